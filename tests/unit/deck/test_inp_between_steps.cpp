// Decks: what changes of contact from step to step, other laws, steps in time, vibrations.
#include <gtest/gtest.h>

#include <algorithm>

#include "cube_nodes.hpp"
#include "osculate/deck/inp_translate.hpp"
#include "osculate/deck/parse.hpp"

namespace osculate::deck {
namespace {

/// A cube under one that is half as wide; lines 1 to 27.
const std::string cubes = R"(*NODE, NSET=NALL
)" + cube_nodes(1, {0, 0, 0}) +
                          cube_nodes(11, {0, 0, 1}, 0.5) + R"(*ELEMENT, TYPE=C3D8, ELSET=LOW
1, 1, 2, 3, 4, 5, 6, 7, 8
*ELEMENT, TYPE=C3D8, ELSET=UP
2, 11, 12, 13, 14, 15, 16, 17, 18
*NSET, NSET=FOOT
11, 12, 13, 14
*SURFACE, NAME=MASTER
LOW, S2
*SURFACE, NAME=SLAVE
UP, S1
*SURFACE, NAME=FEET, TYPE=NODE
FOOT
)";
const std::string steel = R"(*MATERIAL, NAME=STEEL
*ELASTIC
210000., 0.3
*DENSITY
7.8E-9
*DAMPING, ALPHA=3., BETA=1.E-4
*SOLID SECTION, ELSET=LOW, MATERIAL=STEEL
*SOLID SECTION, ELSET=UP, MATERIAL=STEEL
*BOUNDARY
1, 1, 3
)";
const std::string dry = R"(*SURFACE INTERACTION, NAME=DRY
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR
1.E6
*FRICTION
0.2, 5.E4
)";
const std::string pair = "*CONTACT PAIR, INTERACTION=DRY, TYPE=NODE TO SURFACE\nSLAVE, MASTER\n";
const std::string press = "*STEP\n*STATIC\n*DLOAD\nUP, P2, 10.\n*END STEP\n";

TranslatedDeck translated(const std::string& rest) {
  return translate_deck(cubes + steel + rest, "cubes.inp");
}
/// The lines of a key of the model file, and those that belong to it.
std::string part(const std::string& rest, const std::string& key) {
  const std::string text = to_yaml(translated(rest).root);
  const std::size_t begin = text.find("\n" + key + ":\n");
  if (begin == std::string::npos) return "no " + key + " in\n" + text;
  std::size_t end = begin + 1;
  do end = text.find('\n', end) + 1;
  while (end < text.size() && text[end] == ' ');
  return text.substr(begin + 1, end - begin - 1);
}
std::string message_of(const std::string& rest) {
  try {
    (void)parse_model(translated(rest).root, "cubes.inp");
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "no error";
}
void expect_in(const std::string& text, const std::string& what) {
  EXPECT_NE(text.find(what), std::string::npos) << what << "\nis not in\n" << text;
}

/// Supports between two steps are those of the second one, in a deck and after a restart.
TEST(InpBetweenSteps, SupportsBetweenThemAreOfTheNext) {
  const std::string held = "*BOUNDARY\nFOOT, 3, 3, 0.1\n", step = "*STEP\n*STATIC\n*END STEP\n";
  const auto steps_of = [](const std::string& rest) {
    return parse_model(translated(rest).root, "cubes.inp").steps;
  };
  const auto between = steps_of(press + held + step + step);
  const auto within = steps_of(press + "*STEP\n*STATIC\n" + held + "*END STEP\n" + step);
  ASSERT_EQ(between.size(), 3U);
  for (std::size_t s = 0; s < 3; ++s) {
    ASSERT_EQ(between[s].prescribe.size(), within[s].prescribe.size()) << s;
    for (std::size_t p = 0; p < within[s].prescribe.size(); ++p) {
      EXPECT_EQ(between[s].prescribe[p].on.value, within[s].prescribe[p].on.value);
      EXPECT_EQ(between[s].prescribe[p].values[2].has_value(),
                within[s].prescribe[p].values[2].has_value());
    }
  }
  EXPECT_EQ(between[1].prescribe[0].values[2]->value, 0.1);
  // with OP=NEW all others are free from then on
  const auto anew = steps_of(press + "*BOUNDARY, OP=NEW\nFOOT, 3, 3, 0.1\n" + step);
  EXPECT_EQ(anew[1].release.size(), 3U);  // the three directions of node 1
  EXPECT_EQ(anew[1].prescribe.size(), 1U);
  expect_in(message_of(press + "*EQUATION\n2\n1, 1, 1., 11, 1, -1.\n" + step),
            "*EQUATION: stands outside of a step");
}

TEST(InpBetweenSteps, LawsChangeAndPairsComeAndGo) {
  const std::string steps = part(dry + pair + press + R"(*STEP
*STATIC
*CHANGE FRICTION, INTERACTION=dry
*FRICTION
0.4, 7.E4
*CHANGE SURFACE BEHAVIOR, INTERACTION=DRY
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR
2.E6
*END STEP
*STEP
*STATIC
*MODEL CHANGE, TYPE=CONTACT PAIR, REMOVE
SLAVE, MASTER
*END STEP
*STEP
*STATIC
*MODEL CHANGE, TYPE=CONTACT PAIR, ADD
SLAVE, MASTER
*CHANGE FRICTION, INTERACTION=DRY
*FRICTION
0.
*END STEP
)",
                                 "steps");
  expect_in(steps, "coulomb: {mu: 0.4, penalty: 70000}");
  expect_in(steps, "normal: {penalty: 2000000}");
  expect_in(steps, "{pair: SLAVE_MASTER, active: false}");
  expect_in(steps, "{pair: SLAVE_MASTER, active: true, friction: none}");
}

