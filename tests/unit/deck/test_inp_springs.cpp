// Springs, dampers, gaps and masses of decks.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "inp_run_test.hpp"
#include "osculate/deck/inp_translate.hpp"

namespace osculate::deck {
namespace {

/// A unit cube, held or not, with nodes 21 and 22 beside it.
const std::string cube =
    "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n"
    "21,4,0,0\n22,1,0,0\n"
    "*ELEMENT, TYPE=C3D8, ELSET=CUBE\n1,1,2,3,4,5,6,7,8\n"
    "*NSET, NSET=ALL\n1,2,3,4,5,6,7,8\n"
    "*MATERIAL, NAME=M\n*ELASTIC\n1e9, 0.\n*DENSITY\n1e-9\n"
    "*SOLID SECTION, ELSET=CUBE, MATERIAL=M\n";
const std::string held = "*BOUNDARY\nALL, 2, 3\n2, 1, 1, 0.\n21, 1, 3\n22, 2, 3\n";
std::string step(const std::string& what, const std::string& parameters = "") {
  return "*STEP" + parameters + "\n*STATIC\n1., 1.\n" + what + "*END STEP\n";
}
std::string fault(const std::string& text) {
  try {
    (void)translate_deck(text, "d.inp");
  } catch (const core::InputError& error) {
    return error.what();
  }
  return {};
}

/// The cube of another density.
std::string edited_cube(const std::string& density) {
  std::string text = cube;
  return text.replace(text.find("1e-9\n"), 4, density);
}

/// By a set that has a mass beside the cube, by name or number, and by one of masses alone.
TEST(InpSprings, SetsMayHaveMassesBesideCells) {
  const std::string mass =
      "*ELEMENT, TYPE=MASS, ELSET=MA\n50, 2\n51, 3\n*MASS, ELSET=MA\n4.\n*ELEMENT, TYPE=MASS, "
      "ELSET=MB\n52, 6\n*MASS, ELSET=MB\n8.\n*BOUNDARY\nALL, 1, 3\n";
  const auto weight = [&](const std::string& sets, const std::string& density) {
    return run_deck(edited_cube(density) + mass + sets +
                    step("*DLOAD\nEALL, GRAV, 10., 0., 0., -1.\n"))
        .reaction_of("ALL")
        .z();
  };
  EXPECT_NEAR(weight("*ELSET, ELSET=EALL\nCUBE, MA\n", "2."), 20 + 2 * 40, 1e-9);
  EXPECT_NEAR(weight("*ELSET, ELSET=EALL\n1, 51, 52\n", "2."), 20 + 40 + 80, 1e-9);
  EXPECT_NEAR(weight("*ELSET, ELSET=EALL, GENERATE\n1, 51\n", "2."), 20 + 2 * 40, 1e-9);
  EXPECT_NEAR(weight("*ELSET, ELSET=BOTH\nMA\n*ELSET, ELSET=EALL\nBOTH, MB\n", "2."), 160, 1e-9);
  EXPECT_NEAR(weight("*ELSET, ELSET=EALL\nCUBE\n", "2."), 20, 1e-9);
  EXPECT_NE(fault(cube + mass + "*ELSET, ELSET=EALL\nCUBE, MC\n").find("set of elements 'MC'"),
            std::string::npos);
  EXPECT_NE(fault(cube + mass + "*ELSET, ELSET=EALL\n1, 53\n").find("element 53 does not exist"),
            std::string::npos);
}

/// CENTRIF acts on masses, too: at their undeformed places, or with NLGEOM where they are.
TEST(InpSprings, CentrifugalForcesOfMasses) {
  const std::string mass =
      "*ELEMENT, TYPE=SPRING1, ELSET=B\n3, 22\n*SPRING, ELSET=B\n1\n40.\n"
      "*ELEMENT, TYPE=MASS, ELSET=M\n5, 22\n*MASS, ELSET=M\n2.\n";
  const std::string turn = "*DLOAD\nM, CENTRIF, 5., 0., 0., 0., 0., 0., 1.\n";
  EXPECT_NEAR(run_deck(cube + mass + held + step(turn)).displacement(22).x(), 0.25, 1e-12);
  const std::string more = "*ELEMENT, TYPE=MASS, ELSET=M2\n6, 22\n*MASS, ELSET=M2\n6.\n";
  EXPECT_NEAR(run_deck(cube + mass + more + held + step(turn)).displacement(22).x(), 0.25, 1e-12);
  EXPECT_NEAR(run_deck(cube + mass + held + step(turn, ", NLGEOM")).displacement(22).x(), 1.0 / 3,
              1e-9);
  const auto notes = [&](const std::string& first, const std::string& second) {
    std::string all;
    for (const std::string& note :
         translate_deck(cube + mass + held + step(first) + "*STEP, PERTURBATION\n*FREQUENCY\n1\n" +
                            second + "*END STEP\n",
                        "d.inp")
             .notes)
      all += note;
    return all;
  };
  EXPECT_THAT(notes(turn, ""), ::testing::HasSubstr("in CalculiX it does not"));
  EXPECT_THAT(notes("", turn), ::testing::HasSubstr("does not count in it"));
}

/// Along the line between nodes, in directions of one and of two nodes, by a table.
TEST(InpSprings, OfAllKinds) {
  const std::string spring = "*ELEMENT, TYPE=SPRINGA, ELSET=A\n2, 22, 21\n*SPRING, ELSET=A\n\n5.\n";
  const std::string ground = "*ELEMENT, TYPE=SPRING1, ELSET=B\n3, 22\n*SPRING, ELSET=B\n1\n3.\n";
  const std::string two =
      "*ELEMENT, TYPE=SPRING2, ELSET=C\n4, 21, 22\n*SPRING, ELSET=C\n1, 1\n2.\n";
  const std::string table =
      "*ELEMENT, TYPE=SPRINGA, ELSET=D\n5, 22, 21\n*SPRING, ELSET=D, NONLINEAR\n\n-6., -2.\n0., "
      "0.\n"
      "1., 1.\n";
  const auto way = [&](const std::string& springs) {
    return run_deck(cube + springs + held + step("*CLOAD\n22, 1, 1.5\n", ", NLGEOM"))
        .displacement(22)
        .x();
  };
  EXPECT_NEAR(way(spring), 1.5 / 5, 1e-9);
  EXPECT_NEAR(way(spring + ground), 1.5 / 8, 1e-9);
  EXPECT_NEAR(way(two + ground), 1.5 / 5, 1e-9);
  EXPECT_NEAR(way(table), 0.5, 1e-9);
}

/// Of two nodes the elongation is the first's displacement less the second's.
TEST(InpSprings, OfTwoNodesKnowsWhichIsFirst) {
  const auto way = [&](const char* nodes, double force) {
    const std::string spring = fmt::format(
        "*ELEMENT, TYPE=SPRING2, ELSET=C\n4, {}\n*SPRING, ELSET=C, NONLINEAR\n1, 1\n-10., -1.\n0., "
        "0.\n40., 1.\n",
        nodes);
    return run_deck(cube + spring + held + step(fmt::format("*CLOAD\n22, 1, {}\n", force)))
        .displacement(22)
        .x();
  };
  EXPECT_NEAR(way("22, 21", 5), 0.125, 1e-9);
  EXPECT_NEAR(way("22, 21", -5), -0.5, 1e-9);
  EXPECT_NEAR(way("21, 22", 5), 0.5, 1e-9);
  EXPECT_NEAR(way("21, 22", -5), -0.125, 1e-9);
}

TEST(InpSprings, OfRingsActOnASector) {
  const TranslatedDeck deck = translate_deck(
      "*NODE\n1,1,0\n2,2,0\n3,2,1\n4,1,1\n*ELEMENT, TYPE=CAX4, ELSET=E\n1,1,2,3,4\n*ELEMENT, "
      "TYPE=SPRING1, ELSET=S\n2,3\n*SPRING, ELSET=S\n2\n5.\n*MATERIAL, NAME=M\n*ELASTIC\n1e3,0.\n"
      "*SOLID SECTION, ELSET=E, MATERIAL=M\n" +
          step(""),
      "d.inp");
  EXPECT_NE(to_yaml(deck.root).find("stiffness: 900"), std::string::npos) << to_yaml(deck.root);
}

TEST(InpSprings, WithoutAnyCell) {
  const DeckRun run = run_deck(
      "*NODE\n1,0,0,0\n2,0,0,3\n*ELEMENT, TYPE=SPRINGA, ELSET=S\n1,1,2\n*SPRING, ELSET=S\n\n4.\n"
      "*BOUNDARY\n1,1,3\n2,1,2\n" +
      step("*CLOAD\n2,3,2.\n"));
  EXPECT_NEAR(run.displacement(2).z(), 0.5, 1e-12);
}

/// Free until the gap has closed, then stiff.
TEST(InpSprings, GapsClose) {
  const auto way = [&](double prescribed) {
    const DeckRun run = run_deck(
        cube +
        "*ELEMENT, TYPE=GAPUNI, ELSET=G\n2, 22, 21\n*GAP, ELSET=G\n0.25, 1., 0., 0., , 1e4\n" +
        "*ELEMENT, TYPE=SPRING1, ELSET=B\n3, 22\n*SPRING, ELSET=B\n1\n1.\n" + held +
        step(fmt::format("*CLOAD\n22, 1, {}\n", prescribed)));
    return run.displacement(22).x();
  };
  constexpr double pull = 1e-3;  // that of CalculiX where none is given
  EXPECT_NEAR(way(-2), -2 + pull, 1e-9);
  EXPECT_NEAR(way(0.2), 0.2 + pull, 1e-9);
  EXPECT_NEAR(way(3), (3 + 0.25 * 1e4 + pull) / (1e4 + 1), 1e-9);
  const DeckRun usual = run_deck(  // a stiffness of 1e12 in a soft model
      cube + "*ELEMENT, TYPE=GAPUNI, ELSET=G\n2, 22, 21\n*GAP, ELSET=G\n0.25, 1., 0., 0.\n" +
      "*ELEMENT, TYPE=SPRING1, ELSET=B\n3, 22\n*SPRING, ELSET=B\n1\n1.\n" + held +
      step("*CLOAD\n22, 1, 3.\n"));
  EXPECT_NEAR(usual.displacement(22).x(), 0.25, 1e-9);
}

TEST(InpSprings, DampersAndMasses) {
  const TranslatedDeck deck =
      translate_deck(cube +
                         "*ELEMENT, TYPE=DASHPOTA, ELSET=D\n2, 22, 21\n*DASHPOT, ELSET=D\n\n0.5\n"
                         "*ELEMENT, TYPE=MASS, ELSET=P\n3, 22\n*MASS, ELSET=P\n2.5\n" +
                         held + step(""),
                     "d.inp");
  const std::string yaml = to_yaml(deck.root);
  EXPECT_NE(yaml.find("damping: 0.5"), std::string::npos) << yaml;
  EXPECT_NE(yaml.find("mass: 2.5"), std::string::npos) << yaml;
}

TEST(InpSprings, WhatIsWrong) {
  const auto of = [&](const std::string& cards) { return fault(cube + cards + held + step("")); };
  EXPECT_EQ(of("*SPRING, ELSET=NONE\n\n1.\n"),
            "d.inp:22: *SPRING: there is no *ELEMENT of its kind with this ELSET");
  EXPECT_EQ(of("*ELEMENT, TYPE=SPRINGA, ELSET=A\n2, 22, 21\n*MASS, ELSET=A\n1.\n"),
            "d.inp:24: *MASS: its ELSET has elements of type SPRINGA");
  EXPECT_EQ(of("*ELEMENT, TYPE=SPRING1, ELSET=A\n2, 22\n*SPRING, ELSET=A\n4\n1.\n"),
            "d.inp:25: 'node 22' has no direction 4");
  EXPECT_EQ(
      of("*ELEMENT, TYPE=SPRINGA, ELSET=A\n2, 22, 21\n*SPRING, ELSET=A\n\n1.,,0.\n2.,,100.\n"),
      "d.inp:27: *SPRING: a stiffness that depends on the temperature is not supported");
  EXPECT_EQ(
      of("*ELEMENT, TYPE=SPRINGA, ELSET=A\n2, 22, 21\n*SPRING, ELSET=A, NONLINEAR\n\n0., 0.\n1., "
         "1., 100.\n"),
      "d.inp:27: *SPRING: a table that depends on the temperature is not supported");
  EXPECT_EQ(of("*ELEMENT, TYPE=SPRINGA, ELSET=A\n2, 22, 21\n"),
            "d.inp:22: *ELEMENT: no *SPRING, *DASHPOT, *GAP or *MASS names its ELSET");
  EXPECT_EQ(of("*NSET, NSET=T\n22\n*TRANSFORM, NSET=T\n1,1,0,-1,1,0\n*ELEMENT, TYPE=SPRING1, "
               "ELSET=A\n2, 22\n*SPRING, ELSET=A\n1\n1.\n"),
            "d.inp:29: 'node 22' has a *TRANSFORM, whose axes are not those of springs: not "
            "supported");
  EXPECT_EQ(of("*ELEMENT, TYPE=GAPUNI, ELSET=A\n2, 22, 21\n*GAP, ELSET=A\n0.1\n"),
            "d.inp:25: expected the direction of the gap");
}

}  // namespace
}  // namespace osculate::deck
