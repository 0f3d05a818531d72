#pragma once
#include "osculate/cell/cell_type.hpp"

namespace osculate::cell {

inline constexpr int max_volume_nodes = 27;

/// Shape functions of a volume cell and their first derivatives at one point (the first `count`
/// entries are used). Node order as in `CellType`.
///
/// Tested by  tests/unit/cell/test_volume_shape.cpp
struct VolumeShape {
  int count = 0;
  Vec<max_volume_nodes> n = Vec<max_volume_nodes>::Zero();
  Mat<max_volume_nodes, 3> d = Mat<max_volume_nodes, 3>::Zero();  ///< dN/dxi, dN/deta, dN/dzeta
};

/// Empty (count 0) for cells that are not volumes.
[[nodiscard]] VolumeShape volume_shape(CellType type, const Vec3& xi);

/// Reference coordinates of the nodes of a volume cell.
[[nodiscard]] Vec3 volume_node(CellType type, int node);

}  // namespace osculate::cell
