#include "osculate/deck/inp_translate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>

#include "osculate/core/text.hpp"
#include "osculate/deck/inp_keywords.hpp"
#include "osculate/deck/inp_parts.hpp"
#include "osculate/io/inp/loaded_sets.hpp"
#include "osculate/io/inp/thin_sections.hpp"

namespace osculate::deck {

using io::inp::Card;
using io::inp::Line;
using io::inp::Parameter;
using io::inp::Place;

SourceNode inp_text(std::string text, int line) {
  SourceNode node;
  node.kind = SourceNode::Kind::scalar;
  node.quoted = true;
  node.line = line;
  node.text = std::move(text);
  return node;
}
SourceNode inp_number(double value, int line) {
  SourceNode node = inp_text(fmt::format("{}", value), line);
  node.quoted = false;
  return node;
}
SourceNode inp_list(int line) {
  SourceNode node;
  node.kind = SourceNode::Kind::list;
  node.line = line;
  return node;
}
SourceNode inp_map(int line) {
  SourceNode node = inp_list(line);
  node.kind = SourceNode::Kind::map;
  return node;
}
SourceNode& put(SourceNode& map, std::string key, SourceNode value) {
  const int line = value.line;
  map.entries.push_back({std::move(key), line, std::move(value)});
  return map.entries.back().value;
}
SourceNode* find(SourceNode& map, std::string_view key) {
  for (SourceEntry& entry : map.entries)
    if (entry.key == key) return &entry.value;
  return nullptr;
}

std::string plain_name(std::string_view name) {
  std::string plain(name);
  const auto is_plain = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-';
  };
  for (char& c : plain)
    if (!is_plain(c)) c = '_';
  return plain;
}

const std::string& value_of(const InpModel& m, const Card& card, std::string_view parameter) {
  const Parameter* const found = io::inp::find_parameter(card, parameter);
  if (!found || found->value.empty())
    io::inp::fail(m.deck, card, fmt::format("expected '{}=' with a name", parameter));
  return found->value;
}
std::string option_of(const Card& card, std::string_view parameter) {
  const Parameter* const found = io::inp::find_parameter(card, parameter);
  return found ? io::inp::capitals(found->value) : std::string();
}
const Line& only_line(const InpModel& m, const Card& card, const char* what) {
  const auto lines = io::inp::lines_of(m.deck, card);
  if (lines.empty()) io::inp::fail(m.deck, card, fmt::format("expected a line with {}", what));
  if (lines.size() > 1)
    io::inp::fail(m.deck, lines[1].at,
                  fmt::format("*{}: one line with {} is read, no second one", card.keyword, what));
  return lines[0];
}

const std::string& set_of(const InpModel& m, Place at, std::string_view name,
                          std::initializer_list<io::inp::SetKind> kinds) {
  for (const io::inp::SetKind kind : kinds)
    if (const auto found = m.sets.find({kind, io::inp::capitals(name)}); found != m.sets.end())
      return m.mesh.mesh.sets[found->second].name;
  std::vector<std::string> names;
  for (const io::inp::DeckSet& set : m.mesh.sets)
    if (std::find(kinds.begin(), kinds.end(), set.kind) != kinds.end()) names.push_back(set.name);
  const bool surfaces = *kinds.begin() == io::inp::SetKind::surface;
  const bool nodes = *kinds.begin() == io::inp::SetKind::nodes;
  const char* const what = surfaces ? "surface" : nodes ? "set of nodes" : "set of elements";
  io::inp::fail(m.deck, at, core::unknown_name_message(what, printable(name), names));
}

