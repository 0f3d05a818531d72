#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "osculate/pairing/candidate_tree.hpp"
#include "osculate/pairing/slave_side.hpp"

namespace osculate::pairing {

/// Facets that nodes of a slave do not touch, since another contact has both, or nothing is to.
struct HiddenFacets {
  std::vector<std::vector<bool>> kinds;  ///< by facet of the master
  std::vector<int> of_node;              ///< kind of each slave node; -1: none. Empty: of all

  [[nodiscard]] bool has(std::size_t node, Index facet) const {
    return node < of_node.size() && of_node[node] >= 0 &&
           kinds[static_cast<std::size_t>(of_node[node])][static_cast<std::size_t>(facet)];
  }
};

/// Which places of a master a slave node may touch where the whole surface of a body, or the node's
/// own surface, is the master. Without limits (the default) the nearest facet that does not face
/// the same way as the node is taken, however far away or deep.
///
/// Rules      a place is a candidate if it passes all of them
///            near      it is not farther away than `reach`
///            thin      where the node lies behind it (g < 0), |g| <= t / 2: t is how far the
///                      node's own body reaches behind the node in the reference configuration.
///                      Through more than its own body no node touches anything: what is seen
///                      there is the far side of the master; nor does it touch anything deeper
///                      than a quarter of the reach that it never faced, and no edge or vertex
///                      deeper than 3 % of it. A place near the one that
///                      the node faced at the end of the last increment is let off (a thin body
///                      that moves fast)
///            facing    own surface: a facet of the node and the place have normals more than 120
///                      degrees apart. Where the curvature of the surface is at most k, that takes
///                      a way of more than 2 / k along it, so no facet of a smooth neighbourhood
///                      is one, and no facet that the node itself belongs to ever is
///            across    own surface: the way to the place is within 60 degrees of its normal. (A
///                      node of a sharp corner sees the next facets of its own flanks end on.)
///            apart     own surface: if the node was not in front of the place in the reference
///                      configuration (there is material between them, or they lay in one plane),
///                      their distance was at least 4 |g|. The other side of a plate that is
///                      squeezed to more than a quarter, the other flank of a convex corner that
///                      is bent to more than 30 degrees, and the other end of a side that bulges
///                      until both its ends lie on plates, fail; the flanks of a notch, which faced
///                      each other, pass at any depth, and the lips of a fold while they are not
///                      deeper than a quarter of the way between them
///            hidden    the nearest place that passes is on no facet of `hidden`; a node there
///            touches nothing, also not what is beside it
/// Areas      of the node's facets only those within 60 degrees of facing the place count (all, if
///            none is): the node at the edge of a block that lies flat carries the pressure on its
///            lower face, not on the side
/// Tested by  tests/unit/pairing/test_own_surface.cpp
template <int Dim>
struct CandidateFilter {
  bool own = false;  ///< the master is the slave's own surface, facet by facet
  double distance = std::numeric_limits<double>::infinity();
  HiddenFacets hidden{};
  // Filled by `prepare`:
  std::vector<double> thickness;    ///< per slave node, infinite where more than twice `reach`
  std::vector<Vec<Dim>> reference;  ///< own surface: positions of all nodes
  std::vector<std::size_t> first;   ///< of each node's facets in `parts`, and the end
  SlaveSide<Dim> parts;             ///< every node once for each facet that holds it
  std::vector<double> areas;        ///< of the parts, reference configuration

