// A clearance is that of points that have a place on the master at the start; others that come into
// contact later are told of.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "warnings_of.hpp"

namespace osculate::api {
namespace {
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A block that juts out over the end of a rail, pressed down by 0.005 more than the clearance, and
/// dragged.
std::string overhang(const std::string& initial, double way) {
  return fmt::format(R"(osculate: 1
mesh:
  generate:
    block: {{box: {{x: [0.5, 1.5], y: [0, 0.5], elements: [4, 2]}}}}
    rail: {{line: {{points: [[0, 0], [1.05, 0]], elements: 4}}}}
materials: {{m: {{linear_elastic: {{E: 100, nu: 0}}}}}}
sections: [{{on: block, material: m, element: plane_strain}}]
rigid: {{base: {{set: rail}}}}
contact: [{{name: floor, master: base, slave: block.bottom, sampling: nodes, normal: {{penalty: 1e4}}{}}}]
steps:
  - {{name: press, increments: 1, prescribe: [{{on: block.top, ux: 0, uy: -0.015}}]}}
  - {{name: drag, increments: 1, prescribe: [{{on: block.top, ux: {}}}]}}
output: {{fields: none, report: false}}
)",
                     initial, way);
}

TEST(WithoutClearance, IsToldOfOnceWhereItMatters) {
  const std::string given = ", initial: {clearance: 0.01}";
  EXPECT_THAT(warnings_of(overhang(given, -0.3)),
              ElementsAre(AllOf(HasSubstr("contact 'floor': 1 points are in contact that had no "
                                          "place on the master at the start"),
                                HasSubstr("(1.25, 0)"))));
  // As long as they stay outside, and where nothing is given, there is nothing to tell.
  EXPECT_THAT(warnings_of(overhang(given, -0.1)), IsEmpty());
  EXPECT_THAT(warnings_of(overhang("", -0.3)), IsEmpty());
  EXPECT_THAT(warnings_of(overhang(", initial: {clearance: 0}", -0.1)), IsEmpty());
}

}  // namespace
}  // namespace osculate::api
