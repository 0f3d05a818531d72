// `penalty: auto`: from the cells behind the contact, whatever the units.
#include <fmt/format.h>

#include "space_test.hpp"
#include "system_test.hpp"

namespace osculate::deck {
namespace {

/// Two blocks, E = 100 and 400, cells 0.25 and 0.5 high, in units of `length` and `force`.
std::string blocks(const std::string& keys, double length = 1, double force = 1,
                   const std::string& low_bias = "") {
  const double stress = force / (length * length);
  return fmt::format(R"(osculate: 1
mesh:
  generate:
    low: {{box: {{x: [0, {0}], y: [0, {1}], elements: [8, 4]{7}}}}}
    high: {{box: {{x: [{2}, {3}], y: [{1}, {3}], elements: [3, 4]}}}}
materials: {{a: {{neo_hooke: {{E: {4}, nu: 0.25}}}}, b: {{neo_hooke: {{E: {5}, nu: 0.25}}}}}}
sections:
  - {{on: low, material: a, element: plane_strain, thickness: {1}}}
  - {{on: high, material: b, element: plane_strain, thickness: {1}}}
contact: [{{name: c, master: low.top, slave: high.bottom{6}}}]
steps:
  - {{name: press, increments: 2, prescribe: [{{on: low.bottom, ux: 0, uy: 0}}, {{on: high.top, ux: 0, uy: {8}}}]}}
  - {{name: shear, increments: 4, prescribe: [{{on: high.top, ux: {9}}}]}}
)",
                     4 * length, length, length, 3 * length, 100 * stress, 400 * stress, keys,
                     low_bias, -0.05 * length, 0.4 * length);
}

TEST(AutomaticPenalty, IsTenTimesTheTwoLayersBehindEachOther) {
  const Built built = build_text(blocks(", friction: {coulomb: {mu: 0.3}}"));
  const model::ContactPair& pair = built.model.pairs.at(0);
  const double low = 100 / 0.25, high = 400 / 0.5;
  EXPECT_TRUE(pair.automatic);
  EXPECT_NEAR(contact::penalty_of(pair.definition.normal), 10 / (1 / low + 1 / high), 1e-9);
  EXPECT_NEAR(contact::stiffness(*pair.definition.friction), 10 / (1 / low + 1 / high) / 2.5, 1e-9);
  EXPECT_NEAR(pair.height, 0.25, 1e-12);
}

TEST(AutomaticPenalty, IsAsManyTimesThatAsOneSays) {
  const auto penalty = [](const std::string& keys) {
    return contact::penalty_of(build_text(blocks(keys)).model.pairs.at(0).definition.normal);
  };
  EXPECT_NEAR(penalty(", normal: {auto_factor: 10}"), 10 * penalty(""), 1e-9);
  const auto refusal = [](const std::string& keys) -> std::string {
    try {
      (void)build_text(blocks(keys));
    } catch (const core::InputError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_NE(refusal(", normal: {penalty: 100, auto_factor: 10}")
                .find("auto_factor goes with a law whose stiffness is `auto`"),
            std::string::npos);
}

TEST(AutomaticPenalty, ARigidSideGivesNothing) {
  std::string text = blocks("");
  text = edited(text, "steps:", "rigid: {tool: {set: high}}\nsteps:");
  text = edited(text, "  - {on: high, material: b, element: plane_strain, thickness: 1}\n", "");
  for (const std::string from = "on: high.top"; text.find(from) != std::string::npos;)
    text.replace(text.find(from), from.size(), "on: tool");
  EXPECT_NEAR(contact::penalty_of(build_text(text).model.pairs.at(0).definition.normal),
              10 * 100 / 0.25, 1e-9);
}

TEST(AutomaticPenalty, OfNodesIsTimesTheirArea) {
  const double per_area =
      contact::penalty_of(build_text(blocks("")).model.pairs.at(0).definition.normal);
  const Built nodes = build_text(blocks(", weight: node"));
  EXPECT_NEAR(contact::penalty_of(nodes.model.pairs.at(0).definition.normal), per_area * 2.0 / 4,
              1e-9);
}

TEST(AutomaticPenalty, GivenOnesStay) {
  const Built built =
      build_text(blocks(", normal: {penalty: 7}, friction: {coulomb: {mu: 0.3, penalty: 3}}"));
  const model::ContactPair& pair = built.model.pairs.at(0);
  EXPECT_FALSE(pair.automatic);
  EXPECT_EQ(contact::penalty_of(pair.definition.normal), 7);
  EXPECT_EQ(contact::stiffness(*pair.definition.friction), 3);
}

TEST(AutomaticPenalty, InSpaceItIsTheSame) {
  const std::string text = R"(osculate: 1
mesh:
  generate:
    low: {box: {x: [0, 4], y: [0, 3], z: [0, 1], elements: [4, 3, 4]}}
    high: {box: {x: [1, 3], y: [1, 2], z: [1, 3], elements: [3, 2, 4]}}
materials: {a: {neo_hooke: {E: 100, nu: 0.25}}, b: {neo_hooke: {E: 400, nu: 0.25}}}
sections: [{on: low, material: a, element: solid}, {on: high, material: b, element: solid}]
contact: [{name: c, master: low.top, slave: high.bottom, sampling: {gauss: 2}}]
steps: [{name: s, increments: 1, prescribe: [{on: low.bottom, ux: 0, uy: 0, uz: 0}]}]
)";
  const Description description = parse_model(text, "model.yaml");
  const Built3 built = build3(description, load_mesh(description));
  EXPECT_NEAR(contact::penalty_of(built.model.pairs.at(0).definition.normal),
              10 / (0.25 / 100 + 0.5 / 400), 1e-9);
}

Course course_in(double length, double force) {
  return course_of(build_text(blocks(", friction: {coulomb: {mu: 0.3}}", length, force)));
}

TEST(AutomaticPenalty, UnitsDoNotMatter) {
  const Course reference = course_in(1, 1);
  EXPECT_EQ(reference.iterations.size(), 6u);
  const double scales[][2] = {{1e-3, 1}, {0.1, 1e-3}, {1024, 1}};
  for (const auto& scale : scales) {
    const Course other = course_in(scale[0], scale[1]);
    EXPECT_EQ(other.iterations, reference.iterations);
    EXPECT_EQ(other.states, reference.states);
  }
}

}  // namespace
}  // namespace osculate::deck
