#pragma once
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "osculate/geometry/catalogue.hpp"

namespace osculate::testing {

struct NamedCurve {
  std::string name;
  geometry::Curve curve;
};

/// Exact quarter circle of radius `radius` about the origin from (r, 0) to (0, r), degree 2.
inline geometry::NurbsCurve nurbs_quarter_circle(double radius) {
  const double w = std::numbers::sqrt2 / 2;
  return {
      2, {0, 0, 0, 1, 1, 1}, {Vec2(radius, 0), Vec2(radius, radius), Vec2(0, radius)}, {1, w, 1}};
}

/// Full circle in four quadratic pieces, counter-clockwise; inner knots are double.
inline geometry::NurbsCurve nurbs_circle(double r) {
  const double w = std::numbers::sqrt2 / 2;
  return {2,
          {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4},
          {Vec2(r, 0), Vec2(r, r), Vec2(0, r), Vec2(-r, r), Vec2(-r, 0), Vec2(-r, -r), Vec2(0, -r),
           Vec2(r, -r), Vec2(r, 0)},
          {1, w, 1, w, 1, w, 1, w, 1}};
}

/// Full ellipse, counter-clockwise: the normals point inwards, so that inside is above.
inline geometry::NurbsCurve ellipse(double a, double b) {
  geometry::NurbsCurve curve = nurbs_circle(1);
  for (Vec2& p : curve.control) p = p.cwiseProduct(Vec2(a, b));
  return curve;
}

/// Of a circle in the plane z = 0 about the origin, at the angle t.
inline geometry::CurveJet<3> circle_in_space(double radius, double t) {
  geometry::CurveJet<3> j;
  j.r = radius * Vec3(std::cos(t), std::sin(t), 0);
  j.r1 = radius * Vec3(-std::sin(t), std::cos(t), 0);
  j.r2 = -j.r;
  return j;
}

inline geometry::NurbsCurve nurbs_wave(int degree, int points) {
  geometry::NurbsCurve curve;
  curve.degree = degree;
  for (int k = 0; k < points; ++k) {
    curve.control.emplace_back(0.9 * k + 0.2 * std::sin(3.0 * k), 1.3 * std::sin(2.1 * k + degree));
    curve.weights.push_back(1.0 + 0.6 * std::sin(1.7 * k));
  }
  const int inner = points - degree - 1;
  curve.knots.assign(static_cast<std::size_t>(degree) + 1, 0.0);
  for (int i = 1; i <= inner; ++i) curve.knots.push_back(i + 0.2 * std::sin(1.0 * i));
  curve.knots.insert(curve.knots.end(), static_cast<std::size_t>(degree) + 1, inner + 1.0);
  return curve;
}

/// Bent Lagrange line with `count` nodes: an arch with a wiggle.
inline geometry::LagrangeCurve bent_line(int count) {
  std::vector<Vec2> nodes;
  for (int k = 0; k < count; ++k) {
    const double x = k == 0 ? -1.0 : k == 1 ? 1.0 : -1.0 + 2.0 * (k - 1) / (count - 1);
    nodes.emplace_back(1.4 * x + 0.3, 0.6 * x * x - 0.2 * std::sin(2.5 * x) + 0.1);
  }
  return geometry::lagrange_curve(nodes);
}

/// At least one curve of every entry of the catalogue.
inline std::vector<NamedCurve> sample_curves() {
  using namespace geometry;
  std::vector<NamedCurve> list;
  for (int n = 2; n <= cell::max_line_nodes; ++n)
    list.push_back({"lagrange" + std::to_string(n), bent_line(n)});
  for (int p = 1; p <= max_nurbs_degree; ++p)
    list.push_back({"nurbs" + std::to_string(p), nurbs_wave(p, p + 4)});
  list.push_back({"nurbs_quarter", nurbs_quarter_circle(1.7)});
  list.push_back({"nurbs_circle", nurbs_circle(1.3)});
  list.push_back({"disc", Circle{Vec2(0.4, -0.3), 1.5, false}});
  list.push_back({"hole", Circle{Vec2(0.4, -0.3), 1.5, true}});
  list.push_back({"arc", Arc{Vec2(0.2, 0.1), 1.2, 0.3, 2.1, false}});
  list.push_back({"arc_inside", Arc{Vec2(0.2, 0.1), 1.2, -0.4, 1.9, true}});
  list.push_back({"long_arc", Arc{Vec2(0.2, 0.1), 1.2, 0.3, 5.9, false}});
  list.push_back({"line", InfiniteLine{Vec2(0.5, -1.0), Vec2(1.0, 2.0)}});
  return list;
}

/// The parameter range, cut to -4..4 where it is infinite.
inline std::array<double, 2> finite_range(const geometry::Curve& curve) {
  const double lo = geometry::lo(curve), hi = geometry::hi(curve);
  return {std::isfinite(lo) ? lo : -4.0, std::isfinite(hi) ? hi : 4.0};
}

/// Error of a central difference against the given derivative, and its order over one halving.
struct OrderCheck {
  double error, order;
  [[nodiscard]] bool second_order() const { return error < 2e-11 || std::abs(order - 2.0) < 0.1; }
};

template <class F>
OrderCheck check_order(const F& f, const Vec2& derivative, double x, double h) {
  const double scale = std::max(derivative.norm(), 1.0);
  const auto error = [&](double s) {
    return (Vec2((f(x + s) - f(x - s)) / (2 * s)) - derivative).norm() / scale;
  };
  const double e1 = error(h), e2 = error(h / 2);
  return {std::max(e1, e2), std::log2(e1 / e2)};
}

}  // namespace osculate::testing
