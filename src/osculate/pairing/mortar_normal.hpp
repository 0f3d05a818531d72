#pragma once
#include <vector>

#include "osculate/pairing/node_terms.hpp"
#include "osculate/pairing/slave_side.hpp"

namespace osculate::pairing {

/// Averaged normal of a slave node with its derivatives, and tangents that move with the node.
///
/// Formula    n = sum_f n_f / |sum_f n_f| over the facets of the node, n_f their unit normals there
///            `frame`, out of the master's side: 2D tau = turn(n) (the master's direction of
///            travel); 3D e_1 along the part of r_,1 of the node's first facet that is
///            perpendicular to n, e_2 = -n x e_1
/// Sign       n points out of the slave
/// Tested by  tests/unit/pairing/test_mortar.cpp, test_mortar3.cpp (the pair's tangent by order)
template <int Dim>
struct NodalNormal {
  Vec<Dim> value = Vec<Dim>::Zero();  ///< zero where the facets have no common outside
  Mat<Dim, Dim - 1> frame = Mat<Dim, Dim - 1>::Zero();
  std::vector<NodeMatrix<Dim>> gradient;                             ///< of the normal
  std::array<std::vector<NodeMatrix<Dim>>, Dim - 1> frame_gradient;  ///< of its columns
};

/// Of slave node `i` in configuration `x`; gradients only if asked.
void nodal_normal(const SlaveSide<2>& slave, std::size_t i, std::span<const Vec2> x, bool gradients,
                  NodalNormal<2>& out);
void nodal_normal(const SlaveSide<3>& slave, std::size_t i, std::span<const Vec3> x, bool gradients,
                  NodalNormal<3>& out);

}  // namespace osculate::pairing
