#pragma once
#include <Eigen/Core>
#include <array>

namespace osculate::la {

/// Rows and columns of one contact point: those of its slave node and its multipliers' own.
inline constexpr int most_node_rows = 3, most_multipliers = 4,
                     most_local_rows = most_node_rows + most_multipliers;
using LocalBlock =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_local_rows, most_multipliers>;

/// An invertible block of a small matrix: its rows and columns in the order of elimination.
struct LocalPivots {
  int count = 0;
  std::array<int, most_multipliers> rows{}, columns{};
};

/// Gaussian elimination with complete pivoting, as far as pivots of at least `least` go.
///
/// Requires   rows and columns of `scaled` with entries of order one; entries that are not numbers
///            give no pivots
/// Tested by  tests/unit/la/test_condensation.cpp
[[nodiscard]] LocalPivots local_pivots(LocalBlock scaled, double least);

}  // namespace osculate::la
