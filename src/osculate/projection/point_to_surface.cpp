#include "osculate/projection/point_to_surface.hpp"

namespace osculate::projection {
namespace {

SurfaceFoot foot_on(const geometry::Plane& plane, const Vec3& point) {
  const Mat<3, 3> frame = plane.frame();
  const Vec3 local = frame.transpose() * (point - plane.point);
  return {true, local.head<2>(), local.z() * local.z(), false};
}

}  // namespace

SurfaceFoot closest_point(const geometry::Surface& surface, const Vec3& point) {
  return std::visit([&](const auto& s) { return foot_on(s, point); }, surface);
}

}  // namespace osculate::projection
