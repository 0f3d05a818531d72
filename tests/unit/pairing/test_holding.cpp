// Points that stay in contact when they are pulled, and contact at a distance.
#include <gtest/gtest.h>

#include "law_sample.hpp"

#include "osculate/contact/law/normal_exponential.hpp"

namespace osculate::testing {
namespace {

using contact::Status;
using pairing::Separation;

/// One node over a flat master along x; `at` puts it to a place and commits.
struct Node {
  pairing::PairDefinition<2> pair;
  std::vector<Vec2> x{{-4, 0}, {4, 0}, {0, 1}};
  pairing::PairState<2> committed;
  pairing::PairEvaluation<2> last;

  Node() {
    pair.master.facets = {pairing::lagrange_facet(std::array<Index, 2>{0, 1})};
    pairing::connect(pair.master);
    pair.slave = pairing::make_slave_side(pairing::Chain{}, std::array<Index, 1>{2});
    pair.weight = pairing::Weight::node;
    pair.normal = contact::penalty(1000);
  }
  void start(double y) {
    x[2] = {0, y};
    pairing::prepare<2>(pair, x);
    committed = pairing::initial_state<2>(pair, x);
  }
  const pairing::PointResult<2>& at(double along, double y, double duration = 0) {
    x[2] = {along, y};
    pairing::ActiveSet<2> active_set;
    active_set.duration = duration;
    pairing::evaluate<2>(pair, x, committed, false, last, active_set);
    committed = pairing::commit(last);
    return last.points[0];
  }
};

TEST(NoSeparation, HoldsWhatHasTouchedAndLetsItSlide) {
  Node node;
  node.pair.separation = pairing::NeverPart{};
  node.start(0.5);
  EXPECT_EQ(node.at(0, 0.2).status, Status::open);  // not yet
  EXPECT_EQ(node.at(0, -0.01).normal_traction, -10);
  EXPECT_EQ(node.at(0, 0.02).normal_traction, 20);
  EXPECT_EQ(node.at(2, 0.03).normal_traction, 30);
  EXPECT_EQ(node.at(2, -0.01).normal_traction, -10);
  node.pair.separation = pairing::MayPart{};
  EXPECT_EQ(node.at(2, 0.03).status, Status::open);
}

TEST(NoSeparation, CoulombHasNoLimitLeftInTension) {
  Node node;
  node.pair.separation = pairing::NeverPart{};
  node.pair.friction = contact::coulomb(0.3, 100);
  node.start(-0.01);
  EXPECT_NEAR(node.at(0.5, -0.01).shear_traction[0], 3, 1e-12);
  EXPECT_EQ(node.at(0.6, 0.01).shear_traction[0], 0);
  EXPECT_EQ(node.last.points[0].normal_traction, 10);
}

TEST(TiedNormal, KeepsTheGapsOfTheStart) {
  Node node;
  node.pair.separation = pairing::TiedNormal{0.1};
  node.start(0.05);
  EXPECT_NEAR(node.at(0, 0.05).normal_traction, 0, 1e-12);
  EXPECT_NEAR(node.at(1, 0.07).normal_traction, 20, 1e-11);
  EXPECT_NEAR(node.at(-2, 0.03).normal_traction, -20, 1e-11);
  EXPECT_TRUE(node.committed.points[0].held);
  Node far;
  far.pair.separation = pairing::TiedNormal{0.1};
  far.start(0.2);
  EXPECT_EQ(far.at(0, -0.1).status, Status::open);  // takes no part
}

TEST(Rough, SticksWhileInContactAndForgetsWhenItOpens) {
  Node node;
  node.pair.friction = rough(100);
  node.start(-1e-6);
  EXPECT_NEAR(node.at(3, -1e-6).shear_traction[0], 300, 1e-9);
  EXPECT_EQ(node.last.points[0].status, Status::stick);
  EXPECT_EQ(node.at(3, 0.1).status, Status::open);
  EXPECT_NEAR(node.at(3, -1e-6).shear_traction[0], 0, 1e-9);
}

// Thick sides touch at the sum of their half thicknesses: the same contact, so much higher.
TEST(Offset, IsTheSameContactFartherAway) {
  Node thin, thick;
  for (Node* const node : {&thin, &thick}) node->pair.friction = contact::coulomb(0.3, 100);
  thick.pair.offset = 0.4;
  thin.start(0.1);
  thick.start(0.5);
  for (const auto& [along, y] : {std::pair(0.0, 0.05), std::pair(0.1, -0.02), std::pair(0.3, -0.03),
                                 std::pair(0.2, 0.01), std::pair(0.2, -0.01)}) {
    const pairing::PointResult<2> a = thin.at(along, y), b = thick.at(along, y + 0.4);
    EXPECT_EQ(a.status, b.status);
    EXPECT_NEAR(a.normal_traction, b.normal_traction, 1e-10);
    EXPECT_NEAR(a.shear_traction[0], b.shear_traction[0], 1e-10);
    EXPECT_NEAR(a.gap, b.gap, 1e-12);
  }
}

// A sharp corner of the master is round for a thick slave.
TEST(Offset, RoundsACorner) {
  PairSample s = make_sample({.facets = 2, .angle = 0.0});
  s.x[0] = {-2, -2};
  s.x[1] = {0, 0};
  s.x[2] = {2, -2};
  s.x[3] = {0.02, 0.38};
  s.x[4] = {-0.98, 0.58};  // the slave looks down
  s.pair.weight = pairing::Weight::node;
  s.pair.offset = 0.4;
  pairing::PairEvaluation<2> e;
  pairing::evaluate(s.pair, s.x, s.committed, false, e);
  EXPECT_EQ(e.points[0].history.feature, projection::Feature::corner);
  EXPECT_NEAR(e.points[0].normal_traction, 1000 * (s.x[3].norm() - 0.4), 1e-10);
}

// With the full residual, moments balance at any distance, with friction too.
TEST(Offset, MomentsBalance) {
  PairSample s = make_sample({.nodes_per_facet = 3, .bend = 0.02, .depth = -0.3});
  s.pair.offset = 0.35;
  s.pair.friction = contact::coulomb(0.3, 80.0);
  s.pair.residual = contact::ResidualForm::full;
  s.committed.points[0] = remembered(true, 1, projection::Feature::face, 0.1, 0.3, 6);
  const Eigen::VectorXd v = flatten(s.x), r = pair_residual(s, v);
  Vec2 force = Vec2::Zero();
  double moment = 0;
  for (Eigen::Index n = 0; n < v.size() / 2; ++n) {
    const Vec2 f = r.segment<2>(2 * n);
    force += f;
    moment += v[2 * n] * f.y() - v[2 * n + 1] * f.x();
  }
  ASSERT_GT(r.norm(), 1);
  EXPECT_LT(force.norm(), 1e-12 * r.norm());
  EXPECT_LT(std::abs(moment), 1e-11 * r.norm());
}

// First contact within the increment: the share of the way counts from where the law begins.
TEST(NormalLaws, FirstContactIsDatedFromTheirReach) {
  for (const bool exponential : {true, false}) {
    Node node;
    node.pair.friction = rough(100);
    if (exponential)
      node.pair.normal = contact::NormalExponential{5, 0.1};
    else
      node.pair.offset = 0.1;
    node.start(0.5);
    // half of the way down to 0.1 - 0.4 is in contact, and so is half of the way along
    EXPECT_NEAR(node.at(0.6, -0.3).shear_traction[0], 100 * 0.3, 1e-10);
  }
}

// Static, then kinetic: the work is the shear times the distance slid, increment by increment.
TEST(ChangingFriction, DissipatesTractionTimesWay) {
  for (const auto by : {ChangeBy::distance, ChangeBy::speed}) {
    Node node;
    node.pair.friction = changing(0.5, 0.2, by, 0.05, 1e4);
    node.start(-0.01);
    double work = 0, last = 0, peak = 0;
    for (int i = 1; i <= 100; ++i) {
      const pairing::PointResult<2>& p = node.at(0.003 * i, -0.01, 0.1);
      work += p.shear_traction[0] * (p.history.slid - last);
      last = p.history.slid;
      peak = std::max(peak, p.shear_traction[0]);
    }
    EXPECT_NEAR(node.committed.points[0].friction_work, work, 1e-12);
    EXPECT_LE(peak, 5.0);
    const bool distance = by == ChangeBy::distance;
    const double a = distance ? last : 0.003 / 0.1;
    EXPECT_NEAR(node.last.points[0].shear_traction[0], 10 * (0.2 + 0.3 * std::exp(-a / 0.05)),
                distance ? 1e-10 : 1e-3);
  }
}

}  // namespace
}  // namespace osculate::testing
