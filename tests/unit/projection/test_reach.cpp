// Reach of composed curves and surfaces: exact values, brute force, invariance.
#include "osculate/projection/reach.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "osculate/core/error.hpp"
#include "osculate/geometry/surface_frame.hpp"
#include "reach_sample.hpp"
#include "sample_surfaces.hpp"

namespace osculate::projection {
namespace {

using geometry::NurbsCurve;

constexpr double infinite = std::numeric_limits<double>::infinity();

Reach<2> reach_of(geometry::Curve curve) { return reach(Composed<2>(Shape<2>(std::move(curve)))); }
Reach<3> reach_of(geometry::Surface surface) {
  return reach(Composed<3>(Shape<3>(std::move(surface))));
}

/// Straight piece AB, arcs BC and CD of radius 1 bent to both sides (KSCPP, Fig. 6).
NurbsCurve figure6() {
  const double w = std::numbers::sqrt2 / 2;
  return {2,
          {0, 0, 0, 1, 1, 2, 2, 3, 3, 3},
          {Vec2(-2, 0), Vec2(-1, 0), Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(1, 2), Vec2(2, 2)},
          {1, 1, 1, w, 1, w, 1}};
}

TEST(Reach, EllipseIsBoundedByItsTips) {
  const Reach<2> r = reach_of(ellipse(3, 0.5));
  EXPECT_NEAR(r.above.curvature.value, 0.25 / 3, 1e-9);  // b^2/a
  EXPECT_NEAR(r.above.bottleneck.value, 0.5, 1e-10);
  EXPECT_NEAR(r.above.reach.value, 0.25 / 3, 1e-9);
  EXPECT_EQ(r.above.reach.limit, Limit::curvature);
  EXPECT_NEAR(std::abs(r.above.reach.at.x()), 3, 1e-6);
  EXPECT_NEAR(r.above.bottleneck.at.x(), 0, 1e-6);
  EXPECT_EQ(r.below.reach.value, infinite);
  EXPECT_EQ(r.below.reach.limit, Limit::none);
}

TEST(Reach, CentreOfTheEllipsePassesTheLocalTestAtTwoPoints) {         // docs/errata.md
  const geometry::CurveFrame f = curve_frame(ellipse(3, 0.5).jet(1));  // (0, 0.5)
  EXPECT_NEAR(1 - 0.5 * f.kappa, 0.9722222222, 1e-9);
}

TEST(Reach, Figure6) {
  const Reach<2> r = reach_of(figure6());
  EXPECT_NEAR(r.above.curvature.value, 1, 1e-12);
  EXPECT_NEAR(r.below.curvature.value, 1, 1e-12);
  EXPECT_NEAR(r.above.reach.value, 1, 1e-8);
  EXPECT_NEAR(r.below.reach.value, 1, 1e-8);
}

TEST(Reach, CornersOfFigure7) {
  const std::vector<Vec2> path{Vec2(0, 0), Vec2(2, 1), Vec2(4, 0), Vec2(6, 1)};
  const Reach<2> both = reach(Composed<2>(polyline(path)));
  EXPECT_EQ(both.above.reach.value, 0);
  EXPECT_EQ(both.above.reach.limit, Limit::kink);
  EXPECT_EQ(both.above.reach.at, Vec2(4, 0));
  EXPECT_EQ(both.below.reach.at, Vec2(2, 1));
  const std::vector<Vec2> square{Vec2(0, 0), Vec2(0, 1), Vec2(1, 1), Vec2(1, 0)};  // clockwise
  const Reach<2> convex = reach(Composed<2>(polyline(square, true)));
  EXPECT_EQ(convex.above.reach.value, infinite);
  EXPECT_EQ(convex.below.reach.value, 0);
  EXPECT_NEAR(convex.below.bottleneck.value, 0.5, 1e-12);
}

TEST(Reach, EndsOfCurvesCountWithTheirQuarters) {
  // two straight pieces whose ends look at each other across a gap of 0.3
  FacetMesh<2> mesh{{Vec2(0, 0), Vec2(1, 0), Vec2(1.3, 0), Vec2(2, 0)}, {}};
  mesh.facets = {{cell::CellType::line2, {0, 1}}, {cell::CellType::line2, {2, 3}}};
  const Reach<2> r = reach(Composed<2>(mesh));
  EXPECT_NEAR(r.above.reach.value, 0.15, 1e-10);
  EXPECT_NEAR(r.below.reach.value, 0.15, 1e-10);
  // an arc: the gap between its ends is seen from inside
  const geometry::Arc arc{Vec2(0, 0), 1, 0.05, 2 * std::numbers::pi - 0.05, false};
  const Reach<2> c = reach_of(arc);
  EXPECT_NEAR(c.below.reach.value, std::sin(0.05), 1e-9);
  EXPECT_NEAR(c.above.reach.value, std::tan(0.05), 1e-9);  // along the tangent of an end
}

TEST(Reach, ParallelPlates) {
  FacetMesh<2> gap{{Vec2(0, 0), Vec2(1, 0), Vec2(1.2, 0.4), Vec2(0.1, 0.4)}, {}};
  gap.facets = {{cell::CellType::line2, {0, 1}}, {cell::CellType::line2, {2, 3}}};
  const Reach<2> r = reach(Composed<2>(gap));
  EXPECT_NEAR(r.above.reach.value, 0.2, 1e-10);
  EXPECT_EQ(r.above.reach.limit, Limit::bottleneck);
  // from (1.5, 0), straight on from an end, both ends are 0.5 away; and just below that line too
  EXPECT_NEAR(r.below.reach.value, 0.5, 1e-9);
  FacetMesh<3> plates;
  for (const double z : {0.0, 0.4})
    for (const auto& p : {Vec2(0, 0), Vec2(1, 0), Vec2(1, 2), Vec2(0, 2)})
      plates.nodes.emplace_back(p.x(), p.y(), z);
  plates.facets = {{cell::CellType::quad4, {0, 1, 2, 3}}, {cell::CellType::quad4, {4, 7, 6, 5}}};
  const Reach<3> s = reach(Composed<3>(plates));
  EXPECT_NEAR(s.above.reach.value, 0.2, 1e-10);
  EXPECT_EQ(s.below.reach.value, infinite);
}

TEST(Reach, EdgeOverAFace) {
  // a roof upside down over a plate: its ridge comes to 0.5 of it
  FacetMesh<3> mesh;
  mesh.nodes = {Vec3(-2, -2, 0),    Vec3(2, -2, 0),   Vec3(2, 2, 0),      Vec3(-2, 2, 0),
                Vec3(-1, -1, 1.2),  Vec3(-1, 1, 1.2), Vec3(0.1, -1, 0.5), Vec3(0.1, 1, 0.5),
                Vec3(1.3, -1, 1.1), Vec3(1.3, 1, 1.1)};
  mesh.facets = {{cell::CellType::quad4, {0, 1, 2, 3}},
                 {cell::CellType::quad4, {4, 5, 7, 6}},
                 {cell::CellType::quad4, {6, 7, 9, 8}}};
  const Reach<3> r = reach(Composed<3>(mesh));
  EXPECT_NEAR(r.above.reach.value, 0.25, 2.5e-9);
  EXPECT_EQ(r.above.reach.limit, Limit::bottleneck);
  EXPECT_EQ(r.below.reach.value, 0);  // inside the roof
}

TEST(Reach, AnalyticSurfaces) {
  const Reach<3> ball = reach_of(geometry::Sphere{Vec3(1, 2, 3), 0.7});
  EXPECT_NEAR(ball.below.reach.value, 0.7, 1e-8);
  EXPECT_EQ(ball.above.reach.value, infinite);
  const Reach<3> ring = reach_of(geometry::Torus{Vec3(0, 0, 0), Vec3(1, 1, 0), 2, 0.8, false});
  EXPECT_NEAR(ring.below.reach.value, 0.8, 1e-8);
  EXPECT_NEAR(ring.above.reach.value, 1.2, 1e-8);
  const Reach<3> pipe =
      reach_of(geometry::Cylinder{.axis = Vec3(1, 0, 2), .radius = 0.6, .inside = true});
  EXPECT_NEAR(pipe.above.reach.value, 0.6, 1e-8);
  EXPECT_EQ(pipe.below.reach.value, infinite);
  const Reach<3> plane = reach_of(geometry::Plane{});
  EXPECT_EQ(plane.above.reach.value, infinite);
  EXPECT_EQ(plane.below.reach.value, infinite);
  // the small end of a cut cone: nearer to its axis than its radius of curvature
  const Reach<3> cut = reach_of(geometry::Cone{.half_angle = 0.6, .from = 0.8, .to = 3});
  EXPECT_NEAR(cut.below.curvature.value, 0.8 * std::tan(0.6) / std::cos(0.6), 1e-8);
  EXPECT_NEAR(cut.below.reach.value, 0.8 * std::tan(0.6), 1e-6);
  // on the continued generators, whose points belong to both sides
  EXPECT_NEAR(cut.above.reach.value, 0.8 * std::tan(0.6) / std::sin(0.6), 1e-6);
}

TEST(Reach, RoundShapesAreBoundedByTheirBendOrByTheOppositeSide) {
  const Reach<2> circle = reach_of(geometry::Circle{Vec2(1, 2), 2});
  EXPECT_NEAR(circle.below.curvature.value, 2, 1e-12);
  EXPECT_NEAR(circle.below.reach.value, 2, 1e-9);
  EXPECT_NEAR((circle.below.bottleneck.at - circle.below.bottleneck.other).norm(), 4, 1e-9);
  const Reach<2> arc = reach_of(geometry::Arc{Vec2(0, 0), 2, 0, 0.05, false});
  EXPECT_EQ(arc.below.reach.limit, Limit::curvature);
  EXPECT_EQ(arc.below.bottleneck.limit, Limit::none);
  const Reach<3> cone = reach_of(geometry::Cone{.half_angle = 0.5, .to = 2});
  EXPECT_EQ(cone.below.reach.limit, Limit::kink);
  EXPECT_EQ(cone.below.reach.value, 0);
  EXPECT_EQ(cone.above.reach.value, infinite);
}

TEST(Reach, KinksThatCountAsSmoothDoNotCutIt) {
  FacetMesh<2> mesh;  // a circle by 16 parabolas, seen from inside: kinks of 0.0037
  for (int i = 0; i < 32; ++i)
    mesh.nodes.emplace_back(std::cos(std::numbers::pi * i / 16),
                            std::sin(std::numbers::pi * i / 16));
  for (Index i = 0; i < 16; ++i)
    mesh.facets.push_back({cell::CellType::line3, {2 * i, (2 * i + 2) % 32, 2 * i + 1}});
  const Composed<2> curve{Target<2>(mesh)};
  EXPECT_EQ(reach(curve).above.reach.limit, Limit::kink);
  const Reach<2> smooth = reach(curve, {.kink = 0.01});
  EXPECT_NEAR(smooth.above.curvature.value, 0.9904, 1e-4);
  EXPECT_NEAR(smooth.above.reach.value, smooth.above.curvature.value, 1e-9);
}

TEST(Reach, CubeOutsideAndInside) {
  const Reach<3> r = reach(Composed<3>(box(Vec3(1, 2, 0.5))));
  EXPECT_EQ(r.above.reach.value, infinite);
  EXPECT_EQ(r.below.reach.value, 0);
  EXPECT_EQ(r.below.reach.limit, Limit::kink);
  EXPECT_NEAR(r.below.bottleneck.value, 0.25, 1e-12);
}

TEST(Reach, TwoPatchesHaveTheDomainOfTheWhole) {  // the remark in KSCPP 5.1
  const Reach<3> one = reach(Composed<3>(saddle(1, 1)));
  const Reach<3> four = reach(Composed<3>(saddle(2, 2)));
  EXPECT_NEAR(one.above.reach.value, 1, 1e-8);  // 1/k at the origin
  EXPECT_NEAR(one.below.reach.value, 1, 1e-8);
  EXPECT_NEAR(four.above.reach.value, one.above.reach.value, 1e-8);
  EXPECT_NEAR(four.below.reach.value, one.below.reach.value, 1e-8);
}

TEST(Reach, TurnsMovesAndScales) {
  const Mat<3, 3> turned = Eigen::AngleAxisd(0.8, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  const FacetMesh<3> mesh = saddle(2, 1);
  const Reach<3> was = reach(Composed<3>(mesh));
  for (const double scale : {1e-12, 1e-3, 1e12}) {
    FacetMesh<3> other = mesh;
    for (Vec3& p : other.nodes) p = scale * (turned * p + Vec3(0.3, -0.2, 0.5));
    const Reach<3> is = reach(Composed<3>(other));
    EXPECT_NEAR(is.above.reach.value / scale, was.above.reach.value, 1e-7);
    EXPECT_NEAR(is.below.reach.value / scale, was.below.reach.value, 1e-7);
  }
  const Reach<2> curve = reach_of(ellipse(1, 0.9));
  for (const double scale : {1e-12, 1e12}) {
    NurbsCurve other = ellipse(1, 0.9);
    for (Vec2& p : other.control) p = scale * (Eigen::Rotation2Dd(0.7) * p + Vec2(0.4, -1));
    const Reach<2> is = reach_of(other);
    EXPECT_NEAR(is.above.reach.value / scale, curve.above.reach.value, 1e-7);
    EXPECT_NEAR(is.above.bottleneck.value / scale, 0.9, 1e-7);
  }
}

/// Local minima of the distance within `limit` whose arm points to the side.
int minima_within(const NurbsCurve& curve, const Vec2& x, int side, double limit) {
  constexpr int samples = 4000;
  std::vector<double> d;
  std::vector<double> sign;
  for (int i = 0; i <= samples; ++i) {
    const geometry::CurveJet<2> j = curve.jet(curve.lo() + (curve.hi() - curve.lo()) * i / samples);
    d.push_back((x - j.r).norm());
    sign.push_back((x - j.r).dot(curve_frame(j).normal) * side);
  }
  int count = 0;
  for (std::size_t i = 0; i < d.size(); ++i) {
    const bool falls = i == 0 || d[i] < d[i - 1], rises = i + 1 == d.size() || d[i] <= d[i + 1];
    count += falls && rises && d[i] < limit && sign[i] >= 0;
  }
  return count;
}

TEST(Reach, OneLocalMinimumWithinItOnRandomCurves) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int c = 0; c < 8; ++c) {
    SCOPED_TRACE(c);
    const int degree = 3 + c % 2;
    NurbsCurve curve = testing::nurbs_wave(degree, 7);
    for (Vec2& p : curve.control) p += 0.3 * Vec2(number(random), number(random));
    const Reach<2> r = reach_of(curve);
    for (const int side : {-1, 1}) {
      const SideLimit<2>& limit = side > 0 ? r.above.reach : r.below.reach;
      ASSERT_GT(limit.value, 0);
      EXPECT_LT(limit.value, dense_bound(curve, side, 700) * (1 + 1e-6));
      for (int k = 0; k < 40; ++k) {
        const double xi = 0.5 * (1 + number(random)) * (curve.hi() - curve.lo());
        const geometry::CurveJet<2> j = curve.jet(curve.lo() + xi);
        const double zeta = 0.5 * (1 + number(random)) * 0.999 * limit.value;
        const Vec2 x = j.r + side * zeta * curve_frame(j).normal;
        EXPECT_EQ(minima_within(curve, x, side, 0.999 * limit.value), 1);
      }
    }
  }
}

/// Local minima of the distance on a dense grid of a patch, within `limit` and on the side.
int minima_within(const geometry::NurbsPatch& patch, const Vec3& x, int side, double limit) {
  constexpr int n = 90;
  std::vector<double> d, sign;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) {
      const Vec2 t = Vec2(i, j) / n;
      const geometry::SurfaceJet jet =
          patch.jet(patch.lo() + t.cwiseProduct(patch.hi() - patch.lo()));
      d.push_back((x - jet.r).norm());
      sign.push_back((x - jet.r).dot(surface_frame(jet).normal) * side);
    }
  int count = 0;
  const auto at = [](int i, int j) { return static_cast<std::size_t>(i * (n + 1) + j); };
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) {
      bool least = d[at(i, j)] < limit && sign[at(i, j)] >= 0;
      for (int a = std::max(i - 2, 0); a <= std::min(i + 2, n) && least; ++a)
        for (int b = std::max(j - 2, 0); b <= std::min(j + 2, n) && least; ++b)
          least = d[at(a, b)] >= d[at(i, j)];
      count += least;
    }
  return count;
}

