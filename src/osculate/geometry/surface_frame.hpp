#pragma once
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>

#include "osculate/core/types.hpp"
#include "osculate/geometry/surface_jet.hpp"

namespace osculate::geometry {

/// Tangents, normal, metric and curvature of a surface at one point.
///
/// Formula    a_ij = r_i . r_j ,  n = r_1 x r_2/|r_1 x r_2| ,  h_ij = r_ij . n ,
///            h_i^k = h_ij a^jk ,  Gamma^k_ij = r_ij . r_m a^mk
/// Source     KSVD:4 to KSVD:11
/// Units      a: length^2;  a_inv: 1/length^2;  h: length;  h_mixed: 1/length (xi without unit)
/// Frame      the configuration of the jet; lower indices = covariant
/// Sign       n points out of the master body; h > 0 where the surface bends towards n (a solid
///            sphere has h_ij = -a_ij/R)
/// Errors     `valid` is false where the tangents are parallel, vanish or are not finite;
///            everything else is then zero: no NaN, nothing thrown
/// Tested by  tests/unit/geometry/test_surface_frame.cpp
struct SurfaceFrame {
  std::array<Vec3, 2> tangent{Vec3::Zero(), Vec3::Zero()};  ///< r_1, r_2 (not unit vectors)
  Vec3 normal = Vec3::Zero();
  double area = 0;                                             ///< |r_1 x r_2| = sqrt(det a)
  Mat<2, 2> a = Mat<2, 2>::Zero(), a_inv = Mat<2, 2>::Zero();  ///< a_ij, a^ij
  Mat<2, 2> h = Mat<2, 2>::Zero();                             ///< h_ij
  Mat<2, 2> h_mixed = Mat<2, 2>::Zero();                       ///< (i, k): h_i^k
  std::array<Mat<2, 2>, 2> gamma{Mat<2, 2>::Zero(), Mat<2, 2>::Zero()};  ///< [k](i, j): Gamma^k_ij
  bool valid = false;
};

[[nodiscard]] inline SurfaceFrame surface_frame(const SurfaceJet& jet) {
  SurfaceFrame f;
  const Vec3 &r1 = jet.r1[0], &r2 = jet.r1[1];
  const Vec3 cross = r1.cross(r2);
  const double area = cross.norm(), sides = r1.norm() * r2.norm();
  constexpr double parallel = 8 * std::numeric_limits<double>::epsilon();
  if (!(area > parallel * sides) || !(area >= std::numeric_limits<double>::min()) ||
      !std::isfinite(sides))
    return f;
  f.valid = true;
  f.tangent = jet.r1;
  f.area = area;
  f.normal = cross / area;  // @eq KSVD:4
  Mat<3, 2> tangents;
  tangents << r1, r2;
  f.a = tangents.transpose() * tangents;  // @eq KSVD:5, KSCPP:9
  f.a_inv << f.a(1, 1), -f.a(0, 1), -f.a(1, 0), f.a(0, 0);
  f.a_inv = f.a_inv / area / area;  // @eq KSVD:6 with det a = |r_1 x r_2|^2
  std::array<Mat<2, 2>, 2> along;   // r_ij . r_m
  const auto second = [&](const Vec3& v) {
    Mat<2, 2> m;
    m << jet.r2[0].dot(v), jet.r2[1].dot(v), jet.r2[1].dot(v), jet.r2[2].dot(v);
    return m;
  };
  f.h = second(f.normal);  // @eq KSVD:7, KSCPP:10
  f.h_mixed = f.h * f.a_inv;
  along = {second(r1), second(r2)};
  for (std::size_t k = 0; k < 2; ++k) {
    const Vec2 raise = f.a_inv.col(static_cast<Eigen::Index>(k));
    f.gamma[k] = raise[0] * along[0] + raise[1] * along[1];  // @eq KSVD:11
  }
  return f;
}

/// h^ij.
[[nodiscard]] inline Mat<2, 2> contravariant_curvature(const SurfaceFrame& frame) {
  return frame.a_inv * frame.h * frame.a_inv;  // @eq KSVD:8
}

/// r^1, r^2 with r^i . r_j = delta^i_j and r^i . n = 0.
[[nodiscard]] inline std::array<Vec3, 2> contravariant_basis(const SurfaceFrame& f) {
  return {f.a_inv(0, 0) * f.tangent[0] + f.a_inv(0, 1) * f.tangent[1],
          f.a_inv(1, 0) * f.tangent[0] + f.a_inv(1, 1) * f.tangent[1]};
}

/// dn/dxi^i (Weingarten), i = 0 or 1.
[[nodiscard]] inline Vec3 weingarten_formula(const SurfaceFrame& f, Eigen::Index i) {
  return -f.h_mixed(i, 0) * f.tangent[0] - f.h_mixed(i, 1) * f.tangent[1];  // @eq KSVD:9
}

/// r_ij from the frame (Gauss).
[[nodiscard]] inline Vec3 gauss_formula(const SurfaceFrame& f, Eigen::Index i, Eigen::Index j) {
  return f.gamma[0](i, j) * f.tangent[0] + f.gamma[1](i, j) * f.tangent[1] +
         f.h(i, j) * f.normal;  // @eq KSVD:10
}

/// Position with coordinates (xi1, xi2, zeta).
[[nodiscard]] inline Vec3 offset_point(const SurfaceJet& jet, const Vec3& normal, double zeta) {
  return jet.r + zeta * normal;  // @eq KSVD:17, KSCPP:8
}

/// Derivative of `offset_point` along xi^i: (delta_i^k - zeta h_i^k) r_k. Both become parallel, and
/// the coordinates end, at the centres of curvature.
[[nodiscard]] inline Vec3 offset_tangent(const SurfaceFrame& f, Eigen::Index i, double zeta) {
  return f.tangent[static_cast<std::size_t>(i)] + zeta * weingarten_formula(f, i);
}

/// Covariant derivative of the tangent vector field a^i r_i.
///
/// Formula    (i, j): da^i/dxi^j + a^k Gamma^i_jk
/// Source     KSVD:19; the whole derivative also has the normal part a^k h_kj n, which KSVD:18
///            leaves out
[[nodiscard]] inline Mat<2, 2> covariant_derivative(const SurfaceFrame& f, const Vec2& field,
                                                    const Mat<2, 2>& partial) {
  Mat<2, 2> nabla = partial;
  for (std::size_t i = 0; i < 2; ++i)
    nabla.row(static_cast<Eigen::Index>(i)) += (f.gamma[i] * field).transpose();  // @eq KSVD:19
  return nabla;
}

/// Half the trace of h_i^k; -1/R on a solid sphere. The same in every parameterisation.
[[nodiscard]] inline double mean_curvature(const SurfaceFrame& f) {
  return 0.5 * f.h_mixed.trace();  // @eq KSCPP:18
}
/// det h_i^k, the product of the principal curvatures.
[[nodiscard]] inline double gaussian_curvature(const SurfaceFrame& f) {
  const double det_h = f.h(0, 0) * f.h(1, 1) - f.h(0, 1) * f.h(1, 0);
  return f.valid ? det_h / f.area / f.area : 0.0;  // @eq KSCPP:17
}

/// Extremal normal curvatures, the larger first, with their unit directions. Where both are equal
/// the directions are those of r_1 and n x r_1.
struct PrincipalCurvatures {
  std::array<double, 2> value{0, 0};
  std::array<Vec3, 2> direction{Vec3::Zero(), Vec3::Zero()};
};

/// Formula    eigenvalues of h_ij in the orthonormal basis r_1/|r_1|, n x r_1/|r_1|; the same as
///            H +- sqrt(H^2 - K), without its cancellation where both are nearly equal
/// Source     KSCPP:13, 14 and 16
[[nodiscard]] inline PrincipalCurvatures principal_curvatures(const SurfaceFrame& f) {
  if (!f.valid) return {};
  const Vec3 e1 = f.tangent[0].normalized(), e2 = f.normal.cross(e1);
  Mat<2, 2> from_basis;  // column i: coordinates of e_i on r_1, r_2
  const double p = f.tangent[0].norm(), q = f.tangent[1].dot(e1), s = f.tangent[1].dot(e2);
  from_basis << 1 / p, -q / (p * s), 0, 1 / s;
  const Mat<2, 2> b = from_basis.transpose() * f.h * from_basis;
  const double middle = 0.5 * (b(0, 0) + b(1, 1)), half = 0.5 * (b(0, 0) - b(1, 1));
  const double shear = 0.5 * (b(0, 1) + b(1, 0)), radius = std::hypot(half, shear);
  const double angle = 0.5 * std::atan2(shear, half);
  PrincipalCurvatures out;
  out.value = {middle + radius, middle - radius};  // @eq KSCPP:14, KSCPP:16
  // @eq KSCPP:13
  out.direction = {std::cos(angle) * e1 + std::sin(angle) * e2,
                   std::cos(angle) * e2 - std::sin(angle) * e1};
  return out;
}

}  // namespace osculate::geometry
