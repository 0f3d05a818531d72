#include <Eigen/Geometry>

#include "osculate/cell/line_shape.hpp"
#include "osculate/cell/quadrature.hpp"
#include "osculate/solid/points.hpp"

namespace osculate::solid {
namespace {

using cell::CellType;

/// Visits the Gauss points of an edge: shape functions, place, tangent and weight.
template <class Visit>
void over_edge(const Coordinates<2>& x, const Visit& visit) {
  static const cell::Quadrature1D rule = cell::gauss_legendre(4);
  const auto n = static_cast<std::size_t>(x.rows());
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    const cell::LineShape s = cell::lagrange_line(static_cast<int>(n), rule.points[q]);
    Vec2 at = Vec2::Zero(), t = Vec2::Zero();
    for (std::size_t k = 0; k < n; ++k) {
      at += s.n[0][k] * x.row(static_cast<Eigen::Index>(k)).transpose();
      t += s.n[1][k] * x.row(static_cast<Eigen::Index>(k)).transpose();
    }
    visit(s, at, t, rule.weights[q]);
  }
}

/// Exact for the pressure on the face as it is.
cell::Quadrature2D quadrature_of(CellType face) {
  switch (face) {
    case CellType::tri3:
      return cell::gauss_triangle(2);
    case CellType::tri6:
      return cell::gauss_triangle(4);
    case CellType::quad4:
      return cell::gauss_quad(2);
    default:
      return cell::gauss_quad(3);
  }
}

Rule<2> make_rule(CellType face) {
  const cell::Quadrature2D q = quadrature_of(face);
  Rule<2> r{q.points, q.weights, {}};
  for (const Vec2& xi : q.points) r.shape.push_back(cell::area_shape(face, xi));
  return r;
}

/// Visits the Gauss points of a face: shape functions, the tangents x_1, x_2, and weight.
template <class Visit>
void over_face(CellType face, const Coordinates<3>& x, const Visit& visit) {
  using enum CellType;
  static const std::array<Rule<2>, 5> rules{make_rule(tri3), make_rule(tri6), make_rule(quad4),
                                            make_rule(quad8), make_rule(quad9)};
  const Rule<2>& r = rules[static_cast<std::size_t>(face) - static_cast<std::size_t>(tri3)];
  for (std::size_t q = 0; q < r.shape.size(); ++q) {
    const Mat<3, 2> t = x.transpose() * r.shape[q].d.topRows(x.rows());
    visit(r.shape[q], t, r.weights[q]);
  }
}

/// a x as a matrix.
Mat<3, 3> cross_matrix(const Vec3& a) {
  Mat<3, 3> m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

/// The side that the pressure acts on, and nothing yet of its forces.
template <int Dim>
Coordinates<Dim> start(const Section<Dim>& section, const Coordinates<Dim>& reference,
                       const Coordinates<Dim>& displacement, PressureResult<Dim>& out) {
  const Eigen::Index dofs = Dim * reference.rows();
  out.force.setZero(dofs);
  out.tangent.setZero(dofs, dofs);
  Coordinates<Dim> now = reference;
  if (section.kinematics == Kinematics::finite) now += displacement;
  return now;
}

}  // namespace

template <>
ElementVector<2, max_side_nodes> side_weights(const Section<2>& section, CellType,
                                              const Coordinates<2>& reference) {
  const Eigen::Index n = reference.rows();
  ElementVector<2, max_side_nodes> weights = ElementVector<2, max_side_nodes>::Zero(n);
  over_edge(reference, [&](const cell::LineShape& s, const Vec2& x, const Vec2& t, double weight) {
    for (Eigen::Index k = 0; k < n; ++k)
      weights[k] +=
          weight * s.n[0][static_cast<std::size_t>(k)] * t.norm() * depth_at(section, x.x());
  });
  return weights;
}

template <>
ElementVector<3, max_side_nodes> side_weights(const Section<3>&, CellType side,
                                              const Coordinates<3>& reference) {
  const Eigen::Index n = reference.rows();
  ElementVector<3, max_side_nodes> weights = ElementVector<3, max_side_nodes>::Zero(n);
  over_face(side, reference, [&](const cell::AreaShape& s, const Mat<3, 2>& t, double weight) {
    weights += weight * t.col(0).cross(t.col(1)).norm() * s.n.head(n);
  });
  return weights;
}

template <>
PressureResult<2> side_pressure(const Section<2>& section, CellType,
                                const Coordinates<2>& reference, const Coordinates<2>& displacement,
                                double pressure) {
  PressureResult<2> out;
  const Coordinates<2> now = start(section, reference, displacement, out);
  const Eigen::Index n = now.rows();
  over_edge(now, [&](const cell::LineShape& s, const Vec2& x, const Vec2& t, double weight) {
    const double depth = depth_at(section, x.x());
    for (Eigen::Index k = 0; k < n; ++k) {
      const double factor = -pressure * weight * s.n[0][static_cast<std::size_t>(k)];
      out.force.segment<2>(2 * k) += factor * depth * turn(t);
      if (section.kinematics == Kinematics::small) continue;
      for (Eigen::Index l = 0; l < n; ++l) {
        const double slope = s.n[1][static_cast<std::size_t>(l)];
        out.tangent(2 * k, 2 * l + 1) -= factor * depth * slope;
        out.tangent(2 * k + 1, 2 * l) += factor * depth * slope;
        if (is_ring(section))
          out.tangent.block<2, 1>(2 * k, 2 * l) +=
              factor * 2 * std::numbers::pi * s.n[0][static_cast<std::size_t>(l)] * turn(t);
      }
    }
  });
  return out;
}

template <>
PressureResult<3> side_pressure(const Section<3>& section, CellType side,
                                const Coordinates<3>& reference, const Coordinates<3>& displacement,
                                double pressure) {
  PressureResult<3> out;
  const Coordinates<3> now = start(section, reference, displacement, out);
  const Eigen::Index n = now.rows();
  over_face(side, now, [&](const cell::AreaShape& s, const Mat<3, 2>& t, double weight) {
    const Vec3 x1 = t.col(0), x2 = t.col(1), normal = x1.cross(x2);
    const Mat<3, 3> cross1 = cross_matrix(x1), cross2 = cross_matrix(x2);
    for (Eigen::Index k = 0; k < n; ++k) {
      const double factor = -pressure * weight * s.n[k];
      out.force.segment<3>(3 * k) += factor * normal;
      if (section.kinematics == Kinematics::small) continue;
      for (Eigen::Index l = 0; l < n; ++l)
        out.tangent.block<3, 3>(3 * k, 3 * l) += factor * (s.d(l, 1) * cross1 - s.d(l, 0) * cross2);
    }
  });
  return out;
}

}  // namespace osculate::solid
