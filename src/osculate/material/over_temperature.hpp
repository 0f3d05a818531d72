#pragma once
#include "osculate/core/param.hpp"
#include "osculate/material/memory.hpp"

namespace osculate::material {

/// Value of a table over the temperature: linear between its points and constant beyond.
///
/// Requires   the table is not empty, its temperatures increase
/// Tested by  tests/unit/material/test_over_temperature.cpp
[[nodiscard]] double value_at(const core::Table& table, double temperature);

/// A law whose elastic constants may be tables over the temperature.
template <class T>
concept OverTemperature = requires(T law) {
  law.young_over = core::Table();
  law.poisson_over = core::Table();
};

/// The law at the temperature of a point (Memory::temperature).
template <OverTemperature T>
[[nodiscard]] T at_point(const T& law, const Memory& memory) {
  const auto of = [&](const core::Table& table, double otherwise) {
    return table.empty() || !memory.temperature ? otherwise : value_at(table, *memory.temperature);
  };
  T here;
  here.young = of(law.young_over, law.young);
  here.poisson = of(law.poisson_over, law.poisson);
  here.density = law.density;
  return here;
}

}  // namespace osculate::material
