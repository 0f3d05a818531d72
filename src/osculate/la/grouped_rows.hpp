#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "osculate/core/crew.hpp"
#include "osculate/la/aggregates.hpp"

namespace osculate::la {

/// A matrix to be multiplied with often. Rows of a group have their columns in common: entries of a
/// column stand together, and consecutive columns are named once, so that an entry of three rows
/// takes little more memory than its value, which is what a product waits for.
///
/// Formula    y = A x . Each row is summed up in the order of its columns in double precision, so
///            that the bits are those of `multiply` where Value is double, and depend on no number
///            of threads. As float, entries are rounded to 24 bits, times a power of two that
///            keeps the largest one in range: a linear map near to A.
/// Tested by  tests/unit/la/test_grouped_rows.cpp
template <class Value>
class GroupedRows {
 public:
  GroupedRows() = default;
  GroupedRows(const CompressedRows& a, GroupStarts groups, core::Crew& crew);
  void multiply(const Eigen::VectorXd& x, core::Crew& crew, Eigen::VectorXd& y) const;
  /// Entries that are not zero, and those of the diagonal.
  [[nodiscard]] CompressedRows as_rows() const;
  [[nodiscard]] std::size_t entries() const { return values_.size(); }

 private:
  struct Run {
    Index first, count;
  };
  [[nodiscard]] Index size_of(std::size_t group) const {
    return groups_[group + 1] - groups_[group];
  }
  void multiply(std::size_t group, const double* x, double* y_of_group) const;
  void find_columns(const CompressedRows& a);
  void fill(const CompressedRows& a, std::size_t group);

  GroupStarts groups_{0};
  Index columns_ = 0;
  double scale_ = 1;  ///< of the values
  std::vector<std::size_t> first_run_{0}, first_value_{0};
  std::vector<Run> runs_;  ///< of consecutive columns
  std::vector<Value> values_;
};

extern template class GroupedRows<double>;
extern template class GroupedRows<float>;

}  // namespace osculate::la
