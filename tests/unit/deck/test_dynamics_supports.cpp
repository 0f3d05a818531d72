// Steps with inertia: what is prescribed, what follows from it, and what the supports read.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <functional>

#include "osculate/model/inertia.hpp"
#include "space_test.hpp"
#include "system_test.hpp"

namespace osculate::deck {
namespace {

const char* const schemes[] = {"newmark", "{hht: {alpha: 0.1}}",
                               "{generalized_alpha: {radius: 0.6}}"};

/// A function of the time as the table of an amplitude.
std::string table(const std::function<double(double)>& of, double duration, int points) {
  std::string text = "[";
  for (int i = 0; i <= points; ++i) {
    const double fraction = static_cast<double>(i) / points;
    text += fmt::format("{}[{:.17g}, {:.17g}]", i ? ", " : "", fraction, of(fraction * duration));
  }
  return text + "]";
}

/// One cell of height 1 between its base, which moves, and its free top: a mass of 1 at the top, of
/// 1/2 between both, and a spring of 4.
std::string driven(const std::string& scheme, const std::string& motion, int increments,
                   double duration, const std::string& more = "") {
  return fmt::format(R"(osculate: 1
mesh: {{generate: {{block: {{box: {{x: [0, 1], y: [0, 1], elements: [1, 1]}}}}}}}}
materials: {{m: {{linear_elastic: {{E: 4, nu: 0, density: 3}}}}}}
sections: [{{on: block, material: m, element: plane_strain}}]
amplitudes: {{motion: {}}}
steps:
  - name: drive
    increments: {}
    duration: {:.17g}
    dynamics: {{scheme: {}, impact: average{}}}
    prescribe: [{{on: block, ux: 0}}, {{on: block.bottom, uy: 1, amplitude: motion}}]
output: {{history: [{{on: block.top, of: vy}}]}}
)",
                     motion, increments, duration, scheme, more);
}

struct End {
  double u = 0, v = 0;
  double base = 0;    ///< velocity of the base
  double most = 0;    ///< largest acceleration on the way
  double leaked = 0;  ///< largest |numerical| on the way, over the work done
};

/// Of the top, which is node 2 or 3 of the box.
End driven_to_the_end(const std::string& text) {
  const Built built = build_text(text);
  End end;
  double work = 0;
  model::AnalysisObserver observer;
  observer.converged = [&](model::System&, const model::State& s, const model::Progress&,
                           const solve::IncrementRecord*) {
    Index top = 0, base = 0;
    for (Index n = 0; n < 4; ++n)
      (built.model.reference[static_cast<std::size_t>(n)].y() > 0.5 ? top : base) = n;
    end.u = s.u[2 * top + 1];
    end.v = s.rates.velocity[2 * top + 1];
    end.base = s.rates.velocity[2 * base + 1];
    end.most = std::max(end.most, s.rates.acceleration.lpNorm<Eigen::Infinity>());
    work = std::max(work, std::abs(s.rates.energies.external));
    end.leaked = std::max(end.leaked, std::abs(s.rates.energies.numerical));
    return true;
  };
  const model::AnalysisResult result = model::run(built.model, built.options, observer);
  EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
  end.leaked /= work;
  return end;
}

double order(double coarse, double fine) { return std::log2(std::abs(coarse / fine)); }

// The base swings by sin 3t from rest:  u'' + 4 u = 8.5 sin 3t ,  u = 2.55 sin 2t - 1.7 sin 3t .
TEST(DynamicsSupports, AShakenBaseDrivesItsMassWithSecondOrder) {
  constexpr double t = 2;
  const double u = 2.55 * std::sin(2 * t) - 1.7 * std::sin(3 * t);
  const double v = 5.1 * (std::cos(2 * t) - std::cos(3 * t));
  for (const char* const scheme : schemes) {
    End at[2];
    for (int i = 0; i < 2; ++i) {
      const int n = 80 << i;
      at[i] = driven_to_the_end(
          driven(scheme, table([](double s) { return std::sin(3 * s); }, t, n), n, t));
    }
    EXPECT_NEAR(order(at[0].u - u, at[1].u - u), 2, 0.15) << scheme;
    EXPECT_NEAR(order(at[0].v - v, at[1].v - v), 2, 0.15) << scheme;
    EXPECT_NEAR(order(at[0].base - 3 * std::cos(3 * t), at[1].base - 3 * std::cos(3 * t)), 2, 0.15)
        << scheme;
    EXPECT_LT(std::abs(at[1].u - u), 2e-2);
  }
}

// A base that starts and stops at once:  u'' + 4 u = 4 t  and then a jump of 1/2 in the velocity.
TEST(DynamicsSupports, ABaseThatStopsAtOnceGivesItsImpulse) {
  constexpr double stop = 1, t = 2;
  const double u1 = stop - 0.5 * std::sin(2 * stop), v1 = 1 - std::cos(2 * stop) + 0.5;
  const double c = std::cos(2 * (t - stop)), s = std::sin(2 * (t - stop));
  const double u = stop + (u1 - stop) * c + 0.5 * v1 * s, v = -2 * (u1 - stop) * s + v1 * c;
  for (const char* const scheme : schemes) {
    End at[2];
    for (int i = 0; i < 2; ++i)
      at[i] = driven_to_the_end(driven(scheme, "[[0, 0], [0.5, 1], [1, 1]]", 80 << i, t));
    EXPECT_NEAR(order(at[0].u - u, at[1].u - u), 2, 0.2) << scheme;
    EXPECT_NEAR(order(at[0].v - v, at[1].v - v), 2, 0.2) << scheme;
    EXPECT_LT(std::abs(at[1].u - u), 2e-3);
  }
}

// Nothing rings behind a base that moves evenly, damped or not.
TEST(DynamicsSupports, ABaseThatMovesEvenlyCarriesItsMassAlong) {
  for (const char* const damping : {"", ", damping: {mass: 0.5, stiffness: 0.01}"}) {
    const End coarse = driven_to_the_end(driven("newmark", "[[0, 0], [1, 2]]", 100, 2, damping));
    EXPECT_NEAR(coarse.base, 1, 1e-12);
    EXPECT_LT(coarse.most, 2.5);  // 2 sin 2t
    if (!*damping) {
      EXPECT_LT(coarse.leaked, 1e-12);
    }
  }
}

/// A step of ten increments in which everything that `prescribe` names moves by t^2.
template <class Look>
void accelerated(const std::string& bodies, const std::string& prescribe, const Look& look,
                 const std::string& dynamics = "{impact: average}") {
  const std::string text =
      fmt::format(R"(osculate: 1
mesh: {{generate: {{block: {{box: {{x: [0, 2], y: [0, 1], elements: [2, 1]}}}}}}}}
materials: {{m: {{linear_elastic: {{E: 4, nu: 0, density: 3}}}}}}
sections: [{{on: block, material: m, element: plane_strain}}]
{}
amplitudes: {{motion: {}}}
steps:
  - name: lift
    increments: 10
    duration: 1
    gravity: [0, -10]
    dynamics: {}
    prescribe: {}
output: {{history: [{{on: block, of: rfy}}]}}
)",
                  bodies, table([](double t) { return t * t; }, 1, 10), dynamics, prescribe);
  const Built built = build_text(text);
  model::AnalysisObserver observer;
  int seen = 0;
  observer.converged = [&](model::System& system, const model::State& s, const model::Progress&,
                           const solve::IncrementRecord* record) {
    if (record) {
      look(built, system, s, record->fraction);
      ++seen;
    }
    return true;
  };
  const model::AnalysisResult result = model::run(built.model, built.options, observer);
  EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
  EXPECT_EQ(seen, 10);
}

