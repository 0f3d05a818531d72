#include "osculate/mesh/generate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "measure.hpp"
#include "osculate/mesh/boundary.hpp"
#include "osculate/mesh/check.hpp"

namespace osculate::mesh::testing {
namespace {

BoxSpec graded_box(CellType type) {
  BoxSpec spec;
  spec.name = "b";
  spec.x = {0.1, 0.7, 3.0};
  spec.y = {-1, 0.3};
  spec.nx = {3, 2};
  spec.ny = {4};
  spec.bias_x = {5.0, 0.25};
  spec.bias_y = {3.0};
  spec.type = type;
  return spec;
}

Mesh make(const BoxSpec& spec) { return generated(append_box, spec); }

std::vector<Vec2> points_of(const Mesh& mesh, const std::string& set) {
  std::vector<Vec2> points;
  for (const Index node : mesh.find_set(set)->nodes) points.push_back(at(mesh, node).head<2>());
  return points;
}

class BoxOf : public ::testing::TestWithParam<CellType> {};
INSTANTIATE_TEST_SUITE_P(Types, BoxOf, ::testing::ValuesIn(area_types), type_name);

TEST_P(BoxOf, NumbersOfNodesAndCells) {
  const Mesh mesh = make(graded_box(GetParam()));
  const bool is_triangle = cell::info(GetParam()).corners == 3;
  const int order = cell::info(GetParam()).order;
  std::size_t nodes = order == 1 ? 6 * 5 : 11 * 9;
  if (GetParam() == CellType::quad8) nodes -= 5 * 4;
  EXPECT_EQ(mesh.nodes.size(), nodes);
  EXPECT_EQ(mesh.find_set("b")->cells.size(), is_triangle ? 40U : 20U);
  EXPECT_EQ(mesh.find_set("b")->nodes.size(), nodes);
  EXPECT_THAT(mesh.find_set("b.left")->cells, SizeIs(4));
  EXPECT_THAT(mesh.find_set("b.top")->cells, SizeIs(5));
  EXPECT_THAT(check_mesh(mesh), IsEmpty());
}

TEST_P(BoxOf, CellsAreCounterclockwiseAndFillTheBox) {
  const Mesh mesh = make(graded_box(GetParam()));
  double total = 0;
  for (const CellRef ref : mesh.find_set("b")->cells) {
    const double a = area_vector(mesh, ref).z();
    EXPECT_GT(a, 0);
    total += a;
  }
  EXPECT_NEAR(total, 2.9 * 1.3, 1e-14);
}

TEST_P(BoxOf, FurtherNodesLieBetweenCorners) {
  const Mesh mesh = make(graded_box(GetParam()));
  const cell::CellInfo& info = cell::info(GetParam());
  const Block& block = mesh.blocks[0];
  for (Index c = 0; info.order == 2 && c < block.size(); ++c) {
    for (int e = 0; e < info.edge_count; ++e) {
      const auto& edge = info.edges[static_cast<std::size_t>(e)];
      const Vec3 middle =
          0.5 * (at(mesh, block.cell(c)[edge[0]]) + at(mesh, block.cell(c)[edge[1]]));
      EXPECT_LE((at(mesh, block.cell(c)[edge[2]]) - middle).norm(), 1e-15);
    }
    if (info.nodes == 9) {
      const Vec3 middle = 0.5 * (at(mesh, block.cell(c)[0]) + at(mesh, block.cell(c)[2]));
      EXPECT_LE((at(mesh, block.cell(c)[8]) - middle).norm(), 1e-15);
    }
  }
}

TEST_P(BoxOf, CornersAreHitExactly) {
  const Mesh mesh = make(graded_box(GetParam()));
  EXPECT_THAT(points_of(mesh, "b.bottom_left"), ElementsAre(Vec2(0.1, -1)));
  EXPECT_THAT(points_of(mesh, "b.bottom_right"), ElementsAre(Vec2(3.0, -1)));
  EXPECT_THAT(points_of(mesh, "b.top_right"), ElementsAre(Vec2(3.0, 0.3)));
  EXPECT_THAT(points_of(mesh, "b.top_left"), ElementsAre(Vec2(0.1, 0.3)));
  for (const Vec2& p : points_of(mesh, "b.top")) EXPECT_EQ(p.y(), 0.3);
  for (const Vec2& p : points_of(mesh, "b.right")) EXPECT_EQ(p.x(), 3.0);
}

TEST(Box, BiasIsTheRatioOfLastToFirstElement) {
  const Mesh mesh = make(graded_box(CellType::quad4));
  std::vector<double> x;
  for (const Vec2& p : points_of(mesh, "b.bottom")) x.push_back(p.x());
  ASSERT_THAT(x, SizeIs(6));
  EXPECT_EQ(x[3], 0.7);
  EXPECT_NEAR((x[3] - x[2]) / (x[1] - x[0]), 5.0, 1e-13);
  EXPECT_NEAR((x[2] - x[1]) / (x[1] - x[0]), std::sqrt(5.0), 1e-13);
  EXPECT_NEAR((x[5] - x[4]) / (x[4] - x[3]), 0.25, 1e-13);
}

TEST(Box, BiasOneIsExactlyUniform) {
  BoxSpec spec = graded_box(CellType::quad4);
  spec.x = {0, 1};
  spec.nx = {4};
  spec.bias_x = {};
  std::vector<double> x;
  for (const Vec2& p : points_of(make(spec), "b.bottom")) x.push_back(p.x());
  EXPECT_THAT(x, ElementsAre(0, 0.25, 0.5, 0.75, 1));
}

TEST_P(BoxOf, CrownLiesOnTheArcAndTheOtherSideStays) {
  for (const Crown::Side side : {Crown::Side::bottom, Crown::Side::top}) {
    for (const double radius : {4.0, -4.0}) {
      BoxSpec spec = graded_box(GetParam());
      spec.crown = Crown{side, radius, 1.0};
      const Mesh mesh = make(spec);
      const bool bottom = side == Crown::Side::bottom;
      const double y = bottom ? -1 : 0.3;
      const double inward = bottom ? 1 : -1;
      const Vec2 centre(1.0, y + inward * radius);
      for (const Vec2& p : points_of(mesh, bottom ? "b.bottom" : "b.top")) {
        EXPECT_NEAR((p - centre).norm(), 4.0, 1e-14);
        EXPECT_GE((p.y() - y) * inward * radius, 0);
      }
      for (const Vec2& p : points_of(mesh, bottom ? "b.top" : "b.bottom"))
        EXPECT_EQ(p.y(), bottom ? 0.3 : -1);
    }
  }
}

TEST(Box, CrownDecaysLinearly) {
  const Mesh flat = make(graded_box(CellType::quad9));
  BoxSpec spec = graded_box(CellType::quad9);
  spec.crown = Crown{Crown::Side::bottom, 4.0, 1.0};
  const Mesh bent = make(spec);
  for (std::size_t i = 0; i < flat.nodes.size(); ++i) {
    const Vec3& p = flat.nodes[i];
    const double shift = 4.0 - std::sqrt(16.0 - (p.x() - 1) * (p.x() - 1));
    EXPECT_NEAR(bent.nodes[i].y() - p.y(), shift * (0.3 - p.y()) / 1.3, 1e-14);
    EXPECT_EQ(bent.nodes[i].x(), p.x());
  }
}

/// Area between the crown and the chord line y = 0 by the trapezoidal rule or Simpson's.
double crown_integral(CellType type, int n) {
  BoxSpec spec;
  spec.name = "b";
  spec.x = {-1, 1};
  spec.y = {0, 2};
  spec.nx = {n};
  spec.ny = {1};
  spec.type = type;
  spec.crown = Crown{Crown::Side::bottom, 2.0, 0.0};
  const Mesh mesh = make(spec);
  const Set* bottom = mesh.find_set("b.bottom");
  double sum = 0;
  for (const CellRef ref : bottom->cells) {
    const Index* nodes = mesh.blocks[static_cast<std::size_t>(ref.block)].cell(ref.cell);
    const Vec3& a = at(mesh, nodes[0]);
    const Vec3& b = at(mesh, nodes[1]);
    const double h = a.x() - b.x();
    if (cell::info(type).order == 1)
      sum += 0.5 * h * (a.y() + b.y());
    else
      sum += h / 6 * (a.y() + 4 * at(mesh, nodes[2]).y() + b.y());
  }
  return sum;
}

TEST(Box, CrownConvergesWithTheOrderOfTheCells) {
  const double exact = 4.0 - (std::sqrt(3.0) + 4.0 * std::asin(0.5));
  for (const CellType type : area_types) {
    const double coarse = std::abs(crown_integral(type, 16) - exact);
    const double fine = std::abs(crown_integral(type, 32) - exact);
    EXPECT_NEAR(std::log2(coarse / fine), cell::info(type).order == 1 ? 2.0 : 4.0, 0.03);
  }
}

TEST(Box, RightAnglesTurnExactly) {
  BoxSpec spec = graded_box(CellType::quad4);
  const Mesh flat = make(spec);
  spec.about = {1, 2};
  for (const double angle : {90.0, -270.0, 450.0}) {
    spec.angle = angle;
    const Mesh turned = make(spec);
    for (std::size_t i = 0; i < flat.nodes.size(); ++i) {
      const Vec2 arm = flat.nodes[i].head<2>() - spec.about;
      const Vec2 expected = spec.about + turn(arm);
      EXPECT_EQ(turned.nodes[i].head<2>(), expected);
    }
  }
}

TEST(Box, RotationIsRigidAndKeepsTheSidesDirected) {
  BoxSpec spec = graded_box(CellType::quad8);
  const Mesh flat = make(spec);
  spec.angle = 30;
  spec.about = {1, 2};
  const Mesh turned = make(spec);
  const double c = std::cos(std::numbers::pi / 6);
  for (std::size_t i = 0; i < flat.nodes.size(); ++i) {
    const Vec2 arm = flat.nodes[i].head<2>() - spec.about;
    EXPECT_NEAR(turned.nodes[i].x(), 1 + c * arm.x() - 0.5 * arm.y(), 1e-14);
    EXPECT_NEAR(turned.nodes[i].y(), 2 + 0.5 * arm.x() + c * arm.y(), 1e-14);
  }
  for (const BoundaryFacet& facet : orient_boundary(turned, *turned.find_set("b.left")).facets)
    EXPECT_FALSE(facet.flipped);
}

TEST(Box, SeveralShapesShareBlocks) {
  Mesh mesh;
  append_box(mesh, graded_box(CellType::quad4));
  BoxSpec second = graded_box(CellType::quad4);
  second.name = "c";
  append_box(mesh, second);
  append_line(mesh, {"base", {{0, -2}, {3, -2}}, {5}, CellType::line2});
  EXPECT_THAT(mesh.blocks, SizeIs(2));
  EXPECT_THAT(mesh.find_set("c")->cells, SizeIs(20));
  EXPECT_EQ(mesh.find_set("c")->cells[0], (CellRef{0, 20}));
  EXPECT_EQ(mesh.find_set("c")->nodes[0], 30);
  EXPECT_THAT(check_mesh(mesh), IsEmpty());
}

TEST(Line, NodesAndEnds) {
  Mesh mesh;
  append_line(mesh, {"l", {{0, 0}, {1, 0}, {1, 4}}, {2, 4}, CellType::line3});
  EXPECT_THAT(mesh.nodes, SizeIs(13));
  EXPECT_EQ(mesh.nodes[1], Vec3(0.25, 0, 0));
  EXPECT_EQ(mesh.nodes[4], Vec3(1, 0, 0));
  EXPECT_EQ(mesh.nodes[12], Vec3(1, 4, 0));
  EXPECT_THAT(mesh.find_set("l")->cells, SizeIs(6));
  EXPECT_THAT(mesh.find_set("l.start")->nodes, ElementsAre(0));
  EXPECT_THAT(mesh.find_set("l.end")->nodes, ElementsAre(12));
  EXPECT_EQ(mesh.blocks[0].connectivity[2], 1);  // ends first, then the middle
}

TEST(Line, ClosesOnItself) {
  Mesh mesh;
  append_line(mesh, {"l", {{0, 0}, {0, 1}, {1, 0}, {0, 0}}, {1, 1, 1}, CellType::line2});
  EXPECT_THAT(mesh.nodes, SizeIs(3));
  EXPECT_EQ(mesh.blocks[0].connectivity, (std::vector<Index>{0, 1, 1, 2, 2, 0}));
  const Boundary boundary = orient_boundary(mesh, *mesh.find_set("l"));
  EXPECT_EQ(boundary.facets[2].next, 0);
  EXPECT_EQ(boundary.facets[0].prev, 2);
}

// ---- refusals
// -------------------------------------------------------------------------------------

void expect_refusal(const std::function<void(BoxSpec&)>& spoil, const std::string& message) {
  const Mesh before =
      generated(append_line, LineSpec{"old", {{0, 0}, {1, 0}}, {1}, CellType::line2});
  testing::expect_refusal(append_box, graded_box(CellType::quad4), spoil, "box '", message, before);
}

TEST(Box, BadInputIsRefusedAndTheMeshUnchanged) {
  const double nan = std::nan("");
  expect_refusal([](BoxSpec& s) { s.name = ""; }, "needs a name");
  expect_refusal([](BoxSpec& s) { s.name = "old"; }, "already a set of that name");
  expect_refusal([](BoxSpec& s) { s.type = CellType::line2; }, "cannot be made of line2 cells");
  expect_refusal([](BoxSpec& s) { s.x = {1}; }, "x needs at least two values");
  expect_refusal([](BoxSpec& s) { s.x = {0, 2, 1}; }, "x must increase; 1 follows 2");
  expect_refusal([](BoxSpec& s) { s.x = {0, 0, 1}; }, "x must increase; 0 follows 0");
  expect_refusal([&](BoxSpec& s) { s.y = {0, nan}; }, "y must be finite");
  expect_refusal(
      [](BoxSpec& s) {
        s.nx = {3};
        s.bias_x = {};
      },
      "1 numbers of elements in x for 2");
  expect_refusal([](BoxSpec& s) { s.ny = {0}; }, "0 elements in y");
  expect_refusal([](BoxSpec& s) { s.ny = {-5}; }, "-5 elements in y");
  expect_refusal([](BoxSpec& s) { s.bias_x = {1}; }, "1 bias values in x for 2");
  expect_refusal([](BoxSpec& s) { s.bias_y = {0}; }, "bias 0 in y");
  expect_refusal([&](BoxSpec& s) { s.bias_y = {nan}; }, "bias nan in y");
  expect_refusal([&](BoxSpec& s) { s.angle = nan; }, "finite numbers");
  expect_refusal([](BoxSpec& s) { s.crown = Crown{Crown::Side::top, 0, 1}; }, "other than zero");
  expect_refusal([](BoxSpec& s) { s.crown = Crown{Crown::Side::top, 1.5, 1}; }, "radius 1.5");
  expect_refusal([](BoxSpec& s) { s.crown = Crown{Crown::Side::top, 2.0, 1}; }, "opposite side");
}

TEST(Box, SizesBeyondTheLimitAreRefusedBeforeTheyAreAllocated) {
  expect_refusal(
      [](BoxSpec& s) {
        s.nx = {10000, 10000};
        s.ny = {10000};
      },
      "2e+08 nodes");
  expect_refusal(
      [](BoxSpec& s) {
        s.nx = {2000000000, 2000000000};
      },
      "more than 50000000 elements");
  Mesh mesh;
  EXPECT_THROW(append_line(mesh, {"l", {{0, 0}, {1, 0}}, {50000000}, CellType::line2}),
               core::InputError);
}

TEST(Line, BadInputIsRefused) {
  Mesh mesh;
  append_line(mesh, {"l", {{0, 0}, {1, 0}}, {1}, CellType::line2});
  const auto refused = [&](const LineSpec& spec) {
    EXPECT_THROW(append_line(mesh, spec), core::InputError);
    EXPECT_THAT(mesh.nodes, SizeIs(2));
  };
  refused({"l", {{0, 0}, {1, 0}}, {1}, CellType::line2});
  refused({"m", {{0, 0}}, {}, CellType::line2});
  refused({"m", {{0, 0}, {0, 0}}, {1}, CellType::line2});
  refused({"m", {{0, 0}, {std::nan(""), 0}}, {1}, CellType::line2});
  refused({"m", {{0, 0}, {1, 0}}, {1, 1}, CellType::line2});
  refused({"m", {{0, 0}, {1, 0}}, {0}, CellType::line2});
  refused({"m", {{0, 0}, {1, 0}}, {1}, CellType::quad4});
}

}  // namespace
}  // namespace osculate::mesh::testing
