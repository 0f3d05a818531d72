#include "osculate/model/terms/bulk_term.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "osculate/model/changing_unknowns.hpp"
#include "osculate/model/stopwatch.hpp"

namespace osculate::model {
namespace {

constexpr std::size_t tile = 32;     ///< cells of a thread before they are added, in order
constexpr std::size_t worth_it = 4;  ///< cells, while a thread is told of them

}  // namespace

template <int Dim>
BulkTerm<Dim>::BulkTerm(const BasicModel<Dim>& m, const BasicDofSpace<Dim>& dofs, int thread_count)
    : model(m), threads(thread_count), crew(thread_count) {
  for_each_cell(model, [&](const auto& section, const mesh::CellRef& cell, const CellMemory& of) {
    const bool same = is_constant(model, dofs, section, cell);
    (same ? constant : others).push_back(jobs.size());
    stays.push_back(same ? 1 : 0);
    jobs.push_back({&section, cell, of});
    linear.add(section, cell_nodes(model.mesh, cell).type);
  });
  blocks.resize(std::min(tile * static_cast<std::size_t>(std::max(1, threads)), jobs.size()));
}

template <int Dim>
void BulkTerm<Dim>::reserve(const BasicDofSpace<Dim>& dofs, const std::vector<bool>& prescribed,
                            la::MatrixBuilder& builder) const {
  std::vector<Index> of_cell;
  for (const Job& job : jobs) {
    if (job.memory.removed) continue;
    of_cell.clear();
    for (const Index node : cell_nodes(model.mesh, job.cell).nodes)
      for (int i = 0; i < Dim; ++i) {
        const Index unknown = dofs.unknown_of(dofs.node_dof(node, i));
        if (unknown >= 0 && !prescribed[static_cast<std::size_t>(unknown)])
          of_cell.push_back(unknown);
      }
    builder.reserve_block(of_cell);
  }
}

template <int Dim>
void BulkTerm<Dim>::keep_linear() {
  std::vector<char> here(jobs.size(), ranks ? 0 : 1);
  if (ranks)
    for (const std::size_t job : shares.cells) here[job] = 1;
  linear.reserve([](std::size_t) { return false; },
                 [&](std::size_t job) { return here[job] == 0; });
}

template <int Dim>
bool BulkTerm<Dim>::add(const State& committed, const State& trial, double duration,
                        const CellInertia<Dim>* inertia, Assembly<Dim>& to,
                        solve::Evaluation& out) {
  if (ranks && !ranks->agree_on({trial.u.data(), static_cast<std::size_t>(trial.u.size())}))
    throw std::runtime_error("the processes have come to different states");
  std::size_t failed = jobs.size();
  const bool added = add_cells(committed, trial, duration, inertia, to, out, failed);
  return ranks ? all_added(failed, to, out) : added;
}

/// What the others have evaluated; false: a cell of one of them cannot be. The first one counts, as
/// it would for one process alone.
template <int Dim>
bool BulkTerm<Dim>::all_added(std::size_t failed, Assembly<Dim>& to, solve::Evaluation& out) {
  const auto none = static_cast<double>(jobs.size());
  const double first = -ranks->largest(-static_cast<double>(failed));
  if (first < none) {
    const bool here = static_cast<double>(failed) == first;
    const int from = static_cast<int>(ranks->largest(here ? ranks->rank() : -1.0));
    out.ok = false;
    out.message = ranks->spread(out.message, from);
    return false;
  }
  exchange<Dim>(shares, *ranks, to.into.forces.internal);
  if (to.inc) exchange<Dim>(shares, *ranks, to.into.predicted);
  if (diagonal) exchange<Dim>(shares, *ranks, *diagonal);
  return true;
}

template <int Dim>
void BulkTerm<Dim>::exchange_memory(const core::Ranks& among, std::span<const std::size_t> own,
                                    std::vector<double>& memory) const {
  if (memory.empty()) return;
  std::vector<double> all(memory.size(), core::Ranks::nothing);
  const auto copy = [&](std::size_t job, const std::vector<double>& from, std::vector<double>& to) {
    const CellMemory& m = jobs[job].memory;
    const auto begin = static_cast<std::ptrdiff_t>(m.first);
    if (!m.removed)
      std::copy_n(from.begin() + begin, static_cast<std::ptrdiff_t>(m.count), to.begin() + begin);
  };
  for (const std::size_t job : own) copy(job, memory, all);
  among.sum(all);
  for (std::size_t job = 0; job < jobs.size(); ++job) copy(job, all, memory);
}

template <int Dim>
typename BulkTerm<Dim>::Numbers BulkTerm<Dim>::cells_here() const {
  if (!ranks && which == Cells::all) return {nullptr, jobs.size()};
  const std::vector<std::size_t>& some = ranks                      ? shares.cells
                                         : which == Cells::constant ? constant
                                                                    : others;
  return {&some, some.size()};
}

template <int Dim>
template <class WithTangent, class Take>
bool BulkTerm<Dim>::evaluate_in_order(const Numbers& cells, const State& committed,
                                      const State& trial, double duration, Evaluated<Dim>& into,
                                      solve::Evaluation& out, std::size_t& failed,
                                      const WithTangent& with_tangent, const Take& take) {
  for (std::size_t start = 0; start < cells.count; start += blocks.size()) {
    const std::size_t count = std::min(blocks.size(), cells.count - start);
    const Stopwatch watch;
    crew.share_runs(count, worth_it, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const std::size_t job = cells[start + i];
        evaluate(job, trial.u, committed.memory, into.memory, duration, with_tangent(job),
                 blocks[i]);
      }
    });
    seconds += watch.seconds();
    for (std::size_t i = 0; i < count; ++i) {
      BasicBulkBlock<Dim>& block = blocks[i];
      if (!block.ok) {
        out.ok = false;
        out.message = block.message;
        failed = cells[start + i];
        return false;
      }
      if (block.dof_count > 0) take(cells[start + i], block);
    }
  }
  return true;
}

