// Where a foot point stops being a strict minimum of the distance.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "osculate/contact/kinematics.hpp"

namespace osculate::contact {
namespace {

/// y = c x^2 / 2 at its vertex: curvature c, normal +y.
Kinematics<2> on_parabola(double c, double gap) {
  geometry::CurveJet<2> jet;
  jet.r1 = {2, 0};  // any parameter
  jet.r2 = {0.7, 4 * c};
  return face_kinematics(jet, {0, gap});
}

// [eq:KSCPP:20] in the plane: 1 - k gap.
TEST(ProjectionDomain, OfACurveEndsAtItsCentreOfCurvature) {
  for (const double c : {0.5, -0.5}) {
    for (const double gap : {-3.0, -1.0, 0.0, 1.0, 3.0}) {
      const Kinematics<2> k = on_parabola(c, gap);
      EXPECT_NEAR(domain_margin(k), 1 - c * gap, 1e-14);
      EXPECT_EQ(inside_domain(k), 1 - c * gap > 0);
    }
    EXPECT_FALSE(inside_domain(on_parabola(c, 1 / c)));
  }
}

/// z = (c1 u^2 + c2 v^2) / 2 at its vertex, in oblique coordinates.
Kinematics<3> on_paraboloid(double c1, double c2, double gap) {
  const Vec2 a(1.5, 0.2), b(-0.4, 0.8);  // (u, v) = a xi + b eta
  const auto bend = [&](const Vec2& p, const Vec2& q) {
    return Vec3(0, 0, c1 * p.x() * q.x() + c2 * p.y() * q.y());
  };
  geometry::SurfaceJet jet;
  jet.r1 = {Vec3(a.x(), a.y(), 0), Vec3(b.x(), b.y(), 0)};
  jet.r2 = {bend(a, a), bend(a, b), bend(b, b)};
  return face_kinematics(jet, {0, 0, gap});
}

// [eq:KSCPP:20] elliptic, hyperbolic and parabolic points: the nearer centre on the point's side.
TEST(ProjectionDomain, OfASurfaceEndsAtTheNearerCentreOfCurvature) {
  struct Shape {
    double c1, c2;
  };
  for (const Shape& s : {Shape{0.5, 0.25}, Shape{0.5, -0.25}, Shape{-0.5, -0.25}, Shape{0, 0.25},
                         Shape{0.5, 0.5}, Shape{0, 0}})
    for (const double gap : {-5.0, -3.0, -1.0, 0.0, 1.0, 3.0, 5.0}) {
      const double margin = std::min(1 - s.c1 * gap, 1 - s.c2 * gap);
      const Kinematics<3> k = on_paraboloid(s.c1, s.c2, gap);
      EXPECT_NEAR(domain_margin(k), margin, 1e-13);
      EXPECT_EQ(inside_domain(k), margin > 0);
    }
}

// [eq:KSCPP:41] [eq:KSCPP:42] an edge of radius R: outside where r cos(phi) >= R, phi from the
// principal normal; without end on the other side.
TEST(ProjectionDomain, OfAnEdgeDependsOnTheSideOfTheCurve) {
  const double radius = 2;
  geometry::CurveJet<3> jet;  // a circle about (0, R, 0), principal normal +y
  jet.r1 = {3, 0, 0};
  jet.r2 = {0, 9 / radius, 0};
  for (const double phi : {0.0, 0.5, 1.2, 2.0, 3.1})
    for (const double r : {0.5, 1.9, 2.1, 6.0})
      for (const double side : {1.0, -1.0}) {
        const Vec3 out(0, std::cos(phi), std::sin(phi));
        const Kinematics<3> k = edge_kinematics(jet, r * out, side * out);
        ASSERT_NEAR(k.gap, side * r, 1e-14);
        EXPECT_NEAR(domain_margin(k), 1 - r * std::cos(phi) / radius, 1e-13);
        EXPECT_EQ(inside_domain(k), r * std::cos(phi) < radius);
      }
}

TEST(ProjectionDomain, CornersReachEverywhere) {
  EXPECT_EQ(domain_margin(corner_kinematics<3>({0, 0, 0}, {0, 0, -9}, {0, 0, 1})), 1.0);
  EXPECT_TRUE(inside_domain(corner_kinematics<2>({0, 0}, {0, -9}, {0, 1})));
}

}  // namespace
}  // namespace osculate::contact
