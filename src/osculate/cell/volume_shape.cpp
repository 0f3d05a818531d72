#include "osculate/cell/volume_shape.hpp"

#include <array>

#include "osculate/cell/shape.hpp"

namespace osculate::cell {
namespace {

/// Places of the nodes of hex27; hex8 and hex20 have the first of them.
constexpr std::array<std::array<int, 3>, 27> hex_places{
    {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1},  {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1},
     {-1, 1, 1},   {0, -1, -1}, {-1, 0, -1}, {-1, -1, 0}, {1, 0, -1},  {1, -1, 0}, {0, 1, -1},
     {1, 1, 0},    {-1, 1, 0},  {0, -1, 1},  {-1, 0, 1},  {1, 0, 1},   {0, 1, 1},  {0, 0, -1},
     {0, -1, 0},   {-1, 0, 0},  {1, 0, 0},   {0, 1, 0},   {0, 0, 1},   {0, 0, 0}}};

Vec3 hex_place(int k) {
  const auto& p = hex_places[static_cast<std::size_t>(k)];
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

/// A polynomial along one axis and its slope.
struct Factor {
  double n, d;
};

/// Shape function and slopes from the factors of the three axes.
void set_product(VolumeShape& s, int k, const Factor& x, const Factor& y, const Factor& z) {
  s.n[k] = x.n * y.n * z.n;
  s.d.row(k) << x.d * y.n * z.n, x.n * y.d * z.n, x.n * y.n * z.d;
}

/// 1 at `place` = -1 or 1, 0 at the other end.
Factor linear(double place, double x) { return {0.5 * (1 + place * x), 0.5 * place}; }
/// 1 at `place` = -1, 0 or 1, 0 at the other two.
Factor quadratic(double place, double x) {
  if (place == 0) return {1 - x * x, -2 * x};
  return {0.5 * x * (x + place), x + 0.5 * place};
}
Factor bubble(double x) { return {1 - x * x, -2 * x}; }

VolumeShape hex8(const Vec3& xi) {
  VolumeShape s;
  s.count = 8;
  for (int k = 0; k < 8; ++k) {
    const Vec3 p = hex_place(k);
    set_product(s, k, linear(p.x(), xi.x()), linear(p.y(), xi.y()), linear(p.z(), xi.z()));
  }
  return s;
}

VolumeShape hex20(const Vec3& xi) {
  VolumeShape s;
  s.count = 20;
  for (int k = 0; k < 20; ++k) {
    const Vec3 p = hex_place(k);
    std::array<Factor, 3> f;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto axis = static_cast<Eigen::Index>(i);
      f[i] = p[axis] == 0 ? bubble(xi[axis]) : linear(p[axis], xi[axis]);
    }
    set_product(s, k, f[0], f[1], f[2]);
    if (k >= 8) continue;
    const double rest = p.dot(xi) - 2;  // zero at the middles of the corner's three edges
    s.d.row(k) = rest * s.d.row(k) + s.n[k] * p.transpose();
    s.n[k] *= rest;
  }
  return s;
}

VolumeShape hex27(const Vec3& xi) {
  VolumeShape s;
  s.count = 27;
  for (int k = 0; k < 27; ++k) {
    const Vec3 p = hex_place(k);
    set_product(s, k, quadratic(p.x(), xi.x()), quadratic(p.y(), xi.y()), quadratic(p.z(), xi.z()));
  }
  return s;
}

/// Shape functions of an area on two faces.
VolumeShape layered(CellType area, const Vec3& xi) {
  const AreaShape a = area_shape(area, xi.head<2>());
  VolumeShape s;
  s.count = 2 * a.count;
  for (int k = 0; k < s.count; ++k) {
    const int i = k % a.count;
    const Factor z = linear(k < a.count ? -1.0 : 1.0, xi.z());
    s.n[k] = a.n[i] * z.n;
    s.d.row(k) << a.d(i, 0) * z.n, a.d(i, 1) * z.n, a.n[i] * z.d;
  }
  return s;
}

/// Gradient of the volume coordinate of a corner.
Vec3 tet_gradient(std::size_t corner) {
  return corner == 0 ? Vec3(-1, -1, -1) : Vec3(Vec3::Unit(static_cast<Eigen::Index>(corner) - 1));
}
constexpr std::array<std::array<std::size_t, 2>, 6> tet_edges{
    {{0, 1}, {1, 2}, {2, 0}, {3, 0}, {2, 3}, {1, 3}}};

VolumeShape tet(CellType type, const Vec3& xi) {
  const std::array<double, 4> l{1 - xi.sum(), xi.x(), xi.y(), xi.z()};
  VolumeShape s;
  s.count = info(type).nodes;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto at = static_cast<Eigen::Index>(k);
    s.n[at] = type == CellType::tet4 ? l[k] : l[k] * (2 * l[k] - 1);
    s.d.row(at) = (type == CellType::tet4 ? 1 : 4 * l[k] - 1) * tet_gradient(k).transpose();
  }
  if (type == CellType::tet4) return s;
  for (std::size_t e = 0; e < 6; ++e) {
    const auto at = static_cast<Eigen::Index>(4 + e);
    const auto [i, j] = tet_edges[e];
    s.n[at] = 4 * l[i] * l[j];
    s.d.row(at) = 4 * (l[i] * tet_gradient(j) + l[j] * tet_gradient(i)).transpose();
  }
  return s;
}

