#include "osculate/material/neo_hooke.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "osculate/material/stretch.hpp"

namespace osculate::material {
namespace {

/// The plane part of C is positive definite. False for NaN.
bool plane_is_positive(const Strain& e) { return plane_determinant(e) > 0 && 1 + 2 * e[0] > 0; }

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
