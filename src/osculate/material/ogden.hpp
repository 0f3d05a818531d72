#pragma once
#include <optional>

#include "osculate/material/stretches.hpp"

namespace osculate::material {

/// Rubber by powers of its principal stretches.
///
/// Formula    W = sum 2 mu_p / alpha_p^2 (l1^alpha_p + l2^alpha_p + l3^alpha_p - 3) + sum (J -
/// 1)^(2
///            k) / d_k , l_i = J^(-1/3) lambda_i
/// Source     R. W. Ogden, Proc. R. Soc. London A 326 (1972) 565; *HYPERELASTIC, OGDEN of decks,
///            whose mu_p are Ogden's own times alpha_p / 2
/// Requires   sum mu_p > 0, d1 > 0; det C > 0, otherwise the response is not ok
/// Units      mu_p: force/length^2, d_k: length^2/force; 1/d_k = 0 for d_k = 0, k > 1
/// Tested by  tests/unit/material/test_ogden.cpp, verification/ogden
struct Ogden {
  static constexpr std::string_view key = "ogden";
  static constexpr std::string_view doc =
      "Rubber by powers of its principal stretches (Ogden), up to three terms, with a bulk modulus "
      "of its own.";
  static constexpr bool finite_strain = true, large_strain = true;
  double mu1 = 0, alpha1 = 0, mu2 = 0, alpha2 = 0, mu3 = 0, alpha3 = 0;
  double d1 = 0, d2 = 0, d3 = 0, density = 0;

  static constexpr auto params() {
    using P = core::Param<Ogden>;
    const auto mu = [](std::string_view key, double Ogden::*slot, bool first) {
      return P{.key = key,
               .unit = "force/length^2",
               .doc = "Part of the shear modulus that this term has.",
               .slot = slot,
               .required = first,
               .example = "0.4"};
    };
    const auto alpha = [](std::string_view key, double Ogden::*slot, bool first) {
      return P{.key = key,
               .unit = "1",
               .doc = "Power of the stretches of this term.",
               .slot = slot,
               .required = first,
               .example = "1.3"};
    };
    const auto d = [](std::string_view key, std::string_view doc, double Ogden::*slot, bool first) {
      return P{.key = key,
               .unit = "length^2/force",
               .doc = doc,
               .slot = slot,
               .range = {.lower = 0, .with_lower = !first},
               .required = first,
               .example = "0.001"};
    };
    return std::array<P, 10>{
        {mu("mu1", &Ogden::mu1, true),
         alpha("alpha1", &Ogden::alpha1, true),
         mu("mu2", &Ogden::mu2, false),
         alpha("alpha2", &Ogden::alpha2, false),
         mu("mu3", &Ogden::mu3, false),
         alpha("alpha3", &Ogden::alpha3, false),
         d("d1", "Compliance of the volume: 2 / K, K the bulk modulus.", &Ogden::d1, true),
         d("d2", "Inverse of the factor of (J - 1)^4; 0: none.", &Ogden::d2, false),
         d("d3", "Inverse of the factor of (J - 1)^6; 0: none.", &Ogden::d3, false),
         {.key = "density",
          .unit = "mass/length^3",
          .doc = "Mass per reference volume.",
          .slot = &Ogden::density,
          .range = {.lower = 0, .with_lower = true},
          .required = false,
          .example = "1.1e-9"}}};
  }
  [[nodiscard]] std::optional<core::Fault> fault() const;
};

[[nodiscard]] AlongAxes along_axes(const Ogden& law, const PrincipalStrain& e);
/// mu = sum mu_p, K = 2 / d1.
[[nodiscard]] Isotropic unloaded(const Ogden& law);

}  // namespace osculate::material
