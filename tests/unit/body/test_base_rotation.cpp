#include <gtest/gtest.h>

#include <numbers>

#include "derivative_check.hpp"
#include "osculate/body/rigid_body.hpp"

namespace osculate::body {
namespace {

constexpr double pi = std::numbers::pi;
const Vec3 axis = Vec3(0.48, -0.6, 0.64);  // a unit vector
const Vec3 material(2.3, 1.1, -0.6), f(0.7, -1.1, 0.4);

RigidMotion3 on_a_base(const Vec3& theta) {
  RigidMotion3 motion{Vec3(0.7, -0.4, 0.3), Vec3(0.5, -0.2, 0.9), Vec3(0.9, 1.7, -1.2)};
  motion = rebased(motion, 0.0);
  motion.rotation = theta;
  return motion;
}

TEST(RotationVector, IsTheInverseOfItsMatrix) {
  for (const double t : {0.0, 1e-12, 1e-5, 0.3, 1.0, 2.9, 3.14159})
    EXPECT_LT((rotation_vector(rotation_matrix(t * axis)) - t * axis).norm(), 2e-15) << t;
  for (const double t : {3.2, 4.0, 6.2}) {  // the other way round
    const Vec3 back = (t - 2 * pi) * axis;
    EXPECT_LT((rotation_vector(rotation_matrix(t * axis)) - back).norm(), 2e-15) << t;
  }
  EXPECT_NEAR(rotation_vector(rotation_matrix(pi * axis)).norm(), pi, 1e-15);
}

TEST(RotationVector, NextToAGuessIsOfTheSameRotation) {
  for (const double t : {0.2, 3.1, 4.0, 6.28, 2 * pi, 6.3, 9.0, 12.55, 4 * pi, 30.0}) {
    const Mat<3, 3> r = rotation_matrix(t * axis);
    for (const double off : {-1.5, -0.1, 0.0, 0.1, 1.5}) {
      if (t + off < 0.1) continue;
      const Vec3 near = rotation_vector_near(r, (t + off) * axis);
      EXPECT_LT((near - t * axis).norm(), 1e-13) << t << " " << off;
      const Vec3 beside = rotation_vector_near(r, t * axis + Vec3(0.02, 0.03, -0.01));
      EXPECT_LT((rotation_matrix(beside) - r).norm(), 1e-13) << t;
    }
  }
}

/// Without a base nothing has changed: not even the last bit.
TEST(BaseRotation, IsNotThereUntilItIsNeeded) {
  const RigidMotion3 motion{Vec3(0.7, -0.4, 0.3), Vec3(0.5, -0.2, 0.9), 1.9 * axis};
  const Vec3 plain =
      motion.center() + rotation_matrix(motion.rotation) * (material - motion.reference);
  EXPECT_EQ(motion.position(material), plain);
  EXPECT_EQ(motion.orientation(), rotation_matrix(motion.rotation));
  EXPECT_EQ(total_rotation(motion), motion.rotation);
  const RigidMotion3 same = rebased(motion);
  EXPECT_EQ(same.rotation, motion.rotation);
  EXPECT_TRUE(same.base.isIdentity(0));
}

TEST(BaseRotation, KeepsTheBodyWhereItIs) {
  const RigidMotion3 motion{Vec3(0.7, -0.4, 0.3), Vec3(0.5, -0.2, 0.9), 2.1 * axis};
  const RigidMotion3 moved = rebased(motion);
  EXPECT_TRUE(moved.rotation.isZero(0));
  EXPECT_LT((moved.position(material) - motion.position(material)).norm(), 1e-15);
  EXPECT_LT((total_rotation(moved) - motion.rotation).norm(), 1e-15);
  EXPECT_EQ(moved.position(moved.reference), motion.center());
}

TEST(BaseRotation, GradientAndCurvatureAreDerivativesOfThePosition) {
  const Vec<6> d = (Vec<6>() << 0.3, 0.8, -0.6, 0.5, -0.4, 0.7).finished();
  const auto motion_of = [](const Vec<6>& q) {
    RigidMotion3 motion = on_a_base(q.tail<3>());
    motion.translation = q.head<3>();
    return motion;
  };
  for (const double t : {0.0, 0.4, 2.2}) {
    Vec<6> q;
    q << 0.5, -0.2, 0.9, t * axis;
    const RigidMotion3 at = motion_of(q);
    const Vec3 x = at.position(material);
    const auto position = testing::check_derivative(
        [&](const Vec<6>& v) { return Eigen::VectorXd(motion_of(v).position(material)); },
        motion_gradient(at, x) * d, q, d);
    EXPECT_NEAR(position.order, 2, 0.05) << position.error;
    Vec<6> df = Vec<6>::Zero();
    df.tail<3>() = rotation_curvature(at, x, f) * d.tail<3>();
    const auto gradient = testing::check_derivative(
        [&](const Vec<6>& v) {
          const RigidMotion3 motion = motion_of(v);
          return Eigen::VectorXd(motion_gradient(motion, motion.position(material)).transpose() *
                                 f);
        },
        df, q, d);
    EXPECT_NEAR(gradient.order, 2, 0.05) << gradient.error;
  }
}

/// Five turns in steps that hit whole turns exactly and others that do not; also with the noise
/// that a solver leaves across the axis. Beside a whole turn it is as many times larger as the
/// total is than the distance to the whole turn.
TEST(BaseRotation, TotalOfTurnsAboutOneAxisGoesOnForEver) {
  for (const double step : {0.1, pi / 50, 1.3, 2.5})
    for (const double limit : {0.0, far_turned})
      for (const double noise : {0.0, 1e-13}) {
        RigidMotion3 motion;
        const int count = static_cast<int>(10 * pi / step);
        for (int i = 1; i <= count; ++i) {
          motion.rotation += step * axis + noise * (i % 3 - 1) * Vec3(0.8, 0.64, 0);
          const double bound = 1e-12 + noise * i * (10 * pi / 1e-2);
          EXPECT_LT((total_rotation(motion) - i * step * axis).norm(), bound)
              << step << " " << limit << " " << i;
          motion = rebased(motion, limit);
          EXPECT_LT((total_rotation(motion) - i * step * axis).norm(), bound);
        }
      }
}

/// Backwards again: the turns come off.
TEST(BaseRotation, TotalComesBackToZero) {
  RigidMotion3 motion;
  for (int i = 1; i <= 200; ++i) {
    motion.rotation += (i <= 100 ? 0.15 : -0.15) * axis;
    motion = rebased(motion, 0.0);
    EXPECT_NEAR(total_rotation(motion).dot(axis), 0.15 * (i <= 100 ? i : 200 - i), 1e-12);
  }
}

/// About changing axes the total is still a rotation vector of the orientation, and does not jump
/// when the rotation moves into the base.
TEST(BaseRotation, TotalIsARotationVectorOfTheOrientation) {
  RigidMotion3 motion;
  Vec3 last = Vec3::Zero();
  for (int i = 0; i < 400; ++i) {
    const double s = 0.02 * i;
    motion.rotation += 0.03 * Vec3(std::cos(s), std::sin(1.3 * s), 0.7);
    const Vec3 before = total_rotation(motion);
    EXPECT_LT((rotation_matrix(before) - motion.orientation()).norm(), 1e-12) << i;
    EXPECT_LT((before - last).norm(), 0.3) << i;
    motion = rebased(motion, 0.5);
    last = total_rotation(motion);
    EXPECT_LT((before - last).norm(), 1e-12) << i;
  }
}

TEST(BaseRotation, StaysOrthogonal) {
  RigidMotion3 motion;
  for (int i = 0; i < 100000; ++i) {
    motion.rotation = 0.1 * Vec3(std::cos(0.1 * i), std::sin(0.07 * i), 0.5);
    motion = rebased(motion, 0.0);
  }
  EXPECT_LT((motion.base.transpose() * motion.base - Mat<3, 3>::Identity()).norm(), 2e-15);
}

TEST(BaseRotation, TurnBetweenMotions) {
  const RigidMotion3 from = on_a_base(Vec3::Zero()), to = on_a_base(1.2 * axis);
  EXPECT_EQ(turn_between(from, to), to.rotation);
  const RigidMotion3 later = on_a_base(1.5 * axis);
  EXPECT_LT((turn_between(to, later) - 0.3 * axis).norm(), 2e-15);
  EXPECT_LT((turn_between(rebased(to, 0.0), later) - 0.3 * axis).norm(), 2e-15);
  const RigidMotion a{Vec2(1, 0), Vec2(0, 0), 7.0}, b{Vec2(1, 0), Vec2(2, 0), 7.5};
  EXPECT_EQ(turn_between(a, b)[0], 0.5);
  EXPECT_EQ(total_rotation(rebased(a, 0.0))[0], 7.0);
}

}  // namespace
}  // namespace osculate::body
