// Laws of one contact point: their borders and the derivatives of every branch.
#include <gtest/gtest.h>

#include <cmath>

#include "osculate/contact/law/coulomb.hpp"
#include "osculate/contact/law/normal_penalty.hpp"

namespace osculate::contact {
namespace {

/// The law in the plane by its scalars.
struct Plane {
  Status status;
  double traction, d_predictor, d_normal;
};
Plane plane(const TangentialResponse<2>& r) {
  return {r.status, r.traction[0], r.d_predictor(0, 0), r.d_normal[0]};
}
Plane respond(const Coulomb& law, double trial, double normal) {
  return plane(law.response<2>(Vec<1>(trial), normal));
}

// [eq:KS2D:32]
TEST(NormalPenalty, IsActiveFromTouchingOn) {
  const NormalPenalty law{1000.0};
  EXPECT_FALSE(law.response(1e-12).active);
  EXPECT_TRUE(law.response(0.0).active);
  EXPECT_EQ(law.response(0.0).traction, 0.0);
  EXPECT_EQ(law.response(-0.01).traction, -10.0);
  EXPECT_EQ(law.response(-0.01).d_traction, 1000.0);
}

// [eq:KS2D:57] [eq:KS2D:77]
TEST(Coulomb, SticksUpToTheLimitAndSlipsBeyond) {
  const Coulomb law{0.5, 80.0};
  const Plane at_limit = respond(law, 5.0, -10.0);
  EXPECT_EQ(at_limit.status, Status::stick);
  EXPECT_EQ(at_limit.traction, 5.0);
  EXPECT_EQ(at_limit.d_predictor, 1.0);
  for (const double sign : {1.0, -1.0}) {
    const Plane slip = respond(law, sign * 5.0001, -10.0);
    EXPECT_EQ(slip.status, Status::slip);
    EXPECT_EQ(slip.traction, sign * 5.0);
    EXPECT_EQ(slip.d_predictor, 0.0);
    EXPECT_EQ(slip.d_normal, -sign * 0.5);
  }
  EXPECT_EQ(plane(slip_response<2>(Vec<1>(-1.0), 9, law.first_limit(4.0, {}))).traction, -2.0);
  EXPECT_EQ(plane(stick_response<2>(Vec<1>(1e9))).traction, 1e9);
}

// The limit belongs to stick, from both sides, and a point without pressure has none.
TEST(Coulomb, TheLimitItselfSticks) {
  const Coulomb law{0.3, 80.0};
  const double limit = 0.3 * 7.0;
  for (const double sign : {1.0, -1.0}) {
    EXPECT_EQ(respond(law, sign * limit, -7.0).status, Status::stick);
    EXPECT_EQ(respond(law, sign * std::nextafter(limit, 10.0), -7.0).status, Status::slip);
    EXPECT_EQ(respond(law, sign * std::nextafter(limit, 0.0), -7.0).status, Status::stick);
  }
  EXPECT_EQ(respond(law, 0.0, 0.0).status, Status::stick);
  EXPECT_EQ(respond(law, 1e-300, 0.0).status, Status::slip);
  EXPECT_EQ(respond(law, 1e-300, 0.0).traction, 0.0);
}

// [eq:KS2D:77] as printed in Table 1 (T_tr <= mu N with N < 0) no positive trial ever sticks.
TEST(Coulomb, StickUnderPressureThatThePrintedTestWouldMiss) {
  const Coulomb law{0.5, 80.0};
  const double trial = 1.0, normal = -10.0;
  EXPECT_GT(trial, law.mu * normal);  // the printed condition says slip
  EXPECT_EQ(respond(law, trial, normal).status, Status::stick);
}

double value(const NormalResponse& r) { return r.traction; }
double value(const Plane& r) { return r.traction; }

/// Central difference of a branch that is linear: exact but for rounding.
template <class F>
double slope(const F& f, double x) {
  constexpr double h = 0.0625;
  return (value(f(x + h)) - value(f(x - h))) / (2 * h);
}

// [eq:KS2D:32] [eq:KS2D:57]
TEST(ContactLaws, DerivativesOfEveryBranch) {
  const NormalPenalty normal{1000.0};
  const auto of_gap = [&](double gap) { return normal.response(gap); };
  EXPECT_NEAR(slope(of_gap, -0.5), normal.response(-0.5).d_traction, 1e-10);
  EXPECT_EQ(normal.response(0.0).d_traction, 1000.0);
  EXPECT_EQ(slope(of_gap, 0.5), normal.response(0.5).d_traction);
  const Coulomb law{0.5, 80.0};
  for (const double trial : {-20.0, -1.0, 1.0, 20.0}) {
    const double pressure = -10.0;
    const Plane at = respond(law, trial, pressure);
    EXPECT_EQ(at.status, std::abs(trial) > 5 ? Status::slip : Status::stick);
    const auto of_trial = [&](double t) { return respond(law, t, pressure); };
    const auto of_normal = [&](double n) { return respond(law, trial, n); };
    EXPECT_NEAR(slope(of_trial, trial), at.d_predictor, 1e-13);
    EXPECT_NEAR(slope(of_normal, pressure), at.d_normal, 1e-13);
  }
}

}  // namespace
}  // namespace osculate::contact
