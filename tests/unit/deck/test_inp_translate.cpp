#include <gtest/gtest.h>

#include "cube_nodes.hpp"
#include "osculate/deck/inp_translate.hpp"
#include "osculate/deck/parse.hpp"

namespace osculate::deck {
namespace {

/// Two cubes on top of each other.
const std::string blocks = R"(*HEADING
Two cubes
*NODE, NSET=NALL
)" + cube_nodes(1, {0, 0, 0}) +
                           cube_nodes(11, {0, 0, 1}) + R"(*ELEMENT, TYPE=C3D8R, ELSET=LOW
1, 1, 2, 3, 4, 5, 6, 7, 8
*ELEMENT, TYPE=C3D8R, ELSET=UP
2, 11, 12, 13, 14, 15, 16, 17, 18
*NSET, NSET=BASE
1, 2, 3, 4
*NSET, NSET=TOP
15, 16, 17, 18
*SURFACE, NAME=MASTER
LOW, S2
*SURFACE, NAME=SLAVE
UP, S1
)";
const std::string steel = R"(*MATERIAL, NAME=STEEL 1
*ELASTIC
210000., 0.3
*DENSITY
7.8E-9
*SOLID SECTION, ELSET=LOW, MATERIAL=STEEL 1
*SOLID SECTION, ELSET=UP, MATERIAL=STEEL 1
)";
const std::string pair = R"(*SURFACE INTERACTION, NAME=DRY
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR
1.E6
*FRICTION
0.2, 5.D4
*CONTACT PAIR, INTERACTION=dry, TYPE=NODE TO SURFACE
SLAVE, MASTER
)";
const std::string step = "*STEP\n*STATIC\n*DLOAD\nUP, P2, 10.\n*END STEP\n";

TranslatedDeck translated(const std::string& text) { return translate_deck(text, "cubes.inp"); }

