#include <gtest/gtest.h>

#include <cmath>

#include "bar_impact/reference.hpp"
#include "bouncing_ball/reference.hpp"
#include "derivative_check.hpp"

namespace osculate::verification {
namespace {

Eigen::VectorXd one(double x) { return Eigen::VectorXd::Constant(1, x); }

/// Order of the error of central differences of f against df at t.
template <class F>
::testing::AssertionResult differentiates(F&& f, double df, double t, double h) {
  const auto report = testing::check_derivative(
      [&](const Eigen::VectorXd& x) { return one(f(x[0])); }, one(df), one(t), one(1), h);
  if (report.exact || std::abs(report.order - 2) < 0.1) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "error " << report.error << " order " << report.order;
}

TEST(RigidBall, BouncesAtTheTimesOfItsPieces) {
  const RigidBall ball{1.5, 9.81, 0.8};
  double time = std::sqrt(2 * 1.5 / 9.81), speed = std::sqrt(2 * 9.81 * 1.5);
  for (int n = 1; n <= 20; ++n) {
    EXPECT_NEAR(bounce_time(ball, n), time, 1e-12);
    speed *= 0.8;
    EXPECT_NEAR(bounce_speed(ball, n), speed, 1e-12);
    const double top = time + speed / 9.81;
    EXPECT_NEAR(ball_at(ball, top).height, bounce_height(ball, n), 1e-12);
    EXPECT_NEAR(ball_at(ball, top).velocity, 0, 1e-12);
    EXPECT_NEAR(ball_at(ball, time + 1e-9).height, 0, 1e-7);
    time += 2 * speed / 9.81;
  }
  EXPECT_NEAR(rest_time(ball), bounce_time(ball, 400), 1e-12);
  EXPECT_EQ(ball_at(ball, 1.01 * rest_time(ball)).height, 0);
}

TEST(RigidBall, KeepsItsHeightWithoutLosses) {
  const RigidBall ball{2, 10, 1};
  EXPECT_NEAR(bounce_time(ball, 20), 39 * std::sqrt(0.4), 1e-12);
  EXPECT_NEAR(ball_at(ball, 40 * std::sqrt(0.4)).height, 2, 1e-12);
}

TEST(SpringBall, ObeysNewtonsLawInFlightAndInContact) {
  const SpringBall ball{0.5, 9.81, 2, 300};
  const double fall = std::sqrt(2 * 0.5 / 9.81), contact = contact_duration(ball);
  for (const double t : {0.5 * fall, fall + 0.3 * contact, fall + 0.8 * contact,
                         fall + contact + 0.2, 7 * bounce_period(ball) + fall + 0.4 * contact}) {
    const double force = spring_force(ball, t) / ball.mass - ball.gravity;
    EXPECT_TRUE(differentiates([&](double x) { return ball_at(ball, x).height; },
                               ball_at(ball, t).velocity, t, 0.02));
    EXPECT_TRUE(
        differentiates([&](double x) { return ball_at(ball, x).velocity; }, force, t, 0.02));
  }
}

TEST(SpringBall, KeepsItsEnergyOverTwentyBounces) {
  const SpringBall ball{0.5, 9.81, 2, 300};
  const double whole = 2 * 9.81 * 0.5;
  for (int i = 0; i <= 997; ++i) {
    const BallState s = ball_at(ball, 20 * bounce_period(ball) * i / 997);
    const double depth = std::max(0.0, -s.height);
    EXPECT_NEAR(s.velocity * s.velocity + 2 * 9.81 * s.height + 150 * depth * depth, whole, 1e-10);
  }
}

TEST(SpringBall, IsContinuousAndAsDeepAsSaid) {
  const SpringBall ball{0.5, 9.81, 2, 300};
  const double fall = std::sqrt(2 * 0.5 / 9.81), contact = contact_duration(ball);
  for (const double t : {fall, fall + contact, bounce_period(ball)}) {
    EXPECT_NEAR(ball_at(ball, t - 1e-10).height, ball_at(ball, t + 1e-10).height, 1e-8);
    EXPECT_NEAR(ball_at(ball, t - 1e-10).velocity, ball_at(ball, t + 1e-10).velocity, 1e-8);
  }
  EXPECT_NEAR(ball_at(ball, fall + 0.5 * contact).height, -deepest(ball), 1e-13);
  SpringBall stiff = ball;
  stiff.stiffness = 1e14;
  EXPECT_NEAR(contact_duration(stiff) * std::sqrt(0.5e14), std::numbers::pi, 1e-6);
}

const ImpactBar bar{2, 0.5, 8, 0.5, 0.3, 0.06};  // c = 4, touch 0.2, contact 1

TEST(ImpactBar, TurnsItsVelocityInTheTimeOfAWave) {
  EXPECT_DOUBLE_EQ(contact_duration(bar), 1);
  EXPECT_DOUBLE_EQ(contact_force(bar, 0.7), 0.5 * 0.5 * 4 * 0.3);
  EXPECT_EQ(contact_force(bar, 0.19), 0);
  EXPECT_EQ(contact_force(bar, 1.21), 0);
  EXPECT_NEAR(contact_impulse(bar), contact_force(bar, 0.7) * contact_duration(bar), 1e-15);
  for (const double x : {0.0, 0.7, 2.0}) {
    EXPECT_EQ(bar_velocity(bar, x, 0.1), 0.3);
    EXPECT_EQ(bar_velocity(bar, x, 1.3), -0.3);
    EXPECT_EQ(bar_stress(bar, x, 1.3), 0);
    EXPECT_NEAR(bar_displacement(bar, x, 1.4), 0, 1e-15) << "back where it was let go";
  }
}

TEST(ImpactBar, ConsistsOfThreeFieldsThatFit) {
  for (const double x : {0.3, 1.1, 1.9})
    for (const double time : {0.1, 0.3, 0.55, 0.8, 1.13, 1.3}) {
      const double h = 1e-6;  // the fields are linear between the waves
      const double speed =
          (bar_displacement(bar, x, time + h) - bar_displacement(bar, x, time - h)) / (2 * h);
      const double strain =
          -(bar_displacement(bar, x + h, time) - bar_displacement(bar, x - h, time)) / (2 * h);
      EXPECT_NEAR(speed, bar_velocity(bar, x, time), 1e-9);
      EXPECT_NEAR(8 * strain, bar_stress(bar, x, time), 1e-8);
    }
  EXPECT_NEAR(bar_displacement(bar, 0, 0.9), bar.gap, 1e-15) << "the end stays on the wall";
}

TEST(ImpactBar, KeepsItsEnergyAndTradesItsMomentum) {
  constexpr int sections = 4000;
  for (const double time : {0.25, 0.55, 0.7, 0.9, 1.15}) {
    double kinetic = 0, elastic = 0, momentum = 0;
    for (int i = 0; i < sections; ++i) {
      const double x = 2 * (i + 0.5) / sections, volume = 0.5 * 2.0 / sections;
      const double v = bar_velocity(bar, x, time), s = bar_stress(bar, x, time);
      kinetic += 0.25 * v * v * volume;
      elastic += 0.5 * s * s / 8 * volume;
      momentum += 0.5 * v * volume;
    }
    EXPECT_NEAR(kinetic, bar_kinetic_energy(bar, time), 1e-5);
    EXPECT_NEAR(elastic, bar_elastic_energy(bar, time), 1e-5);
    EXPECT_NEAR(momentum, 0.5 * 0.5 * 2 * 0.3 - contact_force(bar, time) * (time - 0.2), 1e-4);
  }
}

}  // namespace
}  // namespace osculate::verification
