#pragma once
#include "osculate/material/catalogue.hpp"

namespace osculate::material {

/// Stored energy per reference volume of a strain (as `response` takes it).
///
/// Formula    W with S = dW/dE; linear laws: S . E / 2
/// Units      force/length^2
/// Returns    infinity for a strain that the law has no answer to
/// Tested by  tests/unit/material/test_energy.cpp
[[nodiscard]] double stored_energy(const Law& law, const Strain& strain);
[[nodiscard]] double stored_energy(const Law& law, const Strain3& strain);

}  // namespace osculate::material
