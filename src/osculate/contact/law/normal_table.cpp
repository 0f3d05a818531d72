#include "osculate/contact/law/normal_table.hpp"

#include <fmt/format.h>

namespace osculate::contact {

std::optional<core::Fault> NormalTable::fault() const {
  if (points.size() < 2) return core::Fault{"a table of pressures needs at least two points"};
  const auto at = [](std::size_t i, std::string why) { return core::Fault{std::move(why), {}, i}; };
  if (points[0][1] != 0) return at(0, "the first pressure of the table must be 0");
  for (std::size_t i = 1; i < points.size(); ++i) {
    const std::array<double, 2>&a = points[i - 1], &b = points[i];
    if (!(b[0] > a[0]))
      return at(i, fmt::format("overclosures must grow: {:g} follows {:g}", b[0], a[0]));
    if (!(b[1] >= a[1]))
      return at(i, fmt::format("pressures must not fall: {:g} follows {:g}", b[1], a[1]));
  }
  if (!(points.back()[1] > 0)) return core::Fault{"the table has no pressure > 0"};
  return std::nullopt;
}

}  // namespace osculate::contact
