// What `contact: {all: ...}` leaves to others: surfaces that are excluded, paired or tied.
#include <algorithm>

#include "osculate/deck/build_contact_parts.hpp"
#include "osculate/deck/build_ties.hpp"

namespace osculate::deck {
namespace {

template <class Facet>
std::vector<Index> sorted_nodes(const Facet& facet) {
  std::vector<Index> nodes(facet.nodes.begin(), facet.nodes.begin() + facet.count);
  std::ranges::sort(nodes);
  return nodes;
}

template <int Dim>
SurfaceNodes surface_with(const pairing::Boundary<Dim>& boundary, const std::vector<Index>& nodes) {
  SurfaceNodes out;
  out.nodes.insert(nodes.begin(), nodes.end());
  for (const auto& facet : boundary.facets) {
    std::vector<Index> own = sorted_nodes(facet);
    out.nodes.insert(own.begin(), own.end());
    out.facets.insert(std::move(own));
  }
  return out;
}

/// Of a set of facets or nodes, or of a rigid body.
template <int Dim>
SurfaceNodes surface_named(const BuildContext<Dim>& c, const Name& name) {
  if (!c.rigid_index.contains(name.value) && c.set(name).dimension == 0)
    return surface_with<Dim>({}, c.set(name).nodes);
  return surface_with<Dim>(boundary_of(c, name), {});
}

}  // namespace

bool SurfaceNodes::has(std::vector<Index> facet) const {
  if (facets.empty()) return std::ranges::all_of(facet, [&](Index n) { return nodes.contains(n); });
  std::ranges::sort(facet);
  return facets.contains(facet);
}

template <int Dim>
std::vector<std::array<SurfaceNodes, 2>> not_by_all(const BuildContext<Dim>& c,
                                                    const Contact& all) {
  std::vector<std::array<SurfaceNodes, 2>> out;
  for (const std::array<Name, 2>& pair : all.exclude_surfaces)
    out.push_back({surface_named(c, pair[0]), surface_named(c, pair[1])});
  for (const Contact& pair : c.description.contact)
    if (!pair.all) out.push_back({surface_named(c, pair.slave), surface_named(c, pair.master)});
  for (const Tie& tie : c.description.ties)
    out.push_back({surface_with<Dim>({}, nodes_of_tie(c, tie)), surface_named(c, tie.master)});
  return out;
}

template <int Dim>
pairing::HiddenFacets hidden_facets(const std::vector<std::array<SurfaceNodes, 2>>& apart,
                                    const std::vector<Index>& slave,
                                    const pairing::Boundary<Dim>& master) {
  pairing::HiddenFacets out;
  std::map<std::vector<std::size_t>, int> kinds;  // by the surfaces that a node is on
  out.of_node.assign(slave.size(), -1);
  for (std::size_t i = 0; i < slave.size(); ++i) {
    std::vector<std::size_t> on;
    for (std::size_t k = 0; k < 2 * apart.size(); ++k)
      if (apart[k / 2][k % 2].nodes.contains(slave[i])) on.push_back(k);
    if (on.empty()) continue;
    const auto [found, fresh] = kinds.try_emplace(on, -1);
    if (fresh) {
      std::vector<bool> hidden;
      for (const auto& facet : master.facets) {
        const std::vector<Index> nodes = sorted_nodes(facet);
        hidden.push_back(std::ranges::any_of(
            on, [&](std::size_t k) { return apart[k / 2][1 - k % 2].has(nodes); }));
      }
      if (std::ranges::find(hidden, true) != hidden.end()) {
        found->second = static_cast<int>(out.kinds.size());
        out.kinds.push_back(std::move(hidden));
      }
    }
    out.of_node[i] = found->second;
  }
  if (out.kinds.empty()) out.of_node.clear();
  return out;
}

template std::vector<std::array<SurfaceNodes, 2>> not_by_all(const BuildContext<2>&,
                                                             const Contact&);
template std::vector<std::array<SurfaceNodes, 2>> not_by_all(const BuildContext<3>&,
                                                             const Contact&);
template pairing::HiddenFacets hidden_facets<2>(const std::vector<std::array<SurfaceNodes, 2>>&,
                                                const std::vector<Index>&,
                                                const pairing::Boundary<2>&);
template pairing::HiddenFacets hidden_facets<3>(const std::vector<std::array<SurfaceNodes, 2>>&,
                                                const std::vector<Index>&,
                                                const pairing::Boundary<3>&);

}  // namespace osculate::deck
