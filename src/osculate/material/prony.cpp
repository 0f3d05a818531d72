#include "osculate/material/prony.hpp"

#include <algorithm>
#include <cmath>

namespace osculate::material {

double left_in_the_mean(double x) { return x > 0 ? -std::expm1(-x) / x : 1; }

double remaining(const core::Table& series) {
  double rest = 1;
  for (const auto& term : series) rest -= term[0];
  return rest;
}

std::size_t terms_of(const core::Table& shear, const core::Table& bulk) {
  return std::max(shear.size(), bulk.size());
}

std::optional<core::Fault> fault_of_series(const core::Table& shear, const core::Table& bulk) {
  if (shear.empty() && bulk.empty())
    return core::Fault{"give `shear` or `bulk`: without, nothing relaxes"};
  constexpr double round_off = 1e-12;
  const auto wrong = [](const core::Table& series,
                        std::string_view key) -> std::optional<core::Fault> {
    for (std::size_t i = 0; i < series.size(); ++i) {
      if (!(series[i][0] >= 0)) return core::Fault{"shares are not negative", key, i};
      if (!(series[i][1] > 0)) return core::Fault{"times are greater than 0", key, i};
    }
    if (series.size() > Relaxation::most)
      return core::Fault{"a series has at most 20 terms", key, {}};
    if (!(remaining(series) > round_off))
      return core::Fault{"the sum of the shares is less than 1: something remains", key, {}};
    return std::nullopt;
  };
  if (auto fault = wrong(shear, "shear")) return fault;
  return wrong(bulk, "bulk");
}

std::optional<core::Fault> Relaxation::fault() const { return fault_of_series(shear, bulk); }

}  // namespace osculate::material
