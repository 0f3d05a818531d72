// What resists free motions in solve::Resistance: the diagonal of the bodies' own stiffness.
#include <algorithm>
#include <cmath>
#include <limits>

#include "osculate/model/system_impl.hpp"

namespace osculate::model {

namespace {

template <int Dim>
double size_of(const BasicModel<Dim>& model) {
  Vec<Dim> low = Vec<Dim>::Constant(std::numeric_limits<double>::infinity());
  Vec<Dim> high = -low;
  for (const BasicBulkSection<Dim>& section : model.sections)
    for (const mesh::CellRef& ref : section.cells)
      for (const Index n : cell_nodes(model.mesh, ref).nodes) {
        low = low.cwiseMin(model.reference[static_cast<std::size_t>(n)]);
        high = high.cwiseMax(model.reference[static_cast<std::size_t>(n)]);
      }
  return low.x() <= high.x() ? (high - low).norm() : 1.0;
}

}  // namespace

/// Also what the rounding of coordinates does to internal forces: |diag K| times that.
///
/// Rigid bodies have no stiffness of their own: they get the mean of the others', their rotations
/// with the square of a length.
template <int Dim>
void BasicSystem<Dim>::Impl::measure_resistance() {
  extent = size_of(model);
  const Eigen::VectorXd rest =
      Eigen::VectorXd::Zero(Dim * static_cast<Eigen::Index>(model.reference.size()));
  Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(dofs.dofs());
  const std::vector<double> untouched(next_memory.size(), 0.0);
  BulkBlock block;
  for (std::size_t j = 0; j < jobs.size(); ++j) {
    evaluate_job(j, rest, untouched, {}, 0, true, block);
    for (int k = 0; block.ok && k < block.dof_count; ++k)
      diagonal[block.dofs[static_cast<std::size_t>(k)]] += std::abs(block.result.tangent(k, k));
  }
  double sum = 0;
  int count = 0;
  for (Eigen::Index d = 0; d < diagonal.size(); ++d)
    if (diagonal[d] > 0) {
      sum += diagonal[d];
      ++count;
    }
  double farthest = 0;
  for (const CellJob& job : jobs)
    for (const Index n : cell_nodes(model.mesh, job.cell).nodes)
      farthest = std::max(farthest, model.reference[static_cast<std::size_t>(n)].norm());
  round_off = 2 * std::numeric_limits<double>::epsilon() * farthest * diagonal.norm();
  const double mean = count ? sum / count : 1.0, arm = extent;
  const Dof first = Dim * dofs.nodes();
  resistance.resize(dofs.unknowns());
  for (Index u = 0; u < dofs.unknowns(); ++u) {
    const Dof dof = dofs.dof_of_unknown(u);
    const bool turns = dof >= first && (dof - first) % body::motions<Dim> >= Dim;
    resistance[u] = diagonal[dof] > 0 ? diagonal[dof] : mean * (turns ? arm * arm : 1.0);
  }
}

template <int Dim>
void BasicSystem<Dim>::Impl::add_resistance(double share) {
  for (Index u = 0; u < dofs.unknowns(); ++u)
    if (!assembler.prescribed(u)) builder.add(u, u, share * resistance[u]);
}

template struct BasicSystem<2>::Impl;
template struct BasicSystem<3>::Impl;

}  // namespace osculate::model
