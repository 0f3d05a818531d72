// Damping of normal contact: values, what is stored and dissipated, derivatives by order, what an
// impact leaves of the speed.
#include <gtest/gtest.h>

#include <cmath>

#include "derivative_check.hpp"
#include "osculate/contact/law/catalogue.hpp"

namespace osculate::contact {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
const NormalPenalty spring{1000};
const NormalExponential exponential{12, 0.01};
const NormalTable table{{{-0.01, 0}, {0, 5}, {0.02, 5}, {0.05, 80}}};

Eigen::VectorXd one(double value) { return Eigen::VectorXd::Constant(1, value); }

/// `value(gap)` has the derivative `slope`, by the order of the error.
template <class F>
void expect_slope(F&& value, double slope, double gap, double h) {
  const auto f = [&](const Eigen::VectorXd& g) { return one(value(g[0])); };
  const auto r = osculate::testing::check_derivative(f, one(slope), one(gap), one(1), h);
  EXPECT_TRUE(r.exact || r.error < 1e-9 || std::abs(r.order - 2) < 0.1)
      << gap << " order " << r.order << " error " << r.error;
}

TEST(Viscous, AddsADamperToTheSpring) {
  const DampingLaw law = Viscous{50};
  const NormalResponse closing = damped(law, spring, -0.03, {-0.01, infinity, 0.1});
  EXPECT_NEAR(closing.traction, -30 - 50 * 0.02 / 0.1, 1e-12);
  EXPECT_NEAR(closing.d_traction, 1000 + 50 / 0.1, 1e-12);
  EXPECT_NEAR(closing.stored, 0.5 * 1000 * 0.03 * 0.03, 1e-15);
  EXPECT_NEAR(closing.dissipated, 50 * 0.02 / 0.1 * 0.02, 1e-15);
  const NormalResponse opening = damped(law, spring, -0.03, {-0.05, infinity, 0.1});
  EXPECT_NEAR(opening.traction, -30 + 50 * 0.02 / 0.1, 1e-12);
  EXPECT_NEAR(opening.dissipated, 50 * 0.02 / 0.1 * 0.02, 1e-15);
}

TEST(Viscous, BeginsAtZeroWhereTheContactDoes) {
  const DampingLaw law = Viscous{50};
  for (const NormalLaw& normal : {NormalLaw(spring), NormalLaw(exponential), NormalLaw(table)}) {
    const double touch = onset_gap(normal);
    EXPECT_EQ(damped(law, normal, touch, {touch + 0.3, infinity, 0.1}).traction, 0.0);
    EXPECT_FALSE(damped(law, normal, touch + 1e-9, {touch + 0.3, infinity, 0.1}).active);
    // Only the way within the reach counts.
    const NormalResponse r = damped(law, normal, touch - 0.02, {touch + 0.3, infinity, 0.1});
    EXPECT_NEAR(r.traction, response(normal, touch - 0.02).traction - 50 * 0.02 / 0.1, 1e-12);
  }
}

TEST(Viscous, NeverPullsAndTakesWhatTheSpringHad) {
  const DampingLaw law = Viscous{50};
  const Closing fast{-0.2, infinity, 0.01};
  const NormalResponse gone = damped(law, spring, -0.1, fast);
  EXPECT_FALSE(gone.active);
  EXPECT_EQ(gone.traction, 0.0);
  EXPECT_EQ(gone.d_traction, 0.0);
  EXPECT_NEAR(gone.stored, 0.5 * 1000 * 0.01, 1e-15);     // the surfaces have not caught up
  EXPECT_NEAR(gone.dissipated, 1000 * 0.1 * 0.1, 1e-12);  // by the spring's own force
  const double lets_go = -0.2 * 50 / (50 + 1000 * 0.01);  // where spring and damper are even
  EXPECT_LT(damped(law, spring, lets_go - 1e-9, fast).traction, 0.0);
  EXPECT_NEAR(damped(law, spring, lets_go - 1e-9, fast).traction, 0, 1e-4);
  EXPECT_FALSE(damped(law, spring, lets_go + 1e-9, fast).active);
}

TEST(Viscous, IsTheSpringWithoutATime) {
  const NormalResponse r = damped(Viscous{50}, spring, -0.03, {0.1, infinity, 0});
  EXPECT_EQ(r.traction, spring.response(-0.03).traction);
  EXPECT_EQ(r.d_traction, 1000);
  EXPECT_EQ(r.dissipated, 0.0);
}

TEST(Viscous, HasItsDerivativeInEveryBranch) {
  for (const NormalLaw& normal : {NormalLaw(spring), NormalLaw(exponential), NormalLaw(table)})
    for (const double from : {0.3, -0.004, -0.012}) {
      const Closing closing{from, infinity, 0.1};
      const auto traction = [&](double gap) {
        return damped(Viscous{2}, normal, gap, closing).traction;
      };
      const NormalResponse r = damped(Viscous{2}, normal, -0.006, closing);
      ASSERT_TRUE(r.active);
      expect_slope(traction, r.d_traction, -0.006, 1e-3);
    }
}

TEST(Restitution, LoadsAsTheLawAndReturnsItsShareOfTheWork) {
  constexpr double e = 0.6;
  for (const NormalLaw& normal : {NormalLaw(spring), NormalLaw(exponential), NormalLaw(table)}) {
    const double touch = onset_gap(normal), deepest = touch - 0.04;
    const NormalResponse loaded = damped(Restitution{e}, normal, deepest, {1, infinity, 0});
    const double work = stored_energy(normal, deepest);
    EXPECT_EQ(loaded.traction, response(normal, deepest).traction);
    EXPECT_NEAR(loaded.stored, e * e * work, 1e-14);
    EXPECT_NEAR(loaded.dissipated, (1 - e * e) * work, 1e-14);
    EXPECT_EQ(loaded.deepest, deepest);
    // The way back, by Simpson's rule on pieces between the corners of the law.
    double back = 0;
    constexpr int pieces = 4000;
    const double h = (touch - deepest) * e * e / pieces;
    const auto pressure = [&](double gap) {
      return -damped(Restitution{e}, normal, gap, {deepest, deepest, 0}).traction;
    };
    for (int i = 0; i < pieces; ++i) {
      const double a = deepest + i * h;
      back += h / 6 * (pressure(a) + 4 * pressure(a + 0.5 * h) + pressure(a + h));
    }
    EXPECT_NEAR(back, e * e * work, 1e-6 * work);
  }
}

TEST(Restitution, LetsGoBeforeItIsApartAndRemembersUntilThen) {
  constexpr double e = 0.5;
  const DampingLaw law = Restitution{e};
  const double deepest = -0.04, free = deepest * (1 - e * e);
  const Closing back{deepest, deepest, 0};
  EXPECT_TRUE(damped(law, spring, free - 1e-12, back).active);
  const NormalResponse gone = damped(law, spring, free + 1e-6, back);
  EXPECT_FALSE(gone.active);
  EXPECT_EQ(gone.stored, 0.0);
  EXPECT_EQ(gone.deepest, deepest);
  // Back again it follows the way it came, up to where it was, and then the law.
  EXPECT_EQ(damped(law, spring, -0.035, {free + 1e-6, deepest, 0}).traction,
            damped(law, spring, -0.035, back).traction);
  EXPECT_NEAR(damped(law, spring, deepest + 1e-12, back).traction, -40, 1e-8);
  EXPECT_EQ(damped(law, spring, -0.05, back).traction, -50.0);
  EXPECT_NEAR(damped(law, spring, -0.05, back).dissipated,
              (1 - e * e) * 0.5 * 1000 * (0.05 * 0.05 - 0.04 * 0.04), 1e-14);
  EXPECT_EQ(damped(law, spring, 1e-9, back).deepest, infinity);
}

TEST(Restitution, OfOneIsTheLawAndOfZeroAlmostNothing) {
  for (const double gap : {-0.01, -0.03, -0.05}) {
    const NormalResponse r = damped(Restitution{1}, spring, gap, {0, -0.04, 0.1});
    EXPECT_NEAR(r.traction, 1000 * gap, 1e-12);
    EXPECT_NEAR(r.d_traction, 1000, 1e-12);
    EXPECT_NEAR(r.dissipated, 0, 1e-15);
  }
  EXPECT_EQ(damped(Restitution{0}, spring, -0.0399999, {0, -0.04, 0}).traction,
            damped(Restitution{Restitution::least}, spring, -0.0399999, {0, -0.04, 0}).traction);
}

// Traction = d(stored + dissipated)/d(gap) in every branch: nothing is lost or made, and the
// tangent is its derivative.
TEST(Restitution, IsTheDerivativeOfWhatItStoresAndDissipates) {
  for (const NormalLaw& normal : {NormalLaw(spring), NormalLaw(exponential), NormalLaw(table)})
    for (const double gap : {-0.006, -0.013, -0.036}) {
      const Closing closing{0, -0.014, 0};
      const auto at = [&](double g) { return damped(Restitution{0.9}, normal, g, closing); };
      expect_slope([&](double g) { return at(g).stored + at(g).dissipated; }, at(gap).traction, gap,
                   4e-4);
      expect_slope([&](double g) { return at(g).traction; }, at(gap).d_traction, gap, 4e-4);
    }
}

TEST(Restitution, NeverPullsAndNeverFallsWithThePenetration) {
  for (const NormalLaw& normal : {NormalLaw(spring), NormalLaw(exponential), NormalLaw(table)})
    for (const double e : {0.0, 0.3, 0.8}) {
      double last = 0;
      for (int i = 0; i <= 2000; ++i) {
        const double gap = 0.02 - i * 4e-5;
        const double n = damped(Restitution{e}, normal, gap, {0, -0.04, 0}).traction;
        EXPECT_LE(n, last + 1e-12) << gap;
        last = n;
      }
    }
}

TEST(Damping, SaysWhatIsWrongAndHowSteepItIs) {
  EXPECT_EQ(fault(DampingLaw(Viscous{0})), "");
  EXPECT_EQ(fault(DampingLaw(Viscous{-1})), "damping_viscous must be >= 0, got -1");
  EXPECT_NE(fault(DampingLaw(Viscous{infinity})), "");
  EXPECT_EQ(fault(DampingLaw(Restitution{0})), "");
  EXPECT_EQ(fault(DampingLaw(Restitution{1.01})),
            "damping_restitution must be >= 0 and <= 1, got 1.01");
  EXPECT_NE(fault(DampingLaw(Restitution{std::nan("")})), "");
  EXPECT_TRUE(needs_duration(DampingLaw(Viscous{1})));
  EXPECT_FALSE(needs_duration(DampingLaw(Restitution{1})));
  EXPECT_EQ(stiffest(Viscous{5}, 100, 0.1), 150);
  EXPECT_EQ(damper(Viscous{5}), 5);
  EXPECT_EQ(damper(Restitution{0.5}), 0);
  EXPECT_EQ(stiffest(Viscous{5}, 100, 0), 100);
  EXPECT_EQ(stiffest(Restitution{0.5}, 100, 0.1), 400);
}

}  // namespace
}  // namespace osculate::contact
