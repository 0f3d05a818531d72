#include "osculate/mesh/generate_ring.hpp"

#include <cmath>

#include "facet_sample.hpp"
#include "osculate/mesh/boundary.hpp"
#include "osculate/mesh/check.hpp"
#include "osculate/mesh/quality.hpp"
#include "osculate/mesh/surface.hpp"

namespace osculate::mesh::testing {
namespace {

std::vector<std::string> names(const Mesh& mesh) {
  std::vector<std::string> out;
  for (const Set& set : mesh.sets) out.push_back(set.name);
  return out;
}

Mesh flat(CellType type, std::vector<double> angle) {
  BoxSpec spec;
  spec.name = "r";
  spec.x = {2, 3};
  spec.y = std::move(angle);
  spec.nx = {2};
  spec.ny = {8};
  spec.type = type;
  Mesh mesh;
  append_ring(mesh, spec, Vec3(10, 20, 0));
  return mesh;
}

Mesh solid(CellType type, std::vector<double> angle, int along) {
  SolidBoxSpec spec;
  spec.name = "r";
  spec.breaks = {std::vector<double>{2, 3}, std::move(angle), {0, 1}};
  spec.elements = {std::vector<int>{2}, {8}, {1}};
  spec.type = type;
  Mesh mesh;
  append_ring(mesh, spec, Vec3(10, 20, 30), along);
  return mesh;
}

void expect_radius(const Mesh& mesh, const std::string& set, double radius, const Vec3& axis) {
  for (const Index n : mesh.find_set(set)->nodes) {
    Vec3 arm = at(mesh, n) - Vec3(10, 20, 30);
    if (axis.isZero()) arm.z() = 0;
    arm -= axis * axis.dot(arm);
    EXPECT_NEAR(arm.norm(), radius, 1e-13);
  }
}

TEST(GenerateRing, AClosedRingHasNoSeam) {
  for (const CellType type : area_types) {
    const Mesh mesh = flat(type, {0, 360});
    EXPECT_THAT(check_mesh(mesh), IsEmpty()) << cell::info(type).name;
    EXPECT_THAT(names(mesh), ElementsAre("r", "r.inner", "r.outer"));
    expect_radius(mesh, "r.outer", 3, Vec3::Zero());
    expect_radius(mesh, "r.inner", 2, Vec3::Zero());
    // Its boundary is the two circles.
    const Boundary boundary = boundary_facets(mesh, *mesh.find_set("r"));
    EXPECT_EQ(boundary.facets.size(), 16u);
    const Boundary outer = orient_boundary(mesh, *mesh.find_set("r.outer"));
    EXPECT_THAT(outer.errors, IsEmpty());
    for (const BoundaryFacet& f : outer.facets) EXPECT_FALSE(f.flipped || f.next < 0 || f.prev < 0);
  }
  EXPECT_EQ(flat(CellType::quad4, {0, 360}).nodes.size(), 24u);
}

TEST(GenerateRing, APartHasEnds) {
  const Mesh mesh = flat(CellType::quad4, {0, 90});
  EXPECT_THAT(check_mesh(mesh), IsEmpty());
  EXPECT_THAT(names(mesh), ElementsAre("r", "r.inner", "r.outer", "r.from", "r.to"));
  for (const Index n : mesh.find_set("r.from")->nodes) EXPECT_EQ(at(mesh, n).y(), 20);
  for (const Index n : mesh.find_set("r.to")->nodes) EXPECT_EQ(at(mesh, n).x(), 10);
}

TEST(GenerateRing, AHollowCylinderAlongEachAxis) {
  for (const CellType type : {CellType::hex8, CellType::hex20, CellType::hex27, CellType::wedge6})
    for (int along = 0; along < 3; ++along) {
      const Mesh mesh = solid(type, {0, 360}, along);
      EXPECT_THAT(check_mesh(mesh), IsEmpty()) << cell::info(type).name << along;
      expect_radius(mesh, "r.outer", 3, Vec3::Unit(along));
      const Surface all = surface_facets(mesh, *mesh.find_set("r"));
      const std::size_t ends = type == CellType::wedge6 ? 64 : 32;
      EXPECT_EQ(all.facets.size(), 16 + ends);
      EXPECT_THAT(orient_surface(mesh, *mesh.find_set("r.inner")).errors, IsEmpty());
      for (const Index n : mesh.find_set("r.top")->nodes)
        EXPECT_EQ(at(mesh, n)[along], 10 * (along + 1) + 1);
    }
}

TEST(GenerateRing, ASecondPartLeavesTheFirstAsItIs) {
  Mesh mesh = solid(CellType::hex8, {0, 360}, 2);
  const std::vector<Index> first = mesh.blocks[0].connectivity;
  SolidBoxSpec spec;
  spec.name = "s";
  spec.breaks = {std::vector<double>{4, 5}, {0, 180, 360}, {0, 1}};
  spec.elements = {std::vector<int>{1}, {3, 3}, {1}};
  append_ring(mesh, spec, Vec3::Zero(), 2);
  EXPECT_THAT(check_mesh(mesh), IsEmpty());
  ASSERT_EQ(mesh.find_set("s")->cells.size(), 6u);
  EXPECT_TRUE(std::equal(first.begin(), first.end(), mesh.blocks[0].connectivity.begin()));
  EXPECT_GT(quality(mesh, mesh.find_set("s")->cells).worst_shape, 0.5);
}

TEST(GenerateRing, Mistakes) {
  const auto refused = [](std::vector<double> radius, std::vector<double> angle, int around) {
    BoxSpec spec;
    spec.name = "r";
    spec.x = std::move(radius);
    spec.y = std::move(angle);
    spec.nx = {1};
    spec.ny = {around};
    Mesh mesh;
    try {
      append_ring(mesh, spec, Vec3::Zero());
    } catch (const core::InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refused({0, 1}, {0, 360}, 8), "ring 'r': the radius must be above 0");
  EXPECT_EQ(refused({1, 2}, {0, 361}, 8), "ring 'r': spans 361 degrees; at most 360 are possible");
  EXPECT_EQ(refused({1, 2}, {0, 360}, 2),
            "ring 'r': 2 elements around; at least 3 are needed all round");
}

}  // namespace
}  // namespace osculate::mesh::testing
