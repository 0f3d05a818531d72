// The thickness of shells is found whatever way their cells are numbered.
#include "osculate/mesh/shell_direction.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "osculate/cell/volume_shape.hpp"

namespace osculate::mesh {
namespace {

/// Cells of a plate (count_x x count_y x layers, thickness 0.1 a layer), each numbered with
/// another of the three right-handed cyclic numberings if `mixed`.
struct Plate {
  Mesh mesh;
  std::vector<CellRef> cells;
};

Plate plate(int count_x, int count_y, int layers, bool mixed, double dx = 1) {
  Plate p;
  const auto node = [&](int i, int j, int k) {
    return static_cast<Index>((k * (count_y + 1) + j) * (count_x + 1) + i);
  };
  for (int k = 0; k <= layers; ++k)
    for (int j = 0; j <= count_y; ++j)
      for (int i = 0; i <= count_x; ++i) p.mesh.nodes.emplace_back(dx * i, j, 0.1 * k);
  Block block{cell::CellType::hex8, {}};
  int number = 0;
  for (int k = 0; k < layers; ++k)
    for (int j = 0; j < count_y; ++j)
      for (int i = 0; i < count_x; ++i, ++number)
        for (int n = 0; n < 8; ++n) {
          const Vec3 c = 0.5 * (cell::volume_node(block.type, n) + Vec3::Ones());
          const int turn = mixed ? number % 3 : 0;
          std::array<int, 3> at{};
          for (int d = 0; d < 3; ++d)
            at[static_cast<std::size_t>((d + turn) % 3)] = static_cast<int>(c[d]);
          block.connectivity.push_back(node(i + at[0], j + at[1], k + at[2]));
        }
  for (Index c = 0; c < number; ++c) p.cells.push_back({0, c});
  p.mesh.blocks.push_back(std::move(block));
  return p;
}

/// All nodes of the lower face of every cell below those of its upper one.
void expect_upright(const Plate& p) {
  for (const CellRef& ref : p.cells) {
    const auto nodes = p.mesh.blocks[0].cell(ref.cell);
    for (int n = 0; n < 4; ++n) {
      const Vec3 up = p.mesh.nodes[static_cast<std::size_t>(nodes[n + 4])] -
                      p.mesh.nodes[static_cast<std::size_t>(nodes[n])];
      EXPECT_NEAR(std::abs(up.z()), 0.1, 1e-15) << ref.cell;
      EXPECT_LT(up.head<2>().norm(), 1e-15) << ref.cell;
    }
    EXPECT_EQ(handedness(p.mesh, ref), 1) << ref.cell;
  }
}

TEST(ShellDirection, IsFoundInAPlate) {
  Plate p = plate(3, 4, 1, true);
  std::vector<Index> before = p.mesh.blocks[0].connectivity;
  EXPECT_EQ(align_shells(p.mesh, p.cells), 8);
  expect_upright(p);
  std::vector<Index> after = p.mesh.blocks[0].connectivity;
  for (std::size_t c = 0; c < before.size(); c += 8) {  // the same nodes in every cell
    std::sort(before.begin() + static_cast<long>(c), before.begin() + static_cast<long>(c) + 8);
    std::sort(after.begin() + static_cast<long>(c), after.begin() + static_cast<long>(c) + 8);
  }
  EXPECT_EQ(before, after);
  EXPECT_EQ(align_shells(p.mesh, p.cells), 0);
}

/// Elements shorter than the shell is thick do not mislead it.
TEST(ShellDirection, IsNotTheShortestOne) {
  Plate p = plate(6, 3, 1, true, 0.02);
  EXPECT_EQ(align_shells(p.mesh, p.cells), 12);
  expect_upright(p);
}

TEST(ShellDirection, OfAStripIsTheThinOne) {
  Plate p = plate(5, 1, 1, true);
  (void)align_shells(p.mesh, p.cells);
  expect_upright(p);
  Plate single = plate(1, 1, 1, true);
  (void)align_shells(single.mesh, single.cells);
  expect_upright(single);
}

TEST(ShellDirection, OfLayersIsTheOneOfTheNumbering) {
  Plate p = plate(4, 4, 3, false);
  EXPECT_EQ(align_shells(p.mesh, p.cells), 0);
  expect_upright(p);
}

}  // namespace
}  // namespace osculate::mesh
