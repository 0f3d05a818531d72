#include "osculate/cell/shape.hpp"

#include <array>

namespace osculate::cell {
namespace {

/// Lagrange polynomials on -1, 0, 1 and their slopes.
struct Quadratic {
  std::array<double, 3> n, d;
  explicit Quadratic(double x)
      : n{0.5 * x * (x - 1), 1 - x * x, 0.5 * x * (x + 1)}, d{x - 0.5, -2 * x, x + 0.5} {}
};

constexpr std::array<std::array<int, 2>, 9> quad_places{
    {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}, {0, 0}}};

AreaShape quad4(const Vec2& xi) {
  AreaShape s;
  s.count = 4;
  for (int k = 0; k < 4; ++k) {
    const double a = quad_places[static_cast<std::size_t>(k)][0];
    const double b = quad_places[static_cast<std::size_t>(k)][1];
    s.n[k] = 0.25 * (1 + a * xi.x()) * (1 + b * xi.y());
    s.d.row(k) << 0.25 * a * (1 + b * xi.y()), 0.25 * b * (1 + a * xi.x());
  }
  return s;
}

AreaShape quad8(const Vec2& xi) {
  AreaShape s;
  s.count = 8;
  for (int k = 0; k < 8; ++k) {
    const double a = quad_places[static_cast<std::size_t>(k)][0];
    const double b = quad_places[static_cast<std::size_t>(k)][1];
    const double x = xi.x(), y = xi.y();
    if (k < 4) {
      s.n[k] = 0.25 * (1 + a * x) * (1 + b * y) * (a * x + b * y - 1);
      s.d.row(k) << 0.25 * a * (1 + b * y) * (2 * a * x + b * y),
          0.25 * b * (1 + a * x) * (a * x + 2 * b * y);
    } else if (a == 0) {
      s.n[k] = 0.5 * (1 - x * x) * (1 + b * y);
      s.d.row(k) << -x * (1 + b * y), 0.5 * b * (1 - x * x);
    } else {
      s.n[k] = 0.5 * (1 + a * x) * (1 - y * y);
      s.d.row(k) << 0.5 * a * (1 - y * y), -y * (1 + a * x);
    }
  }
  return s;
}

AreaShape quad9(const Vec2& xi) {
  AreaShape s;
  s.count = 9;
  const Quadratic px(xi.x()), py(xi.y());
  for (int k = 0; k < 9; ++k) {
    const auto i = static_cast<std::size_t>(quad_places[static_cast<std::size_t>(k)][0] + 1);
    const auto j = static_cast<std::size_t>(quad_places[static_cast<std::size_t>(k)][1] + 1);
    s.n[k] = px.n[i] * py.n[j];
    s.d.row(k) << px.d[i] * py.n[j], px.n[i] * py.d[j];
  }
  return s;
}

AreaShape tri3(const Vec2& xi) {
  AreaShape s;
  s.count = 3;
  s.n.head<3>() << 1 - xi.x() - xi.y(), xi.x(), xi.y();
  s.d.topRows<3>() << -1, -1, 1, 0, 0, 1;
  return s;
}

AreaShape tri6(const Vec2& xi) {
  AreaShape s;
  s.count = 6;
  const std::array<double, 3> l{1 - xi.x() - xi.y(), xi.x(), xi.y()};
  const std::array<Vec2, 3> g{Vec2(-1, -1), Vec2(1, 0), Vec2(0, 1)};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t m = (k + 1) % 3;
    const auto corner = static_cast<Eigen::Index>(k), middle = static_cast<Eigen::Index>(k + 3);
    s.n[corner] = l[k] * (2 * l[k] - 1);
    s.d.row(corner) = (4 * l[k] - 1) * g[k].transpose();
    s.n[middle] = 4 * l[k] * l[m];
    s.d.row(middle) = 4 * (l[k] * g[m] + l[m] * g[k]).transpose();
  }
  return s;
}

}  // namespace

AreaShape area_shape(CellType type, const Vec2& xi) {
  switch (type) {
    case CellType::tri3:
      return tri3(xi);
    case CellType::tri6:
      return tri6(xi);
    case CellType::quad4:
      return quad4(xi);
    case CellType::quad8:
      return quad8(xi);
    case CellType::quad9:
      return quad9(xi);
    default:
      return {};
  }
}

Vec2 area_node(CellType type, int node) {
  if (type == CellType::tri3 || type == CellType::tri6) {
    constexpr std::array<std::array<double, 2>, 6> places{
        {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}}};
    const auto& p = places[static_cast<std::size_t>(node)];
    return {p[0], p[1]};
  }
  const auto& p = quad_places[static_cast<std::size_t>(node)];
  return {static_cast<double>(p[0]), static_cast<double>(p[1])};
}

}  // namespace osculate::cell
