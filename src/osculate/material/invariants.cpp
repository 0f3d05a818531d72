#include "osculate/material/invariants.hpp"

#include <cmath>

namespace osculate::material {

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

Response3 response_of_invariants(const Strain3& e, const Invariants& v, const ByInvariants& w) {
  Response3 r;
  const Vec<6> inv = inverse_stretch(e), one(1, 1, 1, 0, 0, 0);
  const Vec<6> twice(2 * e[0], 2 * e[1], 2 * e[2], e[3], e[4], e[5]);  // C - I
  const Vec<6> change = inverse_change(e, inv);                        // I - C^-1
  const double j = std::exp(v.log_j);
  const double f1 = 2 * std::exp(-2.0 / 3 * v.log_j), f2 = 2 * std::exp(-4.0 / 3 * v.log_j);
  const Vec<6> a1 = f1 * (change - v.first / 3 * inv);
  const Vec<6> a2 = f2 * (2 * change + v.first * one - twice - 2.0 / 3 * v.second * inv);
  r.stress = w.d1 * a1 + w.d2 * a2 + w.dj * j * inv;

  const Tangent3 squared = square(inv), inverses = inv * inv.transpose();
  const Vec<6> d_of_c(2, 2, 2, 1, 1, 1);  // derivative of C
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

}  // namespace osculate::material
