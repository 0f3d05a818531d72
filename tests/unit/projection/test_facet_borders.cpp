// Newton's iteration on facets, folded facets, and the borders between neighbours.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "osculate/geometry/surface_frame.hpp"
#include "osculate/projection/point_to_facet.hpp"
#include "osculate/projection/surface_distance.hpp"
#include "sample_surfaces.hpp"

namespace osculate::projection {
namespace {

using cell::CellType;
using testing::bent_facet_nodes;

constexpr std::array<CellType, 5> types{CellType::tri3, CellType::tri6, CellType::quad4,
                                        CellType::quad8, CellType::quad9};

DistanceJet2 distance_at(const geometry::LagrangeSurface& s, const Vec2& xi, const Vec3& p) {
  const geometry::SurfaceJet j = s.jet(xi);
  return distance_jet2<3>(p - j.r, j.r1, j.r2);
}

TEST(SurfaceDistance, SlopeAndBendAreDerivativesByOrder) {  // [eq:KSVD:15] [eq:KSVD:16]
  const Vec3 p(0.4, -0.3, 0.9);
  for (const CellType type : types) {
    const auto s = geometry::lagrange_surface(type, bent_facet_nodes(type, 0.4));
    const Vec2 xi(0.21, 0.34);
    const DistanceJet2 d = distance_at(s, xi, p);
    const auto half = [&](const Vec2& x) {
      return Vec3(0.5 * distance_at(s, x, p).squared_distance, 0, 0);
    };
    const auto slope = [&](const Vec2& x) {
      const Vec2 v = distance_at(s, x, p).slope;
      return Vec3(v.x(), v.y(), 0);
    };
    for (Eigen::Index i = 0; i < 2; ++i) {
      EXPECT_TRUE(testing::is_derivative(half, Vec3(d.slope[i], 0, 0), xi, i));
      EXPECT_TRUE(testing::is_derivative(slope, Vec3(d.bend(0, i), d.bend(1, i), 0), xi, i));
    }
  }
}

TEST(SurfaceDistance, BendAtTheFootPointIsMetricLessGapTimesCurvature) {
  for (const CellType type : types) {
    const auto s = geometry::lagrange_surface(type, bent_facet_nodes(type, 0.3));
    const Vec2 xi(0.21, 0.34);
    const geometry::SurfaceFrame f = geometry::surface_frame(s.jet(xi));
    const double gap = -0.2;
    const DistanceJet2 d = distance_at(s, xi, s.jet(xi).r + gap * f.normal);
    EXPECT_LT((d.bend - (f.a - gap * f.h)).norm(), 1e-15 * (1 + f.a.norm()));
    EXPECT_LT(d.slope.norm(), 1e-15);
  }
}

TEST(SurfaceDistance, NewtonsStepConvergesQuadratically) {  // [eq:KSVD:14]
  for (const CellType type : {CellType::tri6, CellType::quad4, CellType::quad8, CellType::quad9}) {
    const auto s = geometry::lagrange_surface(type, bent_facet_nodes(type, 0.4));
    const Vec2 foot(0.21, 0.34);
    const Vec3 p = s.jet(foot).r + 0.3 * geometry::surface_frame(s.jet(foot)).normal;
    // error after one step, for a start half as far away: a quarter
    const auto after = [&](double away) {
      const Vec2 xi = foot + away * Vec2(0.6, -0.8);
      return (xi + descent(distance_at(s, xi, p)) - foot).norm();
    };
    EXPECT_NEAR(std::log2(after(2e-3) / after(1e-3)), 2.0, 0.05) << cell::info(type).name;
  }
  // on a plane facet one step is enough from anywhere
  const auto plane =
      geometry::lagrange_surface(CellType::tri3, bent_facet_nodes(CellType::tri3, 0));
  const Vec3 p = plane.jet({0.2, 0.3}).r + Vec3(0, 0, 0.7);
  const Vec2 xi(5, -3);
  EXPECT_LT((xi + descent(distance_at(plane, xi, p)) - Vec2(0.2, 0.3)).norm(), 1e-14);
}

TEST(PointToFacet, NothingNearerOnWarpedFacetsOfAnyNodes) {
  // nodes moved at random: saddles, folds, edges bent in space
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> u(-1, 1);
  constexpr int steps = 80;
  for (const CellType type : types)
    for (int sample = 0; sample < 60; ++sample) {
      std::vector<Vec3> nodes;
      const double size = cell::is_triangle(type) ? 0.15 : 0.3;
      for (int k = 0; k < cell::info(type).nodes; ++k) {
        const Vec2 a = cell::area_node(type, k);
        nodes.emplace_back(a.x() + 0.5 * size * u(generator), a.y() + 0.5 * size * u(generator),
                           size * u(generator));
      }
      const auto s = geometry::lagrange_surface(type, nodes);
      const Vec3 p = s.jet({0.3, 0.3}).r + Vec3(u(generator), u(generator), u(generator));
      const FacetFoot foot = closest_point(type, nodes, p);
      ASSERT_TRUE(foot.converged);
      double sampled = std::numeric_limits<double>::infinity();
      for (int i = 0; i <= steps; ++i)
        for (int j = 0; j <= steps; ++j) {
          Vec2 t(static_cast<double>(i) / steps, static_cast<double>(j) / steps);
          const Vec2 xi = cell::is_triangle(type) ? Vec2(t.x(), t.y() * (1 - t.x()))
                                                  : Vec2(2 * t - Vec2::Ones());
          sampled = std::min(sampled, (p - s.jet(xi).r).norm());
        }
      EXPECT_LE(std::sqrt(foot.squared_distance), sampled + 1e-12) << cell::info(type).name;
      if (foot.feature != Feature::face) continue;
      const DistanceJet2 d = distance_at(s, foot.xi, p);
      EXPECT_LT(d.slope.norm(), 1e-13);
      EXPECT_GT(d.bend.determinant(), 0.0);
    }
}

TEST(PointToFacet, NeighboursAgreeAboutTheEdgeBetweenThem) {
  // two curved quads that share the edge of nodes 1, 2 (first) and 3, 0 (second)
  const std::vector<Vec3> left{Vec3(-1, -1, 0.1), Vec3(0.1, -1, 0.3), Vec3(-0.1, 1, 0.2),
                               Vec3(-1, 1, 0)};
  const std::vector<Vec3> right{left[1], Vec3(1, -1.1, 0.1), Vec3(1.1, 1, 0.2), left[2]};
  const auto a = geometry::lagrange_surface(CellType::quad4, left);
  const auto b = geometry::lagrange_surface(CellType::quad4, right);
  for (const double t : {-0.9, -0.2, 0.5}) {
    // the normals of both along the edge: a wedge of points projects onto the edge itself
    const Vec3 na = geometry::surface_frame(a.jet({1, t})).normal;
    const Vec3 nb = geometry::surface_frame(b.jet({-1, t})).normal;
    const Vec3 on_edge = a.jet({1, t}).r;
    EXPECT_LT((on_edge - b.jet({-1, t}).r).norm(), 1e-15);
    const Vec3 p = on_edge + 0.2 * (na + nb).normalized();
    const FacetFoot fa = closest_point(CellType::quad4, left, p);
    const FacetFoot fb = closest_point(CellType::quad4, right, p);
    const double cross = na.cross(nb).dot(left[2] - left[1]);  // > 0: a ridge seen from above
    const Feature expected = cross > 0 ? Feature::edge : Feature::face;
    EXPECT_EQ(fa.feature, expected) << t;
    EXPECT_EQ(fb.feature, expected) << t;
    if (expected == Feature::face) continue;
    EXPECT_EQ(fa.local, 1);
    EXPECT_EQ(fb.local, 3);
    EXPECT_NEAR(fa.squared_distance, fb.squared_distance, 1e-16);
    EXPECT_NEAR(fa.xi.y(), fb.xi.y(), 1e-14);
  }
}

TEST(PointToFacet, ABorderWithinTheToleranceLetsGoOnBothSides) {
  const std::vector<Vec3> left{Vec3(-1, 0, 0), Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(-1, 1, 0)};
  const std::vector<Vec3> right{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)};
  constexpr double tolerance = 1e-8;  // of the parameter range
  for (const double x : {-3e-9, -1e-12, 0.0, 1e-12, 3e-9}) {
    const Vec3 p(x, 0.4, 0.1);
    for (const std::vector<Vec3>& nodes : {left, right}) {
      FacetFoot foot = closest_point(CellType::quad4, nodes, p);
      if (foot.feature != Feature::face) {
        EXPECT_TRUE(release(CellType::quad4, nodes, p, tolerance, foot)) << x;
      }
      EXPECT_EQ(foot.feature, Feature::face);
      EXPECT_NEAR(std::sqrt(foot.squared_distance), 0.1, 1e-16);
    }
  }
  FacetFoot foot = closest_point(CellType::quad4, left, Vec3(3e-8, 0.4, 0.1));
  EXPECT_FALSE(release(CellType::quad4, left, Vec3(3e-8, 0.4, 0.1), tolerance, foot));
  EXPECT_EQ(foot.feature, Feature::edge);
}

TEST(PointToFacet, ReleaseFindsTheFootOnTheContinuedSurface) {
  for (const CellType type : types) {
    const auto s = geometry::lagrange_surface(type, bent_facet_nodes(type, 0.15));
    const Vec2 beyond = cell::is_triangle(type) ? Vec2(0.4, -0.02) : Vec2(0.4, -1.04);
    for (const double height : {-0.1, 0.0, 0.1}) {
      const Vec3 p = s.jet(beyond).r + height * geometry::surface_frame(s.jet(beyond)).normal;
      FacetFoot foot = closest_point(type, s.used(), p);
      ASSERT_EQ(foot.feature, Feature::edge) << cell::info(type).name;
      EXPECT_EQ(foot.local, 0);
      ASSERT_TRUE(release(type, s.used(), p, 0.021, foot)) << cell::info(type).name;
      EXPECT_LT((foot.xi - beyond).norm(), 1e-12);
      EXPECT_NEAR(foot.squared_distance, height * height, 1e-14);
    }
  }
}

TEST(PointToFacet, AtTheCentreOfASphericalFacetAnyPointDoes) {
  // nodes of a quad9 on a unit sphere: from the centre all of the facet is about equally far
  std::vector<Vec3> nodes;
  for (int k = 0; k < 9; ++k) {
    const Vec2 a = 0.5 * cell::area_node(CellType::quad9, k);
    nodes.push_back(Vec3(a.x(), a.y(), 1).normalized());
  }
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(0, 0, 1e-12), Vec3(1e-9, 0, 0), Vec3(0, 0, -1)}) {
    const FacetFoot foot = closest_point(CellType::quad9, nodes, p);
    EXPECT_TRUE(foot.converged);
    EXPECT_TRUE(foot.xi.allFinite());
    EXPECT_LT((foot.xi.cwiseAbs().maxCoeff()), 1 + 1e-15);
    EXPECT_LT(std::sqrt(foot.squared_distance), 1 + p.norm() + 1e-12);
  }
}

}  // namespace
}  // namespace osculate::projection
