#pragma once
#include <cstdint>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <utility>

#include "osculate/la/condensation.hpp"
#include "osculate/la/sparse_matrix.hpp"

namespace osculate::la {

/// What the caller knows of the matrix. For the symmetric kinds only the upper triangle is read.
/// `positive_definite` does no pivoting: `negative_pivots` > 0 tells that the promise was wrong.
enum class Symmetry { unsymmetric, positive_definite, indefinite };

/// Numerical failure is a value, expected and handled by step control.
enum class SolveStatus { ok, singular, failed };

/// The factors of a matrix do not fit into the memory. No smaller increment helps.
class NotEnoughMemory : public std::bad_alloc {
 public:
  explicit NotEnoughMemory(std::string text) : text_(std::move(text)) {}
  [[nodiscard]] const char* what() const noexcept override { return text_.c_str(); }

 private:
  std::string text_;
};

struct FactorReport {
  SolveStatus status = SolveStatus::ok;
  Index bad_row = -1;                               ///< 0-based row of a zero pivot where known
  int negative_pivots = 0;                          ///< of the symmetric kinds; 0 for unsymmetric
  double seconds_analysis = 0, seconds_factor = 0;  ///< analysis 0: the former one was used again
  std::string message;                              ///< empty when ok
  /// About, of the matrix scaled by its rows; 0: at most 1e13.
  double condition = 0;
  /// Where the matrix was factored, but is `singular` to working precision: what it resists least,
  /// one value per row. Whoever knows that this is no free motion may `solve` all the same, and
  /// correct the solution by its residual.
  Eigen::VectorXd weakest{};
  std::int64_t factor_entries = 0;
};

struct DirectOptions {
  int blas_threads = 1;  ///< more than one may change the last bits with the load of the machine
  Condense condense = Condense::never;  ///< the multipliers that `factor` is told of
};

/// Sparse direct solver (sequential MUMPS with a METIS ordering). The symbolic analysis is kept
/// while pattern and symmetry stand. It depends on the pattern alone, so that a solver that has
/// factored other values before gives the same bits as a new one. Several may live at once: one
/// lock per process around every call of the library.
///
/// Errors     a matrix with 13 or more digits lost is reported as `singular` with the row of one of
///            the unknowns that move in the free mode; nothing is thrown but NotEnoughMemory
///            and std::bad_alloc
/// Tested by  tests/unit/la/test_direct_solver.cpp
class DirectSolver {
 public:
  explicit DirectSolver(DirectOptions options = {});
  ~DirectSolver();
  DirectSolver(DirectSolver&&) noexcept;
  DirectSolver& operator=(DirectSolver&&) noexcept;
  DirectSolver(const DirectSolver&) = delete;
  DirectSolver& operator=(const DirectSolver&) = delete;

  /// `pattern_version` saves the comparison of patterns where it changed; where it did not, the
  /// pattern is compared all the same.
  FactorReport factor(const SparseMatrix& k, std::uint64_t pattern_version, Symmetry symmetry);
  /// The same; with the option `condense` multipliers of these groups are eliminated before,
  /// where they can be: what is factored is smaller then, and unsymmetric. `solve` is that of the
  /// whole system.
  FactorReport factor(const SparseMatrix& k, std::uint64_t pattern_version, Symmetry symmetry,
                      std::span<const MultiplierGroup> condensable);
  /// Replaces the right-hand side by the solution, with one step of refinement where the relative
  /// residual is above 1e-12. `failed` without factors or for a wrong size or a NaN.
  SolveStatus solve(Eigen::VectorXd& rhs_in_solution_out) const;
  /// One right-hand side a column, all at once (last bits may differ from one by one).
  SolveStatus solve(Eigen::MatrixXd& rhs_in_solution_out) const;
  /// Spent in `factor` and `solve` so far [s].
  [[nodiscard]] double seconds() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace osculate::la