TEST(InpBetweenSteps, WhatCannotChangeIsTold) {
  const auto step = [](const std::string& cards) {
    return dry + pair + press + "*STEP\n*STATIC\n" + cards + "*END STEP\n";
  };
  expect_in(message_of(step("*FRICTION\n0.4, 7.E4\n")), "in a step it follows *CHANGE FRICTION");
  expect_in(message_of(step("*CHANGE FRICTION, INTERACTION=WET\n*FRICTION\n0.4, 7.E4\n")),
            "surface interaction of a contact pair");
  expect_in(message_of(step("*MODEL CHANGE, TYPE=SECTION, REMOVE\nUP\n")),
            "expected TYPE=CONTACT PAIR or ELEMENT");
  expect_in(message_of(step("*MODEL CHANGE, TYPE=CONTACT PAIR\nSLAVE, MASTER\n")),
            "expected ADD or REMOVE");
  expect_in(message_of(step("*MODEL CHANGE, TYPE=CONTACT PAIR, REMOVE\nFEET, MASTER\n")),
            "there is no *CONTACT PAIR of 'FEET' and 'MASTER'");
}

/// A law without a stick slope keeps the one that the pair has.
TEST(InpBetweenSteps, FrictionThatDecaysMayComeLater) {
  const auto text = [](const std::string& law) {
    return law + pair + press +
           "*STEP\n*STATIC\n*CHANGE FRICTION, INTERACTION=DRY\n*FRICTION, EXPONENTIAL DECAY\n0.4, "
           "0.2, 3.\n*END STEP\n";
  };
  const std::string steps = part(text(dry), "steps");
  for (const char* const what : {"mu: 0.4\n", "kinetic: 0.2\n", "decay: {speed: 0.33333333"})
    expect_in(steps, what);
  EXPECT_EQ(steps.find("penalty"), std::string::npos);
  const std::string smooth =
      "*SURFACE INTERACTION, NAME=DRY\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1.E5,\n";
  expect_in(message_of(text(smooth)),
            "*FRICTION: needs a stick slope: the interaction 'DRY' has no friction at first");
}

