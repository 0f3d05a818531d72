// `*FIXED MASS SCALING` of decks.
#include <gtest/gtest.h>

#include "cube_nodes.hpp"
#include "osculate/deck/inp_translate.hpp"
#include "osculate/deck/parse.hpp"

namespace osculate::deck {
namespace {

const std::string body_of_steel = "*NODE, NSET=NALL\n" + cube_nodes(1, {0, 0, 0}) +
                                  R"(*ELEMENT, TYPE=C3D8, ELSET=CUBE
1, 1, 2, 3, 4, 5, 6, 7, 8
*MATERIAL, NAME=STEEL
*ELASTIC
210000., 0.3
*DENSITY
7.8E-9
*SOLID SECTION, ELSET=CUBE, MATERIAL=STEEL
)";

std::string model_of(const std::string& steps) {
  return to_yaml(translate_deck(body_of_steel + steps, "cube.inp").root);
}
std::string refusal_of_deck(const std::string& steps) {
  try {
    (void)parse_model(translate_deck(body_of_steel + steps, "cube.inp").root, "cube.inp");
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "no error";
}
void expect_within(const std::string& text, const std::string& what) {
  EXPECT_NE(text.find(what), std::string::npos) << what << "\nis not in\n" << text;
}

TEST(InpMassScaling, HoldsUntilAnotherOneIsSaid) {
  const auto step = [](const std::string& card, const std::string& procedure = "EXPLICIT") {
    return "*STEP\n*DYNAMIC, " + procedure + "\n1.E-5, 1.E-4\n" + card + "*END STEP\n";
  };
  const std::string by_step = step("*FIXED MASS SCALING, DT=2.E-6, TYPE=BELOW MIN\n");
  const std::string steps = model_of(by_step + step("") + step("*Fixed Mass Scaling, FACTOR=9\n") +
                                     step("*FIXED MASS SCALING, FACTOR=4, DT=1.E-6\n") +
                                     step("*FIXED MASS SCALING, FACTOR=1\n") + step(""));
  std::vector<std::string> found;
  for (std::size_t at = steps.find("scheme:"); at != std::string::npos;
       at = steps.find("scheme:", at + 1))
    found.push_back(steps.substr(at, steps.find("- name", at) - at));
  ASSERT_EQ(found.size(), 6u) << steps;
  for (const int i : {0, 1})
    expect_within(found[static_cast<std::size_t>(i)], "{stable_step: 2e-06}");
  expect_within(found[2], "{factor: 9}");
  expect_within(found[3], "{stable_step: 1e-06, factor: 4}");
  for (const int i : {4, 5})
    expect_within(found[static_cast<std::size_t>(i)], "scheme: central_differences");
  EXPECT_EQ(refusal_of_deck(by_step), "no error");
  expect_within(refusal_of_deck(step("*FIXED MASS SCALING, DT=1.E-6\n", "ALPHA=-0.1")),
                "belongs behind *DYNAMIC, EXPLICIT");
  expect_within(refusal_of_deck(step("*FIXED MASS SCALING\n")), "expected DT, FACTOR or both");
  expect_within(refusal_of_deck(step("*FIXED MASS SCALING, DT=0\n")), "expected DT above 0");
  expect_within(refusal_of_deck(step("*FIXED MASS SCALING, FACTOR=0.5\n")),
                "expected FACTOR of 1 or more");
  expect_within(refusal_of_deck(step("*FIXED MASS SCALING, DT=1E-6, TYPE=UNIFORM\n")),
                "expected TYPE=BELOW MIN");
  expect_within(refusal_of_deck(step("*FIXED MASS SCALING, DT=1E-6, ELSET=A\n")), "ELSET");
  expect_within(
      refusal_of_deck(step("*FIXED MASS SCALING, DT=1E-6\n*FIXED MASS SCALING, DT=2E-6\n")),
      "the step has one already");
  expect_within(refusal_of_deck(step("*VARIABLE MASS SCALING, DT=1E-6, FREQUENCY=10\n")),
                "masses change at the beginning of a step only");
}

}  // namespace
}  // namespace osculate::deck
