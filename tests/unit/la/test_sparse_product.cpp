#include "osculate/la/sparse_product.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "irregular_rows.hpp"

namespace osculate::la {
namespace {

using test::irregular;
using test::of_all_sizes;

/// Rows with runs of columns of all lengths, rows of nothing, and, where `alike` is more than one,
/// as many consecutive ones with the same columns.
CompressedRows with_runs(Index rows, Index columns, Index alike = 1) {
  CompressedRows a(rows, columns);
  for (Index i = 0; i < rows; ++i)
    for (Index j = 0; j < columns; ++j)
      if (const Index like = i / alike;
          like % 7 != 3 && (like * like + j / (1 + like % 9)) % 3 == 0)
        a.insert(i, j) = std::sin(i + 1.7 * j);
  a.makeCompressed();
  return a;
}

/// Values of which sums of products have no rounding.
CompressedRows whole_numbers(CompressedRows a) {
  for (Eigen::Index e = 0; e < a.nonZeros(); ++e)
    a.valuePtr()[e] =
        std::copysign(1 + std::floor(std::abs(100 * a.valuePtr()[e])), a.valuePtr()[e]);
  return a;
}

/// Row by row, without places for what is not there.
CompressedRows expected_product(const CompressedRows& a, const CompressedRows& b) {
  std::vector<Eigen::Triplet<double, Index>> entries;
  for (Index i = 0; i < a.rows(); ++i) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(b.cols());
    for (CompressedRows::InnerIterator of_a(a, i); of_a; ++of_a)
      for (CompressedRows::InnerIterator of_b(b, of_a.col()); of_b; ++of_b)
        sum[of_b.col()] += of_a.value() * of_b.value();
    for (Index j = 0; j < b.cols(); ++j)
      if (sum[j] != 0) entries.emplace_back(i, j, sum[j]);
  }
  CompressedRows c(a.rows(), b.cols());
  c.setFromTriplets(entries.begin(), entries.end());
  return c;
}

void expect_bits(const CompressedRows& c, const CompressedRows& expected) {
  ASSERT_EQ(c.nonZeros(), expected.nonZeros());
  EXPECT_TRUE(c.isCompressed());
  EXPECT_TRUE(
      std::equal(c.outerIndexPtr(), c.outerIndexPtr() + c.rows() + 1, expected.outerIndexPtr()));
  EXPECT_TRUE(
      std::equal(c.innerIndexPtr(), c.innerIndexPtr() + c.nonZeros(), expected.innerIndexPtr()));
  EXPECT_TRUE(std::equal(c.valuePtr(), c.valuePtr() + c.nonZeros(), expected.valuePtr()));
}

TEST(SparseProduct, IsTheSumOfRows) {
  core::Crew one(1), three(3);
  for (const Index inner : {1, 5, 40})
    for (const Index columns : {1, 6, 8, 16, 61})
      for (const Index alike : {1, 2, 3, 7}) {
        const CompressedRows a = whole_numbers(irregular(of_all_sizes, inner)),
                             b = whole_numbers(with_runs(inner, columns, alike));
        const CompressedRows expected = expected_product(a, b);
        for (core::Crew* const crew : {&one, &three})
          expect_bits(product(GroupedRows(a, of_all_sizes, *crew), b, *crew), expected);
      }
}

TEST(SparseProduct, BitsDoNotDependOnThreads) {
  GroupStarts groups{0};
  while (groups.size() < 400) groups.push_back(groups.back() + 1 + groups.back() % 4);
  core::Crew one(1), three(3);
  const CompressedRows a = with_runs(groups.back(), 40), b = with_runs(40, 30, 3);
  const GroupedRows grouped(a, groups, one);
  const CompressedRows expected = product(grouped, b, one);
  expect_bits(product(grouped, b, three), expected);
  const Eigen::MatrixXd rest = Eigen::MatrixXd(a) * Eigen::MatrixXd(b) - Eigen::MatrixXd(expected);
  EXPECT_LE(rest.cwiseAbs().maxCoeff(), 1e-14);
}

TEST(SparseProduct, OfNothing) {
  core::Crew crew(2);
  const CompressedRows none(0, 4), zero(4, 3);
  EXPECT_EQ(product(GroupedRows(none, {0}, crew), zero, crew).rows(), 0);
  const CompressedRows c = product(GroupedRows(with_runs(5, 4), {0, 3, 5}, crew), zero, crew);
  EXPECT_EQ(c.rows(), 5);
  EXPECT_EQ(c.cols(), 3);
  EXPECT_EQ(c.nonZeros(), 0);
}

}  // namespace
}  // namespace osculate::la
