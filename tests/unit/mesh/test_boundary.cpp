#include "osculate/mesh/boundary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "osculate/mesh/generate.hpp"

namespace osculate::mesh {
namespace {

using cell::CellType;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

BoxSpec box(const std::string& name, double x0, double x1, int nx, int ny, CellType type) {
  BoxSpec spec;
  spec.name = name;
  spec.x = {x0, x1};
  spec.y = {0, 1};
  spec.nx = {nx};
  spec.ny = {ny};
  spec.type = type;
  return spec;
}

Mesh box_mesh(CellType type) {
  Mesh mesh;
  append_box(mesh, box("b", 0, 2, 3, 2, type));
  return mesh;
}

Set& set_of(Mesh& mesh, const std::string& name) {
  return *std::find_if(mesh.sets.begin(), mesh.sets.end(),
                       [&](const Set& set) { return set.name == name; });
}

Vec2 at(const Mesh& mesh, Index node) {
  return mesh.nodes[static_cast<std::size_t>(node)].head<2>();
}

/// k x (end - start): the normal that must point out of the body.
Vec2 normal(const Mesh& mesh, const BoundaryFacet& facet) {
  return turn(at(mesh, facet.node[1]) - at(mesh, facet.node[0]));
}

/// Area enclosed counterclockwise by straight facets.
double enclosed(const Mesh& mesh, const Boundary& boundary) {
  double twice = 0;
  for (const BoundaryFacet& facet : boundary.facets) {
    const Vec2 a = at(mesh, facet.node[0]);
    const Vec2 b = at(mesh, facet.node[1]);
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

/// Every cell walked the other way round.
void number_clockwise(Mesh& mesh) {
  for (Block& block : mesh.blocks) {
    const cell::CellInfo& info = cell::info(block.type);
    if (info.dimension != 2) continue;
    const auto corners = info.corners;
    for (Index c = 0; c < block.size(); ++c) {
      Index* n = block.connectivity.data() + c * info.nodes;
      std::reverse(n + 1, n + corners);
      if (info.order == 2) std::reverse(n + corners, n + 2 * corners);
    }
  }
}

void reverse_line(Mesh& mesh, CellRef ref) {
  Block& block = mesh.blocks[static_cast<std::size_t>(ref.block)];
  const auto first = static_cast<std::size_t>(ref.cell * cell::info(block.type).nodes);
  std::swap(block.connectivity[first], block.connectivity[first + 1]);
}

class BoundaryOf : public ::testing::TestWithParam<CellType> {};
INSTANTIATE_TEST_SUITE_P(Types, BoundaryOf,
                         ::testing::Values(CellType::tri3, CellType::tri6, CellType::quad4,
                                           CellType::quad8, CellType::quad9),
                         [](const auto& tested) {
                           return std::string(cell::info(tested.param).name);
                         });

TEST_P(BoundaryOf, NormalsOfTheSidesPointOutwards) {
  for (const bool clockwise : {false, true}) {
    Mesh mesh = box_mesh(GetParam());
    if (clockwise) number_clockwise(mesh);
    const std::vector<std::pair<std::string, Vec2>> sides{
        {"b.left", {-1, 0}}, {"b.right", {1, 0}}, {"b.bottom", {0, -1}}, {"b.top", {0, 1}}};
    for (const auto& [name, outward] : sides) {
      const Boundary boundary = orient_boundary(mesh, *mesh.find_set(name));
      EXPECT_THAT(boundary.errors, IsEmpty());
      ASSERT_EQ(boundary.facets.size(), mesh.find_set(name)->cells.size());
      for (const BoundaryFacet& facet : boundary.facets) {
        EXPECT_DOUBLE_EQ(normal(mesh, facet).normalized().dot(outward), 1.0) << name;
        EXPECT_TRUE(facet.has_parent());
        EXPECT_FALSE(facet.flipped);  // the generator directs them itself
      }
    }
  }
}

TEST_P(BoundaryOf, DirectionOfTheFileDoesNotMatter) {
  Mesh mesh = box_mesh(GetParam());
  const Boundary before = orient_boundary(mesh, *mesh.find_set("b.top"));
  const Set top = *mesh.find_set("b.top");
  reverse_line(mesh, top.cells[1]);
  const Boundary after = orient_boundary(mesh, top);
  ASSERT_EQ(before.facets.size(), after.facets.size());
  for (std::size_t f = 0; f < after.facets.size(); ++f) {
    EXPECT_EQ(before.facets[f].node, after.facets[f].node);
    EXPECT_EQ(after.facets[f].flipped, f == 1);
    EXPECT_EQ(before.facets[f].next, after.facets[f].next);
  }
}

TEST_P(BoundaryOf, FreeEdgesCloseAndEncloseTheBodyClockwise) {
  for (const bool clockwise : {false, true}) {
    Mesh mesh = box_mesh(GetParam());
    if (clockwise) number_clockwise(mesh);
    const Boundary boundary = boundary_facets(mesh, *mesh.find_set("b"));
    EXPECT_THAT(boundary.errors, IsEmpty());
    EXPECT_THAT(boundary.warnings, IsEmpty());
    ASSERT_THAT(boundary.facets, SizeIs(10));
    EXPECT_DOUBLE_EQ(enclosed(mesh, boundary), -2.0);
    Index f = 0;
    std::set<Index> seen;
    for (int k = 0; k < 10; ++k) {
      seen.insert(f);
      const BoundaryFacet& facet = boundary.facets[static_cast<std::size_t>(f)];
      const BoundaryFacet& next = boundary.facets[static_cast<std::size_t>(facet.next)];
      EXPECT_EQ(facet.node[1], next.node[0]);
      EXPECT_EQ(next.prev, f);
      f = facet.next;
    }
    EXPECT_EQ(f, 0);
    EXPECT_THAT(seen, SizeIs(10));
  }
}

TEST_P(BoundaryOf, LinesAndFreeEdgesAgree) {
  const Mesh mesh = box_mesh(GetParam());
  std::set<std::array<Index, 4>> lines;
  for (const char* name : {"b.left", "b.right", "b.bottom", "b.top"})
    for (const BoundaryFacet& facet : orient_boundary(mesh, *mesh.find_set(name)).facets)
      lines.insert(facet.node);
  std::set<std::array<Index, 4>> edges;
  for (const BoundaryFacet& facet : boundary_facets(mesh, *mesh.find_set("b")).facets)
    edges.insert(facet.node);
  EXPECT_EQ(lines, edges);
}

TEST_P(BoundaryOf, NodesOfASideGiveTheSide) {
  const Mesh mesh = box_mesh(GetParam());
  const EdgeTable table = edge_table(mesh);
  const Set* top = mesh.find_set("b.top");
  const Boundary by_nodes = facets_of_nodes(mesh, table, top->nodes);
  EXPECT_THAT(by_nodes.warnings, IsEmpty());
  std::set<std::array<Index, 4>> a;
  std::set<std::array<Index, 4>> b;
  for (const BoundaryFacet& facet : by_nodes.facets) a.insert(facet.node);
  for (const BoundaryFacet& facet : orient_boundary(mesh, table, *top).facets) b.insert(facet.node);
  EXPECT_EQ(a, b);
}

TEST(Boundary, NodeThatIsOnNoEdgeIsNamed) {
  const Mesh mesh = box_mesh(CellType::quad4);
  std::vector<Index> nodes = mesh.find_set("b.top")->nodes;
  nodes.push_back(0);
  const Boundary boundary = facets_of_nodes(mesh, edge_table(mesh), nodes);
  EXPECT_THAT(boundary.facets, SizeIs(3));
  EXPECT_THAT(boundary.warnings, ElementsAre(HasSubstr("node 1 (0, 0)")));
}

TEST(Boundary, SetsOfAnyDimensionAreSurfaces) {
  Mesh mesh = box_mesh(CellType::quad4);
  const EdgeTable table = edge_table(mesh);
  Set nodes{"n", 0, {}, mesh.find_set("b.left")->nodes};
  EXPECT_THAT(surface_of(mesh, table, nodes).facets, SizeIs(2));
  EXPECT_THAT(surface_of(mesh, table, *mesh.find_set("b.left")).facets, SizeIs(2));
  EXPECT_THAT(surface_of(mesh, table, *mesh.find_set("b")).facets, SizeIs(10));
}

TEST(Boundary, RigidLineKeepsItsDirection) {
  Mesh mesh = box_mesh(CellType::quad4);
  append_line(mesh, {"base", {{3, -1}, {-1, -1}}, {4}, CellType::line3});
  const Boundary boundary = orient_boundary(mesh, *mesh.find_set("base"));
  EXPECT_THAT(boundary.errors, IsEmpty());
  EXPECT_THAT(boundary.warnings, IsEmpty());
  ASSERT_THAT(boundary.facets, SizeIs(4));
  for (std::size_t f = 0; f < 4; ++f) {
    const BoundaryFacet& facet = boundary.facets[f];
    EXPECT_FALSE(facet.has_parent());
    EXPECT_FALSE(facet.flipped);
    EXPECT_LT(normal(mesh, facet).y(), 0);
    EXPECT_EQ(facet.next, f == 3 ? -1 : static_cast<Index>(f) + 1);
    EXPECT_EQ(facet.prev, static_cast<Index>(f) - 1);
  }
}

// One interior line: the middle column of edges of a 2 x 1 box.
TEST(Boundary, InteriorLineIsAnError) {
  Mesh mesh;
  append_box(mesh, box("b", 0, 2, 2, 1, CellType::quad4));
  mesh.blocks.push_back({CellType::line2, {1, 4}});
  const Set set{"middle", 1, {{static_cast<Index>(mesh.blocks.size()) - 1, 0}}, {1, 4}};
  const Boundary boundary = orient_boundary(mesh, set);
  EXPECT_THAT(boundary.facets, IsEmpty());
  EXPECT_THAT(boundary.errors,
              ElementsAre("set 'middle': line from node 2 (1, 0) to node 5 (1, 1) lies inside a "
                          "body: it is an edge of 2 cells"));
}

TEST(Boundary, LineThatIsThereTwiceIsAnError) {
  Mesh mesh = box_mesh(CellType::quad4);
  Set& top = set_of(mesh, "b.top");
  top.cells.push_back(top.cells[0]);
  EXPECT_THAT(orient_boundary(mesh, top).errors, ElementsAre(HasSubstr("is there twice")));
}

TEST(Boundary, LineWithOtherInteriorNodesThanItsParentIsAnError) {
  Mesh mesh = box_mesh(CellType::quad8);
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
  EXPECT_LT(normal(mesh, boundary.facets[0]).y(), 0);
}

TEST(Boundary, MessagesDoNotPileUp) {
  Mesh mesh = box_mesh(CellType::quad4);
  Set set{"many", 1, {}, {}};
  for (int i = 0; i < 100; ++i) set.cells.push_back(mesh.find_set("b.top")->cells[0]);
  EXPECT_THAT(orient_boundary(mesh, set).errors, SizeIs(11));
}

// Two bodies glued along a side through common nodes.
TEST(Boundary, FreedomIsJudgedByTheTable) {
  Mesh mesh;
  append_box(mesh, box("b", 0, 2, 2, 1, CellType::quad4));
  const Set left{"l", 2, {{0, 0}}, {0, 1, 3, 4}};
  EXPECT_THAT(boundary_facets(mesh, edge_table(mesh), left).facets, SizeIs(3));
  EXPECT_THAT(boundary_facets(mesh, edge_table(mesh, left.cells), left).facets, SizeIs(4));
}

TEST(Boundary, TableFindsParents) {
  Mesh mesh;
  append_box(mesh, box("b", 0, 2, 2, 1, CellType::quad4));
  const EdgeTable table = edge_table(mesh);
  EXPECT_THAT(table.find(1, 4), SizeIs(2));
  EXPECT_THAT(table.find(4, 1), SizeIs(2));
  EXPECT_THAT(table.find(0, 1), SizeIs(1));
  EXPECT_THAT(table.find(0, 4), IsEmpty());
}

TEST(Connect, BranchingAndReversedLinesAreReported) {
  Mesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}};
  mesh.blocks = {{CellType::line2, {0, 1, 1, 2, 1, 3}}};
  mesh.sets = {{"fork", 1, {{0, 0}, {0, 1}, {0, 2}}, {0, 1, 2, 3}}};
  const Boundary fork = orient_boundary(mesh, mesh.sets[0]);
  EXPECT_THAT(fork.branching, ElementsAre(1));
  EXPECT_THAT(fork.warnings, ElementsAre("3 lines meet at node 2 (1, 0)"));
  for (const BoundaryFacet& facet : fork.facets) EXPECT_TRUE(facet.next == -1 && facet.prev == -1);
  mesh.blocks[0].connectivity = {0, 1, 2, 1};
  mesh.sets[0].cells.pop_back();
  const Boundary clash = orient_boundary(mesh, mesh.sets[0]);
  EXPECT_THAT(clash.warnings, ElementsAre(HasSubstr("direction of travel changes at node 2")));
}

// Two unit squares that share one node only.
TEST(ConnectedParts, HingeIsOnePartByNodesAndTwoByEdges) {
  Mesh mesh;
  append_box(mesh, box("a", 0, 1, 1, 1, CellType::quad4));
  append_box(mesh, box("c", 1, 2, 1, 1, CellType::quad4));
  const std::vector<CellRef> all{{0, 0}, {0, 1}};
  EXPECT_THAT(connected_parts(mesh, all),
              ElementsAre(ElementsAre(CellRef{0, 0}), ElementsAre(CellRef{0, 1})));
  mesh.blocks[0].connectivity[4] = 3;  // lower left node of c := upper right node of a
  EXPECT_THAT(connected_parts(mesh, all), ElementsAre(SizeIs(2)));
  EXPECT_THAT(connected_parts(mesh, all, Link::side), SizeIs(2));
}

TEST(ConnectedParts, LongChainIsOnePart) {
  Mesh mesh;
  append_box(mesh, box("b", 0, 1, 300, 1, CellType::tri6));
  std::vector<CellRef> cells = mesh.find_set("b")->cells;
  std::reverse(cells.begin(), cells.end());
  const auto parts = connected_parts(mesh, cells, Link::side);
  ASSERT_THAT(parts, SizeIs(1));
  EXPECT_EQ(parts[0], cells);
}

}  // namespace
}  // namespace osculate::mesh
