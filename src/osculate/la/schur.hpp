#pragma once
#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "osculate/la/linear_solver.hpp"

namespace osculate::la {

/// Factors of the rows and columns I of a matrix that are left without those of a set C, and what
/// they do to C. The entries of C x C have no say in it.
///
/// Formula    S_0 = - K_CI K_II^-1 K_IC ; K x = b where S = K_CC + S_0 ,
///            S x_C = b_C - K_CI K_II^-1 b_I , x_I = K_II^-1 (b_I - K_IC x_C)
/// Contract   the bits depend on the entries alone, not on what was factored before: equal entries
///            are not factored twice
/// Errors     nothing is thrown but NotEnoughMemory and std::bad_alloc
/// Tested by  tests/unit/la/test_condensed.cpp
class SchurFactors {
 public:
  explicit SchurFactors(int blas_threads);
  ~SchurFactors();
  SchurFactors(const SchurFactors&) = delete;
  SchurFactors& operator=(const SchurFactors&) = delete;

  /// Analyses K without C x C where it has another pattern than before. False: it cannot be.
  bool analyse(const SparseMatrix& k, Symmetry symmetry, std::span<const Index> c);
  [[nodiscard]] bool analysed() const;
  /// Whether that was of this pattern.
  [[nodiscard]] bool is_of(const SparseMatrix& k, Symmetry symmetry,
                           std::span<const Index> c) const;
  /// Operations of a factorisation, by the analysis.
  [[nodiscard]] double operations() const;
  /// Factors where the values are others than before. False: singular, or no room.
  bool factor(const SparseMatrix& k);
  /// How often it did.
  [[nodiscard]] int count() const;
  [[nodiscard]] bool holds_factors() const;
  /// Gives the memory back.
  void forget();
  [[nodiscard]] int negative_pivots() const;
  /// Smallest pivot beside the largest one.
  [[nodiscard]] double pivot_ratio() const;
  [[nodiscard]] std::int64_t factor_entries() const;
  /// S_0, both triangles.
  [[nodiscard]] const Eigen::MatrixXd& complement() const;
  /// b_C - K_CI K_II^-1 b_I, one column for each right-hand side; `expand` follows.
  bool reduce(const Eigen::MatrixXd& b, Eigen::MatrixXd& of_c);
  bool expand(const Eigen::MatrixXd& x_c, Eigen::MatrixXd& x);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace osculate::la
