#pragma once
#include <string_view>

#include "osculate/contact/law/penalty_param.hpp"
#include "osculate/contact/law/tangential.hpp"

namespace osculate::contact {

/// Friction of a thin film: the shear traction is proportional to the sliding speed, whatever the
/// pressure.
///
/// Formula    t = c V , V = s / h , s slid in the increment of duration h (backward Euler):
///            |t_tr| = |t| + eps_T s ,  t = t_tr c / (c + eps_T h)
/// Returns    the trial where the duration is not known: nothing has slid yet
/// Units      c: pressure per speed (force per speed with weight node)
/// Tested by  tests/unit/contact/test_friction_laws.cpp
struct ViscousFriction {
  static constexpr std::string_view key = "viscous", words = "viscous {coefficient}",
                                    doc = "Shear traction in proportion to the sliding speed.";
  double coefficient = 0;  ///< c
  double stiffness = 0;    ///< eps_T

  static constexpr auto params() {
    return std::array<core::Param<ViscousFriction>, 2>{
        {{.key = "coefficient",
          .unit = "force time/length^3 (force time/length with weight: node)",
          .doc = "Shear traction per sliding speed; every step needs a duration.",
          .slot = &ViscousFriction::coefficient,
          .range = {.lower = 0, .with_lower = true},
          .example = "0.5",
          .timed = true},
         shear_penalty_param<ViscousFriction>()}};
  }

  [[nodiscard]] SlipLimit predicted_limit(double trial, double, const Sliding& sliding) const {
    if (!(sliding.duration > 0)) return {trial, 1, 0};
    const double share = coefficient / (coefficient + stiffness * sliding.duration);
    return {share * trial, share, 0};
  }
  template <int Dim>
  [[nodiscard]] TangentialResponse<Dim> response(const Vec<Dim - 1>& trial, double,
                                                 const Sliding& sliding = {}) const {
    const double size = length_of<Dim>(trial);
    if (!(sliding.duration > 0) || !(size > 0)) return stick_response<Dim>(trial);
    return slip_response<Dim>(trial / size, size, predicted_limit(size, 0, sliding));
  }
};

}  // namespace osculate::contact
