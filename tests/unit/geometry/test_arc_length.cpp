#include <gtest/gtest.h>

#include <cmath>

#include "osculate/geometry/arc_length.hpp"
#include "sample_curves.hpp"

namespace osculate::geometry {
namespace {

TEST(ArcLength, ExactForStraightLinesAndCircles) {  // [eq:KS2D:19]
  EXPECT_EQ(arc_length(InfiniteLine{}, -3.0, 4.5), 7.5);
  EXPECT_EQ(arc_length(Circle{Vec2(1, 1), 2.0}, 0.5, 1.75), 2.5);
  EXPECT_EQ(arc_length(Arc{Vec2(1, 1), 2.0, 0, 3, true}, 1.75, 0.5), -2.5);
  EXPECT_EQ(arc_length(lagrange_curve(std::array{Vec2(0, 0), Vec2(3, 4)}), -1.0, 1.0), 5.0);
}

TEST(ArcLength, ParabolaInClosedForm) {
  // rho = (x, x^2): s(x) = x sqrt(1 + 4 x^2)/2 + asinh(2 x)/4
  const LagrangeCurve parabola = lagrange_curve(std::array{Vec2(-1, 1), Vec2(1, 1), Vec2(0, 0)});
  const auto s = [](double x) {
    return 0.5 * x * std::sqrt(1 + 4 * x * x) + std::asinh(2 * x) / 4;
  };
  for (double a : {-1.0, -0.3, 0.0})
    for (double b : {0.1, 0.8, 1.0, 30.0})
      EXPECT_NEAR(arc_length(parabola, a, b), s(b) - s(a), 1e-14 * (s(b) - s(a)));
  EXPECT_EQ(arc_length(parabola, 0.4, 0.4), 0.0);
  EXPECT_EQ(arc_length(parabola, 0.9, -0.2), -arc_length(parabola, -0.2, 0.9));
}

TEST(ArcLength, NurbsCircleHasTheLengthOfItsArc) {
  const NurbsCurve quarter = testing::nurbs_quarter_circle(1.7);
  const double pi = std::acos(-1.0);
  EXPECT_NEAR(arc_length(quarter, 0, 1), 0.5 * pi * 1.7, 1e-14 * 3);
  EXPECT_NEAR(arc_length(testing::nurbs_circle(1.3), 0, 4), 2 * pi * 1.3, 1e-14 * 9);
  EXPECT_NEAR(arc_length(testing::nurbs_circle(1.3), 3.5, 0.5), -1.5 * pi * 1.3, 1e-14 * 9);
}

TEST(ArcLength, AddsUpOnEveryCurve) {
  for (const testing::NamedCurve& sample : testing::sample_curves()) {
    SCOPED_TRACE(sample.name);
    const auto range = testing::finite_range(sample.curve);
    const double middle = range[0] + 0.37 * (range[1] - range[0]);
    const double whole = arc_length(sample.curve, range[0], range[1]);
    const double parts =
        arc_length(sample.curve, range[0], middle) + arc_length(sample.curve, middle, range[1]);
    EXPECT_NEAR(parts, whole, 2e-14 * whole);
    EXPECT_GT(whole, 0.0);
  }
}

TEST(ArcLength, CuspAndDegenerateCurvesEnd) {
  // rho = (x^2, 0) runs to the origin and back: its speed has a kink at zero
  const auto cusp = [](double x) {
    return CurveJet<2>{Vec2(x * x, 0), Vec2(2 * x, 0), Vec2(2, 0), Vec2(0, 0)};
  };
  EXPECT_NEAR(arc_length(cusp, -0.3, 1.0), 0.09 + 1.0, 1e-14);
  const auto point = [](double) { return CurveJet<2>{}; };
  EXPECT_EQ(arc_length(point, -1.0, 1.0), 0.0);
}

}  // namespace
}  // namespace osculate::geometry
