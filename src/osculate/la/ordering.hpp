#pragma once
#include <vector>

#include "osculate/la/sparse_matrix.hpp"

namespace osculate::la {

/// Fill-reducing order by nested dissection of the graph of K + K^T.
///
/// Of the matrix of several processes the first one finds it; the others get none.
///
/// Shapes     one-based position of every unknown in the order of elimination; empty when the graph
///            has no edges or the partitioner fails (then any other order will do)
/// Tested by  tests/unit/la/test_ordering.cpp
[[nodiscard]] std::vector<int> nested_dissection(const SparseMatrix& k);

}  // namespace osculate::la
