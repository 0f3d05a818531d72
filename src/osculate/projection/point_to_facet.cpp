#include "osculate/projection/point_to_facet.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "osculate/cell/shape.hpp"

namespace osculate::projection {
namespace {

/// Squared distance and its derivatives at one point of the facet.
struct DistanceJet2 {
  double squared_distance = 0;
  Vec2 slope{0, 0};                      ///< F_i
  Mat<2, 2> bend = Mat<2, 2>::Zero();    ///< F_ij
  Mat<2, 2> metric = Mat<2, 2>::Zero();  ///< a_ij
};

DistanceJet2 distance_jet2(cell::CellType type, std::span<const Vec3> nodes, const Vec2& xi,
                           const Vec3& point) {
  const cell::FacetShape s = cell::facet_shape(type, xi);
  std::array<Vec3, 6> r;
  r.fill(Vec3::Zero());
  for (std::size_t d = 0; d < r.size(); ++d)
    for (std::size_t k = 0; k < nodes.size(); ++k) r[d] += s.n[d][k] * nodes[k];
  const Vec3 gap = point - r[0];
  DistanceJet2 j;
  j.squared_distance = gap.squaredNorm();
  j.slope = {-gap.dot(r[1]), -gap.dot(r[2])};  // @eq KSVD:15
  j.metric << r[1].dot(r[1]), r[1].dot(r[2]), r[1].dot(r[2]), r[2].dot(r[2]);
  Mat<2, 2> second;
  second << gap.dot(r[3]), gap.dot(r[4]), gap.dot(r[4]), gap.dot(r[5]);
  j.bend = j.metric - second;  // @eq KSVD:16
  return j;
}

bool positive(const Mat<2, 2>& m) { return m(0, 0) > 0 && m.determinant() > 0; }

/// Downhill step: Newton's where the distance bends upwards, else Gauss-Newton's.
Vec2 descent(const DistanceJet2& j) {
  if (positive(j.bend)) return -j.bend.inverse() * j.slope;
  if (positive(j.metric)) return -j.metric.inverse() * j.slope;
  return -j.slope / std::max(j.metric.trace(), 1e-300);
}

/// How far a point is outside of the reference cell (0 inside), in parts of its range.
double outside(cell::CellType type, const Vec2& xi) {
  if (cell::is_triangle(type)) return std::max({0.0, -xi.x(), -xi.y(), xi.x() + xi.y() - 1});
  return std::max({0.0, 0.5 * (std::abs(xi.x()) - 1), 0.5 * (std::abs(xi.y()) - 1)});
}

/// Largest part of the step that stays inside.
double inside_part(cell::CellType type, const Vec2& xi, const Vec2& step) {
  double part = 1;
  const auto limit = [&](double room, double way) {
    if (way > room) part = std::min(part, std::max(room, 0.0) / way);
  };
  if (cell::is_triangle(type)) {
    limit(xi.x(), -step.x());
    limit(xi.y(), -step.y());
    limit(1 - xi.x() - xi.y(), step.x() + step.y());
    return part;
  }
  for (Eigen::Index i = 0; i < 2; ++i) {
    limit(1 - xi[i], step[i]);
    limit(1 + xi[i], -step[i]);
  }
  return part;
}

/// Grid of starting points.
Vec2 nearest_sample(cell::CellType type, std::span<const Vec3> nodes, const Vec3& point) {
  const bool curved = nodes.size() > 4;
  const int steps = cell::is_triangle(type) && !curved ? 1 : curved ? 6 : 2;
  Vec2 best(0, 0);
  double distance = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= steps; ++j) {
      Vec2 xi(static_cast<double>(i) / steps, static_cast<double>(j) / steps);
      if (cell::is_triangle(type))
        xi.y() *= 1 - xi.x();
      else
        xi = 2 * xi - Vec2::Ones();
      const cell::FacetShape s = cell::facet_shape(type, xi);
      Vec3 r = Vec3::Zero();
      for (std::size_t k = 0; k < nodes.size(); ++k) r += s.n[0][k] * nodes[k];
      const double d = (point - r).squaredNorm();
      if (d < distance) distance = d, best = xi;
    }
  return 0.98 * best + 0.02 * (cell::is_triangle(type) ? Vec2(1.0 / 3, 1.0 / 3) : Vec2(0, 0));
}

/// Safeguarded Newton inside the facet. Feature none if the way leads out of it.
FacetFoot foot_inside(cell::CellType type, std::span<const Vec3> nodes, const Vec3& point) {
  FacetFoot foot;
  foot.xi = nearest_sample(type, nodes, point);
  DistanceJet2 j = distance_jet2(type, nodes, foot.xi, point);
  constexpr int most = 40;
  for (int it = 0; it < most; ++it) {
    Vec2 step = descent(j);
    if (!step.allFinite()) return foot;
    if (step.norm() <= 1e-15) break;
    const double part = inside_part(type, foot.xi, step);
    if (part < 1e-12) return foot;  // pressed against the border: an edge is nearer
    step *= part;
    DistanceJet2 next = distance_jet2(type, nodes, foot.xi + step, point);
    for (int half = 0; half < 30 && next.squared_distance > j.squared_distance * (1 + 1e-14);
         ++half) {
      step *= 0.5;
      next = distance_jet2(type, nodes, foot.xi + step, point);
    }
    if (next.squared_distance > j.squared_distance * (1 + 1e-14)) break;
    foot.xi += step;
    j = next;
    if (part == 1 && step.norm() <= 1e-15) break;
  }
  foot.squared_distance = j.squared_distance;
  foot.converged = positive(j.bend) || j.slope.norm() <= 1e-12 * j.metric.trace();
  foot.feature = foot.converged ? Feature::face : Feature::none;
  return foot;
}

/// The edge as a curve over t = -1..1: position and its first two derivatives.
std::array<Vec3, 3> edge_jet(cell::CellType type, std::span<const Vec3> nodes, const Vec2& xi,
                             const Vec2& e) {
  const cell::FacetShape s = cell::facet_shape(type, xi);
  std::array<Vec3, 3> r{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    r[0] += s.n[0][k] * nodes[k];
    r[1] += (e.x() * s.n[1][k] + e.y() * s.n[2][k]) * nodes[k];
    r[2] +=
        (e.x() * e.x() * s.n[3][k] + 2 * e.x() * e.y() * s.n[4][k] + e.y() * e.y() * s.n[5][k]) *
        nodes[k];
  }
  return r;
}

}  // namespace

