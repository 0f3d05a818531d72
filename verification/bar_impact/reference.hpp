#pragma once
// An elastic bar that flies against a rigid wall: d'Alembert's solution of the wave equation.
#include <algorithm>
#include <cmath>

namespace osculate::verification {

/// Unstressed, at the distance `gap` from the wall, flying towards it. X is the distance of a
/// section from the end that will touch; displacements and velocities are positive towards the
/// wall.
struct ImpactBar {
  double length = 1;
  double area = 1;
  double modulus = 1;  ///< of uniaxial stress: E, or E / (1 - nu^2) in plane strain, or confined
  double density = 1;
  double speed = 1;
  double gap = 0;
};

inline double wave_speed(const ImpactBar& bar) { return std::sqrt(bar.modulus / bar.density); }
inline double touch_time(const ImpactBar& bar) { return bar.gap / bar.speed; }
/// 2 L / c: a wave runs to the free end and back.
inline double contact_duration(const ImpactBar& bar) { return 2 * bar.length / wave_speed(bar); }
/// rho c v, compression
inline double contact_pressure(const ImpactBar& bar) {
  return bar.density * wave_speed(bar) * bar.speed;
}
/// 2 m v, which turns the velocity of the bar
inline double contact_impulse(const ImpactBar& bar) {
  return 2 * bar.density * bar.area * bar.length * bar.speed;
}

/// Force of the wall: A rho c v from the touch until the wave is back, constant.
inline double contact_force(const ImpactBar& bar, double time) {
  const double t = time - touch_time(bar);
  return t >= 0 && t < contact_duration(bar) ? bar.area * contact_pressure(bar) : 0;
}

/// Formula    u = gap + v min(t, X / c) - v max(0, t - (2 L - X) / c), t from the touch: the wave
///            from the wall stops a section at X / c, the one from the free end throws it back
inline double bar_displacement(const ImpactBar& bar, double x, double time) {
  const double t = time - touch_time(bar), c = wave_speed(bar), v = bar.speed;
  return bar.gap + v * std::min(t, x / c) - v * std::max(0.0, t - (2 * bar.length - x) / c);
}

/// v before the first wave, 0 between the two, -v after the second.
inline double bar_velocity(const ImpactBar& bar, double x, double time) {
  const double t = time - touch_time(bar), c = wave_speed(bar);
  if (t < x / c) return bar.speed;
  return t < (2 * bar.length - x) / c ? 0 : -bar.speed;
}

/// -rho c v between the two waves (compression), none else.
inline double bar_stress(const ImpactBar& bar, double x, double time) {
  const double t = time - touch_time(bar), c = wave_speed(bar);
  return t >= x / c && t < (2 * bar.length - x) / c ? -contact_pressure(bar) : 0;
}

/// Of the whole bar: m v^2 / 2 abs(1 - c t / L) in contact; the rest is elastic.
inline double bar_kinetic_energy(const ImpactBar& bar, double time) {
  const double t = std::clamp(time - touch_time(bar), 0.0, contact_duration(bar));
  const double whole = 0.5 * bar.density * bar.area * bar.length * bar.speed * bar.speed;
  return whole * std::abs(1 - wave_speed(bar) * t / bar.length);
}

inline double bar_elastic_energy(const ImpactBar& bar, double time) {
  return bar_kinetic_energy(bar, touch_time(bar)) - bar_kinetic_energy(bar, time);
}

}  // namespace osculate::verification
