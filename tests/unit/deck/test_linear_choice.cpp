#include "osculate/deck/linear_choice.hpp"

#include <gtest/gtest.h>

#include "deck_test.hpp"

namespace osculate::deck {
namespace {

struct Block {
  std::string height = "1";
  std::string material = "linear_elastic: {E: 200, nu: 0.3}";
  std::string more = "";  ///< parts of the model
};

Built3 built_of(const Block& block) {
  const Description d = parse_model(
      R"(osculate: 1
mesh: {generate: {c: {box: {x: [0, 1], y: [0, 1], z: [0, )" +
          block.height + R"(], elements: [6, 6, 6]}}}}
materials: {s: {)" +
          block.material + R"(}}
sections: [{on: c, material: s, element: solid}]
steps: [{name: pull, increments: 1, prescribe: [{on: c.bottom, ux: 0, uy: 0, uz: 0}, {on: c.top, uz: 0.01}]}]
)" + block.more,
      "model.yaml");
  return build3(d, load_mesh(d));
}

Built3 cube(const std::string& solver) { return built_of({.more = solver}); }

bool iterates(const Built3& built) { return built.options.linear_solver()->asks_for_places(); }

TEST(LinearChoice, FactorsByDefault) {
  Built3 built = cube("");
  EXPECT_FALSE(iterates(built));
  EXPECT_EQ(built.linear_note, "");
  choose_linear_solver(Linear::automatic, {.memory = 0}, built);  // a machine that does not say
  EXPECT_FALSE(iterates(built));
}

TEST(LinearChoice, MultigridWhereFactorsDoNotFit) {
  Built3 built = cube("");
  choose_linear_solver(Linear::automatic, {.memory = 1e4}, built);
  EXPECT_TRUE(iterates(built));
  EXPECT_NE(built.linear_note.find("factors of the tangent would take about"), std::string::npos);
}

TEST(LinearChoice, MultigridWhereFactorsHaveManyEntries) {
  Built3 built = cube("");
  choose_linear_solver(Linear::automatic, {.entries = 1e3}, built);
  EXPECT_TRUE(iterates(built));
  EXPECT_NE(built.linear_note.find("entries"), std::string::npos);
}

// Of compact bodies, but for those that multigrid takes long for.
TEST(LinearChoice, MultigridWhereAnUnknownHasManyEntries) {
  Built3 steel = cube(""), rubber = built_of({.material = "linear_elastic: {E: 200, nu: 0.499}"});
  for (Built3* const built : {&steel, &rubber})
    choose_linear_solver(Linear::automatic, {.anything = 10}, *built);
  EXPECT_TRUE(iterates(steel));
  EXPECT_FALSE(iterates(rubber));
}

// Smaller compact bodies, too, where more changes than a few unknowns.
TEST(LinearChoice, MultigridForSmallerCompactBodiesThatChange) {
  const std::string neo_hooke = "neo_hooke: {E: 200, nu: 0.3}";
  const auto chosen = [](const Block& block, double exact = 1) {
    Built3 built = built_of(block);
    choose_linear_solver(Linear::automatic, {.compact = 10, .exact = exact}, built);
    return iterates(built);
  };
  EXPECT_TRUE(chosen({.material = neo_hooke}));
  EXPECT_FALSE(chosen({.height = "0.05", .material = neo_hooke}));
  EXPECT_FALSE(chosen({}));  // nothing changes: its factors serve for all of the steps
  const auto held_by = [](const std::string& slave) {
    return "rigid: {ground: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}}}\n"
           "contact: [{name: c, master: ground, slave: " +
           slave + ", weight: node, normal: {penalty: 1000}}]\n";
  };
  EXPECT_TRUE(chosen({.more = held_by("c")}));
  EXPECT_FALSE(chosen({.more = held_by("c")}, 0.6));  // 218 of 343 nodes are of contact
  EXPECT_TRUE(chosen({.more = held_by("c")}, 0.65));
  EXPECT_FALSE(chosen({.more = held_by("c.bottom_front_left")}));  // the others are eliminated once
}

TEST(LinearChoice, AsAskedFor) {
  Built3 direct = cube("solver: {linear: direct}\n");
  choose_linear_solver(Linear::direct, {.memory = 1e4, .entries = 1}, direct);
  EXPECT_FALSE(iterates(direct));
  const Built3 multigrid = cube("solver: {linear: multigrid}\n");
  EXPECT_TRUE(iterates(multigrid));
  EXPECT_EQ(multigrid.linear_note, "multigrid");
}

}  // namespace
}  // namespace osculate::deck
