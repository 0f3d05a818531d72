#include "osculate/mesh/check.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "facet_sample.hpp"

namespace osculate::mesh::testing {
namespace {

Mesh square(CellType type = CellType::quad4) {
  Mesh mesh;
  Edges::append(mesh, "b", 0, 1, 2, 2, type);
  return mesh;
}

void expect_one(const Mesh& mesh, Flaw flaw, bool is_error, const std::string& message) {
  const std::vector<Finding> findings = check_mesh(mesh);
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_EQ(findings[0].flaw, flaw);
  EXPECT_EQ(findings[0].is_error, is_error);
  EXPECT_EQ(findings[0].message, message);
}

TEST(Check, GeneratedMeshesHaveNoFlaws) {
  for (const CellType type : area_types)
    EXPECT_THAT(check_mesh(square(type)), IsEmpty()) << cell::info(type).name;
}

TEST(Check, UnusedNode) {
  Mesh mesh = square();
  mesh.nodes.emplace_back(7, 8, 0);
  mesh.blocks.push_back({CellType::point1, {9}});
  expect_one(mesh, Flaw::unused_node, false, "1 node(s) of no line or area cell: 10 (7, 8)");
}

TEST(Check, OnlyTheFirstExamplesAreListed) {
  Mesh mesh = square();
  for (int i = 0; i < 8; ++i) mesh.nodes.emplace_back(i, 0, 0);
  expect_one(mesh, Flaw::unused_node, false,
             "8 node(s) of no line or area cell: 10 (0, 0), 11 (1, 0), 12 (2, 0), 13 (3, 0), "
             "14 (4, 0), ...");
}

TEST(Check, CoordinateThatIsNoNumber) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity(), -1e101}) {
    for (int k = 0; k < 3; ++k) {
      Mesh mesh = square();
      mesh.nodes[4][k] = bad;
      const std::vector<Finding> findings = check_mesh(mesh);
      ASSERT_THAT(findings, SizeIs(1));
      EXPECT_EQ(findings[0].flaw, Flaw::not_finite);
      EXPECT_TRUE(findings[0].is_error);
    }
  }
}

TEST(Check, CellsThatAreThereTwiceInWhateverOrder) {
  Mesh mesh = square();
  std::vector<Index>& quads = mesh.blocks[0].connectivity;
  const std::vector<Index> turned{quads[6], quads[7], quads[4], quads[5]};
  quads.insert(quads.end(), turned.begin(), turned.end());
  expect_one(mesh, Flaw::duplicate_area, true,
             "1 area cell(s) that are there twice: quad4 on nodes 6 5 2 3");
}

TEST(Check, LinesThatAreThereTwiceAreAWarning) {
  Mesh mesh = square();
  std::vector<Index>& lines = mesh.blocks[1].connectivity;
  lines.push_back(lines[1]);
  lines.push_back(lines[0]);
  expect_one(mesh, Flaw::duplicate_line, false,
             "1 line cell(s) that are there twice: line2 on nodes 4 1");
}

TEST(Check, CellThatNamesANodeTwice) {
  Mesh mesh = square();
  mesh.blocks[0].connectivity[2] = mesh.blocks[0].connectivity[0];
  expect_one(mesh, Flaw::repeated_node, true,
             "1 cell(s) that name a node twice: quad4 on nodes 1 2 1 4");
}

// ---- in space -----------------------------------------------------------------------------------

Mesh cube(CellType type = CellType::hex8) { return box_mesh<Faces>(type, 2, 1); }

TEST(CheckSpace, JacobianOfABrickIsAnEighthOfItsVolume) {
  const Mesh mesh = cube(CellType::hex27);
  EXPECT_NEAR(smallest_jacobian(mesh, {0, 0}), 0.125, 1e-15);
}

TEST(CheckSpace, UnusedNode) {
  Mesh mesh = cube();
  mesh.nodes.emplace_back(7, 8, 0);
  expect_one(mesh, Flaw::unused_node, false, "1 node(s) of no cell: 13 (7, 8, 0)");
}

