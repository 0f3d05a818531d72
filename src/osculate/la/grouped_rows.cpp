#include "osculate/la/grouped_rows.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <type_traits>
#include <utility>

namespace osculate::la {
namespace {

/// By which the largest entry becomes a number near one; of double precision nothing is changed.
template <class Value>
double scale_of(double largest) {
  if constexpr (std::is_same_v<Value, double>) return 1;
  int exponent = 0;
  if (!(largest > 0) || !std::isfinite(largest)) return 1;
  std::frexp(largest, &exponent);
  return std::ldexp(1.0, -exponent);
}

double largest_of(const CompressedRows& a) {
  double largest = 0;
  for (Eigen::Index e = 0; e < a.nonZeros(); ++e)
    largest = std::max(largest, std::abs(a.valuePtr()[e]));
  return largest;
}

/// Sums of a row each, which stay in registers: no loop over the rows is left to the compiler.
template <class Value, class Run, std::size_t... Row>
void sum_up(const Value* values, std::pair<const Run*, const Run*> runs, const double* x,
            double back, double* y, std::index_sequence<Row...> /*rows*/) {
  std::array<double, sizeof...(Row)> sum{};
  for (const Run* run = runs.first; run != runs.second; ++run) {
    const double* const of_run = x + run->first;
    for (Index k = 0; k < run->count; ++k, values += sizeof...(Row))
      ((sum[Row] += static_cast<double>(values[Row]) * of_run[k]), ...);
  }
  ((y[Row] = back * sum[Row]), ...);
}

/// Likewise, of any number of rows.
template <class Value, class Run>
void sum_up_any(Index rows, const Value* values, std::pair<const Run*, const Run*> runs,
                const double* x, double back, double* y) {
  for (Index i = 0; i < rows; ++i) {
    const Value* value = values + i;
    double sum = 0;
    for (const Run* run = runs.first; run != runs.second; ++run)
      for (Index k = 0; k < run->count; ++k, value += rows)
        sum += static_cast<double>(*value) * x[run->first + k];
    y[i] = back * sum;
  }
}

}  // namespace

template <class Value>
GroupedRows<Value>::GroupedRows(const CompressedRows& a, GroupStarts groups, core::Crew& crew)
    : groups_(std::move(groups)),
      columns_(static_cast<Index>(a.cols())),
      scale_(scale_of<Value>(largest_of(a))) {
  find_columns(a);
  values_.assign(first_value_.back(), Value{0});
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

template <class Value>
template <class Other>
GroupedRows<Value>::GroupedRows(const GroupedRows<Other>& of)
    : groups_(of.groups_),
      columns_(of.columns_),
      first_run_(of.first_run_),
      first_value_(of.first_value_) {
  double largest = 0;
  for (const Other value : of.values_)
    largest = std::max(largest, std::abs(static_cast<double>(value)));
  scale_ = scale_of<Value>(largest / of.scale_);
  for (const auto& [first, count] : of.runs_) runs_.push_back({first, count});
  values_.resize(of.values_.size());
  const double factor = scale_ / of.scale_;
  std::ranges::transform(of.values_, values_.begin(), [&](Other value) {
    return static_cast<Value>(factor * static_cast<double>(value));
  });
}

template <class Value>
template <class Other>
void GroupedRows<Value>::copy(const GroupedRows<Other>& from, const std::vector<char>& groups) {
  const double factor = scale_ / from.scale_;
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (std::size_t v = first_value_[g]; groups[g] != 0 && v < first_value_[g + 1]; ++v)
      values_[v] = static_cast<Value>(factor * static_cast<double>(from.values_[v]));
}

/// The columns of a group are those of any of its rows.
template <class Value>
void GroupedRows<Value>::find_columns(const CompressedRows& a) {
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

template <class Value>
void GroupedRows<Value>::multiply(std::size_t g, const double* x, double* y) const {
  const double back = 1 / scale_;
  const std::pair runs{runs_.data() + first_run_[g], runs_.data() + first_run_[g + 1]};
  const Value* const values = values_.data() + first_value_[g];
  switch (const Index size = size_of(g)) {
    case 1:
      return sum_up(values, runs, x, back, y, std::make_index_sequence<1>{});
    case 2:
      return sum_up(values, runs, x, back, y, std::make_index_sequence<2>{});
    case 3:
      return sum_up(values, runs, x, back, y, std::make_index_sequence<3>{});
    case 6:
      return sum_up(values, runs, x, back, y, std::make_index_sequence<6>{});
    default:
      sum_up_any(size, values, runs, x, back, y);
  }
}

template <class Value>
void GroupedRows<Value>::multiply(const Eigen::VectorXd& x, core::Crew& crew,
                                  Eigen::VectorXd& y) const {
  y.resize(groups_.back());
  crew.share_runs(groups_.size() - 1, groups_at_least, [&](std::size_t begin, std::size_t end) {
    for (std::size_t g = begin; g < end; ++g) multiply(g, x.data(), y.data() + groups_[g]);
  });
}

template <class Value>
CompressedRows GroupedRows<Value>::as_rows() const {
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

template <class Value>
Eigen::MatrixXd GroupedRows<Value>::diagonal_block(std::size_t g) const {
  const Index size = size_of(g), begin = groups_[g];
  Eigen::MatrixXd block = Eigen::MatrixXd::Zero(size, size);
  const Value* of_run = values_.data() + first_value_[g];
  for (std::size_t r = first_run_[g]; r < first_run_[g + 1]; ++r) {
    const auto& [first, count] = runs_[r];
    for (Index c = std::max(first, begin); c < std::min(first + count, begin + size); ++c)
      for (Index i = 0; i < size; ++i)
        block(i, c - begin) = static_cast<double>(of_run[size * (c - first) + i]) / scale_;
    of_run += static_cast<std::ptrdiff_t>(size) * count;
  }
  return block;
}

template class GroupedRows<double>;
template class GroupedRows<float>;
template GroupedRows<float>::GroupedRows(const GroupedRows<double>&);
template void GroupedRows<float>::copy(const GroupedRows<double>&, const std::vector<char>&);

}  // namespace osculate::la
