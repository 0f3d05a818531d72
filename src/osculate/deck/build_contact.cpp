#include <fmt/format.h>

#include <algorithm>

#include "osculate/deck/build_context.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/mesh/boundary.hpp"

namespace osculate::deck {

std::vector<mesh::BoundaryFacet> oriented_facets(const BuildContext& c, const Name& on) {
  mesh::Boundary boundary = mesh::surface_of(c.model().mesh, c.edges, c.set(on));
  if (!boundary.errors.empty()) throw core::InputError(on.mark, boundary.errors.front());
  std::vector<std::string>& known = c.built.warnings;
  for (const std::string& text : boundary.warnings) {
    std::string warning = fmt::format("set '{}': {}", on.value, text);
    if (std::find(known.begin(), known.end(), warning) == known.end())
      known.push_back(std::move(warning));
  }
  return std::move(boundary.facets);
}

namespace {

const Rigid* rigid_of(const BuildContext& c, const Name& name) {
  return c.rigid_index.contains(name.value) ? c.description.find_rigid(name.value) : nullptr;
}

/// Chain of a mesh set, or of a rigid body: facets with outward normals.
pairing::Chain chain_of(const BuildContext& c, const Name& name) {
  pairing::Chain chain;
  const Rigid* const rigid = rigid_of(c, name);
  const SetShape* const meshed = rigid ? std::get_if<SetShape>(&rigid->shape) : nullptr;
  if (rigid && !meshed) {
    const model::RigidBody& body =
        c.model().rigid[static_cast<std::size_t>(c.rigid_index.at(name.value))];
    if (body.shape) {
      chain.facets.push_back(
          pairing::shape_facet(*body.shape, {body.nodes[0], body.nodes[1], body.nodes[2]}));
    } else {
      const bool closed = std::get<PolylineShape>(rigid->shape).closed;
      const std::size_t n = body.nodes.size();
      for (std::size_t i = 0; i + 1 < n + (closed ? 1 : 0); ++i)
        chain.facets.push_back(
            pairing::lagrange_facet(std::array<Index, 2>{body.nodes[i], body.nodes[(i + 1) % n]}));
    }
  } else {
    const Name& set = meshed ? meshed->set : name;
    for (const mesh::BoundaryFacet& facet : oriented_facets(c, set)) {
      std::vector<Index> nodes(facet.nodes().begin(), facet.nodes().end());
      if (rigid && rigid->flip && !facet.has_parent()) {
        std::swap(nodes[0], nodes[1]);
        std::reverse(nodes.begin() + 2, nodes.end());
      }
      chain.facets.push_back(pairing::lagrange_facet(nodes));
    }
  }
  pairing::connect(chain);
  return chain;
}

pairing::SlaveSide<2> slave_of(const BuildContext& c, const Contact& contact) {
  const Rigid* const rigid = rigid_of(c, contact.slave);
  const SetShape* const meshed = rigid ? std::get_if<SetShape>(&rigid->shape) : nullptr;
  const Name& set_name = meshed ? meshed->set : contact.slave;
  const mesh::Set& set = c.set(set_name);
  if (set.nodes.empty())
    throw core::InputError(contact.slave.mark,
                           fmt::format("contact set '{}' is empty", contact.slave.value));
  if (set.dimension == 0) return pairing::make_slave_side(pairing::Chain{}, set.nodes);
  return pairing::make_slave_side(chain_of(c, contact.slave));
}

/// Thickness or circumference from the section behind the slave, else behind the master.
pairing::AreaRule area_rule(const BuildContext& c, const pairing::PairDefinition<2>& pair) {
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

void set_forms(const Contact& contact, pairing::PairDefinition<2>& pair) {
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

void check_pair(const BuildContext& c, const Contact& contact,
                const pairing::PairDefinition<2>& pair) {
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
  for (const pairing::Facet& f : pair.master.facets) rigid = rigid && all_rigid(f.nodes, f.count);
  if (rigid) throw core::InputError(contact.name.mark, "both sides of this contact are rigid");
  std::vector<bool> of_slave(c.model().reference.size());
  for (const Index n : pair.slave.nodes) {
    if (!c.takes_part(n)) throw c.idle_node(contact.slave, n);
    of_slave[static_cast<std::size_t>(n)] = true;
  }
  for (const pairing::Facet& f : pair.master.facets)
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

}  // namespace

void build_contact(BuildContext& c) {
  for (const Contact& contact : c.description.contact) {
    model::ContactPair out;
    out.name = contact.name.value;
    pairing::PairDefinition<2>& pair = out.definition;
    pair.master = chain_of(c, contact.master);
    pair.slave = slave_of(c, contact);
    check_pair(c, contact, pair);
    set_forms(contact, pair);
    pair.area = area_rule(c, pair);
    try {
      pairing::prepare(pair, c.model().reference);
    } catch (const core::GeometryError& error) {
      throw core::InputError(contact.slave.mark, error.what());
    }
    c.model().pairs.push_back(std::move(out));
  }
}

}  // namespace osculate::deck
