#include "osculate/la/iterative.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <utility>
#include <vector>

#include "elastic_block.hpp"
#include "osculate/la/compressed_rows.hpp"

namespace osculate::la {
namespace {

using test::ElasticBlock;

constexpr Index width = 12;

/// A block whose upper side is pressed by stiff springs, with friction that is not symmetric.
ElasticBlock pressed(double stiff, double friction) {
  ElasticBlock block(width, width, width);
  for (Index n = 0; n < block.nodes(); ++n) {
    if (block.place(n).z() != width) continue;
    block.builder().add(3 * n + 2, 3 * n + 2, stiff);
    block.builder().add(3 * n, 3 * n + 2, friction * stiff);
  }
  return block;
}

Eigen::VectorXd load(const ElasticBlock& block) {
  Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(block.unknowns(), -1, 2);
  for (Index i = 0; i < block.unknowns(); ++i)
    if (block.held(i)) b[i] = 0.01;
  return b;
}

struct Outcome {
  Eigen::VectorXd x;
  IterativeWork work;
};

Outcome by_iterations(const ElasticBlock& block, Symmetry kind, int threads = 1) {
  Iterative solver;
  Places places = block.places();
  places.threads = threads;
  solver.place(places);
  EXPECT_EQ(solver.factor(block.matrix(), 1, kind).status, SolveStatus::ok);
  Outcome out{load(block), {}};
  EXPECT_EQ(solver.solve(out.x), SolveStatus::ok);
  out.work = solver.work();
  return out;
}

// However stiff contact is, and with friction or without.
TEST(Iterative, SolvesAsFactorsDo) {
  int softest = 0;
  for (const double stiff : {1.0, 1e4, 1e8})
    for (const Symmetry kind :
         {Symmetry::unsymmetric, Symmetry::indefinite, Symmetry::positive_definite}) {
      const ElasticBlock block = pressed(stiff, kind == Symmetry::unsymmetric ? 0.3 : 0.0);
      const Outcome found = by_iterations(block, kind);
      EXPECT_EQ(found.work.solutions, 1);
      EXPECT_EQ(found.work.given_up, 0);
      if (softest == 0) softest = found.work.iterations;
      EXPECT_LE(found.work.iterations, softest + 5) << stiff;
      Mumps direct;
      ASSERT_EQ(direct.factor(block.matrix(), 1, kind).status, SolveStatus::ok);
      Eigen::VectorXd x = load(block);
      ASSERT_EQ(direct.solve(x), SolveStatus::ok);
      EXPECT_LT((found.x - x).norm(), 1e-8 * x.norm());
    }
}

/// Only rows that a matrix names are looked at, and none of its values is taken for another's.
TEST(Iterative, TakesRowsThatWereTouchedAsItTakesAllRows) {
  const ElasticBlock block = pressed(1e3, 0.3);
  const SparseMatrix k = block.matrix();
  MatrixBuilder builder(k.n);
  const auto add = [&](Index from, Index to, double factor) {
    for (Index i = from; i < to; ++i)
      for (Index e = k.row_start[as_size(i)]; e < k.row_start[as_size(i) + 1]; ++e)
        builder.add(i, k.column[as_size(e)], factor * k.value[as_size(e)]);
  };
  add(0, k.n, 1);
  builder.keep_values();
  Iterative by_rows, whole;
  by_rows.place(block.places());
  whole.place(block.places());
  const auto expect_same = [&] {
    SparseMatrix unmarked = builder.finish();
    ASSERT_NE(std::exchange(unmarked.mark, nullptr), nullptr);
    Eigen::VectorXd x = load(block), y = x;
    ASSERT_EQ(by_rows.factor(builder.finish(), 1, Symmetry::unsymmetric).status, SolveStatus::ok);
    ASSERT_EQ(whole.factor(unmarked, 1, Symmetry::unsymmetric).status, SolveStatus::ok);
    ASSERT_EQ(by_rows.solve(x), SolveStatus::ok);
    ASSERT_EQ(whole.solve(y), SolveStatus::ok);
    EXPECT_EQ(x, y);
  };
  expect_same();
  for (const auto& [from, to] : {std::pair<Index, Index>{30, 90}, {60, 120}, {0, 0}, {600, 630}}) {
    ASSERT_TRUE(builder.restore_values());
    add(from, to, 0.2);
    expect_same();
  }
  EXPECT_EQ(by_rows.work().given_up, 0);
  ASSERT_TRUE(builder.restore_values());
  builder.add(7, 7, std::numeric_limits<double>::quiet_NaN());
  EXPECT_NE(by_rows.factor(builder.finish(), 1, Symmetry::unsymmetric).status, SolveStatus::ok);
  ASSERT_TRUE(builder.restore_values());
  EXPECT_EQ(by_rows.factor(builder.finish(), 1, Symmetry::unsymmetric).status, SolveStatus::ok);
}

TEST(Iterative, BitsDoNotDependOnThreadsNorOnWhatWasSolvedBefore) {
  const ElasticBlock block = pressed(1e3, 0.3);
  const Outcome one = by_iterations(block, Symmetry::unsymmetric);
  EXPECT_EQ(one.x, by_iterations(block, Symmetry::unsymmetric, 2).x);
  Iterative used;
  used.place(block.places());
  ASSERT_EQ(used.factor(pressed(5, 0.2).matrix(), 1, Symmetry::unsymmetric).status,
            SolveStatus::ok);
  used.aim(1e-5);
  Eigen::VectorXd x = load(block);
  ASSERT_EQ(used.solve(x), SolveStatus::ok);
  x = load(block);
  used.begin_anew();
  ASSERT_EQ(used.factor(block.matrix(), 1, Symmetry::unsymmetric).status, SolveStatus::ok);
  ASSERT_EQ(used.solve(x), SolveStatus::ok);
  EXPECT_EQ(x, one.x);
}

TEST(Iterative, BitsDoNotDependOnThreadsWhereFewRowsChange) {
  std::vector<Eigen::VectorXd> first;
  for (const int threads : {1, 2}) {
    Iterative solver;
    Places places = pressed(1, 0).places();
    places.threads = threads;
    solver.place(places);
    std::vector<Eigen::VectorXd> found;
    for (const auto& [stiff, friction] :
         {std::pair(1e3, 0.3), std::pair(1e3, 0.3), std::pair(1e2, 0.2), std::pair(0.0, 0.0)})
      for (const Symmetry kind : {Symmetry::unsymmetric, Symmetry::indefinite}) {
        const ElasticBlock block = pressed(stiff, kind == Symmetry::unsymmetric ? friction : 0.0);
        ASSERT_EQ(solver.factor(block.matrix(), 1, kind).status, SolveStatus::ok);
        found.push_back(load(block));
        ASSERT_EQ(solver.solve(found.back()), SolveStatus::ok);
        EXPECT_LE(relative_residual(block.matrix(), found.back(), load(block)), 1.001e-10);
      }
    if (first.empty()) first = found;
    EXPECT_EQ(found, first);
    EXPECT_EQ(solver.work().given_up, 0);
  }
}

TEST(Iterative, PassesWhatItHasPreparedUnlessSomethingWasFree) {
  const ElasticBlock held = pressed(1e3, 0.3), loose(width, width, width, false);
  Iterative solver;
  EXPECT_FALSE(solver.passes());
  solver.place(held.places());
  ASSERT_EQ(solver.factor(held.matrix(), 1, Symmetry::unsymmetric).status, SolveStatus::ok);
  EXPECT_TRUE(solver.passes());
  solver.may_come_loose();
  EXPECT_TRUE(solver.passes());
  ASSERT_EQ(solver.factor(loose.matrix(), 1, Symmetry::unsymmetric).status, SolveStatus::ok);
  EXPECT_FALSE(solver.sound());
  EXPECT_FALSE(solver.passes());
  solver.begin_anew();
  EXPECT_EQ(solver.factor(loose.matrix(), 1, Symmetry::unsymmetric).status, SolveStatus::singular);
  EXPECT_FALSE(solver.passes());
  solver.begin_anew();
  ASSERT_EQ(solver.factor(held.matrix(), 1, Symmetry::unsymmetric).status, SolveStatus::ok);
  EXPECT_TRUE(solver.passes());
}

TEST(Iterative, CoarserModelsServeForMatricesThatAreNear) {
  Iterative solver;
  solver.place(pressed(1, 0).places());
  int first = 0;
  for (const double stiff : {1e3, 1e1, 1e7}) {  // contact opens and closes everywhere
    const ElasticBlock block = pressed(stiff, 0.3);
    ASSERT_EQ(solver.factor(block.matrix(), 1, Symmetry::unsymmetric).status, SolveStatus::ok);
    const int before = solver.work().iterations;
    Eigen::VectorXd x = load(block);
    ASSERT_EQ(solver.solve(x), SolveStatus::ok);
    EXPECT_LE(relative_residual(block.matrix(), x, load(block)), 1.001e-10);
    if (first == 0) first = solver.work().iterations;
    EXPECT_LE(solver.work().iterations - before, 2 * first);
  }
}

TEST(Iterative, FactorsOfContactServeUntilItHasChanged) {
  Iterative solver;
  solver.place(pressed(1, 0).places());
  int first = 0;
  const auto is_kept = [&](double stiff, double friction) {
    const ElasticBlock block = pressed(stiff, friction);
    const int factored = solver.work().factored;
    EXPECT_FALSE(solver.factor(block.matrix(), 1, Symmetry::unsymmetric).whole);
    const int before = solver.work().iterations;
    Eigen::VectorXd x = load(block);
    EXPECT_EQ(solver.solve(x), SolveStatus::ok);
    EXPECT_LE(relative_residual(block.matrix(), x, load(block)), 1.001e-10);
    if (first == 0) first = solver.work().iterations - before;
    EXPECT_LE(solver.work().iterations - before, 2 * first);
    return solver.work().factored == factored;
  };
  EXPECT_FALSE(is_kept(1e3, 0));
  EXPECT_TRUE(is_kept(1.3e3, 0));
  EXPECT_TRUE(is_kept(1.3e3, 0.02)) << "entries in new places";
  EXPECT_TRUE(is_kept(600, 0)) << "of what it was when it was factored";
  EXPECT_FALSE(is_kept(400, 0));
  EXPECT_FALSE(is_kept(1e5, 0.3));
  EXPECT_FALSE(is_kept(1e2, 0.3)) << "changed by less than the row was";
  solver.begin_anew();
  EXPECT_FALSE(is_kept(1e2, 0.3));
}

TEST(Iterative, LeavesNoMoreThanIsAskedFor) {
  const ElasticBlock block = pressed(1e3, 0.3);
  Iterative solver;
  solver.place(block.places());
  ASSERT_EQ(solver.factor(block.matrix(), 1, Symmetry::unsymmetric).status, SolveStatus::ok);
  int before = solver.work().iterations, last = 0;
  EXPECT_GT(before, 0) << "tried with noise";
  for (const double share : {1e-4, 1e-6, 1e-9}) {
    solver.aim(share);
    Eigen::VectorXd x = load(block);
    ASSERT_EQ(solver.solve(x), SolveStatus::ok);
    EXPECT_LE(relative_residual(block.matrix(), x, load(block)), 1.001 * share);
    EXPECT_GT(solver.work().iterations - before, last);
    last = solver.work().iterations - before;
    before = solver.work().iterations;
  }
}

TEST(Iterative, SolvesForMultipliersToo) {
  constexpr Index extra = 20;
  const ElasticBlock block(width, width, width);
  MatrixBuilder m(block.unknowns() + extra);
  const SparseMatrix& k = block.matrix();
  for (Index i = 0; i < k.n; ++i)
    for (Index e = k.row_start[static_cast<std::size_t>(i)];
         e < k.row_start[static_cast<std::size_t>(i) + 1]; ++e)
      m.add(i, k.column[static_cast<std::size_t>(e)], k.value[static_cast<std::size_t>(e)]);
  Places places = block.places();
  for (Index j = 0; j < extra; ++j) {
    const Index row = block.unknowns() + j, u = 3 * block.node(j % 5 + 2, j / 5 + 2, width) + 2;
    m.add(row, u, 1);
    m.add(u, row, 1);
    places.node.push_back(-1);
    places.direction.push_back(0);
    places.place.emplace_back(0, 0, 0);
    places.exact.push_back(1);
  }
  Eigen::VectorXd b = Eigen::VectorXd::Zero(block.unknowns() + extra);
  b.tail(extra).setConstant(-0.1);
  Iterative solver;
  solver.place(places);
  ASSERT_EQ(solver.factor(m.finish(), 1, Symmetry::indefinite).status, SolveStatus::ok);
  Eigen::VectorXd x = b;
  ASSERT_EQ(solver.solve(x), SolveStatus::ok);
  EXPECT_EQ(solver.work().given_up, 0);
  EXPECT_LT(relative_residual(m.finish(), x, b), 1e-9);
}

TEST(Iterative, FreeBodiesAreReportedByTheDirectSolver) {
  const ElasticBlock block(width, width, width, false);
  Iterative solver;
  solver.place(block.places());
  const FactorReport report = solver.factor(block.matrix(), 1, Symmetry::indefinite);
  EXPECT_EQ(report.status, SolveStatus::singular);
  EXPECT_EQ(solver.work().given_up, 1);
}

/// A body that springs held, and that nothing holds in the end, under forces that balance.
TEST(Iterative, WhatHasComeLooseIsFoundOutAtTheEnd) {
  const ElasticBlock loose(width, width, width, false);
  ElasticBlock held(width, width, width, false);
  for (Index i = 0; i < held.unknowns(); ++i) held.builder().add(i, i, 1.0);
  Iterative solver;
  solver.place(held.places());
  ASSERT_EQ(solver.factor(held.matrix(), 1, Symmetry::indefinite).status, SolveStatus::ok);
  EXPECT_TRUE(solver.sound());
  const int tried = solver.work().iterations;
  EXPECT_TRUE(solver.sound());
  EXPECT_EQ(solver.work().iterations, tried) << "once is enough";
  solver.may_come_loose();
  ASSERT_EQ(solver.factor(held.matrix(), 1, Symmetry::indefinite).status, SolveStatus::ok);
  EXPECT_EQ(solver.work().iterations, tried) << "nobody has asked yet";
  EXPECT_TRUE(solver.sound());
  EXPECT_GT(solver.work().iterations, tried);
  solver.may_come_loose();
  ASSERT_EQ(solver.factor(loose.matrix(), 1, Symmetry::indefinite).status, SolveStatus::ok);
  EXPECT_FALSE(solver.sound());
  EXPECT_EQ(solver.factor(loose.matrix(), 1, Symmetry::indefinite).status, SolveStatus::singular);
}

/// The same of a soft body beside a stiff one, whose share of all forces is next to nothing.
TEST(Iterative, WhatIsSoftAndComesLooseIsFoundOutToo) {
  constexpr double soft = 1e-7;
  const ElasticBlock block(width, width, width), free(width, width, width, false);
  const Index n = block.unknowns();
  const auto both = [&](double held) {
    MatrixBuilder sum(2 * n);
    const auto add = [&](const SparseMatrix& k, Index first, double factor) {
      for (Index i = 0; i < n; ++i)
        for (Index e = k.row_start[static_cast<std::size_t>(i)];
             e < k.row_start[static_cast<std::size_t>(i) + 1]; ++e)
          sum.add(first + i, first + k.column[static_cast<std::size_t>(e)],
                  factor * k.value[static_cast<std::size_t>(e)]);
    };
    add(block.matrix(), 0, 1);
    add(free.matrix(), n, soft);
    for (Index i = 0; i < n; ++i) sum.add(n + i, n + i, held * soft);
    return SparseMatrix(sum.finish());
  };
  Places places = block.places();
  const Places more = free.places();
  for (Index i = 0; i < n; ++i) {
    const auto u = static_cast<std::size_t>(i);
    places.node.push_back(block.nodes() + more.node[u]);
    places.direction.push_back(more.direction[u]);
    places.place.emplace_back(more.place[u] + Eigen::Vector3d(2.0 * width, 0, 0));
    places.exact.push_back(more.exact[u]);
  }
  Iterative solver;
  solver.place(places);
  ASSERT_EQ(solver.factor(both(1), 1, Symmetry::unsymmetric).status, SolveStatus::ok);
  solver.may_come_loose();
  ASSERT_EQ(solver.factor(both(0.5), 1, Symmetry::unsymmetric).status, SolveStatus::ok);
  EXPECT_TRUE(solver.sound());
  EXPECT_EQ(solver.work().given_up, 0);
  solver.may_come_loose();
  ASSERT_EQ(solver.factor(both(0), 1, Symmetry::unsymmetric).status, SolveStatus::ok);
  EXPECT_FALSE(solver.sound());
}

/// It has come loose but for rounding, and the forces do not balance.
TEST(Iterative, ASolutionThatGoesFarIsNotBelieved) {
  ElasticBlock held(width, width, width, false), loose(width, width, width, false);
  for (Index i = 0; i < held.unknowns(); ++i) {
    held.builder().add(i, i, 1.0);
    loose.builder().add(i, i, 3e-14);
  }
  const Eigen::VectorXd forces = Eigen::VectorXd::Ones(held.unknowns());
  Iterative solver;
  solver.place(held.places());
  ASSERT_EQ(solver.factor(held.matrix(), 1, Symmetry::indefinite).status, SolveStatus::ok);
  solver.may_come_loose();
  ASSERT_EQ(solver.factor(held.matrix(), 1, Symmetry::indefinite).status, SolveStatus::ok);
  const int tried = solver.work().iterations;
  Eigen::VectorXd x = forces;
  EXPECT_EQ(solver.solve(x), SolveStatus::ok);
  const int solved = solver.work().iterations - tried;
  EXPECT_LT(solved, 30) << "what does not go far is not tried";
  ASSERT_EQ(solver.factor(loose.matrix(), 1, Symmetry::indefinite).status, SolveStatus::ok);
  solver.aim(1e-3);
  x = forces;
  EXPECT_EQ(solver.solve(x), SolveStatus::singular) << x.norm();
  EXPECT_EQ(solver.work().given_up, 1);
}

TEST(Iterative, WhatItKnowsNothingOfOrIsSmallIsFactored) {
  const ElasticBlock block = pressed(10, 0.3), small(3, 3, 3);
  Iterative solver;
  for (const ElasticBlock* const of : {&block, &small}) {
    ASSERT_EQ(solver.factor(of->matrix(), 1, Symmetry::unsymmetric).status, SolveStatus::ok);
    Eigen::VectorXd x = load(*of);
    ASSERT_EQ(solver.solve(x), SolveStatus::ok);
    EXPECT_LT(relative_residual(of->matrix(), x, load(*of)), 1e-11);
    solver.place(small.places());
  }
  EXPECT_EQ(solver.work().solutions + solver.work().given_up, 0);
}

TEST(Iterative, RefusesWhatIsNoNumber) {
  ElasticBlock block = pressed(10, 0.3);
  Iterative solver;
  solver.place(block.places());
  ASSERT_EQ(solver.factor(block.matrix(), 1, Symmetry::unsymmetric).status, SolveStatus::ok);
  Eigen::VectorXd x = load(block);
  x[5] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(solver.solve(x), SolveStatus::failed);
  Eigen::VectorXd shorter = Eigen::VectorXd::Ones(7);
  EXPECT_EQ(solver.solve(shorter), SolveStatus::failed);
  block.builder().add(4, 4, std::numeric_limits<double>::infinity());
  EXPECT_EQ(solver.factor(block.matrix(), 1, Symmetry::unsymmetric).status, SolveStatus::failed);
}

}  // namespace
}  // namespace osculate::la
