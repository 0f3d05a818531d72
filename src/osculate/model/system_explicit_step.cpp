// Explicit time integration: the longest stable time step.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "osculate/core/dense.hpp"
#include "osculate/model/system_explicit.hpp"

namespace osculate::model {
namespace {

constexpr int known_for = 100;  ///< time steps until what changes is measured again

}  // namespace

/// M^-1/2 K M^-1/2 of a cell by itself; empty where it has no answer (the next time step says so).
template <int Dim>
Eigen::MatrixXd BasicSystem<Dim>::Impl::Explicit::scaled_stiffness(
    std::size_t cell, BulkBlock& block, typename ForceBatches<Dim>::Stiffness& last) {
  constexpr int most = Dim * solid::max_nodes<Dim>;
  const Eigen::MatrixXd* const of_batch = batches.stiffness(cell, last);
  if (!of_batch) {
    system.bulk.evaluate(cell, motion.position, now.memory, {}, 0, true, block);
    if (!block.ok) return {};
  }
  const Eigen::MatrixXd& mass_of = system.motion->inertia.cells()[cell].mass;
  const double factor = scaled.factor(cell);
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most, 1> root(of_batch ? of_batch->rows()
                                                                     : block.dof_count);
  for (Eigen::Index d = 0; d < root.size(); ++d)
    root[d] = 1 / std::sqrt(factor * mass_of(d / Dim, d / Dim));
  if (of_batch) return root.asDiagonal() * *of_batch * root.asDiagonal();
  return root.asDiagonal() * block.result.tangent * root.asDiagonal();
}

/// The eigenvalues themselves are only looked for where a factorisation does not show that they are
/// all below those of a cell before: most cells are no faster than that.
///
/// Formula    lambda_max(A) < s if s I - A is positive definite
template <int Dim>
void BasicSystem<Dim>::Impl::Explicit::look_at(std::size_t cell, BulkBlock& block,
                                               typename ForceBatches<Dim>::Stiffness& last,
                                               Fastest& fastest) {
  constexpr double equal = 1e-12;  // cells of one shape differ in their last digits
  const Eigen::MatrixXd scaled = scaled_stiffness(cell, block, last);
  if (scaled.size() == 0) return;
  const double known = touching[cell] ? fastest.beside : fastest.value;
  if (core::eigenvalues_below(scaled, known * (1 + equal))) return;
  const double value = core::eigenvalues(scaled).maxCoeff();
  if (value > fastest.value) {
    fastest.value = value;
    fastest.cell = static_cast<Index>(cell);
  }
  if (touching[cell]) fastest.beside = std::max(fastest.beside, value);
}

/// What governed before, by the process that has its cell.
template <int Dim>
typename BasicSystem<Dim>::Impl::Explicit::Fastest
BasicSystem<Dim>::Impl::Explicit::fastest_before() {
  Fastest found;
  if (stable.cell < 0) return found;
  const auto cell = static_cast<std::size_t>(stable.cell);
  bool here = !system.ranks;
  for (std::size_t p = parts.from; p < parts.to && !here; ++p)
    for_each_job(p, [&](std::size_t job) { here = here || job == cell; });
  typename ForceBatches<Dim>::Stiffness last;
  if (here) look_at(cell, work.front().block, last, found);
  return of_all(found);
}

/// The fastest of all processes'; of equal ones that of the first process.
template <int Dim>
typename BasicSystem<Dim>::Impl::Explicit::Fastest BasicSystem<Dim>::Impl::Explicit::of_all(
    const Fastest& here) const {
  const core::Ranks* const ranks = system.ranks;
  if (!ranks) return here;
  Fastest all = here;
  all.value = ranks->largest(here.value);
  all.beside = ranks->largest(here.beside);
  const bool mine = here.cell >= 0 && here.value == all.value;
  const double first =
      -ranks->largest(mine ? -ranks->rank() : -static_cast<double>(ranks->count()));
  if (first < ranks->count()) ranks->spread({&all.cell, 1}, static_cast<int>(first));
  return all;
}

/// Formula    h^2 omega^2 + 2 h B <= 4 , B of the dampers of contacts as omega^2 of their springs:
/// they
///            act on u_n - u_n-1 ,
///            omega^2 <= max(omega_cells^2, omega_touching^2 + omega_contact^2) ,
///            no system is faster than its fastest cell by itself, and nodes in
///            contact give one share of their mass to their cells and the rest to the springs
/// Source     Belytschko2014, section 6.2: element eigenvalue inequality
template <int Dim>
void BasicSystem<Dim>::Impl::Explicit::measure_stable_step() {
  // Parts of fixed size, each from what governed before: the bits do not depend on the number of
  // threads.
  const Fastest before = fastest_before();
  std::vector<Fastest> of_part(batches.parts(), before);
  for_parts([&](std::size_t part, Work& with) {
    typename ForceBatches<Dim>::Stiffness last;
    for_each_job(part, [&](std::size_t cell) { look_at(cell, with.block, last, of_part[part]); });
  });
  Fastest all = before;
  for (const Fastest& f : of_part) {
    if (f.value > all.value) {
      all.value = f.value;
      all.cell = f.cell;
    }
    all.beside = std::max(all.beside, f.beside);
  }
  all = of_all(all);
  const double cells = all.value, beside = all.beside;
  stable = {};
  stable.cell = all.cell;
  const double springs = contact_frequency(false), damped = contact_frequency(true);
  stable.contact = (springs > 0 && beside + springs > cells) || damped * damped > 4 * cells;
  const double most = std::max(cells, springs > 0 ? beside + springs : 0.0);
  stable.step = most > 0 ? 4 / (damped + std::sqrt(damped * damped + 4 * most))
                         : std::numeric_limits<double>::infinity();
  // A mass that touches anywhere within a step comes back from its spring after four of them with
  // 0.985 to 1.0006 of its energy; at 0.9 of the critical step with up to 1.8 of it.
  if (springs > 0) stable.faithful = faithful_share / std::sqrt(springs);
  if (damping > 0) stable.faithful = std::min(stable.faithful, 0.5 / damping);
}

template <int Dim>
double BasicSystem<Dim>::Impl::Explicit::stable_step(const solve::ExplicitMotion&) {
  if (!(stable.step > 0) || (changes && stable.since >= known_for)) measure_stable_step();
  return stable.step;
}

template <int Dim>
std::string BasicSystem<Dim>::Impl::Explicit::governed() const {
  if (stable.contact) return "the springs of the contacts";
  if (stable.cell < 0) return "nothing";
  const typename BulkTerm<Dim>::Job& job = system.bulk.jobs[static_cast<std::size_t>(stable.cell)];
  const CellNodes cell = cell_nodes(system.model.mesh, job.cell);
  return fmt::format("{} cell {} of '{}'", cell::info(cell.type).name,
                     mesh::cell_number(system.model.mesh, job.cell), job.section->name);
}

template <int Dim>
std::string BasicSystem<Dim>::Impl::Explicit::faithful_by() const {
  const bool by_damping = damping > 0 && stable.faithful == 0.5 / damping;
  return by_damping ? "the damping by mass" : "impacts on the springs of the contacts";
}

template struct BasicSystem<2>::Impl::Explicit;
template struct BasicSystem<3>::Impl::Explicit;

}  // namespace osculate::model
