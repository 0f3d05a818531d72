// Parameters of keywords: each is read, told of as without effect, or refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cube_nodes.hpp"
#include "osculate/core/error.hpp"
#include "osculate/deck/inp_keywords.hpp"
#include "osculate/deck/inp_translate.hpp"
#include "osculate/deck/parse.hpp"

namespace osculate::deck {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string cube = "*NODE, NSET=NALL\n" + cube_nodes(1, {0, 0, 0}) +
                         "*ELEMENT, TYPE=C3D8, ELSET=E\n1, 1, 2, 3, 4, 5, 6, 7, 8\n"
                         "*NSET, NSET=BASE\n1, 2, 3, 4\n*NSET, NSET=TOP\n5, 6, 7, 8\n";
const std::string steel =
    "*MATERIAL, NAME=Steel\n*ELASTIC\n2.1E5, 0.3\n*SOLID SECTION, ELSET=E, MATERIAL=STEEL\n";
const std::string fixed = "*BOUNDARY\nBASE, 1, 3\n";

/// Line 16 is the first one of `text`.
TranslatedDeck deck_with(const std::string& text) { return translate_deck(cube + text, "a.inp"); }
std::string message_of(const std::string& text) {
  try {
    (void)deck_with(text);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "no error";
}
std::string in_step(const std::string& text) {
  return steel + fixed + "*STEP\n*STATIC\n" + text + "*END STEP\n";
}

TEST(InpParameters, MistakesAndWhatChangesTheAnswerStop) {
  const std::string step = "*STEP\n*STATIC\n*END STEP\n", end = steel + fixed + step;
  const struct {
    std::string text, message;
  } cases[]{
      {steel + "*STEP, NLGOEM\n*STATIC\n*END STEP\n",
       "a.inp:20: *STEP: unknown parameter 'NLGOEM'; did you mean 'NLGEOM'?"},
      {in_step("*CLOAD, AMPLTUDE=X\nTOP, 1, 1.\n"),
       "*CLOAD: unknown parameter 'AMPLTUDE'; did you mean 'AMPLITUDE'?"},
      {"*CONTACT PAIR, INTERACTION=I, TIED\nA, B\n" + end,
       "*CONTACTPAIR: unknown parameter 'TIED'"},
      {"*SURFACE INTERACTION, NAME=I\n*FRICTION, ANISOTROPIC\n0.1, 0.2\n" + end,
       "a.inp:17: *FRICTION: unknown parameter 'ANISOTROPIC'"},
      {"*SURFACE INTERACTION, NAME=I\n*FRICTION, TAUMAX=3.\n0.1\n" + end,
       "*FRICTION: unknown parameter 'TAUMAX'"},
      {"*SURFACE INTERACTION, NAME=I\n*SURFACE BEHAVIOR, NO SEPERATION\n" + end,
       "*SURFACEBEHAVIOR: unknown parameter 'NOSEPERATION'"},
      {in_step("*BOUNDARY, TYPE=VELOCITY\nTOP, 1, 1, 1.\n"),
       "*BOUNDARY: TYPE=VELOCITY is not supported: expected TYPE=DISPLACEMENT"},
      {in_step("*DLOAD, FOLOWER=NO\nE, P1, 1.\n"), "did you mean 'FOLLOWER'?"},
      {steel + "*STEP, NLGEOM\n*STATIC\n*DLOAD, FOLLOWER=NO\nE, P1, 1.\n*END STEP\n",
       "*DLOAD: FOLLOWER=NO is not supported with NLGEOM"},
      {"*MATERIAL, NAME=A\n*ELASTIC, DEPENDENCIES=1\n1., 0.3, , 5.\n" + end,
       "*ELASTIC: unknown parameter 'DEPENDENCIES'"},
      {"*MATERIAL, NAME=A\n*PLASTIC, RATE=1.\n1., 0.\n" + end, "unknown parameter 'RATE'"},
      {"*MATERIAL, NAME=A\n*EXPANSION, USER\n" + end, "*EXPANSION: unknown parameter 'USER'"},
      {"*TIE, NAME=T, CONSTRAINT RATIO=0.5\nA, B\n" + end,
       "*TIE: unknown parameter 'CONSTRAINTRATIO'"},
      {"*COUPLING, REF NODE=1, SURFACE=S, CONSTRAINT NAME=C, INFLUENCE RADIUS=2.\n*KINEMATIC\n" +
           end,
       "*COUPLING: unknown parameter 'INFLUENCERADIUS'"},
      {steel + "*STEP\n*STATIC, RIKS\n*END STEP\n", "RIKS is not supported; `solver: arc_length`"},
      {in_step("*CLOAD, USER\nTOP, 1, 1.\n"), "the parameter USER is not supported"},
  };
  for (const auto& one : cases) EXPECT_THAT(message_of(one.text), HasSubstr(one.message));
  EXPECT_EQ(message_of(end), "no error");
  EXPECT_EQ(message_of(in_step("*BOUNDARY, TYPE=DISPLACEMENT\nTOP, 1, 1, 1.\n")), "no error");
  EXPECT_EQ(message_of(in_step("*DLOAD, FOLLOWER=NO\nE, P1, 1.\n")), "no error");
}

TEST(InpParameters, ThoseWithoutEffectAreToldOfOnce) {
  const TranslatedDeck deck = deck_with(
      "*MATERIAL, NAME=STEEL, DESCRIPTION=x\n*ELASTIC\n2.1E5, 0.3\n"
      "*SOLID SECTION, ELSET=E, MATERIAL=steel, CONTROLS=EC-1\n,\n*SECTION CONTROLS, "
      "NAME=EC-1\n1.,\n"
      "*STEP, NAME=A, INC=100, UNSYMM=YES\n*STATIC, SOLVER=SPOOLES\n*MONITOR, NODE=1, DOF=1\n"
      "*ENERGY OUTPUT\nALLSE\n*END STEP\n*STEP, UNSYMM=YES\n*STATIC\n*END STEP\n");
  ASSERT_EQ(deck.notes.size(), 2U);
  EXPECT_EQ(deck.notes[0],
            "of 'a.inp' these are left out: *ENERGY OUTPUT, *MONITOR, *SECTION CONTROLS");
  EXPECT_EQ(deck.notes[1],
            "of 'a.inp' these parameters have no effect: CONTROLS of *SOLID SECTION, DESCRIPTION "
            "of *MATERIAL, SOLVER of *STATIC, UNSYMM of *STEP");
}

TEST(InpParameters, ListsOfTheTableHaveNamesAndValues) {
  EXPECT_THAT(inp_parameter_names("NSET, REF NODE; TYPE=A"),
              ::testing::ElementsAre("NSET", "REF NODE", "TYPE=A"));
  EXPECT_TRUE(inp_parameter_names("").empty());
  EXPECT_THAT(inp_parameter_names("; SOLVER"), ::testing::ElementsAre("SOLVER"));
}

TEST(InpParameters, DirectionsOfNodesWithoutRotationsAreLeftOut) {
  for (const char* const held : {"BASE, 1, 6", "BASE, ENCASTRE", "BASE, pinned"}) {
    TranslatedDeck deck = deck_with(steel + "*BOUNDARY\n" + held + "\n*STEP\n*STATIC\n*END STEP\n");
    const Description d = parse_model(std::move(deck.root), "a.inp");
    ASSERT_EQ(d.steps[0].prescribe.size(), 3U) << held;
  }
  TranslatedDeck mirrored =
      deck_with(steel + "*BOUNDARY\nBASE, YSYMM\n*STEP\n*STATIC\n*END STEP\n");
  const Description d = parse_model(std::move(mirrored.root), "a.inp");
  ASSERT_EQ(d.steps[0].prescribe.size(), 1U);
  EXPECT_TRUE(d.steps[0].prescribe[0].values[1]);
  EXPECT_THAT(message_of(steel + "*BOUNDARY\nBASE, XSIMM\n*STEP\n*STATIC\n*END STEP\n"),
              HasSubstr("expected the first direction"));
}

TEST(InpParameters, NodesWithoutElementsAreLeftOut) {
  TranslatedDeck deck = deck_with("*NODE, NSET=RP\n900, 5., 5., 5.\n" + steel + fixed +
                                  "RP, 1, 3\n*STEP\n*STATIC\n*CLOAD\nRP, 1, 5.\nTOP, 3, 1.\n"
                                  "*END STEP\n");
  EXPECT_THAT(deck.notes, ::testing::Contains(HasSubstr("'RP' has no nodes of elements")));
  const Description d = parse_model(std::move(deck.root), "a.inp");
  EXPECT_EQ(d.steps[0].prescribe.size(), 3U);
  EXPECT_EQ(d.steps[0].forces.size(), 1U);
}

TEST(InpParameters, NumbersOfStepsAndAmplitudes) {
  const auto increments = [](const std::string& numbers) {
    TranslatedDeck deck = deck_with(steel + fixed + "*STEP\n*STATIC\n" + numbers + "*END STEP\n");
    return parse_model(std::move(deck.root), "a.inp").steps[0].increments.value;
  };
  EXPECT_EQ(increments(""), 1);
  EXPECT_EQ(increments("0.01, 1.\n"), 10);
  EXPECT_EQ(increments("0.01, 1., 1E-5, 0.05\n"), 20);
  EXPECT_EQ(increments("0.5, 2., 1E-5, 2.\n"), 4);
  TranslatedDeck deck = deck_with("*AMPLITUDE, NAME=A, SHIFTX=0.25, SHIFTY=2.\n0., 0., 0.5, 1.\n" +
                                  in_step("*CLOAD, AMPLITUDE=A\nTOP, 1, 1.\n"));
  EXPECT_THAT(to_yaml(deck.root),
              HasSubstr("    - [0, 2]\n    - [0.25, 2]\n    - [0.75, 3]\n    - [1, 3]\n"));
}

// Abaqus: x^3 (10 - 15 x + 6 x^2) between two points, level at both.
TEST(InpParameters, AmplitudesThatAreNoTables) {
  const auto written = [](const std::string& amplitude) {
    return to_yaml(
        deck_with("*AMPLITUDE, NAME=A, " + amplitude + in_step("*CLOAD, AMPLITUDE=A\nTOP, 1, 1.\n"))
            .root);
  };
  const std::string smooth = written("DEFINITION=SMOOTH STEP\n0., 0., 0.5, 2., 1., 2.\n");
  EXPECT_THAT(smooth, HasSubstr("    - [0, 0]\n"));
  EXPECT_THAT(smooth, HasSubstr("    - [0.125, 0.20703125]\n"));
  EXPECT_THAT(smooth, HasSubstr("    - [0.25, 1]\n"));
  EXPECT_THAT(smooth, HasSubstr("    - [0.5, 2]\n    - [1, 2]\n"));
  EXPECT_THAT(written("DEFINITION=EQUALLY SPACED, FIXED INTERVAL=0.25, BEGIN=0.5\n1., 3., 2.\n"),
              HasSubstr("    - [0, 1]\n    - [0.5, 1]\n    - [0.75, 3]\n    - [1, 2]\n"));
  const auto refused = [&](const std::string& amplitude) {
    try {
      (void)written(amplitude);
    } catch (const core::InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_THAT(refused("DEFINITION=DECAY\n1, 2., 0., 1.\n"),
              HasSubstr("DEFINITION=DECAY is not supported"));
  EXPECT_THAT(refused("DEFINITION=PERIODIC\n1, 2., 0., 1.\n"),
              HasSubstr("expected 1 pairs of A and B, found 0"));
  EXPECT_THAT(refused("DEFINITION=PERIODIC\n1, 0., 0., 1.\n1., 1.\n"),
              HasSubstr("a circular frequency above 0"));
  EXPECT_THAT(refused("DEFINITION=PERIODIC\n1, 1.E5, 0., 1.\n1., 1.\n"),
              HasSubstr("a step has 1.59e+04 of its shortest waves: at most 500 are supported"));
  EXPECT_THAT(refused("DEFINITION=EQUALLY SPACED\n1., 3.\n"), HasSubstr("FIXED INTERVAL"));
  EXPECT_THAT(refused("VALUE=ABSOLUTE\n0., 0., 1., 1.\n"),
              HasSubstr("VALUE=ABSOLUTE is not supported"));
}

// Abaqus: A0 + sum A_n cos n w (t - t0) + B_n sin n w (t - t0) from t0 on, before A0.
TEST(InpParameters, AmplitudesOfWaves) {
  const auto table = [](const std::string& amplitude) {
    TranslatedDeck deck = deck_with("*AMPLITUDE, NAME=A, DEFINITION=PERIODIC" + amplitude +
                                    in_step("*CLOAD, AMPLITUDE=A\nTOP, 1, 1.\n"));
    return parse_model(std::move(deck.root), "a.inp").amplitudes.at(0);
  };
  const auto wave = [](double t) {
    if (t < 0.25) return 0.5;
    const double a = 7 * (t - 0.25);
    return 0.5 + std::cos(a) - 2 * std::sin(a) + 0.3 * std::sin(2 * a);
  };
  for (const std::string text :
       {"\n2, 7., 0.25, 0.5\n1., -2., 0., 0.3\n",
        ", SHIFTX=0.15, SHIFTY=0.2\n2, 7., 0.1, 0.3\n1., -2.\n0., 0.3\n"}) {
    const auto points = table(text).points;
    EXPECT_EQ(points.front(), std::pair(0.0, 0.5));
    double apart = 0;
    for (std::size_t k = 1; k < points.size(); ++k) {
      const auto& [time, factor] = points[k];
      const auto& [before, factor_before] = points[k - 1];
      EXPECT_NEAR(factor, wave(time), 1e-12);
      if (before < 0.25) continue;
      apart =
          std::max(apart, std::abs(0.5 * (factor + factor_before) - wave(0.5 * (time + before))));
    }
    EXPECT_LT(apart, 3e-5);
    EXPECT_GT(points.size(), 500U);
  }
}

TEST(InpParameters, ViscousForcesOfStabilizeAreToldOf) {
  const TranslatedDeck deck =
      deck_with(steel + fixed + "*STEP\n*STATIC, STABILIZE=0.0002, ALLSDTOL=0\n*END STEP\n");
  EXPECT_TRUE(std::ranges::any_of(deck.notes, [](const std::string& note) {
    return note.find("without the viscous forces of STABILIZE") != std::string::npos;
  }));
}

TEST(InpParameters, BoundsOfFrequenciesAreListed) {
  TranslatedDeck deck = deck_with(
      "*MATERIAL, NAME=A\n*ELASTIC\n1., 0.\n*DENSITY\n1.\n*SOLID SECTION, ELSET=E, MATERIAL=a\n"
      "*STEP\n*FREQUENCY\n10, 0.01, 1E6\n*END STEP\n*STEP\n*FREQUENCY\n3\n*END STEP\n");
  const Description d = parse_model(std::move(deck.root), "a.inp");
  ASSERT_TRUE(d.steps[0].lowest && d.steps[0].highest);
  EXPECT_EQ(d.steps[0].lowest->value, 0.01);
  EXPECT_EQ(d.steps[0].highest->value, 1e6);
  EXPECT_FALSE(d.steps[1].lowest);
}

TEST(InpParameters, TemperaturesGoBackToThoseAtFirst) {
  const auto second_step = [](const std::string& heated, const std::string& now) {
    TranslatedDeck deck = deck_with(
        "*MATERIAL, NAME=A\n*ELASTIC\n1., 0.\n*EXPANSION\n1E-3\n*SOLID SECTION, ELSET=E, "
        "MATERIAL=A\n*INITIAL CONDITIONS, TYPE=TEMPERATURE\nNALL, 20.\n*STEP\n*STATIC\n"
        "*TEMPERATURE\n" +
        heated + ", 80.\n*END STEP\n*STEP\n*STATIC\n*TEMPERATURE, OP=NEW\n" + now +
        ", 50.\n*END STEP\n");
    const std::string yaml = to_yaml(deck.root);
    (void)parse_model(std::move(deck.root), "a.inp");
    return yaml.substr(yaml.rfind("    temperature:\n"));
  };
  EXPECT_THAT(second_step("TOP", "BASE"),
              StartsWith("    temperature:\n      - {on: TOP, value: 0}\n      - {on: NALL, value: "
                         "20}\n      - {on: BASE, value: 50}\n"));
  // the set that has a temperature at first is that which was heated: it is named once
  EXPECT_THAT(second_step("NALL", "BASE"),
              StartsWith("    temperature:\n      - {on: NALL, value: 20}\n      - {on: BASE, "
                         "value: 50}\n"));
  EXPECT_THAT(second_step("NALL", "NALL"),
              StartsWith("    temperature:\n      - {on: NALL, value: 50}\n"));
}

TEST(InpParameters, LocalResultsOfNodesWithAxes) {
  const std::string axes = "*TRANSFORM, NSET=TOP\n1., 1., 0., -1., 1., 0.\n";
  TranslatedDeck deck = deck_with(
      axes + in_step("*NODE PRINT, NSET=TOP\nU\n*NODE PRINT, NSET=TOP, GLOBAL=YES\nRF\n"));
  const Output output = parse_model(std::move(deck.root), "a.inp").output;
  ASSERT_EQ(output.dat.size(), 2U);
  EXPECT_TRUE(output.dat[0].local);
  EXPECT_FALSE(output.dat[1].local);
}

}  // namespace
}  // namespace osculate::deck
