#include "osculate/pairing/edges.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "osculate/cell/shape.hpp"
#include "osculate/projection/edge_to_edge.hpp"

namespace osculate::pairing {
namespace {

using contact::PointHistory;

constexpr double overhang_limit = 1e-3;  // of the parameter, where the neighbour takes over

const Vec3& at(std::span<const Vec3> x, Index node) { return x[static_cast<std::size_t>(node)]; }

const SurfaceFacet& facet_of(const FacetSurface& surface, const SharpEdge& edge, std::size_t side) {
  return surface.facets[static_cast<std::size_t>(edge.facets[side])];
}

/// Outward normal of one of the facets where the edge has the coordinate `xi`.
Vec3 side_normal(const FacetSurface& surface, const SharpEdge& edge, std::size_t side, double xi,
                 std::span<const Vec3> x) {
  const Vec2 place = 0.5 * (1 - xi) * edge.ends[side][0] + 0.5 * (1 + xi) * edge.ends[side][1];
  return facet_normal(facet_of(surface, edge, side), place, x);
}

using EdgeNodes = std::array<Vec3, 3>;

std::span<const Vec3> nodes_of(const SharpEdge& edge, std::span<const Vec3> x, EdgeNodes& buffer) {
  for (std::size_t k = 0; k < static_cast<std::size_t>(edge.count); ++k)
    buffer[k] = at(x, edge.nodes[k]);
  return {buffer.data(), static_cast<std::size_t>(edge.count)};
}

Vec3 tangent(const SharpEdge& edge, double xi, std::span<const Vec3> x) {
  const cell::LineShape shape = cell::lagrange_line(edge.count, xi);
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < static_cast<std::size_t>(edge.count); ++k)
    sum += shape.n[1][k] * at(x, edge.nodes[k]);
  return sum.norm() > 0 ? Vec3(sum.normalized()) : Vec3(Vec3::Zero());
}

double length(const SharpEdge& edge, std::span<const Vec3> x) {
  return (at(x, edge.nodes[1]) - at(x, edge.nodes[0])).norm();
}

/// Whether both facets fall away from the edge, seen along `normal`, by more than the flush angle.
bool supports(const FacetSurface& surface, const SharpEdge& edge, double xi, const Vec3& normal,
              std::span<const Vec3> x) {
  static const double flush = std::sin(EdgeContact::flush_angle);
  const Vec3 along = tangent(edge, xi, x);
  const Vec3 first = side_normal(surface, edge, 0, xi, x).cross(along);  // into the facets
  const Vec3 second = -side_normal(surface, edge, 1, xi, x).cross(along);
  return normal.dot(first) < -flush && normal.dot(second) < -flush;
}

/// Coordinates of both ends of local edge `e` on `facet`, and on the neighbour that shares them.
void set_ends(const SurfaceFacet& facet, int e, const SurfaceFacet& other, SharpEdge& edge) {
  const std::array<int, 2> ends = edge_corners(facet, e);
  for (std::size_t k = 0; k < 2; ++k) {
    edge.ends[0][k] = cell::area_node(facet.type, ends[k]);
    int j = 0;
    while (j + 1 < edge_count(other) && other.nodes[static_cast<std::size_t>(j)] != edge.nodes[k])
      ++j;
    edge.ends[1][k] = cell::area_node(other.type, j);
  }
}

SharpEdge edge_of(const FacetSurface& surface, std::size_t f, int e) {
  const SurfaceFacet& facet = surface.facets[f];
  const std::array<int, 2> ends = edge_corners(facet, e);
  SharpEdge edge;
  const auto corners = static_cast<std::size_t>(edge_count(facet));
  edge.count = static_cast<std::size_t>(facet.count) > corners ? 3 : 2;
  edge.nodes[0] = facet.nodes[static_cast<std::size_t>(ends[0])];
  edge.nodes[1] = facet.nodes[static_cast<std::size_t>(ends[1])];
  if (edge.count == 3) edge.nodes[2] = facet.nodes[corners + static_cast<std::size_t>(e)];
  edge.facets = {static_cast<Index>(f), facet.neighbour[static_cast<std::size_t>(e)]};
  set_ends(facet, e, surface.facets[static_cast<std::size_t>(edge.facets[1])], edge);
  return edge;
}

bool share_a_node(const SharpEdge& a, const SharpEdge& b) {
  return a.nodes[0] == b.nodes[0] || a.nodes[0] == b.nodes[1] || a.nodes[1] == b.nodes[0] ||
         a.nodes[1] == b.nodes[1];
}

search::Box<3> box_of(const SharpEdge& edge, std::span<const Vec3> x) {
  search::Box<3> box;
  for (std::size_t k = 0; k < static_cast<std::size_t>(edge.count); ++k)
    box.extend(at(x, edge.nodes[k]));
  if (edge.count == 3) box.inflate(0.25 * (box.hi - box.lo).norm());
  return box;
}

/// The edge-edge contact of two edges, if there is one that counts.
bool cross(const EdgeContact& edges, const FacetSurface& master, const FacetSurface& slave,
           std::span<const Vec3> x, EdgeEdgePoint& c) {
  const SharpEdge& m = edges.master[static_cast<std::size_t>(c.master)];
  const SharpEdge& s = edges.slave[static_cast<std::size_t>(c.slave)];
  if (share_a_node(m, s)) return false;
  EdgeNodes of_master, of_slave;
  const projection::EdgesFoot foot =
      projection::closest_points(nodes_of(m, x, of_master), nodes_of(s, x, of_slave));
  if (!foot.converged || std::sqrt(foot.squared_distance) > edges.longest) return false;
  const Vec2 beyond = (foot.xi.cwiseAbs() - Vec2::Ones()).cwiseMax(0.0);
  c.overhang = beyond.sum();
  if (beyond.maxCoeff() > overhang_limit) return false;
  const Vec3 normal = tangent(m, foot.xi[0], x).cross(tangent(s, foot.xi[1], x)).normalized();
  for (const double side : {1.0, -1.0}) {
    const Vec3 out = side * normal;
    if (!supports(master, m, foot.xi[0], out, x) || !supports(slave, s, foot.xi[1], -out, x))
      continue;
    c.flipped = side > 0;  // r_1 x r_2 = -rho' x s' with both edges forwards
    c.xi = {foot.xi[0], c.flipped ? -foot.xi[1] : foot.xi[1]};
    c.place = edge_position(m, foot.xi[0], x);
    return true;
  }
  return false;
}

/// Whether two edge-edge contacts of neighbouring edges are the same place.
bool same_place(const EdgeContact& edges, const EdgeEdgePoint& a, const EdgeEdgePoint& b,
                std::span<const Vec3> x) {
  const auto near = [](const std::vector<SharpEdge>& all, Index i, Index j) {
    return i == j ||
           share_a_node(all[static_cast<std::size_t>(i)], all[static_cast<std::size_t>(j)]);
  };
  if (!near(edges.master, a.master, b.master) || !near(edges.slave, a.slave, b.slave)) return false;
  const double size = std::max({length(edges.master[static_cast<std::size_t>(a.master)], x),
                                length(edges.master[static_cast<std::size_t>(b.master)], x),
                                length(edges.slave[static_cast<std::size_t>(a.slave)], x),
                                length(edges.slave[static_cast<std::size_t>(b.slave)], x)});
  return (a.place - b.place).norm() <= 2 * overhang_limit * size;
}

/// Of edge-edge contacts at the common place of neighbouring edges the one that lies least beyond
/// its ends stays, then the first.
void drop_doubles(const EdgeContact& edges, std::span<const Vec3> x,
                  std::vector<EdgeEdgePoint>& all) {
  std::vector<EdgeEdgePoint> kept;
  for (const EdgeEdgePoint& c : all) {
    const auto rival = std::find_if(kept.begin(), kept.end(), [&](const EdgeEdgePoint& k) {
      return same_place(edges, k, c, x);
    });
    if (rival == kept.end())
      kept.push_back(c);
    else if (c.overhang < rival->overhang)
      *rival = c;
  }
  all = std::move(kept);
}

}  // namespace

