#include "osculate/solid/volume.hpp"

#include <algorithm>
#include <limits>

#include "osculate/solid/enhanced.hpp"
#include "osculate/solid/finite_forces.hpp"
#include "osculate/solid/mean_dilatation.hpp"
#include "osculate/solid/solid_shell.hpp"
#include "osculate/solid/solid_shell_strain.hpp"
#include "osculate/solid/volume_point.hpp"

namespace osculate::solid {
namespace {

template <int N>
void evaluate_full(const VolumeSection& section, cell::CellType type, const Coordinates3& reference,
                   const Coordinates3& displacement, const material::Memory& memory,
                   bool with_tangent, VolumeResult& out) {
  using Sizes = VolumeSizes<N>;
  const VolumeRule& rule = volume_rule(type);
  const bool finite = section.kinematics == Kinematics::finite;
  const typename Sizes::Nodal x = reference, u = displacement;
  const Eigen::Index n = x.rows();
  typename Sizes::Vector force = Sizes::Vector::Zero(3 * n);
  typename Sizes::Matrix tangent;
  typename Sizes::NodeMatrix geometric;
  if (with_tangent) {
    tangent.setZero(3 * n, 3 * n);
    geometric.setZero(n, n);
  }
  VolumePoint<N> p;
  for (std::size_t q = 0; q < rule.weights.size(); ++q) {
    if (!fill_point<N>(section.kinematics, rule.shape[q], rule.weights[q], x, u, p)) {
      out.status = Status::inverted;
      return;
    }
    const material::Response3 r = material::response(section.law, p.strain, memory.at(q));
    if (!r.ok) {
      out.status = Status::material_failed;
      return;
    }
    const material::Stress3 stress = p.volume * r.stress;
    add_force(p.b, stress, force);
    if (!with_tangent) continue;
    add_material(p.b, p.volume * r.tangent, tangent);
    if (finite) add_geometric(p.gradient, stress, geometric);
  }
  out.force = force;
  if (!with_tangent) return;
  finish_tangent(geometric, tangent);
  out.tangent = tangent;
}

void evaluate_bbar(const VolumeSection& section, const Coordinates3& displacement,
                   const material::Memory& memory, bool with_tangent, HexPoints& points,
                   VolumeResult& out) {
  const bool finite = section.kinematics == Kinematics::finite;
  MeanDilatation<HexPoints> mean;
  if (finite)
    mean = mean_dilatation(points);
  else
    average_volume_small(points, displacement);
  const HexPoints& seen = finite ? mean.point : points;
  HexSizes::Vector force = HexSizes::Vector::Zero();
  HexSizes::Matrix tangent = HexSizes::Matrix::Zero();
  HexSizes::NodeMatrix geometric = HexSizes::NodeMatrix::Zero();
  std::array<material::Stress3, 8> stress;
  for (std::size_t q = 0; q < 8; ++q) {
    const HexPoint& p = seen[q];
    const material::Response3 r = material::response(section.law, p.strain, memory.at(q));
    if (!r.ok) {
      out.status = Status::material_failed;
      return;
    }
    stress[q] = r.stress;
    add_force(p.b, material::Stress3(p.volume * r.stress), force);
    if (!with_tangent) continue;
    add_material(p.b, p.volume * r.tangent, tangent);
    if (finite) add_geometric(p.gradient, p.volume * mean.scale[q] * r.stress, geometric);
  }
  out.force = force;
  if (!with_tangent) return;
  if (finite) add_mean_dilatation_curvature(points, stress, mean, false, tangent);
  finish_tangent(geometric, tangent);
  out.tangent = tangent;
}

/// Enhanced strains: the mode parameters are condensed out of force and tangent.
void evaluate_enhanced(const VolumeSection& section, const Coordinates3& reference,
                       const material::Memory& memory, bool with_tangent, const HexPoints& points,
                       VolumeResult& out) {
  const EnhancedModes<space_modes> e =
      enhanced_modes<space_modes>(section, reference, points, memory);
  if (!e.ok) {
    out.status = Status::material_failed;
    return;
  }
  HexSizes::Vector force = HexSizes::Vector::Zero();
  HexSizes::Matrix tangent = HexSizes::Matrix::Zero();
  HexSizes::NodeMatrix geometric = HexSizes::NodeMatrix::Zero();
  Mat<space_modes, 24> coupling = Mat<space_modes, 24>::Zero();
  for (std::size_t q = 0; q < 8; ++q) {
    const HexPoint& p = points[q];
    const material::Stress3 stress = p.volume * e.response[q].stress;
    add_force(p.b, stress, force);
    if (!with_tangent) continue;
    const material::Tangent3 d = p.volume * e.response[q].tangent;
    add_material(p.b, d, tangent);
    const Mat<space_modes, 6> weighted = e.matrix[q].transpose() * d;
    coupling.noalias() += weighted * p.b;
    if (section.kinematics == Kinematics::finite) add_geometric(p.gradient, stress, geometric);
  }
  out.force = force;
  if (!with_tangent) return;
  const Mat<space_modes, 24> modes = e.stiffness.partialPivLu().solve(coupling);
  tangent.noalias() -= coupling.transpose() * modes;
  finish_tangent(geometric, tangent);
  out.tangent = tangent;
}

/// The cells that explicit analyses have by the thousand.
bool has_forces_alone(const VolumeSection& section, cell::CellType type) {
  if (section.kinematics != Kinematics::finite) return false;
  if (type == cell::CellType::tet4) return section.formulation == VolumeFormulation::full;
  return type == cell::CellType::hex8 && (section.formulation == VolumeFormulation::full ||
                                          section.formulation == VolumeFormulation::bbar);
}

void evaluate_forces(const VolumeSection& section, cell::CellType type,
                     const Coordinates3& reference, const Coordinates3& displacement,
                     const material::Memory& memory, VolumeResult& out) {
  static const PointTable<3, 8, 8> hex(volume_rule(cell::CellType::hex8));
  static const PointTable<3, 4, 1> tet(volume_rule(cell::CellType::tet4));
  const auto set = [&](const auto& table) {
    out.status =
        finite_forces(table, section.law, 1, section.formulation == VolumeFormulation::bbar,
                      reference, displacement, memory, out.force);
  };
  if (type == cell::CellType::hex8)
    set(hex);
  else
    set(tet);
}

bool is_volume(cell::CellType type) { return cell::info(type).dimension == 3; }

void evaluate_whole(const VolumeSection& section, cell::CellType type,
                    const Coordinates3& reference, const Coordinates3& displacement,
                    const material::Memory& memory, bool with_tangent, VolumeResult& out) {
  if (section.formulation == VolumeFormulation::solid_shell) {
    evaluate_solid_shell(section, type, reference, displacement, with_tangent, out, memory);
    return;
  }
  const Eigen::Index dofs = 3 * reference.rows();
  out.status = Status::ok;
  out.force.setZero(dofs);
  if (with_tangent) out.tangent.setZero(dofs, dofs);
  if (section.formulation == VolumeFormulation::full) {
    if (type == cell::CellType::hex8)
      evaluate_full<8>(section, type, reference, displacement, memory, with_tangent, out);
    else if (type == cell::CellType::tet4)
      evaluate_full<4>(section, type, reference, displacement, memory, with_tangent, out);
    else
      evaluate_full<Eigen::Dynamic>(section, type, reference, displacement, memory, with_tangent,
                                    out);
    return;
  }
  HexPoints points;
  if (!fill_points(section.kinematics, reference, displacement, points)) {
    out.status = Status::inverted;
    return;
  }
  if (section.formulation == VolumeFormulation::bbar)
    evaluate_bbar(section, displacement, memory, with_tangent, points, out);
  else
    evaluate_enhanced(section, reference, memory, with_tangent, points, out);
}

}  // namespace

std::string_view unsupported(const VolumeSection& section, cell::CellType type) {
  if (!is_volume(type)) return "only volume cells can be bodies in 3D";
  const bool finite = section.kinematics == Kinematics::finite;
  if (finite && !material::finite_strain(section.law))
    return "linear_elastic is a law of small strains; use st_venant_kirchhoff or neo_hooke with "
           "finite kinematics";
  if (!finite && material::finite_strain(section.law))
    return "the law is one of finite strains; use linear_elastic with small kinematics";
  if (section.formulation == VolumeFormulation::full) return {};
  if (section.formulation == VolumeFormulation::solid_shell) {
    if (type == cell::CellType::hex8 || type == cell::CellType::shell18) return {};
    return "formulation solid_shell exists for hex8 and shell18 cells only; use full";
  }
  if (type != cell::CellType::hex8)
    return "formulations bbar and enhanced exist for hex8 cells only; use auto";
  return {};
}

void evaluate(const VolumeSection& section, cell::CellType type, const Coordinates3& reference,
              const Coordinates3& displacement, bool with_tangent, VolumeResult& out,
              const material::Memory& memory) {
  const bool alone = has_forces_alone(section, type);
  if (with_tangent || !alone)
    evaluate_whole(section, type, reference, displacement, memory, with_tangent, out);
  if (!alone || (with_tangent && out.status != Status::ok)) return;
  evaluate_forces(section, type, reference, displacement, memory,
                  out);  // the same bits in both ways
}

std::size_t point_count(const VolumeSection& section, cell::CellType type) {
  return section.formulation == VolumeFormulation::solid_shell ? shell_rule(type).points.size()
                                                               : volume_rule(type).points.size();
}

VolumeVector volume_weights(cell::CellType type, const Coordinates3& reference) {
  const VolumeRule& rule = volume_rule(type);
  const Eigen::Index n = reference.rows();
  VolumeVector weights = VolumeVector::Zero(n);
  for (std::size_t q = 0; q < rule.weights.size(); ++q) {
    const Mat<3, 3> j = reference.transpose() * rule.shape[q].d.topRows(n);
    weights += rule.weights[q] * j.determinant() * rule.shape[q].n.head(n);
  }
  return weights;
}

double smallest_jacobian(cell::CellType type, const Coordinates3& reference) {
  double smallest = std::numeric_limits<double>::infinity();
  const auto visit = [&](const cell::VolumeShape& s) {
    const Mat<3, 3> j = reference.transpose() * s.d.topRows(s.count);
    smallest = std::min(smallest, j.determinant());
  };
  for (const cell::VolumeShape& s : volume_rule(type).shape) visit(s);
  for (int k = 0; k < cell::info(type).nodes; ++k)
    visit(cell::volume_shape(type, cell::volume_node(type, k)));
  return smallest;
}

}  // namespace osculate::solid
