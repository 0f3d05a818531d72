#include "osculate/projection/composed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "osculate/core/error.hpp"
#include "osculate/geometry/curve_frame.hpp"
#include "osculate/geometry/point_class.hpp"
#include "osculate/projection/point_to_curve.hpp"
#include "osculate/projection/point_to_facet.hpp"
#include "osculate/projection/point_to_surface.hpp"

namespace osculate::projection {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

template <int Dim>
std::size_t check_facet(const FacetMesh<Dim>& mesh, std::size_t f) {
  const MeshFacet& facet = mesh.facets[f];
  const cell::CellInfo& info = cell::info(facet.type);
  if (info.dimension != Dim - 1)
    throw core::InputError({}, fmt::format("facet {}: {} is no facet of a {}", f, info.name,
                                           Dim == 2 ? "plane curve" : "surface"));
  const auto count = static_cast<std::size_t>(info.nodes);
  for (std::size_t k = 0; k < count; ++k) {
    const Index n = facet.nodes[k];
    if (n < 0 || at(n) >= mesh.nodes.size())
      throw core::InputError({}, fmt::format("facet {}: there is no node {}", f, n));
    if (!mesh.nodes[at(n)].allFinite())
      throw core::InputError({}, fmt::format("node {}: expected finite coordinates", n));
  }
  return count;
}

geometry::LagrangeCurve facet_curve(const FacetMesh<2>& mesh, std::size_t f) {
  const MeshFacet& facet = mesh.facets[f];
  std::array<Vec2, cell::max_line_nodes> nodes;
  const auto count = static_cast<std::size_t>(cell::info(facet.type).nodes);
  for (std::size_t k = 0; k < count; ++k) nodes[k] = mesh.nodes[at(facet.nodes[k])];
  return geometry::lagrange_curve(std::span<const Vec2>(nodes.data(), count));
}

geometry::LagrangeSurface facet_surface(const FacetMesh<3>& mesh, std::size_t f) {
  const MeshFacet& facet = mesh.facets[f];
  std::array<Vec3, cell::max_facet_nodes> nodes;
  const auto count = static_cast<std::size_t>(cell::info(facet.type).nodes);
  for (std::size_t k = 0; k < count; ++k) nodes[k] = mesh.nodes[at(facet.nodes[k])];
  return geometry::lagrange_surface(facet.type, std::span<const Vec3>(nodes.data(), count));
}

/// Non-empty spans of a knot vector.
std::vector<Index> spans_of(const std::vector<double>& knots, int degree, std::size_t control) {
  std::vector<Index> spans;
  for (std::size_t i = at(degree); i < control; ++i)
    if (knots[i + 1] > knots[i]) spans.push_back(static_cast<Index>(i));
  return spans;
}

/// Ranges of analytic surfaces: infinite ones are cut to about the size of the shape.
std::vector<SmoothPiece> charts(const geometry::Surface& surface) {
  if (std::holds_alternative<geometry::Sphere>(surface)) {
    constexpr double shift = geometry::Sphere::chart_shift;
    return {{Vec2(-1, -1), Vec2(1, 1)}, {Vec2(shift - 1, -1), Vec2(shift + 1, 1)}};
  }
  SmoothPiece piece{geometry::lo(surface), geometry::hi(surface)};
  double length = 1;
  if (const auto* c = std::get_if<geometry::Cylinder>(&surface)) length = c->radius;
  if (const auto* c = std::get_if<geometry::Cone>(&surface)) length = c->from > 0 ? c->from : 1.0;
  for (Eigen::Index i = 0; i < 2; ++i) {
    if (!std::isfinite(piece.lo[i])) piece.lo[i] = -length;
    if (!std::isfinite(piece.hi[i])) piece.hi[i] = std::max(piece.lo[i], 0.0) + length;
  }
  if (const auto* facet = std::get_if<geometry::LagrangeSurface>(&surface))
    piece.triangle = cell::is_triangle(facet->type);
  return {piece};
}

/// Sides of an analytic surface that are borders.
std::vector<int> open_sides(const geometry::Surface& surface, const SmoothPiece& piece) {
  if (std::holds_alternative<geometry::Sphere>(surface)) return {};
  const Vec2 lo = geometry::lo(surface), hi = geometry::hi(surface);
  const geometry::ClosedFlags closed = geometry::closed(surface);
  if (piece.triangle) return {0, 1, 2};
  std::vector<int> sides;
  const auto* cone = std::get_if<geometry::Cone>(&surface);
  const bool apex = cone && cone->from == 0;
  if (!closed[1] && std::isfinite(lo[1]) && !apex) sides.push_back(0);
  if (!closed[0] && std::isfinite(hi[0])) sides.push_back(1);
  if (!closed[1] && std::isfinite(hi[1])) sides.push_back(2);
  if (!closed[0] && std::isfinite(lo[0])) sides.push_back(3);
  return sides;
}

}  // namespace

