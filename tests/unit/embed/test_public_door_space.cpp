// Every choice on every axis through the public library, in space.
#include <fstream>

#include "public_door.hpp"

namespace osculate {
namespace {

using namespace testing;

/// As in the plane (test_public_door.cpp).
std::string space_model(const std::string& contact, const std::string& rigid = "") {
  return R"(osculate: 1
mesh:
  generate:
    low: {box: {x: [0, 3], y: [0, 3], z: [-1, 0], elements: [3, 3, 1]}}
    high: {box: {x: [0.63, 2.11], y: [0.57, 2.23], z: [-0.01, 1], elements: [2, 2, 1]}}
sets: {skin: {union: [low.top, high.bottom]}}
materials: {m: {linear_elastic: {E: 1000, nu: 0.3}}}
sections: [{on: low, material: m, element: solid}, {on: high, material: m, element: solid}]
)" + (rigid.empty() ? "" : "rigid: {tool: {" + rigid + "}}\n") +
         "contact: [{name: c, master: " + (rigid.empty() ? "low.top" : "tool") +
         ", slave: high.bottom, sampling: nodes, normal: {penalty: 1000}, friction: {coulomb: {mu: "
         "0.3, penalty: 1000}}" +
         contact +
         "}]\nsteps: [{name: s, increments: 1, prescribe: [{on: low.bottom, ux: 0, uy: 0, "
         "uz: 0}]}]\n";
}

/// Two ridges that cross: no node of one sees the other.
std::string crossed_ridges() {
  return R"(osculate: 1
mesh:
  generate:
    low: {box: {x: [-2, 2], y: [-0.3, 0.3], z: [-0.3, 0.3], elements: [3, 1, 1], angle: 45, axis: [1, 0, 0], about: [0, 0, 0]}}
    high: {box: {x: [-0.3, 0.3], y: [-2, 2], z: [0.5285, 1.1285], elements: [1, 3, 1], angle: 45, axis: [0, 1, 0], about: [0, 0, 0.8285]}}
materials: {m: {linear_elastic: {E: 1000, nu: 0.3}}}
sections: [{on: low, material: m, element: solid}, {on: high, material: m, element: solid}]
contact: [{name: c, master: low, slave: high, sampling: nodes, normal: {penalty: 1000}, friction: {coulomb: {mu: 0.3, penalty: 1000}}, edges: true, search: {depth: 0.2}}]
steps: [{name: s, increments: 1, prescribe: [{on: low.left, ux: 0, uy: 0, uz: 0}]}]
)";
}

TEST(PublicDoor, SamplingsAndEnforcementsInSpace) {
  using Rule = Sampling::Rule;
  const auto model = [](const char* sampling) {
    return edited(space_model(""), at_nodes, sampling);
  };
  expect_doors<3>({
      {"nodes", space_model(""), [](Contact<3>&) {}},
      {"gauss", model("sampling: {gauss: 2}"),
       [](Contact<3>& c) {
         c.sampling = {Rule::gauss, 2, 1};
       }},
      {"lobatto", model("sampling: {lobatto: 3}"),
       [](Contact<3>& c) {
         c.sampling = {Rule::lobatto, 3, 1};
       }},
      {"mortar", model("sampling: mortar"), [](Contact<3>& c) { c.sampling.rule = Rule::mortar; }},
      {"hermite", space_model(", smoothing: hermite"),
       [](Contact<3>& c) { c.smoothing.kind = Smoothing::Kind::hermite; }},
      {"augmented", space_model(", enforcement: augmented_lagrange"),
       [](Contact<3>& c) { c.enforcement = Enforcement::augmented_lagrange; }},
  });
  expect_doors<3>({{"unknown", space_model(", enforcement: lagrange_multiplier"),
                    [](Contact<3>& c) { c.enforcement = Enforcement::lagrange_multiplier; }}},
                  false);
}

