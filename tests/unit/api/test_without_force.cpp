// A body that nothing holds follows the one that touches it, without a force: told of at the end.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "warnings_of.hpp"

namespace osculate::api {
namespace {
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// A block on another one, pressed down; `held`: what is prescribed of the lower one.
std::string blocks(const std::string& held, const std::string& more = "") {
  return fmt::format(R"(osculate: 1
mesh:
  generate:
    low: {{box: {{x: [-2, 2], y: [-1, 0], elements: [8, 2]}}}}
    up: {{box: {{x: [-1, 1], y: [0, 1], elements: [5, 2]}}}}
materials: {{m: {{linear_elastic: {{E: 100, nu: 0.3}}}}}}
sections: [{{on: low, material: m, element: plane_strain}}, {{on: up, material: m, element: plane_strain}}]
contact: [{{name: c, master: low.top, slave: up.bottom, friction: {{coulomb: {{mu: 0.3}}}}}}]
steps: [{{name: press, increments: 2, prescribe: [{}{{on: up.top, ux: 0, uy: -0.01}}]{}}}]
output: {{fields: none, report: false}}
)",
                     held, more);
}

TEST(WithoutForce, ABodyThatNothingHoldsIsNamed) {
  EXPECT_THAT(warnings_of(blocks("")),
              ElementsAre(HasSubstr("contact 'c' touched, but pressed nowhere: nothing but contact "
                                    "holds 'low'")));
}

TEST(WithoutForce, ABodyThatIsHeldIsNotNamed) {
  EXPECT_THAT(warnings_of(blocks("{on: low.bottom, ux: 0, uy: 0}, ")), IsEmpty());
}

TEST(WithoutForce, ABodyThatALoadPressesOnIsNotNamed) {
  EXPECT_THAT(warnings_of(blocks("", ", pressure: [{on: low.bottom, value: 0.1}]")), IsEmpty());
  // Pressures without penetration are none of an automatic penalty.
  std::string other = blocks("", ", pressure: [{on: low.bottom, value: 0.1}]");
  const std::string at = "slave: up.bottom, ";
  other.replace(other.find(at), at.size(),
                at + "normal: {exponential: {pressure: 10, clearance: 0.01}}, ");
  EXPECT_THAT(warnings_of(other), Not(Contains(HasSubstr("nowhere"))));
}

/// By a rigid body.
TEST(WithoutForce, ABodyThatIsHeldByOthersIsNotNamed) {
  std::string gripped = blocks("");
  const std::string at = "contact: [";
  gripped.replace(gripped.find(at), at.size(), "rigid: {grip: {set: low.bottom}}\n" + at);
  const std::string prescribed = "prescribe: [";
  gripped.replace(gripped.find(prescribed), prescribed.size(),
                  prescribed + "{on: grip, ux: 0, uy: 0, rz: 0}, ");
  EXPECT_THAT(warnings_of(gripped), Not(Contains(HasSubstr("nowhere"))));
}

}  // namespace
}  // namespace osculate::api
