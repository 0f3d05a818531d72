#include "osculate/deck/inp_keywords.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

namespace osculate::deck {
namespace {

std::string text_of_table() {
  const auto word = [](KeywordUse use) {
    switch (use) {
      case KeywordUse::mesh:
        return "read";
      case KeywordUse::silent:
        return "no effect";
      case KeywordUse::translated:
        return "translated";
      default:
        return "not available";
    }
  };
  std::string text;
  for (const InpKeyword& k : inp_keywords())
    text += fmt::format("| `*{}` | {} | {} | {} | {} |\n", k.keyword, k.parameters, k.data,
                        word(k.use), k.here);
  return text;
}

TEST(InpKeywords, StandInTheDocumentationAsInTheTable) {
  std::ifstream file(OSCULATE_SOURCE_DIR "/docs/inp.md");
  std::stringstream page;
  page << file.rdbuf();
  EXPECT_NE(page.str().find(text_of_table()), std::string::npos)
      << "the table of docs/inp.md should be:\n"
      << text_of_table();
}

TEST(InpKeywords, AreFoundWithoutTheirBlanks) {
  std::set<std::string> seen;
  for (const InpKeyword& known : inp_keywords()) {
    std::string plain(known.keyword);
    std::erase(plain, ' ');
    EXPECT_TRUE(seen.insert(plain).second) << known.keyword;
    EXPECT_EQ(find_inp_keyword(plain), &known);
    EXPECT_EQ(find_inp_keyword(plain + "X"), nullptr);
    EXPECT_EQ(find_inp_keyword(plain.substr(1)), nullptr);
    const bool told = known.use == KeywordUse::none;
    EXPECT_FALSE(told && known.here.empty()) << known.keyword;
  }
}

}  // namespace
}  // namespace osculate::deck
