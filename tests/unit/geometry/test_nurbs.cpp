#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "osculate/geometry/curve_frame.hpp"
#include "sample_curves.hpp"

namespace osculate::geometry {
namespace {

using testing::nurbs_circle;
using testing::nurbs_quarter_circle;
using testing::nurbs_wave;

TEST(Nurbs, QuarterCircleIsACircle) {
  const double radius = 1.7;
  const NurbsCurve curve = nurbs_quarter_circle(radius);
  for (int i = 0; i <= 50; ++i) {
    const CurveJet<2> j = curve.jet(i / 50.0);
    const CurveFrame f = curve_frame(j);
    EXPECT_NEAR(j.r.norm(), radius, 1e-14);
    EXPECT_NEAR(f.kappa, 1 / radius, 1e-14);  // counter-clockwise: a hole
    EXPECT_LT((f.normal + j.r / radius).norm(), 1e-14);
    // third derivative against the circle's: rho_sss = -tau / R^2 in arc length
    const CurveJet<2> s = natural_jet(j);
    EXPECT_LT((s.r3 + s.r1 / (radius * radius)).norm(), 1e-13);
  }
}

TEST(Nurbs, FullCircleIsACircleInEverySpan) {
  const NurbsCurve curve = nurbs_circle(1.3);
  EXPECT_TRUE(curve.closed());
  for (int i = 0; i <= 80; ++i) EXPECT_NEAR(curve.jet(i / 20.0).r.norm(), 1.3, 1e-14);
}

TEST(Nurbs, BasisSumsToOneAndRebuildsTheCurve) {
  for (int p = 1; p <= max_nurbs_degree; ++p) {
    const NurbsCurve curve = nurbs_wave(p, p + 4);
    for (double t : {0.0, 0.2, 0.5, 0.71, 1.0}) {
      const double xi = curve.lo() + t * (curve.hi() - curve.lo());
      const NurbsBasis b = curve.basis(xi);
      ASSERT_EQ(b.shape.count, p + 1);
      ASSERT_GE(b.first, 0);
      ASSERT_LE(static_cast<std::size_t>(b.first + p), curve.control.size() - 1);
      CurveJet<2> sum;
      for (std::size_t d = 0; d < 4; ++d) {
        double total = 0, size = 1;
        for (std::size_t k = 0; k <= static_cast<std::size_t>(p); ++k) {
          total += b.shape.n[d][k];
          size += std::abs(b.shape.n[d][k]);
        }
        EXPECT_NEAR(total, d == 0 ? 1.0 : 0.0, 4e-15 * size);
      }
      const std::span<const Vec2> nodes(curve.control.data() + b.first,
                                        static_cast<std::size_t>(p) + 1);
      EXPECT_EQ(jet_from_shape(b.shape, nodes).r, curve.jet(xi).r);
      EXPECT_EQ(jet_from_shape(b.shape, nodes).r3, curve.jet(xi).r3);
    }
  }
}

TEST(Nurbs, EqualWeightsAndOneSpanAreABezierCurve) {
  const NurbsCurve curve{
      3, {0, 0, 0, 0, 1, 1, 1, 1}, {Vec2(0, 0), Vec2(1, 2), Vec2(3, -1), Vec2(4, 1)}, {2, 2, 2, 2}};
  const double t = 0.3, s = 0.7;
  const NurbsBasis b = curve.basis(t);
  EXPECT_NEAR(b.shape.n[0][0], s * s * s, 1e-16);
  EXPECT_NEAR(b.shape.n[0][1], 3 * s * s * t, 2e-16);
  EXPECT_NEAR(b.shape.n[1][0], -3 * s * s, 4e-16);
  EXPECT_NEAR(b.shape.n[2][3], 6 * t, 4e-16);
  EXPECT_NEAR(b.shape.n[3][3], 6.0, 4e-15);
  EXPECT_EQ(curve.jet(0).r, Vec2(0, 0));
  EXPECT_EQ(curve.jet(1).r, Vec2(4, 1));
}

TEST(Nurbs, SpansAreFoundAlsoAtKnotsEndsAndBeyond) {
  const NurbsCurve curve = nurbs_circle(1);
  EXPECT_EQ(curve.find_span(0), 2);
  EXPECT_EQ(curve.find_span(-5), 2);
  EXPECT_EQ(curve.find_span(0.999), 2);
  EXPECT_EQ(curve.find_span(1), 4);
  EXPECT_EQ(curve.find_span(3.5), 8);
  EXPECT_EQ(curve.find_span(4), 8);
  EXPECT_EQ(curve.find_span(9), 8);
  // without clamped ends the range starts at knot p
  const NurbsCurve open{
      2, {0, 1, 2, 3, 4, 5, 6}, {Vec2(0, 0), Vec2(1, 1), Vec2(2, 0), Vec2(3, 1)}, {1, 1, 1, 1}};
  EXPECT_EQ(validate(open), "");
  EXPECT_EQ(open.lo(), 2.0);
  EXPECT_EQ(open.hi(), 4.0);
  EXPECT_EQ(open.find_span(4), 3);
  EXPECT_LT((open.jet(2).r - Vec2(0.5, 0.5)).norm(), 1e-15);
}

TEST(Nurbs, OneSidedDerivativesAtAKink) {
  const NurbsCurve kink{1, {0, 0, 1, 2, 2}, {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1)}, {1, 1, 1}};
  EXPECT_EQ(kink.jet_in_span(1, 1.0).r1, Vec2(1, 0));
  EXPECT_EQ(kink.jet_in_span(2, 1.0).r1, Vec2(0, 1));
  EXPECT_EQ(kink.jet(1.0).r, Vec2(1, 0));
}

TEST(Nurbs, KnotVectorsAreValidatedWithAMessage) {
  const auto says = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_EQ(validate_knots(3, 2, {0, 0, 0, 1, 1, 1}), "");
  EXPECT_TRUE(says(validate_knots(3, 0, {0, 1, 2, 3}), "degree: expected 1 to 7, found 0"));
  EXPECT_TRUE(says(validate_knots(20, 8, {}), "degree: expected 1 to 7, found 8"));
  EXPECT_TRUE(says(validate_knots(2, 2, {0, 0, 0, 1, 1}), "at least degree + 1 = 3"));
  EXPECT_TRUE(says(validate_knots(3, 2, {0, 0, 0, 1, 1}), "= 6 knots, found 5"));
  EXPECT_TRUE(says(validate_knots(3, 2, {0, 0, 0, 1, 0.5, 1}), "nondecreasing"));
  EXPECT_TRUE(says(validate_knots(3, 2, {0, 0, 0, std::nan(""), 1, 1}), "not a finite"));
  EXPECT_TRUE(says(validate_knots(3, 2, {1, 1, 1, 1, 1, 1}), "positive length"));
  EXPECT_TRUE(says(validate_knots(6, 2, {0, 0, 0, 1, 1, 1, 2, 2, 2}), "inner knots"));
  EXPECT_TRUE(says(validate_knots(4, 2, {0, 0, 0, 0, 1, 1, 1}), ""));
  EXPECT_NE(validate_knots(5, 2, {0, 0, 0, 0, 1, 2, 2, 2}), "");
  NurbsCurve curve = nurbs_quarter_circle(1);
  curve.weights[1] = 0;
  EXPECT_TRUE(says(validate(curve), "weights: expected numbers > 0, weight 1 is 0"));
  curve.weights = {1, 1};
  EXPECT_TRUE(says(validate(curve), "weights: expected one for each of the 3"));
}

}  // namespace
}  // namespace osculate::geometry
