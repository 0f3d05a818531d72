#include "osculate/la/eigenpairs.hpp"

#include <Spectra/SymGEigsShiftSolver.h>
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "osculate/la/spectra_matrix.hpp"

namespace osculate::la {
namespace {

/// M x. Spectra asks twice in a row for that of one vector: a norm, then products with others.
struct Mass {
  using Scalar = double;
  const Sparse& m;
  mutable Eigen::VectorXd last, of_last;
  [[nodiscard]] Eigen::Index rows() const { return m.rows(); }
  [[nodiscard]] Eigen::Index cols() const { return m.cols(); }
  void perform_op(const double* in, double* out) const {
    const Eigen::Map<const Eigen::VectorXd> x(in, m.rows());
    if (last.size() == 0 || last != x) {
      last = x;
      of_last = m * x;
    }
    Eigen::Map<Eigen::VectorXd>(out, m.rows()) = of_last;
  }
};

/// Something small beside the largest eigenvalue; 1 where nothing has a mass.
double small_part(const Sparse& k, const Sparse& m) {
  constexpr double share = 1e-6;
  double largest = 0;
  const Eigen::VectorXd dk = k.diagonal(), dm = m.diagonal();
  for (Eigen::Index i = 0; i < dk.size(); ++i)
    if (dm[i] > 0) largest = std::max(largest, std::abs(dk[i]) / dm[i]);
  return largest > 0 ? share * largest : 1;
}

/// Where the entries of M are among those of K.
std::vector<std::size_t> places_within(const Sparse& k, const Sparse& m) {
  std::vector<std::size_t> places;
  places.reserve(static_cast<std::size_t>(m.nonZeros()));
  for (Index row = 0; row < m.outerSize(); ++row) {
    Index at = k.outerIndexPtr()[row];
    for (Sparse::InnerIterator it(m, row); it; ++it) {
      while (k.innerIndexPtr()[at] != it.col()) ++at;
      assert(at < k.outerIndexPtr()[row + 1]);
      places.push_back(static_cast<std::size_t>(at));
    }
  }
  return places;
}

struct Problem {
  Sparse k, m;
  LinearSolver& solver;
  Eigen::Index with_mass = 0;  ///< unknowns that have one
  std::uint64_t version = 1;
  SparseMatrix shifted = plain(k);  ///< K - s M, the last one factored
  std::vector<std::size_t> place = places_within(k, m);
  bool corrected = true;  ///< solutions by the residual: not where they have all digits without
  /// Of a shift below all eigenvalues, by the signs of the pivots there.
  double below_all = -std::numeric_limits<double>::infinity();

