// Temperatures of a deck: how materials expand, and what nodes have at first, velocities as well.
#include <fmt/format.h>

#include <algorithm>

#include "osculate/deck/inp_parts.hpp"
#include "osculate/io/inp/loaded_sets.hpp"

namespace osculate::deck {

using io::inp::Card;
using io::inp::Fields;
using io::inp::Line;
using io::inp::SetKind;

bool has_temperatures(const InpModel& m) {
  const auto any = [&](const auto& is) {
    return std::any_of(m.deck.cards.begin(), m.deck.cards.end(), is);
  };
  if (any([](const Card& card) { return card.keyword == "TEMPERATURE"; })) return true;
  return any([&](const Card& card) {
           return card.keyword == "ELASTIC" && depends_on_temperature(m, card);
         }) &&
         any([](const Card& card) {
           return card.keyword == "INITIALCONDITIONS" && option_of(card, "TYPE") == "TEMPERATURE";
         });
}

NodeValue temperature_of(const InpModel& m, const Line& line) {
  Fields fields(m.deck, line);
  const std::string name = io::inp::name_of(fields.next().value_or(""));
  const auto number = io::inp::number_of(name);
  NodeValue value{
      set_of(m, line.at, number ? io::inp::node_set_name(*number) : name, {SetKind::nodes}),
      fields.real("the temperature")};
  for (double& gradient : value.gradient) gradient = fields.real_or_zero("a gradient");
  return value;
}

void put_gradients(SourceNode& entry, const std::array<double, 2>& gradient) {
  constexpr std::array<const char*, 2> keys{"gradient", "gradient_1"};
  for (const std::size_t k : {0, 1})
    if (gradient[k] != 0) put(entry, keys[k], inp_number(gradient[k], entry.line));
}

SourceNode inp_expansion(const InpModel& m, const Card& card) {
  const std::string type = option_of(card, "TYPE");
  if (!type.empty() && type != "ISO" && type != "ISOTROPIC")
    io::inp::fail(m.deck, card,
                  fmt::format("TYPE={} is not supported: materials are isotropic", type));
  const int line = line_of(card.at);
  const auto lines = io::inp::lines_of(m.deck, card);
  if (lines.empty()) io::inp::fail(m.deck, card, "expected lines of coefficient and temperature");
  SourceNode expansion = inp_map(line);
  SourceNode table = inp_list(line);
  for (const Line& one : lines) {
    Fields fields(m.deck, one);
    const double alpha = fields.real("the coefficient of expansion");
    const double temperature = fields.real_or_zero("a temperature");
    fields.expect_end();
    SourceNode& row = table.items.emplace_back(inp_list(line_of(one.at)));
    row.items = {inp_number(temperature, row.line), inp_number(alpha, row.line)};
  }
  const bool constant = table.items.size() == 1;
  put(expansion, "alpha", constant ? table.items[0].items[1] : std::move(table));
  if (const io::inp::Parameter* const zero = io::inp::find_parameter(card, "ZERO")) {
    Line value;
    value.text = zero->value;
    value.at = card.at;
    put(expansion, "reference",
        inp_number(Fields(m.deck, value).real("the temperature ZERO"), line));
  }
  return expansion;
}

SourceNode inp_initial_temperature(const InpModel& m) {
  SourceNode list = inp_list(1);
  if (!has_temperatures(m)) return list;
  for (const Card& card : m.deck.cards) {
    if (card.keyword != "INITIALCONDITIONS" || option_of(card, "TYPE") != "TEMPERATURE") continue;
    for (const Line& line : io::inp::lines_of(m.deck, card)) {
      const NodeValue value = temperature_of(m, line);
      SourceNode& entry = list.items.emplace_back(inp_map(line_of(line.at)));
      put(entry, "on", inp_text(value.on, entry.line));
      put(entry, "value", inp_number(value.value, entry.line));
      put_gradients(entry, value.gradient);
    }
  }
  return list;
}

void check_initial_conditions(const InpModel& m, const Card& card) {
  const std::string type = option_of(card, "TYPE");
  for (const char* const other : {"USER", "FILE", "GEOSTATIC", "SECTIONPOINTS"})
    if (io::inp::find_parameter(card, other))
      io::inp::fail(m.deck, card, fmt::format("the parameter {} is not supported", other));
  for (const char* const known : {"TEMPERATURE", "VELOCITY", "STRESS", "PLASTICSTRAIN"})
    if (type == known) return;
  io::inp::fail(m.deck, card,
                fmt::format("TYPE={} is not supported: TEMPERATURE, VELOCITY, STRESS or PLASTIC "
                            "STRAIN",
                            printable(type)));
}

SourceNode inp_initial_velocity(const InpModel& m) {
  SourceNode list = inp_list(1);
  for (const Card& card : m.deck.cards) {
    if (card.keyword != "INITIALCONDITIONS" || option_of(card, "TYPE") != "VELOCITY") continue;
    for (const Line& line : io::inp::lines_of(m.deck, card)) {
      Fields fields(m.deck, line);
      const std::string& set = node_set_of(m, line, fields.next().value_or(""));
      const std::int32_t direction = fields.number("a direction");
      const std::vector<InpPlace> places = direction >= 1 && direction <= inp_dimension(m)
                                               ? inp_places(m, set, direction)
                                               : std::vector<InpPlace>{};
      if (places.empty())
        fields.fail(
            fmt::format("expected a direction 1 to {}, found {}", inp_dimension(m), direction));
      const double speed = fields.real("the velocity");
      for (const InpPlace& place : places) {
        SourceNode& entry = list.items.emplace_back(inp_map(line_of(line.at)));
        put(entry, "on", inp_text(place.on, entry.line));
        put(entry, inp_component('v', place.direction), inp_number(place.sign * speed, entry.line));
      }
    }
  }
  return list;
}

}  // namespace osculate::deck
