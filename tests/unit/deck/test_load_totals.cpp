// Forces and moments of loads, and forces that are given in total.
#include "osculate/model/system.hpp"
#include "space_test.hpp"
#include "system_test.hpp"

namespace osculate::deck {
namespace {

/// A block [0, 4] x [0, 2] of cells that grow to the right.
std::string plane(const std::string& loads, const std::string& element = "plane_strain") {
  return "osculate: 1\n"
         "mesh: {generate: {b: {box: {x: [0, 4], y: [0, 2], elements: [4, 2], bias: [3, 1], type: "
         "quad8}}}}\n"
         "materials: {m: {linear_elastic: {E: 1, nu: 0.3, density: 2}}}\n"
         "sections: [{on: b, material: m, element: " +
         element +
         "}]\n"
         "amplitudes: {wave: [[0, 0], [0.5, 1], [1, 0.25]]}\n"
         "steps:\n"
         "  - {name: one, increments: 1, prescribe: [{on: b.left, ux: 0, uy: 0}], " +
         loads +
         "}\n"
         "  - {name: two, increments: 1}\n";
}

std::string space(const std::string& loads) {
  return "osculate: 1\n"
         "mesh: {generate: {b: {box: {x: [0, 4], y: [0, 2], z: [0, 1], elements: [3, 2, 1]}}}}\n"
         "materials: {m: {linear_elastic: {E: 1, nu: 0.3, density: 2}}}\n"
         "sections: [{on: b, material: m, element: solid}]\n"
         "steps: [{name: one, increments: 1, prescribe: [{on: b.left, ux: 0, uy: 0, uz: 0}], " +
         loads + "}]\n";
}

void expect_vector(const Vec3& is, const Vec3& expected) {
  EXPECT_LT((is - expected).norm(), 1e-12) << is.transpose() << " is not " << expected.transpose();
}

/// What the solver sees at the end of the first step.
Vec2 assembled(const Built& built) {
  Vec2 sum = Vec2::Zero();
  for (const model::DeadLoad& load : built.model.steps[0].dead)
    for (const auto& [dof, value] : load.unit) sum[dof % 2] += value * load.ramp.value(1.0);
  return sum;
}

TEST(LoadTotals, AForceOnASetIsThatOfEachOfItsNodes) {
  const Built built = build_text(plane("forces: [{on: b.right, fx: 3}]"));
  expect_vector(built.loads[0][0].whole.force, {15, 0, 0});  // 5 nodes
}

TEST(LoadTotals, ATotalForceIsOneForceOnTheWholeSet) {
  for (const std::string set : {"b.top", "b", "b.right", "b.top_right"}) {
    const Built built = build_text(plane("total_force: [{on: " + set + ", fx: 3, fy: -6}]"));
    expect_vector(built.loads[0][0].whole.force, {3, -6, 0});
    EXPECT_LT((assembled(built) - Vec2(3, -6)).norm(), 1e-12) << set;
  }
  // Spread by length: its line of action goes through the middle of the side.
  const Built top = build_text(plane("total_force: [{on: b.top, fy: -6}]"));
  expect_vector(top.loads[0][0].whole.moment, {0, 0, -12});
  const Built3 face = built_from(space("total_force: [{on: b.top, fz: -6}]"));
  expect_vector(face.loads[0][0].whole.force, {0, 0, -6});
  expect_vector(face.loads[0][0].whole.moment, {-6, 12, 0});
}

TEST(LoadTotals, PressureTractionAndBodyForce) {
  const Built built = build_text(plane(
      "pressure: [{on: b.top, value: 3}], traction: [{on: b.right, ty: 2}], body_force: [{on: "
      "b, bx: 0.5}]"));
  ASSERT_EQ(built.loads[0].size(), 3u);
  expect_vector(built.loads[0][0].whole.force, {0, 4, 0});  // traction
  expect_vector(built.loads[0][0].whole.moment, {0, 0, 16});
  expect_vector(built.loads[0][1].whole.force, {4, 0, 0});  // body force
  expect_vector(built.loads[0][1].whole.moment, {0, 0, -4});
  expect_vector(built.loads[0][2].whole.force, {0, -12, 0});  // pressure
  expect_vector(built.loads[0][2].whole.moment, {0, 0, -24});
}

TEST(LoadTotals, TheWeightOfAllMasses) {
  const Built3 built = built_from(space("gravity: [0, 0, -10]"));
  EXPECT_EQ(built.loads[0][0].kind, "gravity");
  expect_vector(built.loads[0][0].whole.force, {0, 0, -160});
  expect_vector(built.loads[0][0].whole.moment, {-160, 320, 0});
}

TEST(LoadTotals, ARingIsTakenWhole) {
  const Built built = build_text(plane(
      "total_force: [{on: b.top, fy: -6}], pressure: [{on: b.bottom, value: 1}]", "axisymmetric"));
  EXPECT_NEAR(built.loads[0][0].whole.force.y(), -6, 1e-12);
  EXPECT_NEAR(built.loads[0][1].whole.force.y(), 16 * std::acos(-1.0), 1e-9);  // pi 4^2
}

TEST(LoadTotals, AmplitudesAndWhatStaysFromEarlierSteps) {
  const Built built = build_text(plane("total_force: [{on: b.top, fy: -8, amplitude: wave}]"));
  ASSERT_EQ(built.loads.size(), 2u);
  const LoadTotal& one = built.loads[0].at(0);
  EXPECT_EQ(one.values, "fy -8");
  EXPECT_EQ(one.amplitude, "wave");
  EXPECT_FALSE(one.kept);
  expect_vector(one.whole.force, {0, -8, 0});
  expect_vector(one.end.force, {0, -2, 0});
  const LoadTotal& two = built.loads[1].at(0);
  EXPECT_TRUE(two.kept);
  expect_vector(two.end.force, {0, -2, 0});
}

TEST(LoadTotals, WhatATotalForceCannotActOn) {
  EXPECT_EQ(any_refusal(plane("total_force: [{on: b.left, fx: 1}]")),
            "model.yaml:7: steps[0].total_force[0].fx: a force cannot be given where line 7 "
            "prescribes ux of 'b.left'");
  EXPECT_EQ(
      any_refusal(plane("total_force: [{on: b.top, fz: 1}]")),
      "model.yaml:7: steps[0].total_force[0].fz: 'fz' exists in space only, and this model is "
      "plane: no section has the element solid or solid_shell");
}

}  // namespace
}  // namespace osculate::deck
