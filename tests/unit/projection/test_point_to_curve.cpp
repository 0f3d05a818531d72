#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "osculate/geometry/curve_frame.hpp"
#include "osculate/projection/point_to_curve.hpp"
#include "sample_curves.hpp"

namespace osculate::projection {
namespace {

using geometry::Curve;
using geometry::CurveJet;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Distances of all local minima (ends included), by fine sampling and golden sections.
struct Oracle {
  double best = infinity, second = infinity;
};

double golden(const Curve& curve, const Vec2& p, double a, double b) {
  const double ratio = 0.5 * (std::sqrt(5.0) - 1.0);
  const auto f = [&](double xi) { return (geometry::jet(curve, xi).r - p).squaredNorm(); };
  double c = b - ratio * (b - a), d = a + ratio * (b - a), fc = f(c), fd = f(d);
  for (int i = 0; i < 60; ++i) {
    if (fc < fd) {
      b = d, d = c, fd = fc, c = b - ratio * (b - a), fc = f(c);
    } else {
      a = c, c = d, fc = fd, d = a + ratio * (b - a), fd = f(d);
    }
  }
  return std::sqrt(std::min(fc, fd));
}

/// Curve points at equal parameters.
struct Sampled {
  Curve curve;
  double lo, hi;
  std::vector<Vec2> points;
  static constexpr int count = 1500;
  Sampled(const Curve& c, double from, double to) : curve(c), lo(from), hi(to) {
    for (int i = 0; i <= count; ++i) points.push_back(geometry::jet(curve, xi(i)).r);
  }
  [[nodiscard]] double xi(int i) const { return i == count ? hi : lo + (hi - lo) * i / count; }
};

Oracle brute_force(const Sampled& sampled, const Vec2& p) {
  constexpr int count = Sampled::count;
  const Curve& curve = sampled.curve;
  const double lo = sampled.lo, hi = sampled.hi;
  std::vector<double> d;
  for (const Vec2& point : sampled.points) d.push_back((point - p).norm());
  const auto xi = [&](int i) { return sampled.xi(i); };
  const bool closed = geometry::closed(curve);
  const auto at = [&](int i) {
    if (closed) return d[static_cast<std::size_t>((i + count) % count)];
    return i < 0 || i > count ? infinity : d[static_cast<std::size_t>(i)];
  };
  Oracle oracle;
  for (int i = 0; i <= (closed ? count - 1 : count); ++i) {
    if (!(at(i) <= at(i - 1) && at(i) < at(i + 1))) continue;
    double value = at(i);
    if (i > 0 && i < count) value = std::min(value, golden(curve, p, xi(i - 1), xi(i + 1)));
    if (i == 0) value = std::min(value, golden(curve, p, lo, xi(1)));
    if (i == count) value = std::min(value, golden(curve, p, xi(count - 1), hi));
    if (closed && i == 0) value = std::min(value, golden(curve, p, xi(count - 1), hi));
    if (value < oracle.best) std::swap(value, oracle.best);
    oracle.second = std::min(oracle.second, value);
  }
  return oracle;
}

class Queries {
 public:
  Queries(const Curve& curve, unsigned seed) : random_(seed) {
    const auto range = testing::finite_range(curve);
    low_ = high_ = geometry::jet(curve, range[0]).r;
    for (int i = 1; i <= 64; ++i) {
      const Vec2 r = geometry::jet(curve, range[0] + (range[1] - range[0]) * i / 64).r;
      low_ = low_.cwiseMin(r);
      high_ = high_.cwiseMax(r);
    }
  }
  Vec2 next() {
    const double margin = 0.6 * (high_ - low_).norm();
    std::uniform_real_distribution<double> u(0, 1);
    const Vec2 span = high_ - low_ + Vec2(2 * margin, 2 * margin);
    const double tx = u(random_), ty = u(random_);
    return low_ - Vec2(margin, margin) + Vec2(tx * span.x(), ty * span.y());
  }

