#include "osculate/mesh/node_areas.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace osculate::mesh {
namespace {

/// Two cubes in a row: every node has a quarter of the free squares round it, all together the
/// whole surface.
TEST(NodeAreas, AreSharesOfTheFreeFaces) {
  Mesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1},
                {1, 1, 1}, {0, 1, 1}, {0, 0, 2}, {1, 0, 2}, {1, 1, 2}, {0, 1, 2}};
  mesh.blocks.push_back({cell::CellType::hex8, {0, 1, 2, 3, 4, 5, 6, 7, 4, 5, 6, 7, 8, 9, 10, 11}});
  const std::vector<double> areas = free_areas(mesh, face_table(mesh));
  EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.0), 10, 1e-14);
  EXPECT_NEAR(areas[0], 0.75, 1e-15);
  EXPECT_NEAR(areas[4], 1, 1e-15);  // four squares beside it, none between the cubes
}

TEST(NodeAreas, PolygonsInSpace) {
  Mesh mesh;
  mesh.nodes = {{0, 0, 0}, {2, 0, 0}, {2, 1, 1}, {0, 1, 1}};
  const std::vector<Index> quad{0, 1, 2, 3}, triangle{0, 1, 2};
  EXPECT_NEAR(polygon_area(mesh, quad), 2 * std::sqrt(2.0), 1e-15);
  EXPECT_NEAR(polygon_area(mesh, triangle), std::sqrt(2.0), 1e-15);
}

}  // namespace
}  // namespace osculate::mesh
