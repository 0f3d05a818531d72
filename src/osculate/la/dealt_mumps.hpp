#pragma once
#include "osculate/la/mumps.hpp"

namespace osculate::la {

/// Mumps, for matrices of one process or of several. Of several, those of few entries
/// (SharedMumps::fewest_entries) are put together and factored by the first process, which tells
/// the others what came out: all of them together take longer for these, as MUMPS sends thousands
/// of messages for a factorisation of milliseconds. The factors have the bits of one process alone.
///
/// Errors     as Mumps, on all processes
/// Tested by  tests/unit/la/test_dealt_mumps.cpp, tests/ranks
class DealtMumps final : public LinearSolver {
 public:
  explicit DealtMumps(const MumpsOptions& options = {})
      : fewest_(options.shared.fewest_entries), mumps_(options) {}

  FactorReport factor(const SparseMatrix& k, std::uint64_t pattern_version,
                      Symmetry symmetry) override;
  SolveStatus solve(Eigen::VectorXd& rhs_in_solution_out) override;
  SolveStatus solve_once(Eigen::VectorXd& rhs_in_solution_out) override;
  SolveStatus solve(Eigen::MatrixXd& rhs_in_solution_out) override;
  /// Gives the memory back; `factor` is to follow.
  void forget() { mumps_.forget(); }
  [[nodiscard]] double seconds() const override { return seconds_; }

 private:
  double fewest_;
  Mumps mumps_;
  const core::Ranks* told_ = nullptr;  ///< to whom the first one tells; null: nobody
  double seconds_ = 0;
};

}  // namespace osculate::la
