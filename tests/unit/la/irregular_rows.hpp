#pragma once
#include <cmath>
#include <vector>

#include "osculate/la/aggregates.hpp"

namespace osculate::la::test {

/// Of one to seven rows, and one of none.
inline const GroupStarts of_all_sizes{0, 3, 4, 6, 12, 12, 16, 21, 28, 31};

/// Groups of rows of very different size, whose columns differ and are not all side by side.
inline CompressedRows irregular(const GroupStarts& groups, Index columns) {
  std::vector<Eigen::Triplet<double, Index>> entries;
  for (Index i = 0; i < groups.back(); ++i)
    for (Index j = 0; j < columns; ++j)
      if ((i * 7 + j * j) % 5 < 2 && (i + j) % 11 != 0)
        entries.emplace_back(i, j, std::sin(1.3 * i + 0.7 * j) * std::pow(10.0, i % 3));
  CompressedRows a(groups.back(), columns);
  a.setFromTriplets(entries.begin(), entries.end());
  return a;
}

inline Eigen::VectorXd waving(Eigen::Index n) {
  Eigen::VectorXd v(n);
  for (Eigen::Index i = 0; i < n; ++i) v[i] = std::sin(1.7 * static_cast<double>(i * i % 1009));
  return v;
}

}  // namespace osculate::la::test
