#include "osculate/la/grouped_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "elastic_block.hpp"
#include "irregular_rows.hpp"

namespace osculate::la {
namespace {

using test::ElasticBlock;
using test::irregular;
using test::of_all_sizes;
using test::waving;

TEST(GroupedRows, HaveTheBitsOfProductsRowByRow) {
  core::Crew one(1), two(2);
  const CompressedRows a = irregular(of_all_sizes, 23);
  const Eigen::VectorXd x = waving(23);
  Eigen::VectorXd expected, y, by_two;
  multiply(a, x, one, expected);
  const GroupedRows grouped(a, of_all_sizes, one);
  grouped.multiply(x, one, y);
  grouped.multiply(x, two, by_two);
  EXPECT_EQ(y, expected);
  EXPECT_EQ(by_two, expected);
  EXPECT_GT(grouped.entries(), static_cast<std::size_t>(a.nonZeros()));
  EXPECT_EQ(grouped.largest_entries(), Eigen::MatrixXd(a).cwiseAbs().rowwise().maxCoeff());
}

TEST(GroupedRows, BitsDoNotDependOnThreads) {
  const ElasticBlock block(5, 6, 7);
  GroupStarts groups{0};
  while (groups.back() < block.unknowns()) groups.push_back(groups.back() + 3);
  ASSERT_GT(groups.size(), 300U) << "for some runs of groups";
  const CompressedRows a = compressed(block.matrix(), Symmetry::unsymmetric);
  const Eigen::VectorXd x = waving(block.unknowns());
  core::Crew one(1), three(3);
  const GroupedRows grouped(a, groups, one), again(a, groups, three);
  Eigen::VectorXd expected, y;
  grouped.multiply(x, one, expected);
  EXPECT_LT((a * x - expected).norm(), 1e-14 * expected.norm());
  again.multiply(x, three, y);
  EXPECT_EQ(y, expected);
}

TEST(GroupedRows, GiveBackTheEntriesThatTheyWereMadeOf) {
  const ElasticBlock block(3, 3, 2);
  GroupStarts groups{0};
  for (Index size = 0; groups.back() < block.unknowns(); size = (size + 1) % 7)
    groups.push_back(std::min(groups.back() + size, block.unknowns()));
  const CompressedRows a = compressed(block.matrix(), Symmetry::unsymmetric);
  core::Crew crew(1);
  const CompressedRows again = GroupedRows(a, groups, crew).as_rows();
  EXPECT_EQ(Eigen::MatrixXd(again), Eigen::MatrixXd(a));
  EXPECT_EQ(again.nonZeros(), a.nonZeros());
}

/// What `GroupedRows::update` reads.
auto rows_of(const CompressedRows& a) {
  return [&a](Index i, const auto& take) {
    for (CompressedRows::InnerIterator entry(a, i); entry; ++entry)
      if (entry.value() != 0) take(static_cast<Index>(entry.col()), entry.value());
  };
}

TEST(GroupedRows, TakeTheValuesOfAMatrixWhoseEntriesHavePlaces) {
  core::Crew one(1), two(2);
  const CompressedRows a = irregular(of_all_sizes, 23);
  CompressedRows b = a;
  const auto first_of = [&](Index row) { return b.valuePtr() + b.outerIndexPtr()[row]; };
  *first_of(3) = 7;       // alone in its group
  first_of(15)[1] = 0;    // the last row of a group
  first_of(30)[2] *= -2;  // of the last group
  const Eigen::VectorXd x = waving(23);
  Eigen::VectorXd expected, y;
  multiply(b, x, one, expected);
  for (core::Crew* crew : {&one, &two}) {
    GroupedRows grouped(a, of_all_sizes, *crew);
    std::vector<char> differs;
    ASSERT_TRUE(grouped.update(rows_of(b), *crew, differs));
    EXPECT_EQ(differs, (std::vector<char>{0, 1, 0, 0, 0, 1, 0, 0, 1}));
    grouped.multiply(x, *crew, y);
    EXPECT_EQ(y, expected);
    ASSERT_TRUE(grouped.update(rows_of(a), *crew, differs)) << "what became zero keeps its place";
    EXPECT_EQ(Eigen::MatrixXd(grouped.as_rows()), Eigen::MatrixXd(a));
    ASSERT_TRUE(grouped.update(rows_of(a), *crew, differs));
    EXPECT_EQ(std::ranges::count(differs, 0), 9);
  }
}

TEST(GroupedRows, TakeNoEntryThatHasNoPlace) {
  core::Crew crew(1);
  const CompressedRows a = irregular(of_all_sizes, 23);
  for (const Index row : {0, 13, 30})
    for (const Index column : {0, 11, 22}) {
      Index group = 0;
      while (of_all_sizes[as_size(group + 1)] <= row) ++group;
      bool taken = false;
      for (Index i = of_all_sizes[as_size(group)]; i < of_all_sizes[as_size(group + 1)]; ++i)
        taken = taken || a.coeff(i, column) != 0;
      CompressedRows b = a;
      b.coeffRef(row, column) = 3;
      GroupedRows grouped(a, of_all_sizes, crew);
      std::vector<char> differs;
      EXPECT_EQ(grouped.update(rows_of(b), crew, differs), taken) << row << ", " << column;
    }
}

TEST(GroupedRows, KnowTheBlocksOfTheirDiagonal) {
  core::Crew crew(1);
  const CompressedRows a = irregular(of_all_sizes, 31);
  const GroupedRows grouped(a, of_all_sizes, crew);
  const Eigen::MatrixXd dense(a);
  for (std::size_t g = 0; g + 1 < of_all_sizes.size(); ++g) {
    const Index begin = of_all_sizes[g], size = of_all_sizes[g + 1] - begin;
    EXPECT_EQ(grouped.diagonal_block(g), dense.block(begin, begin, size, size)) << g;
  }
}

}  // namespace
}  // namespace osculate::la
