#include "osculate/contact/kinematics.hpp"

#include <algorithm>
#include <cmath>

namespace osculate::contact {
namespace {

// @eq KS2D:27 exact for every zeta: the rate of penetration is the relative velocity along nu.
Form gap_variation(const Vec2& normal) {
  Form form;
  form.p = normal;
  return form;
}

// @eq KS2D:28 in its exact form: the printed one holds only for zeta = 0 (docs/errata.md).
Form convective_variation(const Kinematics& k) {
  Form form;
  form.p = k.sqrt_a11 / k.g * k.unit_tangent;
  form.q = -k.gap / k.g * k.normal;
  return form;
}

// @eq KS2D:45 rotation of the moving frame, the convective part included.
Form frame_rotation(const Kinematics& k) {
  Form form = k.h11 / k.sqrt_a11 * k.d_xi;
  form.q -= k.normal / k.sqrt_a11;
  return form;
}

}  // namespace

Kinematics face_kinematics(const geometry::CurveJet<2>& jet, const Vec2& slave) {
  Kinematics k;
  k.feature = projection::Feature::face;
  k.a11 = jet.r1.squaredNorm();
  k.sqrt_a11 = std::sqrt(k.a11);
  k.unit_tangent = jet.r1 / k.sqrt_a11;
  k.normal = turn(k.unit_tangent);
  k.gap = (slave - jet.r).dot(k.normal);
  k.h11 = jet.r2.dot(k.normal);
  k.kappa = k.h11 / k.a11;
  k.g = k.a11 - k.gap * k.h11;
  k.rho2 = jet.r2;
  k.rho3 = jet.r3;
  k.d_xi = convective_variation(k);
  k.d_gap = gap_variation(k.normal);
  k.d_angle = frame_rotation(k);
  return k;
}

Kinematics corner_kinematics(const Vec2& vertex, const Vec2& slave, const Vec2& outward) {
  constexpr double tiny = 1e-150;  // keeps gap * d_angle finite where the points coincide
  Kinematics k;
  k.feature = projection::Feature::corner;
  const Vec2 offset = slave - vertex;
  const double distance = offset.norm();
  const double sign = offset.dot(outward) > 0 ? 1.0 : -1.0;
  k.normal = distance > tiny ? Vec2(sign / distance * offset) : outward;
  k.unit_tangent = -turn(k.normal);
  k.gap = sign * std::max(distance, tiny);
  k.d_gap = gap_variation(k.normal);
  k.d_angle.p = -k.unit_tangent / k.gap;
  return k;
}

}  // namespace osculate::contact