  /// Factors K - shift M.
  FactorReport factor(double shift) {
    corrected = true;
    std::copy_n(k.valuePtr(), k.nonZeros(), shifted.value.begin());
    for (std::size_t e = 0; e < place.size(); ++e)
      shifted.value[place[e]] -= shift * m.valuePtr()[e];
    FactorReport report = solver.factor(shifted, version, Symmetry::indefinite);
    if (report.status == SolveStatus::ok && report.negative_pivots == 0)
      below_all = std::max(below_all, shift);
    return report;
  }
  bool solve(Eigen::VectorXd& x) {
    return (corrected ? solver.solve(x) : solver.solve_once(x)) == SolveStatus::ok;
  }
  /// As solve, the first one with these factors, of a right-hand side as smooth as the solutions
  /// that lose most digits: what it does not need the others are spared.
  bool solve_first(Eigen::VectorXd& x) {
    constexpr double all_digits = 1e-12;
    const Eigen::VectorXd b = x;
    corrected = solver.solve_once(x) != SolveStatus::ok ||
                !((multiply_symmetric(shifted, x) - b).norm() <= all_digits * b.norm());
    if (!corrected) return true;
    x = b;
    return solve(x);
  }
  [[nodiscard]] double small_shift() const { return small_part(k, m); }
};

/// (K - s M)^-1 as Spectra wants to see it, factored.
struct Inverse {
  using Scalar = double;
  Problem& p;
  bool& failed;
  [[nodiscard]] Eigen::Index rows() const { return p.k.rows(); }
  [[nodiscard]] Eigen::Index cols() const { return p.k.rows(); }
  void set_shift(double) {}  // it is in the factors
  void perform_op(const double* in, double* out) const {
    Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(in, rows());
    if (!p.solve(x)) failed = true;
    if (failed) x.setZero();
    Eigen::Map<Eigen::VectorXd>(out, rows()) = x;
  }
};

/// Whether the factors of K are those of a matrix that is not singular but for rounding.
bool solves(Problem& p) {
  constexpr double exact = 1e-6;
  Eigen::VectorXd b(p.k.rows());
  for (Eigen::Index i = 0; i < b.size(); ++i) b[i] = std::cos(0.9 * static_cast<double>(i));
  b = (p.m * b).eval();
  Eigen::VectorXd x = b;
  return p.solver.solve(x) == SolveStatus::ok && x.allFinite() &&
         (p.k * x - b).norm() <= exact * b.norm();
}

/// Smallest first, as they nearly are.
void sort(Eigenpairs& pairs) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(pairs.values.size()));
  std::iota(order.begin(), order.end(), 0);
  const auto value = [&](Eigen::Index i) { return pairs.values[i]; };
  if (std::ranges::is_sorted(order, {}, value)) return;
  std::ranges::stable_sort(order, {}, value);
  pairs.values = pairs.values(order).eval();
  pairs.vectors = pairs.vectors(Eigen::all, order).eval();
}

/// Vectors of the space in which M is not zero, normalised; and how good they are. Values that
/// cannot be told from 0 are 0. Beside vectors without stiffness Lanczos' method loses half of the
/// digits of others: where rounding does not explain that a value is not v . K v it is that.
void clean(Problem& p, Eigenpairs& pairs) {
  const Sparse sizes = p.k.cwiseAbs();
  for (Eigen::Index i = 0; i < pairs.values.size(); ++i) {
    Eigen::VectorXd v = p.m * pairs.vectors.col(i);
    p.solve(v);
    Eigen::VectorXd mv = p.m * v;
    const double norm = std::sqrt(v.dot(mv));
    v /= norm;
    mv /= norm;
    const Eigen::VectorXd kv = p.k * v, most = sizes * v.cwiseAbs();
    const double rounding = 4 * std::numeric_limits<double>::epsilon() * v.cwiseAbs().dot(most);
    pairs.rounding = std::max(pairs.rounding, rounding);
    const double quotient = v.dot(kv);
    const bool free = std::abs(quotient) <= rounding;
    if (free)
      pairs.values[i] = 0;
    else if (std::abs(quotient - pairs.values[i]) > rounding)
      pairs.values[i] = quotient;
    const double off = (kv - pairs.values[i] * mv).norm(),
                 scale = free ? most.norm()
                              : (std::abs(pairs.values[i]) + std::abs(pairs.shift)) * mv.norm();
    if (!(off == 0 || off <= pairs.residual * scale)) pairs.residual = off / scale;
    pairs.vectors.col(i) = v;
  }
  sort(pairs);
}

/// Eigenvalues up to the last one of the first `wanted` that are not there.
int count_missing(Problem& p, const Eigenpairs& pairs, Eigen::Index wanted) {
  constexpr double share = 1e-6, far = 1e3;
  const double last = pairs.values[std::min(wanted, pairs.values.size()) - 1],
               first = pairs.values[0];
  const double above = share * (std::abs(last) + std::abs(pairs.shift));
  // Rows without mass are in balance at once: their pivots do not depend on the shift.
  const double below = far * (std::abs(first) + std::abs(pairs.shift) + pairs.rounding);
  FactorReport without;  // none where that is below a shift that is below all
  if (first - below > p.below_all) without = p.factor(first - below);
  if (without.status == SolveStatus::failed) return -1;
  // The signs of pivots next to an eigenvalue are those of rounding: one that was found is below.
  int missing = -1;
  for (double times = 10; missing < 0 && times <= 1e3; times *= 10) {
    const double cut = last + std::max(above, times * pairs.rounding);
    const FactorReport with = p.factor(cut);
    if (with.status == SolveStatus::failed) return -1;
    const auto found = static_cast<int>((pairs.values.array() <= cut).count());
    missing = with.negative_pivots - without.negative_pivots - found;
  }
  return std::max(missing, -1);
}

