// Mass that cells get in explicit steps: which, how much, and that it is mass and no weight.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "osculate/model/mass_scaling.hpp"
#include "osculate/model/quantities.hpp"
#include "space_test.hpp"
#include "system_test.hpp"

namespace osculate::deck {
namespace {

using ::testing::HasSubstr;

/// A bar along x with c = 10, E A = 200 and a mass of 2 a length, of 40 cells of 0.25 but for two:
/// their common node stands at 7.65 instead of 7.5, so that the stable step is that of a cell of
/// 0.1 between all others.
struct Bar {
  std::string scheme = "central_differences";
  std::string start = "{on: bar, vx: 0.2}, {on: bar.left, vx: 1}";
  std::string more{};  ///< keys of the step
  int increments = 4;
  double duration = 1, density = 1;
};
constexpr double thin_step = 0.01, other_step = 0.025, bar_mass = 20;

Built built_bar(const Bar& b) {
  Built built =
      build_text(fmt::format(R"(osculate: 1
mesh: {{generate: {{bar: {{box: {{x: [0, 10], y: [0, 2], elements: [40, 1]}}}}}}}}
materials: {{m: {{linear_elastic: {{E: 100, nu: 0, density: {}}}}}}}
sections: [{{on: bar, material: m, element: plane_strain, kinematics: small}}]
initial_velocity: [{}]
steps: [{{name: fly, increments: {}, duration: {:.17g}, dynamics: {{scheme: {}}}{}}}]
)",
                             b.density, b.start, b.increments, b.duration, b.scheme, b.more));
  for (Vec2& x : built.model.reference)
    if (x.x() == 7.5) x.x() = 7.65;
  return built;
}

std::string scaled_to(const std::string& keys, const std::string& more = "") {
  return fmt::format("{{central_differences: {{mass_scaling: {{{}}}{}}}}}", keys, more);
}

struct Flown {
  model::AnalysisResult result;
  int steps = 0;
  double stable = 0;
  std::string governed;
  [[nodiscard]] const model::Energies& energies() const { return result.state.rates.energies; }
};

Flown fly(const Built& built, int threads = 1) {
  model::AnalysisOptions options;
  options.threads = threads;
  Flown out;
  out.result = model::run(built.model, options, {});
  EXPECT_EQ(out.result.outcome, solve::Outcome::converged) << out.result.message;
  for (const model::StepRecord& step : out.result.steps)
    for (const solve::IncrementRecord& record : step.increments) {
      out.steps += record.time_steps.count;
      out.stable = record.time_steps.stable;
      out.governed = record.time_steps.governed;
    }
  return out;
}
Flown fly(const Bar& b, int threads = 1) { return fly(built_bar(b), threads); }

model::ScaledMasses masses_of(const Built& built) {
  model::System system(built.model, 2);
  system.begin_step(built.model.steps.front(), system.initial_state());
  return system.scaled_masses();
}

TEST(MassScaling, IsOfTheCellsThatAreTooFastAlone) {
  const model::ScaledMasses masses =
      masses_of(built_bar({.scheme = scaled_to("stable_step: 0.025")}));
  ASSERT_EQ(masses.factors.size(), 40u);
  const double lacks = other_step / thin_step;
  for (std::size_t c = 0; c < 40; ++c)
    EXPECT_NEAR(masses.factors[c], c == 30 ? lacks * lacks : 1.0, 1e-10) << c;
  ASSERT_EQ(masses.sections.size(), 1u);
  const model::ScaledMasses::Section& bar = masses.sections[0];
  EXPECT_NEAR(bar.mass, bar_mass, 1e-12);
  EXPECT_NEAR(bar.added, (lacks * lacks - 1) * 0.1 * 2, 1e-9);
  EXPECT_NEAR(bar.needed, bar.added, 1e-12);
  EXPECT_NEAR(bar.largest, lacks * lacks, 1e-10);
  EXPECT_EQ(bar.cells, 40u);
}

TEST(MassScaling, OfAllCellsComesBeforeThatOfTheStableStep) {
  const model::ScaledMasses masses =
      masses_of(built_bar({.scheme = scaled_to("stable_step: 0.025, factor: 4")}));
  const double lacks = other_step / thin_step;
  for (std::size_t c = 0; c < 40; ++c)
    EXPECT_NEAR(masses.factors[c], c == 30 ? lacks * lacks : 4.0, 1e-10) << c;
  const model::ScaledMasses::Section& bar = masses.sections[0];
  EXPECT_EQ(bar.scaled, 40u);
  EXPECT_NEAR(bar.needed, (lacks * lacks - 4) * 0.1 * 2, 1e-9);
  EXPECT_NEAR(bar.added, 3 * bar_mass + bar.needed, 1e-9);
}

TEST(MassScaling, GivesTheStableStepThatIsWanted) {
  const Flown plain = fly(Bar{}), scaled = fly(Bar{.scheme = scaled_to("stable_step: 0.025")});
  EXPECT_NEAR(plain.stable, thin_step, 1e-13);
  EXPECT_NEAR(scaled.stable, other_step, 1e-13);
  EXPECT_EQ(plain.steps, 4 * 28);   // 0.25 / (0.9 * 0.01)
  EXPECT_EQ(scaled.steps, 4 * 12);  // 0.25 / (0.9 * 0.025)
  // It would not be stable by chance: beyond it the energy grows.
  const Built built = built_bar({.scheme = scaled_to("stable_step: 0.025", ", safety: 1.05"),
                                 .increments = 3,
                                 .duration = 30});
  const model::AnalysisResult result = model::run(built.model, {}, {});
  EXPECT_EQ(result.outcome, solve::Outcome::numerical_failure);
  EXPECT_THAT(result.message, HasSubstr("unstable"));
}

void expect_same_bits(const Flown& a, const Flown& b) {
  EXPECT_EQ(a.result.state.u, b.result.state.u);
  EXPECT_EQ(a.result.state.rates.velocity, b.result.state.rates.velocity);
  EXPECT_EQ(a.energies().kinetic, b.energies().kinetic);
  EXPECT_EQ(a.energies().residual, b.energies().residual);
  EXPECT_EQ(a.steps, b.steps);
}

TEST(MassScaling, ThatNoCellNeedsChangesNoBit) {
  const Bar none{.more = ", gravity: [3, 0]"};
  Bar enough = none;
  enough.scheme = scaled_to("stable_step: 0.0099");
  EXPECT_TRUE(masses_of(built_bar(enough)).factors.empty());
  const Flown a = fly(none);
  expect_same_bits(a, fly(enough));
  EXPECT_GT(a.result.state.u.norm(), 0);
  enough.scheme = scaled_to("stable_step: 0.0101");
  EXPECT_NE(fly(enough).result.state.u, a.result.state.u);
}

/// A body of four times the density, if nothing has a weight.
TEST(MassScaling, OfAllCellsIsADensity) {
  expect_same_bits(fly(Bar{.scheme = scaled_to("factor: 4")}), fly(Bar{.density = 4}));
}

TEST(MassScaling, HasTheSameBitsWithThreadsAndAfterARestart) {
  const Bar bar{.scheme = scaled_to("stable_step: 0.025"), .more = ", gravity: [3, 0]"};
  expect_same_bits(fly(bar), fly(bar, 3));
  const Built built = built_bar(bar);
  std::optional<model::ResumePoint> middle;
  model::AnalysisObserver observer;
  observer.resumable = [&](const model::System& system, const model::State& state,
                           const model::Progress& p, const solve::StepPosition& position) {
    if (p.increment == 2)
      middle = model::ResumePoint{state, p, position, system.memory(), {{"fly", {}}}};
    return p.increment == 2;
  };
  const model::AnalysisResult whole = model::run(built.model, {}, observer);
  ASSERT_TRUE(middle.has_value());
  const model::AnalysisResult rest = model::run(built.model, {}, {}, &*middle);
  EXPECT_EQ(rest.steps.at(0).increments.size(), 2u);
  EXPECT_EQ(rest.state.u, whole.state.u);
  EXPECT_EQ(rest.state.rates.velocity, whole.state.rates.velocity);
  EXPECT_EQ(rest.state.rates.energies.numerical, whole.state.rates.energies.numerical);
}

/// Momentum with the masses that move.
double momentum_of(const Built& built, const model::System& system, const model::State& state) {
  const model::BasicInertia<2> inertia(built.model, true);
  const model::ScaledMasses& masses = system.scaled_masses();
  double sum = 0;
  for (std::size_t c = 0; c < inertia.cells().size(); ++c)
    for (std::size_t k = 0; k < inertia.cells()[c].nodes.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      sum += masses.factor(c) * inertia.cells()[c].mass(i, i) *
             state.rates.velocity[2 * inertia.cells()[c].nodes[k]];
    }
  return sum;
}

TEST(MassScaling, KeepsMomentumAndTheBalanceOfEnergy) {
  const Built built = built_bar({.scheme = scaled_to("stable_step: 0.025"), .increments = 20});
  std::vector<double> momentum;
  model::AnalysisObserver observer;
  observer.converged = [&](model::System& system, const model::State& state, const model::Progress&,
                           const solve::IncrementRecord*) {
    momentum.push_back(momentum_of(built, system, state));
    const model::Energies& e = state.rates.energies;
    EXPECT_NEAR(e.residual, 0, 1e-12);
    EXPECT_NEAR(e.kinetic + e.strain, e.start - e.numerical, 1e-12);
    return true;
  };
  (void)model::run(built.model, {}, observer);
  ASSERT_GE(momentum.size(), 20u);
  for (const double p : momentum) EXPECT_NEAR(p, momentum.front(), 1e-12);
  // 0.2 everywhere, 1 at the left end, where nothing was added.
  EXPECT_NEAR(momentum.front(), 0.2 * (bar_mass + 1.05) + 0.8 * 0.25, 1e-9);
}

/// What is added has no weight: the body falls more slowly, by its whole mass over that with it.
TEST(MassScaling, HasNoWeight) {
  const Bar falls{
      .scheme = scaled_to("factor: 4"), .start = "{on: bar, vx: 0}", .more = ", gravity: [3, -8]"};
  const Built built = built_bar(falls);
  model::State end;
  double external = 0;
  (void)run_to_end(built, 1, [&](const model::System& system, const model::State& state) {
    end = state;
    external = 0;
    for (Index n = 0; n < 82; ++n) external += system.forces().external[2 * n + 1];
    EXPECT_NEAR(state.rates.energies.residual, 0, 1e-10);
  });
  EXPECT_NEAR(external, -8 * bar_mass, 1e-10);
  for (Index n = 0; n < 82; ++n) {
    EXPECT_NEAR(end.rates.velocity[2 * n], 3.0 / 4, 1e-10) << n;
    EXPECT_NEAR(end.rates.velocity[2 * n + 1], -8.0 / 4, 1e-10) << n;
  }
  EXPECT_NEAR(end.rates.energies.kinetic, 0.5 * 4 * bar_mass * (9 + 64) / 16, 1e-8);
}

/// A bar that hangs and has come to rest pulls with its weight; so do all sections of it.
///
/// Formula    u(L) = rho g L^2 / (2 E)
TEST(MassScaling, LeavesTheStateAtRestAsItIs) {
  const Built built = built_bar({.scheme = scaled_to("stable_step: 0.025") + ", damping: {mass: 2}",
                                 .start = "{on: bar, vx: 0}",
                                 .more = ", gravity: [3, 0], prescribe: [{on: bar.left, ux: 0}]",
                                 .duration = 60});
  double support = 0;
  const model::AnalysisResult result =
      run_to_end(built, 1, [&](const model::System& system, const model::State&) {
        support = model::reactions(system)[0] + model::reactions(system)[2 * 41];
      });
  EXPECT_NEAR(support, -3 * bar_mass, 1e-8);
  EXPECT_NEAR(result.state.u[2 * 40], 3 * 10.0 * 10 / (2 * 100), 1e-4);
}

TEST(MassScaling, DampingByMassIsARateOfAllOfIt) {
  const double h = 0.01, alpha = 0.4, share = (1 - 0.5 * alpha * h) / (1 + 0.5 * alpha * h);
  const Flown flown =
      fly(Bar{.scheme = scaled_to("stable_step: 0.025", ", step: 0.01") + ", damping: {mass: 0.4}",
              .start = "{on: bar, vx: 0.2}"});
  EXPECT_EQ(flown.steps, 100);
  for (Index n = 0; n < 82; ++n)
    EXPECT_NEAR(flown.result.state.rates.velocity[2 * n], 0.2 * std::pow(share, 100), 1e-12) << n;
}

/// The next step has masses of its own: the energy that goes with the added ones is told of.
TEST(MassScaling, EndsWithItsStep) {
  Built built = built_bar({.scheme = scaled_to("factor: 4"), .start = "{on: bar, vx: 0.2}"});
  built.model.steps.push_back(built.model.steps.front());
  built.model.steps.back().name = "on";
  built.model.steps.back().dynamics->mass_scaling = {};
  const Flown flown = fly(built);
  const double kinetic = 0.5 * bar_mass * 0.04;
  EXPECT_NEAR(flown.energies().kinetic, kinetic, 1e-12);
  EXPECT_NEAR(flown.energies().numerical, 3 * kinetic, 1e-12);
  EXPECT_NEAR(flown.energies().residual, 0, 1e-12);
  EXPECT_NEAR(flown.stable, thin_step, 1e-13);
}

/// A block that falls on a floor whose springs are so stiff that they alone govern.
std::string falling(const std::string& scheme) {
  return fmt::format(R"(osculate: 1
mesh: {{generate: {{b: {{box: {{x: [0, 1], y: [0.02, 1.02], elements: [6, 6]}}}}}}}}
materials: {{m: {{linear_elastic: {{E: 1000, nu: 0.3, density: 1}}}}}}
sections: [{{on: b, material: m, element: plane_strain, formulation: full}}]
rigid: {{floor: {{line: {{point: [0, 0], normal: [0, 1]}}}}}}
contact: [{{name: c, master: floor, slave: b.bottom, normal: {{penalty: 1e8}}}}]
initial_velocity: [{{on: b, vy: -2}}]
steps: [{{name: fall, increments: 20, duration: 0.3, dynamics: {{scheme: {}}}}}]
)",
                     scheme);
}

