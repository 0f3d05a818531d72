// The assembled system: tangents by order, balance, predictor, reproducibility.
#include "osculate/model/system.hpp"

#include <cmath>
#include <numbers>

#include "osculate/model/quantities.hpp"
#include "system_test.hpp"

namespace osculate::deck {
namespace {

using model::State;
using model::System;

/// An elastic block held at its bottom under a rigid tool that overlaps it by about 0.1.
std::string tool_model(const std::string& tool, const std::string& law, const std::string& contact,
                       const std::string& step, const std::string& more_mesh = "",
                       const std::string& element = "plane_strain") {
  return "osculate: 1\nmesh: {generate: {block: {box: {x: [0, 2], y: [0, 1], elements: [4, 2]}}" +
         more_mesh + "}}\nmaterials: {m: {" + law +
         ": {E: 100, nu: 0.3}}}\nsections: [{on: block, material: m, element: " + element +
         "}]\nrigid: {tool: {" + tool + "}}\ncontact: [{name: c, " + contact +
         ", normal: {penalty: 500}}]\nsteps: [{name: s, increments: 1, " + step + "}]\n";
}

struct Tool {
  std::string name, shape, more_mesh;
};
const std::vector<Tool> tools{
    {"circle", "circle: {center: [1, 3.9], radius: 3}", ""},
    {"arc", "arc: {center: [1, 3.9], radius: 3, from: 200, to: 340}", ""},
    {"nurbs",
     "nurbs: {degree: 2, knots: [0, 0, 0, 1, 1, 1], control: [[2.5, 1.3, 1], [1, 0.4, 0.8], "
     "[-0.5, 1.3, 1]]}",
     ""},
    {"line", "line: {point: [1, 0.89], normal: [0.1, -1]}", ""},
    {"polyline", "polyline: {points: [[2.5, 1.2], [1.2, 0.9], [0.3, 0.95], [-0.5, 1.3]]}", ""},
    {"composite",
     "composite: [{polyline: {points: [[2.5, 1.2], [1.6, 0.9]]}}, {function: {x: [1.6, 1.2, 0.8, "
     "0.4], y: [0.9, 0.88, 0.93, 0.9]}}, {polyline: {points: [[0.4, 0.9], [-0.5, 1.3]]}}]",
     ""},
    {"meshed", "set: bar", ", bar: {line: {points: [[2.4, 0.93], [-0.4, 0.91]], elements: 3}}"},
};
constexpr const char* driven =
    "prescribe: [{on: block.bottom, ux: 0, uy: 0}], forces: [{on: tool, fx: 1, fy: -5, mz: 0.3}]";

void expect_second_order(const std::string& model, const std::string& what) {
  SCOPED_TRACE(what);
  Probe probe(model);
  const testing::DerivativeReport report = check_tangent_of(probe);
  EXPECT_TRUE(report.exact || std::abs(report.order - 2.0) < 0.1)
      << "order " << report.order << ", error " << report.error;
}

TEST(System, TangentWithAFreeRigidBody) {
  for (const Tool& tool : tools)
    for (const std::string law : {"linear_elastic", "neo_hooke"})
      for (const std::string friction : {"", ", friction: {coulomb: {mu: 0.3, penalty: 300}}"})
        for (const std::string form : {"surface", "full"}) {
          const std::string model = tool_model(
              tool.shape, law, "master: tool, slave: block.top, residual: " + form + friction,
              driven, tool.more_mesh);
          expect_second_order(model, tool.name + " " + law + " " + form + friction);
          Probe probe(model);
          EXPECT_GT(
              probe.at(probe.base, false).counts.stick + probe.at(probe.base, false).counts.slip, 0)
              << tool.name << " touches nothing";
          EXPECT_EQ(probe.system.dofs().unknowns(), 2 * 15 + 3);
        }
}

TEST(System, TangentWithRigidSlaves) {
  for (const std::string weight : {"reference_area", "current_area", "node"})
    expect_second_order(tool_model(tools.back().shape, "neo_hooke",
                                   "master: block.top, slave: tool, weight: " + weight +
                                       ", friction: {coulomb: {mu: 0.3, penalty: 300}}",
                                   driven, tools.back().more_mesh),
                        weight);
}

TEST(System, TangentWithAPrescribedRotation) {
  for (const Tool& tool : tools)
    expect_second_order(
        tool_model(tool.shape, "neo_hooke", "master: tool, slave: block.top",
                   "prescribe: [{on: block.bottom, ux: 0, uy: 0}, {on: tool, rz: 0.1}], "
                   "forces: [{on: tool, fy: -5}]",
                   tool.more_mesh),
        tool.name);
}

TEST(System, TangentOfFollowerPressureAndAxisymmetry) {
  for (const std::string element : {"plane_strain", "plane_stress", "axisymmetric"})
    expect_second_order(
        tool_model(tools[0].shape, "neo_hooke",
                   "master: tool, slave: block.top, weight: current_area",
                   "prescribe: [{on: block.bottom, ux: 0, uy: 0}], forces: [{on: tool, fy: -5}], "
                   "pressure: [{on: block.right, value: 7}]",
                   "", element),
        element);
}

TEST(System, TangentWithEquations) {
  const std::string model =
      tool_model(tools[0].shape, "neo_hooke", "master: tool, slave: block.top", driven) +
      "equations: [{terms: [{on: block.top_left, of: ux, factor: 2}, {on: block.top_right, of: "
      "uy, factor: -1}, {on: tool, of: rz, factor: 0.5}], value: 0.02}]\n"
      "equal: [{on: block.right, of: ux}]\n";
  const std::string free = edited(model, "{on: block.bottom, ux: 0, uy: 0}",
                                  "{on: block.bottom, uy: 0}, {on: block.bottom_left, ux: 0}");
  expect_second_order(free, "equations");
}

/// The prediction is residual + K du_prescribed: what is left over is of second order.
TEST(System, PredictsToFirstOrder) {
  const std::string moved =
      "prescribe: [{on: block.bottom, ux: 0.05, uy: 0.02}, {on: tool, ux: 0.1, uy: -0.05, rz: "
      "0.2}], pressure: [{on: block.right, value: 7}]";
  for (const Tool& tool : tools) {
    SCOPED_TRACE(tool.name);
    Probe probe(tool_model(tool.shape, "neo_hooke",
                           "master: tool, slave: block.top, friction: {coulomb: {mu: 0.3, "
                           "penalty: 300}}",
                           moved, tool.more_mesh) +
                "equations: [{terms: [{on: block.top_left, of: ux, factor: 2}, {on: tool, of: rz, "
                "factor: 0.5}], value: 0.02}]\n");
    const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(probe.system.dofs().unknowns());
    const auto error = [&](double fraction) {
      solve::Evaluation predicted;
      probe.system.predict(probe.start, fraction, predicted);
      const State moved_state = probe.system.apply(probe.start, nothing, fraction, 1.0);
      return (predicted.residual - probe.at(moved_state, false, fraction).residual).norm();
    };
    EXPECT_NEAR(std::log2(error(2e-3) / error(1e-3)), 2.0, 0.05);
  }
}

// ---- balance
// --------------------------------------------------------------------------------------

/// Sum of a force on all primary dofs, as seen by a rigid motion of everything.
Vec2 resultant(const Built& built, const Eigen::VectorXd& force) {
  Vec2 sum = Vec2::Zero();
  const auto nodes = static_cast<Index>(built.model.reference.size());
  for (Index n = 0; n < nodes; ++n) sum += force.segment<2>(2 * n);
  for (std::size_t b = 0; b < built.model.rigid.size(); ++b)
    sum += force.segment<2>(2 * nodes + 3 * static_cast<Index>(b));
  return sum;
}

TEST(System, AForceOnARigidBodyIsCarriedByItsContact) {
  for (const Tool& tool : tools) {
    SCOPED_TRACE(tool.name);
    const Built built = build_text(tool_model(
        tool.shape, "neo_hooke",
        "master: tool, slave: block.top, residual: full, friction: {coulomb: {mu: 0.5, penalty: "
        "300}}",
        "prescribe: [{on: block.bottom, ux: 0, uy: 0}], forces: [{on: tool, fx: 0.5, fy: -8}]",
        tool.more_mesh));
    bool seen = false;
    const auto result = run_to_end(built, 1, [&](System& system, const State& state) {
      seen = true;
      const model::Forces& f = system.forces();
      EXPECT_LT(resultant(built, f.internal).norm(), 1e-11);
      EXPECT_LT(resultant(built, f.contact).norm(), 1e-11);
      EXPECT_EQ(resultant(built, f.external), Vec2(0.5, -8));
      model::HistoryRequest rigid{"", model::HistoryRequest::Kind::rigid, 0, {}, "rfx"};
      EXPECT_NEAR(history_value(system, built.model, state, rigid), 0, 1e-7);
      rigid.quantity = "rfy";
      EXPECT_NEAR(history_value(system, built.model, state, rigid), 0, 1e-7);
      const model::HistoryRequest contact{"", model::HistoryRequest::Kind::pair, 0, {}, "force_y"};
      EXPECT_NEAR(history_value(system, built.model, state, contact), -8, 1e-7);
      Vec2 support = Vec2::Zero();
      for (const Index n : built.model.mesh.find_set("block.bottom")->nodes)
        support += model::reactions(system).segment<2>(2 * n);
      EXPECT_LT((support - Vec2(-0.5, 8)).norm(), 1e-7);
    });
    EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
    EXPECT_TRUE(seen);
  }
}

TEST(System, AxisymmetricPressureActsOnTheWholeRing) {
  const Built built = build_text(
      "osculate: 1\nmesh: {generate: {ring: {box: {x: [1, 2], y: [0, 1], elements: [3, 2]}}}}\n"
      "materials: {m: {linear_elastic: {E: 100, nu: 0.3}}}\n"
      "sections: [{on: ring, material: m, element: axisymmetric}]\n"
      "steps: [{name: s, increments: 1, prescribe: [{on: ring.bottom, uy: 0}], "
      "pressure: [{on: ring.top, value: 2}]}]\n");
  double reaction = 0;
  const auto result = run_to_end(built, 1, [&](System& system, const State& state) {
    const model::HistoryRequest request{"", model::HistoryRequest::Kind::nodes, -1,
                                        built.model.mesh.find_set("ring.bottom")->nodes, "rfy"};
    reaction = history_value(system, built.model, state, request);
  });
  EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
  EXPECT_NEAR(reaction, 2 * std::numbers::pi * (4 - 1), 1e-10);
}

/// The resultant of a pressure depends on the ends of the current line alone.
TEST(System, FollowerPressureTurnsWithItsEdge) {
  Probe probe(tool_model(tools[0].shape, "neo_hooke", "master: tool, slave: block.top",
                         "prescribe: [{on: block.bottom, ux: 0, uy: 0}], pressure: [{on: "
                         "block.right, value: 7}]"),
              0.1);
  (void)probe.at(probe.base, false);
  const auto end = [&](const char* name) {
    const Index n = probe.built.model.mesh.find_set(name)->nodes.front();
    return probe.system.positions(probe.base)[static_cast<std::size_t>(n)];
  };
  const Vec2 along = end("block.bottom_right") - end("block.top_right");  // body on the right
  const Vec2 force = resultant(probe.built, probe.system.forces().external);
  EXPECT_LT((force + 3.5 * turn(along)).norm(), 1e-13);  // half of the step: p = 3.5
}

TEST(System, EquationsHoldAndDoNoWork) {
  const Built built = build_text(
      "osculate: 1\nmesh: {generate: {b: {box: {x: [0, 2], y: [0, 1], elements: [4, 2]}}}}\n"
      "materials: {m: {linear_elastic: {E: 100, nu: 0.3}}}\n"
      "sections: [{on: b, material: m, element: plane_stress}]\n"
      "equations: [{terms: [{on: b.top_right, of: ux, factor: 1}, {on: b.bottom_right, of: uy, "
      "factor: -2}], value: 0.1}]\nequal: [{on: b.top, of: uy}]\n"
      "steps: [{name: s, increments: 2, prescribe: [{on: b.left, ux: 0}, {on: b.bottom_left, uy: "
      "0}], forces: [{on: b.top_left, fy: 3}]}]\n");
  const auto node = [&](const char* name) {
    return built.model.mesh.find_set(name)->nodes.front();
  };
  bool seen = false;
  const auto result = run_to_end(built, 1, [&](System& system, const State& state) {
    seen = true;
    const Index a = 2 * node("b.top_right"), b = 2 * node("b.bottom_right") + 1;
    EXPECT_NEAR(state.u[a] - 2 * state.u[b], 0.1, 1e-15);
    const Eigen::VectorXd r = model::reactions(system);
    EXPECT_GT(std::abs(r[a]), 0.1);
    EXPECT_NEAR(r[b], -2 * r[a], 1e-9);
    double sum = 0;
    for (const Index n : built.model.mesh.find_set("b.top")->nodes) {
      EXPECT_NEAR(state.u[2 * n + 1], state.u[2 * node("b.top_left") + 1], 1e-15);
      sum += r[2 * n + 1];
    }
    EXPECT_NEAR(sum, 0, 1e-9);
  });
  EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
  EXPECT_TRUE(seen);
}

/// A body that is moved without resistance: all forces are round-off.
TEST(System, ABodyCarriedAlongConverges) {
  for (const std::string law : {"linear_elastic", "neo_hooke"}) {
    const Built built = build_text(
        "osculate: 1\nmesh: {generate: {b: {box: {x: [0, 2], y: [0, 1], elements: [4, 2]}}}}\n"
        "materials: {m: {" +
        law +
        ": {E: 2.1e5, nu: 0.3}}}\n"
        "sections: [{on: b, material: m, element: plane_strain}]\n"
        "steps: [{name: s, increments: 3, prescribe: [{on: b.left, ux: 10, uy: 3}]}]\n");
    const auto result = run_to_end(built, 1, [&](System&, const State& state) {
      for (Index n = 0; n < 15; ++n)
        EXPECT_LT((state.u.segment<2>(2 * n) - Vec2(10, 3)).norm(), 1e-11);
    });
    EXPECT_EQ(result.outcome, solve::Outcome::converged) << law << ": " << result.message;
    ASSERT_EQ(result.steps.size(), 1u);
    EXPECT_EQ(result.steps[0].increments.size(), 3u);
  }
}

// ---- the same bits
// --------------------------------------------------------------------------------

TEST(System, TheSameBitsWithAnyNumberOfThreads) {
  const std::string text = edited(
      tool_model(tools[0].shape, "neo_hooke",
                 "master: tool, slave: block.top, friction: {coulomb: {mu: 0.3, penalty: 300}}",
                 "prescribe: [{on: block.bottom, ux: 0, uy: 0}, {on: tool, ux: 0.2, uy: -0.05, rz: "
                 "0.1}]"),
      "elements: [4, 2]", "elements: [30, 20]");  // more cells than one tile
  std::vector<State> states;
  for (const int threads : {1, 2, 2, 1}) {
    const Built built = build_text(text);
    const auto result = run_to_end(built, threads, [](System&, const State&) {});
    ASSERT_EQ(result.outcome, solve::Outcome::converged) << result.message;
    states.push_back(result.state);
  }
  for (const State& state : states) {
    EXPECT_EQ(state.u, states.front().u);
    for (std::size_t i = 0; i < state.pairs[0].points.size(); ++i) {
      EXPECT_EQ(state.pairs[0].points[i].traction, states.front().pairs[0].points[i].traction);
      EXPECT_EQ(state.pairs[0].points[i].xi, states.front().pairs[0].points[i].xi);
    }
  }
}

}  // namespace
}  // namespace osculate::deck