Eigenpairs found_around(Problem& p, double shift, Eigen::Index count) {
  Eigenpairs pairs;
  pairs.shift = shift;
  const Eigen::Index n = p.k.rows();
  bool failed = false;
  Inverse inverse{p, failed};
  Mass mass{p.m, {}, {}};
  const Eigen::Index space = std::min(p.with_mass, std::max(2 * count + 1, count + 20));
  Spectra::SymGEigsShiftSolver<Inverse, Mass, Spectra::GEigsMode::ShiftInvert> lanczos(
      inverse, mass, count, space, shift);
  // It starts in the space where M is not zero.
  Eigen::VectorXd start(n);
  for (Eigen::Index i = 0; i < n; ++i) start[i] = 1 + 0.5 * std::sin(1.7 * static_cast<double>(i));
  start = p.m * start;
  if (!p.solve_first(start) || !(start.norm() > 0)) {
    pairs.failure = "the stiffness cannot be solved for";
    return pairs;
  }
  constexpr int most = 1000;
  constexpr double tolerance = 1e-11;
  try {
    lanczos.init(start.data());
    lanczos.compute(Spectra::SortRule::LargestMagn, most, tolerance,
                    Spectra::SortRule::SmallestAlge);
  } catch (const std::runtime_error&) {  // values of its small problem too far apart
    failed = true;
  }
  if (failed || lanczos.info() != Spectra::CompInfo::Successful) {
    pairs.failure = "Lanczos' method did not converge";
    return pairs;
  }
  pairs.values = lanczos.eigenvalues();
  pairs.vectors = lanczos.eigenvectors();
  clean(p, pairs);
  return pairs;
}

