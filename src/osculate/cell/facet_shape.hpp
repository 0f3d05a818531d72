#pragma once
#include <array>

#include "osculate/cell/cell_type.hpp"

namespace osculate::cell {

inline constexpr int max_facet_nodes = 9;
/// Room in FacetShape: smooth patches depend on nodes of the facets around theirs too.
inline constexpr int max_shape_nodes = 16;

/// Shape functions of a surface facet and all derivatives up to the third at one point (the first
/// `count` entries are used). Index of a derivative: 0 value; 1, 2 first (1; 2); 3, 4, 5 second
/// (11; 12; 22); 6, 7, 8, 9 third (111; 112; 122; 222).
///
/// Tested by  tests/unit/cell/test_facet_shape.cpp
struct FacetShape {
  int count = 0;
  std::array<std::array<double, max_shape_nodes>, 10> n{};
};

/// Place of d2/dxi_i dxi_j and d3/dxi_i dxi_j dxi_k (i, j, k = 0 or 1) in `FacetShape::n`.
[[nodiscard]] constexpr std::size_t second_index(std::size_t i, std::size_t j) { return 3 + i + j; }
[[nodiscard]] constexpr std::size_t third_index(std::size_t i, std::size_t j, std::size_t k) {
  return 6 + i + j + k;
}

/// `order`: highest derivative that is filled in, 0 to 3.
///
/// Requires   type is tri3, tri6, quad4, quad8 or quad9
[[nodiscard]] FacetShape facet_shape(CellType type, const Vec2& xi, int order = 3);

/// Derivatives of higher order are zero.
[[nodiscard]] constexpr int highest_derivative(CellType type) {
  if (type == CellType::tri3) return 1;
  return type == CellType::tri6 || type == CellType::quad4 ? 2 : 3;
}

/// True for the five types that `facet_shape` knows.
[[nodiscard]] constexpr bool is_facet(CellType type) {
  return type == CellType::tri3 || type == CellType::tri6 || type == CellType::quad4 ||
         type == CellType::quad8 || type == CellType::quad9;
}
/// tri3, tri6: xi, eta >= 0 and xi + eta <= 1; the others -1..1.
[[nodiscard]] constexpr bool is_triangle(CellType type) {
  return type == CellType::tri3 || type == CellType::tri6;
}

}  // namespace osculate::cell
