#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "osculate/cell/line_shape.hpp"
#include "osculate/core/types.hpp"
#include "osculate/geometry/curve_jet.hpp"
#include "osculate/geometry/spline_basis.hpp"

namespace osculate::geometry {

/// Highest degree of a NURBS curve: a span then depends on `cell::max_line_nodes` control points.
inline constexpr int max_nurbs_degree = max_spline_degree;

/// Rational basis of one knot span: control points first .. first + shape.count - 1.
struct NurbsBasis {
  Index span = 0;   ///< index i of the knot span u_i <= xi < u_{i+1}
  Index first = 0;  ///< first control point with a share
  cell::LineShape shape;
};

/// Rational B-spline curve; control points are not multiplied by their weights.
///
/// Formula    rho = sum_k R_k P_k ,  R_k = N_k w_k / W ,  W = sum_j N_j w_j ;
///            derivatives by the quotient rule, W R_k''' = (N_k w_k)''' - 3 W' R_k'' - 3 W'' R_k'
///            - W''' R_k and so on
/// Requires   validate(curve).empty(); outside of lo..hi the end spans are continued
/// Tested by  tests/unit/geometry/test_nurbs.cpp
struct NurbsCurve {
  static constexpr std::string_view key = "nurbs";
  int degree = 1;
  std::vector<double> knots;
  std::vector<Vec2> control;
  std::vector<double> weights;

  [[nodiscard]] CurveJet<2> jet(double xi) const { return jet_in_span(find_span(xi), xi); }
  [[nodiscard]] double lo() const { return knots[static_cast<std::size_t>(degree)]; }
  [[nodiscard]] double hi() const { return knots[control.size()]; }
  [[nodiscard]] bool closed() const;  ///< ends coincide (1e-12 of the control polygon's size)

  /// The non-empty span that holds xi (the last one for xi >= hi).
  [[nodiscard]] Index find_span(double xi) const;
  [[nodiscard]] NurbsBasis basis(double xi) const { return basis_in_span(find_span(xi), xi); }
  /// The analytic piece of one non-empty span, also at and beyond its ends: one-sided derivatives
  /// where the curve has a kink.
  [[nodiscard]] NurbsBasis basis_in_span(Index span, double xi) const;
  [[nodiscard]] CurveJet<2> jet_in_span(Index span, double xi) const;
};

/// Empty, or what was expected: degree 1..7, finite nondecreasing knots, as many knots as control
/// points + degree + 1, inner multiplicity <= degree, a non-empty range, weights > 0.
[[nodiscard]] std::string validate(const NurbsCurve& curve);
/// The same points travelled the other way: the body changes sides.
[[nodiscard]] NurbsCurve reversed(const NurbsCurve& curve);
[[nodiscard]] std::string validate_knots(std::size_t control_points, int degree,
                                         const std::vector<double>& knots);

}  // namespace osculate::geometry
