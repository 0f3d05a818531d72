#include "osculate/pairing/candidate_filter.hpp"

#include <algorithm>

#include "osculate/cell/shape.hpp"
#include "osculate/core/error.hpp"
#include "osculate/pairing/closest.hpp"

namespace osculate::pairing {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double across_cosine = 0.5;  ///< 60 degrees
constexpr double apart_ratio = 4;

Vec2 normal_at(const Facet& facet, double xi, std::span<const Vec2> x) {
  const Vec2 tangent = facet_jet(facet, xi, x).r1;
  const double length = tangent.norm();
  return length > 0 ? Vec2(turn(tangent) / length) : Vec2(Vec2::Zero());
}
Vec3 normal_at(const SurfaceFacet& facet, const Vec2& xi, std::span<const Vec3> x) {
  return facet_normal(facet, xi, x);
}

Vec2 point_at(const Facet& facet, double xi, std::span<const Vec2> x) {
  return facet_jet(facet, xi, x).r;
}
Vec3 point_at(const SurfaceFacet& facet, const Vec2& xi, std::span<const Vec3> x) {
  return facet_point(facet, xi, x);
}

double middle_of(const Facet& facet) { return 0.5 * (facet.lo + facet.hi); }
Vec2 middle_of(const SurfaceFacet& facet) {
  return cell::is_triangle(facet.type) ? Vec2(1.0 / 3, 1.0 / 3) : Vec2(Vec2::Zero());
}

/// Largest angle between the normal in the middle and the others: exact for first-order facets
/// (their r_1 x r_2 is linear, so a combination of those at the corners) but for feet a little
/// beyond the border, twice what the nodes show for curved ones.
double spread_of(const Facet& facet, const Vec2& middle, std::span<const Vec2> x) {
  if (facet.straight()) return 0;
  double least = 1;
  for (const double xi : {-1.0, 1.0}) least = std::min(least, normal_at(facet, xi, x).dot(middle));
  return 2 * std::acos(std::max(least, -1.0));
}
double spread_of(const SurfaceFacet& facet, const Vec3& middle, std::span<const Vec3> x) {
  if (facet.type == cell::CellType::tri3 && !facet.patch) return 0;
  double least = 1;
  for (int k = 0; k < std::min(facet.count, cell::info(facet.type).nodes); ++k)
    least = std::min(least, normal_at(facet, cell::area_node(facet.type, k), x).dot(middle));
  constexpr double rounding = 1e-14;
  if (least > 1 - rounding) return std::sqrt(8 * rounding);
  return (facet.count > 4 || facet.patch ? 2 : 1.2) * std::acos(std::max(least, -1.0));
}

bool is_smooth(const Facet& facet) { return facet.bezier != nullptr; }
bool is_smooth(const SurfaceFacet& facet) { return facet.patch != nullptr; }

template <int Dim, class FacetType>
FacetOutline<Dim> outline(const FacetType& facet, std::span<const Vec<Dim>> x) {
  FacetOutline<Dim> out{Vec<Dim>::Zero(), Vec<Dim>::Zero(), infinite};
  if (facet.shape) return out;
  out.middle = point_at(facet, middle_of(facet), x);
  out.normal = middle_normal(facet, x);
  out.bulge = 0;
  double arms = 0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(facet.count); ++k) {
    const Vec<Dim> arm = x[static_cast<std::size_t>(facet.nodes[k])] - out.middle;
    out.bulge = std::max(out.bulge, std::abs(arm.dot(out.normal)));
    arms = std::max(arms, arm.norm());
  }
  out.overhang = (facet.count > (Dim == 2 ? 2 : 4) || is_smooth(facet) ? 1 : 0.2) * arms;
  out.radius = arms + out.overhang;
  out.spread = spread_of(facet, out.normal, x);
  out.facing = product_within(facing_cosine, out.spread);
  out.same_way = product_within(same_way_cosine, out.spread);
  return out;
}

/// Every node once for each of its facets.
template <int Dim>
void set_parts(const SlaveSide<Dim>& slave, CandidateFilter<Dim>& filter) {
  filter.parts = {};
  filter.parts.boundary = slave.boundary;
  filter.first.assign(1, 0);
  for (std::size_t i = 0; i < slave.nodes.size(); ++i) {
    for (const Index f : slave.facets_of[i]) {
      filter.parts.nodes.push_back(slave.nodes[i]);
      filter.parts.facets_of.push_back({f});
    }
    filter.first.push_back(filter.parts.nodes.size());
  }
}

