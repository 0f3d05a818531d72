#pragma once
#include "osculate/material/linear_elastic.hpp"
#include "osculate/material/memory.hpp"

namespace osculate::material {

/// Deformation plasticity (Hencky) with the curve of Ramberg and Osgood: a metal as long as it is
/// loaded alone, for it is elastic and goes back the way that it came.
///
/// Formula    E eps = sigma + alpha (|sigma| / sigma_0)^(n - 1) sigma of a bar;
///            E eps = (1 + nu) s - (1 - 2 nu) p I + 3/2 alpha (q / sigma_0)^(n - 1) s , s the
///            deviator, -p the mean and q von Mises' of the stress: with the predictor q_tr of the
///            elastic deviator q + 3 G alpha / E (q / sigma_0)^(n - 1) q = q_tr , s = q / q_tr s_tr
/// Source     W. Ramberg, W. R. Osgood, NACA TN 902, 1943; *DEFORMATION PLASTICITY of decks
/// Units      young, yield: force/length^2
/// Requires   E > 0, -1 < nu < 0.5, sigma_0 > 0, n >= 1, alpha >= 0
/// Returns    stored energy: K/2 tr(eps)^2 + q^2 / (6 G) + alpha / E n / (n + 1) q^(n + 1) /
///            sigma_0^(n - 1); nothing is dissipated
/// Tested by  tests/unit/material/test_deformation_plasticity.cpp, verification/ramberg_osgood
struct DeformationPlasticity {
  static constexpr std::string_view key = "deformation_plasticity";
  static constexpr std::string_view doc =
      "Metals that are loaded alone, by the curve of Ramberg and Osgood: elastic, but not linear. "
      "With kinematics: finite the strain is the logarithmic one.";
  static constexpr bool finite_strain = false, large_strain = false, logarithmic = true;
  static constexpr std::array<Remembered, 0> memory{};
  double young = 0, poisson = 0, density = 0;
  double yield = 0, exponent = 1, offset = 0;  ///< sigma_0, n, alpha
  static constexpr std::array<core::Param<DeformationPlasticity>, 6> params();
};

constexpr std::array<core::Param<DeformationPlasticity>, 6> DeformationPlasticity::params() {
  using D = DeformationPlasticity;
  const auto [young, poisson, density] = isotropic_params<D>();
  return {young,
          poisson,
          density,
          {.key = "yield",
           .unit = "force/length^2",
           .doc = "Stress sigma_0 at which a bar is alpha sigma_0 / E longer than an elastic one.",
           .slot = &D::yield,
           .range = {.lower = 0},
           .example = "900"},
          {.key = "n",
           .unit = "1",
           .doc = "The power of the stress.",
           .slot = &D::exponent,
           .range = {.lower = 1, .with_lower = true},
           .example = "12"},
          {.key = "alpha",
           .unit = "1",
           .doc = "Strain beyond the elastic one at sigma_0, over sigma_0 / E.",
           .slot = &D::offset,
           .range = {.lower = 0, .with_lower = true},
           .example = "0.45"}};
}

[[nodiscard]] Response3 respond(const DeformationPlasticity& law, const Strain3& strain,
                                Memory memory);
[[nodiscard]] Response respond(const DeformationPlasticity& law, const Strain& strain,
                               Memory memory);
[[nodiscard]] Response respond_plane_stress(const DeformationPlasticity& law, const Strain& strain,
                                            double& strain_33, Memory memory);
[[nodiscard]] inline Isotropic unloaded(const DeformationPlasticity& law) {
  return {law.young, law.poisson};
}
[[nodiscard]] double energy_of(const DeformationPlasticity& law, const Strain3& strain,
                               const Memory& memory);
[[nodiscard]] inline double dissipated_by(const DeformationPlasticity&, const double*) { return 0; }

}  // namespace osculate::material
