#pragma once
#include <algorithm>
#include <numbers>
#include <span>
#include <type_traits>
#include <vector>

#include "osculate/pairing/chain.hpp"
#include "osculate/pairing/surface.hpp"

namespace osculate::pairing {

/// The boundary a pair works on: a chain of curves in the plane, a surface of facets in space.
template <int Dim>
struct BoundaryOf;
template <>
struct BoundaryOf<2> {
  using Type = Chain;
};
template <>
struct BoundaryOf<3> {
  using Type = FacetSurface;
};
template <int Dim>
using Boundary = typename BoundaryOf<Dim>::Type;

/// How a length of slave curve becomes an area: times the thickness, or times 2 pi x. (3D: an area
/// is an area.)
struct AreaRule {
  double thickness = 1;
  bool axisymmetric = false;    ///< x is the radius, y the axis
  std::vector<double> given{};  ///< by point, whatever the facets are; empty: theirs
};

template <int Dim>
inline constexpr int max_slave_nodes = Dim == 2 ? cell::max_line_nodes : cell::max_facet_nodes;

/// A contact point of the slave: a fixed place on one of its facets, r_s = sum_k N_k x_k, so that
/// d(r_s) = sum_k N_k d(u_k). A node is the case of one node with N = 1.
template <int Dim>
struct SlavePoint {
  int count = 1;
  std::array<Index, max_slave_nodes<Dim>> nodes{};
  std::array<double, max_slave_nodes<Dim>> shape{1.0};  ///< N_k
  Index facet = -1;                                     ///< of the slave's boundary; -1: a node
  Vec<Dim - 1> xi = Vec<Dim - 1>::Zero();               ///< on that facet
  double weight = 0;    ///< of the quadrature, in the facet's reference cell
  bool inside = false;  ///< its facet: a Gauss point

  [[nodiscard]] bool is_node() const { return facet < 0; }
  /// The node with the largest share.
  [[nodiscard]] Index nearest_node() const {
    const auto* const end = shape.begin() + count;
    return nodes[static_cast<std::size_t>(std::max_element(shape.begin(), end) - shape.begin())];
  }
};

template <int Dim>
[[nodiscard]] bool on_same_nodes(const SlavePoint<Dim>& a, const SlavePoint<Dim>& b) {
  return a.count == b.count &&
         std::equal(a.nodes.begin(), a.nodes.begin() + a.count, b.nodes.begin());
}

/// The slave with its contact points: its nodes, unless sampled otherwise (sampling.hpp).
template <int Dim>
struct SlaveSide {
  std::vector<Index> nodes;                   ///< along the boundary, then those without facets
  Boundary<Dim> boundary;                     ///< slave facets; may be empty (point sets)
  std::vector<std::vector<Index>> facets_of;  ///< per entry of `nodes`, the facets that hold it
  std::vector<SlavePoint<Dim>> points;        ///< by default one per entry of `nodes`, in order
};

/// Position of a contact point.
template <int Dim>
[[nodiscard]] Vec<Dim> position(const SlavePoint<Dim>& point,
                                std::type_identity_t<std::span<const Vec<Dim>>> x) {
  Vec<Dim> r = point.shape[0] * x[static_cast<std::size_t>(point.nodes[0])];
  for (std::size_t k = 1; k < static_cast<std::size_t>(point.count); ++k)
    r += point.shape[k] * x[static_cast<std::size_t>(point.nodes[k])];
  return r;
}

/// One contact point per entry of `nodes`.
template <int Dim>
void sample_nodes(SlaveSide<Dim>& side) {
  side.points.assign(side.nodes.size(), {});
  for (std::size_t i = 0; i < side.nodes.size(); ++i) side.points[i].nodes[0] = side.nodes[i];
}

[[nodiscard]] SlaveSide<2> make_slave_side(Chain chain, std::span<const Index> extra_nodes = {});
[[nodiscard]] SlaveSide<3> make_slave_side(FacetSurface surface,
                                           std::span<const Index> extra_nodes = {});

/// Tributary area of every slave node in configuration `x`.
///
/// Formula    2D: A_k = int N_k |dx/dxi| f dxi, f = thickness or 2 pi x_1
///            3D: A_k = int N_k |x_1 x x_2| for tri3, quad4 and quad9. The consistent areas of
///            tri6 and quad8 have zero or negative corners; theirs are c_k times the facet's area
///            with c_k = int N_k^2 / sum_l int N_l^2 over the reference cell: positive, the total
///            is right, but a uniform pressure is not transmitted exactly.
/// Returns    one value per entry of `nodes`; `gradients` (if given) receives dA_k/dx_l
/// Tested by  tests/unit/pairing/test_slave_side.cpp
void nodal_areas(const SlaveSide<2>& slave, std::span<const Vec2> x, const AreaRule& rule,
                 std::vector<double>& areas, std::vector<std::vector<NodeGradient<2>>>* gradients);
void nodal_areas(const SlaveSide<3>& slave, std::span<const Vec3> x, const AreaRule& rule,
                 std::vector<double>& areas, std::vector<std::vector<NodeGradient<3>>>* gradients);

/// Averaged outward normal of every slave node (zero where the node has no facet).
void nodal_normals(const SlaveSide<2>& slave, std::span<const Vec2> x, std::vector<Vec2>& normals);
void nodal_normals(const SlaveSide<3>& slave, std::span<const Vec3> x, std::vector<Vec3>& normals);

}  // namespace osculate::pairing
