#include "osculate/material/expansion.hpp"

#include <Eigen/LU>

#include "osculate/material/between.hpp"
#include "osculate/material/orientation.hpp"
#include "osculate/material/over_temperature.hpp"

namespace osculate::material {
namespace {

Strain3 coefficients_at(const std::vector<Expansion::Directions>& rows, double temperature) {
  const auto at = between(rows, temperature, [](const auto& row) { return row.temperature; });
  return at.below.coefficients + at.weight * (at.above.coefficients - at.below.coefficients);
}

}  // namespace

double expansion(const Expansion& law, double temperature, double before) {
  if (law.table.empty()) return 0;
  if (law.table.size() == 1) return law.table[0][1] * (temperature - before);
  const auto of = [&](double t) { return value_at(law.table, t) * (t - law.reference); };
  return of(temperature) - of(before);
}

Strain3 expansion_by_directions(const Expansion& law, double temperature, double before) {
  const auto& rows = law.directions;
  if (rows.empty()) return Strain3::Zero();
  if (rows.size() == 1) return (temperature - before) * rows[0].coefficients;
  const auto of = [&](double t) -> Strain3 {
    return (t - law.reference) * coefficients_at(rows, t);
  };
  return of(temperature) - of(before);
}

FreeExpansion free_expansion(bool finite, const Strain3& e) {
  FreeExpansion out;
  out.strain = e;
  if (!finite) return out;
  Mat<3, 3> tensor;
  tensor << e[0], 0.5 * e[3], 0.5 * e[5], 0.5 * e[3], e[1], 0.5 * e[4], 0.5 * e[5], 0.5 * e[4],
      e[2];
  const Mat<3, 3> stretch = Mat<3, 3>::Identity() + tensor;
  const Mat<3, 3> free = tensor + 0.5 * tensor * tensor;
  out.strain << free(0, 0), free(1, 1), free(2, 2), 2 * free(0, 1), 2 * free(1, 2), 2 * free(0, 2);
  out.into = into_axes(stretch.inverse());
  out.back = into_axes(stretch);
  out.volume = stretch.determinant();
  return out;
}

}  // namespace osculate::material
