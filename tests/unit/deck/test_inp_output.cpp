#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "osculate/deck/inp_translate.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/io/inp.hpp"
#include "osculate/io/inp/deck_mesh.hpp"

namespace osculate::deck {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string square = R"(*NODE, NSET=ALL
1, 0, 0
2, 1, 0
3, 1, 1
4, 0, 1
*ELEMENT, TYPE=CPE4, ELSET=PART
1, 1, 2, 3, 4
*NSET, NSET=PART
1, 2
*MATERIAL, NAME=M
*ELASTIC
1., 0.
*SOLID SECTION, ELSET=PART, MATERIAL=M
)";

Description read(const std::string& steps, std::vector<std::string>* notes = nullptr) {
  const std::string text = square + steps;
  TranslatedDeck deck = translate_deck(text, "square.inp");
  if (notes) *notes = deck.notes;
  return parse_model(std::move(deck.root), "square.inp");
}

std::vector<std::string> steps_of(const AnswerRequest& request) {
  std::vector<std::string> names;
  for (const Name& step : request.steps) names.push_back(step.value);
  return names;
}

TEST(InpOutput, CardsOfFilesBecomeResultsOfTheNodes) {
  const Output output = read(
                            "*STEP\n*STATIC\n*NODE FILE\nU, RF\n*EL FILE\nS,PE,E\n*CONTACT "
                            "FILE\nCDIS,CSTR\n*END STEP\n")
                            .output;
  ASSERT_EQ(output.frd.size(), 3U);
  EXPECT_THAT(output.frd[0].of, ElementsAre(Answer::u, Answer::rf));
  EXPECT_THAT(output.frd[1].of, ElementsAre(Answer::s, Answer::peeq, Answer::e));
  EXPECT_THAT(output.frd[2].of, ElementsAre(Answer::contact));
  EXPECT_TRUE(output.frd[0].steps.empty());
  EXPECT_TRUE(output.dat.empty());
}

TEST(InpOutput, CardsOfTablesNameTheirSetAndTotals) {
  const Output output = read(
                            "*STEP\n*STATIC\n*NODE PRINT, NSET=part, TOTALS=YES\nu,rf\n"
                            "*EL PRINT, ELSET=PART, TOTALS=ONLY\nEVOL\nELSE\n*END STEP\n")
                            .output;
  ASSERT_EQ(output.dat.size(), 2U);
  EXPECT_EQ(output.dat[0].on.at(0).value, "PART.nodes");
  EXPECT_EQ(output.dat[0].totals, Totals::also);
  EXPECT_THAT(output.dat[0].of, ElementsAre(Answer::u, Answer::rf));
  EXPECT_EQ(output.dat[1].on.at(0).value, "PART");
  EXPECT_EQ(output.dat[1].totals, Totals::only);
  EXPECT_THAT(output.dat[1].of, ElementsAre(Answer::evol, Answer::energy));
}

TEST(InpOutput, ACardHoldsUntilALaterStepHasOneOfItsKind) {
  const Output output = read(
                            "*STEP\n*STATIC\n*NODE FILE\nU\n*EL FILE\nS\n*END STEP\n"
                            "*STEP\n*STATIC\n*END STEP\n"
                            "*STEP\n*STATIC\n*NODE FILE\nRF\n*END STEP\n")
                            .output;
  ASSERT_EQ(output.frd.size(), 3U);
  EXPECT_THAT(steps_of(output.frd[0]), ElementsAre("step_1", "step_2"));
  EXPECT_THAT(steps_of(output.frd[1]), ElementsAre());
  EXPECT_THAT(steps_of(output.frd[2]), ElementsAre("step_3"));
}

TEST(InpOutput, TheLastFrequencyHoldsForAllCardsAndZeroSilencesItsOwn) {
  const Output output =
      read(
          "*STEP\n*STATIC\n*NODE FILE, FREQUENCY=5\nU\n*NODE PRINT, NSET=ALL, FREQUENCY=2\nU\n"
          "*EL PRINT, ELSET=PART, FREQUENCY=0\nS\n*END STEP\n")
          .output;
  ASSERT_EQ(output.frd.size(), 1U);
  ASSERT_EQ(output.dat.size(), 1U);
  EXPECT_EQ(output.frd[0].every, 2);
  EXPECT_EQ(output.dat[0].every, 2);
}

TEST(InpOutput, ResultsThatAreNotWrittenAreToldOf) {
  std::vector<std::string> notes;
  const Output output =
      read("*STEP\n*STATIC\n*NODE FILE\nU,NT\n*EL FILE\nERR\n*END STEP\n", &notes).output;
  ASSERT_EQ(output.frd.size(), 1U);
  ASSERT_FALSE(notes.empty());
  EXPECT_EQ(notes.back(), "of the results asked for these are not written: ERR, NT");
}