TEST(MassScaling, IsSeenByTheSpringsOfContacts) {
  const Flown plain = fly(build_text(falling("central_differences"))),
              heavy = fly(build_text(falling(scaled_to("factor: 4"))));
  EXPECT_THAT(plain.governed, HasSubstr("springs"));
  EXPECT_NEAR(heavy.stable / plain.stable, 2, 1e-9);
  EXPECT_NEAR(1.0 * plain.steps / heavy.steps, 2, 0.02);
  const model::Energies& e = heavy.energies();
  EXPECT_NEAR(e.start, 4 * 2, 1e-9);
  EXPECT_NEAR(e.kinetic + e.strain + e.contact, e.start, 0.015 * e.start);
}

/// Nodes in contact get what their springs need for time steps of safety * stable_step.
///
/// Formula    m = S / w , S the penalty times the length that a node bears, w = (0.75 / h)^2
TEST(MassScaling, OfNodesInContactIsWhatTheirSpringsNeed) {
  const double step = 4e-4, h = 0.9 * step, penalty = 1e6;
  const auto with = [&](const std::string& scheme) {
    return build_text(edited(falling(scheme), "1e8", fmt::format("{}", penalty)));
  };
  const Flown plain = fly(with("central_differences"));
  const std::string wanted = scaled_to(fmt::format("stable_step: {}", step));
  const Flown scaled = fly(with(wanted));
  EXPECT_THAT(plain.governed, HasSubstr("springs"));
  EXPECT_LT(0.015 / plain.steps * 20, 0.8 * h);
  EXPECT_EQ(scaled.steps, 20 * static_cast<int>(std::ceil(0.015 / h)));
  const model::ScaledMasses masses = masses_of(with(wanted));
  ASSERT_EQ(masses.at_nodes.size(), 49u + 3);  // and the frame of the floor
  const double cell = 1.0 / 6, allowed = 0.75 * 0.75 / (h * h);
  double sum = 0;
  for (std::size_t n = 0; n < 7; ++n) {
    const double bears = n % 6 == 0 ? 0.5 : 1;  // cells
    const double needed = bears * (penalty * cell / allowed - 0.5 * cell * cell);
    EXPECT_NEAR(masses.at_nodes[n], needed, 1e-9) << n;
    sum += needed;
  }
  EXPECT_GT(sum, 0.01);
  for (std::size_t n = 7; n < masses.at_nodes.size(); ++n) EXPECT_EQ(masses.at_nodes[n], 0) << n;
  EXPECT_EQ(masses.sections[0].nodes, 7u);
  EXPECT_NEAR(masses.sections[0].added, sum, 1e-9);
  const model::Energies& e = scaled.energies();
  EXPECT_NEAR(e.start, 2 * (1 + sum), 1e-9);
  EXPECT_NEAR(e.kinetic + e.strain + e.contact, e.start, 0.015 * e.start);
}

