#include "osculate/geometry/surfaces.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace osculate::geometry {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double two_pi = 2.0 * std::numbers::pi;

/// A profile in the half plane through the axis: distance from the axis and height, each with
/// three derivatives in xi2.
struct Profile {
  std::array<double, 4> radius{}, height{};
};

/// Surface of revolution about column e3 of `frame`; turn = 1: xi1 counter-clockwise, -1:
/// clockwise.
SurfaceJet revolve(const Vec3& origin, const Mat<3, 3>& frame, double turn, double xi1,
                   const Profile& profile) {
  const Vec3 e1 = frame.col(0), e2 = frame.col(1), e3 = frame.col(2);
  const Vec3 out = std::cos(xi1) * e1 + turn * std::sin(xi1) * e2;
  const Vec3 along = turn * std::cos(xi1) * e2 - std::sin(xi1) * e1;
  const std::array<double, 4>& p = profile.radius;
  const std::array<double, 4>& z = profile.height;
  SurfaceJet jet;
  jet.r = origin + p[0] * out + z[0] * e3;
  jet.r1 = {p[0] * along, p[1] * out + z[1] * e3};
  jet.r2 = {-p[0] * out, p[1] * along, p[2] * out + z[2] * e3};
  jet.r3 = {-p[0] * along, -p[1] * out, p[2] * along, p[3] * out + z[3] * e3};
  return jet;
}

/// The same surface with the two parameters exchanged: the normal turns round.
void exchange_parameters(SurfaceJet& jet) {
  std::swap(jet.r1[0], jet.r1[1]);
  std::swap(jet.r2[0], jet.r2[2]);
  std::swap(jet.r3[0], jet.r3[3]);
  std::swap(jet.r3[1], jet.r3[2]);
}

/// 2/(1 + u^2 + v^2) and its derivatives in the places of `cell::FacetShape::n`.
std::array<double, 10> stereographic_scale(double u, double v) {
  const double s = 1 + u * u + v * v;
  const std::array<double, 2> d{2 * u, 2 * v};  // of s; its second derivatives are 2, 0, 2
  const auto second = [](std::size_t i, std::size_t j) { return i == j ? 2.0 : 0.0; };
  std::array<double, 10> f{};
  f[0] = 2 / s;
  const double f2 = f[0] / s, f3 = f2 / s, f4 = f3 / s;
  for (std::size_t i = 0; i < 2; ++i) {
    f[1 + i] = -f2 * d[i];
    for (std::size_t j = i; j < 2; ++j) {
      f[cell::second_index(i, j)] = 2 * f3 * d[i] * d[j] - f2 * second(i, j);
      for (std::size_t k = j; k < 2; ++k)
        f[cell::third_index(i, j, k)] =
            -6 * f4 * d[i] * d[j] * d[k] +
            2 * f3 * (second(i, j) * d[k] + second(i, k) * d[j] + second(j, k) * d[i]);
    }
  }
  return f;
}

/// Derivatives of x_m f for the coordinate x_m (m = 0: u, 1: v).
std::array<double, 10> times_coordinate(const std::array<double, 10>& f, std::size_t m, double x) {
  std::array<double, 10> g{};
  const auto is = [m](std::size_t i) { return i == m ? 1.0 : 0.0; };
  g[0] = x * f[0];
  for (std::size_t i = 0; i < 2; ++i) {
    g[1 + i] = is(i) * f[0] + x * f[1 + i];
    for (std::size_t j = i; j < 2; ++j) {
      const std::size_t ij = cell::second_index(i, j);
      g[ij] = is(i) * f[1 + j] + is(j) * f[1 + i] + x * f[ij];
      for (std::size_t k = j; k < 2; ++k) {
        const std::size_t ijk = cell::third_index(i, j, k);
        g[ijk] = is(i) * f[cell::second_index(j, k)] + is(j) * f[cell::second_index(i, k)] +
                 is(k) * f[ij] + x * f[ijk];
      }
    }
  }
  return g;
}

