#include "osculate/geometry/curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

namespace osculate::geometry {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

CurveJet<2> circle_jet(const Vec2& center, double radius, bool inside, double xi) {
  const double turn_sign = inside ? 1.0 : -1.0;
  const Vec2 radial(radius * std::cos(xi), turn_sign * radius * std::sin(xi));
  const Vec2 along = turn_sign * turn(radial);
  return {center + radial, along, -radial, -along};
}

std::string check_circle(const Vec2& center, double radius) {
  if (!center.allFinite()) return "center: expected two finite numbers";
  if (!(radius > 0) || !std::isfinite(radius))
    return fmt::format("radius: expected a number > 0, found {}", radius);
  return {};
}

}  // namespace

CurveJet<2> jet_from_shape(const cell::LineShape& shape, std::span<const Vec2> nodes) {
  assert(nodes.size() >= static_cast<std::size_t>(shape.count));
  CurveJet<2> jet;
  for (std::size_t k = 0; k < static_cast<std::size_t>(shape.count); ++k) {
    jet.r += shape.n[0][k] * nodes[k];
    jet.r1 += shape.n[1][k] * nodes[k];
    jet.r2 += shape.n[2][k] * nodes[k];
    jet.r3 += shape.n[3][k] * nodes[k];
  }
  return jet;
}

CurveJet<2> LagrangeCurve::jet(double xi) const {
  return jet_from_shape(cell::lagrange_line(count, xi), nodes);
}

LagrangeCurve lagrange_curve(std::span<const Vec2> nodes) {
  assert(nodes.size() >= 2 && nodes.size() <= static_cast<std::size_t>(cell::max_line_nodes));
  LagrangeCurve curve;
  curve.nodes.fill(Vec2::Zero());
  const std::size_t count = std::min<std::size_t>(nodes.size(), cell::max_line_nodes);
  curve.count = static_cast<int>(count);
  std::copy_n(nodes.begin(), count, curve.nodes.begin());
  return curve;
}

std::string validate(const LagrangeCurve& curve) {
  if (curve.count < 2 || curve.count > cell::max_line_nodes)
    return fmt::format("nodes: expected 2 to {} nodes, found {}", cell::max_line_nodes,
                       curve.count);
  for (int k = 0; k < curve.count; ++k)
    if (!curve.nodes[static_cast<std::size_t>(k)].allFinite())
      return fmt::format("nodes: expected finite coordinates, node {} has none", k);
  if ((curve.nodes[1] - curve.nodes[0]).norm() == 0 && curve.count == 2)
    return "nodes: expected two different points";
  return {};
}

LagrangeCurve reversed(const LagrangeCurve& curve) {
  LagrangeCurve out = curve;
  std::swap(out.nodes[0], out.nodes[1]);
  std::reverse(out.nodes.begin() + 2, out.nodes.begin() + curve.count);
  return out;
}

CurveJet<2> Circle::jet(double xi) const { return circle_jet(center, radius, inside, xi); }
double Circle::hi() const { return two_pi; }
std::string validate(const Circle& curve) { return check_circle(curve.center, curve.radius); }

CurveJet<2> Arc::jet(double xi) const { return circle_jet(center, radius, inside, xi); }
bool Arc::closed() const { return std::abs(to - from - two_pi) <= 1e-12 * two_pi; }

std::string validate(const Arc& curve) {
  if (std::string text = check_circle(curve.center, curve.radius); !text.empty()) return text;
  const double sweep = curve.to - curve.from;
  if (!(sweep > 0) || !(sweep <= two_pi * (1.0 + 1e-12)))
    return fmt::format(
        "from, to: expected from < to <= from + 2 pi (in radians; add 2 pi to `to` if the arc "
        "crosses the angle zero), found {} and {}",
        curve.from, curve.to);
  return {};
}

Vec2 InfiniteLine::unit_normal() const {
  const double length = normal.norm();
  return length > 0 ? Vec2(normal / length) : Vec2(Vec2::Zero());
}

CurveJet<2> InfiniteLine::jet(double xi) const {
  const Vec2 tangent = unit_tangent();
  return {point + xi * tangent, tangent, Vec2::Zero(), Vec2::Zero()};
}

double InfiniteLine::lo() const { return -std::numeric_limits<double>::infinity(); }
double InfiniteLine::hi() const { return std::numeric_limits<double>::infinity(); }

std::string validate(const InfiniteLine& curve) {
  if (!curve.point.allFinite()) return "point: expected two finite numbers";
  if (!curve.normal.allFinite() || !(curve.normal.norm() > 0))
    return "normal: expected a vector of finite length > 0";
  return {};
}

std::size_t Polyline::segments() const {
  if (points.size() < 2) return 0;
  return closed ? points.size() : points.size() - 1;
}

LagrangeCurve Polyline::segment(std::size_t i) const {
  assert(i < segments());
  return lagrange_curve(std::array<Vec2, 2>{points[i], points[(i + 1) % points.size()]});
}

std::string validate(const Polyline& line) {
  const std::size_t least = line.closed ? 3 : 2;
  if (line.points.size() < least)
    return fmt::format("points: expected at least {} points, found {}", least, line.points.size());
  for (std::size_t i = 0; i < line.points.size(); ++i)
    if (!line.points[i].allFinite())
      return fmt::format("points: expected finite coordinates, point {} has none", i);
  for (std::size_t i = 0; i < line.segments(); ++i) {
    const std::size_t next = (i + 1) % line.points.size();
    if (line.points[i] == line.points[next])
      return fmt::format("points: expected distinct neighbours, points {} and {} coincide", i,
                         next);
  }
  return {};
}

}  // namespace osculate::geometry
