// The laws of a contact pair from their description.
#include <fmt/format.h>

#include <algorithm>

#include "osculate/deck/build_contact_parts.hpp"

namespace osculate::deck {
namespace {

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
  pair.keep_gap = n.initial_gap.value == InitialGap::keep;
  const double size = mean_size<Dim>(pair.master, c.model().reference);
  if (!n.tolerance && !(size > 0)) refuse("the master has no facets to measure: give a tolerance");
  pair.tolerance = n.tolerance ? n.tolerance->value : near * size;
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
    check_durations(c.description, n.damping->timed, "damping that depends on speed");
  }
  if (contact.friction) {
    check_durations(c.description, contact.friction->timed, "friction that depends on speed");
    const bool may_part = n.separation.value == SeparationWord::allowed;
    pair.friction = may_part ? contact::parting(contact.friction->law) : contact.friction->law;
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
