#pragma once
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "osculate/cell/line_shape.hpp"
#include "osculate/core/types.hpp"
#include "osculate/geometry/curve_jet.hpp"

namespace osculate::geometry {

// Every curve is a plain struct with the same five members (key, jet, lo, hi, closed) and a free
// function validate(), which returns an empty string or what was expected. Convention for all:
// the body lies on the right of the direction of travel and nu = k x rho_xi / |rho_xi| points out
// of it.

/// Position and derivatives from shape functions and nodes.
[[nodiscard]] CurveJet<2> jet_from_shape(const cell::LineShape& shape, std::span<const Vec2> nodes);

/// Lagrange line through 2..8 nodes in Gmsh order (both ends, then the interior), xi in -1..1.
struct LagrangeCurve {
  static constexpr std::string_view key = "lagrange";
  int count = 2;
  std::array<Vec2, cell::max_line_nodes> nodes{};

  [[nodiscard]] CurveJet<2> jet(double xi) const;
  [[nodiscard]] double lo() const { return -1.0; }
  [[nodiscard]] double hi() const { return 1.0; }
  [[nodiscard]] bool closed() const { return false; }
};
[[nodiscard]] LagrangeCurve lagrange_curve(std::span<const Vec2> nodes);
[[nodiscard]] std::string validate(const LagrangeCurve& curve);

/// Full circle, xi in 0..2 pi.
///
/// Formula    rho = c + R (cos xi, -sin xi): clockwise round a solid disc, nu radially outwards;
///            with `inside`, rho = c + R (cos xi, sin xi): the body is outside, nu points inwards
/// Sign       kappa = -1/R (solid), +1/R (hole)
struct Circle {
  static constexpr std::string_view key = "circle";
  Vec2 center{0, 0};
  double radius = 1;
  bool inside = false;  ///< a hole: the body lies outside the circle

  [[nodiscard]] CurveJet<2> jet(double xi) const;
  [[nodiscard]] double lo() const { return 0.0; }
  [[nodiscard]] double hi() const;
  [[nodiscard]] bool closed() const { return true; }
};
[[nodiscard]] std::string validate(const Circle& curve);

/// Part of a circle between two polar angles from < to <= from + 2 pi (radians, counter-clockwise
/// from the x-axis). As for the circle xi = -angle for a solid body (travel from `to` to `from`)
/// and xi = angle with `inside`.
struct Arc {
  static constexpr std::string_view key = "arc";
  Vec2 center{0, 0};
  double radius = 1;
  double from = 0, to = 1;
  bool inside = false;

  [[nodiscard]] CurveJet<2> jet(double xi) const;
  [[nodiscard]] double lo() const { return inside ? from : -to; }
  [[nodiscard]] double hi() const { return inside ? to : -from; }
  [[nodiscard]] bool closed() const;
};
[[nodiscard]] std::string validate(const Arc& curve);

/// Straight line without ends; xi is arc length, zero at `point`. The body is the half plane that
/// `normal` (any length but zero) points away from.
struct InfiniteLine {
  static constexpr std::string_view key = "line";
  Vec2 point{0, 0};
  Vec2 normal{0, 1};

  [[nodiscard]] Vec2 unit_normal() const;
  [[nodiscard]] Vec2 unit_tangent() const { return -turn(unit_normal()); }
  [[nodiscard]] CurveJet<2> jet(double xi) const;
  [[nodiscard]] double lo() const;  ///< -infinity
  [[nodiscard]] double hi() const;  ///< +infinity
  [[nodiscard]] bool closed() const { return false; }
};
[[nodiscard]] std::string validate(const InfiniteLine& curve);

/// The same points travelled the other way: the body changes sides.
[[nodiscard]] LagrangeCurve reversed(const LagrangeCurve& curve);
[[nodiscard]] inline Circle reversed(Circle curve) {
  curve.inside = !curve.inside;
  return curve;
}
[[nodiscard]] inline Arc reversed(Arc curve) {
  curve.inside = !curve.inside;
  return curve;
}
[[nodiscard]] inline InfiniteLine reversed(InfiniteLine curve) {
  curve.normal = -curve.normal;
  return curve;
}

/// Corner points joined by straight segments. Not a smooth curve, hence no jet: it only yields its
/// segments.
struct Polyline {
  static constexpr std::string_view key = "polyline";
  std::vector<Vec2> points;
  bool closed = false;

  [[nodiscard]] std::size_t segments() const;
  /// Segment i from point i to the next one; needs i < segments().
  [[nodiscard]] LagrangeCurve segment(std::size_t i) const;
};
/// Names points that are too few, not finite, or coincide with their neighbour.
[[nodiscard]] std::string validate(const Polyline& line);

}  // namespace osculate::geometry
