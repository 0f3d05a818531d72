#include "osculate/model/beyond_slave.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "osculate/mesh/boundary.hpp"
#include "osculate/mesh/surface.hpp"
#include "osculate/pairing/projected_point.hpp"

namespace osculate::model {
namespace {

using Flags = std::vector<char>;

/// Neighbours on the free facets of all bodies, by node; empty inside and on rigid meshes.
template <int Dim>
std::vector<std::vector<Index>> free_neighbours(const BasicModel<Dim>& model) {
  mesh::Set all{"", Dim, {}, {}};
  for (const BasicBulkSection<Dim>& section : model.sections)
    all.cells.insert(all.cells.end(), section.cells.begin(), section.cells.end());
  std::vector<std::vector<Index>> near(model.reference.size());
  const auto join = [&](const auto& facets) {
    for (const auto& facet : facets)
      for (const Index a : facet.nodes())
        for (const Index b : facet.nodes())
          if (a != b) near[static_cast<std::size_t>(a)].push_back(b);
  };
  if constexpr (Dim == 2)
    join(boundary_facets(model.mesh, edge_table(model.mesh, all.cells), all).facets);
  else
    join(surface_facets(model.mesh, face_table(model.mesh, all.cells), all).facets);
  return near;
}

template <int Dim>
void mark_nodes(const pairing::Boundary<Dim>& boundary, Flags& marked) {
  for (const auto& facet : boundary.facets)
    for (std::size_t k = 0; k < static_cast<std::size_t>(facet.count); ++k)
      marked[static_cast<std::size_t>(facet.nodes[k])] = 1;
}

/// One master in two configurations: now, and at the start.
template <int Dim>
class Over {
 public:
  Over(const pairing::PairDefinition<Dim>& pair, const std::vector<Vec<Dim>>& x)
      : pair_(pair), x_(x) {
    std::vector<search::Box<Dim>> boxes;
    facet_boxes(pair.master, std::span<const Vec<Dim>>(x), boxes);
    tree_.emplace(boxes);
  }
  /// Over one of its faces; +inf over none.
  [[nodiscard]] double gap(Index node) const {
    pairing::ProjectionQuery<Dim> query;
    query.point = x_[static_cast<std::size_t>(node)];
    const std::span<const Vec<Dim>> x(x_);
    const pairing::Projection<Dim> p = closest(pair_.master, *tree_, x, query);
    if (p.feature != projection::Feature::face || p.beyond_end)
      return std::numeric_limits<double>::infinity();
    return projected_point(pair_.master, p, query.point, x).kinematics.gap - pair_.offset;
  }

 private:
  const pairing::PairDefinition<Dim>& pair_;
  const std::vector<Vec<Dim>>& x_;
  std::optional<pairing::Tree<Dim>> tree_;
};

template <int Dim>
bool judged(const BasicContactPair<Dim>& pair) {
  const pairing::PairDefinition<Dim>& d = pair.definition;
  return !d.filter.limited() && !pairing::held_from_start(d) && pair.height > 0 &&
         !d.master.facets.empty();
}

/// The slaves of this master, in all pairs, and what belongs to it.
template <int Dim>
Flags seen_by(const BasicModel<Dim>& model, const pairing::PairDefinition<Dim>& pair) {
  Flags seen(model.reference.size()), own(model.reference.size());
  mark_nodes<Dim>(pair.master, own);
  for (const BasicContactPair<Dim>& other : model.pairs)
    if (own[static_cast<std::size_t>(other.definition.master.facets.front().nodes[0])])
      mark_nodes<Dim>(other.definition.slave.boundary, seen);
  for (std::size_t n = 0; n < seen.size(); ++n) seen[n] |= own[n];
  return seen;
}

/// The set of the boundary that a node lies in, the smallest one.
template <int Dim>
std::string set_of(const mesh::Mesh& mesh, Index node) {
  const mesh::Set* best = nullptr;
  for (const mesh::Set& set : mesh.sets)
    if (set.dimension == Dim - 1 && std::ranges::binary_search(set.nodes, node) &&
        (!best || set.nodes.size() < best->nodes.size()))
      best = &set;
  return best ? best->name : std::string{};
}

}  // namespace

template <int Dim>
std::vector<BeyondSlave> beyond_slave(const BasicModel<Dim>& model,
                                      const std::vector<Vec<Dim>>& positions, double reach) {
  std::vector<BeyondSlave> all;
  if (std::ranges::none_of(model.pairs, judged<Dim>)) return all;
  const std::vector<std::vector<Index>> near = free_neighbours(model);
  for (const BasicContactPair<Dim>& pair : model.pairs) {
    if (!judged(pair)) continue;
    const Over<Dim> now(pair.definition, positions), once(pair.definition, model.reference);
    Flags visited = seen_by(model, pair.definition), slave(model.reference.size());
    mark_nodes<Dim>(pair.definition.slave.boundary, slave);
    std::vector<Index> next;
    for (std::size_t n = 0; n < slave.size(); ++n)
      if (slave[n]) next.insert(next.end(), near[n].begin(), near[n].end());
    const double nearest = reach * pair.height;
    BeyondSlave found{pair.name, -1, nearest, pair.height, {}};
    while (!next.empty()) {
      const Index node = next.back();
      next.pop_back();
      const auto n = static_cast<std::size_t>(node);
      if (std::exchange(visited[n], 1)) continue;
      const double gap = now.gap(node);
      if (gap >= nearest || once.gap(node) < 2 * std::max(0.0, nearest)) continue;
      if (gap < found.gap) found.node = node;
      found.gap = std::min(found.gap, gap);
      const std::string set = set_of<Dim>(model.mesh, node);
      if (!set.empty() && std::ranges::find(found.sets, set) == found.sets.end())
        found.sets.push_back(set);
      next.insert(next.end(), near[n].begin(), near[n].end());
    }
    std::ranges::sort(found.sets);
    if (found.node >= 0) all.push_back(std::move(found));
  }
  return all;
}

std::string beyond_slave_text(const mesh::Mesh& mesh, const BeyondSlave& found) {
  const bool inside = found.gap < 0;
  return fmt::format(
      "contact '{}': beside its slave the body has {} the master ({:.2g} times the height of the "
      "cells, at {}), where nothing holds it",
      found.pair,
      inside ? fmt::format("gone {:.3g} into", -found.gap)
             : fmt::format("come within {:.3g} of", found.gap),
      std::abs(found.gap) / found.height, describe_node(mesh, found.node));
}

std::string beyond_slave_cure(const BeyondSlave& found) {
  std::string sets;
  for (const std::string& set : found.sets) sets += (sets.empty() ? " ('" : "', '") + set;
  if (!sets.empty()) sets += "')";
  return fmt::format(
      "take the sides that come to the master{} into the slave of contact '{}' as well, or use "
      "`contact: {{all: ...}}`",
      sets, found.pair);
}

template std::vector<BeyondSlave> beyond_slave(const Model&, const std::vector<Vec2>&, double);
template std::vector<BeyondSlave> beyond_slave(const Model3&, const std::vector<Vec3>&, double);

}  // namespace osculate::model
