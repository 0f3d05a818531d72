#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "osculate/core/dense.hpp"

namespace osculate::core {
namespace {

Eigen::MatrixXd sample(Eigen::Index rows, Eigen::Index columns) {
  Eigen::MatrixXd m(rows, columns);
  for (Eigen::Index i = 0; i < rows; ++i)
    for (Eigen::Index j = 0; j < columns; ++j)
      m(i, j) = std::sin(static_cast<double>((1 + i) * (2 + j)));
  return m;
}

TEST(Dense, ASpectrumGivesTheMatrixBack) {
  const Eigen::MatrixXd m = sample(5, 5), symmetric = m + m.transpose();
  const Spectrum s = spectrum(symmetric);
  EXPECT_LT((s.vectors * s.values.asDiagonal() * s.vectors.transpose() - symmetric).norm(), 1e-13);
  EXPECT_LT((s.vectors.transpose() * s.vectors - Eigen::MatrixXd::Identity(5, 5)).norm(), 1e-14);
  for (Eigen::Index i = 1; i < 5; ++i) EXPECT_LE(s.values[i - 1], s.values[i]);
  EXPECT_LT((eigenvalues(symmetric) - s.values).norm(), 1e-13);
}

TEST(Dense, EigenvaluesAreBelowWhatIsAboveTheLargest) {
  const Eigen::MatrixXd m = sample(6, 6), symmetric = m + m.transpose();
  const double largest = eigenvalues(symmetric).maxCoeff();
  EXPECT_TRUE(eigenvalues_below(symmetric, largest * (1 + 1e-12)));
  EXPECT_FALSE(eigenvalues_below(symmetric, largest * (1 - 1e-12)));
  EXPECT_FALSE(eigenvalues_below(symmetric, 0));
}

TEST(Dense, SingularValuesGiveTheMatrixBack) {
  const Eigen::MatrixXd m = sample(4, 4);
  const SingularValues s = singular_values(m);
  EXPECT_LT((s.u * s.values.asDiagonal() * s.v.transpose() - m).norm(), 1e-13);
  for (Eigen::Index i = 1; i < 4; ++i) EXPECT_GE(s.values[i - 1], s.values[i]);
}

TEST(Dense, LeastSquaresLeaveAResidualAcrossTheColumns) {
  const Eigen::MatrixXd m = sample(7, 3), right = sample(7, 5).rightCols(2);
  const Eigen::MatrixXd rest = m * least_squares(m, right) - right;
  EXPECT_GT(rest.norm(), 0.1);
  EXPECT_LT((m.transpose() * rest).norm(), 1e-13);
}

TEST(Dense, ASquareSystemIsSolved) {
  const Eigen::MatrixXd m = sample(4, 4), x = sample(4, 2);
  EXPECT_LT((least_squares(m, m * x) - x).norm(), 1e-12);
}

}  // namespace
}  // namespace osculate::core
