// One rigid master with a valley, and unknown tractions: points stay in it, leave it and turn in
// it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>

#include "system_test.hpp"

namespace osculate::deck {
namespace {

constexpr double tilt = std::numbers::pi / 6;  ///< of both slopes of a groove

/// A square of mass 1 that does not turn, its lowest corner `up` the left slope of a groove, and
/// loads in steps of 2.
std::string in_groove(double up, double mu, const std::string& loads, bool meshed = false) {
  const double x = -up * std::cos(tilt), y = up * std::sin(tilt), r = 0.05;
  const std::string friction =
      mu > 0 ? fmt::format("{{coulomb: {{mu: {}, penalty: 1000}}}}", mu) : std::string("none");
  return fmt::format(
      R"(osculate: 1
mesh: {{generate: {{square: {{line: {{points: [[{0:.17g}, {1:.17g}], [{2:.17g}, {3:.17g}], [{0:.17g}, {4:.17g}],
                                         [{5:.17g}, {3:.17g}], [{0:.17g}, {1:.17g}]], elements: [1, 1, 1, 1]}}}}{11}}}}}
rigid:
  bead: {{set: square, reference: [{0:.17g}, {3:.17g}], mass: 1, inertia: 1}}
  groove: {10}
contact:
  - {{name: c, master: groove, slave: bead, sampling: nodes, weight: node, normal: {{penalty: 1000}},
     friction: {8}, enforcement: lagrange_multiplier}}
amplitudes:
  grows: [[0, 0], [1, 1]]
  at_once: [[0, 1], [1, 1]]
steps:
  - {{name: move, increments: 200, duration: 4, gravity: [0, -1],
     prescribe: [{{on: bead, rz: 0}}], dynamics: {{impact: plastic}}{9}}}
)",
      x, y, x - r, y + r, y + 2 * r, x + r, -2 / std::tan(tilt), 2 / std::tan(tilt), friction,
      loads,
      meshed ? std::string("{set: vee}")
             : fmt::format("{{polyline: {{points: [[{:.17g}, 2], [0, 0], [{:.17g}, 2]]}}}}",
                           -2 / std::tan(tilt), 2 / std::tan(tilt)),
      meshed ? fmt::format(", vee: {{line: {{points: [[{:.17g}, 2], [0, 0], [{:.17g}, 2]], "
                           "elements: [1, 1]}}}}",
                           -2 / std::tan(tilt), 2 / std::tan(tilt))
             : std::string());
}

using Look = std::function<void(const model::System&, const model::State&)>;

void run(const std::string& text, const Look& look) {
  const Built built = build_text(text);
  model::AnalysisObserver observer;
  observer.converged = [&](model::System& system, const model::State& state, const model::Progress&,
                           const solve::IncrementRecord* record) {
    if (record) look(system, state);
    return true;
  };
  const model::AnalysisResult result = model::run(built.model, built.options, observer);
  EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
}

Vec2 corner_of(const model::System& system, const model::State& state) {
  return system.positions(state)[0];
}

/// Without friction it slides down and up the other side with the cosine of its speed, again and
/// again, and comes to rest in the valley, which carries its weight.
TEST(ReentrantVertices, ABeadWithoutFrictionComesToRest) {
  double time = 0, farthest = 0, first_up = 0;
  constexpr double way = 0.2;
  const double down = std::sqrt(2 * way / std::sin(tilt));
  run(in_groove(way, 0, ""), [&](const model::System& system, const model::State& state) {
    time = state.rates.energies.elapsed;
    const Vec2 at = corner_of(system, state);
    if (time > down) first_up = std::max(first_up, at.x() / std::cos(tilt));
    EXPECT_GE(at.y(), std::abs(at.x()) * std::tan(tilt) - 1e-10);
    if (time < 3.5) return;
    farthest = std::max(farthest, at.norm());
    const Vec2 force = system.forces().contact.segment<2>(0);
    EXPECT_NEAR((force - Vec2(0, -1)).norm(), 0, 1e-9);
  });
  EXPECT_GT(time, 3.9);
  EXPECT_NEAR(first_up, way * std::pow(std::cos(2 * tilt), 2), 0.05 * way);
  EXPECT_LT(farthest, 1e-12);
}

/// A push that grows to twice the weight drives it out where the cone of both faces ends.
TEST(ReentrantVertices, ABeadLeavesWhereTheConeEnds) {
  for (const auto& [mu, meshed] : {std::pair{0.0, false}, {0.3, false}, {0.0, true}, {0.3, true}}) {
    const double limit = std::tan(tilt + std::atan(mu));
    double begun = 0;
    run(in_groove(0, mu, ", forces: [{on: bead, fx: 2, amplitude: grows}]", meshed),
        [&](const model::System& system, const model::State& state) {
          const Vec2 at = corner_of(system, state);
          if (begun == 0 && at.norm() > 1e-12) begun = state.rates.energies.elapsed;
          EXPECT_NEAR(at.y(), std::tan(tilt) * std::abs(at.x()), 1e-10);
          EXPECT_GE(at.x(), begun > 0 ? 1e-13 : -1e-12);
        });
    EXPECT_GT(begun / 2, limit) << mu;  // load 2 t / 4, increments of 0.02
    EXPECT_LT(begun / 2, limit + 0.02) << mu;
  }
}

TEST(ReentrantVertices, ABeadIsLiftedOff) {
  Vec2 last = Vec2::Zero();
  run(in_groove(0, 0.3, ", forces: [{on: bead, fy: 1.02, amplitude: at_once}]"),
      [&](const model::System& system, const model::State& state) {
        last = corner_of(system, state);
        EXPECT_LT(system.forces().contact.segment<2>(0).norm(), 1e-9);
      });
  EXPECT_NEAR(last.x(), 0, 1e-12);
  EXPECT_NEAR(last.y(), 0.5 * 0.02 * 16, 0.01 * 0.16);
}

/// A block in the corner of an elastic angle, pushed into it: its corner node stays where the
/// vertex goes, which takes part in the forces of both legs.
TEST(ReentrantVertices, OfAnElasticBodyMoveWithIt) {
  const std::string file = ::testing::TempDir() + "angle.msh";
  std::ofstream(file) << R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
3
1 2 "inner"
1 3 "foot"
2 1 "angle"
$EndPhysicalNames
$Nodes
8
1 0 0 0
2 1 0 0
3 2 0 0
4 0 1 0
5 1 1 0
6 2 1 0
7 0 2 0
8 1 2 0
$EndNodes
$Elements
7
1 3 2 1 1 1 2 5 4
2 3 2 1 1 2 3 6 5
3 3 2 1 1 4 5 8 7
4 1 2 2 2 8 5
5 1 2 2 2 5 6
6 1 2 3 3 1 2
7 1 2 3 3 2 3
$EndElements
)";
  for (const double mu : {0.0, 0.3}) {
    Vec2 corner = Vec2::Zero(), vertex = Vec2::Zero(), sum = Vec2::Zero();
    run(fmt::format(R"(osculate: 1
mesh:
  files: {{angle: {{file: {0}}}}}
  generate: {{block: {{box: {{x: [1, 1.6], y: [1, 1.5], elements: [2, 2]}}}}}}
materials: {{m: {{linear_elastic: {{E: 100, nu: 0.3}}}}}}
sections:
  - {{on: block, element: plane_strain, material: m}}
  - {{on: angle.angle, element: plane_strain, material: m}}
contact:
  - {{name: c, master: angle.inner, slave: [block.bottom, block.left], sampling: nodes,
     normal: {{penalty: 1000}}, friction: {1}, enforcement: lagrange_multiplier}}
steps:
  - {{name: push, increments: 2, prescribe: [{{on: block.top, ux: -0.02, uy: -0.02}},
                                            {{on: angle.foot, ux: 0, uy: 0}}]}}
)",
                    file, mu > 0 ? "{coulomb: {mu: 0.3, penalty: 1000}}" : "none"),
        [&](const model::System& system, const model::State& state) {
          const std::vector<Vec2> x = system.positions(state);
          corner = x[0];  // the block's nodes come first
          vertex = x[13];
          sum.setZero();
          for (Eigen::Index n = 0; n < system.forces().contact.size() / 2; ++n)
            sum += system.forces().contact.segment<2>(2 * n);
        });
    EXPECT_GT((vertex - Vec2(1, 1)).norm(), 1e-3);
    EXPECT_LT((corner - vertex).norm(), 1e-10) << mu;
    EXPECT_LT(sum.norm(), 1e-10);
  }
}