TEST(PublicDoor, ShapesInSpace) {
  const Vector<3> below{1.5, 1.5, -30};
  const NurbsSurface sheet{{1, 1},
                           {{{0, 0, 1, 1}, {0, 0, 1, 1}}},
                           {2, 2},
                           {{0, 0, 0}, {0, 3, 0.01}, {3, 0, -0.01}, {3, 3, 0}},
                           {1, 1, 1, 1}};
  expect_doors<3>({
      {"plane",
       space_model("", "plane: {point: [0, 0, 0], normal: [0, 0, 1]}"),
       [](Contact<3>&) {},
       {Plane{}},
       {},
       false},
      {"sphere",
       space_model("", "sphere: {center: [1.5, 1.5, -30], radius: 30}"),
       [](Contact<3>&) {},
       {Sphere{below, 30}},
       {},
       false},
      {"cylinder",
       space_model("", "cylinder: {point: [1.5, 1.5, -30], axis: [0, 1, 0], radius: 30}"),
       [](Contact<3>&) {},
       {Cylinder{below, {0, 1, 0}, 30}},
       {},
       false},
      {"cone",
       space_model("", "cone: {apex: [1.5, -40, -40], axis: [0, 1, 0], half_angle: 45}"),
       [](Contact<3>&) {},
       {Cone{{1.5, -40, -40}, {0, 1, 0}, std::numbers::pi / 4}},
       {},
       false},
      {"torus",
       space_model(
           "", "torus: {center: [1.5, 1.5, -30], axis: [0, 1, 0], radius: 20, tube_radius: 10}"),
       [](Contact<3>&) {},
       {Torus{below, {0, 1, 0}, 20, 10}},
       {},
       false},
      {"nurbs patch",
       space_model("",
                   "nurbs_patch: {degree: [1, 1], knots: [[0, 0, 1, 1], [0, 0, 1, 1]], control: "
                   "[[[0, 0, 0, 1], [0, 3, 0.01, 1]], [[3, 0, -0.01, 1], [3, 3, 0, 1]]]}"),
       [](Contact<3>&) {},
       {sheet},
       {},
       false},
  });
}

TEST(PublicDoor, EdgesAndOwnSurfaceInSpace) {
  expect_doors<3>({{"edges", crossed_ridges(), [](Contact<3>& c) {
                      c.edge_angle = std::numbers::pi / 6;
                      c.depth = 0.2;
                    }}});
  const std::string own = edited(edited(edited(space_model(""), "z: [-0.01, 1]", "z: [0.01, 1]"),
                                        "master: low.top", "master: skin"),
                                 "slave: high.bottom", "slave: skin");
  expect_doors<3>({{"own surface", own, [](Contact<3>&) {}}});
}

/// A floor and a wall that lean on each other, and a row of nodes in the edge between them.
TEST(PublicDoor, ReentrantEdges) {
  const std::string file = ::testing::TempDir() + "floor_and_wall.msh";
  std::ofstream(file) << R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
1
2 1 "sides"
$EndPhysicalNames
$Nodes
9
1 -1 0 0.5
2 -1 0.57 0
3 -1 4 0
4 1.3 0 0.5
5 1.3 0.57 0
6 1.3 4 0
7 4 0 0.5
8 4 0.57 0
9 4 4 0
$EndNodes
$Elements
4
1 3 2 1 1 1 4 5 2
2 3 2 1 1 2 5 6 3
3 3 2 1 1 4 7 8 5
4 3 2 1 1 5 8 9 6
$EndElements
)";
  const std::string model =
      edited(space_model(", enforcement: lagrange_multiplier", "set: sides.sides"), "mesh:\n",
             "mesh:\n  files: {sides: {file: " + file + "}}\n");
  ASSERT_TRUE(pairing::has_reentrant_vertices(from_file<3>(model).pair));
  expect_doors<3>({{"floor and wall",
                    model,
                    [](Contact<3>& c) {
                      c.enforcement = Enforcement::lagrange_multiplier;
                      c.reentrant_vertices = true;
                    },
                    {},
                    {},
                    false}},
                  false);
}

}  // namespace
}  // namespace osculate
