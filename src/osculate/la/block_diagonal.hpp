#pragma once
#include <Eigen/Core>
#include <vector>

#include "osculate/core/crew.hpp"
#include "osculate/la/grouped_rows.hpp"

namespace osculate::la {

/// Inverses of the symmetric parts of the diagonal blocks of a matrix; zero where a block is not
/// positive definite, as that of a multiplier, or is singular to working precision.
///
/// Tested by  tests/unit/la/test_multigrid.cpp
class BlockDiagonal {
 public:
  BlockDiagonal() = default;
  BlockDiagonal(const GroupedRows& a, core::Crew& crew);
  /// Takes some groups' blocks from another matrix of the same groups; null: all.
  void update(const GroupedRows& a, const std::vector<char>* groups, core::Crew& crew);
  /// y = D^-1 r
  void apply(const Eigen::VectorXd& r, core::Crew& crew, Eigen::VectorXd& y) const;
  [[nodiscard]] GroupedRows as_matrix(core::Crew& crew) const;

 private:
  GroupStarts start_;
  std::vector<std::size_t> place_{0};  ///< of the block of a group, by columns
  std::vector<double> value_;
};

}  // namespace osculate::la
