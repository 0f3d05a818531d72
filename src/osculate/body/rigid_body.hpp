#pragma once
#include <cmath>

#include "osculate/body/rotation.hpp"
#include "osculate/core/types.hpp"

namespace osculate::body {

/// Number of rotations of a rigid body (2D: the angle; 3D: the rotation vector), and of all its
/// degrees of freedom: translations, then rotations.
template <int Dim>
inline constexpr int rotations = Dim == 2 ? 1 : 3;
template <int Dim>
inline constexpr int motions = Dim + rotations<Dim>;

/// Rigid motion about a reference point, of any size, or (`small`) by small rotations: linear in
/// the components, as the strains of small displacements are. Then x = c + A + theta x A with A = X
/// - X_ref, whatever the angle, and moments are those about the axes in space.
template <int Dim>
struct BasicRigidMotion;

/// Plane rigid motion: two translations and a rotation angle.
///
/// Formula    x = c + R(theta) (X - X_ref) ,  c = X_ref + u
/// Units      lengths of the model; theta in radians, positive from x to y
template <>
struct BasicRigidMotion<2> {
  Vec2 reference{0, 0};    ///< X_ref
  Vec2 translation{0, 0};  ///< u
  double angle = 0;        ///< theta
  bool small = false;      ///< rotation

  [[nodiscard]] Vec2 center() const { return reference + translation; }
  [[nodiscard]] Vec2 position(const Vec2& material) const {
    const Vec2 arm = material - reference;
    if (small) return center() + arm + angle * turn(arm);
    const double c = std::cos(angle), s = std::sin(angle);
    return center() + Vec2(c * arm.x() - s * arm.y(), s * arm.x() + c * arm.y());
  }
  /// Translations, then the rotation.
  [[nodiscard]] double& component(int i) { return i == 2 ? angle : translation[i]; }
  [[nodiscard]] double component(int i) const { return i == 2 ? angle : translation[i]; }
};

/// Rigid motion in space: three translations and a rotation vector on top of a base.
///
/// A rotation vector is singular at whole turns. Motions that turn freely and far move what they
/// have turned into the base (`rebased`); others leave it alone, and their rotation vector is the
/// total.
///
/// Formula    x = c + R (X - X_ref) ,  c = X_ref + u ,  R = exp [theta] B
/// Units      lengths of the model; theta in radians
/// Tested by  tests/unit/body/test_rotation.cpp, tests/unit/body/test_base_rotation.cpp
template <>
struct BasicRigidMotion<3> {
  Vec3 reference{0, 0, 0};                 ///< X_ref
  Vec3 translation{0, 0, 0};               ///< u
  Vec3 rotation{0, 0, 0};                  ///< theta
  Mat<3, 3> base = Mat<3, 3>::Identity();  ///< B
  Vec3 turned{0, 0, 0};                    ///< total rotation vector of the base
  bool small = false;                      ///< rotation: its base stays the identity

