// Contact pairs and tied surfaces of a deck.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "osculate/core/text.hpp"
#include "osculate/deck/inp_parts.hpp"
#include "osculate/mesh/node_areas.hpp"

namespace osculate::deck {
namespace {

using io::inp::Card;
using io::inp::Fields;
using io::inp::Line;
using io::inp::SetKind;

bool is_of_second_order(const InpModel& m, const mesh::Set& set) {
  return std::any_of(set.cells.begin(), set.cells.end(), [&](const mesh::CellRef& ref) {
    return cell::info(m.mesh.mesh.blocks[static_cast<std::size_t>(ref.block)].type).order > 1;
  });
}

/// Of two slaves with one name node-to-surface contact has that of nodes, as in CalculiX; where
/// both have the same nodes they are one set of the mesh.
bool has_slave_of_nodes(const InpModel& m, const Card& card, const std::string& slave) {
  return option_of(card, "TYPE") == "NODETOSURFACE" &&
         std::any_of(m.mesh.sets.begin(), m.mesh.sets.end(), [&](const io::inp::DeckSet& set) {
           return set.kind == SetKind::node_surface && m.mesh.mesh.sets[set.set].name == slave;
         });
}

/// Mortar: unknown tractions of hard contact, and the law of pressure where there is one. Nodes,
/// or Gauss points on the parts of the facets that lie over one facet of the master, as there.
void put_sampling(InpModel& m, const Card& card, const std::string& slave,
                  const InpInteraction& law, SourceNode& pair) {
  const int at = line_of(card.at);
  const std::string type = option_of(card, "TYPE");
  const mesh::Set* const set = m.mesh.mesh.find_set(slave);
  const bool has_facets = set && !set->cells.empty() && !has_slave_of_nodes(m, card, slave);
  const bool second_order = has_facets && is_of_second_order(m, *set);
  if (type == "MORTAR" || type == "LINMORTAR" || type == "PGLINMORTAR") {
    put(pair, "sampling", inp_text("mortar", at));
    if (inp_is_hard(law.behavior)) put(pair, "enforcement", inp_text("lagrange_multiplier", at));
    return;
  }
  if (!type.empty() && type != "NODETOSURFACE" && type != "SURFACETOSURFACE")
    io::inp::fail(m.deck, card,
                  fmt::format("TYPE={} is not supported: NODE TO SURFACE, SURFACE TO SURFACE or "
                              "MORTAR",
                              printable(type)));
  if (!has_facets || type == "NODETOSURFACE") {
    put(pair, "sampling", inp_text("nodes", at));
    if (second_order) {
      put(put(pair, "weight", inp_map(at)), "area", inp_text("middles", at));
      m.notes.push_back(fmt::format(
          "line {}: nodes amid the edges of '{}' have nearly all of its area, as in CalculiX; "
          "SURFACE TO SURFACE is better",
          card.at.line, slave));
    }
    return;
  }
  SourceNode& sampling = put(pair, "sampling", inp_map(at));
  put(sampling, "gauss", inp_number(3, at));
  put(sampling, "segments", inp_text("true", at)).quoted = false;
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
SourceNode& pair_of_line(const InpModel& m, const Card& card, const Line& line, SourceNode& pairs) {
  Fields fields(m.deck, line);
  const std::string slave = io::inp::name_of(fields.next().value_or(""));
  const std::string master = io::inp::name_of(fields.next().value_or(""));
  if (slave.empty() || master.empty())
    fields.fail(fmt::format("*{}: expected two surfaces, slave and master", card.keyword));
  SourceNode& pair =
      add_pair(m, line.at, slave, master, pairs, option_of(card, "TYPE") == "NODETOSURFACE");
  refuse_layers_of_plane(m, line.at, find(pair, "slave")->text, PlaneNodes::of_deck,
                         "a surface of their nodes is not supported, name their edges (S1, ...)");
  return pair;
}

/// Mean area of the facets of a set.
double mean_area(const mesh::Mesh& mesh, const mesh::Set& facets) {
  double area = 0;
  for (const mesh::CellRef& ref : facets.cells) {
    const mesh::Block& block = mesh.blocks[static_cast<std::size_t>(ref.block)];
    const auto corners = static_cast<std::size_t>(cell::info(block.type).corners);
    area += mesh::polygon_area(mesh, {block.cell(ref.cell), corners});
  }
  return facets.cells.empty() ? 0 : area / static_cast<double>(facets.cells.size());
}

/// Slave nodes without facets have their share of the free faces of the solids round them, as in
/// CalculiX; where there are no solids, and in contact pairs of plane models, each has the whole
/// area of a facet of the master.
void put_weight(InpModel& m, const Card& card, SourceNode& pair) {
  const mesh::Set* const slave = m.mesh.mesh.find_set(find(pair, "slave")->text);
  if (!slave || !(slave->cells.empty() || has_slave_of_nodes(m, card, slave->name))) return;
  const int line = line_of(card.at);
  const std::vector<double> areas = mesh::free_areas(m.mesh.mesh, mesh::face_table(m.mesh.mesh));
  const bool around = inp_dimension(m) == 2
                          ? card.keyword == "TIE"
                          : std::any_of(slave->nodes.begin(), slave->nodes.end(), [&](Index n) {
                              return areas[static_cast<std::size_t>(n)] > 0;
                            });
  put(put(pair, "weight", inp_map(line)), "area", inp_text(around ? "around" : "master", line));
  m.notes.push_back(fmt::format("line {}: '{}' are nodes: each has {}", card.at.line, slave->name,
                                around ? "its share of the free faces round it"
                                       : "all of the area of a facet of the master, as in "
                                         "CalculiX"));
}

void put_adjust(const InpModel& m, const Card& card, const std::string& value, SourceNode& pair) {
  const int at = line_of(card.at);
  SourceNode& initial = put(pair, "initial", inp_map(at));
  if (value.find_first_of("0123456789.+-") == 0) {
    put(initial, "adjust",
        inp_number(Fields(m.deck, {value, card.at}).real("ADJUST as a distance"), at));
    return;
  }
  put(initial, "nodes", inp_text(set_of(m, card.at, value, {SetKind::nodes}), at));
}

/// Gap up to which node-to-face contact looks for a master in CalculiX: a thousandth of the square
/// root of a slave node's area, here of the mean.
double usual_clearance(const InpModel& m, const Card& card, const std::string& slave) {
  constexpr double share = 1e-3;
  const mesh::Set* const set = m.mesh.mesh.find_set(slave);
  if (!set || set->nodes.empty()) return 0;
  double area = mean_area(m.mesh.mesh, *set) * static_cast<double>(set->cells.size());
  if (set->cells.empty() || has_slave_of_nodes(m, card, slave)) {
    area = 0;
    const std::vector<double> areas = mesh::free_areas(m.mesh.mesh, mesh::face_table(m.mesh.mesh));
    for (const Index n : set->nodes) area += areas[static_cast<std::size_t>(n)];
  }
  return share * std::sqrt(area / static_cast<double>(set->nodes.size()));
}

/// Where CalculiX has no answer for what is tied.
void note_tied_pair(InpModel& m, const Card& card, const InpInteraction& law, SourceNode& pair) {
  if (!find(pair, "friction") || !find(*find(pair, "friction"), "rough") ||
      !find(*find(*find(pair, "friction"), "rough"), "penalty"))
    m.notes.push_back(
        fmt::format("line {}: '{}' has no stick slope in a *FRICTION: what is tied is as stiff "
                    "along the surface as across it (CalculiX stops there)",
                    card.at.line, printable(law.name)));
  if (find(pair, "sampling")->text == "nodes")
    m.notes.push_back(fmt::format(
        "line {}: nodes are tied (CalculiX ties with SURFACE TO SURFACE only)", card.at.line));
}

void add_contact_pair(InpModel& m, const Card& card, const InpInteraction& law, SourceNode& pairs) {
  const auto lines = io::inp::lines_of(m.deck, card);
  if (lines.empty()) io::inp::fail(m.deck, card, "expected a line with two surfaces");
  const bool is_of_nodes = option_of(card, "TYPE") == "NODETOSURFACE";
  const bool has_shells = std::ranges::any_of(
      m.deck.cards, [](const Card& one) { return one.keyword == "SHELLSECTION"; });
  if (has_shells && io::inp::find_parameter(card, "NOTHICKNESS"))
    io::inp::fail(m.deck, card,
                  "NO THICKNESS is not supported with shells, whose surfaces are those of solids");
  for (const Line& line : lines) {
    SourceNode& pair = pair_of_line(m, card, line, pairs);
    const std::string slave = find(pair, "slave")->text;  // the pair's keys move when one is added
    put_sampling(m, card, slave, law, pair);
    put_weight(m, card, pair);
    const double clearance = is_of_nodes ? usual_clearance(m, card, slave) : 0;
    m.pairs.push_back({find(pair, "name")->text, io::inp::capitals(law.name),
                       find(pair, "slave")->text, find(pair, "master")->text, clearance});
    put_laws(m, law, pair, clearance);
    if (inp_is_tied(law.behavior)) note_tied_pair(m, card, law, pair);
    if (const io::inp::Parameter* const adjust = io::inp::find_parameter(card, "ADJUST"))
      put_adjust(m, card, adjust->value, pair);
  }
  if (io::inp::find_parameter(card, "SMALLSLIDING") && !inp_is_tied(law.behavior))
    m.notes.push_back(fmt::format("line {}: sliding is finite, not SMALL SLIDING", card.at.line));
}

/// The initial gap of all points of a contact pair, whatever the mesh has.
void put_clearance(InpModel& m, const Card& card, SourceNode& pairs) {
  const auto surface = [&](const char* key) {
    return set_of(m, card.at, io::inp::name_of(value_of(m, card, key)),
                  {SetKind::surface, SetKind::node_surface});
  };
  const std::string slave = surface("SLAVE"), master = surface("MASTER");
  const auto of = std::ranges::find_if(
      m.pairs, [&](const InpPair& one) { return one.slave == slave && one.master == master; });
  if (of == m.pairs.end())
    io::inp::fail(m.deck, card,
                  fmt::format("there is no *CONTACT PAIR of '{}' and '{}'", slave, master));
  const auto pair = std::ranges::find_if(
      pairs.items, [&](SourceNode& one) { return find(one, "name")->text == of->name; });
  if (find(*pair, "initial"))
    io::inp::fail(m.deck, card, "the contact pair has an ADJUST or a *CLEARANCE already");
  if (of->clearance > 0)
    m.notes.push_back(
        fmt::format("line {}: CalculiX leaves *CLEARANCE out with NODE TO SURFACE; here it counts",
                    card.at.line));
  const double value = Fields(m.deck, {value_of(m, card, "VALUE"), card.at}).real("VALUE");
  const int line = line_of(card.at);
  put(put(*pair, "initial", inp_map(line)), "clearance", inp_number(value, line));
}

/// Overlaps between surfaces are let in over the first step, if that is static, as in CalculiX.
void ramp_overlaps(const InpModel& m, SourceNode& pairs) {
  if (contact_is_damped(m, {})) return;  // the first step is dynamic
  for (SourceNode& pair : pairs.items) {
    const auto of = std::ranges::find(m.pairs, find(pair, "name")->text, &InpPair::name);
    if (of == m.pairs.end() || find(pair, "initial")) continue;
    const SourceNode& sampling = *find(pair, "sampling");
    if (sampling.text != "mortar" && sampling.text != "nodes")
      put(pair, "initial", inp_text("ramp", sampling.line));
  }
}

/// Explicit steps know no equations of many displacements.
void add_explicit_ties(InpModel& m, const Card& card, SourceNode& pairs) {
  for (const Line& line : io::inp::lines_of(m.deck, card)) {
    SourceNode& pair = pair_of_line(m, card, line, pairs);
    const int at = line_of(line.at);
    put(pair, "sampling", inp_text("nodes", at));
    put_weight(m, card, pair);
    SourceNode& normal = put(pair, "normal", inp_map(at));
    put(normal, "separation", inp_text("tied", at));
    if (const auto* const tolerance = io::inp::find_parameter(card, "POSITIONTOLERANCE"))
      put(normal, "tolerance",
          inp_number(Fields(m.deck, {tolerance->value, card.at}).real("POSITION TOLERANCE"), at));
  }
}

}  // namespace

std::vector<InpInteraction> inp_interactions(const InpModel& m) {
  std::vector<InpInteraction> all;
  const auto set = [&](const Card& card, const Card* InpInteraction::*which) {
    if (all.empty()) io::inp::fail(m.deck, card, "stands before the first *SURFACE INTERACTION");
    all.back().*which = &card;
  };
  for (const Card& card : m.deck.cards) {
    if (card.keyword == "STEP") break;  // what follows changes one: inp_changes.cpp
    if (card.keyword == "SURFACEINTERACTION")
      all.push_back({&card, nullptr, nullptr, nullptr, value_of(m, card, "NAME")});
    if (card.keyword == "SURFACEBEHAVIOR") set(card, &InpInteraction::behavior);
    if (card.keyword == "FRICTION") set(card, &InpInteraction::friction);
    if (card.keyword == "CONTACTDAMPING") set(card, &InpInteraction::damping);
  }
  return all;
}

const InpInteraction& interaction_named(const InpModel& m, const std::vector<InpInteraction>& all,
                                        io::inp::Place at, std::string_view name) {
  std::vector<std::string> names;
  for (const InpInteraction& one : all) {
    if (io::inp::capitals(one.name) == io::inp::capitals(name)) return one;
    names.push_back(one.name);
  }
  io::inp::fail(m.deck, at,
                core::unknown_name_message("surface interaction", printable(name), names));
}

bool contact_is_damped(const InpModel& m, std::span<const Card> cards) {
  std::optional<bool> acts;
  const auto look = [&](const Card& card) {
    if (card.keyword == "DYNAMIC") acts = true;
    if (card.keyword == "STATIC" || card.keyword == "VISCO") acts = false;
  };
  std::ranges::for_each(cards, look);
  for (std::size_t k = 0; !acts && k < m.deck.cards.size(); ++k) look(m.deck.cards[k]);
  return acts.value_or(false);
}

void put_laws(const InpModel& m, const InpInteraction& law, SourceNode& pair, double clearance) {
  SourceNode& normal =
      put(pair, "normal", inp_normal(m, law.behavior, line_of(law.card->at), clearance));
  // CalculiX has 50 E, whatever the mesh and the unit of length are
  if (inp_is_hard(law.behavior) && !find(pair, "enforcement"))
    put(normal, "auto_factor", inp_number(10, line_of(law.card->at)));
  const Card* const damping = contact_is_damped(m, {}) ? law.damping : nullptr;
  if (damping) put_damping(m, *damping, normal);
  SourceNode friction = inp_shear(m, law.behavior, law.friction, damping);
  if (!friction.entries.empty() || !friction.text.empty())
    put(pair, "friction", std::move(friction));
}

SourceNode& add_pair(const InpModel& m, io::inp::Place at, const std::string& slave,
                     const std::string& master, SourceNode& pairs, bool nodes) {
  const int line = line_of(at);
  const std::string name = name_for(pairs, slave, master);
  SourceNode& pair = pairs.items.emplace_back(inp_map(line));
  put(pair, "name", inp_text(name, line));
  put(pair, "master", inp_text(set_of(m, at, master, {SetKind::surface}), line));
  const bool of_nodes = nodes && m.sets.contains({SetKind::node_surface, io::inp::capitals(slave)});
  put(pair, "slave",
      inp_text(of_nodes ? set_of(m, at, slave, {SetKind::node_surface})
                        : set_of(m, at, slave, {SetKind::surface, SetKind::node_surface}),
               line));
  return pair;
}

SourceNode inp_contact(InpModel& m) {
  SourceNode pairs = inp_list(1);
  const std::vector<InpInteraction> interactions = inp_interactions(m);
  for (const Card& card : m.deck.cards) {
    if (card.keyword == "CONTACTPAIR")
      add_contact_pair(
          m, card, interaction_named(m, interactions, card.at, value_of(m, card, "INTERACTION")),
          pairs);
    if (card.keyword == "TIE" && !is_cyclic_tie(card) && is_explicit(m))
      add_explicit_ties(m, card, pairs);
  }
  for (const Card& card : m.deck.cards)
    if (card.keyword == "CLEARANCE") put_clearance(m, card, pairs);
  ramp_overlaps(m, pairs);
  return inp_general_contact(m, interactions, std::move(pairs));
}

}  // namespace osculate::deck
