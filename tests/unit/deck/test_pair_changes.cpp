// Contact pairs that change from step to step: what is understood, and what is refused. That they
// do what they should is verification/pair_changes.
#include <gtest/gtest.h>

#include <cmath>

#include "osculate/contact/law/catalogue.hpp"
#include "osculate/core/error.hpp"
#include "osculate/deck/build.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/model/pair_changes.hpp"

namespace osculate::deck {
namespace {

std::string text_of(const std::string& pair, const std::string& first, const std::string& second) {
  return "osculate: 1\n"
         "mesh: {generate: {block: {box: {x: [0, 2], y: [0, 1], elements: [2, 2]}}, rail: {line: "
         "{points: [[-1, 0], [3, 0]], elements: 1}}}}\n"
         "materials: {m: {linear_elastic: {E: 100, nu: 0.3, density: 1}}}\n"
         "sections: [{on: block, material: m, element: plane_strain}]\n"
         "rigid: {base: {set: rail}}\n"
         "contact: [{name: floor, master: base, slave: block.bottom, " +
         pair +
         "}]\n"
         "steps:\n"
         "  - {name: one, increments: 1, prescribe: [{on: block.top, ux: 0, uy: 0}]" +
         first + "}\n  - {name: two, increments: 1" + second + "}\n";
}

Built built(const std::string& pair, const std::string& first, const std::string& second) {
  const Description d = parse_model(text_of(pair, first, second), "m.yaml");
  return build(d, load_mesh(d));
}

std::string refusal(const std::string& pair, const std::string& first, const std::string& second) {
  try {
    (void)built(pair, first, second);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return {};
}

// Cells behind a pair's facets go while the pair is not active, and not otherwise.
TEST(PairChanges, TheCellsOfAPairGoAndComeWithIt) {
  const std::string law = "normal: {penalty: 500}",
                    off = ", contact: [{pair: floor, active: false}]",
                    remove = ", remove: [{on: block}]", add = ", add: [{on: block}]";
  const Built b = built(law, "", off + remove);
  EXPECT_EQ(b.model.body_changes.size(), 1u);
  EXPECT_EQ(
      refusal(law, "", remove).substr(0, 87),
      "m.yaml:9: steps[1].remove[0]: node 3 (2, 0) of contact 'floor' has no cell left in step");
  EXPECT_EQ(refusal(law, off + remove, ", contact: [{pair: floor, active: true}]").substr(0, 60),
            "m.yaml:9: steps[1].contact[0]: node 3 (2, 0) of contact 'flo");
  EXPECT_EQ(refusal(law, off + remove, ", contact: [{pair: floor, active: true}]" + add), "");
}

// Of a deformable master, whose nodes other cells hold too.
TEST(PairChanges, NoFacetOfAPairLosesItsCell) {
  const std::string model =
      "osculate: 1\n"
      "mesh: {generate: {left: {box: {x: [0, 2], y: [0, 1], elements: [2, 1]}}, right: {box: {x: "
      "[2, 4], y: [0, 1], elements: [2, 1]}}, high: {box: {x: [1, 3], y: [1, 2], elements: [2, "
      "1]}}}}\n"
      "sets: {rails: {union: [left.top, right.top]}}\n"
      "materials: {m: {linear_elastic: {E: 100, nu: 0.3}}}\n"
      "sections: [{on: left, material: m, element: plane_strain}, {on: right, material: m, "
      "element: "
      "plane_strain}, {on: high, material: m, element: plane_strain}]\n"
      "contact: [{name: joint, master: rails, slave: high.bottom, normal: {penalty: 50}}]\n"
      "steps:\n"
      "  - {name: one, prescribe: [{on: left.bottom, ux: 0, uy: 0}, {on: right.bottom, ux: 0, uy: "
      "0}, {on: high.top, ux: 0, uy: 0}]}\n"
      "  - {name: two, remove: [{on: right}]}\n";
  const Description d = parse_model(model, "m.yaml");
  try {
    (void)build(d, load_mesh(d));
    FAIL() << "not refused";
  } catch (const core::InputError& error) {
    EXPECT_EQ(
        std::string(error.what()),
        "m.yaml:9: steps[1].remove[0]: cell 3 at the surface of contact 'joint' is removed in "
        "step 'two', in which the pair is active: make it inactive (`contact: [{pair: joint, "
        "active: false}]`), or let them stay");
  }
}

TEST(PairChanges, StayFromStepToStep) {
  const Built b = built("normal: {penalty: 500}, friction: {coulomb: {mu: 0.1, penalty: 200}}",
                        ", contact: [{pair: floor, active: false}]",
                        ", contact: [{pair: floor, active: true, normal: {penalty: 700}}]");
  ASSERT_EQ(b.model.pair_changes.size(), 2u);
  model::Model now = b.model;
  model::change_pairs(b.model, 0, now);
  EXPECT_EQ(now.pairs[0].definition.depth, -std::numeric_limits<double>::infinity());
  EXPECT_EQ(now.pairs[0].definition.normal.as<contact::NormalPenalty>()->stiffness, 500);
  model::change_pairs(b.model, 1, now);
  EXPECT_EQ(now.pairs[0].definition.depth, b.model.pairs[0].definition.depth);
  EXPECT_EQ(now.pairs[0].definition.normal.as<contact::NormalPenalty>()->stiffness, 700);
  ASSERT_TRUE(now.pairs[0].definition.friction);
  EXPECT_EQ(now.pairs[0].definition.friction->as<contact::Coulomb>()->mu, 0.1);
}

TEST(PairChanges, DampingComesAndGoes) {
  // Where it does not act a step needs no duration.
  const Built b = built("normal: {penalty: 500, damping: {viscous: 3}}",
                        ", contact: [{pair: floor, damping: none}]",
                        ", duration: 2, contact: [{pair: floor, damping: {viscous: 4}}]");
  model::Model now = b.model;
  EXPECT_EQ(contact::damper(*now.pairs[0].definition.damping), 3);
  model::change_pairs(b.model, 0, now);
  EXPECT_FALSE(now.pairs[0].definition.damping);
  model::change_pairs(b.model, 1, now);
  EXPECT_EQ(contact::damper(*now.pairs[0].definition.damping), 4);
  // The other laws of the pair stay.
  EXPECT_EQ(now.pairs[0].definition.normal.as<contact::NormalPenalty>()->stiffness, 500);
  EXPECT_NE(refusal("normal: {penalty: 500, damping: {viscous: 3}}", "",
                    ", contact: [{pair: floor, damping: none}]")
                .find("step 'one' has none"),
            std::string::npos);
}

// Mortar by a penalty may be damped from a step on; its other laws stay.
TEST(PairChanges, DampingOfMortar) {
  const Built b = built("normal: {penalty: 500}, sampling: mortar", "",
                        ", duration: 2, contact: [{pair: floor, damping: {viscous: 4}}]");
  ASSERT_EQ(b.model.pair_changes.size(), 1u);
  EXPECT_TRUE(b.model.pair_changes[0].damping);
}

/// A law that says no penalty has that of the pair.
TEST(PairChanges, OfFrictionKeepThePenalty) {
  for (const auto& [given, expected] :
       {std::pair{std::string("{mu: 0.1, penalty: 200}"), 200.0}, {"{mu: 0.1}", 0.0}}) {
    const Built b =
        built("normal: {penalty: 500}, friction: {coulomb: " + given + "}", ", duration: 1",
              ", duration: 1, contact: [{pair: floor, friction: {coulomb: {mu: 0.4, "
              "kinetic: 0.2, decay: {speed: 3}}}}]");
    const double at_first = contact::stiffness(*b.model.pairs[0].definition.friction);
    if (expected > 0) {
      EXPECT_EQ(at_first, expected);
    }
    EXPECT_GT(at_first, 0);
    ASSERT_TRUE(b.model.pair_changes.at(0).friction);
    const contact::FrictionLaw& law = *b.model.pair_changes[0].friction;
    EXPECT_EQ(contact::stiffness(law), at_first);
    EXPECT_EQ(law.as<contact::Coulomb>()->kinetic, 0.2);
  }
  const Built normal =
      built("normal: {penalty: auto}", "", ", contact: [{pair: floor, normal: {penalty: auto}}]");
  EXPECT_EQ(contact::penalty_of(normal.model.pair_changes.at(0).normal),
            contact::penalty_of(normal.model.pairs[0].definition.normal));
}

TEST(PairChanges, AreRefusedWithTheReason) {
  const std::string plain = "normal: {penalty: 500}";
  const auto expect = [&](const std::string& pair, const std::string& change,
                          const std::string& why) {
    const std::string said = refusal(pair, "", ", contact: [{" + change + "}]");
    EXPECT_NE(said.find(why), std::string::npos) << said;
    EXPECT_NE(said.find("m.yaml:9"), std::string::npos) << said;
  };
  expect(plain, "pair: flor, active: false", "did you mean 'floor'");
  expect(plain, "pair: floor", "one of");
  expect(plain, "pair: floor, normal: {penalty: auto}",
         "needs its penalty as a number: that of the pair is none of the bodies'");
  expect(plain, "pair: floor, friction: {coulomb: {mu: 0.1}}",
         "needs its penalty as a number: the pair has no friction that has one");
  expect(plain, "pair: floor, normal: {penalty: 500, separation: tied}",
         "tied from the start of the analysis");
  expect(plain + ", enforcement: lagrange_multiplier", "pair: floor, active: false",
         "enforcement: penalty");
  expect("normal: {penalty: 500, separation: tied}",
         "pair: floor, friction: {coulomb: {mu: 0.1, penalty: 200}}", "do not slide");
  expect("normal: {penalty: 500, damping: {restitution: 0.5}}",
         "pair: floor, normal: {penalty: 5, damping: {restitution: 0.5}}",
         "by the key `damping` of the change");
  expect(plain, "pair: floor, damping: {restitution: 0.5}", "unknown key 'restitution'");
  expect(plain, "pair: floor, damping: {viscous: 2}", "needs the duration of every step");
  expect(plain, "pair: floor, active: false}, {pair: floor, active: true",
         "changes twice in this step");
}

// Points that may part slide steeply, however they were held before.
TEST(PairChanges, RoughTiesThatEndMayPart) {
  const Built b =
      built("normal: {penalty: 500, separation: tied}, friction: {rough: {penalty: 20}}", "",
            ", contact: [{pair: floor, normal: {penalty: 500}}]");
  const auto coefficient = [](const std::optional<contact::FrictionLaw>& law) {
    return law->as<contact::Rough>()->coefficient;
  };
  EXPECT_TRUE(std::isinf(coefficient(b.model.pairs[0].definition.friction)));
  ASSERT_TRUE(b.model.pair_changes.at(0).friction);
  EXPECT_EQ(coefficient(b.model.pair_changes[0].friction), contact::Rough::steep);
  EXPECT_EQ(contact::stiffness(*b.model.pair_changes[0].friction), 20);
}

TEST(PairChanges, WhatCannotBeDampedFromTheStartCannotLater) {
  const auto with = [](const std::string& pair) {
    return refusal(pair, "", ", duration: 1, contact: [{pair: floor, damping: {viscous: 2}}]");
  };
  EXPECT_NE(with("normal: {penalty: 500, separation: no_separation}")
                .find("points that are held do not part"),
            std::string::npos);
  EXPECT_NE(with("normal: {penalty: 500}, enforcement: lagrange_multiplier, sampling: nodes")
                .find("cannot change"),
            std::string::npos);
}

TEST(PairChanges, DoNotGoWithExplicitSteps) {
  const std::string said =
      refusal("normal: {penalty: 500}", ", contact: [{pair: floor, active: false}]",
              ", duration: 1, dynamics: {scheme: central_differences}");
  EXPECT_NE(said.find("explicit steps"), std::string::npos) << said;
}

}  // namespace
}  // namespace osculate::deck
