// The keys sampling and two_pass.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "deck_test.hpp"
#include "osculate/deck/build.hpp"

namespace osculate::deck {
namespace {

const std::string gap = "slave: low.top, normal: {penalty: 1000}";

Built built_with(const std::string& keys) {
  const std::string text =
      edited(test_file("bodies.yaml"), gap, "slave: low.top, normal: {penalty: 1000}, " + keys);
  const Description description = parse_model(text, "model.yaml");
  return build(description, load_mesh(description));
}

std::string refusal_of(const std::string& from, const std::string& to) {
  try {
    const Description d = parse_model(edited(test_file("bodies.yaml"), from, to), "model.yaml");
    (void)build(d, load_mesh(d));
  } catch (const core::InputError& error) {
    return error.what();
  }
  return {};
}

TEST(SamplingKey, SetsTheContactPoints) {
  EXPECT_EQ(built_with("sampling: nodes").model.pairs[1].definition.slave.points.size(), 5u);
  EXPECT_EQ(built_with("sampling: {gauss: 3}").model.pairs[1].definition.slave.points.size(), 12u);
  const Description d = parse_model(test_file("sampling.yaml"), "model.yaml");
  const Built lobatto = build(d, load_mesh(d));
  const auto& slave = lobatto.model.pairs[1].definition.slave;
  EXPECT_EQ(slave.points.size(), 12u);  // 4 facets with 3 points each
  double length = 0;
  for (const double area : lobatto.model.pairs[1].definition.reference_areas) length += area;
  EXPECT_NEAR(length, 4, 1e-14);
  EXPECT_EQ(lobatto.model.pairs[0].definition.slave.points.size(), 12u);  // each pair its own
  EXPECT_EQ(lobatto.model.pairs[2].definition.slave.points.size(), 15u);  // second pass
}

/// Between meshes, with the program's penalty: Gauss points. Where they would be too many, or the
/// master is a plain shape: nodes.
TEST(SamplingKey, IsChosenByTheSides) {
  const auto points = [](const std::string& laws, std::size_t pair) {
    const Description d =
        parse_model(edited(edited(test_file("bodies.yaml"), gap, "slave: low.top" + laws),
                           "slave: high.top, normal: {penalty: 1000}", "slave: high.top"),
                    "model.yaml");
    return build(d, load_mesh(d)).model.pairs.at(pair).definition.slave.points.size();
  };
  constexpr std::size_t nodes = 5, two_on_each = 8;
  EXPECT_EQ(points("", 1), two_on_each);
  EXPECT_EQ(points(", normal: {penalty: 1000}", 1), nodes);
  EXPECT_EQ(points("", 2), nodes);  // the master is a circle
  for (const std::string key :
       {"sampling: nodes", "two_pass: true", "weight: node", "enforcement: augmented_lagrange",
        "enforcement: lagrange_multiplier"})
    EXPECT_EQ(points(", " + key, 1), nodes) << key;
}

/// The nodes of the coarser of two deformable sides.
TEST(SamplingKey, NodesOfTheCoarserSideAreWarnedOf) {
  const auto warnings = [](const std::string& keys, int columns) {
    const std::string text = fmt::format(R"(osculate: 1
mesh: {{generate: {{low: {{box: {{x: [0, 4], y: [0, 1], elements: [{}, 1]}}}},
  high: {{box: {{x: [0, 4], y: [1, 2], elements: [8, 1]}}}}}}}}
materials: {{m: {{linear_elastic: {{E: 100, nu: 0.3}}}}}}
sections: [{{on: low, material: m, element: plane_strain}}, {{on: high, material: m, element: plane_strain}}]
contact: [{{name: c, master: high.bottom, slave: low.top{}}}]
steps: [{{name: s, increments: 1, prescribe: [{{on: low.bottom, ux: 0, uy: 0}}]}}]
)",
                                         columns, keys);
    const Description d = parse_model(text, "model.yaml");
    return build(d, load_mesh(d)).warnings;
  };
  const std::vector<std::string> told = warnings(", sampling: nodes", 4);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0],
            "contact 'c': the facets of the slave 'low.top' are 2 times as long as those of "
            "'high.bottom', and its nodes alone are tested for contact: pressures are off by some "
            "per cent; name the finer side slave, or use sampling: {gauss: 2} or mortar");
  EXPECT_EQ(warnings(", sampling: nodes", 8).size(), 0u);
  EXPECT_EQ(warnings(", sampling: nodes", 7).size(), 0u);
  EXPECT_EQ(warnings("", 4).size(), 0u);
  EXPECT_EQ(warnings(", sampling: mortar", 4).size(), 0u);
  EXPECT_EQ(warnings(", two_pass: true", 4).size(), 0u);
}

