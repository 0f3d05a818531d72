// Smooth patches through the nodes of quad4 and tri3 facets.
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "osculate/core/error.hpp"
#include "osculate/pairing/gregory.hpp"
#include "osculate/pairing/smoothing.hpp"
#include "osculate/pairing/surface.hpp"

namespace osculate::pairing {
namespace {

using Span = std::span<const Vec3>;

/// A vector or a point as a combination of nodes.
class Combination {
 public:
  Combination() = default;
  Combination(Index node, double weight) { terms_.emplace_back(node, weight); }

  void add(double factor, const Combination& other) {
    for (const auto& [node, weight] : other.terms_) {
      const auto at = std::find_if(terms_.begin(), terms_.end(),
                                   [n = node](const auto& term) { return term.first == n; });
      if (at == terms_.end())
        terms_.emplace_back(node, factor * weight);
      else
        at->second += factor * weight;
    }
  }
  [[nodiscard]] const std::vector<std::pair<Index, double>>& terms() const { return terms_; }

 private:
  std::vector<std::pair<Index, double>> terms_;
};

Combination sum(double a, const Combination& x, double b, const Combination& y) {
  Combination out;
  out.add(a, x);
  out.add(b, y);
  return out;
}

/// (node - origin) * factor
Combination difference(Index node, Index origin, double factor) {
  return sum(factor, {node, 1}, -factor, {origin, 1});
}

/// One corner of a facet.
struct Corner {
  Index facet;
  int local;
};

/// What the facets of one sector know of their common vertex: its tangent plane as a linear map of
/// a plane chart in which the edges of the reference configuration keep their lengths.
struct CornerFrame {
  std::array<Combination, 2> base;  ///< derivatives along the axes of the chart
  Vec2 next, previous;              ///< the two edges of the facet in the chart
  bool sharp = false;               ///< the sector is one facet wide between sharp edges
};

Combination tangent(const CornerFrame& c, const Vec2& q) {
  return sum(q.x(), c.base[0], q.y(), c.base[1]);
}

const Vec3& at(Span x, Index n) { return x[static_cast<std::size_t>(n)]; }

const SurfaceFacet& facet_of(const FacetSurface& s, Index f) {
  return s.facets[static_cast<std::size_t>(f)];
}

Index corner_node(const SurfaceFacet& facet, int k) {
  return facet.nodes[static_cast<std::size_t>((k + 2 * edge_count(facet)) % edge_count(facet))];
}

int corner_of(const SurfaceFacet& facet, Index node) {
  for (int k = 0; k < edge_count(facet); ++k)
    if (facet.nodes[static_cast<std::size_t>(k)] == node) return k;
  return -1;
}

/// Vector of the plane of the two edges that meet in a corner.
Vec3 corner_normal(const SurfaceFacet& facet, int k, Span x) {
  const Vec3& v = at(x, corner_node(facet, k));
  return (at(x, corner_node(facet, k + 1)) - v).cross(at(x, corner_node(facet, k - 1)) - v);
}

Vec3 middle_normal(const SurfaceFacet& facet, Span x) {
  Vec3 normal = Vec3::Zero();
  for (int k = 0; k < edge_count(facet); ++k) normal += corner_normal(facet, k, x);
  return normal;
}

double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Sharp and open edges of every facet.
using EdgeFlags = std::vector<std::array<bool, 4>>;

EdgeFlags sharp_edges(const FacetSurface& s, Span x, double sharp_angle) {
  EdgeFlags flags(s.facets.size());
  for (std::size_t f = 0; f < s.facets.size(); ++f)
    for (int e = 0; e < edge_count(s.facets[f]); ++e) {
      const Index other = s.facets[f].neighbour[static_cast<std::size_t>(e)];
      flags[f][static_cast<std::size_t>(e)] =
          other < 0 || facet_of(s, other).shape ||
          angle_between(middle_normal(s.facets[f], x), middle_normal(facet_of(s, other), x)) >
              sharp_angle;
    }
  return flags;
}

bool is_sharp(const EdgeFlags& flags, const FacetSurface& s, Index f, int edge) {
  const int edges = edge_count(facet_of(s, f));
  return flags[static_cast<std::size_t>(f)][static_cast<std::size_t>((edge + edges) % edges)];
}

/// Facet corners around a vertex from one sharp edge to the next, counter-clockwise; all of them
/// from anywhere when none is sharp (`closed`).
struct Sector {
  Index vertex = -1;
  std::vector<Corner> corners;
  bool closed = false;
};

/// The corner at the same vertex across edge `edge` of a facet.
Corner beyond(const FacetSurface& s, const Corner& c, int edge, Index vertex) {
  const SurfaceFacet& facet = facet_of(s, c.facet);
  const int edges = edge_count(facet);
  const Index other = facet.neighbour[static_cast<std::size_t>((edge + edges) % edges)];
  const Corner out{other, corner_of(facet_of(s, other), vertex)};
  const SurfaceFacet& next = facet_of(s, other);
  const int back = edge == c.local ? out.local - 1 : out.local;  // the same edge seen from there
  if (out.local < 0 ||
      next.neighbour[static_cast<std::size_t>((back + edge_count(next)) % edge_count(next))] !=
          c.facet)
    throw core::GeometryError(
        "smoothing: the facets of the master are not turned the same way everywhere, or more than "
        "two of them share an edge");
  return out;
}

Sector sector_at(const FacetSurface& s, const EdgeFlags& flags, const Corner& start) {
  Sector out;
  out.vertex = corner_node(facet_of(s, start.facet), start.local);
  Corner c = start;
  while (!is_sharp(flags, s, c.facet, c.local)) {  // clockwise, over the edge that leaves
    c = beyond(s, c, c.local, out.vertex);
    if (c.facet == start.facet) {
      out.closed = true;
      break;
    }
  }
  const Index first = c.facet;
  for (;;) {  // and back, over the edges that arrive
    out.corners.push_back(c);
    if (is_sharp(flags, s, c.facet, c.local - 1)) break;
    c = beyond(s, c, c.local - 1, out.vertex);
    if (c.facet == first) break;
  }
  return out;
}

/// Nodes at the far ends of the edges of a sector: one more than facets unless it is closed.
std::vector<Index> spokes(const FacetSurface& s, const Sector& sector) {
  std::vector<Index> nodes;
  for (const Corner& c : sector.corners)
    nodes.push_back(corner_node(facet_of(s, c.facet), c.local + 1));
  const Corner& last = sector.corners.back();
  if (!sector.closed) nodes.push_back(corner_node(facet_of(s, last.facet), last.local - 1));
  return nodes;
}

/// The nodes that a vertex has at the ends of its sharp edges.
std::vector<Index> creases(const FacetSurface& s, const EdgeFlags& flags, Index vertex) {
  std::vector<Index> nodes;
  for (const Index f : s.facets_at.at(vertex)) {
    const SurfaceFacet& facet = facet_of(s, f);
    const int k = corner_of(facet, vertex);
    for (const int edge : {k, k - 1}) {
      if (!is_sharp(flags, s, f, edge)) continue;
      const Index far = corner_node(facet, edge == k ? k + 1 : k - 1);
      if (std::find(nodes.begin(), nodes.end(), far) == nodes.end()) nodes.push_back(far);
    }
  }
  return nodes;
}

/// Derivative by the length along the sharp edge from a vertex to `far`: by the parabola where the
/// sharp line goes on smoothly (`along`), else by the edge alone.
struct Crease {
  Combination slope;
  bool along = false;
};

Crease crease_slope(const std::vector<Index>& ends, Index vertex, Index far, Span x,
                    double sharp_angle) {
  const double h = (at(x, far) - at(x, vertex)).norm();
  Crease out{difference(far, vertex, 1 / h), false};
  if (ends.size() != 2) return out;
  const Index other = ends[0] == far ? ends[1] : ends[0];
  const Vec3 before = at(x, vertex) - at(x, other);
  constexpr double most = 0.25 * std::numbers::pi;  // a corner of a sheet is no smooth line
  if (angle_between(before, at(x, far) - at(x, vertex)) > std::min(sharp_angle, most)) return out;
  const double g = before.norm();
  out.slope = sum(g / (g + h), out.slope, -h / (g + h), difference(other, vertex, 1 / g));
  out.along = true;
  return out;
}

/// The spokes of a sector in its chart.
std::vector<Vec2> chart_of(const FacetSurface& s, const Sector& sector,
                           const std::vector<Index>& ends, Span x) {
  Vec3 normal = Vec3::Zero();
  for (const Corner& c : sector.corners)
    normal += corner_normal(facet_of(s, c.facet), c.local, x).normalized();
  normal.normalize();
  const Vec3& v = at(x, sector.vertex);
  Vec3 first = at(x, ends.front()) - v;
  first = (first - first.dot(normal) * normal).normalized();
  const Vec3 second = normal.cross(first);
  std::vector<Vec2> q;
  for (const Index n : ends) {
    const Vec3 edge = at(x, n) - v;
    const Vec2 flat(edge.dot(first), edge.dot(second));
    q.push_back(edge.norm() / flat.norm() * flat);
  }
  return q;
}

/// Gradient in the chart by least squares with the weights |q|^-3, which make two opposite spokes
/// a parabola whatever their lengths are. With `round` the fit has a term |q|^2 too, which takes
/// the curvature of a ball out of it where the spokes are not opposite to each other.
std::array<Combination, 2> fitted_base(Index vertex, const std::vector<Index>& ends,
                                       const std::vector<Vec2>& q, bool round) {
  double size = 0;
  for (const Vec2& p : q) size += p.norm() / static_cast<double>(q.size());
  const auto terms = [&](const Vec2& p) {
    return Vec3(p.x(), p.y(), round ? p.squaredNorm() / size : 0.0);
  };
  Mat<3, 3> normal = Mat<3, 3>::Zero();
  for (const Vec2& p : q) normal += std::pow(p.norm(), -3) * terms(p) * terms(p).transpose();
  if (!round) normal(2, 2) = 1;
  const Mat<3, 3> inverse = normal.inverse();
  std::array<Combination, 2> base;
  for (std::size_t i = 0; i < q.size(); ++i) {
    const Vec3 weight = std::pow(q[i].norm(), -3) * inverse * terms(q[i]);
    base[0].add(weight.x(), difference(ends[i], vertex, 1));
    base[1].add(weight.y(), difference(ends[i], vertex, 1));
  }
  return base;
}

/// Of a sector of one facet: by the sum of its two edges.
Combination side_of_corner(Index vertex, const std::vector<Index>& ends, const std::vector<Vec2>& q,
                           const Combination& along, const Vec2& e, const Vec2& across) {
  const Vec2 both = q.front() + q.back();
  Combination out =
      sum(1, difference(ends.front(), vertex, 1), 1, difference(ends.back(), vertex, 1));
  out.add(-both.dot(e), along);
  return sum(1 / both.dot(across), out, 0, out);
}

/// Everything the tangent planes are made from.
struct Work {
  const FacetSurface& surface;
  const EdgeFlags& flags;
  Span x;
  double sharp_angle;
};

/// The tangent plane of a sector between sharp edges contains their tangents.
std::array<Combination, 2> bordered_base(const Work& w, const Sector& sector,
                                         const std::vector<Index>& ends, std::vector<Vec2>& q,
                                         bool& corner) {
  const std::vector<Index> sharp = creases(w.surface, w.flags, sector.vertex);
  const Crease one = crease_slope(sharp, sector.vertex, ends.front(), w.x, w.sharp_angle),
               two = crease_slope(sharp, sector.vertex, ends.back(), w.x, w.sharp_angle);
  const Vec2 e1 = q.front().normalized(), e2 = q.back().normalized();
  const double sine = e1.x() * e2.y() - e1.y() * e2.x();
  constexpr double parallel = 0.05;
  corner = !one.along && std::abs(sine) > parallel;
  if (corner) {
    Mat<2, 2> edges;
    edges << e1, e2;
    const Mat<2, 2> back = edges.inverse();
    return {sum(back(0, 0), one.slope, back(1, 0), two.slope),
            sum(back(0, 1), one.slope, back(1, 1), two.slope)};
  }
  const Vec2 across(-e1.y(), e1.x());
  Combination side;
  if (sector.corners.size() == 1) {
    side = side_of_corner(sector.vertex, ends, q, one.slope, e1, across);
  } else {
    const std::array<Combination, 2> fit = fitted_base(sector.vertex, ends, q, false);
    side = sum(across.x(), fit[0], across.y(), fit[1]);
  }
  if (one.along) q.back() = -q.back().norm() * e1;
  return {sum(e1.x(), one.slope, across.x(), side), sum(e1.y(), one.slope, across.y(), side)};
}

/// Frames of all corners of all facets.
std::vector<std::array<CornerFrame, 4>> corner_frames(const Work& w) {
  std::vector<std::array<CornerFrame, 4>> frames(w.surface.facets.size());
  std::vector<std::array<bool, 4>> done(frames.size());
  for (std::size_t f = 0; f < frames.size(); ++f)
    for (int k = 0; k < edge_count(w.surface.facets[f]); ++k) {
      if (done[f][static_cast<std::size_t>(k)]) continue;
      const Sector sector = sector_at(w.surface, w.flags, {static_cast<Index>(f), k});
      const std::vector<Index> ends = spokes(w.surface, sector);
      std::vector<Vec2> q = chart_of(w.surface, sector, ends, w.x);
      CornerFrame frame;
      frame.base = sector.closed ? fitted_base(sector.vertex, ends, q, true)
                                 : bordered_base(w, sector, ends, q, frame.sharp);
      frame.sharp = frame.sharp && sector.corners.size() == 1;
      for (std::size_t i = 0; i < sector.corners.size(); ++i) {
        const auto facet = static_cast<std::size_t>(sector.corners[i].facet);
        const auto local = static_cast<std::size_t>(sector.corners[i].local);
        frame.next = q[i];
        frame.previous = q[(i + 1) % q.size()];
        frames[facet][local] = frame;
        done[facet][local] = true;
      }
    }
  return frames;
}

Vec2 quarter_turn(const Vec2& v) { return {-v.y(), v.x()}; }

/// A border of a patch: its cubic curve and the derivative across it, by their Bernstein
/// coefficients.
struct Border {
  std::array<Combination, 4> curve, across;
};

/// Formula    across = k b + h curve' with b, k and h linear along the border; b is the same for
/// the
///            patch on the other side, k and h make `across` a tangent of the patch at both ends
Border border_of(const SurfaceFacet& facet, const std::array<CornerFrame, 4>& frames, int k) {
  const int edges = edge_count(facet);
  const CornerFrame &c0 = frames[static_cast<std::size_t>(k)],
                    &c1 = frames[static_cast<std::size_t>((k + 1) % edges)];
  const double length = c0.next.norm();
  const Vec2 e0 = c0.next / length, e1 = -c1.previous / length;
  Border out;
  out.curve[0] = {corner_node(facet, k), 1};
  out.curve[3] = {corner_node(facet, k + 1), 1};
  out.curve[1] = sum(1, out.curve[0], 1.0 / 3, tangent(c0, c0.next));
  out.curve[2] = sum(1, out.curve[3], 1.0 / 3, tangent(c1, c1.previous));
  const Vec2 far = edges == 3 ? Vec2(c1.next - c1.previous) : c1.next;
  const double k0 = c0.previous.dot(quarter_turn(e0)), h0 = c0.previous.dot(e0) / length;
  const double k1 = far.dot(quarter_turn(e1)), h1 = far.dot(e1) / length;
  const Combination b0 = tangent(c0, quarter_turn(e0)), b1 = tangent(c1, quarter_turn(e1));
  std::array<Combination, 3> speed;  // of the curve
  for (std::size_t i = 0; i < 3; ++i) speed[i] = sum(3, out.curve[i + 1], -3, out.curve[i]);
  out.across[0] = sum(k0, b0, h0, speed[0]);
  out.across[3] = sum(k1, b1, h1, speed[2]);
  out.across[1] = sum((k0 + k1) / 3, b0, k0 / 3, b1);
  out.across[1].add(2 * h0 / 3, speed[1]);
  out.across[1].add(h1 / 3, speed[0]);
  out.across[2] = sum(k1 / 3, b0, (k0 + k1) / 3, b1);
  out.across[2].add(h0 / 3, speed[2]);
  out.across[2].add(2 * h1 / 3, speed[1]);
  return out;
}

using Points = std::array<Combination, gregory_points>;

void add_quad_border(const Border& border, int k, Points& points) {
  const auto place = [&](std::size_t s, std::size_t r) {
    switch (k) {
      case 0:
        return quad_point(s, r);
      case 1:
        return quad_point(3 - r, s, r == 1);
      case 2:
        return quad_point(3 - s, 3 - r);
      default:
        return quad_point(r, 3 - s, r == 1);
    }
  };
  for (std::size_t s = 0; s < 4; ++s) points[place(s, 0)] = border.curve[s];
  for (std::size_t s = 1; s < 3; ++s)
    points[place(s, 1)] = sum(1, border.curve[s], 1.0 / 3, border.across[s]);
}

/// The border curve as one of degree 4, and the row of points beside it.
void add_triangle_border(const Border& border, int k, Points& points) {
  const auto at_corner = static_cast<std::size_t>(k);
  const std::array<Combination, 4>& c = border.curve;
  points[at_corner] = c[0];
  points[triangle_border(at_corner, 1)] = sum(0.25, c[0], 0.75, c[1]);
  points[triangle_border(at_corner, 2)] = sum(0.5, c[1], 0.5, c[2]);
  points[triangle_border(at_corner, 3)] = sum(0.75, c[2], 0.25, c[3]);
  points[triangle_inner(at_corner, false)] =
      sum(1, points[triangle_border(at_corner, 1)], 0.25, border.across[1]);
  points[triangle_inner((at_corner + 1) % 3, true)] =
      sum(1, points[triangle_border(at_corner, 2)], 0.25, border.across[2]);
}

SurfaceFacet with_patch(const SurfaceFacet& facet, const Points& points) {
  SurfaceFacet out = facet;
  GregoryWeights patch;
  patch.triangle = cell::is_triangle(facet.type);
  for (std::size_t j = 0; j < gregory_points; ++j)
    for (const auto& term : points[j].terms()) {
      const auto begin = out.nodes.begin(), end = begin + out.count;
      const auto found = std::find(begin, end, term.first);
      if (found == end) {
        if (out.count == cell::max_shape_nodes)
          throw core::GeometryError(
              "smoothing: too many facets meet at the nodes of one facet of the master; use "
              "smoothing: none");
        out.nodes[static_cast<std::size_t>(out.count++)] = term.first;
      }
      if (!std::isfinite(term.second))
        throw core::GeometryError(
            "smoothing: a facet of the master has no shape at one of its nodes");
      patch.weight[j][static_cast<std::size_t>(found - begin)] = term.second;
    }
  out.patch = std::make_shared<const GregoryWeights>(patch);
  return out;
}

}  // namespace

void smooth(FacetSurface& surface, std::span<const Vec3> reference, const Smoothing& options) {
  if (options.kind == SmoothingKind::none) return;
  const EdgeFlags flags = sharp_edges(surface, reference, options.sharp_angle);
  const auto frames = corner_frames({surface, flags, reference, options.sharp_angle});
  for (std::size_t f = 0; f < surface.facets.size(); ++f) {
    SurfaceFacet& facet = surface.facets[f];
    const int edges = edge_count(facet);
    const bool alone = edges == 0 || std::all_of(frames[f].begin(), frames[f].begin() + edges,
                                                 [](const CornerFrame& c) { return c.sharp; });
    if (alone) continue;
    Points points;
    for (int k = 0; k < edges; ++k) {
      const Border border = border_of(facet, frames[f], k);
      if (edges == 4)
        add_quad_border(border, k, points);
      else
        add_triangle_border(border, k, points);
    }
    facet = with_patch(facet, points);
  }
}

}  // namespace osculate::pairing
