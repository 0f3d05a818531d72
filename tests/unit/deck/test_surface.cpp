// Surface files and boundary sets: what is read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "osculate/deck/parse_surface.hpp"

namespace osculate::deck {
namespace {

using projection::FacetMesh;

template <int Dim>
FacetMesh<Dim> mesh_in(const AnyTarget& target) {
  return std::get<FacetMesh<Dim>>(std::get<projection::Target<Dim>>(target));
}
template <class Shape>
Shape curve_in(const AnyTarget& target) {
  return std::get<Shape>(std::get<geometry::Curve>(std::get<projection::Target<2>>(target)));
}
template <class Shape>
Shape surface_in(const AnyTarget& target) {
  return std::get<Shape>(std::get<geometry::Surface>(std::get<projection::Target<3>>(target)));
}
AnyTarget parse(const std::string& text) { return parse_surface(text, "surface.yaml"); }

std::string mesh_file(const std::string& name) {
  return std::string(OSCULATE_SOURCE_DIR) + "/tests/unit/io/data/" + name;
}

TEST(Surface, FacetsAreNumberedAcrossTypesInTheOrderOfTheFile) {
  const FacetMesh<3> mesh = mesh_in<3>(parse(R"(
osculate_surface: 1
dimension: 3
nodes: [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 1e-3], [2, 1, +.5]]
facets:
  tri3: [[1, 4, 5], [1, 5, 2]]
  quad4: [[0, 1, 2, 3]]
)"));
  ASSERT_EQ(mesh.nodes.size(), 6U);
  EXPECT_EQ(mesh.nodes[5], Vec3(2, 1, 0.5));
  ASSERT_EQ(mesh.facets.size(), 3U);
  EXPECT_EQ(mesh.facets[0].type, cell::CellType::tri3);
  EXPECT_EQ(mesh.facets[1].nodes[2], 2);
  EXPECT_EQ(mesh.facets[2].type, cell::CellType::quad4);
  EXPECT_EQ(mesh.facets[2].nodes[3], 3);
}

TEST(Surface, JsonAndAnyOrderOfKeys) {
  const FacetMesh<2> mesh =
      mesh_in<2>(parse("{\"facets\": {\"line3\": [[0, 1, 2]], \"line2\": [[1, 3]]},\n"
                       " \"nodes\": [[0, 0], [1, 0], [0.5, 0.1], [2, 0]],\n"
                       " \"dimension\": 2, \"osculate_surface\": 1}"));
  ASSERT_EQ(mesh.facets.size(), 2U);
  EXPECT_EQ(mesh.facets[0].type, cell::CellType::line3);
  EXPECT_EQ(mesh.facets[0].nodes[2], 2);
  EXPECT_EQ(mesh.facets[1].nodes[1], 3);
}

TEST(Surface, JsonAsProgramsWriteIt) {
  EXPECT_EQ(surface_in<geometry::Sphere>(
                parse("{\"sphere\":{\"center\":[0,0,1E0],\"radius\":2e0,\"inside\":false}}"))
                .radius,
            2);
  EXPECT_EQ(curve_in<geometry::Circle>(
                parse("{\n\t\"circle\": {\n\t\t\"center\": [0, 0],\n\t\t\"radius\": 1\n\t}\n}\n"))
                .radius,
            1);
}

TEST(Surface, ShapesOfThePlane) {
  const auto circle = curve_in<geometry::Circle>(parse("circle: {center: [1, 2], radius: 3}"));
  EXPECT_EQ(circle.center, Vec2(1, 2));
  EXPECT_EQ(circle.radius, 3);
  const auto arc =
      curve_in<geometry::Arc>(parse("arc: {center: [0, 0], radius: 1, from: 0, to: 180}"));
  EXPECT_DOUBLE_EQ(arc.to, std::numbers::pi);
  const auto line =
      curve_in<geometry::InfiniteLine>(parse("line: {point: [0, 1], normal: [0, 2]}"));
  EXPECT_EQ(line.normal, Vec2(0, 1));
}

TEST(Surface, ShapesOfSpace) {
  EXPECT_EQ(
      surface_in<geometry::Plane>(parse("plane: {point: [0, 0, 1], normal: [0, 0, 3]}")).normal,
      Vec3(0, 0, 1));
  EXPECT_TRUE(
      surface_in<geometry::Sphere>(parse("sphere: {center: [0, 0, 0], radius: 2, inside: true}"))
          .inside);
  EXPECT_EQ(surface_in<geometry::Cylinder>(
                parse("cylinder: {point: [0, 0, 0], axis: [0, 0, 1], radius: 2, length: 5}"))
                .length,
            5);
  EXPECT_DOUBLE_EQ(
      surface_in<geometry::Cone>(parse("cone: {apex: [0, 0, 0], axis: [0, 0, 1], half_angle: 45}"))
          .half_angle,
      std::numbers::pi / 4);
  EXPECT_EQ(surface_in<geometry::Torus>(
                parse("torus: {center: [0, 0, 0], axis: [0, 0, 1], radius: 3, tube_radius: 1}"))
                .tube_radius,
            1);
}

TEST(Surface, PolylinesAreMeshes) {
  const std::string points = "polyline: {points: [[0, 0], [1, 0], [1, 1]]";
  const FacetMesh<2> open = mesh_in<2>(parse(points + "}"));
  ASSERT_EQ(open.facets.size(), 2U);
  EXPECT_EQ(open.facets[1].nodes[1], 2);
  const FacetMesh<2> closed = mesh_in<2>(parse(points + ", closed: true}"));
  ASSERT_EQ(closed.facets.size(), 3U);
  EXPECT_EQ(closed.facets[2].nodes[0], 2);
  EXPECT_EQ(closed.facets[2].nodes[1], 0);
}

TEST(Surface, NurbsCurvesAndPatchesAreToldApartByTheirDegrees) {
  const std::string control = ", control: [[1, 0, 1], [1, 1, 0.5], [0, 1, 1]]}";
  for (const char* const form :
       {"degree: [2], knots: [[0, 0, 0, 1, 1, 1]]", "degree: 2, knots: [0, 0, 0, 1, 1, 1]"}) {
    const auto curve =
        curve_in<geometry::NurbsCurve>(parse("nurbs: {" + std::string(form) + control));
    EXPECT_EQ(curve.degree, 2);
    EXPECT_EQ(curve.knots.size(), 6U);
    EXPECT_EQ(curve.weights[1], 0.5);
    EXPECT_EQ(curve.control[1], Vec2(1, 1));
  }
  for (const char* const key : {"nurbs", "nurbs_patch"}) {
    const auto patch = surface_in<geometry::NurbsPatch>(
        parse(std::string(key) + ": {degree: [1, 1], knots: [[0, 0, 1, 1], [0, 0, 1, 1]], control: "
                                 "[[[0, 0, 0, 1], [0, 1, 0, 2]], [[1, 0, 0, 3], [1, 1, 4, 4]]]}"));
    EXPECT_EQ(patch.count[0], 2);
    EXPECT_EQ(patch.weights[1], 2);
    EXPECT_EQ(patch.control[3], Vec3(1, 1, 4));
  }
}

TEST(Surface, SchemaAndExplanationsComeFromOneSpecification) {
  const auto schema = nlohmann::json::parse(surface_schema());
  EXPECT_TRUE(schema["properties"].contains("facets"));
  EXPECT_TRUE(schema["properties"].contains("torus"));
  EXPECT_THAT(explain_surface_key("facets"), ::testing::HasSubstr("in the order of the file"));
}

/// A cube of eight hexahedra, or whatever the mesh of the test data is: the normals of its boundary
/// point outwards if the volume under them is positive.
double volume_under(const FacetMesh<3>& mesh) {
  double six_times = 0;
  for (const projection::MeshFacet& facet : mesh.facets) {
    const int corners = cell::info(facet.type).corners;
    const auto x = [&](int k) {
      return mesh.nodes[static_cast<std::size_t>(facet.nodes[static_cast<std::size_t>(k)])];
    };
    for (int k = 1; k + 1 < corners; ++k) six_times += x(0).dot(x(k).cross(x(k + 1)));
  }
  return six_times / 6;
}

TEST(Surface, BoundaryOfAGmshMeshPointsOutwards) {
  const SurfaceInput input = read_surface(mesh_file("solids_1_41.msh"));
  EXPECT_EQ(input.dimension(), 3);
  const FacetMesh<3> mesh = mesh_in<3>(input.target);
  EXPECT_GT(volume_under(mesh), 0);
  for (const Vec3& node : mesh.nodes) EXPECT_TRUE(node.allFinite());
}

/// The unit square of two triangles, one numbered clockwise, and its lower side as a line.
constexpr const char* square_msh = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
1 1 "bottom"
2 2 "body"
$EndPhysicalNames
$Nodes
5
1 9 9 0
2 0 0 0
3 1 0 0
4 1 1 0
5 0 1 0
$EndNodes
$Elements
3
1 1 2 1 1 2 3
2 2 2 2 1 2 3 4
3 2 2 2 1 2 5 4
$EndElements
)";

class SurfaceFile : public ::testing::Test {
 protected:
  std::string path_ = ::testing::TempDir() + "osculate_square_" +
                      ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".msh";
  void write(const std::string& text) const { std::ofstream(path_) << text; }
  void TearDown() override { std::filesystem::remove(path_); }
};

TEST_F(SurfaceFile, SetOfLinesIsDirectedByTheBodyBehindIt) {
  write(square_msh);
  const FacetMesh<2> mesh = mesh_in<2>(read_surface(path_ + ":bottom").target);
  ASSERT_EQ(mesh.facets.size(), 1U);
  ASSERT_EQ(mesh.nodes.size(), 2U);  // nodes that no facet uses are left out
  EXPECT_EQ(mesh.nodes[static_cast<std::size_t>(mesh.facets[0].nodes[0])], Vec2(1, 0));
  EXPECT_EQ(mesh.nodes[static_cast<std::size_t>(mesh.facets[0].nodes[1])], Vec2(0, 0));
}

TEST_F(SurfaceFile, WithoutSetTheWholeBoundaryIsMeant) {
  write(square_msh);
  const FacetMesh<2> mesh = mesh_in<2>(read_surface(path_).target);
  EXPECT_EQ(mesh.facets.size(), 4U);
  EXPECT_EQ(mesh.nodes.size(), 4U);
}

TEST_F(SurfaceFile, AreasOffThePlaneAreASurfaceInSpace) {
  std::string text = square_msh;
  text.replace(text.find("4 1 1 0"), 7, "4 1 1 1");
  write(text);
  const SurfaceInput input = read_surface(path_ + ":body");
  ASSERT_EQ(input.dimension(), 3);
  EXPECT_EQ(mesh_in<3>(input.target).facets.size(), 2U);
  ASSERT_EQ(input.warnings.size(), 1U);  // one triangle was turned round
  EXPECT_EQ(input.warnings[0], path_ +
                                   ": 1 of 2 areas were turned round so that neighbours face the "
                                   "same side");
}

std::string refusal(const std::string& named) {
  try {
    (void)read_surface(named);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return {};
}

TEST_F(SurfaceFile, SetsThatCannotBeUsed) {
  write(square_msh);
  EXPECT_EQ(refusal(path_ + ":botom"), path_ + ": unknown set 'botom'; did you mean 'bottom'?");
  EXPECT_EQ(refusal(path_ + "x:bottom"), path_ + "x: no such file");
  std::string text = square_msh;
  text.replace(text.find("4 1 1 0"), 7, "4 1 1 1");
  write(text);
  EXPECT_EQ(refusal(path_ + ":bottom"),
            path_ +
                ": set 'bottom' is made of lines; a surface in space is made of areas, volumes or "
                "nodes");
}

TEST_F(SurfaceFile, SetsMayHaveColonsInTheirNames) {
  std::string text = square_msh;
  text.replace(text.find("\"bottom\""), 8, "\"side:1\"");
  write(text);
  EXPECT_EQ(mesh_in<2>(read_surface(path_ + ":side:1").target).facets.size(), 1U);
}

TEST_F(SurfaceFile, OnlyGmshMeshesHaveSets) {
  const std::string yaml = path_ + ".yaml";
  std::ofstream(yaml) << "circle: {center: [0, 0], radius: 1}\n";
  EXPECT_EQ(refusal(yaml), "");
  EXPECT_EQ(refusal(yaml + ":rim"), yaml + ": only a mesh has sets; 'rim' cannot be chosen here");
  std::filesystem::remove(yaml);
}

}  // namespace
}  // namespace osculate::deck
