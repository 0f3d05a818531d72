// Penalties of single points: each point is that of a pair which has its penalty.
#include "osculate/contact/law/damping.hpp"
#include "osculate/pairing/point_penalty.hpp"

#include <gtest/gtest.h>
#include <algorithm>

#include "edge_sample.hpp"
#include "expect_derivative.hpp"
#include "mortar_sample.hpp"
#include "multiplier_sample.hpp"
#include "osculate/pairing/tangent_parts.hpp"
#include "segment_sample.hpp"

namespace osculate::testing {
namespace {

using contact::Status;
using pairing::RelativeStiffness;

/// A pair, a configuration, a history, and what the penalties act around.
template <int Dim>
struct Case {
  std::string name;
  pairing::PairDefinition<Dim> pair;
  std::vector<Vec<Dim>> x;
  pairing::PairState<Dim> committed;
  pairing::PairMultipliers<Dim> multipliers{};
  double stick = 0;  ///< friction coefficient with which the points stick

  [[nodiscard]] pairing::PairEvaluation<Dim> evaluation(const Eigen::VectorXd& v,
                                                        bool tangent) const {
    pairing::PairEvaluation<Dim> e;
    pairing::evaluate<Dim>(pair, unflatten<Dim>(v), committed, tangent, e, {},
                           multipliers.points.empty() ? nullptr : &multipliers);
    return e;
  }
  [[nodiscard]] Eigen::VectorXd residual(const Eigen::VectorXd& v) const {
    return assembled_force(evaluation(v, false), v.size());
  }
  [[nodiscard]] Eigen::MatrixXd tangent(const Eigen::VectorXd& v) const {
    return assembled_tangent(evaluation(v, true), v.size());
  }
};

template <int Dim>
Case<Dim> case_of(const std::string& name, const ContactSample<Dim>& s) {
  Case<Dim> c{name, s.pair, s.x, s.committed};
  return c;
}

std::vector<Case<2>> plane_cases() {
  PairSample nodes = segment_sample({.bend = 0.02});
  nodes.pair.slave = pairing::make_slave_side(nodes.pair.slave.boundary);
  pairing::prepare(nodes.pair, nodes.x);
  remember_all<2>(nodes, Vec2(0.03, 0.01), 4);
  PairSample gauss = segment_sample({.slave_nodes = 3, .bend = 0.02});
  gauss.pair.weight = pairing::Weight::current_area;
  remember_all<2>(gauss, Vec2(0.03, 0.01), 4);
  ContactSample<2> mortar = make_mortar2({.bend = 0.01, .uneven = 0.2});
  remember<2>(mortar, Vec2(0.05, 0), Vec<1>(4.0), true);
  return {case_of<2>("nodes", nodes), case_of<2>("gauss", gauss), case_of<2>("mortar", mortar)};
}

std::vector<Case<3>> space_cases() {
  PairSample3 nodes = segment_sample3({.bend = 0.02});
  nodes.pair.slave = pairing::make_slave_side(nodes.pair.slave.boundary);
  pairing::prepare(nodes.pair, nodes.x);
  remember_all<3>(nodes, Vec3(0.03, 0.01, 0.01), 4);
  PairSample3 gauss = segment_sample3({.bend = 0.02});
  remember_all<3>(gauss, Vec3(0.03, 0.01, 0.01), 4);
  ContactSample<3> mortar = make_mortar3({.bend = 0.01});
  remember<3>(mortar, Vec3(0.05, 0.02, 0), Vec2(4, 1), true);
  return {case_of<3>("nodes", nodes), case_of<3>("gauss", gauss), case_of<3>("mortar", mortar)};
}

/// Without friction, sticking, slipping.
template <int Dim>
std::vector<Case<Dim>> with_laws(const Case<Dim>& c) {
  std::vector<Case<Dim>> all(3, c);
  all[0].name += ", frictionless";
  all[1].name += ", stick";
  all[1].pair.friction = contact::coulomb(10.0, 80.0);
  all[2].name += ", slip";
  all[2].pair.friction = contact::coulomb(0.01, 80.0);
  return all;
}

/// The same around multipliers, and with multipliers that are unknowns (at nodes).
template <int Dim>
std::vector<Case<Dim>> with_enforcement(const Case<Dim>& c) {
  std::vector<Case<Dim>> all(1, c);
  Case<Dim> multipliers = c;
  multipliers.pair.enforcement = pairing::ByAugmentedLagrange{};
  multipliers.multipliers.stiffening = 10;
  multipliers.multipliers.points.assign(c.pair.slave.points.size(), {-20.0, shear_of<Dim>(3)});
  all.push_back(multipliers);
  all.back().name += ", augmented";
  if (!pairing::sampled_at_nodes(c.pair.slave)) return all;
  multipliers.multipliers.stiffening = 1;
  multipliers.pair.enforcement = pairing::ByMultipliers{};
  all.push_back(multipliers);
  all.back().name += ", unknown";
  return all;
}

/// Powers of two: products with them are exact. `by_facet`: one for all points of the same nodes,
/// whose tangents are in one block.
template <int Dim>
void give_factors(pairing::PairDefinition<Dim>& pair, bool by_facet = false) {
  const auto& points = pair.slave.points;
  std::size_t number = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i > 0 && !(by_facet && points[i].nodes == points[i - 1].nodes)) ++number;
    const int k = static_cast<int>(number % 7) - 3;
    pair.relative_stiffness.push_back({std::exp2(k), std::exp2(2 - k)});
  }
}

