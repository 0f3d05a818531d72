#pragma once
#include "osculate/material/response.hpp"

namespace osculate::material {

/// Hooke's law between stress and small strain.
///
/// Formula    sigma = lambda tr(eps) I + 2 mu eps
/// Units      young: force/length^2
/// Requires   E > 0, -1 < nu < 0.5
/// Tested by  tests/unit/material/test_laws.cpp
struct LinearElastic {
  static constexpr std::string_view key = "linear_elastic";
  static constexpr std::string_view doc = "Hooke's law between stress and small strain";
  static constexpr bool finite_strain = false;
  double young = 0, poisson = 0, density = 0;
  static constexpr auto params() { return isotropic_params<LinearElastic>(); }
};

[[nodiscard]] Response hooke(double young, double poisson, const Strain& strain);
/// Hooke's law with S33 = 0, in closed form: no digits are lost for nu near 0.5.
[[nodiscard]] Response hooke_plane_stress(double young, double poisson, const Strain& strain,
                                          double& strain_33);

[[nodiscard]] inline Response respond(const LinearElastic& law, const Strain& strain) {
  return hooke(law.young, law.poisson, strain);
}
[[nodiscard]] inline Response respond_plane_stress(const LinearElastic& law, const Strain& strain,
                                                   double& strain_33) {
  return hooke_plane_stress(law.young, law.poisson, strain, strain_33);
}

}  // namespace osculate::material
