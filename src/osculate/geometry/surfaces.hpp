#pragma once
#include <array>
#include <limits>
#include <span>
#include <string>
#include <string_view>

#include "osculate/cell/facet_shape.hpp"
#include "osculate/geometry/surface_jet.hpp"

namespace osculate::geometry {

// Every surface is a plain struct with the same five members (key, jet, lo, hi, closed) and a free
// function validate(), which returns an empty string or what was expected. Convention for all:
// n = r_1 x r_2 / |r_1 x r_2| points out of the body. Analytic shapes are solid; with `inside` the
// body lies around them and the normal points into the hole.

/// Which of the two parameters run round and meet themselves.
using ClosedFlags = std::array<bool, 2>;

/// Columns e1, e2, e3 with e3 along `axis` (any length but zero); e1 is the same for every call.
[[nodiscard]] Mat<3, 3> axis_frame(const Vec3& axis);

/// Plane without borders; xi are lengths from `point`. The body is the half space that `normal`
/// (any length but zero) points away from.
struct Plane {
  static constexpr std::string_view key = "plane";
  Vec3 point{0, 0, 0};
  Vec3 normal{0, 0, 1};

  [[nodiscard]] Mat<3, 3> frame() const { return axis_frame(normal); }  ///< e1, e2, unit normal
  [[nodiscard]] SurfaceJet jet(const Vec2& xi) const;
  [[nodiscard]] Vec2 lo() const;
  [[nodiscard]] Vec2 hi() const;
  [[nodiscard]] ClosedFlags closed() const { return {false, false}; }
};
[[nodiscard]] std::string validate(const Plane& plane);

/// Full sphere without a pole: two stereographic charts, each regular on its hemisphere and far
/// beyond it, so that a contact point may sit anywhere.
///
/// Formula    r = c + R (2u e1 + 2v e2 + (1 - u^2 - v^2) e3)/(1 + u^2 + v^2) ; the chart of the
///            hemisphere +e3 is |(u, v)| <= 1 with xi = (u, v); that of -e3 has the axes e1, -e2,
///            -e3 and xi = (u + chart_shift, v); `inside` exchanges u and v
/// Sign       mean curvature -1/R (solid), +1/R (hole)
struct Sphere {
  static constexpr std::string_view key = "sphere";
  static constexpr double chart_shift = 4;
  Vec3 center{0, 0, 0};
  double radius = 1;
  bool inside = false;
  Vec3 axis{0, 0, 1};  ///< middle of the first chart

  [[nodiscard]] SurfaceJet jet(const Vec2& xi) const;
  [[nodiscard]] Vec2 lo() const { return {-1, -1}; }
  [[nodiscard]] Vec2 hi() const { return {1 + chart_shift, 1}; }
  [[nodiscard]] ClosedFlags closed() const { return {false, false}; }
};
[[nodiscard]] std::string validate(const Sphere& sphere);

/// Circular cylinder; xi1 is the angle round the axis, xi2 the length along it from `point`.
///
/// Formula    r = p + R (cos phi e1 + sin phi e2) + xi2 e3 ; phi = xi1, with `inside` -xi1
struct Cylinder {
  static constexpr std::string_view key = "cylinder";
  Vec3 point{0, 0, 0};
  Vec3 axis{0, 0, 1};
  double radius = 1;
  bool inside = false;
  /// From `point` along the axis; infinite: without ends on both sides. The ends are open.
  double length = std::numeric_limits<double>::infinity();

  [[nodiscard]] SurfaceJet jet(const Vec2& xi) const;
  [[nodiscard]] Vec2 lo() const;
  [[nodiscard]] Vec2 hi() const;
  [[nodiscard]] ClosedFlags closed() const { return {true, false}; }
};
[[nodiscard]] std::string validate(const Cylinder& cylinder);

/// Circular cone that opens along `axis` from its apex; xi1 is the angle round the axis, xi2 the
/// distance from the apex along it. At the apex itself there is no normal.
///
/// Formula    r = p + xi2 (tan(alpha) (cos phi e1 + sin phi e2) + e3) ; phi = xi1, with `inside`
///            -xi1
struct Cone {
  static constexpr std::string_view key = "cone";
  Vec3 apex{0, 0, 0};
  Vec3 axis{0, 0, 1};
  double half_angle = 0.5;  ///< alpha, radians
  bool inside = false;
  double from = 0;  ///< a cut cone: between two distances along the axis
  double to = std::numeric_limits<double>::infinity();

  [[nodiscard]] SurfaceJet jet(const Vec2& xi) const;
  [[nodiscard]] Vec2 lo() const { return {0, from}; }
  [[nodiscard]] Vec2 hi() const;
  [[nodiscard]] ClosedFlags closed() const { return {true, false}; }
};
[[nodiscard]] std::string validate(const Cone& cone);

/// Ring torus; xi1 is the angle round the axis, xi2 the angle round the tube (0: outermost).
///
/// Formula    r = c + (R + r cos xi2) (cos phi e1 + sin phi e2) + r sin xi2 e3 ; phi = xi1, with
///            `inside` -xi1
struct Torus {
  static constexpr std::string_view key = "torus";
  Vec3 center{0, 0, 0};
  Vec3 axis{0, 0, 1};
  double radius = 2;       ///< R, from the axis to the middle of the tube
  double tube_radius = 1;  ///< r < R
  bool inside = false;

  [[nodiscard]] SurfaceJet jet(const Vec2& xi) const;
  [[nodiscard]] Vec2 lo() const { return {0, 0}; }
  [[nodiscard]] Vec2 hi() const;
  [[nodiscard]] ClosedFlags closed() const { return {true, true}; }
};
[[nodiscard]] std::string validate(const Torus& torus);

/// One Lagrange facet; nodes in the order of the cell type, walked so that the normal points out
/// of the body.
struct LagrangeSurface {
  static constexpr std::string_view key = "lagrange";
  cell::CellType type = cell::CellType::quad4;
  std::array<Vec3, cell::max_facet_nodes> nodes{};

  [[nodiscard]] std::span<const Vec3> used() const;
  [[nodiscard]] SurfaceJet jet(const Vec2& xi) const;
  [[nodiscard]] Vec2 lo() const;
  [[nodiscard]] Vec2 hi() const { return {1, 1}; }
  [[nodiscard]] ClosedFlags closed() const { return {false, false}; }
};
[[nodiscard]] LagrangeSurface lagrange_surface(cell::CellType type, std::span<const Vec3> nodes);
[[nodiscard]] std::string validate(const LagrangeSurface& surface);

/// Position and derivatives from shape functions and nodes.
[[nodiscard]] SurfaceJet jet_from_shape(const cell::FacetShape& shape, std::span<const Vec3> nodes);

}  // namespace osculate::geometry
