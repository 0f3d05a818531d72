#include "osculate/la/grouped_rows.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace osculate::la {
namespace {

/// Sums of a row each, which stay in registers: no loop over the rows is left to the compiler.
template <std::size_t... Row>
void sum_up(const double* values, std::span<const GroupedRows::Run> runs, const double* x,
            double* y, std::index_sequence<Row...> /*rows*/) {
  std::array<double, sizeof...(Row)> sum{};
  for (const GroupedRows::Run& run : runs) {
    const double* const of_run = x + run.first;
    for (Index k = 0; k < run.count; ++k, values += sizeof...(Row))
      ((sum[Row] += values[Row] * of_run[k]), ...);
  }
  ((y[Row] = sum[Row]), ...);
}

/// Likewise, of any number of rows.
void sum_up_any(Index rows, const double* values, std::span<const GroupedRows::Run> runs,
                const double* x, double* y) {
  for (Index i = 0; i < rows; ++i) {
    const double* value = values + i;
    double sum = 0;
    for (const GroupedRows::Run& run : runs)
      for (Index k = 0; k < run.count; ++k, value += rows) sum += *value * x[run.first + k];
    y[i] = sum;
  }
}

}  // namespace

GroupedRows::GroupedRows(const CompressedRows& a, GroupStarts groups, core::Crew& crew)
    : groups_(std::move(groups)), columns_(static_cast<Index>(a.cols())) {
  find_columns(a);
  values_.assign(first_value_.back(), 0.0);
  crew.share_runs(groups_.size() - 1, groups_at_least, [&](std::size_t begin, std::size_t end) {
    for (std::size_t g = begin; g < end; ++g)
      for (Index i = 0; i < size_of(g); ++i) {
        const auto row = [&](const auto& take) {
          for (CompressedRows::InnerIterator entry(a, groups_[g] + i); entry; ++entry)
            take(static_cast<Index>(entry.col()), entry.value());
        };
        put(row, g, i, values_.data() + first_value_[g]);
      }
  });
}

/// The columns of a group are those of any of its rows.
void GroupedRows::find_columns(const CompressedRows& a) {
  std::vector<Index> columns, before;
  for (std::size_t g = 0; g + 1 < groups_.size(); ++g) {
    columns.clear();
    for (Index i = groups_[g]; i < groups_[g + 1]; ++i) {
      const Index *const begin = a.innerIndexPtr() + a.outerIndexPtr()[i],
                         *const end = a.innerIndexPtr() + a.outerIndexPtr()[i + 1];
      if (std::equal(begin, end, columns.begin(), columns.end())) continue;
      before.swap(columns);
      columns.clear();
      std::set_union(before.begin(), before.end(), begin, end, std::back_inserter(columns));
    }
    for (const Index column : columns)
      if (runs_.size() > first_run_[g] && runs_.back().first + runs_.back().count == column)
        ++runs_.back().count;
      else
        runs_.push_back({column, 1});
    first_run_.push_back(runs_.size());
    first_value_.push_back(first_value_[g] + columns.size() * as_size(size_of(g)));
  }
}

void GroupedRows::multiply(std::size_t g, const double* x, double* y) const {
  const double* const of = values(g).data();
  switch (const Index size = size_of(g)) {
    case 1:
      return sum_up(of, runs(g), x, y, std::make_index_sequence<1>{});
    case 2:
      return sum_up(of, runs(g), x, y, std::make_index_sequence<2>{});
    case 3:
      return sum_up(of, runs(g), x, y, std::make_index_sequence<3>{});
    case 6:
      return sum_up(of, runs(g), x, y, std::make_index_sequence<6>{});
    default:
      sum_up_any(size, of, runs(g), x, y);
  }
}

void GroupedRows::multiply(const Eigen::VectorXd& x, core::Crew& crew, Eigen::VectorXd& y) const {
  y.resize(groups_.back());
  crew.share_runs(groups_.size() - 1, groups_at_least, [&](std::size_t begin, std::size_t end) {
    for (std::size_t g = begin; g < end; ++g) multiply(g, x.data(), y.data() + groups_[g]);
  });
}

CompressedRows GroupedRows::as_rows() const {
  CompressedRows a(groups_.back(), columns_);
  for_each([&](Index row, Index, double) { ++a.outerIndexPtr()[row + 1]; });
  std::partial_sum(a.outerIndexPtr(), a.outerIndexPtr() + a.rows() + 1, a.outerIndexPtr());
  a.resizeNonZeros(a.outerIndexPtr()[a.rows()]);
  Index next = 0;
  for_each([&](Index, Index column, double value) {
    a.innerIndexPtr()[next] = column;
    a.valuePtr()[next++] = value;
  });
  return a;
}

Eigen::VectorXd GroupedRows::largest_entries() const {
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(rows());
  for (std::size_t g = 0; g + 1 < groups_.size(); ++g) {
    const Eigen::Map<const Eigen::MatrixXd> block(
        values(g).data(), size_of(g), size_of(g) > 0 ? std::ssize(values(g)) / size_of(g) : 0);
    if (block.cols() > 0)
      largest.segment(groups_[g], size_of(g)) = block.cwiseAbs().rowwise().maxCoeff();
  }
  return largest;
}

Eigen::MatrixXd GroupedRows::diagonal_block(std::size_t g) const {
  const Index size = size_of(g), begin = groups_[g];
  Eigen::MatrixXd block = Eigen::MatrixXd::Zero(size, size);
  const double* of_run = values_.data() + first_value_[g];
  for (std::size_t r = first_run_[g]; r < first_run_[g + 1]; ++r) {
    const auto& [first, count] = runs_[r];
    for (Index c = std::max(first, begin); c < std::min(first + count, begin + size); ++c)
      for (Index i = 0; i < size; ++i) block(i, c - begin) = of_run[size * (c - first) + i];
    of_run += static_cast<std::ptrdiff_t>(size) * count;
  }
  return block;
}

}  // namespace osculate::la
