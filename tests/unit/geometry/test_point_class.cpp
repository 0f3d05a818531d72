// Classes of surface points, planar points of higher order, distorted parameters.
#include "osculate/geometry/point_class.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sample_surfaces.hpp"

namespace osculate::geometry {
namespace {

using testing::at_surface_places;

/// The graph z = f(x, y) by its derivatives at the origin, moved, turned and scaled, in skew
/// coordinates.
SurfaceJet graph(double xx, double xy, double yy, const std::array<double, 4>& third,
                 double scale = 1) {
  SurfaceJet j;
  j.r1 = {Vec3(1, 0, 0), Vec3(0.3, 0.8, 0)};  // x = u + 0.3 v, y = 0.8 v
  const Mat<2, 2> to{{1, 0.3}, {0, 0.8}};
  const auto z2 = [&](const Vec2& a, const Vec2& b) {
    return xx * a[0] * b[0] + xy * (a[0] * b[1] + a[1] * b[0]) + yy * a[1] * b[1];
  };
  const auto z3 = [&](const Vec2& a, const Vec2& b, const Vec2& c) {
    double sum = 0;
    for (int i = 0; i < 2; ++i)
      for (int k = 0; k < 2; ++k)
        for (int l = 0; l < 2; ++l)
          sum += third[static_cast<std::size_t>(i + k + l)] * a[i] * b[k] * c[l];
    return sum;
  };
  const Vec2 u = to.col(0), v = to.col(1);
  j.r2 = {Vec3(0, 0, z2(u, u)), Vec3(0, 0, z2(u, v)), Vec3(0, 0, z2(v, v))};
  j.r3 = {Vec3(0, 0, z3(u, u, u)), Vec3(0, 0, z3(u, u, v)), Vec3(0, 0, z3(u, v, v)),
          Vec3(0, 0, z3(v, v, v))};
  const Mat<3, 3> turn =
      scale * Eigen::AngleAxisd(1.1, Vec3(0.3, -0.5, 0.8).normalized()).toRotationMatrix();
  for (Vec3& t : j.r1) t = turn * t;
  for (Vec3& t : j.r2) t = turn * t;
  for (Vec3& t : j.r3) t = turn * t;
  return j;
}

TEST(PointClass, PrincipalCurvaturesSolveTheEigenproblem) {
  // [eq:KSCPP:13] [eq:KSCPP:14] [eq:KSCPP:16]
  at_surface_places([](const Surface& s, const Vec2& xi) {
    const SurfaceFrame f = surface_frame(jet(s, xi));
    const PrincipalCurvatures p = principal_curvatures(f);
    const double mean = mean_curvature(f), gauss = gaussian_curvature(f);
    for (std::size_t i = 0; i < 2; ++i) {
      const double k = p.value[i];
      const Mat<2, 2> m = f.h - k * f.a;
      EXPECT_NEAR(m.determinant(), 0, 1e-12 * (1 + m.squaredNorm()));
      const Vec2 e(p.direction[i].dot(contravariant_basis(f)[0]),
                   p.direction[i].dot(contravariant_basis(f)[1]));
      EXPECT_NEAR((m * e).norm(), 0, 1e-12 * (1 + m.norm()) * e.norm());
      EXPECT_NEAR(k * k - 2 * mean * k + gauss, 0, 1e-12 * (1 + k * k));
    }
    EXPECT_GE(p.value[0], p.value[1]);
    EXPECT_NEAR(p.direction[0].dot(p.direction[1]), 0, 1e-14);
    EXPECT_NEAR(p.direction[0].cross(p.direction[1]).dot(f.normal), 1, 1e-13);
  });
}

TEST(PointClass, GaussianAndMeanCurvatureOfAGraph) {
  // [eq:KSCPP:17] [eq:KSCPP:18] z = (xx x^2 + 2 xy x y + yy y^2)/2: K = xx yy - xy^2, H = tr/2
  const SurfaceFrame f = surface_frame(graph(2, -0.7, 0.5, {0, 0, 0, 0}));
  EXPECT_NEAR(gaussian_curvature(f), 2 * 0.5 - 0.49, 1e-14);
  EXPECT_NEAR(mean_curvature(f), 1.25, 1e-14);
}

TEST(PointClass, SignsDecideAtAnySize) {  // [eq:KSCPP:15]
  const auto of = [](double xx, double yy, double size) {
    const SurfaceFrame f = surface_frame(graph(xx / size, 0, yy / size, {0, 0, 0, 0}));
    return point_class(principal_curvatures(f).value, size);
  };
  for (const double size : {1e-12, 1.0, 1e12}) {
    EXPECT_EQ(of(2, 1, size), PointClass::elliptic);
    EXPECT_EQ(of(-2, -1e-6, size), PointClass::elliptic);
    EXPECT_EQ(of(2, -1e-6, size), PointClass::hyperbolic);
    EXPECT_EQ(of(0, -1, size), PointClass::parabolic);
    EXPECT_EQ(of(3, 1e-12, size), PointClass::parabolic);
    EXPECT_EQ(of(0, 0, size), PointClass::planar);
    EXPECT_EQ(of(1e-11, -1e-11, size), PointClass::planar);
  }
  EXPECT_EQ(point_class({NAN, 0}, 1), PointClass::singular);
}

TEST(PointClass, SampleSurfaces) {
  const auto of = [](const Surface& s, const Vec2& xi, double size) {
    return point_class(principal_curvatures(surface_frame(jet(s, xi))).value, size);
  };
  EXPECT_EQ(of(Plane{}, {3, -2}, 1), PointClass::planar);
  EXPECT_EQ(of(Sphere{}, {0.3, 0.1}, 2), PointClass::elliptic);
  EXPECT_EQ(of(Cylinder{}, {0.3, 0.1}, 2), PointClass::parabolic);
  EXPECT_EQ(of(Cone{}, {0.3, 0.7}, 2), PointClass::parabolic);
  EXPECT_EQ(of(Torus{}, {0.3, 0.0}, 3), PointClass::elliptic);
  EXPECT_EQ(of(Torus{}, {0.3, std::numbers::pi}, 3), PointClass::hyperbolic);
  EXPECT_EQ(of(Torus{}, {0.3, 0.5 * std::numbers::pi}, 3), PointClass::parabolic);
}

TEST(FlatPoint, MonkeySaddleHasThreeLines) {  // z = x^3 - 3 x y^2
  for (const double size : {1e-12, 1.0, 1e12}) {
    const double c = 6 / size / size;
    const SurfaceJet j = graph(0, 0, 0, {c, 0, -c, 0});
    const SurfaceFrame f = surface_frame(j);
    EXPECT_EQ(point_class(principal_curvatures(f).value, size), PointClass::planar);
    const FlatPoint p = flat_point(j, f, size);
    EXPECT_EQ(p.form, CubicForm::three_lines);
    EXPECT_EQ(p.contact_order, 2);
  }
}

TEST(FlatPoint, HeightIsTheCubicForm) {
  const SurfaceJet j = graph(0, 0, 0, {6, 1.2, -2.4, 0.9});
  const SurfaceFrame f = surface_frame(j);
  const FlatPoint p = flat_point(j, f, 1);
  const auto& c = p.cubic;
  const Vec2 u(0.4, -0.3);  // parameters: r = u r_1 + v r_2, z of third order
  const Vec3 across = u[0] * j.r1[0] + u[1] * j.r1[1];
  const double x = across.dot(p.basis[0]), y = across.dot(p.basis[1]);
  const double height =
      c[0] * x * x * x + 3 * c[1] * x * x * y + 3 * c[2] * x * y * y + c[3] * y * y * y;
  const Vec3 third = u[0] * u[0] * u[0] * j.r3[0] + 3 * u[0] * u[0] * u[1] * j.r3[1] +
                     3 * u[0] * u[1] * u[1] * j.r3[2] + u[1] * u[1] * u[1] * j.r3[3];
  EXPECT_NEAR(height, third.dot(f.normal), 1e-13);
}

TEST(FlatPoint, OtherForms) {
  const auto of = [](const std::array<double, 4>& third, double scale) {
    const SurfaceJet j = graph(0, 0, 0, third, scale);
    return flat_point(j, surface_frame(j), scale);
  };
  for (const double scale : {1e-12, 1.0, 1e12}) {
    EXPECT_EQ(of({1, 0, 0, 1}, scale).form, CubicForm::one_line);     // x^3 + y^3
    EXPECT_EQ(of({0, 1, 0, 0}, scale).form, CubicForm::two_lines);    // x^2 y
    EXPECT_EQ(of({1, 2, 4, 8}, scale).form, CubicForm::triple_line);  // (x + 2 y)^3
    EXPECT_EQ(of({0, 0, 0, 0}, scale).form, CubicForm::zero);
    EXPECT_EQ(of({0, 0, 0, 0}, scale).contact_order, 3);
  }
}

TEST(CoordinateSine, WarnsOfFoldedCoordinates) {  // [eq:KSCPP:26]
  SurfaceJet j;
  j.r1 = {Vec3(2, 0, 0), Vec3(3, 1e-3, 0)};
  EXPECT_NEAR(coordinate_sine(surface_frame(j)), 1e-3 / std::hypot(3, 1e-3), 1e-15);
  j.r1[1] = Vec3(0, 0, 5);
  EXPECT_NEAR(coordinate_sine(surface_frame(j)), 1, 1e-15);
  j.r1[1] = Vec3(3, 0, 0);
  EXPECT_EQ(coordinate_sine(surface_frame(j)), 0);
  EXPECT_EQ(flat_point(j, surface_frame(j), 1).form, CubicForm::zero);
}

}  // namespace
}  // namespace osculate::geometry
