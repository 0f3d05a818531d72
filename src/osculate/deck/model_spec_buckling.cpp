#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "osculate/deck/bind.hpp"
#include "osculate/deck/model_spec.hpp"

namespace osculate::deck {

BoundKey<Step> buckling_key() {
  using S = Step;
  const auto count = [](std::string doc) {
    return integer(std::move(doc)).at_least(1).at_most(10'000).such_as("3");
  };
  const BoundKeys<S> keys(
      {need(&S::buckling, "count", count("So many.")),
       may(&S::about, "about",
           choice(
               "The state that buckles.",
               {word("last", ModesAbout::last, "the one that the steps before led to"),
                word("start", ModesAbout::start, "the one before the first step, without loads")})
               .otherwise("last")
               .such_as("start"))});
  Spec spec =
      either(
          "So many factors, the smallest first, by which the loads of the step may be multiplied "
          "until the state that the steps before led to buckles, linearly. The loads, "
          "displacements and temperatures of the step are what is multiplied: they act on top "
          "of those before, and are gone after it. Closed contacts stay closed, and stick if "
          "they have friction.",
          {count("So many."), keys.spec("How many, and of which state.")})
          .such_as("3");
  return {optional("buckling", std::move(spec)), [keys](S& s, const Value& v) {
            if (v.alternative == 1) return keys.read(v, s);
            s.buckling = Marked<int>{v.code, v.mark};
          }};
}

void check_buckling(const Value& step, Step& s) {
  if (!s.buckling) return;
  constexpr std::array<std::string_view, 8> others{"increments", "modes",    "duration", "hold",
                                                   "gravity",    "dynamics", "modal",    ""};
  for (const ValueEntry& entry : step.entries)
    if (entry.value.given && std::ranges::find(others, entry.key) != others.end())
      throw core::InputError(
          entry.key_mark,
          fmt::format("a step with `buckling` looks for factors of its loads: `{}` does not go "
                      "with it{}",
                      entry.key, entry.key == "gravity" ? ", a `body_force` does" : ""));
  const auto refuse_table = [](const std::optional<Name>& amplitude) {
    if (amplitude)
      throw core::InputError(amplitude->mark,
                             "loads of a step with `buckling` have no amplitude: they act as they "
                             "are, times the factor");
  };
  for (const std::vector<Load>* const loads : {&s.forces, &s.total_force, &s.pressure, &s.traction,
                                               &s.body_force, &s.centrifugal, &s.temperature})
    for (const Load& load : *loads) refuse_table(load.amplitude);
  for (const Prescription& p : s.prescribe) refuse_table(p.amplitude);
  s.increments = {1, s.buckling->mark};
}

}  // namespace osculate::deck
