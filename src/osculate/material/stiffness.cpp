#include "osculate/material/stiffness.hpp"

#include "osculate/material/condense.hpp"

namespace osculate::material {

Response proportional_plane_stress(const Tangent3& d, const Strain& strain, double& strain_33) {
  Strain free = strain;
  free[2] = 0;
  const Response held = proportional<4>(d, free);
  strain_33 = -held.stress[2] / d(2, 2);
  Response r = without_stress_across(held);
  r.stress = r.tangent * free;
  return r;
}

Isotropic mean_of_directions(const Tangent3& d) {
  const double along = d.diagonal().head<3>().sum(), shear = d.diagonal().tail<3>().sum();
  const double across = d(0, 1) + d(1, 2) + d(0, 2);
  const double bulk = (along + 2 * across) / 9, mu = (along - across + 3 * shear) / 15;
  return {9 * bulk * mu / (3 * bulk + mu), (3 * bulk - 2 * mu) / (2 * (3 * bulk + mu))};
}

std::optional<int> first_not_positive(const Tangent3& d) {
  constexpr double rounding = 1e-14;
  Tangent3 left = d;
  for (int k = 0; k < 6; ++k) {
    if (!(left(k, k) > rounding * d(k, k)) || !(d(k, k) > 0)) return k;
    const Tangent3 taken = left.col(k) * left.row(k) / left(k, k);
    left -= taken;
  }
  return std::nullopt;
}

}  // namespace osculate::material
