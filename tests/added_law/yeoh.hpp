#pragma once
#include <array>
#include <cmath>
#include <string_view>

#include "osculate/material/condense.hpp"
#include "osculate/material/neo_hooke.hpp"

namespace osculate::material {

/// Rubber that stiffens in large stretches (Yeoh's second term): a material that only this test
/// has.
///
/// Formula    W = W of NeoHooke + k (tr C - 3)^2 ,  S = S of NeoHooke + 4 k (tr C - 3) I
/// Units      k: force/length^2
struct Yeoh {
  static constexpr std::string_view key = "yeoh", doc = "Rubber that stiffens in large stretches.";
  static constexpr bool finite_strain = true, large_strain = true;
  double young = 0, poisson = 0, density = 0, stiffening = 0;

  static constexpr auto params() {
    const auto [young, poisson, density] = isotropic_params<Yeoh>();
    return std::array<core::Param<Yeoh>, 4>{{young,
                                             poisson,
                                             density,
                                             {.key = "k",
                                              .unit = "force/length^2",
                                              .doc = "Factor of the second term.",
                                              .slot = &Yeoh::stiffening,
                                              .range = {.lower = 0},
                                              .example = "0.02"}}};
  }
  [[nodiscard]] NeoHooke first_term() const { return {young, poisson, density}; }
};

[[nodiscard]] inline Isotropic unloaded(const Yeoh& law) { return {law.young, law.poisson}; }

template <int N>
[[nodiscard]] double energy_of(const Yeoh& law, const Vec<N>& strain) {
  const double more = 2 * strain.template head<3>().sum();
  return energy_of(law.first_term(), strain) + law.stiffening * more * more;
}
template <int N>
[[nodiscard]] ResponseOf<N> respond(const Yeoh& law, const Vec<N>& strain) {
  ResponseOf<N> r = respond(law.first_term(), strain);
  r.stress.template head<3>().array() += 8 * law.stiffening * strain.template head<3>().sum();
  r.tangent.template topLeftCorner<3, 3>().array() += 8 * law.stiffening;
  return r;
}
/// Newton for E33, from what the first term alone has.
[[nodiscard]] inline Response respond_plane_stress(const Yeoh& law, Strain strain,
                                                   double& strain_33) {
  Response r = respond_plane_stress(law.first_term(), strain, strain_33);
  for (int i = 0; i < 30 && r.ok; ++i) {
    strain[2] = strain_33;
    r = respond(law, strain);
    const double step = r.stress[2] / r.tangent(2, 2);
    if (std::abs(step) < 1e-15) break;
    strain_33 -= step;
  }
  return without_stress_across(r);
}

}  // namespace osculate::material