/// The pair whose penalties are those of one of its points.
template <int Dim>
pairing::PairDefinition<Dim> pair_like(pairing::PairDefinition<Dim> pair, std::size_t point) {
  const RelativeStiffness own = pair.relative_stiffness[point];
  pair.relative_stiffness.clear();
  pair.normal = contact::penalty(own.normal * contact::penalty_of(pair.normal));
  if (pair.friction) pair.friction = pair.friction->stiffened(own.shear);
  return pair;
}

template <int Dim>
void expect_same_constraint(const pairing::ConstraintBlock<Dim>& a,
                            const pairing::ConstraintBlock<Dim>& b, int rows) {
  ASSERT_EQ(a.on, b.on);
  if (!a.on) return;
  EXPECT_EQ(a.normal, b.normal);
  EXPECT_EQ(a.shear, b.shear);
  EXPECT_EQ(a.scale, b.scale);
  EXPECT_EQ(a.own, b.own);
  if (rows > 0) {
    EXPECT_EQ(a.columns.topRows(rows), b.columns.topRows(rows));
  }
  ASSERT_EQ(a.normal_row.size(), b.normal_row.size());
  ASSERT_EQ(a.shear_row.size(), b.shear_row.size());
  for (std::size_t k = 0; k < a.normal_row.size(); ++k)
    EXPECT_EQ(a.normal_row[k].value, b.normal_row[k].value);
  for (std::size_t k = 0; k < a.shear_row.size(); ++k)
    EXPECT_EQ(a.shear_row[k].value, b.shear_row[k].value);
}

