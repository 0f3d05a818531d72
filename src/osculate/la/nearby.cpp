#include "osculate/la/nearby.hpp"

#include <algorithm>
#include <vector>

#include "osculate/la/preconditioned.hpp"

namespace osculate::la {

Nearby solve_nearby(const SparseMatrix& k, Symmetry symmetry, LinearSolver& factors,
                    const NearbyLimits& limits, Eigen::VectorXd& rhs_in_solution_out) {
  if (k.n == 0 || limits.iterations < 1 || rhs_in_solution_out.size() != k.n) return {};
  PreconditionedLimits once;
  once.tolerance = once.good_enough = limits.tolerance;
  once.iterations = once.restart = limits.iterations;
  return solve_preconditioned(
      [&](const Eigen::VectorXd& x, Eigen::VectorXd& y) {
        y = symmetry == Symmetry::unsymmetric ? multiply(k, x) : multiply_symmetric(k, x);
      },
      [&factors](Eigen::VectorXd& x) { return factors.solve_once(x) == SolveStatus::ok; }, once,
      rhs_in_solution_out);
}

FactorReport factor_symmetric_part(const SparseMatrix& k, std::uint64_t pattern_version,
                                   LinearSolver& solver) {
  SparseMatrix half = k;  // only its upper triangle counts
  const auto at = [](Index i) { return static_cast<std::size_t>(i); };
  std::vector<Index> next(k.row_start.begin(), k.row_start.end());  // of each row's columns
  for (Index i = 0; i < k.n; ++i)
    for (Index e = next[at(i)]; e < k.row_start[at(i) + 1]; ++e) {
      const Index j = k.column[at(e)];
      Index& opposite = next[at(j)];
      while (opposite < k.row_start[at(j) + 1] && k.column[at(opposite)] < i) ++opposite;
      const bool there = opposite < k.row_start[at(j) + 1] && k.column[at(opposite)] == i;
      half.value[at(e)] = 0.5 * (k.value[at(e)] + (there ? k.value[at(opposite)] : 0));
    }
  return solver.factor(half, pattern_version, Symmetry::indefinite);
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