 private:
  std::mt19937 random_;
  Vec2 low_, high_;
};

void check_foot(const Curve& curve, const Vec2& p, const CurveFoot& foot, double lo, double hi) {
  ASSERT_TRUE(foot.converged);
  ASSERT_GE(foot.xi, lo);
  ASSERT_LE(foot.xi, hi);
  const CurveJet<2> j = geometry::jet(curve, foot.xi);
  EXPECT_NEAR((p - j.r).norm(), std::sqrt(foot.squared_distance), 1e-14 * (1 + p.norm()));
  const double slope = -(p - j.r).dot(j.r1) / j.r1.norm();
  if (!foot.at_end) {
    EXPECT_NEAR(slope, 0.0, 3e-8 * j.r1.norm()) << p.transpose();  // end_tolerance in xi
    if (foot.xi > lo && foot.xi < hi) {
      EXPECT_NEAR(slope, 0.0, 1e-13 * (1 + p.norm())) << p.transpose();
    }
  } else if (foot.xi == lo) {
    EXPECT_GT(slope, 0.0);
  } else if (foot.xi == hi) {
    EXPECT_LT(slope, 0.0);
  }
}

TEST(PointToCurve, AgreesWithBruteForceOnEveryCurve) {  // [eq:KS2D:1] [eq:KS2D:2]
  constexpr int queries = 1000;
  for (const testing::NamedCurve& sample : testing::sample_curves()) {
    SCOPED_TRACE(sample.name);
    auto range = testing::finite_range(sample.curve);
    if (!std::isfinite(geometry::lo(sample.curve))) range = {-40, 40};
    Queries points(sample.curve, 7);
    const Sampled sampled(sample.curve, range[0], range[1]);
    int wrong_second = 0, iterations = 0;
    for (int q = 0; q < queries; ++q) {
      const Vec2 p = points.next();
      const CurveFoot foot = closest_point(sample.curve, p);
      check_foot(sample.curve, p, foot, geometry::lo(sample.curve), geometry::hi(sample.curve));
      const Oracle oracle = brute_force(sampled, p);
      ASSERT_NEAR(std::sqrt(foot.squared_distance), oracle.best, 1e-11) << p.transpose();
      iterations += foot.iterations;
      const bool same = foot.second_distance == oracle.second ||
                        std::abs(foot.second_distance - oracle.second) < 1e-9;
      if (!same) ++wrong_second;
    }
    // a minimum shallower than the oracle's sampling shows may be missing there
    EXPECT_LE(wrong_second, queries / 500);
    EXPECT_LE(iterations, 8 * queries);
  }
}

TEST(PointToCurve, PointsOnTheCurveAndOnItsNormals) {  // [eq:KS2D:5]
  for (const testing::NamedCurve& sample : testing::sample_curves()) {
    SCOPED_TRACE(sample.name);
    const auto range = testing::finite_range(sample.curve);
    for (double t : {0.0, 0.21, 0.48, 0.83, 1.0})
      for (double zeta : {0.0, 1e-12, 1e-6, 1e-3, -1e-6, -1e-3}) {
        const double xi = range[0] + t * (range[1] - range[0]);
        const CurveJet<2> j = geometry::jet(sample.curve, xi);
        const Vec2 p = offset_point(j, geometry::curve_frame(j).normal, zeta);
        const CurveFoot foot = closest_point(sample.curve, p);
        EXPECT_TRUE(foot.converged);
        EXPECT_FALSE(foot.at_end) << t << " " << zeta;
        EXPECT_LT((geometry::jet(sample.curve, foot.xi).r - j.r).norm(), 3e-13) << t << " " << zeta;
        EXPECT_NEAR(std::sqrt(foot.squared_distance), std::abs(zeta), 1e-14);
      }
  }
}

TEST(PointToCurve, GuessAndSearchAgree) {
  for (const testing::NamedCurve& sample : testing::sample_curves()) {
    SCOPED_TRACE(sample.name);
    if (sample.name == "nurbs1") continue;  // has kinks; these two take one smooth piece
    const auto range = testing::finite_range(sample.curve);
    const auto jet = [&](double xi) { return geometry::jet(sample.curve, xi); };
    Queries points(sample.curve, 11);
    for (int q = 0; q < 300; ++q) {
      const Vec2 p = points.next();
      const CurveFoot foot = closest_on_interval(jet, range[0], range[1], 64, p);
      const CurveFoot fast = closest_from_guess(jet, range[0], range[1], foot.xi, p);
      ASSERT_TRUE(fast.converged);
      EXPECT_NEAR(std::sqrt(fast.squared_distance), std::sqrt(foot.squared_distance), 1e-12);
      EXPECT_EQ(fast.at_end, foot.at_end);
      // from elsewhere it ends in some local minimum, or says that it did not
      const CurveFoot other = closest_from_guess(jet, range[0], range[1], range[0] + 0.1 * q, p);
      if (!other.converged) continue;
      EXPECT_GE(other.squared_distance, foot.squared_distance * (1 - 1e-12));
    }
  }
}

// ---- Newton's step -------------------------------------------------------------------------

TEST(NewtonStep, ConvergesQuadraticallyAndItsMinimumHasPositiveBend) {
  // [eq:KS2D:3] [eq:KS2D:4] on rho = (xi, xi^2 / 2); the cubic x^3/2 + x (1 - py) - px has the root
  const geometry::LagrangeCurve parabola =
      geometry::lagrange_curve(std::array{Vec2(-1, 0.5), Vec2(1, 0.5), Vec2(0, 0)});
  const Vec2 p(0.4, -0.3);
  double xi = 0;
  std::array<double, 6> slopes{};
  for (double& slope : slopes) {
    const DistanceJet d = distance_jet(parabola.jet(xi), xi, p);
    slope = std::abs(d.slope);
    EXPECT_GT(d.bend, 0.0);
    xi += newton_step(d);
  }
  EXPECT_NEAR(xi * xi * xi / 2 + xi * (1 - p.y()) - p.x(), 0.0, 1e-16);
  EXPECT_LT(slopes[2], 2.0 * slopes[1] * slopes[1]);
  EXPECT_LT(slopes[3], 2.0 * slopes[2] * slopes[2]);
  const DistanceJet d = distance_jet(parabola.jet(xi), xi, p);
  const geometry::CurveFrame f = geometry::curve_frame(parabola.jet(xi));
  const double zeta = (p - parabola.jet(xi).r).dot(f.normal);
  EXPECT_NEAR(d.bend, f.a11 - zeta * f.h11, 1e-15);  // positive; the printed (3) is its negative
}

TEST(NewtonStep, PrintedSignWalksAway) {  // errata: eq. 43 of KSCPP, and the sign of [eq:KS2D:3]
  const geometry::LagrangeCurve parabola =
      geometry::lagrange_curve(std::array{Vec2(-1, 0.5), Vec2(1, 0.5), Vec2(0, 0)});
  const Vec2 p(0.4, -0.3);
  double printed = 0, right = 0, previous = 0;
  for (int i = 0; i < 4; ++i) {
    const DistanceJet d = distance_jet(parabola.jet(printed), printed, p);
    printed += d.slope / d.bend;
    EXPECT_LT(printed, previous - 0.1) << i;  // further off in every step
    previous = printed;
    right += newton_step(distance_jet(parabola.jet(right), right, p));
  }
  EXPECT_LT(std::abs(distance_jet(parabola.jet(right), right, p).slope), 1e-15);
  EXPECT_GT(std::abs(distance_jet(parabola.jet(printed), printed, p).slope), 1.0);
}

TEST(DistanceJet, DerivativesByOrder) {  // [eq:KS2D:1] [eq:KS2D:2] [eq:KS2D:3]
  const geometry::LagrangeCurve curve = testing::bent_line(4);
  const Vec2 p(0.7, 1.1);
  const double xi = 0.35;
  const auto at = [&](double x) { return distance_jet(curve.jet(x), x, p); };
  const auto half = [&](double x) { return Vec2(0.5 * at(x).squared_distance, 0); };
  const auto slope = [&](double x) { return Vec2(at(x).slope, 0); };
  const auto bend = [&](double x) { return Vec2(at(x).bend, 0); };
  const DistanceJet d = at(xi);
  EXPECT_TRUE(testing::check_order(half, Vec2(d.slope, 0), xi, 1e-2).second_order());
  EXPECT_TRUE(testing::check_order(slope, Vec2(d.bend, 0), xi, 1e-2).second_order());
  EXPECT_TRUE(testing::check_order(bend, Vec2(d.twist, 0), xi, 1e-2).second_order());
}

// ---- straight segments ---------------------------------------------------------------------

TEST(Line2, StepIsExactFromAnyGuessAndThePrintedClosedFormAgrees) {  // [eq:KS2D:71] [eq:KS2D:72]
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-2, 2);
  for (int q = 0; q < 1000; ++q) {
    const double a = u(random), b = u(random), c = u(random), d = u(random);
    const Vec2 x1(a, b), x2(c, d);
    const double e = u(random), f = u(random);
    const Vec2 p(e, f);
    const double length2 = (x2 - x1).squaredNorm();
    if (length2 < 0.1) continue;
    const double printed = (2 * p.dot(x2 - x1) - (x2.squaredNorm() - x1.squaredNorm())) / length2;
    for (double guess : {-5.0, -1.0, 0.0, 0.3, 2.0})
      EXPECT_NEAR(guess + line2_step(x1, x2, p, guess), printed, 5e-14 * (1 + std::abs(printed)));
    const CurveFoot foot = closest_on_line2(x1, x2, p);
    EXPECT_EQ(foot.at_end, std::abs(printed) > 1 + 2e-8);
    EXPECT_NEAR(foot.xi, std::clamp(printed, -1.0, 1.0), 5e-14);
  }
}

TEST(Line2, ExactInWholeNumbers) {
  const Vec2 x1(0, 0), x2(4, 0);
  const CurveFoot inside = closest_on_line2(x1, x2, Vec2(3, -2));
  EXPECT_EQ(inside.xi, 0.5);
  EXPECT_EQ(inside.squared_distance, 4.0);
  EXPECT_FALSE(inside.at_end);
  EXPECT_EQ(inside.second_distance, infinity);
  const CurveFoot beyond = closest_on_line2(x1, x2, Vec2(7, 4));
  EXPECT_EQ(beyond.xi, 1.0);
  EXPECT_EQ(beyond.squared_distance, 25.0);
  EXPECT_TRUE(beyond.at_end);
  const CurveFoot diagonal = closest_on_line2(Vec2(0, 0), Vec2(2, 2), Vec2(0, 2));
  EXPECT_EQ(diagonal.xi, 0.0);
  EXPECT_EQ(diagonal.squared_distance, 2.0);
}

TEST(Line2, DistanceOfAPenetratingPointKeepsItsDigits) {
  // far from the origin the printed closed form loses what the centred one keeps
  const Vec2 shift(1e6, -3e6), x1 = shift, x2 = shift + Vec2(1, 0);
  const CurveFoot foot = closest_on_line2(x1, x2, shift + Vec2(0.25, -0.125));
  EXPECT_EQ(foot.xi, -0.5);
  EXPECT_EQ(foot.squared_distance, 0.015625);
}

TEST(SharedNode, APointThatProjectsOntoItBelongsToBothNeighbours) {
  // smooth joints: two straight segments in a row, two arcs, two halves of a parabola
  const Vec2 left(-1.3, 0.2), middle(0.1, 0.9), right = 2 * middle - left;
  const Vec2 normal = turn(middle - left).normalized();
  for (double zeta : {-0.7, -1e-3, 0.0, 1e-9, 0.4, 30.0}) {
    const Vec2 p = middle + zeta * normal;
    EXPECT_FALSE(closest_on_line2(left, middle, p).at_end) << zeta;
    EXPECT_FALSE(closest_on_line2(middle, right, p).at_end) << zeta;
    const auto half = [](double a, double b) {
      const auto at = [](double x) { return Vec2(x, 0.2 * x * x); };
      return geometry::lagrange_curve(std::array{at(a), at(b), at(0.5 * (a + b))});
    };
    const geometry::LagrangeCurve one = half(-1, 0.3), two = half(0.3, 1);
    const CurveJet<2> j = one.jet(1);
    const Vec2 q = offset_point(j, geometry::curve_frame(j).normal, std::min(zeta, 1.0));
    EXPECT_FALSE(closest_point(one, q).at_end) << zeta;
    EXPECT_FALSE(closest_point(two, q).at_end) << zeta;
    const geometry::Arc first{Vec2(0, 0), 2, 0.4, 1.1, false},
        second{Vec2(0, 0), 2, 1.1, 1.9, false};
    const Vec2 s = (2 + std::max(zeta, -1.0)) * Vec2(std::cos(1.1), std::sin(1.1));
    EXPECT_FALSE(closest_point(first, s).at_end) << zeta;
    EXPECT_FALSE(closest_point(second, s).at_end) << zeta;
  }
}

TEST(SharedNode, OnlyWhatIsWithinTheToleranceBelongsToTheEnd) {
  const Vec2 x1(0, 0), x2(2, 0);  // xi = x - 1
  EXPECT_FALSE(closest_on_line2(x1, x2, Vec2(2 + 1.9e-8, 1)).at_end);
  EXPECT_TRUE(closest_on_line2(x1, x2, Vec2(2 + 2.1e-8, 1)).at_end);
  const geometry::LagrangeCurve three = geometry::lagrange_curve(std::array{x1, x2, Vec2(1, 0)});
  EXPECT_FALSE(closest_point(three, Vec2(-1.9e-8, 1)).at_end);
  EXPECT_TRUE(closest_point(three, Vec2(-2.1e-8, 1)).at_end);
}

// ---- circles, kinks, degenerate input --------------------------------------------------------

TEST(Circle, CentreIsAmbiguousNotAFailure) {
  const geometry::Circle circle{Vec2(1, 2), 3.0, true};
  const CurveFoot foot = closest_point(circle, circle.center);
  EXPECT_TRUE(foot.converged);
  EXPECT_EQ(foot.squared_distance, 9.0);
  EXPECT_EQ(foot.second_distance, 3.0);
  const geometry::Arc arc{Vec2(1, 2), 3.0, 0.1, 1.0, false};
  const CurveFoot on_arc = closest_point(arc, arc.center);
  EXPECT_TRUE(on_arc.converged);
  EXPECT_EQ(on_arc.squared_distance, 9.0);
  EXPECT_EQ(on_arc.second_distance, 3.0);
  const CurveFoot nurbs = closest_point(testing::nurbs_circle(1.3), Vec2(0, 0));
  EXPECT_TRUE(nurbs.converged);
  EXPECT_NEAR(nurbs.squared_distance, 1.69, 1e-14);
  EXPECT_GE(nurbs.xi, 0.0);
  EXPECT_LE(nurbs.xi, 4.0);
}

TEST(Circle, EndOppositeToThePointIsNoMinimum) {
  for (int i = 0; i < 100; ++i) {
    const double from = 0.071 * i;
    const geometry::Arc half{Vec2(0, 0), 1.0, from, from + std::numbers::pi, i % 2 == 0};
    const Vec2 p = 1.5 * Vec2(std::cos(from), std::sin(from));
    EXPECT_EQ(closest_point(half, p).second_distance, infinity) << i;
    EXPECT_FALSE(closest_point(half, p).at_end) << i;
  }
}

TEST(Circle, ClosedFormAndNewtonAgree) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(-3, 3);
  for (bool inside : {false, true})
    for (int q = 0; q < 500; ++q) {
      const geometry::Circle circle{Vec2(0.2, 0.1), 1.4, inside};
      const double x = u(random), y = u(random);
      const CurveFoot exact = closest_point(circle, Vec2(x, y));
      const auto jet = [&](double xi) { return circle.jet(xi); };
      const CurveFoot newton = closest_on_interval(jet, circle.lo(), circle.hi(), 16, Vec2(x, y));
      EXPECT_NEAR(newton.squared_distance, exact.squared_distance, 1e-13);
      EXPECT_LT((circle.jet(newton.xi).r - circle.jet(exact.xi).r).norm(), 1e-13);
      EXPECT_EQ(exact.second_distance, infinity);  // the far side is a maximum
    }
}

