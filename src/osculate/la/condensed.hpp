#pragma once
#include <Eigen/Core>
#include <Eigen/LU>
#include <memory>
#include <vector>

#include "osculate/la/mumps.hpp"
#include "osculate/la/schur.hpp"

namespace osculate::la {

/// Mumps, which eliminates once what stays the same: of a matrix in which only entries between few
/// unknowns change (contact of bodies that are linear), the others are factored once, and each
/// further matrix costs a dense one of these few. Without such unknowns, where a dense matrix would
/// not be cheaper, or where the factors have few digits, it is Mumps itself.
///
/// Contract   the bits of a solution depend on the matrix and on `may_change` alone
/// Tested by  tests/unit/la/test_condensed.cpp
class Condensed final : public LinearSolver {
 public:
  explicit Condensed(MumpsOptions options = {});
  ~Condensed() override;
  Condensed(const Condensed&) = delete;
  Condensed& operator=(const Condensed&) = delete;

  void may_change(std::vector<Index> unknowns) override;
  FactorReport factor(const SparseMatrix& k, std::uint64_t pattern_version,
                      Symmetry symmetry) override;
  Eliminated* eliminate(const SparseMatrix& k, Symmetry symmetry) override;
  SolveStatus solve(Eigen::VectorXd& rhs_in_solution_out) override;
  SolveStatus solve_once(Eigen::VectorXd& rhs_in_solution_out) override;
  SolveStatus solve(Eigen::MatrixXd& rhs_in_solution_out) override;
  [[nodiscard]] double seconds() const override;
  /// Factorisations so far of all unknowns, and of those alone that may change.
  struct Count {
    int whole = 0, small = 0;
  };
  [[nodiscard]] Count count() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace osculate::la
