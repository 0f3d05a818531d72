#pragma once
#include <limits>
#include <span>

#include "osculate/core/types.hpp"

namespace osculate::projection {

/// The nearest places of two edges, which may lie a little beyond their ends.
struct EdgesFoot {
  bool converged = false;
  Vec2 xi{0, 0};  ///< coordinate on the first and on the second edge, -1..1 inside
  double squared_distance = std::numeric_limits<double>::infinity();
};

/// How far beyond its ends (parameter -1..1) an edge is continued.
inline constexpr double edge_extension = 0.1;

/// Closest points of two edges with two (straight) or three nodes each (both ends, then the
/// middle): a minimum of the distance in the inside of both ranges.
///
/// Formula    F = |s(eta) - r(xi)|^2 / 2: for straight edges one linear system, whose solution is
///            the only minimum; else Newton's method with line search from the nearest points of a
///            grid, the nearest minimum of those it ends in
/// Requires   finite coordinates
/// Returns    converged is false for edges nearer than 5 degrees to parallel at that place (the
///            nearest place is a matter of round-off there) and where there is no minimum within
///            `edge_extension` of both ranges
/// Tested by  tests/unit/projection/test_edge_to_edge.cpp (against brute force)
[[nodiscard]] EdgesFoot closest_points(std::span<const Vec3> first, std::span<const Vec3> second);

}  // namespace osculate::projection