double reading(const Built& built, const model::System& system, const model::State& s,
               const std::string& quantity, const std::vector<Index>& nodes, Index body) {
  model::HistoryRequest request;
  request.quantity = quantity;
  request.nodes = nodes;
  request.target = body;
  request.kind =
      nodes.empty() ? model::HistoryRequest::Kind::rigid : model::HistoryRequest::Kind::nodes;
  return model::history_value(system, built.model, s, request);
}

constexpr const char* any_scheme[] = {"{impact: average}", "{scheme: central_differences}"};

// m (a + g) = 6 (2 + 10)
TEST(DynamicsSupports, ReadTheWeightOfWhatTheyLift) {
  for (const char* const scheme : any_scheme)
    accelerated(
        "", "[{on: block, ux: 0, uy: 1, amplitude: motion}]",
        [](const Built& built, const model::System& system, const model::State& s, double t) {
          EXPECT_NEAR(reading(built, system, s, "rfy", {0, 1, 2, 3, 4, 5}, -1), 72, 1e-9);
          EXPECT_NEAR(s.rates.velocity[1], 2 * t, 1e-12);
        },
        scheme);
}

// The same for a rigid body with a mass of 5 and a moment of inertia of 7: 5 (2 + 10) and 7 * 2.
TEST(DynamicsSupports, ReadTheWeightOfRigidBodies) {
  for (const char* const scheme : any_scheme)
    accelerated(
        "rigid: {disc: {circle: {center: [0, 5], radius: 1}, mass: 5, inertia: 7}}",
        "[{on: block, ux: 0, uy: 0}, {on: disc, ux: 0, uy: 1, rz: 1, amplitude: motion}]",
        [](const Built& built, const model::System& system, const model::State& s, double) {
          EXPECT_NEAR(reading(built, system, s, "rfy", {}, 0), 60, 1e-9);
          EXPECT_NEAR(reading(built, system, s, "rmz", {}, 0), 14, 1e-9);
        },
        scheme);
}