TEST(Nurbs, MinimumAtAKinkIsAnEnd) {
  const geometry::NurbsCurve kink{
      1, {0, 0, 1, 2, 2}, {Vec2(0, 0), Vec2(1, 0), Vec2(1, -1)}, {1, 1, 1}};
  const CurveFoot corner = closest_point(kink, Vec2(1.5, 0.5));
  EXPECT_TRUE(corner.at_end);
  EXPECT_EQ(corner.xi, 1.0);
  EXPECT_EQ(corner.squared_distance, 0.5);
  const CurveFoot border = closest_point(kink, Vec2(1.0, 0.5));  // projects onto the vertex
  EXPECT_FALSE(border.at_end);
  EXPECT_EQ(border.xi, 1.0);
  const CurveFoot within = closest_point(kink, Vec2(0.75, -0.375));  // inside: two faces
  EXPECT_FALSE(within.at_end);
  EXPECT_EQ(within.xi, 1.375);
  EXPECT_NEAR(within.second_distance, 0.375, 1e-15);
}

TEST(Nurbs, SeamOfAClosedCurveIsNoEnd) {
  const CurveFoot foot = closest_point(testing::nurbs_circle(1.3), Vec2(2.0, 0.0));
  EXPECT_FALSE(foot.at_end);
  EXPECT_NEAR(foot.squared_distance, 0.49, 1e-15);
  EXPECT_EQ(foot.second_distance, infinity);
  const CurveFoot opposite = closest_point(testing::nurbs_circle(1.3), Vec2(-2.0, 0.1));
  EXPECT_EQ(opposite.second_distance, infinity);  // its far side is a maximum, not an end
}

