// `contact: {all: ...}`: pairs of all bodies, made of the mesh.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "osculate/core/text.hpp"
#include "osculate/deck/build_contact_parts.hpp"

namespace osculate::deck {
namespace {

/// What may touch: a connected part of the mesh, or a rigid body.
template <int Dim>
struct Body {
  std::string label;               ///< its number, or the name of the rigid body
  std::set<std::string> sections;  ///< sets of the sections that its cells belong to
  pairing::Boundary<Dim> surface;
  double young = 0;  ///< of its stiffest section
  double size = 0;   ///< mean length of a boundary edge; 0: an analytic shape
  bool rigid = false;
  std::vector<double> thickness;  ///< behind its nodes
};

std::vector<mesh::BoundaryFacet> free_sides(const mesh::Mesh& mesh, const mesh::EdgeTable& table,
                                            const mesh::Set& set, std::vector<std::string>& wrong) {
  mesh::Boundary boundary = mesh::boundary_facets(mesh, table, set);
  wrong = std::move(boundary.errors);
  return std::move(boundary.facets);
}
std::vector<mesh::SurfaceFacet> free_sides(const mesh::Mesh& mesh, const mesh::FaceTable& table,
                                           const mesh::Set& set, std::vector<std::string>& wrong) {
  mesh::Surface surface = mesh::surface_facets(mesh, table, set);
  wrong = std::move(surface.errors);
  return std::move(surface.facets);
}

/// The axis of an axisymmetric body is no surface.
void drop_axis(const BuildContext<2>& c, const Section& section,
               std::vector<mesh::BoundaryFacet>& sides) {
  if (section.element.value != SectionElement::axisymmetric) return;
  const std::vector<Vec2>& x = c.model().reference;
  std::erase_if(sides, [&](const mesh::BoundaryFacet& side) {
    const Vec2& a = x[static_cast<std::size_t>(side.node[0])];
    const Vec2& b = x[static_cast<std::size_t>(side.node[1])];
    return std::max(std::abs(a.x()), std::abs(b.x())) <= 1e-9 * (b - a).norm();
  });
}
void drop_axis(const BuildContext<3>&, const Section&, std::vector<mesh::SurfaceFacet>&) {}

template <int Dim>
std::vector<Body<Dim>> deformable_bodies(const BuildContext<Dim>& c, const Contact& contact) {
  const model::BasicModel<Dim>& m = c.model();
  std::vector<mesh::CellRef> cells;
  for (const model::BasicBulkSection<Dim>& section : m.sections)
    cells.insert(cells.end(), section.cells.begin(), section.cells.end());
  std::vector<Body<Dim>> bodies;
  for (std::vector<mesh::CellRef>& part : mesh::connected_parts(m.mesh, cells)) {
    Body<Dim> body;
    body.label = std::to_string(bodies.size() + 1);
    const Section* first = nullptr;
    for (const mesh::CellRef& ref : part) {
      const Section& section =
          c.description
              .sections[static_cast<std::size_t>(c.section_of_cell.at({ref.block, ref.cell}))];
      if (!first) first = &section;
      if (!body.sections.insert(section.on.value).second) continue;
      const Material* const material = c.description.find_material(section.material.value);
      if (material)
        body.young = std::max(body.young, material::unloaded(material->law.value).young);
    }
    mesh::Set set;
    set.dimension = Dim;
    set.cells = std::move(part);
    std::vector<std::string> wrong;
    std::vector<Side<Dim>> sides = free_sides(m.mesh, c.sides, set, wrong);
    if (!wrong.empty()) throw core::InputError(contact.name.mark, wrong.front());
    drop_axis(c, *first, sides);
    body.surface = boundary_from<Dim>(sides, false);
    body.size = mean_size<Dim>(body.surface, m.reference);
    bodies.push_back(std::move(body));
  }
  return bodies;
}

/// Rigid bodies of their own; a set of nodes of a deformable body that moves rigidly is a part of
/// that body.
template <int Dim>
void add_rigid_bodies(BuildContext<Dim>& c, std::vector<Body<Dim>>& bodies) {
  for (const Rigid& rigid : c.description.rigid) {
    const auto& nodes =
        c.model().rigid[static_cast<std::size_t>(c.rigid_index.at(rigid.name.value))].nodes;
    const auto in_section = [&](Index n) {
      return static_cast<std::size_t>(n) < c.section_of_node.size() &&
             c.section_of_node[static_cast<std::size_t>(n)] >= 0;
    };
    if (std::any_of(nodes.begin(), nodes.end(), in_section)) continue;
    if (nodes.size() == 1) continue;  // a point that carries loads touches nothing
    Body<Dim> body;
    body.label = rigid.name.value;
    body.rigid = true;
    body.surface = boundary_of(c, rigid.name);
    body.size = mean_size<Dim>(body.surface, c.model().reference);
    if (body.surface.facets.empty())
      c.built.warnings.push_back(
          fmt::format("rigid body '{}' has no facets; it touches nothing", body.label));
    else
      bodies.push_back(std::move(body));
  }
}

template <int Dim>
bool is_called(const Body<Dim>& body, const std::string& name) {
  return body.label == name || body.sections.contains(name);
}

template <int Dim>
void check_excluded(const std::vector<Body<Dim>>& bodies, const Contact& contact) {
  std::vector<std::string> known;
  for (const Body<Dim>& body : bodies) {
    known.push_back(body.label);
    known.insert(known.end(), body.sections.begin(), body.sections.end());
  }
  std::sort(known.begin(), known.end());
  known.erase(std::unique(known.begin(), known.end()), known.end());
  for (const std::array<Name, 2>& pair : contact.exclude)
    for (const Name& name : pair)
      if (!std::binary_search(known.begin(), known.end(), name.value))
        throw core::InputError(name.mark, core::unknown_name_message("body", name.value, known));
}

template <int Dim>
bool excluded(const Body<Dim>& a, const Body<Dim>& b, const Contact& contact) {
  return std::any_of(contact.exclude.begin(), contact.exclude.end(), [&](const auto& pair) {
    const std::string &first = pair[0].value, &second = pair[1].value;
    return (is_called(a, first) && is_called(b, second)) ||
           (is_called(a, second) && is_called(b, first));
  });
}

struct Roles {
  bool first_is_master;
  const char* reason;
};

/// The one rule: rigid, else stiffer, else coarser, else first.
template <int Dim>
Roles roles(const Body<Dim>& a, const Body<Dim>& b) {
  constexpr double stiffer = 1.000001, coarser = 1.01;
  if (b.rigid) return {false, "rigid"};
  if (a.young > stiffer * b.young) return {true, "stiffer"};
  if (b.young > stiffer * a.young) return {false, "stiffer"};
  if (a.size > coarser * b.size) return {true, "coarser"};
  if (b.size > coarser * a.size) return {false, "coarser"};
  return {true, "first"};
}

template <int Dim>
model::BasicContactPair<Dim> pair_of(const Body<Dim>& a, const Body<Dim>& b,
                                     const Contact& contact) {
  model::BasicContactPair<Dim> out;
  out.group = contact.name.value;
  out.name = fmt::format("{}.{}-{}", out.group, a.label, b.label);
  pairing::PairDefinition<Dim>& pair = out.definition;
  const bool own = &a == &b;
  const Roles who = own ? Roles{true, ""} : roles(a, b);
  const Body<Dim>& master = who.first_is_master ? a : b;
  const Body<Dim>& slave = who.first_is_master ? b : a;
  pair.master = master.surface;
  pair.slave = pairing::make_slave_side(slave.surface);
  pair.filter.own = own;
  pair.filter.thickness = slave.thickness;
  const bool analytic = master.surface.facets.front().shape != nullptr;
  if (!analytic)
    pair.filter.distance = search_distance_in_facets * std::max(master.size, slave.size);
  out.note = own ? fmt::format("body {} with itself", a.label)
                 : fmt::format("slave {}, master {} ({})", slave.label, master.label, who.reason);
  return out;
}

/// Two deformable bodies are slaves in turn: nodes of one side alone miss the corners and edges of
/// the other, and let go of it where they slide off.
template <int Dim>
bool has_second_pass(const Body<Dim>& a, const Body<Dim>& b, const Contact& contact) {
  return &a != &b && !a.rigid && !b.rigid && !contact.edges &&
         contact.enforcement.value.kind != EnforcementWord::lagrange_multiplier;
}

template <int Dim>
void add_pairs(BuildContext<Dim>& c, const Contact& contact, const Body<Dim>& a, const Body<Dim>& b,
               const std::vector<std::array<SurfaceNodes, 2>>& apart) {
  const auto hide = [&](pairing::PairDefinition<Dim>& pair) {
    pair.filter.hidden = hidden_facets<Dim>(apart, pair.slave.nodes, pair.master);
  };
  model::BasicContactPair<Dim> first = pair_of(a, b, contact);
  if (b.rigid)
    face_slave(c, contact, {b.label, contact.name.mark}, first.definition.slave.nodes,
               first.definition.master);
  hide(first.definition);
  if (!has_second_pass(a, b, contact))
    return add_pair(c, contact, contact.name.mark, std::move(first));
  const bool first_is_master = roles(a, b).first_is_master;
  model::BasicContactPair<Dim> second = first;
  second.name += ".reversed";
  second.note = "second pass";
  second.reversed = true;
  second.definition.master = first.definition.slave.boundary;
  second.definition.slave = pairing::make_slave_side(first.definition.master);
  second.definition.filter.thickness = (first_is_master ? a : b).thickness;
  hide(second.definition);
  first.definition.pass_factor = second.definition.pass_factor = 0.5;
  add_pair(c, contact, contact.name.mark, std::move(first));
  add_pair(c, contact, contact.name.mark, std::move(second));
}

/// One measurement of each body for all its pairs.
template <int Dim>
void measure_bodies(const BuildContext<Dim>& c, std::vector<Body<Dim>>& bodies) {
  double largest = 0;
  for (const Body<Dim>& body : bodies) largest = std::max(largest, body.size);
  for (Body<Dim>& body : bodies) {
    if (body.rigid) continue;
    pairing::CandidateFilter<Dim> filter;
    filter.distance = search_distance_in_facets * largest;
    pairing::prepare<Dim>(filter, body.surface, pairing::make_slave_side(body.surface),
                          c.model().reference);
    body.thickness = std::move(filter.thickness);
  }
}

template <int Dim>
void note_bodies(BuildContext<Dim>& c, const std::vector<Body<Dim>>& bodies) {
  for (const Body<Dim>& body : bodies) {
    if (body.rigid) continue;
    const std::vector<std::string> sections(body.sections.begin(), body.sections.end());
    c.built.notes.push_back(fmt::format("body {} is {}, {} boundary facets", body.label,
                                        core::join(sections), body.surface.facets.size()));
  }
}

}  // namespace

template <int Dim>
void build_contact_all(BuildContext<Dim>& c, const Contact& contact) {
  std::vector<Body<Dim>> bodies = deformable_bodies(c, contact);
  add_rigid_bodies(c, bodies);
  check_excluded(bodies, contact);
  measure_bodies(c, bodies);
  note_bodies(c, bodies);
  const std::vector<std::array<SurfaceNodes, 2>> apart = not_by_all(c, contact);
  if (contact.edges && (!contact.exclude_surfaces.empty() || c.description.contact.size() > 1))
    throw core::InputError(contact.edges->mark,
                           "edges that touch each other know no `pairs` beside `all` and no "
                           "`exclude_surfaces`: leave out edges");
  if (!apart.empty())
    c.built.notes.push_back(fmt::format(
        "contact '{}': {} pairs of surfaces are left out: excluded, tied, or pairs of their own",
        contact.name.value, apart.size()));
  const std::size_t before = c.model().pairs.size();
  for (std::size_t i = 0; i < bodies.size() && !bodies[i].rigid; ++i)
    for (std::size_t j = i; j < bodies.size(); ++j)
      if (!excluded(bodies[i], bodies[j], contact) && !bodies[i].surface.facets.empty() &&
          !bodies[j].surface.facets.empty())
        add_pairs(c, contact, bodies[i], bodies[j], apart);
  if (c.model().pairs.size() == before && c.description.contact.size() == 1)
    throw core::InputError(contact.name.mark, "no pair of bodies is left that may touch");
}

template void build_contact_all(BuildContext<2>&, const Contact&);
template void build_contact_all(BuildContext<3>&, const Contact&);

}  // namespace osculate::deck
