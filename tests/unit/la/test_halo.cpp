#include "osculate/la/halo.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "elastic_block.hpp"
#include "osculate/la/dealt_rows.hpp"
#include "osculate/la/engine.hpp"
#include "osculate/la/grouped_rows.hpp"
#include "osculate/la/multigrid.hpp"
#include "ranks.hpp"

namespace osculate::la {
namespace {

using test::ElasticBlock;

enum class Deal { layers, at_random, all_to_the_last };

/// A process for each node.
std::vector<int> owners(const ElasticBlock& block, int processes, Deal deal) {
  std::mt19937 random(7);
  std::vector<int> owner;
  for (Index n = 0; n < block.nodes(); ++n)
    owner.push_back(deal == Deal::at_random
                        ? static_cast<int>(random() % static_cast<unsigned>(processes))
                    : deal == Deal::layers ? static_cast<int>(n * processes / block.nodes())
                                           : processes - 1);
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
    core::Crew crew(1);
    RowsHere rows = rows_here(k, symmetry, dealt, crew);
    halo = std::move(rows.halo);
    a.swap(rows.a);
  }
  [[nodiscard]] Eigen::VectorXd own(const Eigen::VectorXd& all) const {
    if (!dealt.ranks) return all;
    Eigen::VectorXd out(halo.here());
    for (Index i = 0; i < halo.own(); ++i)
      out[i] = all[dealt.unknown[as_size(halo.number_everywhere(i))]];
    return out;
  }
  [[nodiscard]] Eigen::VectorXd all(const Eigen::VectorXd& own) const {
    if (dealt.ranks) return halo.gathered(own)(dealt.number);
    return own;
  }
  [[nodiscard]] GroupStarts nodes() const {
    GroupStarts start;
    for (Index i = 0; i <= halo.own(); i += 3) start.push_back(i);
    return start;
  }
};

class Halos : public ::testing::TestWithParam<std::tuple<int, Deal>> {
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
      core::Crew crew(1);
      GroupedRows(here.a, here.nodes(), crew).multiply(x, crew, y);
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
    CompressedRows all_rows = CompressedRows(mine.transpose()) * ap;
    const CompressedRows sum = summed_up(all_rows, k.ranks, first);
    const Eigen::MatrixXd rows = expected.middleRows(first[as_size(k.ranks->rank())], 3);
    EXPECT_LT((Eigen::MatrixXd(sum) - rows).norm(), 1e-13 * expected.norm());
  });
}

/// What is left of an error after one cycle, in the norm of the energy, at most: by iterations.
double rate(Multigrid& cycle, const ElasticBlock& block, const Here& here,
            const CompressedRows& all) {
  Eigen::VectorXd e = some(block.unknowns());
  for (Index i = 0; i < block.unknowns(); ++i)
    if (block.held(i)) e[i] = 0;
  for (int i = 0; i < 8; ++i) {
    e /= std::sqrt(e.dot(all * e));
    Eigen::VectorXd x = here.own(all * e).head(here.halo.own());
    EXPECT_TRUE(cycle.apply(x));
    e -= here.all(x);
  }
  return std::sqrt(e.dot(all * e));
}

double rate(const SparseMatrix& k, const ElasticBlock& block, const CompressedRows& all,
            int levels) {
  const Here here(k, {});
  Eigen::MatrixXd motions(here.halo.own(), 6);
  for (Index m = 0; m < 6; ++m)
    motions.col(m) = here.own(block.rigid_motions().col(m)).head(here.halo.own());
  core::Crew crew(1);
  Multigrid cycle(crew);
  EXPECT_TRUE(cycle.build(GroupedRows(here.a, here.nodes(), crew), here.halo, motions));
  EXPECT_GE(cycle.levels(), levels);
  return rate(cycle, block, here, all);
}

/// With a model in the middle, too.
TEST(MultigridOfRanks, ConvergesAsThatOfOneProcess) {
  const ElasticBlock block(10, 10, 80);
  const SparseMatrix& whole = block.matrix();
  const CompressedRows all = compressed(whole, Symmetry::unsymmetric);
  const double of_one = rate(whole, block, all, 3);
  EXPECT_LT(of_one, 0.6);
  for (const Deal deal : {Deal::layers, Deal::all_to_the_last}) {
    std::vector<double> rates(3);
    testing::as_ranks(3, [&](const core::Ranks& ranks) {
      rates[as_size(ranks.rank())] =
          rate(rows_of(whole, owners(block, 3, deal), ranks), block, all, 3);
    });
    for (const double of_ranks : rates) EXPECT_EQ(of_ranks, rates.front());
    EXPECT_LT(rates.front(), of_one + 0.05);
  }
}

/// Few nodes of a process are neighbours then.
TEST(MultigridOfRanks, NodesThatAreDealtOutAtRandom) {
  const ElasticBlock block(10, 10, 10);
  const SparseMatrix& whole = block.matrix();
  const CompressedRows all = compressed(whole, Symmetry::unsymmetric);
  testing::as_ranks(4, [&](const core::Ranks& ranks) {
    EXPECT_LT(rate(rows_of(whole, owners(block, 4, Deal::at_random), ranks), block, all, 2), 0.6);
  });
}

