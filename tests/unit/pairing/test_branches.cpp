// Branches of the friction law between iterations: prediction, reversal, branch force.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "derivative_check.hpp"
#include "pair_sample.hpp"

namespace osculate::testing {
namespace {

using contact::Branch;
using contact::Status;
using pairing::ActiveSet;
using pairing::PairEvaluation;

constexpr double eps_n = 1000, eps_t = 80, mu = 0.3, depth = 0.01;
constexpr double limit = mu * eps_n * depth;

/// One slave node on a straight segment of length 4, committed at x = 2 with the traction t there.
PairSample at_rest(double traction, bool slipping) {
  PairSample s;
  s.x = {{0, 0}, {4, 0}, {2, -depth}};
  s.pair.master = line_through(2);
  make_last_node_slave(s);
  s.pair.normal = contact::penalty(eps_n);
  s.pair.friction = contact::coulomb(mu, eps_t);
  s.committed = pairing::initial_state(s.pair, s.x);
  s.committed.points[0].traction[0] = traction;
  s.committed.points[0].slipping = slipping;
  return s;
}

PairEvaluation<2> evaluated(const PairSample& s, const ActiveSet<2>& active_set) {
  PairEvaluation<2> e;
  pairing::evaluate(s.pair, s.x, s.committed, true, e, active_set);
  return e;
}

/// The branches of a point on a master along +x.
using ActiveBranch = pairing::ActiveBranch<2>;
const ActiveBranch none{}, stick{Branch::stick, Vec2::Zero()};
const ActiveBranch slip_forward{Branch::slip, Vec2(1, 0)}, slip_backward{Branch::slip, Vec2(-1, 0)};

ActiveSet<2> assume(const ActiveBranch& branch, bool predict) { return {{branch}, predict}; }

void expect_branch(const ActiveBranch& found, const ActiveBranch& expected) {
  EXPECT_EQ(found.branch, expected.branch);
  EXPECT_EQ(found.direction, expected.direction);
}

/// The tangent of the block is the derivative of its branch force, not of its force.
void expect_tangent_of_branch_force(const PairSample& s, const ActiveSet<2>& active_set) {
  const PairEvaluation<2> e = evaluated(s, active_set);
  const pairing::ContactBlock<2>& b = e.blocks[0];
  Eigen::VectorXd d(6);
  d << 0.3, -0.7, 0.2, 0.5, -0.4, 0.6;
  Eigen::VectorXd along(6);  // in the block's order of nodes: slave, first, second
  along << d.segment<2>(4), d.segment<2>(0), d.segment<2>(2);
  Eigen::VectorXd expected = b.tangent.topLeftCorner<6, 6>() * along;
  for (const pairing::NodeMatrix<2>& g : b.path())
    expected += b.path_rows.topRows<6>() * (g.value * d.segment<2>(2 * g.node));
  const auto branch_force = [&](const Eigen::VectorXd& v) {
    PairSample moved = s;
    moved.x = unflatten<2>(v);
    return Eigen::VectorXd(evaluated(moved, active_set).blocks[0].branch_force.head<6>());
  };
  const DerivativeReport r = check_derivative(branch_force, expected, flatten(s.x), d, 1e-3);
  EXPECT_TRUE(std::abs(r.order - 2) < 0.1) << r.order << " " << r.error;
}

TEST(Branches, CommittedBranchesPredictThatSlippingGoesOn) {
  pairing::PairState<2> state;
  state.points.resize(4);
  state.points[1].active = state.points[2].active = state.points[3].active = true;
  state.points[2].slipping = state.points[3].slipping = true;
  state.points[2].traction[0] = 1, state.points[3].traction[0] = -1;
  for (auto& point : state.points) point.facet = 0;
  const PairSample s = at_rest(0.0, false);
  const ActiveSet<2> active_set = pairing::committed_active_set<2>(s.pair, state, s.x);
  EXPECT_TRUE(active_set.predict);
  expect_branch(active_set.branch[0], none);
  expect_branch(active_set.branch[1], stick);
  expect_branch(active_set.branch[2], slip_forward);
  expect_branch(active_set.branch[3], slip_backward);
}

TEST(Branches, EvaluatedBranchesAreThoseOfTheTangent) {
  PairSample s = at_rest(limit, true);
  s.x[2].x() += 1e-3;
  const PairEvaluation<2> e = evaluated(s, {});
  expect_branch(e.points[0].branch, slip_forward);
  const ActiveSet<2> next = pairing::evaluated_active_set(e);
  EXPECT_FALSE(next.predict);
  ASSERT_EQ(next.branch.size(), 1u);
  expect_branch(next.branch[0], slip_forward);
  s.x[2].y() = 0.1;
  expect_branch(evaluated(s, {}).points[0].branch, none);
}

// The first iteration of an increment starts where the last one ended: by the law every slipping
// point sits exactly on its limit and sticks, and the stiff tangent of stick predicts nothing.
TEST(Branches, PredictionKeepsSlippingPointsSlipping) {
  for (const double sign : {1.0, -1.0}) {
    PairSample s = at_rest(sign * limit, true);
    const ActiveBranch slip = sign > 0 ? slip_forward : slip_backward;
    const ActiveSet<2> active_set = pairing::committed_active_set<2>(s.pair, s.committed, s.x);
    for (const double back : {0.0, 1e-3}) {
      s.x[2].x() = 2 - sign * back;
      const PairEvaluation<2> e = evaluated(s, active_set);
      EXPECT_EQ(e.points[0].status, Status::stick);  // what the law says is what is reported
      EXPECT_NEAR(e.points[0].shear_traction[0], sign * (limit - eps_t * back), 1e-13);
      EXPECT_FALSE(e.points[0].history.slipping);
      expect_branch(e.points[0].branch, slip);
      const pairing::ContactBlock<2>& b = e.blocks[0];
      EXPECT_NEAR(b.force[0], sign * (limit - eps_t * back), 1e-13);
      EXPECT_NEAR(b.branch_force[0], sign * limit, 1e-13);
      EXPECT_EQ(b.tangent(0, 0), 0.0);  // no tangential stiffness
      EXPECT_EQ(b.branched, back > 0);
      expect_tangent_of_branch_force(s, active_set);
    }
  }
}

// A point that has slipped one way and now would slip the other way has jumped over its sticking
// range: plain return mapping sends it back and forth for ever.
TEST(Branches, AReversedSlipIsLinearisedInStick) {
  for (const double sign : {1.0, -1.0}) {
    PairSample s = at_rest(sign * limit, true);
    const double back = 3 * limit / eps_t;  // the trial is -2 limit
    s.x[2].x() -= sign * back;
    const ActiveSet<2> active_set = assume(sign > 0 ? slip_forward : slip_backward, false);
    const PairEvaluation<2> e = evaluated(s, active_set);
    EXPECT_EQ(e.points[0].status, Status::slip);
    EXPECT_NEAR(e.points[0].shear_traction[0], -sign * limit, 1e-13);
    EXPECT_TRUE(e.points[0].history.slipping);
    expect_branch(e.points[0].branch, stick);
    const pairing::ContactBlock<2>& b = e.blocks[0];
    EXPECT_TRUE(b.branched);
    EXPECT_NEAR(b.force[0], -sign * limit, 1e-13);
    EXPECT_NEAR(b.branch_force[0], -sign * 2 * limit, 1e-12);  // the trial, without its limit
    EXPECT_NEAR(b.branch_force[1], b.force[1], 1e-15);
    EXPECT_NEAR(b.tangent(0, 0), eps_t, 1e-10);
    expect_tangent_of_branch_force(s, active_set);
  }
}

TEST(Branches, WithoutReversalTheLawDecides) {
  struct Case {
    ActiveBranch active_set;
    double moved;  ///< in elastic ranges limit / eps_t, from a traction of zero
    ActiveBranch branch;
  };
  for (const Case& c :
       {Case{none, 2, slip_forward}, Case{none, 0.5, stick}, Case{stick, -2, slip_backward},
        Case{stick, 2, slip_forward}, Case{slip_forward, 2, slip_forward},
        Case{slip_forward, 0.5, stick}, Case{slip_forward, -0.5, stick},
        Case{slip_backward, -2, slip_backward}, Case{slip_backward, 0.5, stick}}) {
    PairSample s = at_rest(0.0, false);
    s.x[2].x() += c.moved * limit / eps_t;
    const ActiveSet<2> active_set = assume(c.active_set, false);
    const PairEvaluation<2> e = evaluated(s, active_set);
    expect_branch(e.points[0].branch, c.branch);
    EXPECT_FALSE(e.blocks[0].branched);
    EXPECT_EQ(e.blocks[0].branch_force.head<6>(), e.blocks[0].force.head<6>());
    expect_tangent_of_branch_force(s, active_set);
  }
}

// The branch that an iteration assumes changes the way to the solution, not the solution: forces
// and histories are those of the law.
TEST(Branches, ForcesAndHistoriesAreThoseOfTheLawWhateverIsAssumed) {
  for (const double moved : {-3.0, -0.5, 0.0, 0.5, 3.0}) {
    PairSample s = at_rest(0.7 * limit, true);
    s.x[2].x() += moved * limit / eps_t;
    const PairEvaluation<2> law = evaluated(s, {});
    for (const ActiveBranch& branch : {stick, slip_forward, slip_backward})
      for (const bool predict : {false, true}) {
        const PairEvaluation<2> e = evaluated(s, assume(branch, predict));
        EXPECT_EQ(e.blocks[0].force.head<6>(), law.blocks[0].force.head<6>());
        EXPECT_EQ(e.points[0].status, law.points[0].status);
        EXPECT_EQ(e.points[0].history.traction[0], law.points[0].history.traction[0]);
        EXPECT_EQ(e.points[0].history.slipping, law.points[0].history.slipping);
      }
  }
}

}  // namespace
}  // namespace osculate::testing
