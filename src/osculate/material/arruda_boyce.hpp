#pragma once
#include "osculate/material/invariants.hpp"

namespace osculate::material {

/// Rubber of chains that lock: Arruda and Boyce's eight chains, by the first five terms of the
/// inverse Langevin function.
///
/// Formula    W = mu sum_i a_i (I1^i - 3^i) / lambda_m^(2 i - 2) + ((J^2 - 1) / 2 - ln J) / d ,
///            a = 1/2, 1/20, 11/1050, 19/7000, 519/673750 , I1 = J^(-2/3) tr C
/// Requires   mu > 0, lambda_m > 0, d > 0; det C > 0, otherwise the response is not ok
/// Units      mu: force/length^2, d: length^2/force
/// Source     E. M. Arruda, M. C. Boyce, J. Mech. Phys. Solids 41 (1993) 389, equation (22) with
///            n k Theta = mu, N = lambda_m^2; *HYPERELASTIC, ARRUDA-BOYCE of decks
/// Tested by  tests/unit/material/test_arruda_boyce.cpp, verification/arruda_boyce
struct ArrudaBoyce {
  static constexpr std::string_view key = "arruda_boyce";
  static constexpr std::string_view doc =
      "Rubber that stiffens as its chains are stretched out (Arruda and Boyce, five terms), with a "
      "bulk modulus of its own.";
  static constexpr bool finite_strain = true, large_strain = true;
  double mu = 0, lambda_m = 0, d = 0, density = 0;

  static constexpr auto params() {
    using P = core::Param<ArrudaBoyce>;
    return std::array<P, 4>{
        {{.key = "mu",
          .unit = "force/length^2",
          .doc = "Modulus of the chains; the shear modulus without strain is mu (1 + 3 / (5 "
                 "lambda_m^2) + 99 / (175 lambda_m^4) + ...).",
          .slot = &ArrudaBoyce::mu,
          .range = {.lower = 0},
          .example = "0.4"},
         {.key = "lambda_m",
          .unit = "1",
          .doc = "Stretch at which chains lock.",
          .slot = &ArrudaBoyce::lambda_m,
          .range = {.lower = 0},
          .example = "5"},
         {.key = "d",
          .unit = "length^2/force",
          .doc = "Compliance of the volume: 2 / K, K the bulk modulus.",
          .slot = &ArrudaBoyce::d,
          .range = {.lower = 0},
          .example = "0.001"},
         {.key = "density",
          .unit = "mass/length^3",
          .doc = "Mass per reference volume.",
          .slot = &ArrudaBoyce::density,
          .range = {.lower = 0, .with_lower = true},
          .required = false,
          .example = "1.1e-9"}}};
  }
};

[[nodiscard]] ByInvariants by_invariants(const ArrudaBoyce& law, const Invariants& v);
/// mu (1 + 3/5 x + 99/175 x^2 + 513/875 x^3 + 42039/67375 x^4), x = lambda_m^-2; K = 2 / d.
[[nodiscard]] Isotropic unloaded(const ArrudaBoyce& law);

}  // namespace osculate::material
