// Generalized projection onto surfaces in space.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "osculate/cell/shape.hpp"
#include "osculate/pairing/closest.hpp"
#include "osculate/pairing/closest_patch.hpp"
#include "osculate/pairing/other_side.hpp"
#include "osculate/projection/facet_hull.hpp"
#include "osculate/projection/point_to_facet.hpp"
#include "osculate/projection/point_to_surface.hpp"

namespace osculate::pairing {
namespace {

using projection::FacetFoot;
using projection::Feature;

const Vec3& node(const SurfaceFacet& facet, std::size_t k, std::span<const Vec3> x) {
  return x[static_cast<std::size_t>(facet.nodes[k])];
}

using FacetNodes = std::array<Vec3, cell::max_facet_nodes>;

std::span<const Vec3> nodes_of(const SurfaceFacet& facet, std::span<const Vec3> x,
                               FacetNodes& buffer) {
  const auto count = facet.patch ? static_cast<std::size_t>(edge_count(facet))  // its corners
                                 : static_cast<std::size_t>(facet.count);
  for (std::size_t k = 0; k < count; ++k) buffer[k] = node(facet, k, x);
  return {buffer.data(), count};
}

FacetFoot foot_on_shape(const SurfaceFacet& facet, std::span<const Vec3> x, const Vec3& point) {
  const Vec3 origin = node(facet, 0, x), arm = point - origin;
  const Vec3 local(arm.dot(node(facet, 1, x) - origin), arm.dot(node(facet, 2, x) - origin),
                   arm.dot(node(facet, 3, x) - origin));
  const projection::SurfaceFoot found = projection::closest_point(*facet.shape, local);
  FacetFoot foot;
  foot.converged = found.converged;
  foot.xi = found.xi;
  foot.squared_distance = found.squared_distance;
  foot.feature = found.at_border ? Feature::edge : Feature::face;
  return foot;
}

/// Mean of the corners.
Vec3 middle_of(const SurfaceFacet& facet, std::span<const Vec3> x) {
  Vec3 sum = Vec3::Zero();
  const int corners = edge_count(facet);
  for (std::size_t k = 0; k < static_cast<std::size_t>(corners); ++k) sum += node(facet, k, x);
  return sum / corners;
}

/// Whether the surface ends for this point behind an edge: nothing is there, or another side.
bool ends_at(const FacetSurface& surface, const SurfaceFacet& facet, int edge,
             std::span<const Vec3> x, const ProjectionQuery<3>& query) {
  const Index other = facet.neighbour[static_cast<std::size_t>(edge)];
  if (other < 0 || query.kept >= 0) return true;
  if (!query.slave_normal && !query.filter) return false;
  const SurfaceFacet& next = surface.facets[static_cast<std::size_t>(other)];
  return ends_between<3>(query, middle_normal(facet, x), middle_normal(next, x),
                         middle_of(next, x) - middle_of(facet, x));
}

/// How far the facet goes on beyond an edge.
double extension_beyond(const FacetSurface& surface, const SurfaceFacet& facet, int edge,
                        std::span<const Vec3> x, const ProjectionQuery<3>& query) {
  if (!ends_at(surface, facet, edge, x, query)) return border_tolerance;
  const bool neighbour = facet.neighbour[static_cast<std::size_t>(edge)] >= 0;
  return query.kept >= 0 && neighbour ? end_extension : query.beyond_open;
}

/// A foot on the border of its facet is let go a little beyond it: by the tolerance of the
/// projection between neighbours (clamped, the slip would stand still there and then jump), by
/// `beyond_open` at open borders (the last node of a surface must not lose contact because its
/// master tilts or stretches a little).
template <class Release>
void release_border(const FacetSurface& surface, const SurfaceFacet& facet, std::span<const Vec3> x,
                    const ProjectionQuery<3>& query, const Release& release, FacetFoot& foot) {
  if (!foot.converged || foot.feature == Feature::face || foot.local < 0) return;
  FacetFoot beyond = foot;
  if (!release(end_extension, beyond)) return;  // nor by less
  double extension = extension_beyond(surface, facet, foot.local, x, query);
  if (foot.feature == Feature::corner) {
    const int edges = edge_count(facet), before = (foot.local + edges - 1) % edges;
    extension = std::max(extension, extension_beyond(surface, facet, before, x, query));
  }
  if (extension == end_extension)
    foot = beyond;
  else
    (void)release(extension, foot);
}

/// Upper bound of what `release_border` may take from the distance of a facet.
double release_room(const SurfaceFacet& facet, std::span<const Vec3> nodes) {
  const auto corners = static_cast<std::size_t>(edge_count(facet));
  const bool curved = nodes.size() > corners;
  double longest = 0;  // squared
  for (std::size_t k = 0; k < corners; ++k) {
    const Vec3 &a = nodes[k], &b = nodes[(k + 1) % corners];
    if (!curved) {
      longest = std::max(longest, (b - a).squaredNorm());
      continue;
    }
    const Vec3 bend = 4 * nodes[corners + k] - 2 * (a + b);  // of the rates 2 (c - a), 2 (b - c)
    longest = std::max({longest, (b - a + bend).squaredNorm(), (b - a - bend).squaredNorm()});
  }
  return 4 * end_extension * std::sqrt(longest);
}

/// The foot on a smooth patch. The search begins at the foot on the facet through its corners.
FacetFoot foot_on_patch(const FacetSurface& surface, const SurfaceFacet& facet,
                        std::span<const Vec3> x, const ProjectionQuery<3>& query) {
  FacetNodes buffer;
  const Vec2 start =
      projection::closest_point(facet.type, nodes_of(facet, x, buffer), query.point).xi;
  GregoryPoints room;
  const GregoryPoints& points = points_of(surface, facet, x, query.patches, room);
  const PatchQuery on_patch{facet.type, points, query.point};
  FacetFoot foot = closest_on_patch(on_patch, start);
  const auto release = [&](double extension, FacetFoot& f) {
    return release_from_patch(on_patch, extension, f);
  };
  release_border(surface, facet, x, query, release, foot);
  return foot;
}

/// The foot, clamped to the facet where it is farther than `limit` anyway.
FacetFoot foot_on_facet(const FacetSurface& surface, const SurfaceFacet& facet,
                        std::span<const Vec3> x, const ProjectionQuery<3>& query,
                        double limit = std::numeric_limits<double>::infinity()) {
  if (facet.shape) return foot_on_shape(facet, x, query.point);
  if (facet.patch) return foot_on_patch(surface, facet, x, query);
  FacetNodes buffer;
  const std::span<const Vec3> nodes = nodes_of(facet, x, buffer);
  const double reached = std::isfinite(limit) ? limit + release_room(facet, nodes) : limit;
  if (facet.count > 3 && std::isfinite(limit))
    if (const double least = projection::least_distance(facet.type, nodes, query.point);
        least > reached) {
      FacetFoot far_away;
      far_away.squared_distance = least * least;
      return far_away;
    }
  FacetFoot foot = projection::closest_point(facet.type, nodes, query.point);
  if (foot.squared_distance > limit * limit &&
      (foot.feature == Feature::face || foot.squared_distance > reached * reached))
    return foot;
  const auto release = [&](double extension, FacetFoot& f) {
    return projection::release(facet.type, nodes, query.point, extension, f);
  };
  release_border(surface, facet, x, query, release, foot);
  return foot;
}

FacetFoot foot_on_edge(const SurfaceFacet& facet, std::span<const Vec3> x, int edge,
                       const Vec3& point) {
  if (facet.patch) return closest_on_patch_edge({facet.type, patch_points(facet, x), point}, edge);
  FacetNodes buffer;
  return projection::closest_point_on_edge(facet.type, nodes_of(facet, x, buffer), edge, point);
}

struct Candidate {
  Index facet = -1;
  FacetFoot foot;
  double distance = std::numeric_limits<double>::infinity();
  double cosine = -1;  ///< of the angle between the normals of facet and slave
};

/// Faces before borders, the facet of the history first, then those that face the slave.
int rank(const Candidate& c, Index history) {
  const int feature = c.foot.feature == Feature::face ? 0 : c.foot.feature == Feature::edge ? 3 : 6;
  return feature + (c.facet == history ? 0 : across(c.cosine) ? 2 : 1);
}

bool better(const Candidate& a, const Candidate& b, Index history, double tie) {
  if (b.facet < 0) return true;
  if (std::abs(a.distance - b.distance) > tie) return a.distance < b.distance;
  const int ra = rank(a, history), rb = rank(b, history);
  return ra != rb ? ra < rb : a.facet < b.facet;
}

double size_of(const SurfaceFacet& facet, std::span<const Vec3> x) {
  return (node(facet, 1, x) - node(facet, 0, x)).norm();
}

void normalize(Vec3& v) {
  if (v.norm() > 0) v.normalize();
}

/// The edge of `facet` that it shares with `other`, -1 if there is none.
int shared_edge(const SurfaceFacet& facet, Index other) {
  for (int e = 0; e < edge_count(facet); ++e)
    if (facet.neighbour[static_cast<std::size_t>(e)] == other) return e;
  return -1;
}

/// Coordinates on the neighbour of the point that edge `edge` of `facet` has at `xi`.
Vec2 across(const SurfaceFacet& facet, int edge, const Vec2& xi, const SurfaceFacet& other) {
  const std::array<int, 2> ends = edge_corners(facet, edge);
  const auto corner = [](const SurfaceFacet& f, int k) { return cell::area_node(f.type, k); };
  const Vec2 from = corner(facet, ends[0]), to = corner(facet, ends[1]);
  const double t = (xi - from).dot(to - from) / (to - from).squaredNorm();
  const auto local = [&](int end) {
    const Index wanted = facet.nodes[static_cast<std::size_t>(end)];
    int k = 0;
    while (k + 1 < edge_count(other) && other.nodes[static_cast<std::size_t>(k)] != wanted) ++k;
    return corner(other, k);
  };
  return (1 - t) * local(ends[0]) + t * local(ends[1]);
}

void resolve_edge(const FacetSurface& surface, std::span<const Vec3> x,
                  const ProjectionQuery<3>& query, Projection<3>& p) {
  const SurfaceFacet& facet = surface.facets[static_cast<std::size_t>(p.facet)];
  p.outward = facet_normal(facet, p.xi, x);
  if (facet.shape || p.local < 0 || ends_at(surface, facet, p.local, x, query)) {
    p.beyond_end = true;
    return;
  }
  const SurfaceFacet& other =
      surface.facets[static_cast<std::size_t>(facet.neighbour[static_cast<std::size_t>(p.local)])];
  p.outward += facet_normal(other, across(facet, p.local, p.xi, other), x);
  normalize(p.outward);
}

/// Angle between the two edges of a facet that meet in its corner `k`.
double corner_angle(const SurfaceFacet& facet, int k, std::span<const Vec3> x) {
  const int edges = edge_count(facet);
  const Vec2 at = cell::area_node(facet.type, k);
  const geometry::SurfaceJet jet = facet_jet(facet, at, x);
  const auto towards = [&](int end) {
    const Vec2 e = cell::area_node(facet.type, end) - at;
    return Vec3(e.x() * jet.r1[0] + e.y() * jet.r1[1]);
  };
  const Vec3 a = towards((k + 1) % edges), b = towards((k + edges - 1) % edges);
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// The normals that meet in a corner count by the angle of their facets there: so the sign of the
/// gap is right at every corner, however its faces are cut into facets.
///
/// Source     Baerentzen2005
/// Tested by  tests/unit/pairing/test_closest3.cpp
void resolve_corner(const FacetSurface& surface, std::span<const Vec3> x,
                    const ProjectionQuery<3>& query, Projection<3>& p) {
  const SurfaceFacet& facet = surface.facets[static_cast<std::size_t>(p.facet)];
  const Index vertex = facet.nodes[static_cast<std::size_t>(p.local)];
  p.outward.setZero();
  for (const Index f : surface.facets_at.at(vertex)) {
    const SurfaceFacet& other = surface.facets[static_cast<std::size_t>(f)];
    const int edges = edge_count(other);
    for (int k = 0; k < edges; ++k) {
      if (other.nodes[static_cast<std::size_t>(k)] != vertex) continue;
      p.outward +=
          corner_angle(other, k, x) * facet_normal(other, cell::area_node(other.type, k), x);
      if (ends_at(surface, other, k, x, query) ||
          ends_at(surface, other, (k + edges - 1) % edges, x, query))
        p.beyond_end = true;
    }
  }
  normalize(p.outward);
}

/// Two different foot points inside their facets, equally far away.
bool equidistant(const FacetSurface& surface, std::span<const Vec3> x, const Candidate& best,
                 const Candidate& tied) {
  if (tied.facet < 0 || best.foot.feature != Feature::face || tied.foot.feature != Feature::face)
    return false;
  const SurfaceFacet& a = surface.facets[static_cast<std::size_t>(best.facet)];
  const SurfaceFacet& b = surface.facets[static_cast<std::size_t>(tied.facet)];
  const double apart = (facet_jet(a, best.foot.xi, x).r - facet_jet(b, tied.foot.xi, x).r).norm();
  return best.distance > 1e-10 * size_of(a, x) && apart > 1e-6 * best.distance &&
         std::abs(tied.distance - best.distance) <= 1e-10 * best.distance;
}

/// Two neighbours at the same distance and no history to choose: the edge between them, at the
/// point nearest to the slave.
void share(const FacetSurface& surface, std::span<const Vec3> x, Index other,
           const ProjectionQuery<3>& query, Projection<3>& p) {
  const SurfaceFacet& facet = surface.facets[static_cast<std::size_t>(p.facet)];
  const int edge = facet.shape ? -1 : shared_edge(facet, other);
  if (edge < 0) return;
  const FacetFoot foot = foot_on_edge(facet, x, edge, query.point);
  if (!foot.converged || foot.feature != Feature::edge) return;
  p.feature = Feature::edge;
  p.local = edge;
  p.xi = foot.xi;
  p.distance = std::sqrt(foot.squared_distance);
  resolve_edge(surface, x, query, p);
}

/// Of the angle between the normals of facet and slave; -1 where the slave's does not matter. A
/// facet that faces the same way as the slave is the far side of a thin body.
double cosine_at(const FacetSurface& surface, const SurfaceFacet& facet, const FacetFoot& foot,
                 std::span<const Vec3> x, const ProjectionQuery<3>& query) {
  if (!query.slave_normal) return -1;
  return facet_normal(surface, facet, foot.xi, x, query.patches).dot(*query.slave_normal);
}

/// What `entered_through` asks of a candidate.
struct Look {
  const FacetSurface& surface;
  std::span<const Vec3> x;
  const ProjectionQuery<3>& query;

  [[nodiscard]] const SurfaceFacet& facet(Index f) const {
    return surface.facets[static_cast<std::size_t>(f)];
  }
  [[nodiscard]] Candidate on(Index f) const {
    const FacetFoot foot = foot_on_facet(surface, facet(f), x, query);
    return {f, foot, std::sqrt(foot.squared_distance),
            cosine_at(surface, facet(f), foot, x, query)};
  }
  [[nodiscard]] bool inside(const Candidate& c) const {
    return c.foot.converged && c.foot.feature == Feature::face &&
           (!query.filter || admits(*query.filter, facet(c.facet), c.foot.xi, x));
  }
  [[nodiscard]] double gap(const Candidate& c) const {
    return (query.point - facet_jet(facet(c.facet), c.foot.xi, x).r)
        .dot(facet_normal(facet(c.facet), c.foot.xi, x));
  }
};

/// The foot on the facet that the point keeps, if it is still there.
Projection<3> on_kept_facet(const FacetSurface& surface, std::span<const Vec3> x,
                            const ProjectionQuery<3>& query) {
  Projection<3> p;
  const SurfaceFacet& facet = surface.facets[static_cast<std::size_t>(query.kept)];
  const FacetFoot foot = foot_on_facet(surface, facet, x, query);
  if (!foot.converged || foot.feature != Feature::face ||
      cosine_at(surface, facet, foot, x, query) > same_way_cosine)
    return p;
  p.feature = Feature::face;
  p.facet = query.kept;
  p.xi = foot.xi;
  p.distance = std::sqrt(foot.squared_distance);
  return p;
}

/// A quadratic facet lies in the hull of its control points.
void extend_by_control_points(const SurfaceFacet& facet, std::span<const Vec3> x,
                              search::Box<3>& box) {
  FacetNodes buffer;
  std::array<Vec3, 9> points;
  const int count = projection::control_points(facet.type, nodes_of(facet, x, buffer), points);
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) box.extend(points[k]);
}

}  // namespace

void facet_boxes(const FacetSurface& surface, std::span<const Vec3> x,
                 std::vector<search::Box<3>>& boxes, PatchPoints patches) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  boxes.resize(surface.facets.size());
  for (std::size_t f = 0; f < surface.facets.size(); ++f) {
    const SurfaceFacet& facet = surface.facets[f];
    search::Box<3>& box = boxes[f];
    box = {};
    if (facet.shape) {
      box.lo = Vec3::Constant(-infinite);
      box.hi = Vec3::Constant(infinite);
      continue;
    }
    if (facet.patch) {  // in the hull of its control points
      GregoryPoints room;
      const GregoryPoints& points = points_of(surface, facet, x, patches, room);
      const std::size_t used = cell::is_triangle(facet.type) ? triangle_points : gregory_points;
      for (std::size_t j = 0; j < used; ++j) box.extend(Vec3(points[j].head<3>()));
      continue;
    }
    if (facet.count > 4) {
      extend_by_control_points(facet, x, box);
      continue;
    }
    for (std::size_t k = 0; k < static_cast<std::size_t>(facet.count); ++k)
      box.extend(node(facet, k, x));
  }
}