TEST(InpBetweenSteps, TheLinearLawOfNodesPullsWhereATensionIsGiven) {
  const std::string pulling = R"(*SURFACE INTERACTION, NAME=DRY
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR
1.E5, 3.
)";
  const std::string of_nodes =
      "*CONTACT PAIR, INTERACTION=DRY, TYPE=NODE TO SURFACE\nSLAVE, MASTER\n";
  // four nodes share an area of a quarter: a thousandth of the root of a sixteenth
  expect_in(part(pulling + of_nodes + press, "contact"),
            "tensile: {stiffness: 100000, tension: 3, clearance: 0.00025}");
  const std::string of_faces =
      "*CONTACT PAIR, INTERACTION=DRY, TYPE=SURFACE TO SURFACE\nSLAVE, MASTER\n";
  expect_in(part(pulling + of_faces + press, "contact"), "normal: {penalty: 100000}");
  const std::string change =
      "*STEP\n*STATIC\n*CHANGE SURFACE BEHAVIOR, INTERACTION=DRY\n*SURFACE BEHAVIOR, "
      "PRESSURE-OVERCLOSURE=LINEAR\n2.E5, 4., 0.01\n*END STEP\n";
  expect_in(part(pulling + of_nodes + press + change, "steps"),
            "tensile: {stiffness: 200000, tension: 4, clearance: 0.01}");
}

TEST(InpBetweenSteps, LawsThatAreNoPenalty) {
  const std::string exponential = R"(*SURFACE INTERACTION, NAME=SOFT
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=EXPONENTIAL
1.E-3, 6.
)";
  const std::string soft =
      "*CONTACT PAIR, INTERACTION=SOFT, TYPE=SURFACE TO SURFACE\nSLAVE, MASTER\n";
  expect_in(part(exponential + soft + press, "contact"),
            "decaying: {pressure: 6, clearance: 0.001}");
  const std::string in_time = "*STEP\n*DYNAMIC, DIRECT\n0.1, 1.\n*END STEP\n";
  const std::string damped = "*CONTACT DAMPING, TANGENT FRACTION=0.5\n0.5\n";
  expect_in(part(dry + "*CONTACT DAMPING\n0.5\n" + pair + in_time, "contact"),
            "damping: {viscous: 0.5}");
  expect_in(part(dry + damped + pair + in_time, "contact"), "viscous: 0.25}");
  // in steps with inertia alone
  const std::string at_rest = part(dry + damped + pair + press, "contact");
  EXPECT_EQ(at_rest.find("viscous"), std::string::npos) << at_rest;
  const std::string mortar = "*CONTACT PAIR, INTERACTION=SOFT, TYPE=MORTAR\nSLAVE, MASTER\n";
  const std::string unknown = "enforcement: lagrange_multiplier";
  EXPECT_EQ(part(exponential + mortar + press, "contact").find(unknown), std::string::npos);
  expect_in(part("*SURFACE INTERACTION, NAME=SOFT\n" + mortar + press, "contact"), unknown);
  // A set of nodes is moved, a distance is one.
  const std::string adjusted =
      "*CONTACT PAIR, INTERACTION=DRY, TYPE=NODE TO SURFACE, ADJUST=FOOT\nSLAVE, MASTER\n";
  expect_in(part(dry + adjusted + press, "contact"), "initial: {nodes: FOOT}");
  EXPECT_EQ(message_of(dry + adjusted + press), "no error");
}

/// An interaction of what is tied, and its pair.
std::string tied(const std::string& friction, const std::string& options = "") {
  return "*SURFACE INTERACTION, NAME=LAW\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TIED\n5E4\n" +
         friction + "*CONTACT PAIR, INTERACTION=LAW, TYPE=SURFACE TO SURFACE" + options +
         "\nSLAVE, MASTER\n";
}

