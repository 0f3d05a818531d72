#include "osculate/core/dual.hpp"

#include <gtest/gtest.h>

namespace osculate::testing {
namespace {

using core::Dual;

// The product, quotient and chain rules, each against the closed derivative.
TEST(Dual, FollowsTheRulesOfDifferentiation) {
  const Dual<2> x = Dual<2>::variable(0.7, 0), y = Dual<2>::variable(-1.3, 1);
  const Dual<2> f = x * y + 3.0 * x - y / x + sqrt(x) - (-y) + 2.0;
  EXPECT_DOUBLE_EQ(f.v, 0.7 * -1.3 + 2.1 + 1.3 / 0.7 + std::sqrt(0.7) - 1.3 + 2);
  EXPECT_NEAR(f.d[0], -1.3 + 3 - 1.3 / 0.49 + 0.5 / std::sqrt(0.7), 1e-14);
  EXPECT_NEAR(f.d[1], 0.7 - 1 / 0.7 + 1, 1e-14);
  Dual<2> sum = x;
  sum += y;
  EXPECT_EQ(sum.d, Vec2(1, 1));
  const Dual<2> sine = core::chain(x, std::sin(x.v), std::cos(x.v));
  EXPECT_EQ(sine.d, Vec2(std::cos(0.7), 0));
  EXPECT_EQ(core::chain(0.7, 2.0, 3.0), 2.0);
}

// xi^2 = x: dxi/dx = 1 / (2 xi).
TEST(Dual, RootOfAnEquationByItsImplicitDerivative) {
  const Dual<1> x = Dual<1>::variable(4.0, 0);
  const double xi = 2;
  const Dual<1> root = core::implicit_root(xi, Dual<1>(xi * xi) - x, 2 * xi);
  EXPECT_DOUBLE_EQ(root.v, 2.0);
  EXPECT_DOUBLE_EQ(root.d[0], 0.25);
  EXPECT_EQ(core::implicit_root(xi, 0.0, 2 * xi), 2.0);
}

}  // namespace
}  // namespace osculate::testing
