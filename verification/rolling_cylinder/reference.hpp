#pragma once
// A round body on an incline, let go at rest: it rolls, or it slides and turns.
#include <cmath>

namespace osculate::verification {

struct InclineRoller {
  double radius = 1;
  double mass = 1;
  double shape = 0.5;  ///< J / (m R^2): 1/2 cylinder or disc, 2/5 ball, 1 hoop
  double gravity = 9.81;
  double slope = 0.3;  ///< angle to the horizontal
  double friction = 0.3;
};

/// What rolling needs: tan(alpha) / (1 + m R^2 / J), a third of the slope for a cylinder.
inline double friction_to_roll(const InclineRoller& r) {
  return std::tan(r.slope) / (1 + 1 / r.shape);
}

inline bool rolls(const InclineRoller& r) { return r.friction >= friction_to_roll(r); }

inline double normal_force(const InclineRoller& r) {
  return r.mass * r.gravity * std::cos(r.slope);
}

/// Up the incline: m g sin(alpha) / (1 + m R^2 / J) if it rolls, else mu N.
inline double friction_force(const InclineRoller& r) {
  return (rolls(r) ? friction_to_roll(r) : r.friction) * normal_force(r);
}

/// Down the incline: g sin(alpha) / (1 + J / (m R^2)) if it rolls, else g (sin - mu cos).
inline double acceleration(const InclineRoller& r) {
  return r.gravity * std::sin(r.slope) - friction_force(r) / r.mass;
}

inline double angular_acceleration(const InclineRoller& r) {
  return friction_force(r) / (r.mass * r.shape * r.radius);
}

struct RollerState {
  double way = 0, speed = 0, angle = 0, rate = 0;
};

inline RollerState roller_at(const InclineRoller& r, double time) {
  const double a = acceleration(r), b = angular_acceleration(r);
  return {0.5 * a * time * time, a * time, 0.5 * b * time * time, b * time};
}

inline double kinetic_energy(const InclineRoller& r, const RollerState& s) {
  const double rim = s.rate * r.radius;
  return 0.5 * r.mass * (s.speed * s.speed + r.shape * rim * rim);
}

/// Work of friction: over the way of the rim along the incline.
inline double dissipated(const InclineRoller& r, double time) {
  const RollerState s = roller_at(r, time);
  return friction_force(r) * (s.way - s.angle * r.radius);
}

}  // namespace osculate::verification
