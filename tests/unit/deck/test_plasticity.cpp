// Plastic materials: keys, the memory of a system, energies in time.
#include <gmock/gmock.h>

#include "osculate/model/material_memory.hpp"
#include "system_test.hpp"

namespace osculate::deck {
namespace {

using ::testing::HasSubstr;

constexpr const char* strip = R"(osculate: 1
mesh: {generate: {b: {box: {x: [0, 2], y: [0, 1], elements: [4, 2]}}}}
materials: {m: {elastoplastic: {E: 200, nu: 0.3, yield: 1, isotropic: 5, kinematic: 10}}}
sections: [{on: b, material: m, element: plane_strain}]
steps:
  - {name: pull, increments: 4, prescribe: [{on: b.left, ux: 0, uy: 0}, {on: b.right, ux: 0.04, uy: 0.03}]}
)";
std::string with(const std::string& from, const std::string& to) { return edited(strip, from, to); }

TEST(Plasticity, LawIsInTheStrainsOfItsSection) {
  const model::Model small = build_text(strip).model;
  EXPECT_FALSE(material::finite_strain(small.sections[0].section.law));
  EXPECT_EQ(small.sections[0].section.formulation, solid::Formulation::bbar);
  const model::Model finite =
      build_text(with("plane_strain}", "plane_strain, kinematics: finite}")).model;
  EXPECT_TRUE(material::finite_strain(finite.sections[0].section.law));
  EXPECT_EQ(finite.sections[0].section.formulation, solid::Formulation::bbar);
  EXPECT_EQ(material::key_of(finite.sections[0].section.law), "elastoplastic");
}

TEST(Plasticity, KeysThatDoNotGoTogetherAreRefused) {
  const auto refused = [](const std::string& to) { return refusal(with("yield: 1", to)); };
  EXPECT_EQ(refused("hardening: [[1, 0], [2, 0.1]]"), "");
  EXPECT_THAT(refused("yield: 1, hardening: [[1, 0], [2, 0.1]]"),
              HasSubstr("materials.m.elastoplastic: give `yield` or `hardening`, one of both"));
  EXPECT_THAT(refused("density: 1"), HasSubstr("one of both"));
  EXPECT_THAT(refused("hardening: [[1, 0.1], [2, 0.2]]"),
              HasSubstr("hardening[0]: the first plastic strain is 0"));
  EXPECT_THAT(refused("hardening: [[1, 0], [2, 0]]"),
              HasSubstr("hardening[1]: plastic strains rise from point to point"));
  EXPECT_THAT(refused("yield: 0"), HasSubstr("> 0"));
  EXPECT_THAT(refused("hardening: [[1, 0, 20], [2, 0.1]]"),
              HasSubstr("hardening[1]: either all points have a temperature or none"));
  EXPECT_THAT(refused("hardening: [[1, 0, 20], [2, 0, 10]]"),
              HasSubstr("hardening[1]: temperatures must increase from curve to curve"));
  EXPECT_THAT(refused("hardening: [[1, 0, 20], [2, 0.1, 20], [3, 0, 30], [4, 0, 30]]"),
              HasSubstr("hardening[3]: plastic strains rise from point to point"));
  EXPECT_THAT(build_refusal(with("yield: 1", "hardening: [[1, 0, 20], [2, 0, 30]]")),
              HasSubstr("material 'm' depends on the temperature, which is given nowhere"));
  const auto moved = [](const std::string& to) { return refusal(with("kinematic: 10", to)); };
  EXPECT_EQ(moved("kinematic: [[0, 0], [2, 0.1], [3, 0.3]]"), "");
  EXPECT_THAT(moved("kinematic: [[1, 0], [2, 0.1]]"),
              HasSubstr("kinematic[0]: a curve of kinematic hardening begins with [0, 0]"));
  EXPECT_THAT(moved("kinematic: [[0, 0], [2, 0.1, 5]]"), HasSubstr("either all points"));
  EXPECT_THAT(refused("yeld: 1"), HasSubstr("did you mean 'yield'"));
}

TEST(Plasticity, OnlyCellsOfSuchMaterialsHaveMemory) {
  const model::Model m = build_text(R"(osculate: 1
mesh: {generate: {a: {box: {x: [0, 1], y: [0, 1], elements: [2, 1], type: quad8}}, b: {box: {x: [2, 3], y: [0, 1], elements: [1, 3]}}, c: {box: {x: [4, 5], y: [0, 1], elements: [1, 1], type: tri3}}}}
materials: {e: {linear_elastic: {E: 1, nu: 0.3}}, p: {elastoplastic: {E: 1, nu: 0.3, yield: 1}}}
sections: [{on: a, material: p, element: plane_stress}, {on: b, material: e, element: plane_strain}, {on: c, material: p, element: plane_strain}]
steps: [{name: s, increments: 1, prescribe: [{on: [a, b, c], ux: 0, uy: 0}]}]
)")
                             .model;
  std::vector<std::array<std::size_t, 3>> found;
  model::for_each_cell(m, [&](const auto&, const auto&, const model::CellMemory& at) {
    found.push_back({at.first, at.size, at.count});
  });
  const std::size_t last = 2 * 9 * 7;  // behind the points of two quad8
  const std::vector<std::array<std::size_t, 3>> expected{
      {0, 7, 63},   {63, 7, 63},  {last, 0, 0},    {last, 0, 0},
      {last, 0, 0}, {last, 7, 7}, {last + 7, 7, 7}};
  EXPECT_EQ(found, expected);
  EXPECT_EQ(model::memory_size(m), last + 14);
}

TEST(Plasticity, TrialsLeaveWhatIsCommittedAndACommitTakesTheLastOne) {
  for (const char* const kinematics : {"small", "finite"}) {
    Probe probe(
        with("plane_strain}", std::string("plane_strain, kinematics: ") + kinematics + "}"));
    const std::vector<double> untouched(probe.start.memory.size(), 0.0);
    ASSERT_EQ(untouched.size(), 8u * 4 * 7);
    solve::Evaluation out;
    const model::Trial near = probe.base, far = probe.system.apply(near, probe.random(0.1), 0.5, 1);
    probe.system.evaluate(probe.start, near, 0.5, true, out);
    const Eigen::VectorXd first = out.residual;
    probe.system.evaluate(probe.start, far, 0.5, false, out);
    EXPECT_EQ(probe.start.memory, untouched);
    probe.system.evaluate(probe.start, near, 0.5, false, out);  // as if nothing had been
    EXPECT_EQ(out.residual, first);
    const model::State next = probe.system.commit(near, 0.5);
    EXPECT_GT(*std::ranges::max_element(next.memory), 0);
    EXPECT_EQ(near.state.memory, untouched);
    // Evaluated again, the committed state flows no further: not a bit changes.
    probe.system.evaluate(next, 0.5, false, out);
    EXPECT_LT((out.residual - first).norm(), 1e-11 * first.norm());
    EXPECT_EQ(probe.system.commit({next}, 0.5).memory, next.memory);
  }
}

// A committed state is looked at again (reports, causes of failure): no time passes, it stays as it
// is.
TEST(Creep, OfACommittedStateGoesNoFurther) {
  Probe probe(R"(osculate: 1
mesh: {generate: {a: {box: {x: [0, 1], y: [0, 1], elements: [2, 2]}}}}
materials: {m: {norton: {E: 200, nu: 0.3, A: 0.01, n: 3}}}
sections: [{on: a, material: m, element: plane_strain}]
steps: [{name: s, increments: 1, duration: 2, prescribe: [{on: a.bottom, ux: 0, uy: 0}]}]
)");
  solve::Evaluation out;
  probe.system.evaluate(probe.start, probe.base, 0.5, false, out);
  const Eigen::VectorXd first = out.residual;
  const model::State next = probe.system.commit(probe.base, 0.5);
  EXPECT_GT(*std::ranges::max_element(next.memory), 1e-3);
  probe.system.evaluate(next, 0.5, false, out);
  EXPECT_LT((out.residual - first).norm(), 1e-11 * first.norm());
  EXPECT_EQ(probe.system.material_memory(), next.memory);
}

TEST(Plasticity, AssembledTangentIsConsistent) {
  for (const char* const kinematics : {"small", "finite"}) {
    Probe probe(with("plane_strain}", std::string("plane_strain, kinematics: ") + kinematics + "}"),
                0.05);
    const testing::DerivativeReport r = check_tangent_of(probe);
    EXPECT_NEAR(r.order, 2, 0.1) << r.error;
  }
}

/// What a run has at its end.
model::Energies energies_of(const std::string& text) {
  model::Energies energies;
  const model::AnalysisResult result = run_to_end(
      build_text(text), 1,
      [&](model::System&, const model::State& state) { energies = state.rates.energies; });
  EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
  return energies;
}

// A block thrown against a wall stays shorter: most of its energy is dissipated.
std::string thrown(const std::string& scheme, int increments, const std::string& kinematics) {
  return R"(osculate: 1
mesh: {generate: {b: {box: {x: [0, 4], y: [0, 1], elements: [16, 4]}}}}
materials: {m: {elastoplastic: {E: 200, nu: 0.3, density: 1, yield: 1, isotropic: 4}}}
sections: [{on: b, material: m, element: plane_strain, kinematics: )" +
         kinematics + R"(}]
initial_velocity: [{on: b, vx: -0.5}, {on: b.left, vx: 0}]
steps:
  - {name: hit, increments: )" +
         std::to_string(increments) + R"(, duration: 1, dynamics: {)" + scheme +
         R"(}, prescribe: [{on: b.left, ux: 0}, {on: b.bottom, uy: 0}]}
)";
}

// The books balance but for what the mean of the forces at both ends of a step misses: a quarter of
// it is left with half the step, a sixteenth with a quarter.
TEST(Plasticity, DissipatesTheEnergyOfAnImpactInBothSchemes) {
  const auto with_safety = [](const char* safety) {
    return std::string("scheme: {central_differences: {safety: ") + safety + "}}";
  };
  for (const char* const kinematics : {"small", "finite"}) {
    const model::Energies coarse = energies_of(thrown("", 100, kinematics));
    const model::Energies im = energies_of(thrown("", 200, kinematics));
    EXPECT_LT(std::abs(im.residual), std::abs(coarse.residual) / 3.5);
    const model::Energies fast = energies_of(thrown(with_safety("0.8"), 20, kinematics));
    const model::Energies ex = energies_of(thrown(with_safety("0.2"), 20, kinematics));
    EXPECT_LT(std::abs(ex.residual), std::abs(fast.residual) / 8);
    for (const model::Energies& e : {im, ex}) {
      EXPECT_GT(e.plastic, 0.5 * e.start);
      EXPECT_LT(e.plastic, e.start);
      EXPECT_LT(std::abs(e.residual), 2e-3 * e.start) << e.residual;
    }
    EXPECT_NEAR(im.plastic, ex.plastic, 0.03 * ex.plastic);
  }
}

TEST(Plasticity, HasAColumnOfItsDissipation) {
  const Built built = build_text(thrown("", 10, "small"));
  EXPECT_TRUE(std::ranges::any_of(
      built.history, [](const auto& request) { return request.name == "energy.plastic"; }));
}

// ---- history of what is remembered --------------------------------------------------------------

constexpr const char* requests = R"(
output: {history: [{on: b, of: peeq}, {on: b, of: pe11, name: along}, {on: b.left, of: pe22}]}
)";

