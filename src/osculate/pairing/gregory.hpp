#pragma once
#include <Eigen/Core>
#include <array>
#include <span>

#include "osculate/cell/facet_shape.hpp"

namespace osculate::pairing {

inline constexpr std::size_t gregory_points = 20, triangle_points = 18;

/// A patch over a quadrilateral (bicubic) or a triangle (of degree 4) whose control points are
/// fixed combinations of nodes, so that a point of it is one too: no contact formula knows the
/// difference to a Lagrange facet. Each inner control point has two versions, one for each of the
/// borders beside it, that are mixed by the distance from them: so the tangent planes along the
/// four (three) borders are independent of each other.
///
/// Formula    r = sum_k N_k x_k ,  N_k = sum_j weight[j][k] B_j ;  B_j: Bernstein polynomials, of
/// the
///            inner points times s^2/(s^2 + t^2), with the distances s from the border the other
///            version is for and t from its own
/// Points     quadrilateral: P_ij at i + 4 j, inner ones for the borders of constant second
///            coordinate; then the four inner ones for the other borders. Triangle: the corners,
///            three points along each border from corner to corner, then for each corner the inner
///            point for the border that leaves it and the one for the border that arrives
struct GregoryWeights {
  bool triangle = false;
  std::array<std::array<double, cell::max_shape_nodes>, gregory_points> weight{};
};

/// B_j and their derivatives in the order of cell::FacetShape, by the coordinates of the facet.
using GregoryBasis = std::array<std::array<double, gregory_points>, 10>;
[[nodiscard]] GregoryBasis gregory_basis(bool triangle, const Vec2& xi);

/// Shape functions of the first `count` nodes and their derivatives up to `order`.
[[nodiscard]] cell::FacetShape gregory_shape(const GregoryWeights& patch, int count, const Vec2& xi,
                                             int order = 3);

/// Control points in one configuration, with a fourth coordinate that is 0.
using GregoryPoints = std::array<Eigen::Array4d, gregory_points>;
/// The place r and r_1, r_2; r_11, r_12, r_22 likewise.
using GregoryJet = std::array<Eigen::Array4d, 6>;
[[nodiscard]] GregoryJet gregory_jet(bool triangle, const GregoryPoints& points, const Vec2& xi);
/// Control points of the smooth facets of a surface in one configuration, by facet. Where there are
/// none they are made when they are asked for.
using PatchPoints = std::span<const GregoryPoints>;

/// Number in the list of points; of the inner ones near corner (i, j) of the quadrilateral for the
/// borders of constant second (0) or first (1) coordinate, i, j = 1 or 2.
[[nodiscard]] constexpr std::size_t quad_point(std::size_t i, std::size_t j, bool other = false) {
  return other ? 15 + i + 2 * (j - 1) : i + 4 * j;
}
/// Point s = 1, 2, 3 along the border from corner `k` of the triangle to the next.
[[nodiscard]] constexpr std::size_t triangle_border(std::size_t k, std::size_t s) {
  return 2 + 3 * k + s;
}
/// Inner point near corner `k` for the border that leaves it (or arrives there).
[[nodiscard]] constexpr std::size_t triangle_inner(std::size_t k, bool arrives) {
  return 12 + 2 * k + (arrives ? 1 : 0);
}

}  // namespace osculate::pairing