TEST(Nurbs, SeamIsFoundOnceWhateverTheRoundingSays) {
  for (int i = 0; i < 200; ++i) {
    geometry::NurbsCurve circle = testing::nurbs_circle(1.3);
    const double angle = 0.031 * i;
    Eigen::Rotation2Dd rotation(angle);
    for (Vec2& point : circle.control) point = rotation * point + Vec2(0.3, 0.7);
    const CurveFoot foot = closest_point(circle, rotation * Vec2(1.9, 0) + Vec2(0.3, 0.7));
    EXPECT_FALSE(foot.at_end);
    EXPECT_NEAR(foot.squared_distance, 0.36, 1e-14);
    EXPECT_EQ(foot.second_distance, infinity) << i;
  }
}

TEST(PointToCurve, HiddenPairOfMinimaBetweenTwoSamplesIsFound) {
  // a dip far narrower than the sampling: both samples see a rising distance
  const auto jet = [](double x) {
    const double w = 0.3, c = 0.55, e = std::exp(-(x - c) * (x - c) / (w * w));
    const double q = -2 * (x - c) / (w * w);
    return CurveJet<2>{Vec2(0, 4 + x - 0.9 * e), Vec2(0, 1 - 0.9 * e * q),
                       Vec2(0, -0.9 * e * (q * q - 2 / (w * w))),
                       Vec2(0, -0.9 * e * (q * q * q - 6 * q / (w * w)))};
  };
  const CurveFoot foot = closest_on_interval(jet, 0.0, 1.5, 2, Vec2(0, 0));
  double best = infinity;
  for (int i = 0; i <= 150000; ++i) best = std::min(best, jet(1e-5 * i).r.y());
  EXPECT_NEAR(std::sqrt(foot.squared_distance), best, 1e-9);
  EXPECT_FALSE(foot.at_end);
  EXPECT_NEAR(foot.second_distance, jet(0).r.y(), 1e-12);  // the end at lo is the second minimum
  const auto backwards = [&](double x) {
    CurveJet<2> j = jet(1.5 - x);
    j.r1 *= -1;
    j.r3 *= -1;
    return j;
  };
  const CurveFoot mirrored = closest_on_interval(backwards, 0.0, 1.5, 2, Vec2(0, 0));
  EXPECT_NEAR(mirrored.squared_distance, foot.squared_distance, 1e-13);
  EXPECT_NEAR(mirrored.xi, 1.5 - foot.xi, 1e-12);
  EXPECT_NEAR(mirrored.second_distance, foot.second_distance, 1e-12);
}

