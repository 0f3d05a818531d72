#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "osculate/core/param.hpp"
#include "osculate/material/memory.hpp"

namespace osculate::material {

/// Value of a table over the temperature: linear between its points and constant beyond.
///
/// Requires   the table is not empty, its temperatures increase
/// Tested by  tests/unit/material/test_over_temperature.cpp
[[nodiscard]] double value_at(const core::Table& table, double temperature);
/// The same of a constant that may be a table, at the temperature of a point (Memory::temperature).
[[nodiscard]] inline double value_at(const core::Table& table, double otherwise,
                                     const Memory& memory) {
  return table.empty() || !memory.temperature ? otherwise : value_at(table, *memory.temperature);
}

namespace detail {
template <class T>
constexpr bool any_over() {
  for (const core::Param<T>& p : T::params())
    if (p.over) return true;
  return false;
}
}  // namespace detail

/// A law of whose constants some may be tables over the temperature.
template <class T>
concept OverTemperature = requires {
  T::params();
}
&&detail::any_over<T>();

/// Whether some are, or curves differ with it.
template <OverTemperature T>
[[nodiscard]] bool has_tables(const T& law) {
  for (const core::Param<T>& p : T::params()) {
    const core::Table* const table = core::table_over(law, p);
    const core::Curves* const curves = core::curves_over(law, p);
    if ((table && !table->empty()) || (curves && curves->size() > 1)) return true;
  }
  return false;
}

/// The law at the temperature of a point (Memory::temperature), without tables.
template <OverTemperature T>
[[nodiscard]] T at_point(const T& law, const Memory& memory) {
  T here;
  for (const core::Param<T>& p : T::params())
    if (const core::Table* const table = core::table_over(law, p))
      core::set(here, p.slot, value_at(*table, *core::number_in(law, p.slot), memory));
    else if (const auto number = core::number_in(law, p.slot))
      core::set(here, p.slot, *number);
  return here;
}

/// All temperatures of tables, and so many in equal parts between each two of them.
template <OverTemperature T>
[[nodiscard]] std::vector<double> temperatures_of(const T& law, int between = 0) {
  std::vector<double> all;
  for (const core::Param<T>& p : T::params())
    if (const core::Table* const table = core::table_over(law, p))
      for (const auto& row : *table) all.push_back(row[0]);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  for (std::size_t i = 1, count = all.size(); i < count; ++i)
    for (int k = 1; k <= between; ++k)
      all.push_back(all[i - 1] + (all[i] - all[i - 1]) * k / (between + 1));
  return all;
}

/// The first fault that a law has at one of its temperatures; without tables its own.
template <OverTemperature T, class FaultOf>
[[nodiscard]] std::optional<core::Fault> fault_over_temperature(const T& law, int between,
                                                                const FaultOf& fault_of) {
  if (!has_tables(law)) return fault_of(law);
  Memory memory;
  for (const double temperature : temperatures_of(law, between)) {
    memory.temperature = &temperature;
    std::optional<core::Fault> fault = fault_of(at_point(law, memory));
    if (!fault) continue;
    fault->why += fmt::format(" (at the temperature {:g})", temperature);
    return fault;
  }
  return std::nullopt;
}

}  // namespace osculate::material
