#include "osculate/la/halo.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "elastic_block.hpp"
#include "osculate/la/dealt_rows.hpp"
#include "osculate/la/grouped_rows.hpp"
#include "osculate/la/multigrid.hpp"
#include "ranks.hpp"

namespace osculate::la {
namespace {

using test::ElasticBlock;

/// A process for each node: parts one above the other, or at random.
std::vector<int> owners(const ElasticBlock& block, int processes, bool at_random) {
  std::mt19937 random(7);
  std::vector<int> owner;
  for (Index n = 0; n < block.nodes(); ++n)
    owner.push_back(at_random ? static_cast<int>(random() % static_cast<unsigned>(processes))
                              : static_cast<int>(n * processes / block.nodes()));
  return owner;
}

/// The rows of the nodes of one process.
SparseMatrix rows_of(const SparseMatrix& whole, const std::vector<int>& owner,
                     const core::Ranks& ranks) {
  SparseMatrix k;
  k.n = whole.n;
  k.ranks = &ranks;
  k.row_start = {0};
  for (Index i = 0; i < k.n; ++i) {
    for (Index e = whole.row_start[as_size(i)]; e < whole.row_start[as_size(i) + 1]; ++e)
      if (owner[as_size(i / 3)] == ranks.rank()) {
        k.column.push_back(whole.column[as_size(e)]);
        k.value.push_back(whole.value[as_size(e)]);
      }
    k.row_start.push_back(static_cast<Index>(k.column.size()));
  }
  return k;
}

Eigen::VectorXd some(Eigen::Index n) {
  Eigen::VectorXd v(n);
  for (Eigen::Index i = 0; i < n; ++i) v[i] = std::sin(1.7 * static_cast<double>(i * i % 1009));
  return v;
}

/// Upper triangle as it is, lower one something else.
SparseMatrix lopsided(SparseMatrix k) {
  for (Index i = 0; i < k.n; ++i)
    for (Index e = k.row_start[as_size(i)]; e < k.row_start[as_size(i) + 1]; ++e)
      if (k.column[as_size(e)] < i) k.value[as_size(e)] *= 3;
  return k;
}

struct Here {
  Dealt dealt;
  Halo halo;
  CompressedRows a;

