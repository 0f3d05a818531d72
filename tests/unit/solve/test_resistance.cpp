// Free motions are resisted until contact closes, and nothing of it stays.
#include <gtest/gtest.h>

#include "osculate/la/mumps.hpp"
#include "toy_system.hpp"

namespace osculate::solve {
namespace {

/// A point that a force of 1 pushes over a gap of 5 onto a spring of stiffness 100.
struct FreePoint : ToySystem {
  double share = 0;
  std::vector<double> shares;
  double limit = 1;

  FreePoint() {
    static_cast<ToySystem&>(*this) =
        scalar_system([](double x, double t) { return std::max(0.0, x - 5) * 100 - t; },
                      [](double x) { return x > 5 ? 100.0 : 0.0; });
  }
  void resist(double value) {
    share = value;
    shares.push_back(value);
  }
  [[nodiscard]] double stride(const Eigen::VectorXd& du) const {
    return du.lpNorm<Eigen::Infinity>() / limit;
  }
  const la::SparseMatrix& matrix() {
    fill(evaluated.back());
    builder.add(0, 0, 100 * share);
    return builder.finish();
  }
};

static_assert(Resists<FreePoint>);
static_assert(!Resists<ToySystem>);

TEST(Resistance, BringsAFreePointToItsSpring) {
  FreePoint system;
  la::Mumps solver;
  const auto result = run_step<FreePoint>(
      system, {vector({0.0})}, 1, {}, solver,
      [](const auto&, const IncrementRecord&) { return true; },
      [](const std::string&, double, double, const std::vector<IterationRecord>&) {});
  ASSERT_EQ(result.outcome, Outcome::converged) << result.reason;
  // As without any resistance, up to what the residual is converged to.
  EXPECT_NEAR(result.state.x[0], 5.01, 1e-9 * 5.01);
  ASSERT_EQ(result.increments.size(), 1u);
  EXPECT_TRUE(result.increments[0].resisted);
  EXPECT_EQ(result.increments[0].cutbacks, 0);
  EXPECT_EQ(system.share, 0) << "removed";
}

TEST(Resistance, NothingMovesFartherThanOneStride) {
  FreePoint system;
  la::Mumps solver;
  (void)newton<FreePoint>(system, {vector({0.0})}, 1.0, {}, solver,
                          {{}, 0, 0, Prediction::as_before, true});
  double before = 0;
  for (const Eigen::VectorXd& x : system.evaluated) {
    EXPECT_LE(std::abs(x[0] - before), system.limit * (1 + 1e-12));
    before = x[0];
  }
}

/// F(x) = x^3 - 3 x^2 + 2.5 x rises to 0.636 at x = 0.592, falls, and is 0.636 again at x = 1.816.
/// It may not move farther than 0.1 in an iteration, nor jump over the falling branch.
struct Snapping : FreePoint {
  Snapping() {
    static_cast<ToySystem&>(*this) =
        scalar_system([](double x, double t) { return x * (x * (x - 3) + 2.5) - t; },
                      [](double x) { return x * (3 * x - 6) + 2.5; });
    limit = 0.1;
  }
};

TEST(Resistance, ASnapComesToRest) {
  Snapping system;
  la::Mumps solver;
  const auto result = newton<Snapping>(system, {vector({0.55})}, 0.7, {}, solver,
                                       {{}, 0, 0, Prediction::as_before, true});
  ASSERT_EQ(result.outcome, Outcome::converged) << result.reason;
  const double x = result.trial.x[0];
  EXPECT_GT(x, 1.8);
  EXPECT_NEAR(x * (x * (x - 3) + 2.5), 0.7, 1e-8);
  EXPECT_EQ(system.share, 0) << "removed";
}

/// The same with multipliers: the sign of the work says nothing, and nothing is asked of it.
struct Saddle : Snapping {
  void evaluate(const State& committed, const State& trial, double time, bool tangent,
                Evaluation& out) {
    Snapping::evaluate(committed, trial, time, tangent, out);
    out.saddle = true;
  }
  void predict(const State& state, double time, Evaluation& out) {
    evaluate(state, state, time, true, out);
  }
};

TEST(Resistance, TheWorkOfMultipliersIsNotAskedFor) {
  // On the falling branch the correction goes uphill, back to where its residual is zero.
  Saddle system;
  la::Mumps solver;
  const auto result = newton<Saddle>(system, {vector({1.0})}, 0.49, {}, solver,
                                     {{}, 0, 0, Prediction::as_before, true});
  ASSERT_EQ(result.outcome, Outcome::converged) << result.reason;
  EXPECT_NEAR(result.trial.x[0], 1.02, 1e-3);
  Snapping other;
  const auto stable = newton<Snapping>(other, {vector({1.0})}, 0.49, {}, solver,
                                       {{}, 0, 0, Prediction::as_before, true});
  ASSERT_EQ(stable.outcome, Outcome::converged) << stable.reason;
  EXPECT_GT(std::abs(stable.trial.x[0] - 1), 0.5) << "leaves the unstable branch";
}

TEST(Resistance, WhatNothingHoldsStillFails) {
  FreePoint system;
  system.force = [](const Eigen::VectorXd&, double t) { return vector({-t}); };
  system.stiffness = [](const Eigen::VectorXd&) { return Eigen::MatrixXd::Zero(1, 1); };
  la::Mumps solver;
  const auto result = run_step<FreePoint>(
      system, {vector({0.0})}, 1, {}, solver,
      [](const auto&, const IncrementRecord&) { return true; },
      [](const std::string&, double, double, const std::vector<IterationRecord>&) {});
  EXPECT_NE(result.outcome, Outcome::converged);
  EXPECT_EQ(system.share, 0);
}

}  // namespace
}  // namespace osculate::solve