template <int Dim>
void expect_same_point(const pairing::PairEvaluation<Dim>& a, const pairing::PairEvaluation<Dim>& b,
                       std::size_t i, bool tangents) {
  const pairing::PointResult<Dim>&p = a.points[i], &q = b.points[i];
  EXPECT_EQ(p.status, q.status);
  EXPECT_EQ(p.normal_traction, q.normal_traction);
  EXPECT_EQ(p.shear_traction, q.shear_traction);
  EXPECT_EQ(p.stored, q.stored);
  EXPECT_EQ(p.history.traction, q.history.traction);
  EXPECT_EQ(p.history.slid, q.history.slid);
  EXPECT_EQ(p.history.friction_work, q.history.friction_work);
  const pairing::ContactBlock<Dim>&k = a.blocks[i], &l = b.blocks[i];
  ASSERT_EQ(k.count, l.count);
  const int rows = Dim * k.count;
  EXPECT_EQ(k.force.head(rows), l.force.head(rows));
  ASSERT_EQ(k.has_tangent(), l.has_tangent());
  if (tangents && k.has_tangent()) {
    EXPECT_EQ(k.tangent.topLeftCorner(rows, rows), l.tangent.topLeftCorner(rows, rows));
  }
  ASSERT_EQ(k.path().size(), l.path().size());
  for (std::size_t n = 0; n < k.path().size(); ++n) EXPECT_EQ(k.path()[n].value, l.path()[n].value);
  expect_same_constraint(k.constraint, l.constraint, rows);
}

template <int Dim>
void expect_points_like_pairs(Case<Dim> c, bool by_facet) {
  give_factors(c.pair, by_facet);
  const Eigen::VectorXd v = flatten(c.x);
  const pairing::PairEvaluation<Dim> all = c.evaluation(v, true);
  int closed = 0;
  for (std::size_t i = 0; i < c.pair.slave.points.size(); ++i) {
    SCOPED_TRACE(c.name + ", point " + std::to_string(i));
    Case<Dim> one = c;
    one.pair = pair_like(c.pair, i);
    expect_same_point(all, one.evaluation(v, true), i, by_facet);
    closed += all.points[i].status != Status::open ? 1 : 0;
  }
  EXPECT_GT(closed, 1) << c.name;
}
template <int Dim>
void expect_points_like_pairs(const Case<Dim>& c) {
  for (const bool by_facet : {false, true}) expect_points_like_pairs(c, by_facet);
}

/// Points of a slave facet over one facet of the master have the same nodes, and one tangent.
TEST(PointBlock, PointsOfTheSameNodesHaveOneTangent) {
  int shared = 0;
  for (const Case<3>& c : space_cases()) {
    if (pairing::by_mortar(c.pair)) continue;
    const pairing::PairEvaluation<3> e = c.evaluation(flatten(c.x), true);
    for (std::size_t i = 0; i < c.pair.slave.points.size(); ++i) {
      const pairing::ContactBlock<3>& block = e.blocks[i];
      if (!block.active()) continue;
      const auto same = [&](const pairing::ContactBlock<3>& other) {
        return other.count == block.count &&
               std::equal(block.nodes.begin(), block.nodes.begin() + block.count,
                          other.nodes.begin());
      };
      int holders = 0;
      for (std::size_t j = 0; j < i; ++j)
        holders += e.blocks[j].active() && e.blocks[j].has_tangent() && same(e.blocks[j]) ? 1 : 0;
      EXPECT_EQ(block.has_tangent(), holders == 0) << c.name << ", point " << i;
      shared += block.elsewhere ? 1 : 0;
    }
  }
  EXPECT_GT(shared, 0);
}

TEST(PointPenalty, APointIsThatOfAPairWithItsPenalty) {
  for (const Case<2>& base : plane_cases())
    for (const Case<2>& law : with_laws(base))
      for (const Case<2>& c : with_enforcement(law)) expect_points_like_pairs(c);
  for (const Case<3>& base : space_cases())
    for (const Case<3>& law : with_laws(base))
      for (const Case<3>& c : with_enforcement(law)) expect_points_like_pairs(c);
}

TEST(PointPenalty, ATiedPointIsThatOfAPairWithItsPenalty) {
  for (Case<2> c : plane_cases()) {
    c.pair.separation = pairing::Tied<2>{.tolerance = 1};
    pairing::prepare(c.pair, c.x);
    c.committed = pairing::initial_state<2>(c.pair, c.x);
    for (Vec2& p : c.x) p.y() += 0.01 * p.x() * p.x();  // so that they pull
    c.name += ", tied";
    expect_points_like_pairs(c);
  }
}

