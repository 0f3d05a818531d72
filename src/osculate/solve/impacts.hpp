#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <limits>
#include <optional>
#include <vector>

#include "osculate/solve/impact_ahead.hpp"
#include "osculate/solve/newton.hpp"

namespace osculate::solve {

/// Systems with inertia whose points meet obstacles.
///
/// impact_ahead(state, fraction)     of a committed state; nothing: none comes soon
/// has_met(committed, expected)      one of the points has met its obstacle in the last state
///                                   evaluated
template <class S>
concept MeetsImpacts = requires(S s, const typename S::State& state, double fraction,
                                const ImpactAhead& expected) {
  { s.impact_ahead(state, fraction) } -> std::same_as<std::optional<ImpactAhead>>;
  { s.has_met(state, expected) } -> std::same_as<bool>;
};

/// Solves one increment from `at` to `target`, or to the first impact on the way, which `target`
/// then is. `attempt(end)` solves one to `end`; iterations of what was too long or too short are
/// `wasted`.
///
/// Why        within one increment a point has one state for all of it. One that slides down a
///            face and then meets another at an angle would have to do both
/// How        the end follows from the velocity at the last end that was too short (Newton's
///            method); one that was too long is shortened. It is kept 1/200 of a nominal increment
///            away from the impact: there states change. An impact within the first 1/100 of one
///            happens now: nothing is shortened for it
/// Tested by  tests/unit/solve/test_impacts.cpp
template <System S, class Attempt>
NewtonResult<typename S::Trial> up_to_impact(S& system, const typename S::State& committed,
                                             double at, double& target, double nominal, int& wasted,
                                             const Attempt& attempt) {
  constexpr double now = 0.01, away = 0.005, enough = 0.003;
  constexpr int most = 12;
  std::optional<ImpactAhead> ahead = system.impact_ahead(committed, target);
  if (!ahead || ahead->share * (target - at) < now * nominal) return attempt(target);
  std::vector<std::array<std::size_t, 2>> expected = ahead->points;
  double free = at, met = std::numeric_limits<double>::infinity();
  const auto shortly_before = [&](double from, double share) {
    return std::min(target, from + share * (target - from) - away * nominal);
  };
  double end = shortly_before(at, ahead->share);
  for (int n = 1;; ++n) {
    NewtonResult<typename S::Trial> result = attempt(end);
    const bool converged = result.outcome == Outcome::converged;
    double next = free + 0.8 * (end - free);
    if (converged && system.has_met(committed, {0, expected})) {
      met = end;
    } else if (converged) {
      if (end == target) return result;
      free = end;
      ahead = system.impact_ahead(system.commit(result.trial, end), target);
      next = ahead ? shortly_before(end, ahead->share) : target;
      if (ahead) expected.insert(expected.end(), ahead->points.begin(), ahead->points.end());
      if (next >= met) next = 0.5 * (free + met);
    }
    if (!converged || n == most || (free == end && next - end < enough * nominal)) {
      target = end;
      return result;
    }
    wasted += static_cast<int>(result.iterations.size());
    end = next;
  }
}

}  // namespace osculate::solve
