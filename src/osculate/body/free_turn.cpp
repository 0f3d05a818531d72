#include "osculate/body/free_turn.hpp"

#include <Eigen/LU>

#include "osculate/body/rotation.hpp"

namespace osculate::body {

Vec3 free_turn(const Mat<3, 3>& inertia, const Mat<3, 3>& orientation, const Vec3& momentum,
               double h) {
  constexpr int most = 40;
  constexpr double round_off = 1e-16;
  const Mat<3, 3> inverse = inertia.inverse();
  const Vec3 in_body = orientation.transpose() * momentum;
  const Vec3 before = inverse * in_body;
  Vec3 t = h * before;  // of the body's frame
  for (int i = 0; i < most; ++i) {
    const Vec3 after = inverse * (rotation_matrix(-t) * in_body);
    const Vec3 next = (0.5 * h) * (before + after);
    const double change = (next - t).norm();
    t = next;
    if (!(change > round_off * t.norm())) break;
  }
  return orientation * t;
}

}  // namespace osculate::body
