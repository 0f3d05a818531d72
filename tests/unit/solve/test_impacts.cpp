#include <gtest/gtest.h>

#include <cmath>

#include "osculate/la/mumps.hpp"
#include "toy_system.hpp"

namespace osculate::solve {
namespace {

/// A point whose height follows a given path until it meets the ground: x = (height, time).
struct FallingSystem : ToySystem {
  std::function<double(double time)> speed;
  bool looks_ahead = true;

  [[nodiscard]] std::optional<ImpactAhead> impact_ahead(const State& state, double fraction) const {
    const double h = fraction - state.x[1], v = speed(state.x[1]);
    constexpr double horizon = 1.25;
    if (!looks_ahead || !(state.x[0] > 0) || !(v < 0) || -state.x[0] / v > horizon * h)
      return std::nullopt;
    return ImpactAhead{-state.x[0] / v / h, {{0, 0}}};
  }
  [[nodiscard]] bool has_met(const State& committed, const ImpactAhead& expected) const {
    return !expected.points.empty() && committed.x[0] > 0 && evaluated.back()[0] <= 0;
  }
};

static_assert(MeetsImpacts<FallingSystem>);
static_assert(!MeetsImpacts<ToySystem>);

constexpr double start = 1;

FallingSystem falling(double speed, double acceleration) {
  FallingSystem system;
  system.size = 2;
  system.builder = la::MatrixBuilder(system.size);
  system.force = [=](const Eigen::VectorXd& x, double t) {
    const double height = start + speed * t + 0.5 * acceleration * t * t;
    return vector({x[0] - std::max(height, 0.0), x[1] - t});
  };
  system.stiffness = [](const Eigen::VectorXd&) { return Eigen::MatrixXd::Identity(2, 2); };
  system.speed = [=](double t) { return speed + acceleration * t; };
  return system;
}

std::vector<double> ends_of(FallingSystem& system, int increments, int* wasted = nullptr) {
  la::Mumps solver;
  std::vector<double> ends;
  const auto result =
      run_step(system, ToySystem::State{vector({start, 0})}, increments, {}, solver,
               IncrementObserver<ToySystem::State>(
                   [&](const ToySystem::State& state, const IncrementRecord& record) {
                     EXPECT_EQ(state.x[1], record.fraction);
                     ends.push_back(record.fraction);
                     if (wasted) *wasted += record.wasted_iterations;
                     return true;
                   }),
               CutbackObserver(
                   [](const std::string&, double, double, const std::vector<IterationRecord>&) {}));
  EXPECT_EQ(result.outcome, Outcome::converged);
  return ends;
}

double nearest(const std::vector<double>& ends, double time) {
  double least = 1;
  for (const double end : ends) least = std::min(least, std::abs(end - time));
  return least;
}

void expect_all_nominal_ends(const std::vector<double>& ends, int increments) {
  for (int i = 1; i <= increments; ++i)
    EXPECT_EQ(nearest(ends, static_cast<double>(i) / increments), 0) << i;
}

TEST(Impacts, AnIncrementEndsThere) {
  // The velocity at the beginning tells too late a time when the point gets faster, too early a
  // one when it gets slower, and the exact one when neither.
  for (const double acceleration : {-2.0, 0.0, 0.9}) {
    constexpr double speed = -1.6;
    const double time =
        acceleration == 0
            ? -start / speed
            : (-speed - std::sqrt(speed * speed - 2 * start * acceleration)) / acceleration;
    for (const int increments : {1, 2, 3, 7}) {
      FallingSystem system = falling(speed, acceleration);
      int wasted = 0;
      const std::vector<double> ends = ends_of(system, increments, &wasted);
      EXPECT_LT(nearest(ends, time), 0.009 / increments) << acceleration << ' ' << increments;
      EXPECT_EQ(ends.size(), static_cast<std::size_t>(increments) + 1);
      expect_all_nominal_ends(ends, increments);
      EXPECT_LE(wasted, 20);
    }
  }
}

TEST(Impacts, WithoutOneNothingChanges) {
  FallingSystem away = falling(0.3, 0);
  EXPECT_EQ(ends_of(away, 3), (std::vector<double>{1.0 / 3, 2.0 / 3, 1.0}));
  FallingSystem unseen = falling(-1.6, 0);
  unseen.looks_ahead = false;
  EXPECT_EQ(ends_of(unseen, 3), (std::vector<double>{1.0 / 3, 2.0 / 3, 1.0}));
}

TEST(Impacts, WhatHappensNowShortensNothing) {
  FallingSystem system = falling(-400, 0);  // after 1/800 of the first increment
  EXPECT_EQ(ends_of(system, 2), (std::vector<double>{0.5, 1.0}));
}

TEST(Impacts, OnesThatCannotBeSolvedAreCutBack) {
  FallingSystem system = falling(-1.6, 0);
  system.wrong = [](const Eigen::VectorXd& x, const Eigen::VectorXd& committed) {
    return x[1] - committed[1] > 0.3 ? std::string("too far") : std::string();
  };
  const std::vector<double> ends = ends_of(system, 1);
  EXPECT_LT(nearest(ends, start / 1.6), 0.009);
  EXPECT_EQ(ends.back(), 1.0);
}

}  // namespace
}  // namespace osculate::solve
