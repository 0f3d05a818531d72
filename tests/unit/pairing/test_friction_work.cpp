// The work that sliding dissipates: against closed forms, against the energy identity of the return
// mapping, over borders of facets, and what opening does to it.
#include <gtest/gtest.h>

#include <cmath>

#include "osculate/pairing/pair.hpp"

namespace osculate::testing {
namespace {

constexpr double eps_n = 1000, eps_t = 80, mu = 0.3, depth = 0.01, limit = mu * eps_n * depth;

/// One slave node on a flat master of two pieces of unequal length; `step` moves it and commits.
template <int Dim>
struct Dragged {
  pairing::PairDefinition<Dim> pair;
  pairing::PairState<Dim> committed;
  std::vector<Vec<Dim>> x;
  Vec<Dim - 1> shear = Vec<Dim - 1>::Zero();

  Dragged();
  void add_slave() {
    const auto slave = static_cast<Index>(x.size());
    x.push_back(Vec<Dim>::Zero());
    pair.slave = pairing::make_slave_side(pairing::Boundary<Dim>{}, std::array<Index, 1>{slave});
    pair.weight = pairing::Weight::node;
    pair.normal = contact::penalty(eps_n);
    pair.friction = contact::coulomb(mu, eps_t);
    pairing::prepare(pair, x);
  }
  void place(const Vec<Dim - 1>& at, double below) { x.back() << at, -below; }
  void start(const Vec<Dim - 1>& at) {
    place(at, depth);
    committed = pairing::initial_state(pair, x);
  }
  double step(const Vec<Dim - 1>& to, double below = depth) {
    place(to, below);
    pairing::PairEvaluation<Dim> e;
    pairing::evaluate(pair, x, committed, false, e);
    committed = pairing::commit(e);
    shear = e.points[0].shear().template head<Dim - 1>();
    return committed.points[0].friction_work;
  }
};

template <>
Dragged<2>::Dragged() : x{{-1, 0}, {0.2, 0}, {1, 0}} {
  for (Index i = 0; i < 2; ++i)
    pair.master.facets.push_back(pairing::lagrange_facet(std::array<Index, 2>{i, i + 1}));
  pairing::connect(pair.master);
  add_slave();
}
template <>
Dragged<3>::Dragged()
    : x{{-1, -1, 0}, {0.2, -1, 0}, {1, -1, 0}, {-1, 1, 0}, {0.1, 1, 0}, {1, 1, 0}} {
  for (Index i = 0; i < 2; ++i)
    pair.master.facets.push_back(pairing::surface_facet(
        cell::CellType::quad4, std::array<Index, 4>{i, i + 1, i + 4, i + 3}));
  pairing::connect(pair.master);
  add_slave();
}

TEST(FrictionWork, ThereAndBackInThePlane) {
  Dragged<2> d;
  const double elastic = limit / eps_t;  // of a point on the verge of sliding
  d.start(Vec<1>(0.0));
  EXPECT_EQ(d.step(Vec<1>(0.9 * elastic)), 0.0);
  double work = 0;
  for (const double at : {0.05, 0.3, 0.45}) work = d.step(Vec<1>(at));
  EXPECT_NEAR(work, limit * (0.45 - elastic), 1e-14);
  EXPECT_EQ(d.step(Vec<1>(0.45 - 1.9 * elastic)), work);  // sticks on the way back
  EXPECT_NEAR(d.step(Vec<1>(-0.3)), limit * (0.45 - elastic + 0.75 - 2 * elastic), 1e-14);
}

TEST(FrictionWork, StaysWhenThePointOpensAndGoesOn) {
  Dragged<2> d;
  d.start(Vec<1>(0.0));
  const double before = d.step(Vec<1>(0.4));
  EXPECT_GT(before, 0.0);
  EXPECT_EQ(d.step(Vec<1>(0.4), -0.02), before);
  EXPECT_EQ(d.step(Vec<1>(5.0), -0.02), before);  // beyond the end: no place on the master
  EXPECT_EQ(d.step(Vec<1>(0.1), -0.02), before);
  d.step(Vec<1>(0.1));
  EXPECT_NEAR(d.step(Vec<1>(0.3)), before + limit * (0.2 - limit / eps_t), 1e-14);
}

TEST(FrictionWork, IsPerAreaTimesTheArea) {
  Dragged<2> d;
  const contact::FrictionLaw& law = *d.pair.friction;
  const Vec<1> trial(2.5 * limit);
  const auto response = contact::response<2>(law, trial, -eps_n * depth, {});
  EXPECT_NEAR(contact::dissipated<2>(trial, response, contact::stiffness(law)),
              limit * 1.5 * limit / eps_t, 1e-15);
  EXPECT_EQ(contact::dissipated<2>(Vec<1>(limit),
                                   contact::response<2>(law, Vec<1>(limit), -eps_n * depth, {}),
                                   contact::stiffness(law)),
            0.0);
  d.pair.weight = pairing::Weight::reference_area;
  d.pair.reference_areas = {0.7};
  d.start(Vec<1>(0.0));
  EXPECT_NEAR(d.step(Vec<1>(0.3)), 0.7 * limit * (0.3 - limit / eps_t), 1e-14);
}

// Backward Euler: t_n+1 . du = (|t_n+1|^2 - |t_n|^2 + |t_n+1 - t_n|^2) / 2 eps_T + dissipated,
// whatever the path; here a loop that crosses the border between the facets at every turn.
TEST(FrictionWork, BalancesTheWorkOfTheTractionAlongALoopInSpace) {
  Dragged<3> d;
  Vec2 at(0.6, 0.0), before = Vec2::Zero();
  d.start(at);
  double supplied = 0, stored = 0, work = 0, path = 0;
  for (int i = 1; i <= 96; ++i) {
    const double angle = 0.2617993877991494 * i;
    const Vec2 to(0.6 * std::cos(angle), 0.5 * std::sin(angle));
    work = d.step(to);
    supplied += d.shear.dot(to - at);
    stored += 0.5 / eps_t *
              (d.shear.squaredNorm() - before.squaredNorm() + (d.shear - before).squaredNorm());
    path += (to - at).norm();
    at = to;
    before = d.shear;
  }
  EXPECT_NEAR(work, supplied - stored, 1e-12);
  EXPECT_GT(work, 0.9 * limit * (path - limit / eps_t));
  EXPECT_LT(work, limit * path);
}

TEST(FrictionWork, OfAStraightWayInSpace) {
  Dragged<3> d;
  d.start({-0.5, -0.4});
  double work = 0;
  for (const double part : {0.1, 0.35, 0.8, 1.0})
    work = d.step({-0.5 + 1.2 * part, -0.4 + 0.9 * part});
  EXPECT_NEAR(work, limit * (1.5 - limit / eps_t), 1e-13);
}

}  // namespace
}  // namespace osculate::testing
