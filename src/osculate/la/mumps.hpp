#pragma once
#include <memory>

#include "osculate/la/linear_solver.hpp"

namespace osculate::la {

/// The MUMPS of several processes (libdmumps), which is not linked to this library.
struct SharedMumps {
  void (*call)(void* structure) = nullptr;  ///< dmumps_c
  int communicator = 0;                     ///< as Fortran has it
  /// Matrices of fewer entries are factored by the first process alone (see DealtMumps).
  double fewest_entries = 5e5;
};

struct MumpsOptions {
  int blas_threads = 1;  ///< more than one may change the last bits with the load of the machine
  SharedMumps shared{};  ///< for matrices of several processes (SparseMatrix::ranks)
};

/// Sparse direct solver (MUMPS with a METIS ordering; the sequential one where all of the matrix is
/// here). The symbolic analysis is kept
/// while pattern and symmetry stand. It depends on the pattern alone, so that a solver that has
/// factored other values before gives the same bits as a new one. Solutions get one step of
/// refinement where the relative residual is above 1e-12. Several solvers may live at once: one
/// lock per process around every call of the library.
///
/// Errors     a matrix with 13 or more digits lost is reported as `singular` with the row of one of
///            the unknowns that move in the free mode; otherwise as LinearSolver
/// Tested by  tests/unit/la/test_mumps.cpp
class Mumps final : public LinearSolver {
 public:
  explicit Mumps(MumpsOptions options = {});
  ~Mumps() override;
  Mumps(const Mumps&) = delete;
  Mumps& operator=(const Mumps&) = delete;

  FactorReport factor(const SparseMatrix& k, std::uint64_t pattern_version,
                      Symmetry symmetry) override;
  SolveStatus solve(Eigen::VectorXd& rhs_in_solution_out) override;
  SolveStatus solve_once(Eigen::VectorXd& rhs_in_solution_out) override;
  SolveStatus solve(Eigen::MatrixXd& rhs_in_solution_out) override;
  /// Gives the memory back; `factor` is to follow.
  void forget();
  /// Gives back what is not factors: `solve_once` goes on, `solve` does not, and the next matrix is
  /// analysed again.
  void keep_factors_alone();
  [[nodiscard]] double seconds() const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace osculate::la
