#pragma once
#include <span>

#include "osculate/cell/facet_shape.hpp"
#include "osculate/core/types.hpp"

namespace osculate::projection {

/// Bezier control points of a quadratic facet (tri6, quad8, quad9): the facet lies in their hull.
/// The order is that of the nodes (a quad8 has a ninth one in its middle); corners are nodes.
///
/// Formula    beside an edge a b with middle node m: 2 m - (a + b) / 2; in the middle of a quad9
///            4 m - sum of the edges' middle nodes + sum of the corners / 4 (m: cell::middle_node)
/// Returns    how many there are
/// Tested by  tests/unit/projection/test_facet_hull.cpp
int control_points(cell::CellType type, std::span<const Vec3> nodes, std::span<Vec3, 9> out);

/// A lower bound of the distance of a point from a facet: that from the triangles
/// through its corners, less the farthest that the facet is away from them; exact for a flat
/// triangle with straight edges and a flat parallelogram.
///
/// Formula    triangles: |r - flat| <= 4/3 max |m - (a + b) / 2|, since the functions of the edges
///            sum up to 2/3 at most; quadrilaterals: 3/4 of the largest distance between control
///            points of facet and bilinear facet, and |a - b + c - d| / 4 from that to its
///            triangles
/// Tested by  tests/unit/projection/test_facet_hull.cpp (against brute force)
[[nodiscard]] double least_distance(cell::CellType type, std::span<const Vec3> nodes,
                                    const Vec3& point);

}  // namespace osculate::projection
