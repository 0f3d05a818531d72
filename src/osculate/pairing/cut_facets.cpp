#include "osculate/pairing/cut_facets.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <limits>

#include "osculate/pairing/candidate_tree.hpp"
#include "osculate/pairing/closest.hpp"
#include "osculate/pairing/mortar_clip.hpp"

namespace osculate::pairing {
namespace {

/// Of the size of a facet: what is no wider has no points.
constexpr double narrow = 1e-4;

std::vector<Index> corner_nodes(const Facet& facet) { return {facet.nodes[0], facet.nodes[1]}; }
std::vector<Index> corner_nodes(const SurfaceFacet& facet) {
  return {facet.nodes.begin(), facet.nodes.begin() + edge_count(facet)};
}

template <int Dim>
std::vector<Vec<Dim>> corners_of(const std::vector<Index>& nodes, std::span<const Vec<Dim>> x) {
  std::vector<Vec<Dim>> corners;
  for (const Index n : nodes) corners.push_back(x[static_cast<std::size_t>(n)]);
  return corners;
}

template <int Dim>
search::Box<Dim> box_of(const std::vector<Vec<Dim>>& corners) {
  search::Box<Dim> box;
  for (const Vec<Dim>& corner : corners) box.extend(corner);
  return box;
}

/// Whether all corners lie farther from the plane through `middle` than `reach`, on one side.
template <int Dim>
bool out_of_reach(const std::vector<Vec<Dim>>& corners, const Vec<Dim>& middle,
                  const Vec<Dim>& normal, double reach) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec<Dim>& corner : corners) {
    const double height = (corner - middle).dot(normal);
    low = std::min(low, height);
    high = std::max(high, height);
  }
  return low > reach || high < -reach;
}

/// Adds the places of a line's ends on another one, 0 to 1 along it.
class LineCuts {
 public:
  LineCuts(const Vec2& from, const Vec2& to) : from_(from), way_(to - from) {}
  void add(const Vec2& point) {
    const double s = (point - from_).dot(way_) / way_.squaredNorm();
    if (s > narrow && s < 1 - narrow) at_.push_back(s);
  }
  [[nodiscard]] std::vector<CellPart<2>> parts() {
    if (at_.empty()) return {};
    std::ranges::sort(at_);
    at_.push_back(1);
    std::vector<CellPart<2>> parts;
    double from = 0;
    for (const double to : at_) {
      if (to - from < narrow) continue;
      parts.push_back({2, {Vec<1>(2 * from - 1), Vec<1>(2 * to - 1)}});
      from = to;
    }
    parts.back().corners[1] = Vec<1>(1.0);
    return parts;
  }

 private:
  Vec2 from_, way_;
  std::vector<double> at_;
};

using Flat = Polygon<double>;

/// The plane of a facet, with the outline of its straight edges.
struct FacetPlane {
  Vec3 middle = Vec3::Zero(), e1, e2, normal;
  Flat outline;

  explicit FacetPlane(const std::vector<Vec3>& corners) {
    for (const Vec3& corner : corners) middle += corner / static_cast<double>(corners.size());
    const bool triangle = corners.size() == 3;
    normal = (triangle ? (corners[1] - corners[0]).cross(corners[2] - corners[0])
                       : (corners[2] - corners[0]).cross(corners[3] - corners[1]))
                 .normalized();
    e1 = (corners[1] - corners[0] - normal * normal.dot(corners[1] - corners[0])).normalized();
    e2 = normal.cross(e1);
    for (const Vec3& corner : corners) outline.add(flat(corner));
  }
  [[nodiscard]] PlanePoint<double> flat(const Vec3& point) const {
    return {e1.dot(point - middle), e2.dot(point - middle)};
  }
};

bool is_convex(const Flat& p) {
  for (std::size_t k = 0; k < p.count; ++k)
    if (!(cross(p.corners[(k + 1) % p.count] - p.corners[k],
                p.corners[(k + 2) % p.count] - p.corners[(k + 1) % p.count]) > 0))
      return false;  // also where it has no area
  return p.count > 2;
}

/// Of a facet that faces the plane: one, or both its triangles where its outline bends inwards.
std::vector<Flat> outlines_of(const FacetPlane& plane, const std::vector<Vec3>& corners) {
  Flat whole;  // seen from the other side its corners run backwards
  for (auto corner = corners.rbegin(); corner != corners.rend(); ++corner)
    whole.add(plane.flat(*corner));
  if (is_convex(whole)) return {whole};
  std::vector<Flat> triangles;
  for (std::size_t k = 2; k < whole.count; ++k) {
    Flat one;
    for (const std::size_t i : {std::size_t{0}, k - 1, k}) one.add(whole.corners[i]);
    if (is_convex(one)) triangles.push_back(one);
  }
  return triangles;
}

/// What is left of convex parts outside of another one, as convex parts.
void take_away(const Flat& other, double tolerance, std::vector<Flat>& parts) {
  std::vector<Flat> left;
  for (const Flat& part : parts) {
    Flat rest = part, next;
    for (std::size_t k = 0; k < other.count && rest.count > 2; ++k) {
      const PlanePoint<double>&a = other.corners[k], &b = other.corners[(k + 1) % other.count];
      left_part(rest, b, a, tolerance, next);
      if (next.count > 2 && area_of(next) > tolerance * tolerance) left.push_back(next);
      left_part(rest, a, b, tolerance, next);
      rest = next;
    }
  }
  parts = std::move(left);
}

