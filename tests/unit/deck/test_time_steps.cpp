// Time steps that are chosen by their errors: keys, the error of a step, what they leave behind.
#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <cmath>

#include "osculate/la/mumps.hpp"
#include "osculate/model/inertia.hpp"
#include "space_test.hpp"
#include "system_test.hpp"

namespace osculate::deck {
namespace {

std::string swinging(const std::string& more = "") {
  return R"(osculate: 1
title: A block that swings behind a base that moves
mesh: {generate: {block: {box: {x: [0, 2], y: [0, 1], elements: [2, 1]}}}}
materials: {m: {linear_elastic: {E: 40, nu: 0.3, density: 1}}}
sections: [{on: block, material: m, element: plane_strain}]
amplitudes:
  ramp: [[0, 0], [0.3, 0], [0.37, 1], [1, 1]]
steps:
  - name: shake
    increments: 2
    duration: 1
    dynamics: {time_steps: {error: 1e-2, smallest: 1e-5})" +
         more + R"(}
    prescribe: [{on: block.left, ux: 0.02, uy: 0}]
    traction: [{on: block.right, ty: 1, amplitude: ramp}]
solver: {tolerance: {residual: 1e-12, energy: 0.9}}
)";
}

std::string refusal_of(const std::string& from, const std::string& to) {
  return any_refusal(edited(swinging(), from, to));
}

TEST(TimeStepKeys, BecomeTheModel) {
  const Built built = build_text(swinging());
  const auto& steps = built.model.steps.at(0).dynamics->time_steps;
  ASSERT_TRUE(steps.has_value());
  EXPECT_EQ(steps->error, 1e-2);
  EXPECT_EQ(steps->smallest, 1e-5);
  const Built plain = build_text(edited(swinging(), "{error: 1e-2, smallest: 1e-5}", "{}"));
  EXPECT_EQ(plain.model.steps.at(0).dynamics->time_steps->error, 1e-3);
  EXPECT_EQ(plain.model.steps.at(0).dynamics->time_steps->smallest, 0.5e-3);
  const Built none =
      build_text(edited(swinging(), "time_steps: {error: 1e-2, smallest: 1e-5}", ""));
  EXPECT_FALSE(none.model.steps.at(0).dynamics->time_steps.has_value());
}

TEST(TimeStepKeys, AreRefusedWithTheReason) {
  EXPECT_EQ(refusal_of("error: 1e-2", "error: 1e-2"), "");
  EXPECT_EQ(refusal_of("smallest: 1e-5", "smallest: 0.6"),
            "model.yaml:12: steps[0].dynamics.time_steps.smallest: must be at most a nominal "
            "increment, duration / increments = 0.5, got 0.6");
  EXPECT_THAT(refusal_of("error: 1e-2", "error: 0"), ::testing::HasSubstr("time_steps.error"));
  EXPECT_THAT(refusal_of("error: 1e-2", "eror: 1e-2"), ::testing::HasSubstr("'error'"));
  EXPECT_THAT(refusal_of("dynamics: {", "dynamics: {scheme: central_differences, "),
              ::testing::HasSubstr("dynamics.time_steps: is of the implicit schemes"));
}

TEST(TimeCorners, AreThoseOfTables) {
  const Built built = build_text(swinging());
  EXPECT_EQ(model::corners(built.model.steps.at(0)), (std::vector<double>{0.3, 0.37}));
  std::string smooth = "[";
  for (int i = 0; i <= 100; ++i)
    smooth += (i ? ", [" : "[") + std::to_string(0.01 * i) + ", " +
              std::to_string(1 - std::cos(0.01 * i)) + "]";
  const Built sampled =
      build_text(edited(swinging(), "[[0, 0], [0.3, 0], [0.37, 1], [1, 1]]", smooth + "]"));
  EXPECT_EQ(model::corners(sampled.model.steps.at(0)), (std::vector<double>{1}));
}

// ---- the error of a step -----------------------------------------------------------------------

/// Displacements and the motions of bodies at the end of a run of `increments` over `duration`,
/// and the error of the first time step.
template <int Dim>
struct Way {
  Eigen::VectorXd dofs;
  std::vector<body::BasicRigidMotion<Dim>> rigid;
  double error = 0;
};

template <int Dim>
Way<Dim> way_of(BasicBuilt<Dim> built, int increments, double duration) {
  model::Step& step = built.model.steps.at(0);
  step.increments = increments;
  step.duration = duration;
  step.dynamics->time_steps = model::TimeStepLengths{1e9, 0};
  Way<Dim> way;
  model::BasicState<Dim> before;
  model::BasicAnalysisObserver<Dim> observer;
  observer.converged = [&](model::BasicSystem<Dim>& system, const model::BasicState<Dim>& state,
                           const model::Progress& p, const solve::IncrementRecord* record) {
    if (record && p.increment == 1)
      way.error = system.time_error(before, state).rate * duration / increments;
    before = state;
    way.rigid = state.rigid;
    way.dofs.setZero(system.dofs().dofs());
    way.dofs.head(state.u.size()) = state.u;
    for (std::size_t b = 0; b < state.rigid.size(); ++b)
      for (int i = 0; i < body::motions<Dim>; ++i)
        way.dofs[system.dofs().body_dof(static_cast<Index>(b), i)] = state.rigid[b].component(i);
    return true;
  };
  EXPECT_EQ(model::run(built.model, built.options, observer).outcome, solve::Outcome::converged);
  return way;
}

/// Estimated over true error of one step from the start, minus one.
template <int Dim>
double miss(const BasicBuilt<Dim>& built, double h) {
  const Way<Dim> one = way_of(built, 1, h), fine = way_of(built, 64, h);
  const model::BasicInertia<Dim> inertia(built.model, false);
  const Eigen::VectorXd error = one.dofs - fine.dofs;
  double sum = error.dot(inertia.multiply(error));
  if constexpr (Dim == 3) {
    for (std::size_t b = 0; b < one.rigid.size(); ++b) {
      const Eigen::AngleAxisd turn(
          Mat<3, 3>(fine.rigid[b].orientation().transpose() * one.rigid[b].orientation()));
      const Vec3 angle = turn.angle() * turn.axis();
      if (inertia.body_has_mass(b)) sum += angle.dot(built.model.rigid[b].inertia * angle);
    }
  }
  EXPECT_GT(one.error, 0);
  return one.error / std::sqrt(sum) - 1;
}

template <int Dim>
void expect_the_true_error(const BasicBuilt<Dim>& built, double h) {
  const double coarse = miss(built, h), fine = miss(built, 0.5 * h);
  EXPECT_LT(std::abs(fine), 0.1);
  // The fine run is of 64 steps: it has 1/64^2 of the error itself.
  EXPECT_LT(std::abs(fine), 0.6 * std::abs(coarse) + 1e-3);
}

constexpr const char* elastic = R"(osculate: 1
mesh: {generate: {block: {box: {x: [0, 2], y: [0, 1], elements: [2, 1]}}}}
materials: {m: {linear_elastic: {E: 40, nu: 0.3, density: 1}}}
sections: [{on: block, material: m, element: plane_strain}]
initial_velocity: [{on: block.right, vx: 1, vy: -0.5}]
steps:
  - name: swing
    increments: 1
    duration: 1
    dynamics: {}
    prescribe: [{on: block.left, ux: 0, uy: 0}]
    traction: [{on: block.right, ty: 1}]
solver: {tolerance: {residual: 1e-13, energy: 0.9}}
)";

