#include "osculate/mesh/surface.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <set>

#include "osculate/mesh/generate_space.hpp"

namespace osculate::mesh {
namespace {

using cell::CellType;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

SolidBoxSpec box(const std::string& name, double x0, double x1, int nx, CellType type) {
  SolidBoxSpec spec;
  spec.name = name;
  spec.breaks = {{{x0, x1}, {0, 1}, {0, 1}}};
  spec.elements = {{{nx}, {2}, {2}}};
  spec.type = type;
  return spec;
}

Mesh box_mesh(CellType type) {
  Mesh mesh;
  append_solid_box(mesh, box("b", 0, 2, 3, type));
  return mesh;
}

const Vec3& at(const Mesh& mesh, Index node) { return mesh.nodes[static_cast<std::size_t>(node)]; }

Set& set_of(Mesh& mesh, const std::string& name) {
  return *std::find_if(mesh.sets.begin(), mesh.sets.end(),
                       [&](const Set& set) { return set.name == name; });
}

Vec3 normal(const Mesh& mesh, const SurfaceFacet& facet) {
  const Vec3& a = at(mesh, facet.node[0]);
  return (at(mesh, facet.node[1]) - a).cross(at(mesh, facet.node[2]) - a).normalized();
}

std::span<Index> nodes_of(Mesh& mesh, CellRef ref) {
  Block& block = mesh.blocks[static_cast<std::size_t>(ref.block)];
  const auto n = static_cast<std::size_t>(cell::info(block.type).nodes);
  return std::span(block.connectivity).subspan(static_cast<std::size_t>(ref.cell) * n, n);
}

void reverse(Mesh& mesh, CellRef ref) {
  reverse_area(mesh.blocks[static_cast<std::size_t>(ref.block)].type, nodes_of(mesh, ref));
}

/// The mesh seen in a mirror: every volume cell is inside out.
void mirror(Mesh& mesh) {
  for (Vec3& x : mesh.nodes) x.z() = -x.z();
}

using Key = std::set<Index>;
std::set<Key> keys(const std::vector<SurfaceFacet>& facets) {
  std::set<Key> out;
  for (const SurfaceFacet& facet : facets)
    out.insert(Key(facet.nodes().begin(), facet.nodes().end()));
  return out;
}

class SurfaceOf : public ::testing::TestWithParam<CellType> {};
INSTANTIATE_TEST_SUITE_P(Types, SurfaceOf,
                         ::testing::Values(CellType::tet4, CellType::tet10, CellType::wedge6,
                                           CellType::wedge15, CellType::hex8, CellType::hex20,
                                           CellType::hex27, CellType::shell18),
                         [](const auto& tested) {
                           return std::string(cell::info(tested.param).name);
                         });

TEST_P(SurfaceOf, NormalsPointOutOfTheBody) {
  for (const bool mirrored : {false, true}) {
    Mesh mesh = box_mesh(GetParam());
    if (mirrored) mirror(mesh);
    const double up = mirrored ? -1 : 1;
    const std::vector<std::pair<std::string, Vec3>> sides{
        {"b.left", {-1, 0, 0}}, {"b.right", {1, 0, 0}},    {"b.front", {0, -1, 0}},
        {"b.back", {0, 1, 0}},  {"b.bottom", {0, 0, -up}}, {"b.top", {0, 0, up}}};
    for (const auto& [name, outward] : sides) {
      const Surface surface = orient_surface(mesh, *mesh.find_set(name));
      EXPECT_THAT(surface.errors, IsEmpty());
      ASSERT_EQ(surface.facets.size(), mesh.find_set(name)->cells.size());
      for (const SurfaceFacet& facet : surface.facets) {
        EXPECT_NEAR(normal(mesh, facet).dot(outward), 1, 1e-15) << name;
        EXPECT_EQ(facet.flipped, mirrored);
        EXPECT_EQ(handedness(mesh, facet.parent), mirrored ? -1 : 1);
      }
    }
  }
}

TEST_P(SurfaceOf, OrientationAndFirstNodeOfTheFileDoNotMatter) {
  Mesh mesh = box_mesh(GetParam());
  const Set top = *mesh.find_set("b.top");
  const Surface before = orient_surface(mesh, top);
  const cell::CellInfo& info = cell::info(before.facets[0].type);
  // the second facet backwards, the third one from another corner
  reverse(mesh, top.cells[1]);
  const std::span<Index> third = nodes_of(mesh, top.cells[2]);
  std::rotate(third.begin(), third.begin() + 1, third.begin() + info.corners);
  if (info.order == 2)
    std::rotate(third.begin() + info.corners, third.begin() + info.corners + 1,
                third.begin() + 2 * info.corners);
  const Surface after = orient_surface(mesh, top);
  EXPECT_THAT(after.errors, IsEmpty());
  ASSERT_EQ(before.facets.size(), after.facets.size());
  EXPECT_EQ(before.facets[1].node, after.facets[1].node);
  EXPECT_TRUE(after.facets[1].flipped);
  EXPECT_FALSE(after.facets[2].flipped);
  EXPECT_EQ(after.facets[2].node[0], before.facets[2].node[1]);
  for (const SurfaceFacet& facet : after.facets) EXPECT_GT(normal(mesh, facet).z(), 0.9);
}

TEST_P(SurfaceOf, FreeFacesCloseAndHaveNeighboursEverywhere) {
  for (const bool mirrored : {false, true}) {
    Mesh mesh = box_mesh(GetParam());
    if (mirrored) mirror(mesh);
    const Surface surface = surface_facets(mesh, *mesh.find_set("b"));
    EXPECT_THAT(surface.errors, IsEmpty());
    EXPECT_THAT(surface.warnings, IsEmpty());
    double six_volumes = 0;
    for (std::size_t f = 0; f < surface.facets.size(); ++f) {
      const SurfaceFacet& facet = surface.facets[f];
      const std::span<const Index> c = facet.corners();
      for (std::size_t k = 2; k < c.size(); ++k)
        six_volumes += at(mesh, c[0]).dot(at(mesh, c[k - 1]).cross(at(mesh, c[k])));
      for (std::size_t k = 0; k < c.size(); ++k) {
        ASSERT_GE(facet.next[k], 0);
        const SurfaceFacet& other = surface.facets[static_cast<std::size_t>(facet.next[k])];
        EXPECT_THAT(other.next, ::testing::Contains(static_cast<Index>(f)));
        EXPECT_THAT(other.corners(), ::testing::Contains(c[k]));
        EXPECT_THAT(other.corners(), ::testing::Contains(c[(k + 1) % c.size()]));
      }
    }
    EXPECT_NEAR(six_volumes, 12, 1e-14);
  }
}

TEST_P(SurfaceOf, AreasAndFreeFacesAgree) {
  const Mesh mesh = box_mesh(GetParam());
  std::set<Key> areas;
  for (const char* name : {"b.left", "b.right", "b.front", "b.back", "b.bottom", "b.top"})
    areas.merge(keys(orient_surface(mesh, *mesh.find_set(name)).facets));
  EXPECT_EQ(areas, keys(surface_facets(mesh, *mesh.find_set("b")).facets));
}

TEST_P(SurfaceOf, NodesOfASideGiveTheSide) {
  const Mesh mesh = box_mesh(GetParam());
  const FaceTable table = face_table(mesh);
  const Set& top = *mesh.find_set("b.top");
  const Surface by_nodes = faces_of_nodes(mesh, table, top.nodes);
  EXPECT_THAT(by_nodes.warnings, IsEmpty());
  EXPECT_EQ(keys(by_nodes.facets), keys(orient_surface(mesh, table, top).facets));
}

TEST_P(SurfaceOf, PartsHangTogether) {
  Mesh mesh = box_mesh(GetParam());
  append_solid_box(mesh, box("c", 5, 6, 1, GetParam()));
  std::vector<CellRef> cells = mesh.find_set("c")->cells;
  const std::size_t second = cells.size();
  cells.insert(cells.end(), mesh.find_set("b")->cells.begin(), mesh.find_set("b")->cells.end());
  for (const Link link : {Link::node, Link::side}) {
    const auto parts = connected_parts(mesh, cells, link);
    ASSERT_THAT(parts, SizeIs(2));
    EXPECT_THAT(parts[0], SizeIs(second));
  }
}

TEST(Surface, NodeThatIsOnNoFaceIsNamed) {
  const Mesh mesh = box_mesh(CellType::hex8);
  std::vector<Index> nodes = mesh.find_set("b.top")->nodes;
  nodes.push_back(0);
  const Surface surface = faces_of_nodes(mesh, face_table(mesh), nodes);
  EXPECT_THAT(surface.facets, SizeIs(6));
  EXPECT_THAT(surface.warnings, ElementsAre("node 1 (0, 0, 0) is on no free face with all its "
                                            "nodes in the set"));
}

TEST(Surface, SetsOfMostDimensionsAreSurfaces) {
  const Mesh mesh = box_mesh(CellType::hex8);
  const FaceTable table = face_table(mesh);
  const Set nodes{"n", 0, {}, mesh.find_set("b.left")->nodes};
  EXPECT_THAT(surface_of(mesh, table, nodes).facets, SizeIs(4));
  EXPECT_THAT(surface_of(mesh, table, *mesh.find_set("b.left")).facets, SizeIs(4));
  EXPECT_THAT(surface_of(mesh, table, *mesh.find_set("b")).facets, SizeIs(32));
  EXPECT_THAT(surface_of(mesh, table, *mesh.find_set("b.top_left")).errors,
              ElementsAre("set 'b.top_left' is made of lines; a surface in space is made of areas, "
                          "volumes or nodes"));
}

// Two cubes glued along a side through common nodes.
TEST(Surface, FreedomIsJudgedByTheTable) {
  Mesh mesh;
  SolidBoxSpec spec = box("b", 0, 2, 2, CellType::hex8);
  spec.elements = {{{2}, {1}, {1}}};
  append_solid_box(mesh, spec);
  const Set left{"l", 3, {{0, 0}}, {}};
  EXPECT_THAT(surface_facets(mesh, left).facets, SizeIs(5));
  EXPECT_THAT(surface_facets(mesh, face_table(mesh, left.cells), left).facets, SizeIs(6));
  const FaceTable table = face_table(mesh);
  EXPECT_THAT(table.find(std::array<Index, 4>{10, 1, 4, 7}), SizeIs(2));
  EXPECT_THAT(table.find(std::array<Index, 4>{0, 3, 6, 9}), SizeIs(1));
  EXPECT_THAT(table.find(std::array<Index, 3>{0, 3, 6}), IsEmpty());
}

TEST(Surface, AreaInsideABodyIsAnError) {
  Mesh mesh;
  SolidBoxSpec spec = box("b", 0, 2, 2, CellType::hex8);
  spec.elements = {{{2}, {1}, {1}}};
  append_solid_box(mesh, spec);
  mesh.blocks.push_back({CellType::quad4, {1, 4, 10, 7}});
  const Set set{"middle", 2, {{static_cast<Index>(mesh.blocks.size()) - 1, 0}}, {1, 4, 7, 10}};
  const Surface surface = orient_surface(mesh, set);
  EXPECT_THAT(surface.facets, IsEmpty());
  EXPECT_THAT(surface.errors,
              ElementsAre("set 'middle': quad4 on nodes 2 5 11 8 at node 2 (1, 0, 0) lies inside a "
                          "body: it is a face of 2 cells"));
}

TEST(Surface, AreaThatIsThereTwiceIsAnError) {
  Mesh mesh = box_mesh(CellType::tet4);
  Set& top = set_of(mesh, "b.top");
  top.cells.push_back(top.cells[0]);
  EXPECT_THAT(orient_surface(mesh, top).errors, ElementsAre(HasSubstr("is there twice")));
}

TEST(Surface, AreaThatDoesNotFitTheFaceBehindItIsAnError) {
  Mesh mesh = box_mesh(CellType::hex20);
  const Set top = *mesh.find_set("b.top");
  nodes_of(mesh, top.cells[0])[5] = 0;
  EXPECT_THAT(orient_surface(mesh, top).errors, ElementsAre(HasSubstr("in another order")));
  mesh = box_mesh(CellType::hex27);
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
      for (const CellRef ref : mesh.find_set("g")->cells) reverse(mesh, ref);
    const Surface surface = orient_surface(mesh, *mesh.find_set("g"));
    EXPECT_THAT(surface.errors, IsEmpty());
    EXPECT_THAT(surface.warnings, IsEmpty());
    ASSERT_THAT(surface.facets, SizeIs(9));
    for (const SurfaceFacet& facet : surface.facets) {
      EXPECT_FALSE(facet.flipped || facet.has_parent());
      EXPECT_EQ(normal(mesh, facet).z(), reversed ? -1 : 1);
    }
    EXPECT_THAT(surface.facets[4].next, ::testing::UnorderedElementsAre(1, 3, 5, 7));
  }
}

TEST(RigidSurface, FollowsTheMajority) {
  for (const int turned : {4, 5}) {
    Mesh mesh = sheet(3);
    for (int c = 0; c < turned; ++c)
      reverse(mesh, mesh.find_set("g")->cells[static_cast<std::size_t>(c)]);
    const Surface surface = orient_surface(mesh, *mesh.find_set("g"));
    EXPECT_THAT(surface.errors, IsEmpty());
    EXPECT_THAT(surface.warnings, ElementsAre("4 of 9 areas were turned round so that neighbours "
                                              "face the same side"));
    for (const SurfaceFacet& facet : surface.facets)
      EXPECT_EQ(normal(mesh, facet).z(), turned == 4 ? 1 : -1);
    EXPECT_THAT(surface.branching, IsEmpty());
  }
}

TEST(RigidSurface, FollowsTheFirstAreaInCaseOfATie) {
  Mesh mesh = sheet(2);
  for (const std::size_t c : {0U, 3U}) reverse(mesh, mesh.find_set("g")->cells[c]);
  for (const SurfaceFacet& facet : orient_surface(mesh, *mesh.find_set("g")).facets)
    EXPECT_EQ(normal(mesh, facet).z(), -1);
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
  EXPECT_EQ(normal(mesh, surface.facets[0]).z(), 1);
  EXPECT_EQ(normal(mesh, surface.facets[4]).z(), -1);
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

TEST(Surface, MessagesDoNotPileUp) {
  const Mesh mesh = box_mesh(CellType::hex8);
  Set set{"many", 2, {}, {}};
  for (int i = 0; i < 100; ++i) set.cells.push_back(mesh.find_set("b.top")->cells[0]);
  EXPECT_THAT(orient_surface(mesh, set).errors, SizeIs(11));
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
}  // namespace osculate::mesh
