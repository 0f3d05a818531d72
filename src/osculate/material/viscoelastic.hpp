#pragma once
#include <array>
#include <optional>
#include <span>

#include "osculate/material/linear_elastic.hpp"
#include "osculate/material/memory.hpp"
#include "osculate/material/prony.hpp"

namespace osculate::material {

/// Linear viscoelasticity: shear and bulk modulus relax by Prony series (generalised Maxwell
/// model).
///
/// Formula    s = 2 G_0 ((1 - sum g_i) e + sum g_i h_i) , p = K_0 ((1 - sum k_i) theta +
///            sum k_i theta_i) , dh_i/dt = de/dt - h_i / tau_i , e the deviator and theta the trace
///            of the strain, theta_i like h_i. In an increment of duration t, in which the strain
///            changes evenly, exactly: h_i -> exp(-x) h_i + (1 - exp(-x)) / x de , x = t / tau_i
/// Source     R. L. Taylor, K. S. Pister, G. L. Goudreau, Int. J. Num. Meth. Eng. 2, 1970; Simo &
///            Hughes 1998, section 10.3
/// Units      young: force/length^2, at once; times: time
/// Requires   E > 0, -1 < nu < 0.5, tau_i > 0, g_i >= 0, sum g_i < 1, and so of k_i
/// Returns    stored energy: that of all springs; dissipated: what the dampers take,
///            sum 2 G_0 g_i / tau_i int h_i : h_i dt and that of the bulk
/// Tested by  tests/unit/material/test_viscoelastic.cpp, verification/viscoelastic
struct Viscoelastic {
  static constexpr std::string_view key = "viscoelastic";
  static constexpr std::string_view doc =
      "Linear viscoelasticity: shear and bulk modulus relax by Prony series. With kinematics: "
      "finite the strain is the logarithmic one. Every step needs a duration.";
  static constexpr bool finite_strain = false, large_strain = false, logarithmic = true;
  static constexpr std::size_t own = 7;   ///< numbers beside those of the terms
  static constexpr std::size_t each = 7;  ///< of a term: six of shear, one of the bulk
  /// What is dissipated, the strain, and the terms.
  static constexpr std::array<Remembered, own + each * Relaxation::most> memory{
      {{"CDENS", "energy dissipated by creep, per volume", false}}};
  double young = 0, poisson = 0, density = 0;
  core::Table shear = {}, bulk = {};  ///< g_i, k_i and tau_i
  static constexpr std::array<core::Param<Viscoelastic>, 5> params();
  /// What is wrong with the series.
  [[nodiscard]] std::optional<core::Fault> fault() const;
};

constexpr std::array<core::Param<Viscoelastic>, 5> Viscoelastic::params() {
  auto [young, poisson, density] = isotropic_params<Viscoelastic>();
  young.doc = "Young's modulus at once, before anything has relaxed.";
  poisson.doc = "Poisson's ratio at once, before anything has relaxed.";
  const auto [shear, bulk] = series_params<Viscoelastic>();
  return {young, poisson, density, shear, bulk};
}

[[nodiscard]] Response3 respond(const Viscoelastic& law, const Strain3& strain, Memory memory);
[[nodiscard]] Response respond(const Viscoelastic& law, const Strain& strain, Memory memory);
[[nodiscard]] Response respond_plane_stress(const Viscoelastic& law, const Strain& strain,
                                            double& strain_33, Memory memory);
[[nodiscard]] inline Isotropic unloaded(const Viscoelastic& law) {
  return {law.young, law.poisson};
}
/// Stored at a strain by a point that remembers something (null: nothing).
[[nodiscard]] double energy_of(const Viscoelastic& law, const Strain3& strain,
                               const Memory& memory);
/// Dissipated so far by a point that remembers `state`.
[[nodiscard]] double dissipated_by(const Viscoelastic& law, const double* state);
[[nodiscard]] std::span<const Remembered> remembered_by(const Viscoelastic& law);

}  // namespace osculate::material
