// Domains of edges and corners: the seven regions of a cube's corner against brute force.
#include "osculate/projection/feature_domain.hpp"

#include <gtest/gtest.h>

#include <random>

namespace osculate::projection {
namespace {

/// The cube x > 0, y < 0, z < 0 at its corner O (KSCPP, Fig. 8): edges OA = -y, OB = +x, OC = -z.
struct CubeCorner {
  Vec3 a{0, -1, 0}, b{1, 0, 0}, c{0, 0, -1};
  /// Which of the regions hold the point: three sides, three edges, the corner.
  [[nodiscard]] std::array<bool, 7> regions(const Vec3& p) const {
    const auto side = [&](const Vec3& n, const Vec3& s, const Vec3& t) {
      return p.dot(n) > 0 && p.dot(s) > 0 && p.dot(t) > 0;
    };
    const auto edge = [&](const Vec3& tau, const Vec3& s, const Vec3& t) {
      const EdgeFaces e{tau, {-t, -s}, {s, t}};
      return p.dot(tau) > 0 && in_edge_wedge(e, Vec3(p - p.dot(tau) * tau));
    };
    const std::array<Vec3, 3> all{a, b, c};
    return {side(-a, b, c), side(-c, a, b), side(-b, a, c),           edge(a, b, c),
            edge(b, a, c),  edge(c, a, b),  in_normal_cone<3>(all, p)};
  }
};

TEST(FeatureDomain, SevenRegionsOfACubeCorner) {  // Fig. 8
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1, 1);
  const CubeCorner cube;
  std::array<int, 7> hits{};
  for (int i = 0; i < 4000; ++i) {
    const Vec3 p(number(random), number(random), number(random));
    const std::array<bool, 7> in = cube.regions(p);
    const bool inside = p.x() > 0 && p.y() < 0 && p.z() < 0;
    const auto count = std::count(in.begin(), in.end(), true);
    EXPECT_EQ(count, inside ? 0 : 1);
    if (inside) continue;
    const Vec3 q(std::max(p.x(), 0.0), std::min(p.y(), 0.0), std::min(p.z(), 0.0));  // nearest
    const int zeros = (q.x() == 0) + (q.y() == 0) + (q.z() == 0);
    const auto region =
        static_cast<std::size_t>(std::find(in.begin(), in.end(), true) - in.begin());
    EXPECT_EQ(zeros, region < 3 ? 1 : region < 6 ? 2 : 3);
    ++hits[region];
    const std::array<bool, 7> printed{
        p.x() > 0 && p.y() > 0 && p.z() < 0, p.x() > 0 && p.y() < 0 && p.z() > 0,
        p.x() < 0 && p.y() < 0 && p.z() < 0, p.x() < 0 && p.y() < 0 && p.z() > 0,
        p.x() > 0 && p.y() > 0 && p.z() > 0, p.x() < 0 && p.y() > 0 && p.z() < 0,
        p.x() < 0 && p.y() > 0 && p.z() > 0};
    EXPECT_EQ(in, printed);
  }
  for (const int h : hits) EXPECT_GT(h, 400);
}

TEST(FeatureDomain, ConvexAndReentrantEdges) {
  const EdgeFaces ridge{
      {0, 1, 0}, {Vec3(0, 0, 1), Vec3(1, 0, 0)}, {Vec3(-1, 0, 0), Vec3(0, 0, -1)}};
  EXPECT_NEAR(edge_angle(ridge), std::numbers::pi / 2, 1e-15);
  EXPECT_TRUE(in_edge_wedge(ridge, Vec3(1, 0, 1)));
  EXPECT_FALSE(in_edge_wedge(ridge, Vec3(-0.1, 0, 1)));
  EXPECT_FALSE(in_edge_wedge(ridge, Vec3(1, 0.1, 1)));
  const EdgeFaces valley{{0, 1, 0}, {Vec3(0, 0, 1), Vec3(1, 0, 0)}, {Vec3(1, 0, 0), Vec3(0, 0, 1)}};
  EXPECT_NEAR(edge_angle(valley), -std::numbers::pi / 2, 1e-15);
  EXPECT_FALSE(in_edge_wedge(valley, Vec3(1, 0, 1)));
  EXPECT_TRUE(in_edge_wedge(valley, Vec3(-1, 0, -1)));  // below, between the reversed normals
  const EdgeFaces flat{{0, 1, 0}, {Vec3(0, 0, 1), Vec3(0, 0, 1)}, {Vec3(-1, 0, 0), Vec3(1, 0, 0)}};
  EXPECT_EQ(edge_angle(flat), 0);
}

TEST(FeatureDomain, CornersOfACurve) {  // Fig. 7, body on the right
  EXPECT_NEAR(corner_angle({1, 0}, {0, -1}), std::numbers::pi / 2, 1e-15);  // a right turn: convex
  EXPECT_NEAR(corner_angle({1, 0}, {0, 1}), -std::numbers::pi / 2, 1e-15);
  const std::array<Vec2, 2> roof{Vec2(-1, 0), Vec2(0, -1)};
  EXPECT_TRUE(in_normal_cone<2>(roof, Vec2(1, 1)));
  EXPECT_TRUE(in_normal_cone<2>(roof, Vec2(0, 1)));
  EXPECT_FALSE(in_normal_cone<2>(roof, Vec2(-0.1, 1)));
}

TEST(FeatureDomain, RaysOfACorner) {
  const std::array<Vec3, 3> cube{Vec3(0, -1, 0), Vec3(1, 0, 0), Vec3(0, 0, -1)};
  const std::vector<Vec3> rays = corner_rays(cube);
  ASSERT_EQ(rays.size(), 3u);
  for (const Vec3& n : {Vec3(0, 1, 0), Vec3(-1, 0, 0), Vec3(0, 0, 1)})
    EXPECT_TRUE(std::any_of(rays.begin(), rays.end(),
                            [&](const Vec3& r) { return (r - n).norm() < 1e-14; }));
  const std::array<Vec3, 4> saddle{Vec3(1, 0, 0.5), Vec3(0, 1, -0.5), Vec3(-1, 0, 0.5),
                                   Vec3(0, -1, -0.5)};
  EXPECT_TRUE(corner_rays(saddle).empty());
}

TEST(FeatureDomain, RaysOfACornerOfTheBorder) {
  const std::array<Vec3, 2> plate{Vec3(1, 0, 0), Vec3(1, 1, 0).normalized()};
  const std::vector<Vec3> rays = corner_rays(plate);
  ASSERT_EQ(rays.size(), 4u);
  for (const Vec3& n :
       {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(0, -1, 0), Vec3(Vec3(-1, 1, 0).normalized())})
    EXPECT_TRUE(std::any_of(rays.begin(), rays.end(),
                            [&](const Vec3& r) { return (r - n).norm() < 1e-14; }));
  const std::array<Vec3, 4> inside{Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(-1, 0, 0), Vec3(0, -1, 0)};
  EXPECT_EQ(corner_rays(inside).size(), 2u);  // nothing but the normal and its opposite
}

TEST(FeatureDomain, TurnedVectors) {
  EXPECT_LT((turned<2>(Vec2(1, 0), Vec2(0, 1), 0.5) - Vec2(1, 1).normalized()).norm(), 1e-15);
  EXPECT_LT((turned<3>(Vec3(1, 0, 0), Vec3(0, 0, 1), 1) - Vec3(0, 0, 1)).norm(), 1e-15);
  EXPECT_EQ(turned<2>(Vec2(1, 0), Vec2(1, 0), 0.3), Vec2(1, 0));
}

}  // namespace
}  // namespace osculate::projection
