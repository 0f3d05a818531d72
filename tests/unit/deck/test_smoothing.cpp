// The keys `smoothing` and `history` of a contact pair: what they build, what they refuse, and the
// tangent of whole systems.
#include "system_test.hpp"

namespace osculate::deck {
namespace {

/// A block with an arched upper side under a flat one that overlaps it by about 0.05.
std::string blocks(const std::string& keys, const std::string& type = "quad4") {
  return "osculate: 1\nmesh: {generate: {low: {box: {x: [0, 2], y: [0, 1], elements: [5, 1], "
         "type: " +
         type +
         ", crown: {side: top, radius: 8}}}, up: {box: {x: [0.3, 1.6], y: [0.97, 1.5], elements: "
         "[3, 1]}}}}\nmaterials: {m: {neo_hooke: {E: 100, nu: 0.3}}}\nsections: [{on: low, "
         "material: m, element: plane_strain}, {on: up, material: m, element: plane_strain}]\n"
         "contact: [{name: c, master: low.top, slave: up.bottom, normal: {penalty: 500}, " +
         keys +
         "}]\nsteps: [{name: s, increments: 1, prescribe: [{on: low.bottom, ux: 0, uy: 0}, {on: "
         "up.top, ux: 0.05, uy: -0.05}]}]\n";
}

TEST(SmoothingKey, BuildsSmoothFacets) {
  for (const std::string kind : {"hermite", "nurbs"}) {
    const Built built = build_text(blocks("smoothing: " + kind));
    const auto& facets = built.model.pairs[0].definition.master.facets;
    ASSERT_EQ(facets.size(), 5u);
    for (const pairing::Facet& facet : facets) {
      ASSERT_TRUE(facet.bezier);
      EXPECT_EQ(facet.bezier->degree, kind == "nurbs" ? 5u : 3u);
    }
    EXPECT_EQ(facets[0].count, 3);  // an end
    EXPECT_EQ(facets[2].count, 4);
    EXPECT_FALSE(built.model.pairs[0].definition.slave.boundary.facets[0].bezier);
  }
  EXPECT_FALSE(
      build_text(blocks("smoothing: none")).model.pairs[0].definition.master.facets[0].bezier);
  const Built sharp = build_text(blocks("smoothing: {kind: hermite, angle: 0.01}"));
  EXPECT_FALSE(sharp.model.pairs[0].definition.master.facets[0].bezier);  // all corners are sharper
}

TEST(SmoothingKey, TwoPassesSmoothBothMasters) {
  const Built built = build_text(blocks("smoothing: hermite, two_pass: true"));
  ASSERT_EQ(built.model.pairs.size(), 2u);
  EXPECT_TRUE(built.model.pairs[0].definition.master.facets[0].bezier);
  EXPECT_TRUE(built.model.pairs[1].definition.master.facets[0].bezier);
}

TEST(SmoothingKey, TangentOfTheSystem) {
  for (const std::string smoothing : {"hermite", "nurbs"})
    for (const std::string friction : {"none", "{coulomb: {mu: 0.3, penalty: 300}}"})
      for (const std::string form : {"surface", "full"}) {
        SCOPED_TRACE(smoothing + " " + friction + " " + form);
        Probe probe(
            blocks("smoothing: " + smoothing + ", friction: " + friction + ", residual: " + form));
        const auto counts = probe.at(probe.base, false).counts;
        EXPECT_GT(counts.touching(), 1);
        const testing::DerivativeReport report = check_tangent_of(probe);
        EXPECT_TRUE(report.exact || std::abs(report.order - 2.0) < 0.1)
            << "order " << report.order << ", error " << report.error;
      }
}

/// Two boxes in space, the upper one 0.02 deep in the lower one.
std::string boxes(const std::string& keys) {
  return "osculate: 1\nmesh: {generate: {low: {box: {x: [0, 2], y: [0, 2], z: [0, 1], elements: "
         "[3, 3, 1]}}, up: {box: {x: [0.3, 1.6], y: [0.4, 1.5], z: [0.98, 1.5], elements: [1, 1, "
         "1]}}}}\nmaterials: {m: {linear_elastic: {E: 100, nu: 0.3}}}\nsections: [{on: low, "
         "material: m, element: solid}, {on: up, material: m, element: solid}]\ncontact: [{name: "
         "c, master: low.top, slave: up.bottom, normal: {penalty: 500}, " +
         keys +
         "}]\nsteps: [{name: s, increments: 1, prescribe: [{on: low.bottom, ux: 0, uy: 0, uz: "
         "0}]}]\n";
}

TEST(SmoothingKey, BuildsSmoothPatchesInSpace) {
  const Description d = parse_model(boxes("smoothing: hermite"), "model.yaml");
  const Built3 built = build3(d, load_mesh(d));
  const auto& facets = built.model.pairs[0].definition.master.facets;
  ASSERT_EQ(facets.size(), 9u);
  for (const pairing::SurfaceFacet& facet : facets) EXPECT_TRUE(facet.patch);
  const Description nurbs = parse_model(boxes("smoothing: nurbs"), "model.yaml");
  try {
    (void)build3(nurbs, load_mesh(nurbs));
    FAIL();
  } catch (const core::InputError& error) {
    EXPECT_STREQ(error.what(),
                 "model.yaml:5: contact[0].smoothing: nurbs is for plane models; in space use "
                 "hermite");
  }
}

TEST(HistoryKey, ChoosesTheRule) {
  using pairing::HistoryRule;
  const auto rule = [](const std::string& word) {
    return build_text(blocks("history: " + word)).model.pairs[0].definition.history;
  };
  EXPECT_EQ(rule("continuous"), HistoryRule::continuous);
  EXPECT_EQ(rule("chord"), HistoryRule::chord);
  EXPECT_EQ(rule("per_facet"), HistoryRule::per_facet);
}

TEST(SmoothingKey, Broken) {
  const std::string at = "model.yaml:5: contact[0].smoothing: ";
  EXPECT_EQ(build_refusal(blocks("smoothing: hermite", "quad9")),
            at + "the master 'low.top' has facets of higher order; smoothing is for first-order "
                 "ones");
  EXPECT_EQ(
      build_refusal(edited(blocks("smoothing: hermite"), "slave: up.bottom", "slave: low.top")),
      at + "a surface that touches itself cannot be smoothed");
  const std::string rigid =
      edited(blocks("smoothing: nurbs"),
             "contact:", "rigid: {disc: {circle: {center: [1, -3], radius: 4}}}\ncontact:");
  EXPECT_EQ(build_refusal(edited(rigid, "master: low.top", "master: disc")),
            "model.yaml:6: contact[0].smoothing: the master 'disc' is an analytic shape, which "
            "needs no smoothing");
  EXPECT_EQ(build_refusal(blocks("smoothing: cubic")),
            at + "expected none, hermite, nurbs or a map, got the text 'cubic'");
}

}  // namespace
}  // namespace osculate::deck
