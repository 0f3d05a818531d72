#include "osculate/la/direct_solver.hpp"

#include <dmumps_c.h>
#include <metis.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>

extern "C" void openblas_set_num_threads(int);

namespace osculate::la {
namespace {

/// Control numbers of the library's manual, one-based there.
constexpr int use_communicator_world = -987654;
enum Job { start = -1, end = -2, analyse = 1, factorise = 2, back_substitute = 3 };

std::mutex& library_lock() {
  static std::mutex lock;
  return lock;
}

double seconds_since(std::chrono::steady_clock::time_point from) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - from).count();
}

/// Fill-reducing order of the graph of K + K^T, one-based; empty when it is not worth it.
std::vector<int> metis_order(const SparseMatrix& k) {
  constexpr Index smallest = 1000;
  if (k.n < smallest) return {};
  std::vector<std::vector<idx_t>> neighbours(static_cast<std::size_t>(k.n));
  for (Index i = 0; i < k.n; ++i)
    for (Index e = k.row_start[static_cast<std::size_t>(i)];
         e < k.row_start[static_cast<std::size_t>(i) + 1]; ++e) {
      const Index j = k.column[static_cast<std::size_t>(e)];
      if (i == j) continue;
      neighbours[static_cast<std::size_t>(i)].push_back(j);
      neighbours[static_cast<std::size_t>(j)].push_back(i);
    }
  std::vector<idx_t> start{0}, adjacent;
  for (auto& list : neighbours) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    adjacent.insert(adjacent.end(), list.begin(), list.end());
    start.push_back(static_cast<idx_t>(adjacent.size()));
  }
  idx_t n = k.n;
  std::vector<idx_t> permutation(static_cast<std::size_t>(n)), inverse(static_cast<std::size_t>(n));
  if (METIS_NodeND(&n, start.data(), adjacent.data(), nullptr, nullptr, permutation.data(),
                   inverse.data()) != METIS_OK)
    return {};
  std::vector<int> order;
  for (const idx_t position : inverse) order.push_back(static_cast<int>(position) + 1);
  return order;
}

}  // namespace

struct DirectSolver::Impl {
  DMUMPS_STRUC_C id{};
  bool open = false, factored = false;
  Symmetry symmetry = Symmetry::unsymmetric;
  std::uint64_t version = 0;
  Index n = -1;
  std::vector<int> rows, columns, order;
  std::vector<double> values;

  void call(int job) {
    id.job = job;
    dmumps_c(&id);
  }

  void close() {
    if (open) call(end);
    open = factored = false;
  }

  void begin(Symmetry wanted) {
    close();
    id = {};
    id.comm_fortran = use_communicator_world;
    id.par = 1;
    id.sym = wanted == Symmetry::unsymmetric ? 0 : wanted == Symmetry::positive_definite ? 1 : 2;
    call(start);
    open = true;
    symmetry = wanted;
    for (int i = 0; i < 4; ++i) id.icntl[i] = i == 3 ? 0 : -1;  // silent
  }

  void set_pattern(const SparseMatrix& k) {
    rows.clear();
    columns.clear();
    for (Index i = 0; i < k.n; ++i)
      for (Index e = k.row_start[static_cast<std::size_t>(i)];
           e < k.row_start[static_cast<std::size_t>(i) + 1]; ++e) {
        const Index j = k.column[static_cast<std::size_t>(e)];
        if (symmetry != Symmetry::unsymmetric && j < i) continue;
        rows.push_back(i + 1);
        columns.push_back(j + 1);
      }
    id.n = k.n;
    id.nnz = static_cast<MUMPS_INT8>(rows.size());
    id.irn = rows.data();
    id.jcn = columns.data();
    order = metis_order(k);
    if (!order.empty()) {
      id.icntl[6] = 1;  // ICNTL(7): the order is given
      id.perm_in = order.data();
    }
  }

  bool set_values(const SparseMatrix& k) {
    values.clear();
    for (Index i = 0; i < k.n; ++i)
      for (Index e = k.row_start[static_cast<std::size_t>(i)];
           e < k.row_start[static_cast<std::size_t>(i) + 1]; ++e) {
        if (symmetry != Symmetry::unsymmetric && k.column[static_cast<std::size_t>(e)] < i) continue;
        values.push_back(k.value[static_cast<std::size_t>(e)]);
        if (!std::isfinite(values.back())) return false;
      }
    id.a = values.data();
    return true;
  }

  FactorReport outcome() const {
    FactorReport report;
    const int code = id.infog[0];
    if (code == -10) {
      report.status = SolveStatus::singular;
      report.message = "zero pivot";
    } else if (code == -13 || code == -8 || code == -9) {
      report.status = SolveStatus::not_enough_memory;
      report.message = "not enough memory for the factors";
    } else if (code < 0) {
      report.status = SolveStatus::failed;
      report.message = "MUMPS error " + std::to_string(code);
    }
    report.negative_pivots = id.infog[11];
    return report;
  }

  FactorReport factorise_with_retries() {
    for (const int slack : {30, 100, 300, 1000}) {
      id.icntl[13] = slack;  // ICNTL(14): working space in percent above the estimate
      call(factorise);
      if (id.infog[0] != -8 && id.infog[0] != -9) break;
    }
    return outcome();
  }
};

DirectSolver::DirectSolver() : impl_(std::make_unique<Impl>()) {}
DirectSolver::DirectSolver(DirectSolver&&) noexcept = default;
DirectSolver& DirectSolver::operator=(DirectSolver&&) noexcept = default;

DirectSolver::~DirectSolver() {
  if (!impl_) return;
  const std::lock_guard guard(library_lock());
  impl_->close();
}

FactorReport DirectSolver::factor(const SparseMatrix& k, std::uint64_t pattern_version,
                                  Symmetry symmetry) {
  const std::lock_guard guard(library_lock());
  openblas_set_num_threads(1);
  Impl& s = *impl_;
  s.factored = false;
  if (k.n == 0) {
    s.n = 0;
    s.factored = true;
    return {};
  }
  const auto begin = std::chrono::steady_clock::now();
  double analysis = 0;
  const bool fresh = !s.open || s.symmetry != symmetry || s.version != pattern_version || s.n != k.n;
  if (fresh) {
    s.begin(symmetry);
    s.set_pattern(k);
  }
  s.n = k.n;
  s.version = pattern_version;
  if (!s.set_values(k)) {
    FactorReport report;
    report.status = SolveStatus::failed;
    report.message = "the matrix has entries that are not a number";
    return report;
  }
  if (fresh) {
    s.call(analyse);
    analysis = seconds_since(begin);
    if (s.id.infog[0] < 0) {
      FactorReport report = s.outcome();
      s.close();
      return report;
    }
  }
  FactorReport report = s.factorise_with_retries();
  report.seconds_analysis = analysis;
  report.seconds_factor = seconds_since(begin) - analysis;
  s.factored = report.status == SolveStatus::ok;
  return report;
}

SolveStatus DirectSolver::solve(Eigen::VectorXd& rhs) const {
  const std::lock_guard guard(library_lock());
  Impl& s = *impl_;
  if (!s.factored || rhs.size() != s.n) return SolveStatus::failed;
  if (s.n == 0) return SolveStatus::ok;
  s.id.rhs = rhs.data();
  s.id.nrhs = 1;
  s.id.lrhs = s.n;
  s.call(back_substitute);
  if (s.id.infog[0] < 0) return SolveStatus::failed;
  return rhs.allFinite() ? SolveStatus::ok : SolveStatus::singular;
}

}  // namespace osculate::la
