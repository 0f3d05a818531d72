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

/// What Eigen's solvers ask of a preconditioner.
class ByFactors {
 public:
  void use(LinearSolver& factors) { factors_ = &factors; }
  template <class AnyMatrix>
  ByFactors& analyzePattern(const AnyMatrix& /*k*/) {
    return *this;
  }
  template <class AnyMatrix>
  ByFactors& factorize(const AnyMatrix& /*k*/) {
    return *this;
  }
  template <class AnyMatrix>
  ByFactors& compute(const AnyMatrix& /*k*/) {
    return *this;
  }
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& b) const {
    Eigen::VectorXd x = b;
    if (factors_->solve(x) != SolveStatus::ok) x.setConstant(std::nan(""));
    return x;
  }
  [[nodiscard]] static Eigen::ComputationInfo info() { return Eigen::Success; }

 private:
  LinearSolver* factors_ = nullptr;
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
  constexpr double below = 0.1;
  const Eigen::VectorXd& b = rhs_in_solution_out;
  if (k.n == 0 || limits.iterations < 1 || b.size() != k.n || !b.allFinite()) return {};
  const Matrix a = whole_matrix(k, symmetry);
  Eigen::GMRES<Matrix, ByFactors> gmres;
  gmres.preconditioner().use(factors);
  gmres.setMaxIterations(limits.iterations);
  gmres.set_restart(std::min<Eigen::Index>(limits.iterations, k.n - 1));
  gmres.setTolerance(below * limits.tolerance);
  gmres.compute(a);
  Eigen::VectorXd x = gmres.solve(b);
  Nearby result;
  result.iterations = static_cast<int>(gmres.iterations());
  if (!x.allFinite()) return result;
  result.solved = (b - a * x).stableNorm() <= limits.tolerance * b.stableNorm();
  if (result.solved) rhs_in_solution_out = std::move(x);
  return result;
}

int affordable_iterations(const FactorReport& factors, const SparseMatrix& k) {
  constexpr double per_operation = 1.0 / 8e9, per_factor_entry = 3e-9, per_entry = 2e-9,
                   share = 0.5, most = 40;
  if (!(factors.operations > 0)) return 0;
  const auto entries = static_cast<double>(factors.factor_entries);
  const double whole = factors.operations * per_operation + entries * per_factor_entry;
  const double iteration = per_entry * (entries + static_cast<double>(k.value.size()));
  return static_cast<int>(std::min(most, share * whole / iteration));
}

}  // namespace osculate::la
