#pragma once
#include <numbers>
#include <span>
#include <vector>

#include "osculate/pairing/chain.hpp"

namespace osculate::pairing {

/// How a length of slave curve becomes an area: times the thickness, or times 2 pi x.
struct AreaRule {
  double thickness = 1;
  bool axisymmetric = false;  ///< x is the radius, y the axis
};

/// Where contact is sampled: nodes, with the facets they belong to (for areas and normals).
struct SlaveSide {
  std::vector<Index> nodes;                   ///< along the chain, then the nodes without facets
  Chain chain;                                ///< slave facets; may be empty (point sets)
  std::vector<std::vector<Index>> facets_of;  ///< per entry of `nodes`, the facets that hold it
};

[[nodiscard]] SlaveSide make_slave_side(Chain chain, std::span<const Index> extra_nodes = {});

/// Tributary area of every slave node in configuration `x`.
///
/// Formula    A_k = int N_k |dx/dxi| f dxi ,  f = thickness or 2 pi x_1
/// Returns    one value per entry of `nodes`; `gradients` (if given) receives dA_k/dx_l
/// Tested by  tests/unit/pairing/test_slave_side.cpp
void nodal_areas(const SlaveSide& slave, std::span<const Vec2> x, const AreaRule& rule,
                 std::vector<double>& areas, std::vector<std::vector<NodeGradient>>* gradients);

/// Averaged outward normal of every slave node (zero where the node has no facet).
void nodal_normals(const SlaveSide& slave, std::span<const Vec2> x, std::vector<Vec2>& normals);

}  // namespace osculate::pairing
