#include "osculate/deck/linear_choice.hpp"

#include <gtest/gtest.h>

#include "deck_test.hpp"

namespace osculate::deck {
namespace {

Built3 cube(const std::string& solver, const std::string& nu = "0.3") {
  const Description d = parse_model(R"(osculate: 1
mesh: {generate: {c: {box: {x: [0, 1], y: [0, 1], z: [0, 1], elements: [6, 6, 6]}}}}
materials: {s: {linear_elastic: {E: 200, nu: )" +
                                        nu + R"(}}}
sections: [{on: c, material: s, element: solid}]
steps: [{name: pull, increments: 1, prescribe: [{on: c.bottom, ux: 0, uy: 0, uz: 0}, {on: c.top, uz: 0.01}]}]
)" + solver,
                                    "model.yaml");
  return build3(d, load_mesh(d));
}

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
  Built3 steel = cube(""), rubber = cube("", "0.499");
  for (Built3* const built : {&steel, &rubber})
    choose_linear_solver(Linear::automatic, {.of_unknown = 10}, *built);
  EXPECT_TRUE(iterates(steel));
  EXPECT_FALSE(iterates(rubber));
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
