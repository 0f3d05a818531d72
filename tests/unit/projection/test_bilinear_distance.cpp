// Distance from a facet with four corners by scalar products, beside the one of vectors.
#include "osculate/projection/bilinear_distance.hpp"

#include <gtest/gtest.h>

#include <random>

#include "osculate/cell/linear_facet.hpp"
#include "osculate/projection/surface_distance.hpp"

namespace osculate::projection {
namespace {

struct Problem {
  std::array<Vec3, 4> nodes;
  Vec3 point;
  [[nodiscard]] BilinearDistance distance() const {
    return {nodes[0], nodes[1], nodes[2], nodes[3], point};
  }
  [[nodiscard]] DistanceJet2 jet(const Vec2& xi) const {
    const cell::FacetDerivatives r = cell::linear_facet(
        cell::CellType::quad4, [this](std::size_t k) -> const Vec3& { return nodes[k]; }, xi);
    return distance_jet2<3>(point - r[0], {r[1], r[2]}, {r[3], r[4], r[5]});
  }
};

Problem problem(double distorted, double far, std::mt19937& generator) {
  std::uniform_real_distribution<double> u(-1, 1);
  const auto any = [&] { return Vec3(u(generator), u(generator), u(generator)); };
  return {{Vec3(-1, -1, 0.2) + distorted * any(), Vec3(1, -1, 0) + distorted * any(),
           Vec3(1.2, 1, -0.2) + distorted * any(), Vec3(-0.9, 1, 0) + distorted * any()},
          far * any()};
}

// [eq:KSVD:15] [eq:KSVD:16]
TEST(BilinearDistance, IsThatOfTheVectors) {
  std::mt19937 generator(2);
  std::uniform_real_distribution<double> u(-1.2, 1.2);
  for (int i = 0; i < 300; ++i) {
    const Problem p = problem(0.4, 2, generator);
    const BilinearDistance distance = p.distance();
    const Vec2 xi(u(generator), u(generator));
    const DistanceJet2 j = p.jet(xi);
    const DistanceJet2 k = distance.jet(xi);
    EXPECT_NEAR(k.squared_distance, j.squared_distance, 1e-14 * 40);
    EXPECT_LT((k.slope - j.slope).norm(), 1e-14 * 40);
    EXPECT_LT((k.bend - j.bend).norm(), 1e-14 * 40);
    EXPECT_LT((k.metric - j.metric).norm(), 1e-14 * 40);
    if (!positive(j.bend)) continue;
    EXPECT_LT((distance.step(xi, j.slope) - descent(j)).norm(), 1e-12 * (1 + descent(j).norm()));
  }
}

TEST(BilinearDistance, WhatIsCalledConvexBendsUpwardsAllOver) {
  std::mt19937 generator(4);
  int convex = 0, other = 0;
  for (int i = 0; i < 2000; ++i) {
    const Problem p = problem(0.4, 3, generator);
    const bool said = p.distance().convex();
    ++(said ? convex : other);
    if (!said) continue;
    for (int k = 0; k <= 10; ++k)
      for (int l = 0; l <= 10; ++l) EXPECT_TRUE(positive(p.jet({0.2 * k - 1, 0.2 * l - 1}).bend));
  }
  EXPECT_GT(convex, 200);
  EXPECT_GT(other, 200);
}

TEST(BilinearDistance, ParallelogramsAreConvexForEveryPoint) {
  const BilinearDistance distance({0, 0, 0}, {2, 0, 1}, {2.5, 1, 1}, {0.5, 1, 0}, {1e3, -40, 1e4});
  EXPECT_TRUE(distance.convex());
}

/// Each has no upward bend in a corner, which one of the three bounds by itself would miss.
TEST(BilinearDistance, SaddlesInACornerAreFoundOut) {
  EXPECT_FALSE(
      BilinearDistance({-.9, -1, 0}, {.9, -1, 0}, {1.1, 1, 0}, {-1.1, 1, 0}, {7.7, 0, 0}).convex());
  EXPECT_FALSE(
      BilinearDistance({-1, -.9, 0}, {1, -1.1, 0}, {1, 1.1, 0}, {-1, .9, 0}, {0, 7.7, 0}).convex());
  EXPECT_FALSE(
      BilinearDistance({-1, -1, .5}, {1, -1, -.5}, {1, 1, .5}, {-1, 1, -.5}, {0, 0, 1.8}).convex());
}

TEST(BilinearDistance, FacetsWithoutAreaAreNot) {
  EXPECT_FALSE(BilinearDistance({0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {1, 1, 1}).convex());
  EXPECT_FALSE(BilinearDistance({1, 2, 0}, {1, 2, 0}, {1, 2, 0}, {1, 2, 0}, {1, 1, 1}).convex());
}

TEST(BilinearDistance, KnowsWhereAWayInwardsIsDownhill) {
  const auto at = [](const Vec3& point) {
    return BilinearDistance({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, point);
  };
  EXPECT_TRUE(at({1.2, 0.3, 0.1}).nothing_inwards({1, 0.3}));
  EXPECT_FALSE(at({0.8, 0.3, 0.1}).nothing_inwards({1, 0.3}));
  EXPECT_TRUE(at({-1.2, -4, 0.1}).nothing_inwards({-1, -1}));
  EXPECT_FALSE(at({-1.2, -0.9, 0.1}).nothing_inwards({-1, -1}));
}

}  // namespace
}  // namespace osculate::projection
