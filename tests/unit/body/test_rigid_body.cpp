#include <gtest/gtest.h>

#include "derivative_check.hpp"
#include "osculate/body/rigid_body.hpp"

namespace osculate::body {
namespace {

RigidMotion motion_of(const Vec3& q) { return {Vec2(0.7, -0.4), q.head<2>(), q.z()}; }

const Vec2 material(2.3, 1.1);

/// Against the definition, at angles beyond a turn.
TEST(RigidBody, TurnsAboutItsReferencePoint) {
  for (const double angle : {0.0, 0.3, 2.0, -4.0, 9.0}) {
    const RigidMotion motion = motion_of({0.5, -0.2, angle});
    EXPECT_EQ(motion.position(motion.reference), motion.center());
    const Vec2 arm = motion.position(material) - motion.center();
    const Vec2 before = material - motion.reference;
    EXPECT_NEAR(arm.norm(), before.norm(), 1e-15);
    EXPECT_NEAR(before.dot(arm), before.squaredNorm() * std::cos(angle), 1e-14);
    EXPECT_NEAR(turn(before).dot(arm), before.squaredNorm() * std::sin(angle), 1e-14);
  }
}

TEST(RigidBody, GradientIsTheDerivativeOfThePosition) {
  const Vec3 q(0.5, -0.2, 2.1), d(0.3, 0.8, -0.6);
  const Vec2 x = motion_of(q).position(material);
  const Eigen::VectorXd df = motion_gradient(motion_of(q), x) * d;
  const auto report = testing::check_derivative(
      [](const Vec3& v) { return Eigen::VectorXd(motion_of(v).position(material)); }, df, q, d);
  EXPECT_NEAR(report.order, 2.0, 0.05) << report.error;
}

TEST(RigidBody, CurvatureIsTheDerivativeOfTheGradient) {
  const Vec3 q(0.5, -0.2, 2.1), d(0.0, 0.0, 1.0);
  const Vec2 x = motion_of(q).position(material);
  const Eigen::VectorXd df = rotation_curvature(motion_of(q), x);
  const auto report = testing::check_derivative(
      [](const Vec3& v) {
        const RigidMotion motion = motion_of(v);
        return Eigen::VectorXd(motion_gradient(motion, motion.position(material)).col(2));
      },
      df, q, d);
  EXPECT_NEAR(report.order, 2.0, 0.05) << report.error;
  // The other second derivatives vanish: the gradient does not change with the translation.
  const RigidMotion shifted = motion_of({1.5, 0.9, 2.1});
  EXPECT_TRUE(motion_gradient(shifted, shifted.position(material))
                  .isApprox(motion_gradient(motion_of(q), x), 1e-15));
}

/// x = c + A + theta x A, whatever the angle: derivatives of first order are constant, others none.
TEST(RigidBody, OfSmallRotationIsLinear) {
  RigidMotion plane = motion_of({0.5, -0.2, 1.3});
  plane.small = true;
  const Vec2 arm = material - plane.reference, x = plane.position(material);
  EXPECT_LT((x - (material + Vec2(0.5, -0.2) + 1.3 * turn(arm))).norm(), 1e-15);
  EXPECT_LT((arm_of(plane, x) - arm).norm(), 1e-15);
  EXPECT_LT((motion_gradient(plane, x).col(2) - turn(arm)).norm(), 1e-15);
  EXPECT_EQ(rotation_curvature(plane, x, {3, 4})(0, 0), 0);

  RigidMotion3 space{Vec3(0.7, -0.4, 2), Vec3(0.5, -0.2, 0.3), Vec3(1.1, -0.7, 1.9)};
  space.small = true;
  const Vec3 point(2.3, 1.1, -0.6), arm3 = point - space.reference, x3 = space.position(point);
  EXPECT_LT((x3 - (point + space.translation + space.rotation.cross(arm3))).norm(), 1e-15);
  EXPECT_LT((arm_of(space, x3) - arm3).norm(), 2e-15);
  const Eigen::VectorXd d = Vec<6>(0.3, 0.8, -0.6, 1.2, -0.4, 0.9);
  RigidMotion3 moved = space;
  for (int i = 0; i < 6; ++i) moved.component(i) += d[i];
  EXPECT_LT((motion_gradient(space, x3) * d - (moved.position(point) - x3)).norm(), 5e-15);
  EXPECT_TRUE(rotation_curvature(space, x3, {3, 4, 5}).isZero(0));
  EXPECT_TRUE(moment_gradient(space, Vec3(3, 4, 5)).isZero(0));
  EXPECT_TRUE(spin_tangent(space).isIdentity(0));
  EXPECT_EQ(rebased(space, 0.1).rotation, space.rotation);
  EXPECT_EQ(turn_between(space, moved), moved.rotation - space.rotation);
}

}  // namespace
}  // namespace osculate::body