std::string check_direction(std::string_view field, const Vec3& v) {
  if (v.allFinite() && v.norm() > 0 && std::isfinite(v.norm())) return {};
  return fmt::format("{}: expected a vector of finite length > 0", field);
}
std::string check_place(std::string_view field, const Vec3& v) {
  return v.allFinite() ? std::string() : fmt::format("{}: expected three finite numbers", field);
}
std::string check_size(std::string_view field, double size) {
  if (size > 0 && std::isfinite(size)) return {};
  return fmt::format("{}: expected a number > 0, found {}", field, size);
}
/// The first message that is not empty.
std::string first_of(std::initializer_list<std::string> messages) {
  for (const std::string& text : messages)
    if (!text.empty()) return text;
  return {};
}

}  // namespace

Mat<3, 3> axis_frame(const Vec3& axis) {
  const Vec3 e3 = axis.stableNormalized();
  const Vec3 e1 = e3.unitOrthogonal();
  Mat<3, 3> frame;
  frame << e1, e3.cross(e1), e3;
  return frame;
}

SurfaceJet Plane::jet(const Vec2& xi) const {
  const Mat<3, 3> f = frame();
  SurfaceJet jet;
  jet.r = point + f.leftCols<2>() * xi;
  jet.r1 = {f.col(0), f.col(1)};
  return jet;
}
Vec2 Plane::lo() const { return {-infinity, -infinity}; }
Vec2 Plane::hi() const { return {infinity, infinity}; }
std::string validate(const Plane& plane) {
  return first_of({check_place("point", plane.point), check_direction("normal", plane.normal)});
}

SurfaceJet Sphere::jet(const Vec2& xi) const {
  const bool second = xi.x() > 0.5 * chart_shift;
  Vec2 uv(second ? xi.x() - chart_shift : xi.x(), xi.y());
  if (inside) std::swap(uv.x(), uv.y());
  Mat<3, 3> axes = radius * axis_frame(axis);
  if (second) axes.rightCols<2>() *= -1.0;
  const std::array<double, 10> f = stereographic_scale(uv.x(), uv.y());
  const std::array<double, 10> a = times_coordinate(f, 0, uv.x());
  const std::array<double, 10> b = times_coordinate(f, 1, uv.y());
  const auto at = [&](std::size_t d) { return Vec3(axes * Vec3(a[d], b[d], f[d])); };
  SurfaceJet jet;
  jet.r = center + axes * Vec3(a[0], b[0], f[0] - 1);
  jet.r1 = {at(1), at(2)};
  jet.r2 = {at(3), at(4), at(5)};
  jet.r3 = {at(6), at(7), at(8), at(9)};
  if (inside) exchange_parameters(jet);
  return jet;
}
std::string validate(const Sphere& sphere) {
  return first_of({check_place("center", sphere.center), check_size("radius", sphere.radius),
                   check_direction("axis", sphere.axis)});
}

SurfaceJet Cylinder::jet(const Vec2& xi) const {
  const Profile profile{{radius, 0, 0, 0}, {xi.y(), 1, 0, 0}};
  return revolve(point, axis_frame(axis), inside ? -1.0 : 1.0, xi.x(), profile);
}
Vec2 Cylinder::lo() const { return {0, std::isfinite(length) ? 0 : -infinity}; }
Vec2 Cylinder::hi() const { return {two_pi, length}; }
std::string validate(const Cylinder& cylinder) {
  std::string length;
  if (!(cylinder.length > 0))
    length = fmt::format("length: expected a number > 0, found {}", cylinder.length);
  return first_of({check_place("point", cylinder.point), check_direction("axis", cylinder.axis),
                   check_size("radius", cylinder.radius), length});
}

