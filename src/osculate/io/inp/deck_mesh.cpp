#include "osculate/io/inp/deck_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "osculate/io/inp/expand.hpp"
#include "osculate/io/inp/loaded_sets.hpp"
#include "osculate/io/inp/sides.hpp"

namespace osculate::io::inp {
namespace {

/// By kind of set, where the name is taken.
constexpr std::array<std::string_view, 4> endings{".cells", ".surface", ".nodes", ".surface_nodes"};

RawMesh raw_mesh(const Deck& deck) {
  RawMesh mesh = collect(deck);
  add_loaded_sets(deck, mesh);
  return mesh;
}

/// Sets of elements that have a section, in capitals.
std::set<std::string> section_sets(const Deck& deck) {
  std::set<std::string> names;
  for (const Card& card : deck.cards)
    if (card.keyword == "SOLIDSECTION" || is_thin_section(card))
      if (const Parameter* const set = find_parameter(card, "ELSET"))
        names.insert(capitals(set->value));
  return names;
}

std::set<std::string> layered_sets(const Deck& deck) {
  std::set<std::string> names;
  for (const Card& card : deck.cards)
    if (is_layered(card))
      if (const Parameter* const set = find_parameter(card, "ELSET"))
        names.insert(capitals(set->value));
  return names;
}

class Builder {
 public:
  explicit Builder(const Deck& deck)
      : deck_(deck),
        sections_(section_sets(deck)),
        layered_(layered_sets(deck)),
        raw_(raw_mesh(deck)),
        numbering_(add_cells(deck, raw_, out_.mesh)),
        members_(deck, raw_, numbering_, out_.mesh),
        sides_(deck, raw_, numbering_, out_.mesh) {}

  /// Sets of elements first: they keep their names.
  DeckMesh build() {
    expand_thin();
    for (std::uint32_t s = 0; s < raw_.scopes.size(); ++s)
      for (const auto& [key, raw] : raw_.scopes[s].element_sets) add_elements(s, raw);
    for (std::uint32_t s = 0; s < raw_.scopes.size(); ++s)
      for (const auto& [key, raw] : raw_.scopes[s].surfaces) add_surface(s, raw);
    find_reference_nodes();
    for (std::uint32_t s = 0; s < raw_.scopes.size(); ++s) {
      for (const auto& [key, raw] : raw_.scopes[s].node_sets) {
        const std::vector<Index>& nodes = members_.of(Kind::nodes, s, raw.name, raw.at);
        add_nodes(SetKind::nodes, s, raw, nodes);
        add_thin_sets(s, raw, nodes);
      }
      for (const auto& [key, raw] : raw_.scopes[s].node_surfaces)
        add_nodes(SetKind::node_surface, s, raw, members_.of(Kind::nodes, s, raw));
    }
    mesh::remember_names(out_.mesh);
    out_.missing = members_.missing();
    return std::move(out_);
  }

 private:
  /// Makes solids of shells, beams and of plane elements beside solids, and sets of their knots.
  void expand_thin() {
    const ThinCards cards = thin_cards(deck_, raw_, numbering_, members_);
    if (cards.sections.empty()) return;
    expansion_ = expand(deck_, cards, numbering_, out_.mesh);
    out_.sectors = cards.sectors;
    for (Knot& knot : expansion_.knots) {
      const std::int64_t number = mesh::node_number(out_.mesh, knot.node);
      mesh::Set set{fmt::format("knot {}", number), 0, {}, std::move(knot.nodes), true};
      std::sort(set.nodes.begin(), set.nodes.end());
      out_.knots.push_back({knot.node, set.name});
      out_.mesh.sets.push_back(std::move(set));
      in_knot_.insert(knot.node);
    }
  }

  /// Nodes that stand for bodies are like knots: what acts on them acts on these.
  void find_reference_nodes() {
    for (const Card& card : deck_.cards) {
      if (card.keyword != "RIGIDBODY" && card.keyword != "COUPLING" &&
          card.keyword != "PRE-TENSIONSECTION")
        continue;
      for (const char* const name : {"REFNODE", "ROTNODE", "NODE"}) {
        const Parameter* const given = find_parameter(card, name);
        if (!given) continue;
        const std::optional<std::int32_t> number = number_of(name_of(given->value));
        const Named<RawSet>& sets = raw_.scopes[0].node_sets;
        const auto found = sets.find(capitals(number ? node_set_name(*number) : given->value));
        if (found == sets.end()) continue;
        for (const Index node : members_.of(Kind::nodes, 0, found->second.name, card.at))
          in_knot_.insert(node);
      }
    }
  }

