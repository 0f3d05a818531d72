#pragma once
// Curves and surfaces whose reach is known, and its bound by brute force.
#include <limits>
#include <vector>

#include "osculate/geometry/curve_frame.hpp"
#include "osculate/projection/reach.hpp"
#include "sample_curves.hpp"
#include "sample_targets.hpp"

namespace osculate::projection {

using testing::box;
using testing::ellipse;
using testing::polyline;

/// z = (x^2 - y^2)/2 over 0..1 by nx x ny biquadratic facets, which hold it exactly.
inline FacetMesh<3> saddle(int nx, int ny) {
  FacetMesh<3> mesh;
  const Index row = 2 * nx + 1;
  for (int j = 0; j <= 2 * ny; ++j)
    for (int i = 0; i <= 2 * nx; ++i) {
      const double x = 0.5 * i / nx, y = 0.5 * j / ny;
      mesh.nodes.emplace_back(x, y, 0.5 * (x * x - y * y));
    }
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const Index o = 2 * j * row + 2 * i;
      mesh.facets.push_back({cell::CellType::quad9,
                             {o, o + 2, o + 2 + 2 * row, o + 2 * row, o + 1, o + 2 + row,
                              o + 1 + 2 * row, o + row, o + 1 + row}});
    }
  return mesh;
}

/// Smallest |q - p|^2/(2 (q - p) . v) over all pairs of places with their normals: not below the
/// reach.
template <int Dim>
double smallest_ball(const std::vector<Vec<Dim>>& places, const std::vector<Vec<Dim>>& normals) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < places.size(); ++i)
    for (const Vec<Dim>& q : places) {
      const Vec<Dim> d = q - places[i];
      const double height = d.dot(normals[i]);
      if (height > 1e-9) best = std::min(best, d.squaredNorm() / (2 * height));
    }
  return best;
}

/// Over dense places of a curve, on one side of it.
inline double dense_bound(const geometry::NurbsCurve& curve, int side, int samples) {
  std::vector<Vec2> r, n;
  for (int i = 0; i <= samples; ++i) {
    const geometry::CurveJet<2> j = curve.jet(curve.lo() + (curve.hi() - curve.lo()) * i / samples);
    r.push_back(j.r);
    n.push_back(side * curve_frame(j).normal);
  }
  return smallest_ball<2>(r, n);
}

}  // namespace osculate::projection
