#pragma once
#include <optional>
#include <string>

#include "osculate/la/linear_solver.hpp"

namespace osculate::la {

/// Positive factors at which a matrix becomes singular, smallest first, with their vectors.
struct CriticalFactors {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;         ///< columns, v . K v = 1
  std::optional<double> reversed;  ///< the negative one next to 0; none: it was not found
  double residual = 0;             ///< largest |K v + lambda A v| / |K v|
  /// Factors up to the last one that are missing, by the signs of the pivots of K + s A, s above it
  /// (Sylvester's law of inertia): 0 is proof that all are there; -1: not known.
  int missing = 0;
  std::string failure;  ///< why there are none; empty: there are, or K + s A is regular for s > 0
};

/// (K + lambda A) v = 0 by Lanczos' method for K^-1 (-A) with the product v . K v, whose largest
/// eigenvalues are 1 / lambda (Spectra).
///
/// Formula    K and A symmetric (their symmetric parts), A of any sign, K positive definite; where
///            K has rows of multipliers, on what they allow, and A has none of them
/// Input      multipliers: number of those rows, the last ones
/// Requires   the pattern of A within that of K; 0 < count
/// Errors     `failure` in words: K is singular or not positive definite; NotEnoughMemory
/// Tested by  tests/unit/la/test_critical_factors.cpp
[[nodiscard]] CriticalFactors critical_factors(const SparseMatrix& k, const SparseMatrix& a,
                                               int multipliers, int count, LinearSolver& solver);

}  // namespace osculate::la
