#pragma once
#include <array>
#include <cmath>
#include <string_view>

#include "osculate/contact/law/penalty_param.hpp"
#include "osculate/contact/law/tangential.hpp"

namespace osculate::contact {

/// Friction whose limit goes smoothly from Coulomb's to one shear traction: a law that only this
/// test has.
///
/// Formula    L = tau (1 - exp(-mu p / tau))
struct Saturating {
  static constexpr std::string_view key = "saturating",
                                    words = "saturating {mu} at {limit}[ above {least}]",
                                    doc = "Coulomb's law for small pressures, Tresca's for large.";
  double mu = 0, limit = 1, stiffness = 0;
  std::optional<double> least{};  ///< pressure below which there is no friction

  static constexpr auto params() {
    return std::array<core::Param<Saturating>, 4>{
        {{.key = "mu",
          .unit = "1",
          .doc = "Coefficient of friction at small pressures.",
          .slot = &Saturating::mu,
          .range = {.lower = 0, .with_lower = true},
          .example = "0.3"},
         {.key = "limit",
          .unit = "force/length^2",
          .doc = "Shear traction at large pressures.",
          .slot = &Saturating::limit,
          .range = {.lower = 0},
          .example = "3"},
         {.key = "least",
          .unit = "force/length^2",
          .doc = "Pressure below which there is no friction.",
          .slot = &Saturating::least,
          .range = {.lower = 0},
          .required = false,
          .example = "0.1",
          .otherwise = "none"},
         shear_penalty_param<Saturating>()}};
  }
  [[nodiscard]] SlipLimit predicted_limit(double, double pressure, const Sliding&) const {
    const double most = least && pressure < *least ? 0 : limit;
    const double rest = std::exp(-mu * pressure / limit);
    return {most * (1 - rest), 0, most / limit * mu * rest};
  }
  template <int Dim>
  [[nodiscard]] TangentialResponse<Dim> response(const Vec<Dim - 1>& trial, double normal_traction,
                                                 const Sliding& sliding = {}) const {
    SlipLimit most = predicted_limit(0, pressure_of(normal_traction), sliding);
    if (normal_traction > 0) most.d_pressure = 0;
    const double size = length_of<Dim>(trial);
    if (size <= most.value) return stick_response<Dim>(trial);
    return slip_response<Dim>(trial / size, size, most);
  }
};

}  // namespace osculate::contact
