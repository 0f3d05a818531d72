#pragma once
// Discs that friction slows down: a flat one that spins on its face, and an upright one that is set
// on a line spinning and slides until it rolls.
#include <algorithm>
#include <cmath>

namespace osculate::verification {

/// A flat disc or ring on a plane, pressed on it by a uniform pressure, turning about its axis.
struct FlatDisc {
  double radius = 1;
  double hole = 0;  ///< inner radius
  double mass = 1;
  double force = 1;  ///< N, normal to the plane
  double friction = 0.3;
  double rate = 1;  ///< at the start
};

/// Formula    M = 2/3 mu N (R^3 - r^3) / (R^2 - r^2): mu p rho integrated over the ring
inline double friction_torque(const FlatDisc& disc) {
  const double R = disc.radius, r = disc.hole;
  return 2.0 / 3 * disc.friction * disc.force * (R * R + R * r + r * r) / (R + r);
}

/// m (R^2 + r^2) / 2
inline double inertia(const FlatDisc& disc) {
  return 0.5 * disc.mass * (disc.radius * disc.radius + disc.hole * disc.hole);
}

/// J w / M; without a hole 3 m R w / (4 mu N).
inline double stop_time(const FlatDisc& disc) {
  return inertia(disc) * disc.rate / friction_torque(disc);
}

struct Spin {
  double angle = 0;
  double rate = 0;
};

/// Coulomb's friction does not depend on the speed: the rate falls linearly, and then it is zero.
inline Spin spin_at(const FlatDisc& disc, double time) {
  const double end = stop_time(disc);
  if (time >= end) return {0.5 * disc.rate * end, 0};
  return {disc.rate * time * (1 - 0.5 * time / end), disc.rate * (1 - time / end)};
}

/// Work of friction until the time; in the end the whole J w^2 / 2.
inline double dissipated(const FlatDisc& disc, double time) {
  return friction_torque(disc) * spin_at(disc, time).angle;
}

/// A body with a round rim, upright on a horizontal line: x along the line, turning positive as for
/// rolling towards +x.
struct Wheel {
  double radius = 1;
  double mass = 1;
  double shape = 0.5;  ///< J / (m R^2): 1/2 disc or cylinder, 2/5 ball, 1 hoop
  double gravity = 9.81;
  double friction = 0.3;
  double speed = 0;  ///< at the start
  double rate = 1;   ///< at the start
};

struct WheelState {
  double x = 0, speed = 0, angle = 0, rate = 0;
};

/// v - w R: of the rim over the line.
inline double sliding_speed(const Wheel& wheel) { return wheel.speed - wheel.rate * wheel.radius; }

/// Formula    abs(v - w R) / (mu g (1 + m R^2 / J)); a disc set down spinning: w R / (3 mu g)
inline double rolling_time(const Wheel& wheel) {
  return std::abs(sliding_speed(wheel)) / (wheel.friction * wheel.gravity * (1 + 1 / wheel.shape));
}

/// Sliding with the force mu m g against the motion of the rim until the rolling time, then
/// rolling.
inline WheelState wheel_at(const Wheel& wheel, double time) {
  const double slide = std::min(time, rolling_time(wheel)), roll = time - slide;
  const double push = -std::copysign(wheel.friction * wheel.gravity, sliding_speed(wheel));
  const double spin = -push / (wheel.shape * wheel.radius);
  WheelState s{wheel.speed * slide + 0.5 * push * slide * slide, wheel.speed + push * slide,
               wheel.rate * slide + 0.5 * spin * slide * slide, wheel.rate + spin * slide};
  s.x += s.speed * roll;
  s.angle += s.rate * roll;
  return s;
}

inline double kinetic_energy(const Wheel& wheel, const WheelState& s) {
  const double rim = s.rate * wheel.radius;
  return 0.5 * wheel.mass * (s.speed * s.speed + wheel.shape * rim * rim);
}

/// Until it rolls: m u^2 / (2 (1 + m R^2 / J)), u the sliding speed at the start. A disc set down
/// spinning loses two thirds of its energy.
inline double dissipated(const Wheel& wheel) {
  const double u = sliding_speed(wheel);
  return 0.5 * wheel.mass * u * u / (1 + 1 / wheel.shape);
}

}  // namespace osculate::verification