SurfaceJet Cone::jet(const Vec2& xi) const {
  const double slope = std::tan(half_angle);
  const Profile profile{{slope * xi.y(), slope, 0, 0}, {xi.y(), 1, 0, 0}};
  return revolve(apex, axis_frame(axis), inside ? -1.0 : 1.0, xi.x(), profile);
}
Vec2 Cone::hi() const { return {two_pi, to}; }
std::string validate(const Cone& cone) {
  std::string angle, range;
  if (!(cone.half_angle > 0 && cone.half_angle < 0.5 * std::numbers::pi))
    angle = fmt::format("half_angle: expected an angle between 0 and pi/2 (in radians), found {}",
                        cone.half_angle);
  if (!(cone.from >= 0 && cone.to > cone.from && std::isfinite(cone.from)))
    range = fmt::format("from, to: expected 0 <= from < to, found {} and {}", cone.from, cone.to);
  return first_of(
      {check_place("apex", cone.apex), check_direction("axis", cone.axis), angle, range});
}

SurfaceJet Torus::jet(const Vec2& xi) const {
  const double c = tube_radius * std::cos(xi.y()), s = tube_radius * std::sin(xi.y());
  const Profile profile{{radius + c, -s, -c, s}, {s, c, -s, -c}};
  return revolve(center, axis_frame(axis), inside ? -1.0 : 1.0, xi.x(), profile);
}
Vec2 Torus::hi() const { return {two_pi, two_pi}; }
std::string validate(const Torus& torus) {
  std::string ring;
  if (!(torus.tube_radius < torus.radius))
    ring = fmt::format("tube_radius: expected a number below radius = {}, found {}", torus.radius,
                       torus.tube_radius);
  return first_of({check_place("center", torus.center), check_direction("axis", torus.axis),
                   check_size("radius", torus.radius), check_size("tube_radius", torus.tube_radius),
                   ring});
}

SurfaceJet jet_from_shape(const cell::FacetShape& shape, std::span<const Vec3> nodes) {
  assert(nodes.size() >= static_cast<std::size_t>(shape.count));
  SurfaceJet jet;
  for (std::size_t k = 0; k < static_cast<std::size_t>(shape.count); ++k) {
    jet.r += shape.n[0][k] * nodes[k];
    for (std::size_t d = 0; d < 2; ++d) jet.r1[d] += shape.n[1 + d][k] * nodes[k];
    for (std::size_t d = 0; d < 3; ++d) jet.r2[d] += shape.n[3 + d][k] * nodes[k];
    for (std::size_t d = 0; d < 4; ++d) jet.r3[d] += shape.n[6 + d][k] * nodes[k];
  }
  return jet;
}

std::span<const Vec3> LagrangeSurface::used() const {
  return {nodes.data(), static_cast<std::size_t>(cell::info(type).nodes)};
}
SurfaceJet LagrangeSurface::jet(const Vec2& xi) const {
  return jet_from_shape(cell::facet_shape(type, xi), nodes);
}
Vec2 LagrangeSurface::lo() const { return cell::is_triangle(type) ? Vec2(0, 0) : Vec2(-1, -1); }

LagrangeSurface lagrange_surface(cell::CellType type, std::span<const Vec3> nodes) {
  assert(cell::is_facet(type) && nodes.size() == static_cast<std::size_t>(cell::info(type).nodes));
  LagrangeSurface surface;
  surface.type = type;
  surface.nodes.fill(Vec3::Zero());
  std::copy_n(nodes.begin(), std::min<std::size_t>(nodes.size(), cell::max_facet_nodes),
              surface.nodes.begin());
  return surface;
}

std::string validate(const LagrangeSurface& surface) {
  if (!cell::is_facet(surface.type))
    return fmt::format("type: expected tri3, tri6, quad4, quad8 or quad9, found {}",
                       cell::info(surface.type).name);
  const std::span<const Vec3> nodes = surface.used();
  for (std::size_t k = 0; k < nodes.size(); ++k)
    if (!nodes[k].allFinite())
      return fmt::format("nodes: expected finite coordinates, node {} has none", k);
  const Vec2 middle = cell::is_triangle(surface.type) ? Vec2(1.0 / 3, 1.0 / 3) : Vec2(0, 0);
  const SurfaceJet jet = surface.jet(middle);
  const double sides = jet.r1[0].norm() * jet.r1[1].norm();
  if (!(jet.r1[0].cross(jet.r1[1]).norm() > 1e-14 * sides))
    return "nodes: expected a facet with an area";
  return {};
}

}  // namespace osculate::geometry
