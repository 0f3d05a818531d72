// Contacts that never close are told of once, with the reason.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "warnings_of.hpp"

namespace osculate::api {
namespace {
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A block over a floor, which is moved by `uy`.
std::string block(const std::string& floor, double uy, const std::string& more = "") {
  return fmt::format(R"(osculate: 1
mesh: {{generate: {{b: {{box: {{x: [0, 2], y: [0, 1], elements: [2, 2]}}}}}}}}
materials: {{m: {{linear_elastic: {{E: 100, nu: 0}}}}}}
sections: [{{on: b, material: m, element: plane_strain}}]
rigid: {{floor: {{{}}}}}
contact: [{{name: c, master: floor, slave: b.bottom, normal: {{penalty: 1e5}}{}}}]
steps: [{{name: press, increments: 2, prescribe: [{{on: b.top, ux: 0, uy: {}}}]}}]
output: {{fields: none, report: false}}
)",
                     floor, more, uy);
}

TEST(NeverClosed, AContactThatClosesIsNotMentioned) {
  EXPECT_THAT(warnings_of(block("line: {point: [0, -0.01], normal: [0, 1]}", -0.011)), IsEmpty());
}

TEST(NeverClosed, AFlippedFloorIsNamed) {
  EXPECT_THAT(warnings_of(block("line: {point: [0, -0.01], normal: [0, -1]}", -0.02)),
              ElementsAre(AllOf(HasSubstr("contact 'c' was never closed"),
                                HasSubstr("normals of master and slave point the same way"))));
}

TEST(NeverClosed, APolylineInTheWrongOrderIsNamed) {
  EXPECT_THAT(warnings_of(block("polyline: {points: [[3, -0.01], [-1, -0.01]]}", -0.02)),
              ElementsAre(AllOf(HasSubstr("never closed"), HasSubstr("the order of points"))));
}

TEST(NeverClosed, BodiesThatMoveApartAreNamed) {
  EXPECT_THAT(warnings_of(block("line: {point: [0, -0.01], normal: [0, 1]}", 0.02)),
              ElementsAre(HasSubstr("the bodies only move apart, from 0.01 to 0.03")));
}

TEST(NeverClosed, AFloorTooFarAwayIsNamedWithTheGap) {
  EXPECT_THAT(warnings_of(block("line: {point: [0, -0.5], normal: [0, 1]}", -0.01)),
              ElementsAre(HasSubstr("contact 'c' was never closed: smallest gap 0.49")));
}

TEST(NeverClosed, ACoarseSlaveAroundASmallMasterIsNamed) {
  const std::vector<std::string> found =
      warnings_of(block("circle: {center: [0.5, -0.1], radius: 0.1}", -0.05));
  EXPECT_THAT(found, ElementsAre(HasSubstr("exchange slave and master")));
  EXPECT_THAT(warnings_of(block("circle: {center: [0.5, -0.1], radius: 0.1}", -0.05,
                                ", sampling: {gauss: 20}")),
              IsEmpty());
}

TEST(NeverClosed, ABodyThatOnlyAnOpenContactCouldHold) {
  std::string text = block("line: {point: [0, -0.01], normal: [0, -1]}", 0);
  text.replace(text.find("uy: 0}]"), 7, "}], pressure: [{on: b.top, value: 1}]");
  text.replace(text.find("ux: 0, }"), 8, "ux: 0}");
  EXPECT_THAT(warnings_of(text, RunStatus::stopped),
              ElementsAre(HasSubstr("normals of master and slave point the same way")));
}

TEST(NeverClosed, APairOfAllBodiesMayStayOpenWhereAnotherCloses) {
  const auto two = [](double uy) {
    return fmt::format(R"(osculate: 1
mesh: {{generate: {{a: {{box: {{x: [0, 1], y: [0, 1], elements: [2, 2]}}}}, b: {{box: {{x: [5, 6], y: [0, 1], elements: [2, 2]}}}}}}}}
materials: {{m: {{linear_elastic: {{E: 100, nu: 0}}}}}}
sections: [{{on: a, material: m, element: plane_strain}}, {{on: b, material: m, element: plane_strain}}]
rigid: {{floor: {{line: {{point: [0, -0.01], normal: [0, 1]}}}}}}
contact: {{all: {{name: every}}}}
steps: [{{name: press, increments: 2, prescribe: [{{on: a.top, ux: 0, uy: {}}}, {{on: b.top, ux: 0, uy: 0}}]}}]
output: {{fields: none, report: false}}
)",
                       uy);
  };
  EXPECT_THAT(warnings_of(two(-0.011)), IsEmpty());
  EXPECT_THAT(warnings_of(two(0.01)), ElementsAre(HasSubstr("contact 'every' was never closed")));
}

}  // namespace
}  // namespace osculate::api
