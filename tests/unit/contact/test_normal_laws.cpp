// Normal laws beside the penalty: values, joints, derivatives by order, what is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "derivative_check.hpp"
#include "osculate/contact/law/catalogue.hpp"

namespace osculate::contact {
namespace {

constexpr double p0 = 12, c0 = 0.01;
const NormalTable table{{{-0.01, 0}, {0, 5}, {0.02, 5}, {0.05, 80}}};

double pressure(const NormalLaw& law, double gap) { return -response(law, gap).traction; }

TEST(NormalExponential, IsZeroAtTheClearanceAndP0AtZero) {
  const NormalExponential law{p0, c0};
  EXPECT_FALSE(law.response(1.0001 * c0).active);
  EXPECT_TRUE(law.response(c0).active);
  EXPECT_EQ(law.response(c0).traction, 0.0);
  EXPECT_EQ(law.response(c0).d_traction, 0.0);
  EXPECT_NEAR(-law.response(0).traction, p0, 1e-14 * p0);
  constexpr double e = std::numbers::e;
  EXPECT_NEAR(law.response(0).d_traction, p0 / c0 * (2 * e - 1) / (e - 1), 1e-12 * p0 / c0);
  EXPECT_NEAR(-law.response(-c0).traction, p0 * 2 * (e + 1), 1e-13 * p0);
  EXPECT_EQ(onset_gap(law), c0);
  EXPECT_FALSE(augmentable(law));
}

TEST(NormalExponential, GoesOnWithItsTangentAndNeverOverflows) {
  const NormalExponential law{p0, c0};
  const double joint = -6 * c0, h = 1e-9 * c0;
  const NormalResponse below = law.response(joint + h), above = law.response(joint - h);
  EXPECT_NEAR(above.traction / below.traction, 1, 1e-8);
  EXPECT_NEAR(above.d_traction / below.d_traction, 1, 1e-8);
  EXPECT_NEAR((law.response(2 * joint).traction - law.response(joint).traction) / joint,
              law.response(joint).d_traction, 1e-9 * above.d_traction);
  EXPECT_TRUE(std::isfinite(law.response(-1e6).traction));
}

TEST(NormalDecaying, FallsToAHundredthOverEveryClearanceAndEndsAfterThree) {
  const NormalDecaying law{p0, c0};
  const double rest = 1e-6 * p0;
  EXPECT_NEAR(-law.response(0).traction, p0 - rest, 1e-13 * p0);
  EXPECT_NEAR(-law.response(c0).traction, 0.01 * p0 - rest, 1e-13 * p0);
  EXPECT_NEAR(-law.response(-c0).traction, 100 * p0 - rest, 1e-11 * p0);
  EXPECT_EQ(onset_gap(law), 3 * c0);
  EXPECT_TRUE(law.response(3 * c0).active);
  EXPECT_NEAR(law.response(3 * c0).traction, 0, 1e-15 * rest);
  EXPECT_FALSE(law.response(3.0001 * c0).active);
  EXPECT_FALSE(holds(law));
  const double joint = -3 * c0, h = 1e-9 * c0;
  EXPECT_NEAR(law.response(joint - h).d_traction / law.response(joint + h).d_traction, 1, 1e-8);
  EXPECT_NEAR((law.response(2 * joint).traction - law.response(joint).traction) / joint,
              law.response(joint).d_traction, 1e-9 * law.response(joint).d_traction);
  EXPECT_TRUE(std::isfinite(law.response(-1e6).traction));
}

/// Against forces that CalculiX 2.20 printed of two cubes of one length (K = 5000, sigma = 1).
TEST(NormalTensile, IsTheLinearLawOfCalculiX) {
  const NormalTensile law{5000, 1, 0.005};
  const std::vector<std::pair<double, double>> printed{
      {-1e-2, 49.00131},  {-1e-3, 4.107169},  {-1e-4, 0.2751196},   {1e-4, -0.2248804},
      {5e-4, -0.7151127}, {9e-4, -0.8730029}, {1.1e-3, -0.9085679}, {2e-3, -0.9689219}};
  for (const auto& [gap, p] : printed) EXPECT_NEAR(pressure(law, gap) / p, 1, 1e-7) << gap;
  EXPECT_EQ(pressure(law, 0), 0);
  EXPECT_NEAR(law.response(0).d_traction, 2500, 1e-12);
  EXPECT_TRUE(law.response(0.005).active);
  EXPECT_FALSE(law.response(0.0050001).active);
  EXPECT_EQ(stored_energy(law, 0.0050001), 0.0);
  EXPECT_FALSE(holds(law));
  EXPECT_FALSE(augmentable(law));
  EXPECT_NEAR(pressure(law, -1e6), 5e9 - 1, 1e-3) << "nothing overflows";
  EXPECT_EQ(fault(NormalLaw(NormalTensile{1, 0, 1})), "normal_tensile: tension must be > 0, got 0");
}

TEST(NormalTable, RunsThroughItsPointsAndOnBeyondTheLast) {
  EXPECT_FALSE(table.response(0.0100001).active);
  EXPECT_TRUE(table.response(0.01).active);
  for (const auto& [h, p] : table.points) EXPECT_NEAR(pressure(table, -h), p, 1e-12);
  EXPECT_NEAR(pressure(table, 0.005), 2.5, 1e-12);
  EXPECT_NEAR(pressure(table, -0.01), 5, 1e-12);
  EXPECT_NEAR(pressure(table, -0.08), 155, 1e-11);
  EXPECT_EQ(table.response(-0.01).d_traction, 0.0);
  EXPECT_EQ(onset_gap(NormalLaw(table)), 0.01);
}

/// A point that comes in at constant speed gets the same impulse wherever in a time step it
/// touches, and a linear law is its own mean.
TEST(NormalLaws, GiveTheSameImpulseWhereverInAStepTheyBegin) {
  constexpr double way = 0.3 * c0;
  for (const NormalLaw& law :
       {NormalLaw(NormalPenalty{400}), NormalLaw(NormalExponential{p0, c0}), NormalLaw(table)}) {
    SCOPED_TRACE(text(law));
    const double end = -3 * c0;
    const double whole = stored_energy(law, end);
    for (const double phase : {0.0, 0.2, 0.5, 0.9}) {
      const double first = onset_gap(law) + way * (0.5 + phase);
      double sum = 0, gap = first;
      for (; gap - 0.5 * way > end; gap -= way) sum -= way * mean_response(law, gap, way).traction;
      sum += stored_energy(law, end) - stored_energy(law, gap + 0.5 * way);
      EXPECT_NEAR(sum / whole, 1, 1e-12);
    }
    EXPECT_FALSE(mean_response(law, onset_gap(law) + 0.51 * way, way).active);
    EXPECT_TRUE(mean_response(law, onset_gap(law) + 0.49 * way, way).active);
  }
  const NormalLaw linear(NormalPenalty{400});
  EXPECT_NEAR(mean_response(linear, -c0, way).traction, response(linear, -c0).traction, 1e-12);
  EXPECT_NEAR(mean_response(linear, -c0, way).d_traction, 400, 1e-9);
}

// The stored energy is that of the pressure: none at the first touch, and -dU/dgap = p, inside
// every piece of the law and held points included.
TEST(NormalLaws, StoreTheWorkOfTheirPressure) {
  using osculate::testing::check_derivative;
  const auto one = [](double value) -> Eigen::VectorXd {
    return Eigen::VectorXd::Constant(1, value);
  };
  const auto expect = [&](const NormalLaw& law, double gap, double h) {
    const auto energy = [&](const Eigen::VectorXd& g) -> Eigen::VectorXd {
      return Eigen::VectorXd::Constant(1, stored_energy(law, g[0], gap > onset_gap(law)));
    };
    const Eigen::VectorXd slope = one(response(law, gap, gap > onset_gap(law)).traction);
    const auto r = check_derivative(energy, slope, one(gap), one(1), h);
    EXPECT_TRUE(r.exact || r.error < 1e-9 || std::abs(r.order - 2) < 0.1)
        << gap << " order " << r.order << " error " << r.error;
  };
  for (const double gap : {0.7 * c0, 0.1 * c0, -2 * c0, -5.5 * c0, -9 * c0})
    expect(NormalExponential{p0, c0}, gap, 0.1 * c0);
  for (const double gap : {2.7 * c0, 0.1 * c0, -2 * c0, -9 * c0})
    expect(NormalDecaying{p0, c0}, gap, 0.05 * c0);
  for (const double gap : {0.9 * c0, 0.1 * c0, -0.2 * c0, -5 * c0})
    expect(NormalTensile{p0 / c0, 0.3 * p0, c0}, gap, 0.05 * c0);
  for (const double gap : {0.006, -0.01, -0.03, -0.09}) expect(table, gap, 1e-3);
  for (const double gap : {-0.3, 0.2}) expect(NormalPenalty{100.0}, gap, 1e-2);
  EXPECT_EQ(stored_energy(NormalExponential{p0, c0}, c0), 0.0);
  EXPECT_EQ(stored_energy(NormalDecaying{p0, c0}, 3 * c0), 0.0);
  EXPECT_EQ(stored_energy(table, 0.01), 0.0);
  EXPECT_EQ(stored_energy(NormalPenalty{100.0}, 0.1), 0.0);
}

// The pressure never jumps and never falls with the overclosure.
TEST(NormalLaws, AreContinuousAndMonotone) {
  for (const NormalLaw& law :
       {NormalLaw(NormalExponential{p0, c0}), NormalLaw(table), NormalLaw(NormalPenalty{100.0})}) {
    double last = 0;
    for (int i = -2000; i <= 9000; ++i) {
      const double p = pressure(law, -1e-5 * i);
      EXPECT_GE(p, last - 1e-12);
      EXPECT_LE(p - last, 1e-5 * 1.01 * response(law, -1e-5 * i).d_traction + 0.026 + 0.01 * p);
      last = p;
    }
  }
}

TEST(NormalLaws, DerivativesAreOfSecondOrder) {
  for (const NormalLaw& law :
       {NormalLaw(NormalExponential{p0, c0}), NormalLaw(NormalDecaying{p0, c0}),
        NormalLaw(NormalTensile{p0 / c0, 0.3 * p0, c0})})
    for (const double gap : {0.9 * c0, 0.1 * c0, -0.7 * c0, -2.9 * c0}) {
      using V = Eigen::VectorXd;
      const auto f = [&](const V& g) { return V::Constant(1, response(law, g[0]).traction); };
      const testing::DerivativeReport r =
          testing::check_derivative(f, V(V::Constant(1, response(law, gap).d_traction)),
                                    V(V::Constant(1, gap)), V(V::Constant(1, 1.0)), 0.02 * c0);
      EXPECT_NEAR(r.order, 2, 0.1) << text(law) << gap;
    }
  for (const double gap : {0.005, -0.01, -0.03, -0.2}) {
    constexpr double h = 1e-4;
    const double slope =
        (table.response(gap + h).traction - table.response(gap - h).traction) / (2 * h);
    EXPECT_NEAR(slope, table.response(gap).d_traction, 1e-8) << gap;
  }
}

TEST(NormalLaws, OnlyThePenaltyHoldsWhatIsPulled) {
  EXPECT_EQ(response(NormalPenalty{1000}, 0.01, true).traction, 10.0);
  EXPECT_TRUE(response(NormalPenalty{1000}, 0.01, true).active);
  EXPECT_FALSE(response(NormalPenalty{1000}, 0.01).active);
  EXPECT_TRUE(holds(NormalPenalty{1}));
  EXPECT_TRUE(augmentable(NormalPenalty{1}));
  EXPECT_FALSE(holds(NormalExponential{1, 1}));
  EXPECT_FALSE(holds(table));
}

TEST(NormalLaws, SayWhatIsWrongWithThem) {
  EXPECT_EQ(fault(NormalLaw(NormalPenalty{2})), "");
  EXPECT_EQ(fault(NormalLaw(table)), "");
  EXPECT_EQ(fault(NormalLaw(NormalExponential{p0, c0})), "");
  EXPECT_EQ(fault(NormalLaw(NormalPenalty{0})), "normal_penalty must be > 0, got 0");
  EXPECT_EQ(fault(NormalLaw(NormalExponential{1, 0})),
            "normal_exponential: clearance must be > 0, got 0");
  EXPECT_EQ(fault(NormalLaw(NormalTable{})), "a table of pressures needs at least two points");
  EXPECT_EQ(fault(NormalLaw(NormalTable{{{0, 1}, {1, 2}}})),
            "the first pressure of the table must be 0");
  EXPECT_EQ(fault(NormalLaw(NormalTable{{{0, 0}, {0, 2}}})), "overclosures must grow: 0 follows 0");
  EXPECT_EQ(fault(NormalLaw(NormalTable{{{0, 0}, {1, 2}, {2, 1}}})),
            "pressures must not fall: 1 follows 2");
  EXPECT_EQ(fault(NormalLaw(NormalTable{{{0, 0}, {1, 0}}})), "the table has no pressure > 0");
  EXPECT_EQ(fault(NormalLaw(NormalTable{{{0, 0}, {1, INFINITY}}})),
            "normal_table must be finite, got inf");
}

TEST(NormalLaws, SayTheirNumbersInAFewWords) {
  EXPECT_EQ(text(NormalLaw(NormalPenalty{400}).stiffened(0.5)), "penalty 200");
  EXPECT_EQ(text(NormalLaw(NormalExponential{12, 0.01})), "exponential 12 within 0.01");
  EXPECT_EQ(text(NormalLaw(table)), "table of 4 points");
}

TEST(NormalLaws, StiffnessIsThatOfTheLinearOnes) {
  EXPECT_EQ(penalty_of(with_stiffness(NormalLaw(NormalPenalty{400}), 7)), 7);
  EXPECT_EQ(penalty_of(with_stiffness(NormalLaw(table), 7)), 0);
}

}  // namespace
}  // namespace osculate::contact
