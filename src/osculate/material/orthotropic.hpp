#pragma once
#include "osculate/material/stiffness.hpp"

namespace osculate::material {

/// Linear elasticity with three planes of symmetry, by its engineering constants: wood, rolled
/// sheets, layers of fibres.
///
/// Formula    E11 = S11 / E1 - nu12 / E1 S22 - nu13 / E1 S33 , E22 = -nu12 / E1 S11 + S22 / E2 -
///            nu23 / E2 S33 , E33 = -nu13 / E1 S11 - nu23 / E2 S22 + S33 / E3 , 2 E12 = S12 / G12 ,
///            2 E23 = S23 / G23 , 2 E13 = S13 / G13 , in the axes of the material
/// Source     Jones, Mechanics of Composite Materials, 1999, eq. 2.25; *ELASTIC, TYPE=ENGINEERING
///            CONSTANTS of decks
/// Requires   E_i > 0, G_ij > 0, and that every strain takes energy:
///            nu12^2 < E1 / E2, nu13^2 < E1 / E3, nu23^2 < E2 / E3, a positive determinant
/// Units      E_i, G_ij: force/length^2
/// Tested by  tests/unit/material/test_anisotropic.cpp
struct Orthotropic {
  static constexpr std::string_view key = "orthotropic";
  static constexpr std::string_view doc =
      "Linear elasticity with three planes of symmetry, by engineering constants in the axes that "
      "the section's `orientation` gives. With kinematics: finite the strain is Green and "
      "Lagrange's.";
  static constexpr bool finite_strain = false, large_strain = false, linear = true;
  double e1 = 0, e2 = 0, e3 = 0, nu12 = 0, nu13 = 0, nu23 = 0, g12 = 0, g13 = 0, g23 = 0,
         density = 0;
  /// Over the temperature, in place of them.
  core::Table e1_over = {}, e2_over = {}, e3_over = {}, nu12_over = {}, nu13_over = {},
              nu23_over = {}, g12_over = {}, g13_over = {}, g23_over = {};

  static constexpr auto params() {
    using P = core::Param<Orthotropic>;
    const auto modulus = [](std::string_view key, std::string_view doc, double Orthotropic::*slot,
                            core::Table Orthotropic::*over) {
      return P{.key = key,
               .unit = "force/length^2",
               .doc = doc,
               .slot = slot,
               .range = {.lower = 0},
               .example = "1.0e4",
               .over = over};
    };
    const auto ratio = [](std::string_view key, std::string_view doc, double Orthotropic::*slot,
                          core::Table Orthotropic::*over) {
      return P{.key = key, .unit = "1", .doc = doc, .slot = slot, .example = "0.3", .over = over};
    };
    using O = Orthotropic;
    return std::array<P, 10>{
        {modulus("E1", "Young's modulus along the first axis.", &O::e1, &O::e1_over),
         modulus("E2", "Young's modulus along the second axis.", &O::e2, &O::e2_over),
         modulus("E3", "Young's modulus along the third axis.", &O::e3, &O::e3_over),
         ratio("nu12", "What a pull along the first axis takes from the second.", &O::nu12,
               &O::nu12_over),
         ratio("nu13", "What a pull along the first axis takes from the third.", &O::nu13,
               &O::nu13_over),
         ratio("nu23", "What a pull along the second axis takes from the third.", &O::nu23,
               &O::nu23_over),
         modulus("G12", "Shear modulus in the plane of the first and second axis.", &O::g12,
                 &O::g12_over),
         modulus("G13", "Shear modulus in the plane of the first and third axis.", &O::g13,
                 &O::g13_over),
         modulus("G23", "Shear modulus in the plane of the second and third axis.", &O::g23,
                 &O::g23_over),
         {.key = "density",
          .unit = "mass/length^3",
          .doc = "Mass per reference volume.",
          .slot = &O::density,
          .range = {.lower = 0, .with_lower = true},
          .required = false,
          .example = "1.6e-9"}}};
  }
  /// A strain that would give energy.
  [[nodiscard]] std::optional<core::Fault> fault() const;
};

[[nodiscard]] Tangent3 stiffness(const Orthotropic& law);
[[nodiscard]] inline Isotropic unloaded(const Orthotropic& law) {
  return mean_of_directions(stiffness(law));
}

}  // namespace osculate::material
