#include "osculate/model/linear_cells.hpp"

#include <algorithm>

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

/// Whether the product with the stored matrix has the digits of its forces.
template <int Dim>
bool keeps_digits(const BasicBulkSection<Dim>& section) {
  return section.section.formulation != solid::Formulation::solid_shell;
}

}  // namespace

template <int Dim>
void LinearCells<Dim>::add(const BasicBulkSection<Dim>& section, cell::CellType type) {
  const std::size_t dofs = Dim * static_cast<std::size_t>(cell::info(type).nodes);
  const bool linear = section.section.kinematics == solid::Kinematics::small &&
                      material::linear(section.section.law);
  length_.push_back(linear ? static_cast<std::uint32_t>(dofs * dofs) : 0);
}

template <int Dim>
void LinearCells<Dim>::keep(std::size_t number, const BasicBulkBlock<Dim>& block) {
  if (made_[number] || !block.ok) return;
  const auto& tangent = block.result.tangent;
  std::copy_n(tangent.data(), tangent.size(), &values_[begin_[number]]);
  made_[number] = 1;
}

template <int Dim>
void LinearCells<Dim>::evaluate(std::size_t number, const BasicModel<Dim>& model,
                                const BasicBulkSection<Dim>& section, const mesh::CellRef& cell,
                                const Eigen::VectorXd& u, const material::Memory& memory,
                                bool with_tangent, BasicBulkBlock<Dim>& out) {
  const bool known = kept(number) && made_[number];
  evaluate_cell(model, section, cell, u, memory, with_tangent && !known, out);
  if (!with_tangent || !kept(number)) return;
  if (known)
    out.result.tangent =
        Eigen::Map<const Eigen::MatrixXd>(&values_[begin_[number]], out.dof_count, out.dof_count);
  else
    keep(number, out);
}

template <int Dim>
void LinearCells<Dim>::force(std::size_t number, const BasicModel<Dim>& model,
                             const BasicBulkSection<Dim>& section, const mesh::CellRef& cell,
                             const Eigen::VectorXd& u, const material::Memory& memory,
                             BasicBulkBlock<Dim>& out) {
  if (!kept(number) || !keeps_digits(section) || memory.expansion || memory.initial ||
      memory.origin) {
    evaluate_cell(model, section, cell, u, memory, false, out);
    return;
  }
  if (!made_[number]) {
    evaluate_cell(model, section, cell, u, memory, true, out);
    keep(number, out);
    if (!made_[number]) return;
  }
  set_dofs<Dim>(cell_nodes(model.mesh, cell).nodes, out);
  out.ok = true;
  using Displacement = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, Dim * solid::max_nodes<Dim>, 1>;
  Displacement along(out.dof_count);
  const auto value = [&](int d) { return u[out.dofs[static_cast<std::size_t>(d)]]; };
  for (int axis = 0; axis < Dim; ++axis) {
    const double common = slides_freely(section, axis) ? value(axis) : 0;
    for (int d = axis; d < out.dof_count; d += Dim) along[d] = value(d) - common;
  }
  out.result.force.noalias() =
      Eigen::Map<const Eigen::MatrixXd>(&values_[begin_[number]], out.dof_count, out.dof_count) *
      along;
}

template class LinearCells<2>;
template class LinearCells<3>;

}  // namespace osculate::model