  [[nodiscard]] Vec3 center() const { return reference + translation; }
  /// Of small rotations the one at first.
  [[nodiscard]] Mat<3, 3> orientation() const {
    return small ? Mat<3, 3>(Mat<3, 3>::Identity()) : Mat<3, 3>(rotation_matrix(rotation) * base);
  }
  [[nodiscard]] Vec3 position(const Vec3& material) const {
    const Vec3 arm = base * (material - reference);
    if (small) return center() + arm + cross_matrix(rotation) * arm;
    return center() + rotation_matrix(rotation) * arm;
  }
  /// Translations, then the rotation vector on top of the base.
  [[nodiscard]] double& component(int i) { return i < 3 ? translation[i] : rotation[i - 3]; }
  [[nodiscard]] double component(int i) const { return i < 3 ? translation[i] : rotation[i - 3]; }
};

using RigidMotion = BasicRigidMotion<2>;
using RigidMotion3 = BasicRigidMotion<3>;

/// Rotation since the beginning: the angle; in space the total rotation vector, whose exponential
/// is the orientation. Without a base it is theta. With one it is the logarithm of the orientation
/// next to the sum of both rotation vectors: turns about one axis add up without end.
///
/// Tested by  tests/unit/body/test_base_rotation.cpp
[[nodiscard]] inline Vec<1> total_rotation(const RigidMotion& motion) {
  return Vec<1>(motion.angle);
}
[[nodiscard]] Vec3 total_rotation(const RigidMotion3& motion);

/// The angle above which a rotation vector is moved into the base, far from its whole turn.
inline constexpr double far_turned = 2;

/// The same motion with its rotation moved into the base, if it is larger than `angle` (in the
/// plane: as it is, an angle has no whole turn). Velocities in space do not change by this; what is
/// measured along the components of theta does. Requires   no component of theta is prescribed or
/// part of an equation: they are totals
///
/// Tested by  tests/unit/body/test_base_rotation.cpp
[[nodiscard]] inline RigidMotion rebased(const RigidMotion& motion, double angle = far_turned) {
  (void)angle;
  return motion;
}
[[nodiscard]] RigidMotion3 rebased(const RigidMotion3& motion, double angle = far_turned);

/// Rotation vector in space of the turn that leads from one orientation to the other, below half a
/// turn; exactly the change of theta where both have the same base and the first is at it.
///
/// Tested by  tests/unit/body/test_base_rotation.cpp
[[nodiscard]] inline Vec<1> turn_between(const RigidMotion& from, const RigidMotion& to) {
  return Vec<1>(to.angle - from.angle);
}
[[nodiscard]] Vec3 turn_between(const RigidMotion3& from, const RigidMotion3& to);

/// Spin of a change of the rotation vector (rotation_tangent); of small rotations the change
/// itself.
[[nodiscard]] inline Mat<3, 3> spin_tangent(const RigidMotion3& motion) {
  return motion.small ? Mat<3, 3>(Mat<3, 3>::Identity()) : rotation_tangent(motion.rotation);
}

/// Derivative of spin_tangent^T m with respect to theta for a moment m fixed in space.
[[nodiscard]] inline Mat<3, 3> moment_gradient(const RigidMotion3& motion, const Vec3& m) {
  return motion.small ? Mat<3, 3>(Mat<3, 3>::Zero()) : moment_gradient(motion.rotation, m);
}

/// The arm whose cross product with the spin is the velocity of the material point that is now at
/// `x`, and with its force the moment: x - c, of small rotations A.
///
/// Formula    small: A + theta x A = x - c ,
///            A = (I - [theta] + theta theta^T) (x - c) / (1 + theta . theta)
/// Tested by  tests/unit/body/test_rigid_body.cpp
[[nodiscard]] inline Vec2 arm_of(const RigidMotion& motion, const Vec2& x) {
  const Vec2 now = x - motion.center();
  if (!motion.small) return now;
  return (now - motion.angle * turn(now)) / (1 + motion.angle * motion.angle);
}
[[nodiscard]] inline Vec3 arm_of(const RigidMotion3& motion, const Vec3& x) {
  const Vec3 now = x - motion.center();
  if (!motion.small) return now;
  const Vec3& t = motion.rotation;
  return (now - cross_matrix(t) * now + t * t.dot(now)) / (1 + t.squaredNorm());
}

/// dx / d(u_x, u_y, theta) of the material point that is now at `x`:  dx = du + d(theta) k x (x -
/// c), of small rotations k x A.
[[nodiscard]] inline Mat<2, 3> motion_gradient(const RigidMotion& motion, const Vec2& x) {
  Mat<2, 3> j;
  j.leftCols<2>().setIdentity();
  j.col(2) = turn(arm_of(motion, x));
  return j;
}

/// dx / d(u, theta):  dx = du + (T dtheta) x (x - c).
[[nodiscard]] inline Mat<3, 6> motion_gradient(const RigidMotion3& motion, const Vec3& x) {
  Mat<3, 6> j;
  j.leftCols<3>().setIdentity();
  j.rightCols<3>() = -cross_matrix(arm_of(motion, x)) * spin_tangent(motion);
  return j;
}

/// Second derivative of x with respect to theta: -(x - c), of small rotations none.
[[nodiscard]] inline Vec2 rotation_curvature(const RigidMotion& motion, const Vec2& x) {
  if (motion.small) return Vec2::Zero();
  return motion.center() - x;
}

/// Second derivative of f . x with respect to the rotations, f fixed (symmetric).
[[nodiscard]] inline Mat<1, 1> rotation_curvature(const RigidMotion& motion, const Vec2& x,
                                                  const Vec2& f) {
  return Mat<1, 1>(f.dot(rotation_curvature(motion, x)));
}
[[nodiscard]] inline Mat<3, 3> rotation_curvature(const RigidMotion3& motion, const Vec3& x,
                                                  const Vec3& f) {
  if (motion.small) return Mat<3, 3>::Zero();
  // B (X - X_ref)
  const Vec3 arm = rotation_matrix(motion.rotation).transpose() * (x - motion.center());
  return rotation_hessian(motion.rotation, f, arm);
}

}  // namespace osculate::body
