// A slave that would go through its master within one increment takes shorter ones.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "warnings_of.hpp"

namespace osculate::api {
namespace {
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

/// Two blocks 0.01 apart, of which the upper is moved down by `uy`.
std::string blocks(const std::string& contact, int increments, double uy) {
  return fmt::format(R"(osculate: 1
mesh: {{generate: {{low: {{box: {{x: [0, 2], y: [0, 1], elements: [4, 2]}}}}, up: {{box: {{x: [0.2, 1.8], y: [1.01, 2.01], elements: [3, 2]}}}}}}}}
materials: {{m: {{linear_elastic: {{E: 1000, nu: 0.3}}}}}}
sections: [{{on: low, material: m, element: plane_strain}}, {{on: up, material: m, element: plane_strain}}]
contact: [{{name: c, master: low.top, slave: up.bottom, {}}}]
steps: [{{name: press, increments: {}, prescribe: [{{on: low.bottom, ux: 0, uy: 0}}, {{on: up.top, ux: 0, uy: {}}}]}}]
output: {{fields: none, report: false}}
)",
                     contact, increments, uy);
}

const auto told = Contains(HasSubstr("went through the master within the increment"));

const auto never_closed = Contains(HasSubstr("was never closed"));

TEST(PassedThrough, ASearchThatIsLessDeepThanTheIncrementIsLong) {
  EXPECT_THAT(warnings_of(blocks("search: {depth: 0.05}", 1, -0.3)),
              AllOf(Not(told), Not(never_closed)));
  EXPECT_THAT(warnings_of(blocks("search: {depth: 0.05}", 20, -0.3)), Not(told));
  EXPECT_THAT(warnings_of(blocks("sampling: nodes", 1, -0.3)), Not(told));
}

TEST(PassedThrough, NoIncrementIsShortEnoughWithoutCuts) {
  const std::string text = blocks("search: {depth: 0.02}", 1, -0.5) + "solver: {cutbacks: 0}\n";
  (void)warnings_of(text, RunStatus::stopped);
}

TEST(PassedThrough, ABlockThatBouncesOffIsNotMeant) {
  const std::string text = R"(osculate: 1
mesh: {generate: {b: {box: {x: [-1, 1], y: [0.01, 1], elements: [8, 4]}}}}
materials: {m: {neo_hooke: {E: 2.0e3, nu: 0.4, density: 1}}}
sections: [{on: b, material: m, element: plane_strain}]
rigid: {floor: {line: {point: [0, 0], normal: [0.2, 1]}}}
contact: [{name: c, master: floor, slave: b, normal: {damping: {restitution: 0.5}}}]
initial_velocity: [{on: b, vy: -6}]
steps: [{name: fall, increments: 60, duration: 0.3, dynamics: {scheme: central_differences}}]
output: {fields: none, report: false}
)";
  EXPECT_THAT(warnings_of(text), Not(told));
}

TEST(PassedThrough, AMortarSlaveThatJumpsOverItsReach) {
  for (const double way : {-0.2, -0.8})
    EXPECT_THAT(warnings_of(blocks("sampling: mortar", 1, way)),
                AllOf(Not(told), Not(never_closed)));
}

}  // namespace
}  // namespace osculate::api
