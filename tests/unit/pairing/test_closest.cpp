// Generalized projection onto a chain: faces, vertices, kinks, open ends.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "closest_sample.hpp"

namespace osculate::testing {
namespace {

using pairing::Projection;
using projection::Feature;

/// Polyline of line2 facets through points.
Target<2> line_of(std::vector<Vec2> points) {
  pairing::Chain chain = line_through(points.size());
  return {std::move(points), std::move(chain)};
}

double segment_distance(const Vec2& a, const Vec2& b, const Vec2& p) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm();
}

TEST(ClosestOnChain, EqualsBruteForce) {
  const Target<2> line = line_of({{0, 0}, {1, 0.5}, {2, -0.3}, {3, 0.1}, {3.5, 1.5}, {5, 1}});
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> u(-1, 6);
  for (int i = 0; i < 20000; ++i) {
    const Vec2 p(u(generator), u(generator) - 2);
    double best = 1e9;
    for (std::size_t k = 0; k + 1 < line.x.size(); ++k)
      best = std::min(best, segment_distance(line.x[k], line.x[k + 1], p));
    const Projection<2> found = line.at(p);
    // only the continued ends may be nearer than the polyline itself
    if (found.facet == 0 || found.facet == 4)
      EXPECT_LE(found.distance, best + 1e-12);
    else
      EXPECT_NEAR(found.distance, best, 1e-12);
  }
}

TEST(ClosestOnChain, KinksBelongToTheVertexOutsideAndToTheNearestFaceInside) {
  const Target<2> ridge = line_of({{-2, -1}, {0, 0}, {2, -1}});  // body below: a convex corner
  EXPECT_EQ(ridge.at({0, 0.5}).feature, Feature::corner);
  EXPECT_EQ(ridge.at({0.1, -0.5}).facet, 1);
  EXPECT_EQ(ridge.at({0.1, -0.5}).feature, Feature::face);
  EXPECT_EQ(ridge.at({0, -0.5}, 1).facet, 1);  // equidistant: the history's side
  EXPECT_EQ(ridge.at({0, -0.5}, 0).facet, 0);
  const Target<2> reentrant = line_of({{-2, 1}, {0, 0}, {2, 1}});
  EXPECT_EQ(reentrant.at({0, -0.5}).feature, Feature::corner);
  EXPECT_EQ(reentrant.at({0.3, 0.5}).feature, Feature::face);
  EXPECT_LT((reentrant.at({0, -0.5}).outward - Vec2(0, 1)).norm(), 1e-14);
}

// Clamped to the end, the slip stood still within the tolerance and then jumped: Newton cycled.
TEST(ClosestOnChain, TheFootPointMovesSmoothlyOverABorder) {
  const Target<2> line = line_of({{0, 0}, {1, 0}, {2, 0}});
  for (const double step : {1e-9, 3e-9, -1e-9, -3e-9}) {
    const Projection<2> p = line.at({1 + step, -0.1}, 0);
    EXPECT_EQ(p.feature, Feature::face);
    const double along = p.facet + 0.5 * (p.xi[0] + 1);
    EXPECT_NEAR(along, 1 + step, 1e-15);
  }
}

TEST(ClosestOnChain, OpenEndsAreContinuedALittle) {
  const Target<2> line = line_of({{0, 0}, {1, 0}});
  const Projection<2> near = line.at({1.02, -0.1});
  EXPECT_EQ(near.feature, Feature::face);
  EXPECT_NEAR(near.xi[0], 1.04, 1e-14);
  EXPECT_NEAR(near.distance, 0.1, 1e-14);
  const Projection<2> beyond = line.at({1.2, -0.1});
  EXPECT_TRUE(beyond.beyond_end);
  EXPECT_EQ(beyond.feature, Feature::corner);
  pairing::ProjectionQuery<2> query;
  query.beyond_open = pairing::border_tolerance;
  query.point = {1.001, -0.1};
  EXPECT_TRUE(line.at(query).beyond_end) << "not for points that do not ask for it";
  query.point = {0.999, -0.1};
  EXPECT_FALSE(line.at(query).beyond_end);
}

TEST(ClosestOnChain, FacetsFacingTheSameWayAreSkipped) {
  const Target<2> line = line_of({{0, 0}, {1, 0}});
  pairing::ProjectionQuery<2> query;
  query.point = {0.5, -0.1};
  query.slave_normal = Vec2(0, 1);  // as the facet: the far side of a thin body
  EXPECT_EQ(line.at(query).feature, Feature::none);
  query.slave_normal = Vec2(0, -1);
  EXPECT_EQ(line.at(query).feature, Feature::face);
}

// Inside a convex corner, on its bisector: without history the point belongs to the vertex, whose
// normal is the average of both; with a history it stays on its side.
TEST(ClosestOnChain, EquidistantPointsWithoutHistoryTakeTheAveragedNormal) {
  const Target<2> line = line_of({{-1, 0}, {0, 0}, {0, -1}});
  const Projection<2> shared = line.at({-0.1, -0.1});
  EXPECT_EQ(shared.feature, Feature::corner);
  EXPECT_LT((shared.outward - Vec2(1, 1).normalized()).norm(), 1e-15);
  EXPECT_FALSE(shared.beyond_end);
  for (const Index history : {0, 1}) {
    const Projection<2> kept = line.at({-0.1, -0.1}, history);
    EXPECT_EQ(kept.feature, Feature::face);
    EXPECT_EQ(kept.facet, history);
  }
  EXPECT_EQ(line.at({-0.1, -0.1 + 1e-6}).facet, 0);
  EXPECT_EQ(line.at({-0.1 + 1e-6, -0.1}).facet, 1);
  EXPECT_EQ(line.at({-0.1, -0.1 + 1e-6}).feature, Feature::face);
}

}  // namespace
}  // namespace osculate::testing
