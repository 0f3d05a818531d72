#include "osculate/io/inp/loaded_sets.hpp"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <tuple>

namespace osculate::io::inp {
namespace {

/// What `instance.NAME` means: the scope of the instance, and the name in it; outside of them all
/// else.
std::pair<std::uint32_t, std::string> in_instance(std::string_view field, const RawMesh& mesh) {
  if (const std::size_t dot = field.find('.'); dot != std::string_view::npos)
    if (const auto instance = mesh.instances.find(capitals(field.substr(0, dot)));
        instance != mesh.instances.end())
      return {instance->second, name_of(field.substr(dot + 1))};
  return {own_scope, name_of(field)};
}

/// `instance.17`, a node or element of an instance, which keeps that name.
void add_one_of_instance(std::string_view field, Place at, Named<RawSet> Scope::*sets,
                         RawMesh& mesh) {
  const auto [scope, name] = in_instance(field, mesh);
  const std::optional<std::int32_t> number = number_of(name);
  if (scope == own_scope || !number) return;
  RawSet& set = (mesh.scopes[scope].*sets)[name];
  if (set.name.empty()) set = {name, at, {{*number, *number, 1, own_scope, at, false}}, {}};
}

void add_node(std::string_view field, Place at, RawMesh& mesh) {
  const std::optional<std::int32_t> number = number_of(field);
  if (!number) return add_one_of_instance(name_of(field), at, &Scope::node_sets, mesh);
  const std::string name = node_set_name(*number);
  RawSet& set = mesh.scopes[0].node_sets[capitals(name)];
  if (!set.name.empty()) return;
  set.name = name;
  set.at = at;
  set.ranges.push_back({*number, *number, 1, own_scope, at, false});
}

/// The set of the element that a body force names by its number.
void add_element(std::string_view elements, Place at, RawMesh& mesh) {
  const std::optional<std::int32_t> number = number_of(elements);
  if (!number) return add_one_of_instance(elements, at, &Scope::element_sets, mesh);
  const std::string name = element_set_name(elements);
  RawSet& set = mesh.scopes[0].element_sets[capitals(name)];
  if (!set.name.empty()) return;
  set.name = name;
  set.at = at;
  set.ranges.push_back({*number, *number, 1, own_scope, at, false});
}

void add_every_element(Place at, RawMesh& mesh) {
  RawSet& set = mesh.scopes[0].element_sets[capitals(every_element)];
  if (!set.name.empty()) return;
  set.name = every_element;
  set.at = at;
  for (std::size_t s = 0; s < mesh.scopes.size(); ++s)
    if (!mesh.scopes[s].elements.empty())
      set.ranges.push_back({1, std::numeric_limits<std::int32_t>::max(), 1,
                            static_cast<std::uint32_t>(s), at, true});
}

void add_side(const Deck& deck, const Line& line, RawMesh& mesh) {
  Fields fields(deck, line);
  const std::string elements = name_of(fields.next().value_or(""));
  const std::string load = capitals(name_of(fields.next().value_or("")));
  const bool of_bodies =
      load == "GRAV" || load == "CENTRIF" || load == "BX" || load == "BY" || load == "BZ";
  if (of_bodies) {
    if (elements.empty()) return add_every_element(line.at, mesh);
    add_element(elements, line.at, mesh);
  }
  if (elements.empty() || !(is_side_load(load) || is_edge_load(load))) return;
  if (is_edge_load(load)) add_element(elements, line.at, mesh);
  const std::string name = side_set_name(load, elements);
  RawSurface& surface = mesh.scopes[0].surfaces[capitals(name)];
  if (!surface.name.empty()) return;
  surface.name = name;
  surface.at = line.at;
  SurfaceEntry entry;
  entry.set = {"", own_scope, line.at, true};
  std::tie(entry.set.scope, entry.set.name) = in_instance(elements, mesh);
  if (is_number(entry.set.name))
    entry.number = number_of(deck, line.at, entry.set.name, "an element");
  entry.side = load;
  entry.of_load = true;
  surface.entries.push_back(std::move(entry));
}

/// Whether the lines of a card begin with a node or a set of nodes.
bool begins_with_nodes(const Card& card) {
  if (card.keyword == "INITIALCONDITIONS") {
    const Parameter* const type = find_parameter(card, "TYPE");
    return type && (capitals(type->value) == "TEMPERATURE" || capitals(type->value) == "VELOCITY");
  }
  for (const char* const keyword : {"BOUNDARY", "CLOAD", "TEMPERATURE", "DISTRIBUTINGCOUPLING"})
    if (card.keyword == keyword) return true;
  return false;
}

/// Elements that cards name by their numbers: stresses at first, elements that come and go.
void add_named_elements(const Deck& deck, const Card& card, RawMesh& mesh) {
  const Parameter* const type = find_parameter(card, "TYPE");
  const std::string of = type ? capitals(type->value) : std::string{};
  const bool initial =
      card.keyword == "INITIALCONDITIONS" && (of == "STRESS" || of == "PLASTICSTRAIN");
  if (!initial && !(card.keyword == "MODELCHANGE" && of == "ELEMENT")) return;
  for (const Line& line : lines_of(deck, card))
    for (Fields fields(deck, line); !fields.done();) {
      add_element(name_of(fields.next().value_or("")), line.at, mesh);
      if (initial) break;
    }
}

/// Of `*EQUATION`: a line with the number of terms, then node, dof and factor of each.
void add_nodes_of_equations(const Deck& deck, const Card& card, RawMesh& mesh) {
  std::int32_t missing = 0;  // of the terms
  const bool removes = find_parameter(card, "REMOVE") != nullptr;
  for (const Line& line : lines_of(deck, card)) {
    Fields fields(deck, line);
    if (removes) {
      add_node(fields.next().value_or(""), line.at, mesh);
      continue;
    }
    if (missing == 0) {
      missing = number_of(fields.next().value_or("")).value_or(0);
      continue;
    }
    while (!fields.done() && missing > 0) {
      add_node(fields.next().value_or(""), line.at, mesh);
      (void)fields.next();
      (void)fields.next();
      --missing;
    }
  }
}

}  // namespace

int discrete_nodes(const Card& element) {
  const Parameter* const type = find_parameter(element, "TYPE");
  if (!type) return 0;
  const std::string name = capitals(type->value);
  for (const char* const one : {"DCOUP3D", "MASS", "SPRING1", "DASHPOT1"})
    if (name == one) return 1;
  for (const char* const one : {"SPRINGA", "SPRING2", "DASHPOTA", "DASHPOT2", "GAPUNI"})
    if (name == one) return 2;
  return 0;
}

std::string node_set_name(std::int32_t number) { return fmt::format("node {}", number); }

std::string element_set_name(std::string_view elements) {
  if (elements.empty()) return std::string(every_element);
  return is_number(elements) ? fmt::format("element {}", elements) : std::string(elements);
}

std::string side_set_name(std::string_view load, std::string_view elements) {
  return fmt::format("{} of {}", load, element_set_name(elements));
}

std::vector<int> held_directions(std::string_view word) {
  struct Held {
    std::string_view word;
    std::vector<int> directions;
  };
  static const std::array<Held, 8> all{{{"ENCASTRE", {1, 2, 3, 4, 5, 6}},
                                        {"PINNED", {1, 2, 3}},
                                        {"XSYMM", {1, 5, 6}},
                                        {"YSYMM", {2, 4, 6}},
                                        {"ZSYMM", {3, 4, 5}},
                                        {"XASYMM", {2, 3, 4}},
                                        {"YASYMM", {1, 3, 5}},
                                        {"ZASYMM", {1, 2, 6}}}};
  const std::string name = capitals(name_of(word));
  for (const Held& one : all)
    if (one.word == name) return one.directions;
  return {};
}

bool is_side_load(std::string_view load) {
  if (load == "P") return true;
  return load.size() == 2 && load[0] == 'P' && load[1] >= '1' && load[1] <= '6';
}

bool is_edge_load(std::string_view load) {
  return load.size() == 6 && load.starts_with("EDNOR") && load[5] >= '1' && load[5] <= '4';
}

void add_loaded_sets(const Deck& deck, RawMesh& mesh) {
  for (const Card& card : deck.cards) {
    for (const char* const name : {"REFNODE", "ROTNODE", "NODE"})
      if (const Parameter* const node = find_parameter(card, name))
        add_node(name_of(node->value), card.at, mesh);
    if (const int count = card.keyword == "ELEMENT" ? discrete_nodes(card) : 0; count > 0)
      for (const Line& line : lines_of(deck, card)) {
        Fields fields(deck, line);
        (void)fields.next();
        for (int k = 0; k < count; ++k) add_node(fields.next().value_or(""), line.at, mesh);
      }
    if (card.keyword == "MPC")
      for (const Line& line : lines_of(deck, card))
        for (Fields fields(deck, line); !fields.done();)
          add_node(fields.next().value_or(""), line.at, mesh);
    add_named_elements(deck, card, mesh);
    if (card.keyword == "EQUATION") add_nodes_of_equations(deck, card, mesh);
    const bool of_nodes = begins_with_nodes(card);
    for (const Line& line : lines_of(deck, card)) {
      if (card.keyword == "DLOAD") add_side(deck, line, mesh);
      if (of_nodes) add_node(Fields(deck, line).next().value_or(""), line.at, mesh);
    }
  }
}

}  // namespace osculate::io::inp