std::vector<SharpEdge> sharp_edges(const FacetSurface& surface, std::span<const Vec3> x,
                                   double angle, Bend bend) {
  std::vector<SharpEdge> out;
  for (std::size_t f = 0; f < surface.facets.size(); ++f)
    for (int e = 0; e < edge_count(surface.facets[f]); ++e) {
      const Index other = surface.facets[f].neighbour[static_cast<std::size_t>(e)];
      if (other <= static_cast<Index>(f)) continue;  // open, or already seen from the other side
      const SharpEdge edge = edge_of(surface, f, e);
      const Vec3 a = side_normal(surface, edge, 0, 0, x), b = side_normal(surface, edge, 1, 0, x);
      const double rise = b.dot(a.cross(tangent(edge, 0, x)));  // < 0: a falls away from b
      const bool bends = bend == Bend::convex ? rise < 0 : rise > 0;
      if (bends && std::atan2(a.cross(b).norm(), a.dot(b)) > angle) out.push_back(edge);
    }
  return out;
}

void prepare_edges(EdgeContact& edges, const FacetSurface& master, const SlaveSide<3>& slave,
                   const std::vector<double>& areas, std::span<const Vec3> reference) {
  edges.master = sharp_edges(master, reference, edges.angle);
  edges.slave = sharp_edges(slave.boundary, reference, edges.angle);
  edges.areas.clear();
  edges.slave_nodes.clear();
  edges.longest = 0;
  for (const auto* list : {&edges.master, &edges.slave})
    for (const SharpEdge& edge : *list)
      edges.longest = std::max(edges.longest, length(edge, reference));
  std::unordered_map<Index, int> slot;
  for (std::size_t i = 0; i < slave.nodes.size(); ++i) slot[slave.nodes[i]] = static_cast<int>(i);
  for (const SharpEdge& edge : edges.slave) {
    std::array<int, 3> places{-1, -1, -1};
    for (std::size_t k = 0; k < static_cast<std::size_t>(edge.count); ++k)
      places[k] = slot.at(edge.nodes[k]);
    edges.slave_nodes.push_back(places);
    edges.areas.push_back(0.5 * (areas[static_cast<std::size_t>(places[0])] +
                                 areas[static_cast<std::size_t>(places[1])]));
  }
}

