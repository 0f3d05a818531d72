#include "osculate/material/orientation.hpp"

#include <Eigen/Geometry>
#include <array>

namespace osculate::material {
namespace {

Mat<3, 3> axes_along(const Vec3& a, const Vec3& b) {
  Mat<3, 3> axes;
  axes.col(0) = a.normalized();
  axes.col(2) = a.cross(b).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

Vec3 any_across(const Vec3& axis) {
  Eigen::Index least = 0;
  axis.cwiseAbs().minCoeff(&least);
  return axis.cross(Vec3::Unit(least)).cross(axis);
}

Mat<3, 3> cylindrical_axes(const Vec3& a, const Vec3& b, const Vec3& x) {
  const Vec3 along = (b - a).normalized();
  const Vec3 arm = x - a;
  Vec3 radial = arm - arm.dot(along) * along;
  constexpr double on_axis = 1e-10;
  if (!(radial.norm() > on_axis * (1 + arm.norm()))) radial = any_across(along);
  return axes_along(radial, along.cross(radial));
}

}  // namespace

Mat<3, 3> axes_at(const Orientation& o, const Vec3& place) {
  Mat<3, 3> axes = Mat<3, 3>::Identity();
  if (o.kind == Orientation::Kind::rectangular) axes = axes_along(o.a, o.b);
  if (o.kind == Orientation::Kind::cylindrical) axes = cylindrical_axes(o.a, o.b, place);
  if (o.angle != 0) axes = axes * Eigen::AngleAxisd(o.angle, Vec3::Unit(o.about));
  return axes;
}

Mat<3, 3> axes_along_shell(const Mat<3, 3>& axes, const Vec3& normal) {
  constexpr double across = 0.9999984769132877;  // the cosine of 0.1 degrees
  const Eigen::Index led = std::abs(normal.dot(axes.col(0))) > across ? 2 : 0;
  const Vec3 first = axes.col(led) - normal.dot(axes.col(led)) * normal;
  return axes_along(first, normal.cross(first));
}

bool gives_axes(const Orientation& o) {
  switch (o.kind) {
    case Orientation::Kind::rectangular:
      return o.a.cross(o.b).norm() > 0;
    case Orientation::Kind::cylindrical:
      return (o.b - o.a).norm() > 0;
    default:
      return true;
  }
}

Mat<6, 6> into_axes(const Mat<3, 3>& axes) {
  constexpr std::array<std::array<Eigen::Index, 2>, 6> of{
      {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};
  Mat<6, 6> rows;
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j) {
      const auto [a, b] = of[i];
      const auto [k, l] = of[j];
      const double sum = axes(k, a) * axes(l, b) + axes(l, a) * axes(k, b);
      rows(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          0.5 * (i < 3 ? 1 : 2) * sum;
    }
  return rows;
}

Tangent3 turned(const Tangent3& stiffness, const Mat<3, 3>& axes) {
  const Mat<6, 6> into = into_axes(axes);
  const Tangent3 d = into.transpose() * stiffness * into;
  return 0.5 * (d + d.transpose());
}

}  // namespace osculate::material
