#pragma once
// The curves and surfaces of the case.
#include <cmath>
#include <numbers>
#include <vector>

#include "../../tests/support/sample_curves.hpp"
#include "../../tests/support/sample_targets.hpp"

namespace osculate::verification {

using testing::ellipse;
using testing::polyline;

/// Straight piece AB, arcs BC and CD of radius 1 bent to both sides.
inline geometry::NurbsCurve figure_6() {
  const double w = std::numbers::sqrt2 / 2;
  return {2,
          {0, 0, 0, 1, 1, 2, 2, 3, 3, 3},
          {Vec2(-2, 0), Vec2(-1, 0), Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(1, 2), Vec2(2, 2)},
          {1, 1, 1, w, 1, w, 1}};
}

/// Two plates 1 x 2 at the distance 0.4 that face each other, four facets each.
inline projection::FacetMesh<3> parallel_plates() {
  projection::FacetMesh<3> mesh;
  for (int k = 0; k < 18; ++k)
    mesh.nodes.emplace_back(0.5 * (k % 3), 1.0 * (k / 3 % 3), k < 9 ? 0.0 : 0.4);
  for (const Index o : {0, 1, 3, 4}) {
    mesh.facets.push_back({cell::CellType::quad4, {o, o + 1, o + 4, o + 3}});
    mesh.facets.push_back({cell::CellType::quad4, {o + 9, o + 12, o + 13, o + 10}});
  }
  return mesh;
}

/// Torus of rational biquadratic spans, normals out of the tube.
inline geometry::NurbsPatch torus_patch(double radius, double tube) {
  const geometry::NurbsCurve ring = ellipse(1, 1);
  geometry::NurbsPatch p;
  p.degree = {2, 2};
  p.count = {9, 9};
  p.knots = {ring.knots, ring.knots};
  for (std::size_t i = 0; i < 9; ++i)
    for (std::size_t j = 0; j < 9; ++j) {
      const double r = radius + tube * ring.control[j].x();
      p.control.emplace_back(r * ring.control[i].x(), r * ring.control[i].y(),
                             tube * ring.control[j].y());
      p.weights.push_back(ring.weights[i] * ring.weights[j]);
    }
  return p;
}

/// Half of a bore of radius 1 below z = 0 and the ring round its mouth, by quad9 facets.
inline projection::FacetMesh<3> half_bore() {
  constexpr int around = 8;
  const std::array<Vec2, 5> profile{Vec2(1, -1), Vec2(1, -0.5), Vec2(1, 0), Vec2(1.3, 0),
                                    Vec2(1.6, 0)};  // r, z
  projection::FacetMesh<3> mesh;
  for (int i = 0; i <= 2 * around; ++i) {
    const double angle = std::numbers::pi * i / (2 * around);
    for (const Vec2& p : profile)
      mesh.nodes.emplace_back(p.x() * std::cos(angle), p.x() * std::sin(angle), p.y());
  }
  for (Index i = 0; i < around; ++i)
    for (const Index j : {0, 2}) {
      const Index o = 10 * i + j;  // along the profile first: normals out of the body
      mesh.facets.push_back(
          {cell::CellType::quad9, {o, o + 2, o + 12, o + 10, o + 1, o + 7, o + 11, o + 5, o + 6}});
    }
  return mesh;
}

/// z = x^3 - 3 x y^2 over -1/2..1/2 both ways, exactly, as a bicubic patch.
inline geometry::NurbsPatch monkey_saddle() {
  geometry::NurbsPatch p;
  p.degree = {3, 3};
  p.count = {4, 4};
  p.knots = {{{0, 0, 0, 0, 1, 1, 1, 1}, {0, 0, 0, 0, 1, 1, 1, 1}}};
  // Bernstein coefficients of x, x^2 and x^3 for x = t - 1/2
  const std::array<double, 4> x{-1.0 / 2, -1.0 / 6, 1.0 / 6, 1.0 / 2};
  const std::array<double, 4> square{1.0 / 4, -1.0 / 12, -1.0 / 12, 1.0 / 4};
  const std::array<double, 4> cube{-1.0 / 8, 1.0 / 8, -1.0 / 8, 1.0 / 8};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      p.control.emplace_back(x[i], x[j], cube[i] - 3 * x[i] * square[j]);
      p.weights.push_back(1);
    }
  return p;
}

}  // namespace osculate::verification
