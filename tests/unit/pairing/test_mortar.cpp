// Mortar contact in the plane: balance, uniform pressure, derivatives by order.
#include "osculate/pairing/mortar.hpp"

#include <gtest/gtest.h>

#include "mortar_checks.hpp"
#include "mortar_sample.hpp"

namespace osculate::testing {
namespace {

using contact::Status;
using pairing::Weight;

class MortarLines : public ::testing::TestWithParam<std::tuple<int, int, Weight>> {
 protected:
  static ContactSample<2> sample(MortarOptions2 o) {
    const auto [slave, master, weight] = GetParam();
    o.slave_nodes = slave;
    o.master_nodes = master;
    ContactSample<2> s = make_mortar2(o);
    s.pair.weight = weight;
    return s;
  }
};

TEST_P(MortarLines, TangentIsTheDerivativeOfTheResidual) {
  for (const double bend : {0.0, 0.02}) {
    expect_second_order(sample({.bend = bend, .uneven = 0.2}), 2e-3,
                        "bend " + std::to_string(bend));
  }
}

TEST_P(MortarLines, TangentWhereTheSlaveLeavesTheMaster) {
  expect_second_order(sample({.from = -0.37, .to = 4.41, .depth = 0.1, .bend = 0.01}), 1e-3,
                      "over both ends");
}

TEST_P(MortarLines, ForcesBalance) { expect_balance(sample({.bend = 0.02})); }

// The contact patch test without its bodies.
TEST_P(MortarLines, UniformGapIsUniformPressureOnBothSides) {
  for (const bool longer : {true, false}) {
    expect_uniform_pressure(
        sample({.from = longer ? -0.5 : 0.4, .to = longer ? 4.6 : 3.6, .uneven = 0.2}), longer,
        longer ? 4.0 : 3.2, 1e-11);
  }
}

TEST_P(MortarLines, SidesThatTouchAreInContact) {
  const ContactSample<2> s = sample({.depth = 0});
  for (const Status status : pair_status(s, flatten(s.x))) EXPECT_EQ(status, Status::slip);
}

TEST_P(MortarLines, MatchingMeshes) {
  const ContactSample<2> s = sample({.slave_facets = 3, .master_facets = 3, .from = 0, .to = 4});
  expect_uniform_pressure(s, true, 4.0, 1e-11);
  EXPECT_LT(pair_tangent(s, flatten(s.x)).norm(), 1000 * 4.0 * 10);
}

TEST_P(MortarLines, NothingChangesWithAMotionOfBoth) {
  const ContactSample<2> s = sample({.bend = 0.02});
  const Eigen::VectorXd r = pair_residual(s, flatten(s.x));
  Mat<2, 2> turned;
  turned << std::cos(1.1), -std::sin(1.1), std::sin(1.1), std::cos(1.1);
  std::vector<Vec2> moved;
  for (const Vec2& p : s.x) moved.push_back(turned * p + Vec2(3, -7));
  const Eigen::VectorXd after = pair_residual(s, flatten(moved));
  for (Eigen::Index n = 0; n < r.size() / 2; ++n)
    EXPECT_LT((after.segment<2>(2 * n) - turned * r.segment<2>(2 * n)).norm(), 1e-11 * r.norm());
}

INSTANTIATE_TEST_SUITE_P(All, MortarLines,
                         ::testing::Combine(::testing::Values(2, 3, 4), ::testing::Values(2, 3),
                                            ::testing::Values(Weight::reference_area,
                                                              Weight::current_area)));

// ---- friction -----------------------------------------------------------------------------------

TEST(MortarFriction, TangentInEveryBranch) {
  for (const int slave : {2, 3})
    for (const double mu : {10.0, 0.02})
      for (const double carried : {2.0, -3.0})
        for (const bool active : {true, false}) {
          ContactSample<2> s = make_mortar2({.slave_nodes = slave, .bend = 0.02, .uneven = 0.2});
          s.pair.friction = contact::coulomb(mu, 300.0);
          remember<2>(s, active ? Vec2(0.03, 0.01) : Vec2(0.03, -0.3), Vec<1>(carried), active);
          expect_second_order(s, 5e-4,
                              "mu " + std::to_string(mu) + " carried " + std::to_string(carried));
        }
}

// Sliding by s on a flat master without turning: t = eps_T s, over all borders of facets.
TEST(MortarFriction, SlipIsTheWayAlongTheMaster) {
  for (const int slave : {2, 3})
    for (const double way : {0.01, 1.3}) {
      ContactSample<2> s = make_mortar2({.slave_nodes = slave, .from = 1.6, .to = 2.2, .angle = 0});
      s.pair.friction = contact::coulomb(1e6, 300.0);
      remember<2>(s, Vec2(way, 0), Vec<1>(1.5), true);
      for (const auto& p : pair_evaluation(s, flatten(s.x)).points) {
        EXPECT_NEAR(p.slip_increment[0], way, 1e-12);
        EXPECT_NEAR(p.shear_traction[0], 1.5 + 300 * way, 1e-9);
        EXPECT_NEAR(p.frame(0, 0), 1.0, 1e-12);
      }
    }
}

// Both bodies turn together by a quarter: no slip, and the shear turns with them.
TEST(MortarFriction, NothingSlipsWhenBothTurnTogether) {
  ContactSample<2> s = make_mortar2({.bend = 0.004});
  s.pair.friction = contact::coulomb(1e6, 300.0);
  remember<2>(s, Vec2::Zero(), Vec<1>(1.5), true);
  std::vector<Vec2> moved;
  for (const Vec2& p : s.x) moved.push_back(turn(p) + Vec2(3, -7));
  for (const auto& p : pair_evaluation(s, flatten(moved)).points) {
    EXPECT_NEAR(p.slip_increment[0], 0.0, 1e-12);
    EXPECT_NEAR(p.shear_traction[0], 1.5, 1e-9);
  }
}

// A short slave slides over the corners of a flat master: no jump of any nodal force, and none of
// the total.
TEST(MortarFriction, NoJumpAtCrossingsOnAFlatSurface) {
  for (const int slave : {2, 3}) {
    double largest = 0, total = 0;
    Eigen::VectorXd last;
    for (int i = 0; i <= 400; ++i) {
      ContactSample<2> s = make_mortar2({.slave_nodes = slave, .from = 0.5, .to = 1.3, .angle = 0});
      s.pair.friction = contact::coulomb(0.2, 300.0);
      remember<2>(s, Vec2(0.4, 0), Vec<1>(0.0), true);
      const double way = 1.2 * i / 400;
      for (const Index n : s.pair.slave.nodes) s.x[static_cast<std::size_t>(n)].x() += way;
      const Eigen::VectorXd slaves = slave_forces(s);
      total = slaves.norm();
      if (last.size() > 0) largest = std::max(largest, (slaves - last).norm());
      last = slaves;
    }
    EXPECT_LT(largest, 1e-9 * total);
  }
}

}  // namespace
}  // namespace osculate::testing