  [[nodiscard]] bool limited() const { return own || std::isfinite(distance); }
};

/// Fills the rest. Throws core::GeometryError where `own` is set and master
/// and slave are not the same facets. A thickness that is there already is kept.
template <int Dim>
void prepare(CandidateFilter<Dim>& filter, const Boundary<Dim>& master, const SlaveSide<Dim>& slave,
             std::type_identity_t<std::span<const Vec<Dim>>> reference, const AreaRule& rule = {});

/// What the nodes of one evaluation share.
template <int Dim>
struct FilterBuffers {
  std::vector<FacetOutline<Dim>> outlines;   ///< of the master
  std::vector<BranchOutline<Dim>> branches;  ///< of the tree over it
  std::vector<Vec<Dim>> normals;             ///< of the parts
  std::vector<double> areas;                 ///< of the parts, if they were asked for
  std::vector<std::vector<NodeGradient<Dim>>> area_gradients;
};
/// Outlines, normals and tree at `x`; `boxes` are those of the master's facets there. Outlines and
/// tree stay as they are if the master has not `moved`.
template <int Dim>
void refresh(const CandidateFilter<Dim>& filter, const Boundary<Dim>& master,
             std::type_identity_t<std::span<const Vec<Dim>>> x,
             const std::vector<search::Box<Dim>>& boxes, bool moved, FilterBuffers<Dim>& buffers,
             Tree<Dim>& tree);

/// Unit normals of the slave nodes out of those of their parts, as `nodal_normals`.
template <int Dim>
void mean_normals(const CandidateFilter<Dim>& filter, const FilterBuffers<Dim>& buffers,
                  std::vector<Vec<Dim>>& normals);

/// Parts of slave node `i` that carry the pressure of a contact with this normal of the master:
/// calls `visit` with the number of each.
template <int Dim, class Visit>
void for_each_facing(const CandidateFilter<Dim>& filter, const FilterBuffers<Dim>& buffers,
                     std::size_t i, const Vec<Dim>& normal, const Visit& visit) {
  constexpr double cosine = -0.5;
  bool any = false;
  for (std::size_t p = filter.first[i]; p < filter.first[i + 1]; ++p)
    any = any || buffers.normals[p].dot(normal) < cosine;
  for (std::size_t p = filter.first[i]; p < filter.first[i + 1]; ++p)
    if (!any || buffers.normals[p].dot(normal) < cosine) visit(p);
}

/// The rules for one node at one place in space.
template <int Dim>
struct NodeFilter {
  Vec<Dim> point = Vec<Dim>::Zero();
  double distance = std::numeric_limits<double>::infinity();
  double depth = std::numeric_limits<double>::infinity();  ///< t / 2, or a quarter of the reach
  double edge_depth = std::numeric_limits<double>::infinity();  ///< 3 % of the reach
  std::optional<Vec<Dim>> last;  ///< where the place of the last increment is now
  std::span<const FacetOutline<Dim>> outlines;
  std::span<const BranchOutline<Dim>> branches;
  std::span<const Vec<Dim>> facing;     ///< normals of the node's facets; empty: another surface
  std::span<const Index> facets;        ///< those facets
  std::span<const Vec<Dim>> reference;  ///< empty: no memory of where the node was
  Vec<Dim> home = Vec<Dim>::Zero();     ///< the node there
  bool behind = false;                  ///< only places that the node is behind (for the thickness)

  /// How far behind a facet the node may be.
  [[nodiscard]] double deepest() const {
    return last ? std::max(depth, (point - *last).norm()) : depth;
  }
  /// Facets that need no projection. Never one that `admits` any of its places, but for feet far
  /// outside a strongly curved facet. `slave_normal` is that of the query (projection.hpp).
  [[nodiscard]] bool skips(Index facet, const std::optional<Vec<Dim>>& slave_normal) const;
  /// Branches of the tree with nothing but such facets.
  [[nodiscard]] bool misses(Index branch, const std::optional<Vec<Dim>>& slave_normal) const;

 private:
  /// Whether the node is behind all places, and beside them: only edges and vertices are there, too
  /// far away.
  [[nodiscard]] bool beside_and_behind(double lowest, double highest, double nearest) const;
  /// Whether no place is straight in front of the node, nor near enough for any other: their gaps
  /// are at most `highest`, their distances from the node and from `last` at least `nearest` and
  /// `from_last`.
  [[nodiscard]] bool too_slanted(double highest, double nearest, double from_last) const;
};

/// Whether the node may touch the facet at `xi`.
[[nodiscard]] bool admits(const NodeFilter<2>& rules, const Facet& facet, double xi,
                          std::span<const Vec2> x);
[[nodiscard]] bool admits(const NodeFilter<3>& rules, const SurfaceFacet& facet, const Vec2& xi,
                          std::span<const Vec3> x);

/// The rules for slave node `i`, without `last`.
template <int Dim>
[[nodiscard]] NodeFilter<Dim> node_filter(const CandidateFilter<Dim>& filter,
                                          const SlaveSide<Dim>& slave,
                                          const FilterBuffers<Dim>& buffers, std::size_t i,
                                          const Vec<Dim>& point);

}  // namespace osculate::pairing
