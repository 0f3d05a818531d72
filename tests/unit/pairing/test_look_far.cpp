// Evaluations that search only near their points, and what is found for the rest afterwards.
#include <gtest/gtest.h>

#include "own_surface_sample.hpp"

namespace osculate::testing {
namespace {

using contact::Status;

constexpr double height = 0.4, reach = 1;

/// A plate and a second one over it, `gap` at its left end and rising to the right. Facets of 0.25.
PairSample3 plates(cell::CellType type, double gap) {
  PairSample3 s = own_walls(outline({{0, 0}, {0, height}, {6, height}, {6, 0}}, 0.25), type);
  s.pair.filter.own = false;
  s.pair.filter.distance = reach;
  s.pair.filter.thickness.clear();
  const auto count = static_cast<Index>(s.x.size());
  for (Index n = 0; n < count; ++n) {
    const Vec3 low = s.x[static_cast<std::size_t>(n)];
    s.x.push_back(low + Vec3(0.07, height + gap + 0.25 * low.x(), 0.03));
  }
  pairing::FacetSurface upper = s.pair.master;
  for (pairing::SurfaceFacet& facet : upper.facets)
    for (std::size_t k = 0; k < static_cast<std::size_t>(facet.count); ++k) facet.nodes[k] += count;
  pairing::connect(upper);
  s.pair.slave = pairing::make_slave_side(upper);
  pairing::prepare(s.pair, s.x);
  return s;
}

struct Both {
  pairing::PairEvaluation<3> whole, near;
};

/// The slave has gone down by `way` since its places were committed.
Both evaluated(PairSample3& s, double way) {
  const pairing::PairState<3> committed = pairing::initial_state<3>(s.pair, s.x);
  for (const Index n : s.pair.slave.nodes) s.x[static_cast<std::size_t>(n)].y() -= way;
  Both both;
  pairing::evaluate<3>(s.pair, s.x, committed, true, both.whole);
  pairing::ActiveSet<3> near;
  near.near = true;
  pairing::evaluate<3>(s.pair, s.x, committed, true, both.near, near);
  return both;
}

int count(const pairing::PairEvaluation<3>& e, bool touching) {
  int points = 0;
  for (const pairing::PointResult<3>& p : e.points)
    points += (touching ? p.status != Status::open : p.history.facet >= 0) ? 1 : 0;
  return points;
}

void expect_same_contact(const Both& both) {
  for (std::size_t i = 0; i < both.whole.points.size(); ++i) {
    const pairing::PointResult<3>&a = both.whole.points[i], &b = both.near.points[i];
    EXPECT_EQ(a.status, b.status) << i;
    EXPECT_EQ(a.normal_traction, b.normal_traction) << i;
    if (a.status == Status::open) continue;
    EXPECT_EQ(a.history.facet, b.history.facet) << i;
    EXPECT_EQ(both.whole.blocks[i].force, both.near.blocks[i].force) << i;
    EXPECT_EQ(both.whole.blocks[i].tangent, both.near.blocks[i].tangent) << i;
  }
}

void expect_same_places(const Both& both) {
  for (std::size_t i = 0; i < both.whole.points.size(); ++i) {
    const pairing::PointResult<3>&a = both.whole.points[i], &b = both.near.points[i];
    EXPECT_EQ(a.gap, b.gap) << i;
    EXPECT_EQ(a.foot, b.foot) << i;
    EXPECT_EQ(a.weight, b.weight) << i;
    EXPECT_EQ(a.history.facet, b.history.facet) << i;
    EXPECT_EQ(a.history.xi, b.history.xi) << i;
    EXPECT_EQ(a.history.gap, b.history.gap) << i;
    EXPECT_EQ(a.history.feature, b.history.feature) << i;
    EXPECT_EQ(a.history.active, b.history.active) << i;
  }
}

TEST(LookFar, FindsWhatANearEvaluationLeavesOut) {
  for (const cell::CellType type : {cell::CellType::tri3, cell::CellType::quad4})
    for (const double way : {0.0, 0.03, 0.2, 0.6}) {
      PairSample3 s = plates(type, 0.02);
      Both both = evaluated(s, way);
      expect_same_contact(both);
      EXPECT_LT(count(both.near, false), count(both.whole, false)) << way;
      if (way > 0) {
        EXPECT_GT(count(both.near, true), 0) << way;
      }
      pairing::look_far<3>(s.pair, s.x, pairing::initial_state<3>(s.pair, s.x), both.near);
      expect_same_places(both);
    }
}

TEST(LookFar, WhatCameThroughFromFarAwayIsFoundAtOnce) {
  PairSample3 s = plates(cell::CellType::quad4, 0.7 * reach);  // nothing is near
  const Both both = evaluated(s, 0.7 * reach + 0.35);          // almost through the plate
  EXPECT_GT(count(both.whole, true), 10);
  expect_same_contact(both);
}

TEST(LookFar, TheLawsReachIsNear) {
  PairSample3 s = plates(cell::CellType::quad4, 0.7 * reach);
  s.pair.offset = 0.9 * reach;
  const Both both = evaluated(s, 0.0);
  EXPECT_GT(count(both.whole, true), 0);
  expect_same_contact(both);
}

}  // namespace
}  // namespace osculate::testing
