// Bodies and equations that change from step to step, stresses at first: what is understood, what
// is refused, what is left of the system. That forces and ways are right is
// verification/body_changes.
#include <algorithm>

#include "osculate/model/body_changes.hpp"
#include "osculate/model/material_memory.hpp"
#include "osculate/model/small_strain.hpp"
#include "osculate/solid/element.hpp"
#include "system_test.hpp"

namespace osculate::deck {
namespace {

const std::string& bars() {
  static const std::string text = test_file("bodies_change.yaml");
  return text;
}

model::Model in_step(const Built& b, std::size_t step) {
  model::Model now = b.model;
  model::change_bodies(b.model, step, now);
  return now;
}

TEST(BodyChanges, StayFromStepToStep) {
  const Built b = build_text(bars());
  ASSERT_EQ(b.model.body_changes.size(), 4U);
  EXPECT_FALSE(model::bodies_change(b.model, 0));
  EXPECT_TRUE(model::bodies_change(b.model, 1));
  const model::Model one = in_step(b, 1), again = in_step(b, 2), apart = in_step(b, 3);
  EXPECT_FALSE(model::is_removed(one.sections[0], 0));
  EXPECT_TRUE(model::is_removed(one.sections[1], 1));
  EXPECT_FALSE(model::is_removed(again.sections[1], 1));
  EXPECT_EQ(one.sections[0].material, "stiff");
  EXPECT_EQ(apart.sections[0].material, "soft");
  EXPECT_EQ(material::unloaded(apart.sections[0].section.law).young, 50);
  EXPECT_EQ(one.equations.size(), 2U);
  EXPECT_EQ(again.equations.size(), 2U);
  EXPECT_EQ(apart.equations.size(), 1U);
  const model::Model joined = in_step(b, 4);
  ASSERT_EQ(joined.equations.size(), 2U);
  EXPECT_EQ(joined.equations[1].value, 0.5);
  // new cells have no strain of their own, and those that stay keep theirs
  EXPECT_FALSE(b.model.sections[1].initial[0].empty());
  EXPECT_TRUE(again.sections[1].initial[0].empty());
  EXPECT_FALSE(again.sections[0].initial[0].empty());
}

TEST(BodyChanges, TakeTheirLoadsWithThem) {
  const Built b = build_text(bars());
  const auto sum = [&](std::size_t step) {
    double all = 0;
    for (const model::DeadLoad& load : b.model.steps[step].dead)
      for (const auto& [dof, value] : load.unit) all += value * load.ramp.value(1);
    return all;
  };
  EXPECT_NEAR(sum(0), 9, 1e-12);
  EXPECT_NEAR(sum(1), 6, 1e-12);
  EXPECT_NEAR(sum(2), 9, 1e-12);
  const auto facets = [&](std::size_t step) {
    std::size_t count = 0;
    for (const model::PressureLoad& load : b.model.steps[step].pressure)
      count += load.facets.size();
    return count;
  };
  EXPECT_EQ(facets(0), 2U);
  EXPECT_EQ(facets(1), 0U);
  EXPECT_EQ(facets(2), 2U);
  EXPECT_EQ(std::count(b.warnings.begin(), b.warnings.end(),
                       "step 'one' takes all cells from 6 nodes: they stay where they are, or move "
                       "as they are told, and forces on them have no effect"),
            1);
}

TEST(BodyChanges, LeaveNoUnknownsWithoutCells) {
  const Built b = build_text(bars());
  const model::Model one = in_step(b, 1);
  const model::DofSpace before = model::dof_space(b.model), now = model::dof_space(one);
  const auto all = static_cast<Index>(b.model.reference.size());
  EXPECT_EQ(before.unknowns(), 2 * all - 2);
  // of the six nodes of b only the displacement that an equation gives is left, and is none itself
  EXPECT_EQ(now.unknowns(), 2 * (all - 6) - 1);
}

TEST(BodyChanges, NewCellsAreFreeOfStrainWhereTheyAre) {
  const Built b = build_text(bars());
  const model::Model now = in_step(b, 2);
  model::System system(now, 1);
  model::State state = system.initial_state();
  for (Eigen::Index i = 0; i < state.u.size(); ++i) state.u[i] = 0.01 * static_cast<double>(i % 7);
  std::fill(state.memory.begin(), state.memory.end(), 0.5);
  state = model::begin_bodies(b.model, 2, state);
  std::size_t cells = 0;
  model::for_each_cell(
      now, [&](const auto& section, const mesh::CellRef& ref, const model::CellMemory& m) {
        if (section.name != "b") return;
        ++cells;
        model::BulkBlock block;
        model::evaluate_cell(now, section, ref, state.u, m.of(state.memory), false, block);
        EXPECT_EQ(block.result.force.cwiseAbs().maxCoeff(), 0.0);
      });
  EXPECT_EQ(cells, 2U);
  // nor are they far from where small strains hold
  std::vector<model::SmallStrain> found;
  model::measure_small_strain(now, state, found);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[1].section, "b");
  EXPECT_EQ(found[1].strain, 0.0);
  EXPECT_GT(found[0].strain, 0.01);
  // what the system keeps of it is what was committed
  system.begin_step(now.steps[2], state);
  solve::Evaluation out;
  system.evaluate(state, 0.0, false, out);
  EXPECT_EQ(system.material_memory(), state.memory);
}

/// Cells that are taken away in motion leave with what energy they have, and the balance is even.
TEST(BodyChanges, TakeTheirEnergyWithThem) {
  const Built b = build_text(
      "osculate: 1\nmesh: {generate: {a: {box: {x: [0, 1], y: [0, 1], elements: [2, 1]}}, "
      "b: {box: {x: [0, 1], y: [2, 3], elements: [2, 1]}}}}\n"
      "materials: {m: {elastoplastic: {E: 100, nu: 0, yield: 0.2, isotropic: 10, density: 1}}}\n"
      "sections: [{on: a, material: m, element: plane_strain}, {on: b, material: m, element: "
      "plane_strain}]\nsteps:\n"
      "  - {name: pull, increments: 20, duration: 0.2, dynamics: {scheme: newmark}, prescribe: "
      "[{on: "
      "a.left, ux: 0, uy: 0}, {on: b.left, ux: 0, uy: 0}], total_force: [{on: a.right, fx: 1}, "
      "{on: b.right, fx: 1}]}\n"
      "  - {name: one, increments: 5, duration: 0.05, dynamics: {scheme: newmark}, remove: [{on: "
      "b}]}\n");
  std::vector<model::Energies> at;
  model::AnalysisObserver observer;
  observer.converged = [&](model::System&, const model::State& state, const model::Progress&,
                           const solve::IncrementRecord* record) {
    if (record) at.push_back(state.rates.energies);
    return true;
  };
  ASSERT_EQ(model::run(b.model, b.options, observer).outcome, solve::Outcome::converged);
  const model::Energies &before = at[at.size() - 6], &after = at[at.size() - 5];
  EXPECT_GT(before.plastic, 1e-4);
  EXPECT_LT(after.strain + after.kinetic, 0.6 * (before.strain + before.kinetic));
  EXPECT_GE(after.plastic, before.plastic);
  EXPECT_NEAR(after.residual, before.residual, 1e-3 * before.strain);
}

/// Two bars of stiffness 100 and 50 side by side, one of them pulled by 6.
std::string two_bars(const std::string& steps) {
  return "osculate: 1\nmesh: {generate: {a: {box: {x: [0, 1], y: [0, 1], elements: [2, 1]}}, "
         "b: {box: {x: [0, 1], y: [2, 3], elements: [2, 1]}}}}\n"
         "materials: {stiff: {linear_elastic: {E: 100, nu: 0}}, soft: {linear_elastic: {E: 50, nu: "
         "0}}}\nsections: [{on: a, material: stiff, element: plane_strain}, {on: b, material: "
         "soft, "
         "element: plane_strain}]\nsteps:\n"
         "  - {name: pull, increments: 2, prescribe: [{on: a.left, ux: 0}, {on: b.left, ux: 0}, "
         "{on: a, uy: 0}, {on: b, uy: 0}], total_force: [{on: a.right, fx: 6}]}\n" +
         steps;
}

/// Displacements of the ends of both bars at the end of each increment.
std::vector<Vec2> ends_of_bars(const std::string& text) {
  const Built b = build_text(text);
  std::vector<Vec2> ends;
  model::AnalysisObserver observer;
  observer.converged = [&](model::System&, const model::State& state, const model::Progress&,
                           const solve::IncrementRecord* record) {
    const auto end = [&](const char* set) {
      return state.u[2 * b.model.mesh.find_set(set)->nodes.at(0)];
    };
    if (record) ends.emplace_back(end("a.bottom_right"), end("b.top_right"));
    return true;
  };
  EXPECT_EQ(model::run(b.model, b.options, observer).outcome, solve::Outcome::converged);
  return ends;
}

constexpr const char* joined_ends =
    "equations: [{terms: [{on: b.right, of: ux, factor: 1}, {on: a.right, of: ux, factor: -1}], "
    "for_each_node: true";

/// Equations that begin hold of the displacements in all, from their first increment on.
TEST(BodyChanges, EquationsBeginWithAStep) {
  const std::vector<Vec2> ends = ends_of_bars(
      two_bars(std::string("  - {name: join, increments: 2, ") + joined_ends +
               ", value: 0.03}]}\n  - {name: part, increments: 1, free_equations: all}\n"));
  ASSERT_EQ(ends.size(), 5U);
  EXPECT_NEAR((ends[0] - Vec2(0.03, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((ends[1] - Vec2(0.06, 0)).norm(), 0, 1e-12);
  for (const int i : {2, 3})  // 100 u_a + 50 u_b = 6 , u_b = u_a + 0.03
    EXPECT_NEAR((ends[i] - Vec2(0.03, 0.06)).norm(), 0, 1e-12) << i;
  EXPECT_NEAR((ends[4] - Vec2(0.06, 0)).norm(), 0, 1e-12);
}

/// What a step frees and brings itself: first the old ones end.
TEST(BodyChanges, EquationsTakeThePlaceOfOthers) {
  const std::vector<Vec2> ends =
      ends_of_bars(two_bars(std::string("  - {name: join, increments: 1, ") + joined_ends +
                            "}]}\n  - {name: anew, increments: 1, free_equations: all, " +
                            joined_ends + ", value: 0.03}]}\n"));
  ASSERT_EQ(ends.size(), 4U);
  EXPECT_NEAR((ends[2] - Vec2(0.04, 0.04)).norm(), 0, 1e-12);
  EXPECT_NEAR((ends[3] - Vec2(0.03, 0.06)).norm(), 0, 1e-12);
}

TEST(BodyChanges, EquationsThatBeginAreRefusedWithTheReason) {
  const auto refused = [](const std::string& step) {
    return build_refusal(two_bars("  - {name: join, increments: 1, " + step + "}\n"));
  };
  const auto of_one = [&](const std::string& on, const std::string& term) {
    return refused("equations: [{terms: [{on: " + on + ", " + term + "}]}]");
  };
  const std::string at = "model.yaml:7: steps[1].equations[0]";
  EXPECT_EQ(of_one("b.rigt", "of: ux, factor: 1"),
            at + ".terms[0].on: unknown set 'b.rigt'; did you mean 'b.right'?");
  EXPECT_EQ(of_one("b.right", "of: ux, factor: 0"), at + ".terms[0].factor: must not be zero");
  EXPECT_EQ(of_one("b.right", "of: uz, factor: 1"),
            at + ".terms[0].on: 'uz' exists in space only, and this model is plane: no section has "
                 "the element solid or solid_shell");
  EXPECT_EQ(of_one("b.right", "of: rz, factor: 1"),
            at + ".terms[0].on: 'rz' needs a rigid body: unknown rigid body 'b.right'; there are "
                 "none");
  EXPECT_EQ(refused("equations: [{}]"), at + ": required key 'terms' is missing");
  const std::string joined = std::string(joined_ends) + "}]";
  // they come from 0.06 and 0: alike they are at the end alone
  for (const char* const last : {"0.2", "0.1"})
    EXPECT_EQ(
        refused(joined + ", prescribe: [{on: a.right, ux: 0.1}, {on: b.right, ux: " + last + "}]"),
        at + ": no displacement of it is free: steps prescribe them");
  EXPECT_EQ(build_refusal(
                edited(two_bars("  - {name: join, increments: 1, " + joined + "}\n"), "steps:\n",
                       "ties: [{slave: b.bottom, master: a.top, tolerance: 2}]\nsteps:\n")),
            "model.yaml:5: ties[0].slave: equations that begin or end (step 'join') are not "
            "supported beside ties: whose displacements they give, ties would");
  EXPECT_EQ(refused(joined + ", dynamics: {scheme: central_differences}, duration: 1"),
            at + ": bodies and equations do not change in analyses with explicit steps");
}

TEST(BodyChanges, TangentsAreDerivatives) {
  // cells with a stress of their own, of finite strain
  Probe probe(edited(edited(edited(bars(), "stiff: {linear_elastic: {E: 100, nu: 0}}",
                                   "stiff: {st_venant_kirchhoff: {E: 100, nu: 0.2}}"),
                            "soft: {linear_elastic: {E: 50, nu: 0}}",
                            "soft: {st_venant_kirchhoff: {E: 50, nu: 0.2}}"),
                     "value: [1, 0, 0, 0]", "value: [9, 4, 1, 3]"),
              0.05);
  const testing::DerivativeReport report = check_tangent_of(probe);
  EXPECT_NEAR(report.order, 2, 0.1);
}

TEST(InitialState, IsAStressOfTheUndeformedBody) {
  const Built b = build_text(bars());
  const model::State state = model::System(b.model, 1).initial_state();
  model::for_each_cell(b.model, [&](const auto& section, const mesh::CellRef& ref,
                                    const model::CellMemory& m) {
    const model::CellNodes cell = model::cell_nodes(b.model.mesh, ref);
    const material::Memory memory = m.of(state.memory);
    const auto at = model::places_of(b.model, section, cell.nodes, state.u, memory);
    const auto stress = solid::stress_at_points(model::section_on(section, cell.type), cell.type,
                                                at.reference, at.displacement, memory);
    const auto order = solid::in_order(stress);
    for (std::size_t p = 0; p < order.size(); ++p) {
      Vec<4> wanted = Vec<4>::Zero();
      if (section.name == "a") wanted[0] = 1;
      if (section.name == "b" && p == 0) wanted = {-0.5, 0, 0, -1};  // -E e, shear 2 G e
      if (section.name == "b" && p == 1) wanted[0] = -1.5;
      EXPECT_LT((stress.point[order[p]].stress - wanted).norm(), 1e-13) << section.name << p;
      EXPECT_TRUE(stress.point[order[p]].strain.isZero(0));
    }
    EXPECT_LT(stress.point[order[0]].position.x(), stress.point[order[1]].position.x());
  });
}

TEST(BodyChanges, AreRefusedWithTheReason) {
  const auto refused = [](const std::string& from, const std::string& to) {
    return build_refusal(edited(bars(), from, to));
  };
  EXPECT_EQ(refused("add: [{on: b,", "add: [{on: a,"),
            "model.yaml:14: steps[2].add[0].on: cell 1 of 'a' is there: no step has removed it");
  EXPECT_EQ(refused("materials: [{on: a, material: soft}]", "remove: [{on: b}]"),
            "model.yaml:14: steps[2].remove[0].on: cell 3 of 'b' is not there any more");
  EXPECT_EQ(refused("{on: a, material: soft}]}\n", "{on: a, material: sof}]}\n"),
            "model.yaml:14: steps[2].materials[0].material: unknown material 'sof'; did you mean "
            "'soft'?");
  EXPECT_EQ(refused("{on: b.bottom_right, of: [ux]}", "{on: b.bottom_left, of: [ux]}"),
            "model.yaml:15: steps[3].free_equations[0]: no equation gives this displacement of "
            "'b.bottom_left'");
  EXPECT_EQ(refused("value: [1, 0, 0, 0]", "value: [1, 0, 0, 0, 0, 0]"),
            "model.yaml:9: initial_stress[0].value: expected 4 components, xx, yy, zz, xy, got 6");
  EXPECT_EQ(refused("[{on: a, value: [1, 0, 0, 0]}]", "[{on: a.right, value: [1, 0, 0, 0]}]"),
            "model.yaml:9: initial_stress[0].on: set 'a.right' has no cells with a section");
  EXPECT_EQ(
      refused("stiff: {linear_elastic: {E: 100, nu: 0}}", "stiff: {neo_hooke: {E: 100, nu: 0}}"),
      "model.yaml:9: initial_stress[0].on: the section on 'a' is of neo_hooke with finite "
      "strains: initial stresses and strains are for linear_elastic, orthotropic, "
      "anisotropic and, with small strains, elastoplastic and norton");
  EXPECT_EQ(refused("soft: {linear_elastic: {E: 50, nu: 0}}",
                    "soft: {elastoplastic: {E: 50, nu: 0, yield: 1}}"),
            "model.yaml:14: steps[2].materials[0].material: material 'soft' remembers something "
            "else than that of the section on 'a': one elastic law may take the place of another, "
            "one elastoplastic of another, both with an expansion or both without");
  EXPECT_EQ(
      refused("soft: {linear_elastic: {E: 50, nu: 0}}",
              "soft: {deformation_plasticity: {E: 50, nu: 0, yield: 1, n: 5, alpha: 0.3}}")
          .substr(0, 85),
      "model.yaml:10: initial_strain[0].on: the section on 'b' is of deformation_plasticity:");
  const std::string wood = edited(
      bars(), "soft: {linear_elastic: {E: 50, nu: 0}}}",
      "soft: {linear_elastic: {E: 50, nu: 0}}, wood: {anisotropic: {D1111: 9, D1122: 0, D2222: 9, "
      "D1133: 0, D2233: 0, D3333: 9, D1212: 4, D1313: 4, D2323: 4, D1113: 1}}}");
  EXPECT_EQ(
      build_refusal(edited(wood, "{on: a, material: soft}]}\n", "{on: a, material: wood}]}\n")),
      "model.yaml:14: steps[2].materials[0].material: material 'wood' answers strains of the plane "
      "with shear across it: in the plane one of its axes is across it, and its constants have no "
      "such terms");
  const std::string other = edited(
      bars(), "soft: {linear_elastic: {E: 50, nu: 0}}}",
      "soft: {linear_elastic: {E: 50, nu: 0}}, ramberg: {deformation_plasticity: {E: 50, nu: 0, "
      "yield: 1, n: 5, alpha: 0.3}}}");
  EXPECT_EQ(
      build_refusal(edited(other, "{on: a, material: soft}]}\n", "{on: a, material: ramberg}]}\n"))
          .substr(0, 97),
      "model.yaml:14: steps[2].materials[0].material: the section on 'a' is of "
      "deformation_plasticity: i");
}

}  // namespace
}  // namespace osculate::deck