void expect_status(const CurveFoot& foot, double lo) {
  EXPECT_FALSE(foot.converged);
  EXPECT_TRUE(foot.at_end);
  EXPECT_EQ(foot.xi, lo);
  EXPECT_FALSE(std::isnan(foot.squared_distance));
  EXPECT_FALSE(std::isnan(foot.second_distance));
}

TEST(PointToCurve, DegenerateCurvesGiveAStatus) {
  const Vec2 x(1, 2), p(4, 6);
  expect_status(closest_on_line2(x, x, p), -1);
  EXPECT_EQ(closest_on_line2(x, x, p).squared_distance, 25.0);
  expect_status(closest_point(geometry::lagrange_curve(std::array{x, x, x}), p), -1);
  EXPECT_EQ(closest_point(geometry::lagrange_curve(std::array{x, x, x}), p).squared_distance, 25.0);
  expect_status(closest_point(geometry::Circle{x, 0.0}, p), 0);
  expect_status(closest_point(geometry::Arc{x, 0.0, 0.5, 1.0, true}, p), 0.5);
  expect_status(closest_point(geometry::InfiniteLine{x, Vec2(0, 0)}, p), 0);
  const geometry::NurbsCurve dot{2, {0, 0, 0, 1, 1, 1}, {x, x, x}, {1, 1, 1}};
  expect_status(closest_point(dot, p), 0);
  const auto jet = [&](double) { return CurveJet<2>{x, Vec2(0, 0), Vec2(0, 0), Vec2(0, 0)}; };
  expect_status(closest_from_guess(jet, 0.0, 1.0, 0.5, p), 0);
}

