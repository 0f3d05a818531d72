#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "osculate/material/catalogue.hpp"

namespace osculate::material {

[[nodiscard]] bool finite_strain(const Law& law);
/// Made for large compression, in which enhanced strains are unstable.
[[nodiscard]] bool large_strain(const Law& law);
/// The stress is proportional to the strain, always by the same factors.
[[nodiscard]] bool linear(const Law& law);
/// From the undeformed material on, at least up to where it flows, the stress (of finite laws
/// the second one of Piola and Kirchhoff) is proportional to the strain (Green and Lagrange's).
[[nodiscard]] bool hooke_at_first(const Law& law);
/// What each material point remembers; empty: nothing.
[[nodiscard]] std::span<const Remembered> memory_of(const Law& law);
/// Whether increments have to take time.
[[nodiscard]] bool needs_duration(const Law& law);
/// A law of small strains that may also be used in a finite one (the logarithmic strain, Green and
/// Lagrange's), and its form for that. Other laws stay as they are.
[[nodiscard]] bool has_finite_form(const Law& law);
[[nodiscard]] Law in_finite_strain(const Law& law);
/// The law whose stresses relax by Prony series (relaxing.hpp); none: of this one they do not.
[[nodiscard]] std::optional<Law> relaxing(const Law& law, const Relaxation& series);
/// Of such a law shape and volume relax by the same series alone.
[[nodiscard]] bool relaxes_alike(const Law& law);
/// The stress depends on where the axes of the material point (Memory::axes).
[[nodiscard]] bool directional(const Law& law);
/// Some constants are tables over the temperature (Memory::temperature).
[[nodiscard]] bool over_temperature(const Law& law);
/// The law wants to know the temperature of the point (Memory::temperature).
[[nodiscard]] bool takes_temperature(const Law& law);
/// Why a law had no answer, where it can say so.
[[nodiscard]] std::string complaint(const Law& law);
/// Of a directional law, in its axes, at each of the temperatures of its tables; none of others.
[[nodiscard]] std::vector<Tangent3> stiffnesses_of(const Law& law);
[[nodiscard]] double density(const Law& law);
/// Of the unloaded material.
[[nodiscard]] Isotropic unloaded(const Law& law);
[[nodiscard]] std::string_view key_of(const Law& law);
/// Empty if all constants are in their ranges, else which one is not and what is needed.
[[nodiscard]] std::string range_problem(const Law& law);

/// Stress for a given strain E = (C - I)/2 (or small strain), all four components free.
///
/// Input      memory: of the point, for laws that remember
/// Returns    second Piola-Kirchhoff stress and dS/dE (finite), Cauchy stress (small)
/// Tested by  tests/unit/material/test_laws.cpp
[[nodiscard]] Response response(const Law& law, const Strain& strain, const Memory& memory = {});
/// The same in space. Only for a value of type Strain3: expressions are strains of four components.
///
/// Tested by  tests/unit/material/test_space.cpp
template <std::same_as<Strain3> S>
[[nodiscard]] Response3 response(const Law& law, const S& strain, const Memory& memory = {});

/// The stress alone; `ok` as in the response.
///
/// Tested by  tests/unit/solid/test_finite_forces.cpp
[[nodiscard]] StressOf<4> stress(const Law& law, const Strain& strain, const Memory& memory = {});
[[nodiscard]] StressOf<6> stress(const Law& law, const Strain3& strain, const Memory& memory = {});

/// The same with S33 = 0: E33 is found (closed form, or Newton to round-off) and condensed, so that
/// rows and columns 33 of the tangent are zero.
/// `strain[2]` is ignored; `strain_33` (if given) receives the one found.
///
/// Tested by  tests/unit/material/test_plane_stress.cpp
[[nodiscard]] Response plane_stress_response(const Law& law, const Strain& strain,
                                             double* strain_33 = nullptr,
                                             const Memory& memory = {});

}  // namespace osculate::material
