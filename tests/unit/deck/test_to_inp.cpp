// size: one example goes there and back
// Model files as decks, and those as model files again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "deck_test.hpp"
#include "osculate/deck/inp_translate.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/deck/to_inp.hpp"
#include "osculate/material/catalogue.hpp"

namespace osculate::deck {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string blocks = R"(osculate: 1
mesh:
  generate:
    low: {box: {x: [0, 2], y: [0, 1], z: [0, 1], elements: [2, 1, 1]}}
    high: {box: {x: [0, 1], y: [0, 1], z: [1, 2], elements: [1, 1, 1]}}
materials:
  m: {linear_elastic: {E: 1000, nu: 0.25, density: 2}, expansion: {alpha: 1e-5, reference: 20}}
  hard: {elastoplastic: {E: 1000, nu: 0.25, hardening: [[1, 0], [2, 0.5]]}}
sections:
  - {on: low, material: m, element: solid}
  - {on: high, material: hard, element: solid, formulation: full, kinematics: small}
contact:
  - {name: c, master: low.top, slave: high.bottom, normal: {penalty: 1e4}, friction: {coulomb: {mu: 0.2, penalty: 5e3}}}
equations: [{terms: [{on: low.bottom_front_left, of: ux, factor: 1}, {on: low.top_front_left, of: ux, factor: -0.5}]}]
initial_temperature: [{on: low, value: 10}]
amplitudes: {there_and_back: [[0, 0], [0.5, 2], [1, 0.5]]}
steps:
  - name: press
    increments: 4
    duration: 2
    prescribe: [{on: low.bottom, uz: 0}, {on: high.top, uz: -0.1, amplitude: there_and_back}, {on: high.left, uy: 0}]
    pressure: [{on: low.right, value: 3}]
    temperature: [{on: low, value: 30}]
  - name: free
    increments: 1
    release: [{on: high.left, of: [uy]}]
    forces: [{on: high.right, fy: 0.5}]
)";

