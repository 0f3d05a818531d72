// Decks: elements that go and come back, sections that change, equations that end, stresses and
// plastic strains at first.
#include <cmath>

#include "cube_nodes.hpp"
#include "inp_run_test.hpp"
#include "osculate/deck/inp_translate.hpp"

namespace osculate::deck {
namespace {

/// Two unit cubes side by side, not joined, held below; lines 1 to 36, the step from 37 on.
const std::string two = R"(*NODE, NSET=NALL
)" + cube_nodes(1, {0, 0, 0}) +
                        cube_nodes(11, {2, 0, 0}) + R"(*ELEMENT, TYPE=C3D8, ELSET=A
1, 1, 2, 3, 4, 5, 6, 7, 8
*ELEMENT, TYPE=C3D8, ELSET=B
2, 11, 12, 13, 14, 15, 16, 17, 18
*NSET, NSET=LOW
1, 2, 3, 4, 11, 12, 13, 14
*NSET, NSET=UP
5, 6, 7, 8, 15, 16, 17, 18
*MATERIAL, NAME=M
*ELASTIC
1000., 0.
*MATERIAL, NAME=SOFT
*ELASTIC
500., 0.
*SOLID SECTION, ELSET=A, MATERIAL=M
*SOLID SECTION, ELSET=B, MATERIAL=M
*BOUNDARY
NALL, 1, 2
LOW, 3, 3
)";
std::string pull(double way, const std::string& cards = "") {
  return "*STEP\n*STATIC\n" + cards + "*BOUNDARY\nUP, 3, 3, " + std::to_string(way) +
         "\n*END STEP\n";
}

TEST(InpBodyChanges, ElementsGoAndComeBack) {
  const auto run_with = [](const std::string& how) {
    return run_deck(two + pull(0.1) + pull(0.2, "*MODEL CHANGE, TYPE=ELEMENT, REMOVE\nB\n") +
                    pull(0.3, "*MODEL CHANGE, TYPE=ELEMENT, ADD" + how + "\n2\n"));
  };
  const DeckRun fresh = run_with("=STRAIN FREE"), strained = run_with("=WITH STRAIN");
  EXPECT_NEAR(fresh.reaction_of("LOW", 0).z(), -200, 1e-9);
  EXPECT_NEAR(fresh.reaction_of("LOW", 1).z(), -200, 1e-9);
  EXPECT_NEAR(fresh.reaction_of("LOW", 2).z(), -300 - 100, 1e-9);
  EXPECT_NEAR(strained.reaction_of("LOW", 2).z(), -300 - 300, 1e-9);  // as CalculiX has it
}

TEST(InpBodyChanges, SectionsChange) {
  const DeckRun run =
      run_deck(two + pull(0.1) + pull(0.1, "*CHANGE SOLID SECTION, ELSET=B, MATERIAL=SOFT\n"));
  EXPECT_NEAR(run.reaction_of("LOW", 0).z(), -200, 1e-9);
  EXPECT_NEAR(run.reaction_of("LOW", 1).z(), -150, 1e-9);
}

TEST(InpBodyChanges, EquationsEnd) {
  std::string text = two;
  for (const int node : {5, 6, 7, 8})
    text += "*EQUATION\n2\n" + std::to_string(node + 10) + ", 3, 1., " + std::to_string(node) +
            ", 3, -1.\n";
  const std::string step = "*STEP\n*STATIC\n*CLOAD\n5, 3, 10.\n6, 3, 10.\n7, 3, 10.\n8, 3, 10.\n";
  const std::string end = "*END STEP\n";
  const auto run_with = [&](const std::string& removal) {
    return run_deck(text + step + end + step + removal + end);
  };
  for (const char* const removal :
       {"*EQUATION, REMOVE ALL\n", "*EQUATION, REMOVE\n15, 3\n16, 3\n17, 3, 3\n18, 3\n",
        "*EQUATION, REMOVE\nUP, 1, 3\n"}) {
    SCOPED_TRACE(removal);
    const DeckRun run = run_with(removal);
    EXPECT_NEAR(run.displacement(5, 0).z(), 0.02, 1e-12);
    EXPECT_NEAR(run.displacement(15, 0).z(), 0.02, 1e-12);
    EXPECT_NEAR(run.displacement(5, 1).z(), 0.04, 1e-12);
    EXPECT_NEAR(run.displacement(15, 1).z(), 0, 1e-12);
  }
}

