// Closest points for another code: plain arrays in and out.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "osculate/contact.hpp"

namespace osculate {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

/// Two squares and a triangle in the plane z = 0, normal up.
const std::vector<double> sheet_nodes{0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1,
                                      0, 1, 1, 0, 2, 1, 0, 3, 0, 0};
const std::vector<Index> sheet_quads{0, 1, 4, 3, 1, 2, 5, 4};
const std::vector<Index> sheet_triangles{2, 6, 5};

ClosestPoints<3> sheet() {
  const std::vector<Facets> lists{{FacetType::quad4, sheet_quads},
                                  {FacetType::tri3, sheet_triangles}};
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
  EXPECT_EQ(a.status[3], ClosestStatus::projected);
  EXPECT_EQ(a.unique[3], 1);
  EXPECT_EQ(a.status[4], ClosestStatus::invalid);
  EXPECT_EQ(a.facet[4], -1);
}

TEST(ClosestPoints, ACurveInThePlane) {
  const std::vector<double> nodes{2, 0, 0, 0, 1, 0};
  const std::vector<Index> line3{0, 1, 2};  // walked to -x: the body is above, the normal down
  const std::vector<Facets> lists{{FacetType::line3, line3}};
  const ClosestPointArrays<2> a =
      ClosestPoints<2>(lists, nodes).find(std::vector<double>{0.5, -1, 0.5, 0.25, 3, 0, 0, inf});
  EXPECT_NEAR(a.xi[0], 0.5, 1e-12);
  EXPECT_NEAR(a.distance[0], 1, 1e-12);
  EXPECT_NEAR(a.distance[1], -0.25, 1e-12);
  EXPECT_EQ(a.feature[1], Feature::face);
  EXPECT_EQ(a.feature[2], Feature::corner);
  EXPECT_EQ(a.status[3], ClosestStatus::invalid);
}

TEST(ClosestPoints, AShape) {
  const ClosestPoints<3> find{Shape<3>(Sphere{.radius = 2})};
  const ClosestPointArrays<3> a = find.find(std::vector<double>{0, 3, 4, 0, 0, 0});
  EXPECT_NEAR(a.distance[0], 3, 1e-12);
  EXPECT_NEAR(a.point[1], 1.2, 1e-12);
  EXPECT_NE(a.status[1], ClosestStatus::projected);  // all points of the sphere are as near
  EXPECT_NEAR(a.distance[1], -2, 1e-12);
}

TEST(ClosestPoints, TheSameBitsForAnyNumberOfThreadsAndNearlyTheSameInFastMode) {
  std::vector<double> points;
  for (int i = 0; i < 3 * 2000; ++i) points.push_back(3 * std::sin(1.7 * i + 0.3 * i * i));
  const ClosestPoints<3> find = sheet();
  const ClosestPointArrays<3> one = find.find(points);
  const ClosestPointArrays<3> three = find.find(points, {ClosestMode::certified, 3});
  const ClosestPointArrays<3> fast = find.find(points, {ClosestMode::fast, 2});
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
  } catch (const Refused& error) {
    return error.what();
  }
  return {};
}

TEST(ClosestPoints, InputThatCannotBeUsed) {
  const std::vector<double> nodes{0, 0, 1, 0};
  const std::vector<Index> outside{0, 2}, odd{0, 1, 0}, none;
  const auto with = [&](const Facets& list, std::span<const double> x) {
    return refusal([&] { (void)ClosestPoints<2>(std::vector<Facets>{list}, x); });
  };
  EXPECT_EQ(with({FacetType::line2, outside}, nodes), "surface: node 2 does not exist");
  EXPECT_EQ(with({FacetType::line2, odd}, nodes),
            "surface: 3 node numbers are no whole number of facets of 2");
  EXPECT_EQ(with({FacetType::line5, {}}, nodes), "surface: facets of 5 nodes; expected 2 to 4");
  EXPECT_EQ(with({FacetType::tri3, {}}, nodes), "surface: facets are lines, not tri3");
  EXPECT_EQ(with({FacetType::line2, none}, nodes), "the surface has no facet");
  EXPECT_EQ(with({FacetType::line2, odd}, std::span(nodes).first(3)),
            "3 coordinates are no pairs of x and y");
  EXPECT_EQ(refusal([&] { (void)ClosestPoints<3>(Shape<3>(Sphere{.radius = -1})); }),
            "surface: sphere: radius: expected a number > 0, found -1");
  EXPECT_EQ(refusal([&] { (void)sheet().find(nodes); }),
            "4 coordinates are not a whole number of points with 3 each");
  EXPECT_EQ(refusal([&] {
              (void)sheet().find({}, {ClosestMode::fast, 0});
            }),
            "threads must be >= 1, got 0");
}

}  // namespace
}  // namespace osculate
