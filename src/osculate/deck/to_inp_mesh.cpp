// The mesh of a model file as cards of a deck: nodes, elements, sets and surfaces.
#include <algorithm>
#include <set>

#include "osculate/core/text.hpp"
#include "osculate/deck/build_context.hpp"
#include "osculate/deck/to_inp_parts.hpp"
#include "osculate/io/inp/cards.hpp"
#include "osculate/model/bulk.hpp"

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

/// Of names of a kind in `InpMesh::taken_`.
char letter_of(io::inp::SetKind kind) {
  constexpr std::array<char, 4> letters{'e', 's', 'n', 'p'};
  return letters[static_cast<std::size_t>(kind)];
}

}  // namespace

template <int Dim>
InpMesh<Dim>::InpMesh(const Description& description, const model::BasicModel<Dim>& model)
    : d_(description),
      m_(model),
      table_(sides_table(model.mesh, cells_of(model), std::integral_constant<int, Dim>())),
      used_(model.mesh.nodes.size(), false) {
  if (!model.mesh.expanded.empty()) given_ = std::make_unique<GivenMesh>(description);
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
  for (std::size_t k = 0; k < m_.sections.size(); ++k)
    for (const mesh::CellRef& ref : m_.sections[k].cells) section_of_[{ref.block, ref.cell}] = k;
  if (given_)
    for (const auto kind : {io::inp::SetKind::elements, io::inp::SetKind::nodes,
                            io::inp::SetKind::surface, io::inp::SetKind::node_surface})
      for (const std::string& name : given_->names(kind)) taken_.insert({letter_of(kind), name});
  take_controls();
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
std::optional<std::string> InpMesh<Dim>::given_name(io::inp::SetKind kind, const Name& on) const {
  return given_ ? given_->name(kind, set(on).name) : std::nullopt;
}
template <int Dim>
std::vector<std::int64_t> InpMesh<Dim>::element_numbers(const Name& on) const {
  std::vector<std::int64_t> numbers;
  for (const mesh::CellRef& ref : set(on).cells) {
    const auto found = number_.find({ref.block, ref.cell});
    if (found == number_.end())
      throw core::InputError(on.mark,
                             fmt::format("'{}' has cells that belong to no section", on.value));
    if (given_ && !given_->element(found->second))
      throw core::InputError(on.mark, fmt::format("'{}' has a part of an element: of shells of "
                                                  "layers and hollow beams the sets of their deck "
                                                  "are written",
                                                  on.value));
    numbers.push_back(found->second);
  }
  return numbers;
}

template <int Dim>
const std::string& InpMesh<Dim>::elements(const Name& on) {
  const bool known = names_.contains({'e', on.value});
  std::string& name = names_[{'e', on.value}];
  if (known) return name;
  if (const auto given = given_name(io::inp::SetKind::elements, on)) return name = *given;
  if (const auto section = whole_section(d_, on); section && !given_)
    return name = plain_text(m_.sections[*section].name);
  const std::vector<std::int64_t> numbers = element_numbers(on);
  if (!given_)
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
std::string InpMesh<Dim>::whole_elements(std::size_t section) {
  const std::string& on = d_.sections[section].on.value;
  const std::string whole = given_ ? given_->whole(on) : on;
  return whole == on ? elements(section) : whole;
}

template <int Dim>
std::set<std::size_t> InpMesh<Dim>::sections_of(const Name& on) const {
  std::set<std::size_t> sections;
  for (const mesh::CellRef& ref : set(on).cells)
    if (const auto found = section_of_.find({ref.block, ref.cell}); found != section_of_.end())
      sections.insert(found->second);
  return sections;
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
  if (given_) return given_->cards();
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
      if (type != last)
        out += fmt::format("*ELEMENT, TYPE={}, ELSET={}\n", type, plain_text(m_.sections[s].name));
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
void InpMesh<Dim>::write_nodes(const Name& on, const std::string& name,
                               const std::vector<Index>& nodes) {
  for (const Index n : nodes)
    if (given_ && !given_->has_node(node(n)))
      throw core::InputError(on.mark, fmt::format("'{}' has nodes of the solids that shells, beams "
                                                  "or plane elements became: not written",
                                                  on.value));
  sets_ += fmt::format("*NSET, NSET={}\n", name) +
           lines_of_numbers(nodes, [this](Index n) { return node(n); });
}

template <int Dim>
const std::string& InpMesh<Dim>::nodes(const Name& on) {
  const mesh::Set& found = set(on);
  const bool known = names_.contains({'n', on.value});
  if (!known)
    if (const auto given = given_name(io::inp::SetKind::nodes, on))
      return names_[{'n', on.value}] = *given;
  const std::string& name = plain(on.value, 'n');
  if (known) return name;
  for (const Index n : found.nodes) used_[static_cast<std::size_t>(n)] = true;  // of springs alone
  write_nodes(on, name, found.nodes);
  return name;
}

template <int Dim>
void InpMesh<Dim>::require_same(const std::string& text) const {
  if (!given_) return;
  const std::vector<Section> written = given_->read_again(text);
  for (std::size_t s = 0; s < m_.sections.size(); ++s) {
    const auto same = std::ranges::find_if(written, [&](const Section& one) {
      return mesh::same_but_for_case(one.on.value, d_.sections[s].on.value);
    });
    bool equal = same != written.end();
    for (const mesh::CellRef& ref : m_.sections[s].cells) {
      if (!equal) break;
      const auto type = m_.mesh.blocks[static_cast<std::size_t>(ref.block)].type;
      const solid::Section<Dim> own = model::section_on(m_.sections[s], type);
      equal = own.formulation == formulation_named(same->formulation.value) &&
              (own.kinematics == solid::Kinematics::finite) ==
                  (same->kinematics.value == Kinematics::finite);
    }
    if (!equal)
      throw core::InputError(d_.sections[s].on.mark,
                             fmt::format("'{}' has another `formulation` or `kinematics` than the "
                                         "elements of its deck, which are written as they were",
                                         d_.sections[s].on.value));
  }
}

template class InpMesh<2>;
template class InpMesh<3>;

}  // namespace osculate::deck