FacetFoot closest_point_on_edge(cell::CellType type, std::span<const Vec3> nodes, int edge,
                                const Vec3& point) {
  const int corners = cell::is_triangle(type) ? 3 : 4;
  const Vec2 from = cell::area_node(type, edge), to = cell::area_node(type, (edge + 1) % corners);
  const Vec2 middle = 0.5 * (from + to), e = 0.5 * (to - from);
  const auto squared = [&](double t) {
    return (point - edge_jet(type, nodes, middle + t * e, e)[0]).squaredNorm();
  };
  double t = 0, best = std::numeric_limits<double>::infinity();
  for (int i = -4; i <= 4; ++i)
    if (const double d = squared(0.25 * i); d < best) best = d, t = 0.25 * i;
  for (int it = 0; it < 40; ++it) {
    const std::array<Vec3, 3> r = edge_jet(type, nodes, middle + t * e, e);
    const Vec3 gap = point - r[0];
    const double slope = -gap.dot(r[1]), a = r[1].squaredNorm(), bend = a - gap.dot(r[2]);
    double step = -slope / (bend > 0 ? bend : std::max(a, 1e-300));
    step = std::clamp(t + step, -1.0, 1.0) - t;
    double d = squared(t + step);
    for (int half = 0; half < 30 && d > best * (1 + 1e-14); ++half)
      step *= 0.5, d = squared(t + step);
    if (!(d <= best * (1 + 1e-14))) break;
    t += step;
    best = d;
    if (std::abs(step) <= 1e-15) break;
  }
  FacetFoot foot;
  foot.converged = std::isfinite(best);
  foot.squared_distance = best;
  foot.xi = middle + t * e;
  foot.feature = std::abs(t) < 1 ? Feature::edge : Feature::corner;
  foot.local = std::abs(t) < 1 ? edge : t > 0 ? (edge + 1) % corners : edge;
  return foot;
}

FacetFoot closest_point(cell::CellType type, std::span<const Vec3> nodes, const Vec3& point) {
  FacetFoot best = foot_inside(type, nodes, point);
  // At a minimum inside, the border of a flat facet cannot be nearer.
  if (best.feature == Feature::face && type == cell::CellType::tri3) return best;
  if (best.feature != Feature::face) best = {};
  const int edges = cell::is_triangle(type) ? 3 : 4;
  for (int k = 0; k < edges; ++k) {
    const FacetFoot foot = closest_point_on_edge(type, nodes, k, point);
    if (foot.converged && foot.squared_distance < best.squared_distance * (1 - 1e-14)) best = foot;
  }
  return best;
}

bool release(cell::CellType type, std::span<const Vec3> nodes, const Vec3& point, double extension,
             FacetFoot& foot) {
  Vec2 xi = foot.xi;
  DistanceJet2 j = distance_jet2(type, nodes, xi, point);
  for (int it = 0; it < 12; ++it) {
    if (!positive(j.bend)) return false;
    const Vec2 step = -j.bend.inverse() * j.slope;
    xi += step;
    if (!(outside(type, xi) <= extension)) return false;
    j = distance_jet2(type, nodes, xi, point);
    if (step.norm() <= 1e-15) break;
  }
  if (!positive(j.bend)) return false;
  foot.xi = xi;
  foot.squared_distance = j.squared_distance;
  foot.feature = Feature::face;
  foot.local = -1;
  return true;
}

}  // namespace osculate::projection