// A stick slope along the surface, gaps that close, overlaps that are let in over a static step.
TEST(InpBetweenSteps, WhatIsTied) {
  const std::string slope = "*FRICTION\n0.3, 2E3\n";
  const std::string text = part(tied(slope) + press, "contact");
  expect_in(text, "normal: {penalty: 50000, separation: tied, tolerance: any, initial_gap: close}");
  expect_in(text, "friction:\n      rough: {penalty: 2000}");
  expect_in(text, "initial: ramp");
  expect_in(text, "sampling: {gauss: 3, segments: true}");
  const auto has = [](const std::string& in, const std::string& word) {
    return in.find(word) != std::string::npos;
  };
  EXPECT_FALSE(has(part(tied(slope) + "*STEP\n*DYNAMIC, DIRECT\n0.1, 1.\n*END STEP\n", "contact"),
                   "initial: ramp"));
  const std::string given = "*CLEARANCE, SLAVE=SLAVE, MASTER=MASTER, VALUE=0.1\n";
  expect_in(part(tied(slope) + given + press, "contact"), "initial: {clearance: 0.1}");
  EXPECT_EQ(message_of(tied(slope) + given + press), "no error");
  expect_in(part(tied(slope, ", ADJUST=0.2") + press, "contact"), "initial: {adjust: 0.2}");
  // without a slope, which CalculiX refuses, as stiff along the surface as across it
  EXPECT_FALSE(has(part(tied("") + press, "contact"), "friction"));
  const std::vector<std::string> notes = translated(tied("") + press).notes;
  EXPECT_TRUE(std::ranges::any_of(
      notes, [&](const std::string& note) { return has(note, "'LAW' has no stick slope"); }));
}

TEST(InpBetweenSteps, WhatIsTiedChanges) {
  const std::string begin = tied("*FRICTION\n0.3, 2E3\n") + press + "*STEP\n*STATIC\n";
  const std::string behavior = "*CHANGE SURFACE BEHAVIOR, INTERACTION=LAW\n*SURFACE BEHAVIOR, ",
                    friction = "*CHANGE FRICTION, INTERACTION=LAW\n*FRICTION\n0.1, 7.\n",
                    end = "*END STEP\n";
  // tied no more: with the limit of its friction
  const std::string open = behavior + "PRESSURE-OVERCLOSURE=LINEAR\n1E4\n";
  expect_in(part(begin + open + end, "steps"), "coulomb: {mu: 0.3, penalty: 2000}");
  expect_in(part(begin + open + friction + end, "steps"), "coulomb: {mu: 0.1, penalty: 7}");
  EXPECT_EQ(message_of(begin + open + end), "no error");
  // another slope of what is still tied
  expect_in(part(begin + friction + end, "steps"), "rough: {penalty: 7}");
  const std::string softer = behavior + "PRESSURE-OVERCLOSURE=TIED\n1E4\n";
  expect_in(part(begin + softer + end, "steps"), "rough: {penalty: 2000}");
  EXPECT_EQ(message_of(begin + softer + end + "*STEP\n*STATIC\n" + friction + end), "no error");
}

TEST(InpBetweenSteps, LawsOfAbaqus) {
  const auto contact = [&](const std::string& law) {
    return part("*SURFACE INTERACTION, NAME=LAW\n" + law +
                    "*CONTACT PAIR, INTERACTION=LAW, TYPE=SURFACE TO SURFACE\nSLAVE, MASTER\n" +
                    press,
                "contact");
  };
  // mu = mu_k + (mu_s - mu_k) exp(-d V)
  expect_in(contact("*FRICTION, EXPONENTIAL DECAY\n0.3, 0.2, 4.\n"),
            "mu: 0.3\n        kinetic: 0.2\n        decay: {speed: 0.25}\n");
  expect_in(contact("*FRICTION, EXPONENTIAL DECAY\n0.3, 0.2, 0.\n"), "coulomb: {mu: 0.3}");
  expect_in(contact("*SURFACE BEHAVIOR, NO SEPARATION, PRESSURE-OVERCLOSURE=HARD\n"),
            "normal: {separation: no_separation, auto_factor: 10}");
  expect_in(contact("*SURFACE BEHAVIOR, NO SEPARATION, PRESSURE-OVERCLOSURE=LINEAR\n5E4\n"),
            "normal: {separation: no_separation, penalty: 50000}");
  expect_in(message_of("*SURFACE INTERACTION, NAME=LAW\n*SURFACE BEHAVIOR, NO SEPARATION, "
                       "PRESSURE-OVERCLOSURE=TIED\n5E4\n*CONTACT PAIR, INTERACTION=LAW, "
                       "TYPE=SURFACE TO SURFACE\nSLAVE, MASTER\n" +
                       press),
            "NO SEPARATION does not go with TIED");
  EXPECT_EQ(message_of(dry +
                       "*CONTACT PAIR, INTERACTION=DRY, TYPE=SURFACE TO SURFACE, NO "
                       "THICKNESS\nSLAVE, MASTER\n" +
                       press),
            "no error");
}