Projection<3> closest(const FacetSurface& surface, const Tree<3>& tree, std::span<const Vec3> x,
                      const ProjectionQuery<3>& query) {
  if (query.kept >= 0) {
    const Projection<3> kept = on_kept_facet(surface, x, query);
    if (kept.feature != Feature::none) return kept;
    ProjectionQuery<3> any = query;
    any.kept = -1;
    return closest(surface, tree, x, any);
  }
  constexpr double far_away = std::numeric_limits<double>::infinity();
  const double reach = query.filter ? query.filter->distance : far_away;
  Candidate best, tied;
  const auto visit = [&](Index f) {
    const SurfaceFacet& facet = surface.facets[static_cast<std::size_t>(f)];
    if (query.filter && query.filter->skips(f, query.slave_normal)) return far_away;
    if (faces_same_way(query, f)) return far_away;
    const double tie = 1e-10 * size_of(facet, x);
    const double limit = best.distance + tie;
    const FacetFoot foot = foot_on_facet(surface, facet, x, query, limit);
    const double distance = std::sqrt(foot.squared_distance);
    if (distance > limit) return distance;
    const double cosine = cosine_at(surface, facet, foot, x, query);
    if (!foot.converged || cosine > same_way_cosine) return far_away;
    if (query.filter && !admits(*query.filter, facet, foot.xi, x)) return far_away;
    const Candidate candidate{f, foot, distance, cosine};
    const bool wins = better(candidate, best, query.history, tie);
    const Candidate loser = wins ? best : candidate;
    if (loser.facet >= 0 && std::abs(candidate.distance - best.distance) <= tie) tied = loser;
    if (wins) best = candidate;
    return distance;
  };
  const auto wanted = [&](Index branch) {
    if (query.filter) return !query.filter->misses(branch, query.slave_normal);
    return !branch_faces_same_way(query, branch);
  };
  // First where the point was: most others are farther away than that.
  const double tie = 1e-10 * size_of(surface.facets.front(), x);
  double bound = reach;
  if (query.history >= 0) bound = std::min(reach, visit(query.history) + tie);
  const auto visit_other = [&](Index f) { return f == query.history ? far_away : visit(f); };
  tree.for_each_nearest_wanted(query.point, tie, wanted, visit_other, bound);
  Projection<3> p;
  if (best.facet < 0) return p;
  if (query.history >= 0) {
    const SurfaceFacet& last = surface.facets[static_cast<std::size_t>(query.history)];
    best = entered_through(query, best, last.neighbour, Look{surface, x, query});
  }
  p.feature = best.foot.feature;
  p.facet = best.facet;
  p.xi = best.foot.xi;
  p.local = best.foot.local;
  p.distance = best.distance;
  if (p.feature == Feature::edge) resolve_edge(surface, x, query, p);
  if (p.feature == Feature::corner) resolve_corner(surface, x, query, p);
  if (query.shares() && equidistant(surface, x, best, tied))
    share(surface, x, tied.facet, query, p);
  return p;
}

}  // namespace osculate::pairing
