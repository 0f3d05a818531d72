#include "osculate/la/mumps.hpp"

#include <dmumps_c.h>
#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <limits>

#include "osculate/core/machine.hpp"
#include "osculate/core/memory.hpp"
#include "osculate/la/accuracy.hpp"
#include "osculate/la/blas_at_start.hpp"
#include "osculate/la/mumps_library.hpp"
#include "osculate/la/ordering.hpp"
#include "osculate/la/timed.hpp"

namespace osculate::la {

using namespace mumps;  // NOLINT(google-build-using-namespace): the words of one library

namespace {

constexpr const char* not_definite = "the matrix is not positive definite";

double seconds_since(std::chrono::steady_clock::time_point from) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - from).count();
}

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

FactorReport failure(SolveStatus status, std::string message, Index row = -1) {
  FactorReport report;
  report.status = status;
  report.message = std::move(message);
  report.bad_row = row;
  return report;
}

}  // namespace

struct Mumps::Impl {
  DMUMPS_STRUC_C id{};
  MumpsOptions options;
  bool open = false, analysed = false, factored = false;
  bool alone = false;  ///< the factors, without the matrix
  Symmetry symmetry = Symmetry::unsymmetric;
  std::uint64_t version = 0;
  Index n = -1;
  int slack_percent = 30;
  double seconds = 0;
  const core::Ranks* ranks = nullptr;     ///< of the matrix
  std::vector<int> rows, columns, order;  // one-based triplets; the upper triangle if symmetric
  std::vector<double> values;