TEST(InpOutput, ForcesOfSurfacesAndEnergiesOfContacts) {
  std::vector<std::string> notes;
  const Output output = read(
                            "*SURFACE, NAME=CUT\n1, S2\n*STEP\n*STATIC\n"
                            "*SECTION PRINT, SURFACE=cut, NAME=A\nSOF, SOM\nSOAREA, FLUX\n"
                            "*CONTACT PRINT, TOTALS=ONLY\nCELS\n*END STEP\n",
                            &notes)
                            .output;
  ASSERT_EQ(output.dat.size(), 2U);
  EXPECT_THAT(output.dat[0].of, ElementsAre(Answer::cels));
  EXPECT_EQ(output.dat[0].totals, Totals::only);
  EXPECT_THAT(output.dat[1].of, ElementsAre(Answer::sof));
  EXPECT_EQ(output.dat[1].on.at(0).value, "CUT");
  EXPECT_EQ(notes.back(), "of the results asked for these are not written: FLUX");
}

TEST(InpOutput, ABodyNamesTheNodesThatStandForIt) {
  const Description model = read(
      "*NODE\n5, 0.5, -1\n6, 0.5, -1\n*RIGID BODY, NSET=PART, REF NODE=5, ROT NODE=6\n*STEP\n"
      "*STATIC\n*END STEP\n");
  ASSERT_EQ(model.rigid.size(), 1U);
  EXPECT_EQ(model.rigid[0].reference_node.at(0).value, "node 5");
  EXPECT_EQ(model.rigid[0].rotation_node.at(0).value, "node 6");
}

TEST(InpSets, NodesThatDoNotExistAreLeftOutAndToldOf) {
  std::vector<std::string> notes;
  const std::string steps =
      "*NSET, NSET=SOME\n4, 29, 2\n*STEP\n*STATIC\n*NODE PRINT, NSET=SOME\nU\n*END STEP\n";
  (void)read(steps, &notes);
  ASSERT_FALSE(notes.empty());
  EXPECT_EQ(notes.front(), "line 15: node 29 of a set does not exist, and is left out");
  const std::string text = square + "*NSET, NSET=SOME\n4, 29, 2\n";
  EXPECT_EQ(io::inp::deck_mesh(io::inp::read_cards(text, "a.inp")).mesh.find_set("SOME")->nodes,
            (std::vector<Index>{1, 3}));
  EXPECT_THROW((void)io::read_inp(text, "a.inp"), core::InputError);
  EXPECT_THROW((void)read("*STEP\n*STATIC\n*BOUNDARY\n29, 1\n*END STEP\n"), core::InputError);
}

TEST(InpAmplitudes, ATimeDelayBeginsTheTableLater) {
  const Description model = read(
      "*AMPLITUDE, NAME=A\n0., 1., 1., 2., 2., 3.\n*STEP\n*STATIC\n1.5, 1.5\n"
      "*CLOAD, AMPLITUDE=A, TIME DELAY=1.\n3, 2, 4.\n*END STEP\n");
  ASSERT_EQ(model.amplitudes.size(), 1U);
  const auto& points = model.amplitudes[0].points;
  ASSERT_EQ(points.size(), 3U);
  EXPECT_EQ(points[0], std::pair(0.0, 1.0));
  EXPECT_NEAR(points[1].first, 2.0 / 3, 1e-15);
  EXPECT_EQ(points[1].second, 1.0);
  EXPECT_NEAR(points[2].second, 1.5, 1e-15);
  EXPECT_THROW((void)read("*STEP\n*STATIC\n*CLOAD, TIME DELAY=1.\n3, 2, 4.\n*END STEP\n"),
               core::InputError);
}

TEST(InpOutput, AnUnknownSetStopsWithItsLine) {
  try {
    (void)read("*STEP\n*STATIC\n*NODE PRINT, NSET=PRAT\nU\n*END STEP\n");
    FAIL() << "expected an error";
  } catch (const core::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("square.inp:16"));
    EXPECT_THAT(error.what(), HasSubstr("PRAT"));
  }
}

TEST(InpOutput, AModelFileSaysTheSame) {
  const std::string text =
      to_yaml(translate_deck(square + "*STEP\n*STATIC\n*NODE PRINT, NSET=ALL, FREQUENCY=3\n"
                                      "U\n*END STEP\n",
                             "square.inp")
                  .root);
  const Output output = parse_model(text, "square.yaml").output;
  ASSERT_EQ(output.dat.size(), 1U);
  EXPECT_EQ(output.dat[0].every, 3);
  EXPECT_EQ(output.dat[0].on.at(0).value, "ALL");
}

TEST(Answers, AForceNeedsFacetsThatItGoesThrough) {
  std::string text =
      to_yaml(translate_deck(square + "*STEP\n*STATIC\n*END STEP\n", "square.inp").root);
  text += "output: {dat: [{of: [SOF]}]}\n";
  try {
    (void)parse_model(text, "square.yaml");
    FAIL() << "expected an error";
  } catch (const core::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("SOF needs a set of facets: on"));
  }
}

TEST(Answers, AStepThatIsNotThereIsAnError) {
  std::string text =
      to_yaml(translate_deck(square + "*STEP\n*STATIC\n*END STEP\n", "square.inp").root);
  text += "output: {frd: [{of: [U], steps: [stp_1]}]}\n";
  try {
    (void)parse_model(text, "square.yaml");
    FAIL() << "expected an error";
  } catch (const core::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("did you mean 'step_1'"));
  }
}

}  // namespace
}  // namespace osculate::deck