TEST(InpBetweenSteps, DampingComesAndGoesWithInertia) {
  const std::string in_time = "*STEP\n*DYNAMIC, DIRECT\n0.1, 1.\n*END STEP\n";
  const std::string vibrations = "*STEP\n*FREQUENCY\n2\n*END STEP\n";
  const std::string law = dry + "*CONTACT DAMPING, TANGENT FRACTION=0.5\n3\n" + pair;
  const std::string rests = law + press + vibrations + in_time + in_time + press;
  const std::string at_first = part(rests, "contact");
  EXPECT_EQ(at_first.find("damping"), std::string::npos) << at_first;
  EXPECT_EQ(at_first.find("viscous"), std::string::npos) << at_first;
  const std::string steps = part(rests, "steps");
  const auto count = [&](const std::string& what) {
    std::size_t n = 0;
    for (std::size_t at = steps.find(what); at != std::string::npos; at = steps.find(what, at + 1))
      ++n;
    return n;
  };
  EXPECT_EQ(count("contact:"), 2u) << steps;  // when the third step begins, and the last one
  expect_in(steps, "damping: {viscous: 3}");
  expect_in(steps, "{mu: 0.2, penalty: 50000, viscous: 1.5}");
  expect_in(steps, "damping: none");
  expect_in(steps, "{mu: 0.2, penalty: 50000}");
  // Friction that has changed stays so.
  const std::string rougher =
      "*STEP\n*STATIC\n1,1\n*CHANGE FRICTION, INTERACTION=DRY\n*FRICTION\n0.4, 7E4\n*END STEP\n";
  expect_in(part(law + rougher + in_time, "steps"), "{mu: 0.4, penalty: 70000, viscous: 1.5}");
  // From the start where inertia is.
  expect_in(part(law + in_time + press, "contact"), "damping: {viscous: 3}");
  expect_in(part(law + in_time + press, "steps"), "damping: none");
  EXPECT_EQ(message_of(law + in_time + press), "no error");
}

TEST(InpBetweenSteps, AClearanceIsThatOfItsPair) {
  const auto with = [&](const std::string& card, const std::string& adjust = "") {
    return dry + "*CONTACT PAIR, INTERACTION=DRY, TYPE=SURFACE TO SURFACE" + adjust +
           "\nSLAVE, MASTER\n" + card + press;
  };
  const std::string card = "*CLEARANCE, SLAVE=SLAVE, MASTER=MASTER, VALUE=-1E-3\n";
  expect_in(part(with(card), "contact"), "initial: {clearance: -0.001}");
  expect_in(message_of(with(card + card)),
            "the contact pair has an ADJUST or a *CLEARANCE already");
  expect_in(message_of(with(card, ", ADJUST=0.01")), "has an ADJUST or a *CLEARANCE already");
  expect_in(message_of(with("*CLEARANCE, SLAVE=MASTER, MASTER=SLAVE, VALUE=0\n")),
            "there is no *CONTACT PAIR of 'MASTER' and 'SLAVE'");
  expect_in(message_of(with("*CLEARANCE, SLAVE=SLAVE, MASTER=MASTER, VALUE=x\n")), "VALUE");
}

