// Steps of a deck that move what a step with *FREQUENCY has found: what they may ask for.
#include <fmt/format.h>

#include <algorithm>

#include "osculate/deck/inp_steps.hpp"

namespace osculate::deck {

using io::inp::Card;
using io::inp::find_parameter;

InpVibrations found_vibrations(const InpProcedure& procedure, InpActing& acting,
                               InpConditions standing) {
  InpVibrations found;
  found.count = procedure.modes;
  found.about_start = procedure.about_start;
  found.standing = std::move(standing);
  InpConditions& real = acting.parts[0];
  for (const Conditions* const loads : loads_of(real))
    for (const auto& [key, value] : *loads)
      if (value.fresh) found.forgotten = std::max(value.line, 1);
  for (const auto& [key, value] : real.prescribed)
    if (!value.released) found.held.insert(key);
  return found;
}

void check_vibrations(const InpModel& m, const Card& card, const InpVibrations& found) {
  if (found.count == 0)
    io::inp::fail(m.deck, card,
                  "the step before it must have a *FREQUENCY: vibrations are not read from files");
  if (find_parameter(card, "STEADYSTATE"))
    io::inp::fail(m.deck, card, "STEADY STATE is not supported: give a period that is long enough");
  for (const char* const other : {"CYCLICSYMMETRY", "NSET"})
    if (find_parameter(card, other))
      io::inp::fail(m.deck, card, fmt::format("the parameter {} is not supported", other));
}

void check_perturbation(const InpModel& m, const Card& step, const Card& card,
                        const InpVibrations& found, bool moved) {
  if (moved && (find_parameter(step, "PERTURBATION") != nullptr) == found.about_start)
    io::inp::fail(m.deck, card,
                  "PERTURBATION must be said of this step and of that with *FREQUENCY, or of none");
}

void check_supports(const InpModel& m, const Card& card, const InpVibrations& found,
                    const InpActing& acting) {
  for (const InpConditions& part : acting.parts)
    for (const auto& [key, value] : part.prescribed)
      if (!found.held.contains(key))
        io::inp::fail(
            m.deck, card,
            fmt::format("supports must be those of the step with *FREQUENCY (*BOUNDARY of line {})",
                        value.line));
  for (const auto& [key, value] : acting.parts[0].prescribed)
    if (value.released)
      io::inp::fail(
          m.deck, card,
          fmt::format("supports must be those of the step with *FREQUENCY ('{}' is free here)",
                      key.first));
  for (const auto& [on, value] : acting.temperatures)
    if (value.fresh)
      io::inp::fail(
          m.deck, card,
          fmt::format("no temperatures change in it (*TEMPERATURE of line {})", value.line));
}

void put_on_top(const InpModel& m, const Card& step, const Card& card, const InpVibrations& found,
                InpConditions& acting) {
  const auto fail = [&](const std::string& text) { io::inp::fail(m.deck, card, text); };
  const bool on_top = find_parameter(step, "PERTURBATION") != nullptr;
  InpConditions standing = found.standing;
  const auto before_all = loads_of(standing), all = loads_of(acting);
  for (std::size_t kind = 0; kind < all.size(); ++kind)
    for (auto& [key, value] : *all[kind]) {
      const auto before = before_all[kind]->find(key);
      if (!value.fresh && !value.amplitude.empty() && value.size != 0)
        fail(
            fmt::format("the load of line {} has an amplitude and ends with its step: say it "
                        "again, or OP=NEW",
                        value.line));
      if (!on_top || before == before_all[kind]->end() || !value.fresh) continue;
      if (!value.amplitude.empty())
        fail(
            fmt::format("the load of line {} has an amplitude, and stands on top of one of the "
                        "same set in a step before: give it another set",
                        value.line));
      value.size += before->second.size;
    }
}

void check_swinging(const InpModel& m, const Card& card, InpActing& acting) {
  for (InpConditions& part : acting.parts) {
    const auto check = [&](const Conditions& values) {
      for (const auto& [key, value] : values)
        if (value.size != 0 && !value.swings && !value.released)
          io::inp::fail(
              m.deck, card,
              fmt::format("what line {} says of a step before would go on in this one: write it "
                          "again, or OP=NEW",
                          value.line));
    };
    check(part.prescribed);
    for (const Conditions* const loads : loads_of(part)) check(*loads);
  }
}

}  // namespace osculate::deck
