// Mortar contact in space: balance, uniform pressure, derivatives by order.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "mortar_checks.hpp"
#include "mortar_sample3.hpp"

namespace osculate::testing {
namespace {

using cell::CellType;
using contact::Status;
using pairing::Weight;

class MortarFacets : public ::testing::TestWithParam<std::tuple<CellType, CellType, Weight>> {};

TEST_P(MortarFacets, TangentIsTheDerivativeOfTheResidual) {
  const auto [slave, master, weight] = GetParam();
  MortarSample<3> s = make_mortar3({.slave = slave,
                                    .master = master,
                                    .slave_cells = 1,
                                    .master_cells = 2,
                                    .depth = 0.15,
                                    .skew = 0.1,
                                    .bend = 0.02});
  s.pair.weight = weight;
  expect_second_order(s, 2e-3, "inside");
}

TEST_P(MortarFacets, TangentWhereTheSlaveLeavesTheMaster) {
  const auto [slave, master, weight] = GetParam();
  MortarSample<3> s = make_mortar3({.slave = slave,
                                    .master = master,
                                    .slave_cells = 2,
                                    .master_cells = 1,
                                    .from = -0.33,
                                    .to = 3.27,
                                    .depth = 0.2,
                                    .skew = 0.05,
                                    .bend = 0.005});
  s.pair.weight = weight;
  expect_second_order(s, 2e-3, "over the border");
}

TEST_P(MortarFacets, ForcesBalance) {
  const auto [slave, master, weight] = GetParam();
  MortarSample<3> s = make_mortar3({.slave = slave, .master = master, .skew = 0.1, .bend = 0.02});
  s.pair.weight = weight;
  expect_balance(s);
}

// A uniform gap between flat surfaces gives the nodal forces of a uniform pressure on both sides,
// whichever is wholly covered: the contact patch test without its bodies.
TEST_P(MortarFacets, UniformGapIsUniformPressureOnBothSides) {
  const auto [slave, master, weight] = GetParam();
  for (const bool longer : {true, false})
    for (const double skew : {0.0, 0.15}) {
      MortarSample<3> s = make_mortar3({.slave = slave,
                                        .master = master,
                                        .slave_cells = 3,
                                        .master_cells = 2,
                                        .from = longer ? -0.4 : 0.4,
                                        .to = longer ? 3.3 : 2.7,
                                        .skew = skew,
                                        .keep_border = true});
      s.pair.weight = weight;
      expect_uniform_pressure(s, longer, longer ? 9.0 : 2.3 * 2.3, 1e-10);
    }
}

// The same mesh on both sides: every edge lies on one of the other side.
TEST_P(MortarFacets, MatchingMeshes) {
  const auto [slave, master, weight] = GetParam();
  MortarSample<3> s = make_mortar3(
      {.slave = slave, .master = master, .slave_cells = 2, .master_cells = 2, .from = 0, .to = 3});
  s.pair.weight = weight;
  expect_uniform_pressure(s, true, 9.0, 1e-10);
  const Eigen::MatrixXd k = mortar_tangent(s, flat<3>(s.x));
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

}  // namespace
}  // namespace osculate::testing
