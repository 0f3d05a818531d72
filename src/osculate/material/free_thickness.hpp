#pragma once
#include <algorithm>
#include <cmath>

#include "osculate/material/condense.hpp"
#include "osculate/material/stretch.hpp"

namespace osculate::material {

/// S33 = 0 of a law in finite strain, by Newton to round-off for E33; it begins with C33 =
/// det(C of the plane)^-share, 1 for what keeps its volume.
///
/// Returns    not ok if the area of the plane is not positive, or if no thickness is found
template <class T>
[[nodiscard]] Response find_free_thickness(const T& law, const Strain& strain, double share,
                                           double& strain_33) {
  Response r;
  Strain e = strain;
  const double area = plane_determinant(e);
  r.ok = area > 0 && 1 + 2 * e[0] > 0;
  if (!r.ok) return r;
  constexpr double round_off = 1e-14;
  constexpr int most = 100;
  e[2] = 0.5 * std::expm1(-share * log_plane_determinant(e));
  for (int i = 0;; ++i) {
    r = respond(law, e);
    if (!r.ok || !(r.tangent(2, 2) > 0) || i == most) return {false, {}, {}};
    const double c33 = 1 + 2 * e[2];
    // as a change of ln C33, which leaves C33 positive
    const double step = -2 * r.stress[2] / (r.tangent(2, 2) * c33);
    if (std::abs(step) <= round_off * (1 + std::abs(std::log(c33)))) break;
    e[2] += 0.5 * c33 * std::expm1(std::clamp(step, -1.0, 1.0));
  }
  strain_33 = e[2];
  // the round-off that is left of S33 is one of a pressure, which the plane has as well
  r.stress -= r.tangent.col(2) * (r.stress[2] / r.tangent(2, 2));
  return without_stress_across(r);
}

}  // namespace osculate::material