/// The same solutions as one process, of the first matrix, of a further one, and built again; also
/// of the upper triangle alone.
TEST_P(Halos, TheEngineSolvesAsThatOfOneProcess) {
  ElasticBlock block(8, 8, 8);
  Places places = block.places();
  std::fill(places.exact.begin(), places.exact.end(), 0);  // needs the factors of several processes
  const Eigen::VectorXd b = some(block.unknowns());
  SparseMatrix stiffer = block.matrix();
  for (double& value : stiffer.value) value *= 2;
  for (const Symmetry symmetry : {Symmetry::unsymmetric, Symmetry::positive_definite})
    on_all([&](const SparseMatrix& some_rows) {
      const std::vector<int> owner =
          owners(block, some_rows.ranks->count(), std::get<1>(GetParam()));
      const auto given = [&](const SparseMatrix& k) {
        return symmetry == Symmetry::unsymmetric ? k : lopsided(k);
      };
      const SparseMatrix first = rows_of(given(block.matrix()), owner, *some_rows.ranks),
                         second = rows_of(given(stiffer), owner, *some_rows.ranks);
      const CompressedRows all = compressed(block.matrix(), symmetry);
      const std::unique_ptr<Engine> engine = make_multigrid_engine({});
      const auto expect_solved = [&](double scale) {
        Eigen::VectorXd x = b;
        EXPECT_TRUE(engine->solve({}, x).solved);
        EXPECT_LT((scale * (all * x) - b).norm(), 2e-8 * b.norm());
        EXPECT_EQ(engine->diagonal(), scale * Eigen::VectorXd(all.diagonal()));
      };
      EXPECT_TRUE(engine->build(first, symmetry, places));
      expect_solved(1);
      const bool again = engine->refresh(second, symmetry, places);
      EXPECT_TRUE(again || engine->build(second, symmetry, places));
      expect_solved(2);
      EXPECT_TRUE(engine->build_again(places));
      expect_solved(2);
      EXPECT_LT((multiply(engine->matrix(), b) - 2 * (all * b)).norm(), 1e-13 * (all * b).norm());
      SparseMatrix others = second;  // dealt out otherwise
      if (others.ranks->count() > 1) {
        others = rows_of(stiffer, std::vector<int>(owner.size(), 0), *some_rows.ranks);
        EXPECT_FALSE(engine->refresh(others, symmetry, places));
      }
    });
}

/// An entry between two processes that neither had comes and goes again; the others' rows stay.
TEST_P(Halos, TheEngineTakesEntriesThatComeAndGo) {
  ElasticBlock block(8, 8, 8);
  Places places = block.places();
  std::fill(places.exact.begin(), places.exact.end(), 0);
  const Eigen::VectorXd b = some(block.unknowns());
  const CompressedRows plain = compressed(block.matrix(), Symmetry::unsymmetric);
  Index from = 0, to = block.unknowns() - 1;
  while (block.held(from)) ++from;
  while (block.held(to)) --to;
  const double stiffness = plain.diagonal().maxCoeff();
  CompressedRows spring(plain.rows(), plain.cols());
  for (const Index i : {from, to})
    for (const Index j : {from, to}) spring.insert(i, j) = i == j ? stiffness : -stiffness;
  const CompressedRows joined = plain + spring;
  on_all([&](const SparseMatrix& some_rows) {
    const std::vector<int> owner = owners(block, some_rows.ranks->count(), std::get<1>(GetParam()));
    const std::unique_ptr<Engine> engine = make_multigrid_engine({});
    const auto expect_solved = [&](const CompressedRows& all) {
      Eigen::VectorXd x = b;
      EXPECT_TRUE(engine->solve({}, x).solved);
      EXPECT_LT((all * x - b).norm(), 2e-8 * b.norm());
      EXPECT_EQ(engine->diagonal(), Eigen::VectorXd(all.diagonal()));
      EXPECT_LT((multiply(engine->matrix(), b) - all * b).norm(), 1e-13 * (all * b).norm());
    };
    const auto rows = [&](const CompressedRows& all) {
      return rows_of(stored(all), owner, *some_rows.ranks);
    };
    for (const Symmetry kind : {Symmetry::unsymmetric, Symmetry::positive_definite}) {
      EXPECT_TRUE(engine->build(rows(plain), kind, places));
      expect_solved(plain);
      for (const CompressedRows* const next : {&joined, &joined, &plain, &joined}) {
        EXPECT_TRUE(engine->refresh(rows(*next), kind, places));
        expect_solved(*next);
      }
      EXPECT_TRUE(engine->build_again(places));
      expect_solved(joined);
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Processes, Halos,
                         ::testing::Combine(::testing::Values(1, 2, 3, 8),
                                            ::testing::Values(Deal::layers, Deal::at_random,
                                                              Deal::all_to_the_last)));

}  // namespace
}  // namespace osculate::la
