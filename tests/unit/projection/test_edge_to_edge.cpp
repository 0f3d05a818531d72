// Nearest places of two edges against brute force.
#include "osculate/projection/edge_to_edge.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <vector>

#include "osculate/cell/line_shape.hpp"

namespace osculate::projection {
namespace {

Vec3 place(const std::vector<Vec3>& nodes, double xi, std::size_t order = 0) {
  const cell::LineShape shape = cell::lagrange_line(static_cast<int>(nodes.size()), xi);
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < nodes.size(); ++k) sum += shape.n[order][k] * nodes[k];
  return sum;
}

std::vector<Vec3> random_edge(std::mt19937& generator, std::size_t count) {
  std::uniform_real_distribution<double> u(-1, 1);
  const Vec3 a(u(generator), u(generator), u(generator));
  const Vec3 along = Vec3(u(generator), u(generator), u(generator)).normalized();
  std::vector<Vec3> nodes{a, a + 2 * along};
  if (count == 3)
    nodes.push_back(a + along + 0.15 * Vec3(u(generator), u(generator), u(generator)));
  return nodes;
}

double grid_minimum(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double best = 1e9;
  constexpr int n = 200;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j)
      best = std::min(best, (place(a, 2.0 * i / n - 1) - place(b, 2.0 * j / n - 1)).norm());
  return best;
}

TEST(EdgeToEdge, IsTheNearestOfAllPlacesWhereItLiesInside) {
  std::mt19937 generator(5);
  for (const std::size_t first : {2u, 3u})
    for (const std::size_t second : {2u, 3u}) {
      int inside = 0;
      for (int i = 0; i < 150; ++i) {
        const std::vector<Vec3> a = random_edge(generator, first),
                                b = random_edge(generator, second);
        const EdgesFoot foot = closest_points(a, b);
        if (!foot.converged || foot.xi.cwiseAbs().maxCoeff() > 1) continue;
        ++inside;
        const Vec3 apart = place(b, foot.xi[1]) - place(a, foot.xi[0]);
        EXPECT_NEAR(foot.squared_distance, apart.squaredNorm(), 1e-13);
        EXPECT_LT(std::abs(apart.dot(place(a, foot.xi[0], 1))), 1e-9);
        EXPECT_LT(std::abs(apart.dot(place(b, foot.xi[1], 1))), 1e-9);
        if (first == 2 && second == 2) {
          EXPECT_LE(apart.norm(), grid_minimum(a, b) + 1e-12);
        } else {  // a minimum; the least one unless one at the ends is less
          for (const double da : {-1e-3, 1e-3})
            for (const double db : {-1e-3, 1e-3})
              EXPECT_LT(apart.norm(),
                        (place(b, foot.xi[1] + db) - place(a, foot.xi[0] + da)).norm());
        }
      }
      EXPECT_GT(inside, 10);
    }
}

TEST(EdgeToEdge, CrossingEdgesThatMeetHaveNoDistance) {
  const EdgesFoot foot = closest_points(std::vector<Vec3>{{-1, 0, 0}, {1, 0, 0}},
                                        std::vector<Vec3>{{0.5, -1, 0}, {0.5, 3, 0}});
  ASSERT_TRUE(foot.converged);
  EXPECT_LT((foot.xi - Vec2(0.5, -0.5)).norm(), 1e-15);
  EXPECT_NEAR(foot.squared_distance, 0, 1e-30);
}

TEST(EdgeToEdge, ParallelFarAndBrokenEdgesHaveNone) {
  const std::vector<Vec3> edge{{-1, 0, 0}, {1, 0, 0}};
  const auto turned = [](double degrees) {
    const double a = degrees * std::acos(-1.0) / 180;
    return std::vector<Vec3>{{-std::cos(a), -std::sin(a), 0.1}, {std::cos(a), std::sin(a), 0.1}};
  };
  EXPECT_FALSE(closest_points(edge, turned(0)).converged);
  EXPECT_FALSE(closest_points(edge, turned(4.9)).converged);
  EXPECT_TRUE(closest_points(edge, turned(5.1)).converged);
  EXPECT_FALSE(closest_points(edge, std::vector<Vec3>{{2, -1, 0}, {2, 1, 0}}).converged);
  EXPECT_FALSE(closest_points(edge, std::vector<Vec3>{{0, -1, std::nan("")}, {0, 1, 0}}).converged);
  EXPECT_FALSE(closest_points(edge, std::vector<Vec3>{{0, 0, 0}, {0, 0, 0}}).converged);
}

}  // namespace
}  // namespace osculate::projection
