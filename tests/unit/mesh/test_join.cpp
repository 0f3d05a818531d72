#include "osculate/mesh/join.hpp"

#include <gmock/gmock.h>

#include "osculate/mesh/check.hpp"
#include "osculate/mesh/generate.hpp"

namespace osculate::mesh {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// A box of two cells, quad4 or tri3, with a line mesh beside it.
Mesh part(cell::CellType type) {
  Mesh mesh;
  BoxSpec box;
  box.name = "box";
  box.x = {0, 2};
  box.y = {0, 1};
  box.nx = {2};
  box.ny = {1};
  box.type = type;
  append_box(mesh, box);
  append_line(mesh, {"rail", {{-1, -1}, {3, -1}}, {4}, cell::CellType::line2});
  return mesh;
}

TEST(Join, SetsHaveTheNameOfTheirMeshBeforeTheirs) {
  Mesh mesh = part(cell::CellType::quad4);
  const Mesh before = mesh;
  append_mesh(mesh, part(cell::CellType::tri3), "a");
  append_mesh(mesh, part(cell::CellType::quad4), "b");
  EXPECT_THAT(check_mesh(mesh), IsEmpty());
  ASSERT_NE(mesh.find_set("a"), nullptr);
  EXPECT_EQ(mesh.find_set("a")->dimension, 2);
  EXPECT_EQ(mesh.find_set("a")->cells, mesh.find_set("a.box")->cells);
  EXPECT_EQ(mesh.find_set("b")->nodes, mesh.find_set("b.box")->nodes);
  const auto n = static_cast<Index>(before.nodes.size());
  EXPECT_EQ(mesh.nodes.size(), 3 * before.nodes.size());
  for (const Set& set : before.sets) {
    const Set* const copy = mesh.find_set("b." + set.name);
    ASSERT_NE(copy, nullptr) << set.name;
    EXPECT_EQ(mesh.find_set(set.name)->cells, set.cells);
    ASSERT_EQ(copy->nodes.size(), set.nodes.size());
    for (std::size_t k = 0; k < set.nodes.size(); ++k)
      EXPECT_EQ(copy->nodes[k], set.nodes[k] + 2 * n);
    for (std::size_t c = 0; c < set.cells.size(); ++c) {
      const Block& block = mesh.blocks[static_cast<std::size_t>(copy->cells[c].block)];
      const Block& old = before.blocks[static_cast<std::size_t>(set.cells[c].block)];
      EXPECT_EQ(block.type, old.type);
      EXPECT_EQ(block.cell(copy->cells[c].cell)[1], old.cell(set.cells[c].cell)[1] + 2 * n);
    }
  }
}

TEST(Join, NumbersOfFilesAreKept) {
  Mesh mesh = part(cell::CellType::quad4), file = part(cell::CellType::quad4);
  const std::size_t n = mesh.nodes.size();
  append_mesh(mesh, file, "plain");
  EXPECT_EQ(node_number(mesh, static_cast<Index>(n)), static_cast<std::int64_t>(n) + 1);
  for (std::size_t i = 0; i < n; ++i) file.numbers.push_back(100 + static_cast<std::int64_t>(i));
  for (Block& block : file.blocks)
    for (Index c = 0; c < block.size(); ++c) block.numbers.push_back(200 + c);
  append_mesh(mesh, file, "file");
  EXPECT_EQ(mesh.numbers.size(), mesh.nodes.size());
  EXPECT_EQ(node_number(mesh, 1), 2);
  EXPECT_EQ(node_number(mesh, static_cast<Index>(2 * n) + 1), 101);
  append_mesh(mesh, part(cell::CellType::quad4), "last");
  EXPECT_EQ(mesh.numbers.size(), mesh.nodes.size());
  EXPECT_EQ(node_number(mesh, static_cast<Index>(3 * n)), static_cast<std::int64_t>(3 * n) + 1);
  EXPECT_EQ(cell_number(mesh, mesh.find_set("file.box")->cells[1]), 201);
  EXPECT_EQ(cell_number(mesh, mesh.find_set("last.box")->cells[0]), 7);
}

TEST(Join, IsScaledThenTurnedThenMoved) {
  Mesh mesh = part(cell::CellType::quad4);
  place(mesh, {3, 90, {1, 0, 0}, {0, 0, 2}, {10, 20, 30}});
  // (2, 1) -> (6, 3) -> (1 - 3, 5) -> (8, 25, 30)
  EXPECT_EQ(mesh.nodes[static_cast<std::size_t>(mesh.find_set("box.top_right")->nodes[0])],
            Vec3(8, 25, 30));
}

TEST(Join, NamesThatAreThereAlready) {
  Mesh mesh = part(cell::CellType::quad4);
  const auto refused = [&](const std::string& name) {
    try {
      append_mesh(mesh, part(cell::CellType::quad4), name, {"model.yaml", 7, "mesh.files"});
    } catch (const core::InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refused("box"),
            "model.yaml:7: mesh.files: mesh 'box': there is already a set of that name");
  EXPECT_EQ(mesh.nodes.size(), part(cell::CellType::quad4).nodes.size());
  mesh.sets[0].name = "a.rail";
  EXPECT_EQ(refused("a"), "model.yaml:7: mesh.files: mesh 'a': there is already a set 'a.rail'");
}

}  // namespace
}  // namespace osculate::mesh