Vec2 piece_corner(const SmoothPiece& p, int corner) {
  const bool right = corner == 1 || (corner == 2 && !p.triangle);
  return {right ? p.hi.x() : p.lo.x(), corner >= 2 ? p.hi.y() : p.lo.y()};
}

Vec2 on_side(const SmoothPiece& p, int side, double t) {
  const Vec2 from = piece_corner(p, side), to = piece_corner(p, (side + 1) % corner_count(p));
  return (1 - t) * from + t * to;
}

template <int Dim>
Composed<Dim>::Composed(Target<Dim> target) : target_(std::move(target)) {
  if (std::holds_alternative<FacetMesh<Dim>>(target_))
    join_mesh();
  else
    cut_shape();
  measure();
}

template <int Dim>
void Composed<Dim>::measure() {
  search::Box<Dim> box;
  for (std::size_t p = 0; p < pieces_.size(); ++p)
    for (int i = 0; i <= 8; ++i)
      for (int j = 0; j <= (Dim == 2 ? 0 : 8); ++j) {
        Vec2 xi = pieces_[p].lo + (pieces_[p].hi - pieces_[p].lo).cwiseProduct(Vec2(i, j) / 8.0);
        if (pieces_[p].triangle && xi.sum() > 1) xi /= xi.sum();
        box.extend(jet(static_cast<int>(p), xi).r);
      }
  size_ = (box.hi - box.lo).norm();
  if (!(size_ > 0) || !std::isfinite(size_))
    throw core::InputError({}, "the surface has no extent, or an infinite one");
}

template <>
void Composed<2>::join_mesh() {
  const auto& mesh = std::get<FacetMesh<2>>(target_);
  std::map<Index, std::vector<std::array<int, 2>>> ends;  // facet, side
  std::vector<search::Box<2>> boxes;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    const std::size_t count = check_facet(mesh, f);
    const MeshFacet& facet = mesh.facets[f];
    search::Box<2>& box = boxes.emplace_back();
    for (std::size_t k = 0; k < count; ++k) box.extend(mesh.nodes[at(facet.nodes[k])]);
    if (count > 2) box.inflate(0.25 * (box.hi - box.lo).norm());
    pieces_.push_back({});
    for (int side = 0; side < 2; ++side)
      ends[facet.nodes[at(side)]].push_back({static_cast<int>(f), side});
  }
  if (mesh.facets.empty()) throw core::InputError({}, "the surface has no facets");
  tree_ = search::Bvh<2>(boxes);
  for (auto& [node, list] : ends) {
    std::sort(list.begin(), list.end(),  // the one that arrives first
              [](const auto& a, const auto& b) { return a[1] > b[1]; });
    Joint joint;
    joint.piece[0] = list[0][0];
    joint.side[0] = list[0][1];
    if (list.size() > 1) {
      joint.piece[1] = list[1][0];
      joint.side[1] = list[1][1];
      joint.regular = list.size() == 2 && joint.side[0] != joint.side[1];
    }
    joints_.push_back(joint);
  }
}

template <>
void Composed<3>::join_mesh() {
  const auto& mesh = std::get<FacetMesh<3>>(target_);
  std::map<std::array<Index, 2>, std::vector<std::array<int, 3>>> edges;  // facet, side, way
  std::map<Index, std::vector<PieceCorner>> around;
  std::vector<search::Box<3>> boxes;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    const std::size_t count = check_facet(mesh, f);
    const MeshFacet& facet = mesh.facets[f];
    search::Box<3>& box = boxes.emplace_back();
    for (std::size_t k = 0; k < count; ++k) box.extend(mesh.nodes[at(facet.nodes[k])]);
    if (count > 4) box.inflate(0.25 * (box.hi - box.lo).norm());
    const bool triangle = cell::is_triangle(facet.type);
    pieces_.push_back({triangle ? Vec2(0, 0) : Vec2(-1, -1), Vec2(1, 1), triangle});
    const int corners = triangle ? 3 : 4;
    for (int k = 0; k < corners; ++k) {
      const Index a = facet.nodes[at(k)], b = facet.nodes[at((k + 1) % corners)];
      around[a].push_back({static_cast<int>(f), k});
      edges[{std::min(a, b), std::max(a, b)}].push_back({static_cast<int>(f), k, a < b});
    }
  }
  if (mesh.facets.empty()) throw core::InputError({}, "the surface has no facets");
  tree_ = search::Bvh<3>(boxes);
  for (const auto& [nodes, list] : edges) {
    Joint joint;
    for (std::size_t k = 0; k < std::min<std::size_t>(list.size(), 2); ++k) {
      joint.piece[k] = list[k][0];
      joint.side[k] = list[k][1];
    }
    joint.regular = list.size() == 1 || (list.size() == 2 && list[0][2] != list[1][2]);
    joints_.push_back(joint);
  }
  for (auto& [node, list] : around) corners_.push_back(std::move(list));
}

