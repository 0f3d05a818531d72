// Friction history: reversibility, borders, the metric factors of docs/errata.md, opening.
#include <gtest/gtest.h>

#include <cmath>

#include "pair_sample.hpp"

namespace osculate::testing {
namespace {

constexpr double eps_t = 80.0;

/// One slave node on a master of segments; `step` moves the slave and commits.
struct Walker {
  PairSample s;
  Index slave = -1;
  pairing::PairEvaluation<2> last;

  explicit Walker(const std::vector<Vec2>& master, double mu) {
    s.x = master;
    s.pair.master = line_through(master.size());
    slave = static_cast<Index>(master.size());
    s.x.push_back({0, 0});
    make_last_node_slave(s);
    s.pair.friction = contact::coulomb(mu, eps_t);
  }
  void start(const Vec2& at) {
    s.x.back() = at;
    s.committed = pairing::initial_state(s.pair, s.x);
  }
  const pairing::PointResult<2>& step(const Vec2& to) {
    s.x.back() = to;
    pairing::evaluate(s.pair, s.x, s.committed, false, last);
    s.committed = pairing::commit(last);
    return last.points[0];
  }
};

/// Five segments of lengths 1, 3, 1, 3, 1 with a kink of 30 degrees in the third node.
std::vector<Vec2> kinked_master() {
  const double c = std::cos(0.5236), si = std::sin(0.5236);
  std::vector<Vec2> nodes{{0, 0}, {1, 0}, {4, 0}};
  for (const double along : {1.0, 4.0, 5.0}) nodes.push_back(Vec2(4, 0) + along * Vec2(c, si));
  return nodes;
}

/// Point `depth` under the kinked master at arc length s (on the re-entrant vertex side both
/// normals meet).
Vec2 on_kinked(double s, double depth) {
  const double c = std::cos(0.5236), si = std::sin(0.5236);
  if (s <= 4) return {s, -depth};
  return Vec2(4, 0) + (s - 4) * Vec2(c, si) + depth * Vec2(si, -c);
}

TEST(PairHistory, DraggedOverFiveUnequalSegmentsAndAKinkAndBackReturnsToZero) {
  Walker w(kinked_master(), 1e6);  // sticks whatever happens
  const double depth = 1e-3;
  w.start(on_kinked(0.3, depth));
  const int steps = 37;
  double largest = 0;
  for (int i = 1; i <= steps; ++i)
    largest = std::max(largest,
                       std::abs(w.step(on_kinked(0.3 + 8.4 * i / steps, depth)).shear_traction[0]));
  EXPECT_NEAR(largest, eps_t * 8.4, 1e-10);  // arc length, over every border
  for (int i = steps - 1; i > 0; --i) w.step(on_kinked(0.3 + 8.4 * i / steps, depth));
  EXPECT_NEAR(w.step(on_kinked(0.3, depth)).shear_traction[0], 0.0, 1e-12 * eps_t * 8.4);
}

TEST(PairHistory, ResultDoesNotDependOnTheIncrementSize) {
  std::vector<double> traction;
  for (const int steps : {1, 3, 50}) {
    Walker w(kinked_master(), 1e6);
    w.start(on_kinked(0.3, 1e-3));
    double t = 0;
    for (int i = 1; i <= steps; ++i)
      t = w.step(on_kinked(0.3 + 8.4 * i / steps, 1e-3)).shear_traction[0];
    traction.push_back(t);
  }
  EXPECT_NEAR(traction[0], traction[2], 1e-10);
  EXPECT_NEAR(traction[1], traction[2], 1e-10);
}

// [eq:KS2D:89] [eq:KS2D:74]: from a segment of length 1 to one of length 3, stick. The printed
// formula keeps the covariant T: T_tr = T - eps_T a11 dxi without converting T to the new metric.
TEST(PairHistory, TractionIsConvertedToTheMetricOfTheNewSegment) {
  Walker w({{0, 0}, {1, 0}, {4, 0}}, 1e6);
  w.start({0.2, -1e-3});
  const double t_before = w.step({0.9, -1e-3}).shear_traction[0];
  const double t_after = w.step({1.0, -1e-3}).shear_traction[0] + 0.0;
  const double t_next = w.step({1.2, -1e-3}).shear_traction[0];
  EXPECT_NEAR(t_before, eps_t * 0.7, 1e-12);
  EXPECT_NEAR(t_after, eps_t * 0.8, 1e-12);
  EXPECT_NEAR(t_next, eps_t * 1.0, 1e-12);
  const double root_old = 0.5, root_new = 1.5;  // sqrt(a11) of the segments
  const double covariant = t_after * root_old;
  const double printed = (covariant + eps_t * root_new * 0.2) / root_new;  // physical component
  EXPECT_GT(std::abs(printed - t_next), 0.4 * std::abs(t_next));
}

// [eq:KS2D:74] Table 2a: after slip the centre of attraction is xi_c = xi - s mu|N|/(eps_T
// sqrt(a11)). With the printed R_xi = mu|N|/eps_T the traction at the unchanged state would be
// wrong.
TEST(PairHistory, EqualsTheMovedCentreOfTheElasticRegion) {
  const double depth = 0.01, mu = 0.3;
  Walker w({{0, 0}, {0.5, 0}}, mu);  // sqrt(a11) = 0.25
  const double root = 0.25, limit = mu * 1000 * depth;
  w.start({0.05, -depth});
  double center = -1 + 0.05 / root;
  for (const double x : {0.06, 0.2, 0.35, 0.33, 0.30, 0.21, 0.30}) {
    const double t = w.step({x, -depth}).shear_traction[0];
    const double xi = -1 + x / root;
    double expected = eps_t * root * (xi - center);
    const bool slips = std::abs(expected) > limit;
    const double sign = expected > 0 ? 1 : -1;
    if (slips) {
      const double printed = xi - sign * limit / eps_t;
      center = xi - sign * limit / (eps_t * root);
      expected = sign * limit;
      EXPECT_GT(std::abs(eps_t * root * (xi - printed) - expected), 0.5 * limit);
    }
    EXPECT_NEAR(t, expected, 1e-13);
  }
}

TEST(PairHistory, APointThatOpensForgets) {
  Walker w({{0, 0}, {4, 0}}, 1e6);
  w.start({1, -0.01});
  EXPECT_NEAR(w.step({1.5, -0.01}).shear_traction[0], eps_t * 0.5, 1e-13);
  EXPECT_EQ(w.step({1.5, 0.02}).status, contact::Status::open);
  EXPECT_FALSE(w.s.committed.points[0].active);
  EXPECT_EQ(w.step({2.0, 0.02}).shear_traction[0], 0.0);
  // comes back while it moves: two thirds of the way in the air, one third in contact
  EXPECT_NEAR(w.step({2.3, -0.01}).shear_traction[0], eps_t * 0.1, 1e-12);
}

TEST(PairHistory, ZeroGapCountsAsContact) {
  Walker w({{0, 0}, {4, 0}}, 1e6);
  w.start({1, 0});
  EXPECT_TRUE(w.s.committed.points[0].active);
  EXPECT_EQ(w.step({1, 0}).status, contact::Status::stick);
}

TEST(PairHistory, NoGapAtSharedNodes) {
  Walker w({{0, 0}, {1, 0}, {2, 0}}, 0.5);
  for (const double x : {1.0, 1.0 - 1e-12, 1.0 + 1e-12}) {
    w.start({x, -1e-3});
    const auto& point = w.step({x, -1e-3});
    EXPECT_EQ(point.history.feature, projection::Feature::face);
    EXPECT_NEAR(point.gap, -1e-3, 1e-15);
  }
}

TEST(PairHistory, ClosedSlidingLoopDissipatesFrictionTimesPath) {
  const double depth = 0.01, mu = 0.3, limit = mu * 1000 * depth;
  Walker w({{0, 0}, {1, 0}, {4, 0}}, mu);
  w.start({0.5, -depth});
  // slide until the elastic part is fully developed, then measure one closed loop 3 -> 0.6 -> 3
  for (int i = 1; i <= 100; ++i) w.step({0.5 + 0.025 * i, -depth});
  double work = 0, previous = w.last.points[0].shear_traction[0];
  const int n = 4800;
  for (int i = 1; i <= n; ++i) {
    const double phase = 2.0 * i / n;
    const double x = 0.6 + 2.4 * std::abs(phase - 1.0);
    const double t = w.step({x, -depth}).shear_traction[0];
    work += 0.5 * (t + previous) * (i <= n / 2 ? -4.8 / n : 4.8 / n);
    previous = t;
  }
  const double elastic_range = 2 * limit / eps_t;  // recovered and not dissipated at each turn
  EXPECT_NEAR(work, limit * (4.8 - 2 * elastic_range) + 0.0, 1e-6 * work);
}

}  // namespace
}  // namespace osculate::testing
