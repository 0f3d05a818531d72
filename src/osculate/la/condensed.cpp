#include "osculate/la/condensed.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "osculate/la/accuracy.hpp"
#include "osculate/la/dealt_mumps.hpp"
#include "osculate/la/dense_factors.hpp"
#include "osculate/la/eliminated.hpp"

namespace osculate::la {
namespace {

/// Square roots of the largest entries of rows and columns, 1 for empty ones.
Eigen::VectorXd scale_of(const SparseMatrix& k, bool symmetric) {
  Eigen::VectorXd scale = Eigen::VectorXd::Zero(k.n);
  for (Index i = 0; i < k.n; ++i)
    for (Index e = k.row_start[static_cast<std::size_t>(i)];
         e < k.row_start[static_cast<std::size_t>(i) + 1]; ++e) {
      const Index j = k.column[static_cast<std::size_t>(e)];
      if (symmetric && i > j) continue;
      const double size = std::abs(k.value[static_cast<std::size_t>(e)]);
      scale[i] = std::max(scale[i], size);
      scale[j] = std::max(scale[j], size);
    }
  for (double& s : scale) s = s > 0 ? std::sqrt(s) : 1.0;
  return scale;
}

/// A hash of what may change, C, and of the pattern outside of C x C, on which alone the operations
/// depend (FNV-1a by words). C is sorted, and below n.
std::uint64_t mark_of(const SparseMatrix& k, Symmetry symmetry, std::span<const Index> changing) {
  std::vector<bool> few(static_cast<std::size_t>(k.n));
  for (const Index i : changing) few[static_cast<std::size_t>(i)] = true;
  std::uint64_t mark = 14695981039346656037U;
  const auto add = [&](Index value) {
    mark = (mark ^ static_cast<std::uint32_t>(value)) * 1099511628211U;
  };
  add(static_cast<Index>(symmetry));
  add(k.n);
  for (const Index i : changing) add(i);
  for (Index i = 0; i < k.n; ++i) {
    add(-1 - i);
    const auto row = static_cast<std::size_t>(i);
    for (Index e = k.row_start[row]; e < k.row_start[row + 1]; ++e) {
      const Index j = k.column[static_cast<std::size_t>(e)];
      const bool inside = few[row] && few[static_cast<std::size_t>(j)];
      if (!inside && (symmetry == Symmetry::unsymmetric || i <= j)) add(j);
    }
  }
  return mark;
}

}  // namespace

struct Condensed::Impl {
  [[nodiscard]] Eigen::VectorXd multiplied(const Eigen::VectorXd& x) const {
    return symmetric ? multiply_symmetric(matrix, x) : multiply(matrix, x);
  }

  DealtMumps whole;
  SchurFactors inside;
  Eliminated few{inside};
  std::unique_ptr<DenseFactors> dense = std::make_unique<DenseFactors>();
  std::vector<Index> changing;
  std::uint64_t pattern = 0;   ///< of the last matrix that was asked about, as a hash
  std::uint64_t too_dear = 0;  ///< the one for which a dense matrix was dearer, or had no room
  bool condensed = false;      ///< the last factors
  SparseMatrix matrix;         ///< theirs, where condensed
  std::uint64_t version = 0;
  Symmetry symmetry = Symmetry::unsymmetric;
  bool symmetric = false;
  double seconds = 0;
  Count count;

