// How friction remembers over borders in space: minimal rotation, projected chord, per facet.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "pair_checks.hpp"

#include "osculate/contact/law/coulomb.hpp"
#include "osculate/contact/law/normal_penalty.hpp"

namespace osculate::testing {
namespace {

using cell::CellType;
using contact::Status;
using pairing::HistoryRule;
using projection::Feature;

constexpr double eps_t = 80.0;
constexpr double depth = 1e-3;
constexpr std::array<HistoryRule, 3> all_rules{HistoryRule::continuous, HistoryRule::chord,
                                               HistoryRule::per_facet};

/// A strip of flat quad4 facets of width 2 along x, folded by `angle` at x = `fold`; one slave
/// point that sticks.
struct Walker {
  PairSample3 s;
  pairing::PairEvaluation<3> last;
  double fold, angle;

  Walker(const std::vector<double>& borders, double fold_at, double by, HistoryRule rule)
      : fold(fold_at), angle(by) {
    for (const double at : borders)
      for (const double y : {-1.0, 1.0}) s.x.push_back(on(at, y, 0));
    for (Index i = 0; i + 1 < static_cast<Index>(borders.size()); ++i)
      s.pair.master.facets.push_back(pairing::surface_facet(
          CellType::quad4, std::array<Index, 4>{2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1}));
    pairing::connect(s.pair.master);
    s.x.emplace_back(0, 0, 0);
    s.pair.slave = pairing::make_slave_side(
        pairing::FacetSurface{}, std::array<Index, 1>{static_cast<Index>(s.x.size()) - 1});
    s.pair.weight = pairing::Weight::node;
    s.pair.normal = contact::NormalPenalty{1000};
    s.pair.friction = contact::Coulomb{1e6, eps_t};
    s.pair.history = rule;
    pairing::prepare(s.pair, s.x);
  }
  /// `under` the unfolded place (s, y).
  [[nodiscard]] Vec3 on(double at, double y, double under) const {
    const double bent = at > fold ? angle : 0.0;
    const Vec3 along(std::cos(bent), 0, std::sin(bent)), normal(-std::sin(bent), 0, std::cos(bent));
    return Vec3(std::min(at, fold), y, 0) + std::max(at - fold, 0.0) * along - under * normal;
  }
  void start(double at, double y) {
    s.x.back() = on(at, y, depth);
    s.committed = pairing::initial_state(s.pair, s.x);
  }
  /// Shear along the strip and across it, by eps_T.
  Vec2 step(double at, double y) {
    s.x.back() = on(at, y, depth);
    pairing::evaluate(s.pair, s.x, s.committed, false, last);
    s.committed = pairing::commit(last);
    const double bent = at > fold ? angle : 0.0;
    const Vec3 along(std::cos(bent), 0, std::sin(bent)), t = last.points[0].shear();
    return Vec2(along.dot(t), t.y()) / eps_t;
  }
};

TEST(HistoryRules3, StickOverFiveFoldedFacetsAndBackIsZero) {
  Walker w({0, 1, 4, 5, 8, 9}, 5, 0.5, HistoryRule::continuous);
  w.start(0.3, -0.4);
  const int steps = 29;
  for (int i = 1; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    EXPECT_LT((w.step(0.3 + 8.4 * t, -0.4 + 0.9 * t) - Vec2(8.4 * t, 0.9 * t)).norm(), 1e-12);
  }
  for (int i = steps - 1; i > 0; --i) {
    const double t = static_cast<double>(i) / steps;
    w.step(0.3 + 8.4 * t, -0.4 + 0.9 * t);
  }
  EXPECT_LT(w.step(0.3, -0.4).norm(), 1e-12);
}

TEST(HistoryRules3, TheContinuousOneDoesNotKnowWhereTheBordersAre) {
  Walker one({0, 4}, 9, 0, HistoryRule::continuous), two({0, 1, 4}, 9, 0, HistoryRule::continuous);
  one.start(0.9, 0);
  two.start(0.9, 0);
  for (const double at : {0.95, 1.4, 3.0, 0.2}) {
    const Vec2 a = one.step(at, 0.1 * at), b = two.step(at, 0.1 * at);
    EXPECT_LT((a - b).norm(), 1e-12) << at;
  }
}

// [eq:KS2D:88] in space: what was carried and the part of the chord on the old facet lose the
// cosine across the fold; along the fold nothing is lost.
TEST(HistoryRules3, TheProjectedChordIsShortByTheCosine) {
  const double angle = std::numbers::pi / 6;
  Walker w({0, 1, 3}, 1, angle, HistoryRule::chord);
  w.start(0.6, 0);
  EXPECT_LT((w.step(0.9, 0.2) - Vec2(0.3, 0.2)).norm(), 1e-13);
  EXPECT_LT((w.step(1.05, 0.5) - Vec2(0.4 * std::cos(angle) + 0.05, 0.5)).norm(), 1e-13);
  Walker flat({0, 1, 3}, 9, 0, HistoryRule::chord);
  flat.start(0.6, 0);
  EXPECT_LT((flat.step(2.2, 0.5) - Vec2(1.6, 0.5)).norm(), 1e-13);
}

// [eq:KS2D:84] [eq:KS2D:85] in space: the change of xi^1 from 0.9 to -0.9 times rho_,1.
TEST(HistoryRules3, PerFacetJumpsAtTheBorder) {
  Walker w({0, 1, 2}, 9, 0, HistoryRule::per_facet);
  w.start(0.95, 0);
  EXPECT_LT((w.step(1.05, 0.3) - Vec2(-1.8 * 0.5, 0.3)).norm(), 1e-13);
  Walker inside({0, 1, 2}, 9, 0, HistoryRule::per_facet);
  inside.start(0.3, 0);
  EXPECT_LT((inside.step(0.8, 0.3) - Vec2(0.5, 0.3)).norm(), 1e-13);
}

TEST(HistoryRules3, TangentsAreDerivatives) {
  for (const HistoryRule rule : all_rules)
    for (const CellType type : {CellType::tri3, CellType::tri6, CellType::quad4, CellType::quad9})
      for (const double mu : {10.0, 0.02})
        for (const Index from : {0, 1, 2}) {
          SCOPED_TRACE(::testing::Message()
                       << static_cast<int>(rule) << " " << cell::info(type).name << " mu " << mu
                       << " from " << from);
          SampleOptions3 o{.type = type, .bend = 0.03, .depth = 0.03};
          const bool triangle = cell::is_triangle(type);
          if (triangle) o.at = 2, o.xi = {0.3, 0.4};
          PairSample3 s = make_sample3(o);
          s.pair.friction = contact::Coulomb{mu, eps_t};
          s.pair.weight = pairing::Weight::node;
          s.pair.history = rule;
          s.committed.points[0] =
              remembered(triangle ? from + 1 : from, triangle ? Vec2(0.25, 0.5) : Vec2(0.4, 0.2),
                         -0.01, {4.0, -3.0});
          expect_pair_tangent(s, mu > 1 ? Status::stick : Status::slip, Feature::face, 1e-3);
        }
}

// On the edge of a valley and at first contact.
TEST(HistoryRules3, TangentsAreDerivativesOnEdges) {
  for (const HistoryRule rule : all_rules)
    for (const CellType type : {CellType::quad4, CellType::quad9})
      for (const Index from : {1, 2}) {
        SCOPED_TRACE(::testing::Message()
                     << static_cast<int>(rule) << " " << cell::info(type).name);
        PairSample3 s = make_sample3({.type = type, .kink = 1.2});
        s.x[s.x.size() - 4] = {4.02, 0.3, -0.1};
        s.pair.friction = contact::Coulomb{10.0, eps_t};
        s.pair.weight = pairing::Weight::node;
        s.pair.history = rule;
        s.committed.points[0] = remembered(from, {0.4, 0.25}, -0.01, {2.0, 1.0});
        expect_pair_tangent(s, Status::stick, Feature::edge, 1e-3);
      }
  for (const HistoryRule rule : all_rules) {
    PairSample3 s = make_sample3({.bend = 0.02});
    s.pair.friction = contact::Coulomb{10.0, eps_t};
    s.pair.history = rule;
    s.committed.points[0] = remembered(0, {0.1, -0.1}, 0.03, {0, 0}, false);
    expect_pair_tangent(s, Status::stick, Feature::face, 1e-3);
  }
}

}  // namespace
}  // namespace osculate::testing
