// Contact of edge-edge contact edges: closed form, derivative by order, balance, friction, and one
// contact for one place.
#include <gtest/gtest.h>

#include <random>

#include "edge_sample.hpp"
#include "expect_derivative.hpp"
#include "pair_checks.hpp"

namespace osculate::testing {
namespace {

using cell::CellType;
using contact::ResidualForm;
using contact::Status;
using pairing::Weight;
using projection::Feature;

constexpr std::array<CellType, 5> types{CellType::tri3, CellType::tri6, CellType::quad4,
                                        CellType::quad8, CellType::quad9};

RoofOptions roofs_of(CellType type, double depth = 0.05) {
  return {.type = type, .bend = cell::info(type).nodes > 4 ? 0.05 : 0.0, .depth = depth};
}

/// The one contact there is: the edge-edge contact.
const pairing::PointResult<3>& only(const PairSample3& s, const pairing::PairEvaluation<3>& e) {
  if (edge_contacts(s, e) != 1) throw std::runtime_error("not one crossing");
  for (std::size_t i = 0; i < s.pair.slave.nodes.size(); ++i)
    if (e.points[i].status != Status::open) throw std::runtime_error("a node is in contact");
  return e.points.back();
}

TEST(EdgeContact, NodesAloneDoNotSeeIt) {
  for (const CellType type : types) {
    PairSample3 s = make_roofs(roofs_of(type));
    EXPECT_EQ(only(s, evaluated(s)).status, Status::slip) << cell::info(type).name;
    s.pair.sampler = pairing::AtPoints{};
    const pairing::PairEvaluation<3> e = evaluated(s);
    EXPECT_EQ(edge_contacts(s, e), 0u);
    for (const pairing::PointResult<3>& p : e.points) EXPECT_EQ(p.status, Status::open);
  }
}

// Straight ridges: the distance of two lines along their common perpendicular.
TEST(EdgeContact, GapNormalAndForceOfTwoLines) {
  const PairSample3 s = make_roofs({});
  const pairing::PairEvaluation<3> e = evaluated(s);
  const pairing::PointResult<3>& p = only(s, e);
  const pairing::EdgeContact& edges = *pairing::edges_of(s.pair);
  const pairing::SharpEdge &m = edges.master.at(0), &r = edges.slave.at(0);
  const auto at = [&](Index n) { return s.x[static_cast<std::size_t>(n)]; };
  const Vec3 a = at(m.nodes[1]) - at(m.nodes[0]), b = at(r.nodes[1]) - at(r.nodes[0]);
  Vec3 n = a.cross(b).normalized();
  if (n.z() < 0) n = -n;
  const double gap = n.dot(at(r.nodes[0]) - at(m.nodes[0]));
  EXPECT_LT(gap, -0.04);
  EXPECT_NEAR(p.gap, gap, 1e-14);
  EXPECT_LT((p.normal - n).norm(), 1e-14);
  EXPECT_EQ(p.history.feature, Feature::edge);
  EXPECT_NEAR(p.foot.y(), 0.0, 1e-14);  // on the master's ridge
  Vec3 on_slave = Vec3::Zero();
  const pairing::ContactBlock<3>& block = e.blocks.back();
  for (int k = 0; k < block.count; ++k)
    if (block.nodes[static_cast<std::size_t>(k)] == r.nodes[0] ||
        block.nodes[static_cast<std::size_t>(k)] == r.nodes[1])
      on_slave += block.force.segment<3>(3 * k);
  EXPECT_LT((on_slave - 1000 * gap * n).norm(), 1e-11);
}

Status status_at(PairSample3 s, const Eigen::VectorXd& v) {
  s.x = unflatten<3>(v);
  return only(s, evaluated(s)).status;
}

void expect_second_order(const PairSample3& s, Status status) {
  const Eigen::VectorXd v = flatten(s.x);
  ASSERT_EQ(status_at(s, v), status);
  expect_derivative([&](const Eigen::VectorXd& y) { return pair_residual(s, y); },
                    pair_tangent(s, v), [&](const Eigen::VectorXd& y) { return status_at(s, y); },
                    v, 1e-3);
}

/// After an increment that began with the slave elsewhere, in contact or (first contact inside the
/// increment) above.
PairSample3 after(const RoofOptions& o, double mu, ResidualForm form, Weight weight,
                  const Vec3& from) {
  PairSample3 s = make_roofs(o);
  s.pair.friction = contact::coulomb(mu, 80.0);
  s.pair.residual = form;
  s.pair.weight = weight;
  shift_slave(s, from);
  s.committed = pairing::initial_state(s.pair, s.x);
  shift_slave(s, {0.01, 0.02, 0});
  const pairing::PairEvaluation<3> e = evaluated(s);
  s.committed = pairing::commit(e);
  shift_slave(s, -from - Vec3(0.01, 0.02, 0));
  return s;
}

class EdgeTangent
    : public ::testing::TestWithParam<std::tuple<double, double, ResidualForm, Weight>> {};

TEST_P(EdgeTangent, IsTheDerivativeOfTheResidual) {
  const auto [mu, depth, form, weight] = GetParam();
  for (const CellType type : types)
    for (const double rise : {0.01, 0.3}) {
      SCOPED_TRACE(std::string(cell::info(type).name) + " from " + std::to_string(rise));
      const PairSample3 s = after(roofs_of(type, depth), mu, form, weight, {0.07, -0.04, rise});
      expect_second_order(s, mu > 1 ? Status::stick : Status::slip);
    }
}

INSTANTIATE_TEST_SUITE_P(
    AllForms, EdgeTangent,
    ::testing::Combine(::testing::Values(1e-3, 1e3), ::testing::Values(0.02, 0.1),
                       ::testing::Values(ResidualForm::surface, ResidualForm::full),
                       ::testing::Values(Weight::node, Weight::reference_area,
                                         Weight::current_area)));

TEST(EdgeContact, FrictionlessIsSymmetricAndOfSecondOrder) {
  for (const CellType type : types) {
    const PairSample3 s = make_roofs(roofs_of(type));
    expect_second_order(s, Status::slip);
    expect_symmetric_tangent(s);
  }
}

TEST(EdgeContact, ForcesBalanceAlwaysMomentsWhenFrictionlessOrFull) {
  for (const CellType type : types)
    for (const double mu : {0.0, 0.2, 1e3})
      for (const ResidualForm form : {ResidualForm::surface, ResidualForm::full}) {
        PairSample3 s = after(roofs_of(type), mu, form, Weight::node, {0.07, -0.04, 0.01});
        if (mu == 0) s.pair.friction.reset();
        const Eigen::VectorXd r = pair_residual(s, flatten(s.x));
        ASSERT_GT(r.norm(), 1.0);
        EXPECT_LT(net_force<3>(r).norm(), 1e-13 * r.norm());
        if (mu == 0 || form == ResidualForm::full) {
          EXPECT_LT(net_moment(s, r).norm(), 1e-12 * r.norm()) << cell::info(type).name;
        }
      }
}

TEST(EdgeContact, FrameIndifference) {
  const Mat<3, 3> q = Eigen::AngleAxisd(2.3, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
  for (const CellType type : types)
    for (const double mu : {0.2, 1e3}) {
      PairSample3 s =
          after(roofs_of(type), mu, ResidualForm::full, Weight::node, {0.07, -0.04, 0.01});
      const Eigen::VectorXd r = pair_residual(s, flatten(s.x));
      for (Vec3& x : s.x) x = q * x + Vec3(5, -7, 3);
      Eigen::VectorXd turned = pair_residual(s, flatten(s.x));
      for (Eigen::Index n = 0; n < r.size() / 3; ++n)
        turned.segment<3>(3 * n) = q.transpose() * Vec3(turned.segment<3>(3 * n));
      EXPECT_LT((turned - r).norm(), 1e-11 * r.norm()) << cell::info(type).name;
    }
}

// Exchanged roles: the same force the other way.
TEST(EdgeContact, MasterAndSlaveMayBeExchanged) {
  PairSample3 s = make_roofs({});
  const Eigen::VectorXd r = pair_residual(s, flatten(s.x));
  PairSample3 t = s;
  t.pair.master = s.pair.slave.boundary;
  t.pair.slave = pairing::make_slave_side(s.pair.master);
  pairing::prepare(t.pair, t.x);
  t.committed.points.assign(t.pair.slave.nodes.size(), {});
  EXPECT_LT((pair_residual(t, flatten(t.x)) - r).norm(), 1e-12 * r.norm());
}

// --- friction -----------------------------------------------------------------------------------

// A slave dragged along the master's ridge, which is cut into pieces, there and back.
TEST(EdgeContact, StickIsCarriedOverThePiecesOfAnEdgeAndIsReversible) {
  for (const int pieces : {1, 5, 8}) {
    PairSample3 s = make_roofs({.pieces = pieces});
    s.pair.friction = contact::coulomb(1e6, 80.0);
    s.committed = pairing::initial_state(s.pair, s.x);
    ASSERT_TRUE(s.committed.points.back().active);
    double most = 0;
    const auto go = [&](double along) {
      shift_slave(s, {along, 0, 0});
      const pairing::PairEvaluation<3> e = evaluated(s);
      const pairing::PointResult<3>& p = only(s, e);
      ASSERT_EQ(p.status, Status::stick);
      most = p.shear().norm();
      s.committed = pairing::commit(e);
    };
    for (int i = 0; i < 10; ++i) go(0.11);
    EXPECT_NEAR(most, 80 * 1.1, 1e-9)
        << pieces;  // the way of the edge-edge contact along the ridge
    for (int i = 0; i < 10; ++i) go(-0.11);
    EXPECT_LT(most, 1e-9) << pieces;
  }
}

TEST(EdgeContact, SlipIsLimitedAndOpposesTheMotion) {
  PairSample3 s = make_roofs({});
  s.pair.friction = contact::coulomb(0.3, 1e4);
  s.committed = pairing::initial_state(s.pair, s.x);
  shift_slave(s, {0.2, 0, 0});
  const pairing::PairEvaluation<3> e = evaluated(s);
  const pairing::PointResult<3>& p = only(s, e);
  EXPECT_EQ(p.status, Status::slip);
  EXPECT_NEAR(p.shear().norm(), -0.3 * p.normal_traction, 1e-10);
  EXPECT_GT(p.shear().x(), 0);
  EXPECT_GT(p.history.friction_work, 0);
}

TEST(EdgeContact, ASharedNodeOfTwoPiecesIsOnePlace) {
  for (const double off : {-1e-3, -1e-6, -1e-12, 0.0, 1e-12, 1e-6, 1e-3}) {
    PairSample3 s = make_roofs({.pieces = 4});  // nodes of the ridge at -2, -1, 0, 1, 2
    const double at = only(s, evaluated(s)).foot.x();
    shift_slave(s, {1 + off - at, 0, 0});
    EXPECT_NEAR(only(s, evaluated(s)).foot.x(), 1 + off, 1e-13) << off;
  }
}

// --- what is not an edge contact
// ------------------------------------------------------------------

TEST(EdgeContact, SharpnessIsAnAngle) {
  PairSample3 s = make_roofs({});
  EXPECT_EQ(pairing::sharp_edges(s.pair.master, s.x, 1.5).size(), 1u);  // 90 degrees
  EXPECT_EQ(pairing::sharp_edges(s.pair.master, s.x, 1.6).size(), 0u);
  for (pairing::SurfaceFacet& f : s.pair.master.facets) std::swap(f.nodes[1], f.nodes[3]);
  pairing::connect(s.pair.master);  // the body above: a re-entrant vertex
  EXPECT_EQ(pairing::sharp_edges(s.pair.master, s.x, 0.5).size(), 0u);
}

// The place belongs to the node: the end of the slave's ridge is inside the master too.
TEST(EdgeContact, ANodeInContactTakesTheCrossing) {
  PairSample3 s = make_roofs({});
  const pairing::SharpEdge& ridge = pairing::edges_of(s.pair)->slave.at(0);
  const auto node = static_cast<std::size_t>(ridge.nodes[1]);
  const Vec3 before = s.x[node];
  const auto contacts = [&] {
    const pairing::PairEvaluation<3> e = evaluated(s);
    int count = 0;
    for (const pairing::PointResult<3>& p : e.points) count += p.status != Status::open ? 1 : 0;
    return std::pair<int, std::size_t>(count, edge_contacts(s, e));
  };
  EXPECT_EQ(contacts(), (std::pair<int, std::size_t>(1, 1)));
  const Vec3 foot = evaluated(s).points.back().foot;
  s.x[node] = foot + 0.1 * (before - foot) / (before - foot).norm() - Vec3(0, 0, 0.3);
  EXPECT_EQ(contacts(), (std::pair<int, std::size_t>(1, 0)));
}

/// The six faces of a box.
pairing::FacetSurface add_box(std::vector<Vec3>& x, const Vec3& low, const Vec3& high,
                              double turn) {
  const auto first = static_cast<Index>(x.size());
  const Mat<3, 3> q = Eigen::AngleAxisd(turn, Vec3::UnitZ()).toRotationMatrix();
  const Vec3 middle = 0.5 * (low + high);
  for (const double z : {low.z(), high.z()})
    for (const Vec2& p : {Vec2(low.x(), low.y()), Vec2(high.x(), low.y()), Vec2(high.x(), high.y()),
                          Vec2(low.x(), high.y())})
      x.push_back(middle + q * (Vec3(p.x(), p.y(), z) - middle));
  pairing::FacetSurface box;
  for (const std::array<Index, 4>& f :
       {std::array<Index, 4>{0, 3, 2, 1}, std::array<Index, 4>{4, 5, 6, 7},
        std::array<Index, 4>{0, 1, 5, 4}, std::array<Index, 4>{1, 2, 6, 5},
        std::array<Index, 4>{2, 3, 7, 6}, std::array<Index, 4>{3, 0, 4, 7}})
    box.facets.push_back(pairing::surface_facet(
        CellType::quad4,
        std::array<Index, 4>{first + f[0], first + f[1], first + f[2], first + f[3]}));
  pairing::connect(box);
  return box;
}

// Flat faces on each other: their borders cross, but the nodes' contact with the faces is all.
TEST(EdgeContact, FlushFacesAreTheNodesAffair) {
  for (const double turn : {0.0, 0.5, std::acos(-1.0) / 4}) {
    PairSample3 s;
    s.pair.master = add_box(s.x, {-1, -1, -1}, {1, 1, 0}, 0.0);
    const pairing::FacetSurface slave = add_box(s.x, {-1, -1, -0.01}, {1, 1, 1}, turn);
    s.pair.slave = pairing::make_slave_side(slave);
    s.pair.normal = contact::penalty(1000.0);
    s.pair.weight = Weight::node;
    s.pair.sampler = pairing::AtEdgesToo{};
    pairing::prepare(s.pair, s.x);
    s.committed = pairing::initial_state(s.pair, s.x);
    EXPECT_EQ(pairing::edges_of(s.pair)->master.size(), 12u);
    EXPECT_EQ(edge_contacts(s, evaluated(s)), 0u) << turn;
  }
}

}  // namespace
}  // namespace osculate::testing
