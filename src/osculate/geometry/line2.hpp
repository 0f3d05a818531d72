#pragma once
#include <cmath>
#include <limits>

#include "osculate/core/types.hpp"

namespace osculate::geometry {

// Closed forms for the straight two-node segment x1 -> x2, xi in -1..1: what curve_frame() gives
// for its jet, without the jet.

/// rho_xi = (x2 - x1) / 2.
[[nodiscard]] inline Vec2 line2_tangent(const Vec2& x1, const Vec2& x2) {
  return 0.5 * (x2 - x1);  // @eq KS2D:65
}

/// a11 = |x2 - x1|^2 / 4.
[[nodiscard]] inline double line2_metric(const Vec2& x1, const Vec2& x2) {
  return 0.25 * (x2 - x1).squaredNorm();  // @eq KS2D:66
}

/// Unit normal out of the body on the right of x1 -> x2; zero for a segment without length.
///
/// Formula    nu = (y1 - y2, x2 - x1) / (2 sqrt(a11))
/// Source     KS2D:67 corrected: printed with a11 for its root and with the opposite sign
///            (docs/errata.md)
[[nodiscard]] inline Vec2 line2_normal(const Vec2& x1, const Vec2& x2) {
  const double a11 = line2_metric(x1, x2);
  if (!(a11 >= std::numeric_limits<double>::min())) return Vec2::Zero();
  // @eq KS2D:67
  return Vec2(x1.y() - x2.y(), x2.x() - x1.x()) / (2.0 * std::sqrt(a11));
}

}  // namespace osculate::geometry
