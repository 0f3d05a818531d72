#pragma once
#include <array>
#include <string_view>

#include "osculate/contact/law/normal_response.hpp"
#include "osculate/core/param.hpp"

namespace osculate::contact {

/// Pressure that grows with the square of the overclosure: a law that only this test has.
///
/// Formula    p = k h^2 ,  h = -zeta > 0
struct Quadratic {
  static constexpr std::string_view key = "quadratic", words = "quadratic {factor}",
                                    doc = "Pressure over the square of the overclosure.";
  double factor = 0;

  static constexpr auto params() {
    return std::array<core::Param<Quadratic>, 1>{{{.key = "factor",
                                                   .unit = "force/length^4",
                                                   .doc = "Pressure over overclosure squared.",
                                                   .slot = &Quadratic::factor,
                                                   .range = {.lower = 0},
                                                   .example = "400"}}};
  }
  [[nodiscard]] double onset_gap() const { return 0; }
  [[nodiscard]] NormalResponse response(double gap, bool = false) const {
    if (gap > 0) return {};
    return {true, -factor * gap * gap, -2 * factor * gap};
  }
  [[nodiscard]] double energy(double gap, bool = false) const {
    return gap > 0 ? 0.0 : -factor * gap * gap * gap / 3;
  }
};

}  // namespace osculate::contact
