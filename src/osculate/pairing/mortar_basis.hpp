#pragma once
#include <Eigen/Core>
#include <span>
#include <type_traits>

#include "osculate/pairing/slave_side.hpp"

namespace osculate::pairing {

/// How much of its edges' functions a corner of tri6 and quad8 takes over.
inline constexpr double edge_share = 0.2;

/// Functions that a slave facet's multipliers are dual to, as rows over its shape functions.
///
/// Formula    tri6, quad8: corners N_c + a sum N_e over both edges, edges (1 - 2 a) N_e, a = 1/5;
///            they sum up to 1 and their integrals are positive (those of N_c are not). All others:
///            the shape functions themselves (empty)
/// Tested by  tests/unit/pairing/test_mortar_basis.cpp
[[nodiscard]] const Eigen::MatrixXd& basis_change(const Facet& facet);
[[nodiscard]] const Eigen::MatrixXd& basis_change(const SurfaceFacet& facet);

/// The point that belongs to one of these functions: sum_k weights_k x of nodes_k.
///
/// Formula    corners x_c; edges (x_e - a (x_c1 + x_c2)) / (1 - 2 a): sum_j (new N_j) (new x_j) is
///            the facet again, and on a straight edge with x_e in its middle (new x_e) = x_e
struct SlaveCombination {
  std::vector<Index> nodes;
  std::vector<double> weights;
};

/// One per entry of `slave.nodes`.
[[nodiscard]] std::vector<SlaveCombination> slave_combinations(const SlaveSide<2>& slave);
[[nodiscard]] std::vector<SlaveCombination> slave_combinations(const SlaveSide<3>& slave);

template <int Dim>
[[nodiscard]] Vec<Dim> position_of(const SlaveCombination& point,
                                   std::type_identity_t<std::span<const Vec<Dim>>> x) {
  Vec<Dim> sum = Vec<Dim>::Zero();
  for (std::size_t k = 0; k < point.nodes.size(); ++k)
    sum += point.weights[k] * x[static_cast<std::size_t>(point.nodes[k])];
  return sum;
}

}  // namespace osculate::pairing
