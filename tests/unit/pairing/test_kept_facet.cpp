// A point that goes back and forth over a border of the master keeps its facet.
#include <gtest/gtest.h>

#include "pair_sample.hpp"

namespace osculate::testing {
namespace {

/// A ridge at the origin, the slave point under its right side, `ahead` to the right of the ridge.
PairSample ridge(double ahead) {
  PairSample s = make_sample({.facets = 2, .angle = 0.0});
  s.x[0] = {-1, -0.1};
  s.x[1] = {0, 0};
  s.x[2] = {1, -0.1};
  s.x[3] = {ahead, -0.05};
  s.pair.weight = pairing::Weight::node;
  const std::vector<Index> point{3};
  s.pair.slave = pairing::make_slave_side(pairing::Chain{}, point);
  s.committed.points.resize(1);
  pairing::prepare<2>(s.pair, s.x);
  return s;
}

pairing::ActiveSet<2> that_changed(Index facet, int times) {
  pairing::ActiveSet<2> active_set;
  active_set.branch.resize(1);
  active_set.branch[0].facet = facet;
  active_set.branch[0].changes = times;
  return active_set;
}

Index facet_with(const PairSample& s, const pairing::ActiveSet<2>& active_set) {
  pairing::PairEvaluation<2> e;
  pairing::evaluate<2>(s.pair, s.x, s.committed, true, e, active_set);
  return e.points[0].history.facet;
}

TEST(KeptFacet, IsContinuedALittle) {
  const PairSample s = ridge(0.01);
  EXPECT_EQ(facet_with(s, {}), 1);
  EXPECT_EQ(facet_with(s, that_changed(0, 5)), 1);
  EXPECT_EQ(facet_with(s, that_changed(0, 6)), 0);
  pairing::PairEvaluation<2> e;
  pairing::evaluate<2>(s.pair, s.x, s.committed, true, e, that_changed(0, 6));
  EXPECT_GT(e.points[0].history.xi[0], 1);
  const Vec2 n = turn(Vec2(s.x[1] - s.x[0]).normalized());
  EXPECT_NEAR(e.points[0].gap, n.dot(s.x[3] - s.x[1]), 1e-15);
}

TEST(KeptFacet, IsLeftByAPointThatMovesOn) {
  EXPECT_EQ(facet_with(ridge(0.3), that_changed(0, 6)), 1);
}

/// The count belongs to the iterations of one increment.
TEST(KeptFacet, ChangesAreCounted) {
  pairing::ActiveSet<2> active_set;
  for (int i = 0; i < 8; ++i) {
    const PairSample s = ridge(i % 2 == 0 ? 0.01 : -0.01);
    pairing::PairEvaluation<2> e;
    pairing::evaluate<2>(s.pair, s.x, s.committed, true, e, active_set);
    active_set = pairing::evaluated_active_set<2>(e, active_set);
    EXPECT_EQ(active_set.branch[0].changes, std::min(i, 6));
    EXPECT_EQ(active_set.branch[0].facet, i < 6 ? (i % 2 == 0 ? 1 : 0) : 1);
  }
}

/// Where the master hardly bends a facet is kept at its border from the first change on.
TEST(KeptFacet, IsKeptAtOnceWhereTheMasterHardlyBends) {
  for (const double fall : {1e-3, 1e-5}) {  // the bend is twice that
    PairSample s = ridge(0.01);
    s.x[0][1] = s.x[2][1] = -fall;
    EXPECT_EQ(facet_with(s, {}), 1);
    EXPECT_EQ(facet_with(s, that_changed(0, 1)), fall < 1e-4 ? 0 : 1);
    s.x[3][0] = 0.3;  // it moves on
    EXPECT_EQ(facet_with(s, that_changed(0, 1)), 1);
  }
}

TEST(KeptFacet, InSpace) {
  PairSample3 s = make_sample3({.at = 1, .xi = {0.99, 0.1}, .depth = 0.05, .kink = -0.1});
  s.pair.weight = pairing::Weight::node;
  pairing::PairEvaluation<3> e;
  pairing::evaluate<3>(s.pair, s.x, s.committed, true, e);
  const Index here = e.points[0].history.facet;
  pairing::ActiveSet<3> active_set;
  active_set.branch.resize(4);
  for (Index other = 0; other < static_cast<Index>(s.pair.master.facets.size()); ++other) {
    active_set.branch[0].facet = other;
    active_set.branch[0].changes = 6;
    pairing::evaluate<3>(s.pair, s.x, s.committed, true, e, active_set);
    if (other == here) continue;
    const bool near = e.points[0].history.facet == other;
    EXPECT_TRUE(near || e.points[0].history.facet == here);
    if (near) {
      EXPECT_EQ(e.points[0].history.feature, projection::Feature::face);
    }
  }
}

}  // namespace
}  // namespace osculate::testing
