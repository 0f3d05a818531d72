#pragma once
#include "osculate/cell/linear_facet.hpp"

namespace osculate::cell {

/// A quadratic facet (tri6, quad8, quad9) as a polynomial: places that many are asked for cost a
/// fraction of what its shape functions do.
///
/// Formula    r = sum over i, j < 3 of c_ij xi^i eta^j
/// Tested by  tests/unit/cell/test_facet_shape.cpp
struct QuadraticFacet {
  std::array<std::array<Vec3, 3>, 3> c;

  /// Place and derivatives at `xi`.
  [[nodiscard]] FacetDerivatives at(const Vec2& xi) const {
    const double u = xi[0], v = xi[1];
    std::array<Vec3, 3> a, a1;
    for (std::size_t i = 0; i < 3; ++i) {
      a[i] = c[i][0] + v * (c[i][1] + v * c[i][2]);
      a1[i] = c[i][1] + (2 * v) * c[i][2];
    }
    return {a[0] + u * (a[1] + u * a[2]),    a[1] + (2 * u) * a[2],
            a1[0] + u * (a1[1] + u * a1[2]), 2 * a[2],
            a1[1] + (2 * u) * a1[2],         2 * (c[0][2] + u * (c[1][2] + u * c[2][2]))};
  }
};

/// The ninth node of a quad9, or the place of a quad8 there.
///
/// Formula    quad8: half the sum of the edges' middle nodes less a quarter of that of the corners
/// Tested by  tests/unit/cell/test_facet_shape.cpp
template <class NodeAt>
[[nodiscard]] Vec3 middle_node(CellType type, const NodeAt& node) {
  if (type == CellType::quad9) return node(8);
  return 0.5 * (node(4) + node(5) + node(6) + node(7)) -
         0.25 * (node(0) + node(1) + node(2) + node(3));
}

/// `node(k)` is the position of local node k; `type` tri6, quad8 or quad9.
template <class NodeAt>
[[nodiscard]] QuadraticFacet quadratic_facet(CellType type, const NodeAt& node) {
  QuadraticFacet f;
  if (type == CellType::tri6) {
    f.c[0][0] = node(0);
    f.c[1][0] = 4 * node(3) - node(1) - 3 * node(0);
    f.c[0][1] = 4 * node(5) - node(2) - 3 * node(0);
    f.c[2][0] = 2 * (node(0) + node(1) - 2 * node(3));
    f.c[0][2] = 2 * (node(0) + node(2) - 2 * node(5));
    f.c[1][1] = 4 * (node(0) + node(4) - node(3) - node(5));
    f.c[1][2] = f.c[2][1] = f.c[2][2] = Vec3::Zero();
    return f;
  }
  // Along xi: 1, xi, xi^2 of the three rows eta = -1, 0, 1; then along eta.
  const auto along = [](const Vec3& lo, const Vec3& mid, const Vec3& hi) {
    return std::array<Vec3, 3>{mid, 0.5 * (hi - lo), 0.5 * (hi + lo) - mid};
  };
  const std::array<Vec3, 3> low = along(node(0), node(4), node(1)),
                            mid = along(node(7), middle_node(type, node), node(5)),
                            high = along(node(3), node(6), node(2));
  for (std::size_t i = 0; i < 3; ++i) f.c[i] = along(low[i], mid[i], high[i]);
  return f;
}

}  // namespace osculate::cell
