// Laws of one contact point at their borders, and the variations of its kinematics by order.
#include <gtest/gtest.h>

#include <cmath>

#include "derivative_check.hpp"
#include "osculate/contact/kinematics.hpp"
#include "osculate/contact/law/coulomb.hpp"
#include "osculate/contact/law/normal_penalty.hpp"
#include "osculate/contact/point_terms.hpp"

namespace osculate::contact {
namespace {

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
  const TangentialResponse at_limit = law.response(5.0, -10.0);
  EXPECT_EQ(at_limit.status, Status::stick);
  EXPECT_EQ(at_limit.traction, 5.0);
  EXPECT_EQ(at_limit.d_trial, 1.0);
  for (const double sign : {1.0, -1.0}) {
    const TangentialResponse slip = law.response(sign * 5.0001, -10.0);
    EXPECT_EQ(slip.status, Status::slip);
    EXPECT_EQ(slip.traction, sign * 5.0);
    EXPECT_EQ(slip.d_trial, 0.0);
    EXPECT_EQ(slip.d_normal, -sign * 0.5);
  }
  EXPECT_EQ(law.slip(-1.0, -4.0).traction, -2.0);
  EXPECT_EQ(Coulomb::stick(1e9).traction, 1e9);
}

/// A straight segment with two nodes and a slave point, as one vector of coordinates.
Kinematics on_segment(const Eigen::VectorXd& x, double xi) {
  const Vec2 a = x.segment<2>(0), b = x.segment<2>(2), s = x.segment<2>(4);
  geometry::CurveJet<2> jet;
  jet.r = 0.5 * (1 - xi) * a + 0.5 * (1 + xi) * b;
  jet.r1 = 0.5 * (b - a);
  return face_kinematics(jet, s);
}

double foot(const Eigen::VectorXd& x) {
  const Vec2 a = x.segment<2>(0), b = x.segment<2>(2), s = x.segment<2>(4);
  return 2 * (s - a).dot(b - a) / (b - a).squaredNorm() - 1;
}

// [eq:KS2D:27] [eq:KS2D:28] [eq:KS2D:45]
TEST(Kinematics, VariationsAreDerivatives) {
  Eigen::VectorXd x(6), d(6);
  x << 0, 0, 3, 1, 1.2, 0.1;
  d << 0.3, -0.7, 0.2, 0.9, -0.4, 0.6;
  const double xi = foot(x);
  const Kinematics k = on_segment(x, xi);
  const Vec2 p =
      d.segment<2>(4) - 0.5 * (1 - xi) * d.segment<2>(0) - 0.5 * (1 + xi) * d.segment<2>(2);
  const Vec2 q = 0.5 * d.segment<2>(0) - 0.5 * d.segment<2>(2);
  const auto value = [&](const Form& form) { return form.p.dot(p) + form.q.dot(q); };
  Eigen::VectorXd expected(3);
  expected << value(k.d_xi), value(k.d_gap), value(k.d_angle);
  const auto quantities = [](const Eigen::VectorXd& y) {
    const Kinematics at = on_segment(y, foot(y));
    Eigen::VectorXd v(3);
    v << foot(y), at.gap, std::atan2(at.unit_tangent.y(), at.unit_tangent.x());
    return v;
  };
  const osculate::testing::DerivativeReport r =
      osculate::testing::check_derivative(quantities, expected, x, d);
  EXPECT_NEAR(r.order, 2.0, 0.05) << r.error;
}

TEST(Kinematics, CornerPointsAlongTheSlaveAndSurvivesCoincidence) {
  const Kinematics below = corner_kinematics({0, 0}, {0.3, -0.4}, {0, 1});
  EXPECT_NEAR(below.gap, -0.5, 1e-15);
  EXPECT_LT((below.normal - Vec2(-0.6, 0.8)).norm(), 1e-15);
  EXPECT_NEAR(below.normal.dot(turn(below.unit_tangent)), 1.0, 1e-15);
  const Kinematics same = corner_kinematics({1, 2}, {1, 2}, {0.6, 0.8});
  EXPECT_EQ(same.normal, Vec2(0.6, 0.8));
  EXPECT_LE(same.gap, 0.0);
  EXPECT_TRUE(std::isfinite(same.d_angle.p.norm() * same.gap));
}

// [eq:KS2D:54] [eq:KS2D:56] [eq:KS2D:58] in physical components: T = sqrt(a11) t, rho_xi =
// sqrt(a11) tau.
TEST(CovariantTerms, PartsInPhysicalComponents) {
  geometry::CurveJet<2> jet;
  jet.r1 = {2, 1};
  jet.r2 = {0.3, -0.4};
  const Kinematics k = face_kinematics(jet, Vec2(0.05, -0.1));
  const Vec2 tau = k.unit_tangent, nu = k.normal;
  for (const Status status : {Status::stick, Status::slip}) {
    const double shear = 3.0, normal = -10.0;
    Traction t;
    t.normal = {true, normal, 1000.0};
    t.tangential = {status, shear, status == Status::stick ? 1.0 : 0.0,
                    status == Status::stick ? 0.0 : -0.3};
    t.tangential_stiffness = 80.0;
    const auto part = [&](bool main, bool rotational, bool curvature) {
      return covariant_terms(k, t, ResidualForm::surface, {false, main, rotational, curvature});
    };
    const double first = status == Status::stick ? 1.0 : 2.0;
    const Mat<2, 2> bend = -normal * k.kappa * tau * tau.transpose() +
                           shear * k.kappa * (first * tau * nu.transpose() + nu * tau.transpose());
    EXPECT_LT((part(false, false, true).m[0][0] - bend).norm(), 1e-13);
    const Mat<2, 2> main =
        1000.0 * nu * nu.transpose() + (status == Status::stick
                                            ? Mat<2, 2>(80.0 * tau * tau.transpose())
                                            : Mat<2, 2>(-0.3 * 1000.0 * tau * nu.transpose()));
    EXPECT_LT((part(true, false, false).m[0][0] - main).norm(), 1e-12);
    const Mat<2, 2> turned =
        (normal * nu * tau.transpose() + shear * tau * tau.transpose()) / k.sqrt_a11;
    EXPECT_LT((part(false, true, false).m[1][0] - turned).norm(), 1e-13);
    const Mat<2, 2> other =
        (normal * tau * nu.transpose() + shear * tau * tau.transpose()) / k.sqrt_a11;
    EXPECT_LT((part(false, true, false).m[0][1] - other).norm(), 1e-13);
  }
}

}  // namespace
}  // namespace osculate::contact
