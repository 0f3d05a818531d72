#pragma once
#include <vector>

#include "osculate/core/types.hpp"

namespace osculate::mesh {

/// Deals out nodes to parts of about as many of them, with few cells between parts (METIS).
///
/// Input      cells: the nodes of each
/// Returns    one for each node, below `parts`; nodes without cells in turn
/// Contract   depends on the input alone
/// Errors     throws std::bad_alloc
/// Tested by  tests/unit/mesh/test_partition.cpp
[[nodiscard]] std::vector<int> node_parts(const std::vector<std::vector<Index>>& cells, Index nodes,
                                          int parts);

}  // namespace osculate::mesh