Vec2 tri_gradient(std::size_t corner) {
  return corner == 0 ? Vec2(-1, -1) : Vec2(Vec2::Unit(static_cast<Eigen::Index>(corner) - 1));
}
constexpr std::array<std::array<std::size_t, 2>, 9> wedge_edges{
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 4}, {2, 5}, {3, 4}, {3, 5}, {4, 5}}};

/// `value` times a function of zeta, with the gradient of `value` in the triangle.
void set_wedge(VolumeShape& s, Eigen::Index k, double value, const Vec2& gradient,
               const Factor& z) {
  s.n[k] = value * z.n;
  s.d.row(k) << gradient.x() * z.n, gradient.y() * z.n, value * z.d;
}

VolumeShape wedge15(const Vec3& xi) {
  const std::array<double, 3> l{1 - xi.x() - xi.y(), xi.x(), xi.y()};
  const double z = xi.z();
  VolumeShape s;
  s.count = 15;
  for (std::size_t k = 0; k < 6; ++k) {
    const double side = k < 3 ? -1.0 : 1.0, at = l[k % 3];
    const auto n = static_cast<Eigen::Index>(k);
    const Factor ramp = linear(side, z);
    const double rest = 2 * at - 2 + side * z;
    s.n[n] = at * ramp.n * rest;
    const Vec2 in_plane = (rest + 2 * at) * ramp.n * tri_gradient(k % 3);
    s.d.row(n) << in_plane.x(), in_plane.y(), at * (ramp.d * rest + ramp.n * side);
  }
  for (std::size_t e = 0; e < 9; ++e) {
    const auto [a, b] = wedge_edges[e];
    const auto n = static_cast<Eigen::Index>(6 + e);
    const std::size_t i = a % 3, j = b % 3;
    if (i == j) {
      set_wedge(s, n, l[i], tri_gradient(i), bubble(z));
      continue;
    }
    set_wedge(s, n, 4 * l[i] * l[j], 4 * (l[i] * tri_gradient(j) + l[j] * tri_gradient(i)),
              linear(a < 3 ? -1.0 : 1.0, z));
  }
  return s;
}

Vec3 wedge_corner(std::size_t k) {
  const Vec2 p = area_node(CellType::tri3, static_cast<int>(k % 3));
  return {p.x(), p.y(), k < 3 ? -1.0 : 1.0};
}

}  // namespace

VolumeShape volume_shape(CellType type, const Vec3& xi) {
  switch (type) {
    case CellType::tet4:
    case CellType::tet10:
      return tet(type, xi);
    case CellType::wedge6:
      return layered(CellType::tri3, xi);
    case CellType::wedge15:
      return wedge15(xi);
    case CellType::hex8:
      return hex8(xi);
    case CellType::hex20:
      return hex20(xi);
    case CellType::hex27:
      return hex27(xi);
    case CellType::shell18:
      return layered(CellType::quad9, xi);
    default:
      return {};
  }
}

Vec3 volume_node(CellType type, int node) {
  const auto k = static_cast<std::size_t>(node);
  switch (type) {
    case CellType::tet4:
    case CellType::tet10: {
      const auto corner = [](std::size_t i) {
        return i == 0 ? Vec3(Vec3::Zero()) : tet_gradient(i);
      };
      if (k < 4) return corner(k);
      return 0.5 * (corner(tet_edges[k - 4][0]) + corner(tet_edges[k - 4][1]));
    }
    case CellType::wedge6:
    case CellType::wedge15:
      if (k < 6) return wedge_corner(k);
      return 0.5 * (wedge_corner(wedge_edges[k - 6][0]) + wedge_corner(wedge_edges[k - 6][1]));
    case CellType::shell18: {
      const Vec2 p = area_node(CellType::quad9, node % 9);
      return {p.x(), p.y(), node < 9 ? -1.0 : 1.0};
    }
    default:
      return hex_place(node);
  }
}

}  // namespace osculate::cell
