#include "osculate/result/report_view.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "packed_values.hpp"

namespace osculate::result {
namespace {

/// A row of hexahedra: all 4 (cells + 1) nodes are on its surface.
model::Model3 row_of(Index cells) {
  model::Model3 m;
  for (Index i = 0; i <= cells; ++i)
    for (const auto& [y, z] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
      m.reference.emplace_back(i, y, z);
  mesh::Block block{cell::CellType::hex8, {}};
  model::BulkSection3 section;
  for (Index i = 0; i < cells; ++i) {
    const Index a = 4 * i, b = a + 4;
    block.connectivity.insert(block.connectivity.end(),
                              {a, b, b + 1, a + 1, a + 3, b + 3, b + 2, a + 2});
    section.cells.push_back({0, i});
  }
  m.mesh.nodes = m.reference;
  m.mesh.blocks.push_back(std::move(block));
  m.sections.push_back(std::move(section));
  return m;
}

TEST(ReportView3, OneCellHasSixFaces) {
  const model::Model3 m = row_of(1);
  const ReportView<3> view(m);
  const nlohmann::json mesh = view.mesh();
  EXPECT_EQ(mesh["points"]["shape"], (std::vector<int>{8, 3}));
  ASSERT_EQ(mesh["cells"].size(), 1u);
  EXPECT_EQ(mesh["cells"][0]["connectivity"].size(), 24u);
  EXPECT_EQ(view.max_frames(), 60u);
}

/// Fourteen values a point and frame, at most eight million.
TEST(ReportView3, FramesKeepToTheirBudget) {
  const model::Model3 large = row_of(27'999);
  EXPECT_EQ(ReportView<3>(large).max_frames(), 5u);
  const model::Model3 limit = row_of(71'427);
  EXPECT_EQ(ReportView<3>(limit).max_frames(), 2u);
  const model::Model3 too_large = row_of(71'428);
  const ReportView<3> nothing(too_large);
  EXPECT_EQ(nothing.max_frames(), 0u);
  EXPECT_EQ(nothing.mesh(), (nlohmann::json{{"dimension", 3}}));
}

/// Nodes that no body has (of a tool, say) and inner faces are not sent.
TEST(ReportView3, OnlyWhatCanBeSeenIsSent) {
  model::Model3 m = row_of(3);
  m.reference.emplace_back(9, 9, 9);
  m.mesh.nodes = m.reference;
  m.rigid.push_back({"tool", Vec3::Zero(), {16}, {}, {}, {}, {}});
  m.body_of_node.assign(m.reference.size(), -1);
  m.body_of_node.back() = 0;
  const nlohmann::json mesh = ReportView<3>(m).mesh();
  EXPECT_EQ(mesh["points"]["shape"], (std::vector<int>{16, 3}));
  EXPECT_EQ(mesh["cells"][0]["connectivity"].size(), 4u * (3 * 4 + 2));
}

/// A plane is shown by a square around the bodies that goes with its rigid body.
TEST(ReportView3, APlaneIsASquare) {
  model::Model3 m = row_of(1);
  m.rigid.push_back(
      {"floor", Vec3::Zero(), {}, geometry::Plane{{0, 0, -1}, {0, 0, 2}}, {}, {}, {}});
  const nlohmann::json mesh = ReportView<3>(m).mesh();
  EXPECT_EQ(mesh["points"]["shape"], (std::vector<int>{12, 3}));
  ASSERT_EQ(mesh["cells"].size(), 2u);
  EXPECT_EQ(mesh["cells"][1]["rigid"], true);
  EXPECT_EQ(mesh["cells"][1]["endless"], true);
  EXPECT_EQ(mesh["cells"][1]["connectivity"], (std::vector<int>{8, 9, 10, 11}));
}

/// Each rigid body is a block of its own, and the view is told which of them have no end.
TEST(ReportView3, RigidBodiesAreBlocksOfTheirOwn) {
  model::Model3 m = row_of(1);
  const geometry::Sphere ball{{0, 0, 3}, 0.5};
  m.rigid.push_back({"ball", Vec3::Zero(), {}, ball, {}, {}, {}});
  m.rigid.push_back(
      {"floor", Vec3::Zero(), {}, geometry::Plane{{0, 0, -1}, {0, 0, 2}}, {}, {}, {}});
  const nlohmann::json mesh = ReportView<3>(m).mesh();
  ASSERT_EQ(mesh["cells"].size(), 3u);
  EXPECT_FALSE(mesh["cells"][1].contains("endless"));
  EXPECT_EQ(mesh["cells"][1]["connectivity"].size(), 4u * 32 * 16);
  EXPECT_EQ(mesh["cells"][2]["endless"], true);
  EXPECT_EQ(mesh["cells"][2]["connectivity"].size(), 4u);
}

/// Round shapes are shown whole, endless ones near the model; every corner is on the surface.
TEST(ReportView3, AnalyticShapesAreQuadrilateralsOnThem) {
  const auto corners = [](const geometry::Surface& shape) {
    model::Model3 m = row_of(1);
    m.rigid.push_back({"tool", Vec3::Zero(), {}, shape, {}, {}, {}});
    const nlohmann::json mesh = ReportView<3>(m).mesh();
    const std::vector<float> values = support::decoded(mesh["points"]);
    std::vector<Vec3> out;
    for (std::size_t i = 8; 3 * i < values.size(); ++i)
      out.emplace_back(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
    return out;
  };
  const std::vector<Vec3> ball = corners(geometry::Sphere{{1, 2, 3}, 2});
  EXPECT_EQ(ball.size(), 4u * 32 * 16);
  for (const Vec3& x : ball) EXPECT_NEAR((x - Vec3(1, 2, 3)).norm(), 2, 1e-6);
  const std::vector<Vec3> roll = corners(geometry::Cylinder{{0, 0, -3}, {2, 0, 0}, 2});
  EXPECT_EQ(roll.size(), 4u * 48);
  for (const Vec3& x : roll) {
    EXPECT_NEAR(std::hypot(x.y(), x.z() + 3), 2, 1e-6);
    EXPECT_LT(std::abs(x.x() - 0.5), 1.1);
  }
  const std::vector<Vec3> cone = corners(geometry::Cone{{0, 0, -1}, {0, 0, -1}, 0.25, false, 0, 5});
  for (const Vec3& x : cone) EXPECT_LE(x.z(), -1);
  EXPECT_EQ(corners(geometry::Torus{{0, 0, 5}, {0, 0, 1}, 2, 1}).size(), 4u * 48 * 24);
}

/// The faces of meshed rigid bodies are those of their contact surfaces.
TEST(ReportView3, ARigidMeshIsItsContactSurface) {
  model::Model3 m = row_of(1);
  const auto first = static_cast<Index>(m.reference.size());
  for (const auto& [x, y] : {std::pair{0, 0}, {2, 0}, {2, 2}, {0, 2}})
    m.reference.emplace_back(x, y, -1);
  m.mesh.nodes = m.reference;
  m.body_of_node.assign(m.reference.size(), -1);
  model::ContactPair3 pair;
  const std::array<Index, 4> nodes{first, first + 1, first + 2, first + 3};
  for (const Index n : nodes) m.body_of_node[static_cast<std::size_t>(n)] = 0;
  pair.definition.master.facets.push_back(pairing::surface_facet(cell::CellType::quad4, nodes));
  m.pairs.push_back(pair);
  m.rigid.push_back({"tool", Vec3::Zero(), {nodes.begin(), nodes.end()}, {}, {}, {}, {}});
  const nlohmann::json mesh = ReportView<3>(m).mesh();
  ASSERT_EQ(mesh["cells"].size(), 2u);
  EXPECT_EQ(mesh["cells"][1]["rigid"], true);
  EXPECT_EQ(mesh["cells"][1]["connectivity"], (std::vector<int>{8, 9, 10, 11}));
}

/// What a section cuts through is sent where it leaves twenty frames.
TEST(ReportView3, CellsAreSentForSectionsWhereTheyFit) {
  const model::Model3 m = row_of(3);
  const nlohmann::json mesh = ReportView<3>(m).mesh();
  ASSERT_EQ(mesh["volumes"].size(), 1u);
  EXPECT_EQ(mesh["volumes"][0]["type"], "hex8");
  EXPECT_EQ(mesh["volumes"][0]["connectivity"].size(), 24u);
  EXPECT_EQ(mesh["volumes"][0]["body"], 0);
  const model::Model3 large = row_of(7'143);
  EXPECT_FALSE(ReportView<3>(large).mesh().contains("volumes"));
}

/// The page hides bodies, and labels sets and nodes as the user calls them.
TEST(ReportView3, BodiesSetsAndNumbersAreNamed) {
  model::Model3 m = row_of(2);
  m.mesh.numbers = {11, 12, 13, 14, 21, 22, 23, 24, 31, 32, 33, 34};
  m.sections[0].name = "bar";
  m.mesh.sets.push_back({"end", 2, {}, {8, 9, 10, 11}});
  const geometry::Sphere ball{{0, 0, 3}, 0.5};
  m.rigid.push_back({"ball", Vec3::Zero(), {}, ball, {}, {}, {}});
  const nlohmann::json mesh = ReportView<3>(m).mesh();
  EXPECT_EQ(mesh["bodies"], (std::vector<std::string>{"bar", "ball"}));
  EXPECT_EQ(mesh["cells"][0]["body"], 0);
  EXPECT_EQ(mesh["cells"][1]["body"], 1);
  EXPECT_EQ(mesh["numbers"], m.mesh.numbers);
  ASSERT_EQ(mesh["sets"].size(), 1u);
  EXPECT_EQ(mesh["sets"][0]["name"], "end");
  EXPECT_EQ(mesh["sets"][0]["points"], (std::vector<int>{8, 9, 10, 11}));
}

/// Three sides of a square, as lines in any order, move as one rigid body: a line from end to end.
TEST(ReportView2, ARigidSetOfNodesIsDrawnAsItsFacets) {
  model::Model m;
  for (const Vec2& x : {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1), Vec2(0.5, 0)}) {
    m.reference.push_back(x);
    m.mesh.nodes.emplace_back(x.x(), x.y(), 0);
  }
  m.mesh.blocks.push_back({cell::CellType::line2, {2, 3, 1, 2}});
  m.mesh.blocks.push_back({cell::CellType::line3, {0, 1, 4}});
  m.rigid.resize(1);
  m.rigid[0].nodes = {0, 1, 2, 3, 4};
  m.body_of_node.assign(5, 0);
  model::State state;
  state.u = Eigen::VectorXd::Zero(10);
  state.rigid.resize(1);
  const nlohmann::json rigid = ReportView<2>(m).last_iterate(state, {})["rigid"];
  ASSERT_EQ(rigid.size(), 1u);
  EXPECT_EQ(rigid[0]["polyline"],
            nlohmann::json::parse("[[0.0,0.0],[0.5,0.0],[1.0,0.0],[1.0,1.0],[0.0,1.0]]"));
}

/// Nodes without line cells are drawn as the free edges they span, a node alone as itself.
TEST(ReportView2, ARigidSetWithoutLinesIsDrawnAsFreeEdges) {
  model::Model m;
  for (const Vec2& x : {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1), Vec2(9, 9)}) {
    m.reference.push_back(x);
    m.mesh.nodes.emplace_back(x.x(), x.y(), 0);
  }
  m.mesh.blocks.push_back({cell::CellType::quad4, {0, 1, 2, 3}});
  m.rigid.resize(1);
  m.rigid[0].nodes = {0, 2, 1, 4};
  m.body_of_node = {0, 0, 0, -1, 0};
  model::State state;
  state.u = Eigen::VectorXd::Zero(10);
  state.rigid.resize(1);
  const nlohmann::json rigid = ReportView<2>(m).last_iterate(state, {})["rigid"];
  ASSERT_EQ(rigid.size(), 2u);
  EXPECT_EQ(rigid[0]["polyline"], nlohmann::json::parse("[[0.0,0.0],[1.0,0.0],[1.0,1.0]]"));
  EXPECT_EQ(rigid[1]["polyline"], nlohmann::json::parse("[[9.0,9.0]]"));
}

/// A line without ends is drawn beside the mesh wherever that has moved, and moves with its body.
TEST(ReportView2, LinesWithoutEndsGoAlongWithTheMesh) {
  model::Model m;
  for (int n = 0; n < 4; ++n) {
    m.reference.emplace_back(n % 2, n / 2);
    m.mesh.nodes.emplace_back(n % 2, n / 2, 0);
  }
  m.mesh.blocks.push_back({cell::CellType::quad4, {0, 1, 3, 2}});
  m.rigid.resize(1);
  m.rigid[0].shape = geometry::InfiniteLine{{0, -1}, Vec2(0.6, 0.8)};
  model::State state;
  state.u.resize(8);
  for (int n = 0; n < 4; ++n) state.u.segment<2>(2 * n) = Vec2(70, -30);
  state.rigid.resize(1);
  state.rigid[0].reference = Vec2(2, 3);
  state.rigid[0].translation = Vec2(5, 1);
  state.rigid[0].angle = 0.3;
  const nlohmann::json drawn = ReportView<2>(m).last_iterate(state, {})["rigid"][0]["polyline"];
  const Vec2 along =
      Vec2(std::cos(0.3) * 0.8 + std::sin(0.3) * 0.6, std::sin(0.3) * 0.8 - std::cos(0.3) * 0.6);
  const Vec2 place = state.rigid[0].position(Vec2(0, -1));
  double first = 1e9, last = -1e9, off = 0;
  for (const auto& point : drawn) {
    const Vec2 arm = Vec2(point[0], point[1]) - place;
    first = std::min(first, arm.dot(along));
    last = std::max(last, arm.dot(along));
    off = std::max(off, std::abs(along.x() * arm.y() - along.y() * arm.x()));
  }
  EXPECT_LT(off, 1e-12);
  for (int n = 0; n < 4; ++n) {
    const double at = (m.reference[static_cast<std::size_t>(n)] + Vec2(70, -30) - place).dot(along);
    EXPECT_GT(at, first);
    EXPECT_LT(at, last);
    EXPECT_LT(last - first, 4);
  }
}

}  // namespace
}  // namespace osculate::result
