// Derivative of the contact residual in space by convergence order, in every branch.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include "pair_checks.hpp"

namespace osculate::testing {
namespace {

using cell::CellType;
using contact::ResidualForm;
using contact::Status;
using pairing::Weight;
using projection::Feature;

constexpr std::array<CellType, 5> types{CellType::tri3, CellType::tri6, CellType::quad4,
                                        CellType::quad8, CellType::quad9};

struct Branch {
  Status status;
  double mu;
  Vec2 carried;  ///< traction of the last increment
};

const std::array<Branch, 3> branches{{{Status::stick, 10.0, {4.0, -3.0}},
                                      {Status::slip, 0.02, {4.0, -3.0}},
                                      {Status::slip, 0.02, {-2.0, 5.0}}}};

class Pair3Tangent
    : public ::testing::TestWithParam<std::tuple<CellType, double, ResidualForm, Weight>> {};

// [eq:KSVD:23] [eq:KSVD:33] [eq:KSVD:55] [eq:KS2D:28] [eq:KS2D:39] [eq:KS2D:45]
TEST_P(Pair3Tangent, IsTheDerivativeOfTheResidual) {
  const auto [type, depth, form, weight] = GetParam();
  const bool triangle = cell::is_triangle(type);
  for (const Branch& branch : branches)
    for (const Index from : {0, 1, 2}) {  // facet of the last increment
      SampleOptions3 o{.type = type, .bend = 0.03, .depth = depth};
      if (triangle) o.at = 2, o.xi = {0.3, 0.4};
      PairSample3 s = make_sample3(o);
      s.pair.friction = contact::coulomb(branch.mu, 80.0);
      s.pair.residual = form;
      s.pair.weight = weight;
      const Index facet = triangle ? from + 1 : from;
      const Vec2 xi = triangle ? Vec2(0.25, 0.5) : from == 1 ? Vec2(0.1, -0.1) : Vec2(0.4, 0.2);
      s.committed.points[0] = remembered(facet, xi, -0.01, branch.carried);
      SCOPED_TRACE(std::string(cell::info(type).name) + " from facet " + std::to_string(facet) +
                   " mu " + std::to_string(branch.mu));
      expect_pair_tangent(s, branch.status, Feature::face, 1e-3);
    }
}

INSTANTIATE_TEST_SUITE_P(
    AllForms, Pair3Tangent,
    ::testing::Combine(::testing::ValuesIn(types), ::testing::Values(0.02, 0.2),
                       ::testing::Values(ResidualForm::surface, ResidualForm::full),
                       ::testing::Values(Weight::node, Weight::reference_area,
                                         Weight::current_area)));

TEST(Pair3TangentBranches, FrictionlessIsSymmetric) {
  for (const CellType type : types) {
    SampleOptions3 o{.type = type, .bend = 0.03};
    if (cell::is_triangle(type)) o.at = 2, o.xi = {0.3, 0.4};
    const PairSample3 s = make_sample3(o);
    SCOPED_TRACE(cell::info(type).name);
    expect_pair_tangent(s, Status::slip, Feature::face, 1e-3);
    expect_symmetric_tangent(s);
  }
}

TEST(Pair3TangentBranches, FirstContactInsideTheIncrement) {
  for (const double mu : {10.0, 0.005}) {
    PairSample3 s = make_sample3({.bend = 0.02});
    s.pair.friction = contact::coulomb(mu, 80.0);
    s.committed.points[0] = remembered(1, {0.1, -0.1}, 0.03, {0, 0}, false);
    SCOPED_TRACE("mu " + std::to_string(mu));
    expect_pair_tangent(s, mu > 1 ? Status::stick : Status::slip, Feature::face, 1e-3);
  }
}

/// The strip is folded up at x = 4: a point under the fold is nearest to the edge.
PairSample3 reentrant(CellType type, double mu, ResidualForm form) {
  PairSample3 s = make_sample3({.type = type, .kink = 1.2});
  s.x[s.x.size() - 4] = {4.02, 0.3, -0.1};
  s.pair.friction = contact::coulomb(mu, 80.0);
  s.pair.weight = Weight::node;
  s.pair.residual = form;
  s.committed.points[0] = remembered(1, {0.9, 0.25}, -0.01, {2.0, 1.0});
  return s;
}

TEST(Pair3TangentBranches, EdgeOfAValley) {
  for (const CellType type : {CellType::quad4, CellType::quad9})
    for (const double mu : {10.0, 0.02})
      for (const ResidualForm form : {ResidualForm::surface, ResidualForm::full}) {
        SCOPED_TRACE("mu " + std::to_string(mu));
        expect_pair_tangent(reentrant(type, mu, form), mu > 1 ? Status::stick : Status::slip,
                            Feature::edge, 1e-3);
      }
}

/// Three facets of an inner corner (a room seen from inside) and a point beyond it.
PairSample3 inner_corner(double mu) {
  PairSample3 s;
  s.x = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  const auto add = [&](const std::array<Index, 4>& nodes) {
    s.pair.master.facets.push_back(pairing::surface_facet(CellType::quad4, nodes));
  };
  add({0, 1, 2, 3});  // floor, +z
  add({0, 4, 5, 1});  // wall, +y
  add({0, 3, 6, 4});  // wall, +x
  // more of the corner's surroundings, so that its borders are inside the surface
  s.x.push_back({-0.03, -0.05, -0.04});
  make_last_node_slave(s);
  s.pair.friction = contact::coulomb(mu, 80.0);
  s.committed.points[0] = remembered(0, {-0.9, -0.95}, -0.01, {2.0, 1.0});
  return s;
}

TEST(Pair3TangentBranches, InnerCorner) {
  for (const double mu : {10.0, 0.02}) {
    SCOPED_TRACE("mu " + std::to_string(mu));
    expect_pair_tangent(inner_corner(mu), mu > 1 ? Status::stick : Status::slip, Feature::corner,
                        1e-3);
  }
}

TEST(Pair3TangentBranches, OpenPointsGiveNothing) {
  const PairSample3 s = make_sample3({.depth = -0.05});
  const Eigen::VectorXd v = flatten(s.x);
  EXPECT_EQ(pair_residual(s, v).norm(), 0.0);
  EXPECT_EQ(pair_tangent(s, v).norm(), 0.0);
}

}  // namespace
}  // namespace osculate::testing
