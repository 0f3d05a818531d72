// CONTRIBUTING's promise: a material is its header and one entry of the catalogue. yeoh.hpp is told
// to nothing else, and the model file, its schema, the documentation, refusals and a run know it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "osculate/core/error.hpp"
#include "osculate/deck/explain.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/deck/schema.hpp"
#include "osculate/material/energy.hpp"
#include "osculate/material/law.hpp"
#include "refusal.hpp"
#include "run_model.hpp"

namespace osculate {
namespace {
using material::Yeoh;
using ::testing::HasSubstr;

// What is not compiled again holds laws by value, as large as they are in the program.
static_assert(sizeof(Yeoh) <= sizeof(material::J2Plasticity));
static_assert(alignof(Yeoh) <= alignof(material::J2Plasticity));

/// One cell between walls that do not let it become thinner, pulled at its top.
const std::string plane = R"(osculate: 1
mesh: {generate: {block: {box: {x: [0, 2], y: [0, 1], elements: [1, 1]}}}}
materials: {rubber: {yeoh: {E: 2, nu: 0.3, k: 0.25}}}
sections: [{on: block, material: rubber, element: plane_strain}]
steps:
  - name: pull
    increments: 4
    prescribe: [{on: block.left, ux: 0}, {on: block.right, ux: 0}, {on: block.bottom, uy: 0}, {on: block.top, uy: 0.5}]
output: {fields: last, history: [{on: block.top, of: rfy}]}
)";
/// The same in space, pulled along z.
const std::string space = R"(osculate: 1
mesh: {generate: {block: {box: {x: [0, 2], y: [0, 1], z: [0, 1], elements: [1, 1, 1]}}}}
materials: {rubber: {yeoh: {E: 2, nu: 0.3, k: 0.25}}}
sections: [{on: block, material: rubber, element: solid}]
steps:
  - name: pull
    increments: 4
    prescribe: [{on: block, ux: 0, uy: 0}, {on: block.bottom, uz: 0}, {on: block.top, uz: 0.5}]
output: {fields: last, history: [{on: block.top, of: rfz}]}
)";

std::string edited(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

/// Force per area of the block that becomes `s` times as long and no thinner: s S with C = (1, 1,
/// s^2).
double pull(double s) {
  const material::Lame c = material::lame(2, 0.3);
  const double k = 0.25;
  return s * (c.mu * (1 - 1 / (s * s)) + c.lambda * std::log(s) / (s * s) + 4 * k * (s * s - 1));
}

TEST(AddedMaterial, IsInSchemaAndDocumentation) {
  const std::string schema = deck::model_schema();
  EXPECT_THAT(schema, HasSubstr("\"yeoh\""));
  EXPECT_THAT(schema, HasSubstr("Factor of the second term. Unit: force/length^2."));
  EXPECT_THAT(deck::explain_model_key("materials"), HasSubstr(", yeoh"));
  EXPECT_THAT(deck::explain_model_key("yeoh.k"), HasSubstr("Factor of the second term."));
  EXPECT_THAT(deck::explain_model_key("sections.kinematics"),
              HasSubstr("finite for the other materials"));
}

TEST(AddedMaterial, IsRefusedWithItsKeys) {
  EXPECT_EQ(refusal(plane), "");
  const std::string at = "model.yaml:3: materials.rubber.yeoh";
  EXPECT_EQ(refusal(edited(plane, "k: 0.25", "k: 0")), at + ".k: must be > 0, got 0");
  EXPECT_EQ(refusal(edited(plane, ", k: 0.25", "")), at + ": required key 'k' is missing");
  EXPECT_THAT(refusal(edited(plane, "plane_strain", "plane_strain, kinematics: small")),
              HasSubstr("material 'rubber' is hyperelastic, which needs kinematics: finite"));
  EXPECT_EQ(material::range_problem(Yeoh{1, 0.6, 0, 1}), "nu = 0.6, but -1 < nu < 0.5 is needed");
}

TEST(AddedMaterial, RunsInAModel) {
  EXPECT_NEAR(results_of(plane).history.at("block.top.rfy"), 2 * pull(1.5), 1e-9);
  EXPECT_NEAR(results_of(space).history.at("block.top.rfz"), 2 * pull(1.5), 1e-9);
  // Found, not given: the stretch that a force has.
  const std::string loaded =
      edited(edited(plane, ", {on: block.top, uy: 0.5}]",
                    "]\n    traction: [{on: block.top, ty: " + std::to_string(pull(1.5)) + "}]"),
             "of: rfy", "of: uy");
  EXPECT_NEAR(results_of(loaded).history.at("block.top.uy"), 0.5, 1e-6);
}

TEST(AddedMaterial, IsALawOfTheCatalogue) {
  const material::Law law = Yeoh{2, 0.3, 0, 0.25};
  EXPECT_EQ(material::key_of(material::Law(law)), "yeoh");
  const material::Strain strain(0.2, -0.1, 0.05, 0.15);
  constexpr double step = 1e-5;
  for (int i = 0; i < 4; ++i) {
    const material::Strain h = step * material::Strain::Unit(i);
    const double slope = (material::stored_energy(law, material::Strain(strain + h)) -
                          material::stored_energy(law, material::Strain(strain - h))) /
                         (2 * step);
    EXPECT_NEAR(material::response(law, strain).stress[i], slope, 1e-8);
  }
  double across = 0;
  const material::Response flat = material::plane_stress_response(law, strain, &across);
  material::Strain3 whole = material::in_space(strain);
  whole[2] = across;
  const material::Response3 r = material::response(law, whole);
  EXPECT_NEAR(r.stress[2], 0, 1e-12);
  EXPECT_NEAR((r.stress.head<4>() - flat.stress).norm(), 0, 1e-12);
}

}  // namespace
}  // namespace osculate
