#include "osculate/la/multigrid.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "elastic_block.hpp"
#include "osculate/la/aggregates.hpp"
#include "osculate/la/block_diagonal.hpp"

namespace osculate::la {
namespace {

using test::ElasticBlock;

GroupStarts groups_of_three(Index n) {
  GroupStarts start;
  for (Index i = 0; i <= n; i += 3) start.push_back(i);
  return start;
}

Eigen::VectorXd noise(Eigen::Index n) {
  Eigen::VectorXd v(n);
  for (Eigen::Index i = 0; i < n; ++i) v[i] = std::sin(1.7 * static_cast<double>(i * i % 1009));
  return v;
}

TEST(CompressedRows, HaveBothTrianglesAndNoZerosBesideTheDiagonal) {
  const SparseMatrix k{
      4, {0, 3, 5, 7, 9}, {0, 1, 3, 0, 1, 2, 3, 0, 3}, {4, 0, 2, 7, 0, 5, 3, 9, 6}};
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(4, 4), upper = all;
  all << 4, 0, 0, 2, 7, 0, 0, 0, 0, 0, 5, 3, 9, 0, 0, 6;
  upper << 4, 0, 0, 2, 0, 0, 0, 0, 0, 0, 5, 3, 2, 0, 3, 6;
  CompressedRows a = compressed(k, Symmetry::unsymmetric);
  EXPECT_EQ(Eigen::MatrixXd(a), all);
  EXPECT_EQ(a.nonZeros(), 8);  // the zero at (1, 1) stays, that at (0, 1) does not
  a = compressed(k, Symmetry::positive_definite);
  EXPECT_EQ(Eigen::MatrixXd(a), upper);
  EXPECT_EQ(a.nonZeros(), 8);
  for (Eigen::Index i = 0; i < 4; ++i)
    for (Index e = a.outerIndexPtr()[i] + 1; e < a.outerIndexPtr()[i + 1]; ++e)
      EXPECT_LT(a.innerIndexPtr()[e - 1], a.innerIndexPtr()[e]);
}

TEST(CompressedRows, AreThoseOfOneThread) {
  const ElasticBlock block(5, 6, 7);
  core::Crew three(3);
  for (const Symmetry symmetry : {Symmetry::unsymmetric, Symmetry::indefinite}) {
    const CompressedRows expected = compressed(block.matrix(), symmetry);
    const CompressedRows a = compressed(block.matrix(), symmetry, three);
    ASSERT_GT(a.rows(), 1000) << "for some runs of rows";
    ASSERT_EQ(a.nonZeros(), expected.nonZeros());
    EXPECT_TRUE(std::equal(a.valuePtr(), a.valuePtr() + a.nonZeros(), expected.valuePtr()));
    EXPECT_EQ(Eigen::MatrixXd(a - expected).norm(), 0);
  }
}

GroupedRows grouped(const ElasticBlock& block) {
  core::Crew one(1);
  return {compressed(block.matrix(), Symmetry::unsymmetric), groups_of_three(block.unknowns()),
          one};
}

TEST(Aggregates, EveryGroupBelongsToOneAndThoseLeftOutToNone) {
  const ElasticBlock block(11, 10, 9, false);
  const GroupedRows a = grouped(block);
  core::Crew one(1), three(3);
  std::vector<char> out(a.groups().size() - 1, 0);
  out[3] = out[40] = 1;
  const Aggregates found = aggregate(a, out, 0.05, one);
  EXPECT_EQ(aggregate(a, out, 0.05, three).of_group, found.of_group);
  std::vector<int> members(static_cast<std::size_t>(found.count), 0);
  for (std::size_t g = 0; g < out.size(); ++g) {
    if (out[g] != 0) {
      EXPECT_EQ(found.of_group[g], -1);
      continue;
    }
    ASSERT_GE(found.of_group[g], 0);
    ASSERT_LT(found.of_group[g], found.count);
    ++members[static_cast<std::size_t>(found.of_group[g])];
  }
  for (const int count : members) EXPECT_GT(count, 0);
  EXPECT_LT(10 * found.count, static_cast<Index>(out.size()));
}

// A plate of long thin cells: stiff across, hardly along. Aggregates are across.
TEST(Aggregates, WeakCouplingsAreLeftAlone) {
  constexpr Index along = 10, across = 9;
  std::vector<Eigen::Triplet<double, Index>> entries;
  const auto id = [](Index i, Index j) { return i * across + j; };
  for (Index i = 0; i < along; ++i)
    for (Index j = 0; j < across; ++j) {
      entries.emplace_back(id(i, j), id(i, j), 2.0);
      if (j > 0) {
        entries.emplace_back(id(i, j), id(i, j - 1), -1.0);
        entries.emplace_back(id(i, j - 1), id(i, j), -1.0);
      }
      if (i > 0) {
        entries.emplace_back(id(i, j), id(i - 1, j), -1e-4);
        entries.emplace_back(id(i - 1, j), id(i, j), -1e-4);
      }
    }
  CompressedRows a(along * across, along * across);
  a.setFromTriplets(entries.begin(), entries.end());
  GroupStarts start;
  for (Index i = 0; i <= along * across; ++i) start.push_back(i);
  const std::vector<char> none(static_cast<std::size_t>(along * across), 0);
  core::Crew one(1);
  const Aggregates found = aggregate(GroupedRows(a, start, one), none, 0.05, one);
  std::vector<Index> row(static_cast<std::size_t>(found.count), -1);
  for (Index i = 0; i < along; ++i)
    for (Index j = 0; j < across; ++j) {
      Index& of = row[as_size(found.of_group[as_size(id(i, j))])];
      if (of < 0) of = i;
      EXPECT_EQ(of, i);
    }
}

TEST(BlockDiagonal, InvertsBlocksAndLeavesOutThoseThatAreNotPositiveDefinite) {
  CompressedRows a(6, 6);
  a.insert(0, 0) = 4;
  a.insert(0, 1) = 1;
  a.insert(1, 0) = 1;
  a.insert(1, 1) = 3;
  a.insert(1, 3) = 7;  // of another block
  a.insert(2, 2) = -1;
  a.insert(3, 3) = 0;
  a.insert(4, 4) = 1;
  a.insert(4, 5) = 1;
  a.insert(5, 4) = 1;
  a.insert(5, 5) = 1;
  a.makeCompressed();
  core::Crew crew(1);
  const BlockDiagonal inverse(GroupedRows(a, {0, 2, 3, 4, 6}, crew), crew);
  Eigen::VectorXd y;
  inverse.apply(Eigen::VectorXd::Ones(6), crew, y);
  Eigen::VectorXd expected = Eigen::VectorXd::Zero(6);
  expected.head<2>() << 2.0 / 11, 3.0 / 11;
  EXPECT_LT((y - expected).norm(), 1e-15);
  EXPECT_LT((inverse.as_matrix(crew).as_rows() * Eigen::VectorXd::Ones(6) - expected).norm(),
            1e-15);
}

/// What is left of an error after one cycle, in the norm of the energy, at most: by iterations.
double convergence(const ElasticBlock& block) {
  const GroupedRows a = grouped(block);
  const CompressedRows rows = a.as_rows();
  core::Crew crew(1);
  Multigrid cycle(crew);
  EXPECT_TRUE(cycle.build(a, Halo(block.unknowns()), block.rigid_motions()));
  Eigen::VectorXd e = noise(block.unknowns());
  for (Index i = 0; i < block.unknowns(); ++i)
    if (block.held(i)) e[i] = 0;
  double rate = 0;
  for (int i = 0; i < 25; ++i) {
    e /= std::sqrt(e.dot(rows * e));
    Eigen::VectorXd x = rows * e;
    EXPECT_TRUE(cycle.apply(x));
    e -= x;
    rate = std::sqrt(e.dot(rows * e));
  }
  return rate;
}

TEST(Multigrid, ConvergesAtARateThatDoesNotFollowTheSize) {
  const double coarse = convergence(ElasticBlock(8, 8, 8)),
               fine = convergence(ElasticBlock(16, 16, 16));
  EXPECT_LT(coarse, 0.5);
  EXPECT_LT(fine, 0.6);
}

TEST(Multigrid, IsTheInverseWhereThereIsOneLevel) {
  const ElasticBlock block(4, 4, 4);
  const GroupedRows a = grouped(block);
  core::Crew crew(1);
  Multigrid cycle(crew);
  ASSERT_TRUE(cycle.build(a, Halo(block.unknowns()), block.rigid_motions()));
  EXPECT_EQ(cycle.levels(), 1);
  Eigen::VectorXd x = noise(block.unknowns());
  const Eigen::VectorXd b = x;
  ASSERT_TRUE(cycle.apply(x));
  EXPECT_LT((a.as_rows() * x - b).norm(), 1e-11 * b.norm());
}

/// Symmetric but for the rounding of its entries.
TEST(Multigrid, IsSymmetricAndItsBitsDoNotDependOnThreads) {
  const ElasticBlock block(9, 10, 11);
  const GroupedRows a = grouped(block);
  core::Crew crew_of_one(1), crew_of_two(2);
  Multigrid one(crew_of_one), two(crew_of_two);
  ASSERT_TRUE(one.build(a, Halo(block.unknowns()), block.rigid_motions()));
  ASSERT_TRUE(two.build(a, Halo(block.unknowns()), block.rigid_motions()));
  EXPECT_GE(one.levels(), 2);
  EXPECT_LT(one.complexity(), 1.5);
  const Eigen::VectorXd u = noise(block.unknowns()), v = u.reverse();
  Eigen::VectorXd mu = u, mv = v, again = u;
  ASSERT_TRUE(one.apply(mu) && one.apply(mv) && two.apply(again));
  EXPECT_NEAR(v.dot(mu), u.dot(mv), 1e-5 * mu.norm() * v.norm());
  EXPECT_EQ(mu, again);
}

TEST(Multigrid, SaysThatAFreeBodyHasNoCoarsestModel) {
  const ElasticBlock block(8, 8, 8, false);
  const GroupedRows a = grouped(block);
  core::Crew crew(1);
  Multigrid cycle(crew);
  EXPECT_FALSE(cycle.build(a, Halo(block.unknowns()), block.rigid_motions()));
  Eigen::VectorXd x = noise(block.unknowns());
  cycle.forget();
  EXPECT_FALSE(cycle.apply(x));
}

}  // namespace
}  // namespace osculate::la
