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

}  // namespace

Eigen::VectorXd multiply(const SparseMatrix& k, const Eigen::VectorXd& x) {
  Eigen::VectorXd y(k.n);
  for (Index i = 0; i < k.n; ++i) {
    double sum = 0;
    for (Index e = k.row_start[at(i)]; e < k.row_start[at(i) + 1]; ++e)
      sum += k.value[at(e)] * x[k.column[at(e)]];
    y[i] = sum;
  }
  return y;
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

double* MatrixBuilder::find(Index row, Index column) {
  assert(row >= 0 && row < matrix_.n && column >= 0 && column < matrix_.n);
  const auto first = matrix_.column.begin() + matrix_.row_start[at(row)];
  const auto last = matrix_.column.begin() + matrix_.row_start[at(row) + 1];
  const auto place = std::lower_bound(first, last, column);
  if (place == last || *place != column) return nullptr;
  return matrix_.value.data() + (place - matrix_.column.begin());
}

void MatrixBuilder::reserve_block(std::span<const Index> rows, std::span<const Index> columns) {
  for (const Index i : rows)
    for (const Index j : columns)
      if (i >= 0 && j >= 0 && find(i, j) == nullptr) pending_.push_back({i, j});
  // Bounds the memory of the set-up, and how often what is there is copied.
  const std::size_t most = std::max<std::size_t>(8'000'000, matrix_.column.size() / 2);
  if (pending_.size() > most) merge();
}

void MatrixBuilder::reserve_block(std::span<const Index> unknowns) {
  reserve_block(unknowns, unknowns);
}

void MatrixBuilder::clear() {
  merge();
  std::fill(matrix_.value.begin(), matrix_.value.end(), 0.0);
}

void MatrixBuilder::add(Index row, Index column, double value) {
  if (double* entry = find(row, column))
    *entry += value;
  else
    aside_.push_back({{row, column}, value});
}

void MatrixBuilder::add_block(std::span<const Index> unknowns, const double* values,
                              std::ptrdiff_t stride) {
  order_.clear();
  for (std::size_t j = 0; j < unknowns.size(); ++j)
    if (unknowns[j] >= 0) order_.push_back(j);
  std::sort(order_.begin(), order_.end(),
            [&](std::size_t a, std::size_t b) { return unknowns[a] < unknowns[b]; });
  places_.assign(order_.size(), 0);
  for (const std::size_t i : order_) {
    const Index row = unknowns[i];
    const Index* const first = matrix_.column.data() + matrix_.row_start[at(row)];
    const std::ptrdiff_t count = matrix_.row_start[at(row) + 1] - matrix_.row_start[at(row)];
    double* const sums = matrix_.value.data() + matrix_.row_start[at(row)];
    const double* const entries = values + i;
    std::ptrdiff_t next = 0;
    for (std::size_t k = 0; k < order_.size(); ++k) {
      const Index column = unknowns[order_[k]];
      std::ptrdiff_t place = places_[k];  // where it was in the row before
      if (place >= count || first[place] != column) place = next;
      if (place >= count || first[place] != column)
        place = std::lower_bound(first + next, first + count, column) - first;
      const double value = entries[static_cast<std::ptrdiff_t>(order_[k]) * stride];
      if (place < count && first[place] == column) {
        sums[place] += value;
        places_[k] = place;
        next = place + 1;
      } else if (value != 0.0) {
        aside_.push_back({{row, column}, value});
      }
    }
  }
}

const SparseMatrix& MatrixBuilder::finish() {
  merge();
  return matrix_;
}

void MatrixBuilder::merge() {
  if (pending_.empty() && aside_.empty()) return;
  if (!pending_.empty()) grow();  // what was reserved did not come by entries
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
  if (!pending_.empty()) grow();
  for (const Entry& entry : aside_) *find(entry.at.row, entry.at.column) += entry.value;
  aside_.clear();
}

void MatrixBuilder::grow_by(std::span<const MatrixPlace> places) {
  merge();
  for (const Place& place : places) {
    if (find(place.row, place.column) != nullptr) continue;
    pending_.push_back(place);
    grown_.push_back(place);
  }
  merge();
}

/// Unites the pattern with the pending places. Neither kind is in the pattern before, so it grows.
void MatrixBuilder::grow() {
  const auto rows = at(matrix_.n);
  std::vector<std::size_t> end(rows, 0);  // buckets of new columns, one a row
  for (const Place& place : pending_) ++end[at(place.row)];
  std::size_t total = 0;
  for (std::size_t& e : end) {
    const std::size_t count = e;
    e = total;
    total += count;
  }
  std::vector<Index> fresh(total);
  for (const Place& place : pending_) fresh[end[at(place.row)]++] = place.column;
  pending_.clear();

  SparseMatrix grown;
  grown.n = matrix_.n;
  grown.row_start.assign(rows + 1, 0);
  grown.column.reserve(matrix_.column.size() + total / 2);
  grown.value.reserve(matrix_.column.size() + total / 2);
  auto from = fresh.begin();
  for (std::size_t i = 0; i < rows; ++i) {
    const auto to = fresh.begin() + static_cast<std::ptrdiff_t>(end[i]);
    std::sort(from, to);
    const auto last = std::unique(from, to);
    for (Index e = matrix_.row_start[i]; e < matrix_.row_start[i + 1]; ++e) {
      for (; from != last && *from < matrix_.column[at(e)]; ++from) {
        grown.column.push_back(*from);
        grown.value.push_back(0.0);
      }
      grown.column.push_back(matrix_.column[at(e)]);
      grown.value.push_back(matrix_.value[at(e)]);
    }
    grown.column.insert(grown.column.end(), from, last);
    grown.value.resize(grown.column.size(), 0.0);
    grown.row_start[i + 1] = static_cast<Index>(grown.column.size());
    from = to;
  }
  matrix_ = std::move(grown);
  ++version_;
}

}  // namespace osculate::la
