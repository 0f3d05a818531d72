// The keys of the laws of contact: normal, friction, offset, duration.
#include <gtest/gtest.h>

#include <algorithm>

#include "osculate/contact/law/coulomb.hpp"
#include "osculate/contact/law/damping.hpp"
#include "osculate/contact/law/normal_exponential.hpp"
#include "osculate/contact/law/normal_table.hpp"
#include "osculate/contact/law/rate_and_state.hpp"
#include "osculate/contact/law/rough.hpp"
#include "osculate/contact/law/tresca.hpp"
#include "osculate/deck/build.hpp"
#include "osculate/material/law.hpp"
#include "space_test.hpp"

namespace osculate::deck {
namespace {

Built built(const std::string& from = "", const std::string& to = "") {
  const std::string text = test_file("laws.yaml");
  const Description d = parse_model(from.empty() ? text : edited(text, from, to), "model.yaml");
  return build(d, load_mesh(d));
}

TEST(LawKeys, BecomeLaws) {
  const Built b = built();
  const auto& floor = b.model.pairs[0].definition;
  const auto& exponential = *floor.normal.as<contact::NormalExponential>();
  EXPECT_EQ(exponential.pressure, 12);
  EXPECT_EQ(exponential.clearance, 0.01);
  const auto& coulomb = *floor.friction->as<contact::Coulomb>();
  EXPECT_EQ(coulomb.mu, 0.4);
  EXPECT_EQ(coulomb.stiffness, 500);
  EXPECT_EQ(coulomb.cap, 30);
  EXPECT_EQ(coulomb.kinetic, 0.2);
  EXPECT_EQ(coulomb.speed, 0.5);
  EXPECT_FALSE(coulomb.distance);
  EXPECT_NEAR(floor.offset, 0.03, 1e-16);
  EXPECT_EQ(b.model.steps[0].duration, 0.5);
  const auto& joint = b.model.pairs[1].definition;
  ASSERT_TRUE(pairing::is_tied(joint));
  const auto& tie = std::get<pairing::Tied<2>>(joint.separation);
  EXPECT_EQ(tie.tolerance, 0.02);
  EXPECT_FALSE(tie.keep_gap);
  EXPECT_EQ(tie.ties.size(), 6u);
  const auto& top = b.model.pairs[2].definition;
  EXPECT_EQ(top.normal.as<contact::NormalTable>()->points.size(), 3u);
  EXPECT_EQ(top.friction->as<contact::Tresca>()->limit_traction, 3);
  EXPECT_EQ(top.damping->as<contact::Viscous>()->coefficient, 0.5);
  EXPECT_FALSE(floor.damping.has_value());
  EXPECT_EQ(top.offset, 0);
  EXPECT_TRUE(pairing::is<pairing::MayPart>(top.separation));
}

// Friction by rate and state and creep: their numbers, and what they say of steps without a time.
TEST(LawKeys, OfWhatDependsOnTime) {
  const std::string text = test_file("time.yaml");
  const Description d = parse_model(text, "model.yaml");
  const Built b = build(d, load_mesh(d));
  const auto& law = *b.model.pairs[0].definition.friction->as<contact::RateAndState>();
  EXPECT_EQ(law.mu, 0.5);
  EXPECT_EQ(law.a, 0.01);
  EXPECT_EQ(law.b, 0.02);
  EXPECT_EQ(law.speed, 0.3);
  EXPECT_EQ(law.distance, 0.02);
  EXPECT_EQ(law.state, 4);
  EXPECT_EQ(law.stiffness, 500);
  const auto& lead = std::get<material::Norton>(b.model.sections[0].section.law);
  EXPECT_EQ(lead.rate, 0.001);
  EXPECT_EQ(lead.exponent, 3);
  const std::string untimed = edited(text, "duration: 0.5, ", "");
  EXPECT_EQ(
      any_refusal(untimed),
      "model.yaml:8: materials.lead.norton: material 'lead', which depends on time, needs the "
      "duration of every step, and step 'one' has none");
  EXPECT_EQ(any_refusal(edited(untimed, "{norton: {E: 100, nu: 0.35, density: 2, A: 0.001, n: 3}}",
                               "{linear_elastic: {E: 100, nu: 0.35}}")),
            "model.yaml:16: contact[0].friction.rate_and_state.speed: friction that depends on "
            "speed needs the duration of every step, and step 'one' has none");
  const std::string vibrating = edited(text, "steps: [", "steps: [{name: sound, modes: 2}, ");
  EXPECT_EQ(any_refusal(vibrating),
            "model.yaml:16: contact[0].friction.rate_and_state.speed: friction that depends on "
            "speed does not go with the vibrations of step 'sound'");
}

TEST(LawKeys, RestitutionGoesWithEveryLaw) {
  const Built table = built("{viscous: 0.5}", "{restitution: 0.25}");
  EXPECT_EQ(table.model.pairs[2].definition.damping->as<contact::Restitution>()->value, 0.25);
  const Built exponential = built("clearance: 0.01}}",
                                  "clearance: 0.01}, damping: {restitution: "
                                  "0}}");
  EXPECT_EQ(exponential.model.pairs[0].definition.damping->as<contact::Restitution>()->value, 0);
}

/// A model in which nothing but damping could need a time.
std::string untimed(const std::string& damping) {
  const std::string text = edited(edited(test_file("laws.yaml"), "{speed: 0.5}", "{distance: 1}"),
                                  "duration: 0.5, ", "");
  return edited(text, "{viscous: 0.5}", damping);
}

TEST(LawKeys, OnlyViscousDampingNeedsATime) {
  EXPECT_EQ(any_refusal(untimed("{viscous: 0.5}")),
            "model.yaml:27: contact[2].normal.damping.viscous: damping that depends on speed needs "
            "the duration of every step, and step 'one' has none");
  EXPECT_EQ(any_refusal(untimed("{restitution: 0.5}")), "");
}

TEST(LawKeys, DistanceRoughAndWhatIsHeld) {
  const Built distance = built("decay: {speed: 0.5}", "decay: {distance: 0.1}");
  EXPECT_EQ(distance.model.pairs[0].definition.friction->as<contact::Coulomb>()->distance, 0.1);
  const Built rough = built("tresca: {limit: 3, penalty: 500}", "rough: {penalty: 7}");
  EXPECT_EQ(rough.model.pairs[2].definition.friction->as<contact::Rough>()->stiffness, 7);
  const std::string tied = "separation: tied, tolerance: 0.02, initial_gap: close";
  const Built closed = built(tied, "separation: no_separation");
  EXPECT_TRUE(pairing::is<pairing::NeverPart>(closed.model.pairs[1].definition.separation));
  const Built normal = built(tied, "separation: tied_normal");
  const auto* const held =
      std::get_if<pairing::TiedNormal>(&normal.model.pairs[1].definition.separation);
  ASSERT_NE(held, nullptr);
  EXPECT_NEAR(held->tolerance, 0.05, 1e-15);  // 0.05 of facets of 1
}

TEST(LawKeys, SayHowManyPointsAreTied) {
  const std::vector<std::string> notes = built().notes;
  const auto count = std::count(notes.begin(), notes.end(),
                                "contact 'joint': 6 of 6 points are tied (within 0.02)");
  EXPECT_EQ(count, 1);
}

const std::string floor = "model.yaml:20: contact[0].", joint = "model.yaml:26: contact[1].",
                  top = "model.yaml:27: contact[2].";
const std::string tied = "separation: tied, tolerance: 0.02, initial_gap: close";
const std::string tied_keeping = "separation: tied, tolerance: 0.02";

TEST(LawKeys, TiesHaveTheStiffnessOfRoughFrictionAlongTheMaster) {
  const Built b = built(tied + "}",
                        "separation: tied, tolerance: any, initial_gap: close}\n    friction: "
                        "{rough: {penalty: 7}}\n    initial: ramp");
  const auto& pair = b.model.pairs[1].definition;
  const auto* const ties = std::get_if<pairing::Tied<2>>(&pair.separation);
  ASSERT_NE(ties, nullptr);
  EXPECT_EQ(ties->tolerance, pairing::any_gap);
  EXPECT_FALSE(ties->keep_gap);
  EXPECT_EQ(pair.overlap, pairing::InitialOverlap::ramped);
  ASSERT_TRUE(pair.friction->as<contact::Rough>());
  EXPECT_EQ(contact::stiffness(*pair.friction), 7);
  EXPECT_EQ(contact::text(*pair.friction), "rough (penalty 7)");
}

TEST(LawKeys, RefuseNormalLawsThatMakeNoSense) {
  const std::string exponential = "{exponential: {pressure: 12, clearance: 0.01}}";
  const std::string table = "[[-0.01, 0], [0, 5], [0.1, 50]]";
  expect_refusals(
      test_file("laws.yaml"),
      {
          {exponential, "{penalty: 1, table: [[0, 0], [1, 1]]}",
           floor + "normal.penalty: there is another law already: use one of penalty, exponential, "
                   "table, decaying, tensile, user"},
          {"clearance: 0.01}}", "clearance: 0}}",
           floor + "normal.exponential.clearance: must be > 0, got 0"},
          {"clearance: 0.01}}", "clearance: 0.01}, separation: no_separation}",
           floor + "normal.separation: holding points needs a stiffness in tension: it goes with "
                   "penalty only"},
          {tied, "tolerance: 0.02",
           joint +
               "normal.tolerance: tolerance says what is tied: it goes with separation: tied or "
               "tied_normal"},
          {tied, "initial_gap: close",
           joint + "normal.initial_gap: closing gaps goes with separation: tied only"},
          {"tolerance: 0.02", "tolerance: -1", joint + "normal.tolerance: must be > 0, got -1"},
          {tied + "}", tied + "}\n    friction: {tresca: {limit: 1, penalty: 1}}",
           "model.yaml:27: contact[1].friction.tresca: tied points do not slide: leave out "
           "friction, or use rough, whose penalty is their stiffness along the master"},
          {tied, tied_keeping + "}\n    initial: {clearance: 0.1",
           "model.yaml:27: contact[1].initial: points that are held from the start keep the gap "
           "they "
           "have"},
          {tied + "}", tied_keeping + "}\n    initial: ramp",
           "model.yaml:27: contact[1].initial: points that keep the gap they have do not press: "
           "leave out initial"},
          {"slave: mid.bottom\n", "slave: high.bottom\n",
           joint + "normal.separation: no point of the slave 'high.bottom' is within 0.02 of the "
                   "master "
                   "'low.top': nothing is tied"},
          {"master: low.top\n", "master: mid.bottom\n",
           joint + "normal.separation: a surface cannot be tied to itself: name master and slave"},
          {table, "[[0, 0]]", top + "normal.table: expected at least 2 values, got 1"},
          {table, "[[0, 1], [1, 2]]",
           top + "normal.table[0]: the first pressure of the table must be 0"},
          {table, "[[0, 0], [0, 2]]", top + "normal.table[1]: overclosures must grow: 0 follows 0"},
          {table, "[[0, 0], [1, 2], [2, 1]]",
           top + "normal.table[2]: pressures must not fall: 1 follows 2"},
          {table, "[[0, 0], [1, 0]]", top + "normal.table: the table has no pressure > 0"},
      });
}

TEST(LawKeys, RefuseFrictionAndDampingThatMakeNoSense) {
  expect_refusals(
      test_file("laws.yaml"),
      {
          {"kinetic: 0.2, decay: {speed: 0.5}", "kinetic: 0.2",
           "model.yaml:21: contact[0].friction.coulomb.kinetic: how the coefficient changes is "
           "missing: "
           "add decay: {distance: ...} or {speed: ...}"},
          {"kinetic: 0.2, decay", "decay",
           "model.yaml:21: contact[0].friction.coulomb.decay: decay goes with a kinetic "
           "coefficient, "
           "which is missing"},
          {"duration: 0.5, ", "",
           "model.yaml:21: contact[0].friction.coulomb.decay.speed: friction that depends on speed "
           "needs "
           "the duration of every step, and step 'one' has none"},
          {"duration: 0.5, ", "duration: 0, ",
           "model.yaml:29: steps[0].duration: must be > 0, got 0"},
          {"{viscous: 0.5}", "{viscous: -1}", top + "normal.damping.viscous: must be >= 0, got -1"},
          {"{viscous: 0.5}", "{restitution: 1.1}",
           top + "normal.damping.restitution: must be >= 0 and <= 1, got 1.1"},
          {"{viscous: 0.5}", "{restitution: 1, viscous: 0}",
           top + "normal.damping: 'restitution' and 'viscous' exclude each other"},
          {tied, tied + ", damping: {restitution: 1}",
           joint +
               "normal.damping: points that are held do not part, and an impact of theirs has no "
               "end: damping goes with separation: allowed only"},
          {tied + "}", "damping: {restitution: 1}}\n    enforcement: augmented_lagrange",
           "model.yaml:27: contact[1].enforcement: damping is a part of the spring that a penalty "
           "is, "
           "and corrected or unknown tractions have none: use penalty, or leave out damping "
           "(contact[1].normal.damping.restitution: line 26)"},
          {"slave: low.bottom", "slave: low.bottom\n    enforcement: augmented_lagrange",
           "model.yaml:20: contact[0].enforcement: a law that gives the pressure as a function of "
           "the gap is met by itself: use penalty (contact[0].normal.exponential: line 21)"},
          {"tresca: {limit: 3, penalty: 500}",
           "tresca: {limit: 3, penalty: 500}, rough: {penalty: 1}",
           top + "friction: 'tresca' and 'rough' exclude each other"},
      });
}

}  // namespace
}  // namespace osculate::deck
