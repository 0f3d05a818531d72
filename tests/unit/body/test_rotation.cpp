#include "osculate/body/rotation.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <numbers>
#include <vector>

#include "derivative_check.hpp"
#include "osculate/body/rigid_body.hpp"

namespace osculate::body {
namespace {

constexpr double pi = std::numbers::pi;
const Vec3 axis = Vec3(0.48, -0.6, 0.64);  // a unit vector
const Vec3 f(0.7, -1.1, 0.4), a(1.3, 0.2, -0.8), m(0.9, 0.5, -1.2);

/// Angles at zero, below and above the change of formula (1), near half and whole turns, and more.
std::vector<Vec3> rotations_to_test() {
  std::vector<Vec3> all;
  for (const double t : {0.0, 1e-9, 1e-4, 0.3, 0.999, 1.001, 2.0, 3.1, 4.4, 6.2, 9.0})
    all.emplace_back(t * axis);
  return all;
}

void expect_order_two(const testing::DerivativeReport& report, const Vec3& theta) {
  EXPECT_TRUE(report.exact || std::abs(report.order - 2.0) < 0.05)
      << "order " << report.order << ", error " << report.error << " at " << theta.transpose();
}

TEST(Rotation, IsOrthogonalAndTurnsAboutItsAxis) {
  for (const Vec3& theta : rotations_to_test()) {
    const Mat<3, 3> r = rotation_matrix(theta);
    EXPECT_LT((r * r.transpose() - Mat<3, 3>::Identity()).norm(), 1e-15);
    EXPECT_NEAR(r.determinant(), 1.0, 1e-15);
    EXPECT_LT((r * axis - axis).norm(), 1e-15);
    const Vec3 across = axis.unitOrthogonal(), third = axis.cross(across);
    const double t = theta.norm();
    EXPECT_LT((r * across - std::cos(t) * across - std::sin(t) * third).norm(), 2e-15) << t;
  }
}

TEST(Rotation, ReducesToThePlaneAboutZ) {
  for (const double angle : {0.0, 0.4, -1.7, 3.0}) {
    const RigidMotion plane{Vec2(0.7, -0.4), Vec2(0.5, -0.2), angle};
    const RigidMotion3 space{Vec3(0.7, -0.4, 2), Vec3(0.5, -0.2, 0), Vec3(0, 0, angle)};
    const Vec2 material(2.3, 1.1), force(0.3, -0.7);
    const Vec2 x = plane.position(material);
    const Vec3 x3 = space.position({2.3, 1.1, 2});
    EXPECT_LT((x3 - Vec3(x.x(), x.y(), 2)).norm(), 1e-15);
    Mat<2, 3> part;
    part << motion_gradient(space, x3).topLeftCorner<2, 2>(),
        motion_gradient(space, x3).block<2, 1>(0, 5);
    EXPECT_LT((part - motion_gradient(plane, x)).norm(), 1e-15);
    EXPECT_NEAR(rotation_curvature(space, x3, {0.3, -0.7, 0})(2, 2),
                rotation_curvature(plane, x, force)(0, 0), 1e-15);
  }
}

/// dR R^T is the spin of T dtheta.
TEST(Rotation, TangentIsTheSpin) {
  const Vec3 d(0.4, 0.9, -0.3);
  for (const Vec3& theta : rotations_to_test()) {
    const Mat<3, 3> dr = cross_matrix(rotation_tangent(theta) * d) * rotation_matrix(theta);
    const Eigen::VectorXd df = Eigen::Map<const Vec<9>>(dr.data());
    expect_order_two(testing::check_derivative(
                         [](const Vec3& v) {
                           const Mat<3, 3> r = rotation_matrix(v);
                           return Eigen::VectorXd(Eigen::Map<const Vec<9>>(r.data()));
                         },
                         df, theta, d),
                     theta);
  }
}

TEST(Rotation, TangentIsSingularAtWholeTurnsOnly) {
  EXPECT_NEAR(rotation_tangent(2 * pi * axis).determinant(), 0.0, 1e-15);
  EXPECT_LT((rotation_tangent(2 * pi * axis) * axis - axis).norm(), 1e-15);
  for (const double t : {0.0, 0.5, 3.0, 5.0})
    EXPECT_NEAR(rotation_tangent(t * axis).determinant(),
                t == 0 ? 1 : 2 * (1 - std::cos(t)) / (t * t), 1e-15);
}

TEST(Rotation, HessianIsTheSecondDerivative) {
  const Vec3 d(0.4, 0.9, -0.3);
  for (const Vec3& theta : rotations_to_test()) {
    const Mat<3, 3> h = rotation_hessian(theta, f, a);
    EXPECT_LT((h - h.transpose()).norm(), 1e-15 * h.norm());
    expect_order_two(
        testing::check_derivative(
            [](const Vec3& v) {
              const Vec3 turned = rotation_matrix(v) * a;
              return Eigen::VectorXd(rotation_tangent(v).transpose() * turned.cross(f));
            },
            h * d, theta, d),
        theta);
  }
}

TEST(Rotation, MomentGradientIsTheDerivative) {
  const Vec3 d(0.4, 0.9, -0.3);
  for (const Vec3& theta : rotations_to_test())
    expect_order_two(
        testing::check_derivative(
            [](const Vec3& v) { return Eigen::VectorXd(rotation_tangent(v).transpose() * m); },
            moment_gradient(theta, m) * d, theta, d),
        theta);
}

/// The series and the closed form meet at |theta| = 1 to round-off, in all derivatives.
TEST(Rotation, IsSmoothWhereTheFormulaChanges) {
  const Vec3 below = (1 - 1e-15) * axis, above = (1 + 1e-15) * axis;
  EXPECT_LT((rotation_matrix(below) - rotation_matrix(above)).norm(), 1e-14);
  EXPECT_LT((rotation_tangent(below) - rotation_tangent(above)).norm(), 1e-14);
  EXPECT_LT((rotation_hessian(below, f, a) - rotation_hessian(above, f, a)).norm(), 1e-14);
  EXPECT_LT((moment_gradient(below, m) - moment_gradient(above, m)).norm(), 1e-14);
}

RigidMotion3 motion_of(const Vec<6>& q) { return {Vec3(0.7, -0.4, 0.3), q.head<3>(), q.tail<3>()}; }
const Vec3 material(2.3, 1.1, -0.6);

TEST(RigidBody3, GradientAndCurvatureAreDerivativesOfThePosition) {
  const Vec<6> d = (Vec<6>() << 0.3, 0.8, -0.6, 0.5, -0.4, 0.7).finished();
  for (const Vec3& theta : rotations_to_test()) {
    Vec<6> q;
    q << 0.5, -0.2, 0.9, theta;
    const Vec3 x = motion_of(q).position(material);
    expect_order_two(
        testing::check_derivative(
            [](const Vec<6>& v) { return Eigen::VectorXd(motion_of(v).position(material)); },
            motion_gradient(motion_of(q), x) * d, q, d),
        theta);
    Vec<6> df = Vec<6>::Zero();
    df.tail<3>() = rotation_curvature(motion_of(q), x, f) * d.tail<3>();
    expect_order_two(testing::check_derivative(
                         [](const Vec<6>& v) {
                           const RigidMotion3 motion = motion_of(v);
                           return Eigen::VectorXd(
                               motion_gradient(motion, motion.position(material)).transpose() * f);
                         },
                         df, q, d),
                     theta);
  }
}

TEST(RigidBody3, KeepsLengthsAndItsCentre) {
  for (const Vec3& theta : rotations_to_test()) {
    const RigidMotion3 motion{Vec3(1, 2, 3), Vec3(0.5, 0.25, -1), theta};
    EXPECT_EQ(motion.position(motion.reference), motion.center());
    EXPECT_NEAR((motion.position(material) - motion.center()).norm(),
                (material - motion.reference).norm(), 2e-15 * material.norm());
  }
}

}  // namespace
}  // namespace osculate::body
