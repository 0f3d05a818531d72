#pragma once
// The exact answer of a point that is dragged with elastic-perfectly sliding friction: the sliding
// part follows like a stone on a string of the length mu N / eps_T (a tractrix).
#include <algorithm>
#include <cmath>

#include "osculate/core/types.hpp"

namespace osculate::verification {

/// The dragged end, the string (dragged end minus stone) and the way the stone has gone.
struct Slider {
  Vec2 at = Vec2::Zero();
  Vec2 lag = Vec2::Zero();
  double slid = 0;
};

/// One increment of the return mapping (backward Euler): the stone is pulled straight to the end.
inline void step_to(Slider& s, const Vec2& to, double rod) {
  s.lag += to - s.at;
  s.at = to;
  const double length = s.lag.norm();
  if (length <= rod) return;
  s.slid += length - rod;
  s.lag *= rod / length;
}

/// The exact motion while the end goes straight. With the angle alpha between string and motion,
/// d(alpha)/ds = -sin(alpha) / rod and d(slid)/ds = cos(alpha), so tan(alpha / 2) decays as
/// exp(-s / rod).
inline void pull_straight(Slider& s, const Vec2& to, double rod) {
  const Vec2 way = to - s.at;
  const double length = way.norm();
  const Vec2 ahead = way / length;
  const double along = s.lag.dot(ahead);
  const double within = rod * rod - s.lag.squaredNorm();  // zero but for rounding while it slides
  const double slack = std::max(0.0, std::sqrt(std::max(0.0, within) + along * along) - along);
  s.at = to;
  if (length <= slack) {
    s.lag += way;
    return;
  }
  s.lag += slack * ahead;
  const double x = (length - slack) / rod;
  const Vec2 across = s.lag - s.lag.dot(ahead) * ahead;
  const double sine = across.norm() / rod;
  const double before = sine / (1 + s.lag.dot(ahead) / rod), after = before * std::exp(-x);
  s.slid += rod * (x + std::log((1 + after * after) / (1 + before * before)));
  s.lag = rod * (1 - after * after) / (1 + after * after) * ahead;
  if (sine > 0) s.lag += rod * 2 * after / (1 + after * after) * across / (sine * rod);
}

/// The exact motion of an end that goes round the circle (r sin a, r (1 - cos a)) from rest at the
/// origin to the angle `to`: sticking until the chord is as long as the string, then
/// d(beta)/da = 1 - r sin(beta) / rod, beta from the string to the motion, by Runge-Kutta's method.
inline Slider around_circle(double r, double to, double rod) {
  const double begin = 2 * std::asin(0.5 * rod / r);
  constexpr int steps = 20000;
  const double h = (to - begin) / steps;
  double beta = 0.5 * begin, slid = 0;
  const auto turning = [&](double b) { return 1 - r * std::sin(b) / rod; };
  for (int i = 0; i < steps; ++i) {
    const double k1 = turning(beta), b2 = beta + 0.5 * h * k1, k2 = turning(b2);
    const double b3 = beta + 0.5 * h * k2, k3 = turning(b3), b4 = beta + h * k3;
    slid += r * h / 6 * (std::cos(beta) + 2 * std::cos(b2) + 2 * std::cos(b3) + std::cos(b4));
    beta += h / 6 * (k1 + 2 * k2 + 2 * k3 + turning(b4));
  }
  const double direction = to - beta;
  return {r * Vec2(std::sin(to), 1 - std::cos(to)),
          rod * Vec2(std::cos(direction), std::sin(direction)), slid};
}

}  // namespace osculate::verification
