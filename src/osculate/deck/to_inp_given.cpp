// Shells, beams and plane elements beside solids of a deck, written as they were.
#include "osculate/deck/to_inp_given.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "osculate/core/error.hpp"
#include "osculate/deck/inp_keywords.hpp"
#include "osculate/deck/inp_translate.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/io/gmsh.hpp"
#include "osculate/io/inp/loaded_sets.hpp"
#include "osculate/io/inp/thin_sections.hpp"

namespace osculate::deck {
namespace {

using io::inp::Card;
using io::inp::Parameter;
using io::inp::SetKind;

constexpr std::string_view turning_word = "rotations of ", node_word = "node ";

/// The path of the one deck that is the mesh, as it is.
const std::string& path_of_deck(const Description& d) {
  const bool one =
      d.mesh.files.size() == 1 && d.mesh.files[0].name.value.empty() && d.mesh.generated.empty();
  if (!one)
    throw core::InputError(
        d.mesh.mark,
        "shells, beams, trusses and plane elements that became solids are written where one input "
        "file is the whole mesh");
  return d.mesh.files[0].path;
}

bool same_axes(const material::Orientation& a, const material::Orientation& b) {
  return a.kind == b.kind && a.a == b.a && a.b == b.b && a.about == b.about && a.angle == b.angle &&
         a.on_shell == b.on_shell;
}

bool is_of_mesh(const Card& card) {
  if (card.keyword == "ELEMENT") return io::inp::discrete_nodes(card) == 0;
  return std::ranges::any_of(
      std::array{"NODE", "NSET", "ELSET", "SURFACE", "NODALTHICKNESS", "NORMAL"},
      [&](const char* keyword) { return card.keyword == keyword; });
}

/// `*SHELL SECTION, ELSET=E`; of some parameters there are other values, and INPUT has been read.
std::string head_of_card(const Card& card, const std::string& material = {}) {
  const InpKeyword* const known = find_inp_keyword(card.keyword);
  std::string text = fmt::format("*{}", known ? known->keyword : std::string_view(card.keyword));
  for (const Parameter& p : card.parameters) {
    if (p.name == "INPUT" || (!material.empty() && p.name == "ORIENTATION")) continue;
    text += ", " + p.name;
    if (p.is_flag) continue;
    const std::string& value = !material.empty() && p.name == "MATERIAL" ? material : p.value;
    const bool quoted = value.find_first_of(" ,") != std::string::npos;
    text += quoted ? fmt::format("=\"{}\"", value) : fmt::format("={}", value);
  }
  return text;
}

std::string text_of_lines(const io::inp::Deck& deck, const Card& card) {
  std::string text;
  for (const io::inp::Line& line : io::inp::lines_of(deck, card))
    text.append(line.text).append("\n");
  return text;
}

/// Thickness and points of a layer, then its material and axes.
std::string layer_line(const io::inp::Deck& deck, const io::inp::Line& line,
                       const std::string& material, std::string_view axes) {
  io::inp::Fields fields(deck, line);
  const std::string_view thickness = fields.next().value_or(""),
                         points = fields.next().value_or("");
  return fmt::format("{}, {}, {}{}\n", thickness, points, material,
                     axes.empty() ? "" : fmt::format(", {}", axes.substr(axes.find('=') + 1)));
}

bool same_mesh(const mesh::Mesh& a, const mesh::Mesh& b) {
  const auto blocks = [](const mesh::Mesh& mesh) {
    std::map<cell::CellType, const mesh::Block*> out;
    for (const mesh::Block& block : mesh.blocks)
      if (cell::info(block.type).dimension == 3 && block.size() > 0) out[block.type] = &block;
    return out;
  };
  const auto one = blocks(a), other = blocks(b);
  const auto same_term = [](const auto& s, const auto& t) {
    return s.node == t.node && s.direction == t.direction && s.factor == t.factor;
  };
  return a.nodes == b.nodes && a.numbers == b.numbers && one.size() == other.size() &&
         std::ranges::equal(one, other,
                            [](const auto& s, const auto& t) {
                              return s.first == t.first &&
                                     s.second->connectivity == t.second->connectivity;
                            }) &&
         std::ranges::equal(a.relations, b.relations, [&](const auto& s, const auto& t) {
           return s.from == t.from && std::ranges::equal(s.terms, t.terms, same_term);
         });
}

}  // namespace

GivenMesh::GivenMesh(const Description& description)
    : d_(description),
      text_(io::read_file(path_of_deck(description))),
      deck_(io::inp::read_cards(text_, path_of_deck(description))),
      mesh_(io::inp::deck_mesh(deck_)),
      raw_(io::inp::collect(deck_)) {
  if (raw_.scopes.size() > 1)
    throw core::InputError(d_.mesh.mark,
                           "shells, beams, trusses and plane elements of instances are not "
                           "written");
  const io::inp::Scope& all = raw_.scopes[0];
  for (const io::inp::RawElements& some : all.elements)
    for (const std::int32_t number : some.numbers) elements_[number] = some.type;
  nodes_.insert(all.node_numbers.begin(), all.node_numbers.end());
}

std::string GivenMesh::cards() const {
  std::string out;
  for (const Card& card : deck_.cards)
    if (is_of_mesh(card)) out += head_of_card(card) + "\n" + text_of_lines(deck_, card);
  return out;
}

/// The model's sections of a section of the deck: one, of each type of elements, of each layer.
std::vector<std::size_t> GivenMesh::sections_of(const Card& card) const {
  const Parameter* const elements = io::inp::find_parameter(card, "ELSET");
  std::vector<std::size_t> all;
  if (!elements) return all;
  const std::string name = io::inp::capitals(elements->value);
  for (std::size_t s = 0; s < d_.sections.size(); ++s)
    if (io::inp::capitals(whole(d_.sections[s].on.value)) == name) all.push_back(s);
  return all;
}

std::string GivenMesh::sections(const std::vector<std::string>& axes) const {
  std::string out;
  std::set<std::size_t> written;
  const auto refuse = [&](std::size_t s, const char* what) {
    throw core::InputError(d_.sections[s].on.mark,
                           fmt::format("'{}' {}", d_.sections[s].on.value, what));
  };
  for (const Card& card : deck_.cards) {
    if (card.keyword != "SOLIDSECTION" && !io::inp::is_thin_section(card)) continue;
    const std::vector<std::size_t> own = sections_of(card);
    if (own.empty()) continue;
    written.insert(own.begin(), own.end());
    for (const std::size_t s : own)
      if (!axes[s].empty() &&
          d_.sections[s].orientation.value.on_shell != (card.keyword == "SHELLSECTION"))
        refuse(s,
               "is written as a section whose axes lie along it if it is one of shells, and "
               "there alone (orientation: {..., shell: true})");
    const std::string& material = d_.sections[own[0]].material.value;
    const std::span<const io::inp::Line> lines = io::inp::lines_of(deck_, card);
    if (io::inp::is_layered(card)) {
      if (own.size() != lines.size()) refuse(own[0], "is one of layers that are not all there");
      out += head_of_card(card, material) + "\n";
      for (std::size_t k = 0; k < own.size(); ++k)
        out += layer_line(deck_, lines[k], d_.sections[own[k]].material.value, axes[own[k]]);
      continue;
    }
    for (const std::size_t s : own)
      if (d_.sections[s].material.value != material || axes[s].empty() != axes[own[0]].empty() ||
          !same_axes(d_.sections[s].orientation.value, d_.sections[own[0]].orientation.value))
        refuse(s, "has another material or other axes than the rest of its section in the deck");
    out += head_of_card(card, material) + axes[own[0]] + "\n" + text_of_lines(deck_, card);
  }
  for (std::size_t s = 0; s < d_.sections.size(); ++s)
    if (!written.contains(s))
      refuse(s, "is no set of a section of the deck, beside shells, beams or plane elements");
  return out;
}

std::optional<std::string> GivenMesh::name(SetKind kind, const std::string& set) const {
  const io::inp::Scope& all = raw_.scopes[0];
  const auto has = [&](const std::string& key) {
    if (kind == SetKind::surface) return all.surfaces.contains(key);
    return (kind == SetKind::elements ? all.element_sets
            : kind == SetKind::nodes  ? all.node_sets
                                      : all.node_surfaces)
        .contains(key);
  };
  for (const io::inp::DeckSet& one : mesh_.sets) {
    if (one.kind != kind || mesh_.mesh.sets[one.set].name != set) continue;
    if (has(io::inp::capitals(one.name))) return one.name;
    const std::string_view rest =
        std::string_view(one.name).substr(std::min(one.name.size(), node_word.size()));
    if (kind == SetKind::nodes && one.name.starts_with(node_word) && io::inp::is_number(rest))
      return std::string(rest);
  }
  return std::nullopt;
}

std::set<std::string> GivenMesh::names(SetKind kind) const {
  std::set<std::string> out;
  const auto add = [&](const auto& sets) {
    for (const auto& [name, set] : sets) out.insert(name);
  };
  const io::inp::Scope& all = raw_.scopes[0];
  if (kind == SetKind::elements) add(all.element_sets);
  if (kind == SetKind::nodes) add(all.node_sets);
  if (kind == SetKind::surface) add(all.surfaces);
  if (kind == SetKind::node_surface) add(all.node_surfaces);
  return out;
}

std::string GivenMesh::whole(const std::string& section) const {
  const mesh::Set* const found = mesh_.mesh.find_set(section);
  const std::string set = found ? found->name : section;
  if (const auto own = name(SetKind::elements, set)) return *own;
  for (const std::string_view between : {" of ", " layer "})
    if (const std::size_t at = set.rfind(between); at != std::string::npos)
      if (raw_.scopes[0].element_sets.contains(io::inp::capitals(set.substr(0, at))))
        return set.substr(0, at);
  return section;
}

std::optional<std::string> GivenMesh::turned(const std::string& set) const {
  for (const io::inp::DeckSet& one : mesh_.sets)
    if (one.kind == SetKind::nodes && one.name.starts_with(turning_word) &&
        mesh::same_but_for_case(mesh_.mesh.sets[one.set].name, set))
      return one.name.substr(turning_word.size());
  return std::nullopt;
}

std::optional<std::int64_t> GivenMesh::knot(const std::string& set) const {
  for (const io::inp::DeckKnot& one : mesh_.knots)
    if (mesh::same_but_for_case(one.set, set)) return mesh::node_number(mesh_.mesh, one.node);
  return std::nullopt;
}

const io::inp::ElementType* GivenMesh::element(std::int64_t number) const {
  const auto found = elements_.find(number);
  return found == elements_.end() ? nullptr : found->second;
}

void GivenMesh::require_same(const io::inp::DeckMesh& other) const {
  const auto same_knot = [](const io::inp::DeckKnot& a, const io::inp::DeckKnot& b) {
    return a.node == b.node && a.set == b.set;
  };
  if (!same_mesh(mesh_.mesh, other.mesh) ||
      !std::ranges::equal(mesh_.knots, other.knots, same_knot))
    throw core::InputError(
        d_.mesh.mark,
        "how its shells, beams and plane elements became solids depends on the supports, the "
        "moments "
        "and NLGEOM of the deck, which are other ones in this model: not written");
}

std::vector<Section> GivenMesh::read_again(const std::string& text) const {
  constexpr const char* name = "written.inp";
  const auto again = [&](const auto& read) {
    try {
      return read();
    } catch (const core::InputError& error) {
      throw core::InputError(
          d_.mesh.mark, fmt::format("not written, since it would be refused: {}", error.what()));
    }
  };
  const io::inp::Deck deck = io::inp::read_cards(text, name);
  require_same(again([&] { return io::inp::deck_mesh(deck); }));
  return again([&] { return parse_model(translate_deck(deck).root, name).sections; });
}

}  // namespace osculate::deck
