// A body that bulges onto a plate beside the set that was named is told of.
#include <gmock/gmock.h>

#include "warnings_of.hpp"

namespace osculate::api {
namespace {
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A block of rubber pressed to `height` of 10 between two plates.
std::string pressed(const std::string& contact, double height) {
  return R"(osculate: 1
mesh: {generate: {b: {box: {x: [0, 10], y: [0, 10], elements: [8, 8]}}}}
materials: {m: {neo_hooke: {E: 3, nu: 0.45}}}
sections: [{on: b, material: m, element: plane_strain, formulation: bbar}]
rigid: {low: {line: {point: [0, 0], normal: [0, 1]}}, up: {line: {point: [0, 10], normal: [0, -1]}}}
contact: )" +
         contact + R"(
steps: [{name: s, increments: 12, prescribe: [{on: low, ux: 0, uy: 0, rz: 0}, {on: up, ux: 0, uy: )" +
         std::to_string(height - 10) + R"(, rz: 0}]}]
output: {fields: none, report: false}
)";
}

std::string plates(const std::string& lower, const std::string& upper) {
  return "[{name: l, master: low, slave: " + lower +
         ", friction: {coulomb: {mu: 0.5}}}, {name: u, master: up, slave: " + upper +
         ", friction: {coulomb: {mu: 0.5}}}]";
}

TEST(BeyondSlave, SidesThatPassThePlatesAreNamed) {
  EXPECT_THAT(warnings_of(pressed(plates("b.bottom", "b.top"), 5.8)),
              Contains(AllOf(HasSubstr("beside its slave the body has gone"),
                             HasSubstr("('b.left', 'b.right') into the slave of contact 'l'"))));
}

TEST(BeyondSlave, NothingIsSaidWhereTheSidesBelongToTheSlaveOrStayAway) {
  const std::string sides = ", b.left, b.right]";
  EXPECT_THAT(warnings_of(pressed(plates("[b.bottom" + sides, "[b.top" + sides), 4)), IsEmpty());
  EXPECT_THAT(warnings_of(pressed(plates("b.bottom", "b.top"), 8)), IsEmpty());
  EXPECT_THAT(warnings_of(pressed("{all: {friction: {coulomb: {mu: 0.5}}}}", 4)), IsEmpty());
}

}  // namespace
}  // namespace osculate::api
