#pragma once
#include <span>

#include "osculate/mesh/mesh.hpp"

namespace osculate::mesh {

/// Cells below are called poor.
inline constexpr double poor_shape = 0.2;

/// How regular some cells are.
///
/// Formula    shape of a cell: the smallest, over its corners, of the determinant of the unit
///            vectors along the edges there, over that of the regular cell (scaled Jacobian)
/// Units      shape 1: regular (rectangular); 0: flat; negative: inside out. Straight edges between
///            the corners are looked at, middle nodes are not.
/// Tested by  tests/unit/mesh/test_quality.cpp
struct Quality {
  double worst_shape = 1;
  CellRef worst{-1, -1};
  std::size_t poor = 0;      ///< cells with a shape below poor_shape
  double largest_ratio = 1;  ///< of the longest to the shortest edge of a cell
  CellRef longest{-1, -1};
};

/// Requires   area or volume cells
[[nodiscard]] Quality quality(const Mesh& mesh, std::span<const CellRef> cells);

}  // namespace osculate::mesh