TEST(CheckSpace, MirroredCellsAreInsideOut) {
  for (const CellType type : volume_types) {
    Mesh mesh = cube(type);
    EXPECT_THAT(check_mesh(mesh), IsEmpty());
    for (Vec3& x : mesh.nodes) x.y() = -x.y();
    const std::vector<Finding> findings = check_mesh(mesh);
    ASSERT_THAT(findings, SizeIs(1)) << cell::info(type).name;
    EXPECT_EQ(findings[0].flaw, Flaw::inside_out);
    EXPECT_TRUE(findings[0].is_error);
    EXPECT_EQ(findings[0].count, mesh.find_set("b")->cells.size());
  }
}

TEST(CheckSpace, OneCornerPushedThroughTheCellIsNamed) {
  Mesh mesh = cube();
  mesh.nodes[0] = {1.5, 0.75, 0.75};
  const std::vector<Finding> findings = check_mesh(mesh);
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_EQ(findings[0].flaw, Flaw::inside_out);
  EXPECT_EQ(findings[0].count, 1);
  EXPECT_THAT(findings[0].message,
              ::testing::HasSubstr("hex8 on nodes 1 2 5 4 7 8 11 10 (smallest Jacobian -"));
}

// One of second order may be so at a node where it has no point.
TEST(CheckSpace, CornerOfSecondOrderIsAWarning) {
  Mesh mesh = cube(CellType::tet10);
  const Index* const nodes = mesh.blocks[0].cell(0);
  const Vec3 corner = mesh.nodes[static_cast<std::size_t>(nodes[0])];
  Vec3& middle = mesh.nodes[static_cast<std::size_t>(nodes[4])];  // between the corners 0 and 1
  middle = corner + 0.4 * (middle - corner);
  const std::vector<Finding> findings = check_mesh(mesh);
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_EQ(findings[0].flaw, Flaw::folded);
  EXPECT_FALSE(findings[0].is_error);
}

TEST(CheckSpace, FlatCellIsFound) {
  Mesh mesh = cube(CellType::tet4);
  for (Vec3& x : mesh.nodes) x.z() = 0;
  const std::vector<Finding> findings = check_mesh(mesh);
  EXPECT_EQ(findings.at(0).flaw, Flaw::inside_out);
  EXPECT_EQ(findings.at(1).flaw, Flaw::double_node);
}

TEST(CheckSpace, VolumesThatAreThereTwice) {
  Mesh mesh = cube();
  std::vector<Index>& hexes = mesh.blocks[0].connectivity;
  const std::vector<Index> first(hexes.begin(), hexes.begin() + 8);
  hexes.insert(hexes.end(), first.begin(), first.end());
  expect_one(mesh, Flaw::duplicate_volume, true,
             "1 volume cell(s) that are there twice: hex8 on nodes 1 2 5 4 7 8 11 10");
}

TEST(CheckSpace, NodesOfOneBodyAtTheSamePlace) {
  Mesh mesh;
  for (const double x : {0.0, 1.0}) {
    SolidBoxSpec spec;
    spec.name = x == 0 ? "a" : "c";
    spec.breaks = {{{x, x + 1}, {0, 1}, {0, 1}}};
    spec.elements = {{{1}, {1}, {1}}};
    append_solid_box(mesh, spec);
  }
  EXPECT_THAT(check_mesh(mesh), IsEmpty());  // two bodies that touch
  Set whole{"whole", 3, {{0, 0}, {0, 1}}, {}};
  for (Index i = 0; i < 16; ++i) whole.nodes.push_back(i);
  mesh.sets.push_back(whole);
  expect_one(mesh, Flaw::double_node, false,
             "4 pair(s) of nodes of one body at the same place, so that it may not hang together: "
             "2 and 9 (1, 0, 0) of 'whole', 6 and 13 (1, 0, 1) of 'whole', 4 and 11 (1, 1, 0) of "
             "'whole', 8 and 15 (1, 1, 1) of 'whole'");
}

/// Two boxes side by side in one set, with `n` cells along the edge of the second.
Mesh not_merged(int n) {
  Mesh mesh;
  for (const double x : {0.0, 1.0}) {
    BoxSpec spec;
    spec.name = x == 0 ? "a" : "c";
    spec.x = {x, x + 1};
    spec.y = {0, 1};
    spec.nx = {1};
    spec.ny = {x == 0 ? 1 : n};
    append_box(mesh, spec);
  }
  EXPECT_THAT(check_mesh(mesh), IsEmpty());  // two bodies that touch
  Set whole{"whole", 2, {}, {}};
  for (Index b = 0; b < static_cast<Index>(mesh.blocks.size()); ++b)
    if (cell::info(mesh.blocks[static_cast<std::size_t>(b)].type).dimension == 2)
      for (Index k = 0; k < mesh.blocks[static_cast<std::size_t>(b)].size(); ++k)
        whole.cells.push_back({b, k});
  for (Index i = 0; i < static_cast<Index>(mesh.nodes.size()); ++i) whole.nodes.push_back(i);
  mesh.sets.push_back(whole);
  return mesh;
}

