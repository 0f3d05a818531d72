// A surface against itself in space.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "derivative_check.hpp"
#include "own_surface_sample.hpp"

#include "osculate/contact/law/coulomb.hpp"
#include "osculate/contact/law/normal_penalty.hpp"

namespace osculate::testing {
namespace {

using cell::CellType;
using contact::ResidualForm;
using pairing::Weight;

constexpr std::array<CellType, 5> types{CellType::tri3, CellType::tri6, CellType::quad4,
                                        CellType::quad8, CellType::quad9};

TEST(OwnSurface3, LipsFaceEachOtherAndSqueezeIsNoContact) {
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

PairSample3 contact_sample(CellType type, double mu) {
  PairSample3 s = own_walls(hairpin(), type);
  s.pair.normal = contact::NormalPenalty{300};
  if (mu > 0) s.pair.friction = contact::Coulomb{mu, 80};
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

TEST(OwnSurface3, ClosedLipsTouchInBalance) {
  for (const CellType type : types)
    for (const double mu : {0.0, 0.05, 10.0}) {
      PairSample3 s = contact_sample(type, mu);
      s.pair.residual = ResidualForm::full;
      EXPECT_GE(touching(s).size(), 6u);
      const Eigen::VectorXd r = pair_residual(s, flatten3(s.x));
      Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
      for (std::size_t n = 0; n < s.x.size(); ++n) {
        const Vec3 f = r.segment<3>(3 * static_cast<Eigen::Index>(n));
        force += f;
        moment += s.x[n].cross(f);
      }
      EXPECT_LT(force.norm(), 1e-12 * r.norm());
      EXPECT_LT(moment.norm(), 1e-11 * r.norm());
    }
}

TEST(OwnSurface3, TangentIsTheDerivativeOfTheResidual) {
  const auto facts = [](const PairSample3& s, const Eigen::VectorXd& v) {
    pairing::PairEvaluation<3> e;
    pairing::evaluate(s.pair, unflatten3(v), s.committed, false, e);
    std::vector<std::tuple<contact::Status, projection::Feature, Index>> all;
    for (const pairing::PointResult<3>& p : e.points)
      if (p.status != contact::Status::open)
        all.emplace_back(p.status, p.history.feature, p.history.facet);
    return all;
  };
  for (const CellType type : {CellType::tri3, CellType::quad4, CellType::quad9})
    for (const double mu : {0.0, 0.02, 10.0})
      for (const Weight weight : {Weight::reference_area, Weight::current_area}) {
        SCOPED_TRACE(std::string(cell::info(type).name) + ", mu " + std::to_string(mu));
        PairSample3 s = contact_sample(type, mu);
        s.pair.weight = weight;
        const Eigen::VectorXd v = flatten3(s.x);
        const Eigen::VectorXd d = 0.05 * Eigen::VectorXd::Random(v.size());
        const double h = 2e-3;
        ASSERT_EQ(facts(s, v + h * d), facts(s, v));
        ASSERT_EQ(facts(s, v - h * d), facts(s, v));
        const DerivativeReport r =
            check_derivative([&](const Eigen::VectorXd& y) { return pair_residual(s, y); },
                             Eigen::VectorXd(pair_tangent(s, v) * d), v, d, h);
        EXPECT_TRUE(r.exact || std::abs(r.order - 2) < 0.15) << r.order << " " << r.error;
      }
}

}  // namespace
}  // namespace osculate::testing
