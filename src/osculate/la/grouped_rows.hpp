#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <span>
#include <vector>

#include "osculate/core/crew.hpp"
#include "osculate/la/compressed_rows.hpp"

namespace osculate::la {

/// Groups of unknowns, as those of a node: group g has the unknowns start[g] to start[g + 1] - 1.
using GroupStarts = std::vector<Index>;

/// A matrix that vectors and matrices are multiplied with. Rows of a group have their columns in
/// common: entries of a column stand together, and consecutive columns are named once, so that an
/// entry of three rows takes little more memory than its value, which is what a product waits for.
///
/// Formula    y = A x . Each row is summed up in the order of its columns, so that the bits are
/// those
///            of `multiply`, and depend on no number of threads.
/// Tested by  tests/unit/la/test_grouped_rows.cpp
class GroupedRows {
 public:
  /// Consecutive columns.
  struct Run {
    Index first, count;
  };
  GroupedRows() = default;
  GroupedRows(const CompressedRows& a, GroupStarts groups, core::Crew& crew);
  /// Takes the rows of another matrix: the groups in which it differs. False: an entry has no
  /// place, and no product is to be made before another matrix is assigned.
  ///
  /// Input      rows(i, take): calls take(column, value) for what is not zero in row i;
  ///            may_differ: groups that are looked at, null: all
  template <class Rows>
  bool update(const Rows& rows, core::Crew& crew, std::vector<char>& differs,
              const std::vector<char>* may_differ = nullptr) {
    differs.assign(groups_.size() - 1, 0);
    std::atomic<bool> fits = true;
    crew.share_runs(groups_.size() - 1, groups_at_least, [&](std::size_t begin, std::size_t end) {
      std::vector<double> values;
      for (std::size_t g = begin; g < end && fits; ++g) {
        if (may_differ && (*may_differ)[g] == 0) continue;
        values.assign(first_value_[g + 1] - first_value_[g], 0.0);
        for (Index i = 0; i < size_of(g); ++i)
          if (!put([&](const auto& take) { rows(groups_[g] + i, take); }, g, i, values.data()))
            fits = false;
        if (std::equal(values.begin(), values.end(), of_group(g))) continue;
        std::copy(values.begin(), values.end(), of_group(g));
        differs[g] = 1;
      }
    });
    return fits;
  }
  void multiply(const Eigen::VectorXd& x, core::Crew& crew, Eigen::VectorXd& y) const;
  /// Entries that are not zero, and those of the diagonal.
  [[nodiscard]] CompressedRows as_rows() const;
  [[nodiscard]] std::size_t entries() const { return first_value_.back(); }
  [[nodiscard]] Index rows() const { return groups_.back(); }
  [[nodiscard]] const GroupStarts& groups() const { return groups_; }
  /// Calls take(row, column, value) for what is not zero, and for the diagonal.
  template <class Take>
  void for_each(const Take& take) const {
    for (std::size_t g = 0; g + 1 < groups_.size(); ++g) for_each(g, take);
  }
  /// The same in the rows of a group.
  template <class Take>
  void for_each(std::size_t g, const Take& take) const {
    for (Index i = 0; i < size_of(g); ++i) {
      const double* next = values_.data() + first_value_[g] + i;
      for (const Run& run : runs(g))
        for (Index k = 0; k < run.count; ++k, next += size_of(g))
          if (const Index row = groups_[g] + i, column = run.first + k; *next != 0 || row == column)
            take(row, column, *next);
    }
  }
  /// The same in some columns, of which `before` says how many are below each.
  ///
  /// Shapes     before: one more than there are columns
  template <class Take>
  void for_each(const std::vector<Index>& before, const Take& take) const {
    const auto has = [&](Index from, Index to) {
      return before[as_size(from)] < before[as_size(to)];
    };
    const auto is_in = [&](const Run& run) { return has(run.first, run.first + run.count); };
    for (std::size_t g = 0; g + 1 < groups_.size(); ++g) {
      if (std::ranges::none_of(runs(g), is_in)) continue;
      for (Index i = 0; i < size_of(g); ++i) {
        const double* of_run = values_.data() + first_value_[g] + i;
        for (const auto& [first, count] : runs(g)) {
          for (Index c = first; has(c, first + count); ++c)
            if (const double value = of_run[size_of(g) * (c - first)];
                has(c, c + 1) && (value != 0 || c == groups_[g] + i))
              take(groups_[g] + i, c, value);
          of_run += static_cast<std::ptrdiff_t>(size_of(g)) * count;
        }
      }
    }
  }
  /// Entries of a group's rows in the columns of the same numbers.
  [[nodiscard]] Eigen::MatrixXd diagonal_block(std::size_t group) const;
  [[nodiscard]] std::span<const Run> runs(std::size_t group) const {
    return {runs_.data() + first_run_[group], first_run_[group + 1] - first_run_[group]};
  }
  /// Entries in the columns of the runs, column by column, the rows of one behind each other.
  [[nodiscard]] std::span<const double> values(std::size_t group) const {
    return {values_.data() + first_value_[group], first_value_[group + 1] - first_value_[group]};
  }
  /// Of each row, in size.
  [[nodiscard]] Eigen::VectorXd largest_entries() const;
  [[nodiscard]] Index columns() const { return columns_; }

 private:
  static constexpr std::size_t groups_at_least = 64;  ///< while a thread is told of them
  [[nodiscard]] Index size_of(std::size_t group) const {
    return groups_[group + 1] - groups_[group];
  }
  void multiply(std::size_t group, const double* x, double* y_of_group) const;
  void find_columns(const CompressedRows& a, core::Crew& crew);
  [[nodiscard]] double* of_group(std::size_t group) { return values_.data() + first_value_[group]; }
  /// Writes row `i` of a group among the values of the group. False: an entry has no place.
  template <class Row>
  bool put(const Row& row, std::size_t group, Index i, double* values) const {
    const Run* run = runs_.data() + first_run_[group];
    const Run* const end = runs_.data() + first_run_[group + 1];
    const auto rows = static_cast<std::ptrdiff_t>(size_of(group));
    double* of_run = values + i;
    bool fits = true;
    row([&](Index column, double value) {
      for (; run != end && run->first + run->count <= column; ++run) of_run += rows * run->count;
      fits = fits && run != end && column >= run->first;
      if (fits) of_run[rows * (column - run->first)] = value;
    });
    return fits;
  }

  GroupStarts groups_{0};
  Index columns_ = 0;
  std::vector<std::size_t> first_run_{0}, first_value_{0};
  std::vector<Run> runs_;  ///< of consecutive columns
  Eigen::VectorXd values_;
};

}  // namespace osculate::la