/// Parts of the outline, those over one of the others first; none where it is not cut.
std::vector<Flat> cut(const Flat& outline, const std::vector<Flat>& others) {
  const double whole = area_of(outline), tolerance = narrow * std::sqrt(whole);
  std::vector<Flat> parts, rest{outline};
  double covered = 0;
  for (const Flat& other : others) {
    const Flat part = common_part(outline, other, tolerance);
    if (part.count < 3) continue;
    covered += area_of(part);
    parts.push_back(part);
  }
  constexpr double share = 10 * narrow;
  if (parts.empty() || covered > (1 + share) * whole) return {};
  if (covered > (1 - share) * whole) return parts.size() > 1 ? parts : std::vector<Flat>{};
  for (const Flat& part : std::vector<Flat>(parts)) take_away(part, tolerance, rest);
  parts.insert(parts.end(), rest.begin(), rest.end());
  return parts;
}

/// Place in the reference cell of a point of the outline.
Vec2 place_in_cell(const Flat& outline, const PlanePoint<double>& p) {
  const auto corner = [&](std::size_t k) {
    return Vec2(outline.corners[k].x, outline.corners[k].y);
  };
  const Vec2 point(p.x, p.y);
  Eigen::Matrix2d slope;
  if (outline.count == 3) {
    slope << corner(1) - corner(0), corner(2) - corner(0);
    return slope.inverse() * (point - corner(0));
  }
  const Vec2 a = 0.25 * (corner(0) + corner(1) + corner(2) + corner(3)),
             b = 0.25 * (-corner(0) + corner(1) + corner(2) - corner(3)),
             c = 0.25 * (-corner(0) - corner(1) + corner(2) + corner(3)),
             d = 0.25 * (corner(0) - corner(1) + corner(2) - corner(3));
  Vec2 xi = Vec2::Zero();
  for (int i = 0; i < 20; ++i) {
    slope << b + d * xi[1], c + d * xi[0];
    const Vec2 step = slope.inverse() * (point - a - b * xi[0] - c * xi[1] - d * xi[0] * xi[1]);
    xi += step;
    if (step.norm() < 1e-14) break;
  }
  return xi;
}

/// A convex polygon as quadrilaterals and at most one triangle.
void add_cell_parts(const Flat& outline, const Flat& part, std::vector<CellPart<3>>& out) {
  std::vector<Vec2> at;
  for (std::size_t k = 0; k < part.count; ++k)
    at.push_back(place_in_cell(outline, part.corners[k]));
  for (std::size_t k = 1; k + 1 < at.size(); k += 2) {
    if (k + 2 < at.size())
      out.push_back({4, {at[0], at[k], at[k + 1], at[k + 2]}});
    else
      out.push_back({3, {at[0], at[k], at[k + 1], at[0]}});
  }
}

}  // namespace

template <int Dim>
FacetCutter<Dim>::FacetCutter(const Boundary<Dim>& slave, const Boundary<Dim>& master,
                              std::type_identity_t<std::span<const Vec<Dim>>> x)
    : slave_(slave), master_(master), x_(x) {
  std::vector<search::Box<Dim>> boxes;
  facet_boxes(master, x, boxes);
  tree_ = Tree<Dim>(boxes);
}

template <>
std::vector<CellPart<2>> FacetCutter<2>::parts(Index facet) const {
  const std::vector<Vec2> ends =
      corners_of<2>(corner_nodes(slave_.facets[static_cast<std::size_t>(facet)]), x_);
  const Vec2 way = ends[1] - ends[0], normal = turn(way.normalized());
  LineCuts cuts(ends[0], ends[1]);
  search::Box<2> box = box_of<2>(ends);
  box.inflate(way.norm());
  tree_.for_each_overlap(box, [&](Index m) {
    const Facet& other = master_.facets[static_cast<std::size_t>(m)];
    if (other.shape) return;
    const std::vector<Vec2> theirs = corners_of<2>(corner_nodes(other), x_);
    if (turn((theirs[1] - theirs[0]).normalized()).dot(normal) > facing_cosine) return;
    if (out_of_reach<2>(theirs, ends[0], normal, way.norm())) return;
    for (const Vec2& end : theirs) cuts.add(end);
  });
  return cuts.parts();
}

template <>
std::vector<CellPart<3>> FacetCutter<3>::parts(Index facet) const {
  const std::vector<Vec3> corners =
      corners_of<3>(corner_nodes(slave_.facets[static_cast<std::size_t>(facet)]), x_);
  const FacetPlane plane(corners);
  if (!is_convex(plane.outline)) return {};
  search::Box<3> box = box_of<3>(corners);
  const double size = (box.hi - box.lo).norm();
  box.inflate(size);
  std::vector<Index> near;
  tree_.for_each_overlap(box, [&](Index m) { near.push_back(m); });
  std::ranges::sort(near);
  std::vector<Flat> others;
  for (const Index m : near) {
    const SurfaceFacet& other = master_.facets[static_cast<std::size_t>(m)];
    if (other.shape) continue;
    const std::vector<Vec3> theirs = corners_of<3>(corner_nodes(other), x_);
    if (middle_normal(other, x_).dot(plane.normal) > facing_cosine) continue;
    if (out_of_reach<3>(theirs, plane.middle, plane.normal, size)) continue;
    for (const Flat& outline : outlines_of(plane, theirs)) others.push_back(outline);
  }
  std::vector<CellPart<3>> out;
  for (const Flat& part : cut(plane.outline, others)) add_cell_parts(plane.outline, part, out);
  return out;
}

template class FacetCutter<2>;
template class FacetCutter<3>;

}  // namespace osculate::pairing
