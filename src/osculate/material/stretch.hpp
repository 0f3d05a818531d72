#pragma once
// Right Cauchy-Green tensor C = I + 2 E in the working components 11, 22, 33, 12 of a strain E.
#include <cmath>

#include "osculate/material/response.hpp"

namespace osculate::material {

/// det C of the plane part.
[[nodiscard]] inline double plane_determinant(const Strain& e) {
  return (1 + 2 * e[0]) * (1 + 2 * e[1]) - e[3] * e[3];
}

/// Its logarithm, without cancellation at small strain.
[[nodiscard]] inline double log_plane_determinant(const Strain& e) {
  const double change = 2 * (e[0] + e[1]) + 4 * e[0] * e[1] - e[3] * e[3];
  return std::abs(change) < 0.5 ? std::log1p(change) : std::log(plane_determinant(e));
}

/// ln J = ln det F, without cancellation at small strain. Requires det C > 0.
[[nodiscard]] inline double log_volume_ratio(const Strain& e) {
  return 0.5 * (log_plane_determinant(e) + std::log1p(2 * e[2]));
}

/// C^-1 with the given C33.
[[nodiscard]] inline Vec<4> inverse_stretch(const Strain& e, double c33) {
  const double plane = plane_determinant(e);
  return {(1 + 2 * e[1]) / plane, (1 + 2 * e[0]) / plane, 1 / c33, -e[3] / plane};
}

}  // namespace osculate::material
