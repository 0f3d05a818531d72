#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "oscillator/reference.hpp"

namespace osculate::verification {
namespace {

const std::vector<TimeScheme> second_order_schemes{
    newmark(0.25, 0.5),     newmark(1.0 / 6, 0.5), hht(0.05),
    hht(1.0 / 3),           generalized_alpha(1),  generalized_alpha(0.8),
    generalized_alpha(0.5), generalized_alpha(0)};

TEST(Oscillator, StepsAsTheSchemeIsWritten) {
  const TimeScheme s{0.1, 0.3, 0.4, 0.8};
  const double W = 0.7, xi = 0.05;
  const Vec3 x(0.4, -0.3, 0.2), y = amplification(s, W, xi) * x;
  EXPECT_NEAR(y[0], x[0] + x[1] + 0.1 * x[2] + 0.4 * y[2], 1e-15);
  EXPECT_NEAR(y[1], x[1] + 0.2 * x[2] + 0.8 * y[2], 1e-15);
  const Vec3 stiff = 0.7 * y + 0.3 * x;
  EXPECT_NEAR(0.9 * y[2] + 0.1 * x[2] + 2 * xi * W * stiff[1] + W * W * stiff[0], 0, 1e-15);
}

TEST(Oscillator, HasNewmarksRoots) {
  for (const double beta : {0.0, 1.0 / 6, 0.25, 0.36})
    for (const double gamma : {0.5, 0.6})
      for (const double W : {0.1, 0.7, 1.6}) {
        const std::complex<double> root = principal_root(newmark(beta, gamma), W);
        EXPECT_NEAR(std::abs(root - newmark_root(beta, gamma, W)), 0, 1e-13);
      }
  const double W = 1.3;  // average acceleration
  EXPECT_NEAR(std::arg(principal_root(newmark(0.25, 0.5), W)), 2 * std::atan(W / 2), 1e-14);
}

TEST(Oscillator, GrowsBeyondNewmarksLimit) {
  EXPECT_EQ(newmark_stability_limit(0, 0.5), 2);
  EXPECT_NEAR(newmark_stability_limit(1.0 / 6, 0.5), std::sqrt(12.0), 1e-14);
  for (const double beta : {0.0, 1.0 / 6, 0.2}) {
    const double limit = newmark_stability_limit(beta, 0.5);
    EXPECT_NEAR(spectral_radius(newmark(beta, 0.5), 0.99 * limit), 1, 1e-12);
    EXPECT_GT(spectral_radius(newmark(beta, 0.5), 1.01 * limit), 1.01);
  }
  EXPECT_EQ(newmark_stability_limit(0.25, 0.5), std::numeric_limits<double>::infinity());
}

TEST(Oscillator, NeverGrowsWithTheUnconditionalSchemes) {
  for (const TimeScheme& s :
       {newmark(0.25, 0.5), newmark(0.3025, 0.6), hht(0.1), hht(1.0 / 3), generalized_alpha(0),
        generalized_alpha(0.3), generalized_alpha(0.8), generalized_alpha(1)})
    for (double W = 1e-3; W < 1e3; W *= 1.7) EXPECT_LE(spectral_radius(s, W), 1 + 1e-9) << W;
}

TEST(Oscillator, DampsHighFrequenciesAsAsked) {
  for (const double radius : {0.0, 0.3, 0.5, 0.8, 1.0})
    EXPECT_NEAR(spectral_radius(generalized_alpha(radius), 1e5), radius, 2e-3) << radius;
  for (const double alpha : {0.05, 0.1, 0.3})
    EXPECT_NEAR(spectral_radius(hht(alpha), 1e5), (1 - alpha) / (1 + alpha), 2e-3) << alpha;
}

TEST(Oscillator, HasThePeriodErrorOfItsLeadingTerm) {
  for (const TimeScheme& s : second_order_schemes) {
    ASSERT_TRUE(second_order(s));
    const auto rest = [&](double W) { return period_error(s, W) - leading_period_error(s, W); };
    EXPECT_NEAR(std::log2(rest(0.08) / rest(0.04)), 4, 0.1);
  }
  EXPECT_NEAR(leading_period_error(newmark(0.25, 0.5), 0.1), 0.01 / 12, 1e-16);
}

TEST(Oscillator, DampsLowFrequenciesWithTheThirdOrder) {
  for (const TimeScheme& s : second_order_schemes) {
    if (s.gamma == 0.5) continue;  // none
    const double order = std::log2(algorithmic_damping(s, 0.08) / algorithmic_damping(s, 0.04));
    EXPECT_NEAR(order, 3, 0.1);
  }
  const double order = std::log2(algorithmic_damping(newmark(0.3025, 0.6), 0.02) /
                                 algorithmic_damping(newmark(0.3025, 0.6), 0.01));
  EXPECT_NEAR(order, 1, 0.01) << "gamma alone costs an order";
}

TEST(Oscillator, ConvergesToTheMotionWithTheSecondOrder) {
  const double xi = 0.1, span = 3, wd = std::sqrt(1 - xi * xi);
  const double decay = std::exp(-xi * span), s0 = std::sin(wd * span) / wd;
  const Vec2 exact = decay * Vec2(std::cos(wd * span) + xi * s0, -s0);
  for (const TimeScheme& s : second_order_schemes) {
    const auto error = [&](int n) {
      const Vec3 end = after_steps(s, span / n, 1, 0, n, xi);
      return (Vec2(end[0], end[1] * n / span) - exact).norm();
    };
    EXPECT_NEAR(std::log2(error(200) / error(400)), 2, 0.05);
  }
}

}  // namespace
}  // namespace osculate::verification