/// docs/turning_block.md: the corner stays where it is, and the block turns about it.
TEST(ReentrantVertices, ABlockTurnsAboutItsCorner) {
  constexpr double slid = 0.6, mu = 0.5, q = std::numbers::sqrt2 / 2;
  const double brake = q * (1 - mu), impact = std::sqrt(2 * slid / brake),
               rate = 0.75 * std::sqrt(2 * slid * brake);
  const auto at = [&](double along, double out) {
    return fmt::format("[{:.17g}, {:.17g}]", q * (-along + out), q * (along + out));
  };
  const std::string text = fmt::format(
      R"(osculate: 1
mesh: {{generate: {{block: {{line: {{points: [{0}, {1}, {2}, {3}, {0}], elements: [1, 1, 1, 1]}}}}}}}}
rigid:
  body: {{set: block, reference: {4}, mass: 1, inertia: {5:.17g}}}
  reentrant: {{polyline: {{points: [[-4, 4], [0, 0], [6, 0]]}}}}
contact:
  - {{name: c, master: reentrant, slave: body, sampling: nodes, weight: node, normal: {{penalty: 1.0e4}},
     friction: {{coulomb: {{mu: {6}, penalty: 1.0e4}}}}, enforcement: lagrange_multiplier}}
steps: [{{name: turn, increments: 600, duration: 2.4, gravity: [0, -1], dynamics: {{impact: plastic}}}}]
)",
      at(slid, 0), at(slid + 1, 0), at(slid + 1, 1), at(slid, 1), at(slid + 0.5, 0.5), 1.0 / 6, mu);
  double farthest = 0, first_rate = 0;
  run(text, [&](const model::System& system, const model::State& state) {
    if (state.rates.energies.elapsed < impact + 0.01) return;
    farthest = std::max(farthest, corner_of(system, state).norm());
    if (first_rate == 0) first_rate = -state.rates.velocity[state.u.size() + 2];
  });
  EXPECT_LT(farthest, 1e-11);
  EXPECT_NEAR(first_rate, rate, 0.01 * rate);
}

