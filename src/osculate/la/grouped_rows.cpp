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
  find_columns(a, crew);
  values_.resize(static_cast<Eigen::Index>(first_value_.back()));
  crew.share_runs(groups_.size() - 1, groups_at_least, [&](std::size_t begin, std::size_t end) {
    std::fill(of_group(begin), of_group(end), 0.0);
    for (std::size_t g = begin; g < end; ++g)
      for (Index i = 0; i < size_of(g); ++i) {
        const auto row = [&](const auto& take) {
          for (CompressedRows::InnerIterator entry(a, groups_[g] + i); entry; ++entry)
            take(static_cast<Index>(entry.col()), entry.value());
        };
        put(row, g, i, of_group(g));
      }
  });
}

namespace {

/// Those of some groups that follow each other.
struct RunsOfGroups {
  std::vector<GroupedRows::Run> run;
  std::vector<std::size_t> end, columns;  ///< of each group
};

/// The columns of a group are those of any of its rows.
void add_group(const CompressedRows& a, Index first, Index last, std::vector<Index>& columns,
               std::vector<Index>& before, RunsOfGroups& to) {
  columns.clear();
  for (Index i = first; i < last; ++i) {
    const Index *const begin = a.innerIndexPtr() + a.outerIndexPtr()[i],
                       *const end = a.innerIndexPtr() + a.outerIndexPtr()[i + 1];
    if (std::equal(begin, end, columns.begin(), columns.end())) continue;
    before.swap(columns);
    columns.clear();
    std::set_union(before.begin(), before.end(), begin, end, std::back_inserter(columns));
  }
  const std::size_t others = to.run.size();
  for (const Index column : columns)
    if (to.run.size() > others && to.run.back().first + to.run.back().count == column)
      ++to.run.back().count;
    else
      to.run.push_back({column, 1});
  to.end.push_back(to.run.size());
  to.columns.push_back(columns.size());
}

}  // namespace

void GroupedRows::find_columns(const CompressedRows& a, core::Crew& crew) {
  const std::size_t groups = groups_.size() - 1;
  const std::size_t pieces = std::clamp<std::size_t>(groups / groups_at_least, 1, 8);
  std::vector<RunsOfGroups> of(pieces);
  crew.share(pieces, [&](std::size_t p) {
    std::vector<Index> columns, before;
    for (std::size_t g = groups * p / pieces; g < groups * (p + 1) / pieces; ++g)
      add_group(a, groups_[g], groups_[g + 1], columns, before, of[p]);
  });
  for (const RunsOfGroups& piece : of) {
    const std::size_t first = runs_.size(), g = first_value_.size() - 1;
    runs_.insert(runs_.end(), piece.run.begin(), piece.run.end());
    for (std::size_t i = 0; i < piece.end.size(); ++i) {
      first_run_.push_back(first + piece.end[i]);
      first_value_.push_back(first_value_.back() + piece.columns[i] * as_size(size_of(g + i)));
    }
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