TEST(Check, NodesOfOneBodyAtTheSamePlaceOfThePlane) {
  expect_one(not_merged(1), Flaw::double_node, false,
             "2 pair(s) of nodes of one body at the same place, so that it may not hang together: "
             "2 and 5 (1, 0) of 'whole', 4 and 7 (1, 1) of 'whole'");
}

TEST(Check, NodesOnEdgesOfOtherCells) {
  const std::vector<Finding> findings = check_mesh(not_merged(2));
  ASSERT_THAT(findings, SizeIs(2));
  EXPECT_EQ(findings[1].flaw, Flaw::hanging_node);
  EXPECT_EQ(findings[1].message,
            "1 node(s) on an edge of another cell of their body, so that it may not hang together: "
            "7 (1, 0.5) of 'whole'");
}

TEST(Check, PartsOfOneSetThatAreInContactAreMeantToTouch) {
  for (const int cells : {1, 2}) {
    const Mesh mesh = not_merged(cells);
    // Those of the left square and of the right one.
    ContactSides sides{std::vector<bool>(mesh.nodes.size()), std::vector<bool>(mesh.nodes.size())};
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) sides[n < 4 ? 0 : 1][n] = true;
    EXPECT_THAT(check_mesh(mesh, std::span(&sides, 1)), IsEmpty());
    sides[0][1] = false;  // (1, 0): the end of one side, beyond which the bodies touch as well
    EXPECT_THAT(check_mesh(mesh, std::span(&sides, 1)), IsEmpty());
    const ContactSides other{sides[0], std::vector<bool>(mesh.nodes.size())};
    EXPECT_THAT(check_mesh(mesh, std::span(&other, 1)), SizeIs(cells));  // of another body
  }
}

TEST(Check, TrianglesOverAQuadrilateral) {
  Mesh mesh = square();
  const std::vector<Index> quad(mesh.blocks[0].connectivity.begin(),
                                mesh.blocks[0].connectivity.begin() + 4);
  const auto block = static_cast<Index>(mesh.blocks.size());
  mesh.blocks.push_back({CellType::tri3, {quad[0], quad[1], quad[2], quad[0], quad[2], quad[3]}});
  for (Set& set : mesh.sets)
    if (set.name == "b") set.cells.insert(set.cells.end(), {{block, 0}, {block, 1}});
  const std::vector<Finding> findings = check_mesh(mesh);
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_EQ(findings[0].flaw, Flaw::overlap);
  EXPECT_EQ(findings[0].count, 4u);
}

TEST(Check, SetWithoutNodes) {
  Mesh mesh = square();
  mesh.sets.push_back({"nothing", 1, {}, {}});
  expect_one(mesh, Flaw::empty_set, false, "1 set(s) without nodes: 'nothing'");
}

TEST(Check, ReferencesToNothing) {
  const auto count = [](const Mesh& mesh) {
    const std::vector<Finding> findings = check_mesh(mesh);
    return findings.size() == 1 && findings[0].flaw == Flaw::bad_index ? findings[0].count : 0;
  };
  Mesh mesh = square();
  mesh.blocks[0].connectivity[3] = 9;
  EXPECT_EQ(count(mesh), 1);
  mesh.blocks[0].connectivity[2] = -1;
  EXPECT_EQ(count(mesh), 2);
  mesh.blocks[0].connectivity.pop_back();
  EXPECT_EQ(count(mesh), 4);  // an incomplete cell, and the last cell of the set is gone
  mesh.sets[0].nodes.push_back(99);
  EXPECT_EQ(count(mesh), 5);
  mesh.sets[0].cells.push_back({5, 0});
  EXPECT_EQ(count(mesh), 6);
}

}  // namespace
}  // namespace osculate::mesh::testing
