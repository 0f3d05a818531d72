#pragma once
#include <array>

#include "osculate/cell/facet_shape.hpp"

namespace osculate::cell {

/// Place on a facet with its first and second derivatives: r, r_1, r_2, r_11, r_12, r_22.
using FacetDerivatives = std::array<Vec3, 6>;

/// Those of the linear triangle and of the bilinear quadrilateral, without shape functions: most
/// meshes have no others, and contact asks for them more often than for anything else. `node(k)` is
/// the position of local node k.
///
/// Formula    tri3   r = x0 + xi (x1 - x0) + eta (x2 - x0)
///            quad4  r = x0 + u (x1 - x0) + v (x3 - x0) + u v (x0 - x1 + x2 - x3),
///                   u = (1 + xi) / 2, v = (1 + eta) / 2
/// Requires   type is tri3 or quad4
/// Tested by  tests/unit/cell/test_facet_shape.cpp
template <class NodeAt>
[[nodiscard]] FacetDerivatives linear_facet(CellType type, const NodeAt& node, const Vec2& xi) {
  const Vec3 zero = Vec3::Zero();
  const Vec3 first = node(1) - node(0);
  if (type == CellType::tri3) {
    const Vec3 second = node(2) - node(0);
    return {node(0) + xi[0] * first + xi[1] * second, first, second, zero, zero, zero};
  }
  const Vec3 second = node(3) - node(0), twist = node(2) - node(3) - first;
  const double u = 0.5 * (1 + xi[0]), v = 0.5 * (1 + xi[1]);
  return {node(0) + u * (first + v * twist) + v * second,
          0.5 * (first + v * twist),
          0.5 * (second + u * twist),
          zero,
          0.25 * twist,
          zero};
}

/// Shape functions of quad4 up to the second derivatives, put where they are kept: all of
/// FacetShape is many times as much to copy.
inline void set_bilinear(const Vec2& xi, FacetShape& s) {
  constexpr std::array<double, 4> first{-1, 1, 1, -1}, second{-1, -1, 1, 1};
  s.count = 4;
  for (std::size_t k = 0; k < 4; ++k) {
    const double a = 0.5 * (1 + first[k] * xi.x()), b = 0.5 * (1 + second[k] * xi.y());
    s.n[0][k] = a * b;
    s.n[1][k] = 0.5 * first[k] * b;
    s.n[2][k] = 0.5 * second[k] * a;
    s.n[3][k] = s.n[5][k] = 0;
    s.n[4][k] = 0.25 * first[k] * second[k];
  }
}

/// The types that `linear_facet` knows.
[[nodiscard]] constexpr bool is_linear_facet(CellType type) {
  return type == CellType::tri3 || type == CellType::quad4;
}

}  // namespace osculate::cell
