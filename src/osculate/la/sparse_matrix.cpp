#include "osculate/la/sparse_matrix.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace osculate::la {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Empties it, and gives its memory back.
template <class T>
void release(std::vector<T>& of) {
  std::vector<T>().swap(of);
}

}  // namespace

Eigen::VectorXd multiply(const SparseMatrix& k, const Eigen::VectorXd& x) {
  Eigen::VectorXd y(k.n);
  for (Index i = 0; i < k.n; ++i) {
    double sum = 0;
    for (Index e = k.row_start[at(i)]; e < k.row_start[at(i) + 1]; ++e)
      sum += k.value[at(e)] * x[k.column[at(e)]];
    y[i] = sum;
  }
  if (k.ranks) k.ranks->sum({y.data(), at(k.n)});
  return y;
}

Eigen::VectorXd multiply_symmetric(const SparseMatrix& k, const Eigen::VectorXd& x) {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(k.n);
  for (Index i = 0; i < k.n; ++i) {
    double sum = 0;
    for (Index e = k.row_start[at(i)]; e < k.row_start[at(i) + 1]; ++e) {
      const Index j = k.column[at(e)];
      const double value = k.value[at(e)];
      if (i > j) continue;
      sum += value * x[j];
      if (i != j) y[j] += value * x[i];
    }
    y[i] += sum;
  }
  if (k.ranks) k.ranks->sum({y.data(), at(k.n)});
  return y;
}

double entry_count(const SparseMatrix& k) {
  const auto here = static_cast<double>(k.value.size());
  return k.ranks ? k.ranks->sum(here) : here;
}

void take_out(const SparseMatrix& k, std::span<const Index> c, SparseMatrix& out) {
  std::vector<Index> place(at(k.n), -1);
  for (std::size_t a = 0; a < c.size(); ++a) place[at(c[a])] = static_cast<Index>(a);
  out.n = static_cast<Index>(c.size());
  out.row_start.assign(1, 0);
  out.column.clear();
  out.value.clear();
  for (const Index i : c) {
    for (Index e = k.row_start[at(i)]; e < k.row_start[at(i) + 1]; ++e)
      if (const Index j = place[at(k.column[at(e)])]; j >= 0) {
        out.column.push_back(j);
        out.value.push_back(k.value[at(e)]);
      }
    out.row_start.push_back(static_cast<Index>(out.column.size()));
  }
}

double relative_residual(const SparseMatrix& k, const Eigen::VectorXd& x,
                         const Eigen::VectorXd& b) {
  if (k.n == 0) return 0;
  const double rest = Eigen::VectorXd(b - multiply(k, x)).stableNorm();
  if (rest == 0) return 0;
  const double ratio = rest / b.stableNorm();
  return std::isfinite(ratio) ? ratio : std::numeric_limits<double>::infinity();
}

MatrixBuilder::MatrixBuilder(Index n) {
  matrix_.n = n;
  matrix_.row_start.resize(at(n) + 1);
  matrix_.column.resize(at(n));
  matrix_.value.assign(at(n), 0.0);
  for (Index i = 0; i < n; ++i) {
    matrix_.row_start[at(i) + 1] = i + 1;
    matrix_.column[at(i)] = i;
  }
}

MatrixBuilder::MatrixBuilder(Index n, const core::Ranks* ranks, std::vector<bool> mine)
    : mine_(std::move(mine)) {
  matrix_.n = n;
  matrix_.ranks = ranks;
  matrix_.row_start.assign(1, 0);
  for (Index i = 0; i < n; ++i) {
    if (here(i)) matrix_.column.push_back(i);
    matrix_.row_start.push_back(static_cast<Index>(matrix_.column.size()));
  }
  matrix_.value.assign(matrix_.column.size(), 0.0);
}

double* MatrixBuilder::find(Index row, Index column) {
  assert(row >= 0 && row < matrix_.n && column >= 0 && column < matrix_.n);
  const auto first = matrix_.column.begin() + matrix_.row_start[at(row)];
  const auto last = matrix_.column.begin() + matrix_.row_start[at(row) + 1];
  const auto place = std::lower_bound(first, last, column);
  if (place == last || *place != column) return nullptr;
  return matrix_.value.data() + (place - matrix_.column.begin());
}

