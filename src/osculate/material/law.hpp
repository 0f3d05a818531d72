#pragma once
#include <cmath>
#include <string_view>
#include <variant>

#include "osculate/core/types.hpp"

namespace osculate::material {

/// Working components of plane and axisymmetric problems: 11, 22, 33, 12. Strains carry twice the
/// shear (2 E12), right Cauchy-Green tensors the plain component (C12).
using Strain = Vec<4>;
using Stress = Vec<4>;
using Tangent = Mat<4, 4>;

/// Stress and its derivative with respect to the strain. `ok` is false where the law has no
/// answer (volume not positive, local iteration not converged): step control cuts the increment.
struct Response {
  bool ok = true;
  Stress stress = Stress::Zero();
  Tangent tangent = Tangent::Zero();
};

/// Lame constants.
struct Lame {
  double lambda, mu;
};
[[nodiscard]] inline Lame lame(double young, double poisson) {
  return {young * poisson / ((1 + poisson) * (1 - 2 * poisson)), young / (2 * (1 + poisson))};
}

/// sigma = lambda tr(eps) I + 2 mu eps, small strain.
struct LinearElastic {
  static constexpr std::string_view key = "linear_elastic";
  static constexpr bool finite_strain = false;
  double young = 0, poisson = 0, density = 0;
};

/// S = lambda tr(E) I + 2 mu E, finite strain, moderate strains (no barrier against det F -> 0).
struct StVenantKirchhoff {
  static constexpr std::string_view key = "st_venant_kirchhoff";
  static constexpr bool finite_strain = true;
  double young = 0, poisson = 0, density = 0;
};

/// Compressible neo-Hooke: W = mu/2 (tr C - 3) - mu ln J + lambda/2 (ln J)^2,
/// S = mu (I - C^-1) + lambda ln J C^-1.
struct NeoHooke {
  static constexpr std::string_view key = "neo_hooke";
  static constexpr bool finite_strain = true;
  double young = 0, poisson = 0, density = 0;
};

/// The one list of laws.
using Law = std::variant<LinearElastic, StVenantKirchhoff, NeoHooke>;

[[nodiscard]] bool finite_strain(const Law& law);

/// Stress for a given strain E = (C - I)/2 (or small strain), all four components free.
///
/// Returns    second Piola-Kirchhoff stress and dS/dE (finite), Cauchy stress (small)
/// Tested by  tests/unit/material/test_laws.cpp
[[nodiscard]] Response response(const Law& law, const Strain& strain);

/// The same with S33 = 0: E33 is found (closed form, or Newton to round-off) and condensed.
/// `strain[2]` is ignored; `strain_33` (if given) receives the one found.
[[nodiscard]] Response plane_stress_response(const Law& law, Strain strain,
                                             double* strain_33 = nullptr);

}  // namespace osculate::material
