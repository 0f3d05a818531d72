#include "osculate/projection/composed.hpp"

#include <algorithm>
#include <cmath>

#include "osculate/core/error.hpp"
#include "osculate/geometry/curve_frame.hpp"
#include "osculate/geometry/point_class.hpp"

namespace osculate::projection {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

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
  return {piece};
}

/// Sides of an analytic surface that are borders.
std::vector<int> open_sides(const geometry::Surface& surface) {
  if (std::holds_alternative<geometry::Sphere>(surface)) return {};
  const Vec2 lo = geometry::lo(surface), hi = geometry::hi(surface);
  const geometry::ClosedFlags closed = geometry::closed(surface);
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
Composed<Dim>::Composed(Target<Dim> target) : projector_(std::move(target)) {
  if (cells())
    take_cells();
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

template <int Dim>
void Composed<Dim>::take_cells() {
  for (const Cell& cell : cells()->cells) {
    const bool triangle = Dim == 3 && corner_count(cell) == 3;
    const Vec2 hi = triangle ? Vec2(1, 1) : corner_xi(*cells(), cell, Dim == 2 ? 1 : 2);
    pieces_.push_back({corner_xi(*cells(), cell, 0), hi, triangle});
  }
  join_cells();
}

template <>
void Composed<2>::join_cells() {
  for (Index v = 0; v + 1 < static_cast<Index>(cells()->at_vertex.start.size()); ++v) {
    const auto around = cells()->at_vertex.of(v);
    std::vector<CellPart> list(around.begin(), around.end());
    if (list.empty()) continue;
    std::stable_sort(list.begin(), list.end(),  // the one that arrives first
                     [](const CellPart& a, const CellPart& b) { return a.local > b.local; });
    Joint joint;
    joint.piece[0] = list[0].cell;
    joint.side[0] = list[0].local;
    if (list.size() > 1) {
      joint.piece[1] = list[1].cell;
      joint.side[1] = list[1].local;
      joint.regular = list.size() == 2 && joint.side[0] != joint.side[1];
    }
    joints_.push_back(joint);
  }
}

template <>
void Composed<3>::join_cells() {
  const CellComplex<3>& all = *cells();
  const auto begin_of = [&](const CellPart& part) {
    return all.cell(part.cell).vertex[static_cast<std::size_t>(part.local)];
  };
  const auto end_of = [&](const CellPart& part) {
    const Cell& cell = all.cell(part.cell);
    return cell.vertex[static_cast<std::size_t>((part.local + 1) % corner_count(cell))];
  };
  for (Index e = 0; e + 1 < static_cast<Index>(all.at_edge.start.size()); ++e) {
    const auto list = all.at_edge.of(e);
    if (collapsed(all, all.cell(list[0].cell), list[0].local)) continue;
    Joint joint;
    for (std::size_t k = 0; k < std::min<std::size_t>(list.size(), 2); ++k) {
      joint.piece[k] = list[k].cell;
      joint.side[k] = list[k].local;
    }
    joint.regular = list.size() == 1 || (list.size() == 2 && begin_of(list[0]) == end_of(list[1]) &&
                                         end_of(list[0]) == begin_of(list[1]));
    joints_.push_back(joint);
  }
  for (Index v = 0; v + 1 < static_cast<Index>(all.at_vertex.start.size()); ++v) {
    std::vector<PieceCorner> around;
    for (const CellPart& part : all.at_vertex.of(v)) around.push_back({part.cell, part.local});
    if (!around.empty()) corners_.push_back(std::move(around));
  }
}

template <>
void Composed<2>::cut_shape() {
  const auto& curve = std::get<geometry::Curve>(target());
  double lo = geometry::lo(curve), hi = geometry::hi(curve);
  if (!std::isfinite(lo)) lo = -1;
  if (!std::isfinite(hi)) hi = 1;
  pieces_.push_back({Vec2(lo, 0), Vec2(hi, 0)});
  if (geometry::closed(curve) || std::holds_alternative<geometry::InfiniteLine>(curve)) return;
  joints_.push_back({{0, -1}, {0, 0}});
  joints_.push_back({{0, -1}, {1, 0}});
}

template <>
void Composed<3>::cut_shape() {
  const auto& surface = std::get<geometry::Surface>(target());
  pieces_ = charts(surface);
  for (const int side : open_sides(surface)) joints_.push_back({{0, -1}, {side, 0}});
}

template <>
geometry::CurveJet<2> Composed<2>::jet(int piece, const Vec2& xi) const {
  if (const auto* mesh = std::get_if<FacetMesh<2>>(&target()))
    return facet_curve(*mesh, at(piece)).jet(xi.x());
  const auto& curve = std::get<geometry::Curve>(target());
  if (const auto* nurbs = std::get_if<geometry::NurbsCurve>(&curve))
    return nurbs->jet_in_span(cells()->cell(piece).span[0], xi.x());
  return geometry::jet(curve, xi.x());
}

template <>
geometry::SurfaceJet Composed<3>::jet(int piece, const Vec2& xi) const {
  if (const auto* mesh = std::get_if<FacetMesh<3>>(&target()))
    return facet_surface(*mesh, at(piece)).jet(xi);
  const auto& surface = std::get<geometry::Surface>(target());
  if (const auto* patch = std::get_if<geometry::NurbsPatch>(&surface))
    return patch->jet_in_span(cells()->cell(piece).span, xi);
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

template <int Dim>
NearestPlace<Dim> Composed<Dim>::nearest(const Vec<Dim>& point, double squared_bound) const {
  const ClosestPoint<Dim> c = projector_.nearest_within(point, squared_bound);
  if (c.facet < 0) return {};
  const Vec2 xi(c.xi[0], Dim == 2 ? 0.0 : c.xi[1]);
  NearestPlace<Dim> out{(point - c.point).squaredNorm(), c.point, c.facet, xi};
  if (std::holds_alternative<FacetMesh<Dim>>(target())) return out;
  out.piece = 0;  // of shapes: the last one that begins before the place
  for (std::size_t p = 0; p < pieces_.size(); ++p)
    if ((xi.array() >= pieces_[p].lo.array()).all()) out.piece = static_cast<int>(p);
  return out;
}

template class Composed<2>;
template class Composed<3>;

}  // namespace osculate::projection
