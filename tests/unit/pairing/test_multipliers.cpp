// Tractions that are unknowns or corrected: derivatives by their order, and what corrections do.
#include <gtest/gtest.h>

#include "expect_derivative.hpp"
#include "mortar_sample.hpp"
#include "multiplier_sample.hpp"
#include "pair_sample.hpp"

namespace osculate::testing {
namespace {

using contact::Multiplier;
using contact::Status;

template <int Dim>
void expect_second_order(const MultiplierSample<Dim>& s, Status expected, const std::string& what,
                         double h = 2e-3) {
  SCOPED_TRACE(what);
  const Eigen::VectorXd v = s.packed();
  const auto branch = [&](const Eigen::VectorXd& y) {
    const pairing::PairEvaluation<Dim> e = s.evaluation(y, false);
    return std::pair(states<Dim>(e), e.mortar.overlaps);
  };
  const std::vector<Status> here = branch(v).first;
  ASSERT_NE(std::find(here.begin(), here.end(), expected), here.end());
  expect_derivative([&](const Eigen::VectorXd& y) { return s.residual(y); }, s.tangent(v), branch,
                    v, h);
}

template <int Dim>
void expect_friction_branches(ContactSample<Dim>& s, double h = 2e-3) {
  s.pair.friction = contact::coulomb(10.0, 80.0);
  expect_second_order(unknown_tractions<Dim>(s, -90, 9), Status::stick, "stick", h);
  s.pair.friction = contact::coulomb(0.02, 80.0);
  expect_second_order(unknown_tractions<Dim>(s, -90, 9), Status::slip, "slip", h);
}

TEST(MultiplierTangent, PlaneInEveryBranch) {
  for (const int nodes : {2, 3})
    for (const auto weight :
         {pairing::Weight::node, pairing::Weight::reference_area, pairing::Weight::current_area})
      for (const double depth : {0.03, -0.03})  // in front of the master the traction still acts
        for (const int from : {0, 1}) {
          PairSample s = make_sample(
              {.nodes_per_facet = nodes, .bend = nodes > 2 ? 0.02 : 0.0, .depth = depth});
          s.pair.weight = weight;
          s.committed.points[0] =
              remembered(true, from, projection::Feature::face, from ? 0.1 : 0.8, -0.01, 0, 0);
          expect_second_order(unknown_tractions<2>(s, -90, 0), Status::slip, "frictionless");
          expect_second_order(unknown_tractions<2>(s, 70, 0), Status::open, "open");
          expect_friction_branches(s);
          expect_second_order(unknown_tractions<2>(s, -90, -90), Status::slip, "slip back");
        }
}

TEST(MultiplierTangent, SpaceInEveryBranch) {
  for (const cell::CellType type : {cell::CellType::quad4, cell::CellType::tri6})
    for (const auto weight : {pairing::Weight::node, pairing::Weight::current_area}) {
      PairSample3 s = make_sample3({.type = type, .xi = {0.2, 0.3}, .depth = 0.03});
      s.pair.weight = weight;
      s.committed = pairing::initial_state<3>(s.pair, s.x);
      s.committed.points[0].xi += Vec2(0.07, -0.05);
      expect_second_order(unknown_tractions<3>(s, -90, 0), Status::slip, "frictionless", 1e-3);
      expect_friction_branches(s, 1e-3);
    }
}

TEST(MultiplierTangent, MortarInEveryBranch) {
  ContactSample<2> s = make_mortar2({.bend = 0.01});
  remember<2>(s, Vec2(0.05, 0), Vec<1>::Zero(), true);
  expect_second_order(unknown_tractions<2>(s, -90, 0), Status::slip, "frictionless", 1e-4);
  expect_friction_branches(s, 1e-4);
}

TEST(MultiplierTangent, MortarInSpace) {
  ContactSample<3> s = make_mortar3({});
  remember<3>(s, Vec3(0.05, 0.02, 0), Vec2::Zero(), true);
  expect_friction_branches(s, 1e-4);
}

TEST(MultiplierTangent, FrictionlessIsSymmetric) {
  const PairSample s = make_sample({.nodes_per_facet = 3, .bend = 0.02});
  const MultiplierSample<2> m = unknown_tractions<2>(s, -90, 0);
  const Eigen::MatrixXd k = m.tangent(m.packed());
  EXPECT_LT((k - k.transpose()).norm(), 1e-13 * k.norm());
}

/// The constraint of a closed point is its gap, that of an open one its multiplier.
TEST(Multipliers, ConstraintsAreGapAndSlip) {
  PairSample s = make_sample({.depth = 0.03});
  s.pair.weight = pairing::Weight::node;
  s.pair.friction = contact::coulomb(10.0, 80.0);
  s.committed = pairing::initial_state<2>(s.pair, s.x);
  const MultiplierSample<2> m = unknown_tractions<2>(s, -90, 0);
  const pairing::PairEvaluation<2> e = m.evaluation(m.packed(), false);
  ASSERT_EQ(e.points[0].status, Status::stick);
  EXPECT_NEAR(e.blocks[0].constraint.normal, 1000 * -0.03, 1e-11);
  ASSERT_EQ(e.points[1].status, Status::open);
  EXPECT_NEAR(e.blocks[1].constraint.normal, 90, 1e-12);
}

/// A spring pushes a point against a wall: f = k u + N = 0. Corrections bring the gap below any
/// target; the penalty grows where it is too soft for that.
TEST(Augmentation, ReachesTheTargetWhateverThePenalty) {
  PairSample s = make_sample({.angle = 0, .depth = 0});
  s.pair.weight = pairing::Weight::node;
  s.pair.enforcement = pairing::ByAugmentedLagrange{};
  const std::vector<Vec2> start = s.x;
  constexpr double spring = 100, load = 5, target = 1e-9;
  for (const double penalty : {1e-2, 1e0, 1e2, 1e4, 1e6}) {
    s.pair.normal = contact::penalty(penalty);
    pairing::PairMultipliers<2> m = pairing::initial_multipliers<2>(s.pair, s.committed);
    pairing::PairEvaluation<2> e;
    double gap = 0;
    int corrections = 0;
    for (; corrections < 40; ++corrections) {
      const double stiffness = m.stiffening * penalty;
      gap = (-load - m.points[0].normal) / (spring + stiffness);
      s.x = start;
      s.x[s.x.size() - 2].y() += gap;
      pairing::evaluate<2>(s.pair, s.x, s.committed, false, e, {}, &m);
      const pairing::PairMultipliers<2> next = pairing::augmented<2>(s.pair, e, m);
      m = next;
      if (m.violation < target) break;
    }
    EXPECT_LT(std::abs(gap), 1e-8) << penalty;
    EXPECT_NEAR(e.points[0].normal_traction, -load, 1e-6) << penalty;
    EXPECT_LT(corrections, 30) << penalty;
  }
}

}  // namespace
}  // namespace osculate::testing
