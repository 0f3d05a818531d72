// Motions along vibrations of a deck.
#include <fmt/format.h>

#include <algorithm>

#include "osculate/deck/inp_steps.hpp"

namespace osculate::deck {
namespace {

using io::inp::Card;
using io::inp::Fields;
using io::inp::Line;

/// Lines of first and last vibration and their ratio.
void put_ratios(const InpModel& m, const Card& card, int vibrations, SourceNode& damping) {
  SourceNode list = inp_list(line_of(card.at));
  for (const Line& line : io::inp::lines_of(m.deck, card)) {
    Fields fields(m.deck, line);
    const int first = fields.number("the first vibration");
    int last = fields.number("the last vibration");
    const double ratio = fields.real("a damping ratio");
    if (first < 1 || last < first)
      fields.fail(
          fmt::format("expected the first and the last vibration, found {} to {}", first, last));
    if (first > vibrations) continue;
    last = std::min(last, vibrations);
    const int at = line_of(line.at);
    SourceNode& entry = list.items.emplace_back(inp_map(at));
    put(entry, "first", inp_number(first, at));
    put(entry, "last", inp_number(last, at));
    put(entry, "ratio", inp_number(ratio, at));
  }
  if (!list.items.empty()) put(damping, "ratios", std::move(list));
}

/// One line, whose first two fields are empty.
void put_rayleigh(const InpModel& m, const Card& card, SourceNode& damping) {
  Fields fields(m.deck, only_line(m, card, "two empty fields, alpha, beta"));
  (void)fields.next(), (void)fields.next();
  const int at = line_of(card.at);
  put(damping, "mass", inp_number(fields.real_or_zero("alpha"), at));
  put(damping, "stiffness", inp_number(fields.real_or_zero("beta"), at));
}

}  // namespace

SourceNode inp_modal(const InpModel& m, std::span<const Card> until, int line, int vibrations) {
  SourceNode modal = inp_map(line);
  const auto damped = [](const Card& card) { return card.keyword == "MODALDAMPING"; };
  const auto last = std::find_if(until.rbegin(), until.rend(), damped);
  if (last == until.rend()) return modal;
  if (io::inp::find_parameter(*last, "STRUCTURAL"))
    io::inp::fail(m.deck, *last, "STRUCTURAL is not supported: a ratio, or RAYLEIGH");
  SourceNode& damping = put(modal, "damping", inp_map(line_of(last->at)));
  if (io::inp::find_parameter(*last, "RAYLEIGH"))
    put_rayleigh(m, *last, damping);
  else
    put_ratios(m, *last, vibrations, damping);
  return modal;
}

}  // namespace osculate::deck
