#pragma once
#include <array>
#include <vector>

#include "osculate/cell/line_shape.hpp"
#include "osculate/core/types.hpp"

namespace osculate::geometry {

/// Highest degree of a spline: a span then depends on `cell::max_line_nodes` control points.
inline constexpr int max_spline_degree = cell::max_line_nodes - 1;

/// Values of the degree + 1 B-splines that live on one span, or one of their derivatives.
using SplineRow = std::array<double, cell::max_line_nodes>;

/// B-splines N_{span-degree} .. N_{span} on the span u_span <= xi < u_{span+1}, and their first
/// three derivatives.
///
/// Formula    N_{i,q} = (xi - u_i)/(u_{i+q} - u_i) N_{i,q-1}
///                      + (u_{i+q+1} - xi)/(u_{i+q+1} - u_{i+1}) N_{i+1,q-1} ;
///            N'_{i,q} = q (N_{i,q-1}/(u_{i+q} - u_i) - N_{i+1,q-1}/(u_{i+q+1} - u_{i+1}))
/// Source     Cox and de Boor
/// Requires   a non-empty span of valid knots; xi outside of the span continues its polynomial
[[nodiscard]] std::array<SplineRow, 4> spline_basis(const std::vector<double>& knots, int degree,
                                                    Index span, double xi);

/// The non-empty span that holds xi (the first and last one beyond the ends).
[[nodiscard]] Index find_span(const std::vector<double>& knots, int degree, double xi);

}  // namespace osculate::geometry
