// Mass and moments of rigid bodies that a mesh, a polyline or curves bound.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "space_test.hpp"
#include "system_test.hpp"

namespace osculate::deck {
namespace {

constexpr double pi = std::numbers::pi;

std::string plane_model(const std::string& part, const std::string& rigid) {
  return "osculate: 1\nmesh: {generate: {block: {box: {x: [-2, 2], y: [-9, -8], elements: [2, "
         "1]}}" +
         part +
         "}}\nmaterials: {m: {linear_elastic: {E: 1, nu: 0, density: 1}}}\n"
         "sections: [{on: block, material: m, element: plane_strain}]\n"
         "rigid: {stone: {" +
         rigid +
         "}}\nsteps: [{name: s, increments: 1, duration: 1, dynamics: {},\n"
         "  prescribe: [{on: block, ux: 0, uy: 0}]}]\n";
}

std::string space_model(const std::string& part, const std::string& rigid) {
  return "osculate: 1\nmesh: {generate: {block: {box: {x: [0, 1], y: [0, 1], z: [-9, -8], "
         "elements: "
         "[1, 1, 1]}}" +
         part +
         "}}\nmaterials: {m: {linear_elastic: {E: 1, nu: 0, density: 1}}}\n"
         "sections: [{on: block, material: m, element: solid}]\n"
         "rigid: {stone: {" +
         rigid +
         "}}\nsteps: [{name: s, increments: 1, duration: 1, dynamics: {},\n"
         "  prescribe: [{on: block, ux: 0, uy: 0, uz: 0}]}]\n";
}

model::RigidBody plane_body(const std::string& part, const std::string& rigid) {
  return build_text(plane_model(part, rigid)).model.rigid.at(0);
}

model::RigidBody3 space_body(const std::string& part, const std::string& rigid) {
  return built_from(space_model(part, rigid)).model.rigid.at(0);
}

/// A triangle has m (a . a + b . b + c . c) / 12, corners from its centre.
TEST(BodyMoments, OfAPolyline) {
  const std::string clockwise = "polyline: {points: [[1, 1], [2, 4], [4, 1]], closed: true}";
  const model::RigidBody body = plane_body("", clockwise + ", mass: 3");
  const Vec2 centre(7.0 / 3, 2);
  EXPECT_LT((body.reference - centre).norm(), 1e-14);
  const double squares = (Vec2(1, 1) - centre).squaredNorm() + (Vec2(2, 4) - centre).squaredNorm() +
                         (Vec2(4, 1) - centre).squaredNorm();
  EXPECT_NEAR(body.inertia(0, 0), 3 * squares / 12, 1e-13);
  const model::RigidBody dense = plane_body("", clockwise + ", density: 2");
  EXPECT_NEAR(dense.mass, 2 * 4.5, 1e-13);
  EXPECT_NEAR(dense.inertia(0, 0), 9 * squares / 12, 1e-13);
}

TEST(BodyMoments, OfABoundaryThatFacesInwardsNeedAFlip) {
  const std::string hole = "polyline: {points: [[4, 1], [2, 4], [1, 1]], closed: true}, mass: 3";
  EXPECT_THAT(any_refusal(plane_model("", hole)),
              ::testing::HasSubstr("'stone' lies outside of its closed boundary (flip: true"));
  EXPECT_GT(plane_body("", hole + ", flip: true").inertia(0, 0), 0);
}

// Two half circles and two lines: a square with discs at two ends.
TEST(BodyMoments, OfCurves) {
  const model::RigidBody body =
      plane_body("",
                 "composite: [{polyline: {points: [[-1, 1], [1, 1]]}}, "
                 "{arc: {center: [1, 0], radius: 1, from: -90, to: 90}}, "
                 "{polyline: {points: [[1, -1], [-1, -1]]}}, "
                 "{arc: {center: [-1, 0], radius: 1, from: 90, to: 270}}], density: 0.5");
  EXPECT_NEAR(body.mass, 0.5 * (4 + pi), 1e-12);
  EXPECT_LT(body.reference.norm(), 1e-12);
  // square m (2^2 + 2^2) / 12; half discs: all of a disc's and m (1 + 2 * 4 / (3 pi)) of the way
  // out
  const double discs = pi / 2 + pi * (1 + 8 / (3 * pi));
  EXPECT_NEAR(body.inertia(0, 0), 0.5 * (4 * 8.0 / 12 + discs), 1e-12);
}

// m (a^2 + b^2) / 12 from cells, whatever their number and order.
TEST(BodyMoments, OfAPlaneMesh) {
  for (const char* const type : {"quad4", "tri3", "quad8", "quad9", "tri6"}) {
    const std::string part =
        std::string(", brick: {box: {x: [1, 4], y: [2, 3], elements: [3, 2], type: ") + type + "}}";
    const model::RigidBody body = plane_body(part, "set: brick, density: 1.5");
    EXPECT_NEAR(body.mass, 4.5, 1e-13) << type;
    EXPECT_LT((body.reference - Vec2(2.5, 2.5)).norm(), 1e-14) << type;
    EXPECT_NEAR(body.inertia(0, 0), 4.5 * 10 / 12, 1e-13) << type;
  }
}

TEST(BodyMoments, OfABoxOfCells) {
  for (const char* const type : {"hex8", "tet4", "hex20", "hex27", "tet10"}) {
    const std::string part =
        std::string(
            ", brick: {box: {x: [1, 4], y: [2, 3], z: [0, 2], elements: [2, 1, 2], type: ") +
        type + "}}";
    const model::RigidBody3 body = space_body(part, "set: brick, mass: 6");
    EXPECT_LT((body.reference - Vec3(2.5, 2.5, 1)).norm(), 1e-13) << type;
    const Vec3 exact(6 * (1 + 4) / 12.0, 6 * (9 + 4) / 12.0, 6 * (9 + 1) / 12.0);
    EXPECT_LT((body.inertia - Mat<3, 3>(exact.asDiagonal())).norm(), 1e-12) << type;
  }
}

/// Relative error of volume and moment of a meshed ball.
std::array<double, 2> ball_errors(const std::string& type, int elements) {
  const std::string part =
      ", shell: {sphere: {center: [1, 2, 3], radius: 1.5, elements: " + std::to_string(elements) +
      ", type: " + type + "}}";
  const model::RigidBody3 body = space_body(part, "set: shell, density: 2");
  const double mass = 2 * 4.0 / 3 * pi * std::pow(1.5, 3), moment = 0.4 * mass * 1.5 * 1.5;
  EXPECT_LT((body.reference - Vec3(1, 2, 3)).norm(), 1e-12);
  if (type[0] == 'q') {  // triangles have not the symmetry of a cube
    EXPECT_LT((body.inertia - body.inertia(0, 0) * Mat<3, 3>::Identity()).norm(), 1e-12 * moment);
  }
  return {std::abs(body.mass / mass - 1), (body.inertia / moment - Mat<3, 3>::Identity()).norm()};
}

// Flat facets leave out a share in proportion to their size squared, curved ones to its fourth
// power.
TEST(BodyMoments, OfAMeshedBallComeNearToThoseOfTheSphere) {
  for (const auto& [type, order] :
       {std::pair{"tri3", 2.0}, {"quad4", 2.0}, {"tri6", 4.0}, {"quad8", 4.0}, {"quad9", 4.0}}) {
    const std::array<double, 2> coarse = ball_errors(type, 6), fine = ball_errors(type, 12);
    EXPECT_NEAR(std::log2(coarse[0] / fine[0]), order, 0.15) << type;
    EXPECT_NEAR(std::log2(coarse[1] / fine[1]), order, 0.15) << type;
  }
}

TEST(BodyMoments, AreRefusedWithTheReason) {
  const auto plane = [](const std::string& part, const std::string& rigid) {
    return any_refusal(plane_model(part, rigid));
  };
  using ::testing::HasSubstr;
  EXPECT_THAT(plane("", "polyline: {points: [[0, 0], [1, 0]]}, mass: 1"),
              HasSubstr("inertia is missing: it is known for bodies that enclose a volume, and "
                        "'stone' is an open polyline: give it"));
  EXPECT_THAT(plane("", "line: {point: [0, 0], normal: [0, 1]}, density: 1"),
              HasSubstr("a density needs bodies that enclose a volume, and 'stone' encloses none: "
                        "give mass and inertia"));
  EXPECT_THAT(plane("", "circle: {center: [0, 0], radius: 1}, mass: 1, density: 1"),
              HasSubstr("not both"));
  EXPECT_THAT(
      plane(", edge: {line: {points: [[0, 0], [1, 0]], elements: [2]}}", "set: edge, mass: 1"),
      HasSubstr("has a boundary that is not closed, at node"));
  EXPECT_THAT(any_refusal(space_model(", lid: {tube: {ends: [[0, 0, 0], [0, 0, 2]], radius: 1, "
                                      "elements: [8, 2]}}",
                                      "set: lid, mass: 1")),
              HasSubstr("has a boundary that is not closed, at node"));
  EXPECT_THAT(any_refusal(space_model(", hole: {sphere: {center: [0, 0, 0], radius: 1, elements: "
                                      "2, inside: true}}",
                                      "set: hole, mass: 1")),
              HasSubstr("lies outside of its closed boundary"));
  EXPECT_EQ(plane(", edge: {line: {points: [[0, 0], [1, 0]], elements: [2]}}",
                  "set: edge, mass: 1, inertia: 2"),
            "");
}

}  // namespace
}  // namespace osculate::deck
