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

template <int Dim>
double BasicSystem<Dim>::Impl::Explicit::cell_frequency(std::size_t cell, BulkBlock& block) {
  constexpr int most = Dim * solid::max_nodes<Dim>;
  system.bulk.evaluate(cell, motion.position, now.memory, {}, 0, true, block);
  if (!block.ok) return 0;  // the next time step says so
  const Eigen::MatrixXd& mass_of = system.motion->inertia.cells()[cell].mass;
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most, 1> root(block.dof_count);
  for (Eigen::Index d = 0; d < root.size(); ++d) root[d] = 1 / std::sqrt(mass_of(d / Dim, d / Dim));
  const Eigen::MatrixXd scaled = root.asDiagonal() * block.result.tangent * root.asDiagonal();
  return core::eigenvalues(scaled).maxCoeff();
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
  const auto count = static_cast<std::ptrdiff_t>(system.bulk.jobs.size());
  std::vector<double> of_cell(system.bulk.jobs.size());
#pragma omp parallel num_threads(system.bulk.threads)
  {
    BulkBlock block;
#pragma omp for schedule(static)
    for (std::ptrdiff_t c = 0; c < count; ++c)
      of_cell[static_cast<std::size_t>(c)] = cell_frequency(static_cast<std::size_t>(c), block);
  }
  double cells = 0, beside = 0;
  stable = {};
  for (std::size_t c = 0; c < of_cell.size(); ++c) {
    if (of_cell[c] > cells) {
      cells = of_cell[c];
      stable.cell = static_cast<Index>(c);
    }
    if (touching[c]) beside = std::max(beside, of_cell[c]);
  }
  const double springs = contact_frequency(false), damped = contact_frequency(true);
  stable.contact = (springs > 0 && beside + springs > cells) || damped * damped > 4 * cells;
  const double most = std::max(cells, springs > 0 ? beside + springs : 0.0);
  stable.step = most > 0 ? 4 / (damped + std::sqrt(damped * damped + 4 * most))
                         : std::numeric_limits<double>::infinity();
  // A mass that touches anywhere within a step comes back from its spring after four of them with
  // 0.985 to 1.0006 of its energy; at 0.9 of the critical step with up to 1.8 of it.
  if (springs > 0) stable.faithful = 0.75 / std::sqrt(springs);
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

template struct BasicSystem<2>::Impl::Explicit;
template struct BasicSystem<3>::Impl::Explicit;

}  // namespace osculate::model
