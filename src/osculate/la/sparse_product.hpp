#pragma once
#include "osculate/la/grouped_rows.hpp"

namespace osculate::la {

/// A B of sparse matrices, group by group of the rows of A, whose entries in as many consecutive
/// columns are taken at once as rows of B have their columns in common: what a coarser model is
/// made of comes in blocks of the nodes.
///
/// Formula    C_ij = sum_k A_ik B_kj , in the order of k: the bits depend on no number of threads.
///            Sums that are zero have no entry
/// Errors     std::bad_alloc: more entries than an Index counts
/// Tested by  tests/unit/la/test_sparse_product.cpp
[[nodiscard]] CompressedRows product(const GroupedRows& a, const CompressedRows& b,
                                     core::Crew& crew);

}  // namespace osculate::la
