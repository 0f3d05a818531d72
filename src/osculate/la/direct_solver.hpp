#pragma once
#include <memory>
#include <string>

#include "osculate/la/sparse_matrix.hpp"

namespace osculate::la {

enum class Symmetry { unsymmetric, positive_definite, indefinite };

/// Numerical failure is a value, expected and handled by step control.
enum class SolveStatus { ok, singular, not_enough_memory, failed };

struct FactorReport {
  SolveStatus status = SolveStatus::ok;
  Index bad_row = -1;        ///< 0-based row of a zero pivot where known
  int negative_pivots = 0;
  double seconds_analysis = 0, seconds_factor = 0;
  std::string message;
};

/// Sparse direct solver (sequential MUMPS with a METIS ordering). The symbolic analysis is kept
/// while the pattern stands. One lock per process around every call of the library; BLAS runs on
/// one thread, so the bits do not depend on the machine's load.
class DirectSolver {
 public:
  DirectSolver();
  ~DirectSolver();
  DirectSolver(DirectSolver&&) noexcept;
  DirectSolver& operator=(DirectSolver&&) noexcept;
  DirectSolver(const DirectSolver&) = delete;
  DirectSolver& operator=(const DirectSolver&) = delete;

  FactorReport factor(const SparseMatrix& k, std::uint64_t pattern_version, Symmetry symmetry);
  /// Replaces the right-hand side by the solution.
  SolveStatus solve(Eigen::VectorXd& rhs_in_solution_out) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace osculate::la
