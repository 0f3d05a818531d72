#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "osculate/cell/line_shape.hpp"

namespace osculate::cell {
namespace {

double node_position(int k, int n) {
  if (k < 2) return k == 0 ? -1.0 : 1.0;
  return -1.0 + 2.0 * (k - 1) / (n - 1);
}

double falling(int m, int d) {
  double product = 1;
  for (int i = 0; i < d; ++i) product *= m - i;
  return product;
}

TEST(LineShape, TwoNodesAreTheLinearSegment) {  // [eq:KS2D:64]
  const LineShape s = lagrange_line(2, 0.25);
  EXPECT_EQ(s.count, 2);
  EXPECT_EQ(s.n[0][0], 0.375);
  EXPECT_EQ(s.n[0][1], 0.625);
  EXPECT_EQ(s.n[1][0], -0.5);
  EXPECT_EQ(s.n[1][1], 0.5);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_EQ(s.n[2][k] * s.n[2][k] + s.n[3][k] * s.n[3][k], 0.0);
}

TEST(LineShape, ThreeNodesInClosedForm) {
  const double x = 0.3;
  const LineShape s = lagrange_line(3, x);
  EXPECT_NEAR(s.n[0][0], 0.5 * x * (x - 1), 1e-16);
  EXPECT_NEAR(s.n[0][1], 0.5 * x * (x + 1), 1e-16);
  EXPECT_NEAR(s.n[0][2], 1 - x * x, 2e-16);
  EXPECT_NEAR(s.n[1][2], -2 * x, 2e-16);
  EXPECT_NEAR(s.n[2][0], 1.0, 1e-16);
  EXPECT_NEAR(s.n[2][2], -2.0, 1e-16);
}

TEST(LineShape, IsOneAtItsNodeAndZeroAtTheOthersInGmshOrder) {
  for (int n = 2; n <= max_line_nodes; ++n)
    for (int i = 0; i < n; ++i) {
      const LineShape s = lagrange_line(n, node_position(i, n));
      for (int k = 0; k < n; ++k)
        EXPECT_NEAR(s.n[0][static_cast<std::size_t>(k)], i == k ? 1.0 : 0.0, 3e-14) << n << i << k;
    }
}

TEST(LineShape, EndNodesAreExact) {
  for (int n = 2; n <= max_line_nodes; ++n)
    for (std::size_t end = 0; end < 2; ++end) {
      const LineShape s = lagrange_line(n, end == 0 ? -1.0 : 1.0);
      for (std::size_t k = 0; k < static_cast<std::size_t>(n); ++k) {
        if (k == end)
          EXPECT_NEAR(s.n[0][k], 1.0, 3e-16);
        else
          EXPECT_EQ(s.n[0][k], 0.0) << n << " " << k;
      }
    }
}

TEST(LineShape, ReproducesPolynomialsAndTheirDerivatives) {
  for (int n = 2; n <= max_line_nodes; ++n)
    for (double x : {-1.0, -0.77, -0.1, 0.0, 0.4, 0.93, 1.0, 1.2}) {
      const LineShape s = lagrange_line(n, x);
      ASSERT_EQ(s.count, n);
      for (int m = 0; m < n; ++m)
        for (int d = 0; d < 4; ++d) {
          double sum = 0, size = 1;
          for (int k = 0; k < n; ++k) {
            const double share = s.n[static_cast<std::size_t>(d)][static_cast<std::size_t>(k)];
            sum += share * std::pow(node_position(k, n), m);
            size += std::abs(share);
          }
          const double exact = m < d ? 0.0 : falling(m, d) * std::pow(x, m - d);
          EXPECT_NEAR(sum, exact, 4e-15 * size) << n << " nodes, x^" << m << ", derivative " << d;
        }
    }
}

TEST(LineShape, MirrorsExactly) {
  for (int n = 2; n <= max_line_nodes; ++n) {
    const LineShape left = lagrange_line(n, -0.37), right = lagrange_line(n, 0.37);
    for (int k = 0; k < n; ++k) {
      const int mirror = k < 2 ? 1 - k : n + 1 - k;
      for (std::size_t d = 0; d < 4; ++d)
        EXPECT_NEAR(left.n[d][static_cast<std::size_t>(k)],
                    (d % 2 == 0 ? 1 : -1) * right.n[d][static_cast<std::size_t>(mirror)],
                    1e-12 * std::abs(left.n[d][static_cast<std::size_t>(k)]) + 1e-13);
    }
  }
}

}  // namespace
}  // namespace osculate::cell
