#pragma once
#include <limits>
#include <span>

#include "osculate/cell/facet_shape.hpp"
#include "osculate/core/types.hpp"
#include "osculate/projection/feature.hpp"

namespace osculate::projection {

/// The nearest place of one facet: inside it, on an edge, or at a corner.
struct FacetFoot {
  bool converged = false;
  Vec2 xi{0, 0};
  double squared_distance = std::numeric_limits<double>::infinity();
  Feature feature = Feature::none;  ///< face, edge or corner
  int local = -1;                   ///< edge k joins corners k and k + 1; number of the corner
};

/// Closest point of a facet: the best of a safeguarded Newton iteration inside the facet, started
/// from the nearest point of a grid, and of its edges with their corners; where the way inwards
/// from there is downhill, of an iteration that begins there. Of triangles in closed form, of quad4
/// by Newton's method alone where the distance is convex (BilinearDistance).
///
/// Decision   docs/decisions/119-nearest-places-of-facets.md
/// Formula    F = |p - r|^2 / 2,  F_i = -(p - r) . r_,i ,  F_ij = a_ij - (p - r) . r_,ij
/// Source     KSVD:14 to KSVD:17 with r_,ij (p - r) in full: (17) holds at the solution only
/// Requires   nodes of a cell type that `cell::facet_shape` knows, finite coordinates
/// Returns    converged is false only for coordinates that are not finite
/// Tested by  tests/unit/projection/test_point_to_facet.cpp (against brute force)
[[nodiscard]] FacetFoot closest_point(cell::CellType type, std::span<const Vec3> nodes,
                                      const Vec3& point);

/// Closest point of one edge; feature is corner at its ends.
[[nodiscard]] FacetFoot closest_point_on_edge(cell::CellType type, std::span<const Vec3> nodes,
                                              int edge, const Vec3& point);

/// The foot point just beyond the border of the facet, by Newton's steps on the continued surface.
/// True, and `foot` moved there with feature face, if it lies within `extension` of the parameter
/// range beyond the border.
[[nodiscard]] bool release(cell::CellType type, std::span<const Vec3> nodes, const Vec3& point,
                           double extension, FacetFoot& foot);

}  // namespace osculate::projection
