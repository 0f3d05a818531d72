// Damped contact points: their history, the work they dissipate, and what the springs of points
// hold, whatever holds them.
#include <gtest/gtest.h>

#include <cmath>

#include "osculate/contact/law/damping.hpp"
#include "osculate/pairing/pair.hpp"

namespace osculate::testing {
namespace {

constexpr double eps = 1000, area = 0.5;

/// One slave node above a flat master in the plane, on the weight of a node.
struct Falling {
  pairing::PairDefinition<2> pair;
  pairing::PairState<2> committed;
  std::vector<Vec2> x{{-1, 0}, {1, 0}, {0, 0}};
  pairing::PairEvaluation<2> e;

  explicit Falling(const contact::DampingLaw& law) {
    pair.master.facets.push_back(pairing::lagrange_facet(std::array<Index, 2>{0, 1}));
    pairing::connect(pair.master);
    pair.slave = pairing::make_slave_side(pairing::Boundary<2>{}, std::array<Index, 1>{2});
    pair.weight = pairing::Weight::node;
    pair.normal = contact::penalty(eps);
    pair.damping = law;
    pairing::prepare(pair, x);
  }
  void start(double gap) {
    x[2] = {0, gap};
    committed = pairing::initial_state(pair, x);
  }
  /// The pressure at the end of an increment.
  double step(const Vec2& to, double duration = 0.1) {
    x[2] = to;
    pairing::ActiveSet<2> active_set;
    active_set.duration = duration;
    pairing::evaluate(pair, x, committed, false, e, active_set);
    committed = pairing::commit(e);
    return -e.points[0].normal_traction;
  }
  double step(double gap, double duration = 0.1) { return step(Vec2(0, gap), duration); }
  [[nodiscard]] const contact::PointHistory<2>& history() const { return committed.points[0]; }
};

TEST(Damping, RemembersTheDeepestPlaceUntilTheSidesAreApart) {
  Falling f(contact::Restitution{0.5});
  f.start(0.1);
  EXPECT_TRUE(std::isinf(f.history().deepest));
  EXPECT_NEAR(f.step(-0.02), 20, 1e-12);
  EXPECT_NEAR(f.step(-0.04), 40, 1e-12);
  const double work = 0.75 * 0.5 * eps * 0.04 * 0.04;
  EXPECT_NEAR(f.history().damping_work, work, 1e-15);
  EXPECT_NEAR(f.step(-0.035), 20, 1e-12);  // four times as steep
  EXPECT_EQ(f.step(-0.02), 0.0);           // let go, and yet not apart
  EXPECT_EQ(f.e.points[0].status, contact::Status::open);
  EXPECT_EQ(f.history().deepest, -0.04);
  EXPECT_NEAR(f.step(-0.035), 20, 1e-12);
  EXPECT_NEAR(f.step(-0.04), 40, 1e-12);
  EXPECT_NEAR(f.history().damping_work, work, 1e-15);
  EXPECT_EQ(f.step(0.01), 0.0);
  EXPECT_TRUE(std::isinf(f.history().deepest));
  EXPECT_NEAR(f.history().damping_work, work, 1e-15);  // stays
  EXPECT_NEAR(f.step(-0.02), 20, 1e-12);               // anew
  EXPECT_NEAR(f.history().damping_work, 1.25 * work, 1e-15);
}

TEST(Damping, KeepsItsWorkWhereThereIsNoMaster) {
  Falling f(contact::Restitution{0.5});
  f.start(-0.01);
  f.step(-0.02);
  const double work = f.history().damping_work;
  EXPECT_GT(work, 0.0);
  f.step(Vec2(5, -0.02));
  EXPECT_EQ(f.history().damping_work, work);
  EXPECT_TRUE(std::isinf(f.history().deepest));
}

TEST(Damping, ViscousCountsTheWayOfTheIncrement) {
  Falling f(contact::Viscous{50});
  f.start(0.1);
  EXPECT_NEAR(f.step(-0.02), 20 + 50 * 0.02 / 0.1, 1e-12);
  EXPECT_NEAR(f.step(-0.03, 0.2), 30 + 50 * 0.01 / 0.2, 1e-12);
  EXPECT_NEAR(f.history().damping_work, 50 * (0.02 * 0.02 / 0.1 + 0.01 * 0.01 / 0.2), 1e-15);
  EXPECT_NEAR(f.step(-0.03, 0), 30, 1e-12);  // no time is known
  EXPECT_EQ(f.step(-0.01, 0.01), 0.0);       // let go
  EXPECT_NEAR(f.e.points[0].stored, 0.5 * eps * 0.01 * 0.01, 1e-15);
  EXPECT_NEAR(f.step(-0.015, 0.01), 15 + 50 * 0.005 / 0.01, 1e-12);
}

TEST(Damping, SeesTheGapLessTheOffset) {
  Falling f(contact::Viscous{50});
  f.pair.offset = 0.05;
  f.start(0.1);
  EXPECT_NEAR(f.step(0.04), 10 + 50 * 0.01 / 0.1, 1e-12);
  EXPECT_NEAR(f.step(0.03), 20 + 50 * 0.01 / 0.1, 1e-12);
}

/// Two nodes of a facet over a flat master, tied or held in the normal direction, then moved.
pairing::PairEvaluation<2> pulled(const pairing::Separation<2>& separation) {
  pairing::PairDefinition<2> pair;
  std::vector<Vec2> x{{-1, 0}, {1, 0}, {0.25, 0.01}, {-0.25, 0.01}};
  pair.master.facets.push_back(pairing::lagrange_facet(std::array<Index, 2>{0, 1}));
  pairing::connect(pair.master);
  pairing::Boundary<2> slave;
  slave.facets.push_back(pairing::lagrange_facet(std::array<Index, 2>{2, 3}));
  pairing::connect(slave);
  pair.slave = pairing::make_slave_side(slave);
  pair.normal = contact::penalty(eps);
  pair.separation = separation;
  pairing::prepare(pair, x);
  const pairing::PairState<2> state = pairing::initial_state(pair, x);
  for (const std::size_t n : {2u, 3u}) x[n] += Vec2(0.03, 0.02);
  pairing::PairEvaluation<2> e;
  pairing::evaluate(pair, x, state, false, e);
  return e;
}

double held_by(const pairing::PairEvaluation<2>& e) {
  double sum = 0;
  for (const pairing::PointResult<2>& p : e.points) sum += p.weight * p.stored;
  return sum;
}

TEST(StoredEnergy, OfHeldPointsIsThatOfTheirSprings) {
  EXPECT_NEAR(held_by(pulled(pairing::TiedNormal{0.05})), area * 0.5 * eps * 0.02 * 0.02, 1e-14);
  EXPECT_NEAR(held_by(pulled(pairing::Tied<2>{0.05})),
              area * 0.5 * eps * (0.02 * 0.02 + 0.03 * 0.03), 1e-14);
}

TEST(StoredEnergy, LeavesOutTheOverlapThatDoesNotCount) {
  Falling f(contact::Restitution{1});
  f.pair.damping.reset();
  f.pair.overlap = pairing::InitialOverlap::kept;
  f.start(-0.05);
  f.x[2] = {0, -0.07};
  pairing::ActiveSet<2> active_set;
  active_set.relief = 1;
  pairing::evaluate(f.pair, f.x, f.committed, false, f.e, active_set);
  EXPECT_NEAR(f.e.points[0].stored, 0.5 * eps * 0.02 * 0.02, 1e-14);
}

TEST(StoredEnergy, HasTheElasticPartOfTheSlip) {
  Falling f(contact::Restitution{1});
  f.pair.damping.reset();
  f.pair.friction = contact::coulomb(0.3, 80);
  f.start(-0.01);
  f.step(Vec2(0.02, -0.01));
  const double t = 80 * 0.02;
  ASSERT_EQ(f.e.points[0].status, contact::Status::stick);
  EXPECT_NEAR(f.e.points[0].stored, 0.5 * eps * 1e-4 + t * t / (2 * 80), 1e-14);
}

}  // namespace
}  // namespace osculate::testing
