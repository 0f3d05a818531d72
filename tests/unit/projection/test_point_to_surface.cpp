// Closest points of every surface of the catalogue.
#include "osculate/projection/point_to_surface.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "osculate/geometry/surface_frame.hpp"
#include "sample_surfaces.hpp"

namespace osculate::projection {
namespace {

using geometry::Cone;
using geometry::Cylinder;
using geometry::Plane;
using geometry::Sphere;
using geometry::Surface;
using geometry::SurfaceFrame;
using geometry::Torus;
using testing::at_surface_places;
using testing::sample_surfaces;

Vec3 at(const Surface& s, const Vec2& xi) { return geometry::jet(s, xi).r; }

TEST(PointToSurface, PointsOnNormalsComeBack) {
  at_surface_places([](const Surface& s, const Vec2& xi) {
    const geometry::SurfaceJet j = geometry::jet(s, xi);
    const SurfaceFrame f = geometry::surface_frame(j);
    for (const double height : {-0.05, -1e-6, 0.0, 1e-3, 0.05}) {
      const Vec3 p = j.r + height * f.normal;
      const SurfaceFoot foot = closest_point(s, p);
      ASSERT_TRUE(foot.converged);
      EXPECT_FALSE(foot.at_border);
      EXPECT_LT((at(s, foot.xi) - j.r).norm(), 1e-12) << height;
      EXPECT_NEAR(std::sqrt(foot.squared_distance), std::abs(height), 1e-12);
      // the coordinates too, but for the sphere with its two charts
      if (!std::holds_alternative<Sphere>(s)) {
        EXPECT_LT((foot.xi - xi).norm(), 1e-11) << height;
      }
    }
  });
}

TEST(PointToSurface, FootPointsAreOrthogonalOrOnABorder) {
  int kinks = 0;
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> u(-3, 5);
  for (const testing::NamedSurface& sample : sample_surfaces()) {
    SCOPED_TRACE(sample.name);
    for (int i = 0; i < 200; ++i) {
      const Vec3 p(u(generator), u(generator), u(generator));
      const SurfaceFoot foot = closest_point(sample.surface, p);
      ASSERT_TRUE(foot.converged);
      const geometry::SurfaceJet j = geometry::jet(sample.surface, foot.xi);
      const Vec3 gap = p - j.r;
      EXPECT_NEAR(gap.squaredNorm(), foot.squared_distance, 1e-12);
      if (foot.at_kink) {
        EXPECT_EQ(sample.name, "hills 1 2");  // straight pieces along xi1
        ++kinks;
      }
      if (foot.at_border || foot.at_kink) continue;
      for (const Vec3& tangent : j.r1)
        EXPECT_NEAR(gap.dot(tangent) / (tangent.norm() * gap.norm()), 0.0, 1e-8);
    }
  }
  EXPECT_GT(kinks, 0);
}

TEST(PointToSurface, NoSampleIsNearer) {
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> u(-2, 5);
  for (const testing::NamedSurface& sample : sample_surfaces()) {
    SCOPED_TRACE(sample.name);
    const std::array<Vec2, 2> range = testing::finite_range(sample.surface);
    const bool triangle = sample.name == "tri3" || sample.name == "tri6";
    constexpr int steps = 60;
    std::vector<Vec3> grid;
    for (int i = 0; i <= steps; ++i)
      for (int j = 0; j <= steps; ++j) {
        Vec2 t(static_cast<double>(i) / steps, static_cast<double>(j) / steps);
        if (triangle) t.y() *= 1 - t.x();
        grid.push_back(at(sample.surface, range[0] + t.cwiseProduct(range[1] - range[0])));
      }
    for (int i = 0; i < 60; ++i) {
      const Vec3 p(u(generator), u(generator), u(generator));
      const SurfaceFoot foot = closest_point(sample.surface, p);
      double sampled = std::numeric_limits<double>::infinity();
      for (const Vec3& r : grid) sampled = std::min(sampled, (p - r).norm());
      EXPECT_LE(std::sqrt(foot.squared_distance), sampled + 1e-12) << p.transpose();
    }
  }
}

TEST(PointToSurface, AnalyticDistancesAreExact) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> u(-3, 3);
  const Vec3 c(0.4, -0.7, 0.2), axis(1, -2, 0.5), e = axis.normalized();
  for (int i = 0; i < 200; ++i) {
    const Vec3 p(u(generator), u(generator), u(generator)), arm = p - c;
    const double height = e.dot(arm), radius = (arm - height * e).norm();
    const auto distance = [&](const Surface& s) {
      return std::sqrt(closest_point(s, p).squared_distance);
    };
    for (const bool inside : {false, true}) {
      EXPECT_NEAR(distance(Sphere{c, 1.3, inside, axis}), std::abs(arm.norm() - 1.3), 1e-14);
      const Cylinder pipe{.point = c, .axis = axis, .radius = 0.8, .inside = inside};
      EXPECT_NEAR(distance(pipe), std::abs(radius - 0.8), 1e-14);
      EXPECT_NEAR(distance(Torus{c, axis, 2.0, 0.7, inside}),
                  std::abs(std::hypot(radius - 2, height) - 0.7), 1e-14);
    }
    EXPECT_NEAR(distance(Plane{c, axis}), std::abs(height), 1e-14);
  }
}

TEST(PointToSurface, SpheresHaveNoSeam) {
  // round the sphere through both charts, and over both middles: the foot moves evenly
  for (const bool inside : {false, true}) {
    const Sphere sphere{Vec3(0, 0, 0), 2, inside, Vec3(0, 0, 1)};
    for (int i = 0; i < 400; ++i) {
      const double a = i * 2 * std::numbers::pi / 400;
      const Vec3 ray(std::sin(a) * 0.6, std::sin(a) * 0.8, std::cos(a));
      const SurfaceFoot foot = closest_point(sphere, 1.7 * ray);
      EXPECT_LT((at(sphere, foot.xi) - 2 * ray).norm(), 2e-15);
      EXPECT_TRUE((foot.xi.array() >= sphere.lo().array()).all());
      EXPECT_TRUE((foot.xi.array() <= sphere.hi().array()).all());
      EXPECT_LT(
          (geometry::surface_frame(sphere.jet(foot.xi)).normal - (inside ? -1 : 1) * ray).norm(),
          1e-15);
    }
  }
}

TEST(PointToSurface, BordersAreReported) {
  const Cylinder pipe{.point = Vec3(0, 0, 1), .axis = Vec3(0, 0, 3), .radius = 1, .length = 2};
  EXPECT_FALSE(closest_point(pipe, Vec3(2, 0, 1.0)).at_border);  // on the rim, orthogonal
  EXPECT_FALSE(closest_point(pipe, Vec3(2, 0, 3 + 1e-9)).at_border);
  EXPECT_TRUE(closest_point(pipe, Vec3(2, 0, 3.1)).at_border);
  EXPECT_TRUE(closest_point(pipe, Vec3(2, 0, 0.9)).at_border);
  EXPECT_NEAR(closest_point(pipe, Vec3(2, 0, 3.1)).squared_distance, 1.01, 1e-14);
  const Cone cone{.apex = Vec3(0, 0, 0), .axis = Vec3(0, 0, 1), .half_angle = 0.5};
  EXPECT_TRUE(closest_point(cone, Vec3(0.1, 0, -1)).at_border);
  EXPECT_NEAR(closest_point(cone, Vec3(0.1, 0, -1)).squared_distance, 1.01, 1e-14);
  EXPECT_FALSE(closest_point(cone, Vec3(0.1, 0, 1)).at_border);
  const Surface facet = geometry::lagrange_surface(
      cell::CellType::quad4,
      std::array<Vec3, 4>{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)});
  EXPECT_FALSE(closest_point(facet, Vec3(1 + 1e-9, 0.5, 1)).at_border);
  EXPECT_TRUE(closest_point(facet, Vec3(1.001, 0.5, 1)).at_border);
}

