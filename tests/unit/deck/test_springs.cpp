// Springs, dampers and masses of model files.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "osculate/deck/build.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/model/quantities.hpp"

namespace osculate::deck {
namespace {

/// A stiff square.
const std::string square =
    "osculate: 1\n"
    "mesh: {generate: {b: {box: {x: [0, 1], y: [0, 1], elements: [1, 1]}}}}\n"
    "materials: {m: {linear_elastic: {E: 1e6, nu: 0, density: 1}}}\n"
    "sections: [{on: b, material: m, element: plane_strain}]\n";

struct Outcome {
  Built built;
  model::AnalysisResult result;
  std::vector<model::State> states;
};
Outcome run(const std::string& text) {
  const Description d = parse_model(text, "m.yaml");
  Outcome out{build(d, load_mesh(d)), {}, {}};
  model::AnalysisObserver observer;
  observer.converged = [&](model::System&, const model::State& state, const model::Progress&,
                           const solve::IncrementRecord*) {
    out.states.push_back(state);
    return true;
  };
  out.result = model::run(out.built.model, out.built.options, observer);
  EXPECT_EQ(out.result.outcome, solve::Outcome::converged) << out.result.message;
  return out;
}
double mean(const Outcome& r, const char* set, int direction) {
  const std::vector<Index>& nodes = r.built.model.mesh.find_set(set)->nodes;
  double sum = 0;
  for (const Index n : nodes) sum += r.result.state.u[2 * n + direction];
  return sum / static_cast<double>(nodes.size());
}
std::string message(const std::string& text) {
  try {
    const Description d = parse_model(text, "m.yaml");
    (void)build(d, load_mesh(d));
  } catch (const core::InputError& error) {
    return error.what();
  }
  return {};
}

/// Springs to the ground hold a body: force over stiffness.
TEST(Springs, ToTheGround) {
  const Outcome r =
      run(square +
          "springs:\n"
          "  - {terms: [{on: b.left, of: ux, factor: 0.5}], stiffness: 8}\n"
          "  - {terms: [{on: b.bottom, of: uy, factor: 0.5}], table: [[-1, -3], [0, 0], "
          "[1, 6]]}\n"
          "  - {terms: [{on: b.bottom, of: uy, factor: 1}], table: [[-1, 0], [1, 0]], "
          "damping: 3}\n"
          "steps:\n"
          "  - {name: pull, increments: 1, prescribe: [{on: b.bottom_left, uy: 0}], "
          "total_force: [{on: b.right, fx: 4}]}\n");
  EXPECT_NEAR(mean(r, "b.left", 0), 0.5, 1e-6);
  EXPECT_EQ(r.result.steps[0].increments.size(), 1U);
}

/// Half of a von Mises truss: the force is k (l - L) along the line as it lies now.
TEST(Springs, TurnWithTheirNodes) {
  const std::string truss =
      "osculate: 1\n"
      "mesh: {generate: {b: {box: {x: [0, 1], y: [0, 0.5], elements: [1, 1]}}}}\n"
      "materials: {m: {linear_elastic: {E: 1e-12, nu: 0}}}\n"
      "sections: [{on: b, material: m, element: plane_strain}]\n"
      "springs: [{between: [b.bottom_left, b.top_right], stiffness: 10}]\n"
      "steps:\n"
      "  - {name: push, increments: 4, prescribe: [{on: b.bottom, ux: 0, uy: 0}, {on: b.left, ux: "
      "0}, {on: b.top_right, ux: 0}, {on: b.top, uy: -0.2}]}\n";
  const Outcome r = run(truss);
  model::System system(r.built.model, 1);
  system.begin_step(r.built.model.steps[0], r.result.state);
  solve::Evaluation out;
  system.evaluate(r.result.state, 1.0, false, out);
  const Index apex = r.built.model.mesh.find_set("b.top_right")->nodes[0];
  const double length = std::hypot(1, 0.3), force = 10 * (length - std::hypot(1, 0.5));
  EXPECT_NEAR(system.forces().internal[2 * apex], force / length, 1e-9);
  EXPECT_NEAR(system.forces().internal[2 * apex + 1], force * 0.3 / length, 1e-9);
}

/// A mass on a spring with a damper that is let go: u = U exp(-d t) (cos w t + d / w sin w t), of
/// second order in the time step; the energies balance.
TEST(Springs, DampedOscillator) {
  const double k = 40, m = 2, c = 1.5, start = 0.1;
  const auto error = [&](int increments) {
    const Outcome r =
        run("osculate: 1\n"
            "mesh: {generate: {b: {box: {x: [0, 1], y: [0, 1], elements: [1, 1]}}}}\n"
            "materials: {m: {linear_elastic: {E: 1, nu: 0, density: 1e-12}}}\n"
            "sections: [{on: b, material: m, element: plane_strain}]\n"
            "sets: {tip: {union: [b.top_right]}}\n"
            "springs: [{terms: [{on: tip, of: ux, factor: 1}], stiffness: 40, damping: 1.5}]\n"
            "masses: [{on: b.top_right, mass: 2}]\n"
            "equal: [{on: b, of: ux}]\n"
            "steps:\n"
            "  - {name: pull, increments: 1, prescribe: [{on: b, uy: 0}, {on: tip, ux: 0.1}]}\n"
            "  - {name: swing, increments: " +
            std::to_string(increments) +
            ", duration: 1, dynamics: {}, release: [{on: tip, of: [ux]}]}\n");
    const double d = c / (2 * m), w = std::sqrt(k / m - d * d);
    const double exact = start * std::exp(-d) * (std::cos(w) + d / w * std::sin(w));
    const model::Energies& e = r.result.state.rates.energies;
    EXPECT_NEAR(e.start, 0.5 * k * start * start, 1e-9);
    EXPECT_LT(std::abs(e.residual), 1e-9);
    EXPECT_GT(e.damping, 0.1 * e.start);
    return std::abs(mean(r, "tip", 0) - exact);
  };
  const double coarse = error(100), fine = error(200);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.05);
  EXPECT_LT(fine, 2e-4 * start);
}

/// A mass flies past a fixed point to which a damper joins it, whose line turns by 45 degrees:
/// second order in the time step.
TEST(Springs, DamperThatTurns) {
  const auto place = [](int increments) {
    const Outcome r =
        run("osculate: 1\n"
            "mesh: {generate: {a: {box: {x: [0, 1], y: [0, 1], elements: [1, 1]}}, "
            "b: {box: {x: [3, 4], y: [1, 2], elements: [1, 1]}}}}\n"
            "materials: {m: {linear_elastic: {E: 1, nu: 0, density: 1e-12}}}\n"
            "sections: [{on: a, material: m, element: plane_strain}, "
            "{on: b, material: m, element: plane_strain}]\n"
            "springs: [{between: [a.top_right, b.bottom_left], damping: 3, kinematics: finite}]\n"
            "masses: [{on: b.bottom_left, mass: 2}]\n"
            "equal: [{on: b, of: ux}, {on: b, of: uy}]\n"
            "initial_velocity: [{on: b, vy: 2}]\n"
            "steps: [{name: fly, duration: 1, increments: " +
            std::to_string(increments) + ", dynamics: {}, prescribe: [{on: a, ux: 0, uy: 0}]}]\n");
    return Vec2(mean(r, "b", 0), mean(r, "b", 1));
  };
  const Vec2 coarse = place(50), middle = place(100), fine = place(200);
  EXPECT_LT(fine.x(), -0.2);  // it is held back along the line
  EXPECT_NEAR(std::log2((coarse - middle).norm() / (middle - fine).norm()), 2, 0.05);
}

/// omega^2 = k / m, about the last state of a spring that stiffens and about its first one.
TEST(Springs, VibrationsAboutTheLastStateAndTheFirst) {
  const auto omega_squared = [](const std::string& modes) {
    const Outcome r = run(
        "osculate: 1\n"
        "mesh: {generate: {b: {box: {x: [0, 1], y: [0, 1], elements: [1, 1]}}}}\n"
        "materials: {m: {linear_elastic: {E: 1, nu: 0, density: 1e-9}}}\n"
        "sections: [{on: b, material: m, element: plane_strain}]\n"
        "springs: [{terms: [{on: b.top_right, of: ux, factor: 1}], table: [[-1, -5], [0.1, 0.5], "
        "[1, 27.5]]}]\n"
        "masses: [{on: b.top_right, mass: 2}]\n"
        "equal: [{on: b, of: ux}]\n"
        "steps:\n"
        "  - {name: pull, increments: 1, prescribe: [{on: b, uy: 0}], forces: [{on: b.top_right, "
        "fx: 9}]}\n"
        "  - {name: sound, modes: " +
        modes + "}\n");
    return r.result.steps[1].vibrations->omega_squared[0];
  };
  EXPECT_NEAR(omega_squared("1"), 15, 1e-6);
  EXPECT_NEAR(omega_squared("{count: 1, about: start}"), 2.5, 1e-6);
}

/// In axes of their own the springs' forces are those of the nodes, and balance.
TEST(Springs, InLocalAxes) {
  const Outcome r =
      run(square +
          "axes: [{on: b.right, rectangular: {x: [1, 1], xy: [0, 1]}}]\n"
          "springs: [{terms: [{on: b.top_right, of: ux, factor: 1}], stiffness: 50}]\n"
          "steps:\n"
          "  - {name: pull, increments: 1, prescribe: [{on: b.left, ux: 0, uy: 0}, {on: "
          "b.right, ux: 0.01}]}\n"
          "  - {name: free, increments: 1, release: [{on: b.right, of: [ux]}]}\n");
  model::System system(r.built.model, 1);
  system.begin_step(r.built.model.steps[1], r.result.state);
  solve::Evaluation out;
  system.evaluate(r.result.state, 1.0, false, out);
  const Eigen::VectorXd reaction = model::reactions(system);
  for (const Index n : r.built.model.mesh.find_set("b.right")->nodes)
    EXPECT_LT(reaction.segment<2>(2 * n).norm(), 1e-6);
}

TEST(Springs, WhatIsWrong) {
  const std::string steps = "steps: [{name: s, increments: 1}]\n";
  const auto of = [&](const std::string& spring) {
    return message(square + "springs: [" + spring + "]\n" + steps);
  };
  EXPECT_EQ(
      of("{between: [b.top_left, b.left], stiffness: 1}"),
      "m.yaml:5: springs[0].between[1]: a spring joins two nodes, and 'b.left' has 2 of them");
  EXPECT_EQ(of("{between: [b.top_left, b.top_left], stiffness: 1}"),
            "m.yaml:5: springs[0].between[1]: 'b.top_left' and 'b.top_left' lie at one place: the "
            "spring has no direction; give it `terms`");
  EXPECT_EQ(of("{between: [b.top_left, b.top_right]}"),
            "m.yaml:5: springs[0]: one of stiffness, table, gap and damping is missing");
  EXPECT_EQ(
      of("{between: [b.top_left, b.top_right], stiffness: 1, table: [[0, 0], [1, 1]]}"),
      "m.yaml:5: springs[0].table: a spring has a stiffness, a table or a gap, not two of them");
  EXPECT_EQ(
      of("{between: [b.top_left, b.top_right], stiffness: 1, gap: {stiffness: 1, tension: 1}}"),
      "m.yaml:5: springs[0].gap: a spring has a stiffness, a table or a gap, not two of them");
  EXPECT_EQ(of("{between: [b.top_left, b.top_right], table: [[0, 0], [0, 1]]}"),
            "m.yaml:5: springs[0].table[1]: the elongations must increase");
  EXPECT_EQ(of("{terms: [{on: b.left, of: uz, factor: 1}], stiffness: 1}"),
            "m.yaml:5: springs[0].terms[0].on: 'uz' exists in space only, and this model is plane: "
            "no section has the element solid or solid_shell");
  EXPECT_EQ(of("{between: [b.top_left, nowhere], stiffness: 1}").substr(0, 60),
            "m.yaml:5: springs[0].between[1]: unknown set 'nowhere'; know");
}

}  // namespace
}  // namespace osculate::deck
