#include "osculate/projection/point_to_facet.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "osculate/cell/quadratic_facet.hpp"
#include "osculate/cell/shape.hpp"
#include "osculate/projection/bilinear_distance.hpp"
#include "osculate/projection/inside_facet.hpp"
#include "osculate/projection/triangle.hpp"

namespace osculate::projection {
namespace {

/// A facet whose places and derivatives are asked for again and again.
struct Surface {
  cell::CellType type;
  std::span<const Vec3> nodes;
  std::optional<cell::QuadraticFacet> quadratic;

  Surface(cell::CellType of_type, std::span<const Vec3> of_nodes) : type(of_type), nodes(of_nodes) {
    if (!cell::is_linear_facet(type)) quadratic = cell::quadratic_facet(type, Node{nodes});
  }
  [[nodiscard]] cell::FacetDerivatives at(const Vec2& xi) const {
    return quadratic ? quadratic->at(xi) : cell::linear_facet(type, Node{nodes}, xi);
  }
  [[nodiscard]] DistanceJet2 distance_jet2(const Vec2& xi, const Vec3& point) const {
    const cell::FacetDerivatives r = at(xi);
    return projection::distance_jet2<3>(point - r[0], {r[1], r[2]}, {r[3], r[4], r[5]});
  }

 private:
  struct Node {
    std::span<const Vec3> of;
    const Vec3& operator()(std::size_t k) const { return of[k]; }
  };
};

/// Grid of starting points with its shape values.
struct Samples {
  int steps = 0;
  std::vector<Vec2> xi;
  std::vector<std::array<double, cell::max_shape_nodes>> shape;
  std::vector<bool> border;
};

Samples make_samples(cell::CellType type) {
  Samples out;
  const bool curved = cell::info(type).order > 1;
  out.steps = curved ? 6 : 2;
  for (int i = 0; i <= out.steps; ++i)
    for (int j = 0; j <= out.steps; ++j) {
      Vec2 xi(static_cast<double>(i) / out.steps, static_cast<double>(j) / out.steps);
      bool border = i == 0 || j == 0 || i == out.steps || j == out.steps;
      if (cell::is_triangle(type)) {
        if (i + j > out.steps) continue;
        border = i == 0 || j == 0 || i + j == out.steps;
      } else {
        xi = 2 * xi - Vec2::Ones();
      }
      out.xi.push_back(xi);
      out.shape.push_back(cell::facet_shape(type, xi, 0).n[0]);
      out.border.push_back(border);
    }
  return out;
}

const Samples& samples_of(cell::CellType type) {
  static const std::array<Samples, 5> all{
      make_samples(cell::CellType::tri3), make_samples(cell::CellType::tri6),
      make_samples(cell::CellType::quad4), make_samples(cell::CellType::quad8),
      make_samples(cell::CellType::quad9)};
  switch (type) {
    case cell::CellType::tri3:
      return all[0];
    case cell::CellType::tri6:
      return all[1];
    case cell::CellType::quad4:
      return all[2];
    case cell::CellType::quad8:
      return all[3];
    default:
      return all[4];
  }
}

/// The nearest point of the grid, moved a little inwards, and how near the border can be at least.
struct Start {
  Vec2 xi{0, 0};
  double border = 0;
};

Start nearest_sample(cell::CellType type, std::span<const Vec3> nodes, const Vec3& point) {
  const Samples& samples = samples_of(type);
  double best = std::numeric_limits<double>::infinity(), border = best;
  std::size_t at = 0;
  for (std::size_t i = 0; i < samples.xi.size(); ++i) {
    Vec3 r = Vec3::Zero();
    for (std::size_t k = 0; k < nodes.size(); ++k) r += samples.shape[i][k] * nodes[k];
    const double d = (point - r).squaredNorm();
    if (d < best) best = d, at = i;
    if (samples.border[i]) border = std::min(border, d);
  }
  double edge = 0;  // longest piece of border between two samples, with room for its curvature
  const std::size_t corners = cell::is_triangle(type) ? 3 : 4;
  for (std::size_t k = 0; k < corners; ++k)
    edge = std::max(edge, (nodes[(k + 1) % corners] - nodes[k]).norm());
  return {0.98 * samples.xi[at] + 0.02 * middle_of_cell(type),
          std::sqrt(border) - edge / samples.steps};
}

/// The foot inside a plane triangle in closed form.
FacetFoot foot_inside_triangle(std::span<const Vec3> nodes, const Vec3& point) {
  FacetFoot foot;
  const TriangleFoot nearest = closest_on_triangle(nodes[0], nodes[1], nodes[2], point);
  if (nearest.pressed != 0 || !std::isfinite(nearest.squared_distance)) return foot;
  foot.xi = nearest.xi;
  foot.squared_distance = nearest.squared_distance;
  foot.converged = true;
  foot.feature = Feature::face;
  return foot;
}

/// Newton inside a facet of four corners whose distance is convex, from its middle. Feature none if
/// the way leads out of it, or takes too long.
FacetFoot foot_inside_convex(const BilinearDistance& distance) {
  constexpr int most = 12;
  constexpr double pressed = 1e-12, small = 1e-12;
  FacetFoot foot;
  foot.xi = middle_of_cell(cell::CellType::quad4);
  Vec2 slope = distance.slope(foot.xi);
  for (int it = 0; it < most; ++it) {
    const Vec2 step = distance.step(foot.xi, slope);
    const double part = inside_part(cell::CellType::quad4, foot.xi, step);
    if (!step.allFinite() || part < pressed) return foot;
    const Vec2 next_xi = foot.xi + part * step, next = distance.slope(next_xi);
    if (part == 1 && step.squaredNorm() <= small * small) {  // the rest is rounding
      if (next.squaredNorm() < slope.squaredNorm()) foot.xi = next_xi;
      foot.squared_distance = distance.squared_distance(foot.xi);
      foot.converged = true;
      foot.feature = Feature::face;
      return foot;
    }
    foot.xi = next_xi;
    slope = next;
  }
  return foot;
}

/// An edge as a curve over t = -1..1: straight, or through its middle node.
struct Edge {
  Vec3 middle, half, bend;  ///< r = middle + t half + t^2 bend
  [[nodiscard]] Vec3 at(double t) const { return middle + t * half + t * t * bend; }
};

Edge edge_of(cell::CellType type, std::span<const Vec3> nodes, int edge) {
  const std::size_t corners = cell::is_triangle(type) ? 3 : 4;
  const auto k = static_cast<std::size_t>(edge);
  const Vec3 a = nodes[k], b = nodes[(k + 1) % corners];
  if (cell::info(type).order == 1) return {0.5 * (a + b), 0.5 * (b - a), Vec3::Zero()};
  const Vec3 m = nodes[corners + k];
  return {m, 0.5 * (b - a), 0.5 * (a + b) - m};
}

/// A lower bound of the distance: an edge is at most |bend| away from its chord.
double least_distance(const Edge& e, const Vec3& point) {
  const Vec3 from_chord = point - e.middle - e.bend;
  const double size = std::max(e.half.squaredNorm(), 1e-300);
  const double t = std::clamp(from_chord.dot(e.half) / size, -1.0, 1.0);
  return (from_chord - t * e.half).norm() - e.bend.norm();
}

/// As `polish` of a facet, along an edge.
void polish(const Edge& e, const Vec3& point, double& t, double& squared) {
  const auto slope = [&](double s) { return -(point - e.at(s)).dot(e.half + 2 * s * e.bend); };
  double before = std::abs(slope(t));
  for (int it = 0; it < 3; ++it) {
    const Vec3 first = e.half + 2 * t * e.bend;
    const double bend = first.squaredNorm() - 2 * (point - e.at(t)).dot(e.bend);
    if (!(bend > 0)) return;
    const double next = t - slope(t) / bend;
    const double after = std::abs(slope(next));
    if (!(std::abs(next) <= 1) || !(after < before)) return;
    t = next;
    before = after;
    squared = (point - e.at(t)).squaredNorm();
  }
}

/// Safeguarded Newton for the minimum below t; never farther away than that.
void descend(const Edge& e, const Vec3& point, double& t, double& squared) {
  const auto distance = [&](double s) { return (point - e.at(s)).squaredNorm(); };
  for (int it = 0; it < 40; ++it) {
    const Vec3 gap = point - e.at(t), first = e.half + 2 * t * e.bend;
    const double a = first.squaredNorm();
    const double slope = -gap.dot(first);  // @eq KSCPP:37
    const double bend = a - 2 * gap.dot(e.bend);
    double step = -slope / (bend > 0 ? bend : std::max(a, 1e-300));
    step = std::clamp(t + step, -1.0, 1.0) - t;
    double d = distance(t + step);
    for (int half = 0; half < 30 && d > squared * (1 + 1e-14); ++half)
      step *= 0.5, d = distance(t + step);
    if (!(d <= squared * (1 + 1e-14))) break;
    t += step;
    squared = d;
    if (std::abs(step) <= 1e-15) break;
  }
  polish(e, point, t, squared);
}

/// The nearest t in -1..1: of a straight edge at once, of a bent one by Newton's method from each
/// sample that none beside it is nearer than (the distance has two minima at most).
double nearest_on_edge(const Edge& e, const Vec3& point, double& squared) {
  const auto distance = [&](double t) { return (point - e.at(t)).squaredNorm(); };
  if (e.bend.isZero(0.0)) {
    const double size = std::max(e.half.squaredNorm(), 1e-300);
    const double t = std::clamp((point - e.middle).dot(e.half) / size, -1.0, 1.0);
    squared = distance(t);
    return t;
  }
  constexpr std::size_t samples = 7;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto place = [](std::size_t i) { return (static_cast<double>(i) - 3) / 3; };
  std::array<double, samples + 2> d;  // with one beyond each end
  d.front() = d.back() = infinity;
  for (std::size_t i = 0; i < samples; ++i) d[i + 1] = distance(place(i));
  double nearest = 0;
  squared = infinity;
  for (std::size_t i = 0; i < samples; ++i) {
    if (!(d[i + 1] <= d[i] && d[i + 1] < d[i + 2])) continue;
    double t = place(i), there = d[i + 1];
    descend(e, point, t, there);
    if (there < squared) nearest = t, squared = there;
  }
  return nearest;
}

FacetFoot foot_at(cell::CellType type, int edge, double t, double squared) {
  const int corners = cell::is_triangle(type) ? 3 : 4;
  FacetFoot foot;
  foot.squared_distance = squared;
  const Vec2 from = cell::area_node(type, edge), to = cell::area_node(type, (edge + 1) % corners);
  foot.converged = std::isfinite(foot.squared_distance);
  foot.xi = 0.5 * (from + to) + t * 0.5 * (to - from);
  foot.feature = std::abs(t) < 1 ? Feature::edge : Feature::corner;
  foot.local = std::abs(t) < 1 ? edge : t > 0 ? (edge + 1) % corners : edge;
  return foot;
}

/// The nearest of the edges, if that is nearer than `best`.
void compare_border(cell::CellType type, std::span<const Vec3> nodes, const Vec3& point,
                    FacetFoot& best) {
  constexpr double rounding = 1 - 1e-14;
  const int edges = cell::is_triangle(type) ? 3 : 4;
  double nearest = best.squared_distance, at = 0;
  int edge = -1;
  for (int k = 0; k < edges; ++k) {
    const Edge e = edge_of(type, nodes, k);
    if (least_distance(e, point) > std::sqrt(nearest)) continue;
    double squared = 0;
    const double t = nearest_on_edge(e, point, squared);
    if (squared < nearest * rounding) nearest = squared, edge = k, at = t;
  }
  if (edge >= 0) best = foot_at(type, edge, at, nearest);
}

/// The same as `closest_point` where the distance from a facet of four corners is convex, which
/// leaves no doubt about the one minimum that there is. Feature none: it is not, or there is doubt.
FacetFoot closest_on_convex(std::span<const Vec3> nodes, const Vec3& point,
                            const BilinearDistance& distance) {
  if (!distance.convex()) return {};
  FacetFoot best = foot_inside_convex(distance);
  if (best.feature == Feature::face) return best;
  best = {};
  compare_border(cell::CellType::quad4, nodes, point, best);
  return distance.nothing_inwards(best.xi) ? best : FacetFoot{};
}

/// Of all others: from the nearest sample, along the edges, and from there inwards.
template <class Distance>
FacetFoot closest_from_samples(cell::CellType type, std::span<const Vec3> nodes, const Vec3& point,
                               const Distance& distance) {
  constexpr double last_step = 1e-15;
  const Start start = nearest_sample(type, nodes, point);
  FacetFoot best = foot_inside(type, distance, start.xi, last_step);
  // Nothing on the border can be nearer than this.
  if (start.border > 0 && best.feature == Feature::face &&
      best.squared_distance <= start.border * start.border)
    return best;
  if (best.feature != Feature::face) best = {};
  compare_border(type, nodes, point, best);
  look_inwards(type, distance, last_step, best);
  return best;
}

BilinearDistance bilinear_distance(std::span<const Vec3> nodes, const Vec3& point) {
  return {nodes[0], nodes[1], nodes[2], nodes[3], point};
}

}  // namespace

FacetFoot closest_point_on_edge(cell::CellType type, std::span<const Vec3> nodes, int edge,
                                const Vec3& point) {
  double squared = std::numeric_limits<double>::infinity();
  const double t = nearest_on_edge(edge_of(type, nodes, edge), point, squared);
  return foot_at(type, edge, t, squared);
}

FacetFoot closest_point(cell::CellType type, std::span<const Vec3> nodes, const Vec3& point) {
  if (type == cell::CellType::tri3) {
    FacetFoot best = foot_inside_triangle(nodes, point);
    if (best.feature != Feature::face) compare_border(type, nodes, point, best = {});
    return best;
  }
  if (type == cell::CellType::quad4) {
    const BilinearDistance distance = bilinear_distance(nodes, point);
    const FacetFoot best = closest_on_convex(nodes, point, distance);
    if (best.feature != Feature::none) return best;
    return closest_from_samples(type, nodes, point,
                                [&](const Vec2& xi) { return distance.jet(xi); });
  }
  const Surface surface(type, nodes);
  return closest_from_samples(type, nodes, point,
                              [&](const Vec2& xi) { return surface.distance_jet2(xi, point); });
}

bool release(cell::CellType type, std::span<const Vec3> nodes, const Vec3& point, double extension,
             FacetFoot& foot) {
  if (type == cell::CellType::quad4) {
    const BilinearDistance distance = bilinear_distance(nodes, point);
    return release_along(
        type, [&](const Vec2& xi) { return distance.jet(xi); }, extension, foot);
  }
  const Surface surface(type, nodes);
  return release_along(
      type, [&](const Vec2& xi) { return surface.distance_jet2(xi, point); }, extension, foot);
}

}  // namespace osculate::projection
