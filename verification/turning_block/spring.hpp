#pragma once
// What a vibration on the spring of a penalty becomes: closed forms for a mass m on a stiffness k.
#include <cmath>
#include <numbers>

namespace osculate::verification {

/// Formula    T = 2 pi sqrt(m / k)
/// Tested by  tests/unit/verification/test_turning_block.cpp
[[nodiscard]] inline double spring_period(double mass, double stiffness) {
  return 2 * std::numbers::pi * std::sqrt(mass / stiffness);
}

/// Amplitude after a time over that before, with a damper c beside the spring (c^2 < 4 k m).
///
/// Formula    exp(-c t / (2 m))
/// Tested by  as above
[[nodiscard]] inline double damped_share(double mass, double damper, double time) {
  return std::exp(-damper * time / (2 * mass));
}

/// The same after one increment whose contact force is that of its end: u' = u + h v + theta h^2 b,
/// v' = v + h b, b = -(k / m) u', where theta is 1/2 (impact: dissipative) or 1 (plastic). The step
/// has the determinant 1 / (1 + theta k h^2 / m), the square of the amplitude's factor.
///
/// Formula    1 / sqrt(1 + theta k h^2 / m)
/// Tested by  as above
[[nodiscard]] inline double implicit_share(double mass, double stiffness, double step,
                                           double theta) {
  return 1 / std::sqrt(1 + theta * stiffness * step * step / mass);
}

}  // namespace osculate::verification
