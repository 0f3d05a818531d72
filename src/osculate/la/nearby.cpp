#include "osculate/la/nearby.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace osculate::la {

namespace {

Eigen::VectorXd times(const SparseMatrix& k, Symmetry symmetry, const Eigen::VectorXd& x) {
  return symmetry == Symmetry::unsymmetric ? multiply(k, x) : multiply_symmetric(k, x);
}

/// What noise may leave of itself, and how long its answer may be.
constexpr double left_of_noise = 1e-5, far = 1e8;

/// Roots of the largest entries of the rows; 1 for an empty row, which resists nothing.
Eigen::VectorXd roots_of_rows(const SparseMatrix& k) {
  Eigen::VectorXd root = Eigen::VectorXd::Ones(k.n);
  for (Index i = 0; i < k.n; ++i) {
    double largest = 0;
    for (Index e = k.row_start[static_cast<std::size_t>(i)];
         e < k.row_start[static_cast<std::size_t>(i) + 1]; ++e)
      largest = std::max(largest, std::abs(k.value[static_cast<std::size_t>(e)]));
    if (largest > 0) root[i] = std::sqrt(largest);
    if (k.ranks && largest == 0) root[i] = 0;
  }
  if (k.ranks) {
    k.ranks->largest({root.data(), static_cast<std::size_t>(k.n)});
    for (double& r : root) r = r > 0 ? r : 1;
  }
  return root;
}

}  // namespace

NearbySolutions::NearbySolutions(const SparseMatrix& k, Symmetry symmetry, LinearSolver& factors)
    : k_(k),
      symmetry_(symmetry),
      by_([&k, symmetry](const Eigen::VectorXd& x,
                         Eigen::VectorXd& y) { y = times(k, symmetry, x); },
          [&factors](Eigen::VectorXd& r) { return factors.solve_once(r) == SolveStatus::ok; }),
      factors_(factors) {}

Nearby NearbySolutions::solve(const NearbyLimits& limits, Eigen::VectorXd& rhs_in_solution_out) {
  if (k_.n == 0 || limits.iterations < 1 || rhs_in_solution_out.size() != k_.n) return {};
  PreconditionedLimits all;
  all.tolerance = all.good_enough = limits.tolerance;
  all.iterations = limits.iterations;
  all.restart = std::numeric_limits<int>::max();
  return by_.solve(all, rhs_in_solution_out);
}

Nearby NearbySolutions::resists_all(int iterations) {
  constexpr double tightest = 1e-12;
  const Eigen::VectorXd root = roots_of_rows(k_);
  const Eigen::VectorXd given = noise(k_.n), force = given.cwiseProduct(root);
  const double size = given.stableNorm();
  Nearby result;
  // Soft bodies beside stiff ones have a small share of the residual: what counts is each by
  // itself.
  for (double aim = left_of_noise; aim >= tightest && !result.solved; aim *= 1e-2) {
    Eigen::VectorXd x = force;
    const Nearby more = solve({iterations - result.iterations, aim}, x);
    result.iterations += more.iterations;
    if (!more.solved) break;
    const double left = (force - times(k_, symmetry_, x)).cwiseQuotient(root).stableNorm();
    if (!(x.cwiseProduct(root).stableNorm() <= far * size)) break;
    result.solved = left <= left_of_noise * size;
  }
  return result;
}

Nearby NearbySolutions::is_positive(int iterations) {
  const Eigen::VectorXd root = roots_of_rows(k_), given = noise(k_.n);
  const Eigen::VectorXd force = given.cwiseProduct(root);
  const double size = given.stableNorm(), wanted = left_of_noise * size;
  const auto out_of_balance = [&](const Eigen::VectorXd& r) {
    return r.cwiseQuotient(root).stableNorm();
  };
  Eigen::VectorXd x = Eigen::VectorXd::Zero(k_.n), r = force, p = x;
  double before = 1;
  Nearby result;
  while (out_of_balance(r) > wanted) {
    Eigen::VectorXd z = r;
    if (result.iterations == iterations) return result;
    ++result.iterations;
    if (factors_.solve_once(z) != SolveStatus::ok) return result;
    const double now = r.dot(z);
    p = z + (now / before) * p;
    const Eigen::VectorXd image = times(k_, symmetry_, p);
    const double work = p.dot(image);
    if (!(now > 0 && work > 0) || !std::isfinite(now / work)) return result;
    x += (now / work) * p;
    r -= (now / work) * image;
    before = now;
  }
  const double left = out_of_balance(force - times(k_, symmetry_, x));
  result.solved = left <= 2 * wanted && x.cwiseProduct(root).stableNorm() <= far * size;
  return result;
}

Nearby solve_nearby(const SparseMatrix& k, Symmetry symmetry, LinearSolver& factors,
                    const NearbyLimits& limits, Eigen::VectorXd& rhs_in_solution_out) {
  return NearbySolutions(k, symmetry, factors).solve(limits, rhs_in_solution_out);
}

FactorReport factor_symmetric_part(const SparseMatrix& k, std::uint64_t pattern_version,
                                   LinearSolver& solver) {
  if (k.ranks) {  // the entries across are elsewhere
    FactorReport none;
    none.status = SolveStatus::failed;
    return none;
  }
  SparseMatrix half = k;  // only its upper triangle counts
  half.mark.reset();
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
  constexpr double per_operation = 1.0 / 16e9, per_factor_entry = 9e-9, per_entry = 25e-9;
  constexpr double per_unknown = 5e-8, near = 0.45e-9, far = 1.2e-9, cached = 1.5e6, most = 40;
  constexpr double fewest = 10'000;
  if (!(factors.operations > 0)) return 0;
  const auto in_factors = static_cast<double>(factors.factor_entries);
  const double in_matrix = entry_count(k);
  if (in_matrix < fewest) return 0;
  const double entries = in_factors + in_matrix;
  const double whole =
      factors.operations * per_operation + in_factors * per_factor_entry + in_matrix * per_entry;
  const double iteration = per_unknown * static_cast<double>(k.n) +
                           near * std::min(entries, cached) + far * std::max(entries - cached, 0.0);
  return static_cast<int>(std::min(most, whole / iteration));
}

}  // namespace osculate::la
