#include "osculate/pairing/reentrant_edge_place.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "osculate/cell/shape.hpp"

namespace osculate::pairing {
namespace {

const SharpEdge& edge_at(const ReentrantEdges& edges, Index edge) {
  return edges.list[static_cast<std::size_t>(edge)];
}

const SurfaceFacet& facet_at(const FacetSurface& surface, Index facet) {
  return surface.facets[static_cast<std::size_t>(facet)];
}

/// Derivatives of half the squared distance from the point by s.
struct EdgeDistance {
  Vec3 arm;
  double slope = 0, bend = 0;  ///< bend > 0: a minimum
};

EdgeDistance distance_at(const SharpEdge& edge, double s, std::span<const Vec3> x,
                         const Vec3& point) {
  const Vec3 first = edge_derivative(edge, 1, s, x);
  EdgeDistance d;
  d.arm = point - edge_derivative(edge, 0, s, x);
  d.slope = -first.dot(d.arm);
  d.bend = first.squaredNorm() - edge_derivative(edge, 2, s, x).dot(d.arm);
  return d;
}

/// Coordinate of the closest place, within `limit` on both sides of the middle.
double foot(const SharpEdge& edge, std::span<const Vec3> x, const Vec3& point, double limit) {
  constexpr int grid = 8, most = 30;
  double s = 0;
  if (edge.count > 2)
    for (int i = 0; i <= grid; ++i) {
      const double at = 2.0 * i / grid - 1;
      if (distance_at(edge, at, x, point).arm.norm() < distance_at(edge, s, x, point).arm.norm())
        s = at;
    }
  for (int i = 0; i < most; ++i) {
    const EdgeDistance d = distance_at(edge, s, x, point);
    if (!(d.bend > 0)) break;
    const double next = std::clamp(s - d.slope / d.bend, -limit, limit);
    if (std::abs(next - s) <= 1e-15) break;
    s = next;
  }
  return s;
}

double distance_from(const SharpEdge& edge, std::span<const Vec3> x, const Vec3& point) {
  return (point - edge_derivative(edge, 0, foot(edge, x, point, 1.0), x)).norm();
}

bool ends_in(const SurfaceFacet& facet, int e, Index node) {
  const std::array<int, 2> ends = edge_corners(facet, e);
  return facet.nodes[static_cast<std::size_t>(ends[0])] == node ||
         facet.nodes[static_cast<std::size_t>(ends[1])] == node;
}

/// Whether the surface ends in a node.
bool at_open_border(const FacetSurface& master, Index node) {
  for (const Index f : master.facets_at.at(node)) {
    const SurfaceFacet& facet = facet_at(master, f);
    for (int e = 0; e < edge_count(facet); ++e)
      if (facet.neighbour[static_cast<std::size_t>(e)] < 0 && ends_in(facet, e, node)) return true;
  }
  return false;
}

/// Whether one concave edge goes on from the end of another, within 60 degrees.
bool continues(const ReentrantEdges& edges, Index edge, Index other, Index node,
               std::span<const Vec3> x) {
  constexpr double least_cosine = 0.5;
  const auto chord = [&](Index e) {  // out of the node
    const SharpEdge& is = edge_at(edges, e);
    const Vec3 a = x[static_cast<std::size_t>(is.nodes[0])],
               b = x[static_cast<std::size_t>(is.nodes[1])];
    return Vec3((is.nodes[0] == node ? 1.0 : -1.0) * (b - a).normalized());
  };
  return other != edge && chord(other).dot(chord(edge)) < -least_cosine;
}

bool goes_on(const ReentrantEdges& edges, Index edge, Index node, std::span<const Vec3> x) {
  const std::vector<Index>& all = edges.at.at(node);
  return std::any_of(all.begin(), all.end(),
                     [&](Index other) { return continues(edges, edge, other, node, x); });
}

EdgePlace place_on(const ReentrantEdges& edges, const FacetSurface& master, Index number,
                   std::span<const Vec3> x, const Vec3& point) {
  constexpr double rounding = 1e-6;
  const SharpEdge& edge = edge_at(edges, number);
  EdgePlace p;
  p.edge = number;
  p.s = foot(edge, x, point, 1 + 2 * edge_end_extension);
  p.point = edge_derivative(edge, 0, p.s, x);
  p.first = edge_derivative(edge, 1, p.s, x);
  p.second = edge_derivative(edge, 2, p.s, x);
  p.tangent = p.first.normalized();
  for (std::size_t k = 0; k < 2; ++k) {
    p.normal[k] = facet_normal(facet_at(master, edge.facets[k]), edge_xi(edge, k, p.s), x);
    p.away[k] = (k == 0 ? 1.0 : -1.0) * p.normal[k].cross(p.tangent);
  }
  p.bisector = (p.normal[0] + p.normal[1]).normalized();
  constexpr double least_sine = 1e-6;  // flat or turned over: no such edge now
  const double bend = p.first.squaredNorm() - p.second.dot(point - p.point);
  if (!(p.away[0].dot(p.normal[1]) > least_sine && bend > 0)) p.beyond = true;
  if (p.beyond || std::abs(p.s) <= 1 + rounding) return p;
  const Index end = edge.nodes[p.s > 0 ? 1 : 0];
  const bool continued = at_open_border(master, end) || goes_on(edges, number, end, x);
  p.beyond = !continued || std::abs(p.s) > 1 + edge_end_extension;
  return p;
}

/// The nearest of some edges; the first of those that are equally near.
struct Nearest {
  std::span<const Vec3> x;
  const Vec3& point;
  Index edge = -1;
  double distance = 0;

