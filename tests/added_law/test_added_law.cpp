// CONTRIBUTING's promise: a contact law is its header and one line of the catalogue. The two laws
// beside this file are told to nothing else, and the model file, its schema, the documentation,
// refusals, summaries and a run know them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "osculate/contact/law/catalogue.hpp"
#include "osculate/core/error.hpp"
#include "osculate/deck/explain.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/deck/schema.hpp"
#include "refusal.hpp"
#include "run_model.hpp"

namespace osculate {
namespace {
using ::testing::HasSubstr;

const std::string model = R"(osculate: 1
mesh:
  generate:
    block: {box: {x: [0, 2], y: [0, 1], elements: [2, 1]}}
    rail: {line: {points: [[-1, 0], [5, 0]], elements: 6}}
materials: {soft: {linear_elastic: {E: 100, nu: 0}}}
sections: [{on: block, material: soft, element: plane_strain}]
rigid: {base: {set: rail}}
contact:
  - name: floor
    master: base
    slave: block.bottom
    normal: {quadratic: {factor: 400}}
    friction: {saturating: {mu: 0.5, limit: 3, penalty: 1000}}
steps:
  - {name: press, increments: 2, prescribe: [{on: block, ux: 0}, {on: block.top, uy: -0.14}]}
  - {name: slide, increments: 2, prescribe: [{on: block, ux: 1}]}
output: {history: [{on: floor, of: normal_force}, {on: floor, of: shear_force}, {on: floor, of: max_penetration}]}
)";

std::string edited(const std::string& from, const std::string& to) {
  std::string text = model;
  return text.replace(text.find(from), from.size(), to);
}

TEST(AddedLaw, IsInSchemaAndDocumentation) {
  const std::string schema = deck::model_schema();
  EXPECT_THAT(schema, HasSubstr("\"quadratic\""));
  EXPECT_THAT(schema, HasSubstr("Pressure over overclosure squared. Unit: force/length^4."));
  EXPECT_THAT(schema, HasSubstr("\"saturating\""));
  EXPECT_THAT(
      deck::explain_model_key("contact.normal"),
      HasSubstr("a penalty, or one of exponential, table, decaying, tensile, user and quadratic."));
  EXPECT_THAT(
      deck::explain_model_key("friction"),
      HasSubstr(
          "Exactly one of: coulomb, tresca, rough, rate_and_state, viscous, user, saturating"));
  EXPECT_THAT(deck::explain_model_key("saturating.least"), HasSubstr("default: none"));
  EXPECT_THAT(deck::explain_model_key("saturating.penalty"), HasSubstr("against shear"));
}

TEST(AddedLaw, IsRefusedWithItsKeys) {
  const std::string at = "model.yaml:13: contact[0].normal.";
  EXPECT_EQ(refusal(model), "");
  EXPECT_EQ(refusal(edited("factor: 400", "factor: 0")),
            at + "quadratic.factor: must be > 0, got 0");
  EXPECT_EQ(refusal(edited("{factor: 400}", "{}")),
            at + "quadratic: required key 'factor' is missing");
  EXPECT_EQ(refusal(edited("quadratic:", "table: [[0, 0], [1, 1]], quadratic:")),
            at + "quadratic: there is a table law already: use one of them");
  EXPECT_EQ(refusal(edited("quadratic:", "penalty: 5, quadratic:")),
            at + "penalty: there is another law already: use one of penalty, exponential, table, "
                 "decaying, tensile, user, "
                 "quadratic");
  EXPECT_THAT(refusal(edited("factor: 400}", "factor: 400}, separation: tied")),
              HasSubstr("holding points needs a stiffness in tension"));
  EXPECT_EQ(contact::fault(contact::NormalLaw(contact::Quadratic{})),
            "normal_quadratic: factor must be > 0, got 0");
  EXPECT_EQ(contact::text(contact::FrictionLaw(contact::Saturating{0.5, 3, 10, 0.25})),
            "saturating 0.5 at 3 above 0.25 (penalty 10)");
}

// Without lateral strain the pressure is uniform: E (d - h) / H = k h^2 with h = 0.1, p = 4; all
// nodes slide alike, with the limit at that pressure.
TEST(AddedLaw, RunsInAModel) {
  const auto [values, text] = results_of(model);
  EXPECT_NEAR(values.at("floor.normal_force"), 8, 1e-7);
  EXPECT_NEAR(values.at("floor.max_penetration"), 0.1, 1e-9);
  // Positive along the floor's direction of travel, which is -x.
  EXPECT_NEAR(values.at("floor.shear_force"), -2 * 3 * (1 - std::exp(-2.0 / 3)), 1e-7);
  EXPECT_THAT(text, HasSubstr("quadratic 400, saturating 0.5 at 3 (penalty 1000)"));
}

}  // namespace
}  // namespace osculate
