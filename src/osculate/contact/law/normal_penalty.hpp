#pragma once
#include <string_view>

#include "osculate/contact/law/normal_response.hpp"
#include "osculate/contact/law/penalty_param.hpp"

namespace osculate::contact {

/// Linear penalty.
///
/// Formula    N = eps_N zeta for zeta <= 0, otherwise 0 ; zeta == 0 counts as active; of a point
///            that is held also for zeta > 0
/// Source     KS2D:32
/// Units      eps_N: force per length (weight node) or force per length^3 (area weights)
/// Tested by  tests/unit/contact/test_laws.cpp
struct NormalPenalty {
  static constexpr std::string_view key = "penalty", words = "penalty {}";
  static constexpr bool augmentable = true;  ///< a multiplier may replace the penalty's traction
  static constexpr bool holds = true;        ///< it goes on where a held point is pulled
  double stiffness = 0;

  static constexpr auto params() {
    return std::array{penalty_param<NormalPenalty>(
        "", "Stiffness against penetration, unless there is another law.", from_compression)};
  }

  [[nodiscard]] double onset_gap() const { return 0; }
  [[nodiscard]] NormalResponse response(double gap, bool held = false) const {
    if (gap > 0 && !held) return {};
    const double traction = stiffness * gap;  // @eq KS2D:32
    return {true, traction, stiffness};
  }
  /// Work that the traction has taken up, per weight.
  [[nodiscard]] double energy(double gap, bool held = false) const {
    return gap > 0 && !held ? 0.0 : 0.5 * stiffness * gap * gap;
  }
};

}  // namespace osculate::contact
