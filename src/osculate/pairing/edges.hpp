#pragma once
#include <numbers>
#include <vector>

#include "osculate/contact/history.hpp"
#include "osculate/pairing/projected_point.hpp"
#include "osculate/pairing/slave_side.hpp"

namespace osculate::pairing {

/// An edge between two facets whose normals stand at a large angle to each other.
struct SharpEdge {
  int count = 0;                            ///< 2 nodes, or 3 with the one in the middle
  std::array<Index, 3> nodes{};             ///< both ends first
  std::array<Index, 2> facets{-1, -1};      ///< the first one runs along it from end to end
  std::array<std::array<Vec2, 2>, 2> ends;  ///< coordinates of both ends on each of them
};

/// Contact of the sharp edges of both sides where they cross: what no slave node can see. A
/// edge-edge contact is a contact point on the edges' nearest places; it counts where
///   * both edges support the contact normal: it leans by more than `flush_angle` into both wedges,
///     seen from the faces (flush faces are left to the nodes);
///   * the edges are more than 5 degrees from parallel (projection::closest_points);
///   * no node of the slave's edge is in contact with the same master: that contact is the node's.
/// So a place is pushed by a node or by an edge-edge contact, never by both.
struct EdgeContact {
  static constexpr double default_angle = std::numbers::pi / 6;
  static constexpr double flush_angle = std::numbers::pi / 36;
  double angle = default_angle;  ///< of the normals, in the reference configuration
  // Filled by `prepare`.
  std::vector<SharpEdge> master{}, slave{};
  std::vector<std::array<int, 3>> slave_nodes{};  ///< places of the slave's edge in the node list
  std::vector<double> areas{};                    ///< mean of the edge's end nodes
  double longest = 0;  ///< longest edge: farther places are no neighbours
};

/// Two edges that cross.
struct EdgeEdgePoint {
  Index slave = -1, master = -1;  ///< numbers in EdgeContact
  /// Coordinates on the master's edge and, backwards if `flipped`, on the slave's: so that the
  /// difference of both is a surface whose normal r_1 x r_2 points out of the master.
  Vec2 xi{0, 0};
  bool flipped = false;
  double overhang = 0;  ///< how far it lies beyond the ends of the edges
  Vec3 place = Vec3::Zero();
};

struct EdgeBuffers {
  std::vector<search::Box<3>> boxes;
  Tree<3> tree;
  std::vector<EdgeEdgePoint> found;  ///< by slave, then master edge
};

/// Where the facets of an edge lie: below each other's planes, the body in the wedge, or above
/// them.
enum class Bend : std::uint8_t { convex, concave };

/// Edges of `surface` with an angle of more than `angle` between their facets' normals at `x` that
/// bend this way. Open borders and analytic shapes have none.
[[nodiscard]] std::vector<SharpEdge> sharp_edges(const FacetSurface& surface,
                                                 std::span<const Vec3> x, double angle,
                                                 Bend bend = Bend::convex);

/// Finds the sharp edges of both sides. `areas`: of the slave's nodes.
void prepare_edges(EdgeContact& edges, const FacetSurface& master, const SlaveSide<3>& slave,
                   const std::vector<double>& areas, std::span<const Vec3> reference);

/// Crossings in configuration `x`, open and closed, of the slave's edges that are not `held`. Edges
/// that are neighbours on both sides and cross at their common place count once.
///
/// Tested by  tests/unit/pairing/test_edges.cpp
void find_crossings(const EdgeContact& edges, const FacetSurface& master, const FacetSurface& slave,
                    std::span<const Vec3> x, const std::vector<bool>& held, EdgeBuffers& out);

/// The difference of both edges as a facet: r(xi, eta) = rho(xi) - s(eta).
///
/// The nearest places of two edges are the foot of the origin on the surface of their differences,
/// so contact of edges is contact of a point with a face, gap, normal, slip and all derivatives: no
/// other formula is needed, and none is approximate.
[[nodiscard]] SurfaceFacet edge_contact_facet(const SharpEdge& master, const SharpEdge& slave,
                                              bool flipped);

/// Kinematics of an edge-edge contact that is facet number `facet` of a surface of differences.
[[nodiscard]] ProjectedPoint<3> project_edge_edge(const SurfaceFacet& difference, Index facet,
                                                  const Vec2& xi, std::span<const Vec3> x);

/// Place of the master's (`of_slave`: the slave's) edge at an edge-edge contact.
[[nodiscard]] Vec3 edge_position(const SharpEdge& edge, double xi, std::span<const Vec3> x);

/// The edge-edge contact a history belongs to, if `found` goes on from it: the same edges, or
/// neighbours on both sides that do not go on by themselves. -1 if there is none.
[[nodiscard]] int history_of_crossing(const EdgeContact& edges,
                                      std::span<const contact::PointHistory<3>> histories,
                                      const std::vector<EdgeEdgePoint>& all,
                                      const EdgeEdgePoint& found);

}  // namespace osculate::pairing