template <int Dim>
bool same_facets(const Boundary<Dim>& a, const Boundary<Dim>& b) {
  return std::equal(a.facets.begin(), a.facets.end(), b.facets.begin(), b.facets.end(),
                    [](const auto& f, const auto& g) {
                      return f.count == g.count && f.nodes == g.nodes && !f.shape && !g.shape;
                    });
}

template <int Dim>
std::span<const Vec<Dim>> normals_of(const CandidateFilter<Dim>& filter,
                                     const FilterBuffers<Dim>& buffers, std::size_t i) {
  const std::size_t first = filter.first[i];
  return std::span(buffers.normals).subspan(first, filter.first[i + 1] - first);
}

/// How far the body reaches behind each slave node.
template <int Dim>
void measure(CandidateFilter<Dim>& filter, const SlaveSide<Dim>& slave,
             std::span<const Vec<Dim>> x) {
  filter.thickness.assign(slave.nodes.size(), infinite);
  if (slave.boundary.facets.empty()) return;
  FilterBuffers<Dim> buffers;
  for (const auto& facet : slave.boundary.facets) buffers.outlines.push_back(outline(facet, x));
  nodal_normals(filter.parts, x, buffers.normals);
  std::vector<search::Box<Dim>> boxes;
  facet_boxes(slave.boundary, x, boxes);
  Tree<Dim> tree;
  plant(buffers.outlines, boxes, filter.distance, tree, buffers.branches);
  for (std::size_t i = 0; i < slave.nodes.size(); ++i) {
    NodeFilter<Dim> rules;
    rules.point = x[static_cast<std::size_t>(slave.nodes[i])];
    rules.distance = 2 * filter.distance;
    rules.outlines = buffers.outlines;
    rules.branches = buffers.branches;
    rules.facets = slave.facets_of[i];
    rules.facing = normals_of(filter, buffers, i);
    rules.behind = true;
    if (rules.facing.empty()) continue;
    ProjectionQuery<Dim> query;
    query.point = rules.point;
    query.filter = &rules;
    filter.thickness[i] = closest(slave.boundary, tree, x, query).distance;
  }
}

/// Places that a node never faced may be so far in front of it.
constexpr double depth_in_distance = 0.25;
/// And so far if they are on an edge or a vertex: behind a surface the nearest place is on a face,
/// unless the rules have taken the faces out.
constexpr double edge_depth_in_distance = 0.03;

/// Places farther than the depth are straight in front of the node: others are feet at a vertex,
/// which has the last word on the sign, ...
constexpr double straight = 0.9;
/// ... or nearer to the last place than this part of the node's distance from it.
constexpr double near_last = 0.9;

/// A place is on a face, not an edge or a vertex, if it is so straight before or behind the node.
constexpr double along = 0.999;

/// `admits` for both dimensions.
template <int Dim, class FacetType, class Coordinates>
bool admitted(const NodeFilter<Dim>& rules, const FacetType& facet, const Coordinates& xi,
              std::span<const Vec<Dim>> x) {
  const Vec<Dim> foot = point_at(facet, xi, x);
  const Vec<Dim> normal = normal_at(facet, xi, x);
  const auto faces = [&](const Vec<Dim>& n) { return n.dot(normal) < facing_cosine; };
  if (!rules.facing.empty() && std::none_of(rules.facing.begin(), rules.facing.end(), faces))
    return false;
  const Vec<Dim> arm = rules.point - foot;
  const double distance = arm.norm();
  const double gap = arm.dot(normal);
  if (!rules.facing.empty() && std::abs(gap) < across_cosine * distance) return false;
  if (rules.behind) return gap < 0;
  const bool on_face = std::abs(gap) >= along * distance;
  if (!facet.shape && !on_face && gap < 0 && distance > rules.edge_depth) return false;
  if (gap >= straight * distance) return true;
  if (!facet.shape && distance > rules.depth) {
    if (!rules.last ||
        !((foot - *rules.last).norm() < near_last * (rules.point - *rules.last).norm()))
      return false;
  }
  if (rules.reference.empty()) return true;
  const Vec<Dim> before = rules.home - point_at(facet, xi, rules.reference);
  const double height = before.dot(normal_at(facet, xi, rules.reference));
  const double size = (rules.reference[static_cast<std::size_t>(facet.nodes[1])] -
                       rules.reference[static_cast<std::size_t>(facet.nodes[0])])
                          .norm();
  const bool was_in_front = height > 1e-6 * size;
  return was_in_front || before.norm() >= apart_ratio * distance;
}

}  // namespace

