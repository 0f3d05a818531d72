#include "osculate/la/schur.hpp"

#include <dmumps_c.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "osculate/la/mumps_library.hpp"
#include "osculate/la/ordering.hpp"

namespace osculate::la {

using namespace mumps;  // NOLINT(google-build-using-namespace): the words of one library

struct SchurFactors::Impl {
  DMUMPS_STRUC_C id{};
  int blas_threads;
  bool open = false, analysed = false, factored = false;
  int count = 0;
  Symmetry symmetry = Symmetry::unsymmetric;
  Index n = -1;
  int slack_percent = 30;
  std::vector<Index> row_start, column;  ///< of the matrix analysed last
  std::vector<Index> c;
  std::vector<Index> place;          ///< by row: in C, -1 outside
  std::vector<std::size_t> entries;  ///< of the matrix, outside of C x C
  std::vector<int> rows, columns, order, list;
  std::vector<double> values;
  Eigen::MatrixXd schur, work, reduced;

  explicit Impl(int threads) : blas_threads(std::max(1, threads)) {}
  ~Impl() {
    const LibraryCall guard(blas_threads);
    close();
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void call(int job) {
    id.job = job;
    dmumps_c(&id);
  }
  void close() {
    if (open) call(end);
    open = analysed = factored = false;
  }
  bool begin();
  [[nodiscard]] bool is_of(Index size, Symmetry kind, std::span<const Index> few) const {
    return analysed && n == size && symmetry == kind && std::ranges::equal(c, few);
  }
  [[nodiscard]] bool has_values_of(const SparseMatrix& k) const {
    std::size_t e = 0;
    while (e < values.size() && values[e] == k.value[entries[e]]) ++e;
    return e == values.size();
  }
  /// Whether the triplets are others than before.
  bool set_pattern(const SparseMatrix& k);
  void set_order();
  void point_to_schur();
  bool substitute(int phase, Eigen::MatrixXd& rhs);
};

bool SchurFactors::Impl::begin() {
  close();
  open = open_library(id, kind_of(symmetry));
  return open;
}

bool SchurFactors::Impl::set_pattern(const SparseMatrix& k) {
  const auto each = [&](const auto& take) {
    for (Index i = 0; i < k.n; ++i)
      for (Index e = k.row_start[static_cast<std::size_t>(i)];
           e < k.row_start[static_cast<std::size_t>(i) + 1]; ++e) {
        const Index j = k.column[static_cast<std::size_t>(e)];
        if (symmetry != Symmetry::unsymmetric && i > j) continue;
        if (place[static_cast<std::size_t>(i)] < 0 || place[static_cast<std::size_t>(j)] < 0)
          take(i, j, static_cast<std::size_t>(e));
      }
  };
  std::size_t count_of_entries = 0;
  each([&](Index, Index, std::size_t) { ++count_of_entries; });
  std::vector<int> new_rows, new_columns;
  new_rows.reserve(count_of_entries);
  new_columns.reserve(count_of_entries);
  entries.clear();
  entries.reserve(count_of_entries);
  each([&](Index i, Index j, std::size_t e) {
    entries.push_back(e);
    new_rows.push_back(i + 1);
    new_columns.push_back(j + 1);
  });
  if (rows == new_rows && columns == new_columns) return false;  // the library points to them
  rows = std::move(new_rows);
  columns = std::move(new_columns);
  return true;
}

/// Nested dissection of what is inside, then C.
void SchurFactors::Impl::set_order() {
  std::vector<Index> inner(static_cast<std::size_t>(n), -1), back;
  for (Index i = 0; i < n; ++i)
    if (place[static_cast<std::size_t>(i)] < 0) {
      inner[static_cast<std::size_t>(i)] = static_cast<Index>(back.size());
      back.push_back(i);
    }
  SparseMatrix inside;
  inside.n = static_cast<Index>(back.size());
  inside.row_start.push_back(0);
  std::size_t next = 0;
  for (const Index i : back) {
    while (next < rows.size() && rows[next] < i + 1) ++next;
    for (; next < rows.size() && rows[next] == i + 1; ++next)
      if (const Index j = inner[static_cast<std::size_t>(columns[next] - 1)]; j >= 0)
        inside.column.push_back(j);
    inside.row_start.push_back(static_cast<Index>(inside.column.size()));
  }
  const std::vector<int> dissected = nested_dissection(inside);
  order.assign(static_cast<std::size_t>(n), 0);
  for (std::size_t i = 0; i < back.size(); ++i)
    order[static_cast<std::size_t>(back[i])] =
        dissected.empty() ? static_cast<int>(i) + 1 : dissected[i];
  for (std::size_t k = 0; k < c.size(); ++k)
    order[static_cast<std::size_t>(c[k])] = static_cast<int>(back.size() + k) + 1;
}

void SchurFactors::Impl::point_to_schur() {
  const auto size = static_cast<Eigen::Index>(c.size());
  schur.resize(size, size);
  id.schur = schur.data();
  id.schur_lld = static_cast<int>(size);
}

SchurFactors::SchurFactors(int blas_threads) : impl_(std::make_unique<Impl>(blas_threads)) {}
SchurFactors::~SchurFactors() = default;

bool SchurFactors::is_of(const SparseMatrix& k, Symmetry symmetry, std::span<const Index> c) const {
  return impl_->is_of(k.n, symmetry, c) && impl_->row_start == k.row_start &&
         impl_->column == k.column;
}

bool SchurFactors::analyse(const SparseMatrix& k, Symmetry symmetry, std::span<const Index> c) {
  Impl& s = *impl_;
  if (is_of(k, symmetry, c)) return true;
  const bool same = s.is_of(k.n, symmetry, c);
  s.row_start = k.row_start;
  s.column = k.column;
  s.symmetry = symmetry;
  s.n = k.n;
  s.c.assign(c.begin(), c.end());
  s.place.assign(static_cast<std::size_t>(k.n), -1);
  for (std::size_t a = 0; a < c.size(); ++a)
    s.place[static_cast<std::size_t>(c[a])] = static_cast<Index>(a);
  if (!s.set_pattern(k) && same) return true;
  const LibraryCall guard(s.blas_threads);
  if (!s.begin()) return false;
  s.set_order();
  s.list.clear();
  for (const Index i : c) s.list.push_back(i + 1);
  s.id.n = k.n;
  s.id.nnz = static_cast<MUMPS_INT8>(s.rows.size());
  s.id.irn = s.rows.data();
  s.id.jcn = s.columns.data();
  s.id.icntl[ordering] = 1;
  s.id.perm_in = s.order.data();
  s.id.icntl[schur_wanted] = 3;  // by columns, both triangles
  s.id.size_schur = static_cast<int>(s.list.size());
  s.id.listvar_schur = s.list.data();
  s.id.nprow = s.id.npcol = 1;
  s.id.mblock = s.id.nblock = 100;
  s.call(mumps::analyse);
  s.values.clear();
  s.analysed = s.id.infog[0] >= 0;
  return s.analysed;
}

int SchurFactors::count() const { return impl_->count; }
bool SchurFactors::analysed() const { return impl_->analysed; }
bool SchurFactors::holds_factors() const { return impl_->factored; }

void SchurFactors::forget() {
  const LibraryCall guard(impl_->blas_threads);
  Impl& s = *impl_;
  s.close();
  const auto release = [](auto&... room) { ((room = std::remove_cvref_t<decltype(room)>()), ...); };
  release(s.values, s.entries, s.rows, s.columns, s.order, s.list);
  release(s.row_start, s.column, s.c, s.place);
  s.schur.resize(0, 0);
  s.work.resize(0, 0);
}

double SchurFactors::operations() const { return impl_->id.rinfog[0]; }
int SchurFactors::negative_pivots() const {
  return impl_->symmetry == Symmetry::unsymmetric ? 0 : impl_->id.infog[11];
}
double SchurFactors::pivot_ratio() const {
  const double largest = impl_->id.rinfog[20];
  return largest > 0 ? impl_->id.rinfog[18] / largest : 0;
}
std::int64_t SchurFactors::factor_entries() const {
  constexpr std::int64_t million = 1'000'000;
  const int entries = impl_->id.infog[28];
  return entries >= 0 ? entries : -million * entries;
}
const Eigen::MatrixXd& SchurFactors::complement() const { return impl_->schur; }

bool SchurFactors::factor(const SparseMatrix& k) {
  Impl& s = *impl_;
  if (!s.analysed) return false;
  if (s.factored && s.has_values_of(k)) return true;
  s.factored = false;
  s.values.resize(s.entries.size());
  for (std::size_t e = 0; e < s.values.size(); ++e) s.values[e] = k.value[s.entries[e]];
  if (!std::ranges::all_of(s.values, [](double v) { return std::isfinite(v); })) return false;
  const LibraryCall guard(s.blas_threads);
  s.id.a = s.values.data();
  s.point_to_schur();
  constexpr int no_space = -8, no_real_space = -9, most = 3000;
  for (;; s.slack_percent = s.slack_percent * 10 / 3) {
    s.id.icntl[slack] = s.slack_percent;
    s.call(factorise);
    const bool short_of_space = s.id.infog[0] == no_space || s.id.infog[0] == no_real_space;
    if (!short_of_space || s.slack_percent > most) break;
  }
  s.factored = s.id.infog[0] >= 0;
  ++s.count;
  return s.factored;
}

bool SchurFactors::Impl::substitute(int phase, Eigen::MatrixXd& rhs) {
  id.rhs = rhs.data();
  id.nrhs = static_cast<int>(rhs.cols());
  id.lrhs = n;
  id.redrhs = reduced.data();
  id.lredrhs = static_cast<int>(reduced.rows());
  id.icntl[schur_phase] = phase;
  call(back_substitute);
  id.rhs = id.redrhs = nullptr;
  if (id.infog[0] == -13) throw NotEnoughMemory("not enough memory for a solution");
  return id.infog[0] >= 0;
}

bool SchurFactors::reduce(const Eigen::MatrixXd& b, Eigen::MatrixXd& of_c) {
  Impl& s = *impl_;
  const LibraryCall guard(s.blas_threads);
  s.work = b;
  s.reduced.setZero(static_cast<Eigen::Index>(s.c.size()), b.cols());
  constexpr int condense = 1;
  if (!s.substitute(condense, s.work)) return false;
  of_c = s.reduced;
  return true;
}

bool SchurFactors::expand(const Eigen::MatrixXd& x_c, Eigen::MatrixXd& x) {
  Impl& s = *impl_;
  const LibraryCall guard(s.blas_threads);
  s.reduced = x_c;
  constexpr int all = 2;
  if (!s.substitute(all, s.work)) return false;
  x = s.work;
  return true;
}

}  // namespace osculate::la
