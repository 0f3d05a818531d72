// An equilibrium that does not last is told from one that does.
#include <gtest/gtest.h>

#include "osculate/la/mumps.hpp"
#include "toy_system.hpp"

namespace osculate::solve {
namespace {

/// A strut of stiffness 1 under the force t; sideways it resists by c - slope t.
struct Strut : ToySystem {
  bool rest = true, saddle = false;
  la::Symmetry kind = la::Symmetry::indefinite;
  double share = 0;

  explicit Strut(double c, double slope = 1) {
    size = 2;
    builder = la::MatrixBuilder{2};
    force = [=](const Vector& x, double t) {
      return vector({x[0] - t, (c - slope * x[0]) * x[1]});
    };
    stiffness = [=](const Vector& x) {
      Eigen::MatrixXd k(2, 2);
      k << 1, 0, -slope * x[1], c - slope * x[0];
      return k;
    };
  }
  void evaluate(const State& committed, const State& trial, double time, bool tangent,
                Evaluation& out) {
    ToySystem::evaluate(committed, trial, time, tangent, out);
    out.saddle = saddle;
    for (Index i = 0; tangent && share > 0 && i < size; ++i) builder.add(i, i, share);
  }
  [[nodiscard]] static double stride(const Vector& du) { return du.lpNorm<Eigen::Infinity>(); }
  void resist(double value) { share = value; }
  [[nodiscard]] bool at_rest() const { return rest; }
  [[nodiscard]] la::Symmetry symmetry() const { return kind; }
};

static_assert(KnowsRest<Strut>);
static_assert(!KnowsRest<ToySystem>);

/// Unstable motions at the end of a step of `increments`, up to t = 1.
int unstable(Strut system, int increments = 4) {
  la::Mumps solver;
  const auto result = run_step<Strut>(
      system, {vector({0.0, 0.0})}, increments, {}, solver,
      [](const auto&, const IncrementRecord&) { return true; },
      [](const std::string&, double, double, const std::vector<IterationRecord>&) {});
  EXPECT_EQ(result.outcome, Outcome::converged) << result.reason;
  EXPECT_EQ(system.share, 0) << "nothing of it stays";
  return result.increments.empty() ? -1 : result.increments.back().precision.unstable;
}

TEST(Stability, AboveTheCriticalForceAnEquilibriumIsUnstable) {
  EXPECT_EQ(unstable(Strut(0.6)), 1);
  EXPECT_EQ(unstable(Strut(1.1)), 0);
}

TEST(Stability, WhatIsNegativeByRoundOffIsNot) {
  EXPECT_EQ(unstable(Strut(-5e-13, 0)), 0);
  EXPECT_EQ(unstable(Strut(-1e-10, 0)), 1);
}

TEST(Stability, InertiaMultipliersAndUnsymmetricTangentsAreNotLookedAt) {
  Strut moving(0.6), held(0.6), sliding(0.6);
  moving.rest = false;
  held.saddle = true;
  sliding.kind = la::Symmetry::unsymmetric;
  for (const Strut& system : {moving, held, sliding}) EXPECT_EQ(unstable(system), 0);
}

}  // namespace
}  // namespace osculate::solve
