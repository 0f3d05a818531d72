// Multipliers that say the same thing twice: of two nodes that stick on a rigid face, of
// conditions.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "system_test.hpp"

namespace osculate::deck {
namespace {

constexpr double weight = 3, size = 1;

/// A rigid block on a floor under gravity, pushed sideways.
std::string resting(double push, const char* friction) {
  return fmt::format(R"(osculate: 1
mesh: {{generate: {{block: {{line: {{points: [[{0}, 0], [0, 0], [0, {0}], [{0}, {0}], [{0}, 0]],
                                     elements: [1, 1, 1, 1]}}}}}}}}
rigid:
  body: {{set: block, reference: [0.5, 0.5], mass: {1}, inertia: 0.5}}
  floor: {{polyline: {{points: [[-4, 0], [6, 0]]}}}}
contact:
  - {{name: c, master: floor, slave: body, sampling: nodes, weight: node, normal: {{penalty: 1000}},
     friction: {{coulomb: {{mu: 0.5, penalty: 1000}}}}, enforcement: {2}}}
amplitudes:
  at_once: [[0, 1], [1, 1]]
steps:
  - name: rest
    increments: 4
    duration: 0.4
    gravity: [0, -1]
    forces: [{{on: body, fx: {3}, amplitude: at_once}}]
    dynamics: {{impact: dissipative}}
)",
                     size, weight, friction, push);
}

Vec2 force_on_floor(const model::System& system) {
  Vec2 sum = Vec2::Zero();
  for (Index node = 0; node < 4; ++node) sum += system.forces().contact.segment<2>(2 * node);
  return sum;
}

TEST(RedundantMultipliers, ABlockThatSticksStaysWhereItIs) {
  const Built built = build_text(resting(0.6, "lagrange_multiplier"));
  int increments = 0;
  model::AnalysisObserver observer;
  observer.converged = [&](model::System& system, const model::State& state, const model::Progress&,
                           const solve::IncrementRecord* record) {
    if (!record) return true;
    ++increments;
    EXPECT_LT(state.u.lpNorm<Eigen::Infinity>(), 1e-12);
    EXPECT_LT(state.rates.velocity.lpNorm<Eigen::Infinity>(), 1e-11);
    const Vec2 force = force_on_floor(system);
    EXPECT_NEAR(force.x(), 0.6, 1e-9 * weight);
    EXPECT_NEAR(force.y(), -weight, 1e-9 * weight);
    EXPECT_LE(record->iterations.size(), 4u);
    return true;
  };
  const model::AnalysisResult result = model::run(built.model, built.options, observer);
  EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
  EXPECT_EQ(increments, 4);
}

TEST(RedundantMultipliers, ABlockThatSlidesHasTheRightAcceleration) {
  const Built built = build_text(resting(2.1, "lagrange_multiplier"));
  const model::AnalysisResult result = model::run(built.model, built.options, {});
  ASSERT_EQ(result.outcome, solve::Outcome::converged) << result.message;
  const double acceleration = (2.1 - 0.5 * weight) / weight;
  EXPECT_NEAR(result.state.rigid[0].translation.x(), 0.5 * acceleration * 0.4 * 0.4, 1e-10);
  EXPECT_NEAR(result.state.rates.energies.friction,
              0.5 * weight * result.state.rigid[0].translation.x(), 1e-9);
  EXPECT_NEAR(result.state.rigid[0].angle, 0, 1e-12);
}

/// A column whose top is plane, and an edge of it straight, which says of the node between its ends
/// that it is in the plane once more.
std::string column(double load, int increments = 1) {
  return fmt::format(R"(osculate: 1
mesh: {{generate: {{b: {{box: {{x: [2, 3], y: [0, 1], z: [0, 2], elements: [2, 2, 2]}}}}}}}}
materials: {{n: {{linear_elastic: {{E: 1500, nu: 0.25}}}}}}
sections: [{{on: b, material: n, element: solid}}]
coplanar: [{{on: b.top}}]
collinear: [{{on: b.top_front}}]
sets: {{rod: {{union: [b.top_back_left, b.bottom_front_right]}}}}
fixed_distance: [{{on: rod}}]
steps:
  - {{name: s, increments: {2}, prescribe: [{{on: b.bottom, ux: 0, uy: 0, uz: 0}}],
     forces: [{{on: b.top_front_left, fx: {0}, fz: {1}}}]}}
)",
                     5 * load, -9 * load, increments);
}

double out_of_plane(const std::vector<Vec3>& x) {
  const Vec3 normal = (x[2] - x[0]).cross(x[6] - x[0]).normalized();  // corners
  double most = 0;
  for (const Vec3& y : x) most = std::max(most, std::abs(normal.dot(y - x[0])));
  return most;
}

TEST(RedundantMultipliers, ConditionsOfNodesThatSayTheSameTwiceTakeNoMoreIterations) {
  for (const double load : {0.9, 0.97, 0.99, 1.0, 1.01, 1.03, 1.1, 1.5}) {
    SCOPED_TRACE(load);
    const Description description = parse_model(column(load), "model.yaml");
    const Built3 built = build3(description, load_mesh(description));
    const auto result = model::run(built.model, built.options, {});
    ASSERT_EQ(result.outcome, solve::Outcome::converged) << result.message;
    ASSERT_EQ(result.steps.front().increments.size(), 1U);
    const solve::IncrementRecord& record = result.steps.front().increments.front();
    EXPECT_EQ(record.cutbacks, 0);
    EXPECT_LE(record.iterations.size(), 4U);
    EXPECT_LT(record.iterations.back().residual, 1e-11);
    std::vector<Vec3> top;
    for (std::size_t n = 0; n < built.model.reference.size(); ++n)
      if (built.model.reference[n].z() == 2)
        top.push_back(built.model.reference[n] +
                      result.state.u.segment<3>(3 * static_cast<Eigen::Index>(n)));
    ASSERT_EQ(top.size(), 9U);
    EXPECT_LT(out_of_plane(top), 1e-12);
  }
}

/// Increments that begin where the last ones point to, off the conditions.
TEST(RedundantMultipliers, AndNoMoreInIncrementsThatBeginWhereOthersPointTo) {
  const Description description = parse_model(column(2, 8), "model.yaml");
  const Built3 built = build3(description, load_mesh(description));
  const auto result = model::run(built.model, built.options, {});
  ASSERT_EQ(result.outcome, solve::Outcome::converged) << result.message;
  for (const solve::IncrementRecord& record : result.steps.front().increments) {
    EXPECT_EQ(record.cutbacks, 0);
    EXPECT_LE(record.iterations.size(), 4U);
    EXPECT_LT(record.iterations.back().residual, 1e-9);
  }
}

}  // namespace
}  // namespace osculate::deck
