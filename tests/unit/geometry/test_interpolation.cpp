// Splines through points, and curves travelled backwards.
#include "osculate/geometry/interpolation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sample_curves.hpp"

namespace osculate::testing {
namespace {

using geometry::CurveJet;

TEST(GraphThrough, MeetsItsPointsAndTravelsInTheirOrder) {
  const std::vector<double> x{0, 0.7, 1, 2.5, 3, 4.2}, y{0, 1, -0.5, 0.2, 2, 1};
  for (const bool backwards : {false, true})
    for (std::size_t n = 2; n <= x.size(); ++n) {
      std::vector<double> xs(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(n));
      std::vector<double> ys(y.begin(), y.begin() + static_cast<std::ptrdiff_t>(n));
      if (backwards) {
        std::reverse(xs.begin(), xs.end());
        std::reverse(ys.begin(), ys.end());
      }
      const geometry::NurbsCurve curve = geometry::graph_through(xs, ys);
      ASSERT_EQ(geometry::validate(curve), "");
      EXPECT_EQ(curve.degree, std::min<int>(3, static_cast<int>(n) - 1));
      for (std::size_t i = 0; i < n; ++i) {
        const CurveJet<2> jet = curve.jet(backwards ? -xs[i] : xs[i]);
        EXPECT_LT((jet.r - Vec2(xs[i], ys[i])).norm(), 1e-13);
        EXPECT_NEAR(jet.r1.x(), backwards ? -1 : 1, 1e-12);  // the parameter is x or -x
      }
    }
}

// "Not a knot": a cubic is met exactly with all its derivatives.
TEST(GraphThrough, ReproducesCubics) {
  const auto f = [](double x) { return 2 - x + 0.5 * x * x - 0.3 * x * x * x; };
  std::vector<double> x{-1, -0.2, 0.1, 1, 1.7, 2}, y;
  for (const double at : x) y.push_back(f(at));
  const geometry::NurbsCurve curve = geometry::graph_through(x, y);
  for (const double at : {-0.9, 0.0, 0.5, 1.9}) {
    const CurveJet<2> jet = curve.jet(at);
    EXPECT_NEAR(jet.r.y(), f(at), 1e-13);
    EXPECT_NEAR(jet.r1.y(), -1 + at - 0.9 * at * at, 1e-12);
    EXPECT_NEAR(jet.r2.y(), 1 - 1.8 * at, 1e-11);
    EXPECT_NEAR(jet.r3.y(), -1.8, 1e-10);
  }
}

TEST(GraphThrough, HasTwoContinuousDerivativesAndConvergesWithOrderFour) {
  const auto error = [](int n) {
    std::vector<double> x, y;
    for (int i = 0; i <= n; ++i) {
      x.push_back(3.0 * i / n);
      y.push_back(std::sin(x.back()));
    }
    const geometry::NurbsCurve curve = geometry::graph_through(x, y);
    const Index last = curve.find_span(curve.hi());
    for (Index span = curve.degree; span < last; ++span) {
      const double knot = curve.knots[static_cast<std::size_t>(span) + 1];
      const CurveJet<2> before = curve.jet_in_span(span, knot),
                        after = curve.jet_in_span(span + 1, knot);
      EXPECT_LT((before.r1 - after.r1).norm(), 1e-12);
      EXPECT_LT((before.r2 - after.r2).norm(), 1e-10);
    }
    double worst = 0;
    for (double at = 0; at <= 3; at += 0.003)
      worst = std::max(worst, std::abs(curve.jet(at).r.y() - std::sin(at)));
    return worst;
  };
  EXPECT_NEAR(std::log2(error(80) / error(160)), 4, 0.2);
}

TEST(Reversed, TravelsTheSamePointsTheOtherWay) {
  for (const NamedCurve& sample : sample_curves()) {
    SCOPED_TRACE(sample.name);
    const geometry::Curve back = geometry::reversed(sample.curve);
    const auto [lo, hi] = finite_range(sample.curve);
    const auto [from, to] = finite_range(back);
    EXPECT_EQ(geometry::closed(back), geometry::closed(sample.curve));
    for (int i = 0; i <= 8; ++i) {
      const double part = 0.125 * i + (i == 8 ? 0.0 : 0.011);
      const CurveJet<2> a = geometry::jet(sample.curve, lo + part * (hi - lo)),
                        b = geometry::jet(back, to - part * (to - from));
      EXPECT_LT((a.r - b.r).norm(), 1e-13);
      EXPECT_LT((a.r1 + b.r1).norm(), 1e-12 * a.r1.norm());
      EXPECT_LT((a.r2 - b.r2).norm(), 1e-11 * (1 + a.r2.norm()));
    }
  }
}

}  // namespace
}  // namespace osculate::testing
