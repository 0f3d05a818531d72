// Nodal areas and normals of slave surfaces in space.
#include <Eigen/Geometry>
#include <algorithm>

#include "osculate/cell/quadrature.hpp"
#include "osculate/cell/shape.hpp"
#include "osculate/pairing/area_element.hpp"
#include "osculate/pairing/point_normal.hpp"

namespace osculate::pairing {

SlaveSide<3> make_slave_side(FacetSurface surface, std::span<const Index> extra_nodes) {
  SlaveSide<3> side;
  side.boundary = std::move(surface);
  std::unordered_map<Index, std::size_t> slot;
  const auto add = [&](Index node) {
    const auto found = slot.emplace(node, side.nodes.size());
    if (found.second) {
      side.nodes.push_back(node);
      side.facets_of.emplace_back();
    }
    return found.first->second;
  };
  for (std::size_t f = 0; f < side.boundary.facets.size(); ++f) {
    const SurfaceFacet& facet = side.boundary.facets[f];
    for (std::size_t k = 0; k < static_cast<std::size_t>(facet.count); ++k)
      side.facets_of[add(facet.nodes[k])].push_back(static_cast<Index>(f));
  }
  for (const Index node : extra_nodes) add(node);
  sample_nodes(side);
  return side;
}

namespace {

/// Weighted points of a facet's reference cell.
struct Rule {
  std::vector<Vec2> points;
  std::vector<double> weights;
};

/// Exact for polynomials of degree 9 per variable; triangles by collapsing the square.
Rule make_rule(bool triangle) {
  const cell::Quadrature1D line = cell::gauss_legendre(5);
  Rule rule;
  for (std::size_t i = 0; i < line.points.size(); ++i)
    for (std::size_t j = 0; j < line.points.size(); ++j) {
      const double a = line.points[i], b = line.points[j];
      const double w = line.weights[i] * line.weights[j];
      if (triangle) {
        const double u = 0.5 * (1 + a), v = 0.5 * (1 + b) * (1 - u);
        rule.points.emplace_back(u, v);
        rule.weights.push_back(0.25 * w * (1 - u));
      } else {
        rule.points.emplace_back(a, b);
        rule.weights.push_back(w);
      }
    }
  return rule;
}

const Rule& rule_of(cell::CellType type) {
  static const Rule triangle = make_rule(true), square = make_rule(false);
  return cell::is_triangle(type) ? triangle : square;
}

/// One normal, one area element.
bool is_plane_triangle(const SurfaceFacet& facet) {
  return is_plain(facet) && facet.type == cell::CellType::tri3;
}

/// For areas: linear functions times the area element of a plane triangle need its middle only.
const Rule& rule_of(const SurfaceFacet& facet) {
  static const Rule middle{{Vec2(1.0 / 3, 1.0 / 3)}, {0.5}};
  return is_plane_triangle(facet) ? middle : rule_of(facet.type);
}

/// c_k of tri6 and quad8 (see the header).
std::array<double, cell::max_facet_nodes> make_shares(cell::CellType type) {
  const Rule& rule = rule_of(type);
  std::array<double, cell::max_facet_nodes> share{};
  double total = 0;
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    const cell::FacetShape s = cell::facet_shape(type, rule.points[q]);
    for (std::size_t k = 0; k < static_cast<std::size_t>(s.count); ++k) {
      share[k] += rule.weights[q] * s.n[0][k] * s.n[0][k];
      total += rule.weights[q] * s.n[0][k] * s.n[0][k];
    }
  }
  for (double& value : share) value /= total;
  return share;
}

/// The function that shares out the facet's area: N_k, or the constant c_k.
double share_of(cell::CellType type, const cell::FacetShape& shape, std::size_t k) {
  static const std::array<double, cell::max_facet_nodes> tri6 = make_shares(cell::CellType::tri6);
  static const std::array<double, cell::max_facet_nodes> quad8 = make_shares(cell::CellType::quad8);
  if (type == cell::CellType::tri6) return tri6[k];
  if (type == cell::CellType::quad8) return quad8[k];
  return shape.n[0][k];
}

/// Adds the share of one facet to the area of its local node `k`.
void add_facet_area(const SurfaceFacet& facet, std::size_t k, std::span<const Vec3> x, double& area,
                    std::vector<NodeGradient<3>>* gradient) {
  const Rule& rule = rule_of(facet);
  std::array<Vec3, cell::max_facet_nodes> sum;
  sum.fill(Vec3::Zero());
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    const cell::FacetShape shape = is_plain(facet)
                                       ? cell::facet_shape(facet.type, rule.points[q], 1)
                                       : facet_shape(facet, rule.points[q]);
    const AreaElement<3> element = area_element(facet, shape, x, {});
    const double weight = rule.weights[q] * share_of(facet.type, shape, k);
    area += weight * element.value;
    for (std::size_t l = 0; l < static_cast<std::size_t>(facet.count); ++l)
      sum[l] += weight * element.gradient[l];
  }
  if (!gradient) return;
  for (std::size_t l = 0; l < static_cast<std::size_t>(facet.count); ++l)
    gradient->push_back({facet.nodes[l], sum[l]});
}

