// What a step of a deck prescribes: displacements, forces at nodes, temperatures. It persists as in
// a model file.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "osculate/deck/inp_steps.hpp"
#include "osculate/io/inp/loaded_sets.hpp"
#include "osculate/io/inp/thin_sections.hpp"

namespace osculate::deck {
namespace {

using io::inp::Card;
using io::inp::Fields;
using io::inp::Line;

/// Nodes without elements have no displacements: as in CalculiX nothing acts on them.
bool is_idle(const InpReading& r, const std::string& set, const Line& line) {
  const std::vector<Index>& nodes = r.m.mesh.mesh.find_set(set)->nodes;
  const bool used = std::ranges::any_of(
      nodes, [&](Index n) { return r.m.used_nodes[static_cast<std::size_t>(n)]; });
  if (used || nodes.empty()) return false;
  if (r.idle.insert(set).second)
    r.m.notes.push_back(fmt::format(
        "line {}: '{}' has no nodes of elements: what acts on them is left out, as in CalculiX",
        line.at.line, set));
  return true;
}

/// The directions of a line of `*BOUNDARY`, and the displacement. As in CalculiX, nodes without
/// rotations are not held in them.
std::vector<int> held_here(const InpModel& m, Fields& fields, const Line& line,
                           const std::string& set_name, double& size) {
  const std::string_view word = fields.next().value_or("");
  std::vector<int> directions = io::inp::held_directions(word);
  const int highest = highest_direction(m, set_name);
  const auto body = m.body_nodes.find(only_node(m, set_name));
  // the node of a section under pretension has one direction, and others hold nothing there
  const bool of_body = body != m.body_nodes.end() && body->second.rigid;
  if (directions.empty()) {
    const std::int32_t first = io::inp::number_of(m.deck, line.at, word, "the first direction");
    std::int32_t last = first;
    if (const auto field = fields.next(); field && !field->empty())
      last = io::inp::number_of(m.deck, line.at, *field, "the last direction");
    size = fields.real_or_zero("the displacement");
    if (const int most = of_body ? highest : 6; last > most || last < first)
      fields.fail(fmt::format("expected directions 1 to {}, found {} to {}", most, first, last));
    for (std::int32_t k = first; k <= last; ++k) directions.push_back(k);
  }
  std::erase_if(directions, [&](int k) { return k > highest; });
  return directions;
}

/// Directions above 3 are rotations, which nodes of rigid bodies, shells and beams stand for.
std::vector<InpPlace> places_here(const InpModel& m, const Fields& fields,
                                  const std::string& set_name, int direction) {
  const int highest = highest_direction(m, set_name);
  if (direction < 1 || direction > highest)
    fields.fail(fmt::format("expected a direction 1 to {}, found {}", highest, direction));
  return inp_places(m, set_name, direction);
}

void read_boundary(const InpReading& r, const Card& card) {
  Conditions& prescribed = part_of(r, card).prescribed;
  InpSaid said = begin_card(r, card, prescribed);
  said.fixed = io::inp::find_parameter(card, "FIXED") != nullptr;
  for (const Line& line : io::inp::lines_of(r.m.deck, card)) {
    Fields fields(r.m.deck, line);
    const std::string& set_name = node_set_of(r.m, line, fields.next().value_or(""));
    double size = 0;
    if (is_idle(r, set_name, line)) continue;
    const std::vector<int> directions = held_here(r.m, fields, line, set_name, size);
    if (size != 0 && std::ranges::find(directions, 3) != directions.end())
      refuse_layers_of_plane(r.m, line.at, set_name, PlaneNodes::of_deck,
                             "they do not leave their plane, and are not displaced along z");
    for (const int k : directions)
      for (const InpPlace& place : places_here(r.m, fields, set_name, k)) {
        if (!inp_has_direction(r.m, place.direction)) continue;
        set_on_parts(r, prescribed, {place.on, place.direction}, place.sign * size, said, line,
                     false);
      }
  }
}

void read_forces(const InpReading& r, const Card& card) {
  Conditions& forces = part_of(r, card).forces;
  const InpSaid said = begin_card(r, card, forces);
  // beside sectors of axisymmetric elements all forces are those of whole rings, as in CalculiX
  const double rings = r.m.mesh.sectors ? io::inp::sectors_of_ring : 1;
  for (const Line& line : io::inp::lines_of(r.m.deck, card)) {
    Fields fields(r.m.deck, line);
    const std::string& set_name = node_set_of(r.m, line, fields.next().value_or(""));
    if (is_idle(r, set_name, line)) continue;
    const std::int32_t direction = fields.number("the direction");
    const std::vector<InpPlace> on = places_here(r.m, fields, set_name, direction);
    if (on.empty()) fields.fail("no shell or beam can take a moment here");
    const double size = fields.real("the force") / rings;
    for (const InpPlace& place : on) {
      if (!inp_has_direction(r.m, place.direction))
        fields.fail(
            fmt::format("expected a direction 1 to {}, found {}", inp_dimension(r.m), direction));
      set_on_parts(r, forces, {place.on, place.direction}, place.sign * size, said, line, true);
    }
  }
}

/// Nodes with temperatures of steps before go back to those at first, or to 0 without.
void go_back(const InpReading& r, int line) {
  auto& temperatures = r.acting.temperatures;
  const auto said = [&](double size, std::array<double, 2> gradient = {}) {
    Condition condition;
    condition.size = size;
    condition.line = line;
    condition.gradient = gradient;
    return condition;
  };
  std::vector<std::pair<std::string, Condition>> back;
  for (const auto& [on, value] : temperatures)
    if (!value.fresh) back.emplace_back(on, said(0));
  if (back.empty()) return;
  const auto number = [](SourceNode& of, const char* key) {
    const SourceNode* const value = find(of, key);
    return value ? std::stod(value->text) : 0.0;
  };
  for (SourceNode& one : inp_initial_temperature(r.m).items)
    back.emplace_back(
        find(one, "on")->text,
        said(number(one, "value"), {number(one, "gradient"), number(one, "gradient_1")}));
  for (auto one = back.begin(); one != back.end();) {  // of one set the last one holds
    const bool again = std::any_of(std::next(one), back.end(),
                                   [&](const auto& other) { return other.first == one->first; });
    one = again ? back.erase(one) : std::next(one);
  }
  std::erase_if(temperatures, [](const auto& one) { return !one.second.fresh; });
  temperatures.insert(temperatures.begin(), back.begin(), back.end());
}

void read_temperatures(const InpReading& r, const Card& card) {
  for (const char* const other : {"FILE", "USER", "BSTEP"})
    if (io::inp::find_parameter(card, other))
      io::inp::fail(r.m.deck, card, fmt::format("the parameter {} is not supported", other));
  Conditions none;
  const InpSaid said = begin_card(r, card, none);
  if (option_of(card, "OP") == "NEW") go_back(r, line_of(card.at));
  for (const Line& line : io::inp::lines_of(r.m.deck, card)) {
    NodeValue of = temperature_of(r.m, line);
    std::erase_if(r.acting.temperatures, [&](const auto& one) { return one.first == of.on; });
    Condition condition{of.value, said.amplitude, line_of(line.at)};
    condition.gradient = of.gradient;
    r.acting.temperatures.emplace_back(std::move(of.on), std::move(condition));
  }
}

}  // namespace

InpConditions& part_of(const InpReading& r, const Card& card) {
  return r.acting.parts[option_of(card, "LOADCASE") == "2" ? 1 : 0];
}

void release(Condition& value) {
  value.size = 0;
  value.amplitude.clear();
  value.between = value.fresh = false;
  value.released = true;
}

InpSaid begin_card(const InpReading& r, const Card& card, Conditions& values) {
  const io::inp::Deck& deck = r.m.deck;
  // Supports that stand between two steps are those of the next one.
  if (!r.in_step && card.keyword != "BOUNDARY")
    io::inp::fail(deck, card, "stands outside of a step");
  for (const char* const other : {"USER", "SUBMODEL", "SECTOR", "OMEGA0"})
    if (io::inp::find_parameter(card, other))
      io::inp::fail(deck, card, fmt::format("the parameter {} is not supported", other));
  const std::string part = option_of(card, "LOADCASE");
  if (!part.empty() && part != "1" && part != "2")
    io::inp::fail(deck, card, fmt::format("expected LOAD CASE=1 or 2, found {}", printable(part)));
  if (!part.empty() && !r.swings)
    io::inp::fail(deck, card, "LOAD CASE belongs to *STEADY STATE DYNAMICS");
  const std::string op = option_of(card, "OP");
  if (!op.empty() && op != "NEW" && op != "MOD")
    io::inp::fail(deck, card, fmt::format("expected OP=NEW or MOD, found {}", printable(op)));
  if (op == "NEW") {
    std::erase_if(values, [](const auto& one) { return one.second.between && !one.second.stands; });
    for (auto& [key, value] : values)
      if (!value.fresh || value.between) release(value);
  }
  return {amplitude_of(r.m, card, r.tables), r.in_step && r.swings, !r.in_step};
}

void set_condition(const InpModel& m, Conditions& values, const std::pair<std::string, int>& place,
                   double size, const InpSaid& said, const Line& line, bool adds) {
  const auto [found, is_new] = values.try_emplace(place);
  Condition& value = found->second;
  const bool sum = adds && !is_new && value.fresh;
  if (sum && value.amplitude != said.amplitude)
    io::inp::fail(
        m.deck, line.at,
        fmt::format("'{}' has this load with another amplitude in the same step", place.first));
  Condition now{sum ? value.size + size : size, said.amplitude, line_of(line.at)};
  now.stands = value.stands;
  now.between = said.between;
  now.fixed = said.fixed;
  now.swings = said.swings;
  value = std::move(now);
}

void end_conditions(InpActing& acting) {
  for (InpConditions& part : acting.parts) {
    const auto persist = [](Conditions& values) {
      std::erase_if(values, [](const auto& one) { return one.second.released; });
      for (auto& [key, value] : values) value.fresh = value.between = false, value.stands = true;
    };
    persist(part.prescribed);
    for (Conditions* const loads : loads_of(part)) persist(*loads);
  }
  for (auto& [on, value] : acting.temperatures) value.fresh = false;
}

void read_condition(const InpReading& r, const Card& card) {
  if (card.keyword == "BOUNDARY") read_boundary(r, card);
  if (card.keyword == "CLOAD") read_forces(r, card);
  if (card.keyword == "TEMPERATURE") read_temperatures(r, card);
}

}  // namespace osculate::deck