TEST(Plasticity, HistoryHasWhatIsRememberedOfLargestSize) {
  // A bar in plane stress: flow along it, half as much across.
  const std::string bar = edited(with("plane_strain", "plane_stress"),
                                 "ux: 0, uy: 0}, {on: b.right, ux: 0.04, uy: 0.03}",
                                 "ux: 0}, {on: b.bottom, uy: 0}, {on: b.right, ux: -0.04}") +
                          requests;
  Built built = build_text(bar);
  ASSERT_EQ(built.history.size(), 3u);
  EXPECT_EQ(built.history[0].name, "b.peeq");
  EXPECT_EQ(built.history[1].name, "along");
  const auto row = [&](const model::System& system, const model::State& state) {
    std::vector<double> values;
    for (const model::HistoryRequest& request : built.history)
      values.push_back(model::history_value(system, built.model, state, request));
    return values;
  };
  model::System system(built.model, 1);
  model::State state = system.initial_state();
  EXPECT_EQ(row(system, state), (std::vector<double>{0, 0, 0}));
  // every point the same, but for one number of the last one
  for (std::size_t i = 0; i < state.memory.size(); ++i)
    state.memory[i] = std::array{0.2, -0.2, 0.1, 0.1, 0.0, 0.0, 0.0}[i % 7];
  const std::vector<double> values = row(system, state);
  EXPECT_NEAR(values[0], 0.2, 1e-14);
  EXPECT_NEAR(values[1], -0.2, 1e-14);
  EXPECT_NEAR(values[2], 0.1, 1e-14);
  for (std::size_t i = 1; i < state.memory.size() / 2; i += 7) state.memory[i] = 0.15;
  EXPECT_NEAR(row(system, state)[1], -0.2, 1e-14);
}