  explicit Impl(MumpsOptions wanted) : options(wanted) {
    options.blas_threads = std::max(1, options.blas_threads);
  }
  ~Impl() {
    if (!open) return;
    const LibraryCall guard(options.blas_threads);
    close();
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void call(int job) {
    id.job = job;
    if (ranks)
      options.shared.call(&id);
    else
      dmumps_c(&id);
  }
  [[nodiscard]] bool agreed(bool holds) const { return ranks ? ranks->all(holds) : holds; }
  void close() {
    // While an error is under way the others may be elsewhere.
    if (open && !(ranks && std::uncaught_exceptions() > 0)) call(end);
    open = analysed = factored = false;
  }
  [[nodiscard]] bool kept(Index i, Index j) const {
    return symmetry == Symmetry::unsymmetric || i <= j;
  }

  bool begin(int kind);
  void order_unknowns(const SparseMatrix& k);
  void set_pattern(const SparseMatrix& k);
  [[nodiscard]] bool same_pattern(const SparseMatrix& k) const;
  Index set_values(const SparseMatrix& k);
  FactorReport prepare(const SparseMatrix& k, std::uint64_t wanted_version, Symmetry wanted);
  FactorReport factorise_with_retries();
  void look_at_accuracy(FactorReport& report);
  [[nodiscard]] FactorReport outcome() const;
  [[nodiscard]] double needed_bytes() const;
  [[nodiscard]] double needed_here() const;
  [[nodiscard]] std::string memory_text() const;
  [[nodiscard]] Eigen::VectorXd multiplied(const Eigen::VectorXd& x) const;
  [[nodiscard]] Eigen::VectorXd row_scale() const;
  [[nodiscard]] double loss();
  [[nodiscard]] Index vanishing_row(const SparseMatrix& k);
  SolveStatus substitute(double* rhs, Index count);
  SolveStatus solve(Eigen::VectorXd& rhs);
  FactorReport factor(const SparseMatrix& k, std::uint64_t wanted_version, Symmetry wanted);
  void refine(const Eigen::VectorXd& rhs, Eigen::VectorXd& x);
  void forget_matrix();
};

namespace {

template <class Call>
bool open_by(DMUMPS_STRUC_C& id, int kind, int communicator, const Call& call) {
  id = {};
  id.comm_fortran = communicator;
  id.par = 1;
  id.sym = kind;
  id.job = start;
  call(id);
  if (id.infog[0] < 0) return false;
  id.icntl[error_unit] = id.icntl[warning_unit] = id.icntl[info_unit] = -1;
  id.icntl[print_level] = 0;
  id.icntl[openmp_threads] = 1;
  id.icntl[transversal] = 0;
  id.icntl[scaling] = 7;  // rows and columns together, iterated, from the current values
  return true;
}

}  // namespace

bool mumps::open_library(DMUMPS_STRUC_C& id, int kind) {
  if (!take_blas_buffer()) throw NotEnoughMemory("not enough memory for the linear solver");
  return open_by(id, kind, use_communicator_world, [](DMUMPS_STRUC_C& of) { dmumps_c(&of); });
}

bool mumps::open_library(DMUMPS_STRUC_C& id, int kind, const SharedMumps& shared,
                         const core::Ranks& ranks) {
  if (!ranks.all(take_blas_buffer()))
    throw NotEnoughMemory("not enough memory for the linear solver");
  if (!open_by(id, kind, shared.communicator, [&](DMUMPS_STRUC_C& of) { shared.call(&of); }))
    return false;
  constexpr int by_process = 3;
  id.icntl[distribution] = by_process;
  id.icntl[root_by_one] = 1;  // shared, it tells neither of negative pivots nor of small ones
  return true;
}

bool Mumps::Impl::begin(int kind) {
  close();
  open = ranks ? open_library(id, kind, options.shared, *ranks) : open_library(id, kind);
  return open;
}

void Mumps::Impl::order_unknowns(const SparseMatrix& k) {
  constexpr Index worth_dissecting = 1000;
  order.clear();
  if (k.n >= worth_dissecting) order = nested_dissection(k);
  int given = order.empty() ? 0 : 1;
  if (ranks) ranks->spread({&given, 1}, 0);
  id.icntl[ordering] = given;  // minimum degree, or given
  id.perm_in = order.empty() ? nullptr : order.data();
}

void Mumps::Impl::set_pattern(const SparseMatrix& k) {
  std::size_t entries = 0;
  for (Index i = 0; i < k.n; ++i)
    for (Index e = k.row_start[at(i)]; e < k.row_start[at(i) + 1]; ++e)
      if (kept(i, k.column[at(e)])) ++entries;
  rows.clear();
  columns.clear();
  rows.reserve(entries);
  columns.reserve(entries);
  values.reserve(entries);
  for (Index i = 0; i < k.n; ++i)
    for (Index e = k.row_start[at(i)]; e < k.row_start[at(i) + 1]; ++e) {
      if (!kept(i, k.column[at(e)])) continue;
      rows.push_back(i + 1);
      columns.push_back(k.column[at(e)] + 1);
    }
  id.n = k.n;
  (ranks ? id.nnz_loc : id.nnz) = static_cast<MUMPS_INT8>(rows.size());
  (ranks ? id.irn_loc : id.irn) = rows.data();
  (ranks ? id.jcn_loc : id.jcn) = columns.data();
  order_unknowns(k);
}

bool Mumps::Impl::same_pattern(const SparseMatrix& k) const {
  std::size_t next = 0;
  for (Index i = 0; i < k.n; ++i)
    for (Index e = k.row_start[at(i)]; e < k.row_start[at(i) + 1]; ++e) {
      if (!kept(i, k.column[at(e)])) continue;
      if (next == rows.size() || rows[next] != i + 1 || columns[next] != k.column[at(e)] + 1)
        return false;
      ++next;
    }
  return next == rows.size();
}

/// Returns the first row with an entry that is not finite, or -1.
Index Mumps::Impl::set_values(const SparseMatrix& k) {
  values.clear();
  Index bad = k.n;
  for (Index i = 0; i < k.n && bad == k.n; ++i)
    for (Index e = k.row_start[at(i)]; e < k.row_start[at(i) + 1]; ++e) {
      if (!std::isfinite(k.value[at(e)])) bad = std::min(bad, i);
      if (kept(i, k.column[at(e)])) values.push_back(k.value[at(e)]);
    }
  if (ranks) bad = -static_cast<Index>(ranks->largest(-static_cast<double>(bad)));
  if (bad < k.n) return bad;
  (ranks ? id.a_loc : id.a) = values.data();
  return -1;
}

/// Of the factorisation, by the analysis, without the slack; 0 before it.
double Mumps::Impl::needed_bytes() const {
  return 1e6 * id.infog[16] / (1 + 0.01 * id.icntl[slack]);
}

/// The part of it that processes of this machine need.
double Mumps::Impl::needed_here() const {
  if (!ranks) return needed_bytes();
  const double of_process = 1e6 * id.info[14] / (1 + 0.01 * id.icntl[slack]);
  return core::sum_on_machine(*ranks, of_process, core::mark_of_machine());
}

std::string Mumps::Impl::memory_text() const {
  return "not enough memory for the factors of the tangent of " + std::to_string(n) + " unknowns" +
         (needed_bytes() > 0 ? ", about " + core::memory_text(needed_bytes()) : "");
}

FactorReport Mumps::Impl::outcome() const {
  const int code = id.infog[0];
  if (code == -6 || code == -10) return failure(SolveStatus::singular, "a pivot is zero");
  if (code == -40) return failure(SolveStatus::failed, not_definite);
  if (code == -5 || code == -7 || code == -8 || code == -9 || code == -13)
    throw NotEnoughMemory(memory_text());
  if (code < 0) return failure(SolveStatus::failed, "MUMPS error " + std::to_string(code));
  FactorReport report;
  if (symmetry != Symmetry::unsymmetric) report.negative_pivots = id.infog[11];
  report.operations = std::max(0.0, id.rinfog[2]);  // of the elimination
  constexpr std::int64_t million = 1'000'000;
  report.factor_entries = id.infog[28] >= 0 ? id.infog[28] : -million * id.infog[28];
  return report;
}

/// Opens the library and analyses where the former analysis does not stand; sets the values.
FactorReport Mumps::Impl::prepare(const SparseMatrix& k, std::uint64_t wanted_version,
                                  Symmetry wanted) {
  const auto begun = std::chrono::steady_clock::now();
  const bool same_processes = ranks == k.ranks;
  if (!same_processes) close();
  ranks = k.ranks;
  if (ranks && !options.shared.call)
    return failure(SolveStatus::failed, "there is no linear solver for several processes");
  const bool stands = agreed(analysed && symmetry == wanted && version == wanted_version &&
                             n == k.n && same_pattern(k));
  symmetry = wanted;
  version = wanted_version;
  n = k.n;
  if (!stands) {
    close();
    if (!begin(kind_of(symmetry)))
      return failure(SolveStatus::failed, "the linear solver did not start");
    set_pattern(k);
  }
  const Index bad = set_values(k);
  if (bad >= 0) {
    analysed = stands;
    return failure(SolveStatus::failed, "the matrix has entries that are not finite", bad);
  }
  if (stands) return {};
  analysed = false;
  call(analyse);
  FactorReport report = outcome();
  analysed = report.status == SolveStatus::ok;
  // Where there is less in the whole machine, the system would end the program without a word.
  const double all = core::memory_in_all(), needed = needed_here();
  if (!agreed(all <= 0 || needed <= all)) throw NotEnoughMemory(memory_text());
  // What was freed lies between what was kept, in pieces too small for the factors.
  constexpr double large = 16e6;
  if (needed_bytes() > large) (void)malloc_trim(0);
  report.seconds_analysis = seconds_since(begun);
  return report;
}

FactorReport Mumps::Impl::factorise_with_retries() {
  constexpr int no_space = -8, no_real_space = -9;
  constexpr int most = 3000;
  for (;; slack_percent = slack_percent * 10 / 3) {
    id.icntl[slack] = slack_percent;  // working space in percent above the estimate
    call(factorise);
    const bool short_of_space = id.infog[0] == no_space || id.infog[0] == no_real_space;
    if (!short_of_space || slack_percent > most) return outcome();
  }
}

/// Square roots of the largest entries of the rows, 1 for empty ones.
Eigen::VectorXd Mumps::Impl::row_scale() const {
  Eigen::VectorXd scale = Eigen::VectorXd::Zero(n);
  for (std::size_t e = 0; e < values.size(); ++e)
    for (const int i : {rows[e] - 1, columns[e] - 1})
      scale[i] = std::max(scale[i], std::abs(values[e]));
  if (ranks) ranks->largest({scale.data(), at(n)});
  for (double& s : scale) s = s > 0 ? std::sqrt(s) : 1.0;
  return scale;
}

Eigen::VectorXd Mumps::Impl::multiplied(const Eigen::VectorXd& x) const {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(n);
  for (std::size_t e = 0; e < values.size(); ++e) {
    const Index i = rows[e] - 1, j = columns[e] - 1;
    y[i] += values[e] * x[j];
    if (symmetry != Symmetry::unsymmetric && i != j) y[j] += values[e] * x[i];
  }
  if (ranks) ranks->sum({y.data(), at(n)});
  return y;
}

/// What is lost of a number's digits, as a share; 0 where the pivots say that it is harmless.
double Mumps::Impl::loss() {
  constexpr double harmless = 1e-9;
  const double smallest = id.rinfog[18], largest = id.rinfog[20];  // pivots of the scaled matrix
  if (smallest > harmless * largest) return 0;
  return lost_accuracy(
      row_scale(), [this](const Eigen::VectorXd& x) { return multiplied(x); },
      [this](Eigen::VectorXd& x) { return substitute(x.data(), 1) == SolveStatus::ok; });
}

/// Factors once more with the search for pivots that vanish, which needs pivoting; -1 if none is
/// found. The next factorisation starts from the analysis.
Index Mumps::Impl::vanishing_row(const SparseMatrix& k) {
  constexpr double rounding = 1e-14, near = 10;
  const double smallest = id.infog[0] < 0 ? 0 : id.rinfog[18];
  if (!begin(symmetry == Symmetry::unsymmetric ? general : pivoted)) return -1;
  set_pattern(k);
  (ranks ? id.a_loc : id.a) = values.data();
  id.icntl[slack] = slack_percent;
  id.icntl[null_pivots] = 1;
  id.cntl[null_pivot_threshold] = -std::max(rounding, near * smallest);  // negative: absolute
  call(analyse);
  if (id.infog[0] >= 0) call(factorise);
  const bool found = id.infog[0] >= 0 && id.infog[27] > 0 && id.pivnul_list != nullptr;
  Index row = found ? id.pivnul_list[0] - 1 : -1;
  if (ranks) ranks->spread({&row, 1}, 0);
  close();
  return row;
}

SolveStatus Mumps::Impl::substitute(double* rhs, Index count) {
  id.rhs = rhs;
  id.nrhs = count;
  id.lrhs = n;
  call(back_substitute);
  id.rhs = nullptr;
  if (ranks) ranks->spread({rhs, at(n) * at(count)}, 0);
  if (id.infog[0] == -13) throw NotEnoughMemory("not enough memory for a solution");
  return id.infog[0] >= 0 ? SolveStatus::ok : SolveStatus::failed;
}

/// One correction from the residual where it is worth it, kept if it helps.
void Mumps::Impl::refine(const Eigen::VectorXd& rhs, Eigen::VectorXd& x) {
  constexpr double good = 1e-12;
  const double size = rhs.stableNorm();
  Eigen::VectorXd rest = rhs - multiplied(x);
  const double before = rest.stableNorm();
  if (!(before > good * size)) return;
  if (substitute(rest.data(), 1) != SolveStatus::ok) return;
  const Eigen::VectorXd better = x + rest;
  if (Eigen::VectorXd(rhs - multiplied(better)).stableNorm() < before) x = better;
}

/// Singular to working precision, with what is resisted least, or not so. Without pivoting, small
/// pivots beside negative ones are the method's: `vanishing_row` decides.
void Mumps::Impl::look_at_accuracy(FactorReport& report) {
  constexpr double digits_left = 1e-3;
  const double lost = loss();
  if (!(lost > digits_left)) return;
  const bool promised = symmetry == Symmetry::positive_definite;
  const bool broken = promised && report.negative_pivots > 0;
  report = failure(SolveStatus::singular, "the matrix is singular to working precision");
  report.condition = lost / std::numeric_limits<double>::epsilon();
  if (broken) return;
  WeakestMode mode = weakest_mode(row_scale(), [this](Eigen::VectorXd& x) {
    return substitute(x.data(), 1) == SolveStatus::ok;
  });
  report.weakest = std::move(mode.values);
  report.bad_row = mode.row;
}

Mumps::Mumps(MumpsOptions options) : impl_(std::make_unique<Impl>(options)) {}
Mumps::~Mumps() = default;

FactorReport Mumps::Impl::factor(const SparseMatrix& k, std::uint64_t wanted_version,
                                 Symmetry wanted) {
  const LibraryCall guard(options.blas_threads);
  factored = alone = false;
  if (k.n == 0) {
    close();
    n = 0;
    factored = true;
    return {};
  }
  FactorReport report = prepare(k, wanted_version, wanted);
  if (report.status != SolveStatus::ok) return report;
  const double analysis = report.seconds_analysis;
  const auto begun = std::chrono::steady_clock::now();
  report = factorise_with_retries();
  if (report.status == SolveStatus::ok) look_at_accuracy(report);
  factored = report.status == SolveStatus::ok || report.weakest.size() > 0;
  if (report.status == SolveStatus::singular && !factored) report.bad_row = vanishing_row(k);
  if (report.status == SolveStatus::singular && report.bad_row < 0 &&
      symmetry == Symmetry::positive_definite)
    report = failure(SolveStatus::failed, not_definite);  // it can be factored with pivoting
  report.seconds_analysis = analysis;
  report.seconds_factor = seconds_since(begun);
  return report;
}

FactorReport Mumps::factor(const SparseMatrix& k, std::uint64_t pattern_version,
                           Symmetry symmetry) {
  const Timed timed(impl_->seconds);
  return impl_->factor(k, pattern_version, symmetry);
}

void Mumps::Impl::forget_matrix() {
  for (std::vector<int>* const of : {&rows, &columns, &order}) *of = std::vector<int>();
  values = std::vector<double>();  // braces would keep the room
  // Solutions look at none of these without error analysis and refinement (ICNTL(10), (11) are 0).
  id.irn = id.jcn = id.irn_loc = id.jcn_loc = id.perm_in = nullptr;
  id.a = id.a_loc = nullptr;
}

void Mumps::forget() {
  Impl& s = *impl_;
  if (!s.open) return;
  const LibraryCall guard(s.options.blas_threads);
  s.close();
  s.forget_matrix();
}

void Mumps::keep_factors_alone() {
  Impl& s = *impl_;
  s.forget_matrix();
  s.analysed = false;
  s.alone = true;
}

double Mumps::seconds() const { return impl_->seconds; }

SolveStatus Mumps::Impl::solve(Eigen::VectorXd& rhs) {
  if (n == 0) return SolveStatus::ok;
  const LibraryCall guard(options.blas_threads);
  const Eigen::VectorXd given = rhs;
  const SolveStatus status = substitute(rhs.data(), 1);
  if (status != SolveStatus::ok) return status;
  if (!rhs.allFinite()) return SolveStatus::singular;
  refine(given, rhs);
  return rhs.allFinite() ? SolveStatus::ok : SolveStatus::singular;
}

SolveStatus Mumps::solve(Eigen::VectorXd& rhs) {
  Impl& s = *impl_;
  if (!s.factored || s.alone || rhs.size() != s.n || !rhs.allFinite()) return SolveStatus::failed;
  const Timed timed(s.seconds);
  return s.solve(rhs);
}

SolveStatus Mumps::solve_once(Eigen::VectorXd& rhs) {
  Impl& s = *impl_;
  if (!s.factored || rhs.size() != s.n || !rhs.allFinite()) return SolveStatus::failed;
  if (s.n == 0) return SolveStatus::ok;
  const Timed timed(s.seconds);
  const LibraryCall guard(s.options.blas_threads);
  const SolveStatus status = s.substitute(rhs.data(), 1);
  return status != SolveStatus::ok || rhs.allFinite() ? status : SolveStatus::singular;
}

SolveStatus Mumps::solve(Eigen::MatrixXd& rhs) {
  Impl& s = *impl_;
  if (!s.factored || s.alone || rhs.rows() != s.n || !rhs.allFinite()) return SolveStatus::failed;
  if (rhs.size() == 0) return SolveStatus::ok;
  const Timed timed(s.seconds);
  const LibraryCall guard(s.options.blas_threads);
  const Eigen::MatrixXd given = rhs;
  const SolveStatus status = s.substitute(rhs.data(), static_cast<Index>(rhs.cols()));
  if (status != SolveStatus::ok) return status;
  for (Eigen::Index c = 0; c < rhs.cols() && rhs.allFinite(); ++c) {
    Eigen::VectorXd x = rhs.col(c);
    s.refine(given.col(c), x);
    rhs.col(c) = x;
  }
  return rhs.allFinite() ? SolveStatus::ok : SolveStatus::singular;
}

}  // namespace osculate::la
