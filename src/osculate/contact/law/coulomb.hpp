#pragma once
#include <cmath>
#include <cstdint>
#include <string_view>

namespace osculate::contact {

enum class Status : std::uint8_t { open = 0, stick = 1, slip = 2 };

/// The smooth piece of the friction law that an iteration was linearised in.
enum class Branch : std::uint8_t { none, stick, slip_forward, slip_backward };

/// Tangential traction t (physical, along tau) and its derivatives.
struct TangentialResponse {
  Status status = Status::stick;
  double traction = 0;  ///< t
  double d_trial = 0;   ///< dt/dt_trial
  double d_normal = 0;  ///< dt/dN
};

/// Coulomb friction by return mapping from an elastic trial.
///
/// Formula    t = t_tr                   if |t_tr| <= mu |N|   (stick)
///            t = mu |N| sgn(t_tr)       otherwise             (slip)
/// Source     KS2D:76, KS2D:57 in physical components (T = sqrt(a11) t), signs of docs/errata.md
/// Sign       the force on the slave's residual is +t tau for a slip in the direction +tau
/// Tested by  tests/unit/contact/test_laws.cpp
struct Coulomb {
  static constexpr std::string_view key = "coulomb";
  double mu = 0;
  double stiffness = 0;  ///< eps_T, units as eps_N

  [[nodiscard]] TangentialResponse response(double trial, double normal_traction) const {
    // @eq KS2D:77
    const double limit = mu * std::abs(normal_traction);
    if (std::abs(trial) <= limit) return {Status::stick, trial, 1.0, 0.0};
    return slip(trial > 0 ? 1.0 : -1.0, normal_traction);
  }

  /// The slip branch, whatever the trial.
  [[nodiscard]] TangentialResponse slip(double sign, double normal_traction) const {
    const double traction = sign * mu * std::abs(normal_traction);  // @eq KS2D:57
    return {Status::slip, traction, 0.0, -sign * mu};
  }
  /// The stick branch without its limit.
  [[nodiscard]] static TangentialResponse stick(double trial) {
    return {Status::stick, trial, 1.0, 0.0};
  }
};

}  // namespace osculate::contact
