#include "osculate/material/neo_hooke.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "osculate/material/stretch.hpp"

namespace osculate::material {
namespace {

/// The plane part of C is positive definite. False for NaN.
bool plane_is_positive(const Strain& e) { return plane_determinant(e) > 0 && 1 + 2 * e[0] > 0; }

/// I - C^-1 = 2 C^-1 E, which keeps all digits at small strain.
Vec<4> inverse_change(const Strain& e, double strain_33, double c33) {
  const double c11 = 1 + 2 * e[0], c22 = 1 + 2 * e[1], c12 = e[3];
  return Vec<4>(2 * e[0] * c22 - c12 * c12, 2 * e[1] * c11 - c12 * c12, 0, c12) /
             plane_determinant(e) +
         Vec<4>(0, 0, 2 * strain_33 / c33, 0);
}

/// Derivative of -C^-1 with respect to E, over two: the symmetrised square of C^-1.
Tangent square(const Vec<4>& inv) {
  Tangent t;
  t << inv[0] * inv[0], inv[3] * inv[3], 0, inv[0] * inv[3],  //
      inv[3] * inv[3], inv[1] * inv[1], 0, inv[1] * inv[3],   //
      0, 0, inv[2] * inv[2], 0,                               //
      inv[0] * inv[3], inv[1] * inv[3], 0, 0.5 * (inv[0] * inv[1] + inv[3] * inv[3]);
  return t;
}

/// C is positive definite. False for NaN.
bool is_positive(const Strain3& e) {
  return 1 + 2 * e[0] > 0 && plane_determinant(e) > 0 && 1 + determinant_change(e) > 0;
}

/// I - C^-1 = 2 E C^-1 in six components.
Vec<6> inverse_change(const Strain3& e, const Vec<6>& inv) {
  return {2 * e[0] * inv[0] + e[3] * inv[3] + e[5] * inv[5],
          e[3] * inv[3] + 2 * e[1] * inv[1] + e[4] * inv[4],
          e[5] * inv[5] + e[4] * inv[4] + 2 * e[2] * inv[2],
          -inv[3],
          -inv[4],
          -inv[5]};
}

Tangent3 square(const Vec<6>& inv) {
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

/// y = ln C33 at S33 = 0; false if there is none. Started at y = 0, Newton is monotone from its
/// second iterate on.
bool find_log_c33(const Lame& c, double log_area, double& y) {
  y = 0;
  for (int i = 0; i < 100; ++i) {
    const double slope = c.mu * std::exp(y) + 0.5 * c.lambda;
    if (!(slope > 0)) return false;
    const double step = (c.mu * std::expm1(y) + 0.5 * c.lambda * (log_area + y)) / slope;
    y -= step;
    // quadratic convergence: the step after this one would be below round-off
    if (std::abs(step) <= 1e-9 * std::abs(y)) return true;
  }
  return false;
}

/// What stress and tangent need of a strain.
template <int N>
struct Stretched {
  bool ok = false;
  double log_j = 0;
  Vec<N> inverse, change;  ///< C^-1, I - C^-1
};
Stretched<4> stretched(const Strain& e) {
  const double c33 = 1 + 2 * e[2];
  if (!plane_is_positive(e) || !(c33 > 0)) return {};
  return {true, log_volume_ratio(e), inverse_stretch(e, c33), inverse_change(e, e[2], c33)};
}
Stretched<6> stretched(const Strain3& e) {
  if (!is_positive(e)) return {};
  const Vec<6> inverse = inverse_stretch(e);
  return {true, log_volume_ratio(e), inverse, inverse_change(e, inverse)};
}

template <int N>
Vec<N> stress(const Lame& c, const Stretched<N>& s) {
  return c.mu * s.change + c.lambda * s.log_j * s.inverse;
}
template <int N>
ResponseOf<N> whole_response(const NeoHooke& law, const Stretched<N>& s) {
  const Lame c = lame(law.young, law.poisson);
  ResponseOf<N> r;
  r.ok = s.ok;
  if (!r.ok) return r;
  r.stress = stress(c, s);
  r.tangent = c.lambda * s.inverse * s.inverse.transpose() +
              2 * (c.mu - c.lambda * s.log_j) * square(s.inverse);
  return r;
}
template <int N>
StressOf<N> stress_alone(const NeoHooke& law, const Stretched<N>& s) {
  if (!s.ok) return {false};
  return {true, stress(lame(law.young, law.poisson), s)};
}

/// det C and the trace of E.
double energy(const NeoHooke& law, double determinant, double trace) {
  const Lame k = lame(law.young, law.poisson);
  if (!(determinant > 0)) return std::numeric_limits<double>::infinity();
  const double log_j = 0.5 * std::log(determinant);
  return k.mu * trace - k.mu * log_j + 0.5 * k.lambda * log_j * log_j;
}

}  // namespace

double energy_of(const NeoHooke& law, const Strain& e) {
  return energy(law, 1 + determinant_change(e), e.head<3>().sum());
}
double energy_of(const NeoHooke& law, const Strain3& e) {
  return energy(law, 1 + determinant_change(e), e.head<3>().sum());
}

Response respond(const NeoHooke& law, const Strain& e) { return whole_response(law, stretched(e)); }
Response3 respond(const NeoHooke& law, const Strain3& e) {
  return whole_response(law, stretched(e));
}
StressOf<4> stress_of(const NeoHooke& law, const Strain& e) {
  return stress_alone(law, stretched(e));
}
StressOf<6> stress_of(const NeoHooke& law, const Strain3& e) {
  return stress_alone(law, stretched(e));
}

Response respond_plane_stress(const NeoHooke& law, const Strain& e, double& strain_33) {
  const Lame c = lame(law.young, law.poisson);
  Response r;
  double y = 0;
  r.ok = plane_is_positive(e) && find_log_c33(c, log_plane_determinant(e), y);
  if (!r.ok) return r;
  strain_33 = 0.5 * std::expm1(y);
  const double c33 = std::exp(y);
  Vec<4> inv = inverse_stretch(e, c33);
  inv[2] = 0;
  r.stress = c.mu * inverse_change(e, 0, c33) - 2 * c.mu * strain_33 * inv;
  // the 33 component condensed: lambda becomes 1/(1/lambda + 1/(2 mu C33))
  const double stiff = 2 * c.mu * c33;
  const double softened = c.lambda * stiff / (c.lambda + stiff);
  r.tangent = softened * inv * inv.transpose() + stiff * square(inv);
  return r;
}

}  // namespace osculate::material
