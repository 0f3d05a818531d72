#pragma once

namespace osculate::pairing {

/// A penalty is this many times the stiffness of the cells behind the contact
/// (docs/decisions/020).
inline constexpr double automatic_factor = 10;

/// Points whose stiffness differs from the pair's by less than this factor have the pair's:
/// surfaces of nearly equal cells transmit a uniform pressure exactly (docs/decisions/020).
inline constexpr double usual_spread = 3;

/// Two layers behind each other give way one after the other; a rigid one (0) does not.
[[nodiscard]] inline double in_series(double a, double b) {
  return a > 0 && b > 0 ? a * b / (a + b) : a + b;
}

/// What the penalty of a pair is multiplied by at a point, where the stiffness behind the point is
/// `ratio` times the mean. Continuous; within a factor of `usual_spread` of the ratio.
///
/// Formula    ratio / s for ratio > s ,  s ratio for ratio < 1 / s ,  else 1 ;  s = usual_spread
/// Tested by  tests/unit/deck/test_point_penalties.cpp, tests/unit/embed/test_automatic_penalty.cpp
[[nodiscard]] inline double own_factor(double ratio) {
  if (ratio > usual_spread) return ratio / usual_spread;
  if (ratio < 1 / usual_spread) return ratio * usual_spread;
  return 1;
}

}  // namespace osculate::pairing
