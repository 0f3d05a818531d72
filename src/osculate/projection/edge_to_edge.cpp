#include "osculate/projection/edge_to_edge.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "osculate/cell/line_shape.hpp"
#include "osculate/geometry/curve_jet.hpp"
#include "osculate/projection/surface_distance.hpp"

namespace osculate::projection {
namespace {

constexpr double parallel = 0.0871557427476582;  // sin(5 degrees)
constexpr double limit = 1 + edge_extension;

geometry::CurveJet<3> jet_of(std::span<const Vec3> nodes, double xi) {
  const cell::LineShape shape = cell::lagrange_line(static_cast<int>(nodes.size()), xi);
  geometry::CurveJet<3> jet;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    jet.r += shape.n[0][k] * nodes[k];
    jet.r1 += shape.n[1][k] * nodes[k];
    jet.r2 += shape.n[2][k] * nodes[k];
  }
  return jet;
}

/// F and its derivatives with respect to both coordinates.
struct Distance {
  double value = 0;
  Vec2 slope;
  Mat<2, 2> metric;  ///< of the difference of both curves: Gauss and Newton's part of `bend`
  Mat<2, 2> bend;
};

Distance distance_at(std::span<const Vec3> first, std::span<const Vec3> second, const Vec2& xi) {
  const geometry::CurveJet<3> r = jet_of(first, xi[0]), s = jet_of(second, xi[1]);
  const Vec3 apart = s.r - r.r;
  Distance d;
  d.value = 0.5 * apart.squaredNorm();
  d.slope = {-apart.dot(r.r1), apart.dot(s.r1)};
  d.metric << r.r1.squaredNorm(), -r.r1.dot(s.r1), -r.r1.dot(s.r1), s.r1.squaredNorm();
  d.bend = d.metric;
  d.bend(0, 0) -= apart.dot(r.r2);
  d.bend(1, 1) += apart.dot(s.r2);
  return d;
}

/// sin^2 of the angle between the tangents, times both squared lengths, is the determinant.
bool crossing(const Mat<2, 2>& metric) {
  return metric.determinant() > parallel * parallel * metric(0, 0) * metric(1, 1);
}

bool within(const Vec2& xi) { return xi.cwiseAbs().maxCoeff() <= limit; }

EdgesFoot straight(std::span<const Vec3> first, std::span<const Vec3> second) {
  EdgesFoot foot;
  const Distance d = distance_at(first, second, {0, 0});
  if (!crossing(d.metric)) return foot;
  foot.xi = -d.metric.inverse() * d.slope;
  foot.converged = within(foot.xi);
  foot.squared_distance = 2 * distance_at(first, second, foot.xi).value;
  return foot;
}

/// Newton's method from `xi`; where it is not descending, Gauss and Newton's.
EdgesFoot descend(std::span<const Vec3> first, std::span<const Vec3> second, Vec2 xi) {
  EdgesFoot foot;
  Distance d = distance_at(first, second, xi);
  for (int i = 0; i < 50; ++i) {
    const Mat<2, 2>& m = positive(d.bend) ? d.bend : d.metric;
    if (!positive(m)) return foot;
    Vec2 step = -m.inverse() * d.slope;
    if (!(step.norm() > 1e-15)) break;
    if (step.norm() > 0.5) step *= 0.5 / step.norm();
    Distance next = distance_at(first, second, xi + step);
    int halvings = 0;
    while (next.value > d.value && ++halvings < 30) {
      step *= 0.5;
      next = distance_at(first, second, xi + step);
    }
    if (next.value > d.value) break;  // round-off
    xi += step;
    d = next;
    if (xi.cwiseAbs().maxCoeff() > 2) return foot;
  }
  if (positive(d.bend)) {  // the line search stops at the round-off of F, the slope is finer
    const Vec2 last = -d.bend.inverse() * d.slope;
    if (last.norm() < 1e-5) xi += last;
    d = distance_at(first, second, xi);
  }
  foot.xi = xi;
  foot.squared_distance = 2 * d.value;
  const double small =
      1e-9 * std::sqrt(d.metric.trace()) * (std::sqrt(2 * d.value) + std::sqrt(d.metric.trace()));
  foot.converged = positive(d.bend) && crossing(d.metric) && within(xi) && d.slope.norm() <= small;
  return foot;
}

EdgesFoot curved(std::span<const Vec3> first, std::span<const Vec3> second) {
  constexpr std::array<double, 5> grid{-1, -0.5, 0, 0.5, 1};
  struct Start {
    double value;
    Vec2 xi;
  };
  std::array<Start, grid.size() * grid.size()> starts;
  for (std::size_t i = 0; i < grid.size(); ++i)
    for (std::size_t j = 0; j < grid.size(); ++j) {
      const Vec2 xi(grid[i], grid[j]);
      starts[grid.size() * i + j] = {distance_at(first, second, xi).value, xi};
    }
  std::stable_sort(starts.begin(), starts.end(),
                   [](const Start& a, const Start& b) { return a.value < b.value; });
  EdgesFoot best;
  for (std::size_t i = 0; i < 4; ++i) {
    const EdgesFoot foot = descend(first, second, starts[i].xi);
    if (foot.converged && foot.squared_distance < best.squared_distance) best = foot;
  }
  return best;
}

}  // namespace

EdgesFoot closest_points(std::span<const Vec3> first, std::span<const Vec3> second) {
  for (const std::span<const Vec3> nodes : {first, second})
    for (const Vec3& x : nodes)
      if (!x.allFinite()) return {};
  return first.size() == 2 && second.size() == 2 ? straight(first, second) : curved(first, second);
}

}  // namespace osculate::projection