TEST(PointToSurface, PatchesHaveBordersButNoSeam) {
  const geometry::NurbsPatch pipe = testing::nurbs_cylinder(1.5, 2);
  for (const double offset : {-1e-3, -1e-12, 0.0, 1e-12, 1e-3}) {
    const SurfaceFoot foot = closest_point(pipe, Vec3(2, offset, 1));
    EXPECT_FALSE(foot.at_border) << offset;
    EXPECT_NEAR(std::sqrt(foot.squared_distance), std::hypot(2, offset) - 1.5, 1e-15);
  }
  EXPECT_FALSE(closest_point(pipe, Vec3(2, 0.3, 2)).at_border);
  EXPECT_FALSE(closest_point(pipe, Vec3(2, 0.3, 2 + 1e-9)).at_border);
  EXPECT_TRUE(closest_point(pipe, Vec3(2, 0.3, 2.001)).at_border);
  EXPECT_TRUE(closest_point(pipe, Vec3(2, 0.3, -0.001)).at_border);
}

TEST(PointToSurface, TheSeamOfASquareTubeIsAKinkLikeItsOtherEdges) {
  const std::array<std::array<double, 2>, 5> ring{{{1, 1}, {-1, 1}, {-1, -1}, {1, -1}, {1, 1}}};
  geometry::NurbsPatch tube{.degree = {1, 1},
                            .knots = {{{0, 0, 1, 2, 3, 4, 4}, {0, 0, 1, 1}}},
                            .count = {5, 2},
                            .control = {},
                            .weights = std::vector<double>(10, 1.0)};
  for (const auto& corner : ring)
    for (const double z : {0.0, 2.0}) tube.control.emplace_back(corner[0], corner[1], z);
  ASSERT_EQ(geometry::validate(tube), "");
  EXPECT_EQ(tube.closed(), (geometry::ClosedFlags{true, false}));
  for (const auto& corner : ring) {
    const SurfaceFoot foot = closest_point(tube, Vec3(1.3 * corner[0], 1.2 * corner[1], 0.7));
    EXPECT_TRUE(foot.at_kink);
    EXPECT_FALSE(foot.at_border);
    EXPECT_NEAR(foot.squared_distance, 0.13, 1e-15);
    EXPECT_NEAR(foot.xi.y(), 0.35, 1e-15);
  }
  const SurfaceFoot side = closest_point(tube, Vec3(0.2, 1.5, 0.7));
  EXPECT_FALSE(side.at_kink || side.at_border);
  tube.control.back().x() = tube.control[8].x() = 0.9;  // the tube does not close any more
  const SurfaceFoot open = closest_point(tube, Vec3(1.3, 1.2, 0.7));
  EXPECT_TRUE(open.at_border);
  EXPECT_FALSE(open.at_kink);
}