TEST(Reach, OneLocalMinimumWithinItOnRandomPatches) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int c = 0; c < 2; ++c) {
    SCOPED_TRACE(c);
    geometry::NurbsPatch patch = testing::nurbs_hills({3, 2}, {5, 4});
    for (Vec3& p : patch.control) p += 0.2 * Vec3(number(random), number(random), number(random));
    const Reach<3> r = reach_of(patch);
    for (const int side : {-1, 1}) {
      const double limit = side > 0 ? r.above.reach.value : r.below.reach.value;
      ASSERT_GT(limit, 0);
      ASSERT_LT(limit, 10);
      for (int k = 0; k < 12; ++k) {
        const Vec2 t = 0.5 * Vec2(1 + number(random), 1 + number(random));
        const geometry::SurfaceJet jet =
            patch.jet(patch.lo() + t.cwiseProduct(patch.hi() - patch.lo()));
        const double zeta = 0.5 * (1 + number(random)) * 0.98 * limit;
        const Vec3 x = jet.r + side * zeta * surface_frame(jet).normal;
        EXPECT_EQ(minima_within(patch, x, side, 0.98 * limit), 1);
      }
    }
  }
}

TEST(Reach, BadInputIsNamed) {
  const auto message = [](FacetMesh<3> mesh) -> std::string {
    try {
      const Composed<3> surface{Target<3>(std::move(mesh))};
    } catch (const core::InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(message({}), "a surface needs at least one facet");
  FacetMesh<3> mesh = saddle(1, 1);
  mesh.facets[0].nodes[3] = 12;
  EXPECT_EQ(message(mesh), "facet 0 names node 12; there are nodes 0 to 8");
  mesh = saddle(1, 1);
  mesh.nodes[2].x() = NAN;
  EXPECT_EQ(message(mesh), "node 2 has a coordinate that is not finite");
}

}  // namespace
}  // namespace osculate::projection
