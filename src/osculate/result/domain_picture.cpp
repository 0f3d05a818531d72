#include "osculate/result/domain_picture.hpp"

#include <algorithm>
#include <cmath>

#include "osculate/geometry/point_class.hpp"
#include "osculate/projection/local_domain.hpp"
#include "osculate/projection/piece_search.hpp"

namespace osculate::result {
namespace {

using projection::Composed;
using projection::EdgeFaces;
using projection::Joint;
using projection::SmoothPiece;
using projection::SurfacePlace;

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr int arc = 8;  ///< pieces of a right angle's arc, about
constexpr DomainPlace no_place{nothing, nothing, nothing, nothing, nothing,
                               nothing, nothing, nothing, nothing, nothing};

DomainPart side_of(DomainPart above, int side) {
  return side > 0 ? above : static_cast<DomainPart>(static_cast<int>(above) + 1);
}

/// Points and cells as they are added.
class Sketch {
 public:
  Index point(const Vec3& r, const DomainPlace& place = no_place) {
    out_.points.push_back(r);
    out_.places.push_back(place);
    return static_cast<Index>(out_.points.size()) - 1;
  }
  void cell(cell::CellType type, std::initializer_list<Index> nodes, DomainPart part,
            Index piece = -1) {
    std::size_t b = 0;
    while (b < out_.blocks.size() && out_.blocks[b].type != type) ++b;
    if (b == out_.blocks.size()) {
      out_.blocks.push_back({type, {}});
      out_.parts.emplace_back();
      out_.pieces.emplace_back();
    }
    out_.blocks[b].connectivity.insert(out_.blocks[b].connectivity.end(), nodes);
    out_.parts[b].push_back(part);
    out_.pieces[b].push_back(piece);
  }
  DomainPicture take() { return std::move(out_); }

