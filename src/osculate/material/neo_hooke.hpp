#pragma once
#include "osculate/material/response.hpp"

namespace osculate::material {

/// Compressible neo-Hooke.
///
/// Formula    W = mu/2 (tr C - 3) - mu ln J + lambda/2 (ln J)^2,  C = I + 2 E,  J^2 = det C,
///            S = mu (I - C^-1) + lambda ln J C^-1
/// Requires   E > 0, -1 < nu < 0.5; det C > 0, otherwise the response is not ok
/// Tested by  tests/unit/material/test_laws.cpp
struct NeoHooke {
  static constexpr std::string_view key = "neo_hooke";
  static constexpr std::string_view doc = "Compressible neo-Hookean solid, for large strains.";
  static constexpr bool finite_strain = true, large_strain = true;
  double young = 0, poisson = 0, density = 0;
  static constexpr auto params() { return isotropic_params<NeoHooke>(); }
};

[[nodiscard]] Response respond(const NeoHooke& law, const Strain& strain);
[[nodiscard]] Response3 respond(const NeoHooke& law, const Strain3& strain);

/// The stress without its derivative.
[[nodiscard]] StressOf<4> stress_of(const NeoHooke& law, const Strain& strain);
[[nodiscard]] StressOf<6> stress_of(const NeoHooke& law, const Strain3& strain);

/// The same with S33 = 0: Newton to round-off for y = ln C33 in
/// mu (e^y - 1) + lambda/2 (ln det C_plane + y) = 0, which is convex in y. There,
/// lambda ln J = -2 mu E33, which makes S = mu (I - C^-1 - 2 E33 C^-1) free of lambda.
///
/// Returns    not ok if the area of the plane is not positive, or if no thickness balances, which
///            happens for nu < 0 in strong compression only
/// Tested by  tests/unit/material/test_plane_stress.cpp
[[nodiscard]] Response respond_plane_stress(const NeoHooke& law, const Strain& strain,
                                            double& strain_33);

[[nodiscard]] inline Isotropic unloaded(const NeoHooke& law) { return {law.young, law.poisson}; }
/// W; infinity where det C is not positive.
[[nodiscard]] double energy_of(const NeoHooke& law, const Strain& strain);
[[nodiscard]] double energy_of(const NeoHooke& law, const Strain3& strain);

}  // namespace osculate::material
