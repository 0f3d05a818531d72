// Derivative of the contact residual by convergence order, in every branch.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include "pair_checks.hpp"

namespace osculate::testing {
namespace {

using contact::ResidualForm;
using contact::Status;
using pairing::Weight;
using projection::Feature;

struct Branch {
  Status status;
  double mu;
  double carried;  ///< traction of the last increment
};

class PairTangent : public ::testing::TestWithParam<std::tuple<int, double, ResidualForm, Weight>> {
};

// [eq:KS2D:27] [eq:KS2D:28] [eq:KS2D:31] [eq:KS2D:32] [eq:KS2D:39] [eq:KS2D:45] [eq:KS2D:57]
// [eq:KS2D:60] [eq:KS2D:77] [eq:KS2D:89]
TEST_P(PairTangent, IsTheDerivativeOfTheResidual) {
  const auto [nodes, depth, form, weight] = GetParam();
  for (const Branch& branch : {Branch{Status::stick, 10.0, 7.0}, Branch{Status::slip, 0.01, 7.0},
                               Branch{Status::slip, 0.01, -7.0}})
    for (const int from : {0, 1, 2}) {  // facet of the last increment: behind, the same, ahead
      PairSample s =
          make_sample({.nodes_per_facet = nodes, .bend = nodes > 2 ? 0.02 : 0.0, .depth = depth});
      s.pair.friction = contact::coulomb(branch.mu, 80.0);
      s.pair.residual = form;
      s.pair.weight = weight;
      const double xi = from == 0 ? 0.8 : from == 1 ? 0.1 : -0.9;
      s.committed.points[0] = remembered(true, from, Feature::face, xi, -0.01, branch.carried, 0);
      SCOPED_TRACE("from facet " + std::to_string(from) + " mu " + std::to_string(branch.mu));
      expect_pair_tangent(s, branch.status, Feature::face, 2e-3);
    }
}

INSTANTIATE_TEST_SUITE_P(
    AllForms, PairTangent,
    ::testing::Combine(::testing::Values(2, 3, 4), ::testing::Values(0.02, 0.3),
                       ::testing::Values(ResidualForm::surface, ResidualForm::full),
                       ::testing::Values(Weight::node, Weight::reference_area,
                                         Weight::current_area)));

TEST(PairTangentBranches, FrictionlessStraightAndCurved) {
  for (const int nodes : {2, 3, 4}) {
    const PairSample s = make_sample({.nodes_per_facet = nodes, .bend = nodes > 2 ? 0.02 : 0.0});
    SCOPED_TRACE("frictionless " + std::to_string(nodes));
    expect_pair_tangent(s, Status::slip, Feature::face, 2e-3);
    expect_symmetric_tangent(s);
  }
}

TEST(PairTangentBranches, FirstContactInsideTheIncrement) {
  for (const double mu : {10.0, 0.02}) {
    PairSample s = make_sample({});
    s.pair.friction = contact::coulomb(mu, 80.0);
    s.committed.points[0] = remembered(false, 1, Feature::face, 0.1, 0.03, 0, 0);
    SCOPED_TRACE("mu " + std::to_string(mu));
    expect_pair_tangent(s, mu > 1 ? Status::stick : Status::slip, Feature::face, 2e-3);
  }
}

/// A re-entrant vertex between two facets: the penetrating point is nearest to the vertex.
PairSample reentrant_sample(double mu, double carried) {
  PairSample s = make_sample({.facets = 2, .angle = 0.0});
  s.x[0] = {-1, 1};
  s.x[1] = {0, 0};
  s.x[2] = {2, 1.5};
  s.x[3] = {0.02, -0.11};
  s.pair.friction = contact::coulomb(mu, 80.0);
  s.committed.points[0] = remembered(true, 0, Feature::face, 0.9, -0.01, carried, 0);
  return s;
}

TEST(PairTangentBranches, CornerInTheValley) {
  for (const double mu : {10.0, 0.02})
    for (const ResidualForm form : {ResidualForm::surface, ResidualForm::full}) {
      PairSample s = reentrant_sample(mu, 5.0);
      s.pair.weight = Weight::node;
      s.pair.residual = form;
      pairing::PairEvaluation<2> e;
      pairing::evaluate(s.pair, s.x, s.committed, true, e);
      ASSERT_NEAR(e.points[0].gap, -s.x[3].norm(), 1e-15);
      SCOPED_TRACE("mu " + std::to_string(mu));
      expect_pair_tangent(s, mu > 1 ? Status::stick : Status::slip, Feature::corner, 2e-3);
    }
}

TEST(PairTangentBranches, OpenPointsGiveNothing) {
  const PairSample s = make_sample({.depth = -0.05});
  const Eigen::VectorXd v = flatten(s.x);
  EXPECT_EQ(pair_residual(s, v).norm(), 0.0);
  EXPECT_EQ(pair_tangent(s, v).norm(), 0.0);
}

// [eq:KS2D:54] [eq:KS2D:56] [eq:KS2D:58] the covariant tangent, part by part.
TEST(CovariantTangent, PartsHaveTheirExactProperties) {
  for (const int nodes : {2, 3})
    for (const double mu : {10.0, 0.02}) {
      PairSample s = make_sample({.nodes_per_facet = nodes, .bend = nodes > 2 ? 0.02 : 0.0});
      s.pair.friction = contact::coulomb(mu, 80.0);
      s.committed.points[0] = remembered(true, 1, Feature::face, 0.1, -0.01, 5, 0);
      const Eigen::VectorXd v = flatten(s.x);
      const auto part = [&](bool main, bool rotational, bool curvature) {
        s.pair.tangent = {false, main, rotational, curvature};
        return pair_tangent(s, v);
      };
      const Eigen::MatrixXd main = part(true, false, false), rotational = part(false, true, false),
                            curvature = part(false, false, true), all = part(true, true, true);
      EXPECT_LT((main + rotational + curvature - all).norm(), 1e-13 * all.norm());
      EXPECT_EQ(curvature.norm() == 0.0, nodes == 2);
      EXPECT_LE(Eigen::FullPivLU<Eigen::MatrixXd>(main).rank(), 2);
      const double skew = (all - all.transpose()).norm() / all.norm();
      EXPECT_EQ(skew<1e-14, mu> 1) << skew;  // symmetric in stick only
      s.pair.tangent = {};
      const Eigen::MatrixXd exact = pair_tangent(s, v);
      EXPECT_LT((all - exact).norm(), 0.2 * exact.norm());
      EXPECT_GT((all - exact).norm(), 1e-6 * exact.norm());
    }
}

// The first error of the covariant normal tangent is O(zeta^2): 100 times smaller per decade.
TEST(CovariantTangent, NormalPartIsExactToFirstOrderInTheGap) {
  std::vector<double> error;
  for (const double depth : {1e-2, 1e-3}) {
    PairSample s = make_sample({.nodes_per_facet = 3, .bend = 0.02, .depth = depth});
    s.pair.tangent = {};
    const Eigen::MatrixXd exact = pair_tangent(s, flatten(s.x));
    s.pair.tangent = {false, true, true, true};
    error.push_back((pair_tangent(s, flatten(s.x)) - exact).norm());
  }
  EXPECT_NEAR(std::log10(error[0] / error[1]), 2.0, 0.05);
}

}  // namespace
}  // namespace osculate::testing
