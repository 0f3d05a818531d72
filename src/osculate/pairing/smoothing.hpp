#pragma once
#include <Eigen/Core>
#include <array>
#include <numbers>
#include <span>

#include "osculate/cell/line_shape.hpp"
#include "osculate/core/types.hpp"

namespace osculate::pairing {

struct Chain;
struct FacetSurface;

/// A smooth surface through the nodes of first-order facets.
///   hermite  cubic pieces, one continuous tangent
///   nurbs    pieces of degree 5, also one continuous curvature: the spline with all weights 1
///            whose inner knots are the nodes' (three times each)
enum class SmoothingKind : std::uint8_t { none, hermite, nurbs };

struct Smoothing {
  SmoothingKind kind = SmoothingKind::none;
  /// Corners of the reference configuration with a larger angle between their facets stay sharp.
  double sharp_angle = std::numbers::pi / 6;
};

/// Nodes that a smoothed line depends on: its ends and one more on either side.
inline constexpr std::size_t smooth_line_nodes = 4;
inline constexpr std::size_t most_control_points = 6;

/// A Bezier curve whose control points are fixed combinations of nodes, so that a point of it is
/// one too: no contact formula knows the difference to a Lagrange line.
///
/// Formula    rho = sum_k N_k x_k ,  N_k = sum_j weight[k][j] B_j((1 + xi)/2) with the Bernstein
///            polynomials B_j ;  N_k = sum_d power[d][k] xi^d, by which it is evaluated
struct BezierWeights {
  std::size_t degree = 3;
  std::array<std::array<double, most_control_points>, smooth_line_nodes> weight{};
  std::array<Eigen::Array4d, most_control_points> power{};  ///< four nodes at a time
};

/// Value, slope and two more Taylor coefficients at xi of the polynomial sum_d power[d] xi^d.
template <class Value>
[[nodiscard]] std::array<Value, 4> taylor_at(std::span<const Value> power, double xi) {
  std::array<Value, 4> t;
  t.fill(0.0 * power.back());
  t[0] = power.back();
  for (std::size_t d = power.size() - 1; d-- > 0;) {
    for (std::size_t k = t.size() - 1; k > 0; --k) t[k] = xi * t[k] + t[k - 1];
    t[0] = xi * t[0] + power[d];
  }
  return t;
}

/// Shape functions of the first `count` nodes.
[[nodiscard]] cell::LineShape bezier_shape(const BezierWeights& bezier, int count, double xi);
/// First derivatives of the shape functions alone.
[[nodiscard]] Eigen::Array4d bezier_slopes(const BezierWeights& bezier, double xi);

/// Replaces the straight facets of `chain` (connected) by smooth ones through the same nodes.
///
/// Formula    at a node between facets of the reference lengths h_1 and h_2, by the parabola
///            through three nodes: d = (h_2 e_1 + h_1 e_2)/(h_1 + h_2), c = 2 (e_2 - e_1)/(h_1 +
///            h_2), where e_i = (difference of the facet's nodes)/h_i; rho' = d (and for `nurbs`
///            rho'' = c) there by the reference length. At an end and at a sharp corner d and c are
///            those of the parabola of the facet's other end
/// Returns    facets between two such ends stay straight, analytic curves as they are
/// Requires   facets of two nodes, which differ in `reference`
/// Tested by  tests/unit/pairing/test_smoothing.cpp
void smooth(Chain& chain, std::span<const Vec2> reference, const Smoothing& options);

/// Replaces quad4 and tri3 facets of `surface` (connected) by patches through the same nodes with
/// one normal along their common borders.
///
/// Formula    every vertex has a tangent plane that is linear in the nodes around it: the gradient,
///            by least squares with the weights |q|^-3, in a plane chart of the reference
///            configuration that keeps the lengths q of the edges; sharp and open edges are cubic
///            lines of their own as in the plane, whose tangents it contains. Borders are cubics
///            with these tangents; across a border the derivative is k b + h rho' with k, h and b
///            linear along it, b the same for both patches
/// Source     the construction of Chiyokura and Kimura with the inner points of Gregory's patch
/// Requires   facets of the types quad4 and tri3, kind `hermite`
/// Errors     core::GeometryError where a patch would depend on more than cell::max_shape_nodes
///            nodes, or the facets do not form a surface
/// Tested by  tests/unit/pairing/test_smooth_surface.cpp
void smooth(FacetSurface& surface, std::span<const Vec3> reference, const Smoothing& options);

}  // namespace osculate::pairing
