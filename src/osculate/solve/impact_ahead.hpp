#pragma once
#include <array>
#include <vector>

namespace osculate::solve {

/// The next impact of a committed state, as seen from there.
struct ImpactAhead {
  double share = 0;  ///< of the time to the fraction that was asked for; it may be beyond
  std::vector<std::array<std::size_t, 2>> points;  ///< pair and point
};

}  // namespace osculate::solve
