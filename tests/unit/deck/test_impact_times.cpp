// Increments in time that end at impacts.
#include <gtest/gtest.h>

#include <cmath>

#include "system_test.hpp"

namespace osculate::deck {
namespace {

constexpr double nominal = 0.05, height = 0.12, speed = 1;

struct Fall {
  std::vector<double> times;
  double speed = 0;  ///< at the end of the first step
};

Fall fall_of(const std::string& text) {
  const Built built = build_text(text);
  Fall fall;
  model::AnalysisObserver observer;
  observer.converged = [&](model::System&, const model::State& state,
                           const model::Progress& progress, const solve::IncrementRecord*) {
    if (progress.step > 0) return true;
    fall.times.push_back(state.rates.energies.elapsed);
    fall.speed = state.rates.velocity[0 + 1];
    return true;
  };
  EXPECT_EQ(model::run(built.model, built.options, observer).outcome, solve::Outcome::converged);
  return fall;
}

/// The last end before the impact, as a share of a nominal increment.
double before_impact(const Fall& fall) {
  double least = 1;
  for (const double t : fall.times)
    if (t <= height / speed) least = std::min(least, (height / speed - t) / nominal);
  return least;
}

TEST(ImpactTimes, BecomeTheModel) {
  const Built built = build_text(test_file("impacts.yaml"));
  EXPECT_EQ(built.model.steps.at(0).dynamics->impact_times, model::ImpactTimes::all);
  const auto& later = built.model.steps.at(1).dynamics->explicit_steps;
  ASSERT_TRUE(later.has_value());
  EXPECT_EQ(later->safety, 0.8);
  EXPECT_EQ(later->step, 1e-4);
}

TEST(ImpactTimes, AnIncrementEndsShortlyBefore) {
  for (const char* const word : {"all", "auto"}) {
    const Fall fall = fall_of(edited(test_file("impacts.yaml"), "impact_times: all",
                                     std::string("impact_times: ") + word));
    EXPECT_EQ(fall.times.size(), 9u) << word;  // the start, seven nominal ones, the impact
    EXPECT_GT(before_impact(fall), 0.001);
    EXPECT_LT(before_impact(fall), 0.01);
    EXPECT_NEAR(fall.speed, 0, 1e-3 * speed);
  }
}

TEST(ImpactTimes, OffLeavesTheIncrements) {
  const Fall fall =
      fall_of(edited(test_file("impacts.yaml"), "impact_times: all", "impact_times: off"));
  EXPECT_EQ(fall.times.size(), 8u);
  EXPECT_NEAR(before_impact(fall), 0.4, 1e-9);
}

TEST(ImpactTimes, WhatFliesAwayEndsNothing) {
  const Fall fall = fall_of(edited(test_file("impacts.yaml"), "vy: -1", "vy: 1"));
  EXPECT_EQ(fall.times.size(), 8u);
}

}  // namespace
}  // namespace osculate::deck