TEST(InpBodyChanges, StressesAndPlasticStrainsAtFirst) {
  const auto held = [](const std::string& initial) {
    return run_deck(two + "*INITIAL CONDITIONS, TYPE=" + initial + pull(0)).reaction_of("LOW").z();
  };
  EXPECT_NEAR(held("STRESS\nA, 0., 0., 50., 0., 0., 0.\n"), -50, 1e-12);
  std::string points = "STRESS\n", strains = "PLASTIC STRAIN\n";
  for (int p = 1; p <= 4; ++p)  // the lower four: half of the cube
    points += "2, " + std::to_string(p) + ", 0., 0., 50., 0., 0., 0.\n";
  for (int p = 1; p <= 8; ++p) strains += "2, " + std::to_string(p) + ", 0., 0., .01, 0., 0., 0.\n";
  EXPECT_NEAR(held(points), -25, 1e-12);
  EXPECT_NEAR(held(strains), 10, 1e-12);
}

/// CalculiX gives points of the solid that a plane element is there: those of one layer count.
TEST(InpBodyChanges, StressesAtPointsOfPlaneElements) {
  const auto translated = [](const std::string& type, const std::string& initial) {
    return to_yaml(
        translate_deck(
            "*NODE, NSET=N\n1, 0, 0\n2, 2, 0\n3, 2, 1\n4, 0, 1\n5, 1, 0\n6, 2, .5\n7, 1, 1\n8, 0, "
            ".5\n*ELEMENT, TYPE=" +
                type + ", ELSET=E\n1, 1, 2, 3, 4" + (type[3] == '8' ? ", 5, 6, 7, 8" : "") +
                "\n*MATERIAL, NAME=M\n*ELASTIC\n1000., 0.3\n*SOLID SECTION, ELSET=E, "
                "MATERIAL=M\n1.\n"
                "*INITIAL CONDITIONS, TYPE=STRESS\n" +
                initial + "*STEP\n*STATIC\n*BOUNDARY\nN, 1, 2\n*END STEP\n",
            "deck.inp")
            .root);
  };
  const auto lines = [](int count, int layer) {
    std::string text;
    for (int p = 0; p < count; ++p)
      text += fmt::format("1, {}, {}., 0., 0., {}., 0., 0.\n", p + 1, p % layer + 1, p % layer);
    return text;
  };
  const std::string reduced = translated("CPE8R", lines(8, 4));
  EXPECT_NE(reduced.find("    points:\n      - [1, 0, 0, 0]\n      - [2, 0, 0, 1]\n      - [3, 0, "
                         "0, 2]\n      - [4, 0, 0, 3]\nsteps:"),
            std::string::npos)
      << reduced;
  EXPECT_NE(translated("CPE8", lines(27, 9)).find("- [9, 0, 0, 8]\nsteps:"), std::string::npos);
  EXPECT_NE(translated("CPE4R", "1, 1, 5., 0, 0, 0, 0, 0\n").find("- [5, 0, 0, 0]\nsteps:"),
            std::string::npos);
  const auto refused = [&](const std::string& type, const std::string& initial) -> std::string {
    try {
      (void)translated(type, initial);
    } catch (const core::InputError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_EQ(refused("CPE8R", lines(8, 8)),
            "deck.inp:17: *INITIALCONDITIONS: 'element 1': point 5 is at the place of point 1 of a "
            "plane element, and has other values");
  EXPECT_EQ(refused("CPE8R", lines(9, 4)),
            "deck.inp:17: *INITIALCONDITIONS: 'element 1': its elements have 8 points in CalculiX, "
            "not 9");
  EXPECT_EQ(refused("CPE8R", "1, 1, 5., 0, 0, 0, 1., 0\n"),
            "deck.inp:18: plane elements have no components xz and yz");
}

/// A wedge whose section shrinks by half over its height: the first of two points lies below, where
/// the triangle has (1 - (1 - 1 / sqrt 3) / 4) of its length.
TEST(InpBodyChanges, StressesAtPointsOfWedges) {
  const DeckRun run = run_deck(
      "*NODE, NSET=N\n1, 0, 0, 0\n2, 3, 0, 0\n3, 0, 3, 0\n4, .5, .5, 1\n5, 2, .5, 1\n6, .5, 2, "
      "1\n*ELEMENT, TYPE=C3D6, ELSET=E\n1, 1, 2, 3, 4, 5, 6\n*NSET, NSET=LOW\n1, 2, 3\n"
      "*MATERIAL, NAME=M\n*ELASTIC\n1000., 0.3\n*SOLID SECTION, ELSET=E, MATERIAL=M\n"
      "*INITIAL CONDITIONS, TYPE=STRESS\n1, 1, 0., 0., 50., 0., 0., 0.\n"
      "*STEP\n*STATIC\n*BOUNDARY\nN, 1, 3\n*END STEP\n");
  const double side = 1 - (1 - 1 / std::sqrt(3.0)) / 4;
  EXPECT_NEAR(run.reaction_of("LOW").z(), -50 * 4.5 * side * side / 2, 1e-12);
}

TEST(InpBodyChanges, PointsOfBeamsHaveAnotherOrder) {
  std::string message;
  try {
    (void)translate_deck(
        "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 2, 0, 0\n*ELEMENT, TYPE=B32R, ELSET=E\n1, 1, 2, 3\n"
        "*MATERIAL, NAME=M\n*ELASTIC\n1000., 0.3\n*BEAM SECTION, ELSET=E, MATERIAL=M, "
        "SECTION=RECT\n1., 1.\n0., 0., 1.\n*INITIAL CONDITIONS, TYPE=STRESS\n"
        "1, 1, 5., 0., 0., 0., 0., 0.\n*STEP\n*STATIC\n*END STEP\n",
        "deck.inp");
  } catch (const core::InputError& error) {
    message = error.what();
  }
  EXPECT_EQ(message,
            "deck.inp:13: *INITIALCONDITIONS: points of B32R are not supported, which have another "
            "order here: give one value");
}

/// What held a body goes: the body is named, and how it may move.
TEST(InpBodyChanges, ABodyThatIsFreeWithoutThemIsNamed) {
  const std::string path = ::testing::TempDir() + "osculate_free_body.inp";
  std::ofstream(path)
      << "*NODE\n" + cube_nodes(1, {0, 0, 0}) + cube_nodes(11, {0, 0, 1}) +
             "*ELEMENT, TYPE=C3D8, ELSET=FOOT\n1, 1, 2, 3, 4, 5, 6, 7, 8\n"
             "*ELEMENT, TYPE=C3D8, ELSET=TIP\n2, 5, 6, 7, 8, 15, 16, 17, 18\n"
             "*NSET, NSET=LOW\n1, 2, 3, 4\n*MATERIAL, NAME=M\n*ELASTIC\n1000., 0.\n"
             "*SOLID SECTION, ELSET=FOOT, MATERIAL=M\n*SOLID SECTION, ELSET=TIP, "
             "MATERIAL=M\n*BOUNDARY\nLOW, 1, 3\n"
             "*STEP\n*STATIC\n*CLOAD\n15, 3, 1.\n*END STEP\n"
             "*STEP\n*STATIC\n*MODEL CHANGE, TYPE=ELEMENT, REMOVE\nFOOT\n*END STEP\n";
  const AnyBuilt built = build_any_file(path);
  std::remove(path.c_str());
  const Built3& b = std::get<Built3>(built);
  const model::AnalysisResult3 result = model::run(b.model, b.options, {});
  EXPECT_NE(result.outcome, solve::Outcome::converged);
  EXPECT_NE(result.message.find("body 'TIP' is free to move along (1.0000, 0.0000, 0.0000)"),
            std::string::npos)
      << result.message;
}

TEST(InpBodyChanges, AreRefusedWithTheReason) {
  const auto refused = [](const std::string& card) -> std::string {
    try {
      (void)translate_deck(two + pull(0.1, card), "deck.inp");
    } catch (const core::InputError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_EQ(refused("*MODEL CHANGE, TYPE=ELEMENT\nB\n"),
            "deck.inp:39: *MODELCHANGE: expected ADD or REMOVE");
  EXPECT_EQ(refused("*MODEL CHANGE, TYPE=ELEMENT, ADD=NEW\nB\n"),
            "deck.inp:39: *MODELCHANGE: expected ADD, ADD=STRAIN FREE or ADD=WITH STRAIN");
  EXPECT_EQ(refused("*EQUATION, REMOVE\n5, 7\n"), "deck.inp:40: 'node 5' has no direction 7");
  EXPECT_EQ(refused("*INITIAL CONDITIONS, TYPE=STRESS, USER\n"),
            "deck.inp:39: *INITIALCONDITIONS: the parameter USER is not supported");
  EXPECT_EQ(
      refused("*INITIAL CONDITIONS, TYPE=STRESS\nA, 1., 2.\n"),
      "deck.inp:40: expected an element, a point and 6 components (CalculiX), or an element or "
      "a set and 6 components");
}

}  // namespace
}  // namespace osculate::deck
