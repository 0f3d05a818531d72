#pragma once
#include <memory>

#include "osculate/la/engine.hpp"
#include "osculate/la/linear_solver.hpp"
#include "osculate/la/mumps.hpp"

namespace osculate::la {

/// Linear systems of large bodies by GMRES, with a multigrid cycle for the bodies and a direct
/// solution on the unknowns of contact as preconditioner: contact makes the matrix badly
/// conditioned on these few unknowns alone. Multipliers and rigid bodies are among them.
///
/// Formula    x = C r, then x += M (r - K x) ; C = I_c K_cc^-1 I_c^T on the unknowns c that `place`
///            calls exact, M a cycle of la::Multigrid with the rigid motions of the nodes as near
///            null vectors
/// Between two calls of `begin_anew` the coarser models of the first matrix serve for those that
/// follow, also in other increments, until they take half as many iterations again, and so do
/// factors of what is exact for matrices that are like it there (see `alike` in engine.cpp).
///
/// A matrix is tried with noise, the first after `begin_anew` and after `may_come_loose` the one of
/// which `sound` asks: where that has no solution, or one that says that hardly a digit is left,
/// something is free to move, and the direct solver says what. Once it was asked it goes on until
/// `begin_anew`. One that has not been tried is tried, too, where a solution moves far beside its
/// right-hand side: by more than 1e8, both in the measure of the diagonal.
///
/// Returns    solutions with |b - K x| <= wanted |b| (`aim`). Where that is out of reach, the
///            matrix is factored by the direct solver, whose answer counts
/// Limits     few unknowns, matrices whose unknowns have not been
///            placed, and those with more than half of their unknowns exact are left to the direct
///            solver
/// Source     T. Hartland et al., arXiv:2505.18576 (AMG with filtering); Y. Saad, M. H. Schultz,
///            SIAM J. Sci. Stat. Comput. 7 (1986) 856-869
/// Contract   the bits of a solution depend on what is wanted, where the unknowns are and the
///            matrices since `begin_anew` alone: not on the number of threads, nor on what was
///            factored before
/// Tested by  tests/unit/la/test_iterative.cpp, tests/unit/deck/test_multigrid_models.cpp
class Iterative final : public LinearSolver {
 public:
  explicit Iterative(const MumpsOptions& direct = {});
  ~Iterative() override;
  Iterative(const Iterative&) = delete;
  Iterative& operator=(const Iterative&) = delete;

  [[nodiscard]] bool asks_for_places() const override { return true; }
  void place(Places places) override;
  void may_change(std::vector<Index> unknowns) override;
  void begin_anew() override;
  [[nodiscard]] bool passes() const override;
  void may_come_loose() override;
  [[nodiscard]] bool sound() override;
  void aim(double share) override;
  FactorReport factor(const SparseMatrix& k, std::uint64_t pattern_version,
                      Symmetry symmetry) override;
  SolveStatus solve(Eigen::VectorXd& rhs_in_solution_out) override;
  SolveStatus solve(Eigen::MatrixXd& rhs_in_solution_out) override;
  [[nodiscard]] double seconds() const override;
  [[nodiscard]] IterativeWork work() const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

[[nodiscard]] std::unique_ptr<LinearSolver> make_iterative_solver();

}  // namespace osculate::la
