#include "osculate/geometry/nurbs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "osculate/geometry/spline_basis.hpp"

namespace osculate::geometry {
namespace {

/// Quotient rule: from the derivatives of N_k w_k and of W to those of R_k = N_k w_k / W.
void divide(std::array<SplineRow, 4>& n, std::size_t count) {
  std::array<double, 4> w{};
  for (std::size_t d = 0; d < 4; ++d)
    for (std::size_t k = 0; k < count; ++k) w[d] += n[d][k];
  for (std::size_t k = 0; k < count; ++k) {
    n[0][k] /= w[0];
    n[1][k] = (n[1][k] - w[1] * n[0][k]) / w[0];
    n[2][k] = (n[2][k] - 2 * w[1] * n[1][k] - w[2] * n[0][k]) / w[0];
    n[3][k] = (n[3][k] - 3 * w[1] * n[2][k] - 3 * w[2] * n[1][k] - w[3] * n[0][k]) / w[0];
  }
}

}  // namespace

bool NurbsCurve::closed() const {
  Vec2 low = control.front(), high = control.front();
  for (const Vec2& point : control) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  return (jet(hi()).r - jet(lo()).r).norm() <= 1e-12 * (high - low).norm();
}

Index NurbsCurve::find_span(double xi) const { return geometry::find_span(knots, degree, xi); }

NurbsBasis NurbsCurve::basis_in_span(Index span, double xi) const {
  NurbsBasis basis;
  basis.span = span;
  basis.first = span - degree;
  basis.shape.count = degree + 1;
  std::array<SplineRow, 4>& n = basis.shape.n;
  n = spline_basis(knots, degree, span, xi);
  const auto count = static_cast<std::size_t>(degree) + 1;
  for (std::size_t d = 0; d < 4; ++d)
    for (std::size_t k = 0; k < count; ++k)
      n[d][k] *= weights[static_cast<std::size_t>(basis.first) + k];
  divide(n, count);
  return basis;
}

CurveJet<2> NurbsCurve::jet_in_span(Index span, double xi) const {
  const NurbsBasis b = basis_in_span(span, xi);
  CurveJet<2> jet;
  for (std::size_t k = 0; k < static_cast<std::size_t>(b.shape.count); ++k) {
    const Vec2& point = control[static_cast<std::size_t>(b.first) + k];
    jet.r += b.shape.n[0][k] * point;
    jet.r1 += b.shape.n[1][k] * point;
    jet.r2 += b.shape.n[2][k] * point;
    jet.r3 += b.shape.n[3][k] * point;
  }
  return jet;
}

std::string validate_knots(std::size_t control_points, int degree,
                           const std::vector<double>& knots) {
  if (degree < 1 || degree > max_nurbs_degree)
    return fmt::format("degree: expected 1 to {}, found {}", max_nurbs_degree, degree);
  const auto p = static_cast<std::size_t>(degree);
  if (control_points < p + 1)
    return fmt::format("control: expected at least degree + 1 = {} points, found {}", p + 1,
                       control_points);
  if (knots.size() != control_points + p + 1)
    return fmt::format("knots: expected control points + degree + 1 = {} knots, found {}",
                       control_points + p + 1, knots.size());
  for (std::size_t i = 0; i < knots.size(); ++i) {
    if (!std::isfinite(knots[i])) return fmt::format("knots: knot {} is not a finite number", i);
    if (i > 0 && knots[i] < knots[i - 1])
      return fmt::format("knots: expected nondecreasing numbers, knot {} = {} follows {}", i,
                         knots[i], knots[i - 1]);
  }
  if (!(knots[p] < knots[control_points]))
    return fmt::format("knots: expected a range of positive length, found {}..{}", knots[p],
                       knots[control_points]);
  for (std::size_t i = 1; i + p + 1 < knots.size(); ++i)
    if (knots[i] == knots[i + p] && knots[p] < knots[i] && knots[i] < knots[control_points])
      return fmt::format(
          "knots: expected inner knots at most degree = {} times, {} is repeated "
          "more often and breaks the curve",
          degree, knots[i]);
  for (std::size_t i = 0; i + p + 1 < knots.size(); ++i)
    if (knots[i] == knots[i + p + 1])
      return fmt::format(
          "knots: expected end knots at most degree + 1 = {} times, found {} more "
          "often",
          degree + 1, knots[i]);
  return {};
}

std::string validate(const NurbsCurve& curve) {
  if (std::string text = validate_knots(curve.control.size(), curve.degree, curve.knots);
      !text.empty())
    return text;
  if (curve.weights.size() != curve.control.size())
    return fmt::format("weights: expected one for each of the {} control points, found {}",
                       curve.control.size(), curve.weights.size());
  for (std::size_t k = 0; k < curve.control.size(); ++k) {
    if (!curve.control[k].allFinite())
      return fmt::format("control: expected finite coordinates, point {} has none", k);
    if (!(curve.weights[k] > 0) || !std::isfinite(curve.weights[k]))
      return fmt::format("weights: expected numbers > 0, weight {} is {}", k, curve.weights[k]);
  }
  return {};
}

NurbsCurve reversed(const NurbsCurve& curve) {
  NurbsCurve out = curve;
  std::reverse(out.control.begin(), out.control.end());
  std::reverse(out.weights.begin(), out.weights.end());
  std::reverse(out.knots.begin(), out.knots.end());
  const double sum = curve.knots.front() + curve.knots.back();
  for (double& knot : out.knots) knot = sum - knot;
  return out;
}

}  // namespace osculate::geometry