// Each of the four nodes has a quarter of the faces of the small cube that it is a corner of: 0.25
// below, two of 0.5 beside it.
TEST(InpBetweenSteps, NodesWithoutFacetsHaveTheirShareOfTheFreeFaces) {
  const std::string nodes = "*CONTACT PAIR, INTERACTION=DRY, TYPE=NODE TO SURFACE\nFEET, MASTER\n";
  const std::string contact = part(dry + nodes + press, "contact");
  expect_in(contact, "weight: {area: around}");
  expect_in(contact, "normal: {penalty: 1000000}");
  expect_in(contact, "{mu: 0.2, penalty: 50000}");
}

// A surface of nodes and one of facets may share a name: node-to-surface contact has that of nodes.
TEST(InpBetweenSteps, OfTwoSlavesWithOneNameThatOfNodesCounts) {
  const auto contact = [&](const std::string& nodes, const std::string& type) {
    return part(dry + "*SURFACE, NAME=SLAVE, TYPE=NODE\n" + nodes +
                    "*CONTACT PAIR, INTERACTION=DRY, TYPE=" + type + "\nSLAVE, MASTER\n" + press,
                "contact");
  };
  expect_in(contact("FOOT\n", "NODE TO SURFACE"),
            "slave: SLAVE\n    sampling: nodes\n    weight: {area: around}");
  expect_in(contact("FOOT\n", "SURFACE TO SURFACE"),
            "slave: SLAVE\n    sampling: {gauss: 3, segments: true}");
  expect_in(contact("11, 12\n", "NODE TO SURFACE"),
            "slave: SLAVE.surface_nodes\n    sampling: nodes\n    weight: {area: around}");
  expect_in(contact("11, 12\n", "SURFACE TO SURFACE"),
            "slave: SLAVE\n    sampling: {gauss: 3, segments: true}");
}

TEST(InpBetweenSteps, StepsInTime) {
  const std::string deck = dry + pair + R"(*STEP
*DYNAMIC, DIRECT, ALPHA=-0.1
1.E-5, 1.E-3
*CLOAD
15, 3, -1.
*BOUNDARY
16, 3, 3, -0.1
*END STEP
)";
  const std::string steps = part(deck, "steps");
  expect_in(steps, "increments: 100\n    duration: 0.001\n");
  expect_in(steps, "hht: {alpha: 0.1}");
  expect_in(steps, "damping: {mass: 3, stiffness: 0.0001}");
  expect_in(steps, "{on: node 15, fz: -1, amplitude: at_once}");
  expect_in(steps, "{on: node 16, uz: -0.1}");
  expect_in(part(deck, "amplitudes"), "at_once:\n    - [0, 1]\n    - [1, 1]\n");
  EXPECT_EQ(message_of(deck), "no error");
  const std::string explicit_deck = "*STEP\n*DYNAMIC, EXPLICIT\n1.E-5, 1.E-4\n*END STEP\n";
  expect_in(part(explicit_deck, "steps"), "scheme: central_differences");
  expect_in(message_of("*STEP\n*DYNAMIC, ALPHA=-0.5\n1.E-5, 1.E-4\n*END STEP\n"),
            "expected ALPHA from -1/3 to 0");
}

TEST(InpBetweenSteps, Vibrations) {
  const std::string frequency = "*FREQUENCY\n12\n*END STEP\n";
  const std::string deck = dry + pair + press + "*STEP, PERTURBATION\n" + frequency;
  expect_in(part(deck, "steps"), "{name: step_2, modes: 12}");
  EXPECT_EQ(message_of(deck), "no error");
  EXPECT_EQ(message_of("*STEP\n" + frequency + press), "no error");
  expect_in(part(press + "*STEP\n" + frequency, "steps"), "modes: {count: 12, about: start}");
  expect_in(message_of("*STEP, PERTURBATION\n*STATIC\n*END STEP\n"),
            "steps go on from the last one");
}

