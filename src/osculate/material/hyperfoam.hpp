#pragma once
#include <optional>

#include "osculate/material/stretches.hpp"

namespace osculate::material {

/// Elastic foam, whose volume changes much, by powers of its principal stretches.
///
/// Formula    W = sum 2 mu_p / alpha_p^2 (lambda1^alpha_p + lambda2^alpha_p + lambda3^alpha_p - 3 +
///            (J^(-alpha_p beta_p) - 1) / beta_p) , beta_p = nu_p / (1 - 2 nu_p) ;
///            nu_p = 0: the last term is -alpha_p ln J
/// Source     R. Hill, Adv. Appl. Mech. 18 (1978) 1; B. Storakers, J. Mech. Phys. Solids 34 (1986)
///            125; *HYPERFOAM of decks
/// Requires   sum mu_p > 0; -1 < nu_p < 0.5; det C > 0, otherwise the response is not ok
/// Units      mu_p: force/length^2
/// Tested by  tests/unit/material/test_ogden.cpp, verification/ogden
struct Hyperfoam {
  static constexpr std::string_view key = "hyperfoam";
  static constexpr std::string_view doc =
      "Elastic foam, whose volume changes much, by powers of its principal stretches (Hill, "
      "Storakers), up to three terms.";
  static constexpr bool finite_strain = true, large_strain = true;
  double mu1 = 0, alpha1 = 0, nu1 = 0, mu2 = 0, alpha2 = 0, nu2 = 0, mu3 = 0, alpha3 = 0, nu3 = 0,
         density = 0;

  static constexpr auto params() {
    using P = core::Param<Hyperfoam>;
    using H = Hyperfoam;
    const auto mu = [](std::string_view key, double H::*slot, bool first) {
      return P{.key = key,
               .unit = "force/length^2",
               .doc = "Part of the shear modulus that this term has.",
               .slot = slot,
               .required = first,
               .example = "0.16"};
    };
    const auto alpha = [](std::string_view key, double H::*slot, bool first) {
      return P{.key = key,
               .unit = "1",
               .doc = "Power of the stretches of this term.",
               .slot = slot,
               .required = first,
               .example = "8.9"};
    };
    const auto nu = [](std::string_view key, double H::*slot) {
      return P{.key = key,
               .unit = "1",
               .doc = "Poisson's ratio of this term.",
               .slot = slot,
               .range = {.lower = -1, .upper = 0.5},
               .required = false,
               .example = "0.1"};
    };
    return std::array<P, 10>{{mu("mu1", &H::mu1, true),
                              alpha("alpha1", &H::alpha1, true),
                              nu("nu1", &H::nu1),
                              mu("mu2", &H::mu2, false),
                              alpha("alpha2", &H::alpha2, false),
                              nu("nu2", &H::nu2),
                              mu("mu3", &H::mu3, false),
                              alpha("alpha3", &H::alpha3, false),
                              nu("nu3", &H::nu3),
                              {.key = "density",
                               .unit = "mass/length^3",
                               .doc = "Mass per reference volume.",
                               .slot = &H::density,
                               .range = {.lower = 0, .with_lower = true},
                               .required = false,
                               .example = "5.0e-11"}}};
  }
  [[nodiscard]] std::optional<core::Fault> fault() const;
};

[[nodiscard]] AlongAxes along_axes(const Hyperfoam& law, const PrincipalStrain& e);
/// mu = sum mu_p, K = sum 2 mu_p (1/3 + beta_p).
[[nodiscard]] Isotropic unloaded(const Hyperfoam& law);

}  // namespace osculate::material
