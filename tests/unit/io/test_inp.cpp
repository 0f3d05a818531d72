// Meshes of Abaqus and CalculiX input files: nodes, sets, surfaces, names.
#include "osculate/io/inp.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "osculate/core/error.hpp"
#include "osculate/io/inp/deck_mesh.hpp"
#include "osculate/io/mesh_format.hpp"
#include "osculate/mesh/check.hpp"
#include "osculate/mesh/surface.hpp"

namespace osculate::io {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::UnorderedElementsAre;

/// Nodes 1 to 12 of two bricks on each other, elements 5 and 6.
const std::string bricks =
    "*NODE, NSET=Nall\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, 0, 0, 1\n6, 1, 0, 1\n"
    "7, 1, 1, 1\n8, 0, 1, 1\n9, 0, 0, 2\n10, 1, 0, 2\n11, 1, 1, 2\n12, 0, 1, 2\n"
    "*ELEMENT, TYPE=C3D8, ELSET=Eall\n5, 1, 2, 3, 4, 5, 6, 7, 8\n6, 5, 6, 7, 8, 9, 10, 11, 12\n";

mesh::Mesh read(const std::string& text) { return read_inp(text, "a.inp"); }

/// Of a set, the numbers of its nodes or cells.
std::vector<std::int64_t> nodes(const mesh::Mesh& mesh, const std::string& set) {
  std::vector<std::int64_t> numbers;
  for (const Index node : mesh.find_set(set)->nodes)
    numbers.push_back(mesh::node_number(mesh, node));
  return numbers;
}
std::vector<std::int64_t> cells(const mesh::Mesh& mesh, const std::string& set) {
  std::vector<std::int64_t> numbers;
  for (const mesh::CellRef& ref : mesh.find_set(set)->cells)
    numbers.push_back(mesh::cell_number(mesh, ref));
  return numbers;
}

TEST(Inp, NodesAndElementsAreOrderedByTheirNumbers) {
  const mesh::Mesh mesh = read(
      "*NODE\n30, 3\n10, 1, 2\n20,,, 5\n7\n*ELEMENT, TYPE=S3\n9, 10, 20, 30\n*ELEMENT, TYPE=S3\n"
      "4, 7, 10,\n20\n");
  EXPECT_THAT(mesh.numbers, ElementsAre(7, 10, 20, 30));
  EXPECT_EQ(mesh.nodes[0], Vec3(0, 0, 0));
  EXPECT_EQ(mesh.nodes[1], Vec3(1, 2, 0));
  EXPECT_EQ(mesh.nodes[2], Vec3(0, 0, 5));
  EXPECT_EQ(mesh.nodes[3], Vec3(3, 0, 0));
  ASSERT_THAT(mesh.blocks, SizeIs(1));
  EXPECT_THAT(mesh.blocks[0].numbers, ElementsAre(4, 9));
  EXPECT_THAT(mesh.blocks[0].connectivity, ElementsAre(0, 1, 2, 1, 2, 3));
  EXPECT_THAT(mesh.sets, IsEmpty());
}

TEST(Inp, CylindricalCoordinates) {
  const mesh::Mesh mesh = read(
      "*NODE, SYSTEM=c\n1, 2, 90, 3\n2, 1, 180\n3, 1, 0, 0, .5, .5, 0\n*NODE, SYSTEM=R\n4, 1\n"
      "*ELEMENT, TYPE=S3\n1, 1, 2, 3\n");
  EXPECT_NEAR((mesh.nodes[0] - Vec3(0, 2, 3)).norm(), 0, 1e-15);
  EXPECT_NEAR((mesh.nodes[1] - Vec3(-1, 0, 0)).norm(), 0, 1e-15);
  EXPECT_EQ(mesh.nodes[2], Vec3(1, 0, 0));
  EXPECT_EQ(mesh.nodes[3], Vec3(1, 0, 0));
}

TEST(Inp, SetsOfNumbersOfRangesAndOfSets) {
  const mesh::Mesh mesh =
      read(bricks +
           "*NSET, NSET=A, UNSORTED\n 4, 2,\n1,  \n2\n*NSET, NSET=B, GENERATE\n1, 9, 4\n11, 100\n"
           "*NSET, NSET=C\nlater, A, 12\n*NSET, NSET=Later\n7\n*NSET, NSET=A\n3\n"
           "*ELSET, ELSET=ONE\n5\n*ELSET, ELSET=BOTH\nONE, TWO\n*ELSET, ELSET=TWO, GENERATE\n6, 6\n"
           "*NSET, NSET=OFTWO, ELSET=two\n");
  EXPECT_THAT(nodes(mesh, "A"), ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(nodes(mesh, "B"), ElementsAre(1, 5, 9, 11, 12));
  EXPECT_THAT(nodes(mesh, "C"), ElementsAre(1, 2, 3, 4, 7, 12));
  EXPECT_THAT(nodes(mesh, "Nall"), SizeIs(12));
  EXPECT_EQ(mesh.find_set("A")->dimension, 0);
  EXPECT_THAT(cells(mesh, "BOTH"), ElementsAre(5, 6));
  EXPECT_EQ(mesh.find_set("BOTH")->dimension, 3);
  EXPECT_THAT(nodes(mesh, "ONE"), ElementsAre(1, 2, 3, 4, 5, 6, 7, 8));
  EXPECT_THAT(nodes(mesh, "OFTWO"), ElementsAre(5, 6, 7, 8, 9, 10, 11, 12));
}

TEST(Inp, NamesAreFoundInAnyLettersAndKeepTheFirstOnes) {
  const mesh::Mesh mesh =
      read(bricks + "*NSET, NSET=Top\n9\n*NSET, NSET=TOP\ntop2\n*NSET, NSET=Top2\n10\n");
  ASSERT_TRUE(mesh.find_set("tOp"));
  EXPECT_EQ(mesh.find_set("tOp")->name, "Top");
  EXPECT_THAT(nodes(mesh, "TOP"), ElementsAre(9, 10));
  EXPECT_EQ(mesh.find_set("EALL"), mesh.find_set("Eall"));
  EXPECT_EQ(mesh.find_set("Eal"), nullptr);
  // Names of other formats stay as they are.
  mesh::Mesh other = mesh;
  for (mesh::Set& set : other.sets) set.any_case = false;
  EXPECT_EQ(other.find_set("EALL"), nullptr);
}

TEST(Inp, SurfacesOfElementsAndOfNodes) {
  const mesh::Mesh mesh = read(
      bricks +
      "*SURFACE, NAME=UP, TYPE=ELEMENT\nupper, S2\n*ELSET, ELSET=UPPER\n6\n"
      "*SURFACE, NAME=SIDE\nEALL, s3\n5, S3\n*SURFACE, TYPE=NODE, NAME=NODES\n9, 1.5\nlow\n*NSET, "
      "NSET=LOW\n1, 2\n*SURFACE, NAME=SKIN\nEall\n*SURFACE, NAME=HALF\nUPPER,\n");
  EXPECT_THAT(nodes(mesh, "UP"), ElementsAre(9, 10, 11, 12));
  EXPECT_EQ(mesh.find_set("UP")->dimension, 2);
  EXPECT_THAT(cells(mesh, "SIDE"), UnorderedElementsAre(5, 6));
  EXPECT_THAT(nodes(mesh, "SIDE"), ElementsAre(1, 2, 5, 6, 9, 10));
  EXPECT_THAT(nodes(mesh, "NODES"), ElementsAre(1, 2, 9));
  EXPECT_EQ(mesh.find_set("NODES")->dimension, 0);
  EXPECT_THAT(cells(mesh, "SKIN"), SizeIs(10));
  EXPECT_THAT(cells(mesh, "HALF"), SizeIs(5));  // what is free in the whole mesh
  for (const char* const name : {"UP", "SIDE", "SKIN", "HALF"}) {
    const mesh::Surface surface =
        mesh::surface_of(mesh, mesh::face_table(mesh), *mesh.find_set(name));
    EXPECT_THAT(surface.errors, IsEmpty());
    for (const mesh::SurfaceFacet& facet : surface.facets) EXPECT_FALSE(facet.flipped);
  }
  // Each facet is there once, whatever surfaces it belongs to.
  EXPECT_EQ(mesh.blocks[1].size(), 10);
  EXPECT_THAT(mesh::check_mesh(mesh), IsEmpty());
}

TEST(Inp, SurfacesMadeOfSurfaces) {
  const mesh::Mesh mesh =
      read(bricks +
           "*SURFACE, NAME=BOTH, COMBINE=UNION\nUP, side\n*SURFACE, NAME=REST, COMBINE=DIFFERENCE\n"
           "SKIN, BOTH\n*SURFACE, NAME=EDGE, COMBINE=INTERSECTION\nskin, Side\n"
           "*SURFACE, NAME=UP\n6, S2\n*SURFACE, NAME=SIDE\nEALL, S3\n*SURFACE, NAME=SKIN\nEALL\n");
  EXPECT_THAT(cells(mesh, "BOTH"), UnorderedElementsAre(5, 6, 6));
  EXPECT_THAT(nodes(mesh, "BOTH"), ElementsAre(1, 2, 5, 6, 9, 10, 11, 12));
  EXPECT_THAT(cells(mesh, "REST"), SizeIs(7));
  EXPECT_THAT(nodes(mesh, "EDGE"), ElementsAre(1, 2, 5, 6, 9, 10));
  EXPECT_EQ(mesh.blocks[1].size(), 10);
  EXPECT_THAT(mesh::check_mesh(mesh), IsEmpty());
}

TEST(Inp, SurfacesInThePlaneHaveTheBodyOnTheRight) {
  const mesh::Mesh mesh = read(
      "*NODE\n1, 0, 0\n2, 1, 0\n3, 2, 0\n4, 0, 1\n5, 1, 1\n6, 2, 1\n*ELEMENT, TYPE=CPE4, ELSET=E\n"
      "1, 1, 2, 5, 4\n2, 2, 3, 6, 5\n*SURFACE, NAME=BOTTOM\nE, S1\n*SURFACE, NAME=RIM\nE\n");
  const mesh::Set& bottom = *mesh.find_set("BOTTOM");
  EXPECT_EQ(bottom.dimension, 1);
  const mesh::Boundary boundary = mesh::surface_of(mesh, mesh::edge_table(mesh), bottom);
  EXPECT_THAT(boundary.errors, IsEmpty());
  ASSERT_THAT(boundary.facets, SizeIs(2));
  for (const mesh::BoundaryFacet& facet : boundary.facets) {
    EXPECT_FALSE(facet.flipped);
    EXPECT_LT(mesh.nodes[std::size_t(facet.node[1])].x(),
              mesh.nodes[std::size_t(facet.node[0])].x());
  }
  EXPECT_THAT(mesh.find_set("RIM")->cells, SizeIs(6));
  EXPECT_THAT(mesh::check_mesh(mesh), IsEmpty());
}

TEST(Inp, OneNameForElementsSurfaceAndNodes) {
  const std::string text =
      bricks +
      "*ELSET, ELSET=TOP\n6\n*SURFACE, NAME=Top\nTOP, S2\n*NSET, NSET=top\n9, 10, 11, 12\n"
      "*NSET, NSET=Eall, GENERATE\n1, 12\n*NSET, NSET=LID\n9\n*SURFACE, TYPE=NODE, "
      "NAME=LID\n10\n*SURFACE, TYPE=NODE, NAME=TOP\n9\n";
  const mesh::Mesh mesh = read(text);
  EXPECT_EQ(mesh.find_set("TOP")->dimension, 3);
  EXPECT_EQ(mesh.find_set("top.surface")->dimension, 2);
  EXPECT_THAT(nodes(mesh, "top.nodes"), ElementsAre(9, 10, 11, 12));
  EXPECT_THAT(nodes(mesh, "top.surface_nodes"), ElementsAre(9));
  EXPECT_EQ(mesh.find_set("Eall.nodes"), nullptr);  // the same nodes: one set
  EXPECT_THAT(nodes(mesh, "LID"), ElementsAre(9));
  EXPECT_THAT(nodes(mesh, "LID.surface_nodes"), ElementsAre(10));

  const inp::Deck deck = inp::read_cards(text, "a.inp");
  const inp::DeckMesh found = inp::deck_mesh(deck);
  const auto name = [&](inp::SetKind kind, const std::string& wanted) {
    for (const inp::DeckSet& set : found.sets)
      if (set.kind == kind && set.name == wanted) return found.mesh.sets[set.set].name;
    return std::string();
  };
  EXPECT_EQ(name(inp::SetKind::nodes, "Eall"), "Eall");
  EXPECT_EQ(name(inp::SetKind::elements, "TOP"), "TOP");
  EXPECT_EQ(name(inp::SetKind::surface, "Top"), "Top.surface");
  EXPECT_EQ(name(inp::SetKind::nodes, "top"), "top.nodes");
  EXPECT_EQ(name(inp::SetKind::node_surface, "TOP"), "TOP.surface_nodes");
}

TEST(Inp, SetsOfSeveralDimensions) {
  const mesh::Mesh mesh = read(
      bricks +
      "*ELEMENT, TYPE=S4, ELSET=Eall\n7, 9, 10, 11, 12\n*ELEMENT, TYPE=B31, ELSET=EALL\n8, 1, 2\n");
  EXPECT_THAT(cells(mesh, "EALL"), ElementsAre(5, 6));
  EXPECT_THAT(cells(mesh, "EALL.areas"), ElementsAre(7));
  EXPECT_THAT(cells(mesh, "EALL.lines"), ElementsAre(8));
}

TEST(Inp, WhatIsNotOfTheMeshIsSkipped) {
  const mesh::Mesh mesh =
      read("*HEADING\nany, text\n" + bricks +
           "*MATERIAL, NAME=M\n*ELASTIC\n1., .3\n*SURFACE, TYPE=CYLINDER, NAME=DRUM\n1, 2\n"
           "*SURFACE INTERACTION, NAME=I\n*STEP\n*STATIC\n*NODE PRINT, NSET=NALL\nU\n*NODE "
           "FILE\nU\n*EL PRINT, ELSET=EALL\nS\n*END STEP\n");
  EXPECT_THAT(mesh.sets, SizeIs(2));
}

TEST(Inp, IsAFormatOfMeshes) {
  EXPECT_EQ(mesh_format_of("a.INP", "")->extension, ".inp");
  EXPECT_EQ(mesh_format_of("a", "\n** deck\n*NODE")->extension, ".inp");
  EXPECT_EQ(mesh_format_of("a.yaml", "a: *b"), nullptr);
  EXPECT_EQ(mesh_format_names(), "Gmsh (.msh), Abaqus or CalculiX (.inp) or STL (.stl)");
  EXPECT_EQ(read_mesh(bricks, "a.inp").nodes.size(), 12u);
}

}  // namespace
}  // namespace osculate::io
