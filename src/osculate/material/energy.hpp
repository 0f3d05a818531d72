#pragma once
#include "osculate/material/catalogue.hpp"

namespace osculate::material {

/// Stored energy per reference volume of a strain (as `response` takes it) in a point.
///
/// Formula    W with S = dW/dE; linear laws: S . E / 2. With a strain by the temperature
///            (expansion.hpp) W of the elastic strain, times theta^3 in finite strain
/// Units      force/length^2
/// Returns    infinity for a strain that the law has no answer to
/// Tested by  tests/unit/material/test_energy.cpp, test_j2_plasticity.cpp
[[nodiscard]] double stored_energy(const Law& law, const Strain& strain, const Memory& memory = {});
[[nodiscard]] double stored_energy(const Law& law, const Strain3& strain,
                                   const Memory& memory = {});
/// What has been dissipated in such a point.
[[nodiscard]] double dissipated_energy(const Law& law, const double* state);

}  // namespace osculate::material
