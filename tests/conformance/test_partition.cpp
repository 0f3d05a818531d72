// Whole analyses with contact and friction by three and eight processes, nodes dealt out by METIS
// and one by one at random: to the last bit what one process does.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "by_ranks.hpp"
#include "effort.hpp"
#include "osculate/deck/parse.hpp"

namespace osculate {
namespace {

struct Analysis {
  std::string name, pair;
  std::string material = "{st_venant_kirchhoff: {E: 100, nu: 0.3}}";
  std::string more_of_drag = "";
};

const std::string plastic = "{elastoplastic: {E: 100, nu: 0.3, hardening: [[1, 0], [11, 1]]}}";
const std::string heavy = "{neo_hooke: {E: 100, nu: 0.3, density: 0.01}}";

/// A block pressed on a longer one and dragged along it, until all of it slides.
std::string in_the_plane(const Analysis& of) {
  return fmt::format(
      "osculate: 1\nmesh:\n  generate:\n"
      "    low: {{box: {{x: [0, 3], y: [0, 1], elements: [12, 3]}}}}\n"
      "    up: {{box: {{x: [0.3, 1.45], y: [1, 1.8], elements: [6, 3]}}}}\n"
      "materials: {{m: {}}}\nsections:\n  - {{on: low, material: m, element: plane_strain}}\n"
      "  - {{on: up, material: m, element: plane_strain}}\n"
      "contact: [{{name: c, master: low.top, slave: up.bottom, friction: {{coulomb: {{mu: 0.3}}}}, "
      "{}}}]\nsteps:\n"
      "  - {{name: press, increments: 2, prescribe: [{{on: low.bottom, ux: 0, uy: 0}}, {{on: "
      "up.top, "
      "ux: 0, uy: -0.03}}]}}\n"
      "  - {{name: drag, increments: 4, {}prescribe: [{{on: up.top, ux: 0.3}}]}}\n"
      "output: {{history: [{{on: c, of: normal_force}}, {{on: c, of: force_x}}, {{on: up.top, of: "
      "rfx}}, {{on: low.bottom, of: rfy}}]}}\n",
      of.material, of.pair, of.more_of_drag);
}

std::string in_space(const Analysis& of) {
  return fmt::format(
      "osculate: 1\nmesh:\n  generate:\n"
      "    low: {{box: {{x: [0, 3], y: [0, 2], z: [0, 1], elements: [5, 3, 1]}}}}\n"
      "    up: {{box: {{x: [0.3, 1.4], y: [0.4, 1.5], z: [1, 1.8], elements: [3, 3, 2]}}}}\n"
      "materials: {{m: {}}}\nsections:\n  - {{on: low, material: m, element: solid}}\n"
      "  - {{on: up, material: m, element: solid}}\n"
      "contact: [{{name: c, master: low.top, slave: up.bottom, friction: {{coulomb: {{mu: 0.3}}}}, "
      "{}}}]\nsteps:\n"
      "  - {{name: press, increments: 2, prescribe: [{{on: low.bottom, ux: 0, uy: 0, uz: 0}}, "
      "{{on: "
      "up.top, ux: 0, uy: 0, uz: -0.03}}]}}\n"
      "  - {{name: drag, increments: 3, {}prescribe: [{{on: up.top, ux: 0.3, uy: 0.1}}]}}\n"
      "output: {{history: [{{on: c, of: normal_force}}, {{on: c, of: force_x}}, {{on: up.top, of: "
      "rfz}}]}}\n",
      of.material, of.pair, of.more_of_drag);
}

const std::vector<Analysis> analyses{
    {"nodes", "sampling: nodes"},
    {"gauss", "sampling: {gauss: 2}"},
    {"smoothed", "sampling: {gauss: 2}, smoothing: hermite"},
    {"augmented", "sampling: {gauss: 2}, enforcement: augmented_lagrange"},
    {"multipliers", "enforcement: lagrange_multiplier"},
    {"mortar", "sampling: mortar"},
    {"mortar_multipliers", "sampling: mortar, enforcement: lagrange_multiplier"},
    {"two_pass", "sampling: nodes, two_pass: true"},
    {"plastic", "sampling: {lobatto: 3}", plastic},
    {"swung", "sampling: nodes", heavy, "duration: 0.04, dynamics: {}, "}};

class Partition : public ::testing::TestWithParam<Analysis> {};

template <int Dim>
void expect_no_difference(const std::string& text) {
  SCOPED_TRACE(text);
  const deck::Description description = deck::parse_model(text, "generated.yaml");
  const auto built =
      std::get<deck::BasicBuilt<Dim>>(deck::build_any(description, deck::load_mesh(description)));
  const testing::Outcome alone = testing::analysed<Dim>(built, nullptr);
  ASSERT_EQ(alone.outcome, solve::Outcome::converged) << alone.message;
  const std::vector<int> last(alone.counts.end() - 4, alone.counts.end());
  EXPECT_GT(last[1] + last[2] + last[3], 0);  // in contact
  for (const int count : {3, 8})
    if (count == 3 || !testing::sanitized) testing::expect_the_same_by<Dim>(count, built, alone);
}

TEST_P(Partition, OfThePlaneShowsInNoBit) { expect_no_difference<2>(in_the_plane(GetParam())); }
TEST_P(Partition, OfSpaceShowsInNoBit) { expect_no_difference<3>(in_space(GetParam())); }

/// A block slides as far as it is long, in one step: partners in contact are others at the end.
TEST(Partition, ChangesWithinAStep) {
  const std::string text =
      "osculate: 1\nmesh:\n  generate:\n"
      "    low: {box: {x: [0, 6], y: [0, 0.2], elements: [60, 1]}}\n"
      "    up: {box: {x: [0.22, 2.62], y: [0.2, 0.5], elements: [24, 2]}}\n"
      "materials: {m: {st_venant_kirchhoff: {E: 100, nu: 0.3}}}\nsections:\n"
      "  - {on: low, material: m, element: plane_strain}\n"
      "  - {on: up, material: m, element: plane_strain}\n"
      "contact: [{name: c, master: low.top, slave: up.bottom, sampling: nodes, friction: {coulomb: "
      "{mu: 0.2}}}]\n"
      "steps: [{name: slide, increments: 6, prescribe: [{on: low.bottom, ux: 0, uy: 0}, {on: "
      "up.top, "
      "ux: 2.4, uy: -0.002}]}]\n"
      "output: {history: [{on: c, of: normal_force}, {on: c, of: force_x}]}\n";
  const deck::Description description = deck::parse_model(text, "generated.yaml");
  const auto built =
      std::get<deck::BasicBuilt<2>>(deck::build_any(description, deck::load_mesh(description)));
  const testing::Outcome alone = testing::analysed<2>(built, nullptr);
  ASSERT_EQ(alone.outcome, solve::Outcome::converged) << alone.message;
  testing::expect_the_same_by<2>(2, built, alone, 0, 2);
}

INSTANTIATE_TEST_SUITE_P(Of, Partition, ::testing::ValuesIn(analyses),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace osculate
