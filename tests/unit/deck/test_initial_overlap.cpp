// What becomes of slave points that are inside the master from the beginning.
#include <fmt/format.h>

#include "system_test.hpp"

namespace osculate::deck {
namespace {

/// A column of height 1 that overlaps a rigid plane by `overlap`; its top is held.
std::string column(const std::string& initial, double overlap, const std::string& more = "") {
  return fmt::format(R"(osculate: 1
mesh: {{generate: {{b: {{box: {{x: [0, 1], y: [{}, 1], elements: [2, 4]}}}}}}}}
materials: {{m: {{linear_elastic: {{E: 100, nu: 0}}}}}}
sections: [{{on: b, material: m, element: plane_strain}}]
rigid: {{ground: {{line: {{point: [0, 0], normal: [0, 1]}}}}}}
contact: [{{name: c, master: ground, slave: b.bottom, normal: {{penalty: 1000}}{}}}]
steps:
  - {{name: first, increments: 4, prescribe: [{{on: b.top, ux: 0, uy: 0}}{}]}}
  - {{name: second, increments: 2, prescribe: [{{on: b.top, uy: -0.01}}]}}
)",
                     -overlap, initial, more);
}

/// Normal force after each increment.
std::vector<double> forces(const std::string& text) {
  const Built built = build_text(text);
  std::vector<double> out;
  model::AnalysisObserver observer;
  observer.converged = [&](model::System& system, const model::State&, const model::Progress&,
                           const solve::IncrementRecord* record) {
    double sum = 0;
    for (const pairing::PointResult<2>& point : system.contact()[0].points)
      sum -= point.normal_traction * point.weight;
    if (record) out.push_back(sum);
    return true;
  };
  const model::AnalysisResult result = model::run(built.model, built.options, observer);
  EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
  return out;
}

/// Of springs in a row: the column (E / height) and the penalty.
double force_of(double overlap, double height) { return overlap / (height / 100 + 1.0 / 1000); }

TEST(InitialOverlap, ActsAtOnce) {
  const std::vector<double> f = forces(column("", 0.02));
  ASSERT_EQ(f.size(), 6u);
  EXPECT_NEAR(f[0], force_of(0.02, 1.02), 1e-9);
  EXPECT_NEAR(f[3], force_of(0.02, 1.02), 1e-9);
  EXPECT_NEAR(f[5], force_of(0.03, 1.02), 1e-9);
}

TEST(InitialOverlap, IsLetInOverTheFirstStep) {
  const std::vector<double> f = forces(column(", initial: ramp", 0.02));
  ASSERT_EQ(f.size(), 6u);
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(f[static_cast<std::size_t>(i)], force_of(0.02 * (i + 1) / 4, 1.02), 1e-9);
  EXPECT_NEAR(f[5], force_of(0.03, 1.02), 1e-9);
}

TEST(InitialOverlap, NeverCounts) {
  const std::vector<double> f = forces(column(", initial: keep", 0.02));
  ASSERT_EQ(f.size(), 6u);
  EXPECT_NEAR(f[3], 0, 1e-9);
  EXPECT_NEAR(f[5], force_of(0.01, 1.02), 1e-9);
}

TEST(InitialOverlap, MovesTheSlaveWithoutStrain) {
  const Built built = build_text(column(", initial: adjust", 0.02));
  for (const Index n : built.model.pairs[0].definition.slave.nodes)
    EXPECT_NEAR(built.model.reference[static_cast<std::size_t>(n)].y(), 0, 1e-15);
  ASSERT_EQ(built.notes.size(), 1u);
  EXPECT_EQ(built.notes[0],
            "'c': 3 slave nodes moved onto the master before the first step, by up to 0.02");
  const std::vector<double> f = forces(column(", initial: adjust", 0.02));
  EXPECT_NEAR(f[3], 0, 1e-9);
  EXPECT_NEAR(f[5], force_of(0.01, 1), 1e-9);
}

TEST(InitialOverlap, AToleranceClosesGaps) {
  const std::string open = column(", initial: {adjust: 0.05}", -0.02);
  EXPECT_NEAR(forces(open)[5], force_of(0.01, 1), 1e-9);
  EXPECT_EQ(forces(column(", initial: {adjust: 0.01}", -0.02))[5], 0);
}

// Whatever the mesh has: an overlap, a gap or neither.
TEST(InitialOverlap, AClearanceIsThatOfAllPoints) {
  for (const double overlap : {0.02, -0.02, 0.0}) {
    const std::vector<double> touching = forces(column(", initial: {clearance: 0}", overlap));
    EXPECT_NEAR(touching[3], 0, 1e-9) << overlap;
    EXPECT_NEAR(touching[5], force_of(0.01, 1 + overlap), 1e-9) << overlap;
    const std::vector<double> apart = forces(column(", initial: {clearance: 0.004}", overlap));
    EXPECT_EQ(apart[3], 0) << overlap;
    EXPECT_NEAR(apart[5], force_of(0.006, 1 + overlap), 1e-9) << overlap;
    const std::vector<double> pressed = forces(column(", initial: {clearance: -0.004}", overlap));
    EXPECT_NEAR(pressed[3], force_of(0.004, 1 + overlap), 1e-9) << overlap;
    EXPECT_NEAR(pressed[5], force_of(0.014, 1 + overlap), 1e-9) << overlap;
  }
}

TEST(InitialOverlap, RefusesWhatTurnsCellsInsideOut) {
  try {
    (void)build_text(column(", initial: adjust", 0.6));
    FAIL();
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("inside out"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace osculate::deck