/// All there are, where few unknowns have a mass.
///
/// Formula    M = F F^T ,  (F^T (K - s M)^-1 F) z = z / (lambda - s) ,
///            v = (lambda - s) (K - s M)^-1 F z
Eigenpairs all_around(Problem& p, double shift, Eigen::Index count) {
  Eigenpairs pairs;
  pairs.shift = shift;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> of_mass{Eigen::MatrixXd(p.m)};
  const Eigen::VectorXd& d = of_mass.eigenvalues();
  constexpr double rounding = 1e-12;
  const Eigen::Index rank = (d.array() > rounding * d.maxCoeff()).count();
  const Eigen::MatrixXd f =
      of_mass.eigenvectors().rightCols(rank) * d.tail(rank).cwiseSqrt().asDiagonal();
  Eigen::MatrixXd x = f;
  if (p.solver.solve(x) != SolveStatus::ok) {
    pairs.failure = "the stiffness cannot be solved for";
    return pairs;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> flexible{Eigen::MatrixXd(f.transpose() * x)};
  // What multipliers hold has none.
  const double stiffest = flexible.eigenvalues().cwiseAbs().maxCoeff();
  std::vector<std::pair<double, Eigen::Index>> order;
  for (Eigen::Index i = 0; i < rank; ++i)
    if (const double theta = flexible.eigenvalues()[i]; std::abs(theta) > rounding * stiffest)
      order.emplace_back(shift + 1 / theta, i);
  std::sort(order.begin(), order.end());
  const Eigen::Index n = std::min(count, static_cast<Eigen::Index>(order.size()));
  pairs.values.resize(n);
  pairs.vectors.resize(p.k.rows(), n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& [value, at] = order[static_cast<std::size_t>(i)];
    pairs.values[i] = value;
    pairs.vectors.col(i) = (value - shift) * (x * flexible.eigenvectors().col(at));
  }
  if (n > 0) clean(p, pairs);
  return pairs;
}

/// Whether it did not come to its end, or some that it found are no vibrations.
bool are_none(const Eigenpairs& pairs) {
  constexpr double no_vibration = 1e-3;
  return !pairs.failure.empty() || !(pairs.residual <= no_vibration);
}

/// Around the shift; below 0 where the inverse of K, which is nearly singular, sees little else.
Eigenpairs found_from(Problem& p, double& shift, Eigen::Index count) {
  Eigenpairs pairs = found_around(p, shift, count);
  if (shift != 0 || !(are_none(pairs) || pairs.without_stiffness() > 0)) return pairs;
  shift = -p.small_shift();
  if (p.factor(shift).status == SolveStatus::failed) return pairs;
  return found_around(p, shift, count);
}

/// Of symmetric matrices whose values are of about 1.
Eigenpairs smallest_of(Problem p, int count) {
  Eigenpairs none;
  const Eigen::VectorXd diagonal = p.m.diagonal();
  for (Eigen::Index i = 0; i < diagonal.size(); ++i) p.with_mass += diagonal[i] > 0 ? 1 : 0;
  constexpr Eigen::Index few = 40;  // Lanczos' method needs some more than are wanted
  const bool all_of_them = count >= p.with_mass && p.k.rows() <= few;
  const Eigen::Index wanted =
      std::min<Eigen::Index>(count, all_of_them ? p.with_mass : p.with_mass - 1);
  if (wanted < 1) {
    none.failure = fmt::format("{} unknowns have a mass: too few", p.with_mass);
    return none;
  }
  double shift = 0;
  FactorReport report = p.factor(shift);
  if (report.status != SolveStatus::ok || !solves(p)) {
    shift = -p.small_shift();
    report = p.factor(shift);
  }
  if (report.status == SolveStatus::failed) {
    none.failure = report.message;
    return none;
  }
  if (all_of_them) return all_around(p, shift, wanted);
  constexpr int tries = 3;
  constexpr double no_digit = 0.1;
  const double first = shift;
  Eigenpairs pairs;
  // Of equal ones Lanczos' method finds one alone at first: with one more there is time for both.
  Eigen::Index more = std::min(wanted + 1, p.with_mass - 1);
  for (int i = 0; i < tries; ++i) {
    pairs = found_from(p, shift, more);
    // Where masses act on fewer motions than unknowns it may be one too many.
    if (i == 0 && more > wanted && are_none(pairs)) {
      more = wanted;
      shift = first;
      if (p.factor(shift).status == SolveStatus::failed) break;
      pairs = found_from(p, shift, more);
    }
    if (!pairs.failure.empty()) return pairs;
    if (!(pairs.residual <= no_digit)) {
      pairs.failure = fmt::format(
          "what was found is none (residual {:.0e}): the masses move in fewer ways than are asked "
          "for",
          pairs.residual);
      return pairs;
    }
    pairs.missing = count_missing(p, pairs, wanted);
    if (pairs.missing <= 0 || more + pairs.missing >= p.with_mass) break;
    more += pairs.missing;
    if (p.factor(shift).status == SolveStatus::failed) break;
  }
  if (pairs.values.size() > wanted) {
    pairs.values.conservativeResize(wanted);
    pairs.vectors.conservativeResize(Eigen::NoChange, wanted);
  }
  return pairs;
}

/// Values of about 1, where they are large: Lanczos' method takes what is very small for zero, and
/// equal ones for one.
Eigenpairs smallest_scaled(Sparse k, Sparse m, int count, LinearSolver& solver) {
  const double unit = std::max(1.0, small_part(k, m));
  m *= unit;
  // Masses of nodes are the same in all directions: the pattern has three times as many places.
  m.prune([](Eigen::Index, Eigen::Index, double value) { return value != 0; });
  k = Sparse(k + 0 * m);  // has all places of M
  Eigenpairs pairs = smallest_of({std::move(k), std::move(m), solver}, count);
  if (!pairs.failure.empty()) return pairs;
  pairs.values *= unit;
  pairs.shift *= unit;
  pairs.rounding *= unit;
  pairs.vectors *= std::sqrt(unit);
  return pairs;
}

}  // namespace

