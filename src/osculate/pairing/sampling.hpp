#pragma once
#include "osculate/pairing/slave_side.hpp"

namespace osculate::pairing {

/// Where on the slave contact is looked for.
///   nodes     its nodes
///   gauss     Gauss points inside the facets
///   lobatto   Gauss-Lobatto points: the facets' borders included
struct Sampling {
  enum class Rule : std::uint8_t { nodes, gauss, lobatto };
  Rule rule = Rule::nodes;
  int points = 2;      ///< per direction of a facet (gauss 1 to 20, lobatto 2 to 20)
  int subdomains = 1;  ///< equal parts per direction of a facet, each with its own points
  bool cut = false;    ///< facets that edges of the master cross: each part has its own points
};

/// What cuts facets (FacetCutter): a master, and where all nodes are then.
template <int Dim>
struct CutBy {
  const Boundary<Dim>* master = nullptr;
  std::span<const Vec<Dim>> x{};
};

/// Sets the contact points of a slave: points with the weights of the rule on every facet, so that
/// sum f(xi) w |x_,1 x x_,2| is the integral over the slave (segment-to-segment contact).
///
/// Formula    lines: the rule on -1..1; quadrilaterals: its tensor product; triangles: gauss: a
///            symmetric rule of degree 2 n - 1 up to n = 3, from there the collapsed square;
///            lobatto: corners with 1/3 each (2 points), corners 1/20, middles of the sides 2/15
///            and the centre 9/20 (3 points) of the area. Places that two parts of a facet share
///            are one point with both weights. Parts of a facet that is cut: the rule of a facet of
///            their shape; the weights of all are those of the facet together
/// Source     KS2D section 6 (Lobatto points and sub-domains)
/// Throws     core::GeometryError for a rule that does not exist (lobatto on triangles beyond 3
///            points), and for nodes without facets
/// Tested by  tests/unit/pairing/test_sampling.cpp
template <int Dim>
void sample(SlaveSide<Dim>& side, const Sampling& sampling, const CutBy<Dim>& by = {});

template <int Dim>
[[nodiscard]] bool sampled_at_nodes(const SlaveSide<Dim>& side) {
  return side.points.empty() || side.points.front().is_node();
}

/// Area that each contact point stands for: the tributary areas of nodes, else weight times area
/// element. `gradients` (if given) receives the derivatives.
template <int Dim>
void point_areas(const SlaveSide<Dim>& side, std::type_identity_t<std::span<const Vec<Dim>>> x,
                 const AreaRule& rule, std::vector<double>& areas,
                 std::type_identity_t<std::vector<std::vector<NodeGradient<Dim>>>*> gradients);

/// Outward normal of the slave at each contact point.
template <int Dim>
void point_normals(const SlaveSide<Dim>& side, std::type_identity_t<std::span<const Vec<Dim>>> x,
                   std::vector<Vec<Dim>>& normals);

}  // namespace osculate::pairing
