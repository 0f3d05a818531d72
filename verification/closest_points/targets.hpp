#pragma once
#include <string>
#include <vector>

#include "osculate/projection/target.hpp"

namespace osculate::verification {

/// A curve or surface to project on, and the same as a list of smooth charts.
template <int Dim>
struct SampleTarget {
  std::string name;
  projection::Target<Dim> target;
  int grid = 40;           ///< samples of a chart's side in the brute search
  bool one_facet = false;  ///< every local minimum over a chart is one of the whole
};

[[nodiscard]] std::vector<SampleTarget<2>> plane_targets();
[[nodiscard]] std::vector<SampleTarget<3>> space_targets();

}  // namespace osculate::verification
