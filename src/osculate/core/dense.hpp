#pragma once
#include <Eigen/Core>

namespace osculate::core {

// Decompositions of small dense matrices, compiled once: each costs a compiler seconds in every
// source that uses it. Not for loops over points or cells: the results are allocated.

using DenseView = Eigen::Ref<const Eigen::MatrixXd>;

/// Eigenvalues, rising, and orthonormal eigenvectors, one a column. Requires: symmetric, finite.
struct Spectrum {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
[[nodiscard]] Spectrum spectrum(const DenseView& matrix);
[[nodiscard]] Eigen::VectorXd eigenvalues(const DenseView& matrix);
/// Whether all eigenvalues are below a limit, by Cholesky's factors of limit I - matrix: a tenth of
/// the work. Within rounding of the limit either answer.
[[nodiscard]] bool eigenvalues_below(const DenseView& matrix, double limit);

/// matrix = U diag(values) V^T with square U and V; values fall.
struct SingularValues {
  Eigen::MatrixXd u;
  Eigen::VectorXd values;
  Eigen::MatrixXd v;
};
[[nodiscard]] SingularValues singular_values(const DenseView& matrix);

/// X with the smallest |matrix X - right| in each column; of a square matrix its solution.
///
/// Tested by  tests/unit/core/test_dense.cpp
[[nodiscard]] Eigen::MatrixXd least_squares(const DenseView& matrix, const DenseView& right);

}  // namespace osculate::core
