// Vibrations of model files: with multipliers, and what part of the whole moves.
#include <gtest/gtest.h>

#include <numbers>

#include "osculate/deck/build.hpp"
#include "osculate/deck/parse.hpp"

namespace osculate::deck {
namespace {

/// Of the last step.
model::Vibrations vibrations(const std::string& text) {
  const Description d = parse_model(text, "m.yaml");
  const Built built = build(d, load_mesh(d));
  const model::AnalysisResult result = model::run(built.model, built.options, {});
  EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
  return result.steps.back().vibrations.value();
}

/// A closed contact by multipliers, which have no mass, holds the end of a bar: f_n = n / (2 L)
/// sqrt(E / rho), and vibration n takes part by 8 / (n pi)^2 of the mass if n is odd.
TEST(Vibrations, OfABarOnMultipliers) {
  const model::Vibrations v = vibrations(
      "osculate: 1\n"
      "mesh: {generate: {bar: {box: {x: [0, 1], y: [0, 0.1], elements: [30, 1], type: quad8}}, "
      "wall: {line: {points: [[1.0000001, 1], [1.0000001, -1]], elements: 1}}}}\n"
      "materials: {m: {linear_elastic: {E: 100, nu: 0, density: 1}}}\n"
      "sections: [{on: bar, material: m, element: plane_strain}]\n"
      "rigid: {stop: {set: wall}}\n"
      "contact: [{name: end, master: stop, slave: bar.right, sampling: nodes, normal: {penalty: "
      "50}, enforcement: lagrange_multiplier}]\n"
      "steps:\n"
      "  - {name: press, increments: 1, prescribe: [{on: bar.left, ux: 1e-6}, {on: bar, uy: 0}]}\n"
      "  - {name: closed, modes: 3}\n");
  ASSERT_EQ(v.omega_squared.size(), 3);
  const double mass = 0.1;
  for (int n = 1; n <= 3; ++n) {
    EXPECT_NEAR(model::frequency(v.omega_squared[n - 1]), 5.0 * n, 2e-5 * 5.0 * n);
    const double part = v.participation(n - 1, 0), angle = n * std::numbers::pi;
    EXPECT_NEAR(part * part / mass, n % 2 == 0 ? 0 : 8 / (angle * angle), 1e-4) << n;
  }
  EXPECT_LT(v.moving_mass[0], mass);
  EXPECT_GT(v.moving_mass[0], 0.9 * mass);
}

/// A ring moves as a whole along its axis alone.
TEST(Vibrations, OfAFreeRing) {
  const model::Vibrations v = vibrations(
      "osculate: 1\n"
      "mesh: {generate: {b: {box: {x: [1, 2], y: [0, 1], elements: [2, 2], type: quad8}}}}\n"
      "materials: {m: {linear_elastic: {E: 100, nu: 0.3, density: 2}}}\n"
      "sections: [{on: b, material: m, element: axisymmetric}]\n"
      "steps: [{name: free, modes: 4}]\n");
  const double mass = 2 * std::numbers::pi * 3;
  EXPECT_NEAR(v.moving_mass[1], mass, 1e-12 * mass);
  EXPECT_NEAR(v.participation.col(1).squaredNorm(), mass, 1e-9 * mass);
  for (const int other : {0, 2, 3, 4, 5}) {
    EXPECT_EQ(v.moving_mass[other], 0.0);
    EXPECT_EQ(v.participation.col(other).norm(), 0.0);
  }
}

/// A strip between supports that is pulled: small strain counts its stress as finite strain does,
/// and motions along vibrations rest on the same stiffness.
std::string pulled(const std::string& material, const std::string& steps) {
  return "osculate: 1\n"
         "mesh: {generate: {b: {box: {x: [0, 1], y: [0, 0.02], elements: [20, 1], type: quad8}}}}\n"
         "materials: {m: {" +
         material + ": {E: 1000, nu: 0, density: 1}}}\n" +
         "sections: [{on: b, material: m, element: plane_stress}]\n"
         "steps:\n"
         "  - {name: pull, increments: 1, prescribe: [{on: b.left, ux: 0, uy: 0}, {on: b.right, "
         "ux: "
         "1e-4, uy: 0}]}\n" +
         steps;
}

TEST(Vibrations, CountTheStressesOfSmallStrain) {
  const std::string both =
      "  - {name: last, modes: 2}\n  - {name: first, modes: {count: 2, about: start}}\n";
  std::vector<Eigen::VectorXd> found;
  for (const char* const material : {"linear_elastic", "st_venant_kirchhoff"}) {
    const Description d = parse_model(pulled(material, both), "m.yaml");
    const Built built = build(d, load_mesh(d));
    const model::AnalysisResult result = model::run(built.model, built.options, {});
    ASSERT_EQ(result.outcome, solve::Outcome::converged) << result.message;
    for (std::size_t s : {1, 2}) found.push_back(result.steps[s].vibrations->omega_squared);
  }
  // clamped: f^2 rises by T / T_cr, T_cr of the buckling mode about (2 pi)^2 E I / L^2
  const double rise = found[0][0] / found[1][0];
  EXPECT_GT(rise, 1.07);
  EXPECT_LT(rise, 1.09);
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(found[3][i] / found[1][i], 1, 1e-9);
    EXPECT_NEAR(found[2][i] / found[0][i], 1, 6e-4);  // of strain 1e-4: shape and stress
  }
}

}  // namespace
}  // namespace osculate::deck
