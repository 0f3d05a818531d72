// A surface against itself, in the plane and in space: what is contact and what is not; forces and
// tangent.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "derivative_check.hpp"
#include "osculate/core/error.hpp"
#include "own_surface_sample.hpp"
#include "pair_checks.hpp"

namespace osculate::testing {
namespace {

using cell::CellType;
using contact::ResidualForm;
using pairing::Weight;

constexpr std::array<CellType, 5> types{CellType::tri3, CellType::tri6, CellType::quad4,
                                        CellType::quad8, CellType::quad9};

Vec2 turned(const Vec2& p, double angle) { return Eigen::Rotation2Dd(angle) * p; }

TEST(OwnSurface, LipsFaceEachOtherAndNothingElse) {
  const PairSample s = own_surface(hairpin());
  for (std::size_t i = 0; i < s.committed.points.size(); ++i) {
    const contact::PointHistory<2>& h = s.committed.points[i];
    const Vec2& p = s.x[static_cast<std::size_t>(s.pair.slave.nodes[i])];
    const bool lip = p.y() > 0.9 && p.y() < 1.3 && p.x() > 1.3 && p.x() < 4.9;
    if (lip) {
      EXPECT_NEAR(h.gap, 0.2, 1e-12) << p.transpose();
    }
    EXPECT_FALSE(h.active);
    if (h.facet >= 0) {
      EXPECT_GT(h.gap, 0) << p.transpose();
    }
    if (p.y() < 0.1 || p.y() > 2.1) {
      EXPECT_LT(h.facet, 0) << "outside at " << p.transpose();
    }
  }
}

TEST(OwnSurface, LipsInSpaceFaceEachOtherAndSqueezeIsNoContact) {
  for (const CellType type : types) {
    PairSample3 s = own_walls(hairpin(), type);
    int facing = 0;
    for (const contact::PointHistory<3>& h : s.committed.points) {
      EXPECT_FALSE(h.active);
      if (h.facet >= 0 && std::abs(h.gap - 0.2) < 1e-9) ++facing;
    }
    EXPECT_GE(facing, 2 * 7 * 3);
    for (const double squeeze : {1.0, 0.6, 0.3}) {
      PairSample3 t = s;
      move(t, [&](const Vec2& p) { return Vec2(p.x(), squeeze * p.y()); });
      EXPECT_TRUE(touching(t).empty()) << squeeze;
    }
  }
}

TEST(OwnSurface, RigidMotionAndSqueezeAreNoContact) {
  for (const double angle : {0.0, 0.7, 3.0})
    for (const double squeeze : {1.0, 0.6, 0.3}) {
      PairSample s = own_surface(hairpin());
      move(s, [&](const Vec2& p) { return turned({p.x(), squeeze * p.y()}, angle); });
      EXPECT_TRUE(touching(s).empty()) << angle << " " << squeeze;
      PairSample plate = own_surface(outline({{0, 0}, {0, 0.4}, {6, 0.4}, {6, 0}}, 0.25));
      move(plate, [&](const Vec2& p) { return turned({p.x(), squeeze * p.y()}, angle); });
      EXPECT_TRUE(touching(plate).empty()) << angle << " " << squeeze;
    }
}

TEST(OwnSurface, ConvexCornersBentAcuteAreNoContact) {
  for (const double corner : {80.0, 60.0, 50.0, 40.0, 35.0}) {
    PairSample s = own_surface(outline({{0, 0}, {0, 4}, {4, 4}, {4, 0}}, 0.25));
    const double c = std::cos(corner * M_PI / 180), si = std::sin(corner * M_PI / 180);
    move(s, [&](const Vec2& p) { return Vec2(p.x() + c * p.y(), si * p.y()); });
    EXPECT_TRUE(touching(s).empty()) << corner;
  }
  const PairSample wedge = own_surface(outline({{0, 0}, {4, 1}, {4, 0}}, 0.25));
  EXPECT_TRUE(touching(wedge).empty());
}

TEST(OwnSurface, FlanksOfANotchTouchUpToItsRoot) {
  // A block with a notch of 28 degrees from above; its right half turns about the root.
  PairSample s = own_surface(
      outline({{-4, -3}, {-4, 3}, {-0.75, 3}, {0, 0}, {0.75, 3}, {4, 3}, {4, -3}}, 0.25));
  EXPECT_TRUE(touching(s).empty());
  const double angle = 2 * std::atan(0.25) + 0.02;
  move(s, [&](const Vec2& p) { return p.x() > 0 && p.y() > 0 ? turned(p, angle) : p; });
  const std::vector<Index> nodes = touching(s);
  double nearest = 10;
  for (const Index n : nodes) nearest = std::min(nearest, s.x[static_cast<std::size_t>(n)].norm());
  EXPECT_GE(nodes.size(), 20u);  // 12 on each flank
  EXPECT_LT(nearest, 0.3);       // the node next to the root is one of them
}

TEST(OwnSurface, ClosedLipsTouchAndFarSidesDoNot) {
  PairSample s = own_surface(hairpin());
  move(s, [](const Vec2& p) { return closed_hairpin(p, 0.3); });
  const std::vector<Index> nodes = touching(s);
  ASSERT_GE(nodes.size(), 3u);
  bool above = false, below = false;
  for (const Index n : nodes) {
    const Vec2& p = s.x[static_cast<std::size_t>(n)];
    EXPECT_GT(p.x(), 3) << p.transpose();
    EXPECT_NEAR(p.y(), 1, 0.15) << p.transpose();
    above = above || p.y() < 0.999;
    below = below || p.y() > 0.999;
  }
  EXPECT_TRUE(above && below);  // both sides are slaves
}

TEST(OwnSurface, AThinLipThatJumpsThroughIsFoundAgain) {
  PairSample s = own_surface(outline(
      {{0, 0}, {0, 0.4}, {5, 0.4}, {5, 0.3}, {0.5, 0.3}, {0.5, 0.1}, {5, 0.1}, {5, 0}}, 0.25));
  move(s, [](const Vec2& p) {  // 0.28 down: through the lower lip of thickness 0.1
    return p.x() > 0.6 && p.y() > 0.2 ? Vec2(p.x(), p.y() - 0.28) : p;
  });
  pairing::PairEvaluation<2> e;
  pairing::evaluate(s.pair, s.x, s.committed, false, e);
  for (std::size_t i = 0; i < e.points.size(); ++i) {
    const Vec2& p = s.x[static_cast<std::size_t>(s.pair.slave.nodes[i])];
    if (std::abs(p.y() - 0.02) < 1e-9 && p.x() > 1 && p.x() < 4.5) {
      EXPECT_NEAR(e.points[i].gap, -0.08, 1e-9) << p.transpose();
    }
  }
}

/// A closed hairpin in general position.
PairSample contact_sample(int nodes, double mu) {
  PairSample s = own_surface(hairpin(), nodes);
  s.pair.normal = contact::penalty(300);
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> jitter(-0.01, 0.01);
  move(s, [&](const Vec2& p) {
    return turned(closed_hairpin(p, 0.33) + Vec2(jitter(generator), jitter(generator)), 0.4);
  });
  if (mu > 0) s.pair.friction = contact::coulomb(mu, 80);
  pairing::prepare(s.pair, own_surface(hairpin(), nodes).x);
  return s;
}

PairSample3 contact_sample(CellType type, double mu) {
  PairSample3 s = own_walls(hairpin(), type);
  s.pair.normal = contact::penalty(300);
  if (mu > 0) s.pair.friction = contact::coulomb(mu, 80);
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> jitter(-0.01, 0.01);
  const Eigen::AngleAxisd turn(0.8, Vec3(1, 2, -1).normalized());
  for (Vec3& p : s.x) {
    const Vec2 q = closed_hairpin(p.head<2>(), 0.33);
    const double slide = p.x() > 1 && p.y() > 1.1 ? 0.11 : 0.0;
    const double up = jitter(generator), across = jitter(generator), along = jitter(generator);
    p = turn * Vec3(q.x() + slide + along, q.y() + across, p.z() + slide + up);
  }
  return s;
}

constexpr std::array<Weight, 3> weights{Weight::node, Weight::reference_area, Weight::current_area};

template <int Dim>
void expect_balance(ContactSample<Dim> s) {
  s.pair.residual = ResidualForm::full;
  const Eigen::VectorXd r = pair_residual(s, flatten(s.x));
  ASSERT_GT(r.norm(), 1);
  EXPECT_LT(net_force<Dim>(r).norm(), 1e-12 * r.norm());
  EXPECT_LT(net_moment(s, r).norm(), 1e-11 * r.norm());
}

TEST(OwnSurface, ForcesAndMomentsBalance) {
  for (const int nodes : {2, 3})
    for (const double mu : {0.0, 0.05, 10.0})
      for (const Weight weight : weights) {
        PairSample s = contact_sample(nodes, mu);
        s.pair.weight = weight;
        expect_balance(s);
      }
}

TEST(OwnSurface, ClosedLipsInSpaceTouchInBalance) {
  for (const CellType type : types)
    for (const double mu : {0.0, 0.05, 10.0}) {
      const PairSample3 s = contact_sample(type, mu);
      EXPECT_GE(touching(s).size(), 6u);
      expect_balance(s);
    }
}

// Slave and master share nodes and dofs.
template <int Dim>
void expect_tangent(const ContactSample<Dim>& s) {
  const Eigen::VectorXd v = flatten(s.x);
  const std::vector<PointFacts> facts = pair_facts(s, v);
  const Eigen::VectorXd d = 0.05 * Eigen::VectorXd::Random(v.size());
  const double h = 2e-3;
  ASSERT_EQ(pair_facts(s, v + h * d), facts);
  ASSERT_EQ(pair_facts(s, v - h * d), facts);
  const DerivativeReport r =
      check_derivative([&](const Eigen::VectorXd& y) { return pair_residual(s, y); },
                       Eigen::VectorXd(pair_tangent(s, v) * d), v, d, h);
  EXPECT_TRUE(r.exact || std::abs(r.order - 2) < 0.15) << r.order << " " << r.error;
}

TEST(OwnSurface, TangentIsTheDerivativeOfTheResidual) {
  for (const int nodes : {2, 3})
    for (const double mu : {0.0, 0.02, 10.0})
      for (const Weight weight : weights) {
        SCOPED_TRACE(std::to_string(nodes) + " nodes, mu " + std::to_string(mu));
        PairSample s = contact_sample(nodes, mu);
        s.pair.weight = weight;
        expect_tangent(s);
        if (mu == 0 && weight != Weight::current_area) expect_symmetric_tangent(s);
      }
}

TEST(OwnSurface, TangentInSpaceIsTheDerivativeOfTheResidual) {
  for (const CellType type : {CellType::tri3, CellType::quad4, CellType::quad9})
    for (const double mu : {0.0, 0.02, 10.0})
      for (const Weight weight : {Weight::reference_area, Weight::current_area}) {
        SCOPED_TRACE(std::string(cell::info(type).name) + ", mu " + std::to_string(mu));
        PairSample3 s = contact_sample(type, mu);
        s.pair.weight = weight;
        expect_tangent(s);
      }
}

TEST(OwnSurface, FrictionIsRemembered) {
  PairSample s = contact_sample(2, 10);
  pairing::PairEvaluation<2> e;
  pairing::evaluate(s.pair, s.x, s.committed, false, e);
  s.committed = pairing::commit(e);
  const std::vector<Vec2> before = s.x;
  const auto shear = [&] {
    double sum = 0;
    pairing::evaluate(s.pair, s.x, s.committed, false, e);
    for (const pairing::PointResult<2>& p : e.points) sum += p.weight * p.shear_traction.norm();
    return sum;
  };
  const double first = shear();
  const std::vector<Vec2> shape = hairpin();
  for (std::size_t n = 0; n < s.x.size(); ++n)  // the upper arm slides along the lower one
    if (shape[n].y() > 1.1 && shape[n].x() > 1) s.x[n] += turned({0.02, 0}, 0.4);
  const double loaded = shear();
  EXPECT_GT(loaded, first + 0.1);
  s.committed = pairing::commit(e);
  EXPECT_NEAR(shear(), loaded, 1e-12 * loaded);  // nothing moves: nothing changes
  s.x = before;
  EXPECT_NEAR(shear(), first, 1e-3 * loaded);  // and back
}

TEST(OwnSurface, OtherFacetsOnTheSlaveSideAreRefused) {
  PairSample s = own_surface(hairpin());
  const PairSample finer = own_surface(hairpin(0.25));
  s.pair.slave = pairing::make_slave_side(finer.pair.master);
  s.x = finer.x;
  EXPECT_THROW(pairing::prepare(s.pair, s.x), core::GeometryError);
}

}  // namespace
}  // namespace osculate::testing
