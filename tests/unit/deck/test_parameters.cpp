#include "osculate/deck/parameters.hpp"

#include <gmock/gmock.h>

#include "deck_test.hpp"

namespace osculate::deck {
namespace {

std::string model(const std::string& parameters, const std::string& young = "=stiff",
                  const std::string& section = "block") {
  return "osculate: 1\n" + parameters +
         "\nmesh: {generate: {block: {box: {x: [0, 4], y: [0, 1], elements: [=2*2, 1]}}}}\n"
         "materials: {m: {linear_elastic: {E: " +
         young +
         ", nu: 0.3}}}\n"
         "sections: [{on: " +
         section +
         ", material: m, element: plane_strain}]\n"
         "steps: [{name: s, increments: 1, prescribe: [{on: \"${side}.top\", ux: 0}]}]\n";
}

const std::string usual = "parameters: {stiff: 1e4, part: block, side: \"${part}\"}";

double young(const std::string& text, std::vector<Setting> settings = {}) {
  return material::unloaded(parse_model(text, "model.yaml", settings).materials.at(0).law.value)
      .young;
}

TEST(Parameters, ValuesNamesAndArithmetic) {
  EXPECT_EQ(young(model(usual)), 1e4);
  EXPECT_EQ(young(model(usual, "= 2 * stiff - 3 + 4/8")), 2e4 - 2.5);
  EXPECT_EQ(young(model(usual, "=-(1 - 3)*(stiff + 2e-1)/-(-2)")), 1e4 + 0.2);
  EXPECT_EQ(young(model(usual, "\"${stiff*3}\"")), 3e4);
  EXPECT_EQ(young(model(usual, "=10-2-3")), 5);
  EXPECT_EQ(young(model(usual, "=16/4/2")), 2);
  const Description d = parse_model(model(usual, "1", "=part"), "model.yaml");
  EXPECT_EQ(d.sections[0].on.value, "block");
  EXPECT_EQ(d.steps[0].prescribe[0].on.value, "block.top");
  ASSERT_EQ(d.parameters.size(), 3u);
  EXPECT_EQ(d.parameters[2].value, "block");
}

TEST(Parameters, SettingsReplaceValuesAndWhatFollowsFromThem) {
  const std::string text = model("parameters: {a: 2, stiff: =a*100, side: block}");
  EXPECT_EQ(young(text), 200);
  EXPECT_EQ(young(text, {{"a", "5"}}), 500);
  EXPECT_EQ(young(text, {{"stiff", "7"}}), 7);
  EXPECT_EQ(parse_model(text, "model.yaml", std::vector<Setting>{{"a", "5"}}).parameters[1].value,
            "500");
}

TEST(Parameters, MistakesNameLineKeyAndTheNearestName) {
  EXPECT_EQ(refusal(model(usual, "=stif*2")),
            "model.yaml:4: materials.m.linear_elastic.E: unknown parameter 'stif'; did you mean "
            "'stiff'?");
  EXPECT_EQ(refusal(model(usual, "=2*(stiff")),
            "model.yaml:4: materials.m.linear_elastic.E: cannot compute '2*(stiff': a bracket is "
            "not closed");
  EXPECT_EQ(refusal(model(usual, "=2*")),
            "model.yaml:4: materials.m.linear_elastic.E: cannot compute '2*': a number or name is "
            "missing at the end");
  EXPECT_EQ(refusal(model(usual, "=stiff/0")),
            "model.yaml:4: materials.m.linear_elastic.E: cannot compute 'stiff/0': the result is "
            "not finite");
  EXPECT_EQ(refusal(model(usual, "=2 stiff")),
            "model.yaml:4: materials.m.linear_elastic.E: cannot compute '2 stiff': 's' is not "
            "expected");
  EXPECT_EQ(refusal(model(usual, "=2*part")),
            "model.yaml:4: materials.m.linear_elastic.E: cannot compute '2*part': 'part' is a "
            "text");
  EXPECT_EQ(refusal(model(usual, "=-stiff")),
            "model.yaml:4: materials.m.linear_elastic.E: must be > 0, got -10000");
  EXPECT_EQ(refusal(model("parameters: {2a: 1}")),
            "model.yaml:2: parameters.2a: '2a' cannot be the name of a parameter; use letters, "
            "digits and _, a letter first");
  EXPECT_EQ(refusal(model("parameters: {a: =b, b: 1}")),
            "model.yaml:2: parameters.a: unknown parameter 'b'; there are none");
}

TEST(Parameters, ASettingOfNoParameterIsAMistake) {
  const auto refused = [](const std::string& text, const std::string& name) -> std::string {
    try {
      (void)young(text, {{name, "1"}});
    } catch (const core::InputError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_EQ(refused(model(usual), "stif"),
            "model.yaml: --set: unknown parameter 'stif'; did you mean 'stiff'?");
  EXPECT_EQ(refused(edited(model("", "1"), "${side}", "block"), "stiff"),
            "model.yaml: --set stiff: the file has no `parameters`");
}

TEST(Parameters, WithoutThemAModelIsReadAsBefore) {
  EXPECT_EQ(refusal(edited(model("", "1"), "${side}", "block")), "");
}

}  // namespace
}  // namespace osculate::deck
