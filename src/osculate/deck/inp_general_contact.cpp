// General contact of a deck: *CONTACT with what it includes and excludes.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "osculate/deck/inp_parts.hpp"
#include "osculate/mesh/boundary.hpp"
#include "osculate/mesh/surface.hpp"

namespace osculate::deck {
namespace {

using io::inp::Card;
using io::inp::Fields;
using io::inp::Line;
using io::inp::SetKind;

constexpr std::initializer_list<SetKind> both_kinds{SetKind::surface, SetKind::node_surface};

/// A line `surface, surface, interaction`, in capitals. An empty first surface is everything, an
/// empty second one the first again.
struct ContactLine {
  std::string first, second, interaction;
  io::inp::Place at;
  [[nodiscard]] bool everything() const { return first.empty() && second.empty(); }
  [[nodiscard]] bool same(const ContactLine& b) const {
    return (first == b.first && second == b.second) || (first == b.second && second == b.first);
  }
};

/// What a deck says of its general contact.
struct General {
  const Card* card = nullptr;
  bool all = false;
  std::vector<ContactLine> included, excluded, laws;
};

void add_lines(const InpModel& m, const Card& card, std::vector<ContactLine>& to) {
  for (const Line& line : io::inp::lines_of(m.deck, card)) {
    Fields fields(m.deck, line);
    ContactLine& one = to.emplace_back();
    for (std::string* const name : {&one.first, &one.second, &one.interaction})
      *name = io::inp::capitals(io::inp::name_of(fields.next().value_or("")));
    one.at = line.at;
    if (one.second.empty()) one.second = one.first;
  }
}

/// Reads a card of general contact.
void take(const InpModel& m, const Card& card, General& general) {
  if (card.keyword == "CONTACT") {
    if (general.card) io::inp::fail(m.deck, card, "is given twice");
    general.card = &card;
    return;
  }
  if (!general.card) io::inp::fail(m.deck, card, "stands before *CONTACT");
  if (card.keyword == "CONTACTEXCLUSIONS") return add_lines(m, card, general.excluded);
  if (card.keyword == "CONTACTPROPERTYASSIGNMENT") return add_lines(m, card, general.laws);
  if (io::inp::find_parameter(card, "ALLEXTERIOR"))
    general.all = true;
  else
    add_lines(m, card, general.included);
}

General general_of(const InpModel& m) {
  General general;
  int steps = 0;
  for (const Card& card : m.deck.cards) {
    if (card.keyword == "STEP") ++steps;
    if (card.keyword != "CONTACT" && card.keyword != "CONTACTINCLUSIONS" &&
        card.keyword != "CONTACTEXCLUSIONS" && card.keyword != "CONTACTPROPERTYASSIGNMENT")
      continue;
    if (steps > 1)
      io::inp::fail(m.deck, card,
                    "is not supported after the first step: general contact does not change here");
    take(m, card, general);
  }
  for (const ContactLine& one : general.included) general.all = general.all || one.everything();
  std::erase_if(general.included, [](const ContactLine& one) { return one.everything(); });
  return general;
}

/// The connected parts of a mesh that may touch.
struct Parts {
  std::vector<std::vector<int>> of_cell;  ///< by block and cell; -1: none
  std::vector<mesh::Set> sets;

  [[nodiscard]] int at(const mesh::CellRef& ref) const {
    return of_cell[static_cast<std::size_t>(ref.block)][static_cast<std::size_t>(ref.cell)];
  }
};

Parts parts_of(const mesh::Mesh& mesh, int dimension) {
  Parts parts;
  std::vector<mesh::CellRef> cells;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    parts.of_cell.emplace_back(static_cast<std::size_t>(mesh.blocks[b].size()), -1);
    if (cell::info(mesh.blocks[b].type).dimension != dimension) continue;
    for (Index k = 0; k < mesh.blocks[b].size(); ++k) cells.push_back({static_cast<Index>(b), k});
  }
  for (std::vector<mesh::CellRef>& part : mesh::connected_parts(mesh, cells)) {
    for (const mesh::CellRef& ref : part)
      parts.of_cell[static_cast<std::size_t>(ref.block)][static_cast<std::size_t>(ref.cell)] =
          static_cast<int>(parts.sets.size());
    parts.sets.push_back({"", dimension, std::move(part), {}});
  }
  return parts;
}

/// The parts behind the facets of a surface, and whether it has all their free facets.
struct Behind {
  std::set<int> parts;
  std::size_t facets = 0, free = 0;

