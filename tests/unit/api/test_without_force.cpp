// A body that nothing holds follows the one that touches it, without a force: told of at the end.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "warnings_of.hpp"

namespace osculate::api {
namespace {
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

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
}

}  // namespace
}  // namespace osculate::api
