#include "osculate/projection/facet_hull.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "osculate/cell/quadratic_facet.hpp"
#include "osculate/projection/triangle.hpp"

namespace osculate::projection {

int control_points(cell::CellType type, std::span<const Vec3> nodes, std::span<Vec3, 9> out) {
  const std::size_t corners = cell::is_triangle(type) ? 3 : 4;
  Vec3 of_corners = Vec3::Zero(), of_edges = Vec3::Zero();
  for (std::size_t k = 0; k < corners; ++k) {
    out[k] = nodes[k];
    const Vec3 middle = nodes[corners + k];
    out[corners + k] = 2 * middle - 0.5 * (nodes[k] + nodes[(k + 1) % corners]);
    of_corners += nodes[k];
    of_edges += middle;
  }
  if (corners == 3) return 6;
  const Vec3 middle =
      cell::middle_node(type, [&](std::size_t k) -> const Vec3& { return nodes[k]; });
  out[8] = 4 * middle - of_edges + 0.25 * of_corners;
  return 9;
}

namespace {

/// How far a facet is away from the triangles through its corners at most.
double bulge_of(cell::CellType type, std::span<const Vec3> nodes) {
  const std::size_t corners = cell::is_triangle(type) ? 3 : 4;
  const double warp = corners == 3 ? 0 : 0.25 * (nodes[0] - nodes[1] + nodes[2] - nodes[3]).norm();
  if (cell::is_linear_facet(type)) return warp;
  double squared = 0;
  for (std::size_t k = 0; k < corners; ++k) {
    const Vec3 middle = 0.5 * (nodes[k] + nodes[(k + 1) % corners]);
    squared = std::max(squared, (nodes[corners + k] - middle).squaredNorm());
  }
  if (corners == 3) return 4.0 / 3 * std::sqrt(squared);
  squared *= 4;
  std::array<Vec3, 9> points;
  control_points(type, nodes, points);
  const Vec3 middle = 0.25 * (nodes[0] + nodes[1] + nodes[2] + nodes[3]);
  squared = std::max(squared, (points[8] - middle).squaredNorm());
  return 0.75 * std::sqrt(squared) + warp;
}

}  // namespace

double least_distance(cell::CellType type, std::span<const Vec3> nodes, const Vec3& point) {
  double squared = closest_on_triangle(nodes[0], nodes[1], nodes[2], point).squared_distance;
  if (!cell::is_triangle(type))
    squared = std::min(squared,
                       closest_on_triangle(nodes[0], nodes[2], nodes[3], point).squared_distance);
  return std::max(0.0, std::sqrt(squared) - bulge_of(type, nodes));
}

}  // namespace osculate::projection
