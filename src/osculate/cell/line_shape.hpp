#pragma once
#include <array>

#include "osculate/core/types.hpp"

namespace osculate::cell {

/// Most nodes of a curve facet: Lagrange lines up to order 7, NURBS spans up to degree 7.
inline constexpr int max_line_nodes = 8;

/// Shape functions of a curve and their derivatives with respect to xi at one point.
/// `n[d][k]` = d-th derivative of N_k, d = 0..3; only the first `count` entries are used.
struct LineShape {
  int count = 0;
  std::array<std::array<double, max_line_nodes>, 4> n{};
};

/// Lagrange polynomials on `nodes` (2..8) equidistant points of -1..1, in Gmsh order: both ends
/// first, then the interior nodes from left to right. For two nodes this is eq. (64) of KS2D.
[[nodiscard]] LineShape lagrange_line(int nodes, double xi);

}  // namespace osculate::cell
