// Local conditions of uniqueness against the distance itself.
#include "osculate/projection/local_domain.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "osculate/projection/point_to_curve.hpp"
#include "osculate/projection/point_to_facet.hpp"
#include "osculate/projection/surface_distance.hpp"
#include "sample_curves.hpp"
#include "sample_surfaces.hpp"

namespace osculate::projection {
namespace {

using geometry::SurfaceFrame;
using testing::at_surface_places;

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr std::array<double, 7> heights{-3, -0.8, -0.2, 0, 0.3, 0.9, 4};

TEST(LocalDomain, SecondDerivativeAtTheFootPoint) {  // [eq:KSCPP:11]
  at_surface_places([](const geometry::Surface& s, const Vec2& xi) {
    const geometry::SurfaceJet j = geometry::jet(s, xi);
    const SurfaceFrame f = surface_frame(j);
    for (const double zeta : heights) {
      const DistanceJet2 d = distance_jet2<3>(zeta * f.normal, j.r1, j.r2);
      EXPECT_LT((distance_bend(f, zeta) - d.bend).norm(), 1e-12 * (1 + d.bend.norm()));
    }
  });
}

TEST(LocalDomain, DistanceToASurfaceByOrder) {
  // [eq:KSCPP:4] [eq:KSCPP:5] [eq:KSCPP:6] [eq:KSCPP:8] [eq:KSCPP:9] [eq:KSCPP:10]
  at_surface_places([](const geometry::Surface& s, const Vec2& xi) {
    const geometry::SurfaceJet j = geometry::jet(s, xi);
    const SurfaceFrame f = surface_frame(j);
    const Vec3 point = offset_point(j, f.normal, 0.2) + 0.1 * j.r1[0] - 0.05 * j.r1[1];
    const auto at = [&](const Vec2& x) {
      const geometry::SurfaceJet here = geometry::jet(s, x);
      return distance_jet2<3>(point - here.r, here.r1, here.r2);
    };
    const DistanceJet2 d = at(xi);
    const auto half = [&](const Vec2& x) { return Vec3(0.5 * at(x).squared_distance, 0, 0); };
    const auto slope = [&](const Vec2& x) { return Vec3(at(x).slope[0], at(x).slope[1], 0); };
    for (Eigen::Index i = 0; i < 2; ++i) {
      EXPECT_TRUE(testing::is_derivative(half, Vec3(d.slope[i], 0, 0), xi, i));
      EXPECT_TRUE(testing::is_derivative(slope, Vec3(d.bend(0, i), d.bend(1, i), 0), xi, i));
      EXPECT_NEAR(f.a(i, i), j.r1[static_cast<std::size_t>(i)].squaredNorm(), 1e-13 * f.a.norm());
      EXPECT_NEAR(f.h(i, i), f.normal.dot(j.r2[static_cast<std::size_t>(2 * i)]),
                  1e-13 * (1 + f.h.norm()));
    }
    if (positive(d.bend)) {
      EXPECT_LT((d.bend * descent(d) + d.slope).norm(), 1e-10 * (1 + d.slope.norm()));
    }
  });
}

TEST(LocalDomain, DistanceToACurveByOrder) {
  // [eq:KSCPP:27] [eq:KSCPP:28] [eq:KSCPP:29] [eq:KSCPP:43] in any parameter
  for (const testing::NamedCurve& sample : testing::sample_curves()) {
    SCOPED_TRACE(sample.name);
    const auto range = testing::finite_range(sample.curve);
    const double xi = range[0] + 0.41 * (range[1] - range[0]);
    const geometry::CurveJet<2> j = geometry::jet(sample.curve, xi);
    const Vec2 point = offset_point(j, curve_frame(j).normal, 0.2) + 0.1 * j.r1;
    const auto at = [&](double x) {
      return distance_jet(geometry::jet(sample.curve, x), x, point);
    };
    const DistanceJet d = at(xi);
    EXPECT_NEAR(d.squared_distance, 0.04 + 0.01 * d.a11, 1e-12 * (1 + d.a11));
    const auto half = [&](double x) { return Vec2(0.5 * at(x).squared_distance, 0); };
    const auto slope = [&](double x) { return Vec2(at(x).slope, 0); };
    EXPECT_TRUE(testing::check_order(half, Vec2(d.slope, 0), xi, 1e-3).second_order());
    EXPECT_TRUE(testing::check_order(slope, Vec2(d.bend, 0), xi, 1e-3).second_order());
    EXPECT_NEAR(newton_step(d) * d.bend, -d.slope, 1e-13 * (1 + std::abs(d.slope)));
  }
}

TEST(LocalDomain, FootOnACurvedEdgeIsOrthogonal) {  // [eq:KSCPP:37]
  const std::vector<Vec3> nodes = testing::bent_facet_nodes(cell::CellType::quad9, 0.3);
  for (int edge = 0; edge < 4; ++edge) {
    const Vec3 middle = nodes[4 + static_cast<std::size_t>(edge)];
    const FacetFoot foot = closest_point_on_edge(cell::CellType::quad9, nodes, edge,
                                                 Vec3(middle + Vec3(0.05, -0.04, 0.2)));
    ASSERT_TRUE(foot.converged);
    ASSERT_EQ(foot.feature, Feature::edge);
    const geometry::SurfaceJet j =
        geometry::lagrange_surface(cell::CellType::quad9, nodes).jet(foot.xi);
    const Vec3 tangent = j.r1[edge % 2 == 0 ? 0 : 1];
    EXPECT_NEAR((middle + Vec3(0.05, -0.04, 0.2) - j.r).dot(tangent), 0, 1e-9);
  }
}

TEST(LocalDomain, SylvesterAndPrincipalCurvaturesAgree) {
  // [eq:KSCPP:12] [eq:KSCPP:19] [eq:KSCPP:20] [eq:KSCPP:22] [eq:KSCPP:23] [eq:KSCPP:24]
  // [eq:KSCPP:25]
  at_surface_places([](const geometry::Surface& s, const Vec2& xi) {
    const SurfaceFrame f = surface_frame(geometry::jet(s, xi));
    const geometry::PrincipalCurvatures k = principal_curvatures(f);
    const LocalDomain domain = local_domain(k);
    const double mean = mean_curvature(f), gauss = gaussian_curvature(f);
    for (const double zeta : heights) {
      const double area = shifted_area(mean, gauss, zeta);
      EXPECT_NEAR(area, distance_bend(f, zeta).determinant() / f.a.determinant(),
                  1e-11 * (1 + std::abs(area)));
      if (std::abs(area) < 1e-9) continue;  // at a centre of curvature
      EXPECT_EQ(locally_nearest(f, zeta), locally_nearest(k, zeta));
      EXPECT_EQ(domain.contains(zeta), locally_nearest(k, zeta));
    }
  });
}

TEST(LocalDomain, FourClasses) {  // [eq:KSCPP:22] [eq:KSCPP:23] [eq:KSCPP:24] [eq:KSCPP:25]
  EXPECT_DOUBLE_EQ(local_domain(4, 2).above, 0.25);  // elliptic, bent upwards
  EXPECT_EQ(local_domain(4, 2).below, -infinite);
  EXPECT_DOUBLE_EQ(local_domain(-2, -4).below, -0.25);  // elliptic, a dome
  EXPECT_EQ(local_domain(-2, -4).above, infinite);
  EXPECT_DOUBLE_EQ(local_domain(4, -2).above, 0.25);  // hyperbolic
  EXPECT_DOUBLE_EQ(local_domain(4, -2).below, -0.5);
  EXPECT_EQ(local_domain(0, -2).above, infinite);  // parabolic
  EXPECT_DOUBLE_EQ(local_domain(0, -2).below, -0.5);
  EXPECT_EQ(local_domain(0, 0).above, infinite);  // planar
  EXPECT_EQ(local_domain(0, 0).below, -infinite);
  EXPECT_TRUE(local_domain(4, 2).contains(0));
}

TEST(LocalDomain, PlaneCurve) {  // [eq:KSCPP:31] [eq:KSCPP:32] [eq:KSCPP:33]
  for (const testing::NamedCurve& sample : testing::sample_curves()) {
    SCOPED_TRACE(sample.name);
    const auto range = testing::finite_range(sample.curve);
    for (const double t : {0.13, 0.47, 0.81}) {
      const geometry::CurveJet<2> j =
          geometry::jet(sample.curve, range[0] + t * (range[1] - range[0]));
      const geometry::CurveFrame f = curve_frame(j);
      const LocalDomain domain = local_domain(f);
      for (const double zeta : heights) {
        const double bend = distance_bend(f, zeta);
        const double direct = j.r1.squaredNorm() - zeta * f.normal.dot(j.r2);
        EXPECT_NEAR(bend * f.a11, direct, 1e-12 * (f.a11 + std::abs(direct)));
        if (std::abs(bend) > 1e-9) {
          EXPECT_EQ(domain.contains(zeta), bend > 0);
        }
      }
    }
  }
}

TEST(LocalDomain, Figure5) {  // [eq:KSCPP:32] [eq:KSCPP:33] a convex arc: O1 O2 C2 C1
  const geometry::Arc hole{Vec2(0, 0), 2, 0.5, 2.5, true};  // normals point to the centre
  const LocalDomain inwards = local_domain(curve_frame(hole.jet(1)));
  EXPECT_DOUBLE_EQ(inwards.above, 2);
  EXPECT_EQ(inwards.below, -infinite);
  const geometry::Arc disc{Vec2(0, 0), 2, 0.5, 2.5, false};
  const LocalDomain outwards = local_domain(curve_frame(disc.jet(-1)));
  EXPECT_EQ(outwards.above, infinite);
  EXPECT_DOUBLE_EQ(outwards.below, -2);
}

TEST(LocalDomain, CurvedEdgeOfFigure9) {
  // [eq:KSCPP:40] [eq:KSCPP:41] [eq:KSCPP:42] a circle of radius 2 in space
  const auto circle = [](double t) { return testing::circle_in_space(2, t); };
  const geometry::CurveJet<3> j = circle(0.7);
  const geometry::SpaceCurveFrame f = space_curve_frame(j);
  for (const double phi : {0.0, 0.5, 1.2, 1.9, 3.0, 4.4, 5.5})
    for (const double r : {0.3, 1.9, 2.1, 7.0}) {
      const Vec3 point = point_around(j, f, r, phi);
      const double bend = distance_bend(f, r, phi);
      EXPECT_NEAR(bend, distance_bend(f, Vec3(point - j.r)), 1e-14 * (1 + r));
      EXPECT_NEAR(bend, (j.r1.squaredNorm() - (point - j.r).dot(j.r2)) / j.r1.squaredNorm(),
                  1e-13 * (1 + r));
      EXPECT_EQ(bend > 0, r < local_limit(f, phi));
      double before = 0, after = 0;  // the distance itself, beside the foot point
      before = (circle(0.7 - 1e-3).r - point).norm();
      after = (circle(0.7 + 1e-3).r - point).norm();
      EXPECT_EQ(bend > 0, std::min(before, after) > r);
    }
  EXPECT_DOUBLE_EQ(local_limit(f, 0), 2);
  EXPECT_EQ(local_limit(f, 0.5 * std::numbers::pi), infinite);
  geometry::CurveJet<3> straight;
  straight.r1 = Vec3(1, 0, 0);
  EXPECT_EQ(local_limit(space_curve_frame(straight), 0), infinite);
}

}  // namespace
}  // namespace osculate::projection