TEST(SamplingKey, TwoPassesHaveHalfOfTheTractionEach) {
  const Built b = built_with("two_pass: true, sampling: {gauss: 2}");
  ASSERT_EQ(b.model.pairs.size(), 4u);
  const auto &first = b.model.pairs[1], &second = b.model.pairs[2];
  EXPECT_EQ(second.name, "gap.reversed");
  EXPECT_EQ(second.group, "gap");
  EXPECT_TRUE(second.reversed);
  EXPECT_EQ(first.definition.pass_factor, 0.5);
  EXPECT_EQ(second.definition.pass_factor, 0.5);
  EXPECT_EQ(first.definition.slave.nodes.size(), 5u);
  EXPECT_EQ(second.definition.slave.points.size(), 8u);
  EXPECT_EQ(second.definition.master.facets.size(), first.definition.slave.boundary.facets.size());
  EXPECT_EQ(b.model.pairs[3].definition.pass_factor, 1);
}

TEST(SamplingKey, RefusesWhatItCannotDo) {
  EXPECT_EQ(refusal_of(gap, gap + ", sampling: {subdomains: 2}"),
            "model.yaml:18: contact[1].sampling: needs one of gauss, lobatto");
  EXPECT_EQ(refusal_of("master: high.bottom, " + gap,
                       "master: low.top, " + gap + ", sampling: {gauss: 2}"),
            "model.yaml:18: contact[1].sampling: contact of a surface with itself is sampled at "
            "nodes only");
  EXPECT_EQ(
      refusal_of("master: high.bottom, " + gap, "master: low.top, " + gap + ", two_pass: true"),
      "model.yaml:18: contact[1].two_pass: contact of a surface with itself has two passes "
      "already");
  EXPECT_EQ(
      refusal_of("slave: high.top, normal: {penalty: 1000}",
                 "slave: high.top, normal: {penalty: 1000}, two_pass: true"),
      "model.yaml:19: contact[2].two_pass: 'punch' is an analytic shape: it has no points to be "
      "a slave");
}

TEST(SamplingKey, MortarIntegratesOverTheFacets) {
  const Built b = built_with("sampling: mortar");
  EXPECT_TRUE(pairing::by_mortar(b.model.pairs[1].definition));
  EXPECT_FALSE(pairing::by_mortar(b.model.pairs[0].definition));
  EXPECT_EQ(b.model.pairs[1].definition.slave.points.size(), 5u);  // its nodes
  const std::string at = "model.yaml:18: contact[1].";
  const auto refusal = [](const std::string& keys) {
    return refusal_of(gap, gap + ", sampling: mortar, " + keys);
  };
  EXPECT_EQ(refusal("weight: node"),
            at + "weight: mortar integrates over areas: use reference_area or current_area");
  EXPECT_EQ(refusal("two_pass: true"),
            at + "two_pass: mortar treats both sides in one pass: leave out two_pass");
  EXPECT_EQ(refusal("residual: full"),
            at + "residual: mortar has its own form of the forces: use surface");
  EXPECT_EQ(refusal("history: chord"),
            at + "history: mortar has its own history, without borders: use continuous");
  EXPECT_EQ(refusal("smoothing: hermite"),
            at + "smoothing: mortar integrates over the facets of the mesh: use none");
  EXPECT_EQ(refusal("tangent: covariant"), at + "tangent: mortar has the consistent tangent only");
  EXPECT_EQ(refusal_of("slave: high.top, normal: {penalty: 1000}",
                       "slave: high.top, normal: {penalty: 1000}, sampling: mortar"),
            "model.yaml:19: contact[2].sampling: 'punch' is an analytic shape: mortar takes sides "
            "with nodes, and other samplings any master");
}

}  // namespace
}  // namespace osculate::deck
