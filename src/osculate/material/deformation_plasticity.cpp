#include "osculate/material/deformation_plasticity.hpp"

#include <cmath>

#include "osculate/material/power_flow.hpp"
#include "osculate/material/radial_return.hpp"

namespace osculate::material {
namespace {

/// Factor c of q + c q^n = q_tr.
double factor_of(const DeformationPlasticity& law) {
  const Lame c = lame(law.young, law.poisson);
  return 3 * c.mu * law.offset / law.young * std::pow(law.yield, 1 - law.exponent);
}

}  // namespace

Response3 respond(const DeformationPlasticity& law, const Strain3& strain, Memory) {
  const Lame c = lame(law.young, law.poisson);
  Response3 r = elastic_predictor(c, elastic_strain(strain, Vec<6>::Zero()));
  const Vec<6> s = deviator(r.stress);
  const double size = tensor_norm(s), predictor = std::sqrt(1.5) * size;
  const auto [q, lost, slope] = left_of(predictor, factor_of(law), law.exponent);
  r.ok = std::isfinite(q) && std::isfinite(predictor);
  if (!r.ok || !(lost > 0)) return r;
  const double along = q / predictor - slope;
  return_radially(c.mu, (1 - q / predictor) / (2 * c.mu) * s, s / size, 1 - q / predictor, along,
                  r);
  return r;
}

Response respond(const DeformationPlasticity& law, const Strain& strain, Memory memory) {
  return in_plane(respond(law, in_space(strain), memory));
}

Response respond_plane_stress(const DeformationPlasticity& law, const Strain& strain,
                              double& strain_33, Memory memory) {
  Strain e = strain;
  e[2] = -law.poisson / (1 - law.poisson) * (e[0] + e[1]);
  return without_stress_across(law, e, strain_33, memory);
}

double energy_of(const DeformationPlasticity& law, const Strain3& strain, const Memory&) {
  const Lame c = lame(law.young, law.poisson);
  const Vec<6> e = elastic_strain(strain, Vec<6>::Zero());
  const double trace = e.head<3>().sum(), bulk = c.lambda + 2 * c.mu / 3;
  const double predictor = std::sqrt(6.0) * c.mu * tensor_norm(deviator(e));
  const auto [q, lost, slope] = left_of(predictor, factor_of(law), law.exponent);
  const double n = law.exponent;
  return 0.5 * bulk * trace * trace + (0.5 * q + n / (n + 1) * lost) * q / (3 * c.mu);
}

}  // namespace osculate::material