Vec2 middle_normal(const Facet& facet, std::span<const Vec2> x) {
  return normal_at(facet, middle_of(facet), x);
}
Vec3 middle_normal(const SurfaceFacet& facet, std::span<const Vec3> x) {
  return normal_at(facet, middle_of(facet), x);
}

template <int Dim>
void prepare(CandidateFilter<Dim>& filter, const Boundary<Dim>& master, const SlaveSide<Dim>& slave,
             std::type_identity_t<std::span<const Vec<Dim>>> reference, const AreaRule& rule) {
  if (!filter.limited()) return;
  if (filter.own && !same_facets<Dim>(master, slave.boundary))
    throw core::GeometryError("self-contact needs the same facets as master and slave");
  set_parts(slave, filter);
  nodal_areas(filter.parts, reference, rule, filter.areas, nullptr);
  if (filter.own) filter.reference.assign(reference.begin(), reference.end());
  if (filter.thickness.size() != slave.nodes.size()) measure<Dim>(filter, slave, reference);
}

template <int Dim>
void refresh(const CandidateFilter<Dim>& filter, const Boundary<Dim>& master,
             std::type_identity_t<std::span<const Vec<Dim>>> x,
             const std::vector<search::Box<Dim>>& boxes, bool moved, FilterBuffers<Dim>& buffers,
             Tree<Dim>& tree) {
  if (!filter.limited()) return;
  nodal_normals(filter.parts, x, buffers.normals);
  if (!moved) return;
  buffers.outlines.clear();
  for (const auto& facet : master.facets) buffers.outlines.push_back(outline(facet, x));
  plant(buffers.outlines, boxes, filter.distance, tree, buffers.branches);
}

template <int Dim>
void mean_normals(const CandidateFilter<Dim>& filter, const FilterBuffers<Dim>& buffers,
                  std::vector<Vec<Dim>>& normals) {
  normals.assign(filter.first.size() - 1, Vec<Dim>::Zero());
  for (std::size_t i = 0; i < normals.size(); ++i) {
    for (const Vec<Dim>& n : normals_of(filter, buffers, i)) normals[i] += n;
    if (normals[i].norm() > 1e-12) normals[i].normalize();
  }
}

template <int Dim>
bool NodeFilter<Dim>::too_slanted(double highest, double nearest, double from_last) const {
  constexpr double rounding = 1e-9;
  if (behind || nearest * (1 - rounding) <= depth) return false;
  if (highest >= straight * (1 - rounding) * nearest) return false;
  return !last || from_last * (1 - rounding) >= near_last * (point - *last).norm();
}

template <int Dim>
bool NodeFilter<Dim>::beside_and_behind(double lowest, double highest, double nearest) const {
  constexpr double rounding = 1e-9;
  nearest *= 1 - rounding;
  return highest < 0 && nearest > edge_depth && lowest > -along * nearest;
}

template <int Dim>
bool NodeFilter<Dim>::skips(Index facet, const std::optional<Vec<Dim>>& slave_normal) const {
  if (std::find(facets.begin(), facets.end(), facet) != facets.end()) return true;
  const FacetOutline<Dim>& o = outlines[static_cast<std::size_t>(facet)];
  if (std::isinf(o.bulge)) return false;
  const auto may_face = [&](const Vec<Dim>& n) { return n.dot(o.normal) <= o.facing; };
  if (!facing.empty() && std::none_of(facing.begin(), facing.end(), may_face)) return true;
  if (slave_normal && slave_normal->dot(o.normal) > o.same_way) return true;
  const Vec<Dim> arm = point - o.middle;
  const double height = arm.dot(o.normal), distance = arm.norm();
  if (behind) return height > 2 * o.bulge;
  if (height < -(deepest() + 2 * o.bulge)) return true;
  const double room = 2 * o.bulge + o.spread * (distance + o.radius);
  const double nearest = distance - o.radius;
  return beside_and_behind(height - room, height + room, nearest) ||
         too_slanted(height + room, nearest, last ? (*last - o.middle).norm() - o.radius : 0.0);
}

