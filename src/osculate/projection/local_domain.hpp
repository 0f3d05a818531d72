#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "osculate/geometry/curve_frame.hpp"
#include "osculate/geometry/space_curve.hpp"
#include "osculate/geometry/surface_frame.hpp"

namespace osculate::projection {

// Where on its normal a point of a surface or curve is the nearest one as far as its own
// neighbourhood can tell: conditions of second order at the foot point. That nothing else is nearer
// is the business of reach.hpp.

/// The part below < zeta < above of the normal of one point. Normals point out of the body.
struct LocalDomain {
  double below = -std::numeric_limits<double>::infinity();
  double above = std::numeric_limits<double>::infinity();
  [[nodiscard]] bool contains(double zeta) const { return below < zeta && zeta < above; }
};

/// Second derivative of half the squared distance at the foot point, a_ij - zeta h_ij.
///
/// Source     KSCPP:11; it has this form at the foot point only (docs/errata.md)
[[nodiscard]] inline Mat<2, 2> distance_bend(const geometry::SurfaceFrame& f, double zeta) {
  return f.a - zeta * f.h;  // @eq KSCPP:11
}

/// Sylvester's criterion: both leading minors of F'' are positive.
/// Tested by  tests/unit/projection/test_local_domain.cpp, as all of this file
[[nodiscard]] inline bool locally_nearest(const geometry::SurfaceFrame& f, double zeta) {
  const Mat<2, 2> bend = distance_bend(f, zeta);
  const double det = bend(0, 0) * bend(1, 1) - bend(0, 1) * bend(1, 0);
  const double smaller_minor = std::min(bend(0, 0), det);  // @eq KSCPP:12
  return f.valid && smaller_minor > 0;
}

/// det F''/det a = 1 - 2 H zeta + K zeta^2: the area of the surface shifted by zeta per area of the
/// surface itself, signed.
///
/// Source     KSCPP:19 times zeta^2, so that zeta = 0 and both sides are covered
[[nodiscard]] inline double shifted_area(double mean, double gauss, double zeta) {
  return 1 - 2 * mean * zeta + gauss * zeta * zeta;  // @eq KSCPP:19
}

/// The same criterion in the principal directions; holds for both signs of zeta, unlike the print.
[[nodiscard]] inline bool locally_nearest(const geometry::PrincipalCurvatures& k, double zeta) {
  const double least = 1 - std::max(zeta * k.value[0], zeta * k.value[1]);  // @eq KSCPP:20
  return least > 0;
}

/// From the larger and the smaller curvature: 1/k1 above if k1 > 0, 1/k2 below if k2 < 0, else
/// without end. Elliptic, hyperbolic, parabolic and planar points are the four choices of signs.
///
/// Source     KSCPP:22 to KSCPP:25 with zeta = 0 included and the signs of docs/errata.md
[[nodiscard]] inline LocalDomain local_domain(double larger, double smaller) {
  LocalDomain d;
  if (larger > 0) d.above = 1 / larger;    // @eq KSCPP:22, KSCPP:25
  if (smaller < 0) d.below = 1 / smaller;  // @eq KSCPP:23, KSCPP:24
  return d;
}
[[nodiscard]] inline LocalDomain local_domain(const geometry::PrincipalCurvatures& k) {
  return local_domain(k.value[0], k.value[1]);
}

/// F''/a11 of a plane curve at the foot point.
[[nodiscard]] inline double distance_bend(const geometry::CurveFrame& f, double zeta) {
  return 1 - f.kappa * zeta;  // @eq KSCPP:31
}
/// The sides are those of the signed curvature: kappa > 0 bounds the domain above (outside).
[[nodiscard]] inline LocalDomain local_domain(const geometry::CurveFrame& f) {
  LocalDomain d;
  if (f.kappa > 0) d.above = 1 / f.kappa;  // @eq KSCPP:32
  if (f.kappa < 0) d.below = 1 / f.kappa;  // @eq KSCPP:33
  return d;
}

/// F'' per arc length squared of a curve in space, for a point at `arm` from its foot point.
[[nodiscard]] inline double distance_bend(const geometry::SpaceCurveFrame& f, const Vec3& arm) {
  return 1 - f.k * arm.dot(f.nu);  // @eq KSCPP:40
}
/// The same in polar coordinates round the curve.
[[nodiscard]] inline double distance_bend(const geometry::SpaceCurveFrame& f, double r,
                                          double phi) {
  return 1 - f.k * r * std::cos(phi);  // @eq KSCPP:41
}
/// How far one can go from the curve in the direction phi: to the plane r cos phi = 1/k, or without
/// end on the other side.
[[nodiscard]] inline double local_limit(const geometry::SpaceCurveFrame& f, double phi) {
  const double towards = f.k * std::cos(phi);
  constexpr double rounding = 1e-15;  // of the cosine of a right angle
  if (!(towards > rounding * f.k)) return std::numeric_limits<double>::infinity();
  return 1 / towards;  // @eq KSCPP:42
}

}  // namespace osculate::projection