// Only what the step says is multiplied; what stood before stands again after it.
TEST(InpBetweenSteps, Buckling) {
  const std::string buckle = "*BUCKLE\n3, 0.01\n*CLOAD\n15, 3, -1.\n*END STEP\n";
  const std::string after = "*STEP\n*STATIC\n*DLOAD\nUP, P2, 20.\n*END STEP\n";
  const std::string steps =
      part(dry + pair + press + "*STEP, PERTURBATION\n" + buckle + after, "steps");
  expect_in(steps, "- name: step_2\n    buckling: 3\n    forces:\n      - {on: node 15, fz: -1}\n");
  EXPECT_EQ(steps.find("fz", steps.find("step_3")), std::string::npos) << steps;
  EXPECT_EQ(message_of("*STEP\n" + buckle), "no error");
  expect_in(part("*STEP\n" + buckle, "steps"), "buckling: 3");
  expect_in(part(press + "*STEP\n" + buckle, "steps"), "buckling: {count: 3, about: start}");
  const std::string table = "*AMPLITUDE, NAME=A\n0., 1., 1., 1.\n";
  expect_in(message_of(table + "*STEP\n*BUCKLE\n3\n*CLOAD, AMPLITUDE=A\n15, 3, -1.\n*END STEP\n"),
            "loads of a step with *BUCKLE have no amplitude");
  expect_in(message_of("*STEP\n*BUCKLE\n0\n*END STEP\n"),
            "expected the number of buckling factors");
}

TEST(InpBetweenSteps, MotionsAlongVibrations) {
  const std::string frequency = "*STEP\n*FREQUENCY, STORAGE=YES\n12\n*END STEP\n";
  const std::string moves = "*STEP\n*MODAL DYNAMIC\n1.E-5, 1.E-4\n";
  const std::string load = "*CLOAD\n15, 3, -1.\n";
  const std::string steps = part(frequency + moves + load +
                                     "*MODAL DAMPING\n1, 5, .5\n7, 99, 0.1\n"
                                     "*END STEP\n" +
                                     moves +
                                     "*MODAL DAMPING, RAYLEIGH\n,, 3., 1.E-4\n"
                                     "*END STEP\n" +
                                     moves + "*END STEP\n",
                                 "steps");
  expect_in(steps, "{first: 1, last: 5, ratio: 0.5}");
  expect_in(steps, "{first: 7, last: 12, ratio: 0.1}");
  expect_in(steps, "damping: {mass: 3, stiffness: 0.0001}");
  EXPECT_NE(steps.find("mass: 3"), steps.rfind("mass: 3"));  // it stays
  expect_in(steps, "increments: 10\n    duration: 0.0001");
  expect_in(steps, "fz: -1, amplitude: at_once}");
  const std::string end = "*END STEP\n";
  expect_in(message_of(moves + load + end), "the step before it must have a *FREQUENCY");
  expect_in(message_of(frequency + "*STEP\n*MODAL DYNAMIC, STEADY STATE\n1.E-5, 1.E-4\n" + end),
            "STEADY STATE is not supported");
  expect_in(message_of(frequency + moves + "*BOUNDARY\n15, 3, 3\n" + end),
            "supports must be those of the step with *FREQUENCY");
  const std::string table = "*AMPLITUDE, NAME=A\n0., 1., 1., 1.\n";
  expect_in(message_of(table + frequency + moves + "*CLOAD, AMPLITUDE=A\n15, 3, -1.\n" + end +
                       moves + end),
            "has an amplitude and ends with its step");
  expect_in(message_of(press + "*STEP, PERTURBATION\n*FREQUENCY\n12\n*END STEP\n" + moves + end),
            "PERTURBATION must be said of this step");
  expect_in(message_of(frequency + moves + end + press), "only *MODAL DYNAMIC follows");
}

