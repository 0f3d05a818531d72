#pragma once
// Stresses at several points at once, those of one cell or one of each of several cells: the
// processor takes several of them in one operation.
#include <array>

#include "osculate/core/pack.hpp"
#include "osculate/material/catalogue.hpp"

namespace osculate::material {

/// One number at each of Q points.
template <int Q>
using Lanes = Eigen::Array<double, Q, 1>;
/// A strain or stress of N components at each of Q points.
template <int N, int Q>
using Pointwise = std::array<Lanes<Q>, static_cast<std::size_t>(N)>;

/// The stresses alone, equal to those of `stress` up to round-off.
///
/// Returns    false where the law has no answer at one of the points
/// Tested by  tests/unit/solid/test_finite_forces.cpp
template <int N, int Q>
[[nodiscard]] bool stresses(const Law& law, const Pointwise<N, Q>& strain, const Memory& memory,
                            Pointwise<N, Q>& out);

/// The same at `count` points of each of several cells, of laws that remember nothing.
///
/// Tested by  tests/unit/solid/test_batch.cpp
template <int N>
[[nodiscard]] bool stresses(const Law& law, std::size_t count,
                            const std::array<core::Pack, static_cast<std::size_t>(N)>* strain,
                            std::array<core::Pack, static_cast<std::size_t>(N)>* out);

/// Whether these are calculated at once; of other laws one point comes after the other, by its
/// whole tangent.
[[nodiscard]] bool at_once(const Law& law);

/// Stored energies per reference volume of such points (energy.hpp).
template <int N>
[[nodiscard]] core::Pack stored_energies(
    const Law& law, const std::array<core::Pack, static_cast<std::size_t>(N)>& strain);

}  // namespace osculate::material
