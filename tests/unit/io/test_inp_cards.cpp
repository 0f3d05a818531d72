// Lines of Abaqus and CalculiX input files: cards, parameters, data, included files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>

#include "osculate/core/error.hpp"
#include "osculate/io/inp/cards.hpp"

namespace osculate::io::inp {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using Files = std::map<std::string, std::string>;

Deck deck_of(const Files& files) {
  return read_cards(files.at("a.inp"), "a.inp", [&](const std::string& path) {
    const auto file = files.find(path);
    if (file == files.end()) throw core::InputError({path, 0, ""}, "no such file");
    return file->second;
  });
}

std::string refusal(const Files& files) {
  try {
    (void)deck_of(files);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return {};
}

std::vector<std::string> texts(const Deck& deck, const Card& card) {
  std::vector<std::string> all;
  for (const Line& line : lines_of(deck, card)) all.emplace_back(line.text);
  return all;
}

std::string place(const Deck& deck, Place at) {
  return deck.files[at.file] + ":" + std::to_string(at.line);
}

TEST(InpCards, KeywordsAndParametersInAnyLetters) {
  const std::string content =
      "\xEF\xBB\xBF** a comment\r\n*Solid Section , ElSet=Eall, MATERIAL = \"My steel\" , "
      "nlgeom\r\n"
      "\t 1., 2. \r\n\r\n  ** another\r\n3.\r\n*SOLIDSECTION\r\n *end Step";
  const Deck deck = read_cards(content, "a.inp");
  ASSERT_EQ(deck.cards.size(), 3u);
  const Card& card = deck.cards[0];
  EXPECT_EQ(card.keyword, "SOLIDSECTION");
  EXPECT_EQ(card.keyword, deck.cards[1].keyword);
  EXPECT_EQ(deck.cards[2].keyword, "ENDSTEP");
  EXPECT_EQ(find_parameter(card, "ELSET")->value, "Eall");
  EXPECT_EQ(find_parameter(card, "MATERIAL")->value, "My steel");
  EXPECT_TRUE(find_parameter(card, "NLGEOM")->is_flag);
  EXPECT_EQ(find_parameter(card, "TYPE"), nullptr);
  EXPECT_THAT(texts(deck, card), ElementsAre("1., 2.", "3."));
  EXPECT_EQ(place(deck, card.at), "a.inp:2");
  EXPECT_EQ(place(deck, lines_of(deck, card)[1].at), "a.inp:6");
  EXPECT_EQ(place(deck, deck.cards[2].at), "a.inp:8");
}

TEST(InpCards, KeywordLinesGoOnBehindAComma) {
  const std::string content =
      "*Contact Pair, interaction=A,\n** between\n\n type=surface to surface, \nadjust=0.1\na, b\n"
      "*NODE,\n*ELEMENT,\n 1, 2\n*NSET,";
  const Deck deck = read_cards(content, "a.inp");
  ASSERT_EQ(deck.cards.size(), 4u);
  EXPECT_EQ(find_parameter(deck.cards[0], "TYPE")->value, "surfacetosurface");
  EXPECT_EQ(find_parameter(deck.cards[0], "ADJUST")->value, "0.1");
  EXPECT_THAT(texts(deck, deck.cards[0]), ElementsAre("a, b"));
  // A comma that nothing follows is just that; a line of numbers continues.
  EXPECT_EQ(deck.cards[1].keyword, "NODE");
  EXPECT_THAT(deck.cards[1].parameters, IsEmpty());
  EXPECT_EQ(deck.cards[2].parameters.size(), 2u);
  EXPECT_EQ(deck.cards[3].keyword, "NSET");
}

TEST(InpCards, FieldsOfALine) {
  const std::string content = "*A\n 1 , +2,,\"x, y\".z z, 1.5D+2 ,-.5e1, 1e-999,\n";
  const Deck deck = read_cards(content, "a.inp");
  Fields fields(deck, deck.lines[0]);
  EXPECT_EQ(fields.number("a"), 1);
  EXPECT_EQ(fields.number("b"), 2);
  EXPECT_EQ(fields.real_or_zero("c"), 0);
  EXPECT_EQ(name_of(fields.next().value()), "x, y.zz");
  EXPECT_EQ(fields.real("d"), 150);
  EXPECT_EQ(fields.real("e"), -5);
  EXPECT_FALSE(fields.done());
  EXPECT_EQ(fields.real("f"), 0);
  EXPECT_TRUE(fields.done());
  EXPECT_FALSE(fields.next());
  EXPECT_EQ(fields.real_or_zero("g"), 0);
  fields.expect_end();
}

TEST(InpCards, FieldsThatAreNoNumbers) {
  for (const char* const field :
       {"0", "-3", "2147483648", "99999999999999999999", "1.", "a", "1 2", "+-1", "", "0x10"})
    EXPECT_FALSE(number_of(field)) << field;
  EXPECT_EQ(number_of("2147483647"), 2147483647);
  for (const std::string field : {"nan", "inf", "1e999", "1..2", "x", "1 2", "--1", "+-1", "1d"}) {
    const std::string content = "*A\n" + field + "\n";
    const Deck deck = read_cards(content, "a.inp");
    EXPECT_THROW((void)Fields(deck, deck.lines[0]).real("x"), core::InputError) << field;
  }
}

TEST(InpCards, IncludedFilesStandWhereTheyAreNamed) {
  const Files files{{"a.inp", "*HEADING\n*NODE\n1, 0\n*INCLUDE, INPUT=sub/b.inp\n3, 0\n*END STEP"},
                    {"sub/b.inp", "2, 0\n*include, input = \"c d.txt\"\n**\n"},
                    {"sub/c d.txt", "*ELEMENT\n7\n"}};
  const Deck deck = deck_of(files);
  ASSERT_EQ(deck.cards.size(), 4u);
  EXPECT_THAT(texts(deck, deck.cards[1]), ElementsAre("1, 0", "2, 0"));
  EXPECT_THAT(texts(deck, deck.cards[2]), ElementsAre("7", "3, 0"));
  EXPECT_EQ(place(deck, lines_of(deck, deck.cards[1])[1].at), "sub/b.inp:1");
  EXPECT_EQ(place(deck, lines_of(deck, deck.cards[2])[0].at), "sub/c d.txt:2");
  EXPECT_EQ(place(deck, lines_of(deck, deck.cards[2])[1].at), "a.inp:5");
  EXPECT_EQ(place(deck, deck.cards[3].at), "a.inp:6");
}

TEST(InpCards, DataOfNodesAndElementsFromAnotherFile) {
  const Files files{{"a.inp", "*NODE, NSET=N, INPUT=n.txt\n3, 0\n*SUBMODEL, INPUT=none.frd\n"},
                    {"n.txt", "1, 0\n2, 0"}};
  const Deck deck = deck_of(files);
  EXPECT_THAT(texts(deck, deck.cards[0]), ElementsAre("1, 0", "2, 0", "3, 0"));
  EXPECT_EQ(deck.cards.size(), 2u);
}

TEST(InpCards, IncludesOnTheDisk) {
  const std::string folder = ::testing::TempDir() + "osculate_inp_cards/";
  std::filesystem::create_directories(folder);
  std::ofstream(folder + "b.inp") << "*NODE\n1, 0\n";
  const std::string content = "*INCLUDE, INPUT=b.inp\n";
  const Deck deck = read_cards(content, folder + "a.inp");
  EXPECT_EQ(place(deck, lines_of(deck, deck.cards[0])[0].at), folder + "b.inp:2");
  const std::string missing = "*NODE\n*INCLUDE, INPUT=none.inp\n";
  try {
    (void)read_cards(missing, folder + "a.inp");
    ADD_FAILURE();
  } catch (const core::InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              folder + "a.inp:2: *INCLUDE: " + folder + "none.inp: no such file");
  }
}

TEST(InpCards, FilesThatIncludeThemselves) {
  EXPECT_THAT(refusal({{"a.inp", "*INCLUDE, INPUT=a.inp\n"}}),
              HasSubstr("a.inp:1: *INCLUDE: the file 'a.inp' includes itself"));
  EXPECT_THAT(refusal({{"a.inp", "*INCLUDE, INPUT=b/b.inp\n"},
                       {"b/b.inp", "*A\n*INCLUDE, INPUT=../a.inp"}}),
              HasSubstr("b/b.inp:2: *INCLUDE: the file 'b/../a.inp' includes itself"));
  Files chain{{"a.inp", "*INCLUDE, INPUT=1\n"}};
  for (int k = 1; k < 100; ++k)
    chain[std::to_string(k)] = "*INCLUDE, INPUT=" + std::to_string(k + 1) + "\n";
  EXPECT_THAT(refusal(chain), HasSubstr("too many files include each other"));
  // Thirty files that each include the next one twice.
  Files twice{{"a.inp", "*INCLUDE, INPUT=1\n"}, {"30", "*A\n"}};
  for (int k = 1; k < 30; ++k) {
    const std::string next = "*INCLUDE, INPUT=" + std::to_string(k + 1) + "\n";
    twice[std::to_string(k)] = next + next;
  }
  EXPECT_THAT(refusal(twice), HasSubstr("too many files include each other"));
}

TEST(InpCards, ARestartGoesOnFromTheStepsOfAnotherDeck) {
  const std::string before =
      "*HEADING\na, \"b\"\n*INCLUDE, INPUT=c\n*MATERIAL, NAME=\"My steel, new\"\n*RESTART, "
      "WRITE\n*STEP, NLGEOM\n*STATIC\n1., 1.\n*END STEP\n*STEP\n*END STEP\n";
  const std::string written = restart_text(deck_of({{"a.inp", before}, {"c", "*NODE\n1, 2.,\n"}}));
  const auto words = [](const Deck& deck) {
    std::vector<std::string> all;
    for (const Card& card : deck.cards) {
      all.push_back(card.keyword);
      for (const Parameter& p : card.parameters) all.push_back(p.name + "=" + p.value);
      for (const std::string& text : texts(deck, card)) all.push_back(text);
    }
    return all;
  };
  const std::vector<std::string> first{
      "HEADING", "a, \"b\"", "NODE",   "1, 2.,", "MATERIAL", "NAME=My steel, new",
      "STEP",    "NLGEOM=",  "STATIC", "1., 1.", "ENDSTEP"};
  std::vector<std::string> with = first;
  with.emplace_back("STEP");
  EXPECT_EQ(words(deck_of({{"a.inp", "*RESTART, READ, STEP=1\n*STEP\n"}, {"a.rin", written}})),
            with);
  with.insert(with.end(), {"ENDSTEP", "STATIC"});
  EXPECT_EQ(words(deck_of({{"a.inp", "*RESTART, READ\n*STATIC\n"}, {"a.rin", written}})), with);
  EXPECT_THAT(refusal({{"a.inp", "*RESTART, READ, STEP=3\n*STEP\n"}, {"a.rin", written}}),
              HasSubstr("a.inp:1: *RESTART: there are 2 steps to go on from, not 3"));
  EXPECT_THAT(refusal({{"a.inp", "*NODE\n*RESTART, READ\n"}, {"a.rin", written}}),
              HasSubstr("a.inp:2: *RESTART: READ stands before all other keywords of a deck"));
  EXPECT_THAT(refusal({{"a.inp", "*RESTART, READ\n"}, {"a.rin", "*NODE\n"}}),
              HasSubstr("is no file that `osculate ccx` has written for a restart"));
  EXPECT_THAT(refusal({{"a.inp", "*RESTART, READ\n"}}), HasSubstr("no such file"));
}

TEST(InpCards, WhatIsNoDeck) {
  EXPECT_THAT(refusal({{"a.inp", ""}}), HasSubstr("a.inp: there is no keyword like '*NODE'"));
  EXPECT_THAT(refusal({{"a.inp", "** only\nhello\n"}}), HasSubstr("there is no keyword"));
  EXPECT_THAT(refusal({{"a.inp", "stray\n*NODE"}}), IsEmpty());
  EXPECT_THAT(refusal({{"a.inp", "*NODE\n*, NSET=A"}}),
              HasSubstr("a.inp:2: expected a keyword behind '*'"));
  EXPECT_THAT(refusal({{"a.inp", "*NODE, NSET=\"A"}}),
              HasSubstr("a.inp:1: a quotation mark is missing in '*NODE, NSET=\"A'"));
  EXPECT_THAT(refusal({{"a.inp", "*INCLUDE\n"}}), HasSubstr("expected 'INPUT='"));
}

}  // namespace
}  // namespace osculate::io::inp
