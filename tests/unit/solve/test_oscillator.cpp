// Oscillators moved by forces of straight pieces: exact, whatever their damping.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "osculate/solve/oscillator.hpp"

namespace osculate::solve {
namespace {

OscillatorMotion after(Oscillator o, double h, OscillatorMotion q, double from, double to) {
  return moved(o, impulse_response(o, h), h, q, from, to);
}

void expect_near(OscillatorMotion a, OscillatorMotion b, double tolerance) {
  EXPECT_NEAR(a.place, b.place, tolerance * (std::abs(b.place) + 1e-3));
  EXPECT_NEAR(a.rate, b.rate, tolerance * (std::abs(b.rate) + 1e-3));
}

/// m u'' + c u' + k u = 1, from rest, swinging: 1/k (1 - exp(-d t) (cos w t + d / w sin w t)).
TEST(Oscillator, UnderAStepLoad) {
  const Oscillator o{1.5, 20};
  const double d = 0.75, w = std::sqrt(20 - d * d);
  for (const double t : {1e-3, 0.1, 1.0, 7.0}) {
    const double e = std::exp(-d * t);
    expect_near(
        after(o, t, {}, 1, 1),
        {(1 - e * (std::cos(w * t) + d / w * std::sin(w * t))) / 20, e * std::sin(w * t) / w},
        1e-12);
  }
}

/// Undamped under a ramp of slope 1: 1/k (t - sin w t / w).
TEST(Oscillator, UnderARamp) {
  for (const double t : {0.01, 1.0, 40.0})
    expect_near(after({0, 9}, t, {}, 0, t),
                {(t - std::sin(3 * t) / 3) / 9, (1 - std::cos(3 * t)) / 9}, 1e-11);
}

/// Critically damped, let go at 1: (1 + w t) exp(-w t).
TEST(Oscillator, CriticallyDamped) {
  for (const double t : {0.01, 0.5, 3.0})
    expect_near(after({4, 4}, t, {1, 0}, 0, 0),
                {(1 + 2 * t) * std::exp(-2 * t), -4 * t * std::exp(-2 * t)}, 1e-12);
}

/// Overdamped, roots -1 and -100, let go at 1; and far beyond what an exponential can be.
TEST(Oscillator, Overdamped) {
  for (const double t : {1e-3, 0.1, 2.0, 50.0}) {
    const double slow = std::exp(-t), fast = std::exp(-100 * t);
    expect_near(after({101, 100}, t, {1, 0}, 0, 0),
                {(100 * slow - fast) / 99, 100 * (fast - slow) / 99}, 1e-11);
  }
  expect_near(after({1e6, 1}, 1, {1, 0}, 0, 0), {std::exp(-1e-6 - 1e-18), -1e-6 * std::exp(-1e-6)},
              1e-11);
}

/// Without stiffness: 1/2 f t^2, and with damping f / c (t - (1 - exp(-c t)) / c).
TEST(Oscillator, WithoutStiffness) {
  expect_near(after({0, 0}, 3, {1, 2}, 4, 4), {1 + 6 + 18, 2 + 12}, 1e-13);
  expect_near(after({0, 0}, 3, {}, 0, 6), {9, 9}, 1e-13);
  for (const double c : {1e-9, 0.1, 5.0, 1e3}) {
    const double t = 3, e = -std::expm1(-c * t) / c;
    const double twice = c < 1e-6 ? t * t / 2 : (t - e) / c;
    expect_near(after({c, 0}, t, {}, 1, 1), {twice, e}, 1e-8);
  }
}

/// One that runs away: cosh.
TEST(Oscillator, Unstable) {
  expect_near(after({0, -4}, 3, {1, 0}, 0, 0), {std::cosh(6), 2 * std::sinh(6)}, 1e-12);
}

/// A force of one straight piece may be cut anywhere: in every kind of damping, and across the
/// borders between the formulas.
TEST(Oscillator, PiecesMakeTheWhole) {
  for (const double k : {-3.0, 0.0, 1e-8, 0.3, 0.9, 4.0, 4.4, 900.0})
    for (const double c : {0.0, 1e-6, 0.1, 2.0, 4.0, 4.2, 60.0, 3000.0})
      for (const double share : {1e-3, 0.3, 0.5}) {
        SCOPED_TRACE(testing::Message() << "k " << k << " c " << c << " share " << share);
        const Oscillator o{c, k};
        const double h = 0.9, from = 2, to = -1, between = from + share * (to - from);
        const OscillatorMotion whole = after(o, h, {0.4, -0.7}, from, to);
        const OscillatorMotion first = after(o, share * h, {0.4, -0.7}, from, between);
        expect_near(after(o, (1 - share) * h, first, between, to), whole, 2e-11);
      }
}

/// A force that is bent is followed with the square of the pieces: f = sin 3 t, u'' + 2 u' + 5 u.
TEST(Oscillator, OrderOfABentForce) {
  const auto at_one = [](int pieces) {
    OscillatorMotion q;
    for (int i = 0; i < pieces; ++i) {
      const double h = 1.0 / pieces, t = i * h;
      q = after({2, 5}, h, q, std::sin(3 * t), std::sin(3 * (t + h)));
    }
    return q.place;
  };
  const double a = at_one(20), b = at_one(40), c = at_one(80);
  EXPECT_NEAR(std::log2((a - b) / (b - c)), 2, 0.02);
}

}  // namespace
}  // namespace osculate::solve
