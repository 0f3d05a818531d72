#include "osculate/geometry/arc_length.hpp"

#include "osculate/geometry/line2.hpp"

namespace osculate::geometry {
namespace {

double length_of(const LagrangeCurve& curve, double a, double b) {
  if (curve.count == 2) return line2_tangent(curve.nodes[0], curve.nodes[1]).norm() * (b - a);
  return arc_length([&curve](double xi) { return curve.jet(xi); }, a, b);
}

double length_of(const NurbsCurve& curve, double a, double b) {
  if (b < a) return -length_of(curve, b, a);
  double length = 0;
  const Index first = curve.find_span(a), last = curve.find_span(b);
  for (Index span = first; span <= last; ++span) {
    const auto i = static_cast<std::size_t>(span);
    if (!(curve.knots[i] < curve.knots[i + 1])) continue;
    const double from = span == first ? a : curve.knots[i];
    const double to = span == last ? b : curve.knots[i + 1];
    length += arc_length([&](double xi) { return curve.jet_in_span(span, xi); }, from, to);
  }
  return length;
}

double length_of(const Circle& curve, double a, double b) { return curve.radius * (b - a); }
double length_of(const Arc& curve, double a, double b) { return curve.radius * (b - a); }
double length_of(const InfiniteLine&, double a, double b) { return b - a; }

}  // namespace

double arc_length(const Curve& curve, double xi0, double xi1) {
  return std::visit([xi0, xi1](const auto& c) { return length_of(c, xi0, xi1); }, curve);
}

}  // namespace osculate::geometry
