#include "osculate/projection/point_to_surface.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "osculate/projection/point_to_curve.hpp"
#include "osculate/projection/point_to_facet.hpp"

namespace osculate::projection {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

double squared(double x) { return x * x; }

/// An analytic foot point that came out finite, or none.
SurfaceFoot checked(const Vec2& xi, double squared_distance, bool at_border = false) {
  if (!xi.allFinite() || !std::isfinite(squared_distance)) return {};
  return {true, xi, squared_distance, at_border, false};
}

/// A point in cylindrical coordinates about an axis; `turn` = -1 counts the angle clockwise.
struct Cylindrical {
  double angle = 0;  ///< 0 <= angle < 2 pi; 0 on the axis
  double radius = 0, height = 0;
};

Cylindrical cylindrical(const Vec3& arm, const Vec3& axis, bool inside) {
  const Vec3 local = geometry::axis_frame(axis).transpose() * arm;
  Cylindrical c{0, std::hypot(local.x(), local.y()), local.z()};
  if (c.radius > 0) c.angle = std::atan2(inside ? -local.y() : local.y(), local.x());
  if (c.angle < 0) c.angle += two_pi;
  if (c.angle >= two_pi) c.angle = 0;
  return c;
}

/// A coordinate brought back into its range, and whether it was beyond by more than the tolerance.
struct Clamped {
  double xi;
  bool beyond;
};

Clamped clamped(double xi, double lo, double hi) {
  const double range = std::isfinite(hi - lo) ? hi - lo : std::abs(lo);
  const double inside = std::clamp(xi, lo, hi);
  return {inside, std::abs(xi - inside) > end_tolerance * range};
}

SurfaceFoot foot_on(const geometry::Plane& plane, const Vec3& point) {
  const Vec3 local = plane.frame().transpose() * (point - plane.point);
  return checked(local.head<2>(), squared(local.z()));
}

SurfaceFoot foot_on(const geometry::Sphere& sphere, const Vec3& point) {
  Vec3 local = geometry::axis_frame(sphere.axis).transpose() * (point - sphere.center);
  const double length = local.norm();
  const Vec3 ray = length > 0 ? Vec3(local / length) : Vec3(0, 0, 1);
  const bool second = ray.z() < 0;
  Vec2 uv(ray.x(), second ? -ray.y() : ray.y());
  uv /= 1 + std::abs(ray.z());
  if (sphere.inside) std::swap(uv.x(), uv.y());
  if (second) uv.x() += geometry::Sphere::chart_shift;
  return checked(uv, squared(length - sphere.radius));
}

SurfaceFoot foot_on(const geometry::Cylinder& cylinder, const Vec3& point) {
  const Cylindrical c = cylindrical(point - cylinder.point, cylinder.axis, cylinder.inside);
  const Clamped z = clamped(c.height, cylinder.lo().y(), cylinder.hi().y());
  return checked({c.angle, z.xi}, squared(c.radius - cylinder.radius) + squared(c.height - z.xi),
                 z.beyond);
}

SurfaceFoot foot_on(const geometry::Cone& cone, const Vec3& point) {
  const Cylindrical c = cylindrical(point - cone.apex, cone.axis, cone.inside);
  const double s = std::sin(cone.half_angle), k = std::cos(cone.half_angle);
  const double along = c.radius * s + c.height * k;  // on the generator, from the apex
  const Clamped z = clamped(along * k, cone.from, cone.to);
  const double off = along - z.xi / k, across = c.radius * k - c.height * s;
  return checked({c.angle, z.xi}, squared(across) + squared(off), z.beyond || z.xi == 0);
}

SurfaceFoot foot_on(const geometry::Torus& torus, const Vec3& point) {
  const Cylindrical c = cylindrical(point - torus.center, torus.axis, torus.inside);
  const double arm = c.radius - torus.radius, length = std::hypot(arm, c.height);
  double angle = length > 0 ? std::atan2(c.height, arm) : 0.0;
  if (angle < 0) angle += two_pi;
  if (angle >= two_pi) angle = 0;
  return checked({c.angle, angle}, squared(length - torus.tube_radius));
}

SurfaceFoot foot_on(const geometry::LagrangeSurface& surface, const Vec3& point) {
  FacetFoot foot = closest_point(surface.type, surface.used(), point);
  if (!foot.converged) return {};
  FacetFoot free = foot;
  const bool border = foot.feature != Feature::face &&
                      !release(surface.type, surface.used(), point, end_tolerance, free);
  return checked(foot.xi, foot.squared_distance, border);
}

SurfaceFoot foot_on(const geometry::NurbsPatch& patch, const Vec3& point) {
  return closest_point(patch, point);
}

}  // namespace

SurfaceFoot closest_point(const geometry::Surface& surface, const Vec3& point) {
  if (point.allFinite())
    return std::visit([&](const auto& s) { return foot_on(s, point); }, surface);
  SurfaceFoot nowhere;
  const Vec2 lo = geometry::lo(surface);
  for (Eigen::Index i = 0; i < 2; ++i) nowhere.xi[i] = std::isfinite(lo[i]) ? lo[i] : 0.0;
  return nowhere;
}

}  // namespace osculate::projection
