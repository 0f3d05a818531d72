#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "osculate/cell/quadrature.hpp"
#include "shell_benchmark.hpp"

// Classical thin shells. The expected numbers are what an independent implementation of the same
// elements gives on the same meshes; what the shell theory gives is printed beside them.

namespace osculate::solid::testing {
namespace {

using cell::CellType;
using osculate::testing::edge_shares;
using osculate::testing::mid_displacement;
using osculate::testing::shell_mesh;
using osculate::testing::ShellMesh;
using osculate::testing::ShellProblem;
using osculate::testing::ShellSolution;
using std::numbers::pi;

VolumeSection linear(double young, double poisson) {
  return {Kinematics::small, VolumeFormulation::solid_shell,
          material::LinearElastic{young, poisson, 0}};
}
VolumeSection finite(double young, double poisson) {
  return {Kinematics::finite, VolumeFormulation::solid_shell,
          material::StVenantKirchhoff{young, poisson, 0}};
}

void expect_within(const char* what, double found, double expected, double relative,
                   double theory) {
  std::printf("    %-44s %10.5f  (expected %g, theory %g)\n", what, found, expected, theory);
  EXPECT_NEAR(found, expected, relative * std::abs(expected)) << what;
}

ShellSolution solved(const ShellProblem& p, int steps) {
  const ShellSolution s = osculate::testing::solve(p, steps);
  EXPECT_TRUE(s.converged) << "after " << s.u.size() << " of " << steps << " steps";
  if (s.u.size() > 1) std::printf("    %d iterations in %d steps\n", s.iterations, steps);
  return s;
}

/// A strip along x in the plane z = 0, clamped at x = 0.
ShellProblem strip(CellType type, int cells, double length, double height) {
  ShellProblem p(shell_mesh(type, cells, 1,
                            [&](double u, double v, double z) {
                              return Vec3(length * u, v, 0.5 * height * z);
                            }),
                 finite(1.2e6, 0));
  for (Index j = 0; j < p.mesh.count_v; ++j)
    for (Index side = 0; side < 2; ++side)
      for (int c = 0; c < 3; ++c) p.fix(p.mesh.node(0, j, side), c);
  return p;
}

// Sze, Liu & Lo 2004: U 3.286, W 6.698.
void cantilever(CellType type, int cells, int steps, double u, double w) {
  ShellProblem p = strip(type, cells, 10, 0.1);
  const std::vector<double> share = edge_shares(type, p.mesh.count_v);
  for (Index j = 0; j < p.mesh.count_v; ++j)
    for (Index side = 0; side < 2; ++side)
      p.load[3 * p.mesh.node(p.mesh.count_u - 1, j, side) + 2] = 0.5 * 4 * share[std::size_t(j)];
  const ShellSolution s = solved(p, steps);
  if (!s.converged) return;
  const Vec3 tip = mid_displacement(p.mesh, s.u.back(), p.mesh.count_u - 1, 0);
  expect_within("cantilever U", -tip.x(), u, 0.001, 3.286);
  expect_within("cantilever W", tip.z(), w, 0.001, 6.698);
}

TEST(SolidShellBenchmark, CantileverUnderEndShear) {
  cantilever(CellType::hex8, 16, 10, 3.293, 6.705);
  cantilever(CellType::hex8, 32, 10, 3.291, 6.702);
  cantilever(CellType::shell18, 8, 10, 3.290, 6.700);
}

// A moment of 2 pi EI / L winds the strip to a full circle: U -12, W 0; half of it: -12, 7.639.
void roll_up(CellType type, int cells, int steps, double u, double w) {
  ShellProblem p = strip(type, cells, 12, 0.1);
  const std::vector<double> share = edge_shares(type, p.mesh.count_v);
  const Index end = p.mesh.count_u - 1;
  for (Index j = 0; j < p.mesh.count_v; ++j)
    p.moment.pairs.push_back(
        {p.mesh.node(end, j, 0), p.mesh.node(end, j, 1), -50 * pi / 3 * share[std::size_t(j)]});
  const ShellSolution s = solved(p, steps);
  if (!s.converged) return;
  const Vec3 half = mid_displacement(p.mesh, s.u[std::size_t(steps / 2 - 1)], end, 0);
  const Vec3 tip = mid_displacement(p.mesh, s.u.back(), end, 0);
  expect_within("roll-up half U", half.x(), -12, 0.02, -12);
  expect_within("roll-up half W", half.z(), 7.639, 0.02, 7.639);
  expect_within("roll-up U", tip.x(), u, 0.001, -12);
  std::printf("    %-44s %10.5f  (expected %g)\n", "roll-up W", tip.z(), w);
  EXPECT_NEAR(tip.z(), w, 0.01);
}

TEST(SolidShellBenchmark, RollUpUnderEndMoment) {
  roll_up(CellType::hex8, 16, 40, -11.66, 0.031);
  roll_up(CellType::hex8, 32, 40, -11.91, 0.002);
  roll_up(CellType::shell18, 8, 40, -11.974, 0);
}

/// Symmetry about a plane of constant u (edge true) or v.
void fix_edge(ShellProblem& p, bool along_v, Index at, std::initializer_list<int> components) {
  for (Index k = 0; k < (along_v ? p.mesh.count_v : p.mesh.count_u); ++k)
    for (Index side = 0; side < 2; ++side)
      for (const int c : components)
        p.fix(along_v ? p.mesh.node(at, k, side) : p.mesh.node(k, at, side), c);
}

// R 300, L 600, h 3, E 3e6, nu 0.3, two unit forces, ends held by diaphragms: an eighth. Radial
// displacement under the force 1.8248e-5.
void pinched_cylinder(CellType type, int cells, double ratio) {
  // u: angle from the loaded generatrix (x direction), v: along the axis from the middle
  ShellProblem p(shell_mesh(type, cells, cells,
                            [](double u, double v, double z) {
                              const double r = 300 + 1.5 * z, a = 0.5 * pi * u;
                              return Vec3(r * std::cos(a), r * std::sin(a), 300 * v);
                            }),
                 linear(3e6, 0.3));
  fix_edge(p, true, 0, {1});
  fix_edge(p, true, p.mesh.count_u - 1, {0});
  fix_edge(p, false, 0, {2});
  fix_edge(p, false, p.mesh.count_v - 1, {0, 1});
  for (Index side = 0; side < 2; ++side) p.load[3 * p.mesh.node(0, 0, side)] = -0.125;
  const ShellSolution s = solved(p, 1);
  if (!s.converged) return;
  expect_within("pinched cylinder", -mid_displacement(p.mesh, s.u.back(), 0, 0).x() / 1.8248e-5,
                ratio, 0.01, 1);
}

TEST(SolidShellBenchmark, PinchedCylinderWithDiaphragms) {
  pinched_cylinder(CellType::hex8, 8, 0.755);
  pinched_cylinder(CellType::hex8, 16, 0.930);
  pinched_cylinder(CellType::shell18, 8, 0.9985);
}

/// Adds a constant body force per reference volume.
void add_body_force(ShellProblem& p, const Vec3& force) {
  const cell::Quadrature1D rule = cell::gauss_legendre(4);
  for (const std::vector<Index>& nodes : p.mesh.cells)
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = 0; b < 4; ++b)
        for (std::size_t c = 0; c < 4; ++c) {
          const cell::VolumeShape shape =
              cell::volume_shape(p.mesh.type, {rule.points[a], rule.points[b], rule.points[c]});
          Mat<3, 3> jacobian = Mat<3, 3>::Zero();
          for (std::size_t k = 0; k < nodes.size(); ++k)
            jacobian += p.mesh.nodes[std::size_t(nodes[k])] * shape.d.row(Eigen::Index(k));
          const double volume =
              rule.weights[a] * rule.weights[b] * rule.weights[c] * jacobian.determinant();
          for (std::size_t k = 0; k < nodes.size(); ++k)
            p.load.segment<3>(3 * nodes[k]) += volume * shape.n[Eigen::Index(k)] * force;
        }
}

// R 25, L 50, 80 degrees, h 0.25, E 4.32e8, nu 0, weight 90 per area, ends held by diaphragms: a
// quarter. Vertical displacement in the middle of the free edge 0.3024.
void scordelis_lo(CellType type, int cells, double ratio) {
  // u: angle from the top, v: along the axis from the middle
  ShellProblem p(shell_mesh(type, cells, cells,
                            [](double u, double v, double z) {
                              const double r = 25 + 0.125 * z, a = 40 * pi / 180 * u;
                              return Vec3(r * std::sin(a), 25 * v, r * std::cos(a));
                            }),
                 linear(4.32e8, 0));
  fix_edge(p, true, 0, {0});
  fix_edge(p, false, 0, {1});
  fix_edge(p, false, p.mesh.count_v - 1, {0, 2});
  add_body_force(p, {0, 0, -90 / 0.25});
  const ShellSolution s = solved(p, 1);
  if (!s.converged) return;
  const Vec3 edge = mid_displacement(p.mesh, s.u.back(), p.mesh.count_u - 1, 0);
  expect_within("Scordelis-Lo roof", -edge.z() / 0.3024, ratio, 0.01, 1);
}

TEST(SolidShellBenchmark, ScordelisLoRoof) {
  scordelis_lo(CellType::hex8, 8, 1.0065);
  scordelis_lo(CellType::hex8, 16, 0.9976);
  scordelis_lo(CellType::shell18, 8, 0.995);
}

// R 10, h 0.04, a hole of 18 degrees at the pole, E 6.825e7, nu 0.3, two pairs of opposite forces
// at the equator, inwards along y and outwards along x: a quarter, half the forces.
ShellProblem hemisphere(CellType type, int cells, const VolumeSection& section, double force) {
  // u: angle from the x axis, v: from the equator
  ShellProblem p(shell_mesh(type, cells, cells,
                            [](double u, double v, double z) {
                              const double r = 10 + 0.02 * z, a = 0.5 * pi * u,
                                           b = 72 * pi / 180 * v;
                              return Vec3(r * std::cos(a) * std::cos(b),
                                          r * std::sin(a) * std::cos(b), r * std::sin(b));
                            }),
                 section);
  const Index end = p.mesh.count_u - 1;
  fix_edge(p, true, 0, {1});
  fix_edge(p, true, end, {0});
  p.fix(p.mesh.node(0, 0, 0), 2);
  for (Index side = 0; side < 2; ++side) {
    p.load[3 * p.mesh.node(0, 0, side)] = 0.25 * force;
    p.load[3 * p.mesh.node(end, 0, side) + 1] = -0.25 * force;
  }
  return p;
}

void hemisphere_linear(CellType type, int cells, double expected) {
  const ShellProblem p = hemisphere(type, cells, linear(6.825e7, 0.3), 2);
  const ShellSolution s = solved(p, 1);
  if (!s.converged) return;
  expect_within("hemisphere, linear", mid_displacement(p.mesh, s.u.back(), 0, 0).x(), expected,
                0.005, 0.093);
}

TEST(SolidShellBenchmark, HemisphereWithHoleLinear) {
  hemisphere_linear(CellType::hex8, 16, 0.09329);
  hemisphere_linear(CellType::shell18, 8, 0.09305);
}

// Sze, Liu & Lo 2004 at P = 400: 4.067 outwards, 8.178 inwards.
void hemisphere_finite(CellType type, int cells, double outwards, double inwards) {
  const ShellProblem p = hemisphere(type, cells, finite(6.825e7, 0.3), 400);
  const ShellSolution s = solved(p, 20);
  if (!s.converged) return;
  const Index end = p.mesh.count_u - 1;
  expect_within("hemisphere, outwards", mid_displacement(p.mesh, s.u.back(), 0, 0).x(), outwards,
                0.01, 4.067);
  expect_within("hemisphere, inwards", -mid_displacement(p.mesh, s.u.back(), end, 0).y(), inwards,
                0.01, 8.178);
}

// Longer than a unit test may be: run with --gtest_also_run_disabled_tests.
TEST(SolidShellBenchmark, DISABLED_HemisphereWithHoleFinite) {
  hemisphere_finite(CellType::hex8, 16, 3.968, 7.818);
  hemisphere_finite(CellType::shell18, 8, 4.023, 7.969);
}

// Radii 6 and 10, h 0.03, E 21e6, nu 0, a slit with one side clamped and 0.8 per length along the
// other: Sze, Liu & Lo 2004 have 13.891 (inner corner) and 17.528 (outer corner).
// (The hex8 of the independent implementation has no membrane modes here, 13.168 and 16.813, which
// this one gives without them, too.)
void slit_plate(CellType type, int around, int across, double inner, double outer) {
  ShellProblem p(shell_mesh(type, across, around,
                            [](double u, double v, double z) {
                              const double r = 6 + 4 * u, a = 2 * pi * v;
                              return Vec3(r * std::cos(a), r * std::sin(a), 0.015 * z);
                            }),
                 finite(21e6, 0));
  const Index end = p.mesh.count_v - 1;
  fix_edge(p, false, 0, {0, 1, 2});
  const std::vector<double> share = edge_shares(type, p.mesh.count_u);
  for (Index i = 0; i < p.mesh.count_u; ++i)
    for (Index side = 0; side < 2; ++side)
      p.load[3 * p.mesh.node(i, end, side) + 2] = 0.5 * 0.8 * 4 * share[std::size_t(i)];
  const ShellSolution s = solved(p, 80);
  if (!s.converged) return;
  expect_within("slit plate, inner", mid_displacement(p.mesh, s.u.back(), 0, end).z(), inner, 0.01,
                13.891);
  expect_within("slit plate, outer",
                mid_displacement(p.mesh, s.u.back(), p.mesh.count_u - 1, end).z(), outer, 0.01,
                17.528);
}

TEST(SolidShellBenchmark, DISABLED_SlitAnnularPlate) {
  slit_plate(CellType::hex8, 30, 6, 13.437, 17.073);
  slit_plate(CellType::shell18, 15, 3, 13.483, 17.121);
  slit_plate(CellType::shell18, 30, 5, 13.794, 17.431);
}

}  // namespace
}  // namespace osculate::solid::testing
