// Loads of model files as cards of decks, which lead to the same displacements.
#include <gmock/gmock.h>

#include "inp_run_test.hpp"
#include "osculate/deck/inp_translate.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/deck/to_inp.hpp"

namespace osculate::deck {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// Two columns of two materials, held at their bottoms.
std::string loaded_columns(const std::string& steps, const std::string& more = "",
                           const std::string& law = "linear_elastic") {
  return "osculate: 1\n"
         "mesh: {generate: {\n"
         "  a: {box: {x: [0, 1], y: [0, 1], z: [0, 2], elements: [2, 2, 2]}},\n"
         "  b: {box: {x: [2, 3], y: [0, 1], z: [0, 2], elements: [2, 2, 2]}}}}\n"
         "materials: {m: {" +
         law + ": {E: 1000, nu: 0.25, density: 2}}, n: {" + law +
         ": {E: 1500, nu: 0.25, density: 3}}}\n"
         "sections: [{on: a, material: m, element: solid}, {on: b, material: n, element: solid}]\n"
         "amplitudes: {wave: [[0, 0], [0.5, 2], [1, 0.5]]}\n" +
         more + "steps:\n" + steps;
}
const std::string first_step =
    "  - {name: s1, increments: 1, prescribe: [{on: a.bottom, ux: 0, uy: 0, uz: 0}, {on: b.bottom, "
    "ux: 0, uy: 0, uz: 0}], ";
std::string step_after(int number, const std::string& loads) {
  return "  - {name: s" + std::to_string(number) + ", increments: 1, " + loads + "}\n";
}
std::string written_columns(const std::string& text) {
  const Description description = parse_model(text, "model.yaml");
  return write_deck(description, build_any(description, load_mesh(description))).text;
}
std::string refusal_of_loads(const std::string& text) {
  try {
    (void)written_columns(text);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "no error";
}

/// At the end of each step, all of which move the columns; returns the deck.
std::string expect_same_steps(const std::string& text, std::size_t steps) {
  const std::string deck = written_columns(text);
  const DeckRun ours = run_deck(text, ".yaml"), again = run_deck(deck);
  EXPECT_EQ(ours.u.size(), steps);
  EXPECT_EQ(again.u.size(), steps);
  Eigen::VectorXd before = Eigen::VectorXd::Zero(ours.u.at(0).size());
  for (std::size_t s = 0; s < std::min(ours.u.size(), again.u.size()); ++s) {
    const double size = ours.u[s].lpNorm<Eigen::Infinity>();
    EXPECT_GT((ours.u[s] - before).lpNorm<Eigen::Infinity>(), 1e-3 * size) << "step " << s + 1;
    EXPECT_LT((ours.u[s] - again.u[s]).lpNorm<Eigen::Infinity>(), 1e-10 * size) << "step " << s + 1;
    before = ours.u[s];
  }
  return deck;
}

// Faces that share an edge share no facet.
TEST(ToInpLoads, OfNeighbouringFaces) {
  const std::string deck = expect_same_steps(
      loaded_columns(first_step +
                     "traction: [{on: b.top, tz: 1}, {on: b.right, ty: 3, tx: 4}], pressure: [{on: "
                     "b.left, value: 2}]}\n" +
                     step_after(2,
                                "pressure: [{on: b.front, value: 3}], traction: [{on: b.back, tx: "
                                "-2}]") +
                     step_after(3, "pressure: [{on: b.left, value: 1}]")),
      3);
  EXPECT_THAT(deck, HasSubstr("b.top, TRVEC, 1, 0, 0, 1\n"));
  EXPECT_THAT(deck, HasSubstr("b.right, TRVEC, 5, 0.8, 0.6, 0\n"));
  const std::string both = "sets: {sides: {union: [b.left, b.front]}}\n";
  for (const auto& [key, value] : {std::pair("pressure", "value"), std::pair("traction", "tx")}) {
    const std::string text =
        loaded_columns(first_step + key + ": [{on: b.left, " + value + ": 1}]}\n" +
                           step_after(2, std::string(key) + ": [{on: sides, " + value + ": 1}]"),
                       both);
    EXPECT_THAT(refusal_of_loads(text),
                HasSubstr("'sides' shares facets with 'b.left', which a step before has loaded"));
  }
}

TEST(ToInpLoads, TractionsTurnFromStepToStep) {
  const std::string deck = expect_same_steps(
      loaded_columns(
          first_step + "traction: [{on: b.top, tx: 3, tz: 4}]}\n" +
          step_after(2, "traction: [{on: b.top, ty: 2, tz: 0}]") +
          step_after(3, "traction: [{on: b.top, tx: 1, ty: 1, tz: 1, amplitude: wave}]") +
          step_after(4, "pressure: [{on: b.left, value: 2}]") +
          step_after(5, "traction: [{on: b.top, tx: 0, ty: 0, tz: 0}]")),
      5);
  EXPECT_THAT(deck, HasSubstr("YES, AMPLITUDE=wave_1\nb.top, TRVEC, "));
  EXPECT_THAT(deck.substr(deck.find("**s5")), HasSubstr("b.top, TRVEC, 0, "));
  EXPECT_THAT(refusal_of_loads(
                  loaded_columns(first_step + "traction: [{on: b.top, tx: 3, tz: 4}]}\n" +
                                 step_after(2, "traction: [{on: b.top, tx: 1, amplitude: wave}]"))),
              HasSubstr("model.yaml:10: steps[1].traction[0]: a table of some components"));
  EXPECT_THAT(refusal_of_loads(loaded_columns(first_step + "traction: [{on: b.top, tx: 3}, {on: "
                                                           "b.top, tz: 1}]}\n")),
              HasSubstr("one traction of a set is written in a step"));
}

// There loads act at once where nothing is said.
TEST(ToInpLoads, TractionsInTime) {
  const std::string in_time = "duration: 0.5, increments: 10, dynamics: {scheme: newmark}, ";
  const auto steps = [&](const std::string& second) {
    return loaded_columns(
        "  - {name: s1, prescribe: [{on: a.bottom, ux: 0, uy: 0, uz: 0}, {on: b.bottom, ux: 0, uy: "
        "0, uz: 0}], " +
        in_time + "traction: [{on: b.top, tx: 3, tz: 4}]}\n  - {name: s2, " + in_time + second +
        "}\n  - {name: s3, " + in_time + "pressure: [{on: b.left, value: 2}]}\n");
  };
  expect_same_steps(steps("traction: [{on: b.top, tx: -6, tz: -8}]"), 3);
  EXPECT_THAT(refusal_of_loads(steps("traction: [{on: b.top, tx: 1}]")),
              HasSubstr("a traction that turns is not written in a step with inertia"));
}

// Of one density and direction by GRAV, which CalculiX knows of shells as well, else by themselves.
TEST(ToInpLoads, BodyForcesOfAnyDirection) {
  const std::string both = "sets: {whole: {union: [a, b]}}\n";
  const std::string deck = expect_same_steps(
      loaded_columns(first_step + "body_force: [{on: whole, fx: 3, fz: 4}, {on: b, fy: 1}]}\n" +
                         step_after(2, "body_force: [{on: whole, fx: -2}, {on: b, fy: 3}]") +
                         step_after(3,
                                    "body_force: [{on: whole, fx: 1, amplitude: wave}, {on: b, fy: "
                                    "2, amplitude: wave}]") +
                         step_after(4, "pressure: [{on: b.left, value: 2}]"),
                     both),
      4);
  EXPECT_THAT(deck, HasSubstr("*DLOAD\nwhole_elements, BX, 3\n*DLOAD\nwhole_elements, BZ, 4\n"));
  EXPECT_THAT(deck, HasSubstr("*DLOAD\nb, GRAV, 0.3333333333333333, 0, 0.3333333333333333, 0\n"));
  EXPECT_THAT(deck.substr(deck.find("**s4")), HasSubstr("*DLOAD\nwhole_elements, BX, 0.5\n"));
  EXPECT_THAT(refusal_of_loads(loaded_columns(first_step + "gravity: [0, 0, -9]}\n" +
                                              step_after(2, "body_force: [{on: b, fy: 1}]"))),
              HasSubstr("model.yaml:10: steps[1].body_force[0]: body forces beside `gravity`"));
}

// Each step swings by its own loads alone, whatever stands or has swung before.
TEST(ToInpLoads, WhatSwings) {
  const std::string swing = "harmonic: {from: 1, to: 2, points: 3, damping: {ratio: 0.05}}, ";
  const std::string deck = written_columns(loaded_columns(
      first_step + "forces: [{on: b.top, fz: 1}], pressure: [{on: b.left, value: 2}]}\n" +
      "  - {name: m, modes: 4}\n" + "  - {name: h1, " + swing +
      "pressure: [{on: b.right, value: 3}], traction: [{on: b.top, tx: 3, tz: 4, phase: 90}], "
      "body_force: [{on: a, fy: 2}]}\n" +
      "  - {name: h2, " + swing +
      "total_force: [{on: b.top, fy: 6}, {on: b.top_front, fx: 9}]}\n"));
  EXPECT_THAT(deck, HasSubstr("*CLOAD, OP=NEW\n*CLOAD, OP=NEW, LOAD CASE=2\n"));
  EXPECT_THAT(deck, HasSubstr("YES, LOAD CASE=2\nb.top, TRVEC, 5, 0.6, 0, 0.8\n"));
  const Description after = parse_model(translate_deck(deck, "model.inp").root, "model.inp");
  ASSERT_EQ(after.steps.size(), 4U);
  const Step &one = after.steps[2], &two = after.steps[3];
  EXPECT_TRUE(one.forces.empty());
  ASSERT_EQ(one.pressure.size(), 1U);
  EXPECT_EQ(one.pressure[0].on.value, "b.right");
  ASSERT_EQ(one.traction.size(), 2U);  // by components
  EXPECT_EQ(one.traction[0].phase->value, 90);
  EXPECT_NEAR(one.traction[0].values[0]->value, 3, 1e-14);
  ASSERT_EQ(one.body_force.size(), 1U);
  EXPECT_EQ(one.body_force[0].values[1]->value, 2);
  EXPECT_TRUE(two.pressure.empty() && two.body_force.empty());
  ASSERT_EQ(two.traction.size(), 1U);
  EXPECT_EQ(two.traction[0].values[1]->value, 6);  // on an area of 1
  ASSERT_EQ(two.forces.size(), 1U);
  EXPECT_EQ(two.forces[0].values[0]->value, 3);  // three nodes
}

TEST(ToInpLoads, MassesAreHeavy) {
  const std::string deck =
      expect_same_steps(loaded_columns(first_step + "gravity: [0, 0, -9]}\n" +
                                           step_after(2, "forces: [{on: b.top, fx: 1}]") +
                                           step_after(3, "gravity: [0, 0, -3]"),
                                       "masses: [{on: b.top_front_left, mass: 5}]\n"),
                        3);
  EXPECT_THAT(deck, HasSubstr("*DLOAD\nmass_1, GRAV, 9, 0, 0, -9\n"));
  EXPECT_THAT(
      refusal_of_loads(loaded_columns(
          first_step + "gravity: [0, 0, -9]}\n" + "  - {name: m, modes: 2}\n" +
              step_after(3, "modal: {damping: {ratio: 0.1}}, duration: 1, gravity: [0, 0, -3]"),
          "masses: [{on: b.top_front_left, mass: 5}]\n")),
      HasSubstr("model.yaml:12: steps[2].gravity: gravity of `masses` is not written in a step "
                "with `modal`"));
}

// *MPC brings NLGEOM, in CalculiX as well: small strains say that they are.
TEST(ToInpLoads, ConditionsOfNodesKeepSmallStrains) {
  const std::string load = "forces: [{on: b.top_front_left, fx: 5, fz: -9}]}\n";
  const std::string conditions =
      "coplanar: [{on: b.top}]\ncollinear: [{on: b.top_front}]\n"
      "sets: {rod: {union: [b.top_back_left, b.bottom_front_right]}}\n"
      "fixed_distance: [{on: rod}]\n";
  const std::string small = expect_same_steps(loaded_columns(first_step + load, conditions), 1);
  EXPECT_THAT(small, HasSubstr("*STEP, NLGEOM=NO, INC"));
  const std::string finite =
      expect_same_steps(loaded_columns(first_step + load, conditions, "st_venant_kirchhoff"), 1);
  EXPECT_THAT(finite, HasSubstr("*STEP, NLGEOM, INC"));
  EXPECT_THAT(expect_same_steps(loaded_columns(first_step + load), 1), Not(HasSubstr("NLGEOM")));
}

/// Also on masses. Where they act follows from NLGEOM there.
TEST(ToInpLoads, CentrifugalForces) {
  const std::string mass = "masses: [{on: b.top_front_left, mass: 5}]\n";
  const auto turning = [&](const std::string& more) {
    return loaded_columns(first_step + "centrifugal: [{on: a, speed_squared: 2, from: [1, 0, 0]" +
                              more + "}, {on: b.top_front_left, speed_squared: 3}]}\n",
                          mass);
  };
  EXPECT_THAT(expect_same_steps(turning(""), 1), HasSubstr("mass_1, CENTRIF, 3, 0, 0, 0, 0, 0, 1"));
  (void)expect_same_steps(turning(", places: undeformed"), 1);
  EXPECT_THAT(refusal_of_loads(turning(", places: deformed")),
              HasSubstr("centrifugal forces are written with `places: automatic`"));
  EXPECT_THAT(refusal_of_loads(turning(", places: undeformed") + "  - {name: m, modes: 1}\n"),
              HasSubstr("centrifugal forces are written with `places: automatic`"));
}

}  // namespace
}  // namespace osculate::deck
