#include "osculate/material/over_temperature.hpp"

#include "osculate/material/between.hpp"

namespace osculate::material {

double value_at(const core::Table& t, double temperature) {
  const auto at = between(t, temperature, [](const auto& row) { return row[0]; });
  return at.below[1] + at.weight * (at.above[1] - at.below[1]);
}

}  // namespace osculate::material