template <>
void Composed<2>::cut_shape() {
  const auto& curve = std::get<geometry::Curve>(target_);
  if (std::string problem = geometry::validate(curve); !problem.empty())
    throw core::InputError({}, problem);
  const bool closed = geometry::closed(curve);
  if (const auto* nurbs = std::get_if<geometry::NurbsCurve>(&curve)) {
    for (const Index i : spans_of(nurbs->knots, nurbs->degree, nurbs->control.size())) {
      pieces_.push_back({Vec2(nurbs->knots[at(i)], 0), Vec2(nurbs->knots[at(i) + 1], 0)});
      spans_.push_back({i, 0});
    }
  } else {
    double lo = geometry::lo(curve), hi = geometry::hi(curve);
    if (!std::isfinite(lo)) lo = -1;
    if (!std::isfinite(hi)) hi = 1;
    pieces_.push_back({Vec2(lo, 0), Vec2(hi, 0)});
    if (closed || std::holds_alternative<geometry::InfiniteLine>(curve)) return;
  }
  const int last = static_cast<int>(pieces_.size()) - 1;
  for (int p = 0; p < last; ++p) joints_.push_back({{p, p + 1}, {1, 0}});
  if (closed) {
    joints_.push_back({{last, 0}, {1, 0}});
  } else {
    joints_.push_back({{0, -1}, {0, 0}});
    joints_.push_back({{last, -1}, {1, 0}});
  }
}

template <>
void Composed<3>::cut_shape() {
  const auto& surface = std::get<geometry::Surface>(target_);
  if (std::string problem = geometry::validate(surface); !problem.empty())
    throw core::InputError({}, problem);
  const auto* patch = std::get_if<geometry::NurbsPatch>(&surface);
  if (!patch) {
    pieces_ = charts(surface);
    for (const int side : open_sides(surface, pieces_[0])) joints_.push_back({{0, -1}, {side, 0}});
    if (std::holds_alternative<geometry::LagrangeSurface>(surface))
      for (int c = 0; c < corner_count(pieces_[0]); ++c) corners_.push_back({{0, c}});
    return;
  }
  const auto u = spans_of(patch->knots[0], patch->degree[0], at(patch->count[0]));
  const auto v = spans_of(patch->knots[1], patch->degree[1], at(patch->count[1]));
  const int nu = static_cast<int>(u.size()), nv = static_cast<int>(v.size());
  const geometry::ClosedFlags closed = patch->closed();
  std::map<std::array<int, 2>, std::vector<PieceCorner>> around;
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) {
      const std::size_t a = at(u[at(i)]), b = at(v[at(j)]);
      pieces_.push_back({Vec2(patch->knots[0][a], patch->knots[1][b]),
                         Vec2(patch->knots[0][a + 1], patch->knots[1][b + 1])});
      spans_.push_back({u[at(i)], v[at(j)]});
      const int self = i * nv + j;
      const int right = i + 1 < nu ? self + nv : closed[0] ? j : -1;
      const int up = j + 1 < nv ? self + 1 : closed[1] ? i * nv : -1;
      joints_.push_back({{self, right}, {1, 3}});
      joints_.push_back({{self, up}, {2, 0}});
      if (i == 0 && !closed[0]) joints_.push_back({{self, -1}, {3, 0}});
      if (j == 0 && !closed[1]) joints_.push_back({{self, -1}, {0, 0}});
      for (int c = 0; c < 4; ++c) {
        int x = i + (c == 1 || c == 2), y = j + (c >= 2);
        if (closed[0]) x %= nu;
        if (closed[1]) y %= nv;
        around[{x, y}].push_back({self, c});
      }
    }
  for (auto& [place, list] : around) corners_.push_back(std::move(list));
}

