#include "osculate/la/compressed_rows.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <new>
#include <numeric>
#include <vector>

namespace osculate::la {

void multiply(const CompressedRows& a, const Eigen::VectorXd& x, int threads, Eigen::VectorXd& y) {
  y.resize(a.rows());
  const Index* const start = a.outerIndexPtr();
  const Index* const column = a.innerIndexPtr();
  const double* const value = a.valuePtr();
  const auto rows = static_cast<Index>(a.rows());
#pragma omp parallel for num_threads(threads) schedule(static) if (threads > 1)
  for (Index i = 0; i < rows; ++i) {
    double sum = 0;
    for (Index e = start[i]; e < start[i + 1]; ++e) sum += value[e] * x[column[e]];
    y[i] = sum;
  }
}

void compress(const SparseMatrix& k, Symmetry symmetry, CompressedRows& a) {
  std::vector<Index> next(as_size(k.n) + 1, 0);
  for_each_entry(k, symmetry, [&](Index i, Index, double) { ++next[as_size(i) + 1]; });
  std::partial_sum(next.begin(), next.end(), next.begin());
  a.resize(k.n, k.n);
  a.resizeNonZeros(next.back());
  std::ranges::copy(next, a.outerIndexPtr());
  for_each_entry(
      k, symmetry,
      [&](Index i, Index j, double value) {  // rows from above, so that columns are in order
        const Index at = next[as_size(i)]++;
        a.innerIndexPtr()[at] = j;
        a.valuePtr()[at] = value;
      });
}

CompressedRows compressed(const SparseMatrix& k, Symmetry symmetry) {
  CompressedRows a;
  compress(k, symmetry, a);
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

/// In pieces, for several threads and since a product by Eigen is three times in memory at its end;
/// the bits are those of one piece.
CompressedRows product(const CompressedRows& a, const CompressedRows& b, int threads) {
  const auto rows = static_cast<Index>(a.rows());
  const Index pieces = std::min<Index>(rows, 8 * static_cast<Index>(threads));
  if (pieces < 2) return a * b;
  std::vector<CompressedRows> piece(as_size(pieces));
  const auto begin = [&](Index p) {
    return static_cast<Index>(static_cast<std::int64_t>(rows) * p / pieces);
  };
  int without_room = 0;  // an exception must not leave the loop
#pragma omp parallel for num_threads(threads) schedule(dynamic) reduction(+ : without_room) if (threads > 1)
  for (Index p = 0; p < pieces; ++p) try {
      piece[as_size(p)] = a.middleRows(begin(p), begin(p + 1) - begin(p)) * b;
    } catch (const std::bad_alloc&) {
      ++without_room;
    }
  std::int64_t entries = 0;
  for (const CompressedRows& part : piece) entries += part.nonZeros();
  if (without_room > 0 || entries > std::numeric_limits<Index>::max())
    throw NotEnoughMemory("not enough memory for a product of matrices");
  CompressedRows out(rows, b.cols());
  out.resizeNonZeros(static_cast<Index>(entries));
  Index row = 0, next = 0;
  for (CompressedRows& part : piece) {
    part.makeCompressed();
    const auto count = static_cast<Index>(part.nonZeros());
    std::copy_n(part.innerIndexPtr(), count, out.innerIndexPtr() + next);
    std::copy_n(part.valuePtr(), count, out.valuePtr() + next);
    for (Index i = 0; i < part.rows(); ++i)
      out.outerIndexPtr()[row++] = next + part.outerIndexPtr()[i];
    next += count;
    release(part);
  }
  out.outerIndexPtr()[rows] = next;
  return out;
}

}  // namespace osculate::la
