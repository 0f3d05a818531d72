#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>

#include "measure.hpp"
#include "osculate/mesh/check.hpp"
#include "osculate/mesh/surface.hpp"

namespace osculate::mesh::testing {
namespace {

SolidBoxSpec graded_box(CellType type) {
  SolidBoxSpec spec;
  spec.name = "b";
  spec.breaks = {{{0.1, 0.7, 3.0}, {-1, 0.3}, {2, 2.5}}};
  spec.elements = {{{3, 2}, {4}, {2}}};
  spec.bias = {{{5.0, 0.25}, {3.0}, {}}};
  spec.type = type;
  return spec;
}

Mesh make(const SolidBoxSpec& spec) { return generated(append_solid_box, spec); }

class SolidBox : public ::testing::TestWithParam<CellType> {};
INSTANTIATE_TEST_SUITE_P(Types, SolidBox, ::testing::ValuesIn(volume_types), type_name);

TEST_P(SolidBox, NumbersOfNodesAndCells) {
  const Mesh mesh = make(graded_box(GetParam()));
  const std::size_t bricks = 5 * 4 * 2;
  const std::size_t corners = 6 * 5 * 3;
  const std::size_t edges = 5 * 5 * 3 + 6 * 4 * 3 + 6 * 5 * 2;  // along x, y, z
  std::size_t nodes = corners;
  std::size_t cells = bricks;
  std::size_t left = 4 * 2, top = 5 * 4;
  switch (GetParam()) {
    case CellType::tet4:
      cells *= 6, left *= 2, top *= 2;
      break;
    case CellType::tet10:
      nodes = 11 * 9 * 5;  // one on every edge, diagonal of a rectangle, diagonal of a brick
      cells *= 6, left *= 2, top *= 2;
      break;
    case CellType::wedge6:
      cells *= 2, top *= 2;
      break;
    case CellType::wedge15:
      nodes = corners + edges + 5 * 4 * 3;  // diagonals of the horizontal rectangles
      cells *= 2, top *= 2;
      break;
    case CellType::hex20:
      nodes = corners + edges;
      break;
    case CellType::hex27:
      nodes = 11 * 9 * 5;
      break;
    case CellType::shell18:
      nodes = 11 * 9 * 3;
      break;
    default:
      break;
  }
  EXPECT_EQ(mesh.nodes.size(), nodes);
  EXPECT_EQ(mesh.find_set("b")->cells.size(), cells);
  EXPECT_EQ(mesh.find_set("b")->nodes.size(), nodes);
  EXPECT_EQ(mesh.find_set("b")->dimension, 3);
  EXPECT_THAT(mesh.find_set("b.left")->cells, SizeIs(left));
  EXPECT_THAT(mesh.find_set("b.top")->cells, SizeIs(top));
  EXPECT_EQ(mesh.find_set("b.top")->dimension, 2);
  EXPECT_THAT(check_mesh(mesh), IsEmpty());
}

TEST_P(SolidBox, CellsHavePositiveVolumesThatFillTheBox) {
  const Mesh mesh = make(graded_box(GetParam()));
  double total = 0;
  for (const CellRef ref : mesh.find_set("b")->cells) {
    EXPECT_EQ(handedness(mesh, ref), 1);
    EXPECT_GT(smallest_jacobian(mesh, ref), 0);
    total += volume_of(mesh, ref);
  }
  EXPECT_NEAR(total, 2.9 * 1.3 * 0.5, 1e-14);
}

TEST_P(SolidBox, SidesPointOutwardsAndBelongToTheirCells) {
  const Mesh mesh = make(graded_box(GetParam()));
  const std::vector<std::pair<std::string, Vec3>> sides{
      {"b.left", {-0.65, 0, 0}}, {"b.right", {0.65, 0, 0}},   {"b.front", {0, -1.45, 0}},
      {"b.back", {0, 1.45, 0}},  {"b.bottom", {0, 0, -3.77}}, {"b.top", {0, 0, 3.77}}};
  std::size_t facets = 0;
  for (const auto& [name, area] : sides) {
    EXPECT_LE((area_of_set(mesh, name) - area).norm(), 1e-14) << name;
    const Surface surface = orient_surface(mesh, *mesh.find_set(name));
    EXPECT_THAT(surface.errors, IsEmpty()) << name;
    EXPECT_THAT(surface.warnings, IsEmpty()) << name;
    EXPECT_EQ(surface.facets.size(), mesh.find_set(name)->cells.size());
    for (const SurfaceFacet& facet : surface.facets)
      EXPECT_TRUE(facet.has_parent() && !facet.flipped) << name;
    facets += surface.facets.size();
  }
  EXPECT_EQ(surface_facets(mesh, *mesh.find_set("b")).facets.size(), facets);
}

TEST_P(SolidBox, SidesAreHitExactlyAndHaveAllTheirNodes) {
  const Mesh mesh = make(graded_box(GetParam()));
  const auto count = [&](int axis, double value) {
    return std::count_if(mesh.nodes.begin(), mesh.nodes.end(),
                         [&](const Vec3& x) { return x[axis] == value; });
  };
  const auto size = [&](const char* name) {
    return static_cast<std::ptrdiff_t>(mesh.find_set(name)->nodes.size());
  };
  EXPECT_EQ(size("b.left"), count(0, 0.1));
  EXPECT_EQ(size("b.right"), count(0, 3.0));
  EXPECT_EQ(size("b.front"), count(1, -1));
  EXPECT_EQ(size("b.back"), count(1, 0.3));
  EXPECT_EQ(size("b.bottom"), count(2, 2));
  EXPECT_EQ(size("b.top"), count(2, 2.5));
}

TEST_P(SolidBox, EdgesAndCornersAreWhatTheirNamesSay) {
  const Mesh mesh = make(graded_box(GetParam()));
  const std::vector<std::pair<std::string, Vec3>> corners{
      {"b.bottom_front_left", {0.1, -1, 2}}, {"b.bottom_front_right", {3, -1, 2}},
      {"b.bottom_back_left", {0.1, 0.3, 2}}, {"b.bottom_back_right", {3, 0.3, 2}},
      {"b.top_front_left", {0.1, -1, 2.5}},  {"b.top_front_right", {3, -1, 2.5}},
      {"b.top_back_left", {0.1, 0.3, 2.5}},  {"b.top_back_right", {3, 0.3, 2.5}}};
  for (const auto& [name, x] : corners) {
    ASSERT_NE(mesh.find_set(name), nullptr) << name;
    ASSERT_THAT(mesh.find_set(name)->nodes, SizeIs(1)) << name;
    EXPECT_EQ(at(mesh, mesh.find_set(name)->nodes[0]), x) << name;
  }
  const auto check = [&](const std::string& name, int axis, const Vec3& from, const Vec3& to) {
    const Set* const set = mesh.find_set(name);
    ASSERT_NE(set, nullptr) << name;
    EXPECT_EQ(set->dimension, 1);
    const std::size_t n = axis == 0 ? 5 : axis == 1 ? 4 : 2;
    ASSERT_THAT(set->cells, SizeIs(n)) << name;
    const auto end = [&](std::size_t c, int k) {
      const CellRef ref = set->cells[c];
      return at(mesh, mesh.blocks[static_cast<std::size_t>(ref.block)].cell(ref.cell)[k]);
    };
    EXPECT_EQ(end(0, 0), from) << name;
    EXPECT_EQ(end(n - 1, 1), to) << name;
  };
  check("b.bottom_front", 0, {0.1, -1, 2}, {3, -1, 2});
  check("b.top_back", 0, {0.1, 0.3, 2.5}, {3, 0.3, 2.5});
  check("b.bottom_right", 1, {3, -1, 2}, {3, 0.3, 2});
  check("b.top_left", 1, {0.1, -1, 2.5}, {0.1, 0.3, 2.5});
  check("b.front_right", 2, {3, -1, 2}, {3, -1, 2.5});
  check("b.back_left", 2, {0.1, 0.3, 2}, {0.1, 0.3, 2.5});
  EXPECT_THAT(mesh.sets, SizeIs(1 + 6 + 12 + 8));
}

// The middle of an edge, face or cell of a straight cell is the mean of the corners around it.
TEST_P(SolidBox, FurtherNodesLieInTheMiddle) {
  const Mesh mesh = make(graded_box(GetParam()));
  const cell::CellInfo& info = cell::info(GetParam());
  for (const CellRef ref : mesh.find_set("b")->cells) {
    const Index* const nodes = mesh.blocks[static_cast<std::size_t>(ref.block)].cell(ref.cell);
    for (int f = 0; f < info.face_count; ++f) {
      const cell::CellFace& face = info.faces[static_cast<std::size_t>(f)];
      const cell::CellInfo& area = cell::info(face.type);
      if (area.order == 1) continue;
      const auto n = static_cast<std::size_t>(area.corners);
      Vec3 mean = Vec3::Zero();
      for (std::size_t k = 0; k < n; ++k) {
        const Vec3& a = at(mesh, nodes[face.nodes[k]]);
        const Vec3& b = at(mesh, nodes[face.nodes[(k + 1) % n]]);
        EXPECT_LE((at(mesh, nodes[face.nodes[n + k]]) - 0.5 * (a + b)).norm(), 1e-15);
        mean += a / static_cast<double>(n);
      }
      if (area.nodes == 9) {
        EXPECT_LE((at(mesh, nodes[face.nodes[8]]) - mean).norm(), 1e-15);
      }
    }
  }
}

TEST_P(SolidBox, TurnsAboutAnyAxis) {
  SolidBoxSpec spec = graded_box(GetParam());
  const Mesh straight = make(spec);
  spec.axis = {0, -3, 0};
  spec.about = {1, 7, 2};
  spec.angle = 90;
  const Mesh turned = make(spec);
  for (std::size_t i = 0; i < straight.nodes.size(); ++i) {
    const Vec3 arm = straight.nodes[i] - spec.about;
    const Vec3 expected(1 - arm.z(), 7 + arm.y(), 2 + arm.x());
    EXPECT_LE((turned.nodes[i] - expected).norm(), 1e-15);
  }
  EXPECT_THAT(check_mesh(turned), IsEmpty());
}

TEST(SolidBoxes, ShareBlocksAndLeaveFurtherNodesApart) {
  Mesh mesh;
  append_solid_box(mesh, graded_box(CellType::hex8));
  SolidBoxSpec second = graded_box(CellType::hex8);
  second.name = "c";
  append_solid_box(mesh, second);
  EXPECT_EQ(mesh.find_set("c")->cells[0], (CellRef{0, 40}));
  EXPECT_EQ(mesh.find_set("c")->nodes[0], 90);
  EXPECT_THAT(mesh.blocks, SizeIs(3));
  EXPECT_THAT(check_mesh(mesh), IsEmpty());
}

void expect_refusal(const std::function<void(SolidBoxSpec&)>& spoil, const std::string& message) {
  Mesh before;
  before.sets.push_back({"old.top", 2, {}, {0}});
  testing::expect_refusal(append_solid_box, graded_box(CellType::hex8), spoil, "box '", message,
                          before);
}

TEST(SolidBoxes, BadInputIsRefusedAndTheMeshUnchanged) {
  const double nan = std::nan("");
  expect_refusal([](SolidBoxSpec& s) { s.name = "old"; }, "already a set 'old.top'");
  expect_refusal([](SolidBoxSpec& s) { s.type = CellType::quad4; },
                 "cannot be made of quad4 cells with three coordinates");
  expect_refusal([](SolidBoxSpec& s) { s.breaks[2] = {1}; }, "z needs at least two values");
  expect_refusal([](SolidBoxSpec& s) { s.breaks[2] = {1, 1}; }, "z must increase; 1 follows 1");
  expect_refusal([&](SolidBoxSpec& s) { s.breaks[1] = {0, nan}; }, "y must be finite");
  expect_refusal([](SolidBoxSpec& s) { s.elements[2] = {1, 2}; }, "2 numbers of elements in z");
  expect_refusal([](SolidBoxSpec& s) { s.elements[2] = {0}; }, "0 elements in z");
  expect_refusal([](SolidBoxSpec& s) { s.bias[2] = {1, 2}; }, "2 bias values in z for 1");
  expect_refusal([](SolidBoxSpec& s) { s.axis = {0, 0, 0}; }, "must have a direction");
  expect_refusal([&](SolidBoxSpec& s) { s.angle = nan; }, "finite numbers");
  expect_refusal([](SolidBoxSpec& s) { s.elements = {{{2000, 2}, {2000}, {2000}}}; }, "e+09 nodes");
}

}  // namespace
}  // namespace osculate::mesh::testing
