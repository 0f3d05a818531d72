// `contact: {all: ...}` and sets that touch themselves: which pairs are made, and what is refused.
#include <set>

#include "system_test.hpp"

namespace osculate::deck {
namespace {

const model::ContactPair& pair_named(const Built& built, const std::string& name) {
  for (const model::ContactPair& pair : built.model.pairs)
    if (pair.name == name) return pair;
  throw std::runtime_error("no pair " + name);
}

TEST(ContactAll, MakesThePairsOfAllBodiesButTheExcludedOnes) {
  const Built built = build_text(test_file("all.yaml"));
  std::set<std::string> names;
  for (const model::ContactPair& pair : built.model.pairs) {
    names.insert(pair.name);
    EXPECT_EQ(pair.group, "any");
  }
  EXPECT_EQ(names,
            (std::set<std::string>{"any.1-1", "any.2-2", "any.3-3", "any.1-2", "any.1-2.reversed",
                                   "any.2-3", "any.2-3.reversed", "any.1-floor", "any.2-floor"}));
  for (const char* const name : {"any.1-2", "any.1-2.reversed", "any.2-3", "any.2-3.reversed"})
    EXPECT_EQ(pair_named(built, name).definition.pass_factor, 0.5);
  const auto &there = pair_named(built, "any.1-2"), &back = pair_named(built, "any.1-2.reversed");
  EXPECT_TRUE(back.reversed);
  EXPECT_EQ(back.definition.master.facets.size(), there.definition.slave.boundary.facets.size());
  EXPECT_EQ(there.definition.master.facets.size(), back.definition.slave.boundary.facets.size());
  EXPECT_EQ(pair_named(built, "any.1-floor").definition.pass_factor, 1);
  ASSERT_EQ(built.notes.size(), 4u);
  EXPECT_EQ(built.notes[1], "body 2 is mid, 14 boundary facets");
}

// Rigid, else stiffer, else coarser, else first.
TEST(ContactAll, ChoosesTheMasterByOneRule) {
  const Built built = build_text(test_file("all.yaml"));
  EXPECT_EQ(pair_named(built, "any.1-2").note, "slave 2, master 1 (stiffer)");
  EXPECT_EQ(pair_named(built, "any.2-3").note, "slave 2, master 3 (coarser)");
  EXPECT_EQ(pair_named(built, "any.1-floor").note, "slave 1, master floor (rigid)");
  EXPECT_EQ(pair_named(built, "any.1-1").note, "body 1 with itself");
  EXPECT_TRUE(pair_named(built, "any.1-1").definition.filter.own);
  EXPECT_FALSE(pair_named(built, "any.1-2").definition.filter.own);
  EXPECT_EQ(pair_named(built, "any.1-2").definition.master.facets.size(), 10u);
  const std::string same = edited(edited(test_file("all.yaml"), "material: hard", "material: soft"),
                                  "elements: [6, 1]", "elements: [3, 1]");
  EXPECT_EQ(pair_named(build_text(same), "any.1-2").note, "slave 2, master 1 (first)");
}

/// None where the run does not come to its end.
std::vector<double> history_at_the_end(const Built& built) {
  std::vector<double> values;
  const model::AnalysisResult result =
      run_to_end(built, 1, [&](model::System& system, const model::State& state) {
        for (const model::HistoryRequest& request : built.history)
          values.push_back(model::history_value(system, built.model, state, request));
      });
  EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
  return result.outcome == solve::Outcome::converged ? values : std::vector<double>{};
}

TEST(ContactAll, HistoryOfOnePairOrOfAll) {
  const Built built = build_text(test_file("all.yaml"));
  const std::vector<double> values = history_at_the_end(built);
  ASSERT_EQ(values.size(), built.history.size());
  EXPECT_GT(values[2], 1);
  EXPECT_GT(values[1], 1);
  EXPECT_NEAR(values[0], values[1] + values[2] + values[4], 1e-9 * values[0]);
  EXPECT_GT(values[3], 0);
  // The block in the middle rests between both: what comes from above goes out below.
  EXPECT_GT(values[5], 1);
  EXPECT_NEAR(values[5], -values[6], 1e-7 * values[5]);
}

/// `all.yaml` with other keys beside `all`.
std::string beside(const std::string& of_all, const std::string& pairs, const std::string& rest) {
  return edited(
      edited(test_file("all.yaml"), "    exclude_surfaces: [[mid.left, top.left]]\n  pairs: []\n",
             of_all + pairs),
      "steps:", rest + "steps:");
}

/// Whether a node of a pair's slave touches a facet of its master.
bool sees(const model::ContactPair& pair, Index node, Index facet) {
  const std::vector<Index>& nodes = pair.definition.slave.nodes;
  const auto at = std::find(nodes.begin(), nodes.end(), node);
  EXPECT_NE(at, nodes.end());
  return !pair.definition.filter.hidden.has(static_cast<std::size_t>(at - nodes.begin()), facet);
}

/// Facets of a pair's master at this height.
std::vector<Index> facets_at(const Built& built, const model::ContactPair& pair, double y) {
  std::vector<Index> out;
  const auto& facets = pair.definition.master.facets;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    const auto on = [&](Index n) {
      return std::abs(built.model.reference[static_cast<std::size_t>(n)].y() - y) < 1e-9;
    };
    if (on(facets[f].nodes[0]) && on(facets[f].nodes[1])) out.push_back(static_cast<Index>(f));
  }
  return out;
}

// Whichever is slave, and nothing else: the nodes of the surfaces see the other facets, and other
// nodes see theirs.
TEST(ContactAll, LeavesSurfacesToOthers) {
  const std::string named = "    exclude_surfaces: [[mid.bottom, low.top]]\n";
  const std::string paired =
      "  pairs: [{name: own, master: low.top, slave: mid.bottom, normal: {penalty: 500}}]\n";
  const std::string tied = "ties: [{master: low.top, slave: mid.bottom}]\n";
  for (const std::string& text :
       {beside(named, "", ""), beside("", paired, ""), beside("", "", tied)}) {
    const Built built = build_text(text);
    const model::ContactPair& there = pair_named(built, "any.1-2");
    const std::vector<Index> top = facets_at(built, there, 1), bottom = facets_at(built, there, 0);
    ASSERT_FALSE(top.empty());
    ASSERT_FALSE(bottom.empty());
    for (const Index n : there.definition.slave.nodes) {
      const bool on = std::abs(built.model.reference[static_cast<std::size_t>(n)].y() - 1) < 1e-9;
      EXPECT_EQ(sees(there, n, top.front()), !on);
      EXPECT_TRUE(sees(there, n, bottom.front()));
    }
    const model::ContactPair& back = pair_named(built, "any.1-2.reversed");
    const std::vector<Index> low = facets_at(built, back, 1), high = facets_at(built, back, 2);
    for (const Index n : back.definition.slave.nodes) {
      const bool on = std::abs(built.model.reference[static_cast<std::size_t>(n)].y() - 1) < 1e-9;
      EXPECT_EQ(sees(back, n, low.front()), !on);
      EXPECT_TRUE(sees(back, n, high.front()));
    }
    EXPECT_TRUE(pair_named(built, "any.2-3").definition.filter.hidden.kinds.empty());
  }
}

// The force goes through the pair of its own, and not twice.
TEST(ContactAll, APairOfItsOwnCarriesAll) {
  const std::string paired =
      "  pairs: [{name: own, master: low.top, slave: mid.bottom, normal: {penalty: 1000}}]\n";
  const std::string text =
      edited(beside("", paired, ""), "{on: any.1-2, of: force_y}", "{on: own, of: force_y}");
  const Built built = build_text(text);
  const std::vector<double> values = history_at_the_end(built);
  ASSERT_EQ(values.size(), built.history.size());
  EXPECT_EQ(values[1], 0);
  EXPECT_GT(values[2], 1);
  EXPECT_NEAR(values[5], -values[6], 1e-7 * values[5]);
}

TEST(ContactAll, Refusals) {
  const std::string text = test_file("all.yaml");
  const auto expect = [](const std::string& message, const std::string& part) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  expect(build_refusal(edited(text, "[low, top]", "[low, tpo]")),
         "contact.all.exclude[0][1]: unknown body 'tpo'; known: 1, 2, 3, floor, low, mid, top");
  expect(build_refusal(beside("    exclude_surfaces: [[mid.bottom, lo.top]]\n", "", "")),
         "unknown set 'lo.top'");
  expect(
      build_refusal(beside("", "  pairs: [{name: any, master: low.top, slave: mid.bottom}]\n", "")),
      "'any'");
  expect(build_refusal(edited(text, "any.2-3, of: normal_force", "any.2-4, of: normal_force")),
         "output.history[2].on: unknown contact pair 'any.2-4'; did you mean 'any.");
}

TEST(ContactAll, TheShortFormHasTheDefaults) {
  std::string text = test_file("all.yaml");
  const std::size_t from = text.find("contact:"), to = text.find("steps:");
  const auto with = [&](const std::string& contact) {
    std::string other = text;
    other.replace(from, to - from, contact);
    return build_text(other.substr(0, other.find("output:")));
  };
  const Built brief = with("contact: all\n"), full = with("contact: {all: {}}\n");
  ASSERT_EQ(brief.model.pairs.size(), full.model.pairs.size());
  for (std::size_t p = 0; p < brief.model.pairs.size(); ++p) {
    EXPECT_EQ(brief.model.pairs[p].name, full.model.pairs[p].name);
    EXPECT_TRUE(brief.model.pairs[p].automatic);
    EXPECT_GT(contact::penalty_of(brief.model.pairs[p].definition.normal), 0);
    EXPECT_EQ(contact::penalty_of(brief.model.pairs[p].definition.normal),
              contact::penalty_of(full.model.pairs[p].definition.normal));
  }
}

TEST(SelfContact, IsAPairWhoseMasterAndSlaveAreOneSet) {
  const Built built = build_text(R"(osculate: 1
mesh: {generate: {b: {box: {x: [0, 6], y: [0, 0.5], elements: [12, 1]}}}}
materials: {m: {neo_hooke: {E: 100, nu: 0.3}}}
sections: [{on: b, material: m, element: plane_strain}]
contact: [{name: c, master: b, slave: b, normal: {penalty: 50}}]
steps: [{name: s, increments: 1, prescribe: [{on: b.left, ux: 0, uy: 0}]}]
)");
  ASSERT_EQ(built.model.pairs.size(), 1u);
  const pairing::PairDefinition<2>& pair = built.model.pairs[0].definition;
  EXPECT_TRUE(pair.filter.own);
  EXPECT_EQ(pair.slave.nodes.size(), 26u);
  EXPECT_EQ(pair.master.facets.size(), 26u);
  EXPECT_NEAR(pair.filter.distance, 8 * 0.5, 1e-12);
  for (std::size_t i = 0; i < pair.slave.nodes.size(); ++i) {
    const Vec2& x = built.model.reference[static_cast<std::size_t>(pair.slave.nodes[i])];
    if (x.x() > 0.6 && x.x() < 5.4) {
      EXPECT_NEAR(pair.filter.thickness[i], 0.5, 1e-12);
    }
  }
}

}  // namespace
}  // namespace osculate::deck
