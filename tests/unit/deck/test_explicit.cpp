// Steps with central differences: keys, stable steps, energies, restart.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "allocation_count.hpp"
#include "osculate/model/quantities.hpp"
#include "space_test.hpp"
#include "system_test.hpp"

namespace osculate::deck {
namespace {

using ::testing::HasSubstr;

std::string refusal_of(const std::string& from, const std::string& to) {
  return any_refusal(edited(test_file("explicit.yaml"), from, to));
}

/// One row of cells 1 x 2 that is free and one-dimensional: c = 10, so that a wave needs 0.1 for a
/// cell, which is the critical step.
std::string bar(double safety, double step, int increments, double duration) {
  return fmt::format(R"(osculate: 1
title: A free bar
mesh: {{generate: {{bar: {{box: {{x: [0, 8], y: [0, 2], elements: [8, 1]}}}}}}}}
materials: {{m: {{linear_elastic: {{E: 100, nu: 0, density: 1}}}}}}
sections: [{{on: bar, material: m, element: plane_strain, kinematics: small}}]
initial_velocity: [{{on: bar, vx: 0.2}}, {{on: bar.left, vx: 1}}]
steps: [{{name: fly, increments: {}, duration: {:.17g},
  dynamics: {{scheme: {{central_differences: {{safety: {}, step: {:.17g}}}}}}}}}]
)",
                     increments, duration, safety, step);
}

struct Flight {
  model::AnalysisResult result;
  std::vector<double> momentum;
  std::vector<model::Energies> energies;
  std::vector<solve::TimeSteps> steps;
};

template <int Dim>
model::BasicAnalysisResult<Dim> run_all(
    const model::BasicModel<Dim>& model, int threads,
    const std::function<void(model::BasicSystem<Dim>&, const model::BasicState<Dim>&,
                             const solve::IncrementRecord*)>& look) {
  model::AnalysisOptions options;
  options.threads = threads;
  model::BasicAnalysisObserver<Dim> observer;
  observer.converged = [&](model::BasicSystem<Dim>& system, const model::BasicState<Dim>& state,
                           const model::Progress&, const solve::IncrementRecord* record) {
    look(system, state, record);
    return true;
  };
  return model::run(model, options, observer);
}

Flight run_of(const std::string& text, int threads = 1) {
  const Built built = build_text(text);
  Flight run;
  run.result = run_all<2>(
      built.model, threads,
      [&](model::System&, const model::State& state, const solve::IncrementRecord* record) {
        if (!record) return;
        run.energies.push_back(state.rates.energies);
        run.steps.push_back(record->time_steps);
      });
  return run;
}

TEST(ExplicitKeys, AreRefusedWithTheReason) {
  ASSERT_EQ(any_refusal(test_file("explicit.yaml")), "");
  ASSERT_EQ(refusal_of("{central_differences: {safety: 0.9}}", "central_differences"), "");
  ASSERT_EQ(refusal_of("damping: {mass: 0.3}", "mass: lumped"), "");
  EXPECT_THAT(refusal_of("damping: {mass: 0.3}", "mass: consistent"), HasSubstr("lumped"));
  EXPECT_THAT(refusal_of("damping: {mass: 0.3}", "impact: plastic"), HasSubstr("implicit schemes"));
  EXPECT_THAT(refusal_of("damping: {mass: 0.3}", "damping: {stiffness: 1e-3}"),
              HasSubstr("by the mass only"));
  EXPECT_THAT(refusal_of("safety: 0.9", "safety: 0"), HasSubstr("safety"));
  EXPECT_THAT(
      refusal_of("friction: {coulomb: {mu: 0.4, penalty: 700}}", "enforcement: augmented_lagrange"),
      HasSubstr("has multipliers"));
  EXPECT_THAT(refusal_of("radius: 1}, mass: 2}",
                         "radius: 1}, mass: 2}\n  wall: {line: {point: [0, "
                         "-3], normal: [0, 1]}}"),
              "");
}

TEST(ExplicitKeys, BodiesWithoutMassMustBeTold) {
  const std::string text =
      edited(edited(test_file("explicit.yaml"), "radius: 1}, mass: 2}", "radius: 1}}"),
             "{on: disc, vx: 0.3, vy: -1, wz: 2}, ", "");
  EXPECT_EQ(any_refusal(text), "");
  EXPECT_THAT(
      any_refusal(edited(text, "    gravity:", "    forces: [{on: disc, fy: -1}]\n    gravity:")),
      HasSubstr("'disc' is free to move and has no mass"));
}

TEST(ExplicitKeys, EquationsOfTwoDisplacementsAreTaken) {
  const std::string text = test_file("explicit.yaml");
  EXPECT_EQ(any_refusal(edited(text, "steps:", "equal: [{on: block.right, of: ux}]\nsteps:")), "");
}

TEST(ExplicitBar, TheEstimateIsTheCriticalStep) {
  const Flight run = run_of(bar(0.99, 1, 1, 1));
  ASSERT_EQ(run.result.outcome, solve::Outcome::converged) << run.result.message;
  EXPECT_NEAR(run.steps.at(0).stable, 0.1, 1e-14);
  EXPECT_EQ(run.steps.at(0).count, 11);
  EXPECT_THAT(run.steps.at(0).governed, HasSubstr("of 'bar'"));
}

TEST(ExplicitBar, IsStableBelowTheCriticalStepAndNotAbove) {
  const Flight stable = run_of(bar(0.99, 1, 3, 99 * 2));
  ASSERT_EQ(stable.result.outcome, solve::Outcome::converged) << stable.result.message;
  const model::Energies& e = stable.energies.back();
  EXPECT_LT(e.kinetic + e.strain, e.start / (1 - 0.99 * 0.99));
  const Flight unstable = run_of(bar(1.01, 1, 3, 99 * 2));
  EXPECT_EQ(unstable.result.outcome, solve::Outcome::numerical_failure);
  EXPECT_THAT(unstable.result.message, HasSubstr("unstable"));
  ASSERT_TRUE(unstable.result.failure.has_value());
  EXPECT_EQ(unstable.result.failure->cause, model::FailureCause::unstable_time_step);
}

/// The bar at rest and a sphere of mass 2, under what `acts` says, as the amplitude from 0 on.
std::string at_rest(const std::string& acts, int increments, double duration, double safety = 0.9) {
  return fmt::format(R"(osculate: 1
mesh: {{generate: {{bar: {{box: {{x: [0, 8], y: [0, 2], elements: [8, 1]}}}}}}}}
materials: {{m: {{linear_elastic: {{E: 100, nu: 0, density: 1}}, expansion: {{alpha: 1e-3}}}}}}
sections: [{{on: bar, material: m, element: plane_strain, kinematics: small}}]
rigid: {{disc: {{circle: {{center: [0, 9], radius: 1}}, mass: 2, inertia: 0.5}}}}
amplitudes: {{slow: [[0, 0], [1, 1]]}}
steps: [{{name: push, increments: {}, duration: {}, {},
  dynamics: {{scheme: {{central_differences: {{safety: {}}}}}}}}}]
)",
                     increments, duration, acts, safety);
}