/// What rigid bodies swing with is not made slower by mass at nodes.
TEST(MassScaling, LeavesTheMassOfRigidBodies) {
  const std::string light =
      edited(edited(falling(scaled_to("stable_step: 1e-3")), "normal: [0, 1]}}",
                    "normal: [0, 1]}, mass: 1e-6, inertia: 1}"),
             "initial_velocity:", "initial_velocity:");
  const Flown flown = fly(build_text(edited(light, "1e8", "1e4")));
  EXPECT_THAT(flown.governed, HasSubstr("springs"));
  EXPECT_TRUE(masses_of(build_text(edited(light, "1e8", "1e4"))).at_nodes.empty());
  EXPECT_LT(flown.stable, 1e-4);
}

/// Cells that flatten in space: the stiffness of tet4 and hex8, finite strains.
TEST(MassScaling, ReachesTheStepInSpace) {
  for (const char* const kinematics : {"small", "finite"})
    for (const char* const type : {"hex8", "tet4"}) {
      Built3 built = built_from(
          fmt::format(R"(osculate: 1
mesh: {{generate: {{b: {{box: {{x: [0, 4], y: [0, 2], z: [0, 2], elements: [4, 2, 2], type: {}}}}}}}}}
materials: {{m: {{{}: {{E: 100, nu: 0.3, density: 1}}}}}}
sections: [{{on: b, material: m, element: solid, kinematics: {}}}]
initial_velocity: [{{on: b, vx: 0.01}}, {{on: b.left, vx: 0.02}}]
steps: [{{name: fly, increments: 1, duration: 1, dynamics: {{scheme: {}}}}}]
)",
                      type, kinematics == std::string("small") ? "linear_elastic" : "neo_hooke",
                      kinematics, scaled_to("stable_step: 0.05")));
      for (Vec3& x : built.model.reference)
        if (x.x() == 1.0) x.x() = 0.2;
      const auto run = [&] {
        const auto result =
            model::run(built.model, model::AnalysisOptions{}, model::BasicAnalysisObserver<3>{});
        EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
        return result.steps.at(0).increments.at(0).time_steps.stable;
      };
      const double scaled = run();
      built.model.steps[0].dynamics->mass_scaling = {};
      const double plain = run();
      EXPECT_LT(plain, 0.03) << type << kinematics;
      EXPECT_NEAR(scaled, 0.05, kinematics == std::string("small") ? 1e-10 : 1e-3)
          << type << kinematics;
    }
}

TEST(MassScaling, IsRefusedWhereItMeansNothing) {
  const std::string text = test_file("explicit.yaml");
  const auto refusal = [&](const std::string& keys) {
    return any_refusal(
        edited(text, "{safety: 0.9}", fmt::format("{{safety: 0.9, mass_scaling: {{{}}}}}", keys)));
  };
  EXPECT_EQ(refusal("stable_step: 1e-3"), "");
  EXPECT_EQ(refusal("stable_step: 1e-3, factor: 2"), "");
  EXPECT_THAT(refusal(""), HasSubstr("stable_step"));
  EXPECT_THAT(refusal("stable_step: 0"), HasSubstr("stable_step"));
  EXPECT_THAT(refusal("factor: 0.5"), HasSubstr("factor"));
}

}  // namespace
}  // namespace osculate::deck
