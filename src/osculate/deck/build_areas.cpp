// Areas of contact points that are not those of their facets' shape functions.
#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "osculate/deck/build_contact_parts.hpp"
#include "osculate/deck/foot_on_facets.hpp"
#include "osculate/mesh/node_areas.hpp"
#include "osculate/pairing/sampling.hpp"

namespace osculate::deck {
namespace {

/// By node, in a plane model times the thickness or the circumference.
std::vector<double> areas_around(const BuildContext<3>& c) {
  return mesh::free_areas(c.model().mesh, c.sides);
}
std::vector<double> areas_around(const BuildContext<2>& c) {
  const model::Model& m = c.model();
  std::vector<double> areas(m.reference.size(), 0.0);
  for (const mesh::Edge& edge : c.sides.edges) {
    const mesh::Block& block = m.mesh.blocks[static_cast<std::size_t>(edge.cell.block)];
    const auto& local = cell::info(block.type).edges[static_cast<std::size_t>(edge.local)];
    const Index* const nodes = block.cell(edge.cell.cell);
    const std::array<Index, 2> ends{nodes[local[0]], nodes[local[1]]};
    if (c.sides.find(ends[0], ends[1]).size() > 1) continue;
    const solid::Section<2>& section = m.sections[static_cast<std::size_t>(c.section_of_cell.at(
                                                      {edge.cell.block, edge.cell.cell}))]
                                           .section;
    const Vec2 a = m.reference[static_cast<std::size_t>(ends[0])],
               b = m.reference[static_cast<std::size_t>(ends[1])];
    const bool ring = section.assumption == solid::Assumption::axisymmetric;
    for (const Index n : ends)
      areas[static_cast<std::size_t>(n)] +=
          0.5 * (b - a).norm() * (ring ? std::numbers::pi * (a.x() + b.x()) : section.thickness);
  }
  return areas;
}

/// Share of a facet's area that a node of it has; negative: not known for such facets.
///
/// Formula    quad8 1/100 and 24/100, tri6 1/999 and 332/999 (corners, middles), tri3 and quad4
/// equal
///            ones; in the plane those of the facet's extrusion by one cell of second order: 26/100
///            and 48/100
/// Source     forces of node-to-face contact that CalculiX 2.20 prints; its User's Manual has the
///            first two
double share_of_node(const pairing::Facet& facet, std::size_t local) {
  if (facet.count == 2) return 0.5;
  return facet.count == 3 ? (local < 2 ? 0.26 : 0.48) : -1;
}
double share_of_node(const pairing::SurfaceFacet& facet, std::size_t local) {
  switch (facet.type) {
    case cell::CellType::tri3:
      return 1.0 / 3;
    case cell::CellType::quad4:
      return 0.25;
    case cell::CellType::tri6:
      return (local < 3 ? 1.0 : 332.0) / 999;
    case cell::CellType::quad8:
      return local < 4 ? 0.01 : 0.24;
    default:
      return -1;
  }
}

template <int Dim>
double area_of(const pairing::Boundary<Dim>& boundary, std::size_t f,
               const std::vector<Vec<Dim>>& reference, const pairing::AreaRule& rule) {
  pairing::Boundary<Dim> one = boundary;
  one.facets = {boundary.facets[f]};
  if constexpr (Dim == 2) one.facets[0].prev = one.facets[0].next = -1;
  std::vector<double> areas;
  pairing::nodal_areas(pairing::make_slave_side(one), reference, rule, areas, nullptr);
  double sum = 0;
  for (const double area : areas) sum += area;
  return sum;
}

template <int Dim>
std::vector<double> areas_of_middles(const BuildContext<Dim>& c, const Contact& contact,
                                     const pairing::PairDefinition<Dim>& pair) {
  const pairing::SlaveSide<Dim>& slave = pair.slave;
  std::vector<double> of_facets, areas;
  for (std::size_t f = 0; f < slave.boundary.facets.size(); ++f)
    of_facets.push_back(area_of<Dim>(slave.boundary, f, c.model().reference, pair.area));
  for (std::size_t i = 0; i < slave.nodes.size(); ++i) {
    areas.push_back(0);
    for (const Index f : slave.facets_of[i]) {
      const auto& facet = slave.boundary.facets[static_cast<std::size_t>(f)];
      const auto* const at =
          std::find(facet.nodes.begin(), facet.nodes.begin() + facet.count, slave.nodes[i]);
      const double share = share_of_node(facet, static_cast<std::size_t>(at - facet.nodes.begin()));
      if (!(share >= 0))
        throw core::InputError(contact.weight.mark,
                               "area: middles is for facets of 3, 4, 6 or 8 nodes, and lines of 2 "
                               "or 3");
      areas.back() += share * of_facets[static_cast<std::size_t>(f)];
    }
    if (!(areas.back() > 0))
      throw core::InputError(contact.weight.mark,
                             fmt::format("a node of the slave '{}' has no facet: area: middles is "
                                         "of facets",
                                         contact.slave.value));
  }
  return areas;
}

/// Thickness or circumference of the section behind a facet; of a rigid mesh those of the pair.
pairing::AreaRule rule_behind(const BuildContext<2>& c, const Side<2>& facet,
                              const pairing::AreaRule& otherwise) {
  const auto found = c.section_of_cell.find({facet.parent.block, facet.parent.cell});
  if (found == c.section_of_cell.end()) return otherwise;
  const solid::Section<2>& section =
      c.model().sections[static_cast<std::size_t>(found->second)].section;
  return {section.thickness, section.assumption == solid::Assumption::axisymmetric};
}
pairing::AreaRule rule_behind(const BuildContext<3>&, const Side<3>&,
                              const pairing::AreaRule& otherwise) {
  return otherwise;
}

/// Of the master's facet that is nearest a node where both lie at the beginning.
template <int Dim>
std::vector<double> areas_of_master(const BuildContext<Dim>& c, const Contact& contact,
                                    const pairing::PairDefinition<Dim>& pair) {
  if (c.rigid_index.contains(contact.master.value))
    throw core::InputError(contact.weight.mark,
                           fmt::format("area: master is of facets of the mesh, and '{}' is a rigid "
                                       "body",
                                       contact.master.value));
  const FacetFeet<Dim> master(c.model().reference, oriented_facets(c, contact.master));
  const pairing::Boundary<Dim> boundary = boundary_from<Dim>(master.facets(), false);
  std::vector<double> areas;
  for (const auto& point : pair.slave.points) {
    const auto n = static_cast<std::size_t>(point.nearest_node());
    const auto f = static_cast<std::size_t>(master.at(c.model().reference[n]).facet);
    areas.push_back(area_of<Dim>(boundary, f, c.model().reference,
                                 rule_behind(c, master.facets()[f], pair.area)));
  }
  return areas;
}

}  // namespace

template <int Dim>
std::vector<double> given_areas(const BuildContext<Dim>& c, const Contact& contact,
                                const pairing::PairDefinition<Dim>& pair) {
  const std::size_t count = pair.slave.points.size();
  if (!(contact.area > 0) && !contact.area_by) return {};
  if (!pairing::sampled_at_nodes(pair.slave) || pairing::by_mortar(pair))
    throw core::InputError(contact.weight.mark, "a given area of nodes goes with sampling: nodes");
  if (contact.area > 0) return std::vector<double>(count, contact.area);
  if (*contact.area_by == AreaWord::middles) return areas_of_middles(c, contact, pair);
  if (*contact.area_by == AreaWord::master) return areas_of_master(c, contact, pair);
  const std::vector<double> all = areas_around(c);
  std::vector<double> areas;
  double sum = 0;
  std::size_t some = 0;
  for (const auto& point : pair.slave.points) {
    const auto n = static_cast<std::size_t>(point.nearest_node());
    areas.push_back(n < all.size() ? all[n] : 0.0);
    sum += areas.back();
    some += areas.back() > 0 ? 1 : 0;
  }
  if (some == 0)
    throw core::InputError(contact.weight.mark,
                           fmt::format("no node of the slave '{}' is a corner of a free face: give "
                                       "the area as a number",
                                       contact.slave.value));
  for (double& area : areas)
    if (!(area > 0)) area = sum / static_cast<double>(some);
  return areas;
}

template std::vector<double> given_areas(const BuildContext<2>&, const Contact&,
                                         const pairing::PairDefinition<2>&);
template std::vector<double> given_areas(const BuildContext<3>&, const Contact&,
                                         const pairing::PairDefinition<3>&);

}  // namespace osculate::deck
