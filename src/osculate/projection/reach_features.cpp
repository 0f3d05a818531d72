// Parts of a surface with their normal directions, for the bound of its reach.
#include "osculate/projection/reach_features.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "osculate/projection/feature_domain.hpp"

namespace osculate::projection {

std::string_view name(Gap gap) {
  switch (gap) {
    case Gap::none:
      return "none";
    case Gap::irregular:
      return "facets of opposite orientation, or more than two, meet at an edge or node";
    case Gap::kink:
      return "an edge or corner opens to the other side";
    case Gap::notch:
      return "the border has a re-entrant corner";
    case Gap::pole:
      return "there are places without a normal";
    case Gap::touch:
      return "there are parts that the bounds cannot separate: they touch, or nearly";
    case Gap::effort:
      return "the search was given up";
    case Gap::size:
      return "there are more than 2000 pieces, edges and corners";
    case Gap::shape:
      break;
  }
  return "not for this analytic shape";
}

namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Vectors across an axis.
std::array<Vec2, 1> across(const Vec2& axis) { return {turn(axis)}; }
std::array<Vec3, 2> across(const Vec3& axis) {
  const Vec3 a = axis.unitOrthogonal();
  return {a, axis.cross(a)};
}

double sine_of(double angle) { return angle < 1.5 ? std::sin(angle) : 1.0; }

/// v . t <= sine for the directions t of the cone if v . t <= 0 for one of them.
template <int Dim>
Barrier<Dim> off_cone(const Cone<Dim>& cone) {
  return {cone.axis, sine_of(cone.angle)};
}

template <int Dim>
void measure(ReachFeature<Dim>& f) {
  f.box = {};
  for (const Vec<Dim>& p : f.hull) f.box.extend(p);
  f.center = 0.5 * (f.box.lo + f.box.hi);
  f.radius = 0;
  for (const Vec<Dim>& p : f.hull) f.radius = std::max(f.radius, (p - f.center).norm());
}

template <int Dim>
std::vector<Vec<Dim>> hull_of(const std::vector<ControlPoint<Dim>>& control) {
  std::vector<Vec<Dim>> hull;
  for (const ControlPoint<Dim>& c : control) hull.push_back(c.template head<Dim>() / c[Dim]);
  return hull;
}

/// Where a piece lies in its cell.
template <int Dim>
Owner<Dim> owner_of(const CellComplex<Dim>& all, const Piece<Dim>& piece, const Cone<Dim>& normal) {
  Owner<Dim> o;
  o.cell = piece.cell;
  o.normal = normal;
  const Cell& cell = all.cell(piece.cell);
  const int n = corner_count(cell);
  const std::size_t places = piece.triangle ? 3 : Dim == 2 ? 2 : 4;
  for (std::size_t k = 0; k < places; ++k) o.range.extend(piece.xi[k]);
  const double width = (corner_xi(all, cell, 1) - corner_xi(all, cell, 0)).norm();
  o.range.inflate(1e-9 * width);
  for (int k = 0; k < n; ++k) {
    const Vec2 a = corner_xi(all, cell, k);
    if (o.range.squared_distance(a) <= 0) o.corners |= 1U << k;
    if (Dim == 2) continue;
    const Vec2 way = corner_xi(all, cell, (k + 1) % n) - a;
    for (std::size_t p = 0; p < places; ++p) {
      const Vec2 d = piece.xi[p] - a;
      if (std::abs(way.x() * d.y() - way.y() * d.x()) <= 1e-9 * way.squaredNorm())
        o.edges |= 1U << k;
    }
  }
  return o;
}

template <int Dim>
ReachFeature<Dim> face_feature(const CellComplex<Dim>& all, int side, const Piece<Dim>& piece,
                               std::vector<ControlPoint<Dim>> control) {
  ReachFeature<Dim> f;
  f.piece = piece;
  f.control = std::move(control);
  f.hull = hull_of<Dim>(f.control);
  measure(f);
  const Cone<Dim> normal = normal_cone<Dim>(piece, f.control);
  f.owners = {owner_of(all, piece, normal)};
  if (!normal.narrow()) return f;
  f.directions = {Vec<Dim>(side * normal.axis), normal.angle};
  for (const Vec<Dim>& t : across(normal.axis)) {
    f.seen.push_back({t, std::sin(normal.angle)});
    f.seen.push_back({-t, std::sin(normal.angle)});
  }
  f.sees = f.seen;
  f.sees.push_back({-f.directions.axis, -std::cos(normal.angle)});
  return f;
}

// -- edges --------------------------------------------------------------------------------------

/// The face on the side of an edge part; its barriers.
void bar_edge(int side, ReachFeature<3>& f, bool border) {
  const std::size_t n = f.piece.triangle ? 3 : 0;
  if (f.piece.triangle)
    f.hull = {f.control[f.side].head<3>(), f.control[(f.side + 1) % n].head<3>()};
  else
    f.hull = hull_of<3>(side_control<3>(f.piece, f.control, f.side));
  measure(f);
  const Cone<3> normal = normal_cone<3>(f.piece, f.control);
  const Cone<3> into = inward_cone<3>(f.piece, f.control, f.side);
  const Cone<3> along = along_cone<3>(f.piece, f.control, f.side);
  f.seen = f.others;
  f.seen.push_back(off_cone(into));
  f.seen.push_back(off_cone(along));
  f.seen.push_back({-along.axis, sine_of(along.angle)});
  f.sees = f.seen;
  if (!border) return;
  const Vec3 up = side * normal.axis;
  if (f.kind == FeatureKind::edge) {
    f.sees.push_back({-up, sine_of(normal.angle)});
    return;
  }
  f.sees.push_back({up, sine_of(normal.angle)});
  f.seen.clear();
  Vec3 out = into.axis.dot(along.axis) * along.axis - into.axis;
  out -= out.dot(up) * up;
  f.outermost = {Vec3(out.normalized())};
  f.spread = 1.2 * (normal.angle + along.angle);  // n x tau, with axes that are not quite across
}

struct EdgeState {
  bool border = false, sharp = false;
  bool ridge = true;    ///< sharp: opens above, else below
  bool regular = true;  ///< two facets of the same orientation
};

bool same_orientation(const CellComplex<3>& all, const CellPart& a, const CellPart& b) {
  const Cell &p = all.cell(a.cell), &q = all.cell(b.cell);
  const auto end = [](const Cell& cell, int local) {
    return cell.vertex[at((local + 1) % corner_count(cell))];
  };
  return p.vertex[at(a.local)] == end(q, b.local) && end(p, a.local) == q.vertex[at(b.local)];
}

/// The angle of an inner edge at five places decides whether it is sharp.
EdgeState state_of(const CellComplex<3>& all, const CellPart& part, double kink) {
  const Cell& cell = all.cell(part.cell);
  const int n = corner_count(cell);
  if (collapsed(all, cell, part.local)) return {};  // a pole
  const auto sharing = all.at_edge.of(cell.group[at(part.local)]);
  if (sharing.size() == 1) return {.border = true};
  const bool first = sharing[0].cell == part.cell && sharing[0].local == part.local;
  const CellPart other = sharing[first ? 1 : 0];
  if (sharing.size() > 2 || !same_orientation(all, part, other)) return {.regular = false};
  const Vec2 a = corner_xi(all, cell, part.local), b = corner_xi(all, cell, (part.local + 1) % n);
  const Cell& beyond = all.cell(other.cell);
  for (const double t : {0.1, 0.3, 0.5, 0.7, 0.9}) {
    const Vec2 xi = (1 - t) * a + t * b;
    const Vec3 m = cell_normal<3>(cell_jet(all, cell, xi));
    const Vec2 over = across_edge(all, part, xi, other);
    const PieceJet<3> j = cell_jet(all, beyond, over);
    const Vec3 o = cell_normal<3>(j);
    if (!(std::atan2(m.cross(o).norm(), m.dot(o)) > kink)) continue;
    const Vec2 inwards = middle_xi(all, beyond) - over;
    const Vec3 into = inwards[0] * j.r1[0] + inwards[1] * j.r1[1];
    return {.sharp = true, .ridge = m.dot(into) <= 0};
  }
  return {};
}

/// What the faces of a sharp edge other than the first one say about its wedge.
void look_at_others(const CellComplex<3>& all, int side, const CellPart& own, ReachFeature<3>& f) {
  const Cell& cell = all.cell(own.cell);
  Cone<3> wedge = normal_cone<3>(f.piece, f.control);
  for (const CellPart& part : all.at_edge.of(cell.group[at(own.local)])) {
    if (part.cell == own.cell && part.local == own.local) continue;
    Cone<3> into, normal;
    bool any = false;
    for (const Piece<3>& piece : all.set.pieces)
      for (std::size_t s = 0; s < 4; ++s) {
        if (piece.cell != part.cell || piece.side[s] != part.local) continue;
        const Control<3> control = control_of(piece, all.set.control);
        const Cone<3> i = inward_cone<3>(piece, control, s), n = normal_cone<3>(piece, control);
        into = any ? join<3>(into, i) : i;
        normal = any ? join<3>(normal, n) : n;
        any = true;
      }
    f.others.push_back(off_cone(into));
    wedge = join<3>(wedge, normal);
    Owner<3> o;
    o.cell = part.cell;
    o.edges = 1U << part.local;
    const int n = corner_count(all.cell(part.cell));
    for (const int c : {int(part.local), (part.local + 1) % n}) {
      const Index vertex = all.cell(part.cell).vertex[at(c)];
      for (int k = 0; k < corner_count(cell); ++k)
        if ((f.owners[0].corners >> k & 1U) != 0 && cell.vertex[at(k)] == vertex)
          o.corners |= 1U << c;
      o.range.extend(corner_xi(all, all.cell(part.cell), c));
    }
    o.normal = normal;
    f.owners.push_back(o);
  }
  f.directions = wedge;
  f.directions.axis *= side;
}

void add_edge(const CellComplex<3>& all, int side, const Piece<3>& piece, std::size_t s,
              const EdgeState& state, std::vector<ReachFeature<3>>& out) {
  ReachFeature<3> f;
  f.kind = FeatureKind::edge;
  f.piece = piece;
  const Control<3> control = control_of(piece, all.set.control);
  f.control.assign(control.begin(), control.end());
  f.side = s;
  f.owners = {owner_of(all, piece, normal_cone<3>(piece, control))};
  if (state.sharp) look_at_others(all, side, {piece.cell, piece.side[s]}, f);
  bar_edge(side, f, state.border);
  out.push_back(f);
  if (!state.border) return;
  f.kind = FeatureKind::rim;
  bar_edge(side, f, true);
  out.push_back(std::move(f));
}

// -- corners and ends ---------------------------------------------------------------------------

/// What meets at a corner.
template <int Dim>
struct Fan {
  std::vector<Vec<Dim>> tangents, outward;  ///< unit; outward: away from the borders
  Vec<Dim> normal = Vec<Dim>::Zero();
  Cone<Dim> cone;
  double angle = 0;  ///< of all faces
  bool border = false, sharp = false;
  Gap gap = Gap::none;
};

Fan<2> fan_of(const CellComplex<2>& all, Index vertex, int side, double kink) {
  Fan<2> fan;
  bool any = false;
  std::array<Vec2, 2> leaving{Vec2::Zero(), Vec2::Zero()};  // by the end of the cell
  for (const CellPart& part : all.at_vertex.of(vertex)) {
    const Cell& cell = all.cell(part.cell);
    const PieceJet<2> j = cell_jet(all, cell, corner_xi(all, cell, part.local));
    const Vec2 n = cell_normal<2>(j);
    fan.tangents.push_back(corner_directions(all, part)[0].normalized());
    leaving[at(part.local)] = fan.tangents.back();
    const Cone<2> one{n, 1e-9};
    fan.cone = any ? join<2>(fan.cone, one) : one;
    any = true;
    fan.normal += n;
  }
  fan.border = fan.tangents.size() == 1;
  if (fan.border) fan.outward = {Vec2(-fan.tangents[0])};
  if (fan.border) return fan;
  if (fan.tangents.size() > 2 || leaving[0].isZero() || leaving[1].isZero()) {
    fan.gap = Gap::irregular;
    return fan;
  }
  const double angle = corner_angle(Vec2(-leaving[1]), leaving[0]);
  fan.sharp = std::abs(angle) > kink;
  if (side * angle < -kink) fan.gap = Gap::kink;
  return fan;
}

Fan<3> fan_of(const CellComplex<3>& all, Index vertex, int, double kink) {
  Fan<3> fan;
  bool any = false;
  for (const CellPart& part : all.at_vertex.of(vertex)) {
    const Cell& cell = all.cell(part.cell);
    const int n = corner_count(cell);
    const Vec3 normal = cell_normal<3>(cell_jet(all, cell, corner_xi(all, cell, part.local)));
    const std::array<Vec3, 2> d = corner_directions(all, part);
    if (!(d[0].norm() > 0 && d[1].norm() > 0)) continue;  // a pole
    const std::array<int, 2> edge{part.local, (part.local + n - 1) % n};
    for (std::size_t k = 0; k < 2; ++k) {
      const Vec3 t = d[k].normalized();
      fan.tangents.push_back(t);
      const EdgeState state = state_of(all, {part.cell, static_cast<std::int8_t>(edge[k])}, kink);
      fan.sharp = fan.sharp || state.sharp;
      if (!state.border) continue;
      fan.border = true;
      fan.outward.push_back((k == 0 ? t.cross(normal) : normal.cross(t)).normalized());
    }
    const double angle = std::atan2(d[0].cross(d[1]).norm(), d[0].dot(d[1]));
    fan.angle += angle;
    fan.normal += angle * normal;
    const Cone<3> one{normal, 1e-9};
    fan.cone = any ? join<3>(fan.cone, one) : one;
    any = true;
  }
  return fan;
}

template <int Dim>
void add_point(const CellComplex<Dim>& all, int side, Index vertex, double kink,
               ReachFeatures<Dim>& out) {
  const auto around = all.at_vertex.of(vertex);
  if (around.empty()) return;
  const Fan<Dim> fan = fan_of(all, vertex, side, kink);
  if (fan.gap != Gap::none) out.gap = fan.gap;
  if (!fan.border && !fan.sharp) return;
  constexpr double straight = 3.141592653589793;
  if (Dim == 3 && fan.border && !fan.sharp && fan.angle > straight + std::max(kink, 1e-6))
    out.gap = Gap::notch;
  ReachFeature<Dim> f;
  f.kind = FeatureKind::point;
  for (const CellPart& part : around) {
    const Cell& cell = all.cell(part.cell);
    Owner<Dim> o;
    o.cell = part.cell;
    o.corners = 1U << part.local;
    const Vec2 xi = corner_xi(all, cell, part.local);
    o.range.extend(xi);
    const PieceJet<Dim> j = cell_jet(all, cell, xi);
    o.normal = {cell_normal<Dim>(j), 1e-9};
    f.hull = {j.r};
    f.owners.push_back(o);
  }
  measure(f);
  constexpr double rounding = 1e-12;
  for (const Vec<Dim>& t : fan.tangents) f.seen.push_back({t, rounding});
  f.sees = f.seen;
  const Vec<Dim> up = side * fan.normal.normalized();
  if (!fan.border) f.directions = {Vec<Dim>(side * fan.cone.axis), fan.cone.angle};
  if (fan.border && !fan.sharp) f.sees.push_back({-up, rounding});
  out.list.push_back(f);
  if (!fan.border || fan.sharp) return;
  f.kind = FeatureKind::rim;
  f.seen.clear();
  f.sees = {{up, rounding}};
  f.outermost = fan.outward;
  out.list.push_back(std::move(f));
}

}  // namespace

