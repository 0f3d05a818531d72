// Mortar contact in space: balance, uniform pressure, derivatives by order.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "mortar_checks.hpp"
#include "mortar_sample.hpp"

namespace osculate::testing {
namespace {

using cell::CellType;
using contact::Status;
using pairing::Weight;

class MortarFacets : public ::testing::TestWithParam<std::tuple<CellType, CellType, Weight>> {
 protected:
  static ContactSample<3> sample(MortarOptions3 o) {
    const auto [slave, master, weight] = GetParam();
    o.slave = slave;
    o.master = master;
    ContactSample<3> s = make_mortar3(o);
    s.pair.weight = weight;
    return s;
  }
};

TEST_P(MortarFacets, TangentIsTheDerivativeOfTheResidual) {
  expect_second_order(
      sample({.slave_cells = 1, .master_cells = 2, .depth = 0.15, .skew = 0.1, .bend = 0.02}), 2e-3,
      "inside");
}

TEST_P(MortarFacets, TangentWhereTheSlaveLeavesTheMaster) {
  expect_second_order(sample({.slave_cells = 2,
                              .master_cells = 1,
                              .from = -0.33,
                              .to = 3.27,
                              .depth = 0.2,
                              .skew = 0.05,
                              .bend = 0.005}),
                      2e-3, "over the border");
}

TEST_P(MortarFacets, ForcesBalance) { expect_balance(sample({.skew = 0.1, .bend = 0.02})); }

// A uniform gap between flat surfaces gives the nodal forces of a uniform pressure on both sides,
// whichever is wholly covered: the contact patch test without its bodies.
TEST_P(MortarFacets, UniformGapIsUniformPressureOnBothSides) {
  for (const bool longer : {true, false})
    for (const double skew : {0.0, 0.15}) {
      expect_uniform_pressure(sample({.slave_cells = 3,
                                      .master_cells = 2,
                                      .from = longer ? -0.4 : 0.4,
                                      .to = longer ? 3.3 : 2.7,
                                      .skew = skew,
                                      .keep_border = true}),
                              longer, longer ? 9.0 : 2.3 * 2.3, 1e-10);
    }
}

// Without a gap all nodes are in contact, whatever the sums leave of it.
TEST_P(MortarFacets, SidesThatTouchAreInContact) {
  const ContactSample<3> s = sample({.depth = 0, .skew = 0.1, .keep_border = true});
  for (const Status status : pair_status(s, flatten(s.x))) EXPECT_EQ(status, Status::slip);
}

// The same mesh on both sides: every edge lies on one of the other side.
TEST_P(MortarFacets, MatchingMeshes) {
  const ContactSample<3> s = sample({.slave_cells = 2, .master_cells = 2, .from = 0, .to = 3});
  expect_uniform_pressure(s, true, 9.0, 1e-10);
  const Eigen::MatrixXd k = pair_tangent(s, flatten(s.x));
  EXPECT_TRUE(k.allFinite());
  EXPECT_LT(k.norm(), 1000 * 9.0 * 20);
}

INSTANTIATE_TEST_SUITE_P(
    All, MortarFacets,
    ::testing::Combine(::testing::Values(CellType::tri3, CellType::quad4, CellType::tri6,
                                         CellType::quad8, CellType::quad9),
                       ::testing::Values(CellType::tri3, CellType::quad4, CellType::tri6,
                                         CellType::quad9),
                       ::testing::Values(Weight::reference_area, Weight::current_area)));

// ---- friction -----------------------------------------------------------------------------------

class MortarShear : public ::testing::TestWithParam<CellType> {};

TEST_P(MortarShear, TangentInEveryBranch) {
  for (const double mu : {10.0, 0.002})
    for (const bool active : {true, false}) {
      ContactSample<3> s = make_mortar3({.slave = GetParam(),
                                         .slave_cells = 1,
                                         .master_cells = 2,
                                         .depth = 0.15,
                                         .skew = 0.1,
                                         .bend = 0.02});
      s.pair.friction = contact::coulomb(mu, 300.0);
      const Vec3 shift = turn_of({0.4, -0.3, 0.2}) * Vec3(0.03, -0.02, active ? 0.01 : -0.5);
      remember<3>(s, shift, Vec2(2.0, -3.0), active);
      expect_second_order(s, 1e-3, "mu " + std::to_string(mu));
    }
}

// On a flat master without turning the slip is the way, over all borders of facets.
TEST_P(MortarShear, SlipIsTheWayAlongTheMaster) {
  ContactSample<3> s =
      make_mortar3({.slave = GetParam(), .slave_cells = 1, .from = 1.6, .to = 2.2});
  s.pair.friction = contact::coulomb(1e6, 300.0);
  const Vec3 way = turn_of({0.4, -0.3, 0.2}) * Vec3(0.9, 0.5, 0);
  remember<3>(s, way, Vec2(1.5, -0.5), true);
  for (const auto& p : pair_evaluation(s, flatten(s.x)).points) {
    EXPECT_LT((p.frame * p.slip_increment - way).norm(), 1e-11);
    EXPECT_LT((p.shear_traction - Vec2(1.5, -0.5) - 300 * p.slip_increment).norm(), 1e-9);
    EXPECT_LT((p.frame.transpose() * p.frame - Mat<2, 2>::Identity()).norm(), 1e-14);
    EXPECT_LT((p.frame.col(0).cross(p.frame.col(1)) - p.normal).norm(), 1e-13);
  }
}

TEST_P(MortarShear, NothingSlipsWhenBothTurnTogether) {
  ContactSample<3> s =
      make_mortar3({.slave = GetParam(), .depth = 0.15, .skew = 0.1, .bend = 0.01});
  s.pair.friction = contact::coulomb(1e6, 300.0);
  remember<3>(s, Vec3::Zero(), Vec2(1.5, -0.5), true);
  const Eigen::VectorXd r = pair_residual(s, flatten(s.x));
  const Mat<3, 3> turned = turn_of({1.0, 0.5, -2.0});
  std::vector<Vec3> moved;
  for (const Vec3& p : s.x) moved.push_back(turned * p + Vec3(3, -7, 1));
  const Eigen::VectorXd after = pair_residual(s, flatten(moved));
  for (const auto& p : pair_evaluation(s, flatten(moved)).points)
    EXPECT_LT(p.slip_increment.norm(), 1e-11);
  for (Eigen::Index n = 0; n < r.size() / 3; ++n)
    EXPECT_LT((after.segment<3>(3 * n) - turned * r.segment<3>(3 * n)).norm(), 1e-10 * r.norm());
}

// The slave slides over corners and edges of a flat, skewed master: no slave force changes.
TEST_P(MortarShear, NoJumpAtCrossingsOnAFlatSurface) {
  ContactSample<3> s = make_mortar3({.slave = GetParam(),
                                     .slave_cells = 1,
                                     .master_cells = 4,
                                     .from = 0.4,
                                     .to = 1.1,
                                     .skew = 0.05,
                                     .keep_border = true});
  const Vec3 step = turn_of({0.4, -0.3, 0.2}) * Vec3(0.023, 0.037, 0);
  const Eigen::VectorXd first = slave_forces(s);
  for (int i = 0; i < 40; ++i) {
    for (const Index n : s.pair.slave.nodes) s.x[static_cast<std::size_t>(n)] += step;
    EXPECT_LT((slave_forces(s) - first).norm(), 1e-9 * first.norm()) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(All, MortarShear,
                         ::testing::Values(CellType::tri3, CellType::quad4, CellType::tri6,
                                           CellType::quad8, CellType::quad9));

}  // namespace
}  // namespace osculate::testing
