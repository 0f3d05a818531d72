#pragma once
// Where a surface ends for one slave point; for sources of this layer.
#include <algorithm>

#include "osculate/pairing/scope.hpp"

namespace osculate::pairing {

/// Beyond an edge between normals farther apart (37 degrees) lies another side of the body.
inline constexpr double other_side_cosine = 0.8;

/// Whether nothing with this normal may be touched, wherever it lies.
template <int Dim>
[[nodiscard]] bool turned_away(const ProjectionQuery<Dim>& query, const Vec<Dim>& normal) {
  if (query.slave_normal && normal.dot(*query.slave_normal) > same_way_cosine) return true;
  if (!query.scope || query.scope->facing.empty()) return false;
  const auto faces = [&](const Vec<Dim>& n) { return n.dot(normal) < facing_cosine; };
  return std::none_of(query.scope->facing.begin(), query.scope->facing.end(), faces);
}

/// Whether the surface ends for this point between two facets with these normals, `arm` from the
/// middle of the one to that of the other: beyond a convex edge is another side of the body, which
/// the point may not touch. A node beside a block is not in it, and one at its rim must not change
/// between face and edge by rounding errors.
///
/// Tested by  tests/unit/pairing/test_rim.cpp
template <int Dim>
[[nodiscard]] bool ends_between(const ProjectionQuery<Dim>& query, const Vec<Dim>& normal,
                                const Vec<Dim>& beyond, const Vec<Dim>& arm) {
  const bool convex = arm.dot(normal) < 0;
  return convex && normal.dot(beyond) < other_side_cosine && turned_away(query, beyond);
}

}  // namespace osculate::pairing