/// An elastic block in a channel of facets that turns, `corner` of the block after it. The channel
/// is given by its points in `shape`.
Vec2 dragged(int increments, int facets = 90,
             const std::string& shape = "polyline: {{points: [{}]}}") {
  std::string points;
  for (int i = 0; i <= facets; ++i) {
    const double angle = std::numbers::pi * (static_cast<double>(i) / facets - 0.5);
    points +=
        fmt::format("{}[{:.17g}, {:.17g}]", i > 0 ? ", " : "", std::sin(angle), -std::cos(angle));
  }
  Vec2 last = Vec2::Zero();
  run(fmt::format(R"(osculate: 1
mesh: {{generate: {{block: {{box: {{x: [-0.1, 0.1], y: [-0.99, -0.79], elements: [4, 4]}}}}}}}}
materials: {{m: {{neo_hooke: {{E: 100, nu: 0.3}}}}}}
sections: [{{on: block, element: plane_strain, material: m, formulation: full}}]
rigid: {{channel: {{{0}, reference: [0, 0]}}}}
contact:
  - {{name: c, master: channel, slave: block.bottom, sampling: nodes, weight: node,
     normal: {{penalty: 1000}}, friction: {{coulomb: {{mu: 0.2, penalty: 1000}}}},
     enforcement: lagrange_multiplier}}
steps:
  - {{name: press, increments: 4, prescribe: [{{on: block.top, ux: 0, uy: -0.02}},
                                            {{on: channel, rz: 0, ux: 0, uy: 0}}]}}
  - {{name: turn, increments: {1}, prescribe: [{{on: channel, rz: 0.6}}]}}
)",
                  fmt::format(fmt::runtime(shape), points), increments),
      [&](const model::System& system, const model::State& state) {
        last = corner_of(system, state);
      });
  return last;
}

/// ReentrantVertices that are dragged along under a block do not catch its nodes, whatever the
/// increments.
TEST(ReentrantVertices, SlidingNodesPassThem) {
  EXPECT_NEAR((dragged(6) - dragged(24)).norm(), 0, 1e-8);
}

/// One node is held in a valley when the block is pressed on, and dragged out of it.
TEST(ReentrantVertices, CurvesHoldThemAsWell) {
  const Vec2 last = dragged(6, 30);
  EXPECT_NEAR((dragged(6, 30, "composite: [{{polyline: {{points: [{}]}}}}]") - last).norm(), 0,
              1e-10);
}

}  // namespace
}  // namespace osculate::deck
