#pragma once
#include <cmath>

#include "osculate/core/types.hpp"

namespace osculate::body {

/// Plane rigid motion about a reference point: two translations and a rotation angle (no limit on
/// its size).
///
/// Formula    x = c + R(theta) (X - X_ref) ,  c = X_ref + u
/// Units      lengths of the model; theta in radians, positive from x to y
struct RigidMotion {
  Vec2 reference{0, 0};    ///< X_ref
  Vec2 translation{0, 0};  ///< u
  double angle = 0;        ///< theta

  [[nodiscard]] Vec2 center() const { return reference + translation; }
  [[nodiscard]] Vec2 position(const Vec2& material) const {
    const Vec2 arm = material - reference;
    const double c = std::cos(angle), s = std::sin(angle);
    return center() + Vec2(c * arm.x() - s * arm.y(), s * arm.x() + c * arm.y());
  }
};

/// dx / d(u_x, u_y, theta) of the material point that is now at `x`:  dx = du + d(theta) k x (x -
/// c).
[[nodiscard]] inline Mat<2, 3> motion_gradient(const RigidMotion& motion, const Vec2& x) {
  Mat<2, 3> j;
  j.leftCols<2>().setIdentity();
  j.col(2) = turn(x - motion.center());
  return j;
}

/// Second derivative of x with respect to theta: -(x - c).
[[nodiscard]] inline Vec2 rotation_curvature(const RigidMotion& motion, const Vec2& x) {
  return motion.center() - x;
}

}  // namespace osculate::body