TEST(InpBetweenSteps, Swings) {
  const std::string frequency = "*STEP\n*FREQUENCY, STORAGE=YES\n12\n*END STEP\n";
  const std::string swings = "*STEP\n*STEADY STATE DYNAMICS\n100., 200., 5\n";
  const std::string load = "*CLOAD\n15, 3, -1.\n";
  const std::string end = "*END STEP\n";
  const std::string table = "*AMPLITUDE, NAME=A\n100., 1., 150., 3., 300., 0.\n";
  const std::string steps = part(
      table + frequency + swings + load +
          "*CLOAD, LOAD CASE=2, AMPLITUDE=A\n15, 3, 4.\n*DLOAD, LOAD CASE=2\nUP, P2, 7.\n"
          "*MODAL DAMPING, RAYLEIGH\n,, 3., 1.E-4\n" +
          end + "*STEP\n*STEADY STATE DYNAMICS\n150., 150.,,1.\n*BOUNDARY\n1, 1, 1, 0.5\n" + end,
      "steps");
  expect_in(steps, "from: 100\n");
  expect_in(steps, "points: 5\n");
  expect_in(steps, "bias: 3\n");
  expect_in(steps, "damping: {mass: 3, stiffness: 0.0001}");
  expect_in(steps, "fz: -1}");
  expect_in(steps, "fz: 4, phase: 90, amplitude: A_2}");
  expect_in(steps, "value: 7, phase: 90}");
  expect_in(steps, "points: 20\n      bias: 1\n");
  expect_in(steps, "ux: 0.5}");
  EXPECT_NE(steps.find("fz: -1}"), steps.rfind("fz: -1}"));  // loads of swings go on
  expect_in(
      part(table + frequency + swings + "*CLOAD, AMPLITUDE=A\n15, 3, 4.\n" + end, "amplitudes"),
      "[0.5, 3]");
  expect_in(message_of(swings + load + end), "the step before it must have a *FREQUENCY");
  expect_in(message_of(frequency + "*STEP\n*STEADY STATE DYNAMICS, HARMONIC=NO\n1., 2.\n" + end),
            "HARMONIC=NO is not supported");
  expect_in(message_of(frequency + "*STEP\n*STEADY STATE DYNAMICS\n2., 1.\n" + end),
            "the second not below the first");
  expect_in(message_of("*STEP\n*STATIC\n*CLOAD, LOAD CASE=2\n15, 3, 4.\n" + end),
            "LOAD CASE belongs to *STEADY STATE DYNAMICS");
  expect_in(message_of(press + frequency + swings + end), "of a step before would go on");
  EXPECT_EQ(message_of(press + frequency + swings + "*DLOAD, OP=NEW\n" + end), "no error");
  expect_in(message_of(frequency + swings + "*BOUNDARY, LOAD CASE=2\n15, 3, 3, 1.\n" + end),
            "supports must be those of the step with *FREQUENCY");
  expect_in(message_of(frequency + swings + end + press), "only *STEADY STATE DYNAMICS follows");
  EXPECT_EQ(message_of(frequency + swings + load + end + "*STEP\n"), "no error");
}

TEST(InpBetweenSteps, NodalDiameters) {
  const std::string frequency = "*STEP\n*FREQUENCY\n12\n*SELECT CYCLIC SYMMETRY MODES, ";
  expect_in(part(frequency + "NMIN=1, NMAX=3\n*END STEP\n", "steps"), "diameters: [1, 2, 3]");
  expect_in(message_of(frequency + "NMIN=2, NMAX=1\n*END STEP\n"), "expected 0 <= NMIN <= NMAX");
  expect_in(
      message_of("*STEP\n*STATIC\n*SELECT CYCLIC SYMMETRY MODES, NMIN=2, NMAX=3\n*END STEP\n"),
      "belongs behind *FREQUENCY");
  expect_in(message_of(frequency + "NMIN=0, NMAX=0\n*END STEP\n"),
            "only a sector with `cyclic_symmetry` has nodal diameters");
}

}  // namespace
}  // namespace osculate::deck
