#include "osculate/material/linear_elastic.hpp"

namespace osculate::material {

Response hooke_plane_stress(double young, double poisson, const Strain& strain, double& strain_33) {
  strain_33 = -poisson / (1 - poisson) * (strain[0] + strain[1]);
  const double factor = young / (1 - poisson * poisson);
  Response r;
  r.tangent(0, 0) = r.tangent(1, 1) = factor;
  r.tangent(0, 1) = r.tangent(1, 0) = poisson * factor;
  r.tangent(3, 3) = 0.5 * young / (1 + poisson);
  r.stress = r.tangent * strain;
  return r;
}

}  // namespace osculate::material
