#include "osculate/pairing/closest_patch.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "osculate/cell/shape.hpp"
#include "osculate/projection/inside_facet.hpp"

namespace osculate::pairing {
namespace {

using projection::DistanceJet2;
using projection::FacetFoot;
using projection::Feature;

DistanceJet2 distance_at(const PatchQuery& q, const Vec2& xi) {
  const GregoryJet jet = gregory_jet(cell::is_triangle(q.type), q.points, xi);
  const auto r = [&](std::size_t d) -> Vec3 { return jet[d].head<3>(); };
  return projection::distance_jet2<3>(q.point - r(0), {r(1), r(2)}, {r(3), r(4), r(5)});
}

/// A border as a polynomial of t in 0..1.
struct EdgeCurve {
  std::size_t degree = 3;
  std::array<Vec3, 5> c;

  [[nodiscard]] std::array<Vec3, 3> at(double t) const {
    std::array<Vec3, 3> r{c[degree], Vec3::Zero(), Vec3::Zero()};
    for (std::size_t k = degree; k-- > 0;) {
      r[2] = t * r[2] + 2 * r[1];
      r[1] = t * r[1] + r[0];
      r[0] = t * r[0] + c[k];
    }
    return r;
  }
};

EdgeCurve edge_curve(const PatchQuery& q, int edge) {
  const auto k = static_cast<std::size_t>(edge);
  EdgeCurve out;
  std::array<Vec3, 5> b;
  b.fill(Vec3::Zero());
  const auto point = [&](std::size_t j) -> Vec3 { return q.points[j].head<3>(); };
  if (cell::is_triangle(q.type)) {
    out.degree = 4;
    b[0] = point(k);
    for (std::size_t s = 1; s < 4; ++s) b[s] = point(triangle_border(k, s));
    b[4] = point((k + 1) % 3);
  } else {
    for (std::size_t s = 0; s < 4; ++s) {
      const std::array<std::size_t, 4> place{quad_point(s, 0), quad_point(3, s),
                                             quad_point(3 - s, 3), quad_point(0, 3 - s)};
      b[s] = point(place[k]);
    }
  }
  double binomial = 1;  // powers from forward differences of the control points
  for (std::size_t d = 0; d <= out.degree; ++d) {
    out.c[d] = binomial * b[0];
    for (std::size_t j = 0; j + d < out.degree; ++j) b[j] = b[j + 1] - b[j];
    binomial *= static_cast<double>(out.degree - d) / static_cast<double>(d + 1);
  }
  return out;
}

/// As projection::polish, along an edge.
void polish(const EdgeCurve& e, const Vec3& point, double& t, double& squared) {
  for (int it = 0; it < 3; ++it) {
    const std::array<Vec3, 3> r = e.at(t);
    const double slope = -(point - r[0]).dot(r[1]);
    const double bend = r[1].squaredNorm() - (point - r[0]).dot(r[2]);
    if (!(bend > 0)) return;
    const double next = t - slope / bend;
    if (!(next >= 0 && next <= 1)) return;
    const std::array<Vec3, 3> there = e.at(next);
    if (!(std::abs((point - there[0]).dot(there[1])) < std::abs(slope))) return;
    t = next;
    squared = (point - there[0]).squaredNorm();
  }
}

/// Safeguarded Newton for the nearest t, from the nearest of five samples.
double nearest_on_edge(const EdgeCurve& e, const Vec3& point, double& squared) {
  const auto distance = [&](double t) { return (point - e.at(t)[0]).squaredNorm(); };
  double t = 0;
  squared = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= 4; ++i)
    if (const double d = distance(0.25 * i); d < squared) squared = d, t = 0.25 * i;
  for (int it = 0; it < 40; ++it) {
    const std::array<Vec3, 3> r = e.at(t);
    const double slope = -(point - r[0]).dot(r[1]), a = r[1].squaredNorm();
    const double bend = a - (point - r[0]).dot(r[2]);
    double step = -slope / (bend > 0 ? bend : std::max(a, 1e-300));
    step = std::clamp(t + step, 0.0, 1.0) - t;
    double d = distance(t + step);
    for (int half = 0; half < 30 && d > squared * (1 + 1e-14); ++half)
      step *= 0.5, d = distance(t + step);
    if (!(d <= squared * (1 + 1e-14))) break;
    t += step;
    squared = d;
    if (std::abs(step) <= 1e-7) break;
  }
  polish(e, point, t, squared);
  return t;
}

}  // namespace

FacetFoot closest_on_patch_edge(const PatchQuery& query, int edge) {
  const int corners = cell::is_triangle(query.type) ? 3 : 4;
  FacetFoot foot;
  const double t = nearest_on_edge(edge_curve(query, edge), query.point, foot.squared_distance);
  const Vec2 from = cell::area_node(query.type, edge),
             to = cell::area_node(query.type, (edge + 1) % corners);
  foot.converged = std::isfinite(foot.squared_distance);
  foot.xi = (1 - t) * from + t * to;
  const bool inner = t > 0 && t < 1;
  foot.feature = inner ? Feature::edge : Feature::corner;
  foot.local = inner || t <= 0 ? edge : (edge + 1) % corners;
  return foot;
}

FacetFoot closest_on_patch(const PatchQuery& query, const Vec2& start) {
  constexpr double last_step = 1e-7, near_border = 0.01;
  const auto distance = [&](const Vec2& xi) { return distance_at(query, xi); };
  Vec2 begin = start;
  if (!(projection::least_room(query.type, start) > near_border))  // a little inwards
    begin += 0.02 * (projection::middle_of_cell(query.type) - start);
  FacetFoot best = projection::foot_inside(query.type, distance, begin, last_step);
  if (best.feature == Feature::face && projection::least_room(query.type, best.xi) > near_border)
    return best;
  if (best.feature != Feature::face) best = {};
  const int edges = cell::is_triangle(query.type) ? 3 : 4;
  for (int k = 0; k < edges; ++k) {
    const FacetFoot foot = closest_on_patch_edge(query, k);
    if (foot.converged && foot.squared_distance < best.squared_distance * (1 - 1e-14)) best = foot;
  }
  projection::look_inwards(query.type, distance, last_step, best);
  return best;
}

bool release_from_patch(const PatchQuery& query, double extension, FacetFoot& foot) {
  return projection::release_along(
      query.type, [&](const Vec2& xi) { return distance_at(query, xi); }, extension, foot);
}

}  // namespace osculate::pairing
