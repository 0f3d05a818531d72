#include "osculate/la/nearby.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "osculate/la/preconditioned.hpp"

namespace osculate::la {

Eigen::VectorXd NearbySolutions::times(const Eigen::VectorXd& x) const {
  return symmetry_ == Symmetry::unsymmetric ? multiply(k_, x) : multiply_symmetric(k_, x);
}

/// False: nothing new.
bool NearbySolutions::look_along(Eigen::VectorXd z) {
  constexpr double nothing = 1e-12;
  Eigen::VectorXd v = times(z);
  const double whole = v.norm();
  for (int twice = 0; twice < 2; ++twice)
    for (std::size_t j = 0; j < along_.size(); ++j) {
      const double part = image_[j].dot(v);
      v -= part * image_[j];
      z -= part * along_[j];
    }
  const double size = v.norm();
  if (!(size > nothing * whole) || !std::isfinite(size)) return false;
  image_.push_back(v / size);
  along_.push_back(z / size);
  return true;
}

Nearby NearbySolutions::solve(const NearbyLimits& limits, Eigen::VectorXd& rhs_in_solution_out) {
  const Eigen::VectorXd& b = rhs_in_solution_out;
  Nearby result;
  if (k_.n == 0 || limits.iterations < 1 || b.size() != k_.n || !b.allFinite()) return result;
  constexpr double rounding = 1 + 1e-6, hardly = 0.5;
  const double wanted = limits.tolerance * b.stableNorm();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(k_.n), rest = b;
  const auto take = [&](std::size_t j) {
    const double part = image_[j].dot(rest);
    x += part * along_[j];
    rest -= part * image_[j];
  };
  for (std::size_t j = 0; j < along_.size(); ++j) take(j);
  bool stagnates = false;
  for (double left = rest.stableNorm();; left = rest.stableNorm()) {
    if (left <= wanted) {  // as summed up: what does K say?
      rest = b - times(x);
      left = rest.stableNorm();
      result.solved = left <= rounding * wanted && x.allFinite();
      if (result.solved) break;
    }
    if (result.iterations == limits.iterations) return result;
    Eigen::VectorXd z = stagnates ? image_.back() : rest;
    ++result.iterations;
    if (factors_.solve_once(z) != SolveStatus::ok || !look_along(std::move(z))) return result;
    take(along_.size() - 1);
    stagnates = rest.stableNorm() > hardly * left;
  }
  rhs_in_solution_out = std::move(x);
  return result;
}

Nearby NearbySolutions::resists_all(int iterations) {
  constexpr double tolerance = 1e-5, tightest = 1e-12, far = 1e8;
  Eigen::VectorXd root = Eigen::VectorXd::Ones(k_.n);  // an empty row resists nothing
  for (Index i = 0; i < k_.n; ++i) {
    double largest = 0;
    for (Index e = k_.row_start[static_cast<std::size_t>(i)];
         e < k_.row_start[static_cast<std::size_t>(i) + 1]; ++e)
      largest = std::max(largest, std::abs(k_.value[static_cast<std::size_t>(e)]));
    if (largest > 0) root[i] = std::sqrt(largest);
    if (k_.ranks && largest == 0) root[i] = 0;
  }
  if (k_.ranks) {
    k_.ranks->largest({root.data(), static_cast<std::size_t>(k_.n)});
    for (double& r : root) r = r > 0 ? r : 1;
  }
  const Eigen::VectorXd given = noise(k_.n), force = given.cwiseProduct(root);
  const double size = given.stableNorm();
  Nearby result;
  // Soft bodies beside stiff ones have a small share of the residual: what counts is each by
  // itself.
  for (double aim = tolerance; aim >= tightest && !result.solved; aim *= 1e-2) {
    Eigen::VectorXd x = force;
    const Nearby more = solve({iterations - result.iterations, aim}, x);
    result.iterations += more.iterations;
    if (!more.solved) break;
    const double left = (force - times(x)).cwiseQuotient(root).stableNorm();
    if (!(x.cwiseProduct(root).stableNorm() <= far * size)) break;
    result.solved = left <= tolerance * size;
  }
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
