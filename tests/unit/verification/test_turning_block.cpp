#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "derivative_check.hpp"
#include "turning_block/reference.hpp"
#include "turning_block/spring.hpp"

namespace osculate::verification {
namespace {

constexpr double flat = std::numbers::pi / 4, infinite = std::numeric_limits<double>::infinity();

TurningBlock block_of(double slid_over_edge, double mu) {
  TurningBlock b;
  b.edge = 0.4;
  b.mass = 3;
  b.gravity = 9.81;
  b.slid = slid_over_edge * b.edge;
  b.friction = mu;
  return b;
}

/// The largest demand -R_x - mu R_y of a turn without slip, over 1 + mu.
double demand(double slid_over_edge, double mu) {
  TurningBlock b = block_of(slid_over_edge, 1);
  b.mass = 1 / b.gravity;
  double worst = -infinite;
  for (int i = 0; i <= 200; ++i) {
    const Vec2 f = turning_reaction(b, flat * i / 200);
    const double excess = mu == infinite ? -f.y() : (-f.x() - mu * f.y()) / (1 + mu);
    worst = std::max(worst, excess);
  }
  return worst;
}

double threshold(double mu) {
  double low = 0, high = 1.7;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (demand(middle, mu) < 0 ? low : high) = middle;
  }
  return high;
}

double front_margin(const TurningBlock& b, const BlockState& s) {
  return s.corner.y() + b.edge * std::sqrt(0.5) * (std::cos(s.angle) - std::sin(s.angle));
}

TEST(TurningBlock, SlipsBeyondALengthThatDependsOnFriction) {
  const double mu[] = {0.25, 0.3, 0.5, 0.7, 1, 2, infinite};
  const double length[] = {0.28747, 0.30681, 0.37127, 0.42057, 0.47603, 0.58079, 0.79030};
  for (int i = 0; i < 7; ++i) {
    EXPECT_NEAR(longest_without_slip(mu[i]), length[i], 5e-6);
    EXPECT_NEAR(longest_without_slip(mu[i]), threshold(mu[i]), 1e-12);
    if (mu[i] < infinite) {
      EXPECT_NEAR(friction_without_slip(longest_without_slip(mu[i])), mu[i], 1e-12);
    }
  }
  EXPECT_NEAR(longest_without_slip(1), 4.0 / 9 * (5 * std::numbers::sqrt2 - 6), 1e-15);
  EXPECT_NEAR(friction_without_slip(0.3), 0.28195, 5e-6);
  EXPECT_EQ(friction_without_slip(0.1), 0.25) << "the impact needs as much";
  EXPECT_EQ(friction_without_slip(0.8), infinite);
}

TEST(TurningBlock, NeedsTheSlopeBehindItWhenItFallsSlowly) {
  // On the floor alone, from rest, it is the falling rod: N = m g (3 cos - 1)^2 / 4, and 0.3706 is
  // the largest ratio of the forces, near 35 degrees. The slope takes what friction does not hold.
  TurningBlock b = block_of(1e-12, 0.3);
  const double weight = b.mass * b.gravity;
  double most = 0;
  for (int i = 0; i <= 1000; ++i) {
    const double angle = flat * i / 1000, c = std::cos(angle);
    const Vec2 f = turning_reaction(b, angle);
    EXPECT_NEAR(f.y(), weight * (3 * c - 1) * (3 * c - 1) / 4, 1e-9 * weight);
    EXPECT_NEAR(f.x(), weight * std::sin(angle) * (9 * c - 6) / 4, 1e-9 * weight);
    most = std::max(most, f.x() / f.y());
  }
  EXPECT_NEAR(most, 0.37058, 5e-6);
}

TEST(TurningBlock, KeepsItsAngularMomentumAboutTheValleyLine) {
  const BlockMotion motion = follow(block_of(0.4, 0.5));
  const TurningBlock& b = motion.block;
  const BlockState& before = motion.stages[0].states.back();
  const BlockState& after = motion.stages[1].states.front();
  const double inertia = 2.0 / 3 * b.mass * b.edge * b.edge;
  const Vec2 arm = centre(b, before), v = centre_velocity(b, before);
  EXPECT_NEAR(arm.x(), 0, 1e-15) << "the centre is above the corner";
  EXPECT_NEAR(b.mass * (arm.y() * v.x() - arm.x() * v.y()), inertia * after.rate, 1e-13);
  EXPECT_NEAR(after.rate, 0.75 * impact_speed(b) / b.edge, 1e-13);
  EXPECT_NEAR(rate_after_impact(b), after.rate, 1e-13);
  const Vec2 change = b.mass * (centre_velocity(b, after) - v);
  EXPECT_NEAR((change - motion.impulses[0]).norm(), 0, 1e-13);
  EXPECT_NEAR(-change.x() / change.y(), 0.25, 1e-13);
}

TEST(TurningBlock, SlipsAtTheImpactWithLittleFriction) {
  for (const double mu : {0.1, 0.2, 0.2499}) {
    const BlockMotion motion = follow(block_of(0.4, mu));
    const TurningBlock& b = motion.block;
    const BlockState& after = motion.stages[1].states.front();
    EXPECT_NEAR(after.rate, 3 * mu * impact_speed(b) / b.edge, 1e-12);
    EXPECT_NEAR(after.velocity.x(), impact_speed(b) * std::sqrt(0.5) * (1 - 4 * mu), 1e-12);
    EXPECT_NEAR(motion.impulses[0].x(), -mu * motion.impulses[0].y(), 1e-12);
    EXPECT_EQ(motion.stages[1].phase, BlockPhase::slipping);
  }
}

TEST(TurningBlock, FollowsTheClosedFormsWhileItSticks) {
  const BlockMotion motion = follow(block_of(0.3, 0.3));
  const TurningBlock& b = motion.block;
  ASSERT_EQ(motion.stages.size(), 2u);
  ASSERT_EQ(motion.end, BlockEnd::second_contact);
  const BlockState end = motion.stages.back().states.back();
  EXPECT_NEAR(end.angle, flat, 1e-13);
  EXPECT_NEAR(end.time, impact_time(b) + turning_time(b, flat), 1e-11 * end.time);
  EXPECT_NEAR(end.rate, turning_rate(b, flat), 1e-11 * end.rate);
  for (const double part : {0.2, 0.5, 0.9}) {
    const double angle = part * flat, time = impact_time(b) + turning_time(b, angle);
    const BlockState s = state_at(motion, time);
    EXPECT_NEAR(s.angle, angle, 1e-11);
    EXPECT_NEAR(s.rate, turning_rate(b, angle), 1e-11 * s.rate);
    EXPECT_NEAR((reaction_at(motion, time) - turning_reaction(b, angle)).norm(), 0, 1e-9);
  }
}

TEST(TurningBlock, HasTimesOfTheOrderOfTheRule) {
  const TurningBlock b = block_of(0.25, 0.4);
  const double exact = impact_time(b) + turning_time(b, flat);
  const auto error = [&](double step) {
    return std::abs(follow(b, step).stages.back().states.back().time - exact);
  };
  EXPECT_NEAR(std::log2(error(0.1) / error(0.05)), 4, 0.3);
}

TEST(TurningBlock, ObeysNewtonsLawInEveryPhase) {
  int phases = 0;
  for (const auto& [length, mu] :
       {std::pair{0.3, 0.3}, {0.9, 0.4}, {0.5, 0.2}, {0.2, 0.1}, {1.9, 0.3}}) {
    const BlockMotion motion = follow(block_of(length, mu));
    const TurningBlock& b = motion.block;
    for (const BlockStage& stage : motion.stages) {
      const double begin = stage.states.front().time, span = stage.states.back().time - begin;
      if (span < 0.02) continue;
      const double time = begin + 0.6 * span;
      phases |= 1 << (static_cast<int>(stage.phase) + (stage.direction < 0 ? 4 : 0));
      const Vec2 f = reaction_at(motion, time);
      const BlockState now = state_at(motion, time);
      const Vec2 arm = now.corner - centre(b, now);
      const double moment = arm.y() * f.x() - arm.x() * f.y();  // clockwise
      Eigen::VectorXd rates(3);
      rates << f.x() / b.mass, f.y() / b.mass - b.gravity, 6 * moment / (b.mass * b.edge * b.edge);
      if (stage.phase == BlockPhase::sliding) rates[2] = 0;  // the slope pushes under the centre
      const auto speeds = [&](const Eigen::VectorXd& t) {
        const BlockState s = state_at(motion, t[0]);
        Eigen::VectorXd out(3);
        out << centre_velocity(b, s), s.rate;
        return out;
      };
      const Eigen::VectorXd at = Eigen::VectorXd::Constant(1, time);
      const auto report = testing::check_derivative(
          speeds, rates, at, Eigen::VectorXd(Eigen::VectorXd::Ones(1)), 0.2 * span);
      EXPECT_TRUE(report.exact || std::abs(report.order - 2) < 0.2)
          << length << " " << mu << " phase " << static_cast<int>(stage.phase) << " error "
          << report.error << " order " << report.order;
    }
  }
  EXPECT_EQ(phases, 0b1001111) << "all phases, and slipping to both sides";
}

TEST(TurningBlock, ExchangesMomentumByCoulombsLawWhileItSlips) {
  for (const double mu : {0.1, 0.3, 1.0}) {
    const BlockMotion motion = follow(block_of(0.9, mu));
    const TurningBlock& b = motion.block;
    const BlockStage& stage = motion.stages.back();
    ASSERT_EQ(stage.phase, BlockPhase::slipping);
    const BlockState &s0 = stage.states.front(), &s1 = stage.states.back();
    const Vec2 change = centre_velocity(b, s1) - centre_velocity(b, s0);
    const double from_floor = change.y() + b.gravity * (s1.time - s0.time);
    EXPECT_NEAR(change.x(), -stage.direction * mu * from_floor, 1e-11);
    double lost = 0;  // Simpson's rule over the friction power
    const int parts = 400;
    for (int i = 0; i <= parts; ++i) {
      const double t = s0.time + (s1.time - s0.time) * i / parts * (1 - 1e-15);
      const double weight = i == 0 || i == parts ? 1 : (i % 2 == 0 ? 2 : 4);
      lost -= weight * reaction_at(motion, t).x() * state_at(motion, t).velocity.x();
    }
    lost *= (s1.time - s0.time) / (3 * parts);
    const double energy0 = kinetic_energy(b, s0) + potential_energy(b, s0);
    EXPECT_NEAR(kinetic_energy(b, s1) + potential_energy(b, s1), energy0 - lost, 1e-9 * energy0);
  }
}

TEST(TurningBlock, DoesWhatItsKindSays) {
  for (const double mu : {0.1, 0.2, 0.249, 0.251, 0.3, 0.5, 1.0, 3.0})
    for (int i = 1; i < 40; ++i) {
      const double length = 0.05 * i + 1e-3;
      const BlockMotion motion = follow(block_of(length, mu), 1e-2);
      const TurningKind kind = turning_kind(length, mu);
      const BlockPhase first = motion.stages[1].phase;
      const BlockPhase last = motion.stages.back().phase;
      const auto at = [&] { return ::testing::Message() << length << " " << mu; };
      EXPECT_EQ(kind == TurningKind::jumps, first == BlockPhase::flying) << at();
      EXPECT_EQ(kind == TurningKind::slips_at_impact,
                first == BlockPhase::slipping && motion.stages[1].states[0].angle == 0)
          << at();
      EXPECT_EQ(kind == TurningKind::turns,
                motion.stages.size() == 2 && first == BlockPhase::sticking)
          << at();
      EXPECT_EQ(kind == TurningKind::slips,
                first == BlockPhase::sticking && last == BlockPhase::slipping)
          << at();
      for (std::size_t k = 2; k < motion.stages.size(); ++k) {
        EXPECT_NE(motion.stages[k].phase, BlockPhase::flying)
            << "it leaves the floor late: " << at();
      }
    }
}

TEST(TurningBlock, SticksUntilFrictionIsUsedUp) {
  const BlockMotion motion = follow(block_of(0.5, 0.3));
  const BlockState slip = motion.stages[2].states.front();
  const Vec2 f = turning_reaction(motion.block, slip.angle);
  EXPECT_NEAR(-f.x() / f.y(), 0.3, 1e-10);
  EXPECT_EQ(motion.stages[2].direction, 1) << "away from the slope";
}

TEST(TurningBlock, FliesFreelyAfterAJump) {
  const TurningBlock b = block_of(1.02 * shortest_jump(0.4), 0.4);
  const BlockMotion motion = follow(b);
  ASSERT_EQ(motion.stages[1].phase, BlockPhase::flying);
  const BlockState &s0 = motion.stages[1].states.front(), &s1 = motion.stages[1].states.back();
  const double t = s1.time - s0.time;
  EXPECT_GT(t, 0);
  EXPECT_NEAR(s1.rate, s0.rate, 1e-12);
  const Vec2 path = centre(b, s0) + t * centre_velocity(b, s0) - Vec2(0, 0.5 * b.gravity * t * t);
  EXPECT_NEAR((centre(b, s1) - path).norm(), 0, 1e-12);
  EXPECT_EQ(shortest_jump(0.4), 16.0 / 9);
  EXPECT_NEAR(shortest_jump(0.2), 1 / 0.36, 1e-14);
}

TEST(TurningBlock, EndsWithACornerOnTheFloor) {
  for (const double mu : {0.3, 1.0})
    for (const double length : {0.1, 0.6, 1.5, 2.0, 4.0}) {
      const BlockMotion motion = follow(block_of(length, mu));
      ASSERT_EQ(motion.end, BlockEnd::second_contact);
      EXPECT_NEAR(front_margin(motion.block, motion.stages.back().states.back()), 0, 1e-12);
    }
  const BlockMotion balanced = follow(block_of(0.5, 0), 0.05);
  EXPECT_EQ(balanced.end, BlockEnd::still_upright) << "no friction, no torque";
  EXPECT_EQ(balanced.stages.back().states.back().angle, 0);
  EXPECT_EQ(follow(block_of(0.05, 0.1)).end, BlockEnd::at_the_slope);
}

TEST(TurningBlock, FeelsFrictionOfTheSlopeAsAShorterWay) {
  TurningBlock rough = block_of(0.5, 0.4), smooth = block_of(0.4, 0.4);
  rough.slope_friction = 0.2;
  EXPECT_NEAR(impact_speed(rough), impact_speed(smooth), 1e-14);
  EXPECT_NEAR(impact_time(rough) / rough.slid, impact_time(smooth) / smooth.slid, 1e-14);
  const Vec2 push = reaction_at(follow(rough), 0.5 * impact_time(rough));
  const Vec2 normal = Vec2(1, 1) / std::numbers::sqrt2, up = Vec2(-1, 1) / std::numbers::sqrt2;
  EXPECT_NEAR(push.dot(up), 0.2 * push.dot(normal), 1e-12);
  EXPECT_NEAR(push.dot(normal), rough.mass * rough.gravity / std::numbers::sqrt2, 1e-12);
}

TEST(TurningBlock, RocksOrSlidesAfterTheSecondImpact) {
  const TurningBlock b = block_of(0.3, 1);
  const BlockState end = follow(b).stages.back().states.back();
  const auto rate = [&](double mu) {
    TurningBlock other = b;
    other.friction = mu;
    return second_impact(other, end).rate / end.rate;
  };
  EXPECT_NEAR(rate(1), 0.25, 1e-11) << "Housner's 1 - 3/2 sin^2(45 deg)";
  EXPECT_NEAR(rate(0.6), 0.25, 1e-11);
  for (const double mu : {0.35, 0.45, 0.59})
    EXPECT_NEAR(rate(mu), (3 * mu - 1) / (5 - 3 * mu), 1e-11);
  EXPECT_EQ(rate(0.3), 0) << "the face lies on the floor";
  TurningBlock slippery = b;
  slippery.friction = 0.2;
  EXPECT_NEAR(second_impact(slippery, end).velocity.x(), 0.5 * b.edge * end.rate * 0.8, 1e-11);
}

// exp(z t) with m z^2 + c z + k = 0
TEST(CornerSpring, PeriodAndDecayAreThoseOfTheRoots) {
  const double m = 1.3, k = 470;
  for (const double c : {0.0, 0.7, 21.0}) {
    const std::complex<double> root =
        (-c + std::sqrt(std::complex<double>(c * c - 4 * k * m))) / (2 * m);
    for (const double t : {0.1, 1.7}) {
      EXPECT_NEAR(damped_share(m, c, t), std::abs(std::exp(root * t)), 1e-14);
    }
    if (c > 0) continue;
    EXPECT_NEAR(spring_period(m, k) * root.imag(), 2 * std::numbers::pi, 1e-14);
  }
}

// Two motions with different starts: what they span shrinks by the square of the amplitude.
TEST(CornerSpring, ImplicitStepsShrinkWhatTwoMotionsSpan) {
  const double m = 1.3, k = 470;
  for (const double theta : {0.5, 1.0})
    for (const double h : {0.002, 0.05}) {
      Vec2 place(1, 0.3), speed(-2, 5);  // of both motions
      const double before = place.x() * speed.y() - place.y() * speed.x();
      constexpr int steps = 7;
      for (int i = 0; i < steps; ++i) {
        const Vec2 next = (place + h * speed) / (1 + theta * h * h * k / m);
        speed -= h * k / m * next;
        place = next;
      }
      const double after = place.x() * speed.y() - place.y() * speed.x();
      EXPECT_NEAR(after / before / std::pow(implicit_share(m, k, h, theta), 2 * steps), 1, 1e-11);
    }
}

}  // namespace
}  // namespace osculate::verification
