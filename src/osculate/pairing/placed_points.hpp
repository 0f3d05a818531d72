#pragma once
#include <vector>

#include "osculate/pairing/pair.hpp"

namespace osculate::pairing {

/// Which points of the slave lie over or behind a place of the master, not beyond its border: those
/// that `InitialOverlap::given` gives a clearance.
///
/// Tested by  tests/unit/api/test_without_clearance.cpp
template <int Dim>
[[nodiscard]] std::vector<bool> placed_points(const PairDefinition<Dim>& pair, Points<Dim> x);

}  // namespace osculate::pairing
