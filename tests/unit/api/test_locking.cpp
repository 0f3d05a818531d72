// Bodies of first-order cells with full integration that are too stiff are told of, with the
// formulation that is not; by default there are none.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "warnings_of.hpp"

namespace osculate::api {
namespace {
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// A beam 10 x 1 whose end is bent down.
std::string beam(const std::string& elements, const std::string& section) {
  return fmt::format(R"(osculate: 1
mesh: {{generate: {{b: {{box: {{x: [0, 10], y: [0, 1], elements: {}}}}}}}}}
materials: {{m: {{linear_elastic: {{E: 100, nu: 0.3}}}}}}
sections: [{{on: b, material: m, {}}}]
steps: [{{name: bend, increments: 1, prescribe: [{{on: b.left, ux: 0, uy: 0}}, {{on: b.right, uy: -0.1}}]}}]
output: {{fields: none, report: false}}
)",
                     elements, section);
}

TEST(Locking, ABeamOfOneLayerOfCellsIsTooStiff) {
  const std::string full = "element: plane_stress, formulation: full";
  EXPECT_THAT(warnings_of(beam("[10, 1]", full)),
              ElementsAre(AllOf(HasSubstr("section 'b'"), HasSubstr("formulation: enhanced"))));
  EXPECT_THAT(warnings_of(beam("[10, 1]", "element: plane_stress, formulation: enhanced")),
              IsEmpty());
  EXPECT_THAT(warnings_of(beam("[60, 6]", full)), IsEmpty());
}

TEST(Locking, ByDefaultNothingLocks) {
  for (const char* const element : {"plane_stress", "plane_strain", "axisymmetric"})
    EXPECT_THAT(warnings_of(beam("[10, 1]", std::string("element: ") + element)), IsEmpty())
        << element;
}

TEST(Locking, APlateInARingIsTooStiff) {
  EXPECT_THAT(warnings_of(beam("[10, 1]", "element: axisymmetric, formulation: full")),
              ElementsAre(HasSubstr("formulation: enhanced")));
}

TEST(Locking, ABeamInSpaceLikewise) {
  std::string text = beam("[10, 1, 1]", "element: solid, formulation: full");
  text.replace(text.find("y: [0, 1],"), 10, "y: [0, 1], z: [0, 1],");
  text.replace(text.find("uy: 0}"), 6, "uy: 0, uz: 0}");
  text.replace(text.find("uy: -0.1"), 8, "uz: -0.1");
  EXPECT_THAT(warnings_of(text), ElementsAre(HasSubstr("formulation: enhanced")));
}

/// A plate of triangles, 10 x 10, with what its sides are held and moved by.
std::string plate(const std::string& type, double height, int layers, const std::string& moved,
                  const std::string& formulation = "auto") {
  return fmt::format(R"(osculate: 1
mesh: {{generate: {{b: {{box: {{x: [0, 10], y: [0, 10], z: [0, {}], elements: [6, 6, {}], type: {}}}}}}}}}
materials: {{m: {{linear_elastic: {{E: 100, nu: 0.3}}}}}}
sections: [{{on: b, material: m, element: solid, formulation: {}}}]
steps: [{{name: bend, increments: 1, prescribe: [{}]}}]
output: {{fields: none, report: false}}
)",
                     height, layers, type, formulation, moved);
}

// A layer of a thick body and one that is sheared have a shear that is real.
TEST(Locking, APlateOfOneLayerOfTrianglesIsTooStiff) {
  const std::string bent = "{on: b.left, ux: 0, uy: 0, uz: 0}, {on: b.right, uz: -0.1}";
  const std::string sheared = "{on: b.bottom, ux: 0, uy: 0, uz: 0}, {on: b.top, ux: 0.001, uz: 0}";
  for (const char* const formulation : {"full", "reduced"}) {
    SCOPED_TRACE(formulation);
    EXPECT_THAT(warnings_of(plate("wedge6", 0.5, 1, bent, formulation)),
                ElementsAre(HasSubstr("second-order cells (S6 in place of S3)")));
    EXPECT_THAT(warnings_of(plate("wedge6", 0.5, 1, sheared, formulation)), IsEmpty());
    EXPECT_THAT(warnings_of(plate("wedge6", 5, 8, bent, formulation)), IsEmpty());
  }
  EXPECT_THAT(warnings_of(plate("wedge15", 0.5, 1, bent)), IsEmpty());
}

/// A block whose top is pressed down over its left half, or all over.
std::string block(const std::string& more, const std::string& where, double poisson = 0.4999) {
  return fmt::format(R"(osculate: 1
mesh: {{generate: {{b: {{box: {{x: [0, 1, 2], y: [0, 1], elements: [4, 4]}}}}}}}}
materials: {{m: {{linear_elastic: {{E: 100, nu: {}}}}}}}
sections: [{{on: b, material: m, element: plane_strain{}}}]
rigid: {{punch: {{line: {{point: [0, 1], normal: [0, -1]}}}}}}
contact: [{{name: c, master: punch, slave: b.top, normal: {{penalty: 1e5}}}}]
steps: [{{name: press, increments: 1, prescribe: [{}]}}]
output: {{fields: none, report: false}}
)",
                     poisson, more, where);
}

