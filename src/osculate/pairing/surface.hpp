#pragma once
#include <array>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "osculate/cell/facet_shape.hpp"
#include "osculate/geometry/surface_catalogue.hpp"
#include "osculate/geometry/surface_jet.hpp"
#include "osculate/pairing/gregory.hpp"

namespace osculate::pairing {

/// One piece of a boundary surface: a Lagrange facet through its nodes, a smooth patch that depends
/// on nodes around them too (behind its own), or an analytic surface carried by a rigid frame.
///
/// The frame is four nodes (origin, tips of e1, e2, e3): a material point with frame coordinates X
/// has the weights (1 - X1 - X2 - X3, X1, X2, X3), so an analytic shape is a facet with four nodes
/// like any other and no contact formula knows the difference.
struct SurfaceFacet {
  cell::CellType type = cell::CellType::quad4;  ///< of a Lagrange facet
  int count = 0;
  std::array<Index, cell::max_shape_nodes> nodes{};
  std::shared_ptr<const geometry::Surface> shape;  ///< null for a Lagrange facet and a patch
  std::shared_ptr<const GregoryWeights> patch;     ///< of a smooth patch (pairing/smoothing.hpp)
  std::array<Index, 4> neighbour{-1, -1, -1, -1};  ///< across each edge, -1 = open border
  Index piece = 0;                                 ///< number of the connected piece
  /// Nodes of the two edges whose difference r = rho(xi) - s(eta) this is (pairing/edges.hpp), the
  /// second one run backwards if `flipped`; 0: an ordinary facet.
  std::array<int, 2> difference{0, 0};
  bool flipped = false;
};

/// A boundary made of facets; n = r_1 x r_2 points out of the body.
struct FacetSurface {
  std::vector<SurfaceFacet> facets;
  std::unordered_map<Index, std::vector<Index>> facets_at;  ///< corner node -> facets
};

/// Lagrange facet through `nodes` in the order of the cell type.
[[nodiscard]] SurfaceFacet surface_facet(cell::CellType type, std::span<const Index> nodes);
/// Facet of an analytic surface on the frame nodes (origin, three tips).
[[nodiscard]] SurfaceFacet shape_facet(geometry::Surface shape, const std::array<Index, 4>& frame);
/// Sets neighbours, pieces and `facets_at` from shared corner nodes.
void connect(FacetSurface& surface);

[[nodiscard]] int edge_count(const SurfaceFacet& facet);
/// Both corners of edge k (local numbers).
[[nodiscard]] std::array<int, 2> edge_corners(const SurfaceFacet& facet, int edge);

/// Control points of a patch in configuration `x`.
[[nodiscard]] GregoryPoints patch_points(const SurfaceFacet& facet, std::span<const Vec3> x);
/// `order`: highest derivative that is asked for; those above may be filled in, or 0.
[[nodiscard]] cell::FacetShape facet_shape(const SurfaceFacet& facet, const Vec2& xi,
                                           int order = 3);
[[nodiscard]] geometry::SurfaceJet facet_jet(const SurfaceFacet& facet,
                                             const cell::FacetShape& shape,
                                             std::span<const Vec3> x);
[[nodiscard]] inline geometry::SurfaceJet facet_jet(const SurfaceFacet& facet, const Vec2& xi,
                                                    std::span<const Vec3> x) {
  return facet_jet(facet, facet_shape(facet, xi), x);
}
/// Whether the shape functions are those of the facet's type.
[[nodiscard]] inline bool is_plain(const SurfaceFacet& facet) {
  return !facet.shape && !facet.patch && facet.difference[0] == 0;
}
/// The facet's control points: in `patches`, or made in `room`.
[[nodiscard]] const GregoryPoints& points_of(const FacetSurface& surface, const SurfaceFacet& facet,
                                             std::span<const Vec3> x, PatchPoints patches,
                                             GregoryPoints& room);
/// The same as `facet_jet` but for third derivatives, of a smooth patch.
[[nodiscard]] geometry::SurfaceJet patch_jet(cell::CellType type, const GregoryPoints& points,
                                             const Vec2& xi);
/// Its place at xi without derivatives, `facet_jet(...).r`.
[[nodiscard]] Vec3 facet_point(const SurfaceFacet& facet, const Vec2& xi, std::span<const Vec3> x);
/// Unit normal; zero where the facet has none.
[[nodiscard]] Vec3 facet_normal(const SurfaceFacet& facet, const Vec2& xi, std::span<const Vec3> x);
[[nodiscard]] Vec3 facet_normal(const FacetSurface& surface, const SurfaceFacet& facet,
                                const Vec2& xi, std::span<const Vec3> x, PatchPoints patches);

}  // namespace osculate::pairing
