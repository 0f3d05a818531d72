// Buckling of model files: what acts on top of what, and what is refused.
#include <gtest/gtest.h>

#include <numbers>

#include "osculate/deck/build.hpp"
#include "osculate/deck/parse.hpp"

namespace osculate::deck {
namespace {

/// A clamped column of length 10 and height 0.5 along x, with more sections or contacts.
std::string column(const std::string& steps, const std::string& more = "",
                   const std::string& material = "linear_elastic: {E: 1000, nu: 0}") {
  return "osculate: 1\n"
         "mesh: {generate: {c: {box: {x: [0, 10], y: [0, 0.5], elements: [16, 1], type: quad8}}}}\n"
         "materials: {m: {" +
         material +
         "}}\n"
         "sections: [{on: c, material: m, element: plane_stress}]\n" +
         more + "steps:\n" + steps;
}
const std::string clamped = "prescribe: [{on: c.left, ux: 0, uy: 0}]";

model::AnalysisResult answer_of(const std::string& text) {
  const Description d = parse_model(text, "m.yaml");
  const Built built = build(d, load_mesh(d));
  return model::run(built.model, built.options, {});
}
model::AnalysisResult buckled(const std::string& text) {
  model::AnalysisResult result = answer_of(text);
  EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
  return result;
}
Eigen::VectorXd factors_of(const model::AnalysisResult& result) {
  return result.steps.back().buckling.value().factors;
}
std::string error_of(const std::string& text) {
  try {
    const Description d = parse_model(text, "m.yaml");
    (void)build(d, load_mesh(d));
  } catch (const core::InputError& e) {
    return e.what();
  }
  return "no error";
}

/// Euler's load of the column, but for shear and the mesh.
double eulers() {
  const double inertia = 0.125 / 12;
  return 1000 * inertia * std::numbers::pi * std::numbers::pi / 400;
}

/// A pressure at the free end turns with it (Beck's column): vibrations of small strain know it, as
/// those of finite strain do, and dead loads do not.
TEST(Buckling, PressuresTurnInVibrationsOfSmallStrain) {
  const auto lowest = [](const std::string& law, const std::string& load) {
    const std::string steps = "  - {name: press, increments: 1, " + clamped + ", " + load +
                              "}\n  - {name: free, modes: 2}\n";
    const model::AnalysisResult found =
        buckled(column(steps, "", law + ": {E: 1000, nu: 0, density: 1}"));
    return found.steps.back().vibrations.value().omega_squared[0];
  };
  const std::string pressure = "pressure: [{on: c.right, value: 0.2}]";
  const std::string dead = "traction: [{on: c.right, tx: -0.2}]";
  const double turning = lowest("linear_elastic", pressure);
  EXPECT_NEAR(turning / lowest("st_venant_kirchhoff", pressure), 1, 2e-3);
  EXPECT_NEAR(lowest("linear_elastic", dead) / lowest("st_venant_kirchhoff", dead), 1, 2e-3);
  EXPECT_GT(turning, 1.5 * lowest("linear_elastic", dead));
}

TEST(Buckling, OfAColumnByTheLoadsOfTheStep) {
  const Eigen::VectorXd found = factors_of(buckled(column(
      "  - {name: b, buckling: 2, " + clamped + ", total_force: [{on: c.right, fx: -2}]}\n")));
  ASSERT_EQ(found.size(), 2);
  EXPECT_NEAR(2 * found[0] / eulers(), 1, 5e-3);
  EXPECT_NEAR(found[1] / found[0], 9, 0.2);
}

// What the load of a step before has used up is missing: P0 + f P = P_cr, but for the change of the
// length by P0, which the stress stiffness knows of (P0 / E A = 4e-4).
TEST(Buckling, GoesOnFromTheStressesOfTheStepsBefore) {
  const std::string press = "  - {name: p, increments: 1, " + clamped +
                            ", total_force: [{on: c.right, fx: -0.2}]}\n",
                    load = "total_force: [{on: c.right, fx: -1}]}\n";
  const double alone =
      factors_of(buckled(column("  - {name: b, buckling: 1, " + clamped + ", " + load)))[0];
  EXPECT_NEAR(factors_of(buckled(column(press + "  - {name: b, buckling: 1, " + load)))[0],
              alone - 0.2, 3e-4);
  EXPECT_NEAR(factors_of(buckled(
                  column(press + "  - {name: b, buckling: {count: 1, about: start}, " + load)))[0],
              alone, 1e-9 * alone);
}

// Two steps that look for it, and one that goes on, do not know of each other.
TEST(Buckling, LeavesNothingBehind) {
  const std::string press = "  - {name: p, increments: 1, " + clamped +
                            ", total_force: [{on: c.right, fx: -0.1}]}\n",
                    look = "buckling: 1, total_force: [{on: c.right, fx: -1}]}\n",
                    push = "increments: 1, traction: [{on: c.top, ty: -1e-3}]}\n";
  const model::AnalysisResult with = buckled(column(press + "  - {name: a, " + look +
                                                    "  - {name: b, " + look + "  - {name: q, " +
                                                    push)),
                              without = buckled(column(press + "  - {name: q, " + push));
  EXPECT_EQ(with.steps[1].buckling->factors, with.steps[2].buckling->factors);
  EXPECT_EQ(with.state.u, without.state.u);
}

// Displacements as loads: the force of ux = -1e-3 is E A 1e-4 = 0.05.
TEST(Buckling, BySupportsThatMove) {
  const std::string held = "{on: c.left, ux: 0, uy: 0}, {on: c.right, ux: ";
  const double by_force =
      factors_of(buckled(column("  - {name: b, buckling: 1, " + clamped +
                                ", total_force: [{on: c.right, fx: -0.05}]}\n")))[0];
  const double by_way = factors_of(
      buckled(column("  - {name: b, buckling: 1, prescribe: [" + held + "-1e-3}]}\n")))[0];
  EXPECT_NEAR(by_way / by_force, 4, 0.02);  // guided at its end
  const double after = factors_of(buckled(
      column("  - {name: p, increments: 1, prescribe: [" + held +
             "-1e-3}]}\n  - {name: b, buckling: 1, prescribe: [{on: c.right, ux: -1e-3}]}\n")))[0];
  EXPECT_NEAR(after, by_way - 1, 2e-3);
}

// Heat: held between walls it is pressed by E alpha T.
TEST(Buckling, ByTemperatures) {
  const std::string walls = "prescribe: [{on: c.left, ux: 0, uy: 0}, {on: c.right, ux: 0}]";
  const double by_force =
      factors_of(buckled(column("  - {name: b, buckling: 1, " + clamped +
                                ", total_force: [{on: c.right, fx: -0.05}]}\n")))[0];
  const std::string material = "linear_elastic: {E: 1000, nu: 0}, expansion: {alpha: 1e-5}";
  const double by_heat = factors_of(buckled(
      column("  - {name: b, buckling: 1, " + walls + ", temperature: [{on: c, value: 10}]}\n", "",
             material)))[0];
  EXPECT_NEAR(by_heat / by_force, 4, 0.02);
  const double after = factors_of(
      buckled(column("  - {name: h, increments: 1, " + walls +
                         ", temperature: [{on: c, value: 10}]}\n"
                         "  - {name: b, buckling: 1, temperature: [{on: c, value: 20}]}\n",
                     "", material)))[0];
  EXPECT_NEAR(after, by_heat - 1, 2e-3);
}

// A rigid head of length 5 on a spring of moments: a column whose lower half does not bend is one
// of rigid bodies and geometry alone. Here it is held up by a block that is sheared and bent; the
// head alone has the load.
TEST(Buckling, OfARigidHeadOnAShortColumn) {
  const std::string text =
      "osculate: 1\n"
      "mesh: {generate: {c: {box: {x: [0, 1], y: [0, 0.1], elements: [20, 2], type: quad8}}, "
      "wall: {line: {points: [[1, 0], [1, 0.1]], elements: 2, type: line3}}}}\n"
      "materials: {m: {linear_elastic: {E: 1e4, nu: 0}}}\n"
      "sections: [{on: c, material: m, element: plane_stress}]\n"
      "rigid: {head: {set: c.right, reference: [3, 0.05]}}\n"
      "steps:\n"
      "  - {name: b, buckling: 1, prescribe: [{on: c.left, ux: 0, uy: 0}], release: [{on: head, "
      "of: "
      "[ux, uy, rz]}], forces: [{on: head, fx: -1}]}\n";
  // a clamped column of length a with a rigid part of length b: tan(k a) k b = 1, k^2 = P / E I
  const double stiffness = 1e4 * 1e-3 / 12;
  double low = 0.01, high = std::numbers::pi / 2 - 0.01;
  for (int i = 0; i < 60; ++i) {
    const double k = 0.5 * (low + high);
    (std::tan(k) * k * 2 < 1 ? low : high) = k;
  }
  EXPECT_NEAR(factors_of(buckled(text))[0] / (stiffness * low * low), 1, 2e-3);
}

// Two halves whose joint stays as it is are the whole column: tied, or pressed together with
// friction, also by multipliers.
TEST(Buckling, OfTwoHalvesWithAJointThatHolds) {
  const double whole = factors_of(buckled(column("  - {name: b, buckling: 1, " + clamped +
                                                 ", total_force: [{on: c.right, fx: -1}]}\n")))[0];
  const std::string friction = "normal: {penalty: 1e5}, friction: {coulomb: {mu: 1, penalty: 1e5}}";
  for (const std::string& joint :
       {std::string("sampling: {gauss: 3}, normal: {penalty: 1e5, separation: tied}"),
        "sampling: {gauss: 3}, " + friction,
        "sampling: nodes, enforcement: lagrange_multiplier, " + friction}) {
    const model::AnalysisResult result = buckled(
        "osculate: 1\n"
        "mesh: {generate: {a: {box: {x: [0, 5], y: [0, 0.5], elements: [8, 1], type: quad8}}, b: "
        "{box: {x: [5, 10], y: [0, 0.5], elements: [8, 1], type: quad8}}}}\n"
        "materials: {m: {linear_elastic: {E: 1000, nu: 0}}}\n"
        "sections: [{on: a, material: m, element: plane_stress}, {on: b, material: m, element: "
        "plane_stress}]\n"
        "contact: [{name: joint, master: a.right, slave: b.left, " +
        joint +
        "}]\n"
        "steps:\n"
        "  - {name: p, increments: 1, prescribe: [{on: a.left, ux: 0, uy: 0}, {on: b.right, uy: "
        "0}], "
        "total_force: [{on: b.right, fx: -0.2}]}\n"
        "  - {name: b, buckling: 1, release: [{on: b.right, of: [uy]}], total_force: [{on: "
        "b.right, "
        "fx: -1}]}\n");
    EXPECT_NEAR((0.2 + factors_of(result)[0]) / whole, 1, 2e-3) << joint;
    EXPECT_EQ(result.steps.back().buckling->closed, joint.find("tied") < joint.size() ? 0 : 3);
  }
}

TEST(Buckling, WhatItIsNotFor) {
  const std::string load = ", total_force: [{on: c.right, fx: -1}]";
  const auto says = [&](const std::string& step, const std::string& message,
                        const std::string& material = "linear_elastic: {E: 1000, nu: 0}") {
    const std::string said =
        error_of(column("  - {name: b, buckling: 1, " + clamped + step + "}\n", "", material));
    EXPECT_NE(said.find(message), std::string::npos) << said;
  };
  says(load + ", increments: 2", "`increments` does not go with it");
  says(load + ", gravity: [0, -1]", "`gravity` does not go with it, a `body_force` does");
  says(load + ", modes: 2", "`modes` does not go with it");
  says(load, "section 'c' has finite strains", "st_venant_kirchhoff: {E: 1000, nu: 0}");
  says(load, "the material of section 'c' is not linear",
       "elastoplastic: {E: 1000, nu: 0, yield: 10}");
  const std::string said = error_of(
      column("  - {name: b, buckling: 1, total_force: [{on: c.right, fx: -1, amplitude: a}]}\n",
             "amplitudes: {a: [[0, 0], [1, 1]]}\n"));
  EXPECT_NE(said.find("have no amplitude"), std::string::npos) << said;
}

// What moves is in no balance: the state before all steps may buckle, or one that came to rest.
TEST(Buckling, AfterAStepWithInertia) {
  const std::string dense = "linear_elastic: {E: 1000, nu: 0, density: 1}",
                    swing = "  - {name: d, increments: 3, duration: 0.1, dynamics: {}, " + clamped +
                            ", total_force: [{on: c.right, fy: -1e-4}]}\n",
                    rest = "  - {name: s, increments: 1, total_force: [{on: c.right, fy: 0}]}\n",
                    load = ", total_force: [{on: c.right, fx: -1}]}\n";
  const std::string said = error_of(column(swing + "  - {name: b, buckling: 1" + load, "", dense));
  EXPECT_NE(said.find("steps[1].buckling: step 'd' leaves the bodies in motion"), std::string::npos)
      << said;
  for (const std::string& steps :
       {"  - {name: b, buckling: 1, " + clamped + load,
        swing + "  - {name: b, buckling: {count: 1, about: start}" + load,
        swing + rest + "  - {name: b, buckling: 1" + load})
    EXPECT_NEAR(factors_of(buckled(column(steps, "", dense)))[0] / eulers(), 1, 0.01);
}

TEST(Buckling, SaysWhyThereIsNone) {
  const auto message_of = [](const std::string& steps) { return answer_of(column(steps)).message; };
  EXPECT_EQ(message_of("  - {name: b, buckling: 1, " + clamped + "}\n"),
            "no buckling load was found in step 'b': the loads of the step put no stress on any "
            "body");
  EXPECT_EQ(message_of("  - {name: p, increments: 1, " + clamped +
                       ", total_force: [{on: c.right, fx: -1}]}\n"
                       "  - {name: b, buckling: 1, total_force: [{on: c.right, fx: -1}]}\n"),
            "no buckling load was found in step 'b': the state before is not stable itself");
  EXPECT_EQ(message_of("  - {name: b, buckling: 1, prescribe: [{on: c.left, ux: 0}], total_force: "
                       "[{on: c.right, fx: -1}]}\n"),
            "no buckling load was found in step 'b': something is free to move");
}

}  // namespace
}  // namespace osculate::deck
