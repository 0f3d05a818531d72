#include "osculate/mesh/boundary.hpp"

#include <gtest/gtest.h>

#include "facet_sample.hpp"

namespace osculate::mesh::testing {
namespace {

TEST(Boundary, RigidLineKeepsItsDirection) {
  Mesh mesh = box_mesh<Edges>(CellType::quad4);
  append_line(mesh, {"base", {{3, -1}, {-1, -1}}, {4}, CellType::line3});
  const Boundary boundary = orient_boundary(mesh, *mesh.find_set("base"));
  EXPECT_THAT(boundary.errors, IsEmpty());
  EXPECT_THAT(boundary.warnings, IsEmpty());
  ASSERT_THAT(boundary.facets, SizeIs(4));
  for (std::size_t f = 0; f < 4; ++f) {
    const BoundaryFacet& facet = boundary.facets[f];
    EXPECT_FALSE(facet.has_parent());
    EXPECT_FALSE(facet.flipped);
    EXPECT_LT(Edges::normal(mesh, facet).y(), 0);
    EXPECT_EQ(facet.next, f == 3 ? -1 : static_cast<Index>(f) + 1);
    EXPECT_EQ(facet.prev, static_cast<Index>(f) - 1);
  }
}

TEST(Boundary, LineWithOtherInteriorNodesThanItsParentIsAnError) {
  Mesh mesh = box_mesh<Edges>(CellType::quad8);
  const Set top = *mesh.find_set("b.top");
  Block& lines = mesh.blocks[static_cast<std::size_t>(top.cells[0].block)];
  lines.connectivity[static_cast<std::size_t>(3 * top.cells[0].cell + 2)] = 0;
  EXPECT_THAT(orient_boundary(mesh, top).errors, ElementsAre(HasSubstr("other interior nodes")));
}

TEST(Boundary, LineOfACellWithoutAreaIsAnError) {
  Mesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  mesh.blocks = {{CellType::tri3, {0, 1, 2}}, {CellType::line2, {0, 1}}};
  mesh.sets = {{"a", 2, {{0, 0}}, {0, 1, 2}}, {"l", 1, {{1, 0}}, {0, 1}}};
  EXPECT_THAT(orient_boundary(mesh, mesh.sets[1]).errors, ElementsAre(HasSubstr("no area")));
  EXPECT_THAT(boundary_facets(mesh, mesh.sets[0]).errors, SizeIs(3));
}

// The corners are on one line; the area lies between the bent edges only.
TEST(Boundary, BentEdgesCountForTheSideOfTheBody) {
  Mesh mesh;
  mesh.nodes = {{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {1, -1, 0}, {1.5, 0.5, 0}, {0.5, 0.5, 0}};
  mesh.blocks = {{CellType::tri6, {0, 1, 2, 3, 4, 5}}};
  const Set set{"a", 2, {{0, 0}}, {0, 1, 2, 3, 4, 5}};
  const Boundary boundary = boundary_facets(mesh, set);
  ASSERT_THAT(boundary.facets, SizeIs(3));
  EXPECT_THAT(boundary.facets[0].nodes(), ElementsAre(1, 0, 3));
  EXPECT_LT(Edges::normal(mesh, boundary.facets[0]).y(), 0);
}

TEST(Boundary, TableFindsParents) {
  const Mesh mesh = box_mesh<Edges>(CellType::quad4, 2, 1);
  const EdgeTable table = edge_table(mesh);
  EXPECT_THAT(table.find(1, 4), SizeIs(2));
  EXPECT_THAT(table.find(4, 1), SizeIs(2));
  EXPECT_THAT(table.find(0, 1), SizeIs(1));
  EXPECT_THAT(table.find(0, 4), IsEmpty());
}

TEST(Connect, BranchingIsReported) {
  Mesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}};
  mesh.blocks = {{CellType::line2, {0, 1, 1, 2, 1, 3}}};
  mesh.sets = {{"fork", 1, {{0, 0}, {0, 1}, {0, 2}}, {0, 1, 2, 3}}};
  const Boundary fork = orient_boundary(mesh, mesh.sets[0]);
  EXPECT_THAT(fork.branching, ElementsAre(1));
  EXPECT_THAT(fork.warnings, ElementsAre("3 lines meet at node 2 (1, 0)"));
  for (const BoundaryFacet& facet : fork.facets) EXPECT_TRUE(facet.next == -1 && facet.prev == -1);
}

// Lines of a rigid wall that the mesher numbered both ways.
TEST(Connect, LinesWithoutCellsTravelAsMostOfThem) {
  Mesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 1, 0}};
  mesh.blocks = {{CellType::line2, {1, 0, 1, 2, 3, 2}}};
  mesh.sets = {{"wall", 1, {{0, 0}, {0, 1}, {0, 2}}, {0, 1, 2, 3}}};
  const Boundary wall = orient_boundary(mesh, mesh.sets[0]);
  EXPECT_THAT(wall.warnings, ElementsAre(HasSubstr("1 of 3 lines were turned round")));
  ASSERT_THAT(wall.facets, SizeIs(3));
  EXPECT_EQ(wall.facets[1].node[0], 2);
  EXPECT_EQ(wall.facets[1].next, 0);
  EXPECT_EQ(wall.facets[2].next, 1);
}

// Two unit squares that share one node only.
TEST(ConnectedParts, HingeIsOnePartByNodesAndTwoByEdges) {
  Mesh mesh;
  Edges::append(mesh, "a", 0, 1, 1, 1, CellType::quad4);
  Edges::append(mesh, "c", 1, 2, 1, 1, CellType::quad4);
  const std::vector<CellRef> all{{0, 0}, {0, 1}};
  EXPECT_THAT(connected_parts(mesh, all),
              ElementsAre(ElementsAre(CellRef{0, 0}), ElementsAre(CellRef{0, 1})));
  mesh.blocks[0].connectivity[4] = 3;  // lower left node of c := upper right node of a
  EXPECT_THAT(connected_parts(mesh, all), ElementsAre(SizeIs(2)));
  EXPECT_THAT(connected_parts(mesh, all, Link::side), SizeIs(2));
}

TEST(ConnectedParts, LongChainIsOnePart) {
  Mesh mesh;
  Edges::append(mesh, "b", 0, 1, 300, 1, CellType::tri6);
  std::vector<CellRef> cells = mesh.find_set("b")->cells;
  std::reverse(cells.begin(), cells.end());
  const auto parts = connected_parts(mesh, cells, Link::side);
  ASSERT_THAT(parts, SizeIs(1));
  EXPECT_EQ(parts[0], cells);
}

}  // namespace
}  // namespace osculate::mesh::testing
