#pragma once
// What impacts leave: on a spring that returns the share e^2 of its work, and on a spring and a
// damper that do not pull.
#include <algorithm>
#include <cmath>
#include <numbers>

namespace osculate::verification {

/// A mass on a spring k that loads with k and unloads with k / e^2.
struct PlasticSpring {
  double mass = 1, stiffness = 1, restitution = 1;
};

/// Formula    (1 + e) pi / 2 sqrt(m / k): a quarter of a period there, a quarter of one with
///            k / e^2 back
inline double contact_duration(const PlasticSpring& s) {
  return 0.5 * std::numbers::pi * (1 + s.restitution) * std::sqrt(s.mass / s.stiffness);
}

/// Highest point after a fall from `height` under gravity, over the floor.
///
/// Formula    e^2 h - (1 - e^2) x ,  x = d + sqrt(d^2 + 2 d h) the largest penetration, d = m g / k
/// Derivation the spring returns e^2 k x^2 / 2 and lets go at the penetration x (1 - e^2), where
///            the speed is e sqrt(2 g h): k x^2 / 2 = m g (h + x)
/// Requires   a rebound: the result is above -x (1 - e^2) by e^2 h
inline double next_height(const PlasticSpring& s, double gravity, double height) {
  const double d = s.mass * gravity / s.stiffness;
  const double x = d + std::sqrt(d * d + 2 * d * height);
  const double back = s.restitution * s.restitution;
  return back * height - (1 - back) * x;
}

/// Speed after an impact over that before, on a spring k and a damper c that are let go where they
/// would pull.
///
/// Formula    exp(-z / sqrt(1 - z^2) (pi - 2 asin z)) ,  z = c / (2 sqrt(k m)) < 1 : with
///            x = v / w exp(-z p t) sin(w t), p^2 = k / m, w = p sqrt(1 - z^2), k x + c x' vanishes
///            first at w t = pi - 2 asin z, where x' = -v exp(-z p t)
/// Source     SchwagerPoeschel2007 (linear dashpot without attraction)
inline double rebound(double z) {
  return std::exp(-z / std::sqrt(1 - z * z) * (std::numbers::pi - 2 * std::asin(z)));
}

/// Speeds after a central impact of two bodies.
struct TwoSpeeds {
  double first = 0, second = 0;
};

/// Formula    v_i' = (m_1 v_1 + m_2 v_2 -+ e m_j (v_1 - v_2)) / (m_1 + m_2): momentum is kept, and
/// the speed of
///            parting is e times that of approach
/// Source     Goldsmith1960
inline TwoSpeeds after_impact(double m1, double v1, double m2, double v2, double e) {
  const double common = (m1 * v1 + m2 * v2) / (m1 + m2), apart = e * (v1 - v2) / (m1 + m2);
  return {common - m2 * apart, common + m1 * apart};
}

/// Formula    (1 - e^2) m_red (v_1 - v_2)^2 / 2 ,  1 / m_red = 1 / m_1 + 1 / m_2
inline double energy_lost(double m1, double v1, double m2, double v2, double e) {
  return 0.5 * (1 - e * e) * m1 * m2 / (m1 + m2) * (v1 - v2) * (v1 - v2);
}

/// A rigid body falls without spin and hits with one point, `arm` beside its centre.
struct SlantHit {
  double speed = 0;  ///< of the centre after the impact, upwards
  double spin = 0;   ///< positive: the side of the point goes up
};

/// Formula    J (1 / m + a^2 / I) = (1 + e) v ,  v' = -v + J / m , w' = J a / I
/// Source     Stronge1990 (without friction the works of the impulse are in the ratio e^2 where its
///            speeds are in the ratio e)
inline SlantHit after_slant_hit(double mass, double inertia, double arm, double speed, double e) {
  const double impulse = (1 + e) * speed / (1 / mass + arm * arm / inertia);
  return {-speed + impulse / mass, impulse * arm / inertia};
}

}  // namespace osculate::verification
