#pragma once
// Matrices as Eigen and Spectra want them; for the sources that look for eigenvalues.
#include <Eigen/SparseCore>

#include "osculate/la/sparse_matrix.hpp"

namespace osculate::la {

using Sparse = Eigen::SparseMatrix<double, Eigen::RowMajor, Index>;

[[nodiscard]] inline Sparse sparse(const SparseMatrix& a) {
  return Eigen::Map<const Sparse>(a.n, a.n, static_cast<Index>(a.value.size()), a.row_start.data(),
                                  a.column.data(), a.value.data());
}

[[nodiscard]] inline SparseMatrix plain(Sparse a) {
  a.makeCompressed();
  const auto entries = static_cast<std::size_t>(a.nonZeros());
  SparseMatrix out;
  out.n = static_cast<Index>(a.rows());
  out.row_start.assign(a.outerIndexPtr(), a.outerIndexPtr() + a.rows() + 1);
  out.column.assign(a.innerIndexPtr(), a.innerIndexPtr() + entries);
  out.value.assign(a.valuePtr(), a.valuePtr() + entries);
  return out;
}

}  // namespace osculate::la