  /// Beside a set of nodes those of its rotations, and those that are in no knot.
  void add_thin_sets(std::uint32_t scope, const RawSet& raw, const std::vector<Index>& nodes) {
    std::vector<Index> turns, free;
    for (const Index node : nodes) {
      if (!in_knot_.contains(node)) free.push_back(node);
      const auto found = expansion_.rotations.find(node);
      if (found != expansion_.rotations.end()) turns.push_back(found->second);
    }
    RawSet other{"", raw.at, {}, {}};
    if (!turns.empty()) {
      std::sort(turns.begin(), turns.end());
      other.name = set_of_rotations(raw.name);
      add_nodes(SetKind::nodes, scope, other, std::move(turns));
    }
    if (free.empty() || free.size() == nodes.size()) return;
    other.name = set_without_knots(raw.name);
    add_nodes(SetKind::nodes, scope, other, std::move(free));
  }

  [[nodiscard]] mesh::Set named(std::uint32_t scope, const std::string& name) const {
    mesh::Set set;
    set.name = scope == 0 ? name : raw_.scopes[scope].name + "." + name;
    set.any_case = true;
    return set;
  }
  [[nodiscard]] const mesh::Block& block(const mesh::CellRef& ref) const {
    return out_.mesh.blocks[static_cast<std::size_t>(ref.block)];
  }

  /// Dimension and nodes of a set of cells.
  void finish(mesh::Set& set) const {
    for (const mesh::CellRef& ref : set.cells) {
      const cell::CellInfo& info = cell::info(block(ref).type);
      const Index* const nodes = block(ref).cell(ref.cell);
      set.dimension = info.dimension;
      set.nodes.insert(set.nodes.end(), nodes, nodes + info.nodes);
    }
    std::sort(set.nodes.begin(), set.nodes.end());
    set.nodes.erase(std::unique(set.nodes.begin(), set.nodes.end()), set.nodes.end());
  }

  /// One type of elements, and which they are.
  using Typed = std::map<std::string_view, std::vector<mesh::CellRef>>;

  /// Solid and plane elements of a section by their types, where there are several.
  void add_typed_elements(std::uint32_t scope, const RawSet& raw, const Typed& typed) {
    if (typed.size() < 2 || !sections_.contains(capitals(named(scope, raw.name).name))) return;
    for (const auto& [type, cells] : typed) {
      mesh::Set set = named(scope, typed_set_name(raw.name, type));
      set.cells = cells;
      finish(set);
      add(SetKind::elements, std::move(set), raw.at);
      out_.sets.back().type = type;
    }
  }

  /// A set holds cells of one dimension: of others there is one set more.
  void add_elements(std::uint32_t scope, const RawSet& raw) {
    std::array<std::vector<mesh::CellRef>, 4> cells;
    Typed typed;
    const std::vector<Index>& members = members_.of(Kind::elements, scope, raw.name, raw.at);
    if (std::set<std::int32_t> discrete = members_.discrete(scope, raw); !discrete.empty()) {
      if (scope == 0) out_.discrete[capitals(raw.name)] = std::move(discrete);
      if (members.empty()) return;
    }
    for (const Index index : members) {
      const Element& element = numbering_.elements[static_cast<std::size_t>(index)];
      std::vector<mesh::CellRef> refs{element.cell};
      refs.insert(refs.end(), element.others.begin(), element.others.end());
      for (const mesh::CellRef ref : refs) {
        cells[static_cast<std::size_t>(cell::info(block(ref).type).dimension)].push_back(ref);
        if (element.type->family == Family::plane || element.type->family == Family::solid)
          typed[numbering_.variants[element.variant]].push_back(ref);
      }
    }
    constexpr std::array<std::string_view, 4> kinds{".points", ".lines", ".areas", ".volumes"};
    bool whole = true;
    for (std::size_t dimension = cells.size(); dimension-- > 0;) {
      if (cells[dimension].empty() && (dimension > 0 || !whole)) continue;
      mesh::Set set = named(scope, raw.name);
      if (!whole) set.name += kinds[dimension];
      whole = false;
      set.cells = std::move(cells[dimension]);
      finish(set);
      add(SetKind::elements, std::move(set), raw.at);
      if (typed.size() == 1) out_.sets.back().type = typed.begin()->first;
    }
    add_typed_elements(scope, raw, typed);
    add_layers(scope, raw);
  }