Eigenpairs smallest_eigenpairs(const SparseMatrix& k, const SparseMatrix& m, int count,
                               LinearSolver& solver) {
  const Sparse all = sparse(k);
  return smallest_scaled(0.5 * (all + Sparse(all.transpose())), sparse(m), count, solver);
}

namespace {

/// K for the real and for the imaginary part.
Sparse twice(const Sparse& a) {
  std::vector<Eigen::Triplet<double, Index>> entries;
  const auto n = static_cast<Index>(a.rows());
  for (Index row = 0; row < n; ++row)
    for (Sparse::InnerIterator it(a, row); it; ++it)
      for (const Index part : {0, n})
        entries.emplace_back(part + row, part + static_cast<Index>(it.col()), it.value());
  Sparse out(2 * n, 2 * n);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

Sparse transformation(std::span<const ComplexEntry> t, Index rows, Index columns, bool real) {
  std::vector<Eigen::Triplet<double, Index>> entries;
  for (const ComplexEntry& e : t) {
    entries.emplace_back(e.row, e.column, e.value.real());
    if (real) continue;
    entries.emplace_back(rows + e.row, columns + e.column, e.value.real());
    if (e.value.imag() == 0) continue;
    entries.emplace_back(rows + e.row, e.column, e.value.imag());
    entries.emplace_back(e.row, columns + e.column, -e.value.imag());
  }
  const Index parts = real ? 1 : 2;
  Sparse out(parts * rows, parts * columns);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

/// Both vectors of each pair, as many as are wanted: Lanczos' method may have found one alone.
void complete_pairs(const Sparse& m, Eigen::Index wanted, Eigenpairs& pairs) {
  const Eigen::Index n = pairs.vectors.rows() / 2, found = pairs.values.size();
  Eigen::MatrixXd all(2 * n, 2 * found), all_m(2 * n, 2 * found);
  std::vector<double> values;
  constexpr double new_one = 0.1;
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < found; ++i) {
    Eigen::VectorXd v = pairs.vectors.col(i);
    for (int again = 0; again < 2; ++again)
      v -= all.leftCols(count) * (all_m.leftCols(count).transpose() * v);
    const double norm = std::sqrt(std::max(0.0, v.dot(m * v)));
    if (norm < new_one) continue;
    v /= norm;
    Eigen::VectorXd turned(2 * n);  // i v
    turned << -v.tail(n), v.head(n);
    for (const Eigen::VectorXd& one : {v, turned}) {
      all.col(count) = one;
      all_m.col(count++) = m * one;
      values.push_back(pairs.values[i]);
    }
  }
  if (pairs.missing > 0)
    pairs.missing = std::max(0, pairs.missing - static_cast<int>(count - found));
  const Eigen::Index kept = std::min(wanted, count);
  pairs.vectors = all.leftCols(kept);
  pairs.values = Eigen::Map<const Eigen::VectorXd>(values.data(), kept);
}

}  // namespace

Eigenpairs smallest_eigenpairs(const SparseMatrix& k, const SparseMatrix& m,
                               std::span<const ComplexEntry> t, Index columns, int count,
                               LinearSolver& solver) {
  const bool real =
      std::ranges::all_of(t, [](const ComplexEntry& e) { return e.value.imag() == 0; });
  const Sparse by = transformation(t, k.n, columns, real);
  const Sparse transposed = by.transpose();
  const auto reduced = [&](const SparseMatrix& of) {
    const Sparse one = sparse(of);
    const Sparse all = real ? one : twice(one);
    const Sparse half = all * by;
    return Sparse(transposed * half);
  };
  const Sparse stiffness = reduced(k), mass = reduced(m);
  Eigenpairs pairs = smallest_eigenpairs(plain(stiffness), plain(mass), count, solver);
  if (!pairs.failure.empty()) return pairs;
  if (!real) complete_pairs(mass, count, pairs);
  pairs.vectors = (by * pairs.vectors).eval();
  return pairs;
}

}  // namespace osculate::la
