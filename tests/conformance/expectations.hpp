#pragma once
// What every combination of the axes must do.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "osculate/api/tangent_check.hpp"
#include "osculate/deck/build.hpp"

namespace osculate::testing {

/// Order two or round-off in every part, unless the tangent is none by choice; contact must have
/// been there to check.
inline void expect_tangent(const api::TangentReport& report) {
  EXPECT_GT(report.counts.touching(), 0);
  for (const api::TangentRow& row : report.rows) {
    if (!row.expected) continue;
    EXPECT_FALSE(row.skipped) << row.part << ": " << row.note;
    EXPECT_TRUE(row.exact || std::abs(row.order - 2) < 0.15)
        << row.part << ": order " << row.order << ", error " << row.error;
  }
}

/// The first increment converges; its two columns of history are a force and its reaction.
template <int Dim>
void expect_increment(const deck::BasicBuilt<Dim>& built) {
  std::vector<double> row;
  model::BasicAnalysisObserver<Dim> observer;
  observer.converged = [&](model::BasicSystem<Dim>& system, const model::BasicState<Dim>& state,
                           const model::Progress&, const solve::IncrementRecord*) {
    row.clear();
    for (const auto& request : built.history)
      row.push_back(model::history_value(system, built.model, state, request));
    return true;
  };
  const auto result = model::run(built.model, built.options, observer);
  ASSERT_EQ(result.outcome, solve::Outcome::converged) << result.message;
  EXPECT_GT(row[0], 1e-3);
  EXPECT_NEAR(row[0], -row[1], 1e-7 * row[0]);
}

}  // namespace osculate::testing
