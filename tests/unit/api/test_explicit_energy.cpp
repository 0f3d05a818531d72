// Energy that explicit time integration makes out of nothing is told of.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "warnings_of.hpp"

namespace osculate::api {
namespace {
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

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

/// With default steps, wherever in a time step the bounce begins and ends.
TEST(ExplicitEnergy, OfAPenaltyIsKeptWithinAPercent) {
  for (int i = 0; i < 25; ++i) {
    const double height = 0.01 + 0.0013 * i;
    EXPECT_THAT(warnings_of(bouncing("{penalty: 1000}", height)), IsEmpty()) << height;
  }
}

/// Two elastic blocks, of which one comes with its flat face or an edge first.
TEST(ExplicitEnergy, OfElasticBlocksIsKeptWithinAPercent) {
  for (const char* const law : {"", ", normal: {penalty: 1e6}", ", sampling: mortar",
                                ", sampling: nodes, friction: {coulomb: {mu: 0.3}}"})
    for (const double angle : {0.0, 0.3})
      for (const double height : {0.01, 0.0137, 0.02}) {
        const std::string model = fmt::format(R"(osculate: 1
mesh:
  generate:
    low: {{box: {{x: [0, 3], y: [-1, 0], elements: [12, 4]}}}}
    high: {{box: {{x: [1, 2], y: [{0}, {1}], elements: [7, 7], angle: {2}, about: [1, {0}]}}}}
materials: {{m: {{linear_elastic: {{E: 1000, nu: 0.3, density: 1}}}}}}
sections: [{{on: low, material: m, element: plane_strain}}, {{on: high, material: m, element: plane_strain}}]
contact: [{{name: c, master: low.top, slave: high.bottom{3}}}]
initial_velocity: [{{on: high, vy: -1}}]
steps: [{{name: s, increments: 1, duration: 0.2, dynamics: {{scheme: central_differences}}, prescribe: [{{on: low.bottom, ux: 0, uy: 0}}]}}]
output: {{fields: none, report: false}}
)",
                                              height, 1 + height, angle, law);
        for (const std::string& warning : warnings_of(model))
          EXPECT_THAT(warning, Not(HasSubstr("out of nothing"))) << model;
      }
}

}  // namespace
}  // namespace osculate::api
