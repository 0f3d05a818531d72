#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <numbers>

#include "measure.hpp"
#include "osculate/mesh/check.hpp"
#include "osculate/mesh/generate_space.hpp"
#include "osculate/mesh/surface.hpp"

namespace osculate::mesh::testing {
namespace {

struct Facet {
  Vec3 area = Vec3::Zero(), middle = Vec3::Zero();
};

/// Area vectors and midpoints of the corner polygons of a set.
std::vector<Facet> facets_of(const Mesh& mesh, const std::string& name) {
  std::vector<Facet> facets;
  for (const CellRef ref : mesh.find_set(name)->cells) {
    const std::span<const Index> corners = corners_of(mesh, ref);
    Facet facet{area_vector(mesh, corners), Vec3::Zero()};
    for (const Index n : corners) facet.middle += at(mesh, n) / static_cast<double>(corners.size());
    facets.push_back(facet);
  }
  return facets;
}

double total_area(const Mesh& mesh, const std::string& name) {
  double sum = 0;
  for (const Facet& facet : facets_of(mesh, name)) sum += facet.area.norm();
  return sum;
}

/// Facets that have a neighbour across each of their edges.
std::size_t enclosed_facets(const Mesh& mesh, const std::string& name) {
  const Surface surface = orient_surface(mesh, *mesh.find_set(name));
  EXPECT_THAT(surface.errors, IsEmpty());
  EXPECT_THAT(surface.warnings, IsEmpty());
  std::size_t count = 0;
  for (const SurfaceFacet& facet : surface.facets) {
    EXPECT_FALSE(facet.flipped || facet.has_parent());
    bool all = true;
    for (std::size_t k = 0; k < facet.corners().size(); ++k) all = all && facet.next[k] >= 0;
    count += all ? 1 : 0;
  }
  return count;
}

class Surfaces : public ::testing::TestWithParam<CellType> {};
INSTANTIATE_TEST_SUITE_P(Types, Surfaces, ::testing::ValuesIn(area_types), type_name);

TEST_P(Surfaces, GridIsFlatWithTheNormalOfItsSides) {
  GridSpec spec{"g", {1, 2, 3}, {4, 0, 0}, {1, 0, 2}, {4, 3}, GetParam()};
  Mesh mesh;
  append_grid(mesh, spec);
  const Vec3 normal = spec.u.cross(spec.v).normalized();
  EXPECT_THAT(mesh.find_set("g")->cells, SizeIs(cell::info(GetParam()).corners == 3 ? 24 : 12));
  for (const Facet& facet : facets_of(mesh, "g"))
    EXPECT_NEAR(facet.area.normalized().dot(normal), 1, 1e-15);
  EXPECT_NEAR(total_area(mesh, "g"), 8, 1e-14);
  for (const Vec3& x : mesh.nodes) EXPECT_EQ(x.y(), 2);
  EXPECT_THAT(check_mesh(mesh), IsEmpty());
  EXPECT_EQ(at(mesh, mesh.find_set("g.bottom_left")->nodes[0]), Vec3(1, 2, 3));
  EXPECT_EQ(at(mesh, mesh.find_set("g.bottom_right")->nodes[0]), Vec3(5, 2, 3));
  EXPECT_EQ(at(mesh, mesh.find_set("g.top_right")->nodes[0]), Vec3(6, 2, 5));
  EXPECT_EQ(at(mesh, mesh.find_set("g.top_left")->nodes[0]), Vec3(2, 2, 5));
  EXPECT_THAT(mesh.find_set("g.left")->cells, SizeIs(3));
  EXPECT_THAT(mesh.find_set("g.top")->cells, SizeIs(4));
  for (const Index node : mesh.find_set("g.top")->nodes) EXPECT_EQ(at(mesh, node).z(), 5);
  EXPECT_EQ(enclosed_facets(mesh, "g"), cell::info(GetParam()).corners == 3 ? 12 : 2);
}

TubeSpec ring(CellType type) {
  TubeSpec spec;
  spec.name = "t";
  spec.start = {12, -1, -2};
  spec.end = {12, 2, -2};
  spec.radius = 2;
  spec.zero = Vec3(0, 0, 1);
  spec.elements = {49, 3};
  spec.type = type;
  return spec;
}

// 49 chords on the full circumference, one row of nodes exactly at the top.
TEST_P(Surfaces, TubeHasItsFirstNodesExactlyAtTheTop) {
  Mesh mesh;
  append_tube(mesh, ring(GetParam()));
  const cell::CellInfo& info = cell::info(GetParam());
  std::size_t on_top = 0;
  for (const Vec3& x : mesh.nodes) {
    EXPECT_NEAR(Vec2(x.x() - 12, x.z() + 2).norm(), 2, 1e-14);
    on_top += x.x() == 12 && x.z() == 0 ? 1U : 0U;
    EXPECT_LE(x.z(), 0);
  }
  EXPECT_EQ(on_top, info.order == 1 ? 4U : 7U);
  EXPECT_THAT(mesh.find_set("t")->cells, SizeIs(info.corners == 3 ? 294 : 147));
  EXPECT_THAT(mesh.find_set("t.start")->cells, SizeIs(49));
  EXPECT_THAT(mesh.find_set("t.start")->nodes, SizeIs(static_cast<std::size_t>(49 * info.order)));
  for (const Index node : mesh.find_set("t.end")->nodes) EXPECT_EQ(at(mesh, node).y(), 2);
  EXPECT_EQ(mesh.find_set("t.from"), nullptr);
  EXPECT_THAT(check_mesh(mesh), IsEmpty());
  for (const Facet& facet : facets_of(mesh, "t"))
    EXPECT_GT(facet.area.dot(facet.middle - Vec3(12, facet.middle.y(), -2)), 0);
  EXPECT_NEAR(total_area(mesh, "t"), 49 * 2 * 2 * std::sin(std::numbers::pi / 49) * 3, 1e-12);
  EXPECT_EQ(enclosed_facets(mesh, "t"), info.corners == 3 ? 196 : 49);
}

TEST_P(Surfaces, TubeFromTheInsideFacesItsAxis) {
  TubeSpec spec = ring(GetParam());
  spec.inside = true;
  Mesh mesh;
  append_tube(mesh, spec);
  for (const Facet& facet : facets_of(mesh, "t"))
    EXPECT_LT(facet.area.dot(facet.middle - Vec3(12, facet.middle.y(), -2)), 0);
}

TEST_P(Surfaces, PartOfATubeHasFourSides) {
  TubeSpec spec = ring(GetParam());
  spec.from = -90;
  spec.to = 90;
  spec.elements = {4, 2};
  Mesh mesh;
  append_tube(mesh, spec);
  // right-handed about +y: from z to x
  for (const Index node : mesh.find_set("t.from")->nodes)
    EXPECT_EQ(Vec2(at(mesh, node).x(), at(mesh, node).z()), Vec2(10, -2));
  for (const Index node : mesh.find_set("t.to")->nodes)
    EXPECT_EQ(Vec2(at(mesh, node).x(), at(mesh, node).z()), Vec2(14, -2));
  for (const Vec3& x : mesh.nodes) EXPECT_GE(x.z(), -2);
  EXPECT_THAT(mesh.find_set("t.to")->cells, SizeIs(2));
  EXPECT_THAT(check_mesh(mesh), IsEmpty());
}

TEST(Tube, AngleZeroHasADefault) {
  for (const Vec3& axis : {Vec3(0, 0, 3), Vec3(0, 2, 0), Vec3(1, 1, 1)}) {
    TubeSpec spec;
    spec.name = "t";
    spec.end = axis;
    Mesh mesh;
    append_tube(mesh, spec);
    const Vec3 zero = axis.z() > 1 ? Vec3(1, 0, 0) : Vec3(0, 0, 1);
    const Vec3 k = axis.normalized();
    EXPECT_LE((mesh.nodes[0] - (zero - k * k.dot(zero)).normalized()).norm(), 1e-15);
  }
}

SphereSpec unit_sphere(CellType type, int n) {
  SphereSpec spec;
  spec.name = "s";
  spec.center = {1, 2, -3};
  spec.radius = 2;
  spec.elements = n;
  spec.type = type;
  return spec;
}

TEST_P(Surfaces, SphereIsClosedAndFacesOutwards) {
  Mesh mesh;
  append_sphere(mesh, unit_sphere(GetParam(), 4));
  const cell::CellInfo& info = cell::info(GetParam());
  const std::size_t steps = static_cast<std::size_t>(4 * info.order);
  std::size_t nodes = 6 * steps * steps + 2;
  if (GetParam() == CellType::quad8) nodes -= 6 * 16;
  EXPECT_EQ(mesh.nodes.size(), nodes);
  for (const Vec3& x : mesh.nodes) EXPECT_NEAR((x - Vec3(1, 2, -3)).norm(), 2, 1e-15);
  EXPECT_THAT(mesh.nodes, ::testing::Contains(Vec3(1, 2, -1)));
  EXPECT_THAT(mesh.nodes, ::testing::Contains(Vec3(-1, 2, -3)));
  Vec3 sum = Vec3::Zero();
  for (const Facet& facet : facets_of(mesh, "s")) {
    EXPECT_GT(facet.area.dot(facet.middle - Vec3(1, 2, -3)), 0);
    sum += facet.area;
  }
  EXPECT_LE(sum.norm(), 1e-13);
  EXPECT_EQ(enclosed_facets(mesh, "s"), mesh.find_set("s")->cells.size());
  EXPECT_THAT(check_mesh(mesh), IsEmpty());
}

TEST_P(Surfaces, SphereFromTheInsideFacesItsCentre) {
  SphereSpec spec = unit_sphere(GetParam(), 3);
  spec.inside = true;
  Mesh mesh;
  append_sphere(mesh, spec);
  for (const Facet& facet : facets_of(mesh, "s"))
    EXPECT_LT(facet.area.dot(facet.middle - Vec3(1, 2, -3)), 0);
}

TEST(Sphere, AreaConvergesWithSecondOrder) {
  const auto error = [](int n) {
    Mesh mesh;
    append_sphere(mesh, unit_sphere(CellType::tri3, n));
    return std::abs(total_area(mesh, "s") - 16 * std::numbers::pi);
  };
  EXPECT_NEAR(std::log2(error(8) / error(16)), 2, 0.05);
}

// ---- refusals -----------------------------------------------------------------------------------

TEST(SurfaceRefusals, Grid) {
  const auto refused = [](const std::function<void(GridSpec&)>& spoil, const char* message) {
    const GridSpec good{"g", {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1}, CellType::quad4};
    expect_refusal(append_grid, good, spoil, "grid '", message);
  };
  refused([](GridSpec& s) { s.v = {-2, 0, 0}; }, "the sides u and v must be finite and");
  refused([](GridSpec& s) { s.u = {std::nan(""), 0, 0}; }, "must be finite");
  refused([](GridSpec& s) { s.origin = {std::nan(""), 0, 0}; }, "the origin must be finite");
  refused([](GridSpec& s) { s.elements = {3, 0}; }, "0 elements; at least 1 is needed");
  refused([](GridSpec& s) { s.type = CellType::hex8; }, "cannot be made of hex8 cells");
  refused([](GridSpec& s) { s.elements = {30000, 30000}; }, "9e+08 nodes");
  refused([](GridSpec& s) { s.name = ""; }, "needs a name");
}

TEST(SurfaceRefusals, Tube) {
  const auto refused = [](const std::function<void(TubeSpec&)>& spoil, const char* message) {
    expect_refusal(append_tube, ring(CellType::quad4), spoil, "tube 't': ", message);
  };
  refused([](TubeSpec& s) { s.end = s.start; }, "the ends of the axis must be finite");
  refused([](TubeSpec& s) { s.zero = Vec3(0, 5, 0); }, "must not be along the axis");
  refused([](TubeSpec& s) { s.radius = -1; }, "positive number, not -1");
  refused([](TubeSpec& s) { s.to = 361; }, "at most 360 degrees, not from 0 to 361");
  refused([](TubeSpec& s) { s.to = 0; }, "not from 0 to 0");
  refused([](TubeSpec& s) { s.elements = {2, 1}; }, "2 elements around; at least 3");
  refused([](TubeSpec& s) { s.type = CellType::line2; }, "cannot be made of line2 cells");
}

TEST(SurfaceRefusals, Sphere) {
  const auto refused = [](const std::function<void(SphereSpec&)>& spoil, const char* message) {
    expect_refusal(append_sphere, unit_sphere(CellType::quad4, 2), spoil, "sphere 's': ", message);
  };
  refused([](SphereSpec& s) { s.radius = std::nan(""); }, "the radius must be");
  refused([](SphereSpec& s) { s.center.y() = std::nan(""); }, "the center must be finite");
  refused([](SphereSpec& s) { s.elements = 0; }, "0 elements");
  refused([](SphereSpec& s) { s.elements = 100000; }, "nodes; at most");
}

}  // namespace
}  // namespace osculate::mesh::testing
