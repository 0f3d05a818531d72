#include "osculate/core/param.hpp"

#include <fmt/format.h>

#include <cmath>

namespace osculate::core {

std::string describe(const Range& range, std::string_view name) {
  const bool low = std::isfinite(range.lower), high = std::isfinite(range.upper);
  const std::string_view above = range.with_lower ? "=" : "", below = range.with_upper ? "=" : "";
  if (low && high)
    return fmt::format("{} <{} {} <{} {}", range.lower, above, name, below, range.upper);
  if (low) return fmt::format("{} >{} {}", name, above, range.lower);
  if (high) return fmt::format("{} <{} {}", name, below, range.upper);
  return fmt::format("{} is any number", name);
}

std::string bounds(const Range& range) {
  const bool low = std::isfinite(range.lower), high = std::isfinite(range.upper);
  if (!low && !high) return "finite";
  std::string text;
  if (low) text = fmt::format(">{} {}", range.with_lower ? "=" : "", range.lower);
  if (low && high) text += " and ";
  if (high) text += fmt::format("<{} {}", range.with_upper ? "=" : "", range.upper);
  return text;
}

std::string out_of_range(std::string_view name, double value, const Range& range) {
  return fmt::format("{} = {}, but {} is needed", name, value, describe(range, name));
}

}  // namespace osculate::core