/// Half a step's kick is all that there is: v = h / 2 f / m.
TEST(ExplicitLoads, ThatBeginAtNothingMayTakeOneTimeStep) {
  const double h = 0.01;
  const auto velocity = [&](const std::string& acts, Index dof) {
    const Flight run = run_of(at_rest(acts + ", amplitude: slow}]", 1, h));
    EXPECT_EQ(run.result.outcome, solve::Outcome::converged) << run.result.message;
    if (run.steps.empty()) return 0.0;
    EXPECT_EQ(run.steps.at(0).count, 1);
    return run.result.state.rates.velocity[dof];
  };
  const Index bodies = 2 * (18 + 3);  // behind the nodes of the bar and of the disc's frame
  EXPECT_NEAR(velocity("forces: [{on: bar.right, fx: 3", 2 * 8), h / 2 * 3 / 0.5, 1e-14);
  EXPECT_NEAR(velocity("pressure: [{on: bar.right, value: -3", 2 * 8), h / 2 * 3 / 0.5, 1e-14);
  EXPECT_NEAR(velocity("body_force: [{on: bar, fx: 3", 2 * 3), h / 2 * 3, 1e-14);
  EXPECT_NEAR(velocity("forces: [{on: disc, fx: 3", bodies), h / 2 * 3 / 2, 1e-14);
  EXPECT_NEAR(velocity("forces: [{on: disc, mz: 3", bodies + 2), h / 2 * 3 / 0.5, 1e-14);
  // An edge of length 2 is pushed by E alpha T, half of it each node.
  EXPECT_NEAR(velocity("temperature: [{on: bar, value: 10", 2 * 8), h / 2 * 1 / 0.5, 1e-14);
}

