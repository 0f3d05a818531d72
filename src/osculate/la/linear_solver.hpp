#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <new>
#include <string>
#include <utility>

#include "osculate/la/places.hpp"
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
  /// False: only what may change was factored. The rest had been eliminated before, or is iterated
  /// on.
  bool whole = true;
  double operations = 0;  ///< of the factorisation, where it is worth to do without it; else 0
};

/// What a solver that iterates has done so far.
struct IterativeWork {
  int solutions = 0, iterations = 0;  ///< of systems that were solved so, and of all attempts
  int given_up = 0;                   ///< matrices that were left to the direct solver
  int factored = 0;  ///< likewise, and those of which a part was: others go with factors before
};

class Eliminated;

/// All that the rest of the program knows of a solver of linear systems. What a solver does not
/// know (rows of zero pivots, counts of negative ones) it leaves as it is in the report; those
/// counts decide about stability only where the matrix is of a symmetric kind.
///
/// Contract   the bits of a solution depend on the matrix (and on what may change of it) and on the
///            matrices since `begin_anew` alone, not on what was factored before
/// Errors     nothing is thrown but NotEnoughMemory and std::bad_alloc
/// Tested by  tests/unit/la/test_mumps.cpp, tests/unit/deck/test_linear_solver.cpp (another one)
class LinearSolver {
 public:
  LinearSolver() = default;
  virtual ~LinearSolver() = default;
  LinearSolver(const LinearSolver&) = delete;
  LinearSolver& operator=(const LinearSolver&) = delete;

  /// Between which unknowns alone entries are likely to change from one matrix to the next; none
  /// where nobody knows. A solver may make use of it, or not.
  virtual void may_change(std::vector<Index> /*unknowns*/) {}
  /// Whether `place` is of use.
  [[nodiscard]] virtual bool asks_for_places() const { return false; }
  /// Where the unknowns of the matrices to come are; none: nobody knows.
  virtual void place(Places /*places*/) {}
  /// How much of the right-hand sides to come may be left out of balance, until the next matrix.
  /// Solvers that are exact leave nothing.
  virtual void aim(double /*share*/) {}
  /// Analyses where pattern or symmetry are not those of the last call, and factors.
  /// `pattern_version` saves the comparison of patterns where it changed; where it did not, the
  /// pattern is compared all the same.
  virtual FactorReport factor(const SparseMatrix& k, std::uint64_t pattern_version,
                              Symmetry symmetry) = 0;
  /// Where the solver can eliminate all unknowns but those that may change, and that pays: what
  /// these few see of the rest of `k`. Nothing: it does not.
  virtual Eliminated* eliminate(const SparseMatrix& /*k*/, Symmetry /*symmetry*/) {
    return nullptr;
  }
  /// Replaces the right-hand side by the solution. `failed` without factors or for a wrong size or
  /// a NaN.
  virtual SolveStatus solve(Eigen::VectorXd& rhs_in_solution_out) = 0;
  /// As `solve`, without a correction by the residual: for iterations that see the residual.
  virtual SolveStatus solve_once(Eigen::VectorXd& rhs_in_solution_out) {
    return solve(rhs_in_solution_out);
  }
  /// One right-hand side a column, all at once (last bits may differ from one by one).
  virtual SolveStatus solve(Eigen::MatrixXd& rhs_in_solution_out) = 0;
  /// Spent in `factor` and `solve` so far [s].
  [[nodiscard]] virtual double seconds() const = 0;
  [[nodiscard]] virtual IterativeWork work() const { return {}; }
  /// Nothing of earlier matrices may show in the solutions to come.
  virtual void begin_anew() {}
  /// Whether what a solver that iterates has prepared may serve for the matrices of another
  /// increment: where the first of them is told by `may_come_loose`.
  [[nodiscard]] virtual bool passes() const { return false; }
  /// What held something in the last matrix may not hold it in those to come. Who ends with one of
  /// them asks `sound`.
  virtual void may_come_loose() {}
  /// Whether the last matrix has a solution for every right-hand side. Solvers that factor have
  /// told so already; after `false` the next matrix is factored.
  [[nodiscard]] virtual bool sound() { return true; }
};

using MakeSolver = std::function<std::unique_ptr<LinearSolver>()>;

/// The solver of who asks for none.
[[nodiscard]] std::unique_ptr<LinearSolver> make_default_solver();

}  // namespace osculate::la
