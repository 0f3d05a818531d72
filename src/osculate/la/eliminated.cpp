#include "osculate/la/eliminated.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "osculate/la/accuracy.hpp"
#include "osculate/la/dense_factors.hpp"
#include "osculate/la/schur.hpp"
#include "osculate/la/timed.hpp"

namespace osculate::la {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Adds the entries of a sparse matrix; of symmetric ones the upper triangle counts for both.
void add_entries(const SparseMatrix& k, bool symmetric, Eigen::MatrixXd& to) {
  for (Index i = 0; i < k.n; ++i)
    for (Index e = k.row_start[at(i)]; e < k.row_start[at(i) + 1]; ++e) {
      const Index j = k.column[at(e)];
      if (symmetric && i > j) continue;
      to(i, j) += k.value[at(e)];
      if (symmetric && i != j) to(j, i) += k.value[at(e)];
    }
}

/// The same entry by entry, of one row.
bool same_row(const SparseMatrix& a, const SparseMatrix& b, Index i) {
  Index e = a.row_start[at(i)], f = b.row_start[at(i)];
  const Index end_a = a.row_start[at(i) + 1], end_b = b.row_start[at(i) + 1];
  while (e < end_a || f < end_b) {
    const Index of_a = e < end_a ? a.column[at(e)] : a.n, of_b = f < end_b ? b.column[at(f)] : a.n;
    const double in_a = of_a <= of_b ? a.value[at(e++)] : 0.0;
    const double in_b = of_b <= of_a ? b.value[at(f++)] : 0.0;
    if (in_a != in_b) return false;
  }
  return true;
}

}  // namespace

struct Eliminated::Impl {
  SchurFactors& inside;
  int taken = -1;  ///< count of `inside` when `keep` was called
  Eigen::MatrixXd constant;
  bool symmetric = false;
  DenseFactors factors;
  bool factored = false;    ///< `factors` are those of `first`
  SparseMatrix first, now;  ///< what was factored, and what is solved for
  std::vector<Index> rows;  ///< that differ
  Eigen::MatrixXd changes;  ///< D
  Eigen::MatrixXd along;    ///< Z
  Eigen::PartialPivLU<Eigen::MatrixXd> small;
  double seconds = 0;
  Count count;

  explicit Impl(SchurFactors& of) : inside(of) {}
  [[nodiscard]] Eigen::VectorXd multiplied(const Eigen::VectorXd& x) const {
    return constant * x + (symmetric ? multiply_symmetric(now, x) : multiply(now, x));
  }
  [[nodiscard]] bool substitute(Eigen::MatrixXd& x) const;
  [[nodiscard]] bool accurate() const;
  bool update();
  bool factor_all();
};

bool Eliminated::Impl::substitute(Eigen::MatrixXd& x) const {
  factors.solve(x);
  if (!rows.empty()) x -= along * small.solve(changes * x);
  return x.allFinite();
}

/// At most half of the digits are lost.
bool Eliminated::Impl::accurate() const {
  constexpr double harmless = 1e-9, digits_left = 1e-6;
  if (rows.empty() && factors.pivot_ratio() > harmless) return true;
  const Eigen::VectorXd scale = factors.scale().cwiseInverse();
  const auto solve = [this](Eigen::VectorXd& x) {
    Eigen::MatrixXd as_matrix = x;
    if (!substitute(as_matrix)) return false;
    x = as_matrix.col(0);
    return true;
  };
  const double lost = lost_accuracy(
      scale, [this](const Eigen::VectorXd& x) { return multiplied(x); }, solve);
  return lost < digits_left;
}

bool Eliminated::Impl::factor_all() {
  factored = false;
  rows.clear();
  first = now;
  Eigen::MatrixXd& s = factors.matrix();
  if (s.rows() != constant.rows()) s = {};  // what is there goes first
  s = constant;
  add_entries(now, symmetric, s);
  factored = s.allFinite() && factors.factor(symmetric) && accurate();
  if (factored) ++count.factored;
  return factored;
}

/// Few rows that have changed. False: too many, or an update loses digits.
bool Eliminated::Impl::update() {
  constexpr std::size_t worth_it = 8;
  if (!factored || symmetric) return false;
  rows.clear();
  for (Index i = 0; i < now.n; ++i)
    if (!same_row(now, first, i)) rows.push_back(i);
  if (worth_it * rows.size() > at(now.n)) return false;
  const auto rank = static_cast<Eigen::Index>(rows.size());
  if (rank == 0) return true;
  changes.setZero(rank, now.n);
  along.setZero(now.n, rank);
  for (Eigen::Index r = 0; r < rank; ++r) {
    const Index i = rows[static_cast<std::size_t>(r)];
    along(i, r) = 1;
    for (Index e = now.row_start[at(i)]; e < now.row_start[at(i) + 1]; ++e)
      changes(r, now.column[at(e)]) += now.value[at(e)];
    for (Index e = first.row_start[at(i)]; e < first.row_start[at(i) + 1]; ++e)
      changes(r, first.column[at(e)]) -= first.value[at(e)];
  }
  if (!changes.allFinite()) return false;
  factors.solve(along);
  small.compute(Eigen::MatrixXd::Identity(rank, rank) + changes * along);
  if (!accurate()) return false;
  ++count.updated;
  return true;
}

