#pragma once
#include "osculate/la/linear_solver.hpp"
#include "osculate/la/preconditioned.hpp"

namespace osculate::la {

struct NearbyLimits {
  int iterations = 0;
  double tolerance = 1e-8;  ///< of the residual beside the right-hand side
};

/// Solutions of K x = b with what `factors` has factored before, a matrix near to K, by
/// PreconditionedSolutions. Vectors are whole, also where several processes have the rows of K.
///
/// Requires   `factors` has factors of a matrix of this size, and lives as long as this
/// Tested by  tests/unit/la/test_nearby.cpp
class NearbySolutions {
 public:
  NearbySolutions(const SparseMatrix& k, Symmetry symmetry, LinearSolver& factors);
  /// Returns    `solved` where |b - K x| <= tolerance |b|; else nothing is changed
  Nearby solve(const NearbyLimits& limits, Eigen::VectorXd& rhs_in_solution_out);
  /// Whether K resists all motions: noise is no force that a singular matrix balances, though the
  /// loads may be.
  ///
  /// Formula    |S^-1 (S noise - K x)| <= 1e-5 |noise| , |S x| <= 1e8 |noise| , S the roots of the
  ///            rows' largest entries, 1 for an empty row
  Nearby resists_all(int iterations);
  /// Whether a K of a symmetric kind has no negative eigenvalue, and resists all motions: conjugate
  /// gradients balance noise, and each of their directions takes work.
  ///
  /// Formula    p^T K p > 0 , |S^-1 (S noise - K x)| <= 1e-5 |noise| , |S x| <= 1e8 |noise|. What
  ///            is left is q(M^-1 K) S noise, q(0) = 1, and where all p take work all zeros of q
  ///            are positive, so that it grows along an eigenvector of a negative eigenvalue
  /// Requires   the factors have no negative pivots
  /// Source     C. C. Paige, B. N. Parlett, H. A. van der Vorst, Numer. Linear Algebra Appl. 2
  ///            (1995) 115-133 (zeros are Ritz values)
  Nearby is_positive(int iterations);

 private:
  const SparseMatrix& k_;
  Symmetry symmetry_;
  PreconditionedSolutions by_;
  LinearSolver& factors_;
};

/// One solution.
[[nodiscard]] Nearby solve_nearby(const SparseMatrix& k, Symmetry symmetry, LinearSolver& factors,
                                  const NearbyLimits& limits, Eigen::VectorXd& rhs_in_solution_out);

/// Factors (K + K^T) / 2: half the work and the memory of the factors of K, for which they stand in
/// with `solve_nearby`.
///
/// Tested by  tests/unit/la/test_nearby.cpp
FactorReport factor_symmetric_part(const SparseMatrix& k, std::uint64_t pattern_version,
                                   LinearSolver& solver);

/// How many iterations of `solve_nearby` are cheaper than a factorisation: a function of the report
/// of the factors and the pattern alone, so that the same analysis takes the same way on any
/// machine.
///
/// Formula    seconds = operations / 16e9 + 9e-9 entries of the factors + 25e-9 entries of the
///            matrix of a factorisation; 5e-8 unknowns + 0.45e-9 (entries of the factors + entries
///            of the matrix) of an iteration, 1.2e-9 beyond 1.5e6 of these; at most 40. None for a
///            matrix of fewer than 10 000 entries: some 0.5 ms, and all digits
[[nodiscard]] int affordable_iterations(const FactorReport& factors, const SparseMatrix& k);

}  // namespace osculate::la
