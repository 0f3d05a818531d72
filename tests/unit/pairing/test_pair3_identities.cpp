// Exact identities of contact in space: balance, frame indifference, the plane as a special case,
// reversibility, parts of the covariant tangent.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/QR>

#include "pair_checks.hpp"

namespace osculate::testing {
namespace {

using cell::CellType;
using contact::ResidualForm;

PairSample3 sample_of(CellType type, double mu, ResidualForm form, double bend = 0.03) {
  SampleOptions3 o{.type = type, .bend = bend, .depth = 0.1};
  if (cell::is_triangle(type)) o.at = 2, o.xi = {0.3, 0.4};
  PairSample3 s = make_sample3(o);
  if (mu > 0) s.pair.friction = contact::coulomb(mu, 80.0);
  s.pair.residual = form;
  s.committed.points[0] = remembered(o.at, o.xi - Vec2(0.1, 0.05), -0.01, {4, -3});
  return s;
}

constexpr std::array<CellType, 5> types{CellType::tri3, CellType::tri6, CellType::quad4,
                                        CellType::quad8, CellType::quad9};

TEST(Pair3Identities, ForcesBalanceAlwaysMomentsWhenFrictionlessOrFull) {
  for (const CellType type : types)
    for (const double mu : {0.0, 0.02, 10.0})
      for (const ResidualForm form : {ResidualForm::surface, ResidualForm::full}) {
        const PairSample3 s = sample_of(type, mu, form);
        const Eigen::VectorXd r = pair_residual(s, flatten(s.x));
        ASSERT_GT(r.norm(), 1.0);
        EXPECT_LT(net_force<3>(r).norm(), 1e-13 * r.norm());
        if (mu == 0.0 || form == ResidualForm::full) {
          EXPECT_LT(net_moment(s, r).norm(), 1e-12 * r.norm()) << cell::info(type).name;
        } else {
          EXPECT_GT(net_moment(s, r).norm(), 1e-4 * r.norm());  // t times the gap
        }
      }
}

TEST(Pair3Identities, FrameIndifference) {
  const Mat<3, 3> q = Eigen::AngleAxisd(2.3, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
  for (const CellType type : types)
    for (const double mu : {0.02, 10.0}) {
      PairSample3 s = sample_of(type, mu, ResidualForm::full);
      const Eigen::VectorXd r = pair_residual(s, flatten(s.x));
      for (Vec3& x : s.x) x = q * x + Vec3(5, -7, 3);
      Eigen::VectorXd turned = pair_residual(s, flatten(s.x));
      for (Eigen::Index n = 0; n < r.size() / 3; ++n)
        turned.segment<3>(3 * n) = q.transpose() * Vec3(turned.segment<3>(3 * n));
      EXPECT_LT((turned - r).norm(), 1e-12 * r.norm()) << cell::info(type).name;
    }
}

/// The chain of the plane sample, extruded along -z over a width of 2 (so that n = r_1 x r_2).
PairSample3 extruded(const PairSample& plane) {
  PairSample3 s;
  const std::size_t master = plane.x.size() - 2;
  for (const double z : {1.0, -1.0})
    for (std::size_t n = 0; n < master; ++n) s.x.emplace_back(plane.x[n].x(), plane.x[n].y(), z);
  const auto back = static_cast<Index>(master);
  for (const pairing::Facet& f : plane.pair.master.facets)
    s.pair.master.facets.push_back(pairing::surface_facet(
        CellType::quad4,
        std::array<Index, 4>{f.nodes[0], f.nodes[1], back + f.nodes[1], back + f.nodes[0]}));
  pairing::connect(s.pair.master);
  const auto slave = static_cast<Index>(s.x.size());
  s.x.emplace_back(plane.x[master].x(), plane.x[master].y(), 0.3);
  s.pair.slave = pairing::make_slave_side(pairing::FacetSurface{}, std::array<Index, 1>{slave});
  s.pair.weight = pairing::Weight::node;
  s.pair.normal = plane.pair.normal;
  s.pair.friction = plane.pair.friction;
  s.pair.residual = plane.pair.residual;
  s.committed.points.resize(1);
  pairing::prepare(s.pair, s.x);
  return s;
}

// Also over the kink between two facets, where the way over the edge is exact.
TEST(Pair3Identities, ThePlaneIsASpecialCase) {
  for (const double mu : {0.02, 10.0})
    for (const Index from : {0, 1, 2})
      for (const ResidualForm form : {ResidualForm::surface, ResidualForm::full}) {
        PairSample plane = make_sample({.depth = 0.05});
        plane.x[1].y() += 0.1;  // kinks
        plane.x[2].y() -= 0.1;
        plane.pair.friction = contact::coulomb(mu, 80.0);
        plane.pair.weight = pairing::Weight::node;
        plane.pair.residual = form;
        plane.pair.slave = pairing::make_slave_side(
            pairing::Chain{}, std::array<Index, 1>{static_cast<Index>(plane.x.size()) - 2});
        pairing::prepare(plane.pair, plane.x);
        PairSample3 space = extruded(plane);
        plane.committed.points.resize(1);
        plane.committed.points[0] =
            remembered(true, from, projection::Feature::face, 0.3, -0.01, 2.0);
        space.committed.points[0] = remembered(from, {0.3, -0.3}, -0.01, {2.0, 0.0});
        pairing::PairEvaluation<2> e2;
        pairing::PairEvaluation<3> e3;
        pairing::evaluate(plane.pair, plane.x, plane.committed, true, e2);
        pairing::evaluate(space.pair, space.x, space.committed, true, e3);
        ASSERT_NE(e2.points[0].status, contact::Status::open);
        EXPECT_EQ(e2.points[0].status, e3.points[0].status);
        EXPECT_NEAR(e2.points[0].gap, e3.points[0].gap, 1e-14);
        EXPECT_NEAR(e2.points[0].shear_traction[0], e3.points[0].shear_traction[0], 1e-11);
        EXPECT_NEAR(e3.points[0].shear_traction[1], 0.0, 1e-12);
        EXPECT_LT((e2.blocks[0].force.head<2>() - e3.blocks[0].force.head<2>()).norm(), 1e-11);
        EXPECT_LT((e2.blocks[0].tangent.topLeftCorner<2, 2>() -
                   e3.blocks[0].tangent.topLeftCorner<2, 2>())
                      .norm(),
                  1e-9);
      }
}

// A point dragged in stick over all facets (1 : 3 : 1 and a kink of 50 degrees) and back.
TEST(Pair3Identities, StickIsReversibleOverUnequalFacetsAndAKink) {
  PairSample3 s = make_sample3({.type = CellType::quad4, .kink = 1.2});
  s.pair.friction = contact::coulomb(1e6, 80.0);
  s.pair.weight = pairing::Weight::node;
  const std::size_t slave = s.x.size() - 4;
  s.pair.slave = pairing::make_slave_side(pairing::FacetSurface{},
                                          std::array<Index, 1>{static_cast<Index>(slave)});
  std::vector<Vec3> way;
  for (const double along : {0.2, 0.7, 1.4, 2.4, 3.4, 3.9, 4.2, 4.7}) {
    const double height = along > 4 ? 1.2 * (along - 4) : 0.0;
    const Vec3 n = along > 4 ? Vec3(-1.2, 0, 1).normalized() : Vec3(0, 0, 1);
    way.emplace_back(Vec3(along, 0.3 * along - 0.5, height) - 0.02 * n);
  }
  s.x[slave] = way[0];
  s.committed = pairing::initial_state(s.pair, s.x);
  ASSERT_TRUE(s.committed.points[0].active);
  pairing::PairEvaluation<3> e;
  double largest = 0;
  const auto go = [&](const Vec3& to) {
    s.x[slave] = to;
    pairing::evaluate(s.pair, s.x, s.committed, false, e);
    ASSERT_EQ(e.points[0].status, contact::Status::stick);
    largest = std::max(largest, e.points[0].shear_traction.norm());
    s.committed = pairing::commit(e);
  };
  for (std::size_t i = 1; i < way.size(); ++i) go(way[i]);
  // the length of the way, which is straight in the unfolded surface
  const double unfolded = 3.8 + 0.7 * std::sqrt(1 + 1.2 * 1.2);
  const double expected = 80.0 * std::hypot(unfolded, 0.3 * 4.5);
  EXPECT_NEAR(largest, expected, 1e-9 * expected);
  for (std::size_t i = way.size() - 1; i-- > 0;) go(way[i]);
  EXPECT_LT(e.points[0].shear_traction.norm(), 1e-12 * largest);
}

// [eq:KSVD:56] [eq:KSVD:57] [eq:KSVD:58] the parts are right to the first power of the gap: exact
// minus all parts falls with its square; without one part with its first power.
TEST(Pair3Identities, CovariantNormalPartsAreRightToFirstOrderInTheGap) {
  for (const CellType type : {CellType::quad4, CellType::quad8, CellType::quad9}) {
    const auto missed = [&](double depth, const contact::TangentForm& form) {
      PairSample3 s = make_sample3({.type = type, .bend = 0.05, .depth = depth});
      s.pair.weight = pairing::Weight::node;
      const Eigen::MatrixXd exact = pair_tangent(s, flatten(s.x));
      s.pair.tangent = form;
      return (pair_tangent(s, flatten(s.x)) - exact).norm();
    };
    const auto order = [&](const contact::TangentForm& form) {
      return std::log2(missed(2e-3, form) / missed(1e-3, form));
    };
    EXPECT_NEAR(order({false, true, true, true}), 2.0, 0.05) << cell::info(type).name;
    EXPECT_NEAR(order({false, true, false, true}), 1.0, 0.05) << cell::info(type).name;
    EXPECT_NEAR(order({false, true, true, false}), 1.0, 0.05) << cell::info(type).name;
  }
}

// The curvature part vanishes on a flat facet; the main part has rank one.
TEST(Pair3Identities, CovariantPartsOfAFlatFacet) {
  PairSample3 s = make_sample3({.type = CellType::quad4});
  s.pair.weight = pairing::Weight::node;
  s.pair.tangent = {false, false, false, true};
  EXPECT_LT(pair_tangent(s, flatten(s.x)).norm(), 1e-12);
  s.pair.tangent = {false, true, false, false};
  EXPECT_EQ(pair_tangent(s, flatten(s.x)).fullPivHouseholderQr().rank(), 1);
}

// [eq:KS2D:56] in space: symmetric in stick, whatever is carried.
TEST(Pair3Identities, CovariantStickIsSymmetric) {
  for (const CellType type : types) {
    PairSample3 s = sample_of(type, 10.0, ResidualForm::surface);
    s.pair.tangent.consistent = false;
    expect_symmetric_tangent(s);
  }
}

}  // namespace
}  // namespace osculate::testing
