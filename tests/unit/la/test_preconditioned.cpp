// Iterations with a preconditioner: restarts, what is good enough, several processes.
#include "osculate/la/preconditioned.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "ranks.hpp"

namespace osculate::la {
namespace {

constexpr Eigen::Index n = 120;

/// Unsymmetric, with a condition of some hundred.
Eigen::MatrixXd matrix() {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    a(i, i) = 2 + 0.5 * static_cast<double>(i);
    if (i > 0) a(i, i - 1) = -1;
    if (i + 1 < n) a(i, i + 1) = -0.6;
  }
  return a;
}

PreconditionedSolutions by_itself(const Eigen::MatrixXd& a) {
  return {[&a](const Eigen::VectorXd& x, Eigen::VectorXd& y) { y = a * x; },
          [](Eigen::VectorXd&) { return true; }};
}

Nearby solved(const Eigen::MatrixXd& a, const PreconditionedLimits& limits, Eigen::VectorXd& x) {
  return by_itself(a).solve(limits, x);
}

TEST(Preconditioned, RestartsUntilItIsSolved) {
  const Eigen::MatrixXd a = matrix();
  const Eigen::VectorXd b = noise(n);
  int without = 0;
  for (const int restart : {1000, 15, 4}) {
    SCOPED_TRACE(restart);
    Eigen::VectorXd x = b;
    PreconditionedLimits limits{1e-9, 500, restart, 0.9, 1e-9};
    const Nearby done = solved(a, limits, x);
    ASSERT_TRUE(done.solved);
    EXPECT_LE((b - a * x).norm(), 1.001e-9 * b.norm());
    EXPECT_GT(done.iterations, 20);
    if (restart == 1000) without = done.iterations;
    EXPECT_GE(done.iterations, without);
  }
}

TEST(Preconditioned, GivesUpWhereRestartsGainTooLittleAndChangesNothing) {
  const Eigen::MatrixXd a = matrix();
  const Eigen::VectorXd b = noise(n);
  Eigen::VectorXd x = b;
  const Nearby done = solved(a, {1e-9, 500, 4, 0.01, 1e-9}, x);
  EXPECT_FALSE(done.solved);
  EXPECT_EQ(done.iterations, 4);
  EXPECT_EQ(x, b);
}

TEST(Preconditioned, TakesWhatIsGoodEnoughWhereNoMoreIsToBeHad) {
  const Eigen::MatrixXd a = matrix();
  const Eigen::VectorXd b = noise(n);
  for (const double good_enough : {1e-20, 1e-10}) {
    Eigen::VectorXd x = b;
    const Nearby done = solved(a, {1e-19, 300, 1000, 0.3, good_enough}, x);
    EXPECT_EQ(done.solved, good_enough == 1e-10);
    if (done.solved) {
      EXPECT_LE((b - a * x).norm(), 1.001e-10 * b.norm());
    } else {
      EXPECT_EQ(x, b);
    }
  }
}

TEST(Preconditioned, RefusesWhatIsNoNumber) {
  const Eigen::MatrixXd a = matrix();
  for (const double wrong : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
    x[7] = wrong;
    EXPECT_FALSE(solved(a, {}, x).solved);
  }
  Eigen::VectorXd zero = Eigen::VectorXd::Zero(n);
  EXPECT_TRUE(solved(a, {}, zero).solved);
  EXPECT_TRUE(zero.isZero(0));
  Eigen::VectorXd x = noise(n);
  PreconditionedSolutions broken([&a](const Eigen::VectorXd& v, Eigen::VectorXd& y) { y = a * v; },
                                 [](Eigen::VectorXd& r) {
                                   r.setConstant(std::nan(""));
                                   return true;
                                 });
  EXPECT_FALSE(broken.solve({}, x).solved);
  EXPECT_EQ(x, noise(n));
}

// Rows dealt out, one process without any; the same iterations, and solutions to rounding.
TEST(Preconditioned, SeveralProcessesIterateAsOne) {
  const Eigen::MatrixXd a = matrix();
  const Eigen::VectorXd b = noise(n);
  Eigen::VectorXd alone = b;
  const PreconditionedLimits limits{1e-9, 500, 15, 0.9, 1e-9};
  const Nearby reference = solved(a, limits, alone);
  ASSERT_TRUE(reference.solved);
  osculate::testing::as_ranks(4, [&](const core::Ranks& ranks) {
    const std::array<Eigen::Index, 5> first{0, 50, 50, 83, n};
    const auto me = static_cast<std::size_t>(ranks.rank());
    const Eigen::Index begin = first[me], own = first[me + 1] - begin;
    PreconditionedSolutions by(
        [&](const Eigen::VectorXd& x, Eigen::VectorXd& y) {
          Eigen::VectorXd all = Eigen::VectorXd::Constant(n, core::Ranks::nothing);
          all.segment(begin, own) = x;
          ranks.sum({all.data(), static_cast<std::size_t>(n)});
          y = a.middleRows(begin, own) * all;
        },
        [](Eigen::VectorXd&) { return true; }, &ranks);
    Eigen::VectorXd x = b.segment(begin, own);
    const Nearby done = by.solve(limits, x);
    EXPECT_TRUE(done.solved);
    EXPECT_EQ(done.iterations, reference.iterations);
    EXPECT_LE((x - alone.segment(begin, own)).norm(), 1e-9 * alone.norm());
  });
}

}  // namespace
}  // namespace osculate::la
