#pragma once
// Inside of the public library: multipliers of hosts in C.
#include <algorithm>
#include <span>

#include "osculate/embed/c_call.hpp"
#include "osculate/multipliers.hpp"

namespace osculate::embed {

template <int Dim>
[[nodiscard]] Multipliers<Dim> multipliers_from(const osculate_multipliers* given_ones) {
  Multipliers<Dim> out;
  if (given_ones == nullptr) return out;
  constexpr std::size_t width = Dim + 1;
  const auto values =
      array<const double>(given_ones->values, width * given_ones->points, "multipliers.values");
  out.points.resize(given_ones->points);
  for (std::size_t i = 0; i < out.points.size(); ++i) {
    out.points[i].normal = values[width * i];
    std::copy_n(&values[width * i + 1], Dim, out.points[i].shear.begin());
  }
  out.stiffening = given_ones->stiffening;
  out.violation = given_ones->violation;
  return out;
}

/// Into the array of the host, which has room for `points`.
template <int Dim>
osculate_status put(const Multipliers<Dim>& multipliers, osculate_multipliers* out) {
  osculate_multipliers& to = given(out, "multipliers");
  const osculate_status status = filled(to.values, to.points, multipliers.points.size(), [&] {
    double* at = to.values;
    for (const Multiplier<Dim>& m : multipliers.points) {
      *at++ = m.normal;
      at = std::copy(m.shear.begin(), m.shear.end(), at);
    }
  });
  if (status != osculate_ok) return status;
  to.stiffening = multipliers.stiffening;
  to.violation = multipliers.violation;
  return osculate_ok;
}

}  // namespace osculate::embed
