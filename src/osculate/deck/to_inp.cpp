// A model file as an input file of CalculiX: its mesh, and what is left of the model file.
#include "osculate/deck/to_inp.hpp"

#include <algorithm>
#include <charconv>
#include <set>

#include "osculate/core/text.hpp"
#include "osculate/deck/to_inp_parts.hpp"
#include "osculate/io/inp/cards.hpp"
#include "osculate/model/bulk.hpp"
#include "osculate/pairing/sampling.hpp"

namespace osculate::deck {
namespace {

mesh::EdgeTable sides_table(const mesh::Mesh& mesh, std::span<const mesh::CellRef> cells,
                            std::integral_constant<int, 2>) {
  return mesh::edge_table(mesh, cells);
}
mesh::FaceTable sides_table(const mesh::Mesh& mesh, std::span<const mesh::CellRef> cells,
                            std::integral_constant<int, 3>) {
  return mesh::face_table(mesh, cells);
}

template <int Dim>
std::vector<mesh::CellRef> cells_of(const model::BasicModel<Dim>& m) {
  std::vector<mesh::CellRef> cells;
  for (const auto& section : m.sections)
    cells.insert(cells.end(), section.cells.begin(), section.cells.end());
  return cells;
}

/// Comma between numbers, so many a line.
template <class List, class Number>
std::string lines_of_numbers(const List& list, const Number& number) {
  constexpr std::size_t most = 12;
  std::string out;
  std::size_t count = 0;
  for (const auto& one : list) {
    if (count > 0) out += count % most == 0 ? ",\n" : ", ";
    out += fmt::format("{}", number(one));
    ++count;
  }
  return out + "\n";
}

std::string prefix(const solid::Section<2>& section) {
  switch (section.assumption) {
    case solid::Assumption::plane_strain:
      return "CPE";
    case solid::Assumption::plane_stress:
      return "CPS";
    default:
      return "CAX";
  }
}
std::string prefix(const solid::Section<3>&) { return "C3D"; }

std::string_view ending(solid::Formulation formulation) {
  switch (formulation) {
    case solid::Formulation::bbar:
      return "H";
    case solid::Formulation::enhanced:
      return "I";
    case solid::Formulation::reduced:
      return "R";
    default:
      return "";
  }
}

}  // namespace

Leaves::Leaves(const Description& description) : description_(description) {
  for (const SourceLeaf& leaf : description.source) leaves_.push_back({leaf});
}

std::string Leaves::text(const std::string& path) {
  for (Leaf& one : leaves_)
    if (one.leaf.path == path) {
      one.taken = true;
      return one.leaf.text;
    }
  return {};
}

std::optional<double> Leaves::number(const std::string& path) {
  const std::string found = text(path);
  if (found.empty()) return {};
  double value = 0;
  const char* const end = found.data() + found.size();
  const auto [stop, error] = std::from_chars(found.data() + (found[0] == '+' ? 1 : 0), end, value);
  if (error != std::errc() || stop != end) fail(path, "expected a number");
  return value;
}

void Leaves::take(std::string_view beginning) {
  for (Leaf& one : leaves_) one.taken = one.taken || one.leaf.path.starts_with(beginning);
}

void Leaves::require_none_left() const {
  for (const Leaf& one : leaves_)
    if (!one.taken) fail(one.leaf.path, "has no counterpart in an input file, or is not written");
}

void Leaves::fail(const std::string& path, const std::string& message) const {
  int line = 0;
  for (const Leaf& one : leaves_)
    if (one.leaf.path == path) line = one.leaf.line;
  throw core::InputError({description_.file, line, path}, message);
}

std::string exact(double value) { return fmt::format("{}", value); }

template <int Dim>
InpMesh<Dim>::InpMesh(const Description& description, const model::BasicModel<Dim>& model)
    : d_(description),
      m_(model),
      table_(sides_table(model.mesh, cells_of(model), std::integral_constant<int, Dim>())),
      used_(model.mesh.nodes.size(), false) {
  if (!model.mesh.relations.empty())
    throw core::InputError(
        description.mesh.mark,
        "shells, beams, trusses and plane elements that were expanded are not written");
  std::set<std::int64_t> numbers, nodes;
  for (std::size_t n = 0; n < model.mesh.nodes.size(); ++n)
    own_numbers_ =
        nodes.insert(mesh::node_number(model.mesh, static_cast<Index>(n))).second && own_numbers_;
  const std::vector<mesh::CellRef> cells = cells_of(model);
  bool own = true;
  for (const mesh::CellRef& ref : cells)
    own = numbers.insert(mesh::cell_number(model.mesh, ref)).second && own;
  for (const mesh::CellRef& ref : cells) {
    const auto next = static_cast<std::int64_t>(number_.size()) + 1;
    number_[{ref.block, ref.cell}] = own ? mesh::cell_number(model.mesh, ref) : next;
    last_element_ = std::max(last_element_, number_[{ref.block, ref.cell}]);
    for (const Index n : model::cell_nodes(model.mesh, ref).nodes)
      used_[static_cast<std::size_t>(n)] = true;
  }
  for (std::size_t n = 0; n < model.mesh.nodes.size(); ++n)
    last_node_ = std::max(last_node_, node(static_cast<Index>(n)));
  std::int64_t last = last_node_;
  const auto known = [&](const std::vector<Name>& sets) -> std::int64_t {
    const mesh::Set* const set = sets.size() == 1 ? m_.mesh.find_set(sets[0].value) : nullptr;
    return set && set->nodes.size() == 1 ? node(set->nodes[0]) : ++last;
  };
  for (const Rigid& rigid : description.rigid) {
    const std::int64_t reference = known(rigid.reference_node);
    controls_[rigid.name.value] = {reference, known(rigid.rotation_node)};
  }
}

template <int Dim>
std::optional<ControlNodes> InpMesh<Dim>::control(const std::string& rigid) const {
  const auto found = controls_.find(rigid);
  return found == controls_.end() ? std::nullopt : std::optional(found->second);
}

template <int Dim>
bool InpMesh<Dim>::finite() const {
  if (m_.sections.empty())
    return std::ranges::any_of(d_.springs, [](const Spring& spring) {
      return !spring.between.empty() && spring.kinematics == Kinematics::finite;
    });
  return std::ranges::any_of(
      m_.sections, [](const auto& s) { return s.section.kinematics == solid::Kinematics::finite; });
}
template <int Dim>
bool InpMesh<Dim>::round() const {
  return std::ranges::any_of(m_.sections, [](const auto& s) { return prefix(s.section) == "CAX"; });
}

template <int Dim>
std::int64_t InpMesh<Dim>::node(Index node) const {
  return own_numbers_ ? mesh::node_number(m_.mesh, node) : std::int64_t{node} + 1;
}

template <int Dim>
std::string InpMesh<Dim>::elements(std::size_t section) const {
  return plain_text(m_.sections[section].name);
}

template <int Dim>
const std::string& InpMesh<Dim>::elements(const Name& on) {
  const bool known = names_.contains({'e', on.value});
  std::string& name = names_[{'e', on.value}];
  if (known) return name;
  if (const auto section = whole_section(d_, on)) return name = elements(*section);
  std::vector<std::int64_t> numbers;
  for (const mesh::CellRef& ref : set(on).cells) {
    const auto found = number_.find({ref.block, ref.cell});
    if (found == number_.end())
      throw core::InputError(on.mark,
                             fmt::format("'{}' has cells that belong to no section", on.value));
    numbers.push_back(found->second);
  }
  for (const auto& section : m_.sections)
    taken_.insert({'e', io::inp::capitals(plain_text(section.name))});
  name = plain_text(on.value) + "_elements";
  for (int k = 2; !taken_.insert({'e', io::inp::capitals(name)}).second; ++k)
    name = fmt::format("{}_elements_{}", plain_text(on.value), k);
  sets_ += fmt::format("*ELSET, ELSET={}\n", name) +
           lines_of_numbers(numbers, [](std::int64_t number) { return number; });
  return name;
}

template <int Dim>
std::string InpMesh<Dim>::type_of(const model::BasicBulkSection<Dim>& section,
                                  cell::CellType type) const {
  const solid::Section<Dim> own = model::section_on(section, type);
  const int nodes = cell::info(type).nodes;
  const std::string name = fmt::format("{}{}", prefix(own), nodes);
  const io::inp::ElementType* const found = io::inp::find_element_type(name);
  if (!found || found->cell != type || own.formulation == solid::Formulation::solid_shell ||
      own.formulation == solid::Formulation::beam)
    throw core::InputError(
        d_.mesh.mark,
        fmt::format("section '{}': an input file has no element for its {} cells{}", section.name,
                    cell::info(type).name, found ? " of this formulation" : ""));
  if (type == cell::CellType::wedge6) return name;
  return name + std::string(ending(own.formulation));
}

template <int Dim>
std::string InpMesh<Dim>::cells() const {
  std::string out = "*NODE\n";
  for (std::size_t n = 0; n < m_.mesh.nodes.size(); ++n) {
    if (!used_[n]) continue;
    const Vec3& x = m_.mesh.nodes[n];
    out += fmt::format("{}, {}, {}, {}\n", node(static_cast<Index>(n)), exact(x[0]), exact(x[1]),
                       exact(x[2]));
  }
  for (std::size_t s = 0; s < m_.sections.size(); ++s) {
    std::string last;
    for (const mesh::CellRef& ref : m_.sections[s].cells) {
      const model::CellNodes cell = model::cell_nodes(m_.mesh, ref);
      const std::string type = type_of(m_.sections[s], cell.type);
      if (type != last) out += fmt::format("*ELEMENT, TYPE={}, ELSET={}\n", type, elements(s));
      last = type;
      const auto& name = *io::inp::find_element_type(
          fmt::format("{}{}", prefix(m_.sections[s].section), cell.nodes.size()));
      std::vector<std::int64_t> row{number_.at({ref.block, ref.cell})};
      for (const std::int8_t place : io::inp::cell_places(name))
        row.push_back(node(cell.nodes[static_cast<std::size_t>(place)]));
      out += lines_of_numbers(row, [](std::int64_t number) { return number; });
    }
  }
  return out;
}

template <int Dim>
const mesh::Set& InpMesh<Dim>::set(const Name& on) const {
  const mesh::Set* const found = m_.mesh.find_set(on.value);
  if (!found)
    throw core::InputError(on.mark, fmt::format("'{}' is no set of the mesh: rigid bodies are not "
                                                "written",
                                                on.value));
  return *found;
}

/// Letters, digits, and what a deck has in names.
template <int Dim>
std::string InpMesh<Dim>::plain_text(const std::string& name) {
  std::string text = name;
  for (char& c : text)
    if (c == ',' || c == '=' || c == '"' || c == ' ' || c == '*') c = '_';
  return io::inp::is_number(text) ? "set_" + text : text;
}

/// A deck does not tell capital and small letters apart.
template <int Dim>
const std::string& InpMesh<Dim>::plain(const std::string& name, char kind) {
  std::string& known = names_[{kind, name}];
  if (!known.empty()) return known;
  const std::string text = plain_text(name);
  known = text;
  for (int k = 2; !taken_.insert({kind, io::inp::capitals(known)}).second; ++k)
    known = fmt::format("{}_{}", text, k);
  return known;
}

template <int Dim>
void InpMesh<Dim>::write_nodes(const std::string& name, const std::vector<Index>& nodes) {
  sets_ += fmt::format("*NSET, NSET={}\n", name) +
           lines_of_numbers(nodes, [this](Index n) { return node(n); });
}

template <int Dim>
const std::string& InpMesh<Dim>::nodes(const Name& on) {
  const mesh::Set& found = set(on);
  const bool known = names_.contains({'n', on.value});
  const std::string& name = plain(on.value, 'n');
  if (known) return name;
  for (const Index n : found.nodes) used_[static_cast<std::size_t>(n)] = true;  // of springs alone
  write_nodes(name, found.nodes);
  return name;
}

template <int Dim>
const std::string& InpMesh<Dim>::nodes_of_body(const SetShape& shape, const Rigid& rigid) {
  const auto body =
      std::ranges::find(m_.rigid, rigid.name.value, [](const auto& b) { return b.name; });
  std::vector<Index> nodes;
  for (const Index n : set(shape.set).nodes)
    if (used_[static_cast<std::size_t>(n)]) nodes.push_back(n);
  if (nodes.empty() || body == m_.rigid.end())
    throw core::InputError(rigid.name.mark,
                           "a rigid body without cells of a section: rigid surfaces are not "
                           "written");
  const std::string& name = plain(rigid.name.value + "_nodes", 'n');
  write_nodes(name, nodes);
  Vec3 at = Vec3::Zero();
  for (int k = 0; k < Dim; ++k) at[k] = body->reference[k];
  const ControlNodes control = controls_.at(rigid.name.value);
  for (const std::vector<Name>& own : {rigid.reference_node, rigid.rotation_node})
    for (const Name& one : own)
      for (const Index n : set(one).nodes) used_[static_cast<std::size_t>(n)] = true;
  for (const std::int64_t number : {control.reference, control.rotation})
    if (number > last_node_)
      sets_ +=
          fmt::format("*NODE\n{}, {}, {}, {}\n", number, exact(at[0]), exact(at[1]), exact(at[2]));
  return name;
}

template <int Dim>
std::vector<Side<Dim>> InpMesh<Dim>::facets(const Name& on) const {
  auto surface = mesh::surface_of(m_.mesh, table_, set(on));
  if (!surface.errors.empty()) throw core::InputError(on.mark, surface.errors.front());
  return std::move(surface.facets);
}

template <int Dim>
bool InpMesh<Dim>::is_curved(const Name& surface) const {
  return std::ranges::any_of(facets(surface),
                             [](const auto& f) { return cell::info(f.type).order > 1; });
}

/// `4, S2`.
template <int Dim>
std::string InpMesh<Dim>::side_of(const Side<Dim>& facet, const Name& on) const {
  const auto number = number_.find({facet.parent.block, facet.parent.cell});
  if (number == number_.end())
    throw core::InputError(on.mark, fmt::format("'{}' has facets that are no sides of a section's "
                                                "cells: rigid surfaces are not written",
                                                on.value));
  const model::CellNodes cell = model::cell_nodes(m_.mesh, facet.parent);
  const cell::CellInfo& info = cell::info(cell.type);
  const auto corners = static_cast<std::size_t>(cell::info(facet.type).corners);
  const auto all = facet.nodes();
  const auto is_on = [&](auto local) {
    const Index n = cell.nodes[static_cast<std::size_t>(local)];
    return std::ranges::find(all, n) != all.end();
  };
  const auto matches = [&](int side) {
    const auto at = static_cast<std::size_t>(side);
    if constexpr (Dim == 2) return is_on(info.edges[at][0]) && is_on(info.edges[at][1]);
    const cell::CellFace& face = info.faces[at];
    if (cell::info(face.type).corners != static_cast<int>(corners)) return false;
    for (std::size_t k = 0; k < corners; ++k)
      if (!is_on(face.nodes[k])) return false;
    return true;
  };
  const auto& type =
      *io::inp::find_element_type(fmt::format("{}{}", Dim == 2 ? "CPE" : "C3D", cell.nodes.size()));
  for (int k = 1; k <= 6; ++k) {
    const std::string label = fmt::format("S{}", k);
    const io::inp::Side side = io::inp::find_side(type, label);
    if (side.kind != io::inp::Side::Kind::none && matches(side.local))
      return fmt::format("{}, {}\n", number->second, label);
  }
  throw core::InputError(on.mark, fmt::format("'{}' has a facet that is no side", on.value));
}

template <int Dim>
const std::string& InpMesh<Dim>::surface(const Name& on, bool of_nodes) {
  (void)set(on);
  const char kind = of_nodes ? 'p' : 's';
  const bool known = names_.contains({kind, on.value});
  const std::string& name = plain(of_nodes ? on.value + "_nodes" : on.value, kind);
  if (of_nodes) names_[{kind, on.value}] = name;
  if (known) return name;
  if (of_nodes) {
    sets_ += fmt::format("*SURFACE, NAME={}, TYPE=NODE\n{},\n", name, nodes(on));
    return name;
  }
  std::string lines;
  for (const Side<Dim>& facet : facets(on)) lines += side_of(facet, on);
  sets_ += fmt::format("*SURFACE, NAME={}, TYPE=ELEMENT\n", name) + lines;
  return name;
}

template <int Dim>
const std::string& InpMesh<Dim>::surface_named(const Name& on) const {
  const auto nodes = names_.find({'p', on.value});
  return nodes == names_.end() ? names_.at({'s', on.value}) : nodes->second;
}

template class InpMesh<2>;
template class InpMesh<3>;

namespace {

/// Whether there are cells of a formulation and a type that are wanted.
template <int Dim, class Wanted>
bool has_cells(const model::BasicModel<Dim>& m, const Wanted& wanted) {
  return std::ranges::any_of(m.sections, [&](const auto& section) {
    std::set<cell::CellType> types;
    for (const mesh::CellRef& ref : section.cells)
      types.insert(m.mesh.blocks[static_cast<std::size_t>(ref.block)].type);
    return std::ranges::any_of(types, [&](cell::CellType type) {
      return wanted(model::section_on(section, type).formulation, type);
    });
  });
}

template <int Dim>
WrittenDeck deck_of(const Description& d, const BasicBuilt<Dim>& built) {
  WrittenDeck deck;
  Leaves leaves(d);
  for (const char* const said : {"osculate", "mesh", "sets", "parameters"}) leaves.take(said);
  InpMesh<Dim> mesh(d, built.model);
  std::string model, steps;
  write_model(d, built.model, mesh, leaves, model);
  write_steps(d, mesh, leaves, steps);
  leaves.require_none_left();
  const std::string title = d.title.empty() ? "A model file of Osculate" : d.title;
  deck.text = fmt::format("*HEADING\n{}\n", title) + mesh.cells() + mesh.sets() + model + steps;
  const bool asked = !d.output.frd.empty() || !d.output.dat.empty();
  deck.notes.push_back(
      asked ? "tolerances and other results than frd and dat (solver, output) are left out"
            : "tolerances and results (solver, output) are left out: displacements, forces and "
              "stresses are asked for");
  if (has_cells(built.model, [](solid::Formulation formulation, cell::CellType) {
        return formulation == solid::Formulation::bbar ||
               (Dim == 2 && formulation == solid::Formulation::enhanced);
      }))
    deck.notes.push_back(
        "CalculiX has no elements with mean dilatation (C3D8H, C3D20H, CPE4H, ...) and no plane "
        "ones with "
        "enhanced strains (CPE4I, ...): Osculate and Abaqus read them; `formulation: full` is "
        "CPE4");
  for (const auto& pair : built.model.pairs)
    if (pair.definition.overlap == pairing::InitialOverlap::given &&
        pairing::sampled_at_nodes(pair.definition.slave))
      deck.notes.push_back(fmt::format(
          "CalculiX passes over *CLEARANCE with NODE TO SURFACE: there contact '{}' has the gaps "
          "of "
          "the mesh; with Gauss points (`sampling`) it is SURFACE TO SURFACE, which knows it",
          pair.name));
  if (has_cells(built.model, [](solid::Formulation formulation, cell::CellType type) {
        return type == cell::CellType::wedge6 && formulation == solid::Formulation::full;
      }))
    deck.notes.push_back(
        "C3D6 has two points here as in CalculiX: `formulation: reduced` of wedge6 cells; those of "
        "this model have more of them");
  return deck;
}

}  // namespace

WrittenDeck write_deck(const Description& description, const AnyBuilt& built) {
  return std::visit([&](const auto& one) { return deck_of(description, one); }, built);
}

}  // namespace osculate::deck
