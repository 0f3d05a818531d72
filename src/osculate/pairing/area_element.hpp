#pragma once
#include <Eigen/Geometry>
#include <numbers>

#include "osculate/pairing/slave_side.hpp"

namespace osculate::pairing {

/// Area per unit of a facet's reference cell and its derivative with respect to the facet's nodes
/// (zero where the area is).
template <int Dim>
struct AreaElement {
  double value = 0;
  std::array<Vec<Dim>, max_slave_nodes<Dim>> gradient;
};

/// Formula    |x_,xi| f, f = thickness or 2 pi x_1
/// Tested by  tests/unit/pairing/test_slave_side.cpp, test_sampling.cpp
[[nodiscard]] inline AreaElement<2> area_element(const Facet& facet, const cell::LineShape& shape,
                                                 std::span<const Vec2> x, const AreaRule& rule) {
  const geometry::CurveJet<2> jet = facet_jet(facet, shape, x);
  constexpr double turn_length = 2 * std::numbers::pi;
  const double speed = jet.r1.norm();
  const double factor = rule.axisymmetric ? turn_length * jet.r.x() : rule.thickness;
  AreaElement<2> out;
  out.value = speed * factor;
  out.gradient.fill(Vec2::Zero());
  if (!(speed > 0)) return out;
  for (std::size_t k = 0; k < static_cast<std::size_t>(facet.count); ++k) {
    out.gradient[k] = factor * shape.n[1][k] / speed * jet.r1;
    if (rule.axisymmetric) out.gradient[k].x() += speed * turn_length * shape.n[0][k];
  }
  return out;
}

/// Formula    |x_,1 x x_,2|
/// Tested by  tests/unit/pairing/test_slave_side.cpp, test_sampling.cpp
[[nodiscard]] inline AreaElement<3> area_element(const SurfaceFacet& facet,
                                                 const cell::FacetShape& shape,
                                                 std::span<const Vec3> x, const AreaRule&) {
  std::array<Vec3, 2> r{Vec3::Zero(), Vec3::Zero()};
  for (std::size_t k = 0; k < static_cast<std::size_t>(facet.count); ++k)
    for (std::size_t d = 0; d < 2; ++d)
      r[d] += shape.n[1 + d][k] * x[static_cast<std::size_t>(facet.nodes[k])];
  const Vec3 normal = r[0].cross(r[1]);
  AreaElement<3> out;
  out.value = normal.norm();
  out.gradient.fill(Vec3::Zero());
  if (!(out.value > 0)) return out;
  const Vec3 n = normal / out.value;
  const Vec3 of_first = r[1].cross(n), of_second = n.cross(r[0]);
  for (std::size_t k = 0; k < static_cast<std::size_t>(facet.count); ++k)
    out.gradient[k] = shape.n[1][k] * of_first + shape.n[2][k] * of_second;
  return out;
}

}  // namespace osculate::pairing