TEST(TimeError, OfAnElasticBodyIsTheTrueOne) {
  for (const char* const impact : {"dissipative", "average"})
    expect_the_true_error(
        build_text(edited(elastic, "dynamics: {}",
                          std::string("dynamics: {impact: ") + impact + ", damping: {mass: 0.3}}")),
        0.004);
}

constexpr const char* thrown_top = R"(osculate: 1
mesh: {generate: {plate: {box: {x: [0, 1], y: [0, 1], z: [0, 1], elements: [1, 1, 1]}}}}
materials: {m: {linear_elastic: {E: 400, nu: 0.3, density: 1}}}
sections: [{on: plate, material: m, element: solid}]
rigid: {body: {sphere: {center: [4, 0, 0], radius: 1}, mass: 2.5, inertia: [1, 2, 2.5]}}
initial_velocity: [{on: body, vx: 0.4, wx: 2, wy: -1, wz: 3}]
steps:
  - name: turn
    increments: 1
    duration: 1
    dynamics: {}
    prescribe: [{on: plate, ux: 0, uy: 0, uz: 0}]
    forces: [{on: body, mx: 0}]
solver: {tolerance: {residual: 1e-13, energy: 0.9}}
)";

TEST(TimeError, OfATurningBodyIsTheTrueOne) { expect_the_true_error(built_from(thrown_top), 0.02); }

// ---- what a refused step leaves behind ---------------------------------------------------------

model::State solved(model::System& system, const model::State& from, double until,
                    la::LinearSolver& solver) {
  solve::NewtonOptions options;
  options.residual = 1e-12;
  solve::Condensation<model::System> condensation;
  int wasted = 0;
  const solve::NewtonResult<model::Trial> attempt =
      solve::detail::solve_increment(system, from, until, options, solver, condensation, wasted);
  EXPECT_EQ(attempt.outcome, solve::Outcome::converged);
  return system.commit(attempt.trial, until);
}

constexpr const char* on_a_base = R"(osculate: 1
mesh: {generate: {block: {box: {x: [0.2, 1.2], y: [0, 2], elements: [1, 2]}}}}
materials: {m: {neo_hooke: {E: 40, nu: 0.3, density: 1}}}
sections: [{on: block, material: m, element: plane_strain, kinematics: finite}]
rigid: {base: {set: block.bottom, reference: [0, 0]}}
steps:
  - name: shake
    increments: 1
    duration: 1
    dynamics: {time_steps: {}, damping: {mass: 0.2, stiffness: 2.0e-3}}
    prescribe: [{on: base, ux: 0, uy: 0, rz: 0.4}]
)";

