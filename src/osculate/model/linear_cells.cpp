#include "osculate/model/linear_cells.hpp"

#include <Eigen/Eigenvalues>
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

/// Whether the forces are those of the displacements alone, and the product with the stored matrix
/// has their digits.
template <int Dim>
bool moves_alone(const BasicBulkSection<Dim>& section, const material::Memory& memory) {
  return section.section.formulation != solid::Formulation::solid_shell && !memory.expansion &&
         !memory.initial && !memory.origin;
}

/// Whether a cell is about as long in all directions, by the moments of its nodes: the stiffnesses
/// of its modes are then within three or four digits of each other.
template <int Dim>
bool is_compact(const BasicModel<Dim>& model, const mesh::CellRef& cell) {
  constexpr double most = 10;
  const solid::Coordinates<Dim> x = reference_of(model, cell_nodes(model.mesh, cell).nodes);
  const solid::Coordinates<Dim> from_middle = x.rowwise() - x.colwise().mean();
  const Mat<Dim, Dim> moments = from_middle.transpose() * from_middle;
  Eigen::SelfAdjointEigenSolver<Mat<Dim, Dim>> of;
  of.computeDirect(moments, Eigen::EigenvaluesOnly);
  return of.eigenvalues()[Dim - 1] < most * most * of.eigenvalues()[0];
}

}  // namespace

template <int Dim>
void LinearCells<Dim>::add(const BasicBulkSection<Dim>& section, cell::CellType type) {
  const std::size_t dofs = Dim * static_cast<std::size_t>(cell::info(type).nodes);
  const bool linear = section.section.kinematics == solid::Kinematics::small &&
                      material::linear(section.section.law);
  length_.push_back(linear ? static_cast<std::uint32_t>(dofs * (dofs + 1) / 2) : 0);
}

template <int Dim>
bool LinearCells<Dim>::make(std::size_t number, const BasicModel<Dim>& model,
                            const BasicBulkSection<Dim>& section, const mesh::CellRef& cell,
                            const Eigen::VectorXd& u, const material::Memory& memory,
                            BasicBulkBlock<Dim>& out) {
  if (made_[number] != not_made) return true;
  evaluate_cell(model, section, cell, u, memory, true, out);
  if (!out.ok) return false;
  const auto& tangent = out.result.tangent;
  double* to = &values_[begin_[number]];
  for (Eigen::Index column = 0; column < tangent.cols(); ++column)
    to = std::copy_n(&tangent(column, column), tangent.rows() - column, to);
  made_[number] = is_compact(model, cell) ? compact : slender;
  return true;
}

template <int Dim>
void LinearCells<Dim>::evaluate(std::size_t number, const BasicModel<Dim>& model,
                                const BasicBulkSection<Dim>& section, const mesh::CellRef& cell,
                                const Eigen::VectorXd& u, const material::Memory& memory,
                                bool with_tangent, BasicBulkBlock<Dim>& out) {
  if (!kept(number)) {
    evaluate_cell(model, section, cell, u, memory, with_tangent, out);
    return;
  }
  if (!make(number, model, section, cell, u, memory, out)) return;
  if (made_[number] == compact && moves_alone(section, memory))
    multiply(number, model, section, cell, u, out);
  else
    evaluate_cell(model, section, cell, u, memory, false, out);
  if (!with_tangent) return;
  auto& tangent = out.result.tangent;
  tangent.resize(out.dof_count, out.dof_count);
  const double* from = &values_[begin_[number]];
  for (Eigen::Index column = 0; column < tangent.cols(); ++column)
    for (Eigen::Index row = column; row < tangent.rows(); ++row)
      tangent(row, column) = tangent(column, row) = *from++;
}

template <int Dim>
void LinearCells<Dim>::force(std::size_t number, const BasicModel<Dim>& model,
                             const BasicBulkSection<Dim>& section, const mesh::CellRef& cell,
                             const Eigen::VectorXd& u, const material::Memory& memory,
                             BasicBulkBlock<Dim>& out) {
  if (!kept(number) || !moves_alone(section, memory))
    evaluate_cell(model, section, cell, u, memory, false, out);
  else if (make(number, model, section, cell, u, memory, out))
    multiply(number, model, section, cell, u, out);
}

template <int Dim>
void LinearCells<Dim>::multiply(std::size_t number, const BasicModel<Dim>& model,
                                const BasicBulkSection<Dim>& section, const mesh::CellRef& cell,
                                const Eigen::VectorXd& u, BasicBulkBlock<Dim>& out) const {
  set_dofs<Dim>(cell_nodes(model.mesh, cell).nodes, out);
  out.ok = true;
  using Displacement = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, Dim * solid::max_nodes<Dim>, 1>;
  Displacement along(out.dof_count);
  const auto value = [&](int d) { return u[out.dofs[static_cast<std::size_t>(d)]]; };
  for (int axis = 0; axis < Dim; ++axis) {
    const double common = slides_freely(section, axis) ? value(axis) : 0;
    for (int d = axis; d < out.dof_count; d += Dim) along[d] = value(d) - common;
  }
  auto& force = out.result.force;
  force.setZero(out.dof_count);
  const double* k = &values_[begin_[number]];
  for (Eigen::Index column = 0; column < out.dof_count; ++column) {
    const Eigen::Index below = out.dof_count - column - 1;
    const Eigen::Map<const Eigen::VectorXd> of_column(k + 1, below);
    force[column] += *k * along[column] + of_column.dot(along.tail(below));
    force.tail(below) += along[column] * of_column;
    k += below + 1;
  }
}

template class LinearCells<2>;
template class LinearCells<3>;

}  // namespace osculate::model
