#pragma once
#include <limits>

#include "osculate/geometry/surface_catalogue.hpp"

namespace osculate::projection {

/// The nearest place of a smooth surface.
///
/// Errors     converged = false, xi = lo (0 where that is infinite): the point or the surface is
/// not
///            finite (squared_distance is then infinite); never NaN
struct SurfaceFoot {
  bool converged = false;
  Vec2 xi{0, 0};
  double squared_distance = std::numeric_limits<double>::infinity();
  bool at_border = false;  ///< on an open border, or the apex of a cone, and not orthogonal there
  bool at_kink = false;    ///< on a knot line or seam where a NURBS patch is bent sharply
};

/// Closest point in closed form for plane, sphere, cylinder, cone and torus; a Lagrange facet as in
/// point_to_facet.hpp; a NURBS patch span by span: spans whose control points are all farther than
/// the best foot point so far are left out, in the others safeguarded Newton starts from every
/// local minimum of a grid of 2 degree + 1 points each way. Does not allocate.
///
/// A point that misses a border by less than `end_tolerance` of the parameter range belongs to the
/// surface. Where all points of a curve or of the surface are equally near (axes, centres) it is
/// the one at xi1 = 0; on the middle of a torus' tube the outermost; at the centre of a sphere the
/// middle of its first chart.
///
/// Tested by  tests/unit/projection/test_point_to_surface.cpp (against brute force)
[[nodiscard]] SurfaceFoot closest_point(const geometry::Surface& surface, const Vec3& point);
[[nodiscard]] SurfaceFoot closest_point(const geometry::NurbsPatch& patch, const Vec3& point);

}  // namespace osculate::projection
