// What becomes of contact pairs from step to step.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "osculate/core/text.hpp"
#include "osculate/deck/build_contact_parts.hpp"
#include "osculate/pairing/combinations.hpp"

namespace osculate::deck {
namespace {

/// The pairs that a name stands for: one, or those of an `all` or of both passes.
template <int Dim>
std::vector<std::size_t> pairs_called(const BuildContext<Dim>& c, const Name& name) {
  std::vector<std::size_t> found;
  std::vector<std::string> names;
  for (std::size_t p = 0; p < c.model().pairs.size(); ++p) {
    const model::BasicContactPair<Dim>& pair = c.model().pairs[p];
    if (pair.name == name.value || (!pair.group.empty() && pair.group == name.value))
      found.push_back(p);
    names.push_back(pair.name);
  }
  if (found.empty())
    throw core::InputError(name.mark,
                           core::unknown_name_message("contact pair", name.value, names));
  return found;
}

/// A law without a penalty keeps that of the pair, if that is of its kind.
double kept_penalty(const core::SourceMark& mark, std::optional<double> of_pair, const char* what,
                    const char* why) {
  if (of_pair) return *of_pair;
  throw core::InputError(
      mark,
      fmt::format("a {} that changes in a step needs its penalty as a number: {}", what, why));
}

/// What holds the points of a pair then; those that are tied were so from the start.
template <int Dim>
pairing::Separation<Dim> separation_of(const NormalDescription& n,
                                       const pairing::PairDefinition<Dim>& pair) {
  const SeparationWord word = n.separation.value;
  if (word == SeparationWord::allowed) return pairing::MayPart{};
  if (word == SeparationWord::no_separation) return pairing::NeverPart{};
  if (!pairing::held_from_start(pair) || pairing::is_tied(pair) != (word == SeparationWord::tied))
    throw core::InputError(n.separation.mark,
                           "points are tied from the start of the analysis, not from a later step");
  return pair.separation;
}

template <int Dim>
void apply_damping(const BuildContext<Dim>& c, const ContactChange& change,
                   model::BasicPairChange<Dim>& to) {
  if (!change.damping) return;
  to.damping.reset();
  if (!*change.damping) return;
  const GivenLaw<contact::DampingLaw>& damping = **change.damping;
  StepRange acts =
      steps_of_law(c.description, change.pair.value, to.step + 1, &ContactChange::damping);
  acts.first = to.step;
  check_durations(c.description, damping.timed, "damping that depends on speed", acts);
  to.damping = damping.law;
}

/// The friction of a pair then.
template <int Dim>
std::optional<contact::FrictionLaw> changed_friction(const BuildContext<Dim>& c,
                                                     const ContactChange& change,
                                                     const pairing::PairDefinition<Dim>& pair,
                                                     std::size_t step) {
  if (!*change.friction) return std::nullopt;
  const GivenLaw<contact::FrictionLaw>& friction = **change.friction;
  contact::FrictionLaw law = friction.law;
  if (friction.automatic)
    law = contact::with_stiffness(
        law, kept_penalty(
                 friction.stiffness,
                 pair.friction ? std::optional(contact::stiffness(*pair.friction)) : std::nullopt,
                 "friction law", "the pair has no friction that has one"));
  StepRange acts =
      steps_of_law(c.description, change.pair.value, step + 1, &ContactChange::friction);
  acts.first = step;
  check_durations(c.description, friction.timed, "friction that depends on speed", acts);
  return law;
}

template <int Dim>
void apply(const BuildContext<Dim>& c, const ContactChange& change,
           const model::BasicContactPair<Dim>& whole, model::BasicPairChange<Dim>& to) {
  const pairing::PairDefinition<Dim>& pair = whole.definition;
  if (change.active) to.active = *change.active;
  if (change.normal) {
    const NormalDescription& n = *change.normal;
    if (n.damping)
      throw core::InputError(n.damping->mark,
                             "damping changes by the key `damping` of the change, not by `normal`");
    if (n.auto_factor)
      throw core::InputError(n.auto_factor->mark, "a stiffness `auto` stays that of the pair");
    to.normal = n.law.law;
    if (n.law.automatic) {
      const double penalty = contact::penalty_of(pair.normal);
      to.normal = contact::with_stiffness(
          to.normal,
          kept_penalty(n.law.stiffness,
                       whole.automatic && penalty > 0 ? std::optional(penalty) : std::nullopt,
                       "normal law", "that of the pair is none of the bodies'"));
    }
    to.separation = separation_of(n, pair);
  }
  apply_damping(c, change, to);
  if (change.friction) to.friction = changed_friction(c, change, pair, to.step);
  if (to.friction && pairing::is<pairing::MayPart>(to.separation))
    to.friction = contact::parting(*to.friction);
}

/// Fails where the pair as it is then would have been refused.
template <int Dim>
void check_changed(const ContactChange& change, pairing::PairDefinition<Dim> pair,
                   const model::BasicPairChange<Dim>& to) {
  const bool other_than_damping = change.active || change.normal || change.friction;
  if (!pairing::is<pairing::ByPenalty>(pair.enforcement) ||
      (other_than_damping && pairing::by_mortar(pair)))
    throw core::InputError(change.mark,
                           fmt::format("'{}' cannot change: that goes with enforcement: penalty, "
                                       "and with any sampling but mortar",
                                       change.pair.value));
  pair.normal = to.normal;
  pair.friction = to.friction;
  pair.separation = to.separation;
  pair.damping = to.damping;
  if (const pairing::Refusal* const refused = pairing::refusal(pairing::traits_of(pair)))
    throw core::InputError(change.mark, std::string(refused->why));
}

/// Explicit steps take their pairs from the model as it begins.
template <int Dim>
void refuse_explicit(const BuildContext<Dim>& c) {
  const std::vector<model::Step>& steps = c.model().steps;
  if (std::none_of(steps.begin(), steps.end(), [](const model::Step& step) {
        return step.dynamics && step.dynamics->explicit_steps;
      }))
    return;
  for (const Step& step : c.description.steps)
    if (!step.contact.empty())
      throw core::InputError(step.contact.front().mark,
                             "pairs do not change in analyses with explicit steps");
}

}  // namespace

template <int Dim>
void build_pair_changes(BuildContext<Dim>& c) {
  refuse_explicit(c);
  std::map<std::size_t, model::BasicPairChange<Dim>> running;
  for (std::size_t s = 0; s < c.description.steps.size(); ++s)
    for (const ContactChange& change : c.description.steps[s].contact)
      for (const std::size_t p : pairs_called(c, change.pair)) {
        const model::BasicContactPair<Dim>& whole = c.model().pairs[p];
        const pairing::PairDefinition<Dim>& pair = whole.definition;
        const auto [at, fresh] = running.try_emplace(p);
        model::BasicPairChange<Dim>& now = at->second;
        if (fresh) now = {s, p, true, pair.normal, pair.friction, pair.separation, pair.damping};
        if (!fresh && now.step == s)
          throw core::InputError(change.mark,
                                 fmt::format("'{}' changes twice in this step", change.pair.value));
        now.step = s;
        apply(c, change, whole, now);
        check_changed(change, pair, now);
        c.model().pair_changes.push_back(now);
      }
}

template void build_pair_changes(BuildContext<2>&);
template void build_pair_changes(BuildContext<3>&);

}  // namespace osculate::deck
