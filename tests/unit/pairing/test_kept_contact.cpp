// Open points that are linearised in contact, and what is predicted of points without shear.
#include <gtest/gtest.h>

#include <cmath>

#include "osculate/pairing/projected_point.hpp"
#include "pair_sample.hpp"

namespace osculate::testing {
namespace {

using contact::Branch;
using contact::Status;
using pairing::ActiveSet;
using pairing::PairEvaluation;

constexpr double eps_n = 1000, eps_t = 80, gap = 0.002;

/// Point 0 is open by `distance` over a convex facet; it was in contact a little way off, above
/// whose tangent plane its gap is closed.
template <int Dim>
struct OverAHill {
  ContactSample<Dim> s;
  ActiveSet<Dim> active_set;

  explicit OverAHill(double friction, double distance = gap) {
    if constexpr (Dim == 2)
      s = make_sample({.nodes_per_facet = 3, .bend = 0.05, .depth = -distance});
    else
      s = make_sample3({.type = cell::CellType::quad9, .bend = 0.05, .depth = -distance});
    s.pair.normal = contact::penalty(eps_n);
    if (friction > 0) s.pair.friction = contact::coulomb(friction, eps_t);
    s.committed = pairing::initial_state(s.pair, s.x);
    contact::PointHistory<Dim>& h = s.committed.points[0];
    h.active = true;
    h.gap = -1e-3;
    active_set.branch.resize(s.committed.points.size());
    pairing::ActiveBranch<Dim>& b = active_set.branch[0];
    b.branch = friction > 0 ? Branch::stick : Branch::slip;
    b.closed = true;
    b.facet = h.facet;
    b.xi = h.xi;
    b.xi[0] -= 0.15;
  }

  [[nodiscard]] double linearised() const {
    pairing::Projection<Dim> last;
    last.feature = projection::Feature::face;
    last.facet = active_set.branch[0].facet;
    last.xi = active_set.branch[0].xi;
    const Vec<Dim> point = s.x[static_cast<std::size_t>(s.pair.slave.nodes[0])];
    return pairing::projected_point(s.pair.master, last, point, s.x).kinematics.gap;
  }
  [[nodiscard]] PairEvaluation<Dim> evaluated() const {
    PairEvaluation<Dim> e;
    pairing::evaluate<Dim>(s.pair, s.x, s.committed, true, e, active_set);
    return e;
  }
};

template <int Dim>
void expect_kept(double friction) {
  const OverAHill<Dim> hill(friction);
  const double linearised = hill.linearised();
  ASSERT_LT(linearised, -1e-4);
  const PairEvaluation<Dim> e = hill.evaluated();
  const pairing::ContactBlock<Dim>& b = e.blocks[0];
  const Eigen::Index rows = Dim * b.count;
  ASSERT_GT(rows, 0);
  EXPECT_EQ(e.points[0].status, Status::open);
  EXPECT_NEAR(e.points[0].gap, gap, 1e-12);
  EXPECT_EQ(e.points[0].normal_traction, 0);
  EXPECT_FALSE(e.points[0].history.active);
  EXPECT_TRUE(b.force.head(rows).isZero(0));
  EXPECT_TRUE(b.branched);

  // As the same place with its gap measured from where the linearised one is the present one.
  OverAHill<Dim> there = hill;
  there.s.pair.offset = gap - linearised;
  const PairEvaluation<Dim> d = there.evaluated();
  ASSERT_NE(d.points[0].status, Status::open);
  EXPECT_NEAR(d.points[0].normal_traction, eps_n * linearised, 1e-9);
  const Eigen::MatrixXd tangent =
      assembled_tangent(e, Dim * static_cast<Eigen::Index>(hill.s.x.size()));
  const Eigen::MatrixXd there_tangent = assembled_tangent(d, tangent.rows());
  EXPECT_GT(tangent.norm(), 1);
  EXPECT_LT((tangent - there_tangent).norm(), 1e-9 * tangent.norm());
  if (friction == 0) {
    const double pull = gap / linearised;  // the law continued to the present gap pulls
    EXPECT_LT((b.branch_force.head(rows) - pull * d.blocks[0].force.head(rows)).norm(),
              1e-9 * b.branch_force.head(rows).norm());
  }
}

TEST(KeptContact, OpensOverAHillButIsLinearisedAtItsLastTangentPlane) {
  for (const double friction : {0.0, 0.3}) {
    SCOPED_TRACE(friction);
    expect_kept<2>(friction);
    expect_kept<3>(friction);
  }
}

template <int Dim>
void expect_dropped() {
  OverAHill<Dim> hill(0.3);
  for (int i = 1; i <= 4; ++i) {  // four times in a row, not more
    const PairEvaluation<Dim> e = hill.evaluated();
    EXPECT_TRUE(e.blocks[0].active()) << i;
    const Vec<Dim - 1> xi = hill.active_set.branch[0].xi;
    hill.active_set = pairing::evaluated_active_set(e, hill.active_set);
    EXPECT_TRUE(hill.active_set.branch[0].closed);
    EXPECT_EQ(hill.active_set.branch[0].kept_on, i);
    hill.active_set.branch[0].xi = xi;  // as if it had moved on again
  }
  const PairEvaluation<Dim> last = hill.evaluated();
  EXPECT_FALSE(last.blocks[0].active());
  EXPECT_FALSE(pairing::evaluated_active_set(last, hill.active_set).branch[0].closed);

  OverAHill<Dim> beside(0.3);
  beside.active_set.branch[0].facet = 0;
  EXPECT_FALSE(beside.evaluated().blocks[0].active()) << "over a border of facets";
  OverAHill<Dim> off(0.3);
  off.active_set.branch[0].xi = off.s.committed.points[0].xi;
  EXPECT_FALSE(off.evaluated().blocks[0].active()) << "lifted off";
  OverAHill<Dim> open(0.3);
  open.active_set.branch[0].closed = false;
  EXPECT_FALSE(open.evaluated().blocks[0].active()) << "was open before";
}

TEST(KeptContact, IsGivenUpAfterFourIterationsOverBordersAndWhereItLiftsOff) {
  expect_dropped<2>();
  expect_dropped<3>();
}

/// Shear stiffness of a touching point without shear in the first iteration.
template <int Dim>
double shear_stiffness(Prediction friction) {
  OverAHill<Dim> hill(0.3, -0.01);
  hill.s.committed = pairing::initial_state(hill.s.pair, hill.s.x);
  hill.active_set =
      pairing::committed_active_set<Dim>(hill.s.pair, hill.s.committed, hill.s.x, friction);
  const PairEvaluation<Dim> e = hill.evaluated();
  const Vec<Dim> along = e.points[0].frame.col(0);
  return along.dot(e.blocks[0].tangent.template topLeftCorner<Dim, Dim>() * along) /
         e.points[0].weight;
}

TEST(KeptContact, PointsWithoutShearMayBePredictedToSlide) {
  EXPECT_GT(shear_stiffness<2>(Prediction::as_before), 0.9 * eps_t);
  EXPECT_GT(shear_stiffness<3>(Prediction::sticking), 0.9 * eps_t);
  EXPECT_LT(shear_stiffness<2>(Prediction::sliding), 0.1 * eps_t);
  EXPECT_LT(shear_stiffness<3>(Prediction::sliding), 0.1 * eps_t);
}

}  // namespace
}  // namespace osculate::testing
