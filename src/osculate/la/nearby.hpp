#pragma once
#include "osculate/la/linear_solver.hpp"

namespace osculate::la {

/// How a solution by the factors of another matrix went.
struct Nearby {
  bool solved = false;
  int iterations = 0;
};

struct NearbyLimits {
  int iterations = 0;
  double tolerance = 1e-8;  ///< of the residual beside the right-hand side
};

/// Solves K x = b with what `factors` has factored before, a matrix near to K: by GMRES, with these
/// factors as its preconditioner.
///
/// Returns    `solved` where |b - K x| <= tolerance |b|; else nothing is changed
/// Source     Y. Saad, M. H. Schultz, SIAM J. Sci. Stat. Comput. 7 (1986) 856-869
/// Requires   `factors` has factors of a matrix of this size
/// Tested by  tests/unit/la/test_nearby.cpp
[[nodiscard]] Nearby solve_nearby(const SparseMatrix& k, Symmetry symmetry, LinearSolver& factors,
                                  const NearbyLimits& limits, Eigen::VectorXd& rhs_in_solution_out);

/// Factors (K + K^T) / 2 for a matrix whose entries have places on both sides of the diagonal: half
/// the work and the memory of the factors of K, for which they stand in with `solve_nearby`.
///
/// Tested by  tests/unit/la/test_nearby.cpp
FactorReport factor_symmetric_part(const SparseMatrix& k, std::uint64_t pattern_version,
                                   LinearSolver& solver);

/// How many iterations of `solve_nearby` are cheaper than half a factorisation: a function of the
/// report of the factors and the pattern alone, so that the same analysis takes the same way on any
/// machine.
///
/// Formula    seconds = operations / 8e9 + 3e-9 entries of a factorisation, 1.2e-9 (entries of the
///            factors + entries of the matrix) of an iteration; at most 40
[[nodiscard]] int affordable_iterations(const FactorReport& factors, const SparseMatrix& k);

}  // namespace osculate::la
