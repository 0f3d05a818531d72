#pragma once
// Targets of closest points that unit tests, verification cases and benchmarks share.
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "osculate/geometry/nurbs_patch.hpp"
#include "osculate/projection/target.hpp"

namespace osculate::testing {

inline projection::FacetMesh<2> polyline(const std::vector<Vec2>& points, bool closed = false) {
  projection::FacetMesh<2> mesh{points, {}};
  const auto n = static_cast<Index>(points.size());
  for (Index i = 0; i + (closed ? 0 : 1) < n; ++i)
    mesh.facets.push_back({cell::CellType::line2, {i, (i + 1) % n}});
  return mesh;
}

/// From the origin to `size`, normals outwards.
inline projection::FacetMesh<3> box(const Vec3& size) {
  projection::FacetMesh<3> mesh;
  for (int k = 0; k < 8; ++k)
    mesh.nodes.push_back(size.cwiseProduct(Vec3(k & 1, (k >> 1) & 1, k >> 2)));
  for (const auto& q : {std::array<Index, 4>{0, 2, 3, 1},
                        {4, 5, 7, 6},
                        {0, 1, 5, 4},
                        {2, 6, 7, 3},
                        {0, 4, 6, 2},
                        {1, 3, 7, 5}})
    mesh.facets.push_back({cell::CellType::quad4, {q[0], q[1], q[2], q[3]}});
  return mesh;
}

/// Triangles between points of the unit sphere (an octahedron cut n times).
inline projection::FacetMesh<3> sphere_mesh(int n) {
  projection::FacetMesh<3> mesh;
  std::map<std::array<long, 3>, Index> known;
  const auto node = [&](const Vec3& direction) {
    const Vec3 p = direction.normalized();
    const std::array<long, 3> key{std::lround(p[0] * 1e9), std::lround(p[1] * 1e9),
                                  std::lround(p[2] * 1e9)};
    const auto found = known.try_emplace(key, static_cast<Index>(mesh.nodes.size()));
    if (found.second) mesh.nodes.push_back(p);
    return found.first->second;
  };
  for (int octant = 0; octant < 8; ++octant) {
    const double sx = (octant & 1) != 0 ? -1 : 1, sy = (octant & 2) != 0 ? -1 : 1,
                 sz = (octant & 4) != 0 ? -1 : 1;
    const bool turned = sx * sy * sz < 0;
    const auto at = [&](int i, int j) {
      const double u = static_cast<double>(i) / n, v = static_cast<double>(j) / n;
      return node({sx * (1 - u - v), sy * u, sz * v});
    };
    const auto add = [&](Index a, Index b, Index c) {
      mesh.facets.push_back({cell::CellType::tri3, {a, turned ? c : b, turned ? b : c}});
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j) {
        add(at(i, j), at(i + 1, j), at(i, j + 1));
        if (i + j + 1 < n) add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
      }
  }
  return mesh;
}

/// Bicubic-biquadratic, 3 x 2 spans, with weights between 0.6 and 1.4.
inline geometry::NurbsPatch wavy_patch() {
  geometry::NurbsPatch patch;
  patch.degree = {3, 2};
  patch.knots = {std::vector<double>{0, 0, 0, 0, 0.3, 0.6, 1, 1, 1, 1},
                 std::vector<double>{0, 0, 0, 0.5, 1, 1, 1}};
  patch.count = {6, 4};
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 4; ++j) {
      const double a = std::sin(3.7 * i + 1.3 * j * j + 0.4), b = std::sin(2.1 * i * j + 5.1 * j);
      patch.control.push_back({0.2 * i + 0.03 * b, j / 3.0 + 0.03 * a, 0.3 * a});
      patch.weights.push_back(1 + 0.4 * b);
    }
  return patch;
}

}  // namespace osculate::testing
