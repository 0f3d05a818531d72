#pragma once
#include <string>
#include <vector>

#include "osculate/model/model.hpp"
#include "osculate/model/state.hpp"

namespace osculate::result {

/// Gaps of a pair's points before the first increment, as they are, whatever `initial` makes of
/// them; those below `rounding` are none.
struct GapFacts {
  int found = 0, touching = 0, overlapping = 0, edge_contacts = 0;
  int over_faces =
      0;  ///< of those found: the closest point lies inside a face, not on a border or edge
  double smallest = 0, largest = 0;
  std::size_t deepest = 0;  ///< point with the smallest gap
};
template <int Dim>
[[nodiscard]] GapFacts gap_facts(const pairing::PairState<Dim>& state, double rounding = 0);

/// A warning where the slave is so deep in the master that pushing it out at once is no model of
/// anything; else empty. Overlaps that were given a word of their own (`initial`) are meant.
///
/// Tested by  tests/unit/api/test_initial_gaps.cpp
template <int Dim>
[[nodiscard]] std::string deep_overlap(const model::BasicModel<Dim>& model,
                                       const model::BasicContactPair<Dim>& pair,
                                       const pairing::PairState<Dim>& state);

}  // namespace osculate::result
