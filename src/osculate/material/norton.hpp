#pragma once
#include "osculate/material/linear_elastic.hpp"
#include "osculate/material/memory.hpp"

namespace osculate::material {

/// Steady creep of metals: an isotropic elastic material whose deviator flows at a rate that is a
/// power of von Mises' stress (Norton, Bailey, Odqvist).
///
/// Formula    sigma = K tr(eps) I + 2 G dev(eps - eps_c) ,  d(eps_c)/dt = sqrt(3/2) n A q^n ,
///            q = sqrt(3/2) |dev sigma| , n along dev sigma; implicit in an increment of duration
///            h: q + 3 G h A q^n = q of the elastic predictor
/// Source     F. H. Norton, The Creep of Steel at High Temperatures, 1929; F. K. G. Odqvist,
///            Mathematical Theory of Creep and Creep Rupture, 1966; return and consistent tangent
///            as radial return: Simo & Hughes 1998, box 3.1 and 3.2
/// Units      young: force/length^2; rate: 1/time/(force/length^2)^n
/// Requires   E > 0, -1 < nu < 0.5, A >= 0, n >= 1
/// Returns    stored energy: the elastic one; dissipated: the sum of q A q^n h over the increments
/// Tested by  tests/unit/material/test_norton.cpp, verification/creep
struct Norton {
  static constexpr std::string_view key = "norton";
  static constexpr std::string_view doc =
      "Steady creep of metals: strains grow at a rate that is a power of von Mises' stress. With "
      "kinematics: finite the strain is the logarithmic one. Every step needs a duration.";
  static constexpr bool finite_strain = false, large_strain = false, logarithmic = true,
                        hooke_at_first = true;
  static constexpr std::array<Remembered, 8> memory{
      {{"CEEQ", "equivalent creep strain", false},
       {"CE11", "creep strain, tensor component"},
       {"CE22", "creep strain, tensor component"},
       {"CE33", "creep strain, tensor component"},
       {"CE12", "creep strain, tensor component"},
       {"CE23", "creep strain, tensor component"},
       {"CE13", "creep strain, tensor component"},
       {"CDENS", "energy dissipated by creep, per volume", false}}};
  double young = 0, poisson = 0, density = 0;
  double rate = 0, exponent = 1;  ///< A, n
  /// Over the temperature, in place of them.
  core::Table young_over = {}, poisson_over = {}, rate_over = {}, exponent_over = {};
  static constexpr std::array<core::Param<Norton>, 5> params();
};

constexpr std::array<core::Param<Norton>, 5> Norton::params() {
  const auto [young, poisson, density] = isotropic_params<Norton>();
  return {young,
          poisson,
          density,
          {.key = "A",
           .unit = "1/time/(force/length^2)^n",
           .doc = "Rate of the equivalent creep strain at von Mises' stress 1.",
           .slot = &Norton::rate,
           .range = {.lower = 0, .with_lower = true},
           .example = "1.0e-12",
           .timed = true,
           .over = &Norton::rate_over},
          {.key = "n",
           .unit = "1",
           .doc = "The power of von Mises' stress.",
           .slot = &Norton::exponent,
           .range = {.lower = 1, .with_lower = true},
           .example = "5",
           .over = &Norton::exponent_over}};
}

[[nodiscard]] Response3 respond(const Norton& law, const Strain3& strain, Memory memory);
[[nodiscard]] Response respond(const Norton& law, const Strain& strain, Memory memory);
[[nodiscard]] Response respond_plane_stress(const Norton& law, const Strain& strain,
                                            double& strain_33, Memory memory);

[[nodiscard]] inline Isotropic unloaded(const Norton& law) { return {law.young, law.poisson}; }
/// Stored at a strain by a point that remembers something (null: nothing).
[[nodiscard]] double energy_of(const Norton& law, const Strain3& strain, const Memory& memory);
/// Dissipated so far by a point that remembers `state`.
[[nodiscard]] double dissipated_by(const Norton& law, const double* state);

}  // namespace osculate::material
