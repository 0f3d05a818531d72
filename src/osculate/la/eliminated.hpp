#pragma once
#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "osculate/la/linear_solver.hpp"

namespace osculate::la {

class SchurFactors;

/// What few unknowns C see of a matrix whose others, I, were eliminated: solves for these few
/// alone. Entries of C x C that stay the same are given once, those that change with each matrix.
/// What changes in few rows from the first matrix since `begin_anew` is an update of its factors.
///
/// Formula    S = K' + S_CC , S_CC = K_CC - K_CI K_II^-1 K_IC (K_CC: what stays), K' what `factor`
///            gets;  (A + E D)^-1 = A^-1 - Z (1 + D Z)^-1 D A^-1 , Z = A^-1 E , A factored, E the
///            unit vectors of the rows that have changed by D (Woodbury)
/// Shapes     matrices and right-hand sides have one row for each of C, in its order
/// Contract   the bits of a solution depend on the matrices since `begin_anew` alone
/// Tested by  tests/unit/la/test_eliminated.cpp
class Eliminated final : public LinearSolver {
 public:
  explicit Eliminated(SchurFactors& inside);
  ~Eliminated() override;
  Eliminated(const Eliminated&) = delete;
  Eliminated& operator=(const Eliminated&) = delete;

  /// Whether these are still the factors that `keep` found.
  [[nodiscard]] bool stands() const;
  /// Takes the entries of C x C that stay the same out of a matrix of all unknowns.
  void keep(const SparseMatrix& k, Symmetry symmetry, std::span<const Index> c);
  /// Gives the memory back.
  void forget();
  /// S_CC
  [[nodiscard]] const Eigen::MatrixXd& constant() const;
  /// b_C - K_CI K_II^-1 b_I of a right-hand side of all unknowns.
  bool reduce(const Eigen::VectorXd& b, Eigen::VectorXd& of_c);
  /// x of all unknowns for the right-hand side reduced last, with x_C as given.
  bool expand(const Eigen::VectorXd& x_c, Eigen::VectorXd& x);

  FactorReport factor(const SparseMatrix& k, std::uint64_t pattern_version,
                      Symmetry symmetry) override;
  SolveStatus solve(Eigen::VectorXd& rhs_in_solution_out) override;
  SolveStatus solve(Eigen::MatrixXd& rhs_in_solution_out) override;
  void begin_anew() override;
  [[nodiscard]] double seconds() const override;
  /// Matrices that were factored so far, and updates of factors.
  struct Count {
    int factored = 0, updated = 0;
  };
  [[nodiscard]] Count count() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace osculate::la