template <>
geometry::CurveJet<2> Composed<2>::jet(int piece, const Vec2& xi) const {
  if (const auto* mesh = std::get_if<FacetMesh<2>>(&target_))
    return facet_curve(*mesh, at(piece)).jet(xi.x());
  const auto& curve = std::get<geometry::Curve>(target_);
  if (const auto* nurbs = std::get_if<geometry::NurbsCurve>(&curve))
    return nurbs->jet_in_span(spans_[at(piece)][0], xi.x());
  return geometry::jet(curve, xi.x());
}

template <>
geometry::SurfaceJet Composed<3>::jet(int piece, const Vec2& xi) const {
  if (const auto* mesh = std::get_if<FacetMesh<3>>(&target_))
    return facet_surface(*mesh, at(piece)).jet(xi);
  const auto& surface = std::get<geometry::Surface>(target_);
  if (const auto* patch = std::get_if<geometry::NurbsPatch>(&surface))
    return patch->jet_in_span(spans_[at(piece)], xi);
  return geometry::jet(surface, xi);
}

template <>
SurfacePlace<2> Composed<2>::place(int piece, const Vec2& xi) const {
  const geometry::CurveJet<2> j = jet(piece, xi);
  const geometry::CurveFrame f = curve_frame(j);
  return {j.r, f.normal, {f.kappa, f.kappa}, 1, f.valid};
}

template <>
SurfacePlace<3> Composed<3>::place(int piece, const Vec2& xi) const {
  const geometry::SurfaceJet j = jet(piece, xi);
  const geometry::SurfaceFrame f = surface_frame(j);
  return {j.r, f.normal, principal_curvatures(f).value, coordinate_sine(f), f.valid};
}

template <>
NearestPlace<2> Composed<2>::nearest(const Vec2& point, double squared_bound) const {
  NearestPlace<2> out;
  if (const auto* mesh = std::get_if<FacetMesh<2>>(&target_)) {
    const auto distance = [&](Index f) {
      const CurveFoot foot = closest_point(facet_curve(*mesh, at(f)), point);
      if (!foot.converged || !(foot.squared_distance < out.squared_distance))
        return foot.squared_distance;
      out = {foot.squared_distance, Vec2::Zero(), f, Vec2(foot.xi, 0)};
      return foot.squared_distance;
    };
    (void)tree_.nearest(point, distance, squared_bound);
  } else {
    const auto& curve = std::get<geometry::Curve>(target_);
    const CurveFoot foot = closest_point(curve, point);
    if (foot.converged) out = {foot.squared_distance, Vec2::Zero(), 0, Vec2(foot.xi, 0)};
    for (std::size_t p = 0; p < spans_.size(); ++p)
      if (foot.xi >= pieces_[p].lo.x()) out.piece = static_cast<int>(p);
  }
  if (out.piece < 0 || out.squared_distance > squared_bound) return {};
  out.r = jet(out.piece, out.xi).r;
  return out;
}

template <>
NearestPlace<3> Composed<3>::nearest(const Vec3& point, double squared_bound) const {
  NearestPlace<3> out;
  if (const auto* mesh = std::get_if<FacetMesh<3>>(&target_)) {
    std::array<Vec3, cell::max_facet_nodes> nodes;
    const auto distance = [&](Index f) {
      const MeshFacet& facet = mesh->facets[at(f)];
      const auto count = static_cast<std::size_t>(cell::info(facet.type).nodes);
      for (std::size_t k = 0; k < count; ++k) nodes[k] = mesh->nodes[at(facet.nodes[k])];
      const FacetFoot foot =
          closest_point(facet.type, std::span<const Vec3>(nodes.data(), count), point);
      if (foot.converged && foot.squared_distance < out.squared_distance)
        out = {foot.squared_distance, Vec3::Zero(), f, foot.xi};
      return foot.squared_distance;
    };
    (void)tree_.nearest(point, distance, squared_bound);
  } else {
    const auto& surface = std::get<geometry::Surface>(target_);
    const SurfaceFoot foot = closest_point(surface, point);
    if (foot.converged) out = {foot.squared_distance, Vec3::Zero(), 0, foot.xi};
    for (std::size_t p = 0; p < pieces_.size(); ++p)
      if ((foot.xi.array() >= pieces_[p].lo.array()).all()) out.piece = static_cast<int>(p);
  }
  if (out.piece < 0 || out.squared_distance > squared_bound) return {};
  out.r = jet(out.piece, out.xi).r;
  return out;
}

template class Composed<2>;
template class Composed<3>;

}  // namespace osculate::projection
