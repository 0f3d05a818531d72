#pragma once
#include <array>

#include "osculate/material/stiffness.hpp"

namespace osculate::material {

/// Linear elasticity without any symmetry but that of its energy: 21 constants.
///
/// Formula    S_ij = D_ijkl E_kl in the axes of the material
/// Source     *ELASTIC, TYPE=ANISO of decks, whose order of constants this is
/// Requires   that every strain takes energy: D is positive definite
/// Units      force/length^2
/// Tested by  tests/unit/material/test_anisotropic.cpp
struct Anisotropic {
  static constexpr std::string_view key = "anisotropic";
  static constexpr std::string_view doc =
      "Linear elasticity by the 21 constants of its stiffness (9 of them of orthotropic materials) "
      "in the axes that the section's `orientation` gives. With kinematics: finite the strain is "
      "Green and Lagrange's.";
  static constexpr bool finite_strain = false, large_strain = false, linear = true;
  double d1111 = 0, d1122 = 0, d2222 = 0, d1133 = 0, d2233 = 0, d3333 = 0, d1112 = 0, d2212 = 0,
         d3312 = 0, d1212 = 0, d1113 = 0, d2213 = 0, d3313 = 0, d1213 = 0, d1313 = 0, d1123 = 0,
         d2223 = 0, d3323 = 0, d1223 = 0, d1323 = 0, d2323 = 0, density = 0;
  /// Over the temperature, in place of them.
  core::Table d1111_over = {}, d1122_over = {}, d2222_over = {}, d1133_over = {}, d2233_over = {},
              d3333_over = {}, d1112_over = {}, d2212_over = {}, d3312_over = {}, d1212_over = {},
              d1113_over = {}, d2213_over = {}, d3313_over = {}, d1213_over = {}, d1313_over = {},
              d1123_over = {}, d2223_over = {}, d3323_over = {}, d1223_over = {}, d1323_over = {},
              d2323_over = {};

  static constexpr auto params() {
    using P = core::Param<Anisotropic>;
    using A = Anisotropic;
    const auto own = [](std::string_view key, double A::*slot, core::Table A::*over) {
      return P{.key = key,
               .unit = "force/length^2",
               .doc = "Stress by the strain of the same component.",
               .slot = slot,
               .range = {.lower = 0},
               .example = "1.0e4",
               .over = over};
    };
    const auto other = [](std::string_view key, double A::*slot, core::Table A::*over) {
      return P{.key = key,
               .unit = "force/length^2",
               .doc = "Stress by the strain of the other component.",
               .slot = slot,
               .required = false,
               .example = "1.0e3",
               .over = over};
    };
    return std::array<P, 22>{{own("D1111", &A::d1111, &A::d1111_over),
                              other("D1122", &A::d1122, &A::d1122_over),
                              own("D2222", &A::d2222, &A::d2222_over),
                              other("D1133", &A::d1133, &A::d1133_over),
                              other("D2233", &A::d2233, &A::d2233_over),
                              own("D3333", &A::d3333, &A::d3333_over),
                              other("D1112", &A::d1112, &A::d1112_over),
                              other("D2212", &A::d2212, &A::d2212_over),
                              other("D3312", &A::d3312, &A::d3312_over),
                              own("D1212", &A::d1212, &A::d1212_over),
                              other("D1113", &A::d1113, &A::d1113_over),
                              other("D2213", &A::d2213, &A::d2213_over),
                              other("D3313", &A::d3313, &A::d3313_over),
                              other("D1213", &A::d1213, &A::d1213_over),
                              own("D1313", &A::d1313, &A::d1313_over),
                              other("D1123", &A::d1123, &A::d1123_over),
                              other("D2223", &A::d2223, &A::d2223_over),
                              other("D3323", &A::d3323, &A::d3323_over),
                              other("D1223", &A::d1223, &A::d1223_over),
                              other("D1323", &A::d1323, &A::d1323_over),
                              own("D2323", &A::d2323, &A::d2323_over),
                              {.key = "density",
                               .unit = "mass/length^3",
                               .doc = "Mass per reference volume.",
                               .slot = &A::density,
                               .range = {.lower = 0, .with_lower = true},
                               .required = false,
                               .example = "1.6e-9"}}};
  }
  /// A strain that would give energy.
  [[nodiscard]] std::optional<core::Fault> fault() const;
};

[[nodiscard]] Tangent3 stiffness(const Anisotropic& law);
[[nodiscard]] inline Isotropic unloaded(const Anisotropic& law) {
  return mean_of_directions(stiffness(law));
}

}  // namespace osculate::material
