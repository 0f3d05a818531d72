#pragma once
#include "osculate/pairing/chain.hpp"
#include "osculate/pairing/projection.hpp"
#include "osculate/pairing/surface.hpp"

namespace osculate::pairing {

/// Boxes of all facets at `x`, by their control points (test_facet_boxes.cpp); of shapes: infinite.
void facet_boxes(const Chain& chain, std::span<const Vec2> x, std::vector<search::Box<2>>& boxes);
void facet_boxes(const FacetSurface& surface, std::span<const Vec3> x,
                 std::vector<search::Box<3>>& boxes, PatchPoints patches = {});

/// Nearest place of the master. A point that projects onto a border within 1e-8 of the facet's
/// parameter belongs to both neighbours, so there is no gap at shared nodes and edges. Among
/// equidistant facets the one of the history wins; without history two neighbours share the point:
/// it belongs to the vertex (edge) between them, whose normal is the averaged one; else the first.
///
/// Tested by  tests/unit/pairing/test_closest.cpp, test_closest3.cpp (against brute force; both
///            sides of every kink)
[[nodiscard]] Projection<2> closest(const Chain& chain, const Tree<2>& tree,
                                    std::span<const Vec2> x, const ProjectionQuery<2>& query);
[[nodiscard]] Projection<3> closest(const FacetSurface& surface, const Tree<3>& tree,
                                    std::span<const Vec3> x, const ProjectionQuery<3>& query);

}  // namespace osculate::pairing
