#include "osculate/la/dealt_rows.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace osculate::la {

Dealt dealt_as(const SparseMatrix& k) {
  Dealt dealt;
  dealt.ranks = k.ranks;
  if (!k.ranks) return dealt;
  std::vector<double> owner(as_size(k.n), -1);
  const int me = k.ranks->rank();
  for (Index i = 0; i < k.n; ++i)
    if (k.row_start[as_size(i)] < k.row_start[as_size(i) + 1]) owner[as_size(i)] = me;
  k.ranks->largest(owner);
  dealt.first.assign(static_cast<std::size_t>(k.ranks->count()) + 1, 0);
  for (const double process : owner) {
    if (process < 0) throw std::logic_error("a row of the matrix is on no process");
    ++dealt.first[static_cast<std::size_t>(process) + 1];
  }
  std::partial_sum(dealt.first.begin(), dealt.first.end(), dealt.first.begin());
  dealt.begin = dealt.first[static_cast<std::size_t>(me)];
  dealt.end = dealt.first[static_cast<std::size_t>(me) + 1];
  std::vector<Index> next = dealt.first;
  dealt.number.resize(as_size(k.n));
  dealt.unknown.resize(as_size(k.n));
  for (Index i = 0; i < k.n; ++i) {
    dealt.number[as_size(i)] = next[static_cast<std::size_t>(owner[as_size(i)])]++;
    dealt.unknown[as_size(dealt.number[as_size(i)])] = i;
  }
  return dealt;
}

bool deals(const Dealt& dealt, const SparseMatrix& k) {
  if (dealt.ranks != k.ranks) return false;
  if (!k.ranks) return true;
  bool same = dealt.number.size() == as_size(k.n);
  for (Index i = 0; same && i < k.n; ++i)
    same = dealt.is_here(i) == (k.row_start[as_size(i)] < k.row_start[as_size(i) + 1]);
  return k.ranks->all(same);
}

namespace {

struct Entry {
  Index column = 0;
  double value = 0;
};

/// What others say of rows here: their numbers here, unknowns of the columns, values.
std::vector<double> said_by_others(const SparseMatrix& k, Symmetry symmetry, const Dealt& dealt) {
  if (symmetry == Symmetry::unsymmetric) return {};
  std::vector<std::vector<double>> to(dealt.first.size() - 1);
  for_each_entry(k, symmetry, [&](Index i, Index j, double value) {
    if (dealt.is_here(i)) return;
    const Index number = dealt.number[as_size(i)];
    const auto process = std::ranges::upper_bound(dealt.first, number) - dealt.first.begin() - 1;
    std::vector<double>& of = to[static_cast<std::size_t>(process)];
    of.insert(of.end(), {static_cast<double>(number - *(dealt.first.begin() + process)),
                         static_cast<double>(j), value});
  });
  return exchanged(*dealt.ranks, to);
}

/// Own rows; columns are unknowns, in their order but for those that others have said.
CompressedRows own_rows(const SparseMatrix& k, Symmetry symmetry, const Dealt& dealt, Index begin,
                        Index own) {
  const std::vector<double> said = said_by_others(k, symmetry, dealt);
  std::vector<Index> next(as_size(own) + 1, 0);
  for_each_entry(k, symmetry, [&](Index i, Index, double) {
    if (dealt.is_here(i)) ++next[as_size(dealt.number[as_size(i)] - begin) + 1];
  });
  for (std::size_t e = 0; e < said.size(); e += 3) ++next[static_cast<std::size_t>(said[e]) + 1];
  for (std::size_t i = 1; i < next.size(); ++i) next[i] += next[i - 1];
  CompressedRows a(own, k.n);
  a.resizeNonZeros(next.back());
  std::ranges::copy(next, a.outerIndexPtr());
  const auto put = [&](Index row, Index column, double value) {
    const Index at = next[as_size(row)]++;
    a.innerIndexPtr()[at] = column;
    a.valuePtr()[at] = value;
  };
  for_each_entry(k, symmetry, [&](Index i, Index j, double value) {
    if (dealt.is_here(i)) put(dealt.number[as_size(i)] - begin, j, value);
  });
  for (std::size_t e = 0; e < said.size(); e += 3)
    put(static_cast<Index>(said[e]), static_cast<Index>(said[e + 1]), said[e + 2]);
  return a;
}

/// Columns that are unknowns become those here, own ones first. Uses up the rows.
CompressedRows translated(CompressedRows& rows, const std::vector<Index>& here, const Halo& halo) {
  std::vector<Entry> others;
  for (Index i = 0; i < rows.rows(); ++i) {
    Index next = rows.outerIndexPtr()[i];
    others.clear();
    const auto put = [&](Index column, double value) {
      rows.innerIndexPtr()[next] = column;
      rows.valuePtr()[next++] = value;
    };
    for (Index e = next; e < rows.outerIndexPtr()[i + 1]; ++e)
      if (const Index j = here[as_size(rows.innerIndexPtr()[e])]; j < halo.own())
        put(j, rows.valuePtr()[e]);
      else
        others.push_back({j, rows.valuePtr()[e]});
    std::ranges::sort(others, {}, &Entry::column);
    for (const Entry& other : others) put(other.column, other.value);
  }
  CompressedRows out(rows.rows(), halo.here());
  std::copy_n(rows.outerIndexPtr(), rows.rows() + 1, out.outerIndexPtr());
  out.data().swap(rows.data());
  return out;
}

}  // namespace

RowsHere rows_here(const SparseMatrix& k, Symmetry symmetry, const Dealt& dealt, core::Crew& crew) {
  if (!dealt.ranks) return {compressed(k, symmetry, crew), Halo(k.n)};
  const Index begin = dealt.begin, own = dealt.end - begin;
  CompressedRows rows = own_rows(k, symmetry, dealt, begin, own);
  constexpr Index unseen = -1, seen = -2;
  std::vector<Index> here(as_size(k.n), unseen), others;
  for (Index i = 0; i < own; ++i) here[as_size(dealt.unknown[as_size(begin + i)])] = i;
  for (Eigen::Index e = 0; e < rows.nonZeros(); ++e) {
    const Index u = rows.innerIndexPtr()[e];
    if (here[as_size(u)] != unseen) continue;
    here[as_size(u)] = seen;
    others.push_back(dealt.number[as_size(u)]);
  }
  std::ranges::sort(others);
  for (std::size_t o = 0; o < others.size(); ++o)
    here[as_size(dealt.unknown[as_size(others[o])])] = own + static_cast<Index>(o);
  Halo halo(dealt.ranks, dealt.first, std::move(others));
  return {translated(rows, here, halo), halo};
}

SparseMatrix matrix_of(const CompressedRows& rows, const Halo& halo, const Dealt& dealt) {
  SparseMatrix k = stored(rows);
  if (!dealt.ranks) return k;
  k.ranks = dealt.ranks;
  k.n = halo.everywhere();
  k.row_start = {0};
  Index next = 0;
  std::vector<Entry> row;
  for (Index u = 0; u < k.n; ++u) {
    row.clear();
    if (dealt.is_here(u))
      for (CompressedRows::InnerIterator entry(rows, dealt.number[as_size(u)] - halo.begin());
           entry; ++entry)
        row.push_back(
            {dealt.unknown[as_size(halo.number_everywhere(static_cast<Index>(entry.col())))],
             entry.value()});
    std::ranges::sort(row, {}, &Entry::column);
    for (const auto& [column, value] : row) {
      k.column[as_size(next)] = column;
      k.value[as_size(next++)] = value;
    }
    k.row_start.push_back(next);
  }
  return k;
}

}  // namespace osculate::la
