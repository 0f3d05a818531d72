// How friction remembers over borders: along the path (in space by a minimal rotation), by the
// chord, per facet.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "pair_checks.hpp"

namespace osculate::testing {
namespace {

using cell::CellType;
using contact::ResidualForm;
using contact::Status;
using pairing::HistoryRule;
using projection::Feature;

constexpr double eps_t = 80.0;
constexpr double depth = 1e-3;
constexpr double kink = std::numbers::pi / 6;
constexpr double rounding = 1e-12 / eps_t;
constexpr std::array<HistoryRule, 3> all_rules{HistoryRule::continuous, HistoryRule::chord,
                                               HistoryRule::per_facet};

template <class Dimension>
class HistoryRulesOf : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(HistoryRulesOf, Dimensions);

/// The part of a place or vector of space that lies in the plane of x and z.
template <int Dim>
Vec<Dim> part(const Vec3& v) {
  if constexpr (Dim == 2) return {v.x(), v.z()};
  if constexpr (Dim == 3) return v;
}

template <int Dim>
Vec<Dim - 1> slip(double along, double across = 0) {
  return Vec2(along, across).head<Dim - 1>();
}

/// A strip of straight pieces along x, in space of width 2, folded by `angle` at x = `fold`; one
/// slave point that sticks (or slips) on it.
template <int Dim>
struct Walker {
  ContactSample<Dim> s;
  pairing::PairEvaluation<Dim> last;
  double fold, angle;

  Walker(const std::vector<double>& borders, double fold_at, double by, HistoryRule rule,
         double mu = 1e6)
      : fold(fold_at), angle(by) {
    for (const double at : borders)
      for (int side = 0; side < Dim - 1; ++side) s.x.push_back(on(at, 2 * side - 1, 0));
    if constexpr (Dim == 2) s.pair.master = line_through(s.x.size());
    if constexpr (Dim == 3)
      for (Index n = 0; n + 3 < static_cast<Index>(s.x.size()); n += 2)
        s.pair.master.facets.push_back(
            pairing::surface_facet(CellType::quad4, std::array<Index, 4>{n, n + 2, n + 3, n + 1}));
    s.x.push_back(Vec<Dim>::Zero());
    make_last_node_slave(s);
    s.pair.friction = contact::coulomb(mu, eps_t);
    s.pair.history = rule;
  }
  Walker(const std::vector<double>& borders, HistoryRule rule, double mu = 1e6)
      : Walker(borders, borders.back(), 0, rule, mu) {}

