#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "osculate/cell/quadrature.hpp"

namespace osculate::cell {
namespace {

double apply(const Quadrature1D& rule, int power) {
  double sum = 0;
  for (std::size_t i = 0; i < rule.points.size(); ++i)
    sum += rule.weights[i] * std::pow(rule.points[i], power);
  return sum;
}
double apply(const Quadrature2D& rule, int p, int q) {
  double sum = 0;
  for (std::size_t i = 0; i < rule.points.size(); ++i)
    sum += rule.weights[i] * std::pow(rule.points[i].x(), p) * std::pow(rule.points[i].y(), q);
  return sum;
}
double line_integral(int power) { return power % 2 == 1 ? 0.0 : 2.0 / (power + 1); }
/// p! q! / (p + q + 2)!
double triangle_integral(int p, int q) {
  return std::exp(std::lgamma(p + 1.0) + std::lgamma(q + 1.0) - std::lgamma(p + q + 3.0));
}

void expect_symmetric_and_positive(const Quadrature1D& rule) {
  const std::size_t n = rule.points.size();
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_GT(rule.weights[i], 0) << n;
    EXPECT_LE(std::abs(rule.points[i]), 1) << n;
    EXPECT_NEAR(rule.points[i], -rule.points[n - 1 - i], 1e-16) << n;
    EXPECT_NEAR(rule.weights[i], rule.weights[n - 1 - i], 1e-15) << n;
    EXPECT_TRUE(i == 0 || rule.points[i] > rule.points[i - 1]) << n;
  }
}

TEST(GaussLegendre, IsExactToDegreeTwiceNMinusOneAndNotBeyond) {
  for (int n = 1; n <= 20; ++n) {
    const Quadrature1D rule = gauss_legendre(n);
    ASSERT_EQ(rule.points.size(), static_cast<std::size_t>(n));
    expect_symmetric_and_positive(rule);
    for (int p = 0; p <= 2 * n - 1; ++p)
      EXPECT_NEAR(apply(rule, p), line_integral(p), 5e-15) << n << " points, degree " << p;
    // the error of the first degree missed is known: that of the monic Legendre polynomial squared
    const double monic = std::exp((2 * n + 1) * std::log(2.0) + 4 * std::lgamma(n + 1.0) -
                                  2 * std::lgamma(2 * n + 1.0)) /
                         (2 * n + 1);
    EXPECT_NEAR(line_integral(2 * n) - apply(rule, 2 * n), monic, 5e-15 + 1e-12 * monic) << n;
  }
}

TEST(GaussLegendre, HasTheKnownPoints) {
  const Quadrature1D two = gauss_legendre(2), three = gauss_legendre(3);
  EXPECT_NEAR(two.points[1], 1 / std::sqrt(3.0), 1.2e-16);
  EXPECT_NEAR(three.points[2], std::sqrt(0.6), 1.2e-16);
  EXPECT_EQ(three.points[1], 0.0);
  EXPECT_NEAR(three.weights[1], 8.0 / 9, 2e-16);
}

TEST(GaussLobatto, IsExactToDegreeTwiceNMinusThreeWithBothEnds) {
  for (int n = 2; n <= 20; ++n) {
    const Quadrature1D rule = gauss_lobatto(n);
    ASSERT_EQ(rule.points.size(), static_cast<std::size_t>(n));
    expect_symmetric_and_positive(rule);
    EXPECT_EQ(rule.points.front(), -1.0);
    EXPECT_EQ(rule.points.back(), 1.0);
    for (int p = 0; p <= 2 * n - 3; ++p)
      EXPECT_NEAR(apply(rule, p), line_integral(p), 1e-14) << n << " points, degree " << p;
    EXPECT_TRUE(n > 12 || std::abs(apply(rule, 2 * n - 2) - line_integral(2 * n - 2)) > 1e-8) << n;
  }
}

TEST(GaussLobatto, HasTheKnownPoints) {
  const Quadrature1D three = gauss_lobatto(3), four = gauss_lobatto(4);
  EXPECT_NEAR(three.points[1], 0.0, 1e-16);
  EXPECT_NEAR(three.weights[0], 1.0 / 3, 1e-16);
  EXPECT_NEAR(four.points[2], std::sqrt(0.2), 1.2e-16);
  EXPECT_NEAR(four.weights[0], 1.0 / 6, 1e-16);
}

TEST(GaussQuad, IsTheTensorRule) {
  for (int n = 1; n <= 6; ++n) {
    const Quadrature2D rule = gauss_quad(n);
    ASSERT_EQ(rule.points.size(), static_cast<std::size_t>(n * n));
    for (int p = 0; p <= 2 * n - 1; ++p)
      for (int q = 0; q <= 2 * n - 1; ++q)
        EXPECT_NEAR(apply(rule, p, q), line_integral(p) * line_integral(q), 5e-15) << n << p << q;
  }
}

TEST(GaussTriangle, IsExactToItsDegree) {
  const std::size_t sizes[] = {1, 3, 6, 6, 7, 12};
  for (int degree = 1; degree <= 6; ++degree) {
    const Quadrature2D rule = gauss_triangle(degree);
    EXPECT_EQ(rule.points.size(), sizes[degree - 1]);
    for (int p = 0; p <= degree; ++p)
      for (int q = 0; p + q <= degree; ++q)
        EXPECT_NEAR(apply(rule, p, q), triangle_integral(p, q), 1e-16 + 4e-16 / (1 + p + q))
            << degree << p << q;
  }
}

TEST(GaussTriangle, IsNotExactOneDegreeBeyondItsOwn) {
  for (const int degree : {1, 2, 4, 5, 6}) {
    const Quadrature2D rule = gauss_triangle(degree);
    double worst = 0;
    for (int p = 0; p <= degree + 1; ++p)
      worst = std::max(
          worst, std::abs(apply(rule, p, degree + 1 - p) - triangle_integral(p, degree + 1 - p)));
    EXPECT_GT(worst, 1e-7) << degree;
  }
}

TEST(GaussTriangle, HasPositiveWeightsInsideAndNoPreferredCorner) {
  for (int degree = 1; degree <= 6; ++degree) {
    const Quadrature2D rule = gauss_triangle(degree);
    for (std::size_t i = 0; i < rule.points.size(); ++i) {
      const Vec2& x = rule.points[i];
      EXPECT_GT(rule.weights[i], 0);
      EXPECT_GT(std::min({x.x(), x.y(), 1 - x.x() - x.y()}), 0);
      const Vec2 turned(x.y(), 1 - x.x() - x.y());  // the point seen from the next corner
      bool found = false;
      for (std::size_t j = 0; j < rule.points.size(); ++j)
        found = found || ((rule.points[j] - turned).norm() < 1e-15 &&
                          std::abs(rule.weights[j] - rule.weights[i]) < 1e-16);
      EXPECT_TRUE(found) << degree << " point " << i;
    }
  }
}

}  // namespace
}  // namespace osculate::cell
