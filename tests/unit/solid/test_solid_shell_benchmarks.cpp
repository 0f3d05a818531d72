#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "shell_benchmark.hpp"

// Classical thin shells on the meshes that are quick. The expected numbers are what an independent
// implementation of the same elements gives on the same meshes; verification/solid_shell holds the
// product against all of them and against shell theory.

namespace osculate::solid::testing {
namespace {

using cell::CellType;
using osculate::testing::ShellSolution;
using verification::shell::mid_displacement;
using verification::shell::ShellProblem;

void expect_within(const char* what, double found, double expected, double relative) {
  std::printf("    %-44s %10.5f  (expected %g)\n", what, found, expected);
  EXPECT_NEAR(found, expected, relative * std::abs(expected)) << what;
}

ShellSolution solved(const ShellProblem& p, int steps) {
  const ShellSolution s = osculate::testing::solve(p, steps);
  EXPECT_TRUE(s.converged) << "after " << s.u.size() << " of " << steps << " steps";
  if (s.u.size() > 1) std::printf("    %d iterations in %d steps\n", s.iterations, steps);
  return s;
}

void cantilever(CellType type, Index cells, double u, double w) {
  const ShellProblem p = verification::shell::cantilever(type, cells);
  const ShellSolution s = solved(p, 10);
  if (!s.converged) return;
  const Vec3 tip = mid_displacement(p.mesh, s.u.back(), p.mesh.end_u(), 0);
  expect_within("cantilever U", -tip.x(), u, 0.001);
  expect_within("cantilever W", tip.z(), w, 0.001);
}

TEST(SolidShellBenchmark, CantileverUnderEndShear) {
  cantilever(CellType::hex8, 16, 3.293, 6.705);
  cantilever(CellType::hex8, 32, 3.291, 6.702);
  cantilever(CellType::shell18, 8, 3.290, 6.700);
}

void roll_up(CellType type, Index cells, double u, double w) {
  constexpr std::size_t steps = 40;
  const ShellProblem p = verification::shell::roll_up(type, cells);
  const ShellSolution s = solved(p, steps);
  if (!s.converged) return;
  const Vec3 half = mid_displacement(p.mesh, s.u[steps / 2 - 1], p.mesh.end_u(), 0);
  const Vec3 tip = mid_displacement(p.mesh, s.u.back(), p.mesh.end_u(), 0);
  expect_within("roll-up half U", half.x(), -12, 0.02);
  expect_within("roll-up half W", half.z(), 7.639, 0.02);
  expect_within("roll-up U", tip.x(), u, 0.001);
  std::printf("    %-44s %10.5f  (expected %g)\n", "roll-up W", tip.z(), w);
  EXPECT_NEAR(tip.z(), w, 0.01);
}

TEST(SolidShellBenchmark, RollUpUnderEndMoment) {
  roll_up(CellType::hex8, 16, -11.66, 0.031);
  roll_up(CellType::hex8, 32, -11.91, 0.002);
  roll_up(CellType::shell18, 8, -11.974, 0);
}

void pinched_cylinder(CellType type, Index cells, double ratio) {
  const ShellProblem p = verification::shell::pinched_cylinder(type, cells);
  const ShellSolution s = solved(p, 1);
  if (!s.converged) return;
  expect_within("pinched cylinder", -mid_displacement(p.mesh, s.u.back(), 0, 0).x() / 1.8248e-5,
                ratio, 0.01);
}

TEST(SolidShellBenchmark, PinchedCylinderWithDiaphragms) {
  pinched_cylinder(CellType::hex8, 8, 0.755);
  pinched_cylinder(CellType::hex8, 16, 0.930);
  pinched_cylinder(CellType::shell18, 8, 0.9985);
}

void scordelis_lo(CellType type, Index cells, double ratio) {
  const ShellProblem p = verification::shell::scordelis_lo(type, cells);
  const ShellSolution s = solved(p, 1);
  if (!s.converged) return;
  const Vec3 edge = mid_displacement(p.mesh, s.u.back(), p.mesh.end_u(), 0);
  expect_within("Scordelis-Lo roof", -edge.z() / 0.3024, ratio, 0.01);
}

TEST(SolidShellBenchmark, ScordelisLoRoof) {
  scordelis_lo(CellType::hex8, 8, 1.0065);
  scordelis_lo(CellType::hex8, 16, 0.9976);
  scordelis_lo(CellType::shell18, 8, 0.995);
}

void hemisphere_linear(CellType type, Index cells, double expected) {
  const ShellProblem p =
      verification::shell::hemisphere(type, cells, verification::shell::linear(6.825e7, 0.3), 2);
  const ShellSolution s = solved(p, 1);
  if (!s.converged) return;
  expect_within("hemisphere, linear", mid_displacement(p.mesh, s.u.back(), 0, 0).x(), expected,
                0.005);
}

TEST(SolidShellBenchmark, HemisphereWithHoleLinear) {
  hemisphere_linear(CellType::hex8, 16, 0.09329);
  hemisphere_linear(CellType::shell18, 8, 0.09305);
}

}  // namespace
}  // namespace osculate::solid::testing