template <int Dim>
bool BulkTerm<Dim>::add_cells(const State& committed, const State& trial, double duration,
                              const CellInertia<Dim>* inertia, Assembly<Dim>& to,
                              solve::Evaluation& out, std::size_t& failed) {
  const auto dofs_of = [](const BasicBulkBlock<Dim>& block) {
    return std::span<const Dof>(block.dofs.data(), static_cast<std::size_t>(block.dof_count));
  };
  const Numbers cells = cells_here();
  // What most cells add to the matrix is the same each time: it is kept in sum.
  const bool apart = to.with_tangent && which == Cells::all && !inertia && !constant.empty() &&
                     constant.size() >= others.size();
  const bool restored = apart && to.builder.restore_values();
  if (to.with_tangent && which == Cells::all && !restored) to.builder.clear();
  if (apart && !restored) {
    std::vector<std::size_t> some;
    for (std::size_t i = 0; i < cells.count; ++i)
      if (stays[cells[i]] != 0) some.push_back(cells[i]);
    const bool added = evaluate_in_order(
        {&some, some.size()}, committed, trial, duration, to.into, out, failed,
        [](std::size_t) { return true; },
        [&](std::size_t, const BasicBulkBlock<Dim>& block) {
          to.assembler.add_block(dofs_of(block), block.result.tangent);
        });
    if (!added) return false;
    to.builder.keep_values();
  }
  const auto is_led = [&](std::size_t job) {  // its tangent predicts what follows from that
    const auto& nodes = cell_nodes(model.mesh, jobs[job].cell).nodes;
    return to.inc && std::ranges::any_of(nodes, [&](Index n) {
             return !to.inc->template segment<Dim>(to.dofs.node_dof(n, 0)).isZero(0);
           });
  };
  return evaluate_in_order(
      cells, committed, trial, duration, to.into, out, failed,
      [&](std::size_t job) {
        return to.with_tangent && (!apart || stays[job] == 0 || diagonal || is_led(job));
      },
      [&](std::size_t job, BasicBulkBlock<Dim>& block) {
        const std::span<const Dof> d = dofs_of(block);
        for (int k = 0; k < block.dof_count; ++k)
          to.into.forces.internal[d[static_cast<std::size_t>(k)]] += block.result.force[k];
        if (!to.with_tangent) return;
        for (int k = 0; diagonal && k < block.dof_count; ++k)
          (*diagonal)[d[static_cast<std::size_t>(k)]] += std::abs(block.result.tangent(k, k));
        if (apart && stays[job] != 0) {
          if (is_led(job)) to.predict(d, block.result.tangent);
          return;
        }
        if (inertia) inertia->add_to(job, block.result.tangent);
        to.add_stiffness(d, block.result.tangent);
      });
}

template <int Dim>
void BulkTerm<Dim>::add_stresses(const Strained& at, const Strained* less, Assembly<Dim>& to) {
  for (std::size_t start = 0; start < jobs.size(); start += blocks.size()) {
    const std::size_t count = std::min(blocks.size(), jobs.size() - start);
    const auto evaluate_one = [&](std::size_t i) {
      const Job& job = jobs[start + i];
      blocks[i].ok = false;
      if (!job.memory.removed && job.section->section.kinematics == solid::Kinematics::small)
        stressed_cell(model, *job.section, job.cell, at.u, job.memory.of(at.memory),
                      less ? &less->u : nullptr,
                      less ? job.memory.of(less->memory) : material::Memory{}, blocks[i]);
    };
    crew.share_runs(count, worth_it, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) evaluate_one(i);
    });
    for (std::size_t i = 0; i < count; ++i) {
      if (!blocks[i].ok) continue;
      const auto size = static_cast<std::size_t>(blocks[i].dof_count);
      to.add_stiffness(std::span<const Dof>(blocks[i].dofs.data(), size), blocks[i].result.tangent);
    }
  }
}

template struct BulkTerm<2>;
template struct BulkTerm<3>;

}  // namespace osculate::model
