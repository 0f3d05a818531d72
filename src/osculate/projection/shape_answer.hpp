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

/// Smallest 1 - zeta k over the directions of a face: the second
/// derivative of half the squared distance along the surface's arc length. 1 where the metric is
/// singular (a pole), which leaves the question open.
[[nodiscard]] double least_bend(const Vec3& gap, const std::array<Vec3, 2>& r1,
                                const std::array<Vec3, 3>& r2);

/// Below this 1 - zeta k counts as zero: the point is at its centre of curvature. (There the foot
/// point itself is known to the cube root of the rounding only, and 1 - zeta k to its square.)
inline constexpr double least_bend_allowed = 1e-8;
/// Margins below this part of the target's size make a foot point ambiguous.
inline constexpr double least_margin = 1e-9;

}  // namespace osculate::projection
