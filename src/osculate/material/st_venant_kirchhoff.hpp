#pragma once
#include "osculate/material/linear_elastic.hpp"

namespace osculate::material {

/// Hooke's law between second Piola-Kirchhoff stress and Green-Lagrange strain: large rotations,
/// moderate strains. It softens in compression and has no barrier against det F -> 0.
///
/// Formula    S = lambda tr(E) I + 2 mu E
/// Requires   E > 0, -1 < nu < 0.5
/// Tested by  tests/unit/material/test_laws.cpp
struct StVenantKirchhoff {
  static constexpr std::string_view key = "st_venant_kirchhoff";
  static constexpr std::string_view doc =
      "Hooke's law between second Piola-Kirchhoff stress and Green-Lagrange strain, for large "
      "rotations.";
  static constexpr bool finite_strain = true, large_strain = false, hooke_at_first = true;
  double young = 0, poisson = 0, density = 0;
  core::Table young_over = {}, poisson_over = {};  ///< over the temperature, in place of them
  static constexpr auto params() { return isotropic_params<StVenantKirchhoff>(); }
};

[[nodiscard]] inline Response respond(const StVenantKirchhoff& law, const Strain& strain) {
  return hooke(law.young, law.poisson, strain);
}
[[nodiscard]] inline Response3 respond(const StVenantKirchhoff& law, const Strain3& strain) {
  return hooke(law.young, law.poisson, strain);
}
/// Not ok where the thickness would vanish (1 + 2 E33 <= 0).
[[nodiscard]] inline Response respond_plane_stress(const StVenantKirchhoff& law,
                                                   const Strain& strain, double& strain_33) {
  Response r = hooke_plane_stress(law.young, law.poisson, strain, strain_33);
  r.ok = 1 + 2 * strain_33 > 0;
  return r;
}

[[nodiscard]] inline Isotropic unloaded(const StVenantKirchhoff& law) {
  return {law.young, law.poisson};
}
template <int N>
[[nodiscard]] double energy_of(const StVenantKirchhoff& law, const Vec<N>& strain) {
  return 0.5 * respond(law, strain).stress.dot(strain);
}

}  // namespace osculate::material
