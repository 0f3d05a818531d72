// Rate-and-state friction: the implicit equation, its derivatives, and the state over increments.
#include <gtest/gtest.h>

#include <cmath>

#include "derivative_check.hpp"
#include "osculate/contact/law/catalogue.hpp"

namespace osculate::contact {
namespace {

const RateAndState law{
    .mu = 0.6, .a = 0.01, .b = 0.015, .stiffness = 1e5, .speed = 0.1, .distance = 0.005};

/// mu(V, theta) as it stands in the source.
double coefficient(double speed, double state) {
  const double log_state = std::log(law.speed * state / law.distance);
  return law.a *
         std::asinh(speed / (2 * law.speed) * std::exp((law.mu + law.b * log_state) / law.a));
}

// What slides in the increment belongs to the traction, whatever the trial, and the state to both.
TEST(RateAndState, LimitBelongsToSpeedAndStateAtTheEnd) {
  constexpr double h = 0.01, pressure = 10;
  for (const double state : {0.001, 0.05, 7.0})
    for (const double trial : {6.2, 8.0, 30.0, 500.0}) {
      const Sliding sliding{0.3, h, {state}};
      const TangentialResponse<2> r = law.response<2>(Vec<1>(-trial), -pressure, sliding);
      ASSERT_EQ(r.status, Status::slip);
      const double slip = slid<2>(Vec<1>(-trial), r, law.stiffness);
      const double after = remembered(law, slip, sliding)[0];
      EXPECT_NEAR(after, (state + h) / (1 + slip / law.distance), 1e-15 * after);
      EXPECT_NEAR(-r.traction[0], pressure * coefficient(slip / h, after), 1e-11 * pressure);
    }
}

// A shear that would slide by less than round-off sticks: the contact only ages.
TEST(RateAndState, SticksFarBelowItsFriction) {
  const Sliding sliding{0, 0.01, {0.2}};
  const TangentialResponse<3> r = law.response<3>(Vec2(0.6, -0.8), -10, sliding);
  EXPECT_EQ(r.status, Status::stick);
  EXPECT_EQ(r.traction, Vec2(0.6, -0.8));
  EXPECT_DOUBLE_EQ(remembered(law, 0, sliding)[0], 0.21);
}

template <int Dim>
void expect_second_order(const Vec<Dim - 1>& trial, double normal, const Sliding& sliding) {
  using V = Eigen::VectorXd;
  const auto f = [&](const V& y) {
    return V(response<Dim>(law, Vec<Dim - 1>(y.head<Dim - 1>()), y[Dim - 1], sliding).traction);
  };
  const TangentialResponse<Dim> at = response<Dim>(law, trial, normal, sliding);
  ASSERT_EQ(at.status, Status::slip);
  V y(Dim), d(Dim);
  y << trial, normal;
  d << Vec<Dim - 1>::Constant(0.7), -0.4;
  const V df = at.d_predictor * d.head<Dim - 1>() + at.d_normal * d[Dim - 1];
  const testing::DerivativeReport r = testing::check_derivative(f, df, y, d, 0.2);
  EXPECT_TRUE(r.exact || std::abs(r.order - 2) < 0.1) << r.order << " " << r.error;
}

TEST(RateAndState, DerivativesAreOfSecondOrder) {
  for (const double size : {7.0, 20.0, 300.0}) {
    expect_second_order<2>(Vec<1>(size), -10, {0, 0.01, {0.02}});
    expect_second_order<2>(Vec<1>(-size), -10, {});  // no time: mu p
    expect_second_order<3>(Vec2(0.6 * size, -0.8 * size), -10, {0, 0.01, {0.02}});
  }
}

/// Coefficient after a way at a constant speed in increments, from the steady state of law.speed.
double after(double speed, double way, int increments) {
  constexpr double pressure = 10;
  const double slip = way / increments, h = slip / speed;
  Sliding sliding{0, h, {law.distance / law.speed}};
  for (int i = 0; i < increments; ++i) sliding.memory = remembered(law, slip, sliding);
  sliding.memory[0] = sliding.memory[0] * (1 + slip / law.distance) - h;  // the last one again
  const double friction = pressure * coefficient(speed, remembered(law, slip, sliding)[0]);
  return law.response<2>(Vec<1>(friction + law.stiffness * slip), -pressure, sliding).traction[0] /
         pressure;
}

// mu + a ln(V/V_0) + b ln(V_0 theta / D), theta = D/V + (D/V_0 - D/V) exp(-s/D): of first order.
TEST(RateAndState, ComesToItsNewSteadyStateAfterAJumpOfSpeed) {
  for (const double speed : {1.0, 0.01}) {
    const double ratio = speed / law.speed;
    for (const double way : {0.002, 0.005, 0.01}) {
      const double age = 1 / ratio + (1 - 1 / ratio) * std::exp(-way / law.distance);
      const double exact = law.mu + law.a * std::log(ratio) + law.b * std::log(age);
      const double coarse = after(speed, way, 100) - exact, fine = after(speed, way, 200) - exact;
      EXPECT_NEAR(std::log2(coarse / fine), 1, 0.03);
      EXPECT_LT(std::abs(fine), 2e-4);
    }
    EXPECT_NEAR(after(speed, 0.5, 200), law.mu + (law.a - law.b) * std::log(ratio), 1e-11);
  }
}

// A new contact has the age that the law says, or that of steady sliding at its speed.
TEST(RateAndState, BeginsAtItsStateAndSaysItsNumbers) {
  EXPECT_EQ(law.state_before({}), law.distance / law.speed);
  RateAndState old = law;
  old.state = 3;
  EXPECT_EQ(old.state_before({}), 3);
  EXPECT_EQ(old.state_before({0, 1, {2}}), 2);
  EXPECT_TRUE(needs_duration(FrictionLaw(law)));
  EXPECT_EQ(text(FrictionLaw(law)), "rate and state 0.6 (penalty 100000)");
  EXPECT_EQ(fault(FrictionLaw(RateAndState{.a = 0, .stiffness = 1})),
            "friction_rate_and_state: a must be > 0, got 0");
  EXPECT_EQ(remembered(Coulomb{0.3, 80}, 1, {0, 1, {2}}), LawMemory{});
}

// Around multipliers as stiff as the state falls.
TEST(RateAndState, IsSteadied) {
  RateAndState soft = law;
  soft.stiffness = 1;
  EXPECT_EQ(steadying(FrictionLaw(soft), -10, 1), 100);  // 2 b p / D = 60
}

}  // namespace
}  // namespace osculate::contact