template <int Dim>
ReachFeatures<Dim> features_of(const CellComplex<Dim>& all, int side, double kink) {
  ReachFeatures<Dim> out;
  for (const Piece<Dim>& piece : all.set.pieces) {
    const Control<Dim> control = control_of(piece, all.set.control);
    Piece<Dim> own = piece;
    if (own.triangle) own.xi = {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1), Vec2(0, 0)};
    out.list.push_back(face_feature<Dim>(all, side, own, {control.begin(), control.end()}));
    if constexpr (Dim == 3) {
      for (std::size_t s = 0; s < 4; ++s) {
        if (own.side[s] < 0) continue;
        const CellPart part{own.cell, own.side[s]};
        const auto sharing = all.at_edge.of(all.cell(own.cell).group[at(own.side[s])]);
        const EdgeState state = state_of(all, part, kink);
        if (!state.regular) out.gap = Gap::irregular;
        if (state.sharp && state.ridge != (side > 0)) out.gap = Gap::kink;
        const bool first = sharing[0].cell == part.cell && sharing[0].local == part.local;
        if (state.border || (state.sharp && first)) add_edge(all, side, own, s, state, out.list);
      }
    }
  }
  for (Index v = 0; v + 1 < static_cast<Index>(all.at_vertex.start.size()); ++v)
    add_point(all, side, v, kink, out);
  return out;
}

