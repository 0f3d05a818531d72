#include "osculate/material/rubber.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "osculate/material/free_thickness.hpp"

namespace osculate::material {
namespace {

/// Invariants of C less their values without strain, which keeps digits at small strain.
struct Invariants {
  bool ok = false;
  double first = 0, second = 0;          ///< tr C - 3, ((tr C)^2 - tr C^2) / 2 - 3
  double log_j = 0;                      ///< ln J
  double bar_first = 0, bar_second = 0;  ///< I1 - 3, I2 - 3 without the change of volume
};

Invariants invariants_of(const Strain3& e) {
  Invariants v;
  v.ok = is_positive(e);
  if (!v.ok) return v;
  v.first = 2 * (e[0] + e[1] + e[2]);
  v.second = 2 * v.first + 4 * (e[0] * e[1] + e[1] * e[2] + e[2] * e[0]) - e[3] * e[3] -
             e[4] * e[4] - e[5] * e[5];
  v.log_j = log_volume_ratio(e);
  v.bar_first = std::expm1(-2.0 / 3 * v.log_j) * (3 + v.first) + v.first;
  v.bar_second = std::expm1(-4.0 / 3 * v.log_j) * (3 + v.second) + v.second;
  return v;
}

/// W and its derivatives with respect to the invariants and J.
struct Derivatives {
  double energy, d1, d2, d11, d12, d22, dj, djj;
};

Derivatives derivatives(const Rubber& c, const Invariants& v) {
  const double a = v.bar_first, b = v.bar_second, j = std::expm1(v.log_j);
  Derivatives w{};
  w.energy = c.c10 * a + c.c01 * b + c.c20 * a * a + c.c11 * a * b + c.c02 * b * b +
             c.c30 * a * a * a + c.c21 * a * a * b + c.c12 * a * b * b + c.c03 * b * b * b;
  w.d1 = c.c10 + 2 * c.c20 * a + c.c11 * b + 3 * c.c30 * a * a + 2 * c.c21 * a * b + c.c12 * b * b;
  w.d2 = c.c01 + c.c11 * a + 2 * c.c02 * b + c.c21 * a * a + 2 * c.c12 * a * b + 3 * c.c03 * b * b;
  w.d11 = 2 * c.c20 + 6 * c.c30 * a + 2 * c.c21 * b;
  w.d12 = c.c11 + 2 * c.c21 * a + 2 * c.c12 * b;
  w.d22 = 2 * c.c02 + 2 * c.c12 * a + 6 * c.c03 * b;
  const double square = j * j;
  double power = 1;  // (J - 1)^(2 k - 2)
  int n = 2;
  for (const double d : {c.d1, c.d2, c.d3}) {
    if (d > 0) {
      w.energy += power * square / d;
      w.dj += n * power * j / d;
      w.djj += n * (n - 1) * power / d;
    }
    power *= square;
    n += 2;
  }
  return w;
}

/// S = dW/dE by the derivatives of the invariants
///   dI1/dE = 2 J^(-2/3) (I - tr C / 3 C^-1) ,
///   dI2/dE = 2 J^(-4/3) (tr C I - C - 2/3 I2(C) C^-1) ,  dJ/dE = J C^-1 .
Response3 whole_response(const Rubber& law, const Strain3& e) {
  Response3 r;
  const Invariants v = invariants_of(e);
  r.ok = v.ok;
  if (!r.ok) return r;
  const Derivatives w = derivatives(law, v);
  const Vec<6> inv = inverse_stretch(e), one(1, 1, 1, 0, 0, 0);
  const Vec<6> twice(2 * e[0], 2 * e[1], 2 * e[2], e[3], e[4], e[5]);  // C - I
  const Vec<6> change = inverse_change(e, inv);                        // I - C^-1
  const double j = std::exp(v.log_j);
  const double f1 = 2 * std::exp(-2.0 / 3 * v.log_j), f2 = 2 * std::exp(-4.0 / 3 * v.log_j);
  const Vec<6> a1 = f1 * (change - v.first / 3 * inv);
  const Vec<6> a2 = f2 * (2 * change + v.first * one - twice - 2.0 / 3 * v.second * inv);
  r.stress = w.d1 * a1 + w.d2 * a2 + w.dj * j * inv;

  const Tangent3 squared = square(inv), inverses = inv * inv.transpose();
  Vec<6> d_of_c(2, 2, 2, 1, 1, 1);  // derivative of C
  const double first = 3 + v.first, second = 3 + v.second;
  const Vec<6> slope = (2 + v.first) * one - twice;  // tr C I - C
  const auto mixed = [](const Vec<6>& x, const Vec<6>& y) -> Tangent3 {
    return x * y.transpose() + y * x.transpose();
  };
  r.tangent = w.d11 * a1 * a1.transpose() + w.d12 * mixed(a1, a2) + w.d22 * a2 * a2.transpose() +
              w.djj * j * j * inverses + w.dj * j * (inverses - 2 * squared);
  r.tangent +=
      w.d1 * f1 *
      (-2.0 / 3 * mixed(one, inv) + 2.0 / 9 * first * inverses + 2.0 / 3 * first * squared);
  Tangent3 second_part = -4.0 / 3 * mixed(slope, inv) + 8.0 / 9 * second * inverses +
                         4.0 / 3 * second * squared + 2 * one * one.transpose();
  second_part.diagonal() -= d_of_c;
  r.tangent += w.d2 * f2 * second_part;
  return r;
}

}  // namespace

Isotropic unloaded(const Rubber& law) {
  const double mu = 2 * (law.c10 + law.c01), bulk = 2 / law.d1;
  return {9 * bulk * mu / (3 * bulk + mu), (3 * bulk - 2 * mu) / (2 * (3 * bulk + mu))};
}

double energy_of(const Rubber& law, const Strain3& e) {
  const Invariants v = invariants_of(e);
  return v.ok ? derivatives(law, v).energy : std::numeric_limits<double>::infinity();
}
double energy_of(const Rubber& law, const Strain& e) { return energy_of(law, in_space(e)); }

Response3 respond(const Rubber& law, const Strain3& e) { return whole_response(law, e); }
Response respond(const Rubber& law, const Strain& e) {
  return in_plane(whole_response(law, in_space(e)));
}

Response respond_plane_stress(const Rubber& law, const Strain& strain, double& strain_33) {
  return find_free_thickness(law, strain, 1, strain_33);
}

}  // namespace osculate::material