namespace {

/// What a part or an instance may hold, but for the mesh: sections, which are not there any more.
void require_assembly(const InpModel& m, const Card& card, const InpKeyword& known,
                      const Card*& part) {
  const std::string& key = card.keyword;
  if (key == "PART" || key == "INSTANCE") part = &card;
  if (key == "ENDPART" || key == "ENDINSTANCE") part = nullptr;
  if (!part || (known.use == KeywordUse::mesh && io::inp::discrete_nodes(card) == 0)) return;
  io::inp::fail(m.deck, card,
                fmt::format("stands in the *{} of line {}, where the mesh and its sections are "
                            "read: its place is the assembly or behind it",
                            part->keyword, part->at.line));
}

/// A keyword without counterpart stops; others that are left out are told of once.
void check_keywords(InpModel& m) {
  std::set<std::string> left_out;
  const Card* part = nullptr;
  for (const Card& card : m.deck.cards) {
    const InpKeyword* const known = find_inp_keyword(card.keyword);
    if (!known) {
      std::vector<std::string> names;
      for (const InpKeyword& one : inp_keywords()) names.emplace_back(one.keyword);
      io::inp::fail(m.deck, card.at, core::unknown_name_message("keyword", card.keyword, names));
    }
    if (known->use == KeywordUse::mesh || known->use == KeywordUse::translated) {
      require_assembly(m, card, *known, part);
      continue;
    }
    if (known->use == KeywordUse::silent) {
      if (known->keyword != "HEADING") left_out.insert(fmt::format("*{}", known->keyword));
      continue;
    }
    io::inp::fail(m.deck, card, fmt::format("is not supported: {}", known->here));
  }
  if (left_out.empty()) return;
  std::string text;
  for (const std::string& one : left_out) text += (text.empty() ? "" : ", ") + one;
  m.notes.push_back(fmt::format("of '{}' these are left out: {}", m.deck.files[0], text));
}

/// Nodes of all sets that a tree names.
void mark_named_nodes(InpModel& m, const SourceNode& tree) {
  for (const SourceEntry& entry : tree.entries) mark_named_nodes(m, entry.value);
  for (const SourceNode& item : tree.items) mark_named_nodes(m, item);
  if (tree.kind != SourceNode::Kind::scalar || !tree.quoted) return;
  if (const mesh::Set* const set = m.mesh.mesh.find_set(tree.text))
    for (const Index node : set->nodes) m.used_nodes[static_cast<std::size_t>(node)] = true;
}

void mark_used_nodes(InpModel& m, const SourceNode& root) {
  m.used_nodes.assign(m.mesh.mesh.nodes.size(), false);
  for (const mesh::Block& block : m.mesh.mesh.blocks)
    for (const Index node : block.connectivity) m.used_nodes[static_cast<std::size_t>(node)] = true;
  for (const mesh::Relation& relation : m.mesh.mesh.relations)
    for (const auto& term : relation.terms)
      m.used_nodes[static_cast<std::size_t>(term.node)] = true;
  for (const auto& [node, body] : m.body_nodes) m.used_nodes[static_cast<std::size_t>(node)] = true;
  // What has a temperature has no displacements for that.
  for (const SourceEntry& entry : root.entries)
    if (entry.key != "initial_temperature") mark_named_nodes(m, entry.value);
}

void tell_of_plane_elements(InpModel& m) {
  if (has_layers_of_plane(m))
    m.notes.emplace_back(
        "plane elements beside others become solids of one layer, whose two sides move alike "
        "(docs/inp.md)");
  if (m.mesh.sectors)
    m.notes.emplace_back(
        "axisymmetric elements beside solids are sectors of 2 degrees: of the forces of *CLOAD and "
        "of the thickness of plane elements a 180th acts, as in CalculiX");
}

std::string heading_of(const InpModel& m) {
  for (const Card& card : m.deck.cards)
    if (card.keyword == "HEADING" && !io::inp::lines_of(m.deck, card).empty())
      return printable(io::inp::lines_of(m.deck, card)[0].text);
  return {};
}

}  // namespace

bool names_a_deck(std::string_view file) {
  return file.size() > 4 && io::inp::capitals(file.substr(file.size() - 4)) == ".INP";
}

TranslatedDeck translate_deck(std::string_view content, const std::string& file) {
  return translate_deck(io::inp::read_cards(content, file));
}

TranslatedDeck translate_deck(const io::inp::Deck& deck) {
  const std::string& file = deck.files[0];
  InpModel m{deck, {}, {}, false, {}, {}};
  check_keywords(m);
  check_parameters(m);
  m.finite = io::inp::has_finite_step(deck);
  m.mesh = io::inp::deck_mesh(deck);
  for (const auto& [number, line] : m.mesh.missing)
    m.notes.push_back(
        fmt::format("line {}: node {} of a set does not exist, and is left out", line, number));
  tell_of_plane_elements(m);
  for (const io::inp::DeckSet& set : m.mesh.sets)
    m.sets.emplace(std::pair(set.kind, io::inp::capitals(set.name)), set.set);
  TranslatedDeck out;
  out.root = inp_map(1);
  put(out.root, "osculate", inp_number(1, 1));
  const std::string title = heading_of(m);
  if (!title.empty()) put(out.root, "title", inp_text(title, 1));
  put(out.root, "mesh", inp_text(std::filesystem::path(file).filename().string(), 1));
  const auto put_unless_empty = [&](const char* key, SourceNode node) {
    if (!node.entries.empty() || !node.items.empty()) put(out.root, key, std::move(node));
  };
  put_unless_empty("materials", inp_materials(m));
  m.sections = inp_sections(m);
  m.new_sets = inp_overlaps(m, m.sections);
  put_unless_empty("sections", m.sections);
  put_unless_empty("rigid", inp_rigid(m));
  put_unless_empty("contact", inp_contact(m));
  put_unless_empty("axes", inp_axes(m));
  put_constraints(m, out.root);
  put_springs(m, out.root);
  put_unless_empty("equations", inp_equations(m));
  put_unless_empty("initial_temperature", inp_initial_temperature(m));
  put_unless_empty("initial_velocity", inp_initial_velocity(m));
  put_initial_state(m, out.root);
  mark_used_nodes(m, out.root);
  InpSteps steps = inp_steps(m);
  put_unless_empty("sets", std::move(m.new_sets));
  put_unless_empty("amplitudes", std::move(steps.amplitudes));
  put(out.root, "steps", std::move(steps.steps));
  put_unless_empty("output", inp_output(m));
  out.notes = std::move(m.notes);
  out.check_only = std::ranges::any_of(
      deck.cards, [](const Card& card) { return card.keyword == "NOANALYSIS"; });
  return out;
}

}  // namespace osculate::deck
