#pragma once
#include <cmath>
#include <limits>
#include <string_view>

#include "osculate/contact/law/coulomb.hpp"

namespace osculate::contact {

/// No sliding while in contact: t = t_tr.
///
/// A point that parts while it is sheared has no equilibrium: sticking its shear traction pulls it
/// off, open it penetrates. Coulomb's law has one for every coefficient, sliding at little
/// pressure; so points that may part slide where |t| is above `coefficient` p, p hardly anything.
/// Held points (no separation) do not.
///
/// Tested by  tests/unit/contact/test_friction_laws.cpp
struct Rough {
  static constexpr std::string_view key = "rough", words = "rough",
                                    doc = "No sliding while in contact.";
  static constexpr double steep = 1e4;  ///< 0.006 degrees short of a right angle
  double stiffness = 0;                 ///< eps_T
  double coefficient = std::numeric_limits<double>::infinity();  ///< infinity: never slides

  static constexpr auto params() { return std::array{shear_penalty_param<Rough>()}; }
  [[nodiscard]] std::optional<core::Fault> fault() const {
    if (coefficient > 0) return std::nullopt;
    return core::Fault{core::out_of_range("coefficient", coefficient, {.lower = 0})};
  }
  /// The law of points that may part.
  [[nodiscard]] Rough parting() const { return {stiffness, std::min(coefficient, steep)}; }

  [[nodiscard]] SlipLimit predicted_limit(double trial, double pressure,
                                          const Sliding& sliding) const {
    if (!std::isfinite(coefficient)) return {coefficient, 0, 0};
    return sliding_law().predicted_limit(trial, pressure, sliding);
  }
  template <int Dim>
  [[nodiscard]] TangentialResponse<Dim> response(const Vec<Dim - 1>& trial, double normal_traction,
                                                 const Sliding& sliding = {}) const {
    if (!std::isfinite(coefficient)) return stick_response<Dim>(trial);
    return sliding_law().template response<Dim>(trial, normal_traction, sliding);
  }

 private:
  [[nodiscard]] Coulomb sliding_law() const { return {coefficient, stiffness}; }
};

}  // namespace osculate::contact
