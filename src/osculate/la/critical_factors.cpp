#include "osculate/la/critical_factors.hpp"

#include <Spectra/SymGEigsSolver.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "osculate/la/spectra_matrix.hpp"

namespace osculate::la {
namespace {

/// Eigenvalues 1 / lambda below it, over the largest one in size, are those of what has no stress.
constexpr double unloaded = 1e-11;
/// Of Lanczos' method: for what is wanted, and for what is only told of where it is found.
constexpr int restarts = 100, few_restarts = 10;

struct Pencil {
  Sparse k, a, own;
  LinearSolver& solver;
  std::uint64_t version = 1;

  FactorReport factor(double s) {
    const Sparse shifted = k + s * a;
    return solver.factor(plain(shifted), version, Symmetry::indefinite);
  }
};

/// -A.
struct Loosening {
  using Scalar = double;
  const Sparse& a;
  [[nodiscard]] Eigen::Index rows() const { return a.rows(); }
  [[nodiscard]] Eigen::Index cols() const { return a.cols(); }
  void perform_op(const double* in, double* out) const {
    Eigen::Map<Eigen::VectorXd>(out, a.rows()) =
        -(a * Eigen::Map<const Eigen::VectorXd>(in, a.rows()));
  }
};

/// K, factored; its product is that of the unknowns that are no multipliers (`own`), which the
/// others have no part in: what they allow they do no work on.
struct Holding {
  using Scalar = double;
  const Sparse& k;
  const Sparse& own;
  LinearSolver& solver;
  bool& failed;
  [[nodiscard]] Eigen::Index rows() const { return k.rows(); }
  [[nodiscard]] Eigen::Index cols() const { return k.cols(); }
  void perform_op(const double* in, double* out) const {
    Eigen::Map<Eigen::VectorXd>(out, k.rows()) =
        own * Eigen::Map<const Eigen::VectorXd>(in, k.rows());
  }
  void solve(const double* in, double* out) const {
    Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(in, k.rows());
    if (solver.solve(x) != SolveStatus::ok) failed = true;
    if (failed) x.setZero();
    Eigen::Map<Eigen::VectorXd>(out, k.rows()) = x;
  }
};

/// Eigenvalues 1 / lambda, those of `rule` first, and their vectors.
struct Flexible {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
  bool ok = true;
};

Flexible by_lanczos(Pencil& p, Spectra::SortRule rule, Eigen::Index count, int most) {
  Flexible out;
  const Eigen::Index n = p.k.rows();
  bool failed = false;
  Loosening loosening{p.a};
  Holding holding{p.k, p.own, p.solver, failed};
  const Eigen::Index space = std::min(n, std::max(2 * count + 1, count + 20));
  Spectra::SymGEigsSolver<Loosening, Holding, Spectra::GEigsMode::RegularInverse> lanczos(
      loosening, holding, count, space);
  // It starts with what multipliers allow.
  Eigen::VectorXd start(n);
  for (Eigen::Index i = 0; i < n; ++i) start[i] = 1 + 0.5 * std::sin(1.7 * static_cast<double>(i));
  start = p.a * start;
  out.ok = p.solver.solve(start) == SolveStatus::ok && start.norm() > 0;
  if (!out.ok) return out;
  lanczos.init(start.data());
  constexpr double tolerance = 1e-11;
  try {
    lanczos.compute(rule, most, tolerance, rule);
  } catch (const std::runtime_error&) {  // of its own small problem
    failed = true;
  }
  out.ok = !failed;
  if (failed) return out;
  out.values = lanczos.eigenvalues();  // those that have converged
  out.vectors = lanczos.eigenvectors();
  return out;
}

/// All there are, where unknowns are few.
///
/// Formula    G = K^-1 on the unknowns that are no multipliers, G = L L^T ,
///            (L^T (-A) L) z = z / lambda , v = K^-1 (-A) L z lambda
Flexible all_at_once(Pencil& p, Eigen::Index displacements) {
  Flexible out;
  const Eigen::Index n = p.k.rows(), m = displacements;
  Eigen::MatrixXd g = Eigen::MatrixXd::Identity(n, m);
  out.ok = p.solver.solve(g) == SolveStatus::ok;
  if (!out.ok) return out;
  const Eigen::MatrixXd own = 0.5 * (g.topRows(m) + g.topRows(m).transpose());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> of_g{own};
  const Eigen::MatrixXd l =
      of_g.eigenvectors() * of_g.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
  const Eigen::MatrixXd loosened = -(Eigen::MatrixXd(p.a).topLeftCorner(m, m) * l);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> all{
      Eigen::MatrixXd(l.transpose() * loosened)};
  out.values = all.eigenvalues().reverse();
  out.vectors = g * (loosened * all.eigenvectors()).rowwise().reverse();
  return out;
}

/// What the rounding of K does to a factor, relative to it: |v| . |K| |v| / v . K v in its digits.
double round_off(const Sparse& k, const Eigen::VectorXd& v, double work) {
  double size = 0;
  for (Eigen::Index i = 0; i < k.outerSize(); ++i)
    for (Sparse::InnerIterator at(k, i); at; ++at)
      size += std::abs(v[at.row()] * at.value() * v[at.col()]);
  return std::numeric_limits<double>::epsilon() * size / work;
}

/// Positive ones, at most so many, as factors with clean vectors. Returns their relative accuracy.
double take(Pencil& p, const Flexible& found, Eigen::Index count, CriticalFactors& out) {
  double accuracy = 0;
  const double largest = found.values.size() > 0 ? found.values.cwiseAbs().maxCoeff() : 0;
  std::vector<std::pair<double, Eigen::Index>> order;
  for (Eigen::Index i = 0; i < found.values.size(); ++i)
    if (found.values[i] > unloaded * largest) order.emplace_back(1 / found.values[i], i);
  std::sort(order.begin(), order.end());
  const Eigen::Index n = std::min(count, static_cast<Eigen::Index>(order.size()));
  out.values.resize(n);
  out.vectors.resize(p.k.rows(), n);
  out.residual = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& [value, at] = order[static_cast<std::size_t>(i)];
    Eigen::VectorXd v = p.a * found.vectors.col(at);
    if (p.solver.solve(v) != SolveStatus::ok) v = found.vectors.col(at);
    const Eigen::VectorXd kv = p.k * v;
    out.residual = std::max(out.residual, (kv + value * (p.a * v)).norm() / kv.norm());
    const double work = v.dot(kv);
    accuracy = std::max(accuracy, round_off(p.k, v, work));
    out.values[i] = value;
    out.vectors.col(i) = v / std::sqrt(work);
  }
  return accuracy;
}

/// Factors up to the last one that are not there.
int count_missing_factors(Pencil& p, const CriticalFactors& found, double accuracy,
                          int multipliers) {
  constexpr double least = 1e-6, most = 1e-2;
  const double above = std::clamp(100 * accuracy, least, most);
  const Eigen::Index n = found.values.size();
  const FactorReport beyond = p.factor((1 + above) * found.values[n - 1]);
  if (beyond.status == SolveStatus::failed) return -1;
  return beyond.negative_pivots - multipliers - static_cast<int>(n);
}

/// Negative pivots of a stable state: those of multipliers that hold something.
int pivots_of_multipliers(Pencil& p, int multipliers) {
  if (multipliers == 0) return 0;
  const Sparse k = p.k;
  constexpr double stiff = 1e3;
  for (Eigen::Index i = 0; i < k.rows() - multipliers; ++i)
    p.k.coeffRef(i, i) += stiff * std::abs(p.k.coeff(i, i));
  const FactorReport stiffer = p.factor(0);
  p.k = k;
  return stiffer.status == SolveStatus::failed ? -1 : stiffer.negative_pivots;
}

void find_reversed(Pencil& p, const Flexible& all, CriticalFactors& out) {
  Flexible found = all;
  if (all.values.size() == 0)
    found = by_lanczos(p, Spectra::SortRule::SmallestAlge, 1, few_restarts);
  if (!found.ok || found.values.size() == 0) return;
  const double least = found.values.minCoeff();
  const double largest =
      out.values.size() > 0 ? 1 / out.values[0] : std::numeric_limits<double>::min();
  if (least < -unloaded * std::max(largest, std::abs(least))) out.reversed = 1 / least;
}

}  // namespace