// A rigid body that turns with cells on it: their nodes move as the body does.
TEST(DynamicsSupports, NodesOfRigidBodiesMoveWithThem) {
  accelerated("rigid: {base: {set: block.bottom, reference: [0, 0]}}",
              "[{on: base, ux: 0, uy: 0, rz: 1, amplitude: motion}]",
              [](const Built& built, const model::System& system, const model::State& s, double t) {
                const double rate = 2 * t;
                for (Index n = 0; n < 6; ++n) {
                  if (system.dofs().body_of(n) < 0) continue;
                  const Vec2 x =
                      built.model.reference[static_cast<std::size_t>(n)] + s.u.segment<2>(2 * n);
                  const Vec2 v = rate * Vec2(-x.y(), x.x());
                  const Vec2 a = 2 * Vec2(-x.y(), x.x()) - rate * rate * x;
                  EXPECT_LT((s.rates.velocity.segment<2>(2 * n) - v).norm(), 1e-10);
                  EXPECT_LT((s.rates.acceleration.segment<2>(2 * n) - a).norm(), 1e-9);
                }
              });
}

// u_top = 2 u_bottom at one node and an equation with three terms at another.
TEST(DynamicsSupports, WhatFollowsFromThemFollowsInVelocityToo) {
  accelerated(
      R"(equations:
  - {terms: [{on: block.top_left, of: uy, factor: 1}, {on: block.bottom_left, of: uy, factor: -2}], value: 0})",
      "[{on: block, ux: 0}, {on: block.bottom, uy: 1, amplitude: motion}]",
      [](const Built& built, const model::System& system, const model::State& s, double t) {
        for (Index n = 0; n < 6; ++n) {
          if (system.dofs().equation_of(2 * n + 1) < 0) continue;
          EXPECT_NEAR(s.u[2 * n + 1], 2 * t * t, 1e-12);
          EXPECT_NEAR(s.rates.velocity[2 * n + 1], 4 * t, 1e-10);
          EXPECT_NEAR(s.rates.acceleration[2 * n + 1], 4, 1e-8);
        }
        (void)built;
      });
}

// Velocities that are given for a set reach the nodes of it that follow from others.
TEST(DynamicsSupports, GivenVelocitiesReachWhatFollows) {
  std::string text = driven("newmark", "[[0, 0], [1, 0]]", 4, 1);
  text = edited(text, ", {on: block.bottom, uy: 1, amplitude: motion}", "");
  const std::string both = edited(text, "steps:",
                                  "equal: [{on: block.top, of: uy}]\n"
                                  "initial_velocity: [{on: block, vy: 1}]\nsteps:");
  const std::string one = edited(
      text, "steps:",
      "equations:\n"
      "  - {terms: [{on: block.top_left, of: uy, factor: 1}, {on: block.top_right, of: uy, factor: "
      "-1}]}\n"
      "initial_velocity: [{on: block.top_left, vy: 2}, {on: block.bottom_left, vy: 2}]\nsteps:");
  for (const bool all : {true, false}) {
    const Built built = build_text(all ? both : one);
    model::System system(built.model, 1);
    model::State state = system.initial_state();
    system.begin_step(built.model.steps.front(), state);
    state = system.begin_motion(state);
    // Of the second, a half moves by 2 and is tied to the other at the top: the momentum stays.
    const model::BasicInertia<2> inertia(built.model, false);
    double momentum = 0;
    for (Index n = 0; n < 4; ++n) momentum += inertia.multiply(state.rates.velocity)[2 * n + 1];
    EXPECT_NEAR(momentum, 3, 1e-12);
    double top[2] = {0, 0};
    for (Index n = 0; n < 4; ++n) {
      const Vec2& x = built.model.reference[static_cast<std::size_t>(n)];
      if (x.y() > 0.5) top[x.x() > 0.5 ? 1 : 0] = state.rates.velocity[2 * n + 1];
      if (all) {
        EXPECT_NEAR(state.rates.velocity[2 * n + 1], 1, 1e-13);
      }
    }
    EXPECT_EQ(top[0], top[1]);
    EXPECT_NEAR(top[0], 1, all ? 1e-13 : 0.2);
  }
}

