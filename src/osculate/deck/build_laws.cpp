// The laws of a contact pair from their description.
#include <fmt/format.h>

#include <algorithm>

#include "osculate/deck/build_contact_parts.hpp"

namespace osculate::deck {
namespace {

template <int Dim>
void set_separation(const BuildContext<Dim>& c, const Contact& contact,
                    pairing::PairDefinition<Dim>& pair) {
  constexpr double near = 0.05;  // of the facets' size
  const NormalDescription& n = contact.normal;
  const auto refuse = [&](const char* why) { throw core::InputError(n.separation.mark, why); };
  const SeparationWord word = n.separation.value;
  if (word == SeparationWord::no_separation) pair.separation = pairing::NeverPart{};
  if (word == SeparationWord::allowed || word == SeparationWord::no_separation) return;
  const double size = mean_size<Dim>(pair.master, c.model().reference);
  if (!n.tolerance && !(size > 0)) refuse("the master has no facets to measure: give a tolerance");
  const double tolerance = n.tolerance ? n.tolerance->value : near * size;
  if (word == SeparationWord::tied_normal)
    pair.separation = pairing::TiedNormal{tolerance};
  else
    pair.separation = pairing::Tied<Dim>{tolerance, n.initial_gap.value == InitialGap::keep};
}

}  // namespace

template <int Dim>
void set_laws(const BuildContext<Dim>& c, const Contact& contact,
              pairing::PairDefinition<Dim>& pair) {
  const NormalDescription& n = contact.normal;
  pair.normal = n.law.law;
  pair.offset = contact.offset;
  if (n.damping) {
    pair.damping = n.damping->law;
    check_durations(c.description, n.damping->timed, "damping that depends on speed",
                    steps_of_law(c.description, contact.name.value, 0, &ContactChange::damping));
  }
  if (contact.friction) {
    const StepRange acts =
        steps_of_law(c.description, contact.name.value, 0, &ContactChange::friction);
    check_durations(c.description, contact.friction->timed, "friction that depends on speed", acts);
    const std::size_t end = std::min(acts.end, c.description.steps.size());
    for (const Step& step : std::span(c.description.steps).first(end))  // there it would hold
      if (contact.friction->timed && (step.modes || step.buckling))
        throw core::InputError(
            *contact.friction->timed,
            fmt::format("friction that depends on speed does not go with the "
                        "{} of step '{}'",
                        step.modes ? "vibrations" : "buckling", step.name.value));
    const bool may_part = n.separation.value == SeparationWord::allowed;
    pair.friction = may_part ? contact::parting(contact.friction->law) : contact.friction->law;
  }
  set_separation(c, contact, pair);
}

template <int Dim>
void note_tied(BuildContext<Dim>& c, const Contact& contact,
               const pairing::PairDefinition<Dim>& pair) {
  if (!pairing::held_from_start(pair)) return;
  const auto* const normal = std::get_if<pairing::TiedNormal>(&pair.separation);
  const double tolerance =
      normal ? normal->tolerance : std::get<pairing::Tied<Dim>>(pair.separation).tolerance;
  const auto state = pairing::initial_state<Dim>(pair, c.model().reference);
  const auto held = std::count_if(state.points.begin(), state.points.end(),
                                  [](const auto& point) { return point.held; });
  if (held == 0)
    throw core::InputError(
        contact.normal.separation.mark,
        fmt::format("no point of the slave '{}' is within {:g} of the master '{}': nothing is tied",
                    contact.slave.value, tolerance, contact.master.value));
  c.built.notes.push_back(fmt::format("contact '{}': {} of {} points are tied (within {:g})",
                                      contact.name.value, held, state.points.size(), tolerance));
}

template void set_laws(const BuildContext<2>&, const Contact&, pairing::PairDefinition<2>&);
template void set_laws(const BuildContext<3>&, const Contact&, pairing::PairDefinition<3>&);
template void note_tied(BuildContext<2>&, const Contact&, const pairing::PairDefinition<2>&);
template void note_tied(BuildContext<3>&, const Contact&, const pairing::PairDefinition<3>&);

}  // namespace osculate::deck