 private:
  DomainPicture out_;
};

double or_nothing(double v) { return std::isfinite(v) ? v : nothing; }

template <int Dim>
DomainPlace data_of(const SurfacePlace<Dim>& place, double size,
                    const std::array<double, 2>& even) {
  DomainPlace d = no_place;
  d.sine = place.sine;
  d.point_class = 0;
  if (!place.valid) return d;
  d.larger = place.k[0];
  d.smaller = place.k[1];
  d.gauss = Dim == 3 ? place.k[0] * place.k[1] : 0;
  d.mean = 0.5 * (place.k[0] + place.k[1]);
  d.point_class = static_cast<double>(geometry::point_class(place.k, size));
  if (Dim == 2 && d.point_class > 1) d.point_class = 2;
  const double zero = 1e-9 / size;
  const projection::LocalDomain domain = projection::local_domain(
      place.k[0] > zero ? place.k[0] : 0, place.k[1] < -zero ? place.k[1] : 0);
  d.bound_above = or_nothing(domain.above);
  d.bound_below = or_nothing(-domain.below);
  d.even_above = or_nothing(even[1]);
  d.even_below = or_nothing(even[0]);
  return d;
}

/// One sheet of a piece: its grid of places moved along the normals.
template <int Dim, class Height>
void add_sheet(Sketch& sketch, const Composed<Dim>& s, std::size_t p, int cells,
               const std::array<double, 2>& even, DomainPart part, const Height& height) {
  const SmoothPiece& piece = s.pieces()[p];
  const auto facet = static_cast<Index>(p);
  std::vector<Index> grid;
  const auto at = [&](int i, int j) -> Index& {
    return grid[static_cast<std::size_t>(i * (cells + 1) + j)];
  };
  grid.assign(static_cast<std::size_t>((cells + 1) * (cells + 1)), -1);
  for (int i = 0; i <= cells; ++i)
    for (int j = 0; j <= (Dim == 2 ? 0 : piece.triangle ? cells - i : cells); ++j) {
      const Vec2 xi = piece.lo + (piece.hi - piece.lo).cwiseProduct(Vec2(i, j) / cells);
      const SurfacePlace<Dim> place = s.place(static_cast<int>(p), xi);
      const DomainPlace data = data_of(place, s.size(), even);
      const double zeta = height(data);
      if (!std::isfinite(zeta) || (!place.valid && part != DomainPart::surface)) continue;
      at(i, j) = sketch.point(in_space(Vec<Dim>(place.r + zeta * place.n)), data);
    }
  const auto add = [&](cell::CellType type, std::initializer_list<Index> nodes) {
    if (std::min(nodes) >= 0) sketch.cell(type, nodes, part, facet);
  };
  for (int i = 0; i < cells; ++i) {
    if (Dim == 2) add(cell::CellType::line2, {at(i, 0), at(i + 1, 0)});
    for (int j = 0; Dim == 3 && j < (piece.triangle ? cells - i : cells); ++j) {
      if (!piece.triangle) {
        add(cell::CellType::quad4, {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
        continue;
      }
      add(cell::CellType::tri3, {at(i, j), at(i + 1, j), at(i, j + 1)});
      if (i + j + 2 <= cells)
        add(cell::CellType::tri3, {at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
}

template <int Dim>
void add_sheets(Sketch& sketch, const Composed<Dim>& s, const DomainPen& pen,
                const std::vector<std::array<double, 2>>& even) {
  constexpr int places = 40000;  // of all pieces together
  const int cells = std::min(projection::cells_of(s, places), Dim == 2 ? 100 : pen.cells);
  const auto bound = [&](double v) {
    return std::isnan(v) ? nothing : std::min(v, 2 * pen.length);
  };
  for (std::size_t p = 0; p < s.pieces().size(); ++p) {
    const auto add = [&](DomainPart part, const auto& height) {
      add_sheet(sketch, s, p, cells, even[p], part, height);
    };
    add(DomainPart::surface, [](const DomainPlace&) { return 0.0; });
    add(DomainPart::sheet_above, [&](const DomainPlace& d) { return bound(d.bound_above); });
    add(DomainPart::sheet_below, [&](const DomainPlace& d) { return -bound(d.bound_below); });
    add(DomainPart::even_above, [&](const DomainPlace& d) { return bound(d.even_above); });
    add(DomainPart::even_below, [&](const DomainPlace& d) { return -bound(d.even_below); });
  }
}

/// Corners and ends of a curve: the two normals and the arc between them.
void add_edges(Sketch& sketch, const Composed<2>& s, double kink, double length) {
  for (const Joint& joint : s.joints()) {
    const auto place = [&](std::size_t k) {
      const SmoothPiece& p = s.pieces()[static_cast<std::size_t>(joint.piece[k])];
      return s.place(joint.piece[k], joint.side[k] == 0 ? p.lo : p.hi);
    };
    const SurfacePlace<2> first = place(0);
    if (!first.valid) continue;
    const bool border = joint.piece[1] < 0;
    const double angle = border ? 0 : joint_angle(s, joint);
    if (!border && std::abs(angle) <= kink) continue;
    for (const int side : {1, -1}) {
      if (!border && side * angle < 0) continue;
      const Vec2 from = side * first.n;
      const Vec2 beyond = joint.side[0] == 0 ? turn(first.n) : Vec2(-turn(first.n));
      const Vec2 to = border ? beyond : Vec2(side * place(1).n);
      const DomainPart part = side_of(DomainPart::edge_above, side);
      const Index apex = sketch.point(in_space(first.r));
      Index last = apex;
      for (int k = 0; k <= arc; ++k) {
        const Vec2 v = projection::turned<2>(from, to, static_cast<double>(k) / arc);
        const Index next = sketch.point(in_space(Vec2(first.r + length * v)));
        sketch.cell(cell::CellType::line2, {last, next}, part);
        last = next;
      }
      sketch.cell(cell::CellType::line2, {last, apex}, part);
    }
  }
}

/// The side of a piece as a curve in space.
geometry::SpaceCurveFrame side_frame(const Composed<3>& s, const Joint& joint, double t) {
  const SmoothPiece& p = s.pieces()[static_cast<std::size_t>(joint.piece[0])];
  const geometry::SurfaceJet j = s.jet(joint.piece[0], on_side(p, joint.side[0], t));
  const Vec2 w = on_side(p, joint.side[0], 1) - on_side(p, joint.side[0], 0);
  geometry::CurveJet<3> curve;
  curve.r = j.r;
  curve.r1 = w.x() * j.r1[0] + w.y() * j.r1[1];
  curve.r2 = w.x() * w.x() * j.r2[0] + 2 * w.x() * w.y() * j.r2[1] + w.y() * w.y() * j.r2[2];
  return space_curve_frame(curve);
}

/// One cross-section of a wedge: the edge's point, then the arc as far as the edge's own curvature
/// and the drawn length let it; empty where there is none.
std::vector<Index> wedge_section(Sketch& sketch, const Composed<3>& s, const Joint& joint, double t,
                                 int side, double kink, double length, int pieces) {
  EdgeFaces e;
  const bool border = joint.piece[1] < 0;
  if (!(border ? border_face(s, joint, t, e) : edge_faces(s, joint, t, e))) return {};
  if (!border && side * edge_angle(e) <= kink) return {};
  const SmoothPiece& piece = s.pieces()[static_cast<std::size_t>(joint.piece[0])];
  const Vec3 r = s.jet(joint.piece[0], on_side(piece, joint.side[0], t)).r;
  const geometry::SpaceCurveFrame frame = side_frame(s, joint, t);
  const Vec3 from = side * e.n[0], to = border ? Vec3(-e.into[0]) : Vec3(side * e.n[1]);
  std::vector<Index> section{sketch.point(r)};
  for (int k = 0; k <= pieces; ++k) {
    const Vec3 v = projection::turned<3>(from, to, static_cast<double>(k) / pieces);
    const double phi = std::atan2(v.dot(frame.beta), v.dot(frame.nu));
    section.push_back(sketch.point(r + std::min(length, projection::local_limit(frame, phi)) * v));
  }
  return section;
}

void add_edges(Sketch& sketch, const Composed<3>& s, double kink, double length) {
  constexpr std::size_t fine = 200;  // joints that are drawn with all pieces
  const bool coarse = s.joints().size() > fine;
  const int along = coarse ? 1 : arc;
  for (const Joint& joint : s.joints()) {
    const std::array<double, 2> angles = joint_angles(s, joint);
    const double widest = joint.piece[1] < 0 ? 1.6 : std::max(angles[0], -angles[1]);
    const int pieces = coarse ? 1 + static_cast<int>(3 * widest / 1.6) : arc;
    for (const int side : {1, -1}) {
      const DomainPart part = side_of(DomainPart::edge_above, side);
      std::vector<Index> last;
      for (int i = 0; i <= along; ++i) {
        const double t = static_cast<double>(i) / along;
        std::vector<Index> next = wedge_section(sketch, s, joint, t, side, kink, length, pieces);
        if (!next.empty() && !last.empty()) {
          for (std::size_t k = 0; k + 1 < next.size(); ++k)  // first flank and arc
            sketch.cell(cell::CellType::quad4, {last[k], next[k], next[k + 1], last[k + 1]}, part);
          sketch.cell(cell::CellType::quad4, {last.back(), next.back(), next[0], last[0]}, part);
        }
        last = std::move(next);
      }
    }
  }
}

/// Flanks between neighbouring rays, and the part of a sphere that closes them.
void add_cone(Sketch& sketch, const Vec3& r, std::vector<Vec3> rays, DomainPart part, double length,
              int pieces) {
  Vec3 mean = Vec3::Zero();
  for (const Vec3& ray : rays) mean += ray;
  if (!(mean.norm() > 1e-9)) return;
  mean.normalize();
  const Vec3 e1 = mean.unitOrthogonal(), e2 = mean.cross(e1);
  std::sort(rays.begin(), rays.end(), [&](const Vec3& a, const Vec3& b) {
    return std::atan2(a.dot(e2), a.dot(e1)) < std::atan2(b.dot(e2), b.dot(e1));
  });
  const Index apex = sketch.point(r), tip = sketch.point(r + length * mean);
  for (std::size_t k = 0; k < rays.size(); ++k) {
    const Vec3 &a = rays[k], &b = rays[(k + 1) % rays.size()];
    Index last = sketch.point(r + length * a);
    for (int i = 1; i <= pieces; ++i) {
      const Vec3 v = projection::turned<3>(a, b, static_cast<double>(i) / pieces);
      const Index next = sketch.point(r + length * v);
      sketch.cell(cell::CellType::tri3, {apex, last, next}, part);
      sketch.cell(cell::CellType::tri3, {tip, last, next}, part);
      last = next;
    }
  }
}

void add_corners(Sketch&, const Composed<2>&, double, double) {}
/// Cones of corners that are wider than a kink; those of the border one on each side.
void add_corners(Sketch& sketch, const Composed<3>& s, double kink, double length) {
  constexpr std::size_t fine = 200;
  const int pieces = s.corners().size() > fine ? 1 : arc;
  for (const std::vector<projection::PieceCorner>& around : s.corners()) {
    const projection::CornerFan fan = corner_fan(s, around);
    std::vector<Vec3> rays = projection::corner_rays(fan.tangents);
    if (rays.size() < 3) continue;
    const double narrow = std::max(kink, 1e-6);
    if (rays[0].dot(rays[1]) < -1 + 1e-9) {
      const std::vector<Vec3> across(rays.begin() + 2, rays.end());
      if (across.size() < 2 || (across[0] - across[1]).norm() < narrow) continue;
      for (const std::size_t k : {0u, 1u}) {
        std::vector<Vec3> half = across;
        half.push_back(rays[k]);
        const int side = rays[k].dot(fan.normal) > 0 ? 1 : -1;
        add_cone(sketch, fan.r, half, side_of(DomainPart::corner_above, side), length, pieces);
      }
      continue;
    }
    Vec3 mean = Vec3::Zero();
    for (const Vec3& ray : rays) mean += ray;
    const bool wide = std::any_of(rays.begin(), rays.end(), [&](const Vec3& ray) {
      return (ray - mean.normalized()).norm() > narrow;
    });
    const int side = mean.dot(fan.normal) >= 0 ? 1 : -1;
    if (wide)
      add_cone(sketch, fan.r, rays, side_of(DomainPart::corner_above, side), length, pieces);
  }
}

}  // namespace

template <int Dim>
DomainPicture draw_domain(const Composed<Dim>& s, const DomainPen& pen,
                          const std::vector<std::array<double, 2>>& even) {
  Sketch sketch;
  add_sheets(sketch, s, pen, even);
  const double drawn = 0.25 * pen.length;
  add_edges(sketch, s, pen.kink, drawn);
  add_corners(sketch, s, pen.kink, drawn);
  return sketch.take();
}
template DomainPicture draw_domain(const Composed<2>&, const DomainPen&,
                                   const std::vector<std::array<double, 2>>&);
template DomainPicture draw_domain(const Composed<3>&, const DomainPen&,
                                   const std::vector<std::array<double, 2>>&);

}  // namespace osculate::result
