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

}  // namespace

std::vector<int> nested_dissection(const SparseMatrix& k) {
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