  [[nodiscard]] double slope(double at) const { return at > fold ? angle : 0.0; }
  /// `under` the unfolded place (at, y).
  [[nodiscard]] Vec<Dim> on(double at, double y, double under) const {
    const double c = std::cos(slope(at)), si = std::sin(slope(at));
    return part<Dim>(Vec3(std::min(at, fold), y, 0) + std::max(at - fold, 0.0) * Vec3(c, 0, si) -
                     under * Vec3(-si, 0, c));
  }
  void start(double at, double y = 0) {
    s.x.back() = on(at, y, depth);
    s.committed = pairing::initial_state(s.pair, s.x);
  }
  /// Shear along the strip and across it, by eps_T.
  Vec<Dim - 1> step(double at, double y = 0) {
    s.x.back() = on(at, y, depth);
    pairing::evaluate(s.pair, s.x, s.committed, false, last);
    s.committed = pairing::commit(last);
    const Vec3 along(std::cos(slope(at)), 0, std::sin(slope(at)));
    const Vec<Dim> t = last.points[0].shear();
    return slip<Dim>(part<Dim>(along).dot(t), t[1]) / eps_t;
  }
};

TYPED_TEST(HistoryRulesOf, StickOverFiveFoldedFacetsAndBackIsZero) {
  constexpr int dim = TypeParam::value;
  Walker<dim> w({0, 1, 4, 5, 8, 9}, 5, 0.5, HistoryRule::continuous);
  w.start(0.3, -0.4);
  const int steps = 29;
  for (int i = 1; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    EXPECT_LT((w.step(0.3 + 8.4 * t, -0.4 + 0.9 * t) - slip<dim>(8.4 * t, 0.9 * t)).norm(), 1e-12);
  }
  for (int i = steps - 1; i > 0; --i) {
    const double t = static_cast<double>(i) / steps;
    w.step(0.3 + 8.4 * t, -0.4 + 0.9 * t);
  }
  EXPECT_LT(w.step(0.3, -0.4).norm(), 1e-12);
}

// One piece or two of lengths 1 : 3 are the same, through stick, slip and back.
TYPED_TEST(HistoryRulesOf, TheContinuousOneDoesNotKnowWhereTheBordersAre) {
  constexpr int dim = TypeParam::value;
  for (const double mu : {1e6, 0.3}) {
    Walker<dim> one({0, 4}, HistoryRule::continuous, mu);
    Walker<dim> two({0, 1, 4}, HistoryRule::continuous, mu);
    one.start(0.9);
    two.start(0.9);
    for (const double x : {0.903, 0.95, 1.002, 1.4, 1.399, 1.3, 3.0, 0.95, 0.951, 2.0, 0.2, 0.202})
      EXPECT_LT((one.step(x, 0.1 * x) - two.step(x, 0.1 * x)).norm(), rounding) << x;
  }
}

// [eq:KS2D:88] 0.1 before and 0.05 behind a fold of 30 degrees: the chord has 0.1 cos 30 + 0.05 =
// 0.1366 of the path of 0.1500.
TYPED_TEST(HistoryRulesOf, TheChordIsShortByTheCosineOverAFold) {
  constexpr int dim = TypeParam::value;
  const auto over_the_fold = [](HistoryRule rule) {
    Walker<dim> w({0, 1, 3}, 1, kink, rule);
    w.start(0.9);
    w.step(0.9);
    return w.step(1.05);
  };
  const Vec<dim - 1> chord = over_the_fold(HistoryRule::chord);
  EXPECT_LT((over_the_fold(HistoryRule::continuous) - slip<dim>(0.15)).norm(), 1e-14);
  EXPECT_LT((chord - slip<dim>(0.1 * std::cos(kink) + 0.05)).norm(), 1e-14);
  EXPECT_NEAR(chord[0], 0.1366, 5e-5);
}

// On straight pieces of one length the chord is exact.
TYPED_TEST(HistoryRulesOf, TheChordIsExactOnAStraightLineOfEqualFacets) {
  constexpr int dim = TypeParam::value;
  Walker<dim> w({0, 1, 2, 3}, HistoryRule::chord);
  w.start(0.3);
  for (const double x : {0.8, 1.4, 2.7, 1.1, 0.1})
    EXPECT_LT((w.step(x, 0.2 * x) - slip<dim>(x - 0.3, 0.2 * x)).norm(), rounding);
}

// [eq:KS2D:84] [eq:KS2D:85] from xi = 0.9 to xi = -0.9 over a border: T = sqrt(a11) t changes by
// -1.8 eps_T a11 instead of 0.2 eps_T a11, and by -2 eps_T a11 where the way vanishes.
TYPED_TEST(HistoryRulesOf, PerFacetJumpsAtTheBorder) {
  constexpr int dim = TypeParam::value;
  for (const double length : {0.5, 1.0}) {
    const double root = length / 2;
    const auto change = [&](double xi, HistoryRule rule) {
      Walker<dim> w({0, length, 2 * length}, rule);
      w.start(root * (1 + xi));
      const Vec<dim - 1> held = w.step(root * (1 + xi));
      return Vec<dim - 1>(w.step(length + root * (1 - xi), 0.3) - held);
    };
    const double nearly = 1 - 1e-7;
    EXPECT_LT((change(0.9, HistoryRule::per_facet) - slip<dim>(-1.8 * root, 0.3)).norm(), 5e-14);
    EXPECT_LT((change(nearly, HistoryRule::per_facet) - slip<dim>(-2 * root, 0.3)).norm(), 5e-7);
    EXPECT_LT((change(0.9, HistoryRule::continuous) - slip<dim>(0.2 * root, 0.3)).norm(), 5e-14);
  }
}

// Within a facet nothing distinguishes it from the path.
TYPED_TEST(HistoryRulesOf, PerFacetIsThePathInsideOneFacet) {
  constexpr int dim = TypeParam::value;
  for (const double x : {0.4, 0.8, 0.9, 0.1}) {
    Walker<dim> a({0, 1, 3}, 1, 0.3, HistoryRule::continuous);
    Walker<dim> b({0, 1, 3}, 1, 0.3, HistoryRule::per_facet);
    a.start(0.3);
    b.start(0.3);
    const Vec<dim - 1> path = a.step(x, 0.3), found = b.step(x, 0.3);
    EXPECT_LE((found - path).norm(), dim == 2 ? 0 : 1e-13);
    EXPECT_LT((found - slip<dim>(x - 0.3, 0.3)).norm(), 1e-13);
  }
}

// [eq:KS2D:89] as printed: the covariant T = sqrt(a11) t goes over the border as a number, so that
// t changes by the ratio of the lengths.
TEST(HistoryRules, ThePrintedChordKeepsTheCovariantTraction) {
  Walker<2> w({0, 1, 4}, HistoryRule::chord);
  w.start(0.2);
  const double before = w.step(0.9)[0];
  EXPECT_NEAR(before, 0.7, rounding);
  EXPECT_NEAR(w.step(1.4)[0], before * (1.0 / 3.0) + 0.5, rounding);
}

// [eq:KS2D:88] in space: what was carried loses the cosine across the fold as well; along the fold
// nothing is lost.
TEST(HistoryRules3, WhatTheChordCarriesIsProjected) {
  Walker<3> w({0, 1, 3}, 1, kink, HistoryRule::chord);
  w.start(0.6, 0);
  EXPECT_LT((w.step(0.9, 0.2) - Vec2(0.3, 0.2)).norm(), 1e-13);
  EXPECT_LT((w.step(1.05, 0.5) - Vec2(0.4 * std::cos(kink) + 0.05, 0.5)).norm(), 1e-13);
  Walker<3> flat({0, 1, 3}, HistoryRule::chord);
  flat.start(0.6, 0);
  EXPECT_LT((flat.step(2.2, 0.5) - Vec2(1.6, 0.5)).norm(), 1e-13);
}

// --- derivatives --------------------------------------------------------------------------------

template <int Dim>
void expect_tangent(ContactSample<Dim> s, HistoryRule rule,
                    const contact::PointHistory<Dim>& before, double mu, Feature feature) {
  s.pair.friction = contact::coulomb(mu, eps_t);
  s.pair.history = rule;
  s.committed.points[0] = before;
  expect_pair_tangent(s, mu > 1 ? Status::stick : Status::slip, feature, Dim == 2 ? 2e-3 : 1e-3);
}

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
            s.pair.residual = form;
            expect_tangent(s, rule, remembered(true, from, Feature::face, 0.3, -0.01, 7.0), mu,
                           Feature::face);
          }
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
          s.pair.weight = pairing::Weight::node;
          expect_tangent(
              s, rule,
              remembered(triangle ? from + 1 : from, triangle ? Vec2(0.25, 0.5) : Vec2(0.4, 0.2),
                         -0.01, {4.0, -3.0}),
              mu, Feature::face);
        }
}

