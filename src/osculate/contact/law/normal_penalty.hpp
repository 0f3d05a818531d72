#pragma once
#include <string_view>

namespace osculate::contact {

/// Normal traction and its derivative with respect to the gap.
struct NormalResponse {
  bool active = false;
  double traction = 0;    ///< N <= 0 in contact (the reported pressure is -N)
  double d_traction = 0;  ///< dN/dzeta
};

/// Linear penalty.
///
/// Formula    N = eps_N zeta for zeta <= 0, otherwise 0 ; zeta == 0 counts as active
/// Source     KS2D:32
/// Units      eps_N: force per length (weight node) or force per length^3 (area weights)
/// Tested by  tests/unit/contact/test_laws.cpp
struct NormalPenalty {
  static constexpr std::string_view key = "penalty";
  double stiffness = 0;

  [[nodiscard]] NormalResponse response(double gap) const {
    if (gap > 0) return {};
    const double traction = stiffness * gap;  // @eq KS2D:32
    return {true, traction, stiffness};
  }
};

}  // namespace osculate::contact
