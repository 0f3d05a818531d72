#pragma once
#include <limits>
#include <type_traits>
#include <variant>
#include <vector>

#include "osculate/types.hpp"

// Curves and surfaces in closed form. Lengths are those of the coordinates, angles in radians.
namespace osculate {

// ---- the plane: the body is on the right of the direction of travel ----------------------------

/// Straight line without ends; the body is the half plane that `normal` points away from.
struct Line {
  Vector<2> point{0, 0};
  Vector<2> normal{0, 1};  ///< any length but zero
};

/// Straight line from one place to another.
struct Segment {
  Vector<2> from{0, 0}, to{1, 0};
};

/// Full circle.
struct Circle {
  Vector<2> center{0, 0};
  double radius = 1;
  bool inside = false;  ///< a hole: the body is outside the circle
};

/// Part of a circle between two angles from the x-axis, from < to <= from + 2 pi. Travelled from
/// `to` to `from`; with `inside` the other way.
struct Arc {
  Vector<2> center{0, 0};
  double radius = 1;
  double from = 0, to = 1;
  bool inside = false;
};

/// Rational B-spline curve; control points are not multiplied by their weights.
struct NurbsCurve {
  int degree = 1;  ///< 1 to 7
  std::vector<double> knots;
  std::vector<Vector<2>> control;
  std::vector<double> weights;
};

// ---- space: the normal points out of the body --------------------------------------------------

/// Plane without borders; the body is the half space that `normal` points away from.
struct Plane {
  Vector<3> point{0, 0, 0};
  Vector<3> normal{0, 0, 1};  ///< any length but zero
};

/// Sphere.
struct Sphere {
  Vector<3> center{0, 0, 0};
  double radius = 1;
  bool inside = false;  ///< a hole, here and below: the body is around it
};

/// Circular cylinder, from `point` along the axis; infinite: without ends on both sides.
struct Cylinder {
  Vector<3> point{0, 0, 0}, axis{0, 0, 1};
  double radius = 1;
  bool inside = false;
  double length = std::numeric_limits<double>::infinity();
};

/// Circular cone that opens along `axis` from its apex, between two distances along it.
struct Cone {
  Vector<3> apex{0, 0, 0}, axis{0, 0, 1};
  double half_angle = 0.5;
  bool inside = false;
  double from = 0, to = std::numeric_limits<double>::infinity();
};

/// Ring torus: tube_radius < radius, the latter from the axis to the middle of the tube.
struct Torus {
  Vector<3> center{0, 0, 0}, axis{0, 0, 1};
  double radius = 2, tube_radius = 1;
  bool inside = false;
};

/// Rational B-spline surface; control point (i, j), i along the first parameter, is number
/// i count[1] + j. The normal is along r_1 x r_2.
struct NurbsSurface {
  std::array<int, 2> degree{1, 1};
  std::array<std::vector<double>, 2> knots;
  std::array<int, 2> count{0, 0};
  std::vector<Vector<3>> control;
  std::vector<double> weights;
};

using CurveShape = std::variant<Line, Segment, Circle, Arc, NurbsCurve>;
using SurfaceShape = std::variant<Plane, Sphere, Cylinder, Cone, Torus, NurbsSurface>;
template <int Dim>
using Shape = std::conditional_t<Dim == 2, CurveShape, SurfaceShape>;

}  // namespace osculate
