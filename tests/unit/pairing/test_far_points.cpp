// Points that are left out of evaluations since they cannot be in contact: the same bits as if all
// were looked at every time.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "history_checks.hpp"
#include "osculate/pairing/far_points.hpp"
#include "osculate/pairing/point_normal.hpp"
#include "own_surface_sample.hpp"

namespace osculate::testing {
namespace {

using contact::Status;

struct Seen {
  std::size_t looks = 0, back = 0, all = 0, touching = 0, began = 0;
};

/// Evaluations one after the other, of all points and, by three threads, of those that may be near.
/// Each `period` evaluations all places are asked for.
template <int Dim>
Seen expect_same(const ContactSample<Dim>& sample, int count, int period, double early,
                 const std::function<void(int, std::vector<Vec<Dim>>&)>& move) {
  const pairing::PairDefinition<Dim>& pair = sample.pair;
  std::vector<Vec<Dim>> x = sample.x;
  pairing::PairState<Dim> whole = pairing::initial_state<Dim>(pair, x), some = whole;
  pairing::PairEvaluation<Dim> of_whole, of_some;
  pairing::ActiveSet<Dim> active_set;
  active_set.duration = 1e-3;
  active_set.mean_onset = true;
  core::Crew threads(3);
  pairing::FarPoints<Dim> far;
  far.early = early;
  Seen seen;
  for (int step = 0; step < count; ++step) {
    move(step, x);
    const bool all = step % period == period - 1;
    pairing::evaluate<Dim>(pair, x, whole, false, of_whole, active_set);
    pairing::evaluate<Dim>(pair, x, some, of_some, active_set, far, all, &threads);
    EXPECT_TRUE(far.leaves_out());
    for (std::size_t i = 0; i < of_whole.points.size(); ++i) {
      const pairing::PointResult<Dim>&a = of_whole.points[i], &b = of_some.points[i];
      EXPECT_EQ(a.status, b.status) << step << " " << i;
      EXPECT_EQ(a.normal_traction, b.normal_traction);
      EXPECT_EQ(of_whole.blocks[i].count, of_some.blocks[i].count);
      if (a.status != Status::open) {
        EXPECT_EQ(of_whole.blocks[i].force, of_some.blocks[i].force);
        ++seen.touching;
        if (!whole.points[i].active) ++seen.began;
      }
      if (a.status != Status::open || all) expect_same_history<Dim>(a.history, b.history);
      if (all) {
        EXPECT_EQ(a.gap, b.gap);
      }
    }
    seen.all += of_whole.points.size();
    whole = pairing::commit(of_whole);
    some = pairing::commit(of_some);
    if (all) far.forget();
  }
  seen.looks = far.looks();
  seen.back = far.looks_back();
  return seen;
}

/// Between -1 and 1, of a number.
double noise(double k) { return std::sin(12.9898 * k + 78.233 * std::sin(k)); }

/// A tumbling patch of 9 x 9 nodes over a shape that turns and moves. Now and then it goes forty
/// times as far as before in one step.
ContactSample<3> patch_over(const geometry::Surface& shape) {
  constexpr int side = 9;
  ContactSample<3> s;
  s.x = {Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  s.pair.master.facets.push_back(pairing::shape_facet(shape, {0, 1, 2, 3}));
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) s.x.emplace_back(0.225 * i - 0.9, 0.225 * j - 0.9, 1);
  pairing::FacetSurface patch;
  const auto node = [](int i, int j) { return static_cast<Index>(4 + side * j + i); };
  for (int j = 0; j + 1 < side; ++j)
    for (int i = 0; i + 1 < side; ++i) {
      pairing::SurfaceFacet facet;
      facet.type = cell::CellType::quad4;
      facet.count = 4;
      facet.nodes = {node(i, j), node(i, j + 1), node(i + 1, j + 1), node(i + 1, j)};
      patch.facets.push_back(facet);
    }
  pairing::connect(patch);
  s.pair.slave = pairing::make_slave_side(patch);
  s.pair.normal = contact::penalty(1000);
  s.pair.friction = contact::coulomb(0.3, 500);
  pairing::prepare<3>(s.pair, s.x);
  return s;
}
void tumble(const std::vector<Vec3>& rest, bool jumps, int step, std::vector<Vec3>& x) {
  const double jump = jumps ? 40.0 * (step / 37) : 0.0, t = 0.002 * (step + jump);
  const Eigen::AngleAxisd master(0.3 * std::sin(2 * t), Vec3(1, 2, 0.5).normalized());
  const Vec3 lift(0.1 * t, 0, 0.1 * std::sin(5 * t));
  for (std::size_t n = 0; n < 4; ++n) x[n] = master * rest[n] + lift;
  const Eigen::AngleAxisd turn(0.5 * std::sin(3 * t), Vec3(0.3, 1, 0.2).normalized());
  for (std::size_t n = 4; n < x.size(); ++n) {
    const double k = static_cast<double>(n);
    x[n] = turn * Vec3(rest[n] - Vec3(0, 0, 1)) + Vec3(0.2 * t, 0, 0.3 + 0.5 * std::cos(4 * t)) +
           1e-4 * Vec3(noise(k + step), noise(2 * k + step), noise(3 * k - step));
  }
}

TEST(FarPoints, OfShapesAreLeftOutWithTheSameBits) {
  for (const geometry::Surface& shape :
       {geometry::Surface(geometry::Plane{{0, 0, 0.1}, {0.1, 0.2, 1}}),
        geometry::Surface(geometry::Sphere{{0, 0, -1.5}, 1.6, false, {0, 0, 1}})})
    for (const bool jumps : {false, true})
      for (const double early : {0.75, 1.0}) {
        SCOPED_TRACE(std::string(geometry::key(shape)) + (jumps ? ", jumps" : ""));
        const ContactSample<3> s = patch_over(shape);
        const Seen seen = expect_same<3>(s, 1500, 60, early, [&](int step, std::vector<Vec3>& x) {
          tumble(s.x, jumps, step, x);
        });
        EXPECT_GT(seen.touching, 500u);
        EXPECT_GT(seen.began, 50u);
        EXPECT_LT(seen.looks, seen.all / 2);
        if (jumps) {
          EXPECT_GT(seen.back, 10u);
        }
      }
}

TEST(FarPoints, InThePlaneLikewise) {
  for (const geometry::Curve& shape : {geometry::Curve(geometry::InfiniteLine{{0, 0}, {0.1, 1}}),
                                       geometry::Curve(geometry::Circle{{0, 2}, 2.4, true})}) {
    SCOPED_TRACE(geometry::key(shape));
    ContactSample<2> s;
    s.x = {Vec2::Zero(), Vec2::UnitX(), Vec2::UnitY()};
    s.pair.master.facets.push_back(pairing::shape_facet(shape, {0, 1, 2}));
    for (int n = 0; n < 20; ++n) s.x.emplace_back(1 - 0.1 * n, 0);
    pairing::Chain chain;
    for (Index n = 3; n + 1 < static_cast<Index>(s.x.size()); ++n) {
      pairing::Facet facet;
      facet.count = 2;
      facet.nodes = {n, n + 1};
      chain.facets.push_back(facet);
    }
    pairing::connect(chain);
    s.pair.slave = pairing::make_slave_side(chain);
    s.pair.normal = contact::penalty(1000);
    s.pair.friction = contact::coulomb(0.3, 500);
    pairing::prepare<2>(s.pair, s.x);
    const Seen seen = expect_same<2>(s, 1500, 60, 0.75, [&](int step, std::vector<Vec2>& x) {
      const double t = 0.002 * (step + 40.0 * (step / 37));
      for (std::size_t n = 3; n < x.size(); ++n)
        x[n] = Eigen::Rotation2Dd(0.4 * std::sin(3 * t)) * s.x[n] +
               Vec2(0.1 * std::sin(t), 0.25 + 0.4 * std::cos(4 * t));
    });
    EXPECT_GT(seen.touching, 500u);
    EXPECT_LT(seen.looks, seen.all * 2 / 3);
    EXPECT_GT(seen.back, 10u);
  }
}

/// A quarter in each period, in a fifth of it.
double quarter_turns(double phase) {
  const double periods = phase / (2 * std::numbers::pi), whole = std::floor(periods);
  return std::numbers::pi / 2 * (whole + std::clamp((periods - whole - 0.4) / 0.2, 0.0, 1.0));
}

/// Two plates of facets that move and bend, with a candidate filter.
TEST(FarPoints, BeyondTheReachOfAFilterAreLeftOutWithTheSameBits) {
  PairSample3 s =
      own_walls(outline({{0, 0}, {0, 0.4}, {6, 0.4}, {6, 0}}, 0.25), cell::CellType::quad4);
  s.pair.filter.own = false;
  s.pair.filter.distance = 0.6;
  s.pair.filter.thickness.clear();
  const auto count = static_cast<Index>(s.x.size());
  for (Index n = 0; n < count; ++n)
    s.x.push_back(s.x[static_cast<std::size_t>(n)] + Vec3(0.07, 0.45, 0.03));
  pairing::FacetSurface upper = s.pair.master;
  for (pairing::SurfaceFacet& facet : upper.facets)
    for (std::size_t k = 0; k < static_cast<std::size_t>(facet.count); ++k) facet.nodes[k] += count;
  pairing::connect(upper);
  s.pair.slave = pairing::make_slave_side(upper);
  pairing::prepare(s.pair, s.x);
  // Who comes to whom, with jumps, and after both have turned far from each other: about the
  // direction in which they are apart, so that not even their boxes come near each other, and to
  // touch where the turn has carried them farthest.
  for (const auto& kind : {std::pair(false, false), {true, false}, {false, true}}) {
    const bool of_master = kind.first, turns = kind.second;
    const double jump = of_master ? 15 : 0, high = turns ? 1.5 : 0.62;
    const int period = turns ? 601 : 50;
    const Seen seen = expect_same<3>(s, 600, period, 0.75, [&](int step, std::vector<Vec3>& x) {
      const double t = 0.01 * (step + jump * (step / 23));
      for (std::size_t n = 0; n < x.size(); ++n) {
        const Vec3& at = s.x[n];
        const bool up = n >= static_cast<std::size_t>(count);
        const double down =
            high * (std::cos(2.3 * t) - 1) + 0.12 - 0.06 * (turns ? 6 - at.x() : at.x());
        const double bends = 0.05 * std::sin(3 * t + at.x());
        x[n] = at + Vec3(up ? 0.2 * std::sin(t) : 0.0, 0, 0);
        if (up)
          x[n].y() -= of_master ? bends : down;
        else
          x[n].y() += of_master ? down : bends;
        if (turns) x[n] = Eigen::AngleAxisd(quarter_turns(2.3 * t), Vec3::UnitY()) * x[n];
      }
    });
    EXPECT_GT(seen.touching, 200u);
    EXPECT_GT(seen.began, 10u);
    EXPECT_LT(seen.looks, seen.all * 3 / 4);
  }
}

TEST(FarPoints, NormalOfOnePointHasTheBitsOfAll) {
  const ContactSample<3> s = patch_over(geometry::Plane{{0, 0, 0}, {0, 0, 1}});
  std::vector<Vec3> x = s.x, normals;
  tumble(s.x, false, 11, x);
  pairing::point_normals<3>(s.pair.slave, x, normals);
  for (std::size_t i = 0; i < normals.size(); ++i)
    EXPECT_EQ(normals[i], pairing::point_normal<3>(s.pair.slave, x, i));
}

}  // namespace
}  // namespace osculate::testing