std::string message_of(const std::string& text) {
  try {
    (void)parse_model(translated(text).root, "cubes.inp");
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(InpTranslate, ADeckIsAModelFile) {
  const TranslatedDeck deck = translated(blocks + steel + pair + R"(*EQUATION
2
16, 1, 1., 17, 1, -1.
*AMPLITUDE, NAME=UP AND DOWN
0., 0., 1., 1., 2., 0.
*BOUNDARY
BASE, 1, 3
15, 1, 2
*STEP, NLGEOM
*STATIC, DIRECT
0.25, 2.
*DLOAD, AMPLITUDE=UP AND DOWN
UP, P2, 10.
*END STEP
*STEP, NLGEOM
*STATIC
0.01, 1.
*BOUNDARY, OP=NEW
BASE, 1, 3
*CLOAD
TOP, 3, -2.
17, 3, -1.
17, 3, -1.5
*NODE FILE
U
*RESTART, WRITE
*END STEP
)");
  EXPECT_EQ(to_yaml(deck.root), R"(osculate: 1
title: Two cubes
mesh: cubes.inp
materials:
  STEEL1:
    st_venant_kirchhoff: {E: 210000, nu: 0.3, density: 7.8e-09}
sections:
  - {on: LOW, material: STEEL1, element: solid, kinematics: finite, formulation: reduced}
  - {on: UP, material: STEEL1, element: solid, kinematics: finite, formulation: reduced}
contact:
  - name: SLAVE_MASTER
    master: MASTER
    slave: SLAVE
    sampling: nodes
    normal: {penalty: 1000000}
    friction:
      coulomb: {mu: 0.2, penalty: 50000}
equations:
  - terms:
      - {on: node 16, of: ux, factor: 1}
      - {on: node 17, of: ux, factor: -1}
amplitudes:
  UPANDDOWN_1:
    - [0, 0]
    - [0.5, 1]
    - [1, 0]
steps:
  - name: step_1
    increments: 8
    duration: 2
    prescribe:
      - {on: BASE, ux: 0}
      - {on: BASE, uy: 0}
      - {on: BASE, uz: 0}
      - {on: node 15, ux: 0}
      - {on: node 15, uy: 0}
    pressure:
      - {on: P2 of UP, value: 10, amplitude: UPANDDOWN_1}
  - name: step_2
    increments: 10
    duration: 1
    prescribe:
      - {on: BASE, ux: 0}
      - {on: BASE, uy: 0}
      - {on: BASE, uz: 0}
    release:
      - on: node 15
        of: [ux]
      - on: node 15
        of: [uy]
    forces:
      - {on: TOP, fz: -2}
      - {on: node 17, fz: -2.5}
output:
  frd:
    - of: [U]
      steps: [step_2]
)");
  ASSERT_EQ(deck.notes.size(), 1U);
  EXPECT_EQ(deck.notes[0], "of 'cubes.inp' these are left out: *RESTART");
  const Description d = parse_model(deck.root, "cubes.inp");
  EXPECT_EQ(d.steps.size(), 2U);
  EXPECT_EQ(d.materials[0].law.mark.line, 32);  // of *MATERIAL
}

TEST(InpTranslate, MaterialsThatFlowAndGravity) {
  const TranslatedDeck deck = translated(blocks + R"(*MATERIAL, NAME=M
*ELASTIC
1000., 0.25
*PLASTIC
10., 0.
12., 0.1
*DENSITY
2.
*SOLID SECTION, ELSET=LOW, MATERIAL=M
*SOLID SECTION, ELSET=UP, MATERIAL=M
*STEP
*STATIC
*DLOAD
UP, GRAV, 9.81, 0., 0., -2.
*END STEP
)");
  const std::string yaml = to_yaml(deck.root);
  EXPECT_NE(yaml.find("hardening:\n        - [10, 0]\n        - [12, 0.1]"), std::string::npos)
      << yaml;
  EXPECT_NE(yaml.find("- {on: UP, fz: -19.62}"), std::string::npos) << yaml;
}

TEST(InpTranslate, WhatIsNotUnderstoodStopsWithItsLine) {
  const struct {
    const char* where;
    std::string text, message;
  } cases[]{
      {"keyword", blocks + "*BOUNDRY\n",
       "cubes.inp:32: unknown keyword 'BOUNDRY'; did you mean 'BOUNDARY'?"},
      {"eigenmodes", blocks + "*STEP\n*COMPLEX FREQUENCY\n3\n*END STEP\n",
       "cubes.inp:33: *COMPLEXFREQUENCY: is not supported: no complex vibrations"},
      {"by itself", blocks + steel + "*NO ANALYSIS\n",
       "cubes.inp:39: *NOANALYSIS: stands outside of a step"},
      {"no step", blocks + steel, "cubes.inp: the deck has no *STEP"},
      {"no end", blocks + steel + "*STEP\n*STATIC\n",
       "cubes.inp:39: *STEP: its *END STEP is missing"},
      {"no procedure", blocks + steel + "*STEP\n*END STEP\n",
       "cubes.inp:39: *STEP: the step has no procedure such as *STATIC"},
      {"set", blocks + steel + "*BOUNDARY\nBASS, 1\n" + step,
       "cubes.inp:40: unknown set of nodes 'BASS'; did you mean 'BASE'?"},
      {"node", blocks + steel + "*BOUNDARY\n99, 1\n" + step, "99"},
      {"direction", blocks + steel + "*BOUNDARY\nBASE, 11\n" + step,
       "cubes.inp:40: expected directions 1 to 6, found 11 to 11"},
      {"load", blocks + steel + "*STEP\n*STATIC\n*DLOAD\nUP, NEWTON, 1.\n*END STEP\n",
       "load 'NEWTON' is not supported: P1 to P6, EDNOR1 to EDNOR4, GRAV, CENTRIF, BX, BY or BZ"},
      {"temperature", blocks + "*MATERIAL, NAME=A\n*ELASTIC\n1., .3, 20.\n2., .3, 100.\n",
       "cubes.inp:33: *ELASTIC: depends on the temperature, which is given nowhere (*INITIAL "
       "CONDITIONS, *TEMPERATURE)"},
      {"elastic", blocks + "*MATERIAL, NAME=A\n*DENSITY\n1.\n" + step,
       "cubes.inp:32: *MATERIAL: its *ELASTIC, *HYPERELASTIC or *USER MATERIAL is missing"},
      {"outside", blocks + "*ELASTIC\n1., .3\n", "stands before the first *MATERIAL"},
      {"law",
       blocks + steel +
           "*SURFACE INTERACTION, NAME=A\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE="
           "QUADRATIC\n1., 1.\n*CONTACT PAIR, INTERACTION=A\nSLAVE, MASTER\n" +
           step,
       "PRESSURE-OVERCLOSURE=QUADRATIC is not supported"},
      {"interaction", blocks + steel + "*CONTACT PAIR, INTERACTION=A\nSLAVE, MASTER\n" + step,
       "unknown surface interaction 'A'"},
      {"surface", blocks + steel + pair + "SLAVE, MASTRE\n" + step,
       "unknown surface 'MASTRE'; did you mean 'MASTER'?"},
      {"amplitude", blocks + steel + "*STEP\n*STATIC\n*CLOAD, AMPLITUDE=A\nTOP, 3, 1.\n*END STEP\n",
       "unknown amplitude 'A'"},
      {"density",
       blocks + "*MATERIAL, NAME=A\n*ELASTIC\n1., .3\n*SOLID SECTION, ELSET=UP, MATERIAL=A\n*SOLID "
                "SECTION, ELSET=LOW, MATERIAL=A\n"
                "*STEP\n*STATIC\n*DLOAD\nUP, GRAV, 9., 0., 0., -1.\n*END STEP\n",
       "the material of 'UP' has no *DENSITY"},
      {"section",
       blocks + "*MATERIAL, NAME=A\n*ELASTIC\n1., .3\n*SOLID SECTION, ELSET=UP, MATERIAL=A\n" +
           step,
       "cubes.inp: element 1 has no *SOLID SECTION"},
      {"perturbation", blocks + steel + "*STEP, PERTURBATION\n*STATIC\n*END STEP\n",
       "PERTURBATION is not supported"},
      {"riks", blocks + steel + "*STEP\n*STATIC, RIKS\n*END STEP\n", "RIKS is not supported"},
      {"friction",
       blocks + steel +
           "*SURFACE INTERACTION, NAME=A\n*FRICTION\n.1, 1.\n.2, 2.\n*CONTACT "
           "PAIR, INTERACTION=A\nSLAVE, MASTER\n" +
           step,
       "one line with the coefficient and the stick slope is read, no second one"},
      {"terms", blocks + steel + "*EQUATION\n3\n16, 1, 1., 17, 1, -1.\n" + step,
       "1 terms are missing"},
  };
  for (const auto& one : cases) {
    const std::string message = message_of(one.text);
    EXPECT_NE(message.find(one.message), std::string::npos) << one.where << ": " << message;
  }
}

}  // namespace
}  // namespace osculate::deck
