#include "osculate/model/terms/resistance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

template <int Dim>
Eigen::VectorXd diagonal_at_rest(BulkTerm<Dim>& bulk, const BasicDofSpace<Dim>& dofs) {
  const BasicModel<Dim>& model = bulk.model;
  const Eigen::VectorXd rest =
      Eigen::VectorXd::Zero(Dim * static_cast<Eigen::Index>(model.reference.size()));
  Eigen::VectorXd own = Eigen::VectorXd::Zero(dofs.dofs());
  const std::vector<double> untouched(memory_size(model), 0.0);
  BasicBulkBlock<Dim> block;
  for (std::size_t j = 0; j < bulk.jobs.size(); ++j) {
    bulk.evaluate(j, rest, untouched, {}, 0, true, block);
    for (int k = 0; block.ok && k < block.dof_count; ++k)
      own[block.dofs[static_cast<std::size_t>(k)]] += std::abs(block.result.tangent(k, k));
  }
  return own;
}

}  // namespace

/// Also what the rounding of coordinates does to internal forces: |diag K| times that.
///
/// Rigid bodies have no stiffness of their own: they get the mean of the others', their rotations
/// with the square of a length.
template <int Dim>
void Resistance<Dim>::measure(BulkTerm<Dim>& bulk, const BasicDofSpace<Dim>& dofs,
                              Eigen::VectorXd own) {
  const BasicModel<Dim>& model = bulk.model;
  extent = size_of(model);
  if (own.size() == 0) own = diagonal_at_rest(bulk, dofs);
  double sum = 0;
  int count = 0;
  for (Eigen::Index d = 0; d < own.size(); ++d)
    if (own[d] > 0) {
      sum += own[d];
      ++count;
    }
  double farthest = 0;
  for (const typename BulkTerm<Dim>::Job& job : bulk.jobs)
    for (const Index n : cell_nodes(model.mesh, job.cell).nodes)
      farthest = std::max(farthest, model.reference[static_cast<std::size_t>(n)].norm());
  round_off = 2 * std::numeric_limits<double>::epsilon() * farthest * own.norm();
  const double mean = count ? sum / count : 1.0, arm = extent;
  const Dof first = Dim * dofs.nodes();
  diagonal.resize(dofs.unknowns());
  for (Index u = 0; u < dofs.unknowns(); ++u) {
    const Dof dof = dofs.dof_of_unknown(u);
    const bool turns = dof >= first && (dof - first) % body::motions<Dim> >= Dim;
    diagonal[u] = own[dof] > 0 ? own[dof] : mean * (turns ? arm * arm : 1.0);
  }
}

template <int Dim>
void Resistance<Dim>::add(double part, const BasicAssembler<Dim>& assembler,
                          la::MatrixBuilder& builder) const {
  for (Index u = 0; u < diagonal.size(); ++u)
    if (!assembler.prescribed(u)) builder.add(u, u, part * diagonal[u]);
}

template struct Resistance<2>;
template struct Resistance<3>;

}  // namespace osculate::model