TEST(HistoryRules, TangentsAreDerivativesAtFirstContactAndInAValley) {
  for (const HistoryRule rule : all_rules) {
    SCOPED_TRACE(static_cast<int>(rule));
    expect_tangent(make_sample({}), rule, remembered(false, 0, Feature::face, 0.9, 0.03, 0), 10,
                   Feature::face);
    for (const Index from : {0, 1}) {
      PairSample s = make_sample({.facets = 2, .angle = 0.0});
      s.x[0] = {-1, 1};
      s.x[1] = {0, 0};
      s.x[2] = {2, 1.5};
      s.x[3] = {0.02, -0.11};
      s.pair.weight = pairing::Weight::node;
      expect_tangent(s, rule, remembered(true, from, Feature::face, 0.4, -0.01, 5.0), 10,
                     Feature::corner);
    }
  }
}

TEST(HistoryRules3, TangentsAreDerivativesAtFirstContactAndOnTheEdgeOfAValley) {
  for (const HistoryRule rule : all_rules) {
    SCOPED_TRACE(static_cast<int>(rule));
    expect_tangent(make_sample3({.bend = 0.02}), rule,
                   remembered(0, {0.1, -0.1}, 0.03, {0, 0}, false), 10, Feature::face);
    for (const CellType type : {CellType::quad4, CellType::quad9})
      for (const Index from : {1, 2}) {
        SCOPED_TRACE(cell::info(type).name);
        PairSample3 s = make_sample3({.type = type, .kink = 1.2});
        s.x[s.x.size() - 4] = {4.02, 0.3, -0.1};
        s.pair.weight = pairing::Weight::node;
        expect_tangent(s, rule, remembered(from, {0.4, 0.25}, -0.01, {2.0, 1.0}), 10,
                       Feature::edge);
      }
  }
}

}  // namespace
}  // namespace osculate::testing
