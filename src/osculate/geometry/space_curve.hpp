#pragma once
#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "osculate/core/types.hpp"
#include "osculate/geometry/curve_jet.hpp"

namespace osculate::geometry {

/// Natural frame of a curve in space: an edge of a body, say.
///
/// Formula    tau = rho_xi/|rho_xi| ;  k nu = dtau/ds ;  beta = tau x nu
/// Source     KSCPP:30, 34, 35
/// Units      k: 1/length
/// Sign       k >= 0, nu points to the centre of curvature. Where the curve is straight (k <= 1e-12
///            |rho_xixi|/a11, or zero) k is 0 and nu any normal (remark 1 of KSCPP 4.3)
/// Errors     `valid` is false where rho_xi vanishes or is not finite; everything else is then zero
/// Tested by  tests/unit/geometry/test_space_curve.cpp
struct SpaceCurveFrame {
  Vec3 tau = Vec3::Zero(), nu = Vec3::Zero(), beta = Vec3::Zero();
  double speed = 0;  ///< ds/dxi
  double k = 0;
  bool valid = false;
};

[[nodiscard]] inline SpaceCurveFrame space_curve_frame(const CurveJet<3>& jet) {
  SpaceCurveFrame f;
  const double speed = std::sqrt(jet.r1.dot(jet.r1));  // @eq KSCPP:35
  if (!(speed >= std::numeric_limits<double>::min()) || !std::isfinite(speed)) return f;
  f.valid = true;
  f.speed = speed;
  f.tau = jet.r1 / speed;
  const Vec3 second = jet.r2 / speed / speed;
  const Vec3 bend = second - second.dot(f.tau) * f.tau;  // dtau/ds
  const double k = bend.norm();
  if (k > 1e-12 * second.norm()) {
    f.k = k;  // @eq KSCPP:30
    f.nu = bend / k;
  } else {
    f.nu = f.tau.unitOrthogonal();
  }
  f.beta = f.tau.cross(f.nu);
  return f;
}

/// Direction at the angle phi from nu, in the plane across the curve.
[[nodiscard]] inline Vec3 across(const SpaceCurveFrame& f, double phi) {
  return f.nu * std::cos(phi) + f.beta * std::sin(phi);  // @eq KSCPP:39
}

/// Position with coordinates (xi, r, phi) round the curve.
[[nodiscard]] inline Vec3 point_around(const CurveJet<3>& jet, const SpaceCurveFrame& f, double r,
                                       double phi) {
  return jet.r + r * across(f, phi);  // @eq KSCPP:38
}

}  // namespace osculate::geometry
