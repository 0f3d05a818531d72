#include <gtest/gtest.h>

#include "osculate/deck/reduce_equations.hpp"

namespace osculate::deck {
namespace {

using model::Equation;

MarkedEquation sum(std::vector<Equation::Term> terms, double value = 0) {
  return {{std::move(terms), value}, {"model.yaml", 3, "equations[0]"}, false};
}
PrescribedCourse to(std::vector<double> values, const std::string& amplitude = {}) {
  PrescribedCourse course;
  for (const double v : values) course.steps.push_back({v, amplitude});
  return course;
}
std::vector<Equation> reduced(const std::vector<MarkedEquation>& equations,
                              const PrescribedCourses& prescribed = {}) {
  return reduced_equations(equations, prescribed, 100);
}
std::string refused(const std::vector<MarkedEquation>& equations,
                    const PrescribedCourses& prescribed = {}) {
  try {
    (void)reduced(equations, prescribed);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return {};
}
/// The factor of a dof in an equation; 0 where it is not named.
double factor(const Equation& equation, model::Dof dof) {
  for (const Equation::Term& term : equation.terms)
    if (term.dof == dof) return term.factor;
  return 0;
}

TEST(ReduceEquations, FirstDofThatIsNamedOnceIsEliminated) {
  const auto one = reduced({sum({{3, 2.0}, {5, -4.0}}, 6)});
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0].terms[0].dof, 3);
  EXPECT_EQ(one[0].terms[0].factor, 2.0);
  EXPECT_EQ(factor(one[0], 5), -4.0);
  EXPECT_EQ(one[0].value, 6.0);
  // 3 is named by both: the others go
  const auto two = reduced({sum({{3, 1.0}, {5, -1.0}}), sum({{3, 1.0}, {7, -1.0}})});
  EXPECT_EQ(two[0].terms[0].dof, 5);
  EXPECT_EQ(two[1].terms[0].dof, 7);
}

TEST(ReduceEquations, WhatIsMeantToFollowFromOthersDoes) {
  const auto follows = [](std::vector<Equation::Term> terms) {
    MarkedEquation one = sum(std::move(terms));
    one.first_leads = true;
    return one;
  };
  // 1 follows from 2 and 3 though both name it, 4 from 1: in the end from 2 and 3
  const auto two =
      reduced({follows({{1, 1.0}, {2, -0.5}, {3, -0.5}}), follows({{4, 1.0}, {1, -2.0}})});
  ASSERT_EQ(two.size(), 2u);
  EXPECT_EQ(two[0].terms[0].dof, 1);
  EXPECT_EQ(two[1].terms[0].dof, 4);
  EXPECT_EQ(factor(two[1], 1), 0.0);
  EXPECT_EQ(factor(two[1], 2), -1.0);
  // where steps prescribe the first one the largest factor leads, of equal ones the first
  const auto given =
      reduced({follows({{1, 1.0}, {2, -0.001}, {3, -0.5}, {5, -0.5}})}, {{1, to({2.0})}});
  ASSERT_EQ(given.size(), 1u);
  EXPECT_EQ(given[0].terms[0].dof, 3);
}

TEST(ReduceEquations, ChainsAndCyclesEndInWhatStays) {
  // 1 = 2, 2 = 3, 3 = 1 + 0: the last one says nothing new
  const auto chain =
      reduced({sum({{1, 1.0}, {2, -1.0}}), sum({{2, 1.0}, {3, -1.0}}), sum({{3, 1.0}, {1, -1.0}})});
  ASSERT_EQ(chain.size(), 2u);
  for (const Equation& equation : chain) {
    ASSERT_EQ(equation.terms.size(), 2u);
    EXPECT_EQ(equation.terms[1].dof, 3);
    EXPECT_EQ(equation.terms[1].factor, -1.0);
  }
  // 2 x + y = 5 and x - y = 1: both are numbers
  const auto both = reduced({sum({{1, 2.0}, {2, 1.0}}, 5), sum({{1, 1.0}, {2, -1.0}}, 1)});
  ASSERT_EQ(both.size(), 2u);
  for (const Equation& equation : both) {
    EXPECT_EQ(equation.terms.size(), 1u);
    EXPECT_NEAR(equation.value / equation.terms[0].factor, equation.terms[0].dof == 1 ? 2.0 : 1.0,
                1e-15);
  }
  EXPECT_EQ(refused({sum({{1, 1.0}, {2, -1.0}}), sum({{1, 2.0}, {2, -2.0}}, 1)}),
            "model.yaml:3: equations[0]: contradicts the equations before it");
}

TEST(ReduceEquations, PrescribedDofsStay) {
  const auto one = reduced({sum({{3, 1.0}, {5, -1.0}})}, {{3, to({0})}});
  EXPECT_EQ(one[0].terms[0].dof, 5);
  // both are told the same: nothing is left to say
  EXPECT_TRUE(reduced({sum({{3, 1.0}, {5, -1.0}})}, {{3, to({1, 2})}, {5, to({1, 2})}}).empty());
  EXPECT_TRUE(reduced({sum({{3, 1.0}, {5, -2.0}})}, {{3, to({1})}, {5, to({0.5})}}).empty());
  const std::string no =
      "model.yaml:3: equations[0]: no displacement of it is free: steps prescribe them";
  EXPECT_EQ(refused({sum({{3, 1.0}, {5, -1.0}})}, {{3, to({1, 2})}, {5, to({1, 3})}}), no);
  EXPECT_EQ(refused({sum({{3, 1.0}, {5, -1.0}})}, {{3, to({1}, "wave")}, {5, to({1})}}), no);
  EXPECT_EQ(refused({sum({{3, 1.0}, {5, -1.0}})}, {{3, to({0})}, {5, to({})}}), no);
  EXPECT_EQ(refused({sum({{3, 1.0}, {5, -1.0}}, 0.1)}, {{3, to({0})}, {5, to({0})}}), no);
}

TEST(ReduceEquations, RigidBodiesStay) {
  const auto one = reduced({sum({{103, 1.0}, {5, -1.0}})});
  EXPECT_EQ(one[0].terms[0].dof, 5);
  EXPECT_EQ(refused({sum({{103, 1.0}, {105, -1.0}})}),
            "model.yaml:3: equations[0]: no displacement of a node can be eliminated: all belong "
            "to rigid bodies");
}

}  // namespace
}  // namespace osculate::deck