TEST(Plasticity, HistoryOfWhatNobodyRemembersIsRefused) {
  const auto refused = [](const std::string& model, const std::string& request) {
    return refusal(model + "output: {history: [" + request + "]}\n");
  };
  EXPECT_EQ(refused(strip, "{on: b, of: peeq}"), "");
  EXPECT_THAT(refused(strip, "{on: b, of: ceeq}"),
              HasSubstr("history[0].of: 'ceeq' is remembered by materials of the kind norton, and "
                        "the model has none"));
  EXPECT_THAT(refused(strip, "{on: b, of: peq}"), HasSubstr("did you mean 'peeq'"));
  const std::string rolled =
      with("steps:", "rigid: {roll: {circle: {center: [0, 3], radius: 1}}}\nsteps:");
  EXPECT_THAT(refused(rolled, "{on: roll, of: peeq}"),
              HasSubstr("'peeq' belongs to sets, and 'roll' is a rigid body"));
  const std::string pair = edited(
      rolled,
      "steps:", "contact: [{name: c, master: roll, slave: b.top, normal: {penalty: 1}}]\nsteps:");
  EXPECT_THAT(refused(pair, "{on: c, of: peeq}"),
              HasSubstr("'peeq' belongs to sets, and 'c' is a contact pair"));
}

}  // namespace
}  // namespace osculate::deck
