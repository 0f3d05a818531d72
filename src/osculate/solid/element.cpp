#include "osculate/solid/element.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "osculate/solid/enhanced.hpp"
#include "osculate/solid/finite_forces.hpp"
#include "osculate/solid/mean_dilatation.hpp"
#include "osculate/solid/point_strain.hpp"

namespace osculate::solid {
namespace {

void evaluate_full(const Section& section, const Points& points, const material::Memory& memory,
                   bool with_tangent, ElementResult& out) {
  for (std::size_t q = 0; q < points.count; ++q) {
    const PointGeometry& g = points.geometry[q];
    const PointStrain& p = points.strain[q];
    const material::Response r = point_response(section, p.strain, memory.at(q));
    if (!r.ok) {
      out.status = Status::material_failed;
      return;
    }
    out.force.noalias() += g.volume * p.b.transpose() * r.stress;
    if (!with_tangent) continue;
    const StrainMatrix cb = g.volume * r.tangent * p.b;
    out.tangent.noalias() += p.b.transpose() * cb;
    if (section.kinematics == Kinematics::finite) add_geometric(section, g, r.stress, out.tangent);
  }
}

/// Finite strain with the same volume ratio at all points.
void evaluate_mean_dilatation(const Section& section, const Points& points,
                              const material::Memory& memory, bool with_tangent,
                              ElementResult& out) {
  const MeanDilatation<Points> mean = mean_dilatation(points);
  std::array<material::Stress, max_points> stress;
  for (std::size_t q = 0; q < points.count; ++q) {
    const PointStrain& p = mean.point.strain[q];
    const material::Response r = point_response(section, p.strain, memory.at(q));
    if (!r.ok) {
      out.status = Status::material_failed;
      return;
    }
    const double volume = points.geometry[q].volume;
    stress[q] = r.stress;
    out.force.noalias() += volume * p.b.transpose() * r.stress;
    if (!with_tangent) continue;
    const StrainMatrix cb = volume * r.tangent * p.b;
    out.tangent.noalias() += p.b.transpose() * cb;
    add_geometric(section, points.geometry[q], mean.scale[q] * r.stress, out.tangent);
  }
  if (with_tangent)
    add_mean_dilatation_curvature(points, stress, mean,
                                  section.assumption == Assumption::axisymmetric, out.tangent);
}

/// Enhanced strains: the mode parameters are condensed out of force and tangent.
template <int Count>
void evaluate_enhanced(const Section& section, const Coordinates& reference, const Points& points,
                       const material::Memory& memory, bool with_tangent, ElementResult& out) {
  const EnhancedModes<Count> e = enhanced_modes<Count>(section, reference, points, memory);
  if (!e.ok) {
    out.status = Status::material_failed;
    return;
  }
  Eigen::Matrix<double, Count, Eigen::Dynamic, 0, Count, 2 * max_nodes> coupling(Count, 8);
  coupling.setZero();
  for (std::size_t q = 0; q < 4; ++q) {
    const PointGeometry& g = points.geometry[q];
    const PointStrain& p = points.strain[q];
    out.force.noalias() += g.volume * p.b.transpose() * e.response[q].stress;
    if (!with_tangent) continue;
    const StrainMatrix cb = g.volume * e.response[q].tangent * p.b;
    out.tangent.noalias() += p.b.transpose() * cb;
    coupling.noalias() += e.matrix[q].transpose() * cb;
    if (section.kinematics == Kinematics::finite)
      add_geometric(section, g, e.response[q].stress, out.tangent);
  }
  if (with_tangent)
    out.tangent -= coupling.transpose() * e.stiffness.partialPivLu().solve(coupling);
}

/// The cells that explicit analyses have by the thousand.
bool has_forces_alone(const Section& section, cell::CellType type) {
  return section.kinematics == Kinematics::finite &&
         section.assumption == Assumption::plane_strain &&
         section.formulation != Formulation::enhanced && type == cell::CellType::quad4;
}

void evaluate_forces(const Section& section, cell::CellType type, const Coordinates& reference,
                     const Coordinates& displacement, const material::Memory& memory,
                     ElementResult& out) {
  static const PointTable<2, 4, 4> quad(area_rule(section.assumption, type));
  out.status =
      finite_forces(quad, section.law, section.thickness, section.formulation == Formulation::bbar,
                    reference, displacement, memory, out.force);
}

void evaluate_whole(const Section& section, cell::CellType type, const Coordinates& reference,
                    const Coordinates& displacement, const material::Memory& memory,
                    bool with_tangent, ElementResult& out) {
  const Eigen::Index dofs = 2 * reference.rows();
  out.status = Status::ok;
  out.force.setZero(dofs);
  if (with_tangent) out.tangent.setZero(dofs, dofs);
  Points points;
  if (!fill_points(section, type, reference, displacement, points)) {
    out.status = Status::inverted;
    return;
  }
  if (section.formulation == Formulation::enhanced) {
    if (section.assumption == Assumption::axisymmetric)
      evaluate_enhanced<ring_modes>(section, reference, points, memory, with_tangent, out);
    else
      evaluate_enhanced<plane_modes>(section, reference, points, memory, with_tangent, out);
    return;
  }
  if (section.formulation == Formulation::bbar) {
    if (section.kinematics == Kinematics::finite) {
      evaluate_mean_dilatation(section, points, memory, with_tangent, out);
      return;
    }
    average_volume_small(points, displacement);
  }
  evaluate_full(section, points, memory, with_tangent, out);
}

}  // namespace

std::string_view unsupported(const Section& section, cell::CellType type) {
  if (cell::info(type).dimension != 2) return "only area cells can be bodies in 2D";
  const bool finite = section.kinematics == Kinematics::finite;
  if (finite && !material::finite_strain(section.law))
    return "linear_elastic is a law of small strains; use st_venant_kirchhoff or neo_hooke with "
           "finite kinematics";
  if (!finite && material::finite_strain(section.law))
    return "the law is one of finite strains; use linear_elastic with small kinematics";
  if (section.formulation == Formulation::full) return {};
  if (type != cell::CellType::quad4)
    return "formulations bbar and enhanced exist for quad4 cells only; use auto";
  if (section.formulation == Formulation::bbar && section.assumption == Assumption::plane_stress)
    return "formulation bbar has no use in plane stress; use full or enhanced";
  return {};
}

void evaluate(const Section& section, cell::CellType type, const Coordinates& reference,
              const Coordinates& displacement, bool with_tangent, ElementResult& out,
              const material::Memory& memory) {
  const bool alone = has_forces_alone(section, type);
  if (with_tangent || !alone)
    evaluate_whole(section, type, reference, displacement, memory, with_tangent, out);
  if (!alone || (with_tangent && out.status != Status::ok)) return;
  evaluate_forces(section, type, reference, displacement, memory,
                  out);  // the same bits in both ways
}

ElementVector volume_weights(const Section& section, cell::CellType type,
                             const Coordinates& reference) {
  ElementVector weights = ElementVector::Zero(reference.rows());
  const AreaRule& rule = area_rule(section.assumption, type);
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    const PointGeometry g = point_geometry(section, rule.shape[q], reference, rule.weights[q]);
    weights += g.volume * g.shape.n.head(reference.rows());
  }
  return weights;
}

double smallest_jacobian(cell::CellType type, const Coordinates& reference) {
  double smallest = std::numeric_limits<double>::infinity();
  const auto visit = [&](const Vec2& xi) {
    const cell::AreaShape s = cell::area_shape(type, xi);
    const Mat<2, 2> j = reference.transpose() * s.d.topRows(s.count);
    smallest = std::min(smallest, j.determinant());
  };
  for (const Assumption assumption : {Assumption::plane_strain, Assumption::axisymmetric})
    for (const Vec2& xi : area_rule(assumption, type).points) visit(xi);
  for (int k = 0; k < cell::info(type).nodes; ++k) visit(cell::area_node(type, k));
  return smallest;
}

}  // namespace osculate::solid
