#pragma once
#include <array>
#include <span>

#include "osculate/contact/kinematics.hpp"
#include "osculate/pairing/closest.hpp"

namespace osculate::pairing {

template <int Dim>
inline constexpr int max_master_nodes = Dim == 2 ? cell::max_line_nodes : cell::max_shape_nodes;

/// A slave point on its place of the master.
template <int Dim>
struct ProjectedPoint {
  Projection<Dim> projection;
  contact::Kinematics<Dim> kinematics;
  Vec<Dim> foot = Vec<Dim>::Zero();
  int count = 0;  ///< nodes of the facet
  /// Shape values of the facet at the foot point by slot: values, first and second derivatives
  /// with respect to the coordinates that move (an edge: along it; a vertex: none).
  std::array<std::array<double, max_master_nodes<Dim>>, contact::slots<Dim>> shape{};
  PatchPoints patches{};  ///< of the master
};

/// Kinematics and weights of a projection.
///
/// `order`: highest derivative of the shape functions that is asked for (3: those of the curvature
/// too); inside a smooth patch there are no others, nor third derivatives of its place below 3.
/// With 0 the forms of the kinematics on faces are left zero.
///
/// Requires   p.feature is not none
/// Tested by  tests/unit/pairing/test_pair_tangent.cpp, test_pair3_tangent.cpp
[[nodiscard]] ProjectedPoint<2> projected_point(const Chain& master, const Projection<2>& p,
                                                const Vec2& point, std::span<const Vec2> x);
[[nodiscard]] ProjectedPoint<3> projected_point(const FacetSurface& master, const Projection<3>& p,
                                                const Vec3& point, std::span<const Vec3> x,
                                                PatchPoints patches = {}, int order = 3);

}  // namespace osculate::pairing
