#pragma once
#include <string>
#include <variant>

#include "osculate/contact/law/coulomb.hpp"
#include "osculate/contact/law/damping.hpp"
#include "osculate/contact/law/normal_exponential.hpp"
#include "osculate/contact/law/normal_penalty.hpp"
#include "osculate/contact/law/normal_table.hpp"
#include "osculate/contact/law/rough.hpp"
#include "osculate/contact/law/tresca.hpp"

namespace osculate::contact {

/// The laws there are. A law is dispatched once per call for a point.
using NormalLaw = std::variant<NormalPenalty, NormalExponential, NormalTable>;
using FrictionLaw = std::variant<Coulomb, Tresca, Rough>;
using DampingLaw = std::variant<Viscous, Restitution>;

/// Normal traction at a gap; with `held` also of a point that is pulled, where the law allows it.
[[nodiscard]] inline NormalResponse response(const NormalLaw& law, double gap, bool held = false) {
  return std::visit([&](const auto& l) { return l.response(gap, held); }, law);
}
/// Work that the normal traction has taken up at a gap, per weight: -dU/dgap = pressure.
///
/// Tested by  tests/unit/contact/test_normal_laws.cpp
[[nodiscard]] inline double stored_energy(const NormalLaw& law, double gap, bool held = false) {
  return std::visit([&](const auto& l) { return l.energy(gap, held); }, law);
}
/// The normal law with damping.
[[nodiscard]] inline NormalResponse damped(const DampingLaw& damping, const NormalLaw& law,
                                           double gap, const Closing& closing) {
  return std::visit([&](const auto& d, const auto& l) { return d.response(l, gap, closing); },
                    damping, law);
}
/// Largest gap with contact.
[[nodiscard]] inline double reach(const NormalLaw& law) {
  return std::visit([](const auto& l) { return l.reach(); }, law);
}
/// Whether the law is a means to an end (no penetration) that a multiplier serves better.
[[nodiscard]] inline bool augmentable(const NormalLaw& law) {
  return std::visit([](const auto& l) { return l.augmentable; }, law);
}

/// Whether the law goes on where a held point is pulled.
[[nodiscard]] inline bool holds(const NormalLaw& law) {
  return std::holds_alternative<NormalPenalty>(law);
}

/// eps_N of a linear law; 0: the law has none.
[[nodiscard]] inline double penalty_of(const NormalLaw& law) {
  const auto* const penalty = std::get_if<NormalPenalty>(&law);
  return penalty ? penalty->stiffness : 0.0;
}

/// What is wrong with the numbers of a law; empty: nothing.
///
/// Tested by  tests/unit/contact/test_normal_laws.cpp, test_friction_laws.cpp,
/// test_damping.cpp
[[nodiscard]] std::string fault(const NormalLaw& law);
[[nodiscard]] std::string fault(const FrictionLaw& law);
[[nodiscard]] std::string fault(const DampingLaw& law);

/// Largest slope of the pressure of a penalty with damping.
[[nodiscard]] inline double stiffest(const DampingLaw& law, double penalty, double duration) {
  return std::visit([&](const auto& l) { return l.stiffest(penalty, duration); }, law);
}
/// eps_T
[[nodiscard]] inline double stiffness(const FrictionLaw& law) {
  return std::visit([](const auto& l) { return l.stiffness; }, law);
}
/// The same law with another eps_T.
[[nodiscard]] inline FrictionLaw stiffened(FrictionLaw law, double factor) {
  std::visit([&](auto& l) { l.stiffness *= factor; }, law);
  return law;
}
template <int Dim>
[[nodiscard]] TangentialResponse<Dim> response(const FrictionLaw& law, const Vec<Dim - 1>& trial,
                                               double normal_traction, const Sliding& sliding) {
  return std::visit(
      [&](const auto& l) { return l.template response<Dim>(trial, normal_traction, sliding); },
      law);
}
/// At which limit a sliding point is expected to go on, before the first iteration.
[[nodiscard]] inline SlipLimit predicted_limit(const FrictionLaw& law, double trial,
                                               double normal_traction, const Sliding& sliding) {
  SlipLimit limit = std::visit(
      [&](const auto& l) {
        return l.predicted_limit(trial, pressure_of(normal_traction), sliding);
      },
      law);
  if (normal_traction > 0) limit.d_pressure = 0;
  return limit;
}
/// Whether the law asks how long an increment lasts.
[[nodiscard]] inline bool needs_duration(const FrictionLaw& law) {
  const auto* const coulomb = std::get_if<Coulomb>(&law);
  return coulomb && coulomb->change && coulomb->change->by == FrictionChange::By::speed;
}
[[nodiscard]] inline bool needs_duration(const DampingLaw& law) {
  return std::holds_alternative<Viscous>(law);
}

}  // namespace osculate::contact
