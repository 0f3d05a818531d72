#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "rolling_cylinder/reference.hpp"
#include "spinning_disc/reference.hpp"
#include "stopped_block/reference.hpp"

namespace osculate::verification {
namespace {

TEST(FlatDisc, HasTheTorqueOfItsRings) {
  for (const double hole : {0.0, 0.4}) {
    const FlatDisc disc{1.3, hole, 2, 5, 0.3, 4};
    const double pressure = 5 / (std::numbers::pi * (1.3 * 1.3 - hole * hole));
    double torque = 0;
    constexpr int rings = 20000;
    for (int i = 0; i < rings; ++i) {
      const double width = (1.3 - hole) / rings, rho = hole + (i + 0.5) * width;
      torque += 0.3 * pressure * rho * 2 * std::numbers::pi * rho * width;
    }
    EXPECT_NEAR(friction_torque(disc), torque, 1e-8 * torque);
    EXPECT_NEAR(dissipated(disc, 2 * stop_time(disc)), 0.5 * inertia(disc) * 16, 1e-13);
    EXPECT_NEAR(spin_at(disc, 0.5 * stop_time(disc)).rate, 2, 1e-14);
    EXPECT_NEAR(spin_at(disc, 0.5 * stop_time(disc)).angle, 1.5 * stop_time(disc), 1e-14);
  }
  const FlatDisc disc{1.3, 0, 2, 5, 0.3, 4};
  EXPECT_NEAR(friction_torque(disc), 2.0 / 3 * 0.3 * 5 * 1.3, 1e-14);
  EXPECT_NEAR(stop_time(disc), 3 * 2 * 1.3 * 4 / (4 * 0.3 * 5), 1e-13);
}

TEST(Wheel, RollsAtAThirdOfItsSpin) {
  const Wheel disc{0.4, 2, 0.5, 9.81, 0.3, 0, 12};
  EXPECT_NEAR(rolling_time(disc), 12 * 0.4 / (3 * 0.3 * 9.81), 1e-14);
  const WheelState s = wheel_at(disc, rolling_time(disc));
  EXPECT_NEAR(s.rate, 4, 1e-13);
  EXPECT_NEAR(s.speed, 1.6, 1e-13);
  const double before = kinetic_energy(disc, wheel_at(disc, 0));
  EXPECT_NEAR(dissipated(disc), 2.0 / 3 * before, 1e-13 * before);
  const WheelState later = wheel_at(disc, rolling_time(disc) + 1);
  EXPECT_NEAR(later.x - s.x, 1.6, 1e-13);
  EXPECT_NEAR(later.speed, later.rate * 0.4, 1e-13);
}

TEST(Wheel, KeepsTheMomentumAboutTheLineAndLosesWhatSlidingTakes) {
  for (const double speed : {-3.0, 0.5, 7.0})
    for (const double shape : {0.4, 0.5, 1.0}) {
      const Wheel wheel{0.4, 2, shape, 9.81, 0.3, speed, 9};
      const double end = rolling_time(wheel);
      const WheelState s0 = wheel_at(wheel, 0), s1 = wheel_at(wheel, end);
      EXPECT_NEAR(s1.speed, s1.rate * 0.4, 1e-12);
      EXPECT_NEAR(s1.speed + shape * 0.4 * s1.rate, s0.speed + shape * 0.4 * s0.rate, 1e-12);
      const double slid = s1.x - 0.4 * s1.angle;  // the sliding does not change its sense
      EXPECT_NEAR(dissipated(wheel), 0.3 * 2 * 9.81 * std::abs(slid), 1e-11);
      EXPECT_NEAR(kinetic_energy(wheel, s0) - kinetic_energy(wheel, s1), dissipated(wheel), 1e-11);
    }
}

TEST(InclineRoller, RollsUntilTheSlopeIsThreeTimesTheFriction) {
  InclineRoller r{0.2, 3, 0.5, 9.81, std::atan(0.9), 0.3};
  EXPECT_NEAR(friction_to_roll(r), 0.3, 1e-15);
  r.friction = 0.3 * (1 + 1e-12);
  EXPECT_TRUE(rolls(r));
  EXPECT_NEAR(acceleration(r), 2.0 / 3 * 9.81 * std::sin(r.slope), 1e-13);
  EXPECT_NEAR(dissipated(r, 2), 0, 1e-10);
  r.friction = 0.3 * (1 - 1e-12);
  EXPECT_FALSE(rolls(r));
  EXPECT_NEAR(acceleration(r), 2.0 / 3 * 9.81 * std::sin(r.slope), 1e-10) << "continuous";
}

TEST(InclineRoller, BalancesItsEnergy) {
  for (const double mu : {0.05, 0.2, 0.6})
    for (const double shape : {0.4, 0.5, 1.0}) {
      const InclineRoller r{0.2, 3, shape, 9.81, 0.7, mu};
      const RollerState s = roller_at(r, 1.7);
      const double fall = 3 * 9.81 * s.way * std::sin(0.7);
      EXPECT_NEAR(kinetic_energy(r, s) + dissipated(r, 1.7), fall, 1e-11 * fall);
      EXPECT_LE(friction_force(r), mu * normal_force(r) * (1 + 1e-15));
      EXPECT_GE(s.speed, s.rate * 0.2 - 1e-12) << "never spins faster than it rolls";
      if (rolls(r)) {
        EXPECT_NEAR(s.speed, s.rate * 0.2, 1e-12);
      }
    }
}

TEST(StoppedBlock, StopsWhenItsEnergyIsUsedUp) {
  const StoppedBlock b{2, 3, 0.25, 10};
  EXPECT_DOUBLE_EQ(stop_time(b), 1.2);
  EXPECT_DOUBLE_EQ(stop_distance(b), 1.8);
  EXPECT_DOUBLE_EQ(slide_at(b, 5).way, 1.8);
  EXPECT_NEAR(slide_at(b, 5).speed, 0, 1e-15);
  EXPECT_DOUBLE_EQ(dissipated(b, 5), 9);
  EXPECT_DOUBLE_EQ(friction_force(b, 0.5), 5);
  EXPECT_EQ(friction_force(b, 1.3), 0);
  for (const double t : {0.1, 0.7, 1.1}) {
    const double v = slide_at(b, t).speed;
    EXPECT_NEAR(v * v + dissipated(b, t), 9, 1e-13);
  }
}

}  // namespace
}  // namespace osculate::verification
