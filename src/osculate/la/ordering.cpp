#include "osculate/la/ordering.hpp"

#include <metis.h>

#include <algorithm>
#include <iterator>
#include <new>

namespace osculate::la {
namespace {

/// Columns of the transpose, sorted inside a row.
struct Pattern {
  std::vector<std::size_t> start;
  std::vector<Index> column;
};

Pattern transposed(const SparseMatrix& k) {
  const auto n = static_cast<std::size_t>(k.n);
  Pattern t;
  t.start.assign(n + 1, 0);
  for (const Index j : k.column) ++t.start[static_cast<std::size_t>(j) + 1];
  for (std::size_t i = 0; i < n; ++i) t.start[i + 1] += t.start[i];
  t.column.resize(k.column.size());
  std::vector<std::size_t> next(t.start.begin(), t.start.end() - 1);
  for (Index i = 0; i < k.n; ++i)
    for (Index e = k.row_start[static_cast<std::size_t>(i)];
         e < k.row_start[static_cast<std::size_t>(i) + 1]; ++e)
      t.column[next[static_cast<std::size_t>(k.column[static_cast<std::size_t>(e)])]++] = i;
  return t;
}

/// Puts together what the processes have of the pattern, on the first one.
SparseMatrix whole_pattern(const SparseMatrix& k) {
  const core::Ranks& ranks = *k.ranks;
  const bool first = ranks.rank() == 0;
  const auto processes = static_cast<std::size_t>(ranks.count());
  std::vector<int> lengths, columns;
  for (Index i = 0; i < k.n; ++i)
    lengths.push_back(k.row_start[static_cast<std::size_t>(i) + 1] -
                      k.row_start[static_cast<std::size_t>(i)]);
  std::vector<int> sizes(first ? processes : 0), starts(first ? processes * lengths.size() : 0);
  const int size = static_cast<int>(k.column.size());
  ranks.gather({&size, 1}, sizes);
  ranks.gather(lengths, starts);
  std::size_t all = 0;
  for (const int s : sizes) all += static_cast<std::size_t>(s);
  columns.resize(all);
  ranks.gather(k.column, columns);
  SparseMatrix whole;
  if (!first) return whole;
  whole.n = k.n;
  whole.row_start = {0};
  std::vector<std::size_t> next(processes, 0);
  for (std::size_t p = 1; p < processes; ++p)
    next[p] = next[p - 1] + static_cast<std::size_t>(sizes[p - 1]);
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    for (std::size_t p = 0; p < processes; ++p)
      for (int e = 0; e < starts[p * lengths.size() + i]; ++e)
        whole.column.push_back(columns[next[p]++]);
    whole.row_start.push_back(static_cast<Index>(whole.column.size()));
  }
  return whole;
}

}  // namespace

std::vector<int> nested_dissection(const SparseMatrix& k) {
  if (k.ranks) return nested_dissection(whole_pattern(k));
  const Pattern t = transposed(k);
  std::vector<idx_t> start{0}, adjacent;
  adjacent.reserve(k.column.size());
  std::vector<Index> row;
  for (Index i = 0; i < k.n; ++i) {
    const auto r = static_cast<std::size_t>(i);
    row.clear();
    std::set_union(k.column.begin() + k.row_start[r], k.column.begin() + k.row_start[r + 1],
                   t.column.begin() + static_cast<std::ptrdiff_t>(t.start[r]),
                   t.column.begin() + static_cast<std::ptrdiff_t>(t.start[r + 1]),
                   std::back_inserter(row));
    for (const Index j : row)
      if (j != i) adjacent.push_back(static_cast<idx_t>(j));
    start.push_back(static_cast<idx_t>(adjacent.size()));
  }
  if (adjacent.empty()) return {};
  auto n = static_cast<idx_t>(k.n);
  const auto size = static_cast<std::size_t>(k.n);
  std::vector<idx_t> node(size), position(size);
  const int done = METIS_NodeND(&n, start.data(), adjacent.data(), nullptr, nullptr, node.data(),
                                position.data());
  if (done == METIS_ERROR_MEMORY) throw std::bad_alloc();
  if (done != METIS_OK) return {};
  std::vector<int> order;
  order.reserve(size);
  for (const idx_t p : position) order.push_back(static_cast<int>(p) + 1);
  return order;
}

}  // namespace osculate::la
