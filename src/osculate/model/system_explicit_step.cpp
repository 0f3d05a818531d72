// Explicit time integration: the longest stable time step.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "osculate/core/dense.hpp"
#include "osculate/model/system_explicit.hpp"

namespace osculate::model {
namespace {

constexpr int known_for = 100;  ///< time steps until what changes is measured again

}  // namespace

template <int Dim>
double BasicSystem<Dim>::Impl::Explicit::mass_of(std::size_t cell, std::size_t node) const {
  const auto n = static_cast<Eigen::Index>(node);
  return scaled.factor(cell) * system.motion->inertia.cells()[cell].mass(n, n);
}

/// M^-1/2 K M^-1/2 of a cell by itself; empty where it has no answer (the next time step says so).
template <int Dim>
Eigen::MatrixXd BasicSystem<Dim>::Impl::Explicit::scaled_stiffness(std::size_t cell,
                                                                   BulkBlock& block) {
  system.bulk.evaluate(cell, motion.position, now.memory, {}, 0, true, block);
  if (!block.ok) return {};
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, Dim * solid::max_nodes<Dim>, 1> root(block.dof_count);
  for (Eigen::Index d = 0; d < root.size(); ++d)
    root[d] = 1 / std::sqrt(mass_of(cell, static_cast<std::size_t>(d / Dim)));
  return root.asDiagonal() * block.result.tangent * root.asDiagonal();
}

template <int Dim>
void BasicSystem<Dim>::Impl::Explicit::compare(std::size_t cell, double value,
                                               Fastest& fastest) const {
  if (value > fastest.value) {
    fastest.value = value;
    fastest.cell = static_cast<Index>(cell);
  }
  if (touching[cell]) fastest.beside = std::max(fastest.beside, value);
}

/// The eigenvalues themselves are only looked for where a factorisation does not show that they are
/// all below those of a cell before: most cells are no faster than that.
///
/// Formula    lambda_max(A) < s if s I - A is positive definite
template <int Dim>
void BasicSystem<Dim>::Impl::Explicit::look_at(std::size_t cell, BulkBlock& block,
                                               Fastest& fastest) {
  constexpr double equal = 1e-12;  // cells of one shape differ in their last digits
  const Eigen::MatrixXd scaled_by_mass = scaled_stiffness(cell, block);
  if (scaled_by_mass.size() == 0) return;
  const double known = touching[cell] ? fastest.beside : fastest.value;
  if (core::eigenvalues_below(scaled_by_mass, known * (1 + equal))) return;
  compare(cell, core::eigenvalues(scaled_by_mass).maxCoeff(), fastest);
}

/// Likewise, all cells of a batch at once. Their stiffness has seven digits.
template <int Dim>
void BasicSystem<Dim>::Impl::Explicit::look_at_batch(std::size_t four, Work& with,
                                                     Fastest& fastest) {
  constexpr double equal = 1e-6;
  const std::span<const std::size_t> jobs = batches.jobs(four);
  if (!batches.stiffness(four, with.along, with.stiffness)) {
    for (const std::size_t cell : jobs) look_at(cell, with.block, fastest);
    return;
  }
  const std::size_t dofs = batches.dofs(four);
  core::Pack limit;
  typename ForceBatches<Dim>::Values root;
  for (int lane = 0; lane < core::Pack::count; ++lane) {
    const std::size_t cell = jobs[std::min(static_cast<std::size_t>(lane), jobs.size() - 1)];
    limit.set(lane, (1 + equal) * (touching[cell] ? fastest.beside : fastest.value));
    for (std::size_t d = 0; d < dofs; ++d) root[d].set(lane, 1 / std::sqrt(mass_of(cell, d / Dim)));
  }
  for (std::size_t j = 0; j < dofs; ++j)
    for (std::size_t i = 0; i < dofs; ++i) with.stiffness[dofs * j + i] *= root[i] * root[j];
  std::copy_n(with.stiffness.begin(), dofs * dofs, with.scratch.begin());
  const auto n = static_cast<Eigen::Index>(dofs);
  const auto below = core::eigenvalues_below(limit, static_cast<int>(dofs), with.scratch.data());
  for (std::size_t lane = 0; lane < jobs.size(); ++lane) {
    if (below.v[lane] != 0) continue;
    Eigen::MatrixXd of_cell(n, n);
    for (Eigen::Index e = 0; e < of_cell.size(); ++e)
      of_cell.data()[e] = with.stiffness[static_cast<std::size_t>(e)][static_cast<int>(lane)];
    compare(jobs[lane], core::eigenvalues(of_cell).maxCoeff(), fastest);
  }
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
  if (here) look_at(cell, work.front().block, found);
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
    const auto fours = batches.fours(part), others = batches.alone(part);
    if (fours.begin < fours.end) batches.gather(part, motion.position, with.along);
    for (std::size_t f = fours.begin; f < fours.end; ++f) look_at_batch(f, with, of_part[part]);
    for (std::size_t i = others.begin; i < others.end; ++i)
      look_at(batches.others()[i], with.block, of_part[part]);
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
