#pragma once
// Where a slave point is along a concave edge of a master in space; for sources of this layer.
#include <optional>

#include "osculate/pairing/pair.hpp"

namespace osculate::pairing {

/// How far beyond an open end an edge is continued, in its coordinate -1..1: as far as its facets.
inline constexpr double edge_end_extension = 2 * end_extension;

/// A place on an edge: the closest one to a point, perhaps a little beyond the end.
///
/// Formula    e' . (x - e(s)) = 0
struct EdgePlace {
  Index edge = -1;  ///< number in ReentrantEdges
  double s = 0;
  Vec3 point = Vec3::Zero(), first = Vec3::UnitX(), second = Vec3::Zero();  ///< e, e', e''
  Vec3 tangent = Vec3::UnitX();
  std::array<Vec3, 2> normal, away;  ///< of both facets, and from the edge into them
  Vec3 bisector = Vec3::UnitY();     ///< of the normals
  bool beyond = false;               ///< an end behind which there is no such edge
};

/// A place on the edge that a history or an active branch names by facet and coordinates.
struct EdgeLocation {
  Index edge = -1;
  double s = 0;
};

/// Finds the concave edges of a master between Lagrange facets; whether there are any.
bool find_reentrant_edges(const FacetSurface& master, std::span<const Vec3> reference, double angle,
                          ReentrantEdges& edges);

/// The concave edge of a facet on which the place `xi` lies.
[[nodiscard]] std::optional<EdgeLocation> location_on_edge(const ReentrantEdges& edges,
                                                           const FacetSurface& master, Index facet,
                                                           const Vec2& xi);

[[nodiscard]] Vec3 edge_derivative(const SharpEdge& edge, int order, double s,
                                   std::span<const Vec3> x);
/// Coordinates of a place of the edge on one of its facets, and their derivative by s.
[[nodiscard]] Vec2 edge_xi(const SharpEdge& edge, std::size_t side, double s);
[[nodiscard]] Vec2 edge_xi_rate(const SharpEdge& edge, std::size_t side);

/// The place of a point that was held in `edge`: there, or in one that goes on from it.
[[nodiscard]] EdgePlace follow_edge(const ReentrantEdges& edges, const FacetSurface& master,
                                    Index edge, std::span<const Vec3> x, const Vec3& point);

/// The nearest place on the concave edges that begin at corners of both facets.
[[nodiscard]] std::optional<EdgePlace> edge_between(const ReentrantEdges& edges,
                                                    const FacetSurface& master,
                                                    std::array<Index, 2> facets,
                                                    std::span<const Vec3> x, const Vec3& point);

/// The side (0 or 1) of the edge on which a facet lies: by its normal, unless the edge is its own.
[[nodiscard]] std::size_t side_of(const SharpEdge& edge, const EdgePlace& place,
                                  const FacetSurface& master, Index facet, std::span<const Vec3> x);

}  // namespace osculate::pairing
