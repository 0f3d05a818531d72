#include "osculate/la/local_pivots.hpp"

#include <cmath>

namespace osculate::la {

LocalPivots local_pivots(LocalBlock scaled, double least) {
  LocalPivots out;
  std::array<bool, most_local_rows> row_used{};
  std::array<bool, most_multipliers> column_used{};
  for (Eigen::Index step = 0; step < scaled.cols(); ++step) {
    Eigen::Index row = -1, column = -1;
    double largest = 0;
    for (Eigen::Index i = 0; i < scaled.rows(); ++i)
      for (Eigen::Index j = 0; j < scaled.cols(); ++j) {
        if (row_used[static_cast<std::size_t>(i)] || column_used[static_cast<std::size_t>(j)])
          continue;
        const double size = std::abs(scaled(i, j));
        if (!(size > largest)) continue;
        largest = size;
        row = i;
        column = j;
      }
    if (!(largest >= least) || !std::isfinite(largest)) break;
    row_used[static_cast<std::size_t>(row)] = column_used[static_cast<std::size_t>(column)] = true;
    out.rows[static_cast<std::size_t>(out.count)] = static_cast<int>(row);
    out.columns[static_cast<std::size_t>(out.count)] = static_cast<int>(column);
    ++out.count;
    for (Eigen::Index i = 0; i < scaled.rows(); ++i) {
      if (row_used[static_cast<std::size_t>(i)]) continue;
      const double factor = scaled(i, column) / scaled(row, column);
      for (Eigen::Index j = 0; j < scaled.cols(); ++j) scaled(i, j) -= factor * scaled(row, j);
    }
  }
  return out;
}

}  // namespace osculate::la
