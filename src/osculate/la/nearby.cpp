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

namespace {

/// Rows of the transposed matrix.
SparseMatrix transposed(const SparseMatrix& k) {
  const auto at = [](Index i) { return static_cast<std::size_t>(i); };
  SparseMatrix out;
  out.n = k.n;
  out.row_start.assign(at(k.n) + 1, 0);
  for (const Index j : k.column) ++out.row_start[at(j) + 1];
  for (Index i = 0; i < k.n; ++i) out.row_start[at(i) + 1] += out.row_start[at(i)];
  std::vector<Index> next(out.row_start.begin(), out.row_start.end());
  out.column.resize(k.column.size());
  out.value.resize(k.value.size());
  for (Index i = 0; i < k.n; ++i)
    for (Index e = k.row_start[at(i)]; e < k.row_start[at(i) + 1]; ++e) {
      const Index to = next[at(k.column[at(e)])]++;
      out.column[at(to)] = i;
      out.value[at(to)] = k.value[at(e)];
    }
  return out;
}

/// (K + K^T) / 2, with the places of both.
SparseMatrix symmetric_part(const SparseMatrix& k) {
  const auto at = [](Index i) { return static_cast<std::size_t>(i); };
  const SparseMatrix across = transposed(k);
  SparseMatrix out;
  out.n = k.n;
  out.row_start.assign(1, 0);
  out.column.reserve(k.column.size());
  out.value.reserve(k.value.size());
  for (Index i = 0; i < k.n; ++i) {
    Index e = k.row_start[at(i)], f = across.row_start[at(i)];
    const Index end = k.row_start[at(i) + 1], last = across.row_start[at(i) + 1];
    while (e < end || f < last) {
      const Index own = e < end ? k.column[at(e)] : k.n;
      const Index other = f < last ? across.column[at(f)] : k.n;
      double sum = 0;
      if (own <= other) sum += k.value[at(e++)];
      if (other <= own) sum += across.value[at(f++)];
      out.column.push_back(std::min(own, other));
      out.value.push_back(0.5 * sum);
    }
    out.row_start.push_back(static_cast<Index>(out.column.size()));
  }
  return out;
}

}  // namespace

FactorReport factor_symmetric_part(const SparseMatrix& k, std::uint64_t pattern_version,
                                   LinearSolver& solver) {
  if (k.ranks) {  // the entries across are elsewhere
    FactorReport none;
    none.status = SolveStatus::failed;
    return none;
  }
  return solver.factor(symmetric_part(k), pattern_version, Symmetry::indefinite);
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
