#include "osculate/mesh/set_algebra.hpp"

#include <gtest/gtest.h>

#include <array>

#include "osculate/mesh/generate_space.hpp"

namespace osculate::mesh {
namespace {

Mesh box() {
  SolidBoxSpec spec;
  spec.name = "b";
  spec.breaks = {std::vector<double>{0, 1}, {0, 1}, {0, 1}};
  spec.elements = {std::vector<int>{2}, {2}, {2}};
  Mesh mesh;
  append_solid_box(mesh, spec);
  return mesh;
}

TEST(SetAlgebra, FacesThatAreInTheFileTwiceCountOnce) {
  Mesh mesh = box();
  const Set top = *mesh.find_set("b.top");
  Set copy{"copy", 2, {}, top.nodes};
  Index block = top.cells[0].block;
  for (const CellRef ref : top.cells) {
    Block& faces = mesh.blocks[static_cast<std::size_t>(block)];
    const std::vector<Index> nodes(faces.cell(ref.cell), faces.cell(ref.cell) + 4);
    copy.cells.push_back({block, faces.size()});
    for (const std::size_t k : {1u, 2u, 3u, 0u}) faces.connectivity.push_back(nodes[k]);
  }
  EXPECT_EQ(unite(mesh, "u", std::array<const Set*, 2>{&top, &copy}).cells.size(), 4u);
  EXPECT_EQ(common(mesh, "c", top, copy).cells.size(), 4u);
  EXPECT_TRUE(without(mesh, "w", top, copy).cells.empty());
}

TEST(SetAlgebra, TwoFacesShareTheNodesOfAnEdge) {
  const Mesh mesh = box();
  const Set edge = common(mesh, "e", *mesh.find_set("b.top"), *mesh.find_set("b.left"));
  EXPECT_EQ(edge.dimension, 0);
  EXPECT_EQ(edge.nodes, mesh.find_set("b.top_left")->nodes);
  const Set inner = without(mesh, "i", *mesh.find_set("b.top"), *mesh.find_set("b.top_left"));
  EXPECT_EQ(inner.dimension, 0);
  EXPECT_EQ(inner.nodes.size(), 6u);
}

}  // namespace
}  // namespace osculate::mesh
