#pragma once
#include <optional>

#include "osculate/projection/projector.hpp"

namespace osculate::projection {

/// Closed-form answers, proved as they stand: the nearest point with its margin. Empty for shapes
/// that are not analytic (Lagrange, NURBS).
///
/// Tested by  tests/unit/projection/test_projector.cpp
[[nodiscard]] std::optional<ClosestPoint<2>> shape_answer(const geometry::Curve& curve,
                                                          const Vec2& point);
[[nodiscard]] std::optional<ClosestPoint<3>> shape_answer(const geometry::Surface& surface,
                                                          const Vec3& point);

/// Smallest 1 - zeta k over the directions of a face (of the curve in the plane): the second
/// derivative of half the squared distance along the surface's arc length. 1 where the metric is
/// singular (a pole), which leaves the question open.
[[nodiscard]] double least_bend(const Vec3& gap, const std::array<Vec3, 2>& r1,
                                const std::array<Vec3, 3>& r2);
/// The same along a curve.
template <int Dim>
[[nodiscard]] double least_bend(const Vec<Dim>& gap, const Vec<Dim>& r1, const Vec<Dim>& r2) {
  const double a = r1.squaredNorm();
  return a > 0 ? 1 - gap.dot(r2) / a : 1.0;
}

/// Below this 1 - zeta k counts as zero: the point is at its centre of curvature. (There the foot
/// point itself is known to the cube root of the rounding only, and 1 - zeta k to its square.)
inline constexpr double least_bend_allowed = 1e-8;
/// Margins below this part of the target's size make a foot point ambiguous.
inline constexpr double least_margin = 1e-9;

}  // namespace osculate::projection
