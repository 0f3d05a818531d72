#pragma once
#include <span>

#include "osculate/types.hpp"

namespace osculate {

/// A matrix of a host's in compressed rows, and where entries have their place in it: entry (r, c)
/// goes to row row_of[r] and column column_of[c]. A number below `base` says that they are not here
/// (held, or of another process), and the entry is passed over.
///
/// Requires   columns that ascend in every row
template <class Number>
struct CsrMatrix {
  std::span<const Number> row_start, columns;
  std::span<double> values;
  std::span<const Number> row_of, column_of;
  Number base = 0;  ///< what the host's numbers begin with: 0 or 1, in all four lists
};

/// Adds entries (Result::tangent, Constraints) to the values of a matrix, those of one place in
/// their order.
///
/// Errors     Refused for an entry whose place the matrix does not have, before anything is added
/// Tested by  tests/unit/embed/test_csr.cpp
template <class Number>
void add_entries(std::span<const Entry> entries, const CsrMatrix<Number>& matrix);

extern template void add_entries(std::span<const Entry>, const CsrMatrix<std::int32_t>&);
extern template void add_entries(std::span<const Entry>, const CsrMatrix<std::int64_t>&);

}  // namespace osculate
