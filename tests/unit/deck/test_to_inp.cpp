// Model files as decks, and those as model files again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "deck_test.hpp"
#include "osculate/deck/inp_translate.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/deck/to_inp.hpp"

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

TEST(ToInp, BodiesThatChangeAreWrittenToo) {
  const std::string changing =
      edited(edited(edited(blocks,
                           "contact:\n  - {name: c, master: low.top, slave: high.bottom, normal: "
                           "{penalty: 1e4}, friction: {coulomb: {mu: 0.2, penalty: 5e3}}}\n",
                           "initial_stress: [{on: low, value: [1, 2, 3, 4, 5, 6]}]\n"),
                    "  - name: free\n",
                    "  - {name: gone, increments: 1, remove: [{on: high}], free_equations: all}\n"
                    "  - {name: back, increments: 1, add: [{on: high, with_strain: true}]}\n"
                    "  - name: free\n    materials: [{on: high, material: weak}]\n"),
             "  hard:",
             "  weak: {elastoplastic: {E: 1000, nu: 0.25, hardening: [[1, 0], [1.5, 0.5]]}}\n"
             "  hard:");
  const Description after =
      parse_model(translate_deck(written(changing), "model.inp").root, "model.inp");
  ASSERT_EQ(after.initial_stress.size(), 1U);
  EXPECT_EQ(after.initial_stress[0].value.value, (std::vector<double>{1, 2, 3, 4, 5, 6}));
  ASSERT_EQ(after.steps.size(), 4U);
  EXPECT_EQ(after.steps[1].remove.at(0).on.value, "high");
  EXPECT_TRUE(after.steps[1].frees_all_equations);
  EXPECT_TRUE(after.steps[2].add.at(0).with_strain);
  EXPECT_EQ(after.steps[3].materials.at(0).material.value, "weak");
  EXPECT_EQ(after.materials.size(), 3U);
}

TEST(ToInp, WhatHasNoCounterpartIsRefusedByItsKey) {
  EXPECT_THAT(refusal("normal: {penalty: 1e4}", "two_pass: true, normal: {penalty: 1e4}"),
              HasSubstr("model.yaml:13: contact[0].two_pass: has no counterpart"));
  EXPECT_THAT(
      refusal("normal: {penalty: 1e4}", "enforcement: augmented_lagrange, normal: {penalty: 1e4}"),
      HasSubstr("contact[0].enforcement: has no counterpart"));
  EXPECT_THAT(refusal("formulation: full, kinematics: small", "kinematics: finite"),
              HasSubstr("all sections have finite strains (NLGEOM), or none"));
  EXPECT_THAT(refusal("{elastoplastic: {E: 1000, nu: 0.25, hardening: [[1, 0], [2, 0.5]]}}",
                      "{orthotropic: {E1: 1, E2: 1, E3: 1, nu12: 0, nu13: 0, nu23: 0, G12: 1, "
                      "G13: 1, G23: 1}}"),
              HasSubstr("materials.hard.orthotropic: orthotropic is not written"));
  EXPECT_THAT(refusal("on: high.left, of: [uy]", "on: high.bottom_front_left, of: [uy]"),
              HasSubstr("'high.bottom_front_left' is not what was prescribed"));
  EXPECT_THAT(refusal("sections:\n",
                      "rigid: {r: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}}}\n"
                      "sections:\n"),
              HasSubstr("rigid.r.plane"));
  EXPECT_THAT(refusal("{on: high.left, uy: 0}]", "{on: high.left, uy: 0}]\n    gravity: [0, 0, 1]"),
              HasSubstr("steps[0].gravity"));
  EXPECT_THAT(
      refusal("pressure: [{on: low.right, value: 3}]",
              "forces: [{on: high.top, fy: 1}]\n    pressure: [{on: low.right, value: 3}]"),
      HasSubstr("'high.right' shares nodes with 'high.top', which a step before has loaded"));
}

}  // namespace
}  // namespace osculate::deck
