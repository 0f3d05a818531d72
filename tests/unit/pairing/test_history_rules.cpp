// How friction remembers over borders in the plane: along the path, by the chord, per facet.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "pair_checks.hpp"

#include "osculate/contact/law/coulomb.hpp"
#include "osculate/contact/law/normal_penalty.hpp"

namespace osculate::testing {
namespace {

using contact::ResidualForm;
using contact::Status;
using pairing::HistoryRule;
using projection::Feature;

constexpr double eps_t = 80.0;
constexpr double depth = 1e-3;
constexpr std::array<HistoryRule, 3> all_rules{HistoryRule::continuous, HistoryRule::chord,
                                               HistoryRule::per_facet};

/// One slave point that sticks (or slips) on a polygon under it.
struct Walker {
  PairSample s;
  pairing::PairEvaluation<2> last;

  Walker(const std::vector<Vec2>& master, HistoryRule rule, double mu = 1e6) {
    s.x = master;
    for (std::size_t i = 0; i + 1 < master.size(); ++i)
      s.pair.master.facets.push_back(pairing::lagrange_facet(
          std::array<Index, 2>{static_cast<Index>(i), static_cast<Index>(i + 1)}));
    pairing::connect(s.pair.master);
    s.x.push_back({0, 0});
    s.pair.slave = pairing::make_slave_side(
        pairing::Chain{}, std::array<Index, 1>{static_cast<Index>(master.size())});
    s.pair.weight = pairing::Weight::node;
    s.pair.normal = contact::NormalPenalty{1000};
    s.pair.friction = contact::Coulomb{mu, eps_t};
    s.pair.history = rule;
    pairing::prepare(s.pair, s.x);
  }
  void start(const Vec2& at) {
    s.x.back() = at;
    s.committed = pairing::initial_state(s.pair, s.x);
  }
  double step(const Vec2& to) {
    s.x.back() = to;
    pairing::evaluate(s.pair, s.x, s.committed, false, last);
    s.committed = pairing::commit(last);
    return last.points[0].shear_traction[0];
  }
};

/// A kink by `angle` at (1, 0); the slave lies `depth` under the place at arc length s.
std::vector<Vec2> kinked(double angle) {
  return {{0, 0}, {1, 0}, Vec2(1, 0) + 2 * Vec2(std::cos(angle), std::sin(angle))};
}
Vec2 on_kinked(double angle, double s) {
  const Vec2 along(std::cos(angle), std::sin(angle));
  return s <= 1 ? Vec2(s, -depth) : Vec2(Vec2(1, 0) + (s - 1) * along - depth * turn(along));
}

double over_the_kink(HistoryRule rule, double angle) {
  Walker w(kinked(angle), rule);
  w.start(on_kinked(angle, 0.9));
  w.step(on_kinked(angle, 0.9));
  return w.step(on_kinked(angle, 1.05)) / eps_t;
}

// [eq:KS2D:88] 0.1 before and 0.05 behind a kink of 30 degrees: the chord has 0.1 cos 30 + 0.05 =
// 0.1366 of the path of 0.1500.
TEST(HistoryRules, TheChordIsShortByTheCosineOverAKink) {
  const double angle = std::numbers::pi / 6;
  EXPECT_NEAR(over_the_kink(HistoryRule::continuous, angle), 0.15, 1e-14);
  EXPECT_NEAR(over_the_kink(HistoryRule::chord, angle), 0.1 * std::cos(angle) + 0.05, 1e-14);
  EXPECT_NEAR(over_the_kink(HistoryRule::chord, angle), 0.1366, 5e-5);
}

// On straight pieces of one length the chord is exact.
TEST(HistoryRules, TheChordIsExactOnAStraightLineOfEqualFacets) {
  const std::vector<Vec2> straight{{0, 0}, {1, 0}, {2, 0}, {3, 0}};
  Walker w(straight, HistoryRule::chord);
  w.start({0.3, -depth});
  for (const double x : {0.8, 1.4, 2.7, 1.1, 0.1})
    EXPECT_NEAR(w.step({x, -depth}), eps_t * (x - 0.3), 1e-12);
}

// [eq:KS2D:89] as printed: the covariant T = sqrt(a11) t goes over the border as a number, so that
// t changes by the ratio of the lengths.
TEST(HistoryRules, ThePrintedChordKeepsTheCovariantTraction) {
  Walker w({{0, 0}, {1, 0}, {4, 0}}, HistoryRule::chord);
  w.start({0.2, -depth});
  const double before = w.step({0.9, -depth});
  EXPECT_NEAR(before, eps_t * 0.7, 1e-12);
  EXPECT_NEAR(w.step({1.4, -depth}), before * (1.0 / 3.0) + eps_t * 0.5, 1e-12);
}

// [eq:KS2D:84] [eq:KS2D:85] from xi = 0.9 to xi = -0.9 over a border: T = sqrt(a11) t changes by
// -1.8 eps_T a11 instead of 0.2 eps_T a11, and by -2 eps_T a11 where the way vanishes.
TEST(HistoryRules, PerFacetJumpsAtTheBorder) {
  const double length = 0.5, a11 = length * length / 4, root = length / 2;
  const std::vector<Vec2> straight{{0, 0}, {length, 0}, {2 * length, 0}};
  const auto covariant_change = [&](double before, double after) {
    Walker w(straight, HistoryRule::per_facet);
    w.start({root * (1 + before), -depth});
    const double held = w.step({root * (1 + before), -depth});
    return root * (w.step({length + root * (1 + after), -depth}) - held);
  };
  EXPECT_NEAR(covariant_change(0.9, -0.9), -1.8 * eps_t * a11, 1e-12);
  EXPECT_NEAR(covariant_change(1 - 1e-7, -1 + 1e-7), -2 * eps_t * a11, 1e-5);
  Walker exact(straight, HistoryRule::continuous);
  exact.start({root * 1.9, -depth});
  EXPECT_NEAR(root * exact.step({length + root * 0.1, -depth}), 0.2 * eps_t * a11, 1e-12);
}

// Within a facet nothing distinguishes it from the path.
TEST(HistoryRules, PerFacetIsThePathInsideOneFacet) {
  for (const double x : {0.4, 0.9, 0.1}) {
    Walker a(kinked(0.3), HistoryRule::continuous), b(kinked(0.3), HistoryRule::per_facet);
    a.start({0.3, -depth});
    b.start({0.3, -depth});
    EXPECT_EQ(a.step({x, -depth}), b.step({x, -depth}));
  }
}

// One piece or two of lengths 1 : 3 are the same, through stick, slip and back.
TEST(HistoryRules, TheContinuousOneDoesNotKnowWhereTheBordersAre) {
  Walker one({{0, 0}, {4, 0}}, HistoryRule::continuous, 0.3);
  Walker two({{0, 0}, {1, 0}, {4, 0}}, HistoryRule::continuous, 0.3);
  one.start({0.9, -depth});
  two.start({0.9, -depth});
  for (const double x : {0.903, 1.002, 1.4, 1.399, 1.3, 0.95, 0.951, 2.0, 0.2, 0.202})
    EXPECT_NEAR(one.step({x, -depth}), two.step({x, -depth}), 1e-12) << x;
}

// --- derivatives --------------------------------------------------------------------------------

// [eq:KS2D:84] [eq:KS2D:88]
TEST(HistoryRules, TangentsAreDerivatives) {
  for (const HistoryRule rule : all_rules)
    for (const int nodes : {2, 3, 4})
      for (const double mu : {10.0, 0.01})
        for (const ResidualForm form : {ResidualForm::surface, ResidualForm::full})
          for (const Index from : {0, 1, 2}) {
            SCOPED_TRACE(::testing::Message() << static_cast<int>(rule) << " " << nodes
                                              << " nodes, mu " << mu << ", from " << from);
            PairSample s = make_sample({.nodes_per_facet = nodes, .bend = nodes > 2 ? 0.02 : 0.0});
            s.pair.friction = contact::Coulomb{mu, eps_t};
            s.pair.residual = form;
            s.pair.history = rule;
            s.committed.points[0] = remembered(true, from, Feature::face, 0.3, -0.01, 7.0);
            expect_pair_tangent(s, mu > 1 ? Status::stick : Status::slip, Feature::face, 2e-3);
          }
}

TEST(HistoryRules, TangentsAreDerivativesAtFirstContactAndInAValley) {
  for (const HistoryRule rule : all_rules) {
    SCOPED_TRACE(static_cast<int>(rule));
    PairSample first = make_sample({});
    first.pair.friction = contact::Coulomb{10.0, eps_t};
    first.pair.history = rule;
    first.committed.points[0] = remembered(false, 0, Feature::face, 0.9, 0.03, 0);
    expect_pair_tangent(first, Status::stick, Feature::face, 2e-3);
    for (const Index from : {0, 1}) {
      PairSample s = make_sample({.facets = 2, .angle = 0.0});
      s.x[0] = {-1, 1};
      s.x[1] = {0, 0};
      s.x[2] = {2, 1.5};
      s.x[3] = {0.02, -0.11};
      s.pair.friction = contact::Coulomb{10.0, eps_t};
      s.pair.weight = pairing::Weight::node;
      s.pair.history = rule;
      s.committed.points[0] = remembered(true, from, Feature::face, 0.4, -0.01, 5.0);
      expect_pair_tangent(s, Status::stick, Feature::corner, 2e-3);
    }
  }
}

}  // namespace
}  // namespace osculate::testing
