#pragma once
#include <Eigen/SparseCore>
#include <cstddef>

#include "osculate/core/crew.hpp"
#include "osculate/la/linear_solver.hpp"

namespace osculate::la {

using CompressedRows = Eigen::SparseMatrix<double, Eigen::RowMajor, Index>;

/// Gives the memory back, which an assignment of nothing does not.
inline void release(CompressedRows& a) { CompressedRows().swap(a); }
/// What stands in `a`, without a copy, which a move would be.
[[nodiscard]] inline CompressedRows taken(CompressedRows& a) {
  CompressedRows out;
  out.swap(a);
  return out;
}

[[nodiscard]] constexpr std::size_t as_size(Index i) { return static_cast<std::size_t>(i); }

/// Calls take(row, column, value) for the entries of both triangles that the rows here say: of a
/// symmetric matrix the upper one counts for both. Zeros are left out, but for the diagonal.
template <class Take>
void for_each_entry(const SparseMatrix& k, Symmetry symmetry, const Take& take) {
  const bool both = symmetry != Symmetry::unsymmetric;
  for (Index i = 0; i < k.n; ++i)
    for (Index e = k.row_start[as_size(i)]; e < k.row_start[as_size(i) + 1]; ++e) {
      const Index j = k.column[as_size(e)];
      if ((both && j < i) || (k.value[as_size(e)] == 0 && i != j)) continue;
      take(i, j, k.value[as_size(e)]);
      if (both && j > i) take(j, i, k.value[as_size(e)]);
    }
}

/// The matrix with both triangles; entries that are zero are left out, but for the diagonal.
[[nodiscard]] CompressedRows compressed(const SparseMatrix& k, Symmetry symmetry, core::Crew& crew);
/// By one thread.
[[nodiscard]] inline CompressedRows compressed(const SparseMatrix& k, Symmetry symmetry) {
  core::Crew one(1);
  return compressed(k, symmetry, one);
}
[[nodiscard]] SparseMatrix stored(const CompressedRows& a);

/// y = A x, row by row with several threads: the bits do not depend on their number.
void multiply(const CompressedRows& a, const Eigen::VectorXd& x, core::Crew& crew,
              Eigen::VectorXd& y);

}  // namespace osculate::la