bool MatrixBuilder::has(std::span<const Index> rows, std::span<const Index> columns) {
  for (const Index i : rows)
    for (const Index j : columns)
      if (here(i) && j >= 0 && find(i, j) == nullptr) return false;
  return true;
}

void MatrixBuilder::reserve_block(std::span<const Index> rows, std::span<const Index> columns) {
  if (has(rows, columns)) return;
  const std::size_t begin = block_unknowns_.size();
  for (const Index i : rows)
    if (here(i)) block_unknowns_.push_back(i);
  const std::size_t between = block_unknowns_.size();
  for (const Index j : columns)
    if (j >= 0) block_unknowns_.push_back(j);
  blocks_.push_back({begin, between, block_unknowns_.size()});
}

void MatrixBuilder::reserve_block(std::span<const Index> unknowns) {
  reserve_block(unknowns, unknowns);
}

void MatrixBuilder::clear() {
  merge();
  std::fill(matrix_.value.begin(), matrix_.value.end(), 0.0);
  matrix_.mark.reset();
}

void MatrixBuilder::clear(std::span<const Index> rows) {
  merge();
  for (const Index i : rows) {
    touch(i);
    std::fill(matrix_.value.begin() + matrix_.row_start[at(i)],
              matrix_.value.begin() + matrix_.row_start[at(i) + 1], 0.0);
  }
}

void MatrixBuilder::keep_values() {
  merge();
  kept_ = matrix_.value;
  mark_ = std::make_shared<const char>();
  begin_touching();
}

void MatrixBuilder::begin_touching() {
  touched_.assign(at(matrix_.n), false);
  matrix_.touched.clear();
  matrix_.mark = mark_;
}

bool MatrixBuilder::restore_values() {
  merge();
  if (kept_.empty()) return false;
  const auto copy = [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    std::copy(kept_.begin() + begin, kept_.begin() + end, matrix_.value.begin() + begin);
  };
  if (matrix_.mark == nullptr)
    copy(0, std::ssize(kept_));
  else
    for (const Index i : matrix_.touched)
      copy(matrix_.row_start[at(i)], matrix_.row_start[at(i) + 1]);
  begin_touching();
  return true;
}

void MatrixBuilder::forget_values() {
  release(kept_);
  touched_.clear();
  mark_.reset();
  matrix_.mark.reset();
  matrix_.touched.clear();
}

void MatrixBuilder::add(Index row, Index column, double value) {
  if (!here(row)) return;
  if (double* entry = find(row, column)) {
    touch(row);
    *entry += value;
  } else
    aside_.push_back({{row, column}, value});
}

void MatrixBuilder::order(std::span<const Index> columns) {
  order_.clear();
  for (std::size_t j = 0; j < columns.size(); ++j)
    if (columns[j] >= 0) order_.push_back(j);
  std::sort(order_.begin(), order_.end(),
            [&](std::size_t a, std::size_t b) { return columns[a] < columns[b]; });
  sorted_.clear();
  for (const std::size_t j : order_) sorted_.push_back(columns[j]);
  places_.assign(order_.size(), 0);
  row_.resize(order_.size());
  all_found_ = false;
}

namespace {

/// The first of the sorted columns that is not less than this one. Without branches: where it is
/// can not be predicted, and several searches go on at a time.
std::ptrdiff_t first_not_below(std::span<const Index> sorted, Index column) {
  const Index* from = sorted.data();
  for (std::size_t n = sorted.size(); n > 1;) {
    const std::size_t half = n / 2;
    from += half * static_cast<std::size_t>(from[half - 1] < column);
    n -= half;
  }
  return from - sorted.data() + static_cast<std::ptrdiff_t>(*from < column);
}

}  // namespace

/// Whether the columns are where they were in the row before.
bool MatrixBuilder::are_in_places(std::span<const Index> row) const {
  if (!all_found_ || at(places_.back()) >= row.size()) return false;
  Index differs = 0;
  for (std::size_t k = 0; k < places_.size(); ++k) differs |= row[at(places_[k])] ^ sorted_[k];
  return differs == 0;
}

void MatrixBuilder::find_places(std::span<const Index> row) {
  all_found_ = true;
  std::ptrdiff_t next = 0;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const auto is_next = [&] {
      return static_cast<std::size_t>(next) < row.size() &&
             row[static_cast<std::size_t>(next)] == sorted_[k];
    };
    if (!is_next()) next = first_not_below(row, sorted_[k]);
    const bool found = is_next();
    places_[k] = found ? static_cast<Index>(next++) : -1;
    all_found_ = all_found_ && found;
  }
}

