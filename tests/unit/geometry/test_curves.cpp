#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "osculate/geometry/curve_frame.hpp"
#include "sample_curves.hpp"

namespace osculate::geometry {
namespace {

using testing::check_order;
using testing::finite_range;
using testing::sample_curves;

TEST(CurveCatalogue, EveryEntryHasASampleAndAKeyOfItsOwn) {
  std::set<std::size_t> seen;
  std::set<std::string_view> keys;
  for (const testing::NamedCurve& sample : sample_curves()) {
    seen.insert(sample.curve.index());
    keys.insert(key(sample.curve));
    EXPECT_EQ(validate(sample.curve), "") << sample.name;
  }
  EXPECT_EQ(seen.size(), std::variant_size_v<Curve>);
  EXPECT_EQ(keys.size(), std::variant_size_v<Curve>);
}

TEST(CurveCatalogue, JetsAreDerivativesByOrder) {
  for (const testing::NamedCurve& sample : sample_curves()) {
    SCOPED_TRACE(sample.name);
    const auto range = finite_range(sample.curve);
    const double h = 2e-3 * (range[1] - range[0]) / 4;
    for (double t : {0.11, 0.29, 0.53, 0.68, 0.91}) {
      const double xi = range[0] + t * (range[1] - range[0]);
      const CurveJet<2> j = jet(sample.curve, xi);
      const auto r = [&](double x) { return jet(sample.curve, x).r; };
      const auto r1 = [&](double x) { return jet(sample.curve, x).r1; };
      const auto r2 = [&](double x) { return jet(sample.curve, x).r2; };
      EXPECT_TRUE(check_order(r, j.r1, xi, h).second_order()) << xi;
      EXPECT_TRUE(check_order(r1, j.r2, xi, h).second_order()) << xi;
      EXPECT_TRUE(check_order(r2, j.r3, xi, h).second_order()) << xi;
    }
  }
}

TEST(CurveCatalogue, ClosedCurvesJoin) {
  for (const testing::NamedCurve& sample : sample_curves()) {
    SCOPED_TRACE(sample.name);
    EXPECT_LT(lo(sample.curve), hi(sample.curve));
    if (!closed(sample.curve)) continue;
    const CurveJet<2> a = jet(sample.curve, lo(sample.curve));
    const CurveJet<2> b = jet(sample.curve, hi(sample.curve));
    EXPECT_LT((a.r - b.r).norm(), 1e-14);
  }
  EXPECT_TRUE(closed(testing::nurbs_circle(1)));
  EXPECT_FALSE(closed(testing::nurbs_quarter_circle(1)));
  EXPECT_TRUE(closed(Arc{Vec2(0, 0), 1, 0.5, 0.5 + 2 * std::numbers::pi, true}));
}

TEST(Circle, NormalPointsOutOfTheBodyAndCurvatureIsExact) {
  const double radius = 2.5;
  for (bool inside : {false, true})
    for (double xi : {0.0, 0.4, 1.9, 3.3, 6.1}) {
      const Circle circle{Vec2(1, -2), radius, inside};
      const CurveJet<2> j = circle.jet(xi);
      const CurveFrame f = curve_frame(j);
      const Vec2 radial = (j.r - circle.center) / radius;
      EXPECT_LT((f.normal - (inside ? -1.0 : 1.0) * radial).norm(), 1e-15);
      EXPECT_NEAR(f.kappa, (inside ? 1.0 : -1.0) / radius, 2e-16);
      EXPECT_NEAR(f.gamma, 0.0, 2e-16);
      EXPECT_NEAR((j.r - circle.center).norm(), radius, 1e-15);
    }
}

TEST(Arc, RunsBetweenItsAnglesOnTheBodysRight) {
  const Arc solid{Vec2(0, 0), 2, 0.3, 1.1, false}, hole{Vec2(0, 0), 2, 0.3, 1.1, true};
  const auto at = [](double angle) { return Vec2(2 * std::cos(angle), 2 * std::sin(angle)); };
  EXPECT_LT((solid.jet(solid.lo()).r - at(1.1)).norm(), 1e-15);  // clockwise
  EXPECT_LT((solid.jet(solid.hi()).r - at(0.3)).norm(), 1e-15);
  EXPECT_LT((hole.jet(hole.lo()).r - at(0.3)).norm(), 1e-15);
  EXPECT_LT((hole.jet(hole.hi()).r - at(1.1)).norm(), 1e-15);
  const CurveJet<2> j = solid.jet(-0.7);
  EXPECT_GT(curve_frame(j).normal.dot(j.r), 0.0);
  EXPECT_LT(curve_frame(hole.jet(0.7)).normal.dot(hole.jet(0.7).r), 0.0);
}

TEST(InfiniteLine, ParameterIsArcLengthAndNormalIsTheGivenDirection) {
  const InfiniteLine line{Vec2(1, 2), Vec2(3, -4)};
  const CurveFrame f = curve_frame(line.jet(7.0));
  EXPECT_NEAR(f.a11, 1.0, 3e-16);
  EXPECT_LT((f.normal - Vec2(0.6, -0.8)).norm(), 2e-16);
  EXPECT_EQ(line.jet(0).r, Vec2(1, 2));
  EXPECT_EQ(line.hi(), std::numeric_limits<double>::infinity());
  EXPECT_EQ(line.lo(), -std::numeric_limits<double>::infinity());
}

TEST(Polyline, YieldsItsSegments) {
  const Polyline open{{Vec2(0, 0), Vec2(1, 0), Vec2(1, 1)}, false};
  Polyline ring = open;
  ring.closed = true;
  EXPECT_EQ(open.segments(), 2u);
  EXPECT_EQ(ring.segments(), 3u);
  EXPECT_EQ(ring.segment(2).nodes[0], Vec2(1, 1));
  EXPECT_EQ(ring.segment(2).nodes[1], Vec2(0, 0));
  EXPECT_EQ(open.segment(1).jet(0).r, Vec2(1, 0.5));
  EXPECT_EQ(Polyline{}.segments(), 0u);
}

TEST(CurveCatalogue, ValidationNamesTheFieldAndWhatWasExpected) {
  const double nan = std::nan("");
  const auto says = [](const std::string& text, const std::string& field) {
    return text.rfind(field + ":", 0) == 0 && text.find("expected") != std::string::npos;
  };
  EXPECT_TRUE(says(validate(Circle{Vec2(0, 0), 0.0}), "radius"));
  EXPECT_TRUE(says(validate(Circle{Vec2(0, 0), nan}), "radius"));
  EXPECT_TRUE(says(validate(Circle{Vec2(nan, 0), 1.0}), "center"));
  EXPECT_TRUE(says(validate(Arc{Vec2(0, 0), 1, 2.0, 1.0}), "from, to"));
  EXPECT_TRUE(says(validate(Arc{Vec2(0, 0), 1, 0.0, 7.0}), "from, to"));
  EXPECT_TRUE(says(validate(Arc{Vec2(0, 0), 1, nan, 1.0}), "from, to"));
  EXPECT_TRUE(says(validate(InfiniteLine{Vec2(0, 0), Vec2(0, 0)}), "normal"));
  EXPECT_TRUE(says(validate(Polyline{{Vec2(0, 0)}, false}), "points"));
  EXPECT_TRUE(says(validate(Polyline{{Vec2(0, 0), Vec2(1, 0)}, true}), "points"));
  EXPECT_TRUE(says(validate(Polyline{{Vec2(0, 0), Vec2(0, 0)}, false}), "points"));
  EXPECT_TRUE(says(validate(lagrange_curve(std::array{Vec2(1, 1), Vec2(1, 1)})), "nodes"));
  LagrangeCurve many = testing::bent_line(3);
  many.count = 9;
  EXPECT_TRUE(says(validate(many), "nodes"));
}

}  // namespace
}  // namespace osculate::geometry
