#pragma once
// Stresses at all points of a cell at once: the processor takes several points in one operation.
#include <array>

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

}  // namespace osculate::material
