#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

#include "osculate/deck/bind.hpp"
#include "osculate/deck/model_spec.hpp"

namespace osculate::deck {
namespace {

using M = ModalDescription;

Spec ratio_spec(std::string doc) {
  return number(std::move(doc)).at_least(0).at_most(100).such_as("0.02");
}

BoundKey<M> ratios_key() {
  using R = M::Ratio;
  const auto place = [](std::string doc, const char* example) {
    return integer(std::move(doc)).at_least(1).at_most(10'000).such_as(example);
  };
  const BoundKeys<R> keys({need(&R::first, "first", place("The first of them, from 1 on.", "1")),
                           need(&R::last, "last", place("The last of them.", "5")),
                           need(&R::ratio, "ratio", ratio_spec("Theirs."))});
  return {optional("ratios", list("Ratios of some vibrations, instead of `ratio`; of one that is "
                                  "named twice the last counts.",
                                  keys.spec("Some vibrations, by their numbers."))
                                 .otherwise("[]")
                                 .such_as("[{first: 1, last: 5, ratio: 0.02}]")),
          [keys](M& m, const Value& v) {
            m.ratios = keys.read_all(v, [](const Value&, const R& r) {
              if (r.last.value < r.first.value)
                throw core::InputError(r.last.mark,
                                       fmt::format("must not be below the first one, {}, got {}",
                                                   r.first.value, r.last.value));
            });
          }};
}

BoundKey<M> modal_damping_key() {
  const BoundKeys<M> keys(
      {may(&M::ratio, "ratio",
           ratio_spec("Ratio of the damping to the critical one, of all vibrations.")
               .otherwise("0")),
       ratios_key(),
       may(&M::damping_mass, "mass",
           number("Factor of the mass.").in("1/time").at_least(0).otherwise("0")),
       may(&M::damping_stiffness, "stiffness",
           number("Factor of the stiffness.")
               .in("time")
               .at_least(0)
               .otherwise("0")
               .such_as("1e-4"))});
  return below(keys, optional("damping", keys.spec("Damping of each vibration by itself: a ratio, "
                                                   "and Rayleigh's by mass and stiffness.")
                                             .otherwise("{}")
                                             .such_as("{ratio: 0.02}")));
}

BoundKeys<M> modal_keys() { return {{modal_damping_key()}}; }

BoundKeys<HarmonicDescription> harmonic_keys() {
  using H = HarmonicDescription;
  return {
      {need(&H::from, "from",
            number("The first frequency.").in("1/time").at_least(0).such_as("100")),
       need(&H::to, "to", number("The last one.").in("1/time").at_least(0).such_as("2000")),
       may(&H::points, "points",
           integer("So many frequencies from one vibration to the next, with both; those of the "
                   "vibrations in the range are always among them.")
               .at_least(2)
               .at_most(100'000)
               .otherwise("20")),
       may(&H::bias, "bias",
           number("How much closer they are to the vibrations: 1 is not at all.")
               .at_least(1)
               .at_most(100)
               .otherwise("3")),
       of(&H::damped, modal_damping_key())}};
}

/// What does not go with a kind of step, with the reason.
void refuse_beside(const Value& step, std::span<const std::string_view> others,
                   const std::string& text) {
  for (const ValueEntry& entry : step.entries)
    if (entry.value.given && std::ranges::find(others, entry.key) != others.end())
      throw core::InputError(
          entry.key_mark,
          text + fmt::format("`{}` does not go with it{}", entry.key,
                             entry.key == "dynamics" || entry.key == "modal"
                                 ? ", it is another integration in time"
                                 : ", supports and contacts are those of the step with "
                                   "`modes`"));
}

void check_harmonic(const Value& step, const Step& s) {
  constexpr std::array<std::string_view, 10> others{
      "release", "hold",    "temperature", "contact",    "dynamics",
      "modal",   "gravity", "duration",    "increments", "modes"};
  refuse_beside(step, others, "a step with `harmonic` swings what vibrates by its loads: ");
  if (s.harmonic->to.value < s.harmonic->from.value)
    throw core::InputError(s.harmonic->to.mark,
                           fmt::format("must not be below the first frequency, {:g}, got {:g}",
                                       s.harmonic->from.value, s.harmonic->to.value));
}

/// A phase is one of a swing.
void check_phases(const Step& s) {
  for (const std::vector<Load>* const loads : {&s.prescribe, &s.forces, &s.total_force, &s.pressure,
                                               &s.traction, &s.body_force, &s.centrifugal})
    for (const Load& load : *loads)
      if (load.phase)
        throw core::InputError(load.phase->mark,
                               "only what swings, in a step with `harmonic`, has "
                               "a phase");
}

}  // namespace

BoundKey<Step> modal_key() {
  return {
      optional(
          "modal",
          modal_keys()
              .spec(
                  "Linear motion in time, over the duration: the vibrations that a step "
                  "with `modes` before it has found move by the loads and by supports, and nothing "
                  "else does.")
              .such_as("{damping: {ratio: 0.02}}")),
      [](Step& s, const Value& v) { s.modal = modal_keys().read(v); }};
}

BoundKey<Step> harmonic_key() {
  return {optional("harmonic",
                   harmonic_keys()
                       .spec("Swings of constant amplitude, at one frequency after the other: the "
                             "vibrations that a step with `modes` before it has found swing with "
                             "the loads and supports of this step, whose values are amplitudes. "
                             "An `amplitude` is a factor over the frequencies, 0 at the first and "
                             "1 at the last one.")
                       .such_as("{from: 100, to: 2000, damping: {ratio: 0.02}}")),
          [](Step& s, const Value& v) { s.harmonic = harmonic_keys().read(v); }};
}

void check_modal(const Value& step, Step& s) {
  if (s.harmonic) return check_harmonic(step, s);
  check_phases(s);
  if (!s.modal) return;
  constexpr std::array<std::string_view, 5> others{"release", "hold", "temperature", "contact",
                                                   "dynamics"};
  refuse_beside(step, others, "a step with `modal` moves what vibrates by its loads: ");
}

namespace {

void require_whole(const Step& found, const core::SourceMark& mark) {
  if (!found.diameters.empty())
    throw core::InputError(mark,
                           "vibrations of a sector of a ring are not moved by loads: a model "
                           "of the whole ring");
}

/// Swings follow the step that has found what swings, or one another.
void check_harmonic_steps(const Description& d) {
  const Step* found = nullptr;
  for (const Step& step : d.steps) {
    if (!step.harmonic) {
      found = step.modes ? &step : nullptr;
      continue;
    }
    if (found) require_whole(*found, step.harmonic->mark);
    if (!found)
      throw core::InputError(step.harmonic->mark,
                             "there are no vibrations that could swing: the step before needs the "
                             "key 'modes'");
    for (const ModalDescription::Ratio& r : step.harmonic->damped.ratios)
      if (r.last.value > found->modes->value)
        throw core::InputError(r.last.mark, fmt::format("step '{}' looks for {} vibrations",
                                                        found->name.value, found->modes->value));
  }
}

}  // namespace

/// The step before has what moves.
void check_modal_steps(const Description& d) {
  const Step *found = nullptr, *before = nullptr;
  bool dynamic = false;
  check_harmonic_steps(d);
  for (const Step& step : d.steps) {
    dynamic = dynamic || step.dynamics;
    if (!step.modal) {
      found = step.modes ? &step : nullptr;
      before = nullptr;
      continue;
    }
    const auto moves = [](const Step* s) { return s && !s->prescribe.empty(); };
    if (before && (moves(before) || moves(&step)))
      throw core::InputError(
          (moves(before) ? *before : step).prescribe.front().mark,
          "supports move in the only step with `modal`, none before or behind it");
    before = &step;
    if (!found)
      throw core::InputError(step.modal->mark,
                             "there are no vibrations that could move: the step before needs the "
                             "key 'modes'");
    require_whole(*found, step.modal->mark);
    for (const ModalDescription::Ratio& r : step.modal->ratios)
      if (r.last.value > found->modes->value)
        throw core::InputError(r.last.mark, fmt::format("step '{}' looks for {} vibrations",
                                                        found->name.value, found->modes->value));
    const bool later = !dynamic && std::ranges::any_of(d.steps, [](const Step& s) {
      return s.dynamics.has_value();
    });
    if (!d.initial_velocity.empty() && later)
      throw core::InputError(d.initial_velocity.front().mark,
                             "steps with `modal` and, behind them, with `dynamics`: which of them "
                             "has the velocity is not known");
  }
}

}  // namespace osculate::deck
