#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "osculate/contact/law/normal_response.hpp"
#include "osculate/core/param.hpp"

namespace osculate::contact {

/// Pressure that falls to a hundredth over a clearance, and again over each further one.
///
/// Formula    p = p_0 (exp(-b zeta) - exp(-b 3 c_0)) ,  b = ln 100 / c_0 ,  zeta <= 3 c_0 : there
/// it
///            is zero (a millionth of p_0 is taken off); beyond an overclosure of 3 c_0 the tangent
///            there (nothing overflows)
/// Source     the exponential pressure-overclosure relationship of CalculiX (ccx 2.20 User's
///            Manual, *SURFACE BEHAVIOR), which has no zero; end and tangent are this program's
/// Units      p_0: force per area (force with weight node); c_0: length
/// Tested by  tests/unit/contact/test_normal_laws.cpp
struct NormalDecaying {
  static constexpr std::string_view key = "decaying",
                                    words = "decaying {pressure}, to 1 % at {clearance}",
                                    doc =
                                        "Pressure that decays with the gap: p = p0 x 100^(-gap / "
                                        "clearance), of which a millionth of p0 is taken off.";
  double pressure = 0;                ///< p_0
  double clearance = 0;               ///< c_0
  static constexpr double reach = 3;  ///< clearances, to both sides

  static constexpr auto params() {
    return std::array<core::Param<NormalDecaying>, 2>{
        {{.key = "pressure",
          .unit = "force/length^2",
          .doc = "Pressure p0 at zero gap.",
          .slot = &NormalDecaying::pressure,
          .range = {.lower = 0},
          .example = "12"},
         {.key = "clearance",
          .unit = "length",
          .doc = "Gap at which a hundredth of it is left.",
          .slot = &NormalDecaying::clearance,
          .range = {.lower = 0},
          .example = "0.01"}}};
  }

  [[nodiscard]] double onset_gap() const { return reach * clearance; }
  [[nodiscard]] NormalResponse response(double gap, bool = false) const {
    if (gap > onset_gap()) return {};
    const double rate = decay(), at = std::max(gap, -onset_gap()), rest = at - gap;
    const double p = pressure * std::exp(-rate * at), slope = rate * p;
    return {true, pressure * std::exp(-rate * onset_gap()) - p - slope * rest, slope};
  }
  /// Work that the traction has taken up, per weight.
  [[nodiscard]] double energy(double gap, bool = false) const {
    const double end = onset_gap();
    if (gap > end) return 0;
    const double rate = decay(), at = std::max(gap, -end), rest = at - gap;
    const double last = pressure * std::exp(-rate * end), p = pressure * std::exp(-rate * at);
    return (p - last) / rate - last * (end - at) + rest * (p - last + 0.5 * rate * p * rest);
  }

 private:
  [[nodiscard]] double decay() const { return 2 * std::numbers::ln10 / clearance; }
};

}  // namespace osculate::contact