TEST(ExplicitLoads, OfHeatAreNoGrowth) {
  const Flight run = run_of(at_rest("temperature: [{on: bar, value: 10, amplitude: slow}]", 4, 40));
  ASSERT_EQ(run.result.outcome, solve::Outcome::converged) << run.result.message;
  const Eigen::VectorXd& u = run.result.state.u;
  EXPECT_NEAR(u[2 * 8] - u[0], 8 * 1e-2, 2e-3);  // it swings a little
}

TEST(ExplicitLoads, StillTellOfGrowth) {
  for (const char* const acts : {"forces: [{on: bar.right, fx: 3, amplitude: slow}]",
                                 "temperature: [{on: bar, value: 10, amplitude: slow}]"}) {
    const Flight run = run_of(at_rest(acts, 3, 200, 1.01));
    EXPECT_EQ(run.result.outcome, solve::Outcome::numerical_failure) << acts;
    EXPECT_THAT(run.result.message, HasSubstr("unstable")) << acts;
  }
}

TEST(ExplicitBar, KeepsMomentumAndItsBalance) {
  const Built built = build_text(bar(0.8, 1, 20, 10));
  std::vector<double> momentum;
  const auto mass = [](int node) { return node % 9 == 0 || node % 9 == 8 ? 0.5 : 1.0; };
  (void)run_all<2>(built.model, 1,
                   [&](model::System&, const model::State& state, const solve::IncrementRecord*) {
                     double sum = 0;
                     for (int n = 0; n < 18; ++n) sum += mass(n) * state.rates.velocity[2 * n];
                     momentum.push_back(sum);
                     const model::Energies& e = state.rates.energies;
                     EXPECT_NEAR(e.residual, 0, 1e-12);
                     EXPECT_NEAR(e.kinetic + e.strain, e.start - e.numerical, 1e-12);
                   });
  for (const double p : momentum) EXPECT_NEAR(p, momentum.front(), 1e-12);
}

/// Displacement of the bar's right end at the time 0.5, with the largest step.
double end_of_bar(double step) {
  const Flight run = run_of(bar(0.9, step, 1, 0.5));
  return run.result.state.u[2 * 8];
}

TEST(ExplicitBar, IsOfSecondOrder) {
  const double e1 = end_of_bar(0.02) - end_of_bar(0.01), e2 = end_of_bar(0.01) - end_of_bar(0.005);
  EXPECT_NEAR(std::log2(std::abs(e1 / e2)), 2, 0.1);
}

TEST(ExplicitImpact, HasTheSameBitsWithTwoThreads) {
  const std::string text = test_file("explicit.yaml");
  const Flight one = run_of(text, 1), two = run_of(text, 2);
  ASSERT_EQ(one.result.outcome, solve::Outcome::converged) << one.result.message;
  EXPECT_EQ(one.result.state.u, two.result.state.u);
  EXPECT_EQ(one.result.state.rates.velocity, two.result.state.rates.velocity);
}

/// 2500 cells and 5202 dofs: threads share parts of cells and turns of dofs.
TEST(ExplicitImpact, OfManyCellsHasTheSameBitsWithThreads) {
  const std::string text = R"(osculate: 1
mesh: {generate: {b: {box: {x: [0, 1], y: [0, 1], elements: [50, 50]}}}}
materials: {soft: {neo_hooke: {E: 100, nu: 0.3, density: 1}}}
sections: [{on: b, material: soft, element: plane_strain}]
initial_velocity: [{on: b.left, vx: 1}]
steps: [{name: s, increments: 2, duration: 0.02, dynamics: {scheme: central_differences}}]
)";
  const Flight one = run_of(text, 1);
  ASSERT_EQ(one.result.outcome, solve::Outcome::converged) << one.result.message;
  EXPECT_GT(one.result.state.u.norm(), 0);
  for (const int threads : {2, 3}) {
    const Flight several = run_of(text, threads);
    EXPECT_EQ(one.result.state.u, several.result.state.u);
    EXPECT_EQ(one.result.state.rates.velocity, several.result.state.rates.velocity);
    EXPECT_EQ(one.energies.back().strain, several.energies.back().strain);
  }
}

