#include "osculate/solid/point_strain.hpp"

#include <Eigen/LU>
#include <array>
#include <numbers>

namespace osculate::solid {

const cell::Quadrature2D& quadrature_of(cell::CellType type) {
  static const std::array<cell::Quadrature2D, 4> rules{
      cell::gauss_triangle(1), cell::gauss_triangle(4), cell::gauss_quad(2), cell::gauss_quad(3)};
  switch (type) {
    case cell::CellType::tri3:
      return rules[0];
    case cell::CellType::tri6:
      return rules[1];
    case cell::CellType::quad4:
      return rules[2];
    default:
      return rules[3];
  }
}

PointGeometry point_geometry(const Section& section, cell::CellType type,
                             const Coordinates& reference, const Vec2& xi, double weight) {
  PointGeometry g;
  g.shape = cell::area_shape(type, xi);
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

material::Response point_response(const Section& section, const material::Strain& strain,
                                  double* strain_33) {
  if (section.assumption == Assumption::plane_stress)
    return material::plane_stress_response(section.law, strain, strain_33);
  if (strain_33) *strain_33 = strain[2];
  return material::response(section.law, strain);
}

}  // namespace osculate::solid