  explicit Impl(MumpsOptions options) : whole(options), inside(options.blas_threads) {}
  ~Impl() = default;
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  [[nodiscard]] bool pays(const SparseMatrix& k, Symmetry symmetry);
  bool condense(const SparseMatrix& k, FactorReport& report);
  bool condense_where_it_fits(const SparseMatrix& k, FactorReport& report);
  void forget();
  FactorReport factor_whole(const SparseMatrix& k);
  [[nodiscard]] Eigen::MatrixXd small_matrix(const SparseMatrix& k) const;
  [[nodiscard]] bool accurate();
  bool substitute(Eigen::MatrixXd& x);
  bool substitute(Eigen::VectorXd& x);
  bool solve(const Eigen::MatrixXd& given, Eigen::MatrixXd& x);
};

/// A dense matrix of the few beside the sparse one of the many, in operations: a function of the
/// pattern alone. Where it is dearer no more is kept of the analysis than for which pattern.
bool Condensed::Impl::pays(const SparseMatrix& k, Symmetry symmetry) {
  constexpr double fewest = 4, worth_it = 3, most = 4000;  // 4000: a dense matrix of 128 MB
  const auto c = static_cast<double>(changing.size());
  if (k.ranks || changing.empty() || c > most || fewest * c > k.n || changing.back() >= k.n)
    return false;
  if (inside.is_of(k, symmetry, changing)) return true;
  pattern = mark_of(k, symmetry, changing);
  if (pattern == too_dear) {
    if (inside.analysed()) forget();
    return false;
  }
  if (!inside.analysed()) whole.forget();  // its factors serve no more, and are large
  const double dense_operations = (symmetric ? 1.0 : 2.0) / 3.0 * c * c * c;
  if (inside.analyse(k, symmetry, changing) && inside.operations() > worth_it * dense_operations)
    return true;
  forget();
  too_dear = pattern;
  return false;
}

Eigen::MatrixXd Condensed::Impl::small_matrix(const SparseMatrix& k) const {
  std::vector<Eigen::Index> place(static_cast<std::size_t>(k.n), -1);
  for (std::size_t a = 0; a < changing.size(); ++a)
    place[static_cast<std::size_t>(changing[a])] = static_cast<Eigen::Index>(a);
  Eigen::MatrixXd s = inside.complement();
  for (const Index i : changing)
    for (Index e = k.row_start[static_cast<std::size_t>(i)];
         e < k.row_start[static_cast<std::size_t>(i) + 1]; ++e) {
      const Index j = k.column[static_cast<std::size_t>(e)];
      if (place[static_cast<std::size_t>(j)] < 0 || (symmetric && i > j)) continue;
      const Eigen::Index a = place[static_cast<std::size_t>(i)];
      const Eigen::Index b = place[static_cast<std::size_t>(j)];
      s(a, b) += k.value[static_cast<std::size_t>(e)];
      if (symmetric && a != b) s(b, a) += k.value[static_cast<std::size_t>(e)];
    }
  return s;
}

bool Condensed::Impl::substitute(Eigen::MatrixXd& x) {
  Eigen::MatrixXd of_c;
  if (!inside.reduce(x, of_c)) return false;
  dense->solve(of_c);
  return inside.expand(of_c, x);
}

bool Condensed::Impl::substitute(Eigen::VectorXd& x) {
  Eigen::MatrixXd as_matrix = x;
  if (!substitute(as_matrix)) return false;
  x = as_matrix.col(0);
  return true;
}

/// At most half of the digits are lost: else Mumps looks at the whole.
bool Condensed::Impl::accurate() {
  constexpr double harmless = 1e-9, digits_left = 1e-6;
  if (inside.pivot_ratio() > harmless && dense->pivot_ratio() > harmless) return true;
  const double lost = lost_accuracy(
      scale_of(matrix, symmetric), [this](const Eigen::VectorXd& x) { return multiplied(x); },
      [this](Eigen::VectorXd& x) { return substitute(x); });
  return lost < digits_left;
}

/// False: Mumps is to do it.
bool Condensed::Impl::condense(const SparseMatrix& k, FactorReport& report) {
  const int before = inside.count();
  if (!inside.factor(k)) return false;
  dense->matrix() = small_matrix(k);
  if (!dense->factor(symmetric)) return false;
  matrix = k;
  if (!accurate()) return false;
  report = {};
  report.whole = inside.count() > before;
  report.negative_pivots = inside.negative_pivots();
  report.factor_entries =
      inside.factor_entries() + static_cast<std::int64_t>(changing.size() * changing.size());
  return true;
}

/// As condense, where there is room for it.
bool Condensed::Impl::condense_where_it_fits(const SparseMatrix& k, FactorReport& report) {
  try {
    return condense(k, report);
  } catch (const std::bad_alloc&) {
    forget();
    too_dear = pattern;
    return false;
  }
}

void Condensed::Impl::forget() {
  inside.forget();
  few.forget();
  dense = std::make_unique<DenseFactors>();
  matrix = {};
}

/// By Mumps, with the room of what was condensed where it is short of it.
FactorReport Condensed::Impl::factor_whole(const SparseMatrix& k) {
  try {
    return whole.factor(k, version, symmetry);
  } catch (const NotEnoughMemory&) {
    if (!inside.holds_factors()) throw;
  }
  forget();
  too_dear = pattern;
  return whole.factor(k, version, symmetry);
}

Condensed::Condensed(MumpsOptions options) : impl_(std::make_unique<Impl>(options)) {}
Condensed::~Condensed() = default;

void Condensed::may_change(std::vector<Index> unknowns) {
  std::ranges::sort(unknowns);
  unknowns.erase(std::unique(unknowns.begin(), unknowns.end()), unknowns.end());
  impl_->changing = std::move(unknowns);
}

FactorReport Condensed::factor(const SparseMatrix& k, std::uint64_t pattern_version,
                               Symmetry symmetry) {
  Impl& s = *impl_;
  const auto begun = std::chrono::steady_clock::now();
  const double before = s.whole.seconds();
  FactorReport report;
  s.version = pattern_version;
  s.symmetry = symmetry;
  s.symmetric = symmetry != Symmetry::unsymmetric;
  s.condensed = false;
  s.condensed = s.pays(k, symmetry) && s.condense_where_it_fits(k, report);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begun;
  s.seconds += spent.count();
  if (s.condensed) {
    report.seconds_factor = spent.count();
    ++s.count.small;
    return report;
  }
  ++s.count.whole;
  report = s.factor_whole(k);
  s.seconds += s.whole.seconds() - before;
  return report;
}

Eliminated* Condensed::eliminate(const SparseMatrix& k, Symmetry symmetry) {
  Impl& s = *impl_;
  constexpr double harmless = 1e-9;
  const auto begun = std::chrono::steady_clock::now();
  s.symmetric = symmetry != Symmetry::unsymmetric;
  s.condensed = false;
  bool done = false;
  try {
    done = s.pays(k, symmetry) && s.inside.factor(k);
  } catch (const std::bad_alloc&) {
    s.forget();
    s.too_dear = s.pattern;
  }
  s.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  const bool serves = done && s.inside.negative_pivots() == 0 && s.inside.pivot_ratio() > harmless;
  return serves ? &s.few : nullptr;
}

/// Solves with the condensed factors, with one correction where it helps. False: the residual stays
/// larger than Mumps would leave it.
bool Condensed::Impl::solve(const Eigen::MatrixXd& given, Eigen::MatrixXd& x) {
  constexpr double good = 1e-12, good_enough = 1e-8;
  x = given;
  if (!substitute(x)) return false;
  for (Eigen::Index c = 0; c < x.cols(); ++c) {
    const auto residual = [&](const Eigen::VectorXd& of) -> Eigen::VectorXd {
      return given.col(c) - multiplied(of);
    };
    const double size = given.col(c).stableNorm();
    Eigen::VectorXd rest = residual(x.col(c));
    double off = rest.stableNorm();
    if (!(off > good * size) && std::isfinite(off)) continue;
    if (!substitute(rest)) return false;
    const Eigen::VectorXd better = x.col(c) + rest;
    if (const double then = residual(better).stableNorm(); then < off) {
      x.col(c) = better;
      off = then;
    }
    if (!(off <= good_enough * size)) return false;
  }
  return true;
}

SolveStatus Condensed::solve(Eigen::MatrixXd& rhs) {
  Impl& s = *impl_;
  const auto begun = std::chrono::steady_clock::now();
  SolveStatus status = SolveStatus::ok;
  if (s.condensed && (rhs.rows() != s.matrix.n || !rhs.allFinite())) return SolveStatus::failed;
  Eigen::MatrixXd x;
  if (s.condensed && (rhs.size() == 0 || s.solve(rhs, x))) {
    if (rhs.size() > 0) rhs = std::move(x);
  } else {
    if (s.condensed) status = s.whole.factor(s.matrix, s.version, s.symmetry).status;
    s.condensed = false;
    if (status == SolveStatus::ok) status = s.whole.solve(rhs);
  }
  s.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  return status;
}

SolveStatus Condensed::solve(Eigen::VectorXd& rhs) {
  Impl& s = *impl_;
  if (!s.condensed) {
    const double before = s.whole.seconds();
    const SolveStatus status = s.whole.solve(rhs);
    s.seconds += s.whole.seconds() - before;
    return status;
  }
  Eigen::MatrixXd as_matrix = rhs;
  const SolveStatus status = solve(as_matrix);
  if (as_matrix.size() == rhs.size()) rhs = as_matrix.reshaped();
  return status;
}

SolveStatus Condensed::solve_once(Eigen::VectorXd& rhs) {
  Impl& s = *impl_;
  if (!s.condensed) {
    const double before = s.whole.seconds();
    const SolveStatus status = s.whole.solve_once(rhs);
    s.seconds += s.whole.seconds() - before;
    return status;
  }
  if (rhs.size() != s.matrix.n || !rhs.allFinite()) return SolveStatus::failed;
  const auto begun = std::chrono::steady_clock::now();
  Eigen::VectorXd x = rhs;
  const bool solved = x.size() == 0 || s.substitute(x);
  s.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  if (!solved || !x.allFinite()) return SolveStatus::failed;
  rhs = std::move(x);
  return SolveStatus::ok;
}

double Condensed::seconds() const { return impl_->seconds + impl_->few.seconds(); }
Condensed::Count Condensed::count() const { return impl_->count; }

}  // namespace osculate::la
