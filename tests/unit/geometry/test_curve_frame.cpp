#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "osculate/geometry/curve_frame.hpp"
#include "osculate/geometry/line2.hpp"
#include "sample_curves.hpp"

namespace osculate::geometry {
namespace {

using testing::check_order;
using testing::finite_range;
using testing::sample_curves;

constexpr double places[] = {0.137, 0.391, 0.618, 0.874};

template <class Body>
void at_places(const Body& body) {
  for (const testing::NamedCurve& sample : sample_curves()) {
    SCOPED_TRACE(sample.name);
    const auto range = finite_range(sample.curve);
    for (double t : places) body(sample.curve, range[0] + t * (range[1] - range[0]));
  }
}

TEST(CurveFrame, TangentAndNormalAreOrthogonalAndTheNormalIsUnit) {
  // [eq:KS2D:6] [eq:KS2D:8] nu = k x rho_xi / |rho_xi|
  at_places([](const Curve& c, double xi) {
    const CurveJet<2> j = jet(c, xi);
    const CurveFrame f = curve_frame(j);
    ASSERT_TRUE(f.valid);
    EXPECT_NEAR(f.normal.norm(), 1.0, 3e-16);
    EXPECT_NEAR(f.normal.dot(f.tangent) / f.sqrt_a11, 0.0, 2e-16);
    const double cross = f.tangent.x() * f.normal.y() - f.tangent.y() * f.normal.x();
    EXPECT_GT(cross, 0.0);  // the normal is on the left: the body is on the right
    EXPECT_EQ(f.a11, j.r1.dot(j.r1));
  });
}

TEST(CurveFrame, ContravariantBasisIsDual) {  // [eq:KS2D:9]
  at_places([](const Curve& c, double xi) {
    const CurveFrame f = curve_frame(jet(c, xi));
    const ContravariantBasis b = contravariant_basis(f);
    EXPECT_NEAR(b.rho1.dot(f.tangent), 1.0, 1e-15);
    EXPECT_NEAR(b.rho2.dot(f.normal), 1.0, 1e-15);
    EXPECT_NEAR(b.rho1.dot(f.normal) * f.sqrt_a11, 0.0, 1e-15);
    EXPECT_NEAR(b.rho2.dot(f.tangent) / f.sqrt_a11, 0.0, 1e-15);
  });
}

TEST(CurveFrame, GaussFormulaGivesTheSecondDerivative) {  // [eq:KS2D:11] [eq:KS2D:12]
  at_places([](const Curve& c, double xi) {
    const CurveJet<2> j = jet(c, xi);
    const CurveFrame f = curve_frame(j);
    EXPECT_LT((gauss_formula(f) - j.r2).norm(), 1e-14 * (1 + j.r2.norm()));
  });
}

TEST(CurveFrame, WeingartenByOrder) {  // [eq:KS2D:16]
  at_places([](const Curve& c, double xi) {
    const auto normal = [&](double x) { return curve_frame(jet(c, x)).normal; };
    const Vec2 exact = weingarten_formula(curve_frame(jet(c, xi)));
    const auto check = check_order(normal, exact, xi, 1e-3);
    EXPECT_TRUE(check.second_order()) << check.error << " order " << check.order;
    // the same with the sign flipped must fail where the curve bends
    if (exact.norm() < 1e-3) return;
    EXPECT_FALSE(check_order(normal, -exact, xi, 1e-3).second_order());
  });
}

TEST(CurveFrame, SerretFrenetByOrderInArcLength) {  // [eq:KS2D:20] [eq:KS2D:21]
  at_places([](const Curve& c, double xi) {
    const CurveFrame f = curve_frame(jet(c, xi));
    const SerretFrenet sf = serret_frenet(f);
    // d/ds = (1/sqrt(a11)) d/dxi  [eq:KS2D:19]
    const auto tau = [&](double x) { return unit_tangent(curve_frame(jet(c, x))); };
    const auto nu = [&](double x) { return curve_frame(jet(c, x)).normal; };
    EXPECT_TRUE(check_order(tau, f.sqrt_a11 * sf.dtau_ds, xi, 1e-3).second_order());
    EXPECT_TRUE(check_order(nu, f.sqrt_a11 * sf.dnu_ds, xi, 1e-3).second_order());
    EXPECT_NEAR(sf.dtau_ds.dot(f.normal), f.kappa, 1e-15 * (1 + std::abs(f.kappa)));
  });
}

TEST(CurveFrame, OffsetTangentByOrder) {  // [eq:KS2D:17] and [eq:KS2D:5]
  at_places([](const Curve& c, double xi) {
    for (double zeta : {-0.3, 0.0, 0.4}) {
      const auto offset = [&](double x) {
        const CurveJet<2> j = jet(c, x);
        return Vec2(j.r + zeta * curve_frame(j).normal);
      };
      const Vec2 exact = offset_tangent(curve_frame(jet(c, xi)), zeta);
      const auto check = check_order(offset, exact, xi, 1e-3);
      EXPECT_TRUE(check.second_order()) << check.error << " order " << check.order;
    }
  });
}

TEST(CurveFrame, OffsetTangentVanishesAtTheCentreOfCurvature) {
  const CurveFrame f = curve_frame(Circle{Vec2(0, 0), 2.5, false}.jet(0.7));
  EXPECT_LT(offset_tangent(f, 1.0 / f.kappa).norm(), 1e-15);
  EXPECT_NEAR(f.kappa, -0.4, 1e-15);  // solid: bends away from nu
}

TEST(CurveFrame, LengthOfACovariantVector) {  // [eq:KS2D:22] [eq:KS2D:23]
  at_places([](const Curve& c, double xi) {
    const CurveFrame f = curve_frame(jet(c, xi));
    const double component = -1.7;
    const Vec2 vector = covariant_vector(f, component);
    EXPECT_NEAR(vector.norm(), covariant_length(f, component), 1e-15 * vector.norm());
    EXPECT_NEAR(vector.dot(f.tangent), component, 1e-15);
  });
}

/// d2xi and so on of xi(eta) = eta + 0.3 eta^2 - 0.1 eta^3 at eta = 0.4
constexpr double dxi = 1 + 0.6 * 0.4 - 0.3 * 0.16;
constexpr double d2xi = 0.6 - 0.6 * 0.4;
constexpr double d3xi = -0.6;

TEST(CurveFrame, TractionOfConstantLengthHasNoCovariantDerivative) {  // [eq:KS2D:100]
  // t is the physical traction, T = t sqrt(a11): along the curve (zeta = 0, zeta. = 0)
  // dT/deta = t d sqrt(a11)/deta = T Gamma
  at_places([](const Curve& c, double xi) {
    const CurveJet<2> arbitrary = reparameterise(jet(c, xi), dxi, d2xi, d3xi);
    for (const CurveJet<2>& j : {jet(c, xi), arbitrary}) {
      const CurveFrame f = curve_frame(j);
      const double t = 2.3, rate = 0.7;
      const double dT = t * j.r1.dot(j.r2) / f.sqrt_a11 * rate;
      EXPECT_NEAR(covariant_rate(f, t * f.sqrt_a11, dT, {rate, 0.0}), 0.0,
                  1e-14 * (1 + std::abs(dT)));
    }
  });
}

TEST(CurveFrame, CovariantRateIsTheTangentPartOfTheVectorsRate) {  // [eq:KS2D:100] normal motion
  // T r^1 with r^1 = rho_xi / (a11 (1 - kappa zeta)) at (xi + xi. t, zeta. t), T = T0 + T. t
  at_places([](const Curve& c, double xi) {
    const double T0 = 1.4, rate_T = -0.6;
    const ConvectiveRates rates{0.8, -0.5};
    const auto vector = [&](double t) {
      const CurveFrame f = curve_frame(jet(c, xi + rates.xi * t));
      return Vec2((T0 + rate_T * t) * f.tangent / (f.a11 * (1 - f.kappa * rates.zeta * t)));
    };
    const CurveFrame f = curve_frame(jet(c, xi));
    const auto component = [&](double t) { return Vec2(vector(t).dot(f.tangent), 0.0); };
    const double exact = covariant_rate(f, T0, rate_T, rates);
    const auto check = check_order(component, Vec2(exact, 0), 0.0, 1e-3);
    EXPECT_TRUE(check.second_order()) << check.error << " order " << check.order;
    // eq. (25) as printed: no T and the opposite sign of the curvature term
    const double printed = rate_T - f.gamma * rates.xi + f.kappa * rates.zeta;
    if (std::abs(printed - exact) > 1e-3) {
      EXPECT_FALSE(check_order(component, Vec2(printed, 0), 0.0, 1e-3).second_order());
    }
  });
}

TEST(CurveFrame, NaturalAndArbitraryParameterAgree) {  // [eq:KS2D:19] [eq:KS2D:21]
  at_places([](const Curve& c, double xi) {
    const CurveJet<2> here = jet(c, xi);
    const CurveFrame f = curve_frame(here);
    const CurveJet<2> natural = natural_jet(here);
    const CurveFrame n = curve_frame(natural);
    EXPECT_NEAR(n.a11, 1.0, 1e-13);
    EXPECT_NEAR(n.gamma, 0.0, 1e-13 * (1 + here.r2.norm() / f.a11));
    const CurveFrame a = curve_frame(reparameterise(here, dxi, d2xi, d3xi));
    for (const CurveFrame& other : {n, a}) {
      EXPECT_NEAR(other.kappa, f.kappa, 1e-13 * (1 + std::abs(f.kappa)));
      EXPECT_LT((other.normal - f.normal).norm(), 1e-13);
      // rate of a traction: the physical value D1T/sqrt(a11) does not depend on the parameter
      EXPECT_NEAR(covariant_length(other, 1.9 * other.sqrt_a11), 1.9, 1e-13);
    }
    // third derivative: rho_sss . tau = -kappa^2 in arc length, whatever the parameter was
    EXPECT_NEAR(natural.r3.dot(natural.r1), -f.kappa * f.kappa,
                1e-12 * (1 + here.r3.norm() / (f.a11 * f.sqrt_a11) + f.kappa * f.kappa +
                         here.r2.squaredNorm() / (f.a11 * f.a11)));
  });
}

TEST(CurveFrame, CovariantRateDoesNotDependOnTheParameter) {  // [eq:KS2D:100] to 1e-13
  at_places([](const Curve& c, double xi) {
    const CurveFrame f = curve_frame(jet(c, xi));
    const CurveFrame g = curve_frame(reparameterise(jet(c, xi), dxi, d2xi, d3xi));
    const double T = 1.3, dT = -0.4, zeta_rate = 0.6, xi_rate = 0.9;
    const double eta_rate = xi_rate / dxi;
    // T_eta = T_xi xi', dT_eta/dt = dT_xi/dt xi' + T_xi xi'' eta.
    const double rate_xi = covariant_rate(f, T, dT, {xi_rate, zeta_rate});
    const double rate_eta =
        covariant_rate(g, T * dxi, dT * dxi + T * d2xi * eta_rate, {eta_rate, zeta_rate});
    EXPECT_NEAR(rate_eta / g.sqrt_a11, rate_xi / f.sqrt_a11,
                1e-13 * (1 + std::abs(rate_xi) / f.sqrt_a11));
  });
}

TEST(CurveFrame, ReparameterisedJetByOrder) {
  const auto map = [](double e) { return e + 0.3 * e * e - 0.1 * e * e * e; };
  const auto at = [&](double e) {
    return reparameterise(testing::bent_line(5).jet(map(e)), 1 + 0.6 * e - 0.3 * e * e,
                          0.6 - 0.6 * e, -0.6);
  };
  const CurveJet<2> j = at(0.4);
  EXPECT_TRUE(check_order([&](double e) { return at(e).r; }, j.r1, 0.4, 1e-2).second_order());
  EXPECT_TRUE(check_order([&](double e) { return at(e).r1; }, j.r2, 0.4, 1e-2).second_order());
  EXPECT_TRUE(check_order([&](double e) { return at(e).r2; }, j.r3, 0.4, 1e-2).second_order());
}

TEST(CurveFrame, DegenerateTangentIsAStatusNotANumber) {
  CurveJet<2> j;
  j.r = {1, 2};
  j.r2 = {3, 4};
  for (const Vec2& bad : {Vec2(0, 0), Vec2(1e-200, 0), Vec2(std::nan(""), 1),
                          Vec2(std::numeric_limits<double>::infinity(), 0)}) {
    j.r1 = bad;
    const CurveFrame f = curve_frame(j);
    EXPECT_FALSE(f.valid);
    EXPECT_EQ(f.normal, Vec2(0, 0));
    EXPECT_EQ(f.kappa, 0.0);
    EXPECT_EQ(covariant_vector(f, 1.0), Vec2(0, 0));
    EXPECT_EQ(unit_tangent(f), Vec2(0, 0));
    EXPECT_EQ(covariant_length(f, 1.0), 0.0);
  }
}

TEST(Line2, ClosedFormsAreTheFrameOfTheSegment) {  // [eq:KS2D:65] [eq:KS2D:66] [eq:KS2D:67]
  const Vec2 x1(0.3, -0.2), x2(1.5, 0.7);
  const CurveFrame f = curve_frame(lagrange_curve(std::array{x1, x2}).jet(0.4));
  EXPECT_LT((line2_tangent(x1, x2) - f.tangent).norm(), 1e-16);
  EXPECT_NEAR(line2_metric(x1, x2), f.a11, 1e-16);
  EXPECT_LT((line2_normal(x1, x2) - f.normal).norm(), 2e-16);
  EXPECT_EQ(f.h11, 0.0);
  EXPECT_EQ(f.gamma, 0.0);
  EXPECT_EQ(line2_normal(x1, x1), Vec2(0, 0));
}

TEST(Line2, PrintedNormalIsNeitherUnitNorOutward) {  // [eq:KS2D:67] as printed
  const Vec2 x1(0, 0), x2(0.5, 0);                   // body below, nodes left to right
  EXPECT_EQ(line2_normal(x1, x2), Vec2(0, 1));
  const double a11 = line2_metric(x1, x2);
  const Vec2 printed = Vec2(x2.y() - x1.y(), x1.x() - x2.x()) / (2 * a11);
  EXPECT_NEAR(printed.squaredNorm(), 1 / a11, 1e-15);
  EXPECT_LT(printed.dot(line2_normal(x1, x2)), 0.0);
}

}  // namespace
}  // namespace osculate::geometry