CriticalFactors critical_factors(const SparseMatrix& k, const SparseMatrix& a, int multipliers,
                                 int count, LinearSolver& solver) {
  const Sparse of_k = sparse(k), of_a = sparse(a);
  Pencil p{
      0.5 * (of_k + Sparse(of_k.transpose())), 0.5 * (of_a + Sparse(of_a.transpose())), {}, solver};
  p.own = p.k;
  const Eigen::Index last = p.k.rows() - multipliers;
  p.own.prune([&](Index row, Index column, double) { return row < last && column < last; });
  CriticalFactors out;
  const int holding = pivots_of_multipliers(p, multipliers);
  const FactorReport report = p.factor(0);
  if (report.status != SolveStatus::ok || holding < 0) {
    out.failure =
        report.status == SolveStatus::failed ? report.message : "something is free to move";
    return out;
  }
  if (report.negative_pivots != holding) {
    out.failure = "the state before is not stable itself";
    return out;
  }
  constexpr Eigen::Index few = 150;
  const Eigen::Index n = p.k.rows(), displacements = n - multipliers;
  Flexible all;
  if (n <= few) {
    all = all_at_once(p, displacements);
    if (all.ok) take(p, all, count, out);
    if (all.ok) find_reversed(p, all, out);
    if (!all.ok) out.failure = "the stiffness cannot be solved for";
    return out;
  }
  constexpr int tries = 3;
  Eigen::Index more = count;
  for (int i = 0; i < tries; ++i) {
    const Flexible found =
        by_lanczos(p, Spectra::SortRule::LargestAlge, std::min(more, n / 3), restarts);
    if (!found.ok) {
      out.failure = "Lanczos' method did not converge";
      return out;
    }
    const double accuracy = take(p, found, more, out);
    if (i == 0) find_reversed(p, {}, out);
    if (out.values.size() == 0) break;
    out.missing = count_missing_factors(p, out, accuracy, holding);
    if (p.factor(0).status == SolveStatus::failed || out.missing <= 0) break;
    more = out.values.size() + out.missing;
  }
  if (out.values.size() > count) {  // more of those that are nearly equal to the last one
    out.values.conservativeResize(count);
    out.vectors.conservativeResize(Eigen::NoChange, count);
  }
  return out;
}

}  // namespace osculate::la
