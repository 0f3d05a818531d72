#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "osculate/la/grouped_rows.hpp"

namespace osculate::la {

/// A matrix near to another one in two bytes an entry, for preconditioners, whose products wait for
/// memory and need few digits.
///
/// Formula    A_ij ~ r_i q_ij c_j , q_ij whole numbers of 16 bits, c_j powers of two that are
/// given,
///            r_i = max_j |A_ij| / c_j / 32767: off by no more than r_i c_j / 2 . Sums are those of
///            single precision, in an order that depends on no number of threads
/// Errors     what is no number gives none
/// Decision   docs/decisions/113-two-bytes-an-entry.md
/// Tested by  tests/unit/la/test_compact_rows.cpp
class CompactRows {
 public:
  CompactRows() = default;
  /// Input      of_column: about c; nothing: 1
  CompactRows(const GroupedRows& a, core::Crew& crew, const Eigen::VectorXd& of_column = {});
  /// Takes the values of some groups from a matrix with the same places for entries.
  void copy(const GroupedRows& from, const std::vector<char>& groups, core::Crew& crew);
  void multiply(const Eigen::VectorXd& x, core::Crew& crew, Eigen::VectorXd& y) const;

 private:
  /// Some rows of a group, whose products are made at once.
  struct Bundle {
    Index first_row, rows, group, first_run, runs;
    std::size_t value;  ///< the first; column by column
  };
  using Run = GroupedRows::Run;
  void take(const GroupedRows& from, const Bundle& bundle);
  [[nodiscard]] double put_in(const Eigen::VectorXd& x, core::Crew& crew,
                              std::vector<float>& out) const;

  std::vector<Bundle> bundles_;
  std::vector<Run> runs_;
  std::vector<std::int16_t> values_;
  Eigen::VectorXd of_row_, of_column_;  ///< r and c
};

}  // namespace osculate::la
