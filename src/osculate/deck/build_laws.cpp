// The laws of a contact pair from their description.
#include <fmt/format.h>

#include <algorithm>

#include "osculate/contact/law/coulomb.hpp"
#include "osculate/contact/law/damping.hpp"
#include "osculate/contact/law/normal_exponential.hpp"
#include "osculate/contact/law/normal_table.hpp"
#include "osculate/contact/law/rough.hpp"
#include "osculate/contact/law/tresca.hpp"
#include "osculate/deck/build_contact_parts.hpp"

namespace osculate::deck {
namespace {

contact::NormalLaw normal_law(const Contact& contact) {
  const NormalDescription& n = contact.normal;
  if (n.law.value == NormalWord::exponential)
    return contact::NormalExponential{n.pressure.value, n.clearance.value};
  if (n.law.value == NormalWord::table) return contact::NormalTable{n.table};
  return contact::penalty(contact.normal_penalty.value);
}

contact::FrictionLaw friction_law(const CoulombFriction& f, bool may_part) {
  constexpr double steep = 1e4;  // the angle of friction is 0.006 degrees short of a right angle
  if (f.law == FrictionWord::tresca) return contact::Tresca{f.limit.value, f.penalty.value};
  if (f.law == FrictionWord::rough)
    return may_part ? contact::Rough{f.penalty.value, steep} : contact::Rough{f.penalty.value};
  contact::Coulomb law{f.mu.value, f.penalty.value};
  if (f.cap) law.cap = f.cap->value;
  if (!f.kinetic) return law;
  using By = contact::FrictionChange::By;
  if (f.distance)
    law.change = {f.kinetic->value, f.distance->value, By::distance};
  else if (f.speed)
    law.change = {f.kinetic->value, f.speed->value, By::speed};
  return law;
}

std::optional<contact::DampingLaw> damping_law(const NormalDescription& n) {
  if (n.viscous) return contact::Viscous{n.viscous->value};
  if (n.restitution) return contact::Restitution{n.restitution->value};
  return std::nullopt;
}

/// A speed needs a time.
template <int Dim>
void check_durations(const BuildContext<Dim>& c, const std::optional<Number>& by_speed,
                     const char* what) {
  if (!by_speed) return;
  for (const Step& step : c.description.steps)
    if (!step.duration)
      throw core::InputError(
          by_speed->mark, fmt::format("{} needs the duration of every step, and step '{}' has none",
                                      what, step.name.value));
}

template <int Dim>
void set_separation(const BuildContext<Dim>& c, const Contact& contact,
                    pairing::PairDefinition<Dim>& pair) {
  using pairing::Separation;
  constexpr double near = 0.05;  // of the facets' size
  const NormalDescription& n = contact.normal;
  const auto refuse = [&](const char* why) { throw core::InputError(n.separation.mark, why); };
  pair.separation = n.separation.value == SeparationWord::allowed ? Separation::allowed
                    : n.separation.value == SeparationWord::no_separation
                        ? Separation::no_separation
                    : n.separation.value == SeparationWord::tied_normal ? Separation::tied_normal
                                                                        : Separation::tied;
  if (pair.separation == Separation::allowed || pair.separation == Separation::no_separation)
    return;
  if (contact.all || pair.scope.own)
    refuse("a surface cannot be tied to itself: name master and slave");
  if (pair.edges.on)
    refuse(
        "crossings of edges are found while the bodies move: they cannot be tied from the start");
  pair.keep_gap = n.initial_gap.value == InitialGap::keep;
  const double size = mean_size<Dim>(pair.master, c.model().reference);
  if (!n.tolerance && !(size > 0)) refuse("the master has no facets to measure: give a tolerance");
  pair.tolerance = n.tolerance ? n.tolerance->value : near * size;
}

}  // namespace

template <int Dim>
void set_laws(const BuildContext<Dim>& c, const Contact& contact,
              pairing::PairDefinition<Dim>& pair) {
  pair.normal = normal_law(contact);
  pair.offset = contact.offset;
  pair.damping = damping_law(contact.normal);
  check_durations(c, contact.normal.viscous, "damping that depends on speed");
  if (contact.friction) {
    check_durations(c, contact.friction->speed, "friction that depends on speed");
    pair.friction =
        friction_law(*contact.friction, contact.normal.separation.value == SeparationWord::allowed);
  }
  set_separation(c, contact, pair);
}

template <int Dim>
void note_tied(BuildContext<Dim>& c, const Contact& contact,
               const pairing::PairDefinition<Dim>& pair) {
  using pairing::Separation;
  if (pair.separation != Separation::tied && pair.separation != Separation::tied_normal) return;
  const auto state = pairing::initial_state<Dim>(pair, c.model().reference);
  const auto held = std::count_if(state.points.begin(), state.points.end(),
                                  [](const auto& point) { return point.held; });
  if (held == 0)
    throw core::InputError(
        contact.normal.separation.mark,
        fmt::format("no point of the slave '{}' is within {:g} of the master '{}': nothing is tied",
                    contact.slave.value, pair.tolerance, contact.master.value));
  c.built.notes.push_back(fmt::format("contact '{}': {} of {} points are tied (within {:g})",
                                      contact.name.value, held, state.points.size(),
                                      pair.tolerance));
}

template void set_laws(const BuildContext<2>&, const Contact&, pairing::PairDefinition<2>&);
template void set_laws(const BuildContext<3>&, const Contact&, pairing::PairDefinition<3>&);
template void note_tied(BuildContext<2>&, const Contact&, const pairing::PairDefinition<2>&);
template void note_tied(BuildContext<3>&, const Contact&, const pairing::PairDefinition<3>&);

}  // namespace osculate::deck
