// A friction penalty that gives way instead of friction is told of.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "warnings_of.hpp"

namespace osculate::api {
namespace {
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A block that is pressed onto a floor, and then pushed along by `ux`.
std::string block(const std::string& penalty, const std::string& ux) {
  return fmt::format(R"(osculate: 1
mesh: {{generate: {{b: {{box: {{x: [0, 2], y: [0, 1], elements: [8, 4]}}}}}}}}
materials: {{m: {{linear_elastic: {{E: 1000, nu: 0}}}}}}
sections: [{{on: b, material: m, element: plane_strain}}]
rigid: {{floor: {{line: {{point: [0, 0], normal: [0, 1]}}}}}}
contact: [{{name: c, master: floor, slave: b.bottom, normal: {{penalty: 1e6}}, friction: {{coulomb: {{mu: 0.3{}}}}}}}]
steps:
  - {{name: press, increments: 1, prescribe: [{{on: b.top, ux: 0, uy: -0.01}}]}}
  - {{name: push, increments: 5, prescribe: [{{on: b.top, ux: {}, uy: -0.01}}]}}
output: {{fields: none, report: false}}
)",
                     penalty, ux);
}

TEST(SoftFriction, APenaltyThatTakesUpTheWholeWayIsToldOf) {
  EXPECT_THAT(
      warnings_of(block(", penalty: 2", "0.5")),
      ElementsAre(AllOf(HasSubstr("contact 'c'"), HasSubstr("give of the friction penalty"))));
}

TEST(SoftFriction, SlidingAndStickingAreNot) {
  EXPECT_THAT(warnings_of(block("", "0.5")), IsEmpty());
  EXPECT_THAT(warnings_of(block("", "0.001")), IsEmpty());
}

TEST(SoftFriction, AMotionOfManyTimesTheMeshIsToldOfBeforeItIsComputed) {
  const std::vector<std::string> found = warnings_of(block("", "50"));
  ASSERT_FALSE(found.empty());
  EXPECT_THAT(found[0], HasSubstr("step 'push' moves 'b.top' by ux = 50, 22 times the size of the "
                                  "mesh (2.24): is it in the units of the mesh?"));
}

}  // namespace
}  // namespace osculate::api
