#include "osculate/pairing/point_normal.hpp"

#include <algorithm>
#include <unordered_map>

#include "osculate/cell/quadrature.hpp"
#include "osculate/pairing/area_element.hpp"

namespace osculate::pairing {

namespace {

/// Nodes of a facet in the direction of travel: first end, interior, second end.
std::vector<Index> along(const Facet& facet) {
  std::vector<Index> nodes{facet.nodes[0]};
  nodes.insert(nodes.end(), facet.nodes.begin() + 2, facet.nodes.begin() + facet.count);
  nodes.push_back(facet.nodes[1]);
  return nodes;
}

/// Facets piece by piece in the direction of travel, open pieces from their start.
std::vector<Index> facet_order(const Chain& chain) {
  std::vector<Index> order;
  std::vector<bool> seen(chain.facets.size(), false);
  const auto walk = [&](Index f) {
    for (; f >= 0 && !seen[static_cast<std::size_t>(f)];
         f = chain.facets[static_cast<std::size_t>(f)].next) {
      seen[static_cast<std::size_t>(f)] = true;
      order.push_back(f);
    }
  };
  for (std::size_t f = 0; f < seen.size(); ++f)
    if (chain.facets[f].prev < 0) walk(static_cast<Index>(f));
  for (std::size_t f = 0; f < seen.size(); ++f) walk(static_cast<Index>(f));
  return order;
}

}  // namespace

SlaveSide<2> make_slave_side(Chain chain, std::span<const Index> extra_nodes) {
  SlaveSide<2> side;
  side.boundary = std::move(chain);
  std::unordered_map<Index, std::size_t> slot;
  const auto add = [&](Index node) {
    const auto found = slot.emplace(node, side.nodes.size());
    if (found.second) {
      side.nodes.push_back(node);
      side.facets_of.emplace_back();
    }
    return found.first->second;
  };
  for (const Index f : facet_order(side.boundary))
    for (const Index node : along(side.boundary.facets[static_cast<std::size_t>(f)]))
      side.facets_of[add(node)].push_back(f);
  for (const Index node : extra_nodes) add(node);
  sample_nodes(side);
  return side;
}

namespace {

/// Adds the share of one facet to the area of its local node `k`.
void add_facet_area(const Facet& facet, std::size_t k, std::span<const Vec2> x,
                    const AreaRule& rule, double& area, std::vector<NodeGradient<2>>* gradient) {
  static const cell::Quadrature1D quadrature = cell::gauss_legendre(8);
  std::array<Vec2, cell::max_line_nodes> sum;
  sum.fill(Vec2::Zero());
  for (std::size_t q = 0; q < quadrature.points.size(); ++q) {
    const cell::LineShape shape = facet_shape(facet, quadrature.points[q]);
    const AreaElement<2> element = area_element(facet, shape, x, rule);
    const double weight = quadrature.weights[q] * shape.n[0][k];
    area += weight * element.value;
    for (std::size_t l = 0; l < static_cast<std::size_t>(facet.count); ++l)
      sum[l] += weight * element.gradient[l];
  }
  if (!gradient) return;
  for (std::size_t l = 0; l < static_cast<std::size_t>(facet.count); ++l)
    gradient->push_back({facet.nodes[l], sum[l]});
}

}  // namespace

void nodal_areas(const SlaveSide<2>& slave, std::span<const Vec2> x, const AreaRule& rule,
                 std::vector<double>& areas, std::vector<std::vector<NodeGradient<2>>>* gradients) {
  areas.assign(slave.nodes.size(), 0.0);
  if (gradients) gradients->resize(slave.nodes.size());
  for (std::size_t i = 0; i < slave.nodes.size(); ++i) {
    if (gradients) (*gradients)[i].clear();
    for (const Index f : slave.facets_of[i]) {
      const Facet& facet = slave.boundary.facets[static_cast<std::size_t>(f)];
      const auto* const begin = facet.nodes.begin();
      const auto k =
          static_cast<std::size_t>(std::find(begin, begin + facet.count, slave.nodes[i]) - begin);
      add_facet_area(facet, k, x, rule, areas[i], gradients ? &(*gradients)[i] : nullptr);
    }
  }
}

Vec2 nodal_normal(const SlaveSide<2>& slave, std::span<const Vec2> x, std::size_t i) {
  Vec2 normal = Vec2::Zero();
  for (const Index f : slave.facets_of[i]) {
    const Facet& facet = slave.boundary.facets[static_cast<std::size_t>(f)];
    const auto k = static_cast<std::size_t>(
        std::find(facet.nodes.begin(), facet.nodes.begin() + facet.count, slave.nodes[i]) -
        facet.nodes.begin());
    const double xi = k == 0   ? -1.0
                      : k == 1 ? 1.0
                               : -1.0 + 2.0 * static_cast<double>(k - 1) / (facet.count - 1);
    const Vec2 tangent = facet_jet(facet, xi, x).r1;
    if (tangent.norm() > 0) normal += turn(tangent.normalized());
  }
  if (normal.norm() > 1e-12) normal.normalize();
  return normal;
}

void nodal_normals(const SlaveSide<2>& slave, std::span<const Vec2> x, std::vector<Vec2>& normals) {
  normals.resize(slave.nodes.size());
  for (std::size_t i = 0; i < normals.size(); ++i) normals[i] = nodal_normal(slave, x, i);
}

}  // namespace osculate::pairing
