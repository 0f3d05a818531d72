#include "osculate/core/dense.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace osculate::core {

Spectrum spectrum(const DenseView& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(matrix);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

Eigen::VectorXd eigenvalues(const DenseView& matrix) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly)
      .eigenvalues();
}

bool eigenvalues_below(const DenseView& matrix, double limit) {
  Eigen::MatrixXd rest = -matrix;
  rest.diagonal().array() += limit;
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factors(rest);
  return factors.info() == Eigen::Success;
}

SingularValues singular_values(const DenseView& matrix) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {svd.matrixU(), svd.singularValues(), svd.matrixV()};
}

Eigen::MatrixXd least_squares(const DenseView& matrix, const DenseView& right) {
  return Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(matrix).solve(right);
}

}  // namespace osculate::core
