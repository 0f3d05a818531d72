#pragma once
#include "osculate/cell/cell_type.hpp"

namespace osculate::cell {

inline constexpr int max_area_nodes = 9;

/// Shape functions of an area cell and their first derivatives at one point (the first `count`
/// entries are used). Node order as in `CellType`.
struct AreaShape {
  int count = 0;
  Vec<max_area_nodes> n = Vec<max_area_nodes>::Zero();
  Mat<max_area_nodes, 2> d = Mat<max_area_nodes, 2>::Zero();  ///< dN/dxi, dN/deta
};

[[nodiscard]] AreaShape area_shape(CellType type, const Vec2& xi);

/// Reference coordinates of the nodes.
[[nodiscard]] Vec2 area_node(CellType type, int node);

}  // namespace osculate::cell