namespace {

/// Across the middle of side k (its numbers stay).
template <int Dim>
void cut_triangle(const ReachFeature<Dim>& f, std::size_t k,
                  std::array<std::vector<ControlPoint<Dim>>, 2>& points,
                  std::array<Piece<Dim>, 2>& pieces) {
  const std::size_t b = (k + 1) % 3;
  const ControlPoint<Dim> middle = 0.5 * (f.control[k] + f.control[b]);
  const Vec2 xi = 0.5 * (f.piece.xi[k] + f.piece.xi[b]);
  points = {f.control, f.control};
  pieces = {f.piece, f.piece};
  points[0][b] = points[1][k] = middle;
  pieces[0].xi[b] = pieces[1].xi[k] = xi;
}

template <int Dim>
std::size_t longest_side(const std::vector<ControlPoint<Dim>>& c) {
  std::size_t best = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if ((c[(k + 1) % 3] - c[k]).norm() > (c[(best + 1) % 3] - c[best]).norm()) best = k;
  return best;
}

/// The other parts of an edge's owners reach what the first one reaches.
void follow(const CellComplex<3>& all, ReachFeature<3>& f) {
  const Cell& cell = all.cell(f.owners[0].cell);
  for (std::size_t o = 1; o < f.owners.size(); ++o) {
    const Cell& other = all.cell(f.owners[o].cell);
    unsigned kept = 0;
    for (int c = 0; c < corner_count(other); ++c)
      for (int k = 0; k < corner_count(cell); ++k)
        if ((f.owners[0].corners >> k & 1U) != 0 && (f.owners[o].corners >> c & 1U) != 0 &&
            cell.vertex[at(k)] == other.vertex[at(c)])
          kept |= 1U << c;
    f.owners[o].corners = kept;
  }
}

void halve_edge(const CellComplex<3>& all, int side, const ReachFeature<3>& f,
                std::array<ReachFeature<3>, 2>& halves) {
  std::array<std::vector<ControlPoint<3>>, 2> points;
  std::array<Piece<3>, 2> pieces;
  if (f.piece.triangle) {
    cut_triangle(f, f.side, points, pieces);
  } else {
    const int along = f.side < 2 ? 1 : 0;
    cut(f.piece, f.control, along, pieces, points);
    for (std::size_t k = 0; k < 2; ++k) {
      std::array<std::vector<ControlPoint<3>>, 2> strips;
      std::array<Piece<3>, 2> parts;
      cut(pieces[k], points[k], 1 - along, parts, strips);
      pieces[k] = parts[f.side % 2];
      points[k] = strips[f.side % 2];
    }
  }
  const bool border = f.owners.size() == 1;
  for (std::size_t k = 0; k < 2; ++k) {
    ReachFeature<3>& h = halves[k] = f;
    h.child = {-1, -1};
    h.piece = pieces[k];
    h.control = points[k];
    h.owners[0] = owner_of(all, h.piece, normal_cone<3>(h.piece, h.control));
    follow(all, h);
    bar_edge(side, h, border);
  }
}

}  // namespace

