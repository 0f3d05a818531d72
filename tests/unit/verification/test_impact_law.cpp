// The closed forms of the case impact_law against the integrated equations of motion.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "impact_law/reference.hpp"

namespace osculate::verification {
namespace {

using State = std::array<double, 2>;  // penetration and its rate

/// One step of the classical Runge-Kutta method for x'' = a(x, v).
template <class Acceleration>
State stepped(const State& s, double h, const Acceleration& a) {
  const auto rate = [&](const State& y) { return State{y[1], a(y[0], y[1])}; };
  const auto moved = [](const State& y, double by, const State& r) {
    return State{y[0] + by * r[0], y[1] + by * r[1]};
  };
  const State k1 = rate(s), k2 = rate(moved(s, h / 2, k1)), k3 = rate(moved(s, h / 2, k2)),
              k4 = rate(moved(s, h, k3));
  State out = s;
  for (std::size_t i = 0; i < 2; ++i) out[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
  return out;
}

/// The state where `event` first falls below zero: the last step is cut by bisection.
template <class Acceleration, class Event>
State until(State s, double h, const Acceleration& a, const Event& event) {
  State next = stepped(s, h, a);
  while (event(next) > 0) {
    s = next;
    next = stepped(s, h, a);
  }
  double low = 0, high = h;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (event(stepped(s, middle, a)) > 0 ? low : high) = middle;
  }
  return stepped(s, 0.5 * (low + high), a);
}

TEST(ImpactLaw, ReboundOfSpringAndDamperIsThatOfTheEquationOfMotion) {
  for (const double z : {0.05, 0.3, 0.6, 0.9}) {
    const auto a = [&](double x, double v) { return -x - 2 * z * v; };
    const State end = until({0, 1}, 1e-3, a, [&](const State& s) { return s[0] + 2 * z * s[1]; });
    EXPECT_NEAR(-end[1], rebound(z), 1e-8) << z;
  }
}

TEST(ImpactLaw, NextHeightIsThatOfTheEquationOfMotion) {
  constexpr double gravity = 9.81;
  for (const double e : {0.3, 0.8, 1.0}) {
    const PlasticSpring s{2, 5e4, e};
    const double p2 = s.stiffness / s.mass, height = 0.05;
    const auto load = [&](double x, double) { return gravity - p2 * x; };
    const State deep = until({0, std::sqrt(2 * gravity * height)}, 1e-6, load,
                             [](const State& y) { return y[1]; });
    const double free = deep[0] * (1 - e * e);
    const auto unload = [&](double x, double) { return gravity - p2 * (x - free) / (e * e); };
    const State out = until(deep, 1e-6, unload, [&](const State& y) { return y[0] - free; });
    EXPECT_NEAR(next_height(s, gravity, height), out[1] * out[1] / (2 * gravity) - out[0], 1e-8)
        << e;
  }
}

TEST(ImpactLaw, TwoBodiesKeepMomentumAndLoseWhatTheFormulaSays) {
  for (const double e : {0.0, 0.4, 1.0}) {
    const TwoSpeeds after = after_impact(2, -3, 5, 1, e);
    EXPECT_NEAR(2 * after.first + 5 * after.second, 2 * -3 + 5 * 1, 1e-14);
    EXPECT_NEAR(after.second - after.first, e * (-3 - 1), 1e-14);
    const double before = 0.5 * 2 * 9 + 0.5 * 5 * 1;
    const double left = 0.5 * 2 * after.first * after.first + 0.5 * 5 * after.second * after.second;
    EXPECT_NEAR(before - left, energy_lost(2, -3, 5, 1, e), 1e-13);
  }
}

TEST(ImpactLaw, SlantHitReversesTheSpeedOfThePointAndLosesEnergyOfItsNormal) {
  constexpr double mass = 2, inertia = 1.5, arm = 0.6, speed = 3;
  for (const double e : {0.0, 0.5, 1.0}) {
    const SlantHit hit = after_slant_hit(mass, inertia, arm, speed, e);
    EXPECT_NEAR(hit.speed + arm * hit.spin, e * speed, 1e-14);
    const double red = 1 / (1 / mass + arm * arm / inertia);
    const double left = 0.5 * mass * hit.speed * hit.speed + 0.5 * inertia * hit.spin * hit.spin;
    EXPECT_NEAR(0.5 * mass * speed * speed - left, 0.5 * (1 - e * e) * red * speed * speed, 1e-13);
  }
}

}  // namespace
}  // namespace osculate::verification