  template <class Facets>
  void add(const Parts& of, const Facets& surface) {
    for (const auto& facet : surface.facets)
      if (facet.parent != mesh::no_cell) parts.insert(of.at(facet.parent));
    facets = surface.facets.size();
  }
};

Behind behind(const mesh::Mesh& mesh, const Parts& parts, const mesh::Set& surface, int dimension) {
  Behind out;
  if (dimension == 3) {
    const mesh::FaceTable table = mesh::face_table(mesh);
    out.add(parts, mesh::surface_of(mesh, table, surface));
    for (const int k : out.parts)
      out.free +=
          mesh::surface_facets(mesh, table, parts.sets[static_cast<std::size_t>(k)]).facets.size();
    return out;
  }
  const mesh::EdgeTable table = mesh::edge_table(mesh);
  out.add(parts, mesh::surface_of(mesh, table, surface));
  for (const int k : out.parts)
    out.free +=
        mesh::boundary_facets(mesh, table, parts.sets[static_cast<std::size_t>(k)]).facets.size();
  return out;
}

/// The sets of sections whose bodies a surface covers, all of them and whole; without a name: of
/// all sections. Empty: it covers a part of some.
std::vector<std::string> sections_under(InpModel& m, const Parts& parts, const std::string& name,
                                        io::inp::Place at) {
  std::vector<std::string> names;
  if (name.empty()) {
    for (SourceNode& section : m.sections.items) names.push_back(find(section, "on")->text);
    return names;
  }
  const mesh::Mesh& mesh = m.mesh.mesh;
  const mesh::Set& set = *mesh.find_set(set_of(m, at, name, both_kinds));
  if (set.cells.empty()) return {};
  const Behind under = behind(mesh, parts, set, inp_dimension(m));
  std::set<int> covered;
  for (SourceNode& section : m.sections.items) {
    // null: a set that the translation makes
    const mesh::Set* const cells = mesh.find_set(find(section, "on")->text);
    std::set<int> own;
    if (cells)
      for (const mesh::CellRef& ref : cells->cells) own.insert(parts.at(ref));
    if (own.empty() || !std::ranges::includes(under.parts, own)) continue;
    covered.insert(own.begin(), own.end());
    names.push_back(cells->name);
  }
  if (under.parts.empty() || under.facets != under.free || covered != under.parts) return {};
  return names;
}

/// Whole bodies by their sections, else the surfaces themselves.
void put_exclusions(InpModel& m, const General& general, SourceNode& all) {
  if (general.excluded.empty()) return;
  const int first = line_of(general.excluded[0].at);
  SourceNode bodies = inp_list(first), surfaces = inp_list(first);
  const Parts parts = parts_of(m.mesh.mesh, inp_dimension(m));
  for (const ContactLine& one : general.excluded) {
    if (one.everything()) io::inp::fail(m.deck, one.at, "*CONTACT EXCLUSIONS: nothing is left");
    const int line = line_of(one.at);
    const auto under_first = sections_under(m, parts, one.first, one.at),
               under_second = sections_under(m, parts, one.second, one.at);
    if (!under_first.empty() && !under_second.empty()) {
      for (const std::string& a : under_first)
        for (const std::string& b : under_second)
          bodies.items.emplace_back(inp_list(line)).items = {inp_text(a, line), inp_text(b, line)};
      continue;
    }
    if (one.first.empty() || one.second.empty())
      io::inp::fail(m.deck, one.at,
                    "*CONTACT EXCLUSIONS: with a surface that is not the whole one of a body the "
                    "other one needs a name");
    surfaces.items.emplace_back(inp_list(line)).items = {
        inp_text(set_of(m, one.at, one.first, both_kinds), line),
        inp_text(set_of(m, one.at, one.second, both_kinds), line)};
  }
  if (!bodies.items.empty()) put(all, "exclude", std::move(bodies));
  if (!surfaces.items.empty()) put(all, "exclude_surfaces", std::move(surfaces));
}

/// The law that was assigned last: to these surfaces, else to all.
const ContactLine* law_of(const General& general, const ContactLine& pair) {
  const ContactLine* found = nullptr;
  for (const ContactLine& law : general.laws)
    if (law.same(pair) || (law.everything() && (!found || found->everything()))) found = &law;
  return found;
}

bool has_pair(const std::vector<ContactLine>& list, const ContactLine& pair) {
  return std::ranges::any_of(list, [&](const ContactLine& one) { return one.same(pair); });
}

/// Both sides are slaves in turn, as with `all`.
void add_both_ways(InpModel& m, const ContactLine& one, const ContactLine* law,
                   const std::vector<InpInteraction>& interactions, SourceNode& pairs) {
  SourceNode& pair = add_pair(m, one.at, one.first, one.second, pairs);
  m.pairs.push_back({find(pair, "name")->text, law ? law->interaction : std::string(),
                     find(pair, "slave")->text, find(pair, "master")->text});
  if (law) put_laws(m, interaction_named(m, interactions, law->at, law->interaction), pair);
  if (one.first == one.second) return;
  SourceNode both = inp_text("true", line_of(one.at));
  both.quoted = false;
  put(pair, "two_pass", std::move(both));
}

/// Surfaces with an interaction of their own are pairs, which come before `all`.
SourceNode contact_of_all(InpModel& m, const General& general,
                          const std::vector<InpInteraction>& interactions, SourceNode pairs) {
  const int line = line_of(general.card->at);
  SourceNode root = inp_map(line), all = inp_map(line);
  const ContactLine* of_all = nullptr;
  for (const ContactLine& law : general.laws) {
    if (law.everything()) {
      of_all = &law;
      continue;
    }
    if (law.first.empty() || law.second.empty())
      io::inp::fail(m.deck, law.at,
                    "*CONTACT PROPERTY ASSIGNMENT: beside ALL EXTERIOR expected two surfaces and "
                    "their interaction, or `, , NAME` for all");
    if (!has_pair(general.excluded, law) && law_of(general, law) == &law)
      add_both_ways(m, law, &law, interactions, pairs);
  }
  if (of_all) {
    put_laws(m, interaction_named(m, interactions, of_all->at, of_all->interaction), all);
    m.pairs.push_back({"all", of_all->interaction, {}, {}});
  }
  put_exclusions(m, general, all);
  put(root, "all", std::move(all));
  if (!pairs.items.empty()) put(root, "pairs", std::move(pairs));
  return root;
}

void add_included(InpModel& m, const General& general,
                  const std::vector<InpInteraction>& interactions, SourceNode& pairs) {
  for (const ContactLine& law : general.laws)
    if (!law.everything() && !has_pair(general.included, law))
      io::inp::fail(m.deck, law.at,
                    "*CONTACT PROPERTY ASSIGNMENT: *CONTACT INCLUSIONS has no such pair");
  for (const ContactLine& one : general.excluded)
    if (!has_pair(general.included, one))
      io::inp::fail(m.deck, one.at, "*CONTACT EXCLUSIONS: *CONTACT INCLUSIONS has no such pair");
  for (const ContactLine& one : general.included) {
    if (has_pair(general.excluded, one)) continue;
    if (one.first.empty())
      io::inp::fail(m.deck, one.at,
                    "*CONTACT INCLUSIONS: expected two surfaces, or ALL EXTERIOR alone");
    add_both_ways(m, one, law_of(general, one), interactions, pairs);
  }
}

}  // namespace

SourceNode inp_general_contact(InpModel& m, const std::vector<InpInteraction>& interactions,
                               SourceNode pairs) {
  const General general = general_of(m);
  if (!general.card) return pairs;
  if (!general.all) {
    if (general.included.empty())
      io::inp::fail(m.deck, *general.card, "expected *CONTACT INCLUSIONS after it");
    add_included(m, general, interactions, pairs);
    return pairs;
  }
  if (has_layers_of_plane(m))
    io::inp::fail(m.deck, *general.card,
                  "plane elements become solids beside others, and ALL EXTERIOR would have their "
                  "sides, too: name the pairs of surfaces");
  if (!general.included.empty())
    io::inp::fail(m.deck, general.included[0].at,
                  "*CONTACT INCLUSIONS: ALL EXTERIOR has all pairs of surfaces already");
  return contact_of_all(m, general, interactions, std::move(pairs));
}

}  // namespace osculate::deck
