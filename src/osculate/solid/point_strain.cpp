#include "osculate/solid/point_strain.hpp"

#include <Eigen/LU>
#include <array>
#include <numbers>

#include "osculate/solid/stress_tensor.hpp"

namespace osculate::solid {

namespace {

cell::Quadrature2D quadrature_of(Assumption assumption, cell::CellType type) {
  switch (type) {
    case cell::CellType::tri3:  // one point leaves a ring a mode without energy
      return cell::gauss_triangle(assumption == Assumption::axisymmetric ? 2 : 1);
    case cell::CellType::tri6:
      return cell::gauss_triangle(4);
    case cell::CellType::quad4:
      return cell::gauss_quad(2);
    default:
      return cell::gauss_quad(3);
  }
}

AreaRule make_rule(Assumption assumption, cell::CellType type) {
  const cell::Quadrature2D q = quadrature_of(assumption, type);
  AreaRule rule{q.points, q.weights, {}};
  for (const Vec2& xi : q.points) rule.shape.push_back(cell::area_shape(type, xi));
  return rule;
}

}  // namespace

const AreaRule& area_rule(Assumption assumption, cell::CellType type) {
  using enum cell::CellType;
  constexpr Assumption plane = Assumption::plane_strain, ring = Assumption::axisymmetric;
  static const std::array<AreaRule, 6> rules{make_rule(plane, tri3),  make_rule(ring, tri3),
                                             make_rule(plane, tri6),  make_rule(plane, quad4),
                                             make_rule(plane, quad8), make_rule(plane, quad9)};
  switch (type) {
    case tri3:
      return assumption == ring ? rules[1] : rules[0];
    case tri6:
      return rules[2];
    case quad4:
      return rules[3];
    default:
      return type == quad8 ? rules[4] : rules[5];
  }
}

std::size_t point_count(const Section& section, cell::CellType type) {
  return area_rule(section.assumption, type).points.size();
}

PointGeometry point_geometry(const Section& section, const cell::AreaShape& shape,
                             const Coordinates& reference, double weight) {
  PointGeometry g;
  g.shape = shape;
  const Eigen::Index n = g.shape.count;
  const Mat<2, 2> jacobian = reference.transpose() * g.shape.d.topRows(n);  // dX_i/dxi_j
  g.determinant = jacobian.determinant();
  g.gradient = g.shape.d.topRows(n) * jacobian.inverse();
  g.radius = reference.col(0).dot(g.shape.n.head(n));
  const double depth = section.assumption == Assumption::axisymmetric
                           ? 2 * std::numbers::pi * g.radius
                           : section.thickness;
  g.volume = weight * g.determinant * depth;
  return g;
}

PointStrain point_strain(const Section& section, const PointGeometry& g,
                         const Coordinates& displacement) {
  const Eigen::Index n = g.shape.count;
  PointStrain p;
  const Mat<2, 2> h = displacement.transpose() * g.gradient;  // du_i/dX_j
  const bool finite = section.kinematics == Kinematics::finite;
  const bool axisymmetric = section.assumption == Assumption::axisymmetric;
  const double hoop = axisymmetric ? displacement.col(0).dot(g.shape.n.head(n)) / g.radius : 0.0;
  p.f += h;
  p.f33 = 1 + hoop;
  const Mat<2, 2> f = finite ? p.f : Mat<2, 2>(Mat<2, 2>::Identity());
  p.strain << h(0, 0), h(1, 1), hoop, h(0, 1) + h(1, 0);
  if (finite) {
    const Mat<2, 2> hh = h.transpose() * h;
    p.strain += Vec<4>(0.5 * hh(0, 0), 0.5 * hh(1, 1), 0.5 * hoop * hoop, hh(0, 1));
  }
  p.b.setZero(4, 2 * n);
  for (Eigen::Index k = 0; k < n; ++k)
    for (Eigen::Index i = 0; i < 2; ++i) {
      const double x = g.gradient(k, 0), y = g.gradient(k, 1);
      p.b.col(2 * k + i) << f(i, 0) * x, f(i, 1) * y, 0, f(i, 0) * y + f(i, 1) * x;
      if (axisymmetric && i == 0) p.b(2, 2 * k) = (finite ? p.f33 : 1.0) * g.shape.n[k] / g.radius;
    }
  return p;
}

bool fill_points(const Section& section, cell::CellType type, const Coordinates& reference,
                 const Coordinates& displacement, Points& points) {
  const AreaRule& rule = area_rule(section.assumption, type);
  points.count = rule.points.size();
  bool one_to_one = true;
  for (std::size_t q = 0; q < points.count; ++q) {
    points.geometry[q] = point_geometry(section, rule.shape[q], reference, rule.weights[q]);
    points.strain[q] = point_strain(section, points.geometry[q], displacement);
    if (section.kinematics == Kinematics::finite &&
        !(points.strain[q].f.determinant() > 0 && points.strain[q].f33 > 0))
      one_to_one = false;
  }
  return one_to_one;
}

void add_geometric(const Section& section, const PointGeometry& g, const material::Stress& s,
                   ElementMatrix& k) {
  const Eigen::Index n = g.shape.count;
  const Mat<2, 2> stress = stress_tensor(s);
  for (Eigen::Index a = 0; a < n; ++a)
    for (Eigen::Index b = 0; b < n; ++b) {
      const double value = g.volume * g.gradient.row(a).dot(stress * g.gradient.row(b).transpose());
      k(2 * a, 2 * b) += value;
      k(2 * a + 1, 2 * b + 1) += value;
      if (section.assumption == Assumption::axisymmetric)
        k(2 * a, 2 * b) += g.volume * s[2] * g.shape.n[a] * g.shape.n[b] / (g.radius * g.radius);
    }
}

material::Response point_response(const Section& section, const material::Strain& strain,
                                  const material::Memory& memory, double* strain_33) {
  if (section.assumption == Assumption::plane_stress)
    return material::plane_stress_response(section.law, strain, strain_33, memory);
  if (strain_33) *strain_33 = strain[2];
  return material::response(section.law, strain, memory);
}

}  // namespace osculate::solid
