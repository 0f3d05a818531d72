// What holds for every point of a facet: its hull, and how near it can be.
#include "osculate/projection/facet_hull.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "osculate/cell/shape.hpp"

namespace osculate::projection {
namespace {

using cell::CellType;

constexpr std::array<CellType, 3> types{CellType::tri6, CellType::quad8, CellType::quad9};

/// About the unit facet, every node moved by up to `noise`.
std::vector<Vec3> facet(CellType type, double noise, std::mt19937& generator) {
  std::uniform_real_distribution<double> u(-noise, noise);
  std::vector<Vec3> nodes;
  for (int k = 0; k < cell::info(type).nodes; ++k) {
    const Vec2 p = cell::area_node(type, k);
    nodes.emplace_back(p.x() + u(generator), p.y() + u(generator), u(generator));
  }
  return nodes;
}

Vec2 cell_point(CellType type, double s, double t) {
  return cell::is_triangle(type) ? Vec2(s, t * (1 - s)) : Vec2(2 * s - 1, 2 * t - 1);
}

Vec3 at(CellType type, const std::vector<Vec3>& nodes, const Vec2& xi) {
  const cell::FacetShape s = cell::facet_shape(type, xi);
  Vec3 r = Vec3::Zero();
  for (std::size_t k = 0; k < nodes.size(); ++k) r += s.n[0][k] * nodes[k];
  return r;
}

/// Bernstein functions of a triangle (node order of tri6) or of a square (of quad9).
std::array<double, 9> bernstein(CellType type, const Vec2& xi) {
  if (cell::is_triangle(type)) {
    const double b = xi.x(), c = xi.y(), a = 1 - b - c;
    return {a * a, b * b, c * c, 2 * a * b, 2 * b * c, 2 * c * a};
  }
  const auto line = [](double t) {
    const double s = 0.5 * (1 + t);
    return std::array{(1 - s) * (1 - s), s * s, 2 * s * (1 - s)};  // ends, middle
  };
  const auto f = line(xi.x()), g = line(xi.y());
  return {f[0] * g[0], f[1] * g[0], f[1] * g[1], f[0] * g[1], f[2] * g[0],
          f[1] * g[2], f[2] * g[1], f[0] * g[2], f[2] * g[2]};
}

TEST(FacetHull, IsMadeOfTheControlPointsOfTheSameFacet) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> u(0, 1);
  for (const CellType type : types)
    for (int i = 0; i < 20; ++i) {
      const std::vector<Vec3> nodes = facet(type, 0.3, generator);
      std::array<Vec3, 9> points;
      const int count = control_points(type, nodes, points);
      EXPECT_EQ(count, type == CellType::tri6 ? 6 : 9);
      const Vec2 xi = cell_point(type, u(generator), u(generator));
      const std::array<double, 9> b = bernstein(type, xi);
      Vec3 r = Vec3::Zero();
      for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) r += b[k] * points[k];
      EXPECT_LT((r - at(type, nodes, xi)).norm(), 1e-14) << cell::info(type).name;
    }
}

TEST(FacetHull, NoPlaceIsNearerThanTheBound) {
  std::mt19937 generator(2);
  std::uniform_real_distribution<double> u(-2, 2);
  constexpr int steps = 40;
  for (const CellType type :
       {CellType::tri3, CellType::quad4, CellType::tri6, CellType::quad8, CellType::quad9})
    for (const double noise : {0.0, 0.05, 0.4})
      for (int i = 0; i < 60; ++i) {
        const std::vector<Vec3> nodes = facet(type, noise, generator);
        const Vec3 p(u(generator), u(generator), u(generator));
        double nearest = 1e30;
        for (int j = 0; j <= steps; ++j)
          for (int k = 0; k <= steps; ++k) {
            const Vec2 xi = cell_point(type, double(j) / steps, double(k) / steps);
            nearest = std::min(nearest, (p - at(type, nodes, xi)).norm());
          }
        const double bound = least_distance(type, nodes, p);
        EXPECT_LE(bound, nearest * (1 + 1e-14)) << cell::info(type).name << ' ' << noise;
        // A bound that is of use: within the spacing of the samples where the facet is flat.
        if (noise > 0) continue;
        EXPECT_GT(bound, nearest - 2.0 / steps) << cell::info(type).name;
      }
}

// The bound is reached: the centre of a tri6 whose edges all bulge by h is 4/3 h above its corners.
TEST(FacetHull, TheBoundOfATriangleIsSharp) {
  std::mt19937 generator(3);
  std::vector<Vec3> nodes = facet(CellType::tri6, 0.0, generator);
  for (std::size_t k = 3; k < 6; ++k) nodes[k].z() = 0.1;
  const Vec3 above = at(CellType::tri6, nodes, Vec2(1.0 / 3, 1.0 / 3)) + Vec3(0, 0, 1);
  EXPECT_NEAR(least_distance(CellType::tri6, nodes, above), 1.0, 1e-14);
}

}  // namespace
}  // namespace osculate::projection
