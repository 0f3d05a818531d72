// A law that pulls at surfaces that may part is told of.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "warnings_of.hpp"

namespace osculate::api {
namespace {
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A block on a floor, moved by `uy`.
std::string block(const std::string& normal, double uy) {
  return fmt::format(R"(osculate: 1
mesh: {{generate: {{b: {{box: {{x: [0, 2], y: [0, 1], elements: [4, 2]}}}}}}}}
materials: {{m: {{linear_elastic: {{E: 1000, nu: 0}}}}}}
sections: [{{on: b, material: m, element: plane_strain}}]
rigid: {{floor: {{line: {{point: [0, 0], normal: [0, 1]}}}}}}
contact: [{{name: c, master: floor, slave: b.bottom, normal: {}}}]
steps: [{{name: lift, increments: 2, prescribe: [{{on: b.top, ux: 0, uy: {}}}]}}]
output: {{fields: none, report: false}}
)",
                     normal, uy);
}

TEST(Pulling, IsToldOfAtTheEndOfAStep) {
  const std::string tensile = "{tensile: {stiffness: 1e4, tension: 5, clearance: 0.05}}";
  EXPECT_THAT(
      warnings_of(block(tensile, 0.004)),
      ElementsAre(AllOf(HasSubstr("contact 'c': at the end of step 'lift' its law pulls at"),
                        HasSubstr("holds what would be free"))));
  EXPECT_THAT(warnings_of(block(tensile, -0.004)), IsEmpty());
  EXPECT_THAT(warnings_of(block("{penalty: 1e4, separation: no_separation}", 0.004)), IsEmpty());
}

}  // namespace
}  // namespace osculate::api
