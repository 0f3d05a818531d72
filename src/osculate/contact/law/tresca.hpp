#pragma once
#include <string_view>

#include "osculate/contact/law/penalty_param.hpp"
#include "osculate/contact/law/tangential.hpp"

namespace osculate::contact {

/// Friction with one shear traction for every pressure, by return mapping from an elastic
/// predictor.
///
/// Formula    t = t_tr if |t_tr| <= tau ,  t = tau t_tr / |t_tr| otherwise
/// Units      tau: force per area; force with weight node
/// Tested by  tests/unit/contact/test_friction_laws.cpp
struct Tresca {
  static constexpr std::string_view key = "tresca", words = "Tresca {limit}",
                                    doc =
                                        "One shear traction for every pressure, with an elastic "
                                        "stick range.";
  double limit_traction = 0;
  double stiffness = 0;  ///< eps_T

  static constexpr auto params() {
    return std::array<core::Param<Tresca>, 2>{{{.key = "limit",
                                                .unit = "force/length^2 (force with weight: node)",
                                                .doc = "Shear traction while sliding.",
                                                .slot = &Tresca::limit_traction,
                                                .range = {.lower = 0, .with_lower = true},
                                                .example = "40"},
                                               shear_penalty_param<Tresca>()}};
  }

  [[nodiscard]] SlipLimit predicted_limit(double, double, const Sliding&) const {
    return {limit_traction, 0, 0};
  }
  template <int Dim>
  [[nodiscard]] TangentialResponse<Dim> response(const Vec<Dim - 1>& trial, double,
                                                 const Sliding& = {}) const {
    const double size = length_of<Dim>(trial);
    if (size <= limit_traction) return stick_response<Dim>(trial);
    return slip_response<Dim>(trial / size, size, {limit_traction, 0, 0});
  }
};

}  // namespace osculate::contact