TEST(PointPenalty, DampedPointsToo) {
  for (Case<2> c : plane_cases()) {
    c.pair.damping = contact::Restitution{0.5};
    expect_points_like_pairs(c);
  }
}

/// The curvature share of the pair is the largest of those of its points.
TEST(PointPenalty, CurvatureShareSeesIt) {
  Case<2> c = plane_cases()[0];
  give_factors(c.pair);
  const Eigen::VectorXd v = flatten(c.x);
  const double share = pairing::curvature_share<2>(c.pair, c.x, c.evaluation(v, true));
  double largest = 0;
  for (std::size_t i = 0; i < c.pair.slave.points.size(); ++i) {
    Case<2> one = c;
    one.pair = pair_like(c.pair, i);
    pairing::PairEvaluation<2> e = one.evaluation(v, true);
    for (std::size_t k = 0; k < c.pair.slave.points.size(); ++k)
      if (k != i) e.points[k].status = Status::open;
    largest = std::max(largest, pairing::curvature_share<2>(one.pair, c.x, e));
  }
  EXPECT_GT(share, 0);
  EXPECT_EQ(share, largest);
}

/// No powers of two, and far from each other.
template <int Dim>
void give_uneven_factors(pairing::PairDefinition<Dim>& pair) {
  pair.relative_stiffness.clear();
  for (std::size_t i = 0; i < pair.slave.points.size(); ++i) {
    const double t = static_cast<double>(i * i % 5);
    pair.relative_stiffness.push_back({0.03 * std::pow(5.7, t), 9 * std::pow(0.37, t)});
  }
}

template <int Dim>
void expect_second_order(const Case<Dim>& c, double h) {
  SCOPED_TRACE(c.name);
  const auto branch = [&](const Eigen::VectorXd& y) {
    const pairing::PairEvaluation<Dim> e = c.evaluation(y, false);
    return std::pair(states<Dim>(e), e.mortar.overlaps);
  };
  const Eigen::VectorXd v = flatten(c.x);
  expect_derivative([&](const Eigen::VectorXd& y) { return c.residual(y); }, c.tangent(v), branch,
                    v, h);
}

template <int Dim>
void expect_orders(std::vector<Case<Dim>> cases, double h) {
  for (Case<Dim>& base : cases) {
    give_uneven_factors(base.pair);
    for (const Case<Dim>& law : with_laws(base))
      for (const Case<Dim>& c : with_enforcement(law)) {
        if (!pairing::by_multipliers(c.pair)) {
          expect_second_order(c, h);
          continue;
        }
        SCOPED_TRACE(c.name);
        MultiplierSample<Dim> m{c.pair, c.committed, c.x, c.multipliers.points};
        const auto branch = [&](const Eigen::VectorXd& y) {
          const pairing::PairEvaluation<Dim> e = m.evaluation(y, false);
          return std::pair(states<Dim>(e), e.mortar.overlaps);
        };
        const Eigen::VectorXd v = m.packed();
        expect_derivative([&](const Eigen::VectorXd& y) { return m.residual(y); }, m.tangent(v),
                          branch, v, h);
      }
  }
}

TEST(PointPenalty, TangentsAreExactInThePlane) { expect_orders<2>(plane_cases(), 1e-4); }
TEST(PointPenalty, TangentsAreExactInSpace) { expect_orders<3>(space_cases(), 1e-4); }

/// Forces and, with the full residual, moments of the pair balance.
template <int Dim>
void expect_balance(Case<Dim> c) {
  SCOPED_TRACE(c.name);
  give_uneven_factors(c.pair);
  c.pair.residual = contact::ResidualForm::full;
  const Eigen::VectorXd r = c.residual(flatten(c.x));
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  double arm = 0;
  for (std::size_t n = 0; n < c.x.size(); ++n) {
    Vec3 x = Vec3::Zero(), f = Vec3::Zero();
    x.head<Dim>() = c.x[n];
    f.head<Dim>() = r.segment<Dim>(Dim * static_cast<Eigen::Index>(n));
    force += f;
    moment += x.cross(f);
    arm = std::max(arm, x.norm());
  }
  ASSERT_GT(r.norm(), 0);
  EXPECT_LT(force.norm(), 1e-12 * r.norm());
  if (!pairing::by_mortar(c.pair) && !c.pair.friction) {
    EXPECT_LT(moment.norm(), 1e-12 * arm * r.norm());
  }
}

