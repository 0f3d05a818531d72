#pragma once
#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>
#include <optional>

namespace osculate::la {

/// Factors of a full matrix, scaled by the square roots of the largest entries of its rows, in the
/// place of the matrix.
///
/// Tested by  tests/unit/la/test_condensed.cpp, test_eliminated.cpp
class DenseFactors {
 public:
  DenseFactors() = default;
  DenseFactors(const DenseFactors&) = delete;
  DenseFactors& operator=(const DenseFactors&) = delete;
  /// To be filled before each call of `factor`, which destroys it.
  [[nodiscard]] Eigen::MatrixXd& matrix() { return matrix_; }
  /// False: singular; of symmetric kinds also where it is not positive definite.
  bool factor(bool symmetric);
  void solve(Eigen::MatrixXd& b) const;
  /// Smallest pivot beside the largest one.
  [[nodiscard]] double pivot_ratio() const { return ratio_; }
  /// By row, the inverse of the square root of its largest entry.
  [[nodiscard]] const Eigen::VectorXd& scale() const { return scale_; }

 private:
  Eigen::MatrixXd matrix_;
  std::optional<Eigen::PartialPivLU<Eigen::Ref<Eigen::MatrixXd>>> lu_;
  std::optional<Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>>> cholesky_;
  Eigen::VectorXd scale_;
  bool symmetric_ = false;
  double ratio_ = 0;
};

}  // namespace osculate::la
