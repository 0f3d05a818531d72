#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>

#include "osculate/cell/volume_shape.hpp"
#include "osculate/core/error.hpp"
#include "osculate/io/gmsh.hpp"
#include "osculate/mesh/check.hpp"
#include "osculate/mesh/surface.hpp"

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

const Vec3& at(const Mesh& mesh, Index node) { return mesh.nodes[static_cast<std::size_t>(node)]; }

const mesh::Block& block_of(const Mesh& mesh, mesh::CellRef ref) {
  return mesh.blocks[static_cast<std::size_t>(ref.block)];
}

std::vector<CellType> types_of(const Mesh& mesh, const std::string& name) {
  std::vector<CellType> types;
  for (const mesh::CellRef ref : mesh.find_set(name)->cells)
    if (types.empty() || types.back() != block_of(mesh, ref).type)
      types.push_back(block_of(mesh, ref).type);
  return types;
}

/// The samples are made of straight cells: every node must lie where the shape functions of the
/// corners put it (Gmsh itself is off by 3e-12).
double largest_offset(const Mesh& mesh, const std::string& name, CellType linear) {
  double largest = 0;
  for (const mesh::CellRef ref : mesh.find_set(name)->cells) {
    const mesh::Block& block = block_of(mesh, ref);
    const Index* const nodes = block.cell(ref.cell);
    for (int k = 0; k < cell::info(block.type).nodes; ++k) {
      const cell::VolumeShape shape = cell::volume_shape(linear, cell::volume_node(block.type, k));
      Vec3 x = Vec3::Zero();
      for (int c = 0; c < shape.count; ++c) x += at(mesh, nodes[c]) * shape.n[c];
      largest = std::max(largest, (x - at(mesh, nodes[k])).norm());
    }
  }
  return largest;
}

struct Sample {
  int number;
  CellType brick, tet, prism, facet, triangle;
};
const std::vector<Sample> samples{
    {1, CellType::hex8, CellType::tet4, CellType::wedge6, CellType::quad4, CellType::tri3},
    {2, CellType::hex27, CellType::tet10, CellType::point1, CellType::quad9, CellType::tri6},
    {3, CellType::hex20, CellType::tet10, CellType::wedge15, CellType::quad8, CellType::tri6}};

class GmshSolids : public ::testing::TestWithParam<Sample> {};
INSTANTIATE_TEST_SUITE_P(Orders, GmshSolids, ::testing::ValuesIn(samples), [](const auto& tested) {
  return std::string(cell::info(tested.param.brick).name);
});

TEST_P(GmshSolids, SetsOfEveryDimension) {
  const Sample& s = GetParam();
  const Mesh mesh = sample(fmt::format("solids_{}_41.msh", s.number));
  std::vector<std::string> names;
  for (const Set& set : mesh.sets) names.push_back(fmt::format("{} {}", set.dimension, set.name));
  if (s.prism == CellType::point1)
    EXPECT_THAT(names, ElementsAre("0 A", "1 rim", "2 floor", "2 roof", "2 surface_9", "2 faces",
                                   "3 brick", "3 tet"));
  else
    EXPECT_THAT(names, ElementsAre("0 A", "1 rim", "2 floor", "2 roof", "2 surface_9", "2 slope",
                                   "2 faces", "3 brick", "3 prism", "3 tet"));
  EXPECT_THAT(types_of(mesh, "brick"), ElementsAre(s.brick));
  EXPECT_THAT(types_of(mesh, "tet"), ElementsAre(s.tet));
  EXPECT_THAT(types_of(mesh, "floor"), ElementsAre(s.facet));
  EXPECT_THAT(types_of(mesh, "faces"), ElementsAre(s.triangle));
  EXPECT_THAT(mesh.find_set("brick")->cells, SizeIs(2));
  EXPECT_THAT(mesh.find_set("faces")->cells, SizeIs(4));
  EXPECT_THAT(mesh.find_set("surface_9")->cells, SizeIs(4));
  EXPECT_EQ(at(mesh, mesh.find_set("A")->nodes.at(0)), Vec3(2, 1.2, 0));
  EXPECT_THAT(mesh::check_mesh(mesh), IsEmpty());
}

