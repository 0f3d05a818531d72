#include "osculate/material/over_temperature.hpp"

#include <algorithm>

namespace osculate::material {

double value_at(const core::Table& t, double temperature) {
  const auto above =
      std::find_if(t.begin(), t.end(), [&](const auto& row) { return row[0] > temperature; });
  if (above == t.begin()) return t.front()[1];
  if (above == t.end()) return t.back()[1];
  const auto& [t0, a0] = *(above - 1);
  const auto& [t1, a1] = *above;
  return a0 + (a1 - a0) * (temperature - t0) / (t1 - t0);
}

}  // namespace osculate::material
