#include "osculate/solid/enhanced.hpp"

#include <Eigen/LU>

#include "osculate/solid/local_modes.hpp"

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

/// Responses, equations int M^T S dV = 0 and their derivative at the modes of `e`. `scale` is the
/// size that rounding errors of the equations are relative to. False where the law fails.
bool sample(const Section& section, std::span<const PointGeometry> geometry,
            std::span<const PointStrain> strain, EnhancedModes& e, Vec<enhanced_count>& rest,
            double& scale) {
  rest.setZero();
  scale = 0;
  e.stiffness.setZero();
  for (std::size_t q = 0; q < 4; ++q) {
    const material::Strain total = strain[q].strain + e.matrix[q] * e.alpha;
    e.response[q] = point_response(section, total);
    const material::Response& r = e.response[q];
    if (!r.ok) return false;
    const Mat<4, enhanced_count> weighted = geometry[q].volume * e.matrix[q];
    rest.noalias() += weighted.transpose() * r.stress;
    e.stiffness.noalias() += weighted.transpose() * r.tangent * e.matrix[q];
    const Vec<4> size = r.tangent.cwiseAbs() * total.cwiseAbs() + r.stress.cwiseAbs();
    scale += (weighted.cwiseAbs().transpose() * size).maxCoeff();
  }
  return true;
}

}  // namespace

EnhancedModes enhanced_modes(const Section& section, const Coordinates& reference,
                             std::span<const PointGeometry> geometry,
                             std::span<const PointStrain> strain) {
  const cell::Quadrature2D& rule = quadrature_of(section.assumption, cell::CellType::quad4);
  EnhancedModes e;
  for (std::size_t q = 0; q < 4; ++q)
    e.matrix[q] = mode_matrix(reference, rule.points[q], geometry[q].determinant);
  solve_modes<Vec<enhanced_count>>(e,
                                   [&](EnhancedModes& m, Vec<enhanced_count>& rest, double& scale) {
                                     return sample(section, geometry, strain, m, rest, scale);
                                   });
  return e;
}

}  // namespace osculate::solid