void MatrixBuilder::add_to_row(Index row) {
  const Index begin = matrix_.row_start[at(row)], end = matrix_.row_start[at(row) + 1];
  const std::span columns(matrix_.column.data() + begin, matrix_.column.data() + end);
  double* const sums = matrix_.value.data() + begin;
  if (!are_in_places(columns)) find_places(columns);
  touch(row);
  for (std::size_t k = 0; k < places_.size(); ++k)
    if (places_[k] >= 0)
      sums[places_[k]] += row_[k];
    else if (row_[k] != 0.0)
      aside_.push_back({{row, sorted_[k]}, row_[k]});
}

void MatrixBuilder::add_block(std::span<const Index> unknowns, const double* values,
                              std::ptrdiff_t stride) {
  add_block(unknowns, unknowns, values, stride);
}

void MatrixBuilder::add_block(std::span<const Index> rows, std::span<const Index> columns,
                              const double* values, std::ptrdiff_t stride) {
  order(columns);
  if (order_.empty()) return;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!here(rows[i])) continue;
    for (std::size_t k = 0; k < order_.size(); ++k)
      row_[k] =
          values[static_cast<std::ptrdiff_t>(i) + static_cast<std::ptrdiff_t>(order_[k]) * stride];
    add_to_row(rows[i]);
  }
}

void MatrixBuilder::add_product(std::span<const Index> rows,
                                const Eigen::Ref<const Eigen::MatrixXd>& first,
                                std::span<const Index> columns,
                                const Eigen::Ref<const Eigen::MatrixXd>& second) {
  order(columns);
  if (order_.empty()) return;
  const auto n = static_cast<Eigen::Index>(order_.size());
  const Eigen::Index rank = first.cols();
  factor_.resize(order_.size() * static_cast<std::size_t>(rank));
  Eigen::Map<Eigen::MatrixXd> factor(factor_.data(), n, rank);
  for (Eigen::Index k = 0; k < n; ++k)
    factor.row(k) =
        second.col(static_cast<Eigen::Index>(order_[static_cast<std::size_t>(k)])).transpose();
  Eigen::Map<Eigen::VectorXd> sum(row_.data(), n);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto row = first.row(static_cast<Eigen::Index>(i));
    if (!here(rows[i]) || row.isZero(0)) continue;
    sum.setZero();
    for (Eigen::Index r = 0; r < rank; ++r)
      if (row[r] != 0.0) sum += row[r] * factor.col(r);
    add_to_row(rows[i]);
  }
}

const SparseMatrix& MatrixBuilder::finish() {
  merge();
  return matrix_;
}

void MatrixBuilder::merge() {
  if (!waits() && aside_.empty()) return;
  if (waits()) grow();  // what was reserved did not come by entries
  const auto before = static_cast<std::ptrdiff_t>(grown_.size());
  for (const Entry& entry : aside_) {
    if (find(entry.at.row, entry.at.column) != nullptr) continue;
    pending_.push_back(entry.at);
    grown_.push_back(entry.at);
  }
  const auto key = [](const Place& p) { return std::pair(p.row, p.column); };
  std::sort(grown_.begin() + before, grown_.end(),
            [&](const Place& a, const Place& b) { return key(a) < key(b); });
  const auto same = [&](const Place& a, const Place& b) { return key(a) == key(b); };
  grown_.erase(std::unique(grown_.begin() + before, grown_.end(), same), grown_.end());
  if (waits()) grow();
  for (const Entry& entry : aside_) {
    touch(entry.at.row);
    *find(entry.at.row, entry.at.column) += entry.value;
  }
  release(aside_);
}

void MatrixBuilder::grow_by(std::span<const MatrixPlace> places) {
  merge();
  for (const Place& place : places) {
    if (here(place.row)) {
      if (find(place.row, place.column) != nullptr) continue;
      pending_.push_back(place);
    }
    grown_.push_back(place);  // those of other processes, too: checkpoints add to what they had
  }
  merge();
}

