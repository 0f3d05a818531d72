#include "osculate/mesh/quality.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "osculate/mesh/generate_space.hpp"

namespace osculate::mesh {
namespace {

using cell::CellType;

Mesh one_cell(CellType type, std::vector<Vec3> nodes) {
  Mesh mesh;
  mesh.nodes = std::move(nodes);
  mesh.blocks.push_back({type, {}});
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    mesh.blocks[0].connectivity.push_back(static_cast<Index>(n));
  return mesh;
}

Quality of(const Mesh& mesh) {
  std::vector<CellRef> cells;
  for (Index c = 0; c < mesh.blocks[0].size(); ++c) cells.push_back({0, c});
  return quality(mesh, cells);
}

TEST(Quality, RegularCellsOfEveryKindHaveTheShapeOne) {
  const double h = std::sqrt(0.75);
  EXPECT_NEAR(of(one_cell(CellType::tri3, {{0, 0, 0}, {1, 0, 0}, {0.5, h, 0}})).worst_shape, 1,
              1e-14);
  EXPECT_NEAR(
      of(one_cell(CellType::tet4, {{1, 1, 1}, {-1, 1, -1}, {1, -1, -1}, {-1, -1, 1}})).worst_shape,
      1, 1e-14);
  EXPECT_NEAR(of(one_cell(CellType::wedge6,
                          {{0, 0, 0}, {1, 0, 0}, {0.5, h, 0}, {0, 0, 1}, {1, 0, 1}, {0.5, h, 1}}))
                  .worst_shape,
              1, 1e-14);
  for (const CellType type :
       {CellType::hex8, CellType::hex20, CellType::hex27, CellType::shell18}) {
    Mesh mesh;
    SolidBoxSpec box;
    box.name = "b";
    box.breaks = {std::vector<double>{0, 1}, {0, 1}, {0, 0.5}};
    box.elements = {std::vector<int>{1}, {1}, {1}};
    box.type = type;
    append_solid_box(mesh, box);
    std::size_t at = 0;
    while (mesh.blocks[at].type != type) ++at;
    const Quality q = quality(mesh, std::vector<CellRef>{{static_cast<Index>(at), 0}});
    EXPECT_NEAR(q.worst_shape, 1, 1e-14) << cell::info(type).name;
    EXPECT_NEAR(q.largest_ratio, 2, 1e-14) << cell::info(type).name;
  }
}

/// A rhombus with an angle of 10 degrees, beside a square.
TEST(Quality, TheWorstCellIsNamedAndPoorOnesAreCounted) {
  const double a = std::acos(-1.0) / 18;
  Mesh mesh = one_cell(CellType::quad4, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  mesh.nodes.insert(
      mesh.nodes.end(),
      {{2, 0, 0}, {3, 0, 0}, {3 + std::cos(a), std::sin(a), 0}, {2 + std::cos(a), std::sin(a), 0}});
  for (Index n = 4; n < 8; ++n) mesh.blocks[0].connectivity.push_back(n);
  const Quality q = of(mesh);
  EXPECT_NEAR(q.worst_shape, std::sin(a), 1e-14);
  EXPECT_EQ(q.worst, (CellRef{0, 1}));
  EXPECT_EQ(q.poor, 1U);
}

TEST(Quality, ACellThatIsInsideOutHasANegativeShape) {
  EXPECT_LT(of(one_cell(CellType::quad4, {{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}})).worst_shape,
            0);
}

}  // namespace
}  // namespace osculate::mesh
