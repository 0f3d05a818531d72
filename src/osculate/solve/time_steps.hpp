#pragma once
#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <vector>

#include "osculate/solve/time_scheme.hpp"

namespace osculate::solve {

/// What one step of the family is off by, over h^2 (a_n+1 - a_n).
///
/// Formula    u_n+1 - u(t_n+1) = factor h^2 (a_n+1 - a_n) + O(h^4) ,
///            factor = beta + (alpha_m - alpha_f) / 2 - 1/6 ; for u_n, v_n on the solution and a_n
///            its acceleration at t_n + (alpha_m - alpha_f) h, which is where the accelerations of
///            the scheme belong
/// Source     ZienkiewiczXie1991 for Newmark; with the shift: decision 028
/// Sign       above zero for all members here: beta = (1 - alpha_m + alpha_f)^2 / 4, so that it is
///            1/12 + (alpha_m - alpha_f)^2 / 4
/// Tested by  tests/unit/solve/test_time_steps.cpp
[[nodiscard]] constexpr double error_factor(const TimeScheme& s) {
  return s.beta + 0.5 * (s.alpha_m - s.alpha_f) - 1.0 / 6;
}

/// The error of one step in time, and what it is small against: root mean squares over the mass,
/// times the root of the mass.
struct TimeError {
  double rate = 0;    ///< error of the displacement over the length of the step
  double speed = 0;   ///< change of the velocity since the beginning
  double length = 0;  ///< of the step
};

/// Systems that know the error of a step in time. `next` must be the last state committed.
template <class S>
concept EstimatesTimeErrors = requires(S s, const typename S::State& state) {
  { s.time_error(state, state) } -> std::same_as<TimeError>;
};

/// How long steps in time may be.
struct TimeAccuracy {
  double error = 1e-3;          ///< the rate of errors, over the largest speed
  double smallest = 0;          ///< share of the step that is not shortened any more
  std::vector<double> corners;  ///< fractions to be hit, in order
};

/// What the choice of lengths remembers.
struct TimePace {
  double speed = 0;  ///< largest so far
  double tried = 0;  ///< largest of the steps that were refused and are not yet made good
  double until = 0;  ///< fraction where the last of those would have ended
};

/// A step in time that was taken; length 0: none, or its length was not chosen by its error.
struct TimeStepTaken {
  double length = 0;  ///< in time
  double error = 0;   ///< its rate over the largest speed
  int refused = 0;    ///< steps before it that were too long
};

/// Rate of the error over the largest speed so far. Refused steps count until their time has been
/// reached: a motion that begins slowly is small against what it becomes within the first of them.
///
/// Tested by  tests/unit/solve/test_time_steps.cpp
[[nodiscard]] inline double relative_error(const TimeError& e, const TimePace& pace) {
  const double speed = std::max({e.speed, pace.speed, pace.tried});
  if (!(e.rate > 0)) return 0;
  return speed > 0 ? e.rate / speed : std::numeric_limits<double>::infinity();
}

[[nodiscard]] inline TimePace after_refusal(TimePace pace, const TimeError& e, double end) {
  pace.tried = std::max(pace.tried, e.speed);
  pace.until = std::max(pace.until, end);
  return pace;
}

[[nodiscard]] inline TimePace after_step(TimePace pace, const TimeError& e, double end) {
  pace.speed = std::max(pace.speed, e.speed);
  if (end >= pace.until) pace.tried = pace.until = 0;
  return pace;
}

/// End of a step of about `length` from `at`: the next corner or the end of the nominal increment
/// is hit, and the last two steps before it are of one length.
///
/// Requires   at < end, length > 0
/// Tested by  tests/unit/solve/test_time_steps.cpp
[[nodiscard]] inline double time_target(double at, double length, double end,
                                        const std::vector<double>& corners) {
  constexpr double sliver = 1e-6;
  const double close = sliver * std::min(length, end - at);
  const auto corner = std::upper_bound(corners.begin(), corners.end(), at + close);
  const double stop = corner != corners.end() && *corner < end - close ? *corner : end;
  const double rest = stop - at;
  if (rest <= length * (1 + sliver)) return stop;
  if (rest <= 2 * length * (1 + sliver)) return at + 0.5 * rest;
  return at + length;
}

namespace detail {
constexpr double time_safety = 0.8;  ///< root of the share of the allowed error that is aimed at
constexpr double time_margin = 1.5;  ///< share that is refused
constexpr double least_cut = 0.1, most_growth = 2, worth_growing = 1.4;
}  // namespace detail

/// The step is to be repeated with a shorter one.
[[nodiscard]] inline bool refuses(double length, double share, double smallest) {
  constexpr double rounding = 1e-9;
  return share > detail::time_margin && length > smallest * (1 + rounding);
}

/// Length of the repetition. `share`: error over what is allowed; its rate is of second order.
///
/// Formula    h_new = 0.8 h / sqrt(share), at least h / 10
/// Tested by  tests/unit/solve/test_time_steps.cpp
[[nodiscard]] inline double shorter(double length, double share, double smallest) {
  return std::max(smallest,
                  length * std::max(detail::least_cut, detail::time_safety / std::sqrt(share)));
}

/// Length of the steps after one of `taken` that was accepted, steps having had `length` so far (or
/// less, where something had to be hit). It stays where it fits about.
///
/// Formula    h_new = 0.8 taken / sqrt(share) if share > 1; if it is 1.4 length or more: that or 2
///            length, where growing is not ruled out
/// Tested by  tests/unit/solve/test_time_steps.cpp
[[nodiscard]] inline double next_length(double length, double taken, double share, bool may_grow,
                                        double smallest, double largest) {
  const double fits = share > 0 ? detail::time_safety * taken / std::sqrt(share)
                                : std::numeric_limits<double>::infinity();
  double next = length;
  if (share > 1)
    next = std::min(length, fits);
  else if (may_grow && fits >= detail::worth_growing * length)
    next = std::min(fits, detail::most_growth * length);
  return std::min(std::max(next, smallest), largest);
}

}  // namespace osculate::solve
