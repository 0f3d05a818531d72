#include "osculate/solid/enhanced.hpp"

#include <Eigen/LU>
#include <algorithm>

namespace osculate::solid {
namespace {

/// Four strain modes (xi for 11, eta for 22, xi and eta for 12), brought from the centre of the
/// cell to the point; their mean is zero, so that the patch test holds (Simo & Rifai 1990).
Mat<4, enhanced_count> mode_matrix(const Coordinates& reference, const Vec2& xi,
                                   double determinant) {
  const cell::AreaShape center = cell::area_shape(cell::CellType::quad4, Vec2::Zero());
  const Mat<2, 2> j = (reference.transpose() * center.d.topRows<4>()).transpose();  // dX_j/dxi_i
  const Mat<2, 2> i = j.inverse();  // i(a, b) = dxi_b/dX_a
  // strain_X = T strain_xi with eps_ab = dxi_i/dX_a dxi_j/dX_b eps_ij
  Mat<3, 3> t;
  t << i(0, 0) * i(0, 0), i(0, 1) * i(0, 1), i(0, 0) * i(0, 1),  //
      i(1, 0) * i(1, 0), i(1, 1) * i(1, 1), i(1, 0) * i(1, 1),   //
      2 * i(0, 0) * i(1, 0), 2 * i(0, 1) * i(1, 1), i(0, 0) * i(1, 1) + i(0, 1) * i(1, 0);
  Mat<3, enhanced_count> natural = Mat<3, enhanced_count>::Zero();
  natural(0, 0) = xi.x();
  natural(1, 1) = xi.y();
  natural(2, 2) = xi.x();
  natural(2, 3) = xi.y();
  const Mat<3, enhanced_count> plane = j.determinant() / determinant * t * natural;
  Mat<4, enhanced_count> m = Mat<4, enhanced_count>::Zero();
  m.row(0) = plane.row(0);
  m.row(1) = plane.row(1);
  m.row(3) = plane.row(2);
  return m;
}

}  // namespace

EnhancedModes enhanced_modes(const Section& section, const Coordinates& reference,
                             std::span<const PointGeometry> geometry,
                             std::span<const PointStrain> strain) {
  const cell::Quadrature2D& rule = quadrature_of(cell::CellType::quad4);
  EnhancedModes e;
  for (std::size_t q = 0; q < 4; ++q)
    e.matrix[q] = mode_matrix(reference, rule.points[q], geometry[q].determinant);
  constexpr int most = 40;
  for (int it = 0; it < most; ++it) {
    Vec<enhanced_count> rest = Vec<enhanced_count>::Zero();
    e.stiffness.setZero();
    for (std::size_t q = 0; q < 4; ++q) {
      e.response[q] = point_response(section, strain[q].strain + e.matrix[q] * e.alpha);
      if (!e.response[q].ok) {
        e.ok = false;
        return e;
      }
      const double volume = geometry[q].volume;
      rest += volume * e.matrix[q].transpose() * e.response[q].stress;
      e.stiffness += volume * e.matrix[q].transpose() * e.response[q].tangent * e.matrix[q];
    }
    const Vec<enhanced_count> step = -e.stiffness.partialPivLu().solve(rest);
    const double scale = std::max(e.alpha.lpNorm<Eigen::Infinity>(), 1e-9);
    const bool found = it > 0 && step.lpNorm<Eigen::Infinity>() <= 1e-13 * scale;
    if (found || rest.norm() == 0) return e;
    e.alpha += step;
  }
  e.ok = false;
  return e;
}

}  // namespace osculate::solid
