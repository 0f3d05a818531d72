#include "osculate/la/nearby.hpp"

#include <Eigen/Sparse>
#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/IterativeSolvers>
#include <utility>
#include <vector>

namespace osculate::la {
namespace {

using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor, Index>;

/// K M^-1, M the matrix that was factored: its residual is the true one.
struct Operator {
  const Matrix& k;
  LinearSolver& factors;

  [[nodiscard]] Eigen::Index rows() const { return k.rows(); }
  /// Not a number where the factors do not solve.
  [[nodiscard]] Eigen::VectorXd preconditioned(const Eigen::VectorXd& y) const {
    Eigen::VectorXd x = y;
    if (factors.solve_once(x) != SolveStatus::ok) x.setConstant(std::nan(""));
    return x;
  }
  [[nodiscard]] Eigen::VectorXd operator*(const Eigen::VectorXd& y) const {
    return k * preconditioned(y);
  }
};

/// What Eigen asks of a preconditioner on the left.
struct NoPreconditioner {
  [[nodiscard]] static const Eigen::VectorXd& solve(const Eigen::VectorXd& b) { return b; }
};

Matrix whole_matrix(const SparseMatrix& k, Symmetry symmetry) {
  const Eigen::Map<const Matrix> stored(k.n, k.n, static_cast<Index>(k.value.size()),
                                        k.row_start.data(), k.column.data(), k.value.data());
  if (symmetry == Symmetry::unsymmetric) return stored;
  return Matrix(Matrix(stored).selfadjointView<Eigen::Upper>());
}

}  // namespace

Nearby solve_nearby(const SparseMatrix& k, Symmetry symmetry, LinearSolver& factors,
                    const NearbyLimits& limits, Eigen::VectorXd& rhs_in_solution_out) {
  const Eigen::VectorXd& b = rhs_in_solution_out;
  if (k.n == 0 || limits.iterations < 1 || b.size() != k.n || !b.allFinite()) return {};
  const Matrix a = whole_matrix(k, symmetry);
  const Operator by_factors{a, factors};
  Eigen::VectorXd y = Eigen::VectorXd::Zero(k.n);
  const Eigen::Index most = std::min<Eigen::Index>(limits.iterations, k.n);
  Eigen::Index iterations = most;
  double residual = limits.tolerance;
  Eigen::internal::gmres(by_factors, b, y, NoPreconditioner{}, iterations, most, residual);
  Nearby result;
  result.iterations = static_cast<int>(iterations);
  Eigen::VectorXd x = by_factors.preconditioned(y);
  if (!x.allFinite()) return result;
  constexpr double rounding = 1 + 1e-6;
  result.solved = (b - a * x).stableNorm() <= rounding * limits.tolerance * b.stableNorm();
  if (result.solved) rhs_in_solution_out = std::move(x);
  return result;
}

int affordable_iterations(const FactorReport& factors, const SparseMatrix& k) {
  constexpr double per_operation = 1.0 / 8e9, per_factor_entry = 3e-9, per_entry = 1.2e-9,
                   share = 0.5, most = 40;
  if (!(factors.operations > 0)) return 0;
  const auto entries = static_cast<double>(factors.factor_entries);
  const double whole = factors.operations * per_operation + entries * per_factor_entry;
  const double iteration = per_entry * (entries + static_cast<double>(k.value.size()));
  return static_cast<int>(std::min(most, share * whole / iteration));
}

}  // namespace osculate::la
