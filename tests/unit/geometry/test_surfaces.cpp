// The catalogue of surfaces: every entry by the same loop, then what is particular.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "osculate/geometry/nurbs.hpp"
#include "osculate/geometry/surface_frame.hpp"
#include "sample_surfaces.hpp"

namespace osculate::geometry {
namespace {

using testing::at_surface_places;
using testing::is_derivative;
using testing::sample_surfaces;

TEST(SurfaceCatalogue, EveryEntryHasASampleAndAKeyOfItsOwn) {
  std::set<std::size_t> seen;
  std::set<std::string_view> keys;
  for (const testing::NamedSurface& sample : sample_surfaces()) {
    seen.insert(sample.surface.index());
    keys.insert(key(sample.surface));
    EXPECT_EQ(validate(sample.surface), "") << sample.name;
    EXPECT_TRUE((lo(sample.surface).array() < hi(sample.surface).array()).all()) << sample.name;
  }
  EXPECT_EQ(seen.size(), std::variant_size_v<Surface>);
  EXPECT_EQ(keys.size(), std::variant_size_v<Surface>);
}

TEST(SurfaceCatalogue, JetsAreDerivativesByOrder) {
  at_surface_places([](const Surface& s, const Vec2& xi) {
    const SurfaceJet j = jet(s, xi);
    const auto r = [&](const Vec2& x) { return jet(s, x).r; };
    for (std::size_t i = 0; i < 2; ++i) {
      const auto along = static_cast<Eigen::Index>(i);
      EXPECT_TRUE(is_derivative(r, j.r1[i], xi, along));
      for (std::size_t a = 0; a < 2; ++a) {
        const auto first = [&, a](const Vec2& x) { return jet(s, x).r1[a]; };
        EXPECT_TRUE(is_derivative(first, j.r2[i + a], xi, along)) << a << i;
      }
      for (std::size_t a = 0; a < 3; ++a) {
        const auto second = [&, a](const Vec2& x) { return jet(s, x).r2[a]; };
        EXPECT_TRUE(is_derivative(second, j.r3[i + a], xi, along)) << a << i;
      }
    }
  });
}

TEST(SurfaceCatalogue, AWrongDerivativeIsNoticed) {
  const Surface s = testing::nurbs_hills({3, 2}, {6, 4});
  const Vec2 xi(1.4, 0.7);
  const auto r = [&](const Vec2& x) { return jet(s, x).r; };
  EXPECT_TRUE(is_derivative(r, jet(s, xi).r1[0], xi, 0));
  EXPECT_FALSE(is_derivative(r, 1.001 * jet(s, xi).r1[0], xi, 0));
}

TEST(SurfaceCatalogue, ClosedSurfacesJoinWithTheirNormals) {
  for (const testing::NamedSurface& sample : sample_surfaces()) {
    SCOPED_TRACE(sample.name);
    const std::array<Vec2, 2> range = testing::finite_range(sample.surface);
    for (Eigen::Index i = 0; i < 2; ++i) {
      Vec2 a = 0.4 * range[0] + 0.6 * range[1], b = a;
      a[i] = range[0][i];
      b[i] = range[1][i];
      const SurfaceJet ja = jet(sample.surface, a), jb = jet(sample.surface, b);
      EXPECT_EQ(closed(sample.surface)[static_cast<std::size_t>(i)], (ja.r - jb.r).norm() < 1e-13);
      if (!closed(sample.surface)[static_cast<std::size_t>(i)]) continue;
      EXPECT_LT((surface_frame(ja).normal - surface_frame(jb).normal).norm(), 1e-14);
    }
  }
}

TEST(SurfaceCatalogue, FramesAreValidAndNormalsAreUnit) {
  at_surface_places([](const Surface& s, const Vec2& xi) {
    const SurfaceFrame f = surface_frame(jet(s, xi));
    ASSERT_TRUE(f.valid);
    EXPECT_NEAR(f.normal.norm(), 1.0, 4e-16);
    EXPECT_NEAR(f.normal.dot(f.tangent[0]) / f.tangent[0].norm(), 0.0, 5e-16);
    EXPECT_NEAR(f.normal.dot(f.tangent[1]) / f.tangent[1].norm(), 0.0, 5e-16);
  });
}

TEST(Sphere, IsASphereEverywhereWithItsNormalOutOfTheBody) {
  for (const bool inside : {false, true}) {
    const Sphere s{Vec3(1, 2, 3), 2.5, inside, Vec3(0.3, -1, 0.2)};
    for (double u = -1; u <= 1; u += 0.25)
      for (double v = -1; v <= 1; v += 0.25)
        for (const double shift : {0.0, Sphere::chart_shift}) {
          const SurfaceJet j = s.jet({u + shift, v});
          const Vec3 radial = (j.r - s.center) / s.radius;
          EXPECT_NEAR(radial.norm(), 1.0, 6e-16);
          EXPECT_LT((surface_frame(j).normal - (inside ? -1.0 : 1.0) * radial).norm(), 1e-15);
        }
    // the middles of the two charts are opposite
    EXPECT_LT((s.jet({0, 0}).r + s.jet({Sphere::chart_shift, 0}).r - 2 * s.center).norm(), 1e-14);
  }
}

TEST(Revolution, NormalsPointOutOfTheBody) {
  const Vec3 c(0.4, -0.7, 0.2), axis(1, -2, 0.5);
  const Vec3 e = axis.normalized();
  for (const bool inside : {false, true}) {
    const double sign = inside ? -1 : 1;
    const Cylinder cylinder{.point = c, .axis = axis, .radius = 0.8, .inside = inside};
    const Cone cone{.apex = c, .axis = axis, .half_angle = 0.6, .inside = inside};
    const Torus torus{c, axis, 2.0, 0.7, inside};
    for (double u = 0.1; u < 6.2; u += 0.7)
      for (double v = 0.2; v < 6; v += 0.6) {
        SurfaceJet j = cylinder.jet({u, v});
        Vec3 out = (j.r - c) - e * e.dot(j.r - c);
        EXPECT_NEAR(out.norm(), 0.8, 2e-15);
        EXPECT_LT((surface_frame(j).normal - sign * out.normalized()).norm(), 5e-15);
        j = cone.jet({u, v});
        out = (j.r - c) - e * e.dot(j.r - c);
        EXPECT_NEAR(out.norm(), std::tan(0.6) * e.dot(j.r - c), 1e-14);
        out = std::cos(0.6) * out.normalized() - std::sin(0.6) * e;
        EXPECT_LT((surface_frame(j).normal - sign * out).norm(), 5e-15);
        j = torus.jet({u, v});
        out = (j.r - c) - e * e.dot(j.r - c);
        out = j.r - c - 2.0 * out.normalized();
        EXPECT_NEAR(out.norm(), 0.7, 2e-15);
        EXPECT_LT((surface_frame(j).normal - sign * out / 0.7).norm(), 5e-15);
      }
  }
}

TEST(Plane, NormalIsTheGivenOne) {
  const Plane p{Vec3(1, 2, 3), Vec3(0, 3, -4)};
  const SurfaceFrame f = surface_frame(p.jet({1e3, -7}));
  EXPECT_LT((f.normal - Vec3(0, 0.6, -0.8)).norm(), 1e-15);
  EXPECT_LT((f.a - Mat<2, 2>::Identity()).norm(), 5e-16);
  EXPECT_EQ(f.h.norm(), 0.0);
}

TEST(NurbsPatch, IsAnExactCylinder) {
  const NurbsPatch patch = testing::nurbs_cylinder(1.5, 2);
  EXPECT_EQ(patch.closed(), (ClosedFlags{true, false}));
  for (double u = 0.05; u < 4; u += 0.17)
    for (const double v : {0.0, 0.3, 1.0}) {
      const SurfaceJet j = patch.jet({u, v});
      EXPECT_NEAR(std::hypot(j.r.x(), j.r.y()), 1.5, 1e-15);
      const SurfaceFrame f = surface_frame(j);
      EXPECT_NEAR(mean_curvature(f), -0.5 / 1.5, 1e-14);
      EXPECT_NEAR(gaussian_curvature(f), 0.0, 1e-14);
      EXPECT_LT((f.normal - Vec3(j.r.x(), j.r.y(), 0) / 1.5).norm(), 1e-14);
    }
}

TEST(NurbsPatch, IsAlongABorderTheCurveOfTheBorder) {
  const NurbsPatch patch = testing::nurbs_hills({3, 2}, {6, 4});
  NurbsCurve border;
  border.degree = 3;
  border.knots = patch.knots[0];
  for (Index i = 0; i < 6; ++i) {
    border.control.push_back(patch.control[patch.index(i, 0)].head<2>());
    border.weights.push_back(patch.weights[patch.index(i, 0)]);
  }
  for (const double u : {0.0, 0.4, 1.3, 2.2, 3.0}) {
    const SurfaceJet a = patch.jet({u, 0});
    const CurveJet<2> b = border.jet(u);
    EXPECT_LT((a.r.head<2>() - b.r).norm(), 1e-14);
    EXPECT_LT((a.r1[0].head<2>() - b.r1).norm(), 1e-13);
    EXPECT_LT((a.r2[0].head<2>() - b.r2).norm(), 1e-12);
    EXPECT_LT((a.r3[0].head<2>() - b.r3).norm(), 1e-11);
  }
}

TEST(NurbsPatch, ReversedIsTheSameSurfaceFromTheOtherSide) {
  const NurbsPatch patch = testing::nurbs_hills({3, 2}, {6, 4}), other = reversed(patch);
  EXPECT_EQ(validate(other), "");
  const SurfaceJet a = patch.jet({1.4, 0.7}), b = other.jet({0.7, 1.4});
  EXPECT_LT((a.r - b.r).norm(), 1e-15);
  EXPECT_LT((surface_frame(a).normal + surface_frame(b).normal).norm(), 1e-14);
  EXPECT_EQ(reversed(other).control, patch.control);
}

TEST(SurfaceCatalogue, ValidationNamesTheField) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto names = [](const Surface& s, std::string_view field) {
    return validate(s).find(field) == 0;
  };
  EXPECT_TRUE(names(Plane{Vec3(0, nan, 0), Vec3(0, 0, 1)}, "point"));
  EXPECT_TRUE(names(Plane{Vec3(0, 0, 0), Vec3(0, 0, 0)}, "normal"));
  EXPECT_TRUE(names(Sphere{.radius = 0}, "radius"));
  EXPECT_TRUE(names(Sphere{.radius = nan}, "radius"));
  EXPECT_TRUE(names(Cylinder{.axis = Vec3(0, 0, 0)}, "axis"));
  EXPECT_TRUE(names(Cylinder{.length = -1}, "length"));
  EXPECT_TRUE(names(Cone{.half_angle = 1.6}, "half_angle"));
  EXPECT_TRUE(names(Cone{.from = 2, .to = 1}, "from, to"));
  EXPECT_TRUE(names(Torus{.radius = 1, .tube_radius = 1}, "tube_radius"));
  LagrangeSurface line = lagrange_surface(
      cell::CellType::tri3, std::array<Vec3, 3>{Vec3(0, 0, 0), Vec3(1, 1, 1), Vec3(2, 2, 2)});
  EXPECT_TRUE(names(line, "nodes"));
  line.type = cell::CellType::hex8;
  EXPECT_TRUE(names(line, "type"));
  NurbsPatch patch = testing::nurbs_hills({3, 2}, {6, 4});
  patch.weights[3] = 0;
  EXPECT_TRUE(names(patch, "weights"));
  patch.control.pop_back();
  EXPECT_TRUE(names(patch, "control"));
  patch.knots[1].pop_back();
  EXPECT_TRUE(names(patch, "direction 2: knots"));
  EXPECT_TRUE(names(NurbsPatch{}, "direction 1: control"));
}

}  // namespace
}  // namespace osculate::geometry