/// 161 slave points over facets and over a plane: threads share them.
TEST(ExplicitImpact, OfManyPointsHasTheSameBitsWithThreads) {
  const std::string text = R"(osculate: 1
mesh:
  generate:
    low: {box: {x: [-0.2, 1.2], y: [-0.1, 0], elements: [70, 3]}}
    high: {box: {x: [0, 1], y: [0.004, 0.1], elements: [160, 4]}}
materials: {soft: {neo_hooke: {E: 100, nu: 0.3, density: 1}}}
sections: [{on: low, material: soft, element: plane_strain}, {on: high, material: soft, element: plane_strain}]
rigid: {floor: {line: {point: [0.5, -0.13], normal: [0.04, 1]}}}
contact:
  - {name: hit, master: low.top, slave: high.bottom, friction: {coulomb: {mu: 0.2}}}
  - {name: rest, master: floor, slave: low.bottom, friction: {coulomb: {mu: 0.2}}}
initial_velocity: [{on: high, vy: -2, vx: 1}]
steps: [{name: s, increments: 2, duration: 0.02, dynamics: {scheme: central_differences}}]
)";
  const Flight one = run_of(text, 1);
  ASSERT_EQ(one.result.outcome, solve::Outcome::converged) << one.result.message;
  EXPECT_GT(one.energies.back().contact, 0);
  for (const int threads : {2, 3}) {
    const Flight several = run_of(text, threads);
    EXPECT_EQ(one.result.state.u, several.result.state.u);
    EXPECT_EQ(one.result.state.rates.velocity, several.result.state.rates.velocity);
    EXPECT_EQ(one.energies.back().contact, several.energies.back().contact);
  }
}

TEST(ExplicitImpact, GoesOnFromTheMiddleWithTheSameBits) {
  const Built built =
      build_text(edited(test_file("explicit.yaml"), "increments: 4", "increments: 8"));
  std::optional<model::ResumePoint> middle;
  model::AnalysisObserver observer;
  observer.resumable = [&](const model::System& system, const model::State& state,
                           const model::Progress& p, const solve::StepPosition& position) {
    if (p.increment == 3)
      middle = model::ResumePoint{state, p, position, system.memory(), {{"hit", {}}}};
    return p.increment == 3;
  };
  const model::AnalysisResult whole = model::run(built.model, {}, observer);
  ASSERT_TRUE(middle.has_value());
  const model::AnalysisResult rest = model::run(built.model, {}, {}, &*middle);
  EXPECT_EQ(rest.steps.at(0).increments.size(), 5u);
  EXPECT_EQ(rest.state.u, whole.state.u);
  EXPECT_EQ(rest.state.rates.velocity, whole.state.rates.velocity);
  EXPECT_EQ(rest.state.rates.energies.numerical, whole.state.rates.energies.numerical);
}

/// Residual of the ledger and what the scheme has taken, at the end of the impact.
model::Energies energies_with(double step, const std::string& text = test_file("explicit.yaml")) {
  const Flight run =
      run_of(edited(text, "{safety: 0.9}", fmt::format("{{safety: 0.9, step: {}}}", step)));
  EXPECT_EQ(run.result.outcome, solve::Outcome::converged) << run.result.message;
  return run.energies.back();
}

TEST(ExplicitImpact, TheLedgerClosesWithSecondOrder) {
  const model::Energies coarse = energies_with(1e-3), fine = energies_with(2.5e-4);
  EXPECT_GT(coarse.friction, 0);
  EXPECT_GT(coarse.damping, 0);
  EXPECT_NEAR(coarse.elapsed, 0.1, 1e-15);
  EXPECT_LT(std::abs(coarse.residual), 1e-3 * coarse.start);
  EXPECT_LT(std::abs(fine.residual), std::abs(coarse.residual) / 8);
  // With friction, the shear springs of points that open let go of theirs, whatever the step.
  const std::string smooth =
      edited(test_file("explicit.yaml"), ", friction: {coulomb: {mu: 0.4, penalty: 700}}", "");
  EXPECT_LT(std::abs(energies_with(2.5e-4, smooth).numerical),
            std::abs(energies_with(1e-3, smooth).numerical) / 4);
}

TEST(ExplicitImpact, PrescribedNodesEndOnTheirRamp) {
  const Built built = build_text(test_file("explicit.yaml"));
  const model::AnalysisResult result = run_to_end(built, 1, [](auto&, auto&) {});
  for (Index n = 0; n < 9; ++n) {
    EXPECT_EQ(result.state.u[2 * n], 0.01);
    EXPECT_EQ(result.state.u[2 * n + 1], 0);
    EXPECT_NEAR(result.state.rates.velocity[2 * n], 0.1, 1e-9);
  }
}

