#pragma once
#include "osculate/core/types.hpp"
#include "osculate/geometry/curve_jet.hpp"
#include "osculate/projection/feature.hpp"

namespace osculate::contact {

/// A linear form in the three relative variations of a contact point:
///   value = p . (sum_k w_k du_k) + q . (sum_k w'_k du_k) + r . (sum_k w''_k du_k) ,
/// where w are the contact weights (slave shape values, then minus the master shape values) and
/// w', w'' their derivatives with respect to xi (zero for slave nodes).
struct Form {
  Vec2 p = Vec2::Zero(), q = Vec2::Zero(), r = Vec2::Zero();

  Form& operator+=(const Form& o) {
    p += o.p, q += o.q, r += o.r;
    return *this;
  }
  friend Form operator+(Form a, const Form& b) { return a += b; }
  friend Form operator*(double s, const Form& a) { return {s * a.p, s * a.q, s * a.r}; }
};

/// Everything the contact terms need to know of one slave point and its foot point.
///
/// Formula    zeta = (r_s - rho) . nu ,  g = a11 - zeta h11
/// Sign       zeta < 0 is penetration; nu = k x rho_xi / |rho_xi| points out of the master
/// Units      gap: length; a11: length^2 / xi^2; h11: length / xi^2
/// Frame      current configuration
struct Kinematics {
  projection::Feature feature = projection::Feature::none;
  double gap = 0;           ///< zeta
  Vec2 normal{0, 1};        ///< nu
  Vec2 unit_tangent{1, 0};  ///< tau = rho_xi / |rho_xi|
  double a11 = 1, sqrt_a11 = 1, h11 = 0, kappa = 0;
  double g = 1;  ///< a11 - zeta h11 > 0 where the projection is a strict minimum
  Vec2 rho2 = Vec2::Zero(), rho3 = Vec2::Zero();  ///< rho_xixi, rho_xixixi
  Form d_xi;     ///< variation of the convective coordinate (zero at a corner)
  Form d_gap;    ///< variation of zeta
  Form d_angle;  ///< rotation of the moving frame: d(tau) = nu d_angle, d(nu) = -tau d_angle
};

/// Kinematics at a foot point inside a facet: closest point condition satisfied by `jet`.
[[nodiscard]] Kinematics face_kinematics(const geometry::CurveJet<2>& jet, const Vec2& slave);

/// Kinematics at a vertex of the master where no neighbouring facet holds the projection.
/// `outward` is the averaged normal of the two neighbours: it fixes the sign of the gap and is the
/// normal itself when the slave point coincides with the vertex.
[[nodiscard]] Kinematics corner_kinematics(const Vec2& vertex, const Vec2& slave,
                                           const Vec2& outward);

}  // namespace osculate::contact
