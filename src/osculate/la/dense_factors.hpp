#pragma once
#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>

namespace osculate::la {

/// Factors of a full matrix, scaled by the square roots of the largest entries of its rows.
///
/// Tested by  tests/unit/la/test_condensed.cpp, test_eliminated.cpp
class DenseFactors {
 public:
  /// False: singular; of symmetric kinds also where it is not positive definite.
  bool factor(Eigen::MatrixXd s, bool symmetric);
  void solve(Eigen::MatrixXd& b) const;
  /// Smallest pivot beside the largest one.
  [[nodiscard]] double pivot_ratio() const { return ratio_; }
  /// By row, the inverse of the square root of its largest entry.
  [[nodiscard]] const Eigen::VectorXd& scale() const { return scale_; }

 private:
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
  Eigen::LLT<Eigen::MatrixXd> cholesky_;
  Eigen::VectorXd scale_;
  bool symmetric_ = false;
  double ratio_ = 0;
};

}  // namespace osculate::la
