// Closest point of one facet against brute force, and its borders.
#include "osculate/projection/point_to_facet.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "effort.hpp"
#include "osculate/cell/shape.hpp"
#include "osculate/projection/inside_facet.hpp"

namespace osculate::projection {
namespace {

using cell::CellType;

constexpr std::array<CellType, 5> types{CellType::tri3, CellType::tri6, CellType::quad4,
                                        CellType::quad8, CellType::quad9};

/// A bent and warped facet of about unit size.
std::vector<Vec3> nodes_of(CellType type, double bend) {
  std::vector<Vec3> nodes;
  for (int k = 0; k < cell::info(type).nodes; ++k) {
    const Vec2 p = cell::area_node(type, k);
    nodes.emplace_back(1.2 * p.x() + 0.1 * p.y(), 0.9 * p.y(),
                       bend * (p.x() * p.x() - 0.6 * p.y() * p.y() + 0.8 * p.x() * p.y()));
  }
  return nodes;
}

Vec3 at(CellType type, const std::vector<Vec3>& nodes, const Vec2& xi) {
  const cell::FacetShape s = cell::facet_shape(type, xi);
  Vec3 r = Vec3::Zero();
  for (std::size_t k = 0; k < nodes.size(); ++k) r += s.n[0][k] * nodes[k];
  return r;
}

double brute_force(CellType type, const std::vector<Vec3>& nodes, const Vec3& p) {
  constexpr int steps = 120;
  double best = 1e30;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= steps; ++j) {
      Vec2 xi(static_cast<double>(i) / steps, static_cast<double>(j) / steps);
      if (cell::is_triangle(type))
        xi.y() *= 1 - xi.x();
      else
        xi = 2 * xi - Vec2::Ones();
      best = std::min(best, (p - at(type, nodes, xi)).norm());
    }
  return best;
}

// [eq:KSVD:15] [eq:KSVD:16]
TEST(PointToFacet, IsNeverFartherThanAnySample) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> u(-2, 2);
  for (const CellType type : types)
    for (const double bend : {0.0, 0.3}) {
      const std::vector<Vec3> nodes = nodes_of(type, bend);
      for (int i = 0; i < (testing::sanitized ? 20 : 150); ++i) {
        const Vec3 p(u(generator), u(generator), u(generator));
        const FacetFoot foot = closest_point(type, nodes, p);
        ASSERT_TRUE(foot.converged);
        const double distance = std::sqrt(foot.squared_distance);
        EXPECT_NEAR((p - at(type, nodes, foot.xi)).norm(), distance, 1e-12);
        const double sampled = brute_force(type, nodes, p);
        EXPECT_LE(distance, sampled + 1e-12) << cell::info(type).name;
        EXPECT_GE(distance, sampled - 2e-2) << cell::info(type).name;  // the grid is 0.02 wide
      }
    }
}

/// The distance is flat at its minimum and cannot tell the last half of the digits; the foot has
/// them all the same, or the forces of a contact point would be noise below 1e-9.
TEST(PointToFacet, TheFootIsExactToRounding) {
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> u(0.05, 0.95);
  for (const CellType type : types)
    for (const double height : {-0.1, -1e-3, -1e-5, 1e-4, 0.02})
      for (int i = 0; i < 200; ++i) {
        std::vector<Vec3> nodes = nodes_of(type, 0.2);
        for (Vec3& x : nodes) x += Vec3(3, -5, 4);
        Vec2 xi(u(generator), u(generator));
        xi = cell::is_triangle(type) ? Vec2(xi.x(), (1 - xi.x()) * xi.y())
                                     : Vec2(2 * xi - Vec2::Ones());
        const cell::FacetShape s = cell::facet_shape(type, xi);
        Vec3 a = Vec3::Zero(), b = Vec3::Zero();
        for (std::size_t k = 0; k < nodes.size(); ++k) {
          a += s.n[1][k] * nodes[k];
          b += s.n[2][k] * nodes[k];
        }
        const Vec3 p = at(type, nodes, xi) + height * a.cross(b).normalized();
        const FacetFoot foot = closest_point(type, nodes, p);
        ASSERT_EQ(foot.feature, Feature::face);
        EXPECT_LT((foot.xi - xi).norm(), 3e-14) << cell::info(type).name << " " << height;
      }
}

TEST(PointToFacet, PointsOnNormalsComeBack) {
  for (const CellType type : types)
    for (const double height : {-0.3, -1e-3, 0.0, 0.2}) {
      const std::vector<Vec3> nodes = nodes_of(type, 0.1);
      const Vec2 xi = cell::is_triangle(type) ? Vec2(0.3, 0.45) : Vec2(0.4, -0.7);
      const cell::FacetShape s = cell::facet_shape(type, xi);
      Vec3 a = Vec3::Zero(), b = Vec3::Zero();
      for (std::size_t k = 0; k < nodes.size(); ++k)
        a += s.n[1][k] * nodes[k], b += s.n[2][k] * nodes[k];
      const Vec3 p = at(type, nodes, xi) + height * a.cross(b).normalized();
      const FacetFoot foot = closest_point(type, nodes, p);
      EXPECT_EQ(foot.feature, Feature::face);
      EXPECT_LT((foot.xi - xi).norm(), 1e-12) << cell::info(type).name << " " << height;
    }
}

TEST(PointToFacet, NamesEdgesAndCorners) {
  const std::vector<Vec3> nodes = nodes_of(CellType::quad4, 0.0);
  const FacetFoot edge = closest_point(CellType::quad4, nodes, Vec3(1.7, 0.1, 0.2));
  EXPECT_EQ(edge.feature, Feature::edge);
  EXPECT_EQ(edge.local, 1);
  const FacetFoot corner = closest_point(CellType::quad4, nodes, Vec3(-3, -3, 0.2));
  EXPECT_EQ(corner.feature, Feature::corner);
  EXPECT_EQ(corner.local, 0);
}

