// Four numbers at once are what they are one by one.
#include <gtest/gtest.h>

#include <cmath>

#include "osculate/core/pack.hpp"

namespace osculate::core {
namespace {

TEST(Pack, CalculatesEachNumber) {
  const Pack a(0.3, -2, 1e-9, 7), b(2, 5, -0.25, 1e3);
  for (int i = 0; i < Pack::count; ++i) {
    EXPECT_EQ((a + b)[i], a[i] + b[i]);
    EXPECT_EQ((a - b)[i], a[i] - b[i]);
    EXPECT_EQ((2 * a * b)[i], 2 * a[i] * b[i]);
    EXPECT_EQ((a / b)[i], a[i] / b[i]);
    EXPECT_EQ((-a)[i], -a[i]);
    EXPECT_EQ(abs(a)[i], std::abs(a[i]));
    EXPECT_NEAR(log(abs(b))[i], std::log(std::abs(b[i])), 1e-15 * std::abs(std::log(1e3)));
    EXPECT_DOUBLE_EQ(cube_root_of(b)[i], std::cbrt(b[i]));
  }
  Pack c = a;
  c += b;
  c -= a;
  c *= Pack(2.0);
  EXPECT_EQ(c[1], 10);
  c.set(1, 3);
  EXPECT_EQ(c[1], 3);
}

TEST(Pack, AllMeansEach) {
  const Pack a(1, 2, 3, 4);
  EXPECT_TRUE(everywhere(a > 0));
  EXPECT_FALSE(everywhere(a > 1));
  EXPECT_FALSE(everywhere(a < 4));
  EXPECT_TRUE(everywhere(a > 0 && a < 5));
  EXPECT_FALSE(everywhere(a > 0 && a < 4));
  EXPECT_FALSE(everywhere(Pack(1, 2, std::nan(""), 4) > 0));
}

}  // namespace
}  // namespace osculate::core