  /// Of a section of layers: a set of each, where its elements are all of one kind.
  void add_layers(std::uint32_t scope, const RawSet& raw) {
    if (!layered_.contains(capitals(named(scope, raw.name).name))) return;
    std::vector<std::vector<mesh::CellRef>> layers;
    std::set<std::string_view> types;
    for (const Index index : members_.of(Kind::elements, scope, raw.name, raw.at)) {
      const Element& element = numbering_.elements[static_cast<std::size_t>(index)];
      types.insert(numbering_.variants[element.variant]);
      layers.resize(std::max(layers.size(), element.others.size() + 1));
      layers[0].push_back(element.cell);
      for (std::size_t k = 0; k < element.others.size(); ++k)
        layers[k + 1].push_back(element.others[k]);
    }
    for (std::size_t k = 0; k < layers.size(); ++k) {
      mesh::Set set = named(scope, set_of_layer(raw.name, k + 1));
      set.cells = std::move(layers[k]);
      finish(set);
      add(SetKind::elements, std::move(set), raw.at);
      if (types.size() == 1) out_.sets.back().type = *types.begin();
    }
  }

  void add_surface(std::uint32_t scope, const RawSurface& raw) {
    mesh::Set set = named(scope, raw.name);
    set.cells = sides_.of(raw, scope, members_);
    finish(set);
    add(SetKind::surface, std::move(set), raw.at);
  }

  void add_nodes(SetKind kind, std::uint32_t scope, const RawSet& raw, std::vector<Index> nodes) {
    mesh::Set set = named(scope, raw.name);
    set.nodes = std::move(nodes);
    add(kind, std::move(set), raw.at);
  }

  /// A set that has the nodes of one of the same name is that one; others get an ending.
  void add(SetKind kind, mesh::Set set, Place at) {
    std::string name = set.name;
    for (const bool first : {true, false}) {
      const auto [used, is_new] = used_.try_emplace(capitals(set.name), out_.mesh.sets.size());
      if (is_new) break;
      const mesh::Set& other = out_.mesh.sets[used->second];
      if (kind != SetKind::elements && other.nodes == set.nodes &&
          (other.dimension == set.dimension || set.cells.empty())) {
        out_.sets.push_back({kind, std::move(name), used->second});
        return;
      }
      if (!first) fail(deck_, at, fmt::format("two sets have the name '{}'", set.name));
      set.name += endings[static_cast<std::size_t>(kind)];
    }
    out_.sets.push_back({kind, std::move(name), out_.mesh.sets.size()});
    out_.mesh.sets.push_back(std::move(set));
  }

  const Deck& deck_;
  std::set<std::string> sections_, layered_;
  DeckMesh out_;
  RawMesh raw_;
  Numbering numbering_;
  Members members_;
  Sides sides_;
  Expansion expansion_;
  std::set<Index> in_knot_;
  Named<std::size_t> used_;  ///< names of sets in capitals, and the sets
};

}  // namespace

std::string typed_set_name(std::string_view elements, std::string_view type) {
  return fmt::format("{} of {}", elements, type);
}
std::string set_of_layer(std::string_view elements, std::size_t layer) {
  return fmt::format("{} layer {}", elements, layer);
}
std::string set_without_knots(std::string_view nodes) {
  return fmt::format("{} without knots", nodes);
}
std::string set_of_rotations(std::string_view nodes) {
  return fmt::format("rotations of {}", nodes);
}

DeckMesh deck_mesh(const Deck& deck) { return Builder(deck).build(); }

}  // namespace osculate::io::inp