template <int Dim>
bool halve(const CellComplex<Dim>& all, int side, const ReachFeature<Dim>& f,
           std::array<ReachFeature<Dim>, 2>& halves, int direction) {
  if (f.control.empty()) return false;
  if (f.kind != FeatureKind::face) {
    if constexpr (Dim == 3) halve_edge(all, side, f, halves);
    return Dim == 3;
  }
  std::array<std::vector<ControlPoint<Dim>>, 2> points;
  std::array<Piece<Dim>, 2> pieces;
  if (f.piece.triangle)
    cut_triangle(f, longest_side<Dim>(f.control), points, pieces);
  else
    cut(f.piece, f.control, direction >= 0 ? direction : longer_direction<Dim>(f.piece, f.control),
        pieces, points);
  for (std::size_t k = 0; k < 2; ++k)
    halves[k] = face_feature<Dim>(all, side, pieces[k], std::move(points[k]));
  return true;
}

template ReachFeatures<2> features_of(const CellComplex<2>&, int, double);
template ReachFeatures<3> features_of(const CellComplex<3>&, int, double);
template bool halve(const CellComplex<2>&, int, const ReachFeature<2>&,
                    std::array<ReachFeature<2>, 2>&, int);
template bool halve(const CellComplex<3>&, int, const ReachFeature<3>&,
                    std::array<ReachFeature<3>, 2>&, int);

}  // namespace osculate::projection
