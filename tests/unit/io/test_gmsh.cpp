#include "osculate/io/gmsh.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "osculate/core/error.hpp"
#include "osculate/mesh/check.hpp"

namespace osculate::io {
namespace {

using cell::CellType;
using mesh::Mesh;
using mesh::Set;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

Mesh sample(const std::string& name) {
  return read_gmsh(std::string(OSCULATE_SOURCE_DIR "/tests/unit/io/data/") + name);
}

bool same_topology(const Mesh& a, const Mesh& b) {
  const auto same_block = [](const mesh::Block& p, const mesh::Block& q) {
    return p.type == q.type && p.connectivity == q.connectivity;
  };
  const auto same_set = [](const Set& p, const Set& q) {
    return p.name == q.name && p.dimension == q.dimension && p.cells == q.cells &&
           p.nodes == q.nodes;
  };
  return a.nodes.size() == b.nodes.size() && std::ranges::equal(a.blocks, b.blocks, same_block) &&
         std::ranges::equal(a.sets, b.sets, same_set);
}

double largest_difference(const Mesh& a, const Mesh& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.nodes.size(); ++i)
    largest = std::max(largest, (a.nodes[i] - b.nodes[i]).cwiseAbs().maxCoeff());
  return largest;
}

/// Cells of all sets by their coordinates, independent of any numbering.
std::map<std::string, std::vector<std::string>> by_coordinates(const Mesh& mesh) {
  std::map<std::string, std::vector<std::string>> result;
  for (const Set& set : mesh.sets) {
    std::vector<std::string>& cells = result[fmt::format("{} {}", set.dimension, set.name)];
    for (const mesh::CellRef ref : set.cells) {
      const mesh::Block& block = mesh.blocks[static_cast<std::size_t>(ref.block)];
      std::string text;
      for (int k = 0; k < cell::info(block.type).nodes; ++k) {
        const Vec3& x = mesh.nodes[static_cast<std::size_t>(block.cell(ref.cell)[k])];
        text += fmt::format(" {:.9f},{:.9f}", x.x() + 1e-11, x.y() + 1e-11);
      }
      cells.push_back(text);
    }
    std::sort(cells.begin(), cells.end());
  }
  return result;
}

const Set& get(const Mesh& mesh, const std::string& name) {
  const Set* set = mesh.find_set(name);
  if (set == nullptr) throw std::runtime_error("no set " + name);
  return *set;
}

Vec2 end_of(const Mesh& mesh, const Set& set, std::size_t cell, int end) {
  const mesh::CellRef ref = set.cells[cell];
  const mesh::Block& block = mesh.blocks[static_cast<std::size_t>(ref.block)];
  return mesh.nodes[static_cast<std::size_t>(block.cell(ref.cell)[end])].head<2>();
}

// ---- what is in the sample ----------------------------------------------------------------------

TEST(Gmsh, BlocksAndSets) {
  const Mesh mesh = sample("blocks_41.msh");
  EXPECT_THAT(mesh.nodes, SizeIs(32));
  ASSERT_THAT(mesh.blocks, SizeIs(4));
  EXPECT_EQ(mesh.blocks[0].type, CellType::point1);
  EXPECT_EQ(mesh.blocks[1].type, CellType::line3);
  EXPECT_EQ(mesh.blocks[2].type, CellType::tri6);
  EXPECT_EQ(mesh.blocks[3].type, CellType::quad9);
  EXPECT_EQ(mesh.blocks[3].size(), 4);
  std::vector<std::string> names;
  for (const Set& set : mesh.sets) names.push_back(fmt::format("{} {}", set.dimension, set.name));
  EXPECT_THAT(names, ElementsAre("0 point_33", "0 A", "1 line_9", "1 bottom edge", "1 rim",
                                 "1 rigid", "2 block", "2 surface_77", "2 all"));
  EXPECT_THAT(get(mesh, "block").cells, SizeIs(4));
  EXPECT_THAT(get(mesh, "block").nodes, SizeIs(25));
  EXPECT_EQ(get(mesh, "all").cells.size(),
            get(mesh, "block").cells.size() + get(mesh, "surface_77").cells.size());
  EXPECT_EQ(mesh.nodes[static_cast<std::size_t>(get(mesh, "A").nodes.at(0))], Vec3(0.5, 2, 0));
}

TEST(Gmsh, CellsOfTwoGroupsAreThereOnce) {
  const Mesh mesh = sample("blocks_22.msh");
  const Set& bottom = get(mesh, "bottom edge");
  const Set& rim = get(mesh, "rim");
  EXPECT_THAT(bottom.cells, SizeIs(2));
  EXPECT_THAT(rim.cells, SizeIs(4));
  for (const mesh::CellRef ref : bottom.cells) EXPECT_THAT(rim.cells, ::testing::Contains(ref));
  EXPECT_EQ(mesh.blocks[3].size(), 4);
  EXPECT_THAT(mesh::check_mesh(mesh), IsEmpty());
}

TEST(Gmsh, NegativeGroupsReverseTheirCells) {
  for (const char* name : {"blocks_22.msh", "blocks_41.msh"}) {
    const Mesh mesh = sample(name);
    const Set& rigid = get(mesh, "rigid");
    ASSERT_THAT(rigid.cells, SizeIs(1));
    EXPECT_EQ(end_of(mesh, rigid, 0, 0), Vec2(2, -0.5)) << name;
    EXPECT_EQ(end_of(mesh, rigid, 0, 1), Vec2(-1, -0.5)) << name;
    const Set& rim = get(mesh, "rim");
    for (std::size_t c = 0; c < 4; ++c) {
      const Vec2 way = end_of(mesh, rim, c, 1) - end_of(mesh, rim, c, 0);
      EXPECT_TRUE(way.x() > 0 || way.y() < 0) << name;
    }
  }
}

TEST(Gmsh, QuadraticAreasAreReversedAsGmshDoesItself) {
  // MSH 2 holds the reversed cells, MSH 4 the original ones and a negative tag.
  for (const char* order : {"1", "2"}) {
    const Mesh a = sample(fmt::format("mixed_{}_22.msh", order));
    const Mesh b = sample(fmt::format("mixed_{}_41.msh", order));
    EXPECT_TRUE(same_topology(a, b)) << order;
    EXPECT_EQ(by_coordinates(a), by_coordinates(b)) << order;
    EXPECT_THAT(get(a, "tris").cells, SizeIs(2));
    // line 1 is in a group forwards and in another one backwards: two cells
    EXPECT_EQ(end_of(a, get(a, "l"), 0, 0), end_of(a, get(a, "m"), 0, 1));
    EXPECT_EQ(a.blocks[0].size(), 3);
  }
  EXPECT_EQ(sample("mixed_2_41.msh").blocks.back().type, CellType::quad8);
}

// ---- flavours
// --------------------------------------------------------------------------------------

TEST(Gmsh, FourFlavoursGiveTheSameMesh) {
  const Mesh text4 = sample("blocks_41.msh");
  const Mesh text2 = sample("blocks_22.msh");
  const Mesh binary4 = sample("blocks_41_binary.msh");
  const Mesh binary2 = sample("blocks_22_binary.msh");
  for (const Mesh* other : {&text2, &binary2, &binary4}) {
    ASSERT_TRUE(same_topology(text4, *other));
    EXPECT_EQ(by_coordinates(text4), by_coordinates(*other));
  }
  EXPECT_EQ(largest_difference(text4, text2), 0);
  EXPECT_EQ(largest_difference(binary4, binary2), 0);
  EXPECT_LE(largest_difference(text4, binary4), 1e-15);  // 16 digits of text
}

TEST(Gmsh, PartitionsAndParametersDoNotMatter) {
  const auto expected = by_coordinates(sample("blocks_41.msh"));
  for (const char* name : {"partitioned_22.msh", "partitioned_41.msh", "partitioned_41_binary.msh",
                           "parametric_41.msh", "parametric_41_binary.msh"})
    EXPECT_TRUE(by_coordinates(sample(name)) == expected) << name;
}

TEST(Gmsh, LineEndsOfWindowsAndAByteOrderMarkAreRead) {
  std::string text = read_file(OSCULATE_SOURCE_DIR "/tests/unit/io/data/blocks_41.msh");
  std::string windows = "\xEF\xBB\xBF";
  for (const char c : text) windows += c == '\n' ? "\r\n" : std::string(1, c);
  EXPECT_TRUE(same_topology(read_gmsh(windows, "w"), read_gmsh(text, "u")));
}

// ---- written by hand
// -------------------------------------------------------------------------------

const std::string head2 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
const std::string nodes2 = "$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n";

TEST(Gmsh, SparseTagsInAnyOrder) {
  const Mesh mesh =
      read_gmsh(head2 +
                    "$Nodes\n3\n2000000000 1 0 0\n5 0 1e-400 0\n70 0 +1 0\n$EndNodes\n"
                    "$Elements\n1\n9 2 2 4 1 5 2000000000 70\n$EndElements",
                "t");
  EXPECT_THAT(mesh.nodes, ElementsAre(Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(1, 0, 0)));
  EXPECT_THAT(mesh.blocks[0].connectivity, ElementsAre(0, 2, 1));
  EXPECT_THAT(get(mesh, "surface_4").cells, SizeIs(1));
  EXPECT_THAT(mesh.numbers, ElementsAre(5, 70, 2000000000));
  EXPECT_THAT(mesh.blocks[0].numbers, ElementsAre(9));
}

/// Messages and results name nodes and cells as the mesh file does.
TEST(Gmsh, NumbersOfTheFileAreKept) {
  for (const char* const file : {"blocks_22.msh", "blocks_22_binary.msh", "blocks_41.msh"}) {
    const Mesh mesh = sample(file);
    ASSERT_EQ(mesh.numbers.size(), mesh.nodes.size()) << file;
    EXPECT_TRUE(std::is_sorted(mesh.numbers.begin(), mesh.numbers.end())) << file;
    for (const mesh::Block& block : mesh.blocks) {
      ASSERT_EQ(block.numbers.size(), static_cast<std::size_t>(block.size())) << file;
      EXPECT_THAT(block.numbers, ::testing::Each(::testing::Gt(0))) << file;
    }
  }
}

TEST(Gmsh, CellsWithoutGroupAreInNoSet) {
  const Mesh mesh = read_gmsh(
      head2 + nodes2 + "$Elements\n3\n1 2 0 1 2 3\n2 2 2 0 1 1 2 3\n3 1 2 0 1 1 2\n$EndElements\n",
      "t");
  EXPECT_THAT(mesh.sets, IsEmpty());
  EXPECT_EQ(mesh.blocks[1].size(), 2);
}

TEST(Gmsh, NamedGroupsWithoutCellsAreEmptySets) {
  const Mesh mesh = read_gmsh(head2 +
                                  "$PhysicalNames\n3\n1 4 \"edge of it\"\n3 9 \"body\"\n2 1 "
                                  "\"a\"\n$EndPhysicalNames\n" +
                                  nodes2 + "$Elements\n1\n1 2 2 1 1 1 2 3\n$EndElements\n",
                              "t");
  ASSERT_THAT(mesh.sets, SizeIs(3));
  EXPECT_EQ(mesh.sets[0].name, "edge of it");
  EXPECT_THAT(mesh.sets[0].cells, IsEmpty());
  EXPECT_THAT(mesh.sets[1].cells, SizeIs(1));
  EXPECT_EQ(mesh.sets[2].name, "body");
  EXPECT_EQ(mesh.sets[2].dimension, 3);
  EXPECT_THAT(mesh.sets[2].cells, IsEmpty());
}

TEST(Gmsh, OtherSectionsAreSkipped) {
  const Mesh mesh = read_gmsh("$Comments\nany $thing\n$EndComments\n" + head2 +
                                  "$Periodic\n1\n0 1 2\n$EndPeriodic\n" + nodes2 +
                                  "$Elements\n1\n1 2 2 1 1 1 2 3\n$EndElements\n"
                                  "$NodeData\n1\n\"u\"\n$EndNodeData\n\n",
                              "t");
  EXPECT_THAT(mesh.nodes, SizeIs(3));
}

}  // namespace
}  // namespace osculate::io
