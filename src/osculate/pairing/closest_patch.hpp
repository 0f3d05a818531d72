#pragma once
// Closest points of smooth patches; for sources of this layer.
#include "osculate/pairing/surface.hpp"
#include "osculate/projection/point_to_facet.hpp"

namespace osculate::pairing {

/// The patch seen from a point.
struct PatchQuery {
  cell::CellType type;
  const GregoryPoints& points;
  Vec3 point;
};

/// The same three questions as for Lagrange facets (projection/point_to_facet.hpp). The search
/// inside starts from the foot point `start` on the facet through the corners: a patch is so little
/// bent that this leads to its nearest point.
///
/// Tested by  tests/unit/pairing/test_smooth_surface.cpp (against brute force)
[[nodiscard]] projection::FacetFoot closest_on_patch(const PatchQuery& query, const Vec2& start);
[[nodiscard]] projection::FacetFoot closest_on_patch_edge(const PatchQuery& query, int edge);
[[nodiscard]] bool release_from_patch(const PatchQuery& query, double extension,
                                      projection::FacetFoot& foot);

}  // namespace osculate::pairing
