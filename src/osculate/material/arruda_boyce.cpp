#include "osculate/material/arruda_boyce.hpp"

#include <array>
#include <cmath>

namespace osculate::material {
namespace {

/// Factors of the series of the inverse Langevin function.
constexpr std::array<double, 5> chain_factors{1.0 / 2, 1.0 / 20, 11.0 / 1050, 19.0 / 7000,
                                              519.0 / 673750};

}  // namespace

ByInvariants by_invariants(const ArrudaBoyce& law, const Invariants& v) {
  ByInvariants w;
  const double a = v.bar_first, first = 3 + a, shrink = 1 / (law.lambda_m * law.lambda_m);
  double factor = law.mu;               // mu / lambda_m^(2 i - 2)
  double power = 1, below = 0;          // I1^(i-1), I1^(i-2)
  double difference = 0, of_three = 1;  // I1^(i-1) - 3^(i-1), 3^(i-1)
  for (std::size_t k = 0; k < chain_factors.size(); ++k) {
    const auto i = static_cast<double>(k + 1);
    const double c = factor * chain_factors[k];
    difference = difference * first + of_three * a;
    of_three *= 3;
    w.energy += c * difference;
    w.d1 += c * i * power;
    w.d11 += c * i * (i - 1) * below;
    below = power;
    power *= first;
    factor *= shrink;
  }
  w.volume = (std::expm1(2 * v.log_j) / 2 - v.log_j) / law.d;
  w.dj = 2 * std::sinh(v.log_j) / law.d;
  w.djj = (1 + std::exp(-2 * v.log_j)) / law.d;
  return w;
}

Isotropic unloaded(const ArrudaBoyce& law) {
  return isotropic_of(2 * by_invariants(law, Invariants{}).d1, 2 / law.d);
}

}  // namespace osculate::material
