#pragma once
#include "osculate/pairing/sampling.hpp"

namespace osculate::pairing {

/// Outward normal of the slave at one contact point: the bits that `point_normals` has for it.
///
/// Tested by  tests/unit/pairing/test_far_points.cpp
template <int Dim>
[[nodiscard]] Vec<Dim> point_normal(const SlaveSide<Dim>& side,
                                    std::type_identity_t<std::span<const Vec<Dim>>> x,
                                    std::size_t i);

/// At a node of the slave; zero where it has no facet.
[[nodiscard]] Vec2 nodal_normal(const SlaveSide<2>& slave, std::span<const Vec2> x, std::size_t i);
[[nodiscard]] Vec3 nodal_normal(const SlaveSide<3>& slave, std::span<const Vec3> x, std::size_t i);

}  // namespace osculate::pairing