TEST(PointToCurve, NoQueryGivesNaN) {
  const double nan = std::nan("");
  for (const testing::NamedCurve& sample : testing::sample_curves()) {
    SCOPED_TRACE(sample.name);
    const double lo = std::isfinite(geometry::lo(sample.curve)) ? geometry::lo(sample.curve) : 0;
    for (const Vec2& p :
         {Vec2(nan, 0), Vec2(0, infinity), Vec2(-infinity, infinity), Vec2(nan, nan)})
      expect_status(closest_point(sample.curve, p), lo);
    for (double far : {1e3, 1e8, 1e15, 1e60, 1e120}) {
      const CurveFoot foot = closest_point(sample.curve, Vec2(far, -0.3 * far));
      EXPECT_TRUE(foot.converged) << far;
      EXPECT_TRUE(std::isfinite(foot.xi));
      const double distance =
          (geometry::jet(sample.curve, foot.xi).r - Vec2(far, -0.3 * far)).norm();
      EXPECT_NEAR(std::sqrt(foot.squared_distance) / distance, 1.0, 1e-12) << far;
    }
    const CurveFoot beyond = closest_point(sample.curve, Vec2(1e200, 1e200));
    EXPECT_FALSE(std::isnan(beyond.xi) || std::isnan(beyond.squared_distance));
  }
}

}  // namespace
}  // namespace osculate::projection
