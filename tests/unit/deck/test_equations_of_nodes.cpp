// Equations for each node of sets, in model files.
#include <gmock/gmock.h>

#include "osculate/core/error.hpp"
#include "system_test.hpp"

namespace osculate::deck {
namespace {

/// Two squares of unit edges beside each other, of 2 by 2 and 1 by 1 cells.
std::string squares(const std::string& equation) {
  return "osculate: 1\nmesh: {generate: {a: {box: {x: [0, 1], y: [0, 1], elements: [2, 2]}},\n"
         "  b: {box: {x: [2, 3], y: [0, 1], elements: [1, 1]}}}}\n"
         "materials: {m: {linear_elastic: {E: 100, nu: 0}}}\n"
         "sections: [{on: [a, b], material: m, element: plane_strain}]\nequations: [" +
         equation +
         "]\nsteps: [{name: one, prescribe: [{on: a.bottom, ux: 0, uy: 0}, {on: b.bottom, ux: 0, "
         "uy: 0}], forces: [{on: a.top_left, fy: 1}]}]\n";
}

TEST(EquationsOfNodes, EachNodeFollows) {
  const Built built = build_text(
      squares("{terms: [{on: a.top, of: uy, factor: 1}, {on: a.top_right, of: uy, factor: -1}], "
              "for_each_node: true}"));
  // of the three the last one is to move as itself, which is no equation
  ASSERT_EQ(built.model.equations.size(), 2U);
  for (const model::Equation& e : built.model.equations) EXPECT_EQ(e.terms.size(), 2U);
  const Built sum = build_text(
      squares("{terms: [{on: a.top, of: uy, factor: 1}, {on: a.top_right, of: uy, factor: -2}]}"));
  ASSERT_EQ(sum.model.equations.size(), 1U);
  EXPECT_EQ(sum.model.equations[0].terms.size(), 3U);
}

TEST(EquationsOfNodes, SetsHaveAsManyNodesAsTheFirstOrOne) {
  const auto message = [](const std::string& equation) {
    try {
      (void)build_text(squares(equation));
    } catch (const core::InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_THAT(message("{terms: [{on: a.top, of: uy, factor: 1}, {on: b.top, of: uy, factor: -1}], "
                      "for_each_node: true}"),
              ::testing::HasSubstr("expected one node, or as many as 'a.top' has, which are 3: "
                                   "'b.top' has 2"));
  EXPECT_THAT(message("{terms: [{on: a.top_left, of: uy, factor: 1}, {on: a.top_left, of: uy, "
                      "factor: -1}], value: 1, for_each_node: true}"),
              ::testing::HasSubstr("the terms of a node cancel out"));
}

}  // namespace
}  // namespace osculate::deck
