// The schemes against their published properties, on one mass and one spring.
#include "osculate/solve/time_scheme.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <vector>

namespace osculate::solve {
namespace {

/// d, h v, h^2 a of a mass 1 on a spring w^2.
using Oscillator = Eigen::Vector3d;

/// One step by the factors, as a system takes it.
Oscillator step(const TimeScheme& s, double w, double h, const Oscillator& at) {
  const StepFactors f = step_factors(s, h);
  const double k = w * w, d = at[0], v = at[1] / h, a = at[2] / (h * h);
  const double ahead = d + h * v + h * h * (0.5 - s.beta) * a;
  const double rest = -f.mass * ahead + f.past_mass * a + f.past_force * k * d;
  const double next = -rest / (f.mass + f.force * k);
  const double acceleration = (next - ahead) / (s.beta * h * h);
  return {next, h * (v + h * ((1 - s.gamma) * a + s.gamma * acceleration)), h * h * acceleration};
}

Eigen::Matrix3d amplification(const TimeScheme& s, double wh) {
  Eigen::Matrix3d m;
  for (int i = 0; i < 3; ++i) m.col(i) = step(s, wh, 1.0, Oscillator::Unit(i));
  return m;
}

/// Sharp to the square or cube root of rounding where roots are multiple.
double radius(const TimeScheme& s, double wh) {
  return amplification(s, wh).eigenvalues().cwiseAbs().maxCoeff();
}

TimeScheme with(TimeScheme s, Impact impact) {
  s.impact = impact;
  return s;
}

TEST(TimeScheme, RadiusAtInfiniteFrequencyIsThePublishedOne) {
  for (const Impact impact : {Impact::average, Impact::dissipative, Impact::plastic}) {
    for (const double r : {0.0, 0.3, 0.8, 1.0})
      EXPECT_NEAR(radius(with(generalized_alpha(r), impact), 1e5), r, 1e-3) << r;
    EXPECT_NEAR(radius(with(newmark(), impact), 1e5), 1, 1e-9);
    // (1 - alpha) / (1 + alpha), the double root of its cubic
    EXPECT_NEAR(radius(with(hht(0.1), impact), 1e5), 0.9 / 1.1, 1e-3);
  }
}

TEST(TimeScheme, NeverGrows) {
  for (double wh = 1e-3; wh < 1e4; wh *= 1.7) {
    EXPECT_LT(radius(newmark(), wh), 1 + 1e-12);
    for (const double alpha : {0.05, 0.2, 1.0 / 3}) EXPECT_LT(radius(hht(alpha), wh), 1 + 1e-7);
    for (const double r : {0.0, 0.5, 0.9, 1.0})
      EXPECT_LT(radius(generalized_alpha(r), wh), 1 + 1e-7);
  }
}

double error_at(const TimeScheme& s, int steps) {
  const double w = 1.3, end = 5, h = end / steps;
  Oscillator at(1, 0.4 * h, -w * w * h * h);
  for (int i = 0; i < steps; ++i) at = step(s, w, h, at);
  return std::abs(at[0] - (std::cos(w * end) + 0.4 / w * std::sin(w * end)));
}

TEST(TimeScheme, IsOfSecondOrder) {
  for (const TimeScheme& s : {newmark(), hht(0.1), generalized_alpha(0.6), generalized_alpha(0)})
    EXPECT_NEAR(std::log2(error_at(s, 1600) / error_at(s, 3200)), 2, 0.05);
}

TEST(TimeScheme, NewmarkKeepsTheEnergy) {
  const double w = 40, h = 0.1;
  Oscillator at(1, 0, -w * w * h * h);
  for (int i = 0; i < 1000; ++i) at = step(newmark(), w, h, at);
  const double v = at[1] / h;
  EXPECT_NEAR(0.5 * v * v + 0.5 * w * w * at[0] * at[0], 0.5 * w * w, 1e-9 * w * w);
}

// A mass that flies against a stiff stop: the contact is implicit, its force is `stiffness` times
// the penetration at the end of the step.
struct Flight {
  double d = 0, v = 0, a = 0;
};
Flight fly(const TimeScheme& s, double h, double stiffness, const Flight& at) {
  const StepFactors f = step_factors(s, h);
  const double ahead = at.d + h * at.v + h * h * (0.5 - s.beta) * at.a;
  const double free = ahead - f.past_mass * at.a / f.mass;
  const double next = free < 0 ? free * f.mass / (f.mass + stiffness) : free;
  const double impulse = next < 0 ? -stiffness * next : 0.0;
  const double a = (next - ahead - impulse_way(s.impact) * h * h * impulse) / (s.beta * h * h);
  return {next, at.v + h * ((1 - s.gamma) * at.a + s.gamma * a + impulse), a};
}

TEST(TimeScheme, ADissipativeImpactNeverGainsEnergy) {
  for (const TimeScheme& s : {newmark(), hht(0.1), generalized_alpha(0.5)})
    for (const double stiffness : {1.0, 1e3, 1e6, 1e12})
      for (int shift = 0; shift < 10; ++shift) {
        Flight at{0.1 * shift + 0.05, -1, 0};
        double before = 0.5;
        for (int i = 0; i < 12; ++i) {
          at = fly(s, 0.3, stiffness, at);
          const double energy = 0.5 * at.v * at.v + (at.d < 0 ? 0.5 * stiffness * at.d * at.d : 0);
          EXPECT_LE(energy, before * (1 + 1e-12));
          before = energy;
        }
      }
}

TEST(TimeScheme, APlasticImpactStays) {
  TimeScheme s = with(newmark(), Impact::plastic);
  Flight at{0.1, -1, 0};
  for (int i = 0; i < 3; ++i) at = fly(s, 0.3, 1e12, at);
  EXPECT_NEAR(at.v, 0, 1e-9);
  EXPECT_NEAR(at.d, 0, 1e-9);
}

}  // namespace
}  // namespace osculate::solve
