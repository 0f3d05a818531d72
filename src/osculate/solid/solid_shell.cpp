#include "osculate/solid/solid_shell.hpp"

#include <Eigen/LU>

#include "osculate/solid/solid_shell_strain.hpp"

namespace osculate::solid {
namespace {

constexpr int max_rows = 6 * max_shell_points, max_dofs = 3 * max_shell_nodes;
/// Six rows a quadrature point, so that the stiffness is one product.
using Stack = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, max_rows, max_dofs>;
using ModeStack =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, max_rows, max_shell_modes>;
using SampleStress = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, max_shell_samples, 1>;

/// Weighted stress that works on each sample. Input: of_point(q), the stress of a point.
template <class OfPoint>
SampleStress sample_stress(const ShellCell& cell, const OfPoint& of_point) {
  SampleStress stress = SampleStress::Zero(cell.sample_b.cols());
  for (std::size_t q = 0; q < cell.rule->points.size(); ++q) {
    const ShellPoint& p = cell.points[q];
    const material::Stress3& given = of_point(q);
    const Vec<6> convected = p.volume * p.from_convected.transpose() * given;
    for (const ShellShare& share : p.shares)
      stress[static_cast<Eigen::Index>(share.sample)] += share.weight * convected[share.component];
  }
  return stress;
}

/// int B^T C B dV with the modes condensed.
void add_material(const ShellCell& cell, const ShellModes& modes, ElementMatrix<3>& tangent) {
  const Eigen::Index dofs = cell.sample_b.rows();
  const auto points = static_cast<Eigen::Index>(cell.rule->points.size());
  Stack b(6 * points, dofs), cb(6 * points, dofs);
  ModeStack m(6 * points, cell.rule->modes);
  Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, max_dofs> convected(6, dofs);
  for (Eigen::Index q = 0; q < points; ++q) {
    const auto at = static_cast<std::size_t>(q);
    const ShellPoint& p = cell.points[at];
    convected.setZero();
    for (const ShellShare& share : p.shares)
      convected.row(share.component) +=
          share.weight * cell.sample_b.col(static_cast<Eigen::Index>(share.sample)).transpose();
    b.middleRows<6>(6 * q).noalias() = p.from_convected * convected;
    cb.middleRows<6>(6 * q).noalias() =
        p.volume * modes.response[at].tangent * b.middleRows<6>(6 * q);
    m.middleRows<6>(6 * q) = p.modes;
  }
  tangent.noalias() += b.transpose() * cb;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, max_shell_modes, max_dofs> coupling =
      m.transpose() * cb;
  tangent.noalias() -= coupling.transpose() * modes.stiffness.partialPivLu().solve(coupling);
}

/// Adds sum over samples of their stress times the second derivative of their strain.
void add_geometric(const ShellCell& cell, const SampleStress& stress, ElementMatrix<3>& tangent) {
  constexpr std::array<std::array<Eigen::Index, 2>, 6> axes{
      {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};
  const Eigen::Index nodes = cell.rule->center.rows();
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, max_shell_nodes, max_shell_nodes> sum(
      nodes, nodes);
  sum.setZero();
  for (std::size_t s = 0; s < cell.rule->samples.size(); ++s) {
    const ShellSample& sample = cell.rule->samples[s];
    const auto [i, j] = axes[static_cast<std::size_t>(sample.component)];
    const double weight = 0.5 * stress[static_cast<Eigen::Index>(s)] * (i == j ? 1.0 : 2.0);
    sum.noalias() += weight * sample.shape.col(i) * sample.shape.col(j).transpose();
    sum.noalias() += weight * sample.shape.col(j) * sample.shape.col(i).transpose();
  }
  for (Eigen::Index k = 0; k < nodes; ++k)
    for (Eigen::Index l = 0; l < nodes; ++l)
      tangent.block<3, 3>(3 * k, 3 * l).diagonal().array() += sum(k, l);
}

}  // namespace

void evaluate_solid_shell(const Section<3>& section, cell::CellType type,
                          const Coordinates<3>& reference, const Coordinates<3>& displacement,
                          bool with_tangent, ElementResult<3>& out,
                          const material::Memory& memory) {
  const Eigen::Index dofs = 3 * reference.rows();
  out.status = Status::ok;
  out.force.setZero(dofs);
  out.tangent.setZero(dofs, dofs);
  ShellCell cell;
  if (!fill_shell(section, type, reference, displacement, cell)) {
    out.status = Status::inverted;
    return;
  }
  const ShellModes modes = shell_modes(section, cell, memory);
  if (!modes.ok) {
    out.status = Status::material_failed;
    return;
  }
  const SampleStress stress = sample_stress(
      cell, [&](std::size_t q) -> const material::Stress3& { return modes.response[q].stress; });
  out.force.noalias() = cell.sample_b * stress;
  if (!with_tangent) return;
  add_material(cell, modes, out.tangent);
  if (section.kinematics == Kinematics::finite) add_geometric(cell, stress, out.tangent);
}

void add_solid_shell_stress_stiffness(const Section<3>& section, cell::CellType type,
                                      const Coordinates<3>& reference, const CellStress<3>& stress,
                                      ElementMatrix<3>& to) {
  ShellCell cell;
  (void)fill_shell(section, type, reference, Coordinates<3>::Zero(reference.rows(), 3), cell);
  add_geometric(
      cell,
      sample_stress(
          cell, [&](std::size_t q) -> const material::Stress3& { return stress.point[q].stress; }),
      to);
}

}  // namespace osculate::solid