// A force that is left over is no loss of the scheme: it stands in the residual, all of it, and the
// increments after it do not go on with it.
TEST(DynamicsLedger, WhatIsLeftOverStandsInTheResidual) {
  std::string text = driven("newmark", "[[0, 0], [1, 1]]", 10, 1);
  text = edited(text, "ux: 0}, {on: block.bottom", "ux: 0}, {on: block.bottom_left");
  Probe probe(text);
  model::State state = probe.system.initial_state();
  probe.system.begin_step(probe.built.model.steps.front(), state);
  state = probe.system.begin_motion(state);
  double left_over = 0;
  for (int i = 1; i <= 5; ++i) {
    const double at = 0.1 * i;
    const model::Trial trial = probe.system.apply(state, probe.random(0.01), at, 1.0);
    solve::Evaluation e;
    probe.system.evaluate(state, trial, at, false, e);
    for (Index u = 0; u < probe.system.dofs().unknowns(); ++u) {
      const Index d = probe.system.dofs().dof_of_unknown(u);
      left_over += 0.5 * e.residual[u] * (trial.state.u[d] - state.u[d]);
    }
    state = probe.system.commit(trial, at);
  }
  ASSERT_GT(std::abs(left_over), 1e-4);
  EXPECT_NEAR(state.rates.energies.numerical, 0, 1e-13);
  EXPECT_NEAR(state.rates.energies.residual, -left_over, 1e-13);
}

/// A body in space with principal moments of inertia 2, 2.5 and 3 beside a block at rest.
std::string in_space(const std::string& motion, const std::string& prescribe,
                     const std::string& more) {
  return fmt::format(R"(osculate: 1
mesh: {{generate: {{low: {{box: {{x: [0, 1], y: [0, 1], z: [-5, -4], elements: [1, 1, 1]}}}}}}}}
materials: {{m: {{linear_elastic: {{E: 100, nu: 0.25, density: 1}}}}}}
sections: [{{on: low, material: m, element: solid}}]
rigid: {{wheel: {{sphere: {{center: [0, 0, 0], radius: 1}}, mass: 2.5, inertia: [2, 2.5, 3]}}}}
amplitudes: {{motion: {}}}
initial_velocity: [{{on: wheel, wy: 3}}]
steps:
  - name: spin
    increments: 10
    duration: 1
    dynamics: {{{}}}
    prescribe: [{{on: low, ux: 0, uy: 0, uz: 0}}{}]
output: {{history: [{{on: wheel, of: rz}}]}}
)",
                     motion, more, prescribe);
}

template <class Look>
void run_in_space(const std::string& text, const Look& look) {
  const Built3 built = built_from(text);
  model::AnalysisObserver3 observer;
  int seen = 0;
  observer.converged = [&](model::System3& system, const model::State3& s, const model::Progress&,
                           const solve::IncrementRecord* record) {
    if (record) look(built, system, s, record->fraction);
    ++seen;
    return true;
  };
  const model::AnalysisResult3 result = model::run(built.model, built.options, observer);
  EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
  EXPECT_EQ(seen, 11);
}

// The angle is t^2 about an axis that is one of inertia: a moment of 3 * 2, and its work.
TEST(DynamicsSupports, ReadTheMomentOfWhatTheyTurnInSpace) {
  for (const char* const impact : {"impact: average", "impact: dissipative"})
    run_in_space(
        in_space(table([](double t) { return t * t; }, 1, 10),
                 ", {on: wheel, ux: 0, uy: 0, uz: 0, rx: 0, ry: 0}, {on: wheel, rz: 1, "
                 "amplitude: motion}",
                 impact),
        [](const Built3& built, const model::System3& system, const model::State3& s, double t) {
          model::HistoryRequest request;
          request.kind = model::HistoryRequest::Kind::rigid;
          request.quantity = "rmz";
          request.target = 0;
          EXPECT_NEAR(model::history_value(system, built.model, s, request), 6, 1e-9);
          const Index spin = system.dofs().body_dof(0, 5);
          EXPECT_NEAR(s.rates.velocity[spin], 2 * t, 1e-12);
          EXPECT_NEAR(s.rates.energies.external, 0.5 * 3 * 4 * t * t, 1e-9);
          EXPECT_NEAR(s.rates.energies.numerical, 0, 1e-9);
        });
}

