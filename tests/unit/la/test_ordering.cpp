#include "osculate/la/ordering.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "grid.hpp"

namespace osculate::la {
namespace {

/// Entries of the Cholesky factor when the unknowns are eliminated in this order.
std::size_t fill(const SparseMatrix& k, const std::vector<int>& position) {
  const auto n = static_cast<std::size_t>(k.n);
  std::vector<std::vector<std::size_t>> below(n);
  for (std::size_t i = 0; i < n; ++i)
    for (Index e = k.row_start[i]; e < k.row_start[i + 1]; ++e) {
      const auto j = static_cast<std::size_t>(k.column[static_cast<std::size_t>(e)]);
      const auto a = static_cast<std::size_t>(position[i]) - 1;
      const auto b = static_cast<std::size_t>(position[j]) - 1;
      if (a != b) below[std::min(a, b)].push_back(std::max(a, b));
    }
  std::size_t entries = n;
  for (auto& column : below) {
    std::sort(column.begin(), column.end());
    column.erase(std::unique(column.begin(), column.end()), column.end());
    entries += column.size();
    if (column.size() > 1)
      below[column[0]].insert(below[column[0]].end(), column.begin() + 1, column.end());
  }
  return entries;
}

TEST(NestedDissection, is_a_permutation_with_half_the_fill_of_the_natural_order) {
  MatrixBuilder m = test::grid(80, 80, true);
  const SparseMatrix& k = m.finish();
  const std::vector<int> order = nested_dissection(k);
  std::vector<int> sorted = order, natural;
  for (Index i = 0; i < k.n; ++i) natural.push_back(i + 1);
  std::sort(sorted.begin(), sorted.end());
  ASSERT_EQ(sorted, natural);
  std::vector<int> inverse(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    inverse[static_cast<std::size_t>(order[i]) - 1] = static_cast<int>(i) + 1;
  EXPECT_LT(2 * fill(k, order), fill(k, natural));
  EXPECT_GT(fill(k, inverse), fill(k, natural));  // so the direction of the order matters
}

TEST(NestedDissection, repeats_itself) {
  MatrixBuilder m = test::grid(20, 20, true);
  EXPECT_EQ(nested_dissection(m.finish()), nested_dissection(m.finish()));
}

TEST(NestedDissection, sees_the_graph_of_the_matrix_and_its_transpose) {
  MatrixBuilder upper(50), both(50);
  for (Index i = 0; i + 1 < 50; ++i) {
    upper.add(i, i + 1, 1), both.add(i, i + 1, 1), both.add(i + 1, i, 1);
  }
  EXPECT_EQ(nested_dissection(upper.finish()), nested_dissection(both.finish()));
}

TEST(NestedDissection, is_empty_without_edges) {
  EXPECT_TRUE(nested_dissection(MatrixBuilder(5).finish()).empty());
}

}  // namespace
}  // namespace osculate::la
