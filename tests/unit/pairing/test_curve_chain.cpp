// Several analytic curves on one frame as one chain: neighbours, history over the joints, corners.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "osculate/geometry/interpolation.hpp"
#include "pair_sample.hpp"

namespace osculate::testing {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double eps_t = 80.0;

/// Up a wall, round a quarter circle onto a floor (smoothly), along it, and down at a sharp corner:
/// (0, 3) .. (0, 1), arc about (1, 1), (1, 0) .. (3, 0), (3, 0) .. (3, -2). The body is on the
/// right of travel: left of the wall, under the floor.
std::vector<geometry::Curve> channel() {
  const auto segment = [](const Vec2& a, const Vec2& b) {
    return geometry::Curve(geometry::lagrange_curve(std::array<Vec2, 2>{a, b}));
  };
  return {segment({0, 3}, {0, 1}), geometry::Arc{{1, 1}, 1.0, pi, 1.5 * pi, true},
          segment({1, 0}, {3, 0}), segment({3, 0}, {3, -2})};
}

/// One slave point on the channel, whose frame is moved by a rigid motion.
struct Slider {
  PairSample s;
  pairing::PairEvaluation<2> last;

  explicit Slider(double mu, bool closed = false) {
    s.x = {{0, 0}, {1, 0}, {0, 1}, {0, 0}};
    pairing::add_curves(channel(), closed, {0, 1, 2}, s.pair.master);
    make_last_node_slave(s);
    s.pair.friction = contact::coulomb(mu, eps_t);
  }
  /// Turns the frame by `angle` about the origin.
  void turn_by(double angle) {
    s.x[1] = {std::cos(angle), std::sin(angle)};
    s.x[2] = {-std::sin(angle), std::cos(angle)};
  }
  [[nodiscard]] Vec2 moved(const Vec2& p) const { return p.x() * s.x[1] + p.y() * s.x[2]; }
  void start(const Vec2& at) {
    s.x[3] = moved(at);
    s.committed = pairing::initial_state(s.pair, s.x);
  }
  const pairing::PointResult<2>& step(const Vec2& to) {
    s.x[3] = moved(to);
    pairing::evaluate(s.pair, s.x, s.committed, false, last);
    s.committed = pairing::commit(last);
    return last.points[0];
  }
};

/// The point `depth` inside the body at path length s from (0, 2), up to the corner and beyond.
Vec2 on_channel(double s, double depth) {
  if (s <= 1) return {-depth, 2 - s};
  if (s <= 1 + pi / 2) return Vec2(1, 1) + (1 + depth) * Vec2(-std::cos(s - 1), -std::sin(s - 1));
  return {s - pi / 2, -depth};
}

TEST(CurveChain, NeighboursInTheOrderOfTheCurves) {
  const Slider open(0.1), closed(0.1, true);
  const auto& a = open.s.pair.master.facets;
  const auto& b = closed.s.pair.master.facets;
  for (std::size_t f = 0; f < 4; ++f) {
    const auto at = static_cast<Index>(f);
    EXPECT_EQ(a[f].prev, at - 1);
    EXPECT_EQ(a[f].next, f < 3 ? at + 1 : -1);
    EXPECT_EQ(b[f].prev, (at + 3) % 4);
    EXPECT_EQ(b[f].next, (at + 1) % 4);
    EXPECT_FALSE(b[f].closed);
  }
}

// The slip is the path over both smooth joints, also while the body turns, and back to zero.
TEST(CurveChain, CarriesTheHistoryOverItsJointsAndBack) {
  for (const double spin : {0.0, 0.8}) {
    Slider w(1e6);
    w.start(on_channel(0.1, 1e-3));
    const int steps = 23;
    const double way = 2 + pi / 2;
    for (int i = 1; i <= steps; ++i) {
      w.turn_by(spin * i / steps);
      const auto& point = w.step(on_channel(0.1 + way * i / steps, 1e-3));
      EXPECT_NEAR(point.gap, -1e-3, 1e-14);
      EXPECT_NEAR(point.shear_traction[0], eps_t * way * i / steps, 1e-11);
    }
    for (int i = steps - 1; i >= 0; --i) {
      w.turn_by(spin * i / steps);
      w.step(on_channel(0.1 + way * i / steps, 1e-3));
    }
    EXPECT_NEAR(w.last.points[0].shear_traction[0], 0.0, 1e-11);
  }
}

// Exactly on a smooth joint and a rounding error beside it: no gap opens, one foot point.
TEST(CurveChain, JointsAreTight) {
  Slider w(1e6);
  for (const double joint : {1.0, 1 + pi / 2})
    for (const double beside : {-1e-9, -1e-13, -1e-16, 0.0, 1e-16, 1e-13, 1e-9}) {
      w.start(on_channel(joint + beside, 1e-3));
      const auto& point = w.step(on_channel(joint + beside, 1e-3));
      EXPECT_NEAR(point.gap, -1e-3, 1e-12);
      EXPECT_NEAR((point.foot - on_channel(joint + beside, 0)).norm(), 0, 2e-12);
      EXPECT_NEAR(point.shear_traction[0], 0, 1e-10);
    }
}

// A sharp convex corner between two curves is a vertex with the averaged normal.
TEST(CurveChain, ConvexCornersAreVertices) {
  Slider w(1e6);
  w.start({3.3, 0.4});
  const auto& outside = w.step({3.3, 0.4});
  EXPECT_NEAR(outside.gap, 0.5, 1e-14);
  EXPECT_NEAR((outside.foot - Vec2(3, 0)).norm(), 0, 1e-15);
  EXPECT_EQ(outside.history.feature, projection::Feature::corner);
  const auto& floor = w.step({2.9, -0.01});
  EXPECT_NEAR(floor.gap, -0.01, 1e-15);
  const auto& side = w.step({2.99, -0.5});
  EXPECT_NEAR(side.gap, -0.01, 1e-15);
  EXPECT_NEAR((side.normal - Vec2(1, 0)).norm(), 0, 1e-15);
}

// In a concave corner the point beyond both curves belongs to the vertex between them.
TEST(CurveChain, ConcaveCornersAreShared) {
  Slider w(1e6);
  w.s.pair.master.facets.clear();
  const auto segment = [](const Vec2& a, const Vec2& b) {
    return geometry::Curve(geometry::lagrange_curve(std::array<Vec2, 2>{a, b}));
  };
  pairing::add_curves({segment({0, 2}, {0, 0}), segment({0, 0}, {2, 0})}, false, {0, 1, 2},
                      w.s.pair.master);
  w.start({0.5, 0.5});  // as near to the wall as to the floor
  const auto& shared = w.step({0.5, 0.5});
  EXPECT_EQ(shared.history.feature, projection::Feature::corner);
  const auto& deep = w.step({-0.03, -0.04});
  EXPECT_EQ(deep.history.feature, projection::Feature::corner);
  EXPECT_NEAR(deep.gap, -0.05, 1e-15);
}

}  // namespace
}  // namespace osculate::testing
