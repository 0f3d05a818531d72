#pragma once
#include <complex>
#include <span>
#include <string>

#include "osculate/la/linear_solver.hpp"

namespace osculate::la {

/// Eigenvalues next to the shift and above it, smallest first, with their vectors.
struct Eigenpairs {
  Eigen::VectorXd values;   ///< 0 exactly, where it cannot be told from 0: see rounding
  Eigen::MatrixXd vectors;  ///< columns, v . M v = 1
  double shift = 0;         ///< that they were found around
  double residual = 0;      ///< largest |K v - lambda M v| / ((|lambda| + |shift|) |M v|);
                            ///< where lambda is 0, |K v| / | |K| |v| |
  /// What rounding alone may make of an eigenvalue: the largest 4 eps |v| . |K| |v|, absolute
  /// values entry by entry.
  double rounding = 0;
  /// Eigenvalues up to the last one that are missing, by the signs of the pivots of K - s M, s
  /// above it (Sylvester's law of inertia): 0 is proof that all are there.
  int missing = 0;
  std::string failure;  ///< why there are none; empty: there are

  /// Vectors that K does not resist: of rigid motions and mechanisms.
  [[nodiscard]] Eigen::Index without_stiffness() const { return (values.array() == 0).count(); }
};

/// Smallest eigenvalues of K v = lambda M v by Lanczos' method with a shift that is inverted
/// (Spectra). Without a shift of its own, 0, and below it where K is singular.
///
/// Formula    K and M symmetric (of K the symmetric part), M positive semidefinite
/// Requires   the pattern of M within that of K; 0 < count
/// Errors     `failure` in words; NotEnoughMemory
/// Tested by  tests/unit/la/test_eigenpairs.cpp
[[nodiscard]] Eigenpairs smallest_eigenpairs(const SparseMatrix& k, const SparseMatrix& m,
                                             int count, LinearSolver& solver);

/// An entry of a matrix that makes complex vectors of others.
struct ComplexEntry {
  Index row = 0, column = 0;
  std::complex<double> value;
};
/// Eigenvalues of T^H K T q = lambda T^H M T q, and x = T q: real and, below it, imaginary part, so
/// that a vector has 2 n rows; n, where T is real.
///
/// Formula    as real vectors (Re q, Im q), of T = [Re T, -Im T; Im T, Re T]: each value twice, of
/// a
///            vector x and of i x, both of which are returned
/// Requires   as above; T has `columns` columns, all independent
/// Tested by  tests/unit/la/test_eigenpairs.cpp
[[nodiscard]] Eigenpairs smallest_eigenpairs(const SparseMatrix& k, const SparseMatrix& m,
                                             std::span<const ComplexEntry> t, Index columns,
                                             int count, LinearSolver& solver);

}  // namespace osculate::la