TEST_P(GmshSolids, NodesLieWhereTheShapeFunctionsPutThem) {
  const Sample& s = GetParam();
  const Mesh mesh = sample(fmt::format("solids_{}_41.msh", s.number));
  EXPECT_LE(largest_offset(mesh, "brick", CellType::hex8), 1e-11);
  EXPECT_LE(largest_offset(mesh, "tet", CellType::tet4), 1e-11);
  if (s.prism == CellType::point1) return;
  EXPECT_THAT(types_of(mesh, "prism"), ElementsAre(s.prism));
  EXPECT_LE(largest_offset(mesh, "prism", CellType::wedge6), 1e-11);
}

// Gmsh's facets and our faces of its cells have the same nodes.
TEST_P(GmshSolids, AreasAreFacesOfTheirVolumes) {
  const Mesh mesh = sample(fmt::format("solids_{}_22.msh", GetParam().number));
  for (const Set& set : mesh.sets) {
    if (set.dimension != 2) continue;
    const mesh::Surface surface = mesh::orient_surface(mesh, set);
    EXPECT_THAT(surface.errors, IsEmpty());
    EXPECT_THAT(surface.warnings, IsEmpty());
    EXPECT_EQ(surface.facets.size(), set.cells.size());
    for (const mesh::SurfaceFacet& facet : surface.facets) EXPECT_TRUE(facet.has_parent());
  }
}

TEST_P(GmshSolids, FourFlavoursGiveTheSameMesh) {
  const int n = GetParam().number;
  const Mesh first = sample(fmt::format("solids_{}_22.msh", n));
  for (const char* flavour : {"22_binary", "41", "41_binary"}) {
    const Mesh other = sample(fmt::format("solids_{}_{}.msh", n, flavour));
    ASSERT_EQ(other.nodes.size(), first.nodes.size());
    for (std::size_t i = 0; i < first.nodes.size(); ++i)
      EXPECT_LE((other.nodes[i] - first.nodes[i]).norm(), 1e-15);
    ASSERT_EQ(other.blocks.size(), first.blocks.size());
    for (std::size_t b = 0; b < first.blocks.size(); ++b) {
      EXPECT_EQ(other.blocks[b].type, first.blocks[b].type);
      EXPECT_EQ(other.blocks[b].connectivity, first.blocks[b].connectivity) << flavour;
    }
    ASSERT_EQ(other.sets.size(), first.sets.size());
    for (std::size_t i = 0; i < first.sets.size(); ++i) {
      EXPECT_EQ(other.sets[i].name, first.sets[i].name);
      EXPECT_EQ(other.sets[i].cells, first.sets[i].cells);
      EXPECT_EQ(other.sets[i].nodes, first.sets[i].nodes);
    }
  }
}

// ---- written by hand ----------------------------------------------------------------------------

const std::string head =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
    "$Entities\n0 0 1 1\n1 0 0 0 1 1 1 1 -3 0\n1 0 0 0 1 1 1 1 -7 0\n$EndEntities\n"
    "$Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n";

TEST(GmshVolumes, NegativeGroupsReverseAreasButNotVolumes) {
  const Mesh mesh = read_gmsh(head +
                                  "$Elements\n2 2 1 2\n2 1 2 1\n1 1 2 3\n3 1 4 1\n2 1 2 3 4\n"
                                  "$EndElements\n",
                              "t");
  EXPECT_THAT(mesh.blocks[0].connectivity, ElementsAre(0, 2, 1));
  EXPECT_THAT(mesh.blocks[1].connectivity, ElementsAre(0, 1, 2, 3));
  EXPECT_EQ(mesh.sets[1].name, "volume_7");
  EXPECT_EQ(mesh.sets[1].dimension, 3);
  EXPECT_THAT(mesh.sets[1].nodes, ElementsAre(0, 1, 2, 3));
}

TEST(GmshVolumes, CompletePrismsSayHowToAvoidThem) {
  try {
    (void)read_gmsh(head + "$Elements\n1 1 1 1\n3 1 13 1\n1 1 2 3 4\n$EndElements\n", "t");
    ADD_FAILURE();
  } catch (const core::InputError& error) {
    EXPECT_THAT(error.what(),
                ::testing::HasSubstr("element type 13 (18-node prism) is not supported "
                                     "(Mesh.SecondOrderIncomplete = 1 makes 15-node prisms); "
                                     "supported are 15 (point1)"));
    EXPECT_THAT(error.what(), ::testing::Not(::testing::HasSubstr("shell18")));
  }
}

}  // namespace
}  // namespace osculate::io
