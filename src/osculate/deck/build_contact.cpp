#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "osculate/deck/build_context.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/mesh/boundary.hpp"

namespace osculate::deck {

template <int Dim>
std::vector<Side<Dim>> oriented_facets(const BuildContext<Dim>& c, const Name& on) {
  auto surface = mesh::surface_of(c.model().mesh, c.sides, c.set(on));
  if (!surface.errors.empty()) throw core::InputError(on.mark, surface.errors.front());
  std::vector<std::string>& known = c.built.warnings;
  for (const std::string& text : surface.warnings) {
    std::string warning = fmt::format("set '{}': {}", on.value, text);
    if (std::find(known.begin(), known.end(), warning) == known.end())
      known.push_back(std::move(warning));
  }
  return std::move(surface.facets);
}

template std::vector<Side<2>> oriented_facets(const BuildContext<2>&, const Name&);
template std::vector<Side<3>> oriented_facets(const BuildContext<3>&, const Name&);

namespace {

template <int Dim>
const Rigid* rigid_of(const BuildContext<Dim>& c, const Name& name) {
  return c.rigid_index.contains(name.value) ? c.description.find_rigid(name.value) : nullptr;
}

template <int Dim>
const model::BasicRigidBody<Dim>& body_of(const BuildContext<Dim>& c, const Name& name) {
  return c.model().rigid[static_cast<std::size_t>(c.rigid_index.at(name.value))];
}

/// Facets of a rigid body that has no mesh: an analytic shape on its frame, or a polyline.
void add_unmeshed(const Rigid& rigid, const model::RigidBody& body, pairing::Chain& chain) {
  const std::vector<Index>& nodes = body.nodes;
  if (body.shape) {
    chain.facets.push_back(pairing::shape_facet(*body.shape, {nodes[0], nodes[1], nodes[2]}));
    return;
  }
  const bool closed = std::get<PolylineShape>(rigid.shape).closed;
  for (std::size_t i = 0; i + 1 < nodes.size() + (closed ? 1 : 0); ++i)
    chain.facets.push_back(
        pairing::lagrange_facet(std::array<Index, 2>{nodes[i], nodes[(i + 1) % nodes.size()]}));
}

void add_unmeshed(const Rigid&, const model::RigidBody3& body, pairing::FacetSurface& surface) {
  const std::vector<Index>& nodes = body.nodes;
  surface.facets.push_back(
      pairing::shape_facet(body.shape.value(), {nodes[0], nodes[1], nodes[2], nodes[3]}));
}

/// Facet of a mesh side; `flip` puts the body on its other side.
pairing::Facet contact_facet(const mesh::BoundaryFacet& side, bool flip) {
  std::vector<Index> nodes(side.nodes().begin(), side.nodes().end());
  if (flip) {
    std::swap(nodes[0], nodes[1]);
    std::reverse(nodes.begin() + 2, nodes.end());
  }
  return pairing::lagrange_facet(nodes);
}

pairing::SurfaceFacet contact_facet(const mesh::SurfaceFacet& side, bool flip) {
  std::vector<Index> nodes(side.nodes().begin(), side.nodes().end());
  if (flip) mesh::reverse_area(side.type, nodes);
  return pairing::surface_facet(side.type, nodes);
}

/// Boundary of a mesh set, or of a rigid body: facets with outward normals.
template <int Dim>
pairing::Boundary<Dim> boundary_of(const BuildContext<Dim>& c, const Name& name) {
  pairing::Boundary<Dim> boundary;
  const Rigid* const rigid = rigid_of(c, name);
  const SetShape* const meshed = rigid ? std::get_if<SetShape>(&rigid->shape) : nullptr;
  if (rigid && !meshed) {
    add_unmeshed(*rigid, body_of(c, name), boundary);
  } else {
    for (const Side<Dim>& side : oriented_facets(c, meshed ? meshed->set : name))
      boundary.facets.push_back(contact_facet(side, rigid && rigid->flip && !side.has_parent()));
  }
  pairing::connect(boundary);
  return boundary;
}

template <int Dim>
pairing::SlaveSide<Dim> slave_of(const BuildContext<Dim>& c, const Contact& contact) {
  const Rigid* const rigid = rigid_of(c, contact.slave);
  const SetShape* const meshed = rigid ? std::get_if<SetShape>(&rigid->shape) : nullptr;
  const Name& set_name = meshed ? meshed->set : contact.slave;
  const mesh::Set& set = c.set(set_name);
  if (set.nodes.empty())
    throw core::InputError(contact.slave.mark,
                           fmt::format("contact set '{}' is empty", contact.slave.value));
  if (set.dimension == 0) return pairing::make_slave_side(pairing::Boundary<Dim>{}, set.nodes);
  return pairing::make_slave_side(boundary_of(c, contact.slave));
}

/// Thickness or circumference from the section behind the slave, else behind the master. An area in
/// space needs neither.
pairing::AreaRule area_rule(const BuildContext<2>& c, const pairing::PairDefinition<2>& pair) {
  const auto from = [&](Index node) -> const solid::Section* {
    if (static_cast<std::size_t>(node) >= c.section_of_node.size()) return nullptr;
    const Index s = c.section_of_node[static_cast<std::size_t>(node)];
    return s < 0 ? nullptr : &c.model().sections[static_cast<std::size_t>(s)].section;
  };
  const solid::Section* section = nullptr;
  for (const Index n : pair.slave.nodes)
    if (!section) section = from(n);
  for (const pairing::Facet& f : pair.master.facets)
    for (int k = 0; k < f.count && !section; ++k)
      section = from(f.nodes[static_cast<std::size_t>(k)]);
  if (!section) return {};
  return {section->thickness, section->assumption == solid::Assumption::axisymmetric};
}
pairing::AreaRule area_rule(const BuildContext<3>&, const pairing::PairDefinition<3>&) {
  return {};
}

template <int Dim>
void set_forms(const Contact& contact, pairing::PairDefinition<Dim>& pair) {
  pair.normal.stiffness = contact.normal_penalty.value;
  if (contact.friction)
    pair.friction = contact::Coulomb{contact.friction->mu.value, contact.friction->penalty.value};
  switch (contact.weight.value) {
    case ContactWeight::node:
      pair.weight = pairing::Weight::node;
      break;
    case ContactWeight::reference_area:
      pair.weight = pairing::Weight::reference_area;
      break;
    case ContactWeight::current_area:
      pair.weight = pairing::Weight::current_area;
      break;
  }
  pair.residual = contact.residual.value == Residual::full ? contact::ResidualForm::full
                                                           : contact::ResidualForm::surface;
  const Tangent& t = contact.tangent.value;
  pair.tangent = {t.kind == TangentKind::consistent, t.main, t.rotational, t.curvature};
  if (contact.search_depth) pair.depth = contact.search_depth->value;
}

template <int Dim>
void check_pair(const BuildContext<Dim>& c, const Contact& contact,
                const pairing::PairDefinition<Dim>& pair) {
  if (pair.master.facets.empty())
    throw core::InputError(contact.master.mark,
                           fmt::format("contact set '{}' has no facets", contact.master.value));
  if (pair.slave.nodes.empty())
    throw core::InputError(contact.slave.mark,
                           fmt::format("contact set '{}' has no facets", contact.slave.value));
  const auto all_rigid = [&](const auto& nodes, int count) {
    for (int k = 0; k < count; ++k)
      if (c.model().body_of_node[static_cast<std::size_t>(nodes[static_cast<std::size_t>(k)])] < 0)
        return false;
    return true;
  };
  bool rigid = all_rigid(pair.slave.nodes, static_cast<int>(pair.slave.nodes.size()));
  for (const auto& f : pair.master.facets) rigid = rigid && all_rigid(f.nodes, f.count);
  if (rigid) throw core::InputError(contact.name.mark, "both sides of this contact are rigid");
  std::vector<bool> of_slave(c.model().reference.size());
  for (const Index n : pair.slave.nodes) {
    if (!c.takes_part(n)) throw c.idle_node(contact.slave, n);
    of_slave[static_cast<std::size_t>(n)] = true;
  }
  for (const auto& f : pair.master.facets)
    for (int k = 0; k < f.count; ++k) {
      const Index n = f.nodes[static_cast<std::size_t>(k)];
      if (!c.takes_part(n)) throw c.idle_node(contact.master, n);
      if (of_slave[static_cast<std::size_t>(n)])
        throw core::InputError(
            contact.slave.mark,
            fmt::format("master '{}' and slave '{}' share {}", contact.master.value,
                        contact.slave.value, mesh::describe_node(c.model().mesh, n)));
    }
}

void set_edges(BuildContext<2>&, const Contact&, pairing::PairDefinition<2>&) {}
void set_edges(BuildContext<3>&, const Contact& contact, pairing::PairDefinition<3>& pair) {
  if (!contact.edges) return;
  if (pair.slave.boundary.facets.empty())
    throw core::InputError(contact.edges->mark,
                           fmt::format("the slave '{}' is a set of points: only facets have edges",
                                       contact.slave.value));
  pair.edges.on = true;
  pair.edges.angle = contact.edges->value * std::numbers::pi / 180;
}

/// Edges were asked for, and one side has none.
void warn_of_smooth(BuildContext<2>&, const Contact&, const pairing::PairDefinition<2>&) {}
void warn_of_smooth(BuildContext<3>& c, const Contact& contact,
                    const pairing::PairDefinition<3>& pair) {
  if (!pair.edges.on) return;
  const auto warn = [&](const char* side, const Name& name) {
    c.built.warnings.push_back(fmt::format(
        "contact '{}': the {} '{}' has no convex edge with more than {:g} degrees between its "
        "facets, so edges: has no effect",
        contact.name.value, side, name.value, contact.edges->value));
  };
  if (pair.edges.master.empty()) warn("master", contact.master);
  if (pair.edges.slave.empty()) warn("slave", contact.slave);
}

/// The areas of the nodes of tri6 and quad8 facets are positive, but not those of a uniform
/// pressure.
void warn_of_scatter(BuildContext<2>&, const Contact&, const pairing::PairDefinition<2>&) {}
void warn_of_scatter(BuildContext<3>& c, const Contact& contact,
                     const pairing::PairDefinition<3>& pair) {
  for (const pairing::SurfaceFacet& facet : pair.slave.boundary.facets) {
    if (facet.type != cell::CellType::tri6 && facet.type != cell::CellType::quad8) continue;
    if (c.model().body_of_node[static_cast<std::size_t>(facet.nodes[0])] >= 0) continue;
    c.built.warnings.push_back(fmt::format(
        "contact '{}': the slave '{}' has {} faces, at whose nodes contact pressures scatter; "
        "prefer hex27 or first-order cells there, or make it the master",
        contact.name.value, contact.slave.value, cell::info(facet.type).name));
    return;
  }
}

}  // namespace

template <int Dim>
void build_contact(BuildContext<Dim>& c) {
  for (const Contact& contact : c.description.contact) {
    model::BasicContactPair<Dim> out;
    out.name = contact.name.value;
    pairing::PairDefinition<Dim>& pair = out.definition;
    pair.master = boundary_of(c, contact.master);
    pair.slave = slave_of(c, contact);
    check_pair(c, contact, pair);
    set_forms(contact, pair);
    set_edges(c, contact, pair);
    pair.area = area_rule(c, pair);
    try {
      pairing::prepare(pair, c.model().reference);
    } catch (const core::GeometryError& error) {
      throw core::InputError(contact.slave.mark, error.what());
    }
    warn_of_scatter(c, contact, pair);
    warn_of_smooth(c, contact, pair);
    c.model().pairs.push_back(std::move(out));
  }
}

template void build_contact(BuildContext<2>&);
template void build_contact(BuildContext<3>&);

}  // namespace osculate::deck
