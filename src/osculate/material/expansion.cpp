#include "osculate/material/expansion.hpp"

#include <algorithm>

namespace osculate::material {
namespace {

double coefficient(const Expansion& law, double temperature) {
  const auto& t = law.table;
  const auto above =
      std::find_if(t.begin(), t.end(), [&](const auto& row) { return row[0] > temperature; });
  if (above == t.begin()) return t.front()[1];
  if (above == t.end()) return t.back()[1];
  const auto& [t0, a0] = *(above - 1);
  const auto& [t1, a1] = *above;
  return a0 + (a1 - a0) * (temperature - t0) / (t1 - t0);
}

}  // namespace

double expansion(const Expansion& law, double temperature, double before) {
  if (law.table.empty()) return 0;
  if (law.table.size() == 1) return law.table[0][1] * (temperature - before);
  const auto of = [&](double t) { return coefficient(law, t) * (t - law.reference); };
  return of(temperature) - of(before);
}

}  // namespace osculate::material
