// Energy that explicit time integration makes out of nothing is told of.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "warnings_of.hpp"

namespace osculate::api {
namespace {
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A rigid block that falls flat on a floor and bounces.
std::string bouncing(const std::string& law, double height) {
  return fmt::format(R"(osculate: 1
mesh: {{generate: {{cells: {{box: {{x: [0, 2], y: [{}, 1], elements: [1, 1]}}}}}}}}
rigid: {{block: {{set: cells, mass: 2, inertia: 1.5}}, floor: {{line: {{point: [0, 0], normal: [0, 1]}}}}}}
contact: [{{name: c, master: floor, slave: cells.bottom, weight: node, normal: {}}}]
initial_velocity: [{{on: block, vy: -1}}]
steps: [{{name: fall, increments: 1, duration: 0.3, dynamics: {{scheme: central_differences}}}}]
output: {{fields: none, report: false}}
)",
                     height, law);
}

/// The stable step is estimated from the slope at the start, which is a hundredth of the later one.
TEST(ExplicitEnergy, OfALawThatGetsMuchSteeperIsToldOf) {
  EXPECT_THAT(warnings_of(bouncing("{table: [[0, 0], [0.001, 0.1], [0.002, 10]]}", 0.04)),
              ElementsAre(HasSubstr("of the energy out of nothing: take shorter time steps")));
}

TEST(ExplicitEnergy, OfAPenaltyIsKept) {
  for (const double height : {0.01, 0.014, 0.016, 0.02, 0.028, 0.03})
    EXPECT_THAT(warnings_of(bouncing("{penalty: 1000}", height)), IsEmpty()) << height;
}

}  // namespace
}  // namespace osculate::api
