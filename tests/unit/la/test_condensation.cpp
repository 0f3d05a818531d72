// Multipliers that are eliminated before the factorisation: exactly, whatever can be and what not.
#include "osculate/la/condensation.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include "grid.hpp"
#include "osculate/la/direct_solver.hpp"

namespace osculate::la {
namespace {

enum class State { open, stick, slip };

/// Bodies (random, dominated by their diagonal), whose first nodes are slaves of the last ones.
struct Contact {
  int dim = 3;
  bool friction = true;
  Index nodes = 12;
  std::vector<State> states;  ///< of slave node 0, 1, ...
  std::uint32_t seed = 1;

  [[nodiscard]] Index count() const { return friction ? dim + 1 : 1; }
  [[nodiscard]] Index first(Index point) const { return dim * nodes + count() * point; }
  [[nodiscard]] Index size() const { return first(static_cast<Index>(states.size())); }
  [[nodiscard]] std::vector<MultiplierGroup> groups() const {
    std::vector<MultiplierGroup> out;
    for (Index i = 0; i < static_cast<Index>(states.size()); ++i) {
      MultiplierGroup g{first(i), count()};
      for (int c = 0; c < dim; ++c) g.node[static_cast<std::size_t>(c)] = dim * i + c;
      out.push_back(g);
    }
    return out;
  }
};

/// A point in contact with the normal n and two master nodes: as pairing/constraint.hpp has it.
void add_point(const Contact& c, Index point, State state, std::mt19937& random,
               Eigen::MatrixXd& k) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Index first = c.first(point), slave = c.dim * point;
  const Eigen::VectorXd n = Eigen::VectorXd::NullaryExpr(c.dim, [&] { return uniform(random); });
  const Eigen::VectorXd normal = n.normalized();
  const double area = 2 + uniform(random), share = 0.5 * (1 + uniform(random));
  if (state == State::open) {
    for (Index i = 0; i < c.count(); ++i) k(first + i, first + i) = -area * (i == 0 ? 50 : 7);
    return;
  }
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(c.dim, c.dim);
  const Eigen::MatrixXd along = one - normal * normal.transpose();
  Eigen::MatrixXd own = -one, rate = along;
  if (state == State::slip) {
    const Eigen::VectorXd way = (along * Eigen::VectorXd::Ones(c.dim)).normalized();
    rate = 0.8 * (along - way * way.transpose());
    own = rate - one;
  } else {
    own = along - one;
  }
  const auto add = [&](Index node, double weight) {
    for (int i = 0; i < c.dim; ++i) {
      k(first, node + i) += area * 50 * weight * normal[i];
      k(node + i, first) += 1.3 * area * 50 * weight * normal[i];
      if (!c.friction) continue;
      for (int j = 0; j < c.dim; ++j) {
        k(first + 1 + i, node + j) += area * 7 * weight * rate(i, j);
        k(node + j, first + 1 + i) += 1.3 * area * 7 * weight * rate(i, j);
      }
    }
  };
  add(slave, 1);
  add(c.dim * (c.nodes - 1 - point % 3), -share);
  add(c.dim * (c.nodes - 2 - point % 3), share - 1);
  if (c.friction) k.block(first + 1, first + 1, c.dim, c.dim) = area * 7 * own;
}

Eigen::MatrixXd system_of(const Contact& c) {
  std::mt19937 random(c.seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(c.size(), c.size());
  const Index bodies = c.dim * c.nodes;
  for (Index i = 0; i < bodies; ++i)
    for (Index j = 0; j < bodies; ++j)
      if (std::abs(i / c.dim - j / c.dim) < 3) k(i, j) = i == j ? 40 : uniform(random);
  for (Index p = 0; p < static_cast<Index>(c.states.size()); ++p)
    add_point(c, p, c.states[static_cast<std::size_t>(p)], random, k);
  return k;
}

/// All entries of `pattern` are stored.
MatrixBuilder stored(const Eigen::MatrixXd& k, const Eigen::MatrixXd& pattern) {
  MatrixBuilder m(static_cast<Index>(k.rows()));
  for (Index i = 0; i < k.rows(); ++i)
    for (Index j = 0; j < k.cols(); ++j)
      if (k(i, j) != 0 || pattern(i, j) != 0) m.add(i, j, k(i, j));
  return m;
}
MatrixBuilder stored(const Eigen::MatrixXd& k) { return stored(k, k); }

Eigen::VectorXd some_rhs(Eigen::Index n) {
  return Eigen::VectorXd::NullaryExpr(n, [](Eigen::Index i) { return std::sin(1.0 + 3.0 * i); });
}

/// The error of the whole system's solution from the reduced one: a few roundings, relative.
double error_of(const Condensation& c, const Eigen::MatrixXd& whole) {
  const Eigen::VectorXd exact = some_rhs(whole.rows());
  const Eigen::VectorXd rhs = whole * exact;
  const Eigen::VectorXd reduced = test::dense(c.matrix()).fullPivLu().solve(c.reduced(rhs));
  return (c.expanded(reduced, rhs) - exact).norm() / exact.norm();
}

constexpr double rounding = 1e-12;

std::vector<State> random_states(std::uint32_t seed, std::size_t count) {
  std::mt19937 random(seed);
  std::vector<State> out(count);
  for (State& s : out) s = static_cast<State>(random() % 3);
  return out;
}

TEST(Condensation, SolvesLikeTheWholeSystemWithoutAnyMultiplier) {
  for (const int dim : {2, 3})
    for (const bool friction : {false, true})
      for (std::uint32_t seed = 1; seed < 20; ++seed) {
        const Contact c{dim, friction, 14, random_states(seed, 8), seed};
        const Eigen::MatrixXd whole = system_of(c);
        MatrixBuilder m = stored(whole);
        Condensation condensed;
        ASSERT_TRUE(condensed.reduce(m.finish(), c.groups()));
        EXPECT_EQ(condensed.matrix().n, c.dim * c.nodes);
        EXPECT_EQ(condensed.unknowns(), c.size());
        EXPECT_LT(error_of(condensed, whole), rounding) << dim << friction << seed;
      }
}

/// As solve::Softens has it: so small that no pivot may be made of it.
TEST(Condensation, ALittleComplianceChangesNothing) {
  for (const bool friction : {false, true}) {
    const Contact c{3, friction, 14, random_states(4, 8), 2};
    Eigen::MatrixXd whole = system_of(c);
    for (Index u = c.dim * c.nodes; u < c.size(); ++u) whole(u, u) -= 1e-8;
    MatrixBuilder m = stored(whole);
    Condensation condensed;
    ASSERT_TRUE(condensed.reduce(m.finish(), c.groups()));
    EXPECT_EQ(condensed.matrix().n, c.dim * c.nodes);
    EXPECT_LT(error_of(condensed, whole), rounding);
  }
}

/// What keeps a multiplier among the unknowns; the others are condensed all the same.
TEST(Condensation, MixesWithWhatCannotBeCondensed) {
  const Contact c{3, true, 14, std::vector<State>(8, State::stick), 3};
  const auto kept = [&](const Eigen::MatrixXd& whole, const std::vector<MultiplierGroup>& groups) {
    MatrixBuilder m = stored(whole);
    Condensation condensed;
    EXPECT_TRUE(condensed.reduce(m.finish(), groups));
    EXPECT_LT(error_of(condensed, whole), rounding);
    return condensed.matrix().n - c.dim * c.nodes;
  };
  const Eigen::MatrixXd all = system_of(c);
  EXPECT_EQ(kept(all, c.groups()), 0);
  std::vector<MultiplierGroup> groups = c.groups();
  groups.erase(groups.begin() + 2);
  EXPECT_EQ(kept(all, groups), 4) << "a point that is none of the groups";
  groups = c.groups();
  groups[3].node[1] = -1;
  EXPECT_EQ(kept(all, groups), 1) << "one direction of the slave node is prescribed";
  groups[3].node = {-1, -1, -1};
  EXPECT_EQ(kept(all, groups), 4) << "the slave node belongs to a rigid body";

  const Index slave = 3 * 2, other = c.first(4);
  Eigen::MatrixXd mixed = all;
  mixed(slave, other) = 5;
  EXPECT_EQ(kept(mixed, c.groups()), 1) << "one row knows another point's multiplier";
  mixed(slave + 1, other + 1) = mixed(slave + 2, other + 1) = 5;
  EXPECT_EQ(kept(mixed, c.groups()), 4);
  Eigen::MatrixXd weak = all;
  weak.block(slave, c.first(2), 3, 4) *= 1e-9;
  weak.block(c.first(2) + 1, c.first(2) + 1, 3, 3) -= 7 * Eigen::Matrix3d::Identity();
  EXPECT_EQ(kept(weak, c.groups()), 1) << "the pressure acts on the slave too little";
}

TEST(Condensation, RoundingOfOtherPointsMultipliersIsNothing) {
  const Contact c{2, true, 14, std::vector<State>(6, State::stick), 3};
  const Eigen::MatrixXd whole = system_of(c);
  Eigen::MatrixXd rounded = whole;
  for (Index p = 1; p < 6; ++p) rounded(2 * p, c.first(p - 1)) = 1e-15;
  MatrixBuilder m = stored(rounded);
  Condensation condensed;
  ASSERT_TRUE(condensed.reduce(m.finish(), c.groups()));
  EXPECT_EQ(condensed.matrix().n, c.dim * c.nodes);
  EXPECT_LT(error_of(condensed, rounded), rounding);
}

/// As node-to-node contact without friction in a symmetric system: the row with the largest part of
/// the normal makes place, and the constraint stands there, with an entry on the diagonal.
TEST(Condensation, TheConstraintTakesTheNodesPlace) {
  Eigen::MatrixXd k(4, 4);
  k << 5, 1, 0, 0.6, 1, 4, 1, 0.8, 0, 1, 3, -0.5, 0.6, 0.8, -0.5, 0;
  MatrixBuilder m = stored(k);
  Condensation condensed;
  ASSERT_TRUE(condensed.reduce(m.finish(), std::vector<MultiplierGroup>{{3, 1, {0, 1, -1}}}));
  const Eigen::MatrixXd reduced = test::dense(condensed.matrix());
  ASSERT_EQ(reduced.rows(), 3);
  EXPECT_TRUE(reduced.row(1).isApprox(Eigen::RowVector3d(0.6, 0.8, -0.5)));
  EXPECT_TRUE(reduced.row(0).isApprox(k.row(0).head(3) - 0.75 * k.row(1).head(3)));
  EXPECT_TRUE(reduced.row(2).isApprox(k.row(2).head(3) + 0.625 * k.row(1).head(3)));
  EXPECT_LT(error_of(condensed, k), rounding);
}

TEST(Condensation, ThePatternStandsWhilePointsOpenCloseStickAndSlip) {
  Contact c{3, true, 14, std::vector<State>(8, State::stick), 3};
  const Eigen::MatrixXd pattern = system_of(c);
  Condensation used;
  MatrixBuilder first = stored(pattern);
  ASSERT_TRUE(used.reduce(first.finish(), c.groups()));
  const std::uint64_t version = used.pattern_version();
  for (std::uint32_t seed = 1; seed < 10; ++seed) {
    c.states = random_states(seed, 8);
    c.seed = seed;
    MatrixBuilder m = stored(system_of(c), pattern);
    ASSERT_TRUE(used.reduce(m.finish(), c.groups()));
    EXPECT_EQ(used.pattern_version(), version);
    EXPECT_LT(error_of(used, system_of(c)), rounding);
    Condensation fresh;
    ASSERT_TRUE(fresh.reduce(m.finish(), c.groups()));
    EXPECT_EQ(fresh.matrix().row_start, used.matrix().row_start) << "whatever came before";
    EXPECT_EQ(fresh.matrix().column, used.matrix().column);
    EXPECT_EQ(fresh.matrix().value, used.matrix().value);
  }
  std::vector<MultiplierGroup> fewer = c.groups();
  fewer.pop_back();
  MatrixBuilder m = stored(system_of(c), pattern);
  ASSERT_TRUE(used.reduce(m.finish(), fewer));
  EXPECT_NE(used.pattern_version(), version);
  EXPECT_EQ(used.matrix().n, c.dim * c.nodes + 4);
}

TEST(Condensation, NothingToCondense) {
  const Contact c{2, false, 14, std::vector<State>(3, State::stick), 3};
  MatrixBuilder m = stored(system_of(c));
  Condensation condensed;
  EXPECT_FALSE(condensed.reduce(m.finish(), {}));
  std::vector<MultiplierGroup> groups = c.groups();
  for (MultiplierGroup& g : groups) g.node = {-1, -1, -1};
  EXPECT_FALSE(condensed.reduce(m.finish(), groups));
}

TEST(Condensation, TheSolverHasTheWholeSystemsSolution) {
  const Contact c{3, true, 40, random_states(7, 30), 3};
  const Eigen::MatrixXd whole = system_of(c);
  MatrixBuilder m = stored(whole);
  DirectSolver plain, condensing(DirectOptions{.condense = Condense::always});
  const FactorReport as_it_is =
      plain.factor(m.finish(), m.pattern_version(), Symmetry::unsymmetric, c.groups());
  const FactorReport smaller =
      condensing.factor(m.finish(), m.pattern_version(), Symmetry::unsymmetric, c.groups());
  ASSERT_EQ(as_it_is.status, SolveStatus::ok);
  ASSERT_EQ(smaller.status, SolveStatus::ok);
  EXPECT_LT(smaller.factor_entries, as_it_is.factor_entries);
  const Eigen::VectorXd exact = some_rhs(whole.rows());
  Eigen::VectorXd one = whole * exact;
  Eigen::MatrixXd two(whole.rows(), 2);
  two << one, 2 * one;
  ASSERT_EQ(condensing.solve(one), SolveStatus::ok);
  EXPECT_LT((one - exact).norm(), rounding * exact.norm());
  ASSERT_EQ(condensing.solve(two), SolveStatus::ok);
  EXPECT_EQ(two.col(0), one);
  EXPECT_LT((two.col(1) - 2 * exact).norm(), rounding * exact.norm());
  DirectSolver choosing(DirectOptions{.condense = Condense::if_unsymmetric});
  EXPECT_EQ(choosing.factor(m.finish(), 1, Symmetry::unsymmetric, c.groups()).factor_entries,
            smaller.factor_entries);
  EXPECT_EQ(choosing.factor(m.finish(), 1, Symmetry::indefinite, c.groups()).factor_entries,
            plain.factor(m.finish(), 1, Symmetry::indefinite).factor_entries);
  Eigen::VectorXd too_short = Eigen::VectorXd::Zero(c.dim * c.nodes);
  EXPECT_EQ(condensing.solve(too_short), SolveStatus::failed);
  // The next system is one without multipliers.
  MatrixBuilder other = test::grid(4, 4, true);
  ASSERT_EQ(condensing.factor(other.finish(), 1, Symmetry::indefinite).status, SolveStatus::ok);
  Eigen::VectorXd b = Eigen::VectorXd::Ones(other.finish().n);
  EXPECT_EQ(condensing.solve(b), SolveStatus::ok);
}

TEST(Condensation, AZeroRowIsNamedAsInTheWholeSystem) {
  const Contact c{2, true, 40, std::vector<State>(20, State::stick), 3};
  Eigen::MatrixXd whole = system_of(c);
  const Index free = 2 * 25 + 1;
  whole.row(free).setZero();
  whole.col(free).setZero();
  std::vector<MultiplierGroup> groups = c.groups();
  MatrixBuilder m = stored(whole);
  DirectSolver solver(DirectOptions{.condense = Condense::always});
  const FactorReport report = solver.factor(m.finish(), 1, Symmetry::unsymmetric, groups);
  EXPECT_EQ(report.status, SolveStatus::singular);
  EXPECT_EQ(report.bad_row, free);
}

TEST(Condensation, WhatIsNotANumberIsReported) {
  const Contact c{2, true, 14, std::vector<State>(6, State::stick), 3};
  const Eigen::MatrixXd whole = system_of(c);
  for (const Index row : {Index{2}, c.first(1), c.first(1) + 1, Index{20}})
    for (Index column = 0; column < c.size(); ++column) {
      if (whole(row, column) == 0) continue;
      Eigen::MatrixXd bad = whole;
      bad(row, column) = std::nan("");
      MatrixBuilder m = stored(bad);
      DirectSolver solver(DirectOptions{.condense = Condense::always});
      EXPECT_EQ(solver.factor(m.finish(), 1, Symmetry::unsymmetric, c.groups()).status,
                SolveStatus::failed)
          << row << ' ' << column;
    }
}

TEST(LocalPivots, FindTheRank) {
  LocalBlock block(4, 3);
  block << 1, 2, 0, 2, 4, 0, 0, 0, 1e-9, 1, 2, 0;
  const LocalPivots p = local_pivots(block, 1e-6);
  ASSERT_EQ(p.count, 1);
  EXPECT_EQ(p.rows[0], 1);
  EXPECT_EQ(p.columns[0], 1);
  EXPECT_EQ(local_pivots(block, 1e-12).count, 2);
  EXPECT_EQ(local_pivots(LocalBlock::Zero(3, 2), 1e-6).count, 0);
}

}  // namespace
}  // namespace osculate::la