/// Calls of malloc while a system advances by `increments` of the step's four at once.
std::size_t allocations(const std::string& text, double fraction, int& steps) {
  const Built built = build_text(text);
  model::System system(built.model, 1);
  model::State state = system.initial_state();
  system.begin_step(built.model.steps.front(), state);
  state = system.begin_motion(state);
  state = system.advance(state, 0.6).state;
  const std::size_t before = osculate::testing::allocation_count();
  steps = system.advance(state, fraction).time_steps.count;
  return osculate::testing::allocation_count() - before;
}

TEST(ExplicitImpact, TimeStepsAllocateNothing) {
  const std::string text = edited(edited(test_file("explicit.yaml"), "neo_hooke", "linear_elastic"),
                                  "{safety: 0.9}", "{step: 1e-4}");
  int few = 0, many = 0;
  const std::size_t short_way = allocations(text, 0.61, few);
  const std::size_t long_way = allocations(text, 0.65, many);
  EXPECT_GT(many, 3 * few);
  EXPECT_EQ(short_way, long_way);
}

/// A free box in space that flies, turns and is hit by nothing.
const char* const free_top = R"(osculate: 1
title: A free top and a cube
mesh: {generate: {cube: {box: {x: [5, 6], y: [0, 1], z: [0, 1], elements: [2, 2, 2]}}}}
materials: {m: {linear_elastic: {E: 100, nu: 0.3, density: 1}}}
sections: [{on: cube, material: m, element: solid}]
rigid: {top: {sphere: {center: [0, 0, 0], radius: 1}, mass: 2, inertia: [1, 2, 3]}}
contact: [{name: c, master: top, slave: cube.left, normal: {penalty: 100}}]
initial_velocity: [{on: top, wx: 0.1, wy: 4, wz: 0.1}, {on: cube, vx: 0.1}]
steps: [{name: fly, increments: 20, duration: 4, dynamics: {scheme: {central_differences: {step: 0.01}}}}]
)";

TEST(ExplicitTop, KeepsMomentumAndEnergy) {
  const Built3 built = built_from(free_top);
  std::optional<Vec3> first;
  double energy = 0, least = 1;
  const auto result =
      run_all<3>(built.model, 1,
                 [&](model::System3&, const model::State3& state, const solve::IncrementRecord*) {
                   const Mat<3, 3> r = state.rigid[0].orientation();
                   const Vec3 spin = state.rates.velocity.segment<3>(
                       3 * static_cast<Index>(built.model.reference.size()) + 3);
                   const Vec3 momentum = r * built.model.rigid[0].inertia * r.transpose() * spin;
                   const model::Energies& e = state.rates.energies;
                   if (!first) {
                     first = momentum;
                     energy = e.kinetic;
                   }
                   least = std::min(least, r(1, 1));
                   EXPECT_LT((momentum - *first).norm(), 1e-12 * first->norm());
                   EXPECT_NEAR(e.kinetic, energy, 1e-11 * energy);
                 });
  EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
  EXPECT_LT(least, -0.5);  // it turns over: the axis is the middle one
}

/// Damping by mass takes the same share of the spin in every time step.
///
/// Formula    L_n+1 = L_n (1 - alpha h / 2) / (1 + alpha h / 2)
TEST(ExplicitTop, IsDampedByItsMass) {
  const double h = 0.01, alpha = 0.4, share = (1 - 0.5 * alpha * h) / (1 + 0.5 * alpha * h);
  const Built3 built =
      built_from(edited(edited(edited(edited(free_top, "inertia: [1, 2, 3]", "inertia: [2, 2, 2]"),
                                      "increments: 20", "increments: 1"),
                               "duration: 4", "duration: 0.2"),
                        "{step: 0.01}}}}", "{step: 0.01}}, damping: {mass: 0.4}}}"));
  const Index first = 3 * static_cast<Index>(built.model.reference.size());
  int seen = 0;
  const auto look = [&](model::System3& system, const model::State3& state,
                        const solve::IncrementRecord* record) {
    if (!record) return;
    ++seen;
    ASSERT_EQ(record->time_steps.count, 20);
    const double left = std::pow(share, 20);
    const Eigen::VectorXd& v = state.rates.velocity;
    EXPECT_LT((v.segment<3>(first + 3) - left * Vec3(0.1, 4, 0.1)).norm(), 1e-12);
    EXPECT_LT(v.segment<3>(first).norm(), 1e-15);
    const model::Energies& e = state.rates.energies;
    EXPECT_NEAR(e.damping + e.numerical, e.start - e.kinetic - e.strain, 1e-12 * e.start);
    EXPECT_NEAR(e.damping, e.start - e.kinetic - e.strain, 1e-5 * e.start);
    // What moves freely has no reaction.
    const Eigen::VectorXd rest = model::reactions(system);
    EXPECT_LT(rest.segment<6>(first).norm(), 1e-12);
  };
  const auto result = run_all<3>(built.model, 1, look);
  EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
  EXPECT_EQ(seen, 1);
}

