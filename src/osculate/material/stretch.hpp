#pragma once
// Right Cauchy-Green tensor C = I + 2 E in the working components 11, 22, 33, 12 (23, 13) of a
// strain E.
#include <array>
#include <cmath>

#include "osculate/material/response.hpp"

namespace osculate::material {

/// det C of the plane part.
template <int N>
[[nodiscard]] double plane_determinant(const Vec<N>& e) {
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

/// det C - 1 in space, without cancellation at small strain.
[[nodiscard]] inline double determinant_change(const Strain3& e) {
  const double a = 2 * e[0], b = 2 * e[1], c = 2 * e[2], d = e[3], f = e[4], g = e[5];
  return a + b + c + a * b + b * c + c * a - d * d - f * f - g * g + a * b * c + 2 * d * f * g -
         a * f * f - b * g * g - c * d * d;
}

[[nodiscard]] inline double log_volume_ratio(const Strain3& e) {
  const double change = determinant_change(e);
  return 0.5 * (std::abs(change) < 0.5 ? std::log1p(change) : std::log(1 + change));
}

/// det C - 1 where C33 is free and no shear goes across the plane.
[[nodiscard]] inline double determinant_change(const Strain& e) {
  const double plane = 2 * (e[0] + e[1]) + 4 * e[0] * e[1] - e[3] * e[3];
  return plane + 2 * e[2] * (1 + plane);
}

[[nodiscard]] inline Vec<6> inverse_stretch(const Strain3& e) {
  const double c11 = 1 + 2 * e[0], c22 = 1 + 2 * e[1], c33 = 1 + 2 * e[2];
  const double c12 = e[3], c23 = e[4], c13 = e[5];
  const double scale = 1 / (1 + determinant_change(e));
  return {scale * (c22 * c33 - c23 * c23), scale * (c11 * c33 - c13 * c13),
          scale * (c11 * c22 - c12 * c12), scale * (c13 * c23 - c12 * c33),
          scale * (c12 * c13 - c23 * c11), scale * (c12 * c23 - c13 * c22)};
}

/// C is positive definite. False for NaN.
[[nodiscard]] inline bool is_positive(const Strain3& e) {
  return 1 + 2 * e[0] > 0 && plane_determinant(e) > 0 && 1 + determinant_change(e) > 0;
}

/// I - C^-1 = 2 E C^-1 in six components.
[[nodiscard]] inline Vec<6> inverse_change(const Strain3& e, const Vec<6>& inv) {
  return {2 * e[0] * inv[0] + e[3] * inv[3] + e[5] * inv[5],
          e[3] * inv[3] + 2 * e[1] * inv[1] + e[4] * inv[4],
          e[5] * inv[5] + e[4] * inv[4] + 2 * e[2] * inv[2],
          -inv[3],
          -inv[4],
          -inv[5]};
}

/// Derivative of -C^-1 with respect to E, over two: the symmetrised square of C^-1.
[[nodiscard]] inline Tangent3 square(const Vec<6>& inv) {
  constexpr std::array<std::array<int, 3>, 3> place{{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}}};
  constexpr std::array<std::array<std::size_t, 2>, 6> axes{
      {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};
  const auto at = [&](std::size_t i, std::size_t j) { return inv[place[i][j]]; };
  Tangent3 t;
  for (std::size_t a = 0; a < 6; ++a)
    for (std::size_t b = 0; b <= a; ++b) {
      const auto [i, j] = axes[a];
      const auto [k, l] = axes[b];
      const auto row = static_cast<Eigen::Index>(a), column = static_cast<Eigen::Index>(b);
      t(row, column) = t(column, row) = 0.5 * (at(i, k) * at(j, l) + at(i, l) * at(j, k));
    }
  return t;
}

/// I - C^-1 = 2 C^-1 E, which keeps all digits at small strain.
[[nodiscard]] inline Vec<4> inverse_change(const Strain& e, double strain_33, double c33) {
  const double c11 = 1 + 2 * e[0], c22 = 1 + 2 * e[1], c12 = e[3];
  return Vec<4>(2 * e[0] * c22 - c12 * c12, 2 * e[1] * c11 - c12 * c12, 0, c12) /
             plane_determinant(e) +
         Vec<4>(0, 0, 2 * strain_33 / c33, 0);
}

/// Derivative of -C^-1 with respect to E, over two: the symmetrised square of C^-1.
[[nodiscard]] inline Tangent square(const Vec<4>& inv) {
  Tangent t;
  t << inv[0] * inv[0], inv[3] * inv[3], 0, inv[0] * inv[3],  //
      inv[3] * inv[3], inv[1] * inv[1], 0, inv[1] * inv[3],   //
      0, 0, inv[2] * inv[2], 0,                               //
      inv[0] * inv[3], inv[1] * inv[3], 0, 0.5 * (inv[0] * inv[1] + inv[3] * inv[3]);
  return t;
}

}  // namespace osculate::material
