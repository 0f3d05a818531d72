#pragma once
#include <vector>

#include "osculate/core/types.hpp"

namespace osculate::mesh {

/// Deals out nodes to parts of about as many of them, with few cells and joints between parts; and
/// about as many joints in each, where they have twenty nodes a part or more (METIS, two weights a
/// node).
///
/// Input      cells: the nodes of each
///            joints: nodes that work of another kind has together (points of contact); those
///            without a cell do not matter
/// Returns    one for each node, below `parts`; nodes without cells in turn
/// Contract   depends on the input alone
/// Errors     throws std::bad_alloc
/// Tested by  tests/unit/mesh/test_partition.cpp
[[nodiscard]] std::vector<int> node_parts(const std::vector<std::vector<Index>>& cells,
                                          const std::vector<std::vector<Index>>& joints,
                                          Index nodes, int parts);

}  // namespace osculate::mesh
