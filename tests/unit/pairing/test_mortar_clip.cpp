#include "osculate/pairing/mortar_clip.hpp"

#include <gtest/gtest.h>

#include <random>

namespace osculate::testing {
namespace {

using pairing::area_of;
using pairing::common_part;
using pairing::PlanePoint;
using pairing::Polygon;

Polygon<double> polygon(const std::vector<PlanePoint<double>>& corners) {
  Polygon<double> p;
  for (const PlanePoint<double>& c : corners) p.add(c);
  return p;
}
Polygon<double> square(double x, double y, double size) {
  return polygon({{x, y}, {x + size, y}, {x + size, y + size}, {x, y + size}});
}

TEST(MortarClip, CommonPartOfSquares) {
  constexpr double tiny = 1e-10;
  const Polygon<double> unit = square(0, 0, 1);
  EXPECT_DOUBLE_EQ(area_of(unit), 1.0);
  EXPECT_NEAR(area_of(common_part(square(0.25, 0.5, 1), unit, tiny)), 0.375, 1e-15);
  EXPECT_EQ(common_part(square(2, 0, 1), unit, tiny).count, 0u);  // apart
  EXPECT_EQ(common_part(square(1, 0, 1), unit, tiny).count, 0u);  // a common edge
  EXPECT_EQ(common_part(square(1, 1, 1), unit, tiny).count, 0u);  // a common corner
  EXPECT_DOUBLE_EQ(area_of(common_part(unit, unit, tiny)), 1.0);  // the same
  EXPECT_DOUBLE_EQ(area_of(common_part(square(0.2, 0.3, 0.5), unit, tiny)), 0.25);  // inside
  EXPECT_DOUBLE_EQ(area_of(common_part(unit, square(-1, -1, 3), tiny)), 1.0);       // around
  // Turned by 45 degrees: an octagon.
  const double r = 0.6 * std::sqrt(2.0);
  const Polygon<double> turned =
      polygon({{0.5 - r, 0.5}, {0.5, 0.5 - r}, {0.5 + r, 0.5}, {0.5, 0.5 + r}});
  const Polygon<double> octagon = common_part(turned, unit, tiny);
  EXPECT_EQ(octagon.count, 8u);
  const double cut = std::sqrt(0.5) - 0.6;  // height of each corner that is cut off
  EXPECT_NEAR(area_of(octagon), 1 - 4 * cut * cut, 1e-14);
}

// A square in four parts: whatever lies over it, the parts add up to the whole.
TEST(MortarClip, PartsAddUp) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-0.5, 1.2);
  for (int trial = 0; trial < 200; ++trial) {
    const double ax = uniform(random), ay = uniform(random);
    const double bx = uniform(random), by = uniform(random);
    const double cx = uniform(random), cy = uniform(random);
    Polygon<double> triangle = polygon({{ax, ay}, {bx, by}, {cx, cy}});
    if (area_of(triangle) < 0) triangle = polygon({{ax, ay}, {cx, cy}, {bx, by}});
    double sum = 0;
    for (const double x : {0.0, 0.5})
      for (const double y : {0.0, 0.5})
        sum += area_of(common_part(triangle, square(x, y, 0.5), 1e-12));
    EXPECT_NEAR(sum, area_of(common_part(triangle, square(0, 0, 1), 1e-12)), 1e-9);
    EXPECT_NEAR(area_of(common_part(square(0, 0, 1), triangle, 1e-12)), sum, 1e-9);
  }
}

// Edges on each other within rounding are not cut: their intersection could be anywhere.
TEST(MortarClip, EdgesOnEachOtherAreNotCut) {
  const Polygon<double> unit = square(0, 0, 1);
  const Polygon<double> nearly =
      polygon({{1e-13, -1e-13}, {1, 1e-13}, {1 - 1e-13, 1}, {0, 1 + 1e-13}});
  const Polygon<double> common = common_part(nearly, unit, 1e-10);
  ASSERT_EQ(common.count, 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(common.corners[k].x, nearly.corners[k].x);
    EXPECT_EQ(common.corners[k].y, nearly.corners[k].y);
  }
}

}  // namespace
}  // namespace osculate::testing