  Here(const SparseMatrix& k, Symmetry symmetry) : dealt(dealt_as(k)) {
    RowsHere rows = rows_here(k, symmetry, dealt);
    halo = std::move(rows.halo);
    a.swap(rows.a);
  }
  [[nodiscard]] Eigen::VectorXd own(const Eigen::VectorXd& all) const {
    Eigen::VectorXd out(halo.here());
    for (Index i = 0; i < halo.own(); ++i)
      out[i] = all[dealt.unknown[as_size(halo.number_everywhere(i))]];
    return out;
  }
  [[nodiscard]] GroupStarts nodes() const {
    GroupStarts start;
    for (Index i = 0; i <= halo.own(); i += 3) start.push_back(i);
    return start;
  }
};

class Halos : public ::testing::TestWithParam<std::tuple<int, bool>> {
 protected:
  template <class Work>
  void on_all(const Work& work) const {
    testing::as_ranks(std::get<0>(GetParam()), [&](const core::Ranks& ranks) {
      work(rows_of(whole_, owners(block_, ranks.count(), std::get<1>(GetParam())), ranks));
    });
  }
  ElasticBlock block_{6, 5, 7};
  const SparseMatrix whole_ = lopsided(block_.matrix());
  const Eigen::VectorXd x_ = some(block_.unknowns());
};

TEST_P(Halos, ProductsAreThoseOfAllRows) {
  for (const Symmetry symmetry : {Symmetry::unsymmetric, Symmetry::positive_definite}) {
    const CompressedRows all = compressed(whole_, symmetry);
    const Eigen::VectorXd expected = all * x_;
    on_all([&](const SparseMatrix& k) {
      const Here here(k, symmetry);
      Eigen::VectorXd x = here.own(x_), y;
      here.halo.update(x);
      GroupedRows<double>(here.a, here.nodes()).multiply(x, 1, y);
      const Eigen::VectorXd found = here.halo.gathered(y)(here.dealt.number);
      EXPECT_LT((found - expected).norm(), 1e-14 * expected.norm());
      const double length = here.halo.norm(x);
      EXPECT_NEAR(length, x_.norm(), 1e-14 * length);
    });
  }
}

TEST_P(Halos, WhatIsAddedUpIsTheProductWithTheTransposed) {
  const Eigen::VectorXd expected = CompressedRows(compressed(whole_, {})).transpose() * x_;
  on_all([&](const SparseMatrix& k) {
    const Here here(k, {});
    Eigen::VectorXd y = here.a.transpose() * here.own(x_).head(here.halo.own());
    here.halo.add_up(y);
    const Eigen::VectorXd found = here.halo.gathered(y.head(here.halo.own()))(here.dealt.number);
    EXPECT_LT((found - expected).norm(), 1e-14 * expected.norm());
  });
}

TEST_P(Halos, TheMatrixComesBack) {
  on_all([&](const SparseMatrix& k) {
    const Here here(k, {});
    const SparseMatrix again = matrix_of(here.a, here.halo, here.dealt);
    EXPECT_EQ(again.row_start.size(), k.row_start.size());
    const auto mine = [&](const SparseMatrix& of) {
      SparseMatrix plain = of;
      plain.ranks = nullptr;
      return Eigen::MatrixXd(compressed(plain, {}));
    };
    EXPECT_EQ(mine(again), mine(k));
    const CompressedRows all = gathered(here.a, here.halo),  // by their numbers
        given = compressed(k, {});
    for (Index i = 0; i < k.n; ++i)
      for (CompressedRows::InnerIterator entry(given, i); entry; ++entry)
        EXPECT_EQ(all.coeff(here.dealt.number[as_size(i)],
                            here.dealt.number[as_size(static_cast<Index>(entry.col()))]),
                  entry.value());
  });
}

/// P^T A P with P dealt out as the rows of A are: three columns for each process.
TEST_P(Halos, ProductsOfMatricesAreThoseOfAllRows) {
  const int processes = std::get<0>(GetParam());
  const auto p = [&](Index unknown, Index column) { return std::cos(unknown + 2.3 * column); };
  Eigen::MatrixXd all(block_.unknowns(), 3 * processes);
  const std::vector<int> owner = owners(block_, processes, std::get<1>(GetParam()));
  for (Index u = 0; u < block_.unknowns(); ++u)
    for (Index c = 0; c < 3 * processes; ++c)
      all(u, c) = c / 3 == owner[as_size(u / 3)] ? p(u, c % 3) : 0;
  const CompressedRows a = compressed(whole_, {});
  const Eigen::MatrixXd expected = all.transpose() * (a * all);
  on_all([&](const SparseMatrix& k) {
    const Here here(k, {});
    const std::vector<Index> first = dealt_out(k.ranks, 3);
    CompressedRows mine(here.halo.own(), 3);
    for (Index i = 0; i < here.halo.own(); ++i)
      for (Index c = 0; c < 3; ++c)
        mine.insert(i, c) = p(here.dealt.unknown[as_size(here.halo.number_everywhere(i))], c);
    mine.makeCompressed();
    put_everywhere(mine, first[as_size(k.ranks->rank())], first.back());
    const CompressedRows ap = here.a * with_rows_of_others(mine, here.halo);
    CompressedRows sum = summed_up(CompressedRows(mine.transpose()) * ap, k.ranks, first);
    const Eigen::MatrixXd rows = expected.middleRows(first[as_size(k.ranks->rank())], 3);
    EXPECT_LT((Eigen::MatrixXd(sum) - rows).norm(), 1e-13 * expected.norm());
  });
}

TEST_P(Halos, MultigridConvergesAsThatOfOneProcess) {
  const ElasticBlock block(10, 10, 10);
  const SparseMatrix& whole = block.matrix();
  const CompressedRows all = compressed(whole, Symmetry::unsymmetric);
  const auto [processes, at_random] = GetParam();
  std::vector<double> rates(static_cast<std::size_t>(processes));
  testing::as_ranks(processes, [&](const core::Ranks& ranks) {
    const SparseMatrix k = rows_of(whole, owners(block, ranks.count(), at_random), ranks);
    const Here here(k, {});
    Eigen::MatrixXd motions(here.halo.own(), 6);
    for (Index m = 0; m < 6; ++m)
      motions.col(m) = here.own(block.rigid_motions().col(m)).head(here.halo.own());
    Multigrid cycle(1);
    EXPECT_TRUE(cycle.build(CompressedRows(here.a), here.halo, here.nodes(), motions));
    EXPECT_GE(cycle.levels(), 2);
    Eigen::VectorXd e = some(block.unknowns());
    for (Index i = 0; i < block.unknowns(); ++i)
      if (block.held(i)) e[i] = 0;
    for (int i = 0; i < 20; ++i) {
      e /= std::sqrt(e.dot(all * e));
      Eigen::VectorXd x = here.own(all * e).head(here.halo.own());
      EXPECT_TRUE(cycle.apply(x));
      e -= here.halo.gathered(x)(here.dealt.number);
    }
    rates[static_cast<std::size_t>(ranks.rank())] = std::sqrt(e.dot(all * e));
  });
  for (const double rate : rates) EXPECT_EQ(rate, rates.front());
  EXPECT_LT(rates.front(), 0.6);
}

INSTANTIATE_TEST_SUITE_P(Processes, Halos,
                         ::testing::Combine(::testing::Values(1, 2, 3, 8), ::testing::Bool()));

}  // namespace
}  // namespace osculate::la