TEST(PointToFacet, IsReleasedALittleBeyondABorder) {
  const std::vector<Vec3> nodes = nodes_of(CellType::quad4, 0.0);
  const Vec3 p = at(CellType::quad4, nodes, {1.04, 0.3}) + Vec3(0, 0, 0.1);
  FacetFoot foot = closest_point(CellType::quad4, nodes, p);
  ASSERT_EQ(foot.feature, Feature::edge);
  FacetFoot kept = foot;
  EXPECT_FALSE(release(CellType::quad4, nodes, p, 0.01, kept));
  EXPECT_EQ(kept.feature, Feature::edge);
  EXPECT_TRUE(release(CellType::quad4, nodes, p, 0.05, foot));
  EXPECT_EQ(foot.feature, Feature::face);
  EXPECT_LT((foot.xi - Vec2(1.04, 0.3)).norm(), 1e-13);
}

/// Corners and middles of edges that are not where they would be in a regular mesh.
std::vector<Vec3> distorted(CellType type, double by, std::mt19937& generator) {
  std::uniform_real_distribution<double> u(-by, by);
  std::vector<Vec3> nodes = nodes_of(type, 0.2);
  for (Vec3& x : nodes) x += Vec3(u(generator), u(generator), u(generator));
  return nodes;
}

/// Where the distance falls from an edge inwards, the foot is not on the edge: points that press
/// obliquely on a warped facet, at 0.9 of its range and beyond, were placed on its border.
TEST(PointToFacet, NoWayInwardsFromAnEdgeIsDownhill) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> u(-1.6, 1.6);
  for (const CellType type : types) {
    int edges = 0;
    for (int f = 0; f < (testing::sanitized ? 10 : 100); ++f) {
      const std::vector<Vec3> nodes = distorted(type, 0.3, generator);
      const Vec2 middle = middle_of_cell(type);
      for (int i = 0; i < 200; ++i) {
        const Vec3 p(u(generator), u(generator), i % 2 == 0 ? 0.5 * u(generator) : 0.1);
        const FacetFoot foot = closest_point(type, nodes, p);
        if (foot.feature != Feature::edge) continue;
        ++edges;
        const cell::FacetShape s = cell::facet_shape(type, foot.xi, 1);
        Vec3 r = Vec3::Zero(), inwards = Vec3::Zero();
        for (std::size_t k = 0; k < nodes.size(); ++k) {
          r += s.n[0][k] * nodes[k];
          const Vec2 to = middle - foot.xi;
          inwards += (to[0] * s.n[1][k] + to[1] * s.n[2][k]) * nodes[k];
        }
        EXPECT_LT((p - r).dot(inwards), 1e-11) << cell::info(type).name;
      }
    }
    EXPECT_GT(edges, testing::sanitized ? 100 : 1000);
  }
}

/// Distorted facets ten times as long as they are wide.
TEST(PointToFacet, LongFacetsOfFourCornersHaveNoNearerSample) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> u(-1.6, 1.6);
  for (int f = 0; f < 60; ++f) {
    std::vector<Vec3> nodes = distorted(CellType::quad4, 0.3, generator);
    for (Vec3& x : nodes) x = {x.x(), 0.1 * x.y(), 0.1 * x.z()};
    for (int i = 0; i < 20; ++i) {
      const Vec3 p(u(generator), 0.1 * u(generator), 0.1 * u(generator));
      const FacetFoot foot = closest_point(CellType::quad4, nodes, p);
      EXPECT_LE(std::sqrt(foot.squared_distance), brute_force(CellType::quad4, nodes, p) + 1e-12);
    }
  }
}

/// A bent edge may have two nearest places, of which the farther one has the nearer sample.
TEST(PointToFacet, BentEdgesAreSearchedFromAllSides) {
  const std::vector<Vec3> nodes{
      {-0.26489271838388734, -0.0046006556472643163, 0.0055561889747214399},
      {1.0070965153776532, 0.00105143597184028, 0.29943857551049852},
      {-0.13587253605212343, 0.015763767176836103, -0.0076633426220941896},
      {0.49598979625952244, 0.010055752214409601, 0.16151977611957202},
      {0.69068123857872987, 0.0030464193359531419, 0.16152185000748837},
      {0.18685553602644067, 0.012655519754258755, 0.0058271106498217979}};
  const Vec3 p(-0.20191477663661228, 0.028003627809725297, 0.00086895902629393425);
  const double edge =
      std::sqrt(closest_point_on_edge(CellType::tri6, nodes, 2, p).squared_distance);
  EXPECT_NEAR(edge, 0.031177, 1e-6);
  EXPECT_LE(std::sqrt(closest_point(CellType::tri6, nodes, p).squared_distance), edge);
}

TEST(PointToFacet, CentreOfCurvatureAndFarPointsStayFinite) {
  for (const CellType type : types) {
    const std::vector<Vec3> nodes = nodes_of(type, 0.5);
    for (const Vec3& p : {Vec3(0, 0, 1.44), Vec3(1e8, -1e8, 1e8), nodes[0]}) {
      const FacetFoot foot = closest_point(type, nodes, p);
      EXPECT_TRUE(foot.converged);
      EXPECT_TRUE(foot.xi.allFinite());
      EXPECT_TRUE(std::isfinite(foot.squared_distance));
    }
  }
}

}  // namespace
}  // namespace osculate::projection
