// Slaves that begin deep in their masters are told of, unless that is what was asked for.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "warnings_of.hpp"

namespace osculate::api {
namespace {
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A soft column of cells 0.1 high that begins `overlap` deep in a rigid floor.
std::string column(double overlap, const std::string& initial) {
  return fmt::format(R"(osculate: 1
mesh: {{generate: {{b: {{box: {{x: [0, 1], y: [{}, {}], elements: [1, 20]}}}}}}}}
materials: {{m: {{linear_elastic: {{E: 100, nu: 0}}}}}}
sections: [{{on: b, material: m, element: plane_strain}}]
rigid: {{ground: {{line: {{point: [0, 0], normal: [0, 1]}}}}}}
contact: [{{name: c, master: ground, slave: b.bottom, normal: {{penalty: 1e6}}{}}}]
steps: [{{name: press, increments: 2, prescribe: [{{on: b.top, ux: 0, uy: -0.001}}]}}]
output: {{fields: none, report: false}}
)",
                     -overlap, 2 - overlap, initial);
}

TEST(InitialGaps, AnOverlapOfEightCellsIsToldOf) {
  const std::vector<std::string> found = warnings_of(column(0.8, ""));
  ASSERT_FALSE(found.empty());
  EXPECT_THAT(found[0],
              HasSubstr("contact 'c': the slave begins 0.8 deep in the master, 8 times the "
                        "height of the cells, at node"));
  EXPECT_THAT(found[0], HasSubstr("all of its points are behind the master; if that should face"));
}

TEST(InitialGaps, SmallOverlapsAndThoseThatAreMeantAreNot) {
  EXPECT_THAT(warnings_of(column(0.01, "")), IsEmpty());
  EXPECT_THAT(warnings_of(column(0.15, ", initial: ramp")), IsEmpty());
  EXPECT_THAT(warnings_of(column(0.15, ", initial: keep")), IsEmpty());
  EXPECT_THAT(warnings_of(column(0.8, ", initial: {clearance: 0}")), IsEmpty());
}

}  // namespace
}  // namespace osculate::api
