#include "osculate/la/dealt_rows.hpp"

#include <algorithm>
#include <utility>

namespace osculate::la {

Dealt dealt_as(const SparseMatrix& k) {
  Dealt dealt;
  dealt.ranks = k.ranks;
  if (!k.ranks) return dealt;
  std::vector<double> owner(as_size(k.n), -1);
  for (Index i = 0; i < k.n; ++i)
    if (k.row_start[as_size(i)] < k.row_start[as_size(i) + 1]) owner[as_size(i)] = k.ranks->rank();
  k.ranks->largest(owner);
  dealt.number.resize(as_size(k.n));
  for (int p = 0; p < k.ranks->count(); ++p) {
    dealt.first.push_back(static_cast<Index>(dealt.unknown.size()));
    for (Index i = 0; i < k.n; ++i)
      if (static_cast<int>(owner[as_size(i)]) == p) {
        dealt.number[as_size(i)] = static_cast<Index>(dealt.unknown.size());
        dealt.unknown.push_back(i);
      }
  }
  dealt.first.push_back(static_cast<Index>(dealt.unknown.size()));
  return dealt;
}

namespace {

using NumberedRow = std::vector<std::pair<Index, double>>;

CompressedRows sorted_rows(std::vector<NumberedRow>& rows, Index columns) {
  std::size_t entries = 0;
  for (const NumberedRow& row : rows) entries += row.size();
  CompressedRows out(static_cast<Index>(rows.size()), columns);
  out.resizeNonZeros(static_cast<Index>(entries));
  Index next = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::ranges::sort(rows[i]);
    for (const auto& [column, value] : rows[i]) {
      out.innerIndexPtr()[next] = column;
      out.valuePtr()[next++] = value;
    }
    out.outerIndexPtr()[i + 1] = next;
    rows[i] = {};
  }
  return out;
}

}  // namespace

CompressedRows own_rows(const SparseMatrix& k, Symmetry symmetry, const Dealt& dealt) {
  if (!dealt.ranks) return compressed(k, symmetry);
  const bool both = symmetry != Symmetry::unsymmetric;  // the upper triangle counts for both
  const auto me = static_cast<std::size_t>(dealt.ranks->rank());
  const Index begin = dealt.first[me], end = dealt.first[me + 1];
  std::vector<NumberedRow> rows(as_size(end - begin));
  std::vector<std::vector<double>> to(dealt.first.size() - 1);  // number of row, of column, value
  const auto put = [&](Index i, Index j, double value) {
    const Index row = dealt.number[as_size(i)], column = dealt.number[as_size(j)];
    if (row >= begin && row < end) {
      rows[as_size(row - begin)].emplace_back(column, value);
      return;
    }
    const auto after = std::ranges::upper_bound(dealt.first, row);
    std::vector<double>& of = to[static_cast<std::size_t>(after - dealt.first.begin()) - 1];
    of.insert(of.end(), {static_cast<double>(row), static_cast<double>(column), value});
  };
  for (Index i = 0; i < k.n; ++i)
    for (Index e = k.row_start[as_size(i)]; e < k.row_start[as_size(i) + 1]; ++e) {
      const Index j = k.column[as_size(e)];
      const double value = k.value[as_size(e)];
      if ((both && j < i) || (value == 0 && i != j)) continue;
      put(i, j, value);
      if (both && j > i) put(j, i, value);
    }
  const std::vector<double> taken = exchanged(*dealt.ranks, to);
  for (std::size_t e = 0; e < taken.size(); e += 3)
    rows[as_size(static_cast<Index>(taken[e]) - begin)].emplace_back(
        static_cast<Index>(taken[e + 1]), taken[e + 2]);
  return sorted_rows(rows, k.n);
}

SparseMatrix matrix_of(const CompressedRows& rows, const Halo& halo, const Dealt& dealt) {
  SparseMatrix k = stored(rows);
  if (!dealt.ranks) return k;
  k.ranks = dealt.ranks;
  k.n = halo.everywhere();
  k.row_start = {0};
  Index next = 0;
  NumberedRow row;
  for (Index u = 0; u < k.n; ++u) {
    row.clear();
    if (dealt.is_here(u))
      for (CompressedRows::InnerIterator entry(rows, dealt.number[as_size(u)] - halo.begin());
           entry; ++entry)
        row.emplace_back(
            dealt.unknown[as_size(halo.number_everywhere(static_cast<Index>(entry.col())))],
            entry.value());
    std::ranges::sort(row);
    for (const auto& [column, value] : row) {
      k.column[as_size(next)] = column;
      k.value[as_size(next++)] = value;
    }
    k.row_start.push_back(next);
  }
  return k;
}

}  // namespace osculate::la
