#pragma once
#include <limits>

#include "osculate/geometry/surface_catalogue.hpp"

namespace osculate::projection {

/// The nearest place of an analytic surface.
struct SurfaceFoot {
  bool converged = false;
  Vec2 xi{0, 0};
  double squared_distance = std::numeric_limits<double>::infinity();
  bool at_border = false;
};

[[nodiscard]] SurfaceFoot closest_point(const geometry::Surface& surface, const Vec3& point);

}  // namespace osculate::projection