void find_crossings(const EdgeContact& edges, const FacetSurface& master, const FacetSurface& slave,
                    std::span<const Vec3> x, const std::vector<bool>& held, EdgeBuffers& out) {
  const bool fresh = out.boxes.size() != edges.master.size();
  out.boxes.clear();
  for (const SharpEdge& edge : edges.master) out.boxes.push_back(box_of(edge, x));
  if (fresh)
    out.tree = Tree<3>(out.boxes);
  else
    out.tree.refit(out.boxes);
  out.found.clear();
  for (std::size_t s = 0; s < edges.slave.size(); ++s) {
    if (held[s]) continue;
    search::Box<3> box = box_of(edges.slave[s], x);
    box.inflate(edges.longest);
    out.tree.for_each_overlap(box, [&](Index m) {
      EdgeEdgePoint c;
      c.slave = static_cast<Index>(s);
      c.master = m;
      if (cross(edges, master, slave, x, c)) out.found.push_back(c);
    });
  }
  std::sort(out.found.begin(), out.found.end(), [](const EdgeEdgePoint& a, const EdgeEdgePoint& b) {
    return a.slave != b.slave ? a.slave < b.slave : a.master < b.master;
  });
  drop_doubles(edges, x, out.found);
}

SurfaceFacet edge_contact_facet(const SharpEdge& master, const SharpEdge& slave, bool flipped) {
  SurfaceFacet facet;
  facet.difference = {master.count, slave.count};
  facet.flipped = flipped;
  facet.count = master.count + slave.count;
  std::copy_n(master.nodes.begin(), master.count, facet.nodes.begin());
  std::copy_n(slave.nodes.begin(), slave.count, facet.nodes.begin() + master.count);
  return facet;
}

ProjectedPoint<3> project_edge_edge(const SurfaceFacet& difference, Index facet, const Vec2& xi,
                                    std::span<const Vec3> x) {
  ProjectedPoint<3> projected;
  projected.projection.feature = projection::Feature::edge;
  projected.projection.facet = facet;
  projected.projection.xi = xi;
  const cell::FacetShape shape = facet_shape(difference, xi);
  const geometry::SurfaceJet jet = facet_jet(difference, shape, x);
  projected.foot = jet.r;
  projected.count = difference.count;
  for (std::size_t s = 0; s < contact::slots<3>; ++s) projected.shape[s] = shape.n[s];
  projected.kinematics = contact::face_kinematics(jet, Vec3::Zero());
  projected.kinematics.feature = projection::Feature::edge;
  return projected;
}

Vec3 edge_position(const SharpEdge& edge, double xi, std::span<const Vec3> x) {
  const cell::LineShape shape = cell::lagrange_line(edge.count, xi);
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < static_cast<std::size_t>(edge.count); ++k)
    sum += shape.n[0][k] * at(x, edge.nodes[k]);
  return sum;
}

int history_of_crossing(const EdgeContact& edges, std::span<const PointHistory<3>> histories,
                        const std::vector<EdgeEdgePoint>& all, const EdgeEdgePoint& found) {
  const auto is = [](const PointHistory<3>& h, const EdgeEdgePoint& c) {
    return h.edge == c.slave && h.facet == c.master;
  };
  for (std::size_t i = 0; i < histories.size(); ++i)
    if (is(histories[i], found)) return static_cast<int>(i);
  const auto near = [](const std::vector<SharpEdge>& list, Index i, Index j) {
    return i == j ||
           share_a_node(list[static_cast<std::size_t>(i)], list[static_cast<std::size_t>(j)]);
  };
  for (std::size_t i = 0; i < histories.size(); ++i) {
    const PointHistory<3>& h = histories[i];
    if (!near(edges.slave, h.edge, found.slave) || !near(edges.master, h.facet, found.master))
      continue;
    if (std::none_of(all.begin(), all.end(), [&](const EdgeEdgePoint& c) { return is(h, c); }))
      return static_cast<int>(i);
  }
  return -1;
}

}  // namespace osculate::pairing
