#include "osculate/solid/element.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <numbers>

#include "osculate/cell/line_shape.hpp"
#include "osculate/solid/enhanced.hpp"
#include "osculate/solid/point_strain.hpp"

namespace osculate::solid {
namespace {

/// Geometry and strain of all quadrature points.
struct Points {
  std::size_t count = 0;
  std::array<PointGeometry, max_points> geometry;
  std::array<PointStrain, max_points> strain;
};

bool fill_points(const Section& section, cell::CellType type, const Coordinates& reference,
                 const Coordinates& displacement, Points& points) {
  const cell::Quadrature2D& rule = quadrature_of(type);
  points.count = rule.points.size();
  for (std::size_t q = 0; q < points.count; ++q) {
    points.geometry[q] = point_geometry(section, type, reference, rule.points[q], rule.weights[q]);
    points.strain[q] = point_strain(section, points.geometry[q], displacement);
    if (section.kinematics == Kinematics::finite &&
        !(points.strain[q].f.determinant() > 0 && points.strain[q].f33 > 0))
      return false;
  }
  return true;
}

/// Adds int G^T S G dV, the part of the tangent from the change of B (finite kinematics).
void add_geometric(const Section& section, const PointGeometry& g, const material::Stress& s,
                   ElementMatrix& k) {
  const Eigen::Index n = g.shape.count;
  Mat<2, 2> stress;
  stress << s[0], s[3], s[3], s[1];
  for (Eigen::Index a = 0; a < n; ++a)
    for (Eigen::Index b = 0; b < n; ++b) {
      const double value = g.volume * g.gradient.row(a).dot(stress * g.gradient.row(b).transpose());
      k(2 * a, 2 * b) += value;
      k(2 * a + 1, 2 * b + 1) += value;
      if (section.assumption == Assumption::axisymmetric)
        k(2 * a, 2 * b) += g.volume * s[2] * g.shape.n[a] * g.shape.n[b] / (g.radius * g.radius);
    }
}

void evaluate_full(const Section& section, const Points& points, bool with_tangent,
                   ElementResult& out) {
  for (std::size_t q = 0; q < points.count; ++q) {
    const PointGeometry& g = points.geometry[q];
    const PointStrain& p = points.strain[q];
    const material::Response r = point_response(section, p.strain);
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

/// Replaces the volumetric part of B by its mean over the cell (small strain).
void average_volume(Points& points, const Coordinates& displacement) {
  const Eigen::Index dofs = points.strain[0].b.cols();
  Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, 2 * max_nodes> mean(dofs);
  mean.setZero();
  double volume = 0;
  for (std::size_t q = 0; q < points.count; ++q) {
    mean += points.geometry[q].volume * points.strain[q].b.topRows<3>().colwise().sum();
    volume += points.geometry[q].volume;
  }
  mean /= volume;
  ElementVector u(dofs);
  for (Eigen::Index k = 0; k < dofs / 2; ++k) u.segment<2>(2 * k) = displacement.row(k);
  for (std::size_t q = 0; q < points.count; ++q) {
    StrainMatrix& b = points.strain[q].b;
    const Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, 2 * max_nodes> shift =
        (mean - b.topRows<3>().colwise().sum()) / 3.0;
    for (Eigen::Index i = 0; i < 3; ++i) b.row(i) += shift;
    points.strain[q].strain = b * u;
  }
}

/// Enhanced strains: the mode parameters are condensed out of force and tangent.
void evaluate_enhanced(const Section& section, const Coordinates& reference, const Points& points,
                       bool with_tangent, ElementResult& out) {
  const EnhancedModes e = enhanced_modes(section, reference, points.geometry, points.strain);
  if (!e.ok) {
    out.status = Status::material_failed;
    return;
  }
  Eigen::Matrix<double, enhanced_count, Eigen::Dynamic, 0, enhanced_count, 2 * max_nodes> coupling(
      enhanced_count, 8);
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

}  // namespace

std::string_view unsupported(const Section& section, cell::CellType type) {
  if (cell::info(type).dimension != 2) return "only area cells can be bodies in 2D";
  if (section.formulation == Formulation::full) return {};
  if (type != cell::CellType::quad4)
    return "formulations bbar and enhanced exist for quad4 cells only; use full";
  if (section.formulation == Formulation::bbar) {
    if (section.kinematics == Kinematics::finite)
      return "formulation bbar is for small kinematics; use enhanced";
    if (section.assumption == Assumption::plane_stress)
      return "formulation bbar has no use in plane stress; use full or enhanced";
  }
  if (section.formulation == Formulation::enhanced &&
      section.assumption == Assumption::axisymmetric)
    return "formulation enhanced is not available for axisymmetric sections; use full or bbar";
  return {};
}

void evaluate(const Section& section, cell::CellType type, const Coordinates& reference,
              const Coordinates& displacement, bool with_tangent, ElementResult& out) {
  const Eigen::Index dofs = 2 * reference.rows();
  out.status = Status::ok;
  out.force.setZero(dofs);
  out.tangent.setZero(dofs, dofs);
  Points points;
  if (!fill_points(section, type, reference, displacement, points)) {
    out.status = Status::inverted;
    return;
  }
  if (section.formulation == Formulation::bbar) average_volume(points, displacement);
  if (section.formulation == Formulation::enhanced)
    evaluate_enhanced(section, reference, points, with_tangent, out);
  else
    evaluate_full(section, points, with_tangent, out);
}

ElementVector volume_weights(const Section& section, cell::CellType type,
                             const Coordinates& reference) {
  ElementVector weights = ElementVector::Zero(reference.rows());
  const cell::Quadrature2D& rule = quadrature_of(type);
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    const PointGeometry g =
        point_geometry(section, type, reference, rule.points[q], rule.weights[q]);
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
  for (const Vec2& xi : quadrature_of(type).points) visit(xi);
  for (int k = 0; k < cell::info(type).corners; ++k) visit(cell::area_node(type, k));
  return smallest;
}

namespace {

/// Visits the Gauss points of an edge: shape values, slopes, weight.
template <class Visit>
void over_edge(Eigen::Index nodes, const Visit& visit) {
  static const cell::Quadrature1D rule = cell::gauss_legendre(4);
  for (std::size_t q = 0; q < rule.points.size(); ++q)
    visit(cell::lagrange_line(static_cast<int>(nodes), rule.points[q]), rule.weights[q]);
}

double depth_at(const Section& section, double radius) {
  return section.assumption == Assumption::axisymmetric ? 2 * std::numbers::pi * radius
                                                        : section.thickness;
}

}  // namespace

ElementVector edge_weights(const Section& section, const Coordinates& reference) {
  const Eigen::Index n = reference.rows();
  ElementVector weights = ElementVector::Zero(n);
  over_edge(n, [&](const cell::LineShape& s, double weight) {
    Vec2 x = Vec2::Zero(), t = Vec2::Zero();
    for (Eigen::Index k = 0; k < n; ++k) {
      x += s.n[0][static_cast<std::size_t>(k)] * reference.row(k).transpose();
      t += s.n[1][static_cast<std::size_t>(k)] * reference.row(k).transpose();
    }
    for (Eigen::Index k = 0; k < n; ++k)
      weights[k] +=
          weight * s.n[0][static_cast<std::size_t>(k)] * t.norm() * depth_at(section, x.x());
  });
  return weights;
}

PressureResult edge_pressure(const Section& section, const Coordinates& reference,
                             const Coordinates& displacement, double pressure) {
  const Eigen::Index n = reference.rows();
  const bool follows = section.kinematics == Kinematics::finite;
  const bool axisymmetric = section.assumption == Assumption::axisymmetric;
  PressureResult out;
  out.force.setZero(2 * n);
  out.tangent.setZero(2 * n, 2 * n);
  Coordinates now = reference;
  if (follows) now += displacement;
  over_edge(n, [&](const cell::LineShape& s, double weight) {
    Vec2 x = Vec2::Zero(), t = Vec2::Zero();
    for (Eigen::Index k = 0; k < n; ++k) {
      x += s.n[0][static_cast<std::size_t>(k)] * now.row(k).transpose();
      t += s.n[1][static_cast<std::size_t>(k)] * now.row(k).transpose();
    }
    const double depth = depth_at(section, x.x());
    for (Eigen::Index k = 0; k < n; ++k) {
      const double factor = -pressure * weight * s.n[0][static_cast<std::size_t>(k)];
      out.force.segment<2>(2 * k) += factor * depth * turn(t);
      if (!follows) continue;
      for (Eigen::Index l = 0; l < n; ++l) {
        const double slope = s.n[1][static_cast<std::size_t>(l)];
        out.tangent(2 * k, 2 * l + 1) -= factor * depth * slope;
        out.tangent(2 * k + 1, 2 * l) += factor * depth * slope;
        if (axisymmetric)
          out.tangent.block<2, 1>(2 * k, 2 * l) +=
              factor * 2 * std::numbers::pi * s.n[0][static_cast<std::size_t>(l)] * turn(t);
      }
    }
  });
  return out;
}

}  // namespace osculate::solid
