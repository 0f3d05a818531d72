#include "osculate/la/compressed_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace osculate::la {
namespace {

/// Rows with runs of columns of all lengths, and rows of nothing.
CompressedRows with_runs(Index rows, Index columns) {
  CompressedRows a(rows, columns);
  for (Index i = 0; i < rows; ++i)
    for (Index j = 0; j < columns; ++j)
      if (i % 7 != 3 && (i * i + j / (1 + i % 9)) % 3 == 0) a.insert(i, j) = std::sin(i + 1.7 * j);
  a.makeCompressed();
  return a;
}

TEST(CompressedRows, ProductIsThatOfDenseMatrices) {
  core::Crew one(1), three(3);
  for (const Index inner : {1, 5, 40})
    for (const Index columns : {1, 6, 8, 16, 61}) {
      const CompressedRows a = with_runs(50, inner), b = with_runs(inner, columns);
      const CompressedRows c = product(a, b, one);
      const Eigen::MatrixXd expected = Eigen::MatrixXd(a) * Eigen::MatrixXd(b);
      EXPECT_LE((Eigen::MatrixXd(c) - expected).norm(), 1e-15 * inner * (1 + expected.norm()));
      EXPECT_TRUE(c.isCompressed());
      for (Index i = 0; i < c.rows(); ++i) {
        Index before = -1;
        for (CompressedRows::InnerIterator entry(c, i); entry; before = entry.col(), ++entry)
          EXPECT_GT(entry.col(), before) << "in order";
      }
      const CompressedRows again = product(a, b, three);
      EXPECT_EQ(Eigen::MatrixXd(again), Eigen::MatrixXd(c));
      EXPECT_EQ(again.nonZeros(), c.nonZeros());
    }
}

TEST(CompressedRows, ProductOfNothing) {
  core::Crew crew(2);
  const CompressedRows none(0, 4), zero(4, 3);
  EXPECT_EQ(product(none, zero, crew).rows(), 0);
  const CompressedRows c = product(with_runs(5, 4), zero, crew);
  EXPECT_EQ(c.rows(), 5);
  EXPECT_EQ(c.cols(), 3);
  EXPECT_EQ(c.nonZeros(), 0);
}

}  // namespace
}  // namespace osculate::la
