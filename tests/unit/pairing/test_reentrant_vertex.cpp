// Points with unknown tractions in a concave corner of the master: what holds them, where they
// leave, what they take along; derivatives by their order.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "allocation_count.hpp"
#include "expect_derivative.hpp"
#include "multiplier_sample.hpp"
#include "pair_sample.hpp"

namespace osculate::testing {
namespace {

using contact::Branch;
using contact::Status;
using projection::Feature;
using Sample = MultiplierSample<2>;

constexpr double penalty = 1000, half_turn = std::numbers::pi;

Vec2 direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

struct Corner {
  double angle = half_turn / 4;  ///< between the normals; negative: a convex corner
  double start = -0.9;           ///< direction of the first facet
  int nodes_per_facet = 2;
  double bow = 0;  ///< of the facets
};

/// The unit normal of facet k at the corner (of straight facets).
Vec2 normal_of(const Corner& c, int k) { return direction(c.start + k * c.angle + half_turn / 2); }

constexpr std::size_t vertex = 1;

/// Two facets that meet in node 1, and one slave point there, displaced by `offset`.
Sample make_valley(const Corner& c, const Vec2& offset = Vec2::Zero()) {
  const Vec2 first = direction(c.start), second = direction(c.start + c.angle), at(0.3, -0.7);
  Sample s;
  s.x = {at - 2 * first, at, at + 3 * second};
  std::vector<Index> before{0, 1}, behind{1, 2};
  if (c.nodes_per_facet == 3) {
    s.x.push_back(at - first + c.bow * turn(first));
    s.x.push_back(at + 1.5 * second + c.bow * turn(second));
    before.push_back(3);
    behind.push_back(4);
  }
  s.pair.master.facets = {pairing::lagrange_facet(before), pairing::lagrange_facet(behind)};
  pairing::connect(s.pair.master);
  const auto slave = static_cast<Index>(s.x.size());
  s.x.push_back(at + offset);
  s.pair.slave = pairing::make_slave_side(pairing::Chain{}, std::array<Index, 1>{slave});
  s.pair.normal = contact::penalty(penalty);
  s.pair.weight = pairing::Weight::node;
  s.pair.enforcement = pairing::ByMultipliers{.reentrant_angle = 0};
  s.committed.points.resize(1);
  s.multipliers.resize(1);
  pairing::prepare(s.pair, s.x);
  return s;
}

/// The point was held in the re-entrant vertex, by a force on it.
void hold_by(const Vec2& force, Sample& s) {
  s.committed.points[0] = remembered(true, 0, Feature::corner, 1, 0, 0);
  s.active_set = {{Branch::reentrant, Vec2::Zero()}};
  s.active_set[0].facet = 0;
  s.multipliers[0] = {0, -force};
}

/// The point was pressed on a facet.
void press_on(Index facet, double normal, const Vec2& shear, Sample& s) {
  s.committed.points[0] = remembered(true, facet, Feature::face, 0.5, 0, 0);
  s.active_set = {{Branch::stick, Vec2::Zero()}};
  s.active_set[0].facet = facet;
  s.multipliers[0] = {normal, shear};
}

Vec2 force_on_point(const pairing::PairEvaluation<2>& e) {
  return -e.blocks[0].force.segment<2>(0);
}

pairing::PairEvaluation<2> evaluated(const Sample& s) { return s.evaluation(s.packed(), false); }

TEST(ReentrantVertex, IsWhereTheMasterBendsOutwards) {
  const Sample reentrant = make_valley({}), ridge = make_valley({.angle = -0.3}),
               flat = make_valley({.angle = 0});
  EXPECT_TRUE(pairing::has_reentrant_vertices(reentrant.pair));
  EXPECT_FALSE(pairing::has_reentrant_vertices(ridge.pair));
  EXPECT_FALSE(pairing::has_reentrant_vertices(flat.pair));
  const auto v = pairing::reentrant_vertex_after(reentrant.pair.master, 0, reentrant.x);
  ASSERT_TRUE(v);
  EXPECT_NEAR((v->point - reentrant.x[vertex]).norm(), 0, 1e-15);
  for (const int k : {0, 1})
    EXPECT_NEAR((v->normal[static_cast<std::size_t>(k)] - normal_of({}, k)).norm(), 0, 1e-14);
  EXPECT_FALSE(pairing::reentrant_vertex_after(reentrant.pair.master, 1, reentrant.x));
}

/// The cone of Coulomb about the bisector with tan(alpha / 2 + atan mu) (at pi/2 any force).
TEST(ReentrantVertex, HoldsInTheSumOfBothCones) {
  constexpr int directions = 720;
  for (const double alpha : {0.2, half_turn / 4, 2.0})
    for (const double mu : {0.0, 0.3, 2.0}) {
      const Corner corner{.angle = alpha};
      const double middle = corner.start + half_turn / 2 + alpha / 2,
                   half = alpha / 2 + std::atan(mu);
      for (int i = 0; i < directions; ++i) {
        const double from_middle = 2 * half_turn * (i + 0.37) / directions - half_turn;
        Sample s = make_valley(corner);
        if (mu > 0) s.pair.friction = contact::coulomb(mu, penalty);
        hold_by(5 * direction(middle + from_middle), s);
        const pairing::PairEvaluation<2> e = evaluated(s);
        const bool held = e.points[0].branch.branch == Branch::reentrant;
        EXPECT_EQ(held, std::abs(from_middle) < half) << alpha << " " << mu << " " << from_middle;
        if (held || e.points[0].status == Status::open) continue;
        EXPECT_EQ(e.points[0].status, Status::slip);
        EXPECT_EQ(e.points[0].history.facet, from_middle > 0 ? 1 : 0);
        const Vec2 n = normal_of(corner, from_middle > 0 ? 1 : 0);
        EXPECT_NEAR(force_on_point(e).dot(n), 5 * direction(middle + from_middle).dot(n), 1e-12);
        EXPECT_NEAR(force_on_point(e).norm() / force_on_point(e).dot(n), std::hypot(1, mu), 1e-12);
      }
    }
}

/// Arriving along a facet in this increment: there friction is at its limit against the way it
/// came, and the cone is that of the normals, turned by atan mu.
TEST(ReentrantVertex, HoldsWhatTheFacetItCameAlongDidNot) {
  constexpr int directions = 360;
  constexpr double mu = 0.3;
  const Corner corner;
  const double first = corner.start + half_turn / 2;
  for (const Index came_along : {0, 1})
    for (int i = 0; i < directions; ++i) {
      const double from_first = 2 * half_turn * (i + 0.37) / directions - half_turn;
      Sample s = make_valley(corner);
      s.pair.friction = contact::coulomb(mu, penalty);
      hold_by(5 * direction(first + from_first), s);
      s.committed.points[0] = remembered(true, came_along, Feature::face, 0.5, 0, 0);
      const double turned = from_first + (came_along == 0 ? -1 : 1) * std::atan(mu);
      const bool held = evaluated(s).points[0].branch.branch == Branch::reentrant;
      EXPECT_EQ(held, turned > 0 && turned < corner.angle) << came_along << " " << from_first;
    }
}

TEST(ReentrantVertex, LetsGoWhereItWouldPull) {
  Sample s = make_valley({});
  s.pair.friction = contact::coulomb(0.3, penalty);
  const Vec2 bisector = (normal_of({}, 0) + normal_of({}, 1)).normalized();
  hold_by(-5 * bisector, s);
  EXPECT_EQ(evaluated(s).points[0].status, Status::open);
}

/// Pressed on the first facet the point has slid beyond the corner, into the second one.
TEST(ReentrantVertex, TakesOverTheTraction) {
  const Corner corner;
  const Vec2 offset = 0.01 * direction(corner.start), n = normal_of(corner, 0),
             shear = 4 * direction(corner.start);
  for (const double mu : {0.0, 0.3}) {
    Sample s = make_valley(corner, offset);
    if (mu > 0) s.pair.friction = contact::coulomb(mu, penalty);
    press_on(0, -20, mu > 0 ? shear : Vec2(Vec2::Zero()), s);
    const pairing::PairEvaluation<2> e = evaluated(s);
    ASSERT_EQ(e.points[0].branch.branch, Branch::reentrant);
    const Vec2 carried = -20 * n + s.multipliers[0].shear;
    EXPECT_NEAR((force_on_point(e) + carried + penalty * offset).norm(), 0, 1e-11);
    EXPECT_NEAR((e.blocks[0].constraint.shear - penalty * offset).norm(), 0, 1e-11);
    EXPECT_EQ(e.blocks[0].constraint.normal, 0);
    pairing::PairMultipliers<2> next;
    next.points = s.multipliers;
    next = pairing::taken_over(e, next);
    EXPECT_EQ(next.points[0].normal, 0);
    EXPECT_NEAR((next.points[0].shear - carried).norm(), 0, 1e-12);
    EXPECT_EQ(e.points[0].history.feature, Feature::corner);
    EXPECT_EQ(e.points[0].history.facet, 0);
    EXPECT_NEAR(e.points[0].slip_increment[0], 0.5, 1e-12);  // from xi = 0.5 to the end
    next = pairing::commit(e, next);
    EXPECT_NEAR((next.points[0].shear - carried).norm(), 0, 1e-12);
  }
}

/// An open point beyond the corner belongs to the second facet; one in the wedge to the corner.
TEST(ReentrantVertex, AnOpenPointIsWhereItsPlaceIs) {
  const Corner corner;
  Sample s = make_valley(corner, 0.01 * direction(corner.start));
  s.committed.points[0] = remembered(false, 0, Feature::face, 0.5, 0.1, 0);
  s.active_set = {pairing::ActiveBranch<2>{}};
  EXPECT_EQ(evaluated(s).points[0].history.facet, 1);
  EXPECT_EQ(evaluated(s).points[0].branch.branch, Branch::slip);
  s.x.back() = s.x[vertex] - 0.01 * (normal_of(corner, 0) + normal_of(corner, 1));
  EXPECT_EQ(evaluated(s).points[0].branch.branch, Branch::reentrant);
  s.pair.enforcement = pairing::ByMultipliers{};
  EXPECT_EQ(evaluated(s).points[0].history.feature, Feature::corner);
  EXPECT_EQ(evaluated(s).points[0].branch.branch, Branch::slip);
}

/// A pressed point stays on its facet, though the other one is nearer and it has not come into it.
TEST(ReentrantVertex, APressedPointKeepsItsFacet) {
  const Corner groove{.angle = 3.0};
  const Vec2 offset = -0.3 * direction(groove.start) + 0.03 * normal_of(groove, 0);
  ASSERT_GT(offset.dot(normal_of(groove, 1)), 0);
  ASSERT_LT(offset.dot(normal_of(groove, 1)), 0.02);
  Sample s = make_valley(groove, offset);
  press_on(0, -40, Vec2::Zero(), s);
  EXPECT_EQ(evaluated(s).points[0].history.facet, 0);
  EXPECT_EQ(evaluated(s).points[0].branch.branch, Branch::slip);
  press_on(0, -20, Vec2::Zero(), s);
  EXPECT_EQ(evaluated(s).points[0].history.facet, 1);
  EXPECT_EQ(evaluated(s).points[0].status, Status::open);
}

TEST(ReentrantVertex, ForcesBalance) {
  Sample s = make_valley({.nodes_per_facet = 3, .bow = 0.05});
  s.pair.friction = contact::coulomb(0.3, penalty);
  const Vec2 force = 5 * (normal_of({}, 0) + normal_of({}, 1));
  hold_by(force, s);
  const pairing::PairEvaluation<2> e = evaluated(s);
  ASSERT_EQ(e.points[0].branch.branch, Branch::reentrant);
  Vec2 sum = Vec2::Zero();
  double moment = 0;
  for (int k = 0; k < e.blocks[0].count; ++k) {
    const Vec2 f = e.blocks[0].force.segment<2>(2 * k);
    const Vec2& at = s.x[static_cast<std::size_t>(e.blocks[0].nodes[static_cast<std::size_t>(k)])];
    sum += f;
    moment += at.x() * f.y() - at.y() * f.x();
  }
  EXPECT_NEAR(sum.norm(), 0, 1e-14);
  EXPECT_NEAR(moment, 0, 1e-13);
  const pairing::PointResult<2>& p = e.points[0];
  EXPECT_NEAR((p.normal_traction * p.normal + p.shear() + force).norm(), 0, 1e-13);
}

TEST(ReentrantTangent, IsOfSecondOrder) {
  for (const double mu : {0.0, 0.3})
    for (const auto weight : {pairing::Weight::node, pairing::Weight::reference_area})
      for (const auto& [nodes, bow] : {std::pair(2, 0.0), std::pair(3, 0.05)}) {
        Sample s = make_valley({.nodes_per_facet = nodes, .bow = bow}, {0.004, -0.02});
        s.pair.weight = weight;
        s.pair.reference_areas = {0.7};
        if (mu > 0) s.pair.friction = contact::coulomb(mu, 80.0);
        hold_by(90 * (normal_of({}, 0) + normal_of({}, 1)), s);
        const Eigen::VectorXd v = s.packed();
        const auto branch = [&](const Eigen::VectorXd& y) {
          return s.evaluation(y, false).points[0].branch.branch;
        };
        ASSERT_EQ(branch(v), Branch::reentrant);
        expect_derivative([&](const Eigen::VectorXd& y) { return s.residual(y); }, s.tangent(v),
                          branch, v, 1e-3);
        const Eigen::MatrixXd k = s.tangent(v);
        EXPECT_LT((k - k.transpose()).norm(), 1e-13 * k.norm());
      }
}

/// The facets' own branches have a shear without friction: it vanishes.
TEST(ReentrantTangent, OfFacetsWithoutFriction) {
  Sample s = make_valley({.nodes_per_facet = 3, .bow = 0.05}, {-0.6, 0.7});
  press_on(0, -90, Vec2(3, 1), s);
  const Eigen::VectorXd v = s.packed();
  const auto branch = [&](const Eigen::VectorXd& y) {
    return s.evaluation(y, false).points[0].branch.branch;
  };
  ASSERT_EQ(branch(v), Branch::slip);
  expect_derivative([&](const Eigen::VectorXd& y) { return s.residual(y); }, s.tangent(v), branch,
                    v, 1e-3);
  const Eigen::MatrixXd k = s.tangent(v);
  EXPECT_LT((k - k.transpose()).norm(), 1e-13 * k.norm());
  const pairing::PairEvaluation<2> e = s.evaluation(v, false);
  EXPECT_NEAR((e.blocks[0].constraint.shear + s.multipliers[0].shear).norm(), 0, 1e-14);
}

TEST(ReentrantVertex, NothingIsAllocatedAfterTheFirstCall) {
  Sample s = make_valley({});
  s.pair.friction = contact::coulomb(0.3, penalty);
  hold_by(5 * (normal_of({}, 0) + normal_of({}, 1)), s);
  pairing::ActiveSet<2> active_set;
  active_set.branch = s.active_set;
  pairing::PairMultipliers<2> taken;
  taken.points = s.multipliers;
  pairing::PairEvaluation<2> e;
  const auto evaluate = [&] {
    pairing::evaluate<2>(s.pair, s.x, s.committed, true, e, active_set, &taken);
  };
  evaluate();
  ASSERT_EQ(e.points[0].branch.branch, Branch::reentrant);
  const std::size_t before = allocation_count();
  evaluate();
  EXPECT_EQ(allocation_count(), before);
}

/// What rested in the re-entrant vertex is predicted to stay, whatever rounding says.
TEST(ReentrantVertex, IsRememberedFromIncrementToIncrement) {
  Sample s = make_valley({}, Vec2(1e-15, -1e-15));
  s.committed.points[0] = remembered(true, 0, Feature::corner, 1, 0, 0);
  const pairing::ActiveSet<2> active_set =
      pairing::committed_active_set<2>(s.pair, s.committed, s.x);
  EXPECT_EQ(active_set.branch[0].branch, Branch::reentrant);
  pairing::PairEvaluation<2> e;
  pairing::PairMultipliers<2> none;
  none.points.resize(1);
  pairing::evaluate<2>(s.pair, s.x, s.committed, true, e, active_set, &none);
  EXPECT_EQ(e.points[0].branch.branch, Branch::reentrant);
  s.pair.enforcement = pairing::ByMultipliers{};
  EXPECT_EQ(pairing::committed_active_set<2>(s.pair, s.committed, s.x).branch[0].branch,
            Branch::stick);
}

}  // namespace
}  // namespace osculate::testing
