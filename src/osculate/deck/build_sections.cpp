#include <fmt/format.h>

#include <algorithm>

#include "osculate/deck/build_context.hpp"
#include "osculate/mesh/shell_cells.hpp"
#include "osculate/mesh/shell_direction.hpp"
#include "osculate/model/bulk.hpp"

namespace osculate::deck {
namespace {

solid::Kinematics solid_kinematics(Kinematics kinematics) {
  return kinematics == Kinematics::finite ? solid::Kinematics::finite : solid::Kinematics::small;
}

solid::Assumption assumption_of(SectionElement element) {
  switch (element) {
    case SectionElement::plane_stress:
      return solid::Assumption::plane_stress;
    case SectionElement::axisymmetric:
      return solid::Assumption::axisymmetric;
    default:
      return solid::Assumption::plane_strain;
  }
}

/// The law in the strains of a section.
material::Law law_of(const Section& s, const Material& material) {
  return s.kinematics.value == Kinematics::finite ? material::in_finite_strain(material.law.value)
                                                  : material.law.value;
}

/// What `auto` stands for (decisions 037, 043): enhanced strains lock nowhere, but are unstable in
/// the large compression that some laws are made for, and take many iterations where a material
/// flows without hardening; in plane stress there is no B-bar.
Formulation best_formulation(const Section& s, const Material& material) {
  const material::Law law = law_of(s, material);
  if (!material::large_strain(law) && material::memory_of(law).empty())
    return Formulation::enhanced;
  return s.element.value == SectionElement::plane_stress ? Formulation::full : Formulation::bbar;
}

solid::Formulation formulation_of(const Section& s, const Material& material) {
  const Formulation given = s.formulation.value;
  if (s.element.value == SectionElement::solid_shell) return solid::Formulation::solid_shell;
  return formulation_named(given == Formulation::automatic ? best_formulation(s, material) : given);
}

}  // namespace

solid::Formulation formulation_named(Formulation word) {
  switch (word) {
    case Formulation::bbar:
      return solid::Formulation::bbar;
    case Formulation::enhanced:
      return solid::Formulation::enhanced;
    case Formulation::reduced:
      return solid::Formulation::reduced;
    case Formulation::beam:
      return solid::Formulation::beam;
    default:
      return solid::Formulation::full;
  }
}

template <int Dim>
solid::Section<Dim> make_solid_section(const Section& s, const Material& material) {
  solid::Section<Dim> out;
  if constexpr (Dim == 2) {
    out.assumption = assumption_of(s.element.value);
    out.thickness = s.thickness.value;
  }
  out.kinematics = solid_kinematics(s.kinematics.value);
  out.formulation = formulation_of(s, material);
  out.law = law_of(s, material);
  out.expansion = material.expansion;
  out.orientation = s.orientation.value;
  return out;
}

namespace {

template <int Dim>
solid::Section<Dim> solid_section(const BuildContext<Dim>& c, const Section& s) {
  const Material* const material = c.description.find_material(s.material.value);
  if (!material)
    throw core::InputError(s.material.mark, fmt::format("unknown material '{}'", s.material.value));
  check_durations(c.description, *material);
  return make_solid_section<Dim>(s, *material);
}

/// Cells without volume or inside out; in the plane also of negative radius.
template <int Dim>
void check_shape(const BuildContext<Dim>& c, const Section& s, const mesh::CellRef& ref) {
  const mesh::Block& block = c.model().mesh.blocks[static_cast<std::size_t>(ref.block)];
  const cell::CellInfo& info = cell::info(block.type);
  const double jacobian = model::smallest_jacobian(c.model(), ref);
  if (!(jacobian > 0))
    throw core::InputError(
        s.on.mark, fmt::format("{} cell {} of set '{}' has a negative or zero volume (smallest "
                               "Jacobian {:.3g}); number its nodes {}",
                               info.name, mesh::cell_number(c.model().mesh, ref), s.on.value,
                               jacobian, Dim == 2 ? "counter-clockwise" : "as Gmsh does"));
  if (s.element.value != SectionElement::axisymmetric) return;
  for (int k = 0; k < info.nodes; ++k) {
    const Index node = block.cell(ref.cell)[k];
    const Vec3& x = c.model().mesh.nodes[static_cast<std::size_t>(node)];
    if (x.x() < -1e-12 * x.norm())
      throw core::InputError(
          s.element.mark,
          fmt::format("{} of set '{}' has a negative radius; an axisymmetric body needs x >= 0",
                      mesh::describe_node(c.model().mesh, node), s.on.value));
  }
}

template <int Dim>
void check_cell(const BuildContext<Dim>& c, const Section& s,
                const model::BasicBulkSection<Dim>& section, const mesh::CellRef& ref) {
  const cell::CellType type = c.model().mesh.blocks[static_cast<std::size_t>(ref.block)].type;
  const std::string_view reason =
      solid::unsupported(s.formulation.value == Formulation::automatic &&
                                 s.element.value != SectionElement::solid_shell
                             ? model::section_on(section, type)
                             : section.section,
                         type);
  if (!reason.empty() && s.element.value == SectionElement::solid_shell)
    throw core::InputError(
        s.element.mark,
        fmt::format(
            "set '{}' has {} cells: solid_shell is for hex8, shell18 and hex27 cells; use solid",
            s.on.value, cell::info(type).name));
  if (!reason.empty())
    throw core::InputError(s.formulation.mark, fmt::format("set '{}' has {} cells: {}", s.on.value,
                                                           cell::info(type).name, reason));
  check_shape(c, s, ref);
}

/// Cells that have two directions along a shell and one across it.
bool is_of_layers(cell::CellType type) {
  using cell::CellType;
  constexpr std::array of_layers{CellType::wedge6, CellType::wedge15, CellType::hex8,
                                 CellType::hex20,  CellType::hex27,   CellType::shell18};
  return std::ranges::find(of_layers, type) != of_layers.end();
}

/// Whether a cell of layers is more than twice as long along its third direction as along another.
bool is_long_across(const mesh::Mesh& mesh, const mesh::CellRef& ref) {
  const mesh::Block& block = mesh.blocks[static_cast<std::size_t>(ref.block)];
  const bool wedge = block.type == cell::CellType::wedge6 || block.type == cell::CellType::wedge15;
  const auto length = [&](int node) {
    const Index* const nodes = block.cell(ref.cell);
    return (mesh.nodes[static_cast<std::size_t>(nodes[node])] -
            mesh.nodes[static_cast<std::size_t>(nodes[0])])
        .norm();
  };
  constexpr double twice = 2;
  return length(wedge ? 3 : 4) > twice * std::min(length(1), length(wedge ? 2 : 3));
}

/// The third axis of `shell: true` is across layers, and not along some.
template <int Dim>
void check_layers(BuildContext<Dim>& c, const Section& s) {
  const mesh::Mesh& mesh = c.model().mesh;
  const std::vector<mesh::CellRef>& cells = c.set(s.on).cells;
  for (const mesh::CellRef& ref : cells) {
    const cell::CellType type = mesh.blocks[static_cast<std::size_t>(ref.block)].type;
    if (!is_of_layers(type))
      throw core::InputError(s.orientation.mark,
                             fmt::format("shell: true is for layers of bricks or wedges, and set "
                                         "'{}' has {} cells",
                                         s.on.value, cell::info(type).name));
  }
  const auto across = [&](const mesh::CellRef& ref) { return is_long_across(mesh, ref); };
  if (s.element.value != SectionElement::solid_shell &&
      2 * static_cast<std::size_t>(std::ranges::count_if(cells, across)) > cells.size())
    c.built.warnings.push_back(fmt::format(
        "sections: the third axis of the shell '{}' is along the third local direction of its "
        "cells, in which most of them are more than twice as long as in another: are they layers "
        "across it?",
        s.on.value));
}

/// Axes that are given mean something, and are some.
template <int Dim>
void check_orientation(BuildContext<Dim>& c, const Section& s, const solid::Section<Dim>& section) {
  const material::Orientation& axes = s.orientation.value;
  if (axes.kind == material::Orientation::Kind::global) return;
  require_axes(axes, s.orientation.mark);
  if (axes.on_shell) check_layers(c, s);
  if (!material::directional(section.law) && section.expansion.directions.empty())
    c.built.warnings.push_back(
        fmt::format("sections: the orientation on '{}' has no effect: material '{}' is the same in "
                    "all directions",
                    s.on.value, s.material.value));
}

template <int Dim>
void check_set(const Section& s, const mesh::Set& set) {
  if (set.dimension == Dim && !set.cells.empty()) return;
  if (Dim == 2 && set.dimension == 3)
    throw core::InputError(s.element.mark,
                           fmt::format("set '{}' has volume cells; a body in space has the element "
                                       "solid or solid_shell",
                                       s.on.value));
  throw core::InputError(
      s.on.mark,
      fmt::format("set '{}' has no {} cells, so it cannot be a section{}", s.on.value,
                  Dim == 2 ? "area" : "volume", Dim == 3 && set.dimension == 2 ? " in space" : ""));
}

template <int Dim>
void add_cell(BuildContext<Dim>& c, const Section& s, const model::BasicBulkSection<Dim>& section,
              const mesh::CellRef& ref) {
  const model::BasicModel<Dim>& m = c.model();
  const auto index = static_cast<Index>(m.sections.size());
  const auto [at, fresh] = c.section_of_cell.emplace(std::pair(ref.block, ref.cell), index);
  if (!fresh)
    throw core::InputError(
        s.on.mark,
        fmt::format("cells of set '{}' already belong to the section on '{}'", s.on.value,
                    at->second == index ? section.name
                                        : m.sections[static_cast<std::size_t>(at->second)].name));
  check_cell(c, s, section, ref);
  if constexpr (Dim == 2) check_plane(c, s, section.section, s.material, ref);
  const mesh::Block& block = m.mesh.blocks[static_cast<std::size_t>(ref.block)];
  for (int k = 0; k < cell::info(block.type).nodes; ++k) {
    Index& slot = c.section_of_node[static_cast<std::size_t>(block.cell(ref.cell)[k])];
    if (slot < 0) slot = index;
  }
}

}  // namespace

void check_plane(const BuildContext<2>& c, const Section& s, const solid::Section<2>& section,
                 const Name& named, const mesh::CellRef& ref) {
  const auto& expands = section.expansion.directions;
  if (!material::directional(section.law) && expands.empty()) return;
  const mesh::Block& block = c.model().mesh.blocks[static_cast<std::size_t>(ref.block)];
  const int nodes = cell::info(block.type).nodes;
  Vec3 middle = Vec3::Zero();
  for (int k = 0; k < nodes; ++k)
    middle += c.model().mesh.nodes[static_cast<std::size_t>(block.cell(ref.cell)[k])] / nodes;
  const Mat<3, 3> axes = material::axes_at(section.orientation, middle);
  constexpr double rounding = 1e-12;
  const auto fail = [&](const char* what) {
    const bool given = section.orientation.kind != material::Orientation::Kind::global;
    throw core::InputError(
        given ? s.orientation.mark : named.mark,
        fmt::format("material '{}' {} across it: in the plane one of its axes is "
                    "across it, and its constants have no such terms",
                    named.value, what));
  };
  for (const material::Tangent3& own : material::stiffnesses_of(section.law)) {
    const material::Tangent3 d = material::turned(own, axes);
    if (!(d.topRightCorner<4, 2>().cwiseAbs().maxCoeff() <= rounding * d.cwiseAbs().maxCoeff()))
      fail("answers strains of the plane with shear");
  }
  for (const auto& row : expands) {
    const material::Strain3 e = material::into_axes(axes.transpose()) * row.coefficients;
    if (!(e.tail<2>().norm() <= rounding * e.norm())) fail("shears, as it expands,");
  }
}

template <int Dim>
void build_sections(BuildContext<Dim>& c) {
  model::BasicModel<Dim>& m = c.model();
  for (const Section& s : c.description.sections) {
    if (s.element.value != SectionElement::solid_shell) continue;
    if (const std::string why = mesh::make_shell18(m.mesh, c.set(s.on).cells); !why.empty())
      throw core::InputError(s.element.mark, fmt::format("set '{}': {}", s.on.value, why));
  }
  c.section_of_node.assign(m.mesh.nodes.size(), -1);
  for (const Section& s : c.description.sections) {
    const mesh::Set& set = c.set(s.on);
    check_set<Dim>(s, set);
    model::BasicBulkSection<Dim> section;
    section.name = s.on.value;
    section.section = solid_section(c, s);
    section.cells = set.cells;
    section.material = s.material.value;
    section.by_default = s.formulation.value == Formulation::automatic;
    check_orientation(c, s, section.section);
    if (s.element.value == SectionElement::solid_shell)
      (void)mesh::align_shells(m.mesh, section.cells);
    for (const mesh::CellRef& ref : section.cells) add_cell(c, s, section, ref);
    m.sections.push_back(std::move(section));
  }
  std::vector<mesh::CellRef> cells;
  for (const auto& entry : c.section_of_cell)
    cells.push_back({entry.first.first, entry.first.second});
  if constexpr (Dim == 2)
    c.sides = mesh::edge_table(m.mesh, cells);
  else
    c.sides = mesh::face_table(m.mesh, cells);
}

template solid::Section<2> make_solid_section(const Section&, const Material&);
template solid::Section<3> make_solid_section(const Section&, const Material&);
template void build_sections(BuildContext<2>&);
template void build_sections(BuildContext<3>&);

}  // namespace osculate::deck
