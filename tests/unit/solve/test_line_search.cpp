#include <gtest/gtest.h>

#include <algorithm>

#include "osculate/la/mumps.hpp"
#include "toy_system.hpp"

namespace osculate::solve {
namespace {

/// x^3 + x = 2, from `x`.
struct SearchedCubic {
  ToySystem system = scalar_system([](double x, double) { return x * x * x + x - 2; },
                                   [](double x) { return 3 * x * x + 1; });
  NewtonResult<ToySystem::State> result;

  explicit SearchedCubic(double x) {
    la::Mumps solver;
    result = newton(system, {vector({x})}, 1, {}, solver);
  }
};

/// The search evaluates a full correction with its tangent: what it takes is not evaluated again.
TEST(Newton, WhatTheSearchTakesIsNotEvaluatedTwice) {
  const SearchedCubic searched(2);
  const auto& [system, result] = searched;
  ASSERT_EQ(result.outcome, Outcome::converged) << result.reason;
  ASSERT_GT(result.iterations.size(), 3u);
  const std::vector<Eigen::VectorXd>& seen = system.evaluated;
  EXPECT_EQ(seen.back(), result.trial.x);
  EXPECT_EQ(std::adjacent_find(seen.begin(), seen.end()), seen.end());
}

/// Near the solution the search does without: the next iterate may be the last one, which needs
/// none.
TEST(Newton, TheLastIterateHasNoTangentThatNobodyNeeds) {
  const SearchedCubic searched(1.001);
  const auto& [system, result] = searched;
  ASSERT_EQ(result.outcome, Outcome::converged) << result.reason;
  ASSERT_EQ(result.iterations.size(), 2u);
  EXPECT_LT(result.iterations[0].residual, 1e-5);
  EXPECT_EQ(system.evaluated.back(), result.trial.x);
  EXPECT_FALSE(system.with_tangent.back());
  EXPECT_TRUE(system.with_tangent[system.with_tangent.size() - 2]);
}

}  // namespace
}  // namespace osculate::solve