template <int Dim>
bool NodeFilter<Dim>::misses(Index branch, const std::optional<Vec<Dim>>& slave_normal) const {
  if (branches.empty()) return false;
  const BranchOutline<Dim>& b = branches[static_cast<std::size_t>(branch)];
  if (std::isinf(b.bulge)) return false;
  if (slave_normal && slave_normal->dot(b.axis) > b.same_way) return true;
  const auto may_face = [&](const Vec<Dim>& n) { return n.dot(b.axis) <= b.facing; };
  if (!facing.empty() && std::none_of(facing.begin(), facing.end(), may_face)) return true;
  if (behind) return false;
  if (b.across > 0.5 * distance) return false;  // too large for what follows to pay
  const double highest = b.highest(point);
  if (highest < -(deepest() + 2 * b.bulge)) return true;
  return too_slanted(highest + 2 * b.bulge + b.overhang, b.nearest(point),
                     last ? b.nearest(*last) : 0.0);
}

bool admits(const NodeFilter<2>& rules, const Facet& facet, double xi, std::span<const Vec2> x) {
  return admitted<2>(rules, facet, xi, x);
}
bool admits(const NodeFilter<3>& rules, const SurfaceFacet& facet, const Vec2& xi,
            std::span<const Vec3> x) {
  return admitted<3>(rules, facet, xi, x);
}

template <int Dim>
NodeFilter<Dim> node_filter(const CandidateFilter<Dim>& filter, const SlaveSide<Dim>& slave,
                            const FilterBuffers<Dim>& buffers, std::size_t i,
                            const Vec<Dim>& point) {
  NodeFilter<Dim> rules;
  rules.point = point;
  rules.distance = filter.distance;
  rules.depth = std::min(0.5 * filter.thickness[i], depth_in_distance * filter.distance);
  rules.edge_depth = edge_depth_in_distance * filter.distance;
  rules.outlines = buffers.outlines;
  rules.branches = buffers.branches;
  if (!filter.own) return rules;
  rules.facing = normals_of(filter, buffers, i);
  rules.facets = slave.facets_of[i];
  rules.reference = filter.reference;
  rules.home = filter.reference[static_cast<std::size_t>(slave.nodes[i])];
  return rules;
}

template void prepare<2>(CandidateFilter<2>&, const Boundary<2>&, const SlaveSide<2>&,
                         std::span<const Vec2>, const AreaRule&);
template void prepare<3>(CandidateFilter<3>&, const Boundary<3>&, const SlaveSide<3>&,
                         std::span<const Vec3>, const AreaRule&);
template void refresh<2>(const CandidateFilter<2>&, const Boundary<2>&, std::span<const Vec2>,
                         const std::vector<search::Box<2>>&, bool, FilterBuffers<2>&, Tree<2>&);
template void refresh<3>(const CandidateFilter<3>&, const Boundary<3>&, std::span<const Vec3>,
                         const std::vector<search::Box<3>>&, bool, FilterBuffers<3>&, Tree<3>&);
template void mean_normals<2>(const CandidateFilter<2>&, const FilterBuffers<2>&,
                              std::vector<Vec2>&);
template void mean_normals<3>(const CandidateFilter<3>&, const FilterBuffers<3>&,
                              std::vector<Vec3>&);
template struct NodeFilter<2>;
template struct NodeFilter<3>;
template NodeFilter<2> node_filter<2>(const CandidateFilter<2>&, const SlaveSide<2>&,
                                      const FilterBuffers<2>&, std::size_t, const Vec2&);
template NodeFilter<3> node_filter<3>(const CandidateFilter<3>&, const SlaveSide<3>&,
                                      const FilterBuffers<3>&, std::size_t, const Vec3&);

}  // namespace osculate::pairing