TEST(Locking, ABlockThatHardlyChangesItsVolumeIsTooStiff) {
  const std::string pressed =
      "{on: b.bottom, ux: 0, uy: 0}, {on: b.left, ux: 0}, {on: punch, uy: -0.01}";
  EXPECT_THAT(
      warnings_of(block(", formulation: full", pressed)),
      ElementsAre(AllOf(HasSubstr("nearly incompressible"), HasSubstr("formulation: bbar"))));
  EXPECT_THAT(warnings_of(block(", formulation: bbar", pressed)), IsEmpty());
  EXPECT_THAT(warnings_of(block("", pressed)), IsEmpty());
  EXPECT_THAT(warnings_of(block(", formulation: full", pressed, 0.3)), IsEmpty());
}

/// A quarter of a thick cylinder under internal pressure.
std::string cylinder(const std::string& type, const std::string& formulation, double poisson) {
  return fmt::format(R"(osculate: 1
mesh: {{generate: {{t: {{ring: {{radius: [1, 2], angle: [0, 90], elements: [2, 2], type: {}}}}}}}}}
materials: {{m: {{linear_elastic: {{E: 1, nu: {}}}}}}}
sections: [{{on: t, material: m, element: plane_strain, formulation: {}}}]
steps: [{{name: s, increments: 1, prescribe: [{{on: t.from, uy: 0}}, {{on: t.to, ux: 0}}], pressure: [{{on: t.inner, value: 0.01}}]}}]
output: {{fields: none, report: false}}
)",
                     type, poisson, formulation);
}

TEST(Locking, CurvedPlainCellsOfSecondOrderThatHardlyChangeTheirVolumeLockToo) {
  for (const char* const type : {"quad8", "quad9", "tri6"}) {
    SCOPED_TRACE(type);
    for (const char* const plain : {"auto", "full"}) {
      EXPECT_THAT(warnings_of(cylinder(type, plain, 0.4999)),
                  ElementsAre(AllOf(HasSubstr("strains that plain cells"),
                                    HasSubstr("give it formulation: bbar, or more cells"))));
      EXPECT_THAT(warnings_of(cylinder(type, plain, 0.3)), IsEmpty());
    }
    EXPECT_THAT(warnings_of(cylinder(type, "bbar", 0.4999)), IsEmpty());
  }
}

TEST(Locking, UniformCompressionDoesNotLock) {
  EXPECT_THAT(warnings_of(block(", formulation: full",
                                "{on: b.bottom, uy: 0}, {on: b.left, ux: 0}, {on: punch, uy: "
                                "-0.01}")),
              IsEmpty());
}

/// The same of a metal that yields at a strain of 0.1 %.
std::string metal(const std::string& more, const std::string& where) {
  std::string text = block(more, where);
  text.replace(text.find("linear_elastic: {E: 100, nu: 0.4999}"), 36,
               "elastoplastic: {E: 1000, nu: 0.3, yield: 1}");
  text.replace(text.find("increments: 1,"), 14, "increments: 5,");
  return text;
}

TEST(Locking, AMetalThatFlowsIsTooStiff) {
  const auto pressed = [](double way) {
    return fmt::format(
        "{{on: b.bottom, ux: 0, uy: 0}}, {{on: b.left, ux: 0}}, {{on: punch, uy: {}}}", -way);
  };
  // (beside what is said of such strains with small kinematics)
  EXPECT_THAT(
      warnings_of(metal(", formulation: full", pressed(0.08))),
      Contains(AllOf(HasSubstr("section 'b'"), HasSubstr("work done on cells that flow"),
                     HasSubstr("since flow keeps the volume"), HasSubstr("formulation: bbar"))));
  for (const char* const sound : {"", ", formulation: enhanced"})
    EXPECT_THAT(warnings_of(metal(sound, pressed(0.08))),
                Not(Contains(HasSubstr("cells that flow"))));
  EXPECT_THAT(warnings_of(metal(", formulation: full", pressed(0.0015))), IsEmpty());  // begins to
}

/// What its cells remember stands behind what those of another section do, which rests.
TEST(Locking, AMetalThatFlowsBesideOneThatDoesNot) {
  std::string text = metal(", formulation: full",
                           "{on: a.bottom, ux: 0, uy: 0}, {on: b.bottom, ux: 0, uy: 0}, {on: "
                           "b.left, ux: 0}, {on: punch, uy: -0.08}");
  const auto insert = [&](const std::string& before, const std::string& what) {
    const std::size_t at = text.find(before);
    ASSERT_NE(at, std::string::npos) << before;
    text.insert(at, what);
  };
  insert("b: {box:", "a: {box: {x: [5, 6], y: [0, 1], elements: [8, 8]}}, ");
  insert("{on: b, material: m", "{on: a, material: m, element: plane_strain, formulation: full}, ");
  EXPECT_THAT(warnings_of(text),
              Contains(AllOf(HasSubstr("section 'b'"), HasSubstr("work done on cells that flow"))));
}

TEST(Locking, UniformFlowDoesNotLock) {
  EXPECT_THAT(warnings_of(metal(", formulation: full",
                                "{on: b.bottom, uy: 0}, {on: b.left, ux: 0}, {on: punch, uy: "
                                "-0.01}")),
              IsEmpty());
}

}  // namespace
}  // namespace osculate::api
