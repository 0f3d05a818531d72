#include "osculate/la/dense_factors.hpp"

#include <cmath>

namespace osculate::la {

bool DenseFactors::factor(bool symmetric) {
  Eigen::MatrixXd& s = matrix_;
  symmetric_ = symmetric;
  scale_.resize(s.rows());
  Eigen::ArrayXd sizes = Eigen::ArrayXd::Zero(s.rows());
  for (Eigen::Index j = 0; j < s.cols(); ++j) sizes = sizes.max(s.col(j).array().abs());
  for (Eigen::Index i = 0; i < s.rows(); ++i) {
    if (!(sizes[i] > 0) || !std::isfinite(sizes[i])) return false;
    scale_[i] = 1 / std::sqrt(sizes[i]);
  }
  for (Eigen::Index j = 0; j < s.cols(); ++j)
    s.col(j).array() = scale_.array() * s.col(j).array() * scale_[j];
  Eigen::ArrayXd pivots;
  if (symmetric) {
    cholesky_.emplace(s);
    if (cholesky_->info() != Eigen::Success) return false;
    pivots = s.diagonal().array().square();
  } else {
    lu_.emplace(s);
    pivots = s.diagonal().array().abs();
  }
  ratio_ = pivots.minCoeff() / pivots.maxCoeff();
  return ratio_ > 0;
}

void DenseFactors::solve(Eigen::MatrixXd& b) const {
  b = scale_.asDiagonal() * b;
  if (symmetric_)
    cholesky_->solveInPlace(b);
  else
    b = lu_->solve(b);
  b = scale_.asDiagonal() * b;
}

}  // namespace osculate::la
