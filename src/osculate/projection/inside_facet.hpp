#pragma once
#include <algorithm>
#include <cmath>

#include "osculate/projection/point_to_facet.hpp"
#include "osculate/projection/surface_distance.hpp"

// Newton's method for the nearest place of one facet, whatever its surface is: `distance(xi)` is
// the DistanceJet2 of the point there.
//
// Tested by  tests/unit/projection/test_point_to_facet.cpp,
// tests/unit/pairing/test_smooth_surface.cpp

namespace osculate::projection {

[[nodiscard]] inline Vec2 middle_of_cell(cell::CellType type) {
  return cell::is_triangle(type) ? Vec2(1.0 / 3, 1.0 / 3) : Vec2(0, 0);
}

/// Distance from the border of the cell, inwards, in parts of its range; negative outside.
[[nodiscard]] inline double least_room(cell::CellType type, const Vec2& xi) {
  if (cell::is_triangle(type)) return std::min({xi.x(), xi.y(), 1 - xi.x() - xi.y()});
  return std::min(0.5 * (1 - std::abs(xi.x())), 0.5 * (1 - std::abs(xi.y())));
}

/// Largest part of the step that stays inside.
[[nodiscard]] inline double inside_part(cell::CellType type, const Vec2& xi, const Vec2& step) {
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

/// Takes full Newton steps that the distance is too coarse to judge (it is flat where it is
/// smallest: of 1e-16 relative, 1e-8 of the way), while the slope shrinks. Without them the slip is
/// noisy by that much, and no increment gets below it.
template <class Distance>
void polish(cell::CellType type, const Distance& distance, Vec2& xi, DistanceJet2& j) {
  for (int it = 0; it < 3 && positive(j.bend); ++it) {
    const Vec2 next_xi = xi + descent(j);
    if (next_xi == xi || !next_xi.allFinite() || least_room(type, next_xi) < 0) return;
    const DistanceJet2 next = distance(next_xi);
    if (!(next.slope.norm() < j.slope.norm())) return;
    xi = next_xi;
    j = next;
  }
}

/// Safeguarded Newton inside the facet, which never goes farther away than `start` is; `small`: the
/// last step. Feature none if the way leads out of it.
template <class Distance>
[[nodiscard]] FacetFoot foot_inside(cell::CellType type, const Distance& distance,
                                    const Vec2& start, double small) {
  FacetFoot foot;
  foot.xi = start;
  DistanceJet2 j = distance(foot.xi);
  constexpr int most = 40;
  for (int it = 0; it < most; ++it) {
    Vec2 step = descent(j);
    if (!step.allFinite()) return foot;
    if (step.norm() <= 1e-15) break;
    const double part = inside_part(type, foot.xi, step);
    if (part < 1e-12) return foot;  // pressed against the border
    step *= part;
    DistanceJet2 next = distance(foot.xi + step);
    for (int half = 0; half < 30 && next.squared_distance > j.squared_distance * (1 + 1e-14);
         ++half) {
      step *= 0.5;
      next = distance(foot.xi + step);
    }
    if (next.squared_distance > j.squared_distance * (1 + 1e-14)) break;
    foot.xi += step;
    j = next;
    if (part == 1 && step.norm() <= small) break;
  }
  polish(type, distance, foot.xi, j);
  foot.squared_distance = j.squared_distance;
  foot.converged = positive(j.bend) || j.slope.norm() <= 1e-12 * j.metric.trace();
  foot.feature = foot.converged ? Feature::face : Feature::none;
  return foot;
}

/// A step that was cut at the border may end there though the nearest place is inside. Where the
/// way inwards from the nearest place of all edges is downhill, the iteration begins anew there:
/// its first step leads inwards, since the distance is level along the edge.
template <class Distance>
void look_inwards(cell::CellType type, const Distance& distance, double small, FacetFoot& best) {
  if (best.feature != Feature::edge) return;  // from a corner both edges lead uphill
  const Vec2 inwards = middle_of_cell(type) - best.xi;
  const DistanceJet2 j = distance(best.xi);
  constexpr double rounding = 1e-13;
  const double size = j.metric.trace() + std::sqrt(j.squared_distance * j.metric.trace());
  if (!(j.slope.dot(inwards) < -rounding * size)) return;
  for (const double part : {0.0, 0.5, 0.1, 0.01}) {
    const FacetFoot foot = foot_inside(type, distance, best.xi + part * inwards, small);
    if (foot.feature != Feature::face || !(foot.squared_distance < best.squared_distance)) continue;
    best = foot;
    return;
  }
}

/// As `release` of a facet.
template <class Distance>
[[nodiscard]] bool release_along(cell::CellType type, const Distance& distance, double extension,
                                 FacetFoot& foot) {
  Vec2 xi = foot.xi;
  DistanceJet2 j = distance(xi);
  for (int it = 0; it < 12; ++it) {
    if (!positive(j.bend)) return false;
    const Vec2 step = -j.bend.inverse() * j.slope;
    xi += step;
    if (!(least_room(type, xi) >= -extension)) return false;
    j = distance(xi);
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
