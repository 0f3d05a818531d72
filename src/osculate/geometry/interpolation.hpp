#pragma once
#include <vector>

#include "osculate/core/types.hpp"
#include "osculate/geometry/nurbs.hpp"

namespace osculate::geometry {

/// The spline of degree min(3, points - 1) with rho(t_i) = p_i, all weights 1.
///
/// Formula    inner knots t_2 .. t_{n-3} (cubic, "not a knot"): one polynomial runs over the first
///            two and over the last two intervals, so cubics are met exactly
/// Requires   at least two points, t strictly increasing and finite
/// Tested by  tests/unit/geometry/test_interpolation.cpp
[[nodiscard]] NurbsCurve spline_through(const std::vector<double>& t, const std::vector<Vec2>& p);

/// The graph y(x) of that spline, travelled from the first point to the last; its parameter is x,
/// or -x where x decreases.
///
/// Requires   at least two points, x strictly increasing or strictly decreasing
[[nodiscard]] NurbsCurve graph_through(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace osculate::geometry
