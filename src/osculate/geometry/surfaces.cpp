#include <Eigen/Geometry>

#include "osculate/geometry/surface_catalogue.hpp"

namespace osculate::geometry {

Mat<3, 3> Plane::frame() const {
  Mat<3, 3> f;
  f.col(2) = normal.normalized();
  const Vec3 unit = f.col(2);
  f.col(0) = unit.unitOrthogonal();
  const Vec3 first = f.col(0);
  f.col(1) = unit.cross(first);
  return f;
}

SurfaceJet Plane::jet(const Vec2& xi) const {
  const Mat<3, 3> f = frame();
  SurfaceJet jet;
  jet.r = point + f.leftCols<2>() * xi;
  jet.r1 = {f.col(0), f.col(1)};
  return jet;
}

}  // namespace osculate::geometry
