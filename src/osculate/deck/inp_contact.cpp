// Contact pairs and tied surfaces of a deck.
#include <fmt/format.h>

#include <algorithm>

#include "osculate/core/text.hpp"
#include "osculate/deck/inp_parts.hpp"

namespace osculate::deck {
namespace {

using io::inp::Card;
using io::inp::Fields;
using io::inp::Line;
using io::inp::SetKind;

/// The cards of one `*SURFACE INTERACTION`.
struct Interaction {
  const Card* card = nullptr;
  const Card *behavior = nullptr, *friction = nullptr;
  std::string name;
};

std::vector<Interaction> interactions_of(const InpModel& m) {
  std::vector<Interaction> all;
  const auto set = [&](const Card& card, const Card* Interaction::*which) {
    if (all.empty()) io::inp::fail(m.deck, card, "stands before the first *SURFACE INTERACTION");
    all.back().*which = &card;
  };
  for (const Card& card : m.deck.cards) {
    if (card.keyword == "SURFACEINTERACTION")
      all.push_back({&card, nullptr, nullptr, value_of(m, card, "NAME")});
    if (card.keyword == "SURFACEBEHAVIOR") set(card, &Interaction::behavior);
    if (card.keyword == "FRICTION") set(card, &Interaction::friction);
  }
  return all;
}

const Interaction& interaction_of(const InpModel& m, const std::vector<Interaction>& all,
                                  const Card& pair) {
  const std::string& name = value_of(m, pair, "INTERACTION");
  std::vector<std::string> names;
  for (const Interaction& one : all) {
    if (io::inp::capitals(one.name) == io::inp::capitals(name)) return one;
    names.push_back(one.name);
  }
  io::inp::fail(m.deck, pair,
                core::unknown_name_message("surface interaction", printable(name), names));
}

bool is_tied(const Interaction& law) {
  return law.behavior && option_of(*law.behavior, "PRESSURE-OVERCLOSURE") == "TIED";
}

void put_table(const InpModel& m, const Card& card, SourceNode& normal) {
  const int at = line_of(card.at);
  SourceNode& table = put(normal, "table", inp_list(at));
  for (const Line& line : io::inp::lines_of(m.deck, card)) {
    Fields fields(m.deck, line);
    const double pressure = fields.real("the pressure");
    const double overclosure = fields.real("the overclosure");
    SourceNode& row = table.items.emplace_back(inp_list(line_of(line.at)));
    row.items = {inp_number(overclosure, line_of(line.at)), inp_number(pressure, line_of(line.at))};
  }
}

SourceNode normal_of(const InpModel& m, const Interaction& law) {
  SourceNode normal = inp_map(line_of(law.card->at));
  if (!law.behavior) return normal;  // hard
  const Card& card = *law.behavior;
  const std::string kind = option_of(card, "PRESSURE-OVERCLOSURE");
  if (kind.empty() || kind == "HARD") return normal;
  if (kind == "TABULAR") {
    put_table(m, card, normal);
    return normal;
  }
  if (kind != "LINEAR" && kind != "TIED")
    io::inp::fail(m.deck, card,
                  fmt::format("PRESSURE-OVERCLOSURE={} is not supported: HARD, LINEAR, TABULAR or "
                              "TIED",
                              printable(kind)));
  const auto lines = io::inp::lines_of(m.deck, card);
  if (lines.empty()) io::inp::fail(m.deck, card, "expected a line with the stiffness");
  put(normal, "penalty",
      inp_number(Fields(m.deck, lines[0]).real("the stiffness"), line_of(lines[0].at)));
  if (kind == "TIED") put(normal, "separation", inp_text("tied", line_of(card.at)));
  return normal;
}

void put_friction(const InpModel& m, const Card& card, SourceNode& pair) {
  const Line& line = only_line(m, card, "the coefficient and the stick slope");
  Fields fields(m.deck, line);
  const int at = line_of(line.at);
  const double mu = fields.real("the coefficient of friction");
  if (mu == 0) return;
  SourceNode& friction = put(pair, "friction", inp_map(line_of(card.at)));
  SourceNode& coulomb = put(friction, "coulomb", inp_map(at));
  put(coulomb, "mu", inp_number(mu, at));
  if (const double slope = fields.real_or_zero("the stick slope"); slope > 0)
    put(coulomb, "penalty", inp_number(slope, at));
}

bool is_of_second_order(const InpModel& m, const mesh::Set& set) {
  return std::any_of(set.cells.begin(), set.cells.end(), [&](const mesh::CellRef& ref) {
    return cell::info(m.mesh.mesh.blocks[static_cast<std::size_t>(ref.block)].type).order > 1;
  });
}

/// Nodes, or Gauss points: two per direction of a facet, three of one of second order, whose
/// corners have no positive area.
void put_sampling(InpModel& m, const Card& card, const std::string& slave, SourceNode& pair) {
  const int at = line_of(card.at);
  const std::string type = option_of(card, "TYPE");
  const mesh::Set* const set = m.mesh.mesh.find_set(slave);
  const bool has_facets = set && !set->cells.empty();
  const bool second_order = has_facets && is_of_second_order(m, *set);
  if (type == "MORTAR" || type == "LINMORTAR" || type == "PGLINMORTAR") {
    put(pair, "sampling", inp_text("mortar", at));
    put(pair, "enforcement", inp_text("lagrange_multiplier", at));
    return;
  }
  if (!type.empty() && type != "NODETOSURFACE" && type != "SURFACETOSURFACE")
    io::inp::fail(m.deck, card,
                  fmt::format("TYPE={} is not supported: NODE TO SURFACE, SURFACE TO SURFACE or "
                              "MORTAR",
                              printable(type)));
  if (!has_facets || (type == "NODETOSURFACE" && !second_order)) {
    put(pair, "sampling", inp_text("nodes", at));
    return;
  }
  if (type == "NODETOSURFACE")
    m.notes.push_back(fmt::format(
        "line {}: '{}' is sampled at Gauss points: corners of second-order facets have no area",
        card.at.line, slave));
  put(put(pair, "sampling", inp_map(at)), "gauss", inp_number(second_order ? 3 : 2, at));
}

/// `slave_master`, with a number where that is taken.
std::string name_for(const SourceNode& pairs, std::string_view slave, std::string_view master) {
  const std::string first = plain_name(fmt::format("{}_{}", slave, master));
  std::string name = first;
  const auto is_taken = [&](const SourceNode& pair) { return pair.entries[0].value.text == name; };
  for (int k = 2; std::any_of(pairs.items.begin(), pairs.items.end(), is_taken); ++k)
    name = fmt::format("{}_{}", first, k);
  return name;
}

/// The pair of one line of data, `slave, master`.
SourceNode& add_pair(const InpModel& m, const Card& card, const Line& line, SourceNode& pairs) {
  Fields fields(m.deck, line);
  const std::string slave = io::inp::name_of(fields.next().value_or(""));
  const std::string master = io::inp::name_of(fields.next().value_or(""));
  if (slave.empty() || master.empty())
    fields.fail(fmt::format("*{}: expected two surfaces, slave and master", card.keyword));
  const int at = line_of(line.at);
  const std::string name = name_for(pairs, slave, master);
  SourceNode& pair = pairs.items.emplace_back(inp_map(at));
  put(pair, "name", inp_text(name, at));
  put(pair, "master", inp_text(set_of(m, line.at, master, {SetKind::surface}), at));
  put(pair, "slave",
      inp_text(set_of(m, line.at, slave, {SetKind::surface, SetKind::node_surface}), at));
  return pair;
}

void add_contact_pair(InpModel& m, const Card& card, const Interaction& law, SourceNode& pairs) {
  const auto lines = io::inp::lines_of(m.deck, card);
  if (lines.empty()) io::inp::fail(m.deck, card, "expected a line with two surfaces");
  for (const Line& line : lines) {
    SourceNode& pair = add_pair(m, card, line, pairs);
    put_sampling(m, card, find(pair, "slave")->text, pair);
    put(pair, "normal", normal_of(m, law));
    if (law.friction && !is_tied(law)) put_friction(m, *law.friction, pair);
    const io::inp::Parameter* const adjust = io::inp::find_parameter(card, "ADJUST");
    if (!adjust) continue;
    const io::inp::Line value{adjust->value, card.at};
    SourceNode& initial = put(pair, "initial", inp_map(line_of(card.at)));
    put(initial, "adjust",
        inp_number(Fields(m.deck, value)
                       .real("ADJUST as a distance (sets of nodes are not "
                             "supported)"),
                   line_of(card.at)));
  }
  if (io::inp::find_parameter(card, "SMALLSLIDING"))
    m.notes.push_back(fmt::format("line {}: sliding is finite, not SMALL SLIDING", card.at.line));
}

void add_ties(const InpModel& m, const Card& card, SourceNode& pairs) {
  for (const Line& line : io::inp::lines_of(m.deck, card)) {
    SourceNode& pair = add_pair(m, card, line, pairs);
    const int at = line_of(line.at);
    put(pair, "sampling", inp_text("nodes", at));
    SourceNode& normal = put(pair, "normal", inp_map(at));
    put(normal, "separation", inp_text("tied", at));
    if (const auto* const tolerance = io::inp::find_parameter(card, "POSITIONTOLERANCE"))
      put(normal, "tolerance",
          inp_number(Fields(m.deck, {tolerance->value, card.at}).real("POSITION TOLERANCE"), at));
  }
}

}  // namespace

SourceNode inp_contact(InpModel& m) {
  SourceNode pairs = inp_list(1);
  const std::vector<Interaction> interactions = interactions_of(m);
  for (const Card& card : m.deck.cards) {
    if (card.keyword == "CONTACTPAIR")
      add_contact_pair(m, card, interaction_of(m, interactions, card), pairs);
    if (card.keyword == "TIE") add_ties(m, card, pairs);
  }
  return pairs;
}

}  // namespace osculate::deck
