#pragma once
#include <optional>

#include "osculate/material/invariants.hpp"

namespace osculate::material {

/// Rubber: a polynomial in the invariants of the strain without its change of volume. Terms that
/// are 0 make it neo-Hooke's (c10), Mooney and Rivlin's (c10, c01), Yeoh's (c10, c20, c30).
///
/// Formula    W = sum c_ij (I1 - 3)^i (I2 - 3)^j + sum (J - 1)^(2 k) / d_k ,
///            I1 = J^(-2/3) tr C , I2 = J^(-4/3) ((tr C)^2 - tr C^2) / 2 , C = I + 2 E
/// Requires   c10 + c01 > 0, d1 > 0; det C > 0, otherwise the response is not ok
/// Units      c_ij: force/length^2, d_k: length^2/force; 1/d_k = 0 for d_k = 0, k > 1
/// Source     Rivlin, Saunders 1951; *HYPERELASTIC, POLYNOMIAL of decks
/// Tested by  tests/unit/material/test_rubber.cpp
struct Rubber {
  static constexpr std::string_view key = "rubber";
  static constexpr std::string_view doc =
      "Rubber: polynomial in the invariants (neo-Hooke, Mooney-Rivlin, Yeoh, ...) with a bulk "
      "modulus of its own.";
  static constexpr bool finite_strain = true, large_strain = true;
  double c10 = 0, c01 = 0, c20 = 0, c11 = 0, c02 = 0, c30 = 0, c21 = 0, c12 = 0, c03 = 0;
  double d1 = 0, d2 = 0, d3 = 0, density = 0;

  static constexpr auto params() {
    using P = core::Param<Rubber>;
    const auto c = [](std::string_view key, std::string_view doc, double Rubber::*member) {
      return P{.key = key,
               .unit = "force/length^2",
               .doc = doc,
               .slot = member,
               .required = false,
               .example = "0.1"};
    };
    const auto d = [](std::string_view key, std::string_view doc, double Rubber::*member) {
      return P{.key = key,
               .unit = "length^2/force",
               .doc = doc,
               .slot = member,
               .range = {.lower = 0, .with_lower = true},
               .required = false,
               .example = "0.001"};
    };
    P first = c("c10", "Factor of I1 - 3; the shear modulus is 2 (c10 + c01).", &Rubber::c10);
    first.required = true;
    first.example = "0.5";
    P bulk = d("d1", "Compliance of the volume: 2 / K, K the bulk modulus.", &Rubber::d1);
    bulk.required = true;
    bulk.range = {.lower = 0};
    return std::array<P, 13>{{first,
                              c("c01", "Factor of I2 - 3.", &Rubber::c01),
                              c("c20", "Factor of (I1 - 3)^2.", &Rubber::c20),
                              c("c11", "Factor of (I1 - 3) (I2 - 3).", &Rubber::c11),
                              c("c02", "Factor of (I2 - 3)^2.", &Rubber::c02),
                              c("c30", "Factor of (I1 - 3)^3.", &Rubber::c30),
                              c("c21", "Factor of (I1 - 3)^2 (I2 - 3).", &Rubber::c21),
                              c("c12", "Factor of (I1 - 3) (I2 - 3)^2.", &Rubber::c12),
                              c("c03", "Factor of (I2 - 3)^3.", &Rubber::c03),
                              bulk,
                              d("d2", "Inverse of the factor of (J - 1)^4; 0: none.", &Rubber::d2),
                              d("d3", "Inverse of the factor of (J - 1)^6; 0: none.", &Rubber::d3),
                              {.key = "density",
                               .unit = "mass/length^3",
                               .doc = "Mass per reference volume.",
                               .slot = &Rubber::density,
                               .range = {.lower = 0, .with_lower = true},
                               .required = false,
                               .example = "1.1e-9"}}};
  }
  /// Without stiffness against shear there is no solid.
  [[nodiscard]] std::optional<core::Fault> fault() const {
    if (c10 + c01 > 0) return {};
    return core::Fault{"c10 + c01 > 0 is needed: half the shear modulus", "c10", {}};
  }
};

[[nodiscard]] ByInvariants by_invariants(const Rubber& law, const Invariants& v);
/// mu = 2 (c10 + c01), K = 2 / d1.
[[nodiscard]] Isotropic unloaded(const Rubber& law);

}  // namespace osculate::material
