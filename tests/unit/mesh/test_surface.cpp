#include "osculate/mesh/surface.hpp"

#include <gtest/gtest.h>

#include "facet_sample.hpp"

namespace osculate::mesh::testing {
namespace {

TEST(Surface, LineSetIsAnError) {
  const Mesh mesh = box_mesh<Faces>();
  EXPECT_THAT(surface_of(mesh, face_table(mesh), *mesh.find_set("b.top_left")).errors,
              ElementsAre("set 'b.top_left' is made of lines; a surface in space is made of areas, "
                          "volumes or nodes"));
}

TEST(Surface, TableFindsParents) {
  const Mesh mesh = box_mesh<Faces>(CellType::hex8, 2, 1);
  const FaceTable table = face_table(mesh);
  EXPECT_THAT(table.find(std::array<Index, 4>{10, 1, 4, 7}), SizeIs(2));
  EXPECT_THAT(table.find(std::array<Index, 4>{0, 3, 6, 9}), SizeIs(1));
  EXPECT_THAT(table.find(std::array<Index, 3>{0, 3, 6}), IsEmpty());
}

TEST(Surface, AreaThatDoesNotFitTheFaceBehindItIsAnError) {
  Mesh mesh = box_mesh<Faces>(CellType::hex20);
  const Set top = *mesh.find_set("b.top");
  nodes_of(mesh, top.cells[0])[5] = 0;
  EXPECT_THAT(orient_surface(mesh, top).errors, ElementsAre(HasSubstr("in another order")));
  mesh = box_mesh<Faces>(CellType::hex27);
  const Set& side = set_of(mesh, "b.top");
  const std::span<const Index> quad9 = nodes_of(mesh, side.cells[0]);
  const std::vector<Index> corners(quad9.begin(), quad9.begin() + 4);
  mesh.blocks.push_back({CellType::quad4, corners});
  const Set linear{"t", 2, {{static_cast<Index>(mesh.blocks.size()) - 1, 0}}, {}};
  EXPECT_THAT(orient_surface(mesh, linear).errors,
              ElementsAre(HasSubstr("the face of the cell behind it is a quad9")));
}

TEST(Surface, AreaOfACellWithoutVolumeIsAnError) {
  Mesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  mesh.blocks = {{CellType::tet4, {0, 1, 2, 3}}, {CellType::tri3, {0, 1, 2}}};
  mesh.sets = {{"v", 3, {{0, 0}}, {}}, {"a", 2, {{1, 0}}, {}}};
  EXPECT_EQ(handedness(mesh, {0, 0}), 0);
  EXPECT_THAT(orient_surface(mesh, mesh.sets[1]).errors, ElementsAre(HasSubstr("no volume")));
  EXPECT_THAT(surface_facets(mesh, mesh.sets[0]).errors, SizeIs(4));
}

// ---- rigid surfaces -----------------------------------------------------------------------------

Mesh sheet(int n) {
  Mesh mesh;
  GridSpec spec;
  spec.name = "g";
  spec.elements = {n, n};
  append_grid(mesh, spec);
  return mesh;
}

TEST(RigidSurface, KeepsItsOrientation) {
  Mesh mesh = sheet(3);
  for (const bool reversed : {false, true}) {
    if (reversed)
      for (const CellRef ref : mesh.find_set("g")->cells) Faces::reverse(mesh, ref);
    const Surface surface = orient_surface(mesh, *mesh.find_set("g"));
    EXPECT_THAT(surface.errors, IsEmpty());
    EXPECT_THAT(surface.warnings, IsEmpty());
    ASSERT_THAT(surface.facets, SizeIs(9));
    for (const SurfaceFacet& facet : surface.facets) {
      EXPECT_FALSE(facet.flipped || facet.has_parent());
      EXPECT_EQ(Faces::normal(mesh, facet).z(), reversed ? -1 : 1);
    }
    EXPECT_THAT(surface.facets[4].next, ::testing::UnorderedElementsAre(1, 3, 5, 7));
  }
}

TEST(RigidSurface, FollowsTheMajority) {
  for (const int turned : {4, 5}) {
    Mesh mesh = sheet(3);
    for (int c = 0; c < turned; ++c)
      Faces::reverse(mesh, mesh.find_set("g")->cells[static_cast<std::size_t>(c)]);
    const Surface surface = orient_surface(mesh, *mesh.find_set("g"));
    EXPECT_THAT(surface.errors, IsEmpty());
    EXPECT_THAT(surface.warnings, ElementsAre("4 of 9 areas were turned round so that neighbours "
                                              "face the same side"));
    for (const SurfaceFacet& facet : surface.facets)
      EXPECT_EQ(Faces::normal(mesh, facet).z(), turned == 4 ? 1 : -1);
    EXPECT_THAT(surface.branching, IsEmpty());
  }
}

TEST(RigidSurface, FollowsTheFirstAreaInCaseOfATie) {
  Mesh mesh = sheet(2);
  for (const std::size_t c : {0U, 3U}) Faces::reverse(mesh, mesh.find_set("g")->cells[c]);
  for (const SurfaceFacet& facet : orient_surface(mesh, *mesh.find_set("g")).facets)
    EXPECT_EQ(Faces::normal(mesh, facet).z(), -1);
}

TEST(RigidSurface, SeparateSheetsAreOrientedEachForItself) {
  Mesh mesh = sheet(2);
  GridSpec spec;
  spec.name = "h";
  spec.origin = {0, 0, 5};
  spec.v = {0, -1, 0};
  append_grid(mesh, spec);
  Set both = *mesh.find_set("g");
  both.cells.push_back(mesh.find_set("h")->cells[0]);
  const Surface surface = orient_surface(mesh, both);
  EXPECT_THAT(surface.warnings, IsEmpty());
  EXPECT_EQ(Faces::normal(mesh, surface.facets[0]).z(), 1);
  EXPECT_EQ(Faces::normal(mesh, surface.facets[4]).z(), -1);
}

TEST(RigidSurface, MoebiusStripIsAnError) {
  Mesh mesh;
  std::vector<Index> quads;
  constexpr int n = 5;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * 3.14159265358979 * i / n;
    const Vec3 out(std::cos(angle), std::sin(angle), 0);
    const Vec3 across = 0.3 * (std::cos(angle / 2) * out + std::sin(angle / 2) * Vec3::UnitZ());
    mesh.nodes.push_back(out - across);
    mesh.nodes.push_back(out + across);
    const Index a = 2 * i;
    const bool last = i + 1 == n;
    quads.insert(quads.end(), {a, last ? 1 : a + 2, last ? 0 : a + 3, a + 1});
  }
  mesh.blocks = {{CellType::quad4, quads}};
  Set strip{"strip", 2, {}, {}};
  for (Index c = 0; c < n; ++c) strip.cells.push_back({0, c});
  EXPECT_THAT(orient_surface(mesh, strip).errors,
              ElementsAre(HasSubstr("set 'strip': the surface has no two sides (like a Moebius")));
  strip.cells.pop_back();
  EXPECT_THAT(orient_surface(mesh, strip).errors, IsEmpty());
}

TEST(RigidSurface, BranchingEdgesAreReportedAndUnlinked) {
  Mesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}};
  mesh.blocks = {{CellType::tri3, {0, 1, 2, 1, 0, 3, 0, 1, 4}}};
  const Set set{"fin", 2, {{0, 0}, {0, 1}, {0, 2}}, {}};
  const Surface surface = orient_surface(mesh, set);
  EXPECT_THAT(surface.errors, IsEmpty());
  EXPECT_THAT(surface.branching, ElementsAre(std::array<Index, 2>{0, 1}));
  EXPECT_THAT(surface.warnings, ElementsAre("3 facets meet along the edge from node 1 (0, 0) to "
                                            "node 2 (1, 0)"));
  for (const SurfaceFacet& facet : surface.facets)
    EXPECT_THAT(facet.next, ElementsAre(-1, -1, -1, -1));
}

TEST(Surface, ReversedAreasKeepTheirFirstNode) {
  std::vector<Index> nodes{0, 1, 2, 3, 4, 5, 6, 7, 8};
  reverse_area(CellType::quad9, nodes);
  EXPECT_THAT(nodes, ElementsAre(0, 3, 2, 1, 7, 6, 5, 4, 8));
  std::vector<Index> six{0, 1, 2, 3, 4, 5};
  reverse_area(CellType::tri6, six);
  EXPECT_THAT(six, ElementsAre(0, 2, 1, 5, 4, 3));
}

}  // namespace
}  // namespace osculate::mesh::testing
