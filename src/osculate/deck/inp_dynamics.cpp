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

}  // namespace

SourceNode inp_dynamics(const InpModel& m, const Card& card) {
  const int line = line_of(card.at);
  SourceNode dynamics = inp_map(line);
  if (find_parameter(card, "EXPLICIT")) {
    put(dynamics, "scheme", inp_text("central_differences", line));
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
