#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "osculate/contact/law/normal_response.hpp"
#include "osculate/core/param.hpp"

namespace osculate::contact {

/// Pressure that grows exponentially from a clearance on.
///
/// Formula    p = p_0 / (e - 1) x (exp(x) - 1) ,  x = 1 - zeta / c_0 >= 0 :
///            zero with zero slope at the clearance c_0, p_0 at zero clearance; beyond an
///            overclosure of 6 c_0 the tangent there (nothing overflows)
/// Source     the exponential pressure-overclosure relationship of Abaqus (Theory Guide,
///            "Small-sliding interaction between bodies"); the tangent is this program's
/// Units      p_0: force per area (force with weight node); c_0: length
/// Tested by  tests/unit/contact/test_normal_laws.cpp
struct NormalExponential {
  static constexpr std::string_view key = "exponential",
                                    words = "exponential {pressure} within {clearance}",
                                    doc =
                                        "Pressure that grows exponentially: p = p0 / (e - 1) x "
                                        "(exp(x) - 1), x = 1 - gap / clearance.";
  double pressure = 0;               ///< p_0
  double clearance = 0;              ///< c_0
  static constexpr double last = 7;  ///< x at an overclosure of 6 c_0

  static constexpr auto params() {
    return std::array<core::Param<NormalExponential>, 2>{{{.key = "pressure",
                                                           .unit = "force/length^2",
                                                           .doc = "Pressure p0 at zero gap.",
                                                           .slot = &NormalExponential::pressure,
                                                           .range = {.lower = 0},
                                                           .example = "12"},
                                                          {.key = "clearance",
                                                           .unit = "length",
                                                           .doc = "Gap at which it begins.",
                                                           .slot = &NormalExponential::clearance,
                                                           .range = {.lower = 0},
                                                           .example = "0.01"}}};
  }

  [[nodiscard]] double onset_gap() const { return clearance; }
  [[nodiscard]] NormalResponse response(double gap, bool = false) const {
    if (gap > clearance) return {};
    const double x = 1 - gap / clearance;
    const double at = x < last ? x : last;
    const double scale = pressure / (std::numbers::e - 1);
    const double slope = scale * (std::exp(at) * (1 + at) - 1);  // dp/dx
    const double p = scale * at * std::expm1(at) + slope * (x - at);
    return {true, -p, slope / clearance};
  }
  /// Work that the traction has taken up, per weight.
  [[nodiscard]] double energy(double gap, bool = false) const {
    if (gap > clearance) return 0;
    const double x = 1 - gap / clearance, at = std::min(x, last), rest = x - at;
    const double scale = pressure / (std::numbers::e - 1);
    const double slope = scale * (std::exp(at) * (1 + at) - 1);
    const double up_to = scale * ((at - 1) * std::exp(at) + 1 - 0.5 * at * at);
    return clearance * (up_to + rest * (scale * at * std::expm1(at) + 0.5 * slope * rest));
  }
};

}  // namespace osculate::contact
