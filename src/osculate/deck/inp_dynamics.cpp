// Steps in time of a deck.
#include <fmt/format.h>

#include "osculate/deck/inp_steps.hpp"

namespace osculate::deck {
namespace {

using io::inp::Card;
using io::inp::Fields;
using io::inp::find_parameter;

/// A parameter that is a number.
double number_of(const InpModel& m, const Card& card, const char* name, double otherwise) {
  const io::inp::Parameter* const found = find_parameter(card, name);
  return found ? Fields(m.deck, {found->value, card.at}).real(name) : otherwise;
}

/// Rayleigh damping of the materials, which must be the same in all of them.
void put_damping(const InpModel& m, SourceNode& dynamics) {
  const Card* first = nullptr;
  for (const Card& card : m.deck.cards) {
    if (card.keyword != "DAMPING") continue;
    if (first) {
      if (number_of(m, card, "ALPHA", 0) != number_of(m, *first, "ALPHA", 0) ||
          number_of(m, card, "BETA", 0) != number_of(m, *first, "BETA", 0))
        io::inp::fail(m.deck, card,
                      fmt::format("expected the damping of line {}: it is that of all materials",
                                  first->at.line));
      continue;
    }
    first = &card;
    const int line = line_of(card.at);
    SourceNode& damping = put(dynamics, "damping", inp_map(line));
    put(damping, "mass", inp_number(number_of(m, card, "ALPHA", 0), line));
    put(damping, "stiffness", inp_number(number_of(m, card, "BETA", 0), line));
  }
}

/// Nothing where the masses are what they are.
void put_scheme(const InpMassScaling& scaling, SourceNode& dynamics, int line) {
  if (!(scaling.stable_step > 0) && scaling.factor == 1.0) {
    put(dynamics, "scheme", inp_text("central_differences", line));
    return;
  }
  const int here = line_of(scaling.card->at);
  SourceNode& scheme = put(dynamics, "scheme", inp_map(line));
  SourceNode& central = put(scheme, "central_differences", inp_map(line));
  SourceNode& masses = put(central, "mass_scaling", inp_map(here));
  if (scaling.stable_step > 0) put(masses, "stable_step", inp_number(scaling.stable_step, here));
  if (scaling.factor != 1.0) put(masses, "factor", inp_number(scaling.factor, here));
}

}  // namespace

InpMassScaling read_mass_scaling(const InpModel& m, const Card& card,
                                 const InpProcedure& procedure) {
  if (!procedure.is("DYNAMIC") || !find_parameter(*procedure.card, "EXPLICIT"))
    io::inp::fail(m.deck, card, "belongs behind *DYNAMIC, EXPLICIT");
  if (procedure.scaling.card && procedure.scaling.card > procedure.card)
    io::inp::fail(m.deck, card,
                  fmt::format("the step has one already, in line {}: it is of all cells",
                              procedure.scaling.card->at.line));
  if (!find_parameter(card, "DT") && !find_parameter(card, "FACTOR"))
    io::inp::fail(m.deck, card, "expected DT, FACTOR or both");
  InpMassScaling scaling{&card, number_of(m, card, "DT", 0), number_of(m, card, "FACTOR", 1)};
  if (!(scaling.stable_step > 0) && find_parameter(card, "DT"))
    io::inp::fail(m.deck, card,
                  fmt::format("expected DT above 0, found {:g}", scaling.stable_step));
  if (!(scaling.factor >= 1))
    io::inp::fail(m.deck, card,
                  fmt::format("expected FACTOR of 1 or more, found {:g}", scaling.factor));
  return scaling;
}

SourceNode inp_dynamics(const InpModel& m, const InpProcedure& procedure) {
  const Card& card = *procedure.card;
  const int line = line_of(card.at);
  SourceNode dynamics = inp_map(line);
  if (find_parameter(card, "EXPLICIT")) {
    put_scheme(procedure.scaling, dynamics, line);
    put_damping(m, dynamics);
    return dynamics;
  }
  constexpr double usual = -0.05;
  const double alpha = number_of(m, card, "ALPHA", usual);
  if (!(alpha <= 0 && alpha >= -1.0 / 3))
    io::inp::fail(m.deck, card, fmt::format("expected ALPHA from -1/3 to 0, found {:g}", alpha));
  SourceNode& scheme = put(dynamics, "scheme", inp_map(line));
  SourceNode& hht = put(scheme, "hht", inp_map(line));
  put(hht, "alpha", inp_number(-alpha, line));
  put_damping(m, dynamics);
  if (!find_parameter(card, "DIRECT")) put(dynamics, "time_steps", inp_map(line));
  return dynamics;
}

}  // namespace osculate::deck
