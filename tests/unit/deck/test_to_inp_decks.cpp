// Decks written anew: whose shells, beams and plane elements become solids, and with what model
// files say otherwise.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "deck_test.hpp"
#include "osculate/deck/inp_translate.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/deck/to_inp.hpp"

namespace osculate::deck {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// Two plates at a right angle, with a beam of B32R and a solid in the air.
const std::string plates =
    "*NODE, NSET=N\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, 1, 0, 1\n6, 1, 1, 1\n"
    "11, 5, 0, 0\n12, 6, 0, 0\n13, 6, 1, 0\n14, 5, 1, 0\n15, 5, 0, 1\n16, 6, 0, 1\n17, 6, 1, 1\n"
    "18, 5, 1, 1\n21, 9, 0, 0\n22, 10, 0, 0\n23, 11, 0, 0\n*ELEMENT, TYPE=S4R, ELSET=E\n"
    "1, 1, 2, 3, 4\n2, 2, 5, 6, 3\n*ELEMENT, TYPE=C3D8, ELSET=B\n3, 11, 12, 13, 14, 15, 16, 17, "
    "18\n*ELEMENT, TYPE=B32R, ELSET=L\n4, 21, 22, 23\n*NSET, NSET=ENDS\n1, 4\n*ELSET, "
    "ELSET=ONE\n1\n*MATERIAL, NAME=M\n"
    "*ELASTIC\n1000., 0.3\n*DENSITY\n2.\n*SHELL SECTION, ELSET=E, MATERIAL=M, OFFSET=0.5\n0.1\n"
    "*SOLID SECTION, ELSET=B, MATERIAL=M\n*BEAM SECTION, ELSET=L, MATERIAL=M, SECTION=RECT\n0.1, "
    "0.2\n0, 0, 1\n*BOUNDARY\nENDS, 1, 6\n21, 1, 6\n11, 1, 3\n12, 2, 3\n14, 3\n*STEP\n*STATIC\n"
    "*DLOAD\n1, P, 2.\nE, GRAV, 3., 0., 0., -1.\n*DLOAD\nB, P2, 1.\n*CLOAD\n23, 5, 0.2\n5, 2, 1.\n"
    "*NODE FILE\nU\n*EL PRINT, ELSET=E\nS\n*NODE PRINT, NSET=ENDS\nRF\n*END STEP\n";

class ToInpDecks : public ::testing::Test {
 protected:
  Description description_of(const std::string& text) {
    std::ofstream(path_) << text;
    return parse_model(translate_deck(text, path_).root, path_);
  }
  static std::string anew(const Description& description) {
    return write_deck(description, build_any(description, load_mesh(description))).text;
  }
  std::string refusal_of(const Description& description) {
    try {
      (void)anew(description);
    } catch (const core::InputError& error) {
      return error.what();
    }
    return "no error";
  }
  // Tests of a case run beside each other.
  std::string path_ = ::testing::TempDir() + "osculate_given_" +
                      ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".inp";
};

TEST_F(ToInpDecks, ElementsAreThoseOfTheDeck) {
  const std::string text = anew(description_of(plates));
  EXPECT_THAT(text, HasSubstr("*ELEMENT, TYPE=S4R, ELSET=E\n1, 1, 2, 3, 4\n2, 2, 5, 6, 3\n"));
  EXPECT_THAT(text, HasSubstr("*ELEMENT, TYPE=B32R, ELSET=L\n4, 21, 22, 23\n"));
  EXPECT_THAT(text, HasSubstr("*SHELL SECTION, ELSET=E, MATERIAL=M, OFFSET=0.5\n0.1\n"));
  EXPECT_THAT(text, HasSubstr("*BEAM SECTION, ELSET=L, MATERIAL=M, SECTION=RECT\n0.1, 0.2\n"));
  EXPECT_THAT(text, AllOf(Not(HasSubstr("C3D8R")), Not(HasSubstr("C3D20"))));
  EXPECT_THAT(text, AllOf(HasSubstr("ENDS, 4, 4, 0\n"), HasSubstr("\n21, 6, 6, 0\n")));
  EXPECT_THAT(text, HasSubstr("*CLOAD\n23, 5, 0.2\n"));
  EXPECT_THAT(text, HasSubstr("TYPE=ELEMENT\n1, S1\n"));  // P of a shell pushes its lower side
  EXPECT_THAT(text, HasSubstr("*DLOAD\nE, GRAV, 3, 0, 0, -3\n"));
  EXPECT_THAT(text, HasSubstr("*EL PRINT, ELSET=E\nS\n*END STEP"));
}

TEST_F(ToInpDecks, ReadAgainItIsTheSameModel) {
  for (const bool finite : {false, true}) {
    const std::string deck = finite ? edited(plates, "*STEP\n", "*STEP, NLGEOM\n") : plates;
    const Description before = description_of(deck);
    const std::string text = anew(before);
    const Description after = description_of(text);
    const std::string again = anew(after);
    ASSERT_EQ(after.sections.size(), 3U);
    for (std::size_t s = 0; s < 3; ++s) {
      EXPECT_EQ(after.sections[s].on.value, before.sections[s].on.value);
      EXPECT_EQ(after.sections[s].formulation.value, before.sections[s].formulation.value);
    }
    EXPECT_EQ(after.rigid.size(), before.rigid.size());
    EXPECT_EQ(after.rigid.size(), finite ? 2U : 0U);  // the knots at nodes 2 and 3
    const auto sum = [](const Description& d) {
      double all = 0;
      for (const Load& load : d.steps[0].forces)
        for (const auto& value : load.values) all += value ? value->value : 0;
      return all;
    };
    EXPECT_NEAR(sum(after), sum(before), 1e-14);
    EXPECT_EQ(anew(description_of(again)), again);  // and so on
  }
}

TEST_F(ToInpDecks, WhatBecameOtherwiseIsRefused) {
  Description held = description_of(plates);
  held.steps[0].prescribe.pop_back();
  while (!held.steps[0].prescribe.empty() &&
         held.steps[0].prescribe.back().on.value.starts_with("rotations"))
    held.steps[0].prescribe.pop_back();
  EXPECT_THAT(refusal_of(held), HasSubstr("depends on the supports, the moments and NLGEOM"));
  Description full = description_of(plates);
  full.sections[0].formulation.value = Formulation::full;
  EXPECT_THAT(refusal_of(full), HasSubstr("'E' has another `formulation` or `kinematics`"));
  Description part = description_of(plates);
  part.sections[0].on.value = "ONE";
  EXPECT_THAT(refusal_of(part), HasSubstr("is no set of a section of the deck"));
}

TEST_F(ToInpDecks, LayersHaveTheirMaterials) {
  const std::string deck =
      edited(edited(edited(plates, "*SHELL SECTION, ELSET=E, MATERIAL=M, OFFSET=0.5\n0.1\n",
                           "*MATERIAL, NAME=K\n*ELASTIC\n2000., 0.3\n*SHELL SECTION, ELSET=E, "
                           "COMPOSITE\n0.1, 3, M\n0.2, 3, K\n"),
                    "*ELEMENT, TYPE=S4R, ELSET=E\n1, 1, 2, 3, 4\n2, 2, 5, 6, 3\n",
                    "*ELEMENT, TYPE=S6, ELSET=E\n1, 1, 2, 3, 7, 8, 9\n"),
             "*NODE, NSET=N\n", "*NODE, NSET=N\n7, .5, 0, 0\n8, 1, .5, 0\n9, .5, .5, 0\n");
  const std::string text =
      edited(edited(deck, "ENDS\n1, 4\n", "ENDS\n1\n"), "5, 2, 1.\n", "2, 2, 1.\n");
  EXPECT_THAT(anew(description_of(edited(text, "E, GRAV, 3., 0., 0., -1.\n", ""))),
              HasSubstr("*SHELL SECTION, ELSET=E, COMPOSITE\n0.1, 3, M\n0.2, 3, K\n"));
}

TEST_F(ToInpDecks, PlaneElementsBesideSolids) {
  const std::string deck =
      "*NODE, NSET=N\n1, 1, 0, 0\n2, 2, 0, 0\n3, 2, 1, 0\n4, 1, 1, 0\n11, 5, 0, 0\n12, 6, 0, 0\n"
      "13, 6, 1, 0\n14, 5, 1, 0\n15, 5, 0, 1\n16, 6, 0, 1\n17, 6, 1, 1\n18, 5, 1, 1\n"
      "*ELEMENT, TYPE=CAX4, ELSET=R\n1, 1, 2, 3, 4\n*ELEMENT, TYPE=C3D8, ELSET=B\n"
      "3, 11, 12, 13, 14, 15, 16, 17, 18\n*MATERIAL, NAME=M\n*ELASTIC\n1000., 0.3\n"
      "*SOLID SECTION, ELSET=R, MATERIAL=M\n*SOLID SECTION, ELSET=B, MATERIAL=M\n*BOUNDARY\n1, 2\n"
      "11, 1, 3\n12, 2, 3\n14, 3\n*STEP\n*STATIC\n*DLOAD\nR, P4, 2.\n*CLOAD\n3, 2, 90.\n"
      "*NODE FILE, OUTPUT=3D\nU\n*END STEP\n";
  const Description before = description_of(deck);
  EXPECT_EQ(before.steps[0].forces[0].values[1]->value, 0.5);  // of a sector
  const std::string text = anew(before);
  EXPECT_THAT(text, HasSubstr("*ELEMENT, TYPE=CAX4, ELSET=R\n1, 1, 2, 3, 4\n"));
  EXPECT_THAT(text, HasSubstr("*CLOAD\n3, 2, 90\n"));
  EXPECT_THAT(text, HasSubstr("TYPE=ELEMENT\n1, S4\n"));  // an edge of the deck
  EXPECT_THAT(text, HasSubstr("*NODE FILE, OUTPUT=3D\nU\n"));
  EXPECT_THAT(anew(description_of(edited(deck, ", OUTPUT=3D", ""))),
              HasSubstr("*NODE FILE, OUTPUT=2D\nU\n"));
}

/// Two cells on top of each other, the upper one of which is number 2.
const std::string bolt =
    "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, 0, 0, 1\n6, 1, 0, 1\n7, 1, 1, 1\n"
    "8, 0, 1, 1\n9, 0, 0, 2\n10, 1, 0, 2\n11, 1, 1, 2\n12, 0, 1, 2\n99, 0, 0, 9\n"
    "*ELEMENT, TYPE=C3D8, ELSET=E\n1, 1, 2, 3, 4, 5, 6, 7, 8\n2, 5, 6, 7, 8, 9, 10, 11, 12\n"
    "*NSET, NSET=LOW\n1, 2, 3, 4\n*NSET, NSET=TOP\n9, 10, 11, 12\n*MATERIAL, NAME=M\n*ELASTIC\n"
    "1000., 0.3\n*SOLID SECTION, ELSET=E, MATERIAL=M\n*BOUNDARY\nLOW, 1, 3\n";

TEST_F(ToInpDecks, PretensionKeepsItsSideAndSign) {
  for (const char* const cards :
       {"*SURFACE, NAME=CUT\n2, S1\n*PRE-TENSION SECTION, SURFACE=CUT, NODE=99\n",
        "*SURFACE, NAME=CUT\n1, S2\n*PRE-TENSION SECTION, SURFACE=CUT, NODE=99\n0., 0., -2.\n"}) {
    const Description before = description_of(
        bolt + cards + "*BOUNDARY\nTOP, 1, 3\n*STEP\n*STATIC\n*CLOAD\n99, 1, 5.\n*END STEP\n");
    const std::string text = anew(before);
    EXPECT_THAT(text, HasSubstr("*PRE-TENSION SECTION, SURFACE=CUT_ahead, NODE=99\n"));
    EXPECT_THAT(text, Not(HasSubstr("\n13, ")));  // the cut's own nodes
    const Description after = description_of(text);
    ASSERT_EQ(after.pretension.size(), 1U);
    EXPECT_EQ(after.pretension[0].axis->value, before.pretension[0].axis->value.normalized());
    EXPECT_EQ(after.steps[0].forces[0].values[0]->value,
              before.steps[0].forces[0].values[0]->value);
  }
}

TEST_F(ToInpDecks, CouplingsOfMeanMotionsAndOfSomeDirections) {
  const std::string step = "*STEP\n*STATIC\n*CLOAD\n99, 4, 5.\n*END STEP\n";
  for (const char* const kind : {"*DISTRIBUTING\n1, 3\n", "*KINEMATIC\n1, 1\n3, 3\n"}) {
    const std::string text = anew(description_of(
        bolt + "*SURFACE, NAME=S\n2, S2\n*COUPLING, REF NODE=99, SURFACE=S, CONSTRAINT NAME=C\n" +
        kind + step));
    EXPECT_THAT(text, HasSubstr("*COUPLING, CONSTRAINT NAME=coupling_1, REF NODE=99, SURFACE=S\n" +
                                std::string(kind)));
    EXPECT_THAT(text, HasSubstr("*CLOAD\n99, 4, 5\n"));
    EXPECT_EQ(anew(description_of(text)), text);
  }
}

TEST_F(ToInpDecks, StressesOfPointsAndForcesThroughSections) {
  std::string lines;
  for (int p = 1; p <= 8; ++p) lines += "2, " + std::to_string(p) + ", 1, 2, 3, 4, 5, 6\n";
  const std::string text = anew(description_of(
      bolt + "*SURFACE, NAME=CUT\n1, S2\n*INITIAL CONDITIONS, TYPE=STRESS\n" + lines +
      "*STEP\n*STATIC\n*SECTION PRINT, SURFACE=CUT, NAME=CUT\nSOF\n" + "*END STEP\n"));
  EXPECT_THAT(text, HasSubstr("*INITIAL CONDITIONS, TYPE=STRESS\n" + lines));
  EXPECT_THAT(text, HasSubstr("*SURFACE, NAME=CUT, TYPE=ELEMENT\n1, S2\n"));  // inside, that side
}

TEST_F(ToInpDecks, RequestsEndWhereALaterStepHasNone) {
  const std::string text =
      anew(description_of(
          bolt + "*SURFACE, NAME=END\n2, S2\n*STEP\n*STATIC\n*NODE FILE\nU\n"
                 "*NODE PRINT, NSET=TOP\nU, S\n"
                 "*SECTION PRINT, SURFACE=END, NAME=END\nSOF\n*END STEP\n"
                 "*STEP\n*STATIC\n*NODE FILE\n*SECTION PRINT, SURFACE=END, NAME=END, FREQUENCY=0\n"
                 "*END STEP\n"));
  const std::size_t second = text.rfind("*STEP");
  EXPECT_THAT(text.substr(0, second), Not(HasSubstr("*EL PRINT")));  // of nodes there are none
  EXPECT_THAT(text.substr(second), HasSubstr("*NODE FILE, FREQUENCY=0\n"));
  EXPECT_THAT(text.substr(second),
              HasSubstr("*SECTION PRINT, SURFACE=END, NAME=END, FREQUENCY=0\n*END STEP"));
  EXPECT_THAT(text.substr(second), HasSubstr("*NODE PRINT, NSET=TOP\nU\n"));
}

}  // namespace
}  // namespace osculate::deck
