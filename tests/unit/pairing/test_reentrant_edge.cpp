// Points with unknown tractions in a concave edge of a meshed master in space: what holds them,
// how they slide along it, where they leave, what they take along; derivatives by their order.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "allocation_count.hpp"
#include "expect_derivative.hpp"
#include "groove_sample.hpp"
#include "osculate/contact/law/catalogue.hpp"
#include "osculate/pairing/reentrant_edge_traction.hpp"

namespace osculate::testing {
namespace {

using cell::CellType;
using contact::Branch;
using contact::Status;
using projection::Feature;
using Sample = MultiplierSample<3>;

constexpr double penalty = 1000;

const pairing::ReentrantEdges& edges_of(const Sample& s) {
  return std::get<pairing::ByMultipliers>(s.pair.enforcement).reentrant_edges;
}

/// Number of the concave edge that the point is nearest to, where it runs, and the place.
pairing::EdgePlace place_of(const Sample& s, const Vec3& point) {
  return pairing::follow_edge(edges_of(s), s.pair.master, 0, s.x, point);
}

/// The point was held in the edge at the committed place `from`, by a force on it; it slid with a
/// traction towards `sliding`.
void hold_by(const Vec3& force, Sample& s, const Vec3& from, const Vec3& sliding = Vec3::Zero()) {
  const pairing::EdgePlace place = place_of(s, from);
  const pairing::SharpEdge& edge = edges_of(s).list[static_cast<std::size_t>(place.edge)];
  contact::PointHistory<3>& h = s.committed.points[0];
  h = remembered(edge.facets[0], pairing::edge_xi(edge, 0, place.s), 0, Vec2::Zero());
  h.feature = Feature::edge;
  pairing::ActiveBranch<3> branch;
  branch.branch = Branch::reentrant;
  branch.facet = h.facet;
  branch.xi = h.xi;
  branch.direction = sliding;
  s.active_set = {branch};
  s.multipliers[0] = {0, -force};
}

/// The point was pressed on a facet, at its coordinates xi.
void press_on(Index facet, const Vec2& xi, double normal, const Vec3& shear, Sample& s) {
  s.committed.points[0] = remembered(facet, xi, 0, Vec2::Zero());
  s.active_set = {pairing::ActiveBranch<3>{Branch::stick, Vec3::Zero()}};
  s.active_set[0].facet = facet;
  s.multipliers[0] = {normal, shear};
}

pairing::PairEvaluation<3> evaluated(const Sample& s) { return s.evaluation(s.packed(), false); }
Vec3 force_on_point(const pairing::PairEvaluation<3>& e) {
  return -e.blocks[0].force.segment<3>(0);
}

struct Facts {
  Branch branch;
  Status status;
  bool towards;  ///< x, of the linearised slip
  bool operator==(const Facts&) const = default;
};

Facts facts_of(const Sample& s, const Eigen::VectorXd& v) {
  const pairing::PointResult<3> p = s.evaluation(v, false).points[0];
  return {p.branch.branch, p.status, p.branch.direction.x() > 0};
}

void expect_tangent(const Sample& s, Status status) {
  const Eigen::VectorXd v = s.packed();
  const auto branch = [&](const Eigen::VectorXd& y) { return facts_of(s, y); };
  ASSERT_EQ(branch(v).branch, Branch::reentrant);
  ASSERT_EQ(branch(v).status, status);
  expect_derivative([&](const Eigen::VectorXd& y) { return s.residual(y); }, s.tangent(v), branch,
                    v, 1e-3);
}

TEST(ReentrantEdge, IsWhereTheMasterBendsOutwards) {
  for (const CellType type : {CellType::tri3, CellType::quad8}) {
    const Sample s = make_groove({.type = type, .pieces = 3});
    ASSERT_EQ(edges_of(s).list.size(), 3u);
    EXPECT_EQ(edges_of(s).at.size(), 4u);
    const pairing::EdgePlace p = place_of(s, {0.4, 0.01, 0.02});
    EXPECT_NEAR((p.point - Vec3(0.4, 0, 0)).norm(), 0, 1e-14);
    EXPECT_NEAR(std::abs(p.tangent.x()), 1, 1e-14);
    for (const std::size_t k : {0u, 1u}) EXPECT_GT(p.normal[1 - k].dot(p.away[k]), 0.5);
  }
  EXPECT_FALSE(pairing::has_reentrant_vertices(make_groove({.tilt = {0.2, 0.3}}).pair));
  EXPECT_FALSE(pairing::has_reentrant_vertices(make_groove({.tilt = {-0.6, -0.6}}).pair));
}

TEST(ReentrantEdgeTangent, IsOfSecondOrder) {
  for (const CellType type :
       {CellType::tri3, CellType::tri6, CellType::quad4, CellType::quad8, CellType::quad9})
    for (const auto weight : {pairing::Weight::node, pairing::Weight::reference_area})
      for (const double mu : {0.0, 5.0, 0.1}) {
        const bool curved = type != CellType::tri3 && type != CellType::quad4;
        const GrooveOptions o{
            .type = type,
            .tilt = {0.6, 0.8},
            .pieces = 1,
            .bend = curved ? 0.05 : 0.0,
            .pose = Mat<3, 3>(Eigen::AngleAxisd(0.4, Vec3(1, 2, 0.5).normalized()))};
        Sample s = make_groove(o);
        s.pair.weight = weight;
        s.pair.reference_areas = {0.7};
        if (mu > 0) s.pair.friction = contact::coulomb(mu, 80.0);
        const Vec3 push = 60 * (groove_normal(o, 0) + groove_normal(o, 1)),
                   along = o.pose * Vec3(40, 0, 0);
        s.x.back() = groove_point(o, 0.3, 0) + o.pose * Vec3(0, 0.004, -0.02);
        hold_by(push - along, s, groove_point(o, 0.27, 0), (mu == 0.1 ? 1.0 : 0.0) * o.pose.col(0));
        SCOPED_TRACE(std::string(cell::info(type).name) + " mu " + std::to_string(mu));
        expect_tangent(s, mu == 0.1 ? Status::slip : Status::stick);
        if (mu > 0) continue;
        const Eigen::MatrixXd k = s.tangent(s.packed());
        EXPECT_LT((k - k.transpose()).norm(), 1e-13 * k.norm());
      }
}

/// The way along the edge begins on a facet, or on the edge before a bend of it, which is run the
/// other way round.
TEST(ReentrantEdgeTangent, OfTheWayBehind) {
  for (const double along : {-35.0, 40.0}) {  // with eps_T times the way: stick and slip
    const GrooveOptions o{.turn = 0.3, .at = {0.2, 0.07, -0.01}};
    Sample s = make_groove(o);
    s.pair.friction = contact::coulomb(0.3, 80.0);
    const Status status = along < 0 ? Status::stick : Status::slip;
    const Vec3 force = 60 * (groove_normal(o, 0) + groove_normal(o, 1)) - Vec3(along, 0, 0);
    hold_by(force, s, {-0.4, 0, 0});
    expect_tangent(s, status);
    s.committed.points[0] = remembered(1, {0.5, -0.4}, 0, Vec2::Zero());
    expect_tangent(s, status);
  }
}

TEST(ReentrantEdgeTangent, OfFacetsWithoutFriction) {
  Sample s = make_groove({.at = {0.3, 0.5, 0.5 * std::tan(0.6) - 0.01}});
  press_on(3, {0, 0}, -90, Vec3(3, 1, 2), s);
  const Eigen::VectorXd v = s.packed();
  const auto branch = [&](const Eigen::VectorXd& y) { return facts_of(s, y); };
  ASSERT_EQ(branch(v).branch, Branch::slip);
  expect_derivative([&](const Eigen::VectorXd& y) { return s.residual(y); }, s.tangent(v), branch,
                    v, 1e-3);
  const Eigen::MatrixXd k = s.tangent(v);
  EXPECT_LT((k - k.transpose()).norm(), 1e-13 * k.norm());
}

/// Forces sum to zero, and their moments do where the point is in the edge.
TEST(ReentrantEdge, ForcesBalance) {
  for (const double mu : {0.0, 0.1, 5.0}) {
    const GrooveOptions o{.type = CellType::quad9, .pieces = 1, .bend = 0.05};
    Sample s = make_groove(o);
    if (mu > 0) s.pair.friction = contact::coulomb(mu, penalty);
    s.x.back() = groove_point(o, 0.3, 0);
    hold_by(5 * (groove_normal(o, 0) + groove_normal(o, 1)) + Vec3(3, 0, 0), s, s.x.back());
    const pairing::PairEvaluation<3> e = evaluated(s);
    ASSERT_EQ(e.points[0].branch.branch, Branch::reentrant);
    Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
    for (int k = 0; k < e.blocks[0].count; ++k) {
      const Vec3 f = e.blocks[0].force.segment<3>(3 * k);
      sum += f;
      moment +=
          s.x[static_cast<std::size_t>(e.blocks[0].nodes[static_cast<std::size_t>(k)])].cross(f);
    }
    EXPECT_NEAR(sum.norm(), 0, 1e-13);
    EXPECT_NEAR(moment.norm(), 0, 1e-13);
    const pairing::PointResult<3>& p = e.points[0];
    EXPECT_NEAR((p.normal_traction * p.normal + p.shear() + force_on_point(e)).norm(), 0, 1e-13);
  }
}

TEST(ReentrantEdge, TurnsWithTheFrame) {
  const Mat<3, 3> turn(Eigen::AngleAxisd(2.1, Vec3(1, -2, 0.5).normalized()));
  for (const double mu : {0.0, 0.1, 5.0}) {
    const GrooveOptions o{.tilt = {0.5, 0.9}};
    Sample a = make_groove(o);
    if (mu > 0) a.pair.friction = contact::coulomb(mu, 80.0);
    a.x.back() += Vec3(0.01, 0.003, -0.02);
    hold_by(60 * (groove_normal(o, 0) + groove_normal(o, 1)) + Vec3(20, 0, 0), a, {0.28, 0, 0});
    Sample b = a;
    for (Vec3& x : b.x) x = turn * x;
    b.multipliers[0].shear = turn * b.multipliers[0].shear;
    const pairing::PairEvaluation<3> of_a = evaluated(a), of_b = evaluated(b);
    ASSERT_EQ(of_a.points[0].branch.branch, Branch::reentrant);
    for (int k = 0; k < of_a.blocks[0].count; ++k)
      EXPECT_NEAR(
          (turn * of_a.blocks[0].force.segment<3>(3 * k) - of_b.blocks[0].force.segment<3>(3 * k))
              .norm(),
          0, 1e-12);
  }
}

/// Dragged along the groove the point meets mu (N_1 + N_2) of both sides, whatever their angles: in
/// a symmetric groove of half angle beta mu F / sin(beta).
TEST(ReentrantEdge, SlidesAlongAtTheSumOfBothLimits) {
  constexpr double mu = 0.3;
  for (const auto& tilt : {std::array{0.6, 0.6}, std::array{0.4, 1.1}, std::array{1.3, 1.3}}) {
    const GrooveOptions o{.tilt = tilt};
    const double n0 = 7, n1 = 4, limit = mu * (n0 + n1);
    const Vec3 press = n0 * groove_normal(o, 0) + n1 * groove_normal(o, 1);
    for (const double along : {0.99 * limit, 1.01 * limit, -3 * limit}) {
      Sample s = make_groove(o);
      s.pair.friction = contact::coulomb(mu, penalty);
      hold_by(press + Vec3(along, 0, 0), s, s.x.back());
      const pairing::PairEvaluation<3> e = evaluated(s);
      ASSERT_EQ(e.points[0].branch.branch, Branch::reentrant);
      EXPECT_EQ(e.points[0].status, std::abs(along) < limit ? Status::stick : Status::slip);
      const double carried = std::clamp(along, -limit, limit);
      EXPECT_NEAR((force_on_point(e) - press - Vec3(carried, 0, 0)).norm(), 0, 1e-12);
    }
    if (tilt[0] != tilt[1]) continue;
    Sample s = make_groove(o);
    s.pair.friction = contact::coulomb(mu, penalty);
    hold_by(Vec3(100, 0, 5), s, s.x.back());
    const double beta = std::numbers::pi / 2 - tilt[0];
    EXPECT_NEAR(force_on_point(evaluated(s)).x(), mu * 5 / std::sin(beta), 1e-12);
  }
}

/// Each facet's law has slid as far as the other's: also where the limit falls with the way.
TEST(ReentrantEdge, BothLawsSlideByTheSameWay) {
  contact::Coulomb falls{.mu = 0.6, .stiffness = 500, .kinetic = 0.2, .distance = 0.01};
  const std::array<double, 2> normal{-7, -4};
  for (const double predictor : {9.0, -12.0}) {
    const pairing::EdgeFriction f = pairing::friction_of_both(falls, predictor, normal, {});
    const auto one = contact::response<2>(contact::FrictionLaw(falls), Vec<1>(predictor), -11, {});
    ASSERT_TRUE(f.slides);
    EXPECT_NEAR(f.value, one.traction[0], 1e-12);  // linear in the pressure
    EXPECT_NEAR(f.d_predictor, one.d_predictor(0, 0), 1e-10);
    for (const double d : f.d_normal) EXPECT_NEAR(d, one.d_normal[0], 1e-10);
  }
  const contact::Tresca fixed{2, 500};
  EXPECT_NEAR(pairing::friction_of_both(fixed, 9, normal, {}).value, 4, 1e-14);
  EXPECT_NEAR(pairing::friction_of_both(fixed, 9, {-7, 0}, {}).value, 2, 1e-14);
  EXPECT_FALSE(pairing::friction_of_both(fixed, 3.9, normal, {}).slides);
}

/// Across the edge it is held as in the plane: in the sum of the cones (without a force along it).
TEST(ReentrantEdge, HoldsInTheSumOfBothCones) {
  constexpr int directions = 360;
  for (const double tilt : {0.3, 0.9})
    for (const double mu : {0.0, 0.3}) {
      const GrooveOptions o{.tilt = {tilt, tilt}};
      const double half = tilt + std::atan(mu);
      for (int i = 0; i < directions; ++i) {
        const double angle = std::numbers::pi * (2 * (i + 0.37) / directions - 1);
        Sample s = make_groove(o);
        if (mu > 0) s.pair.friction = contact::coulomb(mu, penalty);
        const Vec3 force = 5 * Vec3(0, std::sin(angle), std::cos(angle));
        hold_by(force, s, s.x.back());
        const pairing::PairEvaluation<3> e = evaluated(s);
        const bool held = e.points[0].branch.branch == Branch::reentrant;
        EXPECT_EQ(held, std::abs(angle) < half) << tilt << " " << mu << " " << angle;
        if (held || e.points[0].status == Status::open) continue;
        EXPECT_EQ(e.points[0].history.facet % 2, angle > 0 ? 0 : 1);
        const Vec3 n = groove_normal(o, angle > 0 ? 0 : 1);
        EXPECT_NEAR(force_on_point(e).dot(n), force.dot(n), 1e-12);
      }
    }
}

TEST(ReentrantEdge, LetsGoWhereItWouldPull) {
  Sample s = make_groove({});
  s.pair.friction = contact::coulomb(0.3, penalty);
  hold_by(Vec3(1, 0, -5), s, s.x.back());
  EXPECT_EQ(evaluated(s).points[0].status, Status::open);
}

/// Pressed on one side the point has slid beyond the edge, into the other one.
TEST(ReentrantEdge, TakesOverTheTraction) {
  const GrooveOptions o{.at = {0.3, 0.01, -0.01 * std::tan(0.6)}};  // on the plane of side 0
  const Vec3 n = groove_normal(o, 0), down(0, std::cos(0.6), -std::sin(0.6));
  for (const double mu : {0.0, 0.3}) {
    Sample s = make_groove(o);
    if (mu > 0) s.pair.friction = contact::coulomb(mu, penalty);
    press_on(2, {-0.7, 0.5}, -20, mu > 0 ? Vec3(4 * down) : Vec3(Vec3::Zero()), s);
    const pairing::PairEvaluation<3> e = evaluated(s);
    ASSERT_EQ(e.points[0].branch.branch, Branch::reentrant);
    const Vec3 carried = -20 * n + s.multipliers[0].shear, offset = 0.01 / std::cos(0.6) * down;
    EXPECT_NEAR((force_on_point(e) + carried + penalty * offset).norm(), 0, 1e-11);
    EXPECT_NEAR((e.blocks[0].constraint.shear - penalty * offset).norm(), 0, 1e-11);
    EXPECT_EQ(e.blocks[0].constraint.normal, 0);
    pairing::PairMultipliers<3> next;
    next.points = s.multipliers;
    next = pairing::taken_over(e, next);
    EXPECT_EQ(next.points[0].normal, 0);
    EXPECT_NEAR((next.points[0].shear - carried).norm(), 0, 1e-12);
    EXPECT_EQ(e.points[0].history.feature, Feature::edge);
    next = pairing::commit(e, next);
    EXPECT_NEAR((next.points[0].shear - carried).norm(), 0, 1e-12);
  }
}

/// A pressed point stays on its facet where the other one is nearer, but not met.
TEST(ReentrantEdge, APressedPointKeepsItsFacet) {
  const GrooveOptions o{.tilt = {1.45, 1.45}};  // a narrow slot
  const Vec3 out = groove_normal(o, 0), into = Vec3(0, -std::cos(1.45), std::sin(1.45));
  Sample s = make_groove(o);
  s.x.back() = Vec3(0.3, 0, 0) + 0.3 * into + 0.04 * out;
  const double other = (s.x.back() - Vec3(0.3, 0, 0)).dot(groove_normal(o, 1));
  ASSERT_GT(other, 0);
  ASSERT_LT(other, 0.04);
  press_on(2, {-0.7, 0.5}, -50, Vec3::Zero(), s);
  EXPECT_EQ(evaluated(s).points[0].history.facet, 2);
  EXPECT_EQ(evaluated(s).points[0].branch.branch, Branch::slip);
  press_on(2, {-0.7, 0.5}, -20, Vec3::Zero(), s);
  EXPECT_EQ(evaluated(s).points[0].history.facet, 3);
  EXPECT_EQ(evaluated(s).points[0].status, Status::open);
}

TEST(ReentrantEdge, AnOpenPointIsWhereItsPlaceIs) {
  Sample s = make_groove({.at = {0.3, 0, -0.01}});
  s.active_set = {pairing::ActiveBranch<3>{}};
  EXPECT_EQ(evaluated(s).points[0].branch.branch, Branch::reentrant);
  s.x.back() = {0.3, 0.1, 0.06};
  EXPECT_EQ(evaluated(s).points[0].branch.branch, Branch::slip);
  EXPECT_EQ(evaluated(s).points[0].history.facet, 3);
}

/// Along a bent edge from piece to piece; beyond its end the point has no place there.
TEST(ReentrantEdge, GoesOnInTheNextEdgeAndEnds) {
  const GrooveOptions o{.pieces = 4, .turn = 0.2};
  Sample s = make_groove(o);
  s.pair.friction = contact::coulomb(0.1, penalty);
  const Vec3 push = 9 * (groove_normal(o, 0) + groove_normal(o, 1));
  s.x.back() = groove_point(o, 1.4, 0);
  hold_by(push, s, {-0.3, 0, 0});
  const pairing::PairEvaluation<3> e = evaluated(s);
  ASSERT_EQ(e.points[0].branch.branch, Branch::reentrant);
  EXPECT_EQ(e.points[0].history.facet, 6);
  EXPECT_NEAR(std::abs(e.points[0].slip_increment[0]), 1.7, 1e-2);  // over two bends
  s.x.back() = groove_point(o, 2.04, 0);  // the facets are continued as far
  EXPECT_EQ(evaluated(s).points[0].branch.branch, Branch::reentrant);
  s.x.back() = groove_point(o, 2.1, 0);
  EXPECT_EQ(evaluated(s).points[0].branch.branch, Branch::none);
}

/// What rested in the edge is predicted to stay, what slid to go on.
TEST(ReentrantEdge, IsRememberedFromIncrementToIncrement) {
  Sample s = make_groove({});
  s.pair.friction = contact::coulomb(0.3, penalty);
  hold_by(Vec3(20, 0, 5), s, s.x.back());
  pairing::PairEvaluation<3> e = evaluated(s);
  ASSERT_EQ(e.points[0].status, Status::slip);
  const pairing::PairState<3> committed = pairing::commit(e);
  const pairing::ActiveSet<3> next = pairing::committed_active_set<3>(s.pair, committed, s.x);
  EXPECT_EQ(next.branch[0].branch, Branch::reentrant);
  EXPECT_NEAR(next.branch[0].direction.x(), -1, 1e-14);  // of T, the force is its negative
  pairing::PairMultipliers<3> none;
  none.points.resize(1);
  pairing::evaluate<3>(s.pair, s.x, committed, true, e, next, &none);
  EXPECT_EQ(e.points[0].branch.branch, Branch::reentrant);
  s.pair.enforcement = pairing::ByMultipliers{.reentrant_angle = 3};
  pairing::prepare(s.pair, s.x);
  EXPECT_NE(pairing::committed_active_set<3>(s.pair, committed, s.x).branch[0].branch,
            Branch::reentrant);
}

/// An elastic master may bend its groove flat, or over.
TEST(ReentrantEdge, ThatIsFlatOrTurnedOverHoldsNoPoint) {
  for (const double mu : {0.0, 0.3})
    for (const double slope : {0.1, 0.0, -0.1}) {
      Sample s = make_groove({});
      if (mu > 0) s.pair.friction = contact::coulomb(mu, penalty);
      hold_by(Vec3(0, 0, 5), s, s.x.back());
      for (std::size_t k = 0; k + 1 < s.x.size(); ++k) s.x[k].z() = slope * std::abs(s.x[k].y());
      const pairing::PairEvaluation<3> e = evaluated(s);
      EXPECT_EQ(e.points[0].branch.branch == Branch::reentrant, slope > 0) << slope;
      // Without friction a side of the ridge carries what is normal to it.
      const double carried = slope < 0 && mu == 0 ? 5 / (1 + slope * slope) : 5;
      EXPECT_NEAR(force_on_point(e).z(), carried, 1e-12) << slope;
    }
}

/// A point that a facet held at the edge's place is not taken for one that the edge held.
TEST(ReentrantEdge, AFacetsMultiplierIsNotLostAtTheNextIncrement) {
  const GrooveOptions o{};
  Sample s = make_groove(o);
  s.pair.friction = contact::coulomb(0.3, penalty);
  hold_by(Vec3(0, 0, 5), s, s.x.back());
  s.multipliers[0] = {-20, Vec3::Zero()};
  const pairing::ActiveSet<3> next = pairing::committed_active_set<3>(s.pair, s.committed, s.x);
  pairing::PairMultipliers<3> given;
  given.points = s.multipliers;
  pairing::PairEvaluation<3> e;
  pairing::evaluate<3>(s.pair, s.x, s.committed, false, e, next, &given);
  EXPECT_NEAR(force_on_point(e).norm(), 20, 1e-12);
}

TEST(ReentrantEdge, NothingIsAllocatedAfterTheFirstCall) {
  Sample s = make_groove({});
  s.pair.friction = contact::coulomb(0.3, penalty);
  hold_by(Vec3(1, 0, 5), s, {0.25, 0, 0});
  pairing::ActiveSet<3> active_set;
  active_set.branch = s.active_set;
  pairing::PairMultipliers<3> taken;
  taken.points = s.multipliers;
  pairing::PairEvaluation<3> e;
  const auto evaluate = [&] {
    pairing::evaluate<3>(s.pair, s.x, s.committed, true, e, active_set, &taken);
  };
  evaluate();
  ASSERT_EQ(e.points[0].branch.branch, Branch::reentrant);
  const std::size_t before = allocation_count();
  evaluate();
  EXPECT_EQ(allocation_count(), before);
}

}  // namespace
}  // namespace osculate::testing