TEST(ExplicitKeys, RotationsInSpaceAreNoTermsOfEquations) {
  const std::string tied = edited(free_top, "initial_velocity:",
                                  "equations: [{terms: [{on: cube.bottom_front_left, of: uz, "
                                  "factor: 1}, {on: top, of: rx, factor: -1}]}]\n"
                                  "initial_velocity:");
  EXPECT_THAT(any_refusal(tied), HasSubstr("has a rotation of a rigid body"));
}

/// A node that follows another shares what it was given, also where that is nothing.
TEST(ExplicitKeys, VelocitiesOfWhatFollowsAreShared) {
  for (const char* const scheme : {"central_differences", "newmark"})
    for (const auto& [given, left] :
         {std::pair{"{on: bar.left, vx: 1}, {on: bar.right, vx: 0}", 0.5},
          std::pair{"{on: bar.left, vx: 1}", 1.0}}) {
      const Built built = build_text(fmt::format(R"(osculate: 1
mesh: {{generate: {{bar: {{box: {{x: [0, 1], y: [0, 1], elements: [1, 1]}}}}}}}}
materials: {{m: {{linear_elastic: {{E: 1, nu: 0, density: 1}}}}}}
sections: [{{on: bar, material: m, element: plane_strain}}]
equal: [{{on: bar, of: ux}}]
initial_velocity: [{}]
steps: [{{name: s, increments: 1, duration: 1e-6, dynamics: {{scheme: {}, mass: lumped}}}}]
)",
                                                 given, scheme));
      const model::AnalysisResult result = run_to_end(built, 1, [](auto&, auto&) {});
      for (Index n = 0; n < 4; ++n)
        EXPECT_NEAR(result.state.rates.velocity[2 * n], left, 1e-9) << scheme << given;
    }
}

/// A block that falls on a floor with an energy of 2.
std::string falling(const std::string& penalty, const std::string& more = "") {
  return fmt::format(R"(osculate: 1
mesh: {{generate: {{b: {{box: {{x: [0, 1], y: [0.02, 1.02], elements: [6, 6]}}}}}}}}
materials: {{m: {{linear_elastic: {{E: 1000, nu: 0.3, density: 1}}}}}}
sections: [{{on: b, material: m, element: plane_strain, formulation: full}}]
rigid: {{floor: {{line: {{point: [0, 0], normal: [0, 1]}}}}}}
contact: [{{name: c, master: floor, slave: b.bottom, normal: {{penalty: {}}}}}]
initial_velocity: [{{on: b, vy: -2}}]
steps: [{{name: fall, increments: 20, duration: 0.3, dynamics: {{scheme: central_differences{}}}}}]
)",
                     penalty, more);
}

TEST(Explicit, AnImpactOnAStiffContactMakesNoEnergy) {
  for (const char* penalty : {"1e5", "1e6", "1e8"}) {
    const Flight flight = run_of(falling(penalty));
    ASSERT_EQ(flight.result.outcome, solve::Outcome::converged);
    const model::Energies& e = flight.energies.back();
    EXPECT_NEAR(e.kinetic + e.strain + e.contact, 2, 0.03) << penalty;
  }
}

TEST(Explicit, DampingByMassOnlyTakesEnergyAway) {
  for (const int mass : {100, 1000, 10000}) {
    const Flight flight = run_of(falling("1e4", fmt::format(", damping: {{mass: {}}}", mass)));
    ASSERT_EQ(flight.result.outcome, solve::Outcome::converged);
    double before = 0;
    for (const model::Energies& e : flight.energies) {
      EXPECT_GE(e.damping, before) << mass;
      before = e.damping;
    }
    EXPECT_NEAR(before, 2, 0.2) << mass;
  }
}

}  // namespace
}  // namespace osculate::deck
