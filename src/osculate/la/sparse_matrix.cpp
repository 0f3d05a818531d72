#include "osculate/la/sparse_matrix.hpp"

#include <algorithm>

namespace osculate::la {

Eigen::VectorXd multiply(const SparseMatrix& k, const Eigen::VectorXd& x) {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(k.n);
  for (Index i = 0; i < k.n; ++i)
    for (Index e = k.row_start[static_cast<std::size_t>(i)];
         e < k.row_start[static_cast<std::size_t>(i) + 1]; ++e)
      y[i] += k.value[static_cast<std::size_t>(e)] * x[k.column[static_cast<std::size_t>(e)]];
  return y;
}

MatrixBuilder::MatrixBuilder(Index n) {
  matrix_.n = n;
  matrix_.row_start.resize(static_cast<std::size_t>(n) + 1);
  matrix_.column.resize(static_cast<std::size_t>(n));
  matrix_.value.assign(static_cast<std::size_t>(n), 0.0);
  for (Index i = 0; i < n; ++i) {
    matrix_.row_start[static_cast<std::size_t>(i) + 1] = i + 1;
    matrix_.column[static_cast<std::size_t>(i)] = i;
  }
}

void MatrixBuilder::reserve_block(std::span<const Index> unknowns) {
  for (const Index i : unknowns)
    for (const Index j : unknowns)
      if (i >= 0 && j >= 0 && i != j) aside_.push_back({i, j, 0.0});
  constexpr std::size_t most = 4'000'000;  // bounds the memory of the set-up
  if (aside_.size() > most) merge();
}

void MatrixBuilder::clear() {
  if (!aside_.empty()) merge();
  std::fill(matrix_.value.begin(), matrix_.value.end(), 0.0);
}

void MatrixBuilder::add(Index row, Index column, double value) {
  const auto begin = matrix_.column.begin() + matrix_.row_start[static_cast<std::size_t>(row)];
  const auto end = matrix_.column.begin() + matrix_.row_start[static_cast<std::size_t>(row) + 1];
  const auto at = std::lower_bound(begin, end, column);
  if (at != end && *at == column)
    matrix_.value[static_cast<std::size_t>(at - matrix_.column.begin())] += value;
  else
    aside_.push_back({row, column, value});
}

const SparseMatrix& MatrixBuilder::finish() {
  if (!aside_.empty()) merge();
  return matrix_;
}

void MatrixBuilder::merge() {
  std::stable_sort(aside_.begin(), aside_.end(), [](const Entry& a, const Entry& b) {
    return a.row != b.row ? a.row < b.row : a.column < b.column;
  });
  SparseMatrix grown;
  grown.n = matrix_.n;
  grown.row_start.reserve(static_cast<std::size_t>(grown.n) + 1);
  grown.row_start.push_back(0);
  std::size_t next = 0;
  const auto push = [&](Index column, double value) {
    const bool same = static_cast<Index>(grown.column.size()) > grown.row_start.back() &&
                      grown.column.back() == column;
    if (same) {
      grown.value.back() += value;
    } else {
      grown.column.push_back(column);
      grown.value.push_back(value);
    }
  };
  for (Index row = 0; row < grown.n; ++row) {
    for (Index e = matrix_.row_start[static_cast<std::size_t>(row)];
         e < matrix_.row_start[static_cast<std::size_t>(row) + 1]; ++e) {
      const Index column = matrix_.column[static_cast<std::size_t>(e)];
      for (; next < aside_.size() && aside_[next].row == row && aside_[next].column < column; ++next)
        push(aside_[next].column, aside_[next].value);
      push(column, matrix_.value[static_cast<std::size_t>(e)]);
      for (; next < aside_.size() && aside_[next].row == row && aside_[next].column == column; ++next)
        push(aside_[next].column, aside_[next].value);
    }
    for (; next < aside_.size() && aside_[next].row == row; ++next)
      push(aside_[next].column, aside_[next].value);
    grown.row_start.push_back(static_cast<Index>(grown.column.size()));
  }
  if (grown.column.size() != matrix_.column.size()) ++version_;
  matrix_ = std::move(grown);
  aside_.clear();
}

}  // namespace osculate::la
