#include "osculate/csr.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "osculate/errors.hpp"

namespace osculate {
namespace {

constexpr std::size_t nowhere = static_cast<std::size_t>(-1);

/// The host's number of a row or column, from 0; negative: not here.
template <class Number>
Number place_of(Index entry, std::span<const Number> of, Number base, const char* what) {
  if (entry < 0 || static_cast<std::size_t>(entry) >= of.size())
    throw Refused(fmt::format("the list of {}s has {} numbers, and an entry has {} {}", what,
                              of.size(), what, entry));
  const Number number = of[static_cast<std::size_t>(entry)];
  return number < base ? Number{-1} : number - base;
}

/// Where the value of an entry is stored.
template <class Number>
std::size_t stored_at(const Entry& e, const CsrMatrix<Number>& m) {
  const Number row = place_of(e.row, m.row_of, m.base, "row");
  const Number column = place_of(e.column, m.column_of, m.base, "column");
  if (row < 0 || column < 0) return nowhere;
  if (static_cast<std::size_t>(row) + 1 >= m.row_start.size())
    throw Refused(fmt::format("the matrix has no row {}", row + m.base));
  const auto start = [&](Number r) {
    return m.columns.begin() + (m.row_start[static_cast<std::size_t>(r)] - m.base);
  };
  const auto end = start(row + 1), at = std::lower_bound(start(row), end, column + m.base);
  if (at == end || *at != column + m.base)
    throw Refused(
        fmt::format("row {} of the matrix has no column {}", row + m.base, column + m.base));
  return static_cast<std::size_t>(at - m.columns.begin());
}

template <class Number>
void check_shape(const CsrMatrix<Number>& m) {
  if (m.row_start.empty() || m.row_start.front() != m.base)
    throw Refused(fmt::format("the rows of the matrix do not begin with {}", m.base));
  if (!std::is_sorted(m.row_start.begin(), m.row_start.end()) ||
      static_cast<std::size_t>(m.row_start.back() - m.base) > m.columns.size() ||
      m.columns.size() != m.values.size())
    throw Refused("rows, columns and values of the matrix do not go together");
}

}  // namespace

template <class Number>
void add_entries(std::span<const Entry> entries, const CsrMatrix<Number>& matrix) {
  check_shape(matrix);
  std::vector<std::size_t> place(entries.size());
  for (std::size_t i = 0; i < entries.size(); ++i) place[i] = stored_at(entries[i], matrix);
  for (std::size_t i = 0; i < entries.size(); ++i)
    if (place[i] != nowhere) matrix.values[place[i]] += entries[i].value;
}

template void add_entries(std::span<const Entry>, const CsrMatrix<std::int32_t>&);
template void add_entries(std::span<const Entry>, const CsrMatrix<std::int64_t>&);

}  // namespace osculate