std::string written(const std::string& text) {
  const Description description = parse_model(text, "model.yaml");
  return write_deck(description, build_any(description, load_mesh(description))).text;
}
std::string refusal(const std::string& from, const std::string& to) {
  try {
    (void)written(edited(blocks, from, to));
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(ToInp, HasTheCardsOfAModelFile) {
  const std::string text = written(blocks);
  EXPECT_THAT(text, HasSubstr("*ELEMENT, TYPE=C3D8I, ELSET=low\n1, 1, 2, 5, 4, 7"));
  EXPECT_THAT(text, HasSubstr("*ELEMENT, TYPE=C3D8, ELSET=high\n"));
  EXPECT_THAT(text, HasSubstr("*SURFACE, NAME=high.bottom, TYPE=ELEMENT\n3, S1\n"));
  EXPECT_THAT(text, HasSubstr("*MATERIAL, NAME=m\n*ELASTIC\n1000, 0.25\n*DENSITY\n2\n"
                              "*EXPANSION, ZERO=20\n1e-05\n"));
  EXPECT_THAT(text, HasSubstr("*PLASTIC\n1, 0\n2, 0.5\n"));
  EXPECT_THAT(text, HasSubstr("*EQUATION\n2\n1, 1, 1\n"));
  EXPECT_THAT(text, HasSubstr("PRESSURE-OVERCLOSURE=LINEAR\n10000\n*FRICTION\n0.2, 5000\n"
                              "*CONTACT PAIR, INTERACTION=law_of_c, TYPE=NODE TO SURFACE\n"
                              "high.bottom, low.top\n"));
  EXPECT_THAT(text, HasSubstr("*AMPLITUDE, NAME=there_and_back_2\n0, 0\n1, 2\n2, 0.5\n"));
  EXPECT_THAT(text, HasSubstr("*STATIC, DIRECT\n0.5, 2\n"));
  EXPECT_THAT(text, HasSubstr("*BOUNDARY, AMPLITUDE=there_and_back_2\nhigh.top, 3, 3, -0.1\n"));
  EXPECT_THAT(text, HasSubstr("*DSLOAD\nlow.right, P, 3\n"));
  EXPECT_THAT(text, Not(HasSubstr("NLGEOM")));
  // what stays held is said again, at the end of its amplitude
  const std::string second = text.substr(text.find("**free"));
  EXPECT_THAT(second, AllOf(HasSubstr("*BOUNDARY, OP=NEW\nhigh.top, 3, 3, -0.05\n*BOUNDARY\n"),
                            HasSubstr("low.bottom, 3, 3, 0\n"), Not(HasSubstr("high.left"))));
}

TEST(ToInp, ReadAgainItIsTheSameModel) {
  const Description before = parse_model(blocks, "model.yaml");
  const std::string text = written(blocks);
  const Description after = parse_model(translate_deck(text, "model.inp").root, "model.inp");
  ASSERT_EQ(after.sections.size(), 2U);
  EXPECT_EQ(after.sections[1].formulation.value, Formulation::full);
  ASSERT_EQ(after.contact.size(), 1U);
  EXPECT_EQ(after.contact[0].sampling.value.rule, SamplingRule::nodes);
  ASSERT_EQ(after.steps.size(), 2U);
  EXPECT_EQ(after.steps[0].increments.value, 4);
  EXPECT_EQ(after.steps[0].duration->value, 2);
  EXPECT_EQ(after.amplitudes[0].points, before.amplitudes[0].points);
  ASSERT_EQ(after.steps[1].release.size(), 1U);
  EXPECT_EQ(after.steps[1].release[0].on.value, "high.left");
  EXPECT_EQ(after.initial_temperature[0].values[0]->value, 10);
}

/// The law of `hard` after it was written and read again.
material::Law written_law(const std::string& law) {
  const std::string text = edited(
      edited(blocks, "{elastoplastic: {E: 1000, nu: 0.25, hardening: [[1, 0], [2, 0.5]]}}", law),
      "formulation: full, kinematics: small", "formulation: full, kinematics: finite");
  const std::string finite = edited(edited(text, "m: {linear_elastic:", "m: {st_venant_kirchhoff:"),
                                    "{on: low, material: m, element: solid}",
                                    "{on: low, material: m, element: solid, kinematics: finite}");
  return parse_model(translate_deck(written(finite), "model.inp").root, "model.inp")
      .find_material("hard")
      ->law.value;
}

TEST(ToInp, ExpansionByDirections) {
  const auto of = [](const std::string& alpha) {
    return written(edited(blocks, "{alpha: 1e-5, reference: 20}", alpha));
  };
  EXPECT_THAT(of("{alpha: [1e-5, 2e-5, 3e-5]}"),
              HasSubstr("*EXPANSION, TYPE=ORTHO\n1e-05, 2e-05, 3e-05\n"));
  EXPECT_THAT(
      of("{alpha: [[0, 1, 2, 3, 4, 5, 6], [9, 2, 2, 3, 4, 5, 6]], reference: 1}"),
      HasSubstr("*EXPANSION, TYPE=ANISO, ZERO=1\n1, 2, 3, 4, 5, 6, 0\n2, 2, 3, 4, 5, 6, 9\n"));
  EXPECT_THAT(of("{alpha: [[0, 1e-5], [100, 2e-5]]}"),
              HasSubstr("*EXPANSION\n1e-05, 0\n2e-05, 100\n"));
  EXPECT_THAT(refusal("hardening: [[1, 0], [2, 0.5]]",
                      "hardening: [[1, 0, 0], [2, 0, 9]], kinematic: [[0, 0, 0], [2, 1, 0], [0, 0, "
                      "8], [2, 1, 8]]"),
              HasSubstr("over the same temperatures as the yield stress alone"));
}

TEST(ToInp, RubberAndFoamAreReadAgainAsTheyWere) {
  const auto two = std::get<material::Rubber>(
      written_law("{rubber: {c10: 0.4, c11: 0.03, d1: 0.01, d2: 0.5, density: 2}}"));
  EXPECT_EQ(two.c10, 0.4);
  EXPECT_EQ(two.c11, 0.03);
  EXPECT_EQ(two.c03, 0);
  EXPECT_EQ(two.d2, 0.5);
  EXPECT_EQ(two.density, 2);
  const auto all = std::get<material::Rubber>(written_law(
      "{rubber: {c10: 1, c01: 2, c20: 3, c11: 4, c02: 5, c30: 6, c21: 7, c12: 8, c03: 9, "
      "d1: 0.1, d2: 0.2, d3: 0.3}}"));
  EXPECT_EQ(all.c02, 5);
  EXPECT_EQ(all.c03, 9);
  EXPECT_EQ(all.d1, 0.1);
  EXPECT_EQ(all.d3, 0.3);
  EXPECT_EQ(std::get<material::Rubber>(written_law("{rubber: {c10: 1, d1: 0.1, d3: 0.3}}")).d3,
            0.3);
  const auto ogden = std::get<material::Ogden>(
      written_law("{ogden: {mu1: 0.4, alpha1: 1.3, mu2: -0.01, alpha2: -2, d1: 0.02}}"));
  EXPECT_EQ(ogden.mu2, -0.01);
  EXPECT_EQ(ogden.alpha2, -2);
  EXPECT_EQ(ogden.mu3, 0);
  EXPECT_EQ(ogden.d1, 0.02);
  const auto foam = std::get<material::Hyperfoam>(
      written_law("{hyperfoam: {mu1: 0.16, alpha1: 8, nu1: 0.1, mu2: 0.1, alpha2: -4, nu2: 0.2}}"));
  EXPECT_EQ(foam.alpha2, -4);
  EXPECT_EQ(foam.nu1, 0.1);
  EXPECT_EQ(foam.nu2, 0.2);
  const auto chains = std::get<material::ArrudaBoyce>(
      written_law("{arruda_boyce: {mu: 0.3, lambda_m: 3, d: 0.01}}"));
  EXPECT_EQ(chains.mu, 0.3);
  EXPECT_EQ(chains.lambda_m, 3);
  EXPECT_EQ(chains.d, 0.01);
}

TEST(ToInp, BodiesThatChangeAreWrittenToo) {
  const std::string changing =
      edited(edited(edited(blocks,
                           "contact:\n  - {name: c, master: low.top, slave: high.bottom, normal: "
                           "{penalty: 1e4}, friction: {coulomb: {mu: 0.2, penalty: 5e3}}}\n",
                           "initial_strain: [{on: low, value: [1, 2, 3, 4, 5, 6]}]\n"),
                    "  - name: free\n",
                    "  - {name: gone, increments: 1, remove: [{on: high}], free_equations: all}\n"
                    "  - {name: back, increments: 1, add: [{on: high, with_strain: true}]}\n"
                    "  - name: free\n    materials: [{on: high, material: weak}]\n"),
             "  hard:",
             "  weak: {elastoplastic: {E: 1000, nu: 0.25, hardening: [[1, 0], [1.5, 0.5]]}}\n"
             "  hard:");
  const Description after =
      parse_model(translate_deck(written(changing), "model.inp").root, "model.inp");
  ASSERT_EQ(after.initial_strain.size(), 1U);
  EXPECT_EQ(after.initial_strain[0].value.value, (std::vector<double>{1, 2, 3, 4, 5, 6}));
  ASSERT_EQ(after.steps.size(), 4U);
  EXPECT_EQ(after.steps[1].remove.at(0).on.value, "high");
  EXPECT_TRUE(after.steps[1].frees_all_equations);
  EXPECT_TRUE(after.steps[2].add.at(0).with_strain);
  EXPECT_EQ(after.steps[3].materials.at(0).material.value, "weak");
  EXPECT_EQ(after.materials.size(), 3U);
}

TEST(ToInp, WhatHasNoCounterpartIsRefusedByItsKey) {
  EXPECT_THAT(refusal("normal: {penalty: 1e4}",
                      "two_pass: true, sampling: {gauss: 3}, normal: {penalty: 1e4}"),
              HasSubstr("model.yaml:13: contact[0].sampling.gauss: has no counterpart"));
  EXPECT_THAT(
      refusal("normal: {penalty: 1e4}", "enforcement: augmented_lagrange, normal: {penalty: 1e4}"),
      HasSubstr("contact[0].enforcement: has no counterpart"));
  EXPECT_THAT(refusal("    release: [{on: high.left,",
                      "    equations: [{terms: [{on: low.top_front_left, of: uy, factor: 1}]}]\n"
                      "    release: [{on: high.left,"),
              HasSubstr("steps[1].equations[0].terms[0].on: has no counterpart"));
  EXPECT_THAT(refusal("formulation: full, kinematics: small", "kinematics: finite"),
              HasSubstr("all sections have finite strains (NLGEOM), or none"));
  EXPECT_THAT(refusal("on: high.left, of: [uy]", "on: high.bottom_front_left, of: [uy]"),
              HasSubstr("'high.bottom_front_left' is not what was prescribed"));
  EXPECT_THAT(refusal("sections:\n",
                      "rigid: {r: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}}}\n"
                      "sections:\n"),
              HasSubstr("rigid.r.plane"));
  EXPECT_THAT(
      refusal("pressure: [{on: low.right, value: 3}]",
              "forces: [{on: high.top, fy: 1}]\n    pressure: [{on: low.right, value: 3}]"),
      HasSubstr("'high.right' shares nodes with 'high.top', which a step before has loaded"));
}

/// A cube with another material, more keys and other steps.
std::string cube(const std::string& material, const std::string& more, const std::string& steps,
                 const std::string& section = "") {
  return "osculate: 1\n"
         "mesh: {generate: {c: {box: {x: [0, 1], y: [0, 1], z: [0, 1], elements: [2, 2, 2]}}}}\n"
         "materials: {m: {" +
         material + "}}\nsections: [{on: c, material: m, element: solid, formulation: full" +
         section + "}]\n" + more + "steps:\n" + steps;
}
const std::string elastic = "linear_elastic: {E: 1000, nu: 0.25, density: 2}";
const std::string pressed =
    "  - {name: a, increments: 1, duration: 1, prescribe: [{on: c.bottom, ux: 0, uy: 0, uz: 0}]}\n";
Description again(const std::string& text) {
  return parse_model(translate_deck(written(text), "model.inp").root, "model.inp");
}
std::string refusal_of(const std::string& text) {
  try {
    (void)written(text);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "no error";
}

/// Keys and numbers of the first material, as the model file has them; what is 0 is not said.
std::vector<std::pair<std::string, double>> numbers_of_law(const Description& d) {
  std::vector<std::pair<std::string, double>> all;
  for (const SourceLeaf& leaf : d.source)
    if (leaf.path.starts_with("materials.m."))
      if (const double value = std::stod(leaf.text); value != 0) all.emplace_back(leaf.path, value);
  std::ranges::sort(all);
  return all;
}

// Read again a law is the same law with the same numbers.
TEST(ToInp, MaterialsGoThereAndBack) {
  for (
      const char* const law :
      {"linear_elastic: {E: 1000, nu: 0.25}",
       "linear_elastic: {E: [[0, 1000], [100, 800]], nu: 0.25}",
       "linear_elastic: {E: [[0, 1000], [100, 800]], nu: [[0, 0.2], [100, 0.3]]}",
       "elastoplastic: {E: 1000, nu: 0.25, yield: 3, kinematic: 20}",
       "elastoplastic: {E: [[0, 1000], [100, 800]], nu: 0.25, hardening: [[3, 0, 0], [4, 0.1, 0], "
       "[2, 0, 100]], kinematic: 20}",
       "elastoplastic: {E: 1000, nu: 0.25, yield: 3, kinematic: [[0, 0], [1, 0.125]]}",
       "elastoplastic: {E: 1000, nu: 0.25, yield: 3, kinematic: [[0, 0], [1, 0.125], [1.5, 0.25]]}",
       "elastoplastic: {E: 1000, nu: 0.25, hardening: [[3, 0, 0], [2, 0, 100]], kinematic: [[0, 0, "
       "0], [1, 0.5, 0], [0, 0, 100], [2, 0.5, 100]]}",
       "norton: {E: 1000, nu: 0.25, A: 1.0e-4, n: 3}",
       "norton: {E: 1000, nu: 0.25, A: [[0, 1.0e-4], [100, 2.0e-4]], n: 3}",
       "viscoelastic: {E: 1000, nu: 0.25, shear: [[0.25, 1], [0.5, 2]], bulk: [[0.125, 3]]}",
       "orthotropic: {E1: [[0, 100], [100, 90]], E2: 200, E3: 300, nu12: 0.1, nu13: 0.2, nu23: "
       "0.3, G12: 40, G13: 50, G23: [[0, 60], [100, 50]]}",
       "anisotropic: {D1111: 10, D1122: [[0, 2], [100, 3]], D2222: 11, D1133: 3, D2233: 4, D3333: "
       "12, D1212: 5, D1313: 6, D2323: 7, D1112: 0.5}",
       "deformation_plasticity: {E: 1000, nu: 0.25, yield: 3, n: 5, alpha: 0.3}",
       "orthotropic: {E1: 100, E2: 200, E3: 300, nu12: 0.1, nu13: 0.2, nu23: 0.3, G12: 40, G13: "
       "50, G23: 60}",
       "anisotropic: {D1111: 10, D1122: 2, D2222: 11, D1133: 3, D2233: 4, D3333: 12, D1212: 5, "
       "D1313: 6, D2323: 7, D1112: 0.5}",
       "rubber: {c10: 1, d1: 0.01}",
       "rubber: {c10: 1, c01: 0.5, d1: 0.01}",
       "rubber: {c10: 1, c20: -0.1, c30: 0.01, d1: 0.01, d2: 0.02}",
       "ogden: {mu1: 1, alpha1: 2, mu2: -0.5, alpha2: -3, d1: 0.01}",
       "hyperfoam: {mu1: 1, alpha1: 2, nu1: 0.2}",
       "rubber: {c10: 1, d1: 0.01}, relaxation: {shear: [[0.25, 1], [0.5, 2]], bulk: [[0.125, 3]]}",
       "ogden: {mu1: 1, alpha1: 2, d1: 0.01}, relaxation: {bulk: [[0.125, 3]]}",
       "arruda_boyce: {mu: 1, lambda_m: 3, d: 0.01}, relaxation: {shear: [[0.5, 3]]}",
       "hyperfoam: {mu1: 1, alpha1: 2, nu1: 0.2}, relaxation: {shear: [[0.5, 3]], bulk: [[0.5, "
       "3]]}"}) {
    const bool warm = std::string(law).find("[[") < std::string::npos;
    const std::string text =
        cube(law, warm ? "initial_temperature: [{on: c, value: 20}]\n" : "",
             warm ? edited(pressed, "}]}", "}], temperature: [{on: c, value: 50}]}") : pressed,
             std::string(law).starts_with("deformation") ? ", kinematics: finite" : "");
    const Description before = parse_model(text, "model.yaml"), after = again(text);
    const auto& found = after.materials.at(0).law.value;
    const material::Law& expected = before.materials.at(0).law.value;
    const bool finite = after.sections.at(0).kinematics.value == Kinematics::finite;
    EXPECT_EQ(finite, before.sections.at(0).kinematics.value == Kinematics::finite) << law;
    EXPECT_EQ(material::key_of(found), material::key_of(expected)) << law;
    EXPECT_EQ(numbers_of_law(after), numbers_of_law(before)) << law;
  }
}

TEST(ToInp, WhatHoldsAndPullsNodes) {
  const std::string more =
      "axes: [{on: c.right, rectangular: {x: [1, 1, 0], xy: [0, 1, 0]}}]\n"
      "equal: [{on: c.top_left, of: uz}]\n"
      "coplanar: [{on: c.top}]\n"
      "springs:\n"
      "  - {between: [c.bottom_front_left, c.top_back_right], stiffness: 5, kinematics: small}\n"
      "  - {terms: [{on: c.top_front_left, of: ux, factor: 1}], table: [[-1, -2], [0, 0], [1, "
      "3]]}\n"
      "  - {terms: [{on: c.top_front_left, of: uy, factor: 1}, {on: c.bottom_front_left, of: uy, "
      "factor: -1}], damping: 4}\n"
      "masses: [{on: c.top_front_left, mass: 7}]\n";
  const std::string text = cube(elastic, more, pressed,
                                ", orientation: {cylindrical: {from: [0, 0, "
                                "0], to: [0, 0, 1]}, turn: {about: 1, angle: 30}}");
  const std::string deck = written(text);
  EXPECT_THAT(deck, HasSubstr("*TRANSFORM, NSET=c.right, TYPE=R\n1, 1, 0, 0, 1, 0\n"));
  EXPECT_THAT(deck, HasSubstr("*ELEMENT, TYPE=SPRINGA, ELSET=spring_1\n9, 1, 27\n"
                              "*SPRING, ELSET=spring_1\n\n5.\n"));
  EXPECT_THAT(deck, HasSubstr("*SPRING, ELSET=spring_2, NONLINEAR\n1\n-2., -1.\n0., 0.\n3., 1.\n"));
  EXPECT_THAT(deck, HasSubstr("*DASHPOT, ELSET=damper_3\n2, 2\n4.\n"));
  EXPECT_THAT(deck, HasSubstr("*MASS, ELSET=mass_1\n7\n"));
  EXPECT_THAT(deck, HasSubstr("*MPC\nPLANE, c.top\n"));
  EXPECT_THAT(deck,
              HasSubstr("*ORIENTATION, NAME=axes_1, SYSTEM=CYLINDRICAL\n0, 0, 0, 0, 0, 1\n1, "));
  EXPECT_THAT(deck, HasSubstr("*SOLID SECTION, ELSET=c, MATERIAL=m, ORIENTATION=axes_1\n"));
  const Description after = again(text);
  EXPECT_EQ(after.springs.size(), 3U);
  EXPECT_EQ(after.masses.at(0).mass.value, 7);
  EXPECT_EQ(after.coplanar.size(), 1U);
  EXPECT_EQ(after.equations.size(), 2U);  // two of the three nodes follow the first
  EXPECT_EQ(after.axes.size(), 1U);
}

// A body of a model file is held where nothing is said, one of a deck is free.
TEST(ToInp, RigidBodiesAndTheirMotions) {
  const std::string text =
      cube(elastic, "rigid: {head: {set: c.top, reference: [0.5, 0.5, 2], kinematics: small}}\n",
           "  - {name: a, increments: 1, prescribe: [{on: c.bottom, ux: 0, uy: 0, uz: 0}, {on: "
           "head, uz: -0.1}], release: [{on: head, of: [rx]}], forces: [{on: head, mx: 3}]}\n");
  const std::string deck = written(text);
  EXPECT_THAT(deck, HasSubstr("*RIGID BODY, NSET=head_nodes, REF NODE=28, ROT NODE=29\n"));
  EXPECT_THAT(deck, HasSubstr("*NODE\n28, 0.5, 0.5, 2\n*NODE\n29, 0.5, 0.5, 2\n"));
  EXPECT_THAT(deck, HasSubstr("28, 3, 3, -0.1\n"));
  EXPECT_THAT(deck, HasSubstr("29, 2, 2, 0\n"));
  EXPECT_THAT(deck, Not(HasSubstr("29, 1, 1,")));
  EXPECT_THAT(deck, HasSubstr("*CLOAD\n29, 1, 3\n"));
  const Description after = again(text);
  ASSERT_EQ(after.rigid.size(), 1U);
  EXPECT_EQ(after.rigid[0].kinematics->value, Kinematics::small);
  ASSERT_EQ(after.steps.at(0).release.size(), 1U);
  EXPECT_TRUE(after.steps[0].release[0].of[3]);
  try {
    (void)written(edited(text, ", kinematics: small", ""));
    ADD_FAILURE() << "of any rotation";
  } catch (const core::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("a rigid body in a deck turns as the strain of its cells "
                                        "is: `kinematics: small`"));
  }
}

TEST(ToInp, StepsOfAllKinds) {
  const std::string steps =
      "  - {name: a, increments: 1, prescribe: [{on: c.bottom, ux: 0, uy: 0, uz: 0}], gravity: [0, "
      "0, -9]}\n"
      "  - {name: b, modes: 4}\n"
      "  - {name: c, modes: {count: 4, about: start}}\n"
      "  - {name: d, modal: {damping: {ratio: 0.02}}, increments: 10, duration: 5, forces: [{on: "
      "c.top, fx: 1}]}\n";
  const std::string deck = written(cube(elastic, "", steps));
  EXPECT_THAT(deck, HasSubstr("*DLOAD\nc, GRAV, 9, 0, 0, -9\n"));
  EXPECT_THAT(deck, HasSubstr("**b\n*STEP, PERTURBATION\n*FREQUENCY\n4\n"));
  EXPECT_THAT(deck, HasSubstr("**c\n*STEP\n*FREQUENCY\n4\n"));
  EXPECT_THAT(deck, HasSubstr("**d\n*STEP\n*MODAL DYNAMIC\n0.5, 5\n*MODAL DAMPING\n1, 4, 0.02\n"));
  EXPECT_THAT(deck, HasSubstr("*AMPLITUDE, NAME=ramp_1\n0, 0\n5, 1\n"));
  const Description after = again(cube(elastic, "", steps));
  EXPECT_EQ(after.steps.at(1).about, ModesAbout::last);
  EXPECT_EQ(after.steps.at(2).about, ModesAbout::start);
  EXPECT_EQ(after.steps.at(3).modal->ratios.at(0).ratio, 0.02);
  const std::string swing =
      written(cube(elastic, "",
                   pressed + "  - {name: b, modes: {count: 3, about: start}}\n"
                             "  - {name: h, harmonic: {from: 1, to: 3, points: 5}, forces: [{on: "
                             "c.top, fx: 2, phase: 90}]}\n"));
  EXPECT_THAT(swing, HasSubstr("*STEADY STATE DYNAMICS\n1, 3, 5, 3\n"));
  EXPECT_THAT(swing, HasSubstr("*CLOAD, LOAD CASE=2\nc.top, 1, 2\n"));
  const std::string buckles = written(
      cube(elastic, "", pressed + "  - {name: b, buckling: 2, forces: [{on: c.top, fz: -1}]}\n"));
  EXPECT_THAT(buckles, HasSubstr("*STEP, PERTURBATION\n*BUCKLE\n2\n*CLOAD\nc.top, 3, -1\n"));
  const std::string moves = written(cube(
      elastic, "initial_velocity: [{on: c, vx: 3}]\n",
      "  - {name: a, dynamics: {scheme: {hht: {alpha: 0.05}}, damping: {mass: 2, stiffness: 0.1}}, "
      "increments: 4, duration: 2, prescribe: [{on: c.bottom, uz: 0}], forces: [{on: c.top, fx: "
      "1}]}\n"));
  EXPECT_THAT(moves, HasSubstr("*DYNAMIC, DIRECT, ALPHA=-0.05\n0.5, 2\n"));
  EXPECT_THAT(moves, HasSubstr("*DAMPING, ALPHA=2, BETA=0.1\n"));
  EXPECT_THAT(moves, HasSubstr("*INITIAL CONDITIONS, TYPE=VELOCITY\nc, 1, 3\n"));
}

TEST(ToInp, MassesOfExplicitSteps) {
  const auto step = [](const std::string& name, const std::string& keys) {
    return fmt::format(
        "  - {{name: {}, dynamics: {{scheme: {}}}, increments: 4, duration: 2, forces: [{{on: "
        "c.top, fx: 1}}]}}\n",
        name, keys.empty() ? "central_differences" : "{central_differences: {" + keys + "}}");
  };
  const std::string model = cube(
      elastic, "",
      step("a", "") + step("b", "mass_scaling: {stable_step: 0.25, factor: 3}") + step("c", ""));
  const std::string deck = written(model);
  EXPECT_THAT(deck, HasSubstr("*DYNAMIC, EXPLICIT, DIRECT\n0.5, 2\n*FIXED MASS SCALING, FACTOR=3, "
                              "DT=0.25\n"));
  EXPECT_THAT(deck,
              HasSubstr("*DYNAMIC, EXPLICIT, DIRECT\n0.5, 2\n*FIXED MASS SCALING, FACTOR=1\n"));
  const Description after = again(model);
  const auto scaling = [&](std::size_t s) { return after.steps.at(s).dynamics->mass_scaling; };
  for (const std::size_t s : {std::size_t{0}, std::size_t{2}}) {
    EXPECT_FALSE(scaling(s).stable_step.has_value()) << s;
    EXPECT_EQ(scaling(s).factor, 1) << s;
  }
  EXPECT_EQ(scaling(1).stable_step, 0.25);
  EXPECT_EQ(scaling(1).factor, 3);
}

TEST(ToInp, WhatADeckCannotSayOfTheNewKeys) {
  EXPECT_THAT(refusal_of(cube("deformation_plasticity: {E: 1000, nu: 0.25, yield: 3, n: 5, alpha: "
                              "0.3}",
                              "", pressed)),
              HasSubstr("makes all strains of an input file finite"));
  EXPECT_THAT(refusal_of(cube("neo_hooke: {E: 1000, nu: 0.25}", "", pressed)),
              HasSubstr("neo_hooke is not written"));
  EXPECT_THAT(refusal_of(cube(elastic,
                              "springs: [{between: [c.bottom_front_left, c.top_back_right], "
                              "stiffness: 5, kinematics: finite}]\n",
                              pressed)),
              HasSubstr("where the steps have NLGEOM"));
  EXPECT_THAT(refusal_of(cube(elastic,
                              "springs: [{between: [c.bottom_front_left, c.top_back_right], gap: "
                              "{stiffness: 5, tension: 1}, kinematics: small}]\n",
                              pressed)),
              HasSubstr("gaps of two nodes along a unit vector"));
  EXPECT_THAT(
      refusal_of(cube(elastic, "", edited(pressed, "}]}", "}], total_force: [{on: c, fz: 1}]}"))),
      HasSubstr("written of facets and of nodes, not of bodies"));
  EXPECT_THAT(refusal_of(cube(elastic, "",
                              edited(pressed, "increments: 1",
                                     "dynamics: {scheme: {generalized_alpha: {radius: 0.8}}}, "
                                     "increments: 1"))),
              HasSubstr("schemes other than newmark, hht and central differences"));
  EXPECT_THAT(refusal("normal: {penalty: 1e4}", "weight: {area: 0.3}, normal: {penalty: 1e4}"),
              HasSubstr("contact[0].weight.area: has no counterpart"));
}

/// The pair of `blocks` with other keys, after it was written and read again.
Contact pair_again(const std::string& keys, std::string& text) {
  text = written(edited(blocks,
                        "normal: {penalty: 1e4}, friction: {coulomb: {mu: 0.2, penalty: "
                        "5e3}}",
                        keys));
  return parse_model(translate_deck(text, "model.inp").root, "model.inp").contact.at(0);
}

// What CalculiX passes over is said.
TEST(ToInp, AClearanceOfNodesIsLostInCalculix) {
  const auto lost = [](const std::string& sampling) {
    const std::string text =
        edited(blocks, "normal: {penalty: 1e4}, friction: {coulomb: {mu: 0.2, penalty: 5e3}}",
               "normal: {penalty: 1e4}, initial: {clearance: -0.01}, sampling: " + sampling);
    const Description d = parse_model(text, "model.yaml");
    const WrittenDeck deck = write_deck(d, build_any(d, load_mesh(d)));
    std::size_t found = 0;
    for (const std::string& note : deck.notes)
      found += note.find("*CLEARANCE") != std::string::npos;
    return found;
  };
  EXPECT_EQ(lost("nodes"), 1U);
  EXPECT_EQ(lost("{gauss: 3, segments: true}"), 0U);
}

TEST(ToInp, LawsOfContactGoThereAndBack) {
  std::string text;
  Contact pair = pair_again(
      "normal: {penalty: 1e4}, initial: {clearance: -0.01}, "
      "friction: {coulomb: {mu: 0.2, penalty: 5e3}}",
      text);
  EXPECT_THAT(text, HasSubstr("*CLEARANCE, SLAVE=high.bottom, MASTER=low.top, VALUE=-0.01\n"));
  EXPECT_EQ(pair.initial.value, InitialWord::clearance);
  EXPECT_EQ(pair.initial_clearance, -0.01);
  pair = pair_again(
      "normal: {decaying: {pressure: 5, clearance: 0.01}}, friction: {rough: {}}, "
      "initial: {adjust: 0.2}",
      text);
  EXPECT_THAT(text, HasSubstr("PRESSURE-OVERCLOSURE=EXPONENTIAL\n0.01, 5\n*FRICTION, ROUGH\n"));
  EXPECT_EQ(pair.initial.value, InitialWord::adjust);
  EXPECT_EQ(pair.initial_tolerance, 0.2);
  pair = pair_again(
      "normal: {tensile: {stiffness: 1e4, tension: 2, clearance: 0.01}}, "
      "weight: {area: around}",
      text);
  EXPECT_THAT(text, HasSubstr("LINEAR\n10000, 2, 0.01\n"));
  EXPECT_THAT(text, HasSubstr("*SURFACE, NAME=high.bottom_nodes, TYPE=NODE\nhigh.bottom,\n"));
  EXPECT_EQ(pair.area_by, AreaWord::around);
  pair = pair_again("sampling: {gauss: 3, segments: true}, normal: {}", text);
  EXPECT_THAT(text, HasSubstr("*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD\n"));
  EXPECT_TRUE(pair.normal.law.automatic);
  for (const std::string law : {"penalty: 1e4, ", ""}) {
    pair = pair_again(
        "sampling: {gauss: 3, segments: true}, normal: {" + law + "separation: no_separation}",
        text);
    EXPECT_THAT(text, HasSubstr("*SURFACE BEHAVIOR, NO SEPARATION, PRESSURE-OVERCLOSURE="));
    EXPECT_EQ(pair.normal.separation.value, SeparationWord::no_separation);
    EXPECT_EQ(pair.normal.law.automatic, law.empty());
  }
  pair = pair_again("sampling: mortar, enforcement: lagrange_multiplier", text);
  EXPECT_EQ(pair.enforcement.value.kind, EnforcementWord::lagrange_multiplier);
  pair = pair_again("sampling: mortar, normal: {penalty: 1e4}", text);
  EXPECT_EQ(pair.sampling.value.rule, SamplingRule::mortar);
  EXPECT_EQ(pair.enforcement.value.kind, EnforcementWord::penalty);
}

TEST(ToInp, StepsInTimeGoThereAndBack) {
  const auto steps = [&](const std::string& scheme) {
    const std::string text = R"(osculate: 1
mesh: {generate: {a: {box: {x: [0, 1], y: [0, 1], z: [0, 1], elements: [1, 1, 1]}}, b: {box: {x: [0, 1], y: [0, 1], z: [1, 2], elements: [1, 1, 1]}}}}
materials: {m: {linear_elastic: {E: 1000, nu: 0.25, density: 2}}}
sections: [{on: a, material: m, element: solid}, {on: b, material: m, element: solid}]
contact: [{name: c, master: a.top, slave: b.bottom, normal: {penalty: 1e4, damping: {viscous: 4}}, friction: {coulomb: {mu: 0.2, penalty: 5e3, viscous: 3}}}]
steps: [{name: s, increments: 4, duration: 2, dynamics: {damping: {mass: 0.3}, )" +
                             scheme + R"(}, prescribe: [{on: a.bottom, uz: 0}]}]
)";
    const std::string deck = written(text);
    EXPECT_THAT(deck, HasSubstr("*CONTACT DAMPING, TANGENT FRACTION=0.75\n4\n"));
    const Description d = parse_model(translate_deck(deck, "model.inp").root, "model.inp");
    EXPECT_EQ(contact::text(d.contact.at(0).friction->law),
              "Coulomb 0.2 and viscous 3 (penalty 5000)");
    EXPECT_EQ(d.steps.at(0).increments.value, 4);
    EXPECT_EQ(d.steps.at(0).dynamics->damping_mass, 0.3);
    return *d.steps.at(0).dynamics;
  };
  EXPECT_EQ(steps("scheme: central_differences").scheme, SchemeWord::central_differences);
  EXPECT_TRUE(steps("scheme: newmark, time_steps: {}").time_steps.has_value());
  EXPECT_FALSE(steps("scheme: {hht: {alpha: 0.1}}").time_steps.has_value());
  EXPECT_THAT(refusal("normal: {penalty: 1e4}",
                      "sampling: mortar, enforcement: augmented_lagrange, normal: {penalty: 1e4}"),
              HasSubstr("an input file has nodes of first-order facets"));
}

TEST(ToInp, PairsBesideContactOfAllGoThereAndBack) {
  const std::string text = R"(osculate: 1
mesh: {generate: {a: {box: {x: [0, 1], y: [0, 1], z: [0, 1], elements: [1, 1, 1]}}, b: {box: {x: [0, 1], y: [0, 1], z: [1, 2], elements: [1, 1, 1]}}, c: {box: {x: [0, 1], y: [0, 1], z: [2, 3], elements: [1, 1, 1]}}}}
materials: {m: {linear_elastic: {E: 1000, nu: 0.25}}}
sections: [{on: a, material: m, element: solid}, {on: b, material: m, element: solid}, {on: c, material: m, element: solid}]
contact:
  all: {normal: {penalty: 1e4}, exclude_surfaces: [[a.left, b.right]]}
  pairs: [{name: p, master: a.top, slave: b.bottom, normal: {penalty: 2e4}}]
steps: [{name: s, increments: 1, prescribe: [{on: a.bottom, uz: 0}]}]
)";
  const std::string deck = written(text);
  EXPECT_THAT(deck, HasSubstr("*CONTACT EXCLUSIONS\n"));
  const Description d = parse_model(translate_deck(deck, "model.inp").root, "model.inp");
  ASSERT_EQ(d.contact.size(), 2U);
  EXPECT_TRUE(d.contact[1].all);
  EXPECT_EQ(contact::penalty_of(d.contact[0].normal.law.law), 2e4);
  EXPECT_EQ(contact::penalty_of(d.contact[1].normal.law.law), 1e4);
  EXPECT_EQ(d.contact[1].exclude_surfaces.size(), 1U);
}

TEST(ToInp, DampingThatComesAndGoesGoesThereAndBack) {
  const auto with = [](const std::string& first, const std::string& second) {
    return R"(osculate: 1
mesh: {generate: {a: {box: {x: [0, 1], y: [0, 1], z: [0, 1], elements: [1, 1, 1]}}, b: {box: {x: [0, 1], y: [0, 1], z: [1, 2], elements: [1, 1, 1]}}}}
materials: {m: {linear_elastic: {E: 1000, nu: 0.25, density: 2}}}
sections: [{on: a, material: m, element: solid}, {on: b, material: m, element: solid}]
contact: [{name: c, master: a.top, slave: b.bottom, normal: {penalty: 1e4}}]
steps:
  - {name: s, increments: 1, duration: 1, prescribe: [{on: a.bottom, uz: 0}]}
  - {name: t, increments: 4, duration: 2, dynamics: {}, contact: [{pair: c, damping: )" +
           first + R"(}]}
  - {name: u, increments: 1, duration: 1, contact: [{pair: c, damping: )" +
           second + "}]}\n";
  };
  const std::string deck = written(with("{viscous: 4}", "none"));
  EXPECT_THAT(deck, HasSubstr("*CONTACT DAMPING\n4\n"));
  const Description d = parse_model(translate_deck(deck, "model.inp").root, "model.inp");
  EXPECT_FALSE(d.contact.at(0).normal.damping);
  EXPECT_EQ(contact::damper((*d.steps.at(1).contact.at(0).damping)->law), 4);
  EXPECT_FALSE(d.steps.at(2).contact.at(0).damping->has_value());
  for (const auto& [first, second] :
       {std::pair{"{viscous: 4}", "{viscous: 4}"}, {"{viscous: 4}", "{viscous: 5}"}})
    EXPECT_THAT(refusal_of(with(first, second)), HasSubstr("in all of them alike"));
}

/// `blocks` with durations in all steps, and another edit.
std::string timed_refusal(const std::string& from, const std::string& to) {
  return refusal_of(edited(edited(blocks, from, to), "  - name: free\n    increments: 1",
                           "  - name: free\n    duration: 1\n    increments: 1"));
}

TEST(ToInp, WhatIsDampedInStepsWithoutInertiaIsRefused) {
  EXPECT_THAT(
      timed_refusal("normal: {penalty: 1e4}", "normal: {penalty: 1e4, damping: {viscous: 4}}"),
      HasSubstr("acts in steps with `dynamics`, in all of them alike"));
  EXPECT_THAT(timed_refusal("friction: {coulomb: {mu: 0.2, penalty: 5e3}}",
                            "friction: {viscous: {coefficient: 2, penalty: 5e3}}"),
              HasSubstr("acts in steps with `dynamics` alone"));
  EXPECT_THAT(timed_refusal("    release: [{on: high.left, of: [uy]}]",
                            "    contact: [{pair: c, friction: {coulomb: {mu: 0.2, penalty: 5e3, "
                            "viscous: 3}}}]\n    release: [{on: high.left, of: [uy]}]"),
              HasSubstr("changes of friction beside a film are not written"));
}

TEST(ToInp, ContactThatChangesGoesThereAndBack) {
  const std::string text = written(
      edited(blocks, "    release: [{on: high.left, of: [uy]}]",
             "    contact: [{pair: c, active: false, normal: {penalty: 2e4}, friction: none}]\n"
             "    release: [{on: high.left, of: [uy]}]"));
  EXPECT_THAT(text, HasSubstr("*MODEL CHANGE, TYPE=CONTACT PAIR, REMOVE\nhigh.bottom, low.top\n"));
  const Description after = parse_model(translate_deck(text, "model.inp").root, "model.inp");
  ASSERT_EQ(after.steps[1].contact.size(), 1U);
  const ContactChange& change = after.steps[1].contact[0];
  EXPECT_EQ(change.active, false);
  EXPECT_EQ(contact::text(change.normal->law.law), "penalty 20000");
  ASSERT_TRUE(change.friction.has_value());
  EXPECT_FALSE(change.friction->has_value());
}

TEST(ToInp, PartsOfSectionsAndGaps) {
  const std::string whole =
      edited(edited(blocks, "  - {on: low, material: m, element: solid}\n", ""),
             "  - {on: high, material: hard, element: solid, formulation: full, kinematics: small}",
             "  - {on: both, material: m, element: solid}\nsets: {both: {union: [low, high]}}");
  const std::string gap =
      "springs: [{terms: [{on: low.bottom_front_left, of: uz, factor: -1}, {on: "
      "low.bottom_back_right, of: uz, factor: 1}], gap: {clearance: 0.1, stiffness: 1e4, "
      "tension: 1e-3}}]\n";
  const std::string text = written(edited(whole, "amplitudes:", gap + "amplitudes:") +
                                   "output: {dat: [{on: high, of: [S]}]}\n");
  EXPECT_THAT(text, HasSubstr("*GAP, ELSET=gap_1\n0.1, 0, 0, 1, , 10000, 0.001\n"));
  EXPECT_THAT(text, HasSubstr("*ELSET, ELSET=high_elements\n3\n"));
  EXPECT_THAT(text, HasSubstr("*EL PRINT, ELSET=high_elements\nS\n"));
  const Description after = parse_model(translate_deck(text, "model.inp").root, "model.inp");
  ASSERT_EQ(after.springs.size(), 1U);
  EXPECT_EQ(after.springs[0].gap->clearance, 0.1);
}

TEST(ToInp, SidesThatAreSlavesInTurnAndDecayingFriction) {
  const std::string text = written(edited(
      edited(blocks, "normal: {penalty: 1e4}, friction: {coulomb: {mu: 0.2, penalty: 5e3}}",
             "two_pass: true, normal: {penalty: 1e4}, friction: {coulomb: {mu: 0.3, "
             "kinetic: 0.1, decay: {speed: 4}}}"),
      "  - name: free\n    increments: 1", "  - name: free\n    duration: 1\n    increments: 1"));
  const Contact again =
      parse_model(translate_deck(text, "model.inp").root, "model.inp").contact.at(0);
  EXPECT_THAT(text, HasSubstr("*FRICTION, EXPONENTIAL DECAY\n0.3, 0.1, 0.25\n"));
  EXPECT_THAT(text, HasSubstr("*CONTACT\n*CONTACT INCLUSIONS\nhigh.bottom, low.top\n"
                              "*CONTACT PROPERTY ASSIGNMENT\nhigh.bottom, low.top, law_of_c\n"));
  EXPECT_TRUE(again.two_pass.has_value());
  EXPECT_EQ(again.slave.value, "high.bottom");
  EXPECT_THAT(text, Not(HasSubstr("*CONTACT PAIR")));
}

TEST(ToInp, TractionsGoThereAndBack) {
  const std::string text = written(edited(
      blocks, "pressure: [{on: low.right, value: 3}]",
      "pressure: [{on: low.right, value: 3}]\n    traction: [{on: high.right, ty: 3, tz: 4}]"));
  EXPECT_THAT(text, HasSubstr("*DSLOAD, FOLLOWER=NO, CONSTANT RESULTANT=YES\nhigh.right, TRVEC, 5, "
                              "0, 0.6, 0.8\n"));
  const Description after = parse_model(translate_deck(text, "model.inp").root, "model.inp");
  EXPECT_NEAR(after.steps[0].traction.at(0).values[1]->value, 3, 1e-15);
}

TEST(ToInp, ForcesInTotalAreSharedOut) {
  const std::string text = written(edited(
      blocks, "pressure: [{on: low.right, value: 3}]",
      "pressure: [{on: low.right, value: 3}]\n    total_force: [{on: low.front, fy: 3}, {on: "
      "high.bottom_front, fx: 6}]"));
  const Description after = parse_model(translate_deck(text, "model.inp").root, "model.inp");
  EXPECT_EQ(after.steps[0].traction.at(0).on.value, "low.front");
  EXPECT_NEAR(after.steps[0].traction[0].values[1]->value, 1.5, 1e-14);  // over an area of 2
  EXPECT_THAT(text, HasSubstr("*CLOAD\nhigh.bottom_front, 1, 3\n"));     // two nodes
}

}  // namespace
}  // namespace osculate::deck
