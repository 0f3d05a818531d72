#include "osculate/deck/search_doc.hpp"

#include <gmock/gmock.h>

#include <array>

namespace osculate::deck {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

constexpr std::array<Page, 2> pages{
    {{"limits", "# Limits\n| plasticity, creep | not available |\nlast line about bolts"},
     {"laws", "Nothing of the kind\n"}}};

TEST(SearchDoc, AWordOfAChoice) {
  EXPECT_THAT(search_model(pages, "axisymmetric"), HasSubstr("  sections[].element: axisymmetric"));
}

TEST(SearchDoc, WhatIsNotThereIsSaidToBeMissing) {
  for (const char* const word : {"damage", "Gasket", "gaskets", "shells", "conduction"})
    EXPECT_THAT(
        search_model(pages, word),
        StartsWith(std::string("'") + word + "': not available: see `osculate doc limits`"));
}

TEST(SearchDoc, WhatIsCalledOtherwiseHere) {
  EXPECT_THAT(search_model(pages, "interference"), HasSubstr("contact.initial: ramp"));
  EXPECT_THAT(search_model(pages, "plasticity"), HasSubstr("materials.elastoplastic"));
  EXPECT_THAT(search_model(pages, "boundary condition"), HasSubstr("steps.prescribe"));
}

TEST(SearchDoc, LinesOfPages) {
  EXPECT_THAT(search_model(pages, "creep"),
              HasSubstr("Pages:\n  docs/limits.md: | plasticity, creep | not available |\n"));
  EXPECT_THAT(search_model(pages, "ABOUT bolts"), HasSubstr("last line about bolts"));
  EXPECT_THAT(search_model(pages, "creep"), Not(HasSubstr("laws.md")));
}

TEST(SearchDoc, SentencesOfKeys) {
  EXPECT_THAT(search_model(pages, "young"), HasSubstr("materials.NAME.linear_elastic.E"));
}

TEST(SearchDoc, NothingFound) {
  EXPECT_EQ(search_model(pages, "xyzzy"), "");
  EXPECT_EQ(search_model(pages, " "), "");
}

}  // namespace
}  // namespace osculate::deck
