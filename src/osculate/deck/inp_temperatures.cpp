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

namespace {

template <class Is>
bool any_card(const InpModel& m, const Is& is) {
  return std::any_of(m.deck.cards.begin(), m.deck.cards.end(), is);
}
bool changes_temperatures(const InpModel& m) {
  return any_card(m, [](const Card& card) { return card.keyword == "TEMPERATURE"; });
}
bool begins_with_temperatures(const InpModel& m) {
  return any_card(m, [](const Card& card) {
    return card.keyword == "INITIALCONDITIONS" && option_of(card, "TYPE") == "TEMPERATURE";
  });
}

}  // namespace

bool has_temperatures(const InpModel& m) {
  return changes_temperatures(m) ||
         (begins_with_temperatures(m) &&
          any_card(m, [&](const Card& card) { return depends_on_temperature(m, card); }));
}

void require_temperatures(const InpModel& m, const Card& card) {
  if (!changes_temperatures(m) && !begins_with_temperatures(m))
    io::inp::fail(m.deck, card,
                  "depends on the temperature, which is given nowhere (*INITIAL CONDITIONS, "
                  "*TEMPERATURE)");
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

namespace {

/// How many coefficients a `*EXPANSION` has.
std::size_t coefficients_of(const InpModel& m, const Card& card) {
  const std::string type = option_of(card, "TYPE");
  if (type == "ORTHO" || type == "ORTHOTROPIC") return 3;
  if (type == "ANISO" || type == "ANISOTROPIC") return 6;
  if (!type.empty() && type != "ISO" && type != "ISOTROPIC")
    io::inp::fail(m.deck, card,
                  fmt::format("TYPE={} is not supported: ISO, ORTHO or ANISO", printable(type)));
  return 1;
}

/// A row of the table over the temperature, which stands first.
SourceNode expansion_row(const InpModel& m, const Line& one, std::size_t coefficients) {
  const int line = line_of(one.at);
  Fields fields(m.deck, one);
  SourceNode row = inp_list(line);
  row.items.emplace_back();
  for (std::size_t k = 0; k < coefficients; ++k)
    row.items.push_back(inp_number(k == 0 ? fields.real("the coefficient of expansion")
                                          : fields.real_or_zero("a coefficient of expansion"),
                                   line));
  row.items[0] = inp_number(fields.real_or_zero("a temperature"), line);
  fields.expect_end();
  return row;
}

}  // namespace

bool expands_by_directions(const Card& card) {
  const std::string type = option_of(card, "TYPE");
  return card.keyword == "EXPANSION" && (type.starts_with("ORTHO") || type.starts_with("ANISO"));
}

SourceNode inp_expansion(const InpModel& m, const Card& card) {
  const std::size_t coefficients = coefficients_of(m, card);
  const int line = line_of(card.at);
  const auto lines = io::inp::lines_of(m.deck, card);
  if (lines.empty()) io::inp::fail(m.deck, card, "expected lines of coefficient and temperature");
  SourceNode expansion = inp_map(line);
  SourceNode table = inp_list(line);
  for (const Line& one : lines) table.items.push_back(expansion_row(m, one, coefficients));
  if (table.items.size() == 1) {  // without the temperature
    SourceNode only = std::move(table.items[0]);
    only.items.erase(only.items.begin());
    table = coefficients == 1 ? std::move(only.items[0]) : std::move(only);
  }
  put(expansion, "alpha", std::move(table));
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