  bool offer(const ReentrantEdges& edges, Index other) {
    constexpr double tie = 1e-12;
    const SharpEdge& is = edge_at(edges, other);
    const double found = distance_from(is, x, point);
    const double size = edge_derivative(is, 1, 0, x).norm();
    if (edge >= 0 && !(found < distance - tie * size)) return false;
    edge = other;
    distance = found;
    return true;
  }
};

}  // namespace

bool find_reentrant_edges(const FacetSurface& master, std::span<const Vec3> reference, double angle,
                          ReentrantEdges& edges) {
  edges = {};
  for (const SharpEdge& edge : sharp_edges(master, reference, angle, Bend::concave)) {
    if (!is_plain(facet_at(master, edge.facets[0])) || !is_plain(facet_at(master, edge.facets[1])))
      continue;
    for (const std::size_t end : {0u, 1u})
      edges.at[edge.nodes[end]].push_back(static_cast<Index>(edges.list.size()));
    edges.list.push_back(edge);
  }
  return !edges.list.empty();
}

std::optional<EdgeLocation> location_on_edge(const ReentrantEdges& edges,
                                             const FacetSurface& master, Index facet,
                                             const Vec2& xi) {
  constexpr double rounding = 1e-7;
  if (facet < 0) return std::nullopt;
  const SurfaceFacet& is = facet_at(master, facet);
  for (int e = 0; e < edge_count(is); ++e) {
    const auto there = edges.at.find(is.nodes[static_cast<std::size_t>(e)]);
    if (there == edges.at.end()) continue;
    for (const Index number : there->second) {
      const SharpEdge& edge = edge_at(edges, number);
      if (edge.facets[0] != facet && edge.facets[1] != facet) continue;
      const std::size_t side = edge.facets[0] == facet ? 0 : 1;
      const Vec2 rate = edge_xi_rate(edge, side);
      const double s = (xi - edge_xi(edge, side, 0)).dot(rate) / rate.squaredNorm();
      if ((xi - edge_xi(edge, side, s)).norm() < rounding &&
          std::abs(s) <= 1 + edge_end_extension + rounding)
        return EdgeLocation{number, s};
    }
  }
  return std::nullopt;
}

Vec3 edge_derivative(const SharpEdge& edge, int order, double s, std::span<const Vec3> x) {
  const cell::LineShape shape = cell::lagrange_line(edge.count, s);
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < static_cast<std::size_t>(edge.count); ++k)
    sum += shape.n[static_cast<std::size_t>(order)][k] * x[static_cast<std::size_t>(edge.nodes[k])];
  return sum;
}

Vec2 edge_xi(const SharpEdge& edge, std::size_t side, double s) {
  return 0.5 * (1 - s) * edge.ends[side][0] + 0.5 * (1 + s) * edge.ends[side][1];
}

Vec2 edge_xi_rate(const SharpEdge& edge, std::size_t side) {
  return 0.5 * (edge.ends[side][1] - edge.ends[side][0]);
}

EdgePlace follow_edge(const ReentrantEdges& edges, const FacetSurface& master, Index edge,
                      std::span<const Vec3> x, const Vec3& point) {
  Nearest nearest{x, point};
  nearest.offer(edges, edge);
  for (bool moved = true; moved;) {
    moved = false;
    const Index from = nearest.edge;
    for (const std::size_t end : {0u, 1u}) {
      const Index node = edge_at(edges, from).nodes[end];
      for (const Index other : edges.at.at(node))
        if (continues(edges, from, other, node, x)) moved = nearest.offer(edges, other) || moved;
    }
  }
  return place_on(edges, master, nearest.edge, x, point);
}

std::optional<EdgePlace> edge_between(const ReentrantEdges& edges, const FacetSurface& master,
                                      std::array<Index, 2> facets, std::span<const Vec3> x,
                                      const Vec3& point) {
  Nearest nearest{x, point};
  for (const Index f : facets) {
    const SurfaceFacet& facet = facet_at(master, f);
    for (int k = 0; k < edge_count(facet); ++k) {
      const auto there = edges.at.find(facet.nodes[static_cast<std::size_t>(k)]);
      if (there == edges.at.end()) continue;
      for (const Index edge : there->second) nearest.offer(edges, edge);
    }
  }
  if (nearest.edge < 0) return std::nullopt;
  return place_on(edges, master, nearest.edge, x, point);
}

std::size_t side_of(const SharpEdge& edge, const EdgePlace& place, const FacetSurface& master,
                    Index facet, std::span<const Vec3> x) {
  if (edge.facets[0] == facet) return 0;
  if (edge.facets[1] == facet) return 1;
  const Vec3 normal = middle_normal(facet_at(master, facet), x);
  return normal.dot(place.normal[1]) > normal.dot(place.normal[0]) ? 1 : 0;
}

}  // namespace osculate::pairing
