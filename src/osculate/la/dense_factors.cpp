#include "osculate/la/dense_factors.hpp"

#include <cmath>
#include <utility>

namespace osculate::la {

bool DenseFactors::factor(Eigen::MatrixXd s, bool symmetric) {
  symmetric_ = symmetric;
  scale_.resize(s.rows());
  Eigen::ArrayXd sizes = Eigen::ArrayXd::Zero(s.rows());
  for (Eigen::Index j = 0; j < s.cols(); ++j) sizes = sizes.max(s.col(j).array().abs());
  for (Eigen::Index i = 0; i < s.rows(); ++i) {
    if (!(sizes[i] > 0) || !std::isfinite(sizes[i])) return false;
    scale_[i] = 1 / std::sqrt(sizes[i]);
  }
  s = scale_.asDiagonal() * s * scale_.asDiagonal();
  Eigen::ArrayXd pivots;
  if (symmetric) {
    cholesky_.compute(s);
    if (cholesky_.info() != Eigen::Success) return false;
    pivots = cholesky_.matrixLLT().diagonal().array().square();
  } else {
    lu_.compute(s);
    pivots = lu_.matrixLU().diagonal().array().abs();
  }
  ratio_ = pivots.minCoeff() / pivots.maxCoeff();
  return ratio_ > 0;
}

void DenseFactors::solve(Eigen::MatrixXd& b) const {
  b = scale_.asDiagonal() * b;
  if (symmetric_)
    cholesky_.solveInPlace(b);
  else
    b = lu_.solve(b);
  b = scale_.asDiagonal() * b;
}

}  // namespace osculate::la
