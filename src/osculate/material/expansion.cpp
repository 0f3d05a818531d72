#include "osculate/material/expansion.hpp"

#include "osculate/material/over_temperature.hpp"

namespace osculate::material {

double expansion(const Expansion& law, double temperature, double before) {
  if (law.table.empty()) return 0;
  if (law.table.size() == 1) return law.table[0][1] * (temperature - before);
  const auto of = [&](double t) { return value_at(law.table, t) * (t - law.reference); };
  return of(temperature) - of(before);
}

}  // namespace osculate::material
