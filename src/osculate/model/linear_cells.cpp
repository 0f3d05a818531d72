#include "osculate/model/linear_cells.hpp"

namespace osculate::model {
namespace {

/// Whether a cell feels nothing of a motion of all its nodes along an axis.
template <int Dim>
bool slides_freely(const BasicBulkSection<Dim>& section, Eigen::Index axis) {
  if constexpr (Dim == 2)
    return axis == 1 || section.section.assumption != solid::Assumption::axisymmetric;
  else
    return true;
}

}  // namespace

template <int Dim>
void LinearCells<Dim>::add(const BasicBulkSection<Dim>& section, cell::CellType type) {
  const std::size_t dofs = Dim * static_cast<std::size_t>(cell::info(type).nodes);
  const bool kept = section.section.kinematics == solid::Kinematics::small &&
                    (size_ + dofs * dofs) * sizeof(double) <= most_bytes;
  begin_.push_back(kept ? size_ : nowhere);
  made_.push_back(0);
  if (kept) size_ += dofs * dofs;
}

template <int Dim>
void LinearCells<Dim>::evaluate(std::size_t number, const BasicModel<Dim>& model,
                                const BasicBulkSection<Dim>& section, const mesh::CellRef& cell,
                                const Eigen::VectorXd& u, bool with_tangent,
                                BasicBulkBlock<Dim>& out) {
  if (begin_[number] == nowhere || values_.empty()) {
    evaluate_cell(model, section, cell, u, with_tangent, out);
    return;
  }
  const CellNodes nodes = cell_nodes(model.mesh, cell);
  const auto dofs = static_cast<Eigen::Index>(Dim * nodes.nodes.size());
  Eigen::Map<Eigen::MatrixXd> stiffness(&values_[begin_[number]], dofs, dofs);
  if (!made_[number]) {
    evaluate_cell(model, section, cell, u, true, out);
    if (!out.ok) return;
    stiffness = out.result.tangent;
    made_[number] = 1;
  }
  set_dofs<Dim>(nodes.nodes, out);
  out.ok = true;
  using Displacement =
      Eigen::Matrix<double, Eigen::Dynamic, 1, 0, Dim * BulkTraits<Dim>::max_nodes, 1>;
  Displacement along(dofs);
  const auto value = [&](Eigen::Index d) { return u[out.dofs[static_cast<std::size_t>(d)]]; };
  for (Eigen::Index axis = 0; axis < Dim; ++axis) {
    const double common = slides_freely(section, axis) ? value(axis) : 0;
    for (Eigen::Index d = axis; d < dofs; d += Dim) along[d] = value(d) - common;
  }
  out.result.force.noalias() = stiffness * along;
  if (with_tangent) out.result.tangent = stiffness;
}

template class LinearCells<2>;
template class LinearCells<3>;

}  // namespace osculate::model
