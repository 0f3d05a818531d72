#include "osculate/body/rigid_body.hpp"

namespace osculate::body {

Vec3 total_rotation(const RigidMotion3& motion) {
  if (motion.turned.isZero(0)) return motion.rotation;
  return rotation_vector_near(motion.orientation(), motion.turned + motion.rotation);
}

RigidMotion3 rebased(const RigidMotion3& motion, double angle) {
  if (motion.small || !(motion.rotation.norm() > angle)) return motion;
  RigidMotion3 out = motion;
  out.turned = total_rotation(motion);
  const Mat<3, 3> b = motion.orientation();
  // One step of Newton's iteration for the polar decomposition: round-off does not pile up.
  out.base = 0.5 * b * (3 * Mat<3, 3>::Identity() - b.transpose() * b);
  out.rotation.setZero();
  return out;
}

Vec3 turn_between(const RigidMotion3& from, const RigidMotion3& to) {
  if (from.small) return to.rotation - from.rotation;
  if (from.rotation.isZero(0) && from.base == to.base) return to.rotation;
  return rotation_vector(to.orientation() * from.orientation().transpose());
}

}  // namespace osculate::body