namespace {

/// Lists by row, one behind the other: those of row i are items[start[i]] to items[start[i + 1]].
struct ByRow {
  std::vector<std::size_t> start;
  std::vector<Index> items;
};
/// Input      each(take): calls take(row, item) for all of them, twice in the same order
template <class Each>
ByRow by_row(std::size_t rows, const Each& each) {
  ByRow out;
  out.start.assign(rows + 2, 0);  // shifted by one while they are filled
  each([&](Index row, Index) { ++out.start[at(row) + 2]; });
  for (std::size_t i = 0; i < rows; ++i) out.start[i + 2] += out.start[i + 1];
  out.items.resize(out.start[rows + 1]);
  each([&](Index row, Index item) { out.items[out.start[at(row) + 1]++] = item; });
  out.start.pop_back();
  return out;
}

/// Gives rows further columns, of a value of zero, where the entries stand: from the last row on,
/// which is moved farthest. A thirty-second of them is kept as room for what comes later.
///
/// Requires   `fresh` of a row sorted, and not in it; `kept` empty, or one for each entry
void insert(const ByRow& fresh, SparseMatrix& k, std::vector<double>& kept) {
  constexpr std::size_t room = 32;
  const std::size_t size = k.column.size() + fresh.items.size();
  const auto resize = [&](auto& of) {
    if (of.capacity() < size) of.reserve(size + size / room);
    of.resize(size);
  };
  resize(k.column);
  resize(k.value);
  if (!kept.empty()) resize(kept);
  const auto put = [&](std::size_t to, Index column, double value, double kept_value) {
    k.column[to] = column;
    k.value[to] = value;
    if (!kept.empty()) kept[to] = kept_value;
  };
  for (std::size_t i = at(k.n), f = fresh.items.size(); f > 0 && i-- > 0;) {
    const std::size_t begin = at(k.row_start[i]);
    std::size_t end = at(k.row_start[i + 1]), to = end + f;
    k.row_start[i + 1] = static_cast<Index>(to);
    while (end > begin || f > fresh.start[i])
      if (end == begin || (f > fresh.start[i] && fresh.items[f - 1] > k.column[end - 1])) {
        put(--to, fresh.items[--f], 0.0, 0.0);
      } else {
        --end;
        put(--to, k.column[end], k.value[end], kept.empty() ? 0.0 : kept[end]);
      }
  }
}

}  // namespace

/// Unites the pattern with what waits. Neither kind is all in the pattern before, so it grows. What
/// was kept is of the new pattern then.
void MatrixBuilder::grow() {
  const auto rows = at(matrix_.n);
  const ByRow blocks = by_row(rows, [&](const auto& take) {
    for (std::size_t b = 0; b < blocks_.size(); ++b)
      for (std::size_t k = blocks_[b].rows; k < blocks_[b].columns; ++k)
        take(block_unknowns_[k], static_cast<Index>(b));
  });
  const ByRow single = by_row(rows, [&](const auto& take) {
    for (const Place& place : pending_) take(place.row, place.column);
  });
  ByRow fresh{{0}, {}};
  std::vector<Index> seen(rows, -1);  // the row in which a column was seen last
  for (std::size_t i = 0; i < rows; ++i) {
    const auto row = static_cast<Index>(i);
    const bool grows =
        blocks.start[i] < blocks.start[i + 1] || single.start[i] < single.start[i + 1];
    for (Index e = matrix_.row_start[i]; grows && e < matrix_.row_start[i + 1]; ++e)
      seen[at(matrix_.column[at(e)])] = row;
    const auto take = [&](Index column) {
      if (std::exchange(seen[at(column)], row) != row) fresh.items.push_back(column);
    };
    for (std::size_t k = blocks.start[i]; k < blocks.start[i + 1]; ++k) {
      const Block& block = blocks_[at(blocks.items[k])];
      for (std::size_t c = block.columns; c < block.end; ++c) take(block_unknowns_[c]);
    }
    for (std::size_t k = single.start[i]; k < single.start[i + 1]; ++k) take(single.items[k]);
    std::sort(fresh.items.begin() + static_cast<std::ptrdiff_t>(fresh.start[i]), fresh.items.end());
    fresh.start.push_back(fresh.items.size());
  }
  release(blocks_);
  release(block_unknowns_);
  release(pending_);
  insert(fresh, matrix_, kept_);
  if (!kept_.empty()) mark_ = std::make_shared<const char>();
  if (matrix_.mark) matrix_.mark = mark_;
  ++version_;
}

}  // namespace osculate::la
