#include "osculate/material/norton.hpp"

#include <cmath>

#include "osculate/material/over_temperature.hpp"
#include "osculate/material/power_flow.hpp"
#include "osculate/material/radial_return.hpp"

namespace osculate::material {
namespace {

constexpr std::size_t dissipation = 7;  ///< among what is remembered

}  // namespace

Response3 respond(const Norton& over, const Strain3& strain, Memory memory) {
  const Norton law = at_point(over, memory);
  const Lame c = lame(law.young, law.poisson);
  Inelastic now = inelastic_of(memory.committed);
  Response3 r = elastic_predictor(c, elastic_strain(strain, now.strain));
  const Vec<6> s = deviator(r.stress);
  const double size = tensor_norm(s), predictor = std::sqrt(1.5) * size;
  const double stiffness = 3 * c.mu;
  const auto [q, lost, slope] =
      left_of(predictor, stiffness * memory.duration * law.rate, law.exponent);
  r.ok = std::isfinite(q);
  double work = memory.committed ? memory.committed[dissipation] : 0;
  if (lost > 0) {
    const double increment = lost / stiffness;
    const Vec<6> direction = s / size, step = std::sqrt(1.5) * increment * direction;
    now.equivalent += increment;
    now.strain += step;
    work += q * increment;
    return_radially(c.mu, step, direction, 1 - q / predictor, q / predictor - slope, r);
  }
  remember(now, memory);
  if (memory.next) memory.next[dissipation] = work;
  return r;
}

Response respond(const Norton& law, const Strain& strain, Memory memory) {
  return in_plane(respond(law, in_space(strain), memory));
}

Response respond_plane_stress(const Norton& law, const Strain& strain, double& strain_33,
                              Memory memory) {
  return return_in_plane_stress(law, strain, strain_33, memory);
}

double energy_of(const Norton& law, const Strain3& strain, const Memory& memory) {
  const Norton here = at_point(law, memory);
  const Lame c = lame(here.young, here.poisson);
  const Vec<6> elastic = elastic_strain(strain, inelastic_of(memory.committed).strain);
  const double trace = elastic.head<3>().sum(), size = tensor_norm(elastic);
  return 0.5 * c.lambda * trace * trace + c.mu * size * size;
}

double dissipated_by(const Norton&, const double* state) { return state ? state[dissipation] : 0; }

}  // namespace osculate::material
