#pragma once
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "osculate/contact/law/normal_response.hpp"
#include "osculate/core/param.hpp"

namespace osculate::contact {

/// Pressure that is linear far inside, and tension that holds what is apart, up to a clearance.
///
/// Formula    p = K h (1/2 + atan(h / e) / pi) ,  h = -zeta ,  e = pi sigma / K ,  for
///            zeta <= c_0, else 0: zero at zeta = 0 with the slope K / 2; K h - sigma far inside,
///            -sigma far outside. It grows with h everywhere, and jumps to zero at c_0
/// Source     the linear pressure-overclosure relationship of node-to-face contact in CalculiX (ccx
///            2.20 User's Manual, *SURFACE BEHAVIOR), measured: docs/decisions/055
/// Units      K: force per length^3, sigma: force per area (weight node: times an area); c_0:
///            length
/// Tested by  tests/unit/contact/test_normal_laws.cpp
struct NormalTensile {
  static constexpr std::string_view key = "tensile",
                                    words =
                                        "tensile {stiffness}, pulls up to {tension} within "
                                        "{clearance}",
                                    doc =
                                        "Pressure that is linear inside of the master, with a "
                                        "tension in front of it: the linear law of CalculiX.";
  double stiffness_inside = 0;  ///< K
  double tension = 0;           ///< sigma
  double clearance = 0;         ///< c_0

  static constexpr auto params() {
    return std::array<core::Param<NormalTensile>, 3>{
        {{.key = "stiffness",
          .unit = "force/length^3",
          .doc = "Slope of the pressure far inside.",
          .slot = &NormalTensile::stiffness_inside,
          .range = {.lower = 0},
          .example = "1e6"},
         {.key = "tension",
          .unit = "force/length^2",
          .doc = "Tension that is reached far outside.",
          .slot = &NormalTensile::tension,
          .range = {.lower = 0},
          .example = "3"},
         {.key = "clearance",
          .unit = "length",
          .doc = "Gap at which the surfaces let go.",
          .slot = &NormalTensile::clearance,
          .range = {.lower = 0},
          .example = "0.001"}}};
  }

  [[nodiscard]] double onset_gap() const { return clearance; }
  [[nodiscard]] NormalResponse response(double gap, bool = false) const {
    if (gap > clearance) return {};
    const double x = -gap / width(), share = share_of(-gap);
    return {true, stiffness_inside * gap * share,
            stiffness_inside * (share + x / (std::numbers::pi * (1 + x * x)))};
  }
  /// Work that the traction has taken up, per weight: negative where the surfaces still pull.
  [[nodiscard]] double energy(double gap, bool = false) const {
    return gap > clearance ? 0 : work(-gap) - work(-clearance);
  }
  /// Integral of the pressure over the overclosure, from 0 on.
  [[nodiscard]] double work(double h) const {
    const double e = width(), share = share_of(h);
    return stiffness_inside *
           (0.5 * h * h * share + 0.5 * e * e * (share - 0.5) - 0.5 * e * h / std::numbers::pi);
  }

 private:
  [[nodiscard]] double width() const { return std::numbers::pi * tension / stiffness_inside; }
  /// 1/2 + atan(h / e) / pi, with all its digits far outside, where it is nearly nothing.
  [[nodiscard]] double share_of(double h) const {
    return std::atan2(width(), -h) / std::numbers::pi;
  }
};

}  // namespace osculate::contact
