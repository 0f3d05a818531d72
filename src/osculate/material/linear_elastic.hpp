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
  static constexpr std::string_view doc = "Hooke's law between stress and small strain.";
  static constexpr bool finite_strain = false, large_strain = false, linear = true;
  double young = 0, poisson = 0, density = 0;
  core::Table young_over = {}, poisson_over = {};  ///< over the temperature, in place of them
  static constexpr auto params() { return isotropic_params<LinearElastic>(); }
};

/// For four components (Strain) or six (Strain3).
template <int N>
[[nodiscard]] ResponseOf<N> hooke(double young, double poisson, const Vec<N>& strain) {
  const Lame c = lame(young, poisson);
  ResponseOf<N> r;
  r.tangent.template topLeftCorner<3, 3>().setConstant(c.lambda);
  r.tangent.diagonal().template head<3>().array() += 2 * c.mu;
  r.tangent.diagonal().template tail<N - 3>().setConstant(c.mu);
  r.stress = r.tangent * strain;
  return r;
}
/// Hooke's law with S33 = 0, in closed form: no digits are lost for nu near 0.5.
[[nodiscard]] Response hooke_plane_stress(double young, double poisson, const Strain& strain,
                                          double& strain_33);

[[nodiscard]] inline Response respond(const LinearElastic& law, const Strain& strain) {
  return hooke(law.young, law.poisson, strain);
}
[[nodiscard]] inline Response3 respond(const LinearElastic& law, const Strain3& strain) {
  return hooke(law.young, law.poisson, strain);
}
[[nodiscard]] inline Response respond_plane_stress(const LinearElastic& law, const Strain& strain,
                                                   double& strain_33) {
  return hooke_plane_stress(law.young, law.poisson, strain, strain_33);
}

[[nodiscard]] inline Isotropic unloaded(const LinearElastic& law) {
  return {law.young, law.poisson};
}
/// Formula    S . E / 2
template <int N>
[[nodiscard]] double energy_of(const LinearElastic& law, const Vec<N>& strain) {
  return 0.5 * respond(law, strain).stress.dot(strain);
}

}  // namespace osculate::material