std::size_t local_node(const SurfaceFacet& facet, Index node) {
  const auto* const begin = facet.nodes.begin();
  return static_cast<std::size_t>(std::find(begin, begin + facet.count, node) - begin);
}

}  // namespace

void nodal_areas(const SlaveSide<3>& slave, std::span<const Vec3> x, const AreaRule&,
                 std::vector<double>& areas, std::vector<std::vector<NodeGradient<3>>>* gradients) {
  areas.assign(slave.nodes.size(), 0.0);
  if (gradients) gradients->resize(slave.nodes.size());
  for (std::size_t i = 0; i < slave.nodes.size(); ++i) {
    if (gradients) (*gradients)[i].clear();
    for (const Index f : slave.facets_of[i]) {
      const SurfaceFacet& facet = slave.boundary.facets[static_cast<std::size_t>(f)];
      add_facet_area(facet, local_node(facet, slave.nodes[i]), x, areas[i],
                     gradients ? &(*gradients)[i] : nullptr);
    }
  }
}

void nodal_normals(const SlaveSide<3>& slave, std::span<const Vec3> x, std::vector<Vec3>& normals) {
  const std::vector<SurfaceFacet>& facets = slave.boundary.facets;
  const std::size_t count = slave.nodes.size();
  normals.assign(count + facets.size(), Vec3::Zero());  // of the nodes, then of plane facets
  for (std::size_t f = 0; f < facets.size(); ++f)
    if (is_plane_triangle(facets[f])) normals[count + f] = facet_normal(facets[f], Vec2::Zero(), x);
  for (std::size_t i = 0; i < count; ++i) {
    for (const Index f : slave.facets_of[i]) {
      const SurfaceFacet& facet = facets[static_cast<std::size_t>(f)];
      if (is_plane_triangle(facet)) {
        normals[i] += normals[count + static_cast<std::size_t>(f)];
        continue;
      }
      const Vec2 xi =
          cell::area_node(facet.type, static_cast<int>(local_node(facet, slave.nodes[i])));
      normals[i] += facet_normal(facet, xi, x);
    }
    if (normals[i].norm() > 1e-12) normals[i].normalize();
  }
  normals.resize(count);
}

Vec3 nodal_normal(const SlaveSide<3>& slave, std::span<const Vec3> x, std::size_t i) {
  Vec3 normal = Vec3::Zero();
  for (const Index f : slave.facets_of[i]) {
    const SurfaceFacet& facet = slave.boundary.facets[static_cast<std::size_t>(f)];
    const Vec2 xi =
        is_plane_triangle(facet)
            ? Vec2(Vec2::Zero())
            : cell::area_node(facet.type, static_cast<int>(local_node(facet, slave.nodes[i])));
    normal += facet_normal(facet, xi, x);
  }
  if (normal.norm() > 1e-12) normal.normalize();
  return normal;
}

}  // namespace osculate::pairing