TEST(PointPenalty, ForcesAndMomentsBalance) {
  for (const Case<2>& base : plane_cases())
    for (const Case<2>& c : with_laws(base)) expect_balance(c);
  for (const Case<3>& base : space_cases())
    for (const Case<3>& c : with_laws(base)) expect_balance(c);
}

/// From no traction the first correction is the penalty times the gap: by that penalty it is the
/// gap, whatever the factors.
TEST(PointPenalty, AViolationIsALength) {
  for (Case<2> c : plane_cases()) {
    SCOPED_TRACE(c.name);
    give_uneven_factors(c.pair);
    c.pair.enforcement = pairing::ByAugmentedLagrange{};
    c.multipliers.points.assign(c.pair.slave.points.size(), {});
    const pairing::PairEvaluation<2> e = c.evaluation(flatten(c.x), false);
    double deepest = 0;
    for (const auto& p : e.points)
      if (p.status != Status::open) deepest = std::max(deepest, -p.gap);
    const double violation = pairing::augmented<2>(c.pair, e, c.multipliers).violation;
    EXPECT_GT(deepest, 0);
    EXPECT_NEAR(violation, deepest, 1e-15);
  }
}

/// A edge-edge contact has the mean of the ends of its slave edge.
TEST(PointPenalty, ACrossingHasThatOfItsSlaveEdge) {
  PairSample3 s = make_roofs({});
  const std::size_t nodes = s.pair.slave.points.size();
  const pairing::PairEvaluation<3> usual = evaluated(s);
  ASSERT_GT(usual.points.size(), nodes);
  const pairing::PointResult<3>& edge_contact = usual.points[nodes];
  ASSERT_NE(edge_contact.status, Status::open);
  const auto edge = static_cast<std::size_t>(edge_contact.history.edge);
  s.pair.relative_stiffness.assign(nodes, {});
  const std::array<int, 3> ends = pairing::edges_of(s.pair)->slave_nodes[edge];
  s.pair.relative_stiffness[static_cast<std::size_t>(ends[0])].normal = 2;
  s.pair.relative_stiffness[static_cast<std::size_t>(ends[1])].normal = 6;
  EXPECT_EQ(evaluated(s).points[nodes].normal_traction, 4 * edge_contact.normal_traction);
}

TEST(PointPenalty, RangeIsOverThePoints) {
  Case<2> c = plane_cases()[0];
  c.pair.friction = contact::coulomb(0.3, 80.0);
  pairing::PenaltyRange r = pairing::penalty_range(c.pair);
  EXPECT_EQ(r.smallest.normal, 1000);
  EXPECT_EQ(r.largest.shear, 80);
  EXPECT_NEAR(r.mean.normal, 1000, 1e-12 * 1000);
  c.pair.relative_stiffness.assign(c.pair.slave.points.size(), {2, 0.5});
  c.pair.relative_stiffness[0] = {6, 0.25};
  r = pairing::penalty_range(c.pair);
  EXPECT_EQ(r.smallest.normal, 2000);
  EXPECT_EQ(r.largest.normal, 6000);
  EXPECT_EQ(r.smallest.shear, 20);
  EXPECT_EQ(r.largest.shear, 40);
  double all = 0;
  for (const double a : c.pair.reference_areas) all += a;
  EXPECT_NEAR(r.mean.normal, 2000 + 4000 * c.pair.reference_areas[0] / all, 1e-9);
}

}  // namespace
}  // namespace osculate::testing
