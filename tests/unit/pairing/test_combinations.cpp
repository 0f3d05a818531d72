#include "osculate/pairing/combinations.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "osculate/contact/law/catalogue.hpp"
#include "osculate/core/error.hpp"
#include "osculate/pairing/pair.hpp"
#include "pair_sample.hpp"

namespace osculate::pairing {
namespace {

std::string text_of_table() {
  std::string text;
  for (const Refusal& r : refusals())
    text += fmt::format("| {} | {} | {} |\n", name_of(r.told_at), name_of(r.other), r.why);
  return text;
}

TEST(Combinations, StandInTheDocumentationAsInTheTable) {
  std::ifstream file(OSCULATE_SOURCE_DIR "/docs/combinations.md");
  std::stringstream page;
  page << file.rdbuf();
  EXPECT_NE(page.str().find(text_of_table()), std::string::npos)
      << "the table of docs/combinations.md should be:\n"
      << text_of_table();
}

TEST(Combinations, AreRefusedInPairsAlone) {
  std::set<std::pair<Trait, Trait>> seen;
  for (const Refusal& r : refusals()) {
    EXPECT_FALSE(r.why.empty());
    EXPECT_NE(r.told_at, r.other);
    EXPECT_TRUE(seen.insert(std::minmax(r.told_at, r.other)).second) << r.why;
    Traits one;
    one.add(r.told_at);
    EXPECT_EQ(refusal(one), nullptr);
    one.add(r.other);
    ASSERT_NE(refusal(one), nullptr);
    EXPECT_EQ(refusal(one)->why, r.why);
    EXPECT_EQ(why_not(r.told_at, r.other), r.why);
  }
}

TEST(Combinations, OfAPairAreReadFromItsDefinition) {
  const auto refused = [](auto change) -> std::string {
    testing::PairSample s = testing::make_sample({});
    change(s.pair);
    try {
      prepare<2>(s.pair, s.x);
    } catch (const core::GeometryError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_EQ(refused([](PairDefinition<2>&) {}), "");
  EXPECT_EQ(refused([](PairDefinition<2>& p) {
              p.sampler = ByMortar<2>{};
              p.weight = Weight::node;
            }),
            why_not(Trait::nodal_weight, Trait::mortar));
  EXPECT_EQ(refused([](PairDefinition<2>& p) {
              p.enforcement = pairing::ByMultipliers{};
              p.residual = contact::ResidualForm::full;
            }),
            why_not(Trait::full_residual, Trait::multipliers));
  EXPECT_EQ(refused([](PairDefinition<2>& p) {
              p.enforcement = pairing::ByAugmentedLagrange{};
              p.separation = Tied<2>{};
            }),
            why_not(Trait::corrected, Trait::tied));
  for (const bool slides : {true, false})
    EXPECT_EQ(refused([&](PairDefinition<2>& p) {
                p.separation = Tied<2>{};
                p.friction = slides ? contact::FrictionLaw(contact::Coulomb{0.3, 10})
                                    : contact::FrictionLaw(contact::Rough{10});
              }),
              slides ? why_not(Trait::slides, Trait::tied) : std::string_view());
  for (const bool keeps : {true, false})
    EXPECT_EQ(refused([&](PairDefinition<2>& p) {
                p.separation = Tied<2>{1, keeps};
                p.overlap = pairing::InitialOverlap::ramped;
              }),
              keeps ? why_not(Trait::relieved_overlap, Trait::keeps_gap) : std::string_view());
}

}  // namespace
}  // namespace osculate::pairing
