// Natural frame of curves in space.
#include "osculate/geometry/space_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace osculate::geometry {
namespace {

/// Helix with radius a and pitch 2 pi b, in the parameter t = xi + xi^2/4.
CurveJet<3> helix(double xi, double a = 2, double b = 0.5) {
  const double t = xi + 0.25 * xi * xi, d1 = 1 + 0.5 * xi, d2 = 0.5;
  const Vec3 first(-a * std::sin(t), a * std::cos(t), b);
  const Vec3 second(-a * std::cos(t), -a * std::sin(t), 0);
  CurveJet<3> j;
  j.r = Vec3(a * std::cos(t), a * std::sin(t), b * t);
  j.r1 = d1 * first;
  j.r2 = d1 * d1 * second + d2 * first;
  return j;
}

TEST(SpaceCurve, HelixHasItsCurvature) {  // [eq:KSCPP:30] [eq:KSCPP:35]
  for (const double xi : {-0.7, 0.0, 1.3}) {
    const CurveJet<3> j = helix(xi);
    const SpaceCurveFrame f = space_curve_frame(j);
    ASSERT_TRUE(f.valid);
    EXPECT_NEAR(f.k, 2 / (4 + 0.25), 1e-14);
    EXPECT_NEAR(f.speed, (1 + 0.5 * xi) * std::sqrt(4.25), 1e-14);
    EXPECT_NEAR(f.nu.dot(Vec3(j.r.x(), j.r.y(), 0)) / 2, -1, 1e-14);  // towards the axis
    EXPECT_NEAR(f.tau.cross(f.nu).dot(f.beta), 1, 1e-14);
  }
}

TEST(SpaceCurve, PolarCoordinatesLieAcross) {  // [eq:KSCPP:38] [eq:KSCPP:39]
  const CurveJet<3> j = helix(0.4);
  const SpaceCurveFrame f = space_curve_frame(j);
  for (const double phi : {0.0, 0.8, 2.5, 4.0}) {
    const Vec3 arm = point_around(j, f, 1.7, phi) - j.r;
    EXPECT_NEAR(arm.norm(), 1.7, 1e-14);
    EXPECT_NEAR(arm.dot(f.tau), 0, 1e-14);
    EXPECT_NEAR(arm.dot(f.nu), 1.7 * std::cos(phi), 1e-14);
    EXPECT_NEAR(arm.dot(f.beta), 1.7 * std::sin(phi), 1e-14);
  }
}

TEST(SpaceCurve, StraightAndDegenerateOnes) {
  CurveJet<3> j;
  EXPECT_FALSE(space_curve_frame(j).valid);
  j.r1 = Vec3(1, 2, 2);
  j.r2 = Vec3(0.3, 0.6, 0.6);  // straight, at uneven speed
  const SpaceCurveFrame f = space_curve_frame(j);
  EXPECT_TRUE(f.valid);
  EXPECT_EQ(f.k, 0);
  EXPECT_NEAR(f.nu.norm(), 1, 1e-14);
  EXPECT_NEAR(f.nu.dot(f.tau), 0, 1e-14);
}

}  // namespace
}  // namespace osculate::geometry
