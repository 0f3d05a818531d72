// Which rigid motions the prescriptions leave a body.
#include "osculate/model/supports.hpp"

#include <gmock/gmock.h>

#include "space_test.hpp"
#include "system_test.hpp"

namespace osculate::deck {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

std::string plane(const std::string& step, const std::string& element = "plane_strain") {
  return "osculate: 1\n"
         "mesh: {generate: {b: {box: {x: [0, 4], y: [0, 2], elements: [4, 2]}}}}\n"
         "materials: {m: {linear_elastic: {E: 1, nu: 0.3}}}\n"
         "sections: [{on: b, material: m, element: " +
         element +
         "}]\n"
         "rigid: {floor: {line: {point: [0, 0], normal: [0, 1]}}}\n"
         "contact: [{name: c, master: floor, slave: b.bottom, normal: {penalty: 1}}]\n"
         "steps: [{name: s, increments: 1, " +
         step + "}]\n";
}

std::vector<model::Support> plane_supports(const std::string& text) {
  const Built built = build_text(text);
  return model::supports(built.model, built.model.steps[0]);
}

TEST(Supports, ABodyThatNothingHolds) {
  const auto found = plane_supports(plane("body_force: [{on: b, by: -1}]"));
  ASSERT_THAT(found, SizeIs(2));
  EXPECT_EQ(found[0].body, "b");
  EXPECT_EQ(found[0].held, 0u);
  EXPECT_TRUE(found[0].all_free);
  EXPECT_THAT(found[0].contact, ElementsAre("c"));
  EXPECT_EQ(found[1].body, "floor");
  EXPECT_TRUE(found[1].rigid);
  EXPECT_THAT(found[1].free, IsEmpty());
}

TEST(Supports, APinLeavesTheTurnAboutIt) {
  EXPECT_THAT(plane_supports(plane("prescribe: [{on: b.bottom_right, ux: 0, uy: 0}]"))[0].free,
              ElementsAre("turn about (4, 0)"));
  EXPECT_THAT(plane_supports(plane("prescribe: [{on: b.bottom, uy: 0}]"))[0].free,
              ElementsAre("move along x"));
  EXPECT_THAT(
      plane_supports(plane("prescribe: [{on: b.bottom, uy: 0}, {on: b.left, ux: 0}]"))[0].free,
      IsEmpty());
}

TEST(Supports, AForceSetsARigidBodyFree) {
  EXPECT_THAT(plane_supports(plane("forces: [{on: floor, fy: 1}]"))[1].free,
              ElementsAre("move along y"));
}

TEST(Supports, ARingHasOneRigidMotion) {
  EXPECT_THAT(plane_supports(plane("prescribe: [{on: b.left, ux: 0}]", "axisymmetric"))[0].free,
              ElementsAre("move along y"));
  EXPECT_THAT(plane_supports(plane("prescribe: [{on: b.left, uy: 0}]", "axisymmetric"))[0].free,
              IsEmpty());
}

TEST(Supports, AHingeInSpace) {
  const Built3 built = built_from(
      "osculate: 1\n"
      "mesh: {generate: {b: {box: {x: [0, 4], y: [0, 2], z: [0, 1], elements: [2, 2, 1]}}}}\n"
      "materials: {m: {linear_elastic: {E: 1, nu: 0.3}}}\n"
      "sections: [{on: b, material: m, element: solid}]\n"
      "steps: [{name: s, increments: 1, prescribe: [{on: b.bottom_left, ux: 0, uy: 0, uz: 0}]}]\n");
  const auto found = model::supports(built.model, built.model.steps[0]);
  EXPECT_THAT(found[0].free, ElementsAre("turn about y through (0, 1, 0)"));
}

}  // namespace
}  // namespace osculate::deck
