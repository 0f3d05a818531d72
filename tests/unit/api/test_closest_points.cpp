// Closest points for another code: plain arrays in and out.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "osculate/api/closest_points.hpp"
#include "osculate/core/error.hpp"

namespace osculate::api {
namespace {

using projection::Feature;
using projection::Mode;
using projection::Status;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

/// Two squares and a triangle in the plane z = 0, normal up.
const std::vector<double> sheet_nodes{0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1,
                                      0, 1, 1, 0, 2, 1, 0, 3, 0, 0};
const std::vector<Index> sheet_quads{0, 1, 4, 3, 1, 2, 5, 4};
const std::vector<Index> sheet_triangles{2, 6, 5};

ClosestPoints3 sheet() {
  const std::vector<FacetList3> lists{{cell::CellType::quad4, sheet_quads},
                                      {cell::CellType::tri3, sheet_triangles}};
  return {lists, sheet_nodes};
}

TEST(ClosestPoints, FeaturesFacetsAndCoordinatesOfASheet) {
  const std::vector<double> points{0.5,  0.25, 2,     // above the first square
                                   2.25, 0.25, -1,    // below the triangle, facet 2
                                   0.5,  -1,   0.5,   // beyond an edge
                                   -1,   -1,   0.25,  // beyond a corner
                                   nan,  0,    0};
  const ClosestPointArrays<3> a = sheet().find(points);
  ASSERT_EQ(a.status.size(), 5U);
  EXPECT_EQ(a.feature[0], Feature::face);
  EXPECT_EQ(a.facet[0], 0);
  EXPECT_NEAR(a.xi[0], 0, 1e-12);
  EXPECT_NEAR(a.xi[1], -0.5, 1e-12);
  EXPECT_NEAR(a.distance[0], 2, 1e-12);
  EXPECT_EQ(a.facet[1], 2);
  EXPECT_NEAR(a.xi[2], 0.25, 1e-12);
  EXPECT_NEAR(a.distance[1], -1, 1e-12);
  EXPECT_EQ(a.feature[2], Feature::edge);
  EXPECT_NEAR(std::abs(a.distance[2]), std::hypot(1, 0.5), 1e-12);
  EXPECT_NEAR(a.point[6], 0.5, 1e-12);
  EXPECT_NEAR(a.point[7], 0, 1e-12);
  EXPECT_EQ(a.feature[3], Feature::corner);
  EXPECT_EQ(a.status[3], Status::projected);
  EXPECT_EQ(a.unique[3], 1);
  EXPECT_EQ(a.status[4], Status::invalid);
  EXPECT_EQ(a.facet[4], -1);
}

TEST(ClosestPoints, ACurveInThePlane) {
  const std::vector<double> nodes{2, 0, 0, 0, 1, 0};
  const std::vector<Index> line3{0, 1, 2};  // walked to -x: the body is above, the normal down
  const std::vector<FacetList> lists{{3, line3}};
  const ClosestPointArrays<2> a =
      ClosestPoints(lists, nodes).find(std::vector<double>{0.5, -1, 0.5, 0.25, 3, 0, 0, inf});
  EXPECT_NEAR(a.xi[0], 0.5, 1e-12);
  EXPECT_NEAR(a.distance[0], 1, 1e-12);
  EXPECT_NEAR(a.distance[1], -0.25, 1e-12);
  EXPECT_EQ(a.feature[1], Feature::face);
  EXPECT_EQ(a.feature[2], Feature::corner);
  EXPECT_EQ(a.status[3], Status::invalid);
}

TEST(ClosestPoints, AShape) {
  geometry::Sphere sphere;
  sphere.radius = 2;
  const ClosestPoints3 find{projection::Target<3>(geometry::Surface(sphere))};
  const ClosestPointArrays<3> a = find.find(std::vector<double>{0, 3, 4, 0, 0, 0});
  EXPECT_NEAR(a.distance[0], 3, 1e-12);
  EXPECT_NEAR(a.point[1], 1.2, 1e-12);
  EXPECT_NE(a.status[1], Status::projected);  // all points of the sphere are as near
  EXPECT_NEAR(a.distance[1], -2, 1e-12);
}

TEST(ClosestPoints, TheSameBitsForAnyNumberOfThreadsAndNearlyTheSameInFastMode) {
  std::vector<double> points;
  for (int i = 0; i < 3 * 2000; ++i) points.push_back(3 * std::sin(1.7 * i + 0.3 * i * i));
  const ClosestPoints3 find = sheet();
  const ClosestPointArrays<3> one = find.find(points);
  const ClosestPointArrays<3> three = find.find(points, {Mode::certified, 3});
  const ClosestPointArrays<3> fast = find.find(points, {Mode::fast, 2});
  for (std::size_t i = 0; i < one.status.size(); ++i) {
    ASSERT_EQ(one.facet[i], three.facet[i]);
    ASSERT_EQ(one.distance[i], three.distance[i]);
    ASSERT_EQ(one.xi[2 * i], three.xi[2 * i]);
    ASSERT_EQ(one.margin[i], three.margin[i]);
    ASSERT_NEAR(std::abs(one.distance[i]), std::abs(fast.distance[i]), 1e-12);
    ASSERT_TRUE(std::isnan(fast.margin[i]));
  }
}

template <class F>
std::string refusal(const F& f) {
  try {
    f();
  } catch (const core::InputError& error) {
    return error.what();
  }
  return {};
}

TEST(ClosestPoints, InputThatCannotBeUsed) {
  const std::vector<double> nodes{0, 0, 1, 0};
  const std::vector<Index> outside{0, 2}, odd{0, 1, 0}, none;
  const auto with = [&](const FacetList& list, std::span<const double> x) {
    return refusal([&] { (void)ClosestPoints(std::vector<FacetList>{list}, x); });
  };
  EXPECT_EQ(with({2, outside}, nodes), "facet 0 names node 2, but there are 2 nodes");
  EXPECT_EQ(with({2, odd}, nodes), "3 node numbers for facets of 2 nodes");
  EXPECT_EQ(with({5, odd}, nodes), "facets of 5 nodes; expected 2 to 4");
  EXPECT_EQ(with({2, none}, nodes), "the surface has no facet");
  EXPECT_EQ(with({2, odd}, std::span(nodes).first(3)),
            "3 coordinates are not a whole number of points with 2 each");
  EXPECT_EQ(refusal([&] { (void)sheet().find(nodes); }),
            "4 coordinates are not a whole number of points with 3 each");
  EXPECT_EQ(refusal([&] {
              (void)sheet().find({}, {Mode::fast, 0});
            }),
            "threads must be >= 1, got 0");
}

}  // namespace
}  // namespace osculate::api
