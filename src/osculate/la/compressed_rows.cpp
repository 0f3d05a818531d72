#include "osculate/la/compressed_rows.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

namespace osculate::la {

void multiply(const CompressedRows& a, const Eigen::VectorXd& x, core::Crew& crew,
              Eigen::VectorXd& y) {
  constexpr std::size_t worth_it = 500;
  y.resize(a.rows());
  const Index* const start = a.outerIndexPtr();
  const Index* const column = a.innerIndexPtr();
  const double* const value = a.valuePtr();
  const std::size_t rows = as_size(static_cast<Index>(a.rows()));
  crew.share_runs(rows, worth_it, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      double sum = 0;
      for (Index e = start[i]; e < start[i + 1]; ++e) sum += value[e] * x[column[e]];
      y[static_cast<Index>(i)] = sum;
    }
  });
}

namespace {

/// Calls take(row, column, value) as `for_each_entry` does, of an unsymmetric matrix: rows by
/// several threads.
template <class Take>
void for_each_entry(const SparseMatrix& k, core::Crew& crew, const Take& take) {
  constexpr std::size_t worth_it = 500;
  crew.share_runs(as_size(k.n), worth_it, [&](std::size_t begin, std::size_t end) {
    for (auto i = static_cast<Index>(begin); i < static_cast<Index>(end); ++i)
      for (Index e = k.row_start[as_size(i)]; e < k.row_start[as_size(i) + 1]; ++e)
        if (const Index j = k.column[as_size(e)]; k.value[as_size(e)] != 0 || i == j)
          take(i, j, k.value[as_size(e)]);
  });
}

}  // namespace

CompressedRows compressed(const SparseMatrix& k, Symmetry symmetry, core::Crew& crew) {
  const auto each = [&](const auto& take) {
    if (symmetry == Symmetry::unsymmetric)
      for_each_entry(k, crew, take);
    else
      for_each_entry(k, symmetry, take);  // rows from above, so that columns are in order
  };
  std::vector<Index> next(as_size(k.n) + 1, 0);
  each([&](Index i, Index, double) { ++next[as_size(i) + 1]; });
  std::partial_sum(next.begin(), next.end(), next.begin());
  CompressedRows a(k.n, k.n);
  a.resizeNonZeros(next.back());
  std::ranges::copy(next, a.outerIndexPtr());
  each([&](Index i, Index j, double value) {
    const Index at = next[as_size(i)]++;
    a.innerIndexPtr()[at] = j;
    a.valuePtr()[at] = value;
  });
  return a;
}

SparseMatrix stored(const CompressedRows& a) {
  SparseMatrix k;
  k.n = static_cast<Index>(a.rows());
  k.row_start.assign(a.outerIndexPtr(), a.outerIndexPtr() + k.n + 1);
  k.column.assign(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros());
  k.value.assign(a.valuePtr(), a.valuePtr() + a.nonZeros());
  return k;
}

}  // namespace osculate::la
