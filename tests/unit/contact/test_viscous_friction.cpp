#include "osculate/contact/law/viscous_friction.hpp"

#include <gtest/gtest.h>

#include "derivative_check.hpp"
#include "osculate/contact/law/catalogue.hpp"

namespace osculate::contact {
namespace {

const ViscousFriction law{3, 80};

/// t = c s / h for the distance s that it says has been slid; any pressure.
TEST(ViscousFriction, IsProportionalToTheSpeed) {
  const Sliding sliding{0, 0.1, {}};
  for (const double size : {0.5, 7.0})
    for (const double normal : {-4.0, -400.0}) {
      const Vec2 trial(0.6 * size, -0.8 * size);
      const auto r = law.response<3>(trial, normal, sliding);
      EXPECT_EQ(r.status, Status::slip);
      EXPECT_NEAR(r.traction.norm(), 3 * slid<3>(trial, r, 80) / 0.1, 1e-13 * size);
      EXPECT_NEAR(r.traction.normalized().dot(trial.normalized()), 1, 1e-15);
      EXPECT_EQ(r.d_normal, Vec2::Zero());
      EXPECT_NEAR(dissipated<3>(trial, r, 80), r.traction.squaredNorm() * 0.1 / 3, 1e-13 * size);
    }
}

TEST(ViscousFriction, DerivativeIsExact) {
  const Sliding sliding{0, 0.3, {}};
  const Eigen::VectorXd at = Vec2(1.3, -0.4), d = Vec2(-0.2, 0.9);
  const auto traction = [&](const Eigen::VectorXd& t) {
    return Eigen::VectorXd(law.response<3>(Vec2(t), -1, sliding).traction);
  };
  const Eigen::VectorXd df = law.response<3>(Vec2(at), -1, sliding).d_predictor * d;
  EXPECT_TRUE(testing::check_derivative(traction, df, at, d, 1e-2).exact);
}

TEST(ViscousFriction, NothingSlidesWithoutTime) {
  const auto r = law.response<2>(Vec<1>(2.0), -1.0, {});
  EXPECT_EQ(r.status, Status::stick);
  EXPECT_EQ(r.traction[0], 2.0);
  EXPECT_TRUE(needs_duration(FrictionLaw(law)));
  EXPECT_EQ(text(FrictionLaw(law)), "viscous 3 (penalty 80)");
}

}  // namespace
}  // namespace osculate::contact