Eliminated::Eliminated(SchurFactors& inside) : impl_(std::make_unique<Impl>(inside)) {}
Eliminated::~Eliminated() = default;

bool Eliminated::stands() const {
  return impl_->inside.holds_factors() && impl_->inside.count() == impl_->taken;
}

void Eliminated::keep(const SparseMatrix& k, Symmetry symmetry, std::span<const Index> c) {
  Impl& s = *impl_;
  if (s.inside.complement().rows() != static_cast<Eigen::Index>(c.size())) {
    s.taken = -1;
    return;
  }
  s.taken = s.inside.count();
  s.symmetric = symmetry != Symmetry::unsymmetric;
  s.factored = false;
  s.constant = s.inside.complement();
  SparseMatrix few;
  take_out(k, c, few);
  add_entries(few, s.symmetric, s.constant);
}

void Eliminated::forget() {
  Impl& s = *impl_;
  s.taken = -1;
  s.factored = false;
  for (Eigen::MatrixXd* const m : {&s.constant, &s.changes, &s.along, &s.factors.matrix()})
    m->resize(0, 0);
  s.first = s.now = {};
}

const Eigen::MatrixXd& Eliminated::constant() const { return impl_->constant; }

bool Eliminated::reduce(const Eigen::VectorXd& b, Eigen::VectorXd& of_c) {
  const Timed watch(impl_->seconds);
  Eigen::MatrixXd reduced;
  if (!impl_->inside.reduce(b, reduced)) return false;
  of_c = reduced.col(0);
  return of_c.allFinite();
}

bool Eliminated::expand(const Eigen::VectorXd& x_c, Eigen::VectorXd& x) {
  const Timed watch(impl_->seconds);
  Eigen::MatrixXd all;
  if (!impl_->inside.expand(x_c, all)) return false;
  x = all.col(0);
  return x.allFinite();
}

void Eliminated::begin_anew() { impl_->factored = false; }

FactorReport Eliminated::factor(const SparseMatrix& k, std::uint64_t /*pattern_version*/,
                                Symmetry /*symmetry*/) {
  Impl& s = *impl_;
  const Timed watch(s.seconds);
  FactorReport report;
  report.whole = false;
  report.factor_entries =
      std::int64_t{k.n} * k.n;  // no operations: K' alone is no matrix to iterate on
  s.now = k;
  if (!s.update() && !s.factor_all()) {
    report.status = SolveStatus::failed;
    report.message = "the matrix of the unknowns of contact has too few digits";
  }
  return report;
}

/// Corrected once where the residual asks for it.
SolveStatus Eliminated::solve(Eigen::VectorXd& rhs) {
  Impl& s = *impl_;
  const Timed watch(s.seconds);
  constexpr double good = 1e-12, good_enough = 1e-8;
  if (!s.factored || rhs.size() != s.now.n || !rhs.allFinite()) return SolveStatus::failed;
  Eigen::MatrixXd x = rhs;
  if (!s.substitute(x)) return SolveStatus::failed;
  const double size = rhs.stableNorm();
  Eigen::MatrixXd rest = rhs - s.multiplied(x.col(0));
  const double off = rest.stableNorm();
  if (off > good * size) {
    if (!s.substitute(rest)) return SolveStatus::failed;
    rest += x;
    const double then = Eigen::VectorXd(rhs - s.multiplied(rest.col(0))).stableNorm();
    if (then < off) x.swap(rest);
    if (!(std::min(then, off) <= good_enough * size)) return SolveStatus::failed;
  }
  rhs = x.col(0);
  return rhs.allFinite() ? SolveStatus::ok : SolveStatus::failed;
}

SolveStatus Eliminated::solve(Eigen::MatrixXd& rhs) {
  for (Eigen::Index c = 0; c < rhs.cols(); ++c) {
    Eigen::VectorXd column = rhs.col(c);
    if (const SolveStatus status = solve(column); status != SolveStatus::ok) return status;
    rhs.col(c) = column;
  }
  return SolveStatus::ok;
}

double Eliminated::seconds() const { return impl_->seconds; }
Eliminated::Count Eliminated::count() const { return impl_->count; }

}  // namespace osculate::la