// Average acceleration takes w (1 - a h / 2) / (1 + a h / 2) in each increment, and what is lost is
// damping.
TEST(DynamicsRotation, DampingByMassSlowsTurningInSpace) {
  run_in_space(in_space("[[0, 0], [1, 0]]", "", "damping: {mass: 0.8}"),
               [](const Built3&, const model::System3& system, const model::State3& s, double t) {
                 const Index spin = system.dofs().body_dof(0, 4);
                 const double share = std::pow((1 - 0.04) / (1 + 0.04), std::round(10 * t));
                 EXPECT_NEAR(s.rates.velocity[spin], 3 * share, 1e-9);
                 const model::Energies& e = s.rates.energies;
                 EXPECT_NEAR(e.damping, 0.5 * 2.5 * 9 * (1 - share * share), 1e-8);
                 EXPECT_NEAR(e.numerical, 0, 1e-8);
               });
}

// A rigid body without mass that holds the nodes of one line can turn about it without moving any
// mass.
TEST(DynamicsFailure, AMassMatrixWithoutAnInverseEndsTheRunWithAReason) {
  Built3 built = built_from(R"(osculate: 1
mesh: {generate: {plate: {box: {x: [0, 1], y: [0, 1], z: [0, 1], elements: [1, 1, 1]}}}}
materials: {m: {linear_elastic: {E: 100, nu: 0.25, density: 1}}}
sections: [{on: plate, material: m, element: solid}]
rigid: {bar: {set: plate.left, reference: [1, 0, 1]}}
steps: [{name: fall, increments: 2, duration: 1, gravity: [0, 0, -10], dynamics: {}}]
output: {history: [{on: bar, of: uz}]}
)");
  model::RigidBody3& bar = built.model.rigid[0];
  std::erase_if(bar.nodes, [&](Index n) {
    if (built.model.reference[static_cast<std::size_t>(n)].z() < 0.5) return false;
    built.model.body_of_node[static_cast<std::size_t>(n)] = -1;
    return true;
  });
  ASSERT_EQ(bar.nodes.size(), 2u);
  built.model.steps[0].prescribed.clear();
  const model::AnalysisResult3 result = model::run(built.model, built.options, {});
  EXPECT_NE(result.outcome, solve::Outcome::converged);
  EXPECT_THAT(result.message, ::testing::HasSubstr("mass matrix cannot be factored"));
}

TEST(DynamicsKeys, AStepWithoutInertiaBetweenOthersIsToldOf) {
  const std::string text = edited(driven("newmark", "[[0, 0], [1, 1]]", 4, 1),
                                  "output:", "  - {name: hold, increments: 1}\noutput:");
  const Built built = build_text(text);
  ASSERT_EQ(built.warnings.size(), 1u);
  EXPECT_THAT(
      built.warnings[0],
      ::testing::HasSubstr("step 'hold' has no inertia and brings to rest what step 'drive'"));
}

// Without sections the rigid bodies tell.
TEST(DynamicsKeys, RigidBodiesAloneTellThePlaneFromSpace) {
  const std::string text = R"(osculate: 1
mesh: {generate: {bed: {box: {x: [0, 1], y: [0, 1], z: [-5, -4], elements: [1, 1, 1]}}}}
rigid: {ball: {sphere: {center: [0, 0, 0], radius: 1}, mass: 2}}
initial_velocity: [{on: ball, vz: 3, wx: 2}]
steps: [{name: fly, increments: 10, duration: 1, gravity: [0, 0, -10], dynamics: {}}]
output: {history: [{on: ball, of: uz}]}
)";
  ASSERT_EQ(any_refusal(text), "");
  const Built3 built = built_from(text);
  model::AnalysisObserver3 observer;
  double height = 0;
  observer.converged = [&](model::System3&, const model::State3& s, const model::Progress&,
                           const solve::IncrementRecord*) {
    height = s.rigid[0].translation.z();
    return true;
  };
  const model::AnalysisResult3 result = model::run(built.model, built.options, observer);
  EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
  EXPECT_NEAR(height, 3 - 5, 1e-12);
}

}  // namespace
}  // namespace osculate::deck
