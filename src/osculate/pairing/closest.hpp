#pragma once
#include <limits>
#include <optional>

#include "osculate/pairing/chain.hpp"
#include "osculate/projection/feature.hpp"
#include "osculate/search/bvh.hpp"

namespace osculate::pairing {

/// How far an open end of a chain is continued, as a part of the last facet's parameter range.
inline constexpr double end_extension = 0.05;

/// Generalized projection of a point onto a chain: faces, then the vertices between them.
struct Projection {
  projection::Feature feature = projection::Feature::none;
  Location location;  ///< facet and coordinate (a vertex: the end of its facet)
  double distance = std::numeric_limits<double>::infinity();
  Vec2 outward{0, 0};       ///< averaged normal of the neighbours (corners only)
  bool beyond_end = false;  ///< nearest point is an open end of the chain
};

struct ProjectionQuery {
  Vec2 point{0, 0};
  std::optional<Vec2> slave_normal;  ///< facets facing the same way are not candidates
  Location history;                  ///< equidistant facets: the side of the history wins
};

using Tree = search::Bvh<2>;

/// Boxes of all facets in configuration `x` (analytic lines: infinite).
void facet_boxes(const Chain& chain, std::span<const Vec2> x, std::vector<search::Box<2>>& boxes);

/// Nearest place of the chain. A point that projects onto a node within 1e-8 of the facet's
/// parameter belongs to both neighbours, so there is no gap at shared nodes. Among equidistant
/// facets the one of the history wins, else the first.
///
/// Tested by  tests/unit/pairing/test_closest.cpp (against brute force; both sides of every kink)
[[nodiscard]] Projection closest_on_chain(const Chain& chain, const Tree& tree,
                                          std::span<const Vec2> x, const ProjectionQuery& query);

}  // namespace osculate::pairing