TEST(PointToSurface, PatchAgreesWithTheCylinderItIs) {
  const geometry::NurbsPatch patch = testing::nurbs_cylinder(1.5, 2);
  const Cylinder cylinder{.radius = 1.5, .length = 2};
  std::mt19937 generator(2);
  std::uniform_real_distribution<double> u(-3, 3);
  for (int i = 0; i < 300; ++i) {
    const Vec3 p(u(generator), u(generator), u(generator));
    const SurfaceFoot a = closest_point(patch, p), b = closest_point(cylinder, p);
    EXPECT_NEAR(a.squared_distance, b.squared_distance, 1e-13);
    // Rounding of a point moves its foot R / rho times as far.
    const double spread = std::max(1.0, 1.5 / p.head<2>().norm());
    EXPECT_LT((patch.jet(a.xi).r - cylinder.jet(b.xi).r).norm(), 1e-13 * spread);
    EXPECT_EQ(a.at_border, b.at_border);
  }
}

TEST(PointToSurface, AxesCentresAndTheApexHaveTheirAnswer) {
  const Vec3 c(0.4, -0.7, 0.2), axis(1, -2, 0.5), e = axis.normalized();
  const auto foot_of = [&](const Surface& s, const Vec3& p) {
    const SurfaceFoot foot = closest_point(s, p);
    EXPECT_TRUE(foot.converged);
    EXPECT_NEAR((at(s, foot.xi) - p).squaredNorm(), foot.squared_distance, 1e-13);
    return foot;
  };
  for (const bool inside : {false, true}) {
    EXPECT_EQ(foot_of(Sphere{c, 1.3, inside, axis}, c).xi, Vec2(0, 0));
    const Cylinder pipe{.point = c, .axis = axis, .radius = 0.8, .inside = inside};
    EXPECT_NEAR(foot_of(pipe, c).squared_distance, 0.64, 1e-15);
    (void)foot_of(pipe, c + 2 * e);
    const Cone cone{.apex = c, .axis = axis, .half_angle = 0.6, .inside = inside};
    EXPECT_EQ(foot_of(cone, c).squared_distance, 0.0);
    EXPECT_NEAR(foot_of(cone, c + 2 * e).squared_distance, std::pow(2 * std::sin(0.6), 2), 1e-14);
    EXPECT_NEAR(foot_of(cone, c - 2 * e).squared_distance, 4, 1e-14);
    const Torus torus{c, axis, 2, 0.7, inside};
    EXPECT_NEAR(foot_of(torus, c).squared_distance, 1.69, 1e-14);
    const Vec3 middle = c + 2.0 / 2.7 * (torus.jet({0.3, 0}).r - c);
    EXPECT_NEAR(foot_of(torus, middle).squared_distance, 0.49, 1e-14);
  }
  // exactly on the axis
  const Cylinder upright{.radius = 0.8};
  EXPECT_EQ(foot_of(upright, Vec3(0, 0, 2)).xi, Vec2(0, 2));
  EXPECT_EQ(foot_of(Torus{}, Vec3(0, 0, 0)).xi, Vec2(0, std::numbers::pi));
  EXPECT_NEAR(foot_of(testing::nurbs_cylinder(1.5, 2), Vec3(0, 0, 1)).squared_distance, 2.25,
              1e-13);
}

TEST(PointToSurface, WhatIsNotFiniteStaysWithoutNaN) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  for (const testing::NamedSurface& sample : sample_surfaces()) {
    SCOPED_TRACE(sample.name);
    for (const Vec3& p : {Vec3(nan, 0, 0), Vec3(0, infinite, 0), Vec3(0, 0, -infinite)}) {
      const SurfaceFoot foot = closest_point(sample.surface, p);
      EXPECT_FALSE(foot.converged);
      EXPECT_TRUE(foot.xi.allFinite());
      EXPECT_EQ(foot.squared_distance, infinite);
    }
    for (const Vec3& p : {Vec3(1e9, -1e9, 1e9), Vec3(1e100, 0, 0), Vec3(1e200, 0, 1e200)}) {
      const SurfaceFoot foot = closest_point(sample.surface, p);
      EXPECT_TRUE(foot.xi.allFinite());
      EXPECT_FALSE(std::isnan(foot.squared_distance));
    }
  }
  EXPECT_FALSE(closest_point(Sphere{.radius = nan}, Vec3(1, 2, 3)).converged);
  EXPECT_FALSE(closest_point(Cylinder{.axis = Vec3(0, nan, 0)}, Vec3(1, 2, 3)).converged);
}

}  // namespace
}  // namespace osculate::projection