TEST(TimeSteps, ThatAreRefusedLeaveNothingBehind) {
  const Built built = build_text(on_a_base);
  std::array<model::State, 2> ends;
  for (const bool refused : {false, true}) {
    model::System system(built.model, 1);
    la::Mumps solver;
    model::State state = system.initial_state();
    system.begin_step(built.model.steps.front(), state);
    state = system.begin_motion(state);
    state = solved(system, state, 0.1, solver);
    if (refused) {
      const model::State dropped = solved(system, state, 0.5, solver);
      EXPECT_GT(system.time_error(state, dropped).rate, 0);
    }
    ends[refused] = solved(system, state, 0.2, solver);
    const solve::TimeError error = system.time_error(state, ends[refused]);
    EXPECT_EQ(error.length, 0.2 - 0.1);
  }
  EXPECT_EQ(ends[0].u, ends[1].u);
  EXPECT_EQ(ends[0].rates.velocity, ends[1].rates.velocity);
  EXPECT_EQ(ends[0].rates.acceleration, ends[1].rates.acceleration);
  EXPECT_EQ(ends[0].rates.energies.external, ends[1].rates.energies.external);
}

/// A load begins after three increments of rest.
TEST(Dynamics, TimeGoesOnWhereNothingMoves) {
  const std::string even =
      edited(edited(swinging(), "time_steps: {error: 1e-2, smallest: 1e-5}", ""), "increments: 2",
             "increments: 10");
  const Built built = build_text(edited(even, "ux: 0.02", "ux: 0"));
  std::vector<double> times;
  model::AnalysisObserver observer;
  observer.converged = [&](model::System&, const model::State& state, const model::Progress&,
                           const solve::IncrementRecord*) {
    times.push_back(state.rates.energies.elapsed);
    return true;
  };
  EXPECT_EQ(model::run(built.model, built.options, observer).outcome, solve::Outcome::converged);
  ASSERT_EQ(times.size(), 11u);
  for (std::size_t i = 0; i < times.size(); ++i)
    EXPECT_NEAR(times[i], 0.1 * static_cast<double>(i), 1e-12);
}

// ---- what is prescribed ------------------------------------------------------------------------

/// A base that begins to move at once, and stops at once: its own accelerations are no errors.
TEST(TimeError, HasNoPartOfWhatIsPrescribed) {
  constexpr const char* carried = R"(osculate: 1
mesh: {generate: {block: {box: {x: [0, 1], y: [0, 1], elements: [1, 1]}}}}
materials: {m: {linear_elastic: {E: 40, nu: 0, density: 1}}}
sections: [{on: block, material: m, element: plane_strain}]
amplitudes: {stop: [[0, 0], [0.5, 1], [1, 1]]}
steps:
  - name: push
    increments: 2
    duration: 1
    dynamics: {time_steps: {error: 1e-2}}
    prescribe: [{on: block, uy: 0}, {on: block.left, ux: 1, amplitude: stop},
      {on: block.right, ux: 1, amplitude: stop}]
)";
  const Built built = build_text(carried);
  int increments = 0;
  model::AnalysisObserver observer;
  observer.converged = [&](model::System&, const model::State&, const model::Progress&,
                           const solve::IncrementRecord* record) {
    if (!record) return true;
    ++increments;
    EXPECT_EQ(record->time_step.error, 0);
    return true;
  };
  EXPECT_EQ(model::run(built.model, built.options, observer).outcome, solve::Outcome::converged);
  EXPECT_EQ(increments, 2);
}

/// Flights are parabolas, and an impact that stops a body is no acceleration.
TEST(TimeSteps, HaveNoErrorsInFlightsAndPlasticImpacts) {
  const std::string even = test_file("impacts.yaml");
  std::array<std::vector<double>, 2> times;
  for (const bool chosen : {false, true}) {
    const Built built = build_text(
        chosen ? edited(even, "impact_times: all", "impact_times: all, time_steps: {}") : even);
    model::AnalysisObserver observer;
    observer.converged = [&](model::System&, const model::State& state, const model::Progress&,
                             const solve::IncrementRecord*) {
      times[chosen].push_back(state.rates.energies.elapsed);
      return true;
    };
    EXPECT_EQ(model::run(built.model, built.options, observer).outcome, solve::Outcome::converged);
  }
  EXPECT_EQ(times[0], times[1]);
}

TEST(TimeSteps, EndAtCorners) {
  const Built built = build_text(swinging());
  std::vector<double> ends;
  model::AnalysisObserver observer;
  observer.converged = [&](model::System&, const model::State&, const model::Progress& p,
                           const solve::IncrementRecord*) {
    ends.push_back(p.fraction);
    return true;
  };
  EXPECT_EQ(model::run(built.model, built.options, observer).outcome, solve::Outcome::converged);
  for (const double corner : {0.3, 0.37, 0.5, 1.0})
    EXPECT_NE(std::find(ends.begin(), ends.end(), corner), ends.end()) << corner;
  EXPECT_GT(ends.size(), 10u);
}

}  // namespace
}  // namespace osculate::deck
