// Models whose linear systems are solved by iterations end where those by factors do.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "deck_test.hpp"
#include "osculate/deck/build.hpp"
#include "osculate/model/analysis.hpp"

namespace osculate::deck {
namespace {

struct Blocks {
  std::string name, cells, material = "{linear_elastic: {E: 200, nu: 0.3}}", contact = "",
                           more = "";
};

/// A block that is pressed onto another one and sheared, with friction.
std::string blocks(const Blocks& of, const std::string& linear) {
  return R"(osculate: 1
mesh:
  generate:
    low: {box: {x: [0, 1], y: [0, 1], z: [0, 1], )" +
         of.cells + R"(}}
    up: {box: {x: [0.1, 0.87], y: [0.1, 0.87], z: [1, 1.6], )" +
         of.cells + R"(}}
materials: {s: )" +
         of.material + R"(}
sections: [{on: low, material: s, element: solid}, {on: up, material: s, element: solid}]
contact: [{name: c, master: low.top, slave: up.bottom, friction: {coulomb: {mu: 0.2}})" +
         of.contact + R"(}]
)" + of.more +
         R"(steps:
  - {name: press, increments: 1, prescribe: [{on: low.bottom, ux: 0, uy: 0, uz: 0}, {on: up.top, ux: 0, uy: 0, uz: -0.01}]}
  - {name: shear, increments: 1, prescribe: [{on: up.top, ux: 0.004}]}
solver: {tolerance: {residual: 1.0e-11}, linear: )" +
         linear + "}\n";
}

model::AnalysisResult3 analysed(const Blocks& of, const std::string& linear, int threads = 1) {
  const Description d = parse_model(blocks(of, linear), "model.yaml");
  Built3 built = build3(d, load_mesh(d));
  built.options.threads = threads;
  return model::run(built.model, built.options, {});
}

class MultigridModels : public ::testing::TestWithParam<Blocks> {};

TEST_P(MultigridModels, EndWhereThoseByFactorsDo) {
  const model::AnalysisResult3 direct = analysed(GetParam(), "direct");
  ASSERT_EQ(direct.outcome, solve::Outcome::converged) << direct.message;
  EXPECT_EQ(direct.linear.solutions, 0);
  const model::AnalysisResult3 multigrid = analysed(GetParam(), "multigrid");
  ASSERT_EQ(multigrid.outcome, solve::Outcome::converged) << multigrid.message;
  EXPECT_GT(multigrid.linear.solutions, 1);
  EXPECT_EQ(multigrid.linear.given_up, 0);
  EXPECT_LT((multigrid.state.u - direct.state.u).norm(), 1e-8 * direct.state.u.norm());
  for (std::size_t step = 0; step < direct.steps.size(); ++step)
    for (std::size_t i = 0; i < direct.steps[step].increments.size(); ++i)
      EXPECT_LE(multigrid.steps[step].increments.at(i).iterations.size(),
                direct.steps[step].increments[i].iterations.size() + 2);
  const model::AnalysisResult3 again = analysed(GetParam(), "multigrid", 2);
  EXPECT_EQ(again.state.u, multigrid.state.u);
}

INSTANTIATE_TEST_SUITE_P(
    Cells, MultigridModels,
    ::testing::Values(
        Blocks{"Hex8", "elements: [6, 6, 6]"}, Blocks{"Hex20", "elements: [4, 4, 4], type: hex20"},
        Blocks{"Hex27", "elements: [3, 3, 3], type: hex27"},
        Blocks{"Rubber", "elements: [6, 6, 6]", "{neo_hooke: {E: 200, nu: 0.45}}"},
        Blocks{"NearlyIncompressible", "elements: [6, 6, 6]", "{neo_hooke: {E: 200, nu: 0.49}}"},
        Blocks{"Mortar", "elements: [6, 6, 6]", "{linear_elastic: {E: 200, nu: 0.3}}",
               ", sampling: mortar"},
        Blocks{"StiffPenalty", "elements: [6, 6, 6]", "{linear_elastic: {E: 200, nu: 0.3}}",
               ", normal: {penalty: 1.0e+6}"},
        Blocks{"Equation", "elements: [6, 6, 6]", "{linear_elastic: {E: 200, nu: 0.3}}", "",
               "equal: [{on: low.left, of: ux}]\n"}),
    [](const ::testing::TestParamInfo<Blocks>& info) { return info.param.name; });

// Coarser models pass from one increment to the next: what is factored is that of contact alone,
// and not in each increment where it sticks.
TEST(MultigridRuns, LaterIncrementsBeginWithWhatIsThere) {
  std::string text = blocks({"Passing", "elements: [6, 6, 6]"}, "multigrid");
  text.replace(text.find("press, increments: 1"), 20, "press, increments: 4");
  const Description d = parse_model(text, "model.yaml");
  Built3 built = build3(d, load_mesh(d));
  const model::AnalysisResult3 found = model::run(built.model, built.options, {});
  ASSERT_EQ(found.outcome, solve::Outcome::converged) << found.message;
  EXPECT_EQ(found.linear.given_up, 0);
  const auto& increments = found.steps[0].increments;
  ASSERT_EQ(increments.size(), 4U);
  EXPECT_TRUE(increments[0].iterations.front().factored);
  EXPECT_FALSE(increments[2].iterations.front().factored);
  EXPECT_FALSE(increments[3].iterations.front().factored);
  const model::AnalysisResult3 direct = [&] {
    text.replace(text.find("linear: multigrid"), 17, "linear: direct");
    const Description by_factors = parse_model(text, "model.yaml");
    Built3 other = build3(by_factors, load_mesh(by_factors));
    return model::run(other.model, other.options, {});
  }();
  EXPECT_LT((found.state.u - direct.state.u).norm(), 1e-8 * direct.state.u.norm());
}

// Multipliers are among the unknowns that are solved for exactly.
TEST(MultigridRuns, MultipliersAreSolvedFor) {
  const Blocks of{"Multipliers", "elements: [6, 6, 6]", "{linear_elastic: {E: 200, nu: 0.3}}",
                  ", sampling: mortar, enforcement: lagrange_multiplier"};
  const model::AnalysisResult3 direct = analysed(of, "direct"),
                               multigrid = analysed(of, "multigrid");
  ASSERT_EQ(direct.outcome, solve::Outcome::converged) << direct.message;
  ASSERT_EQ(multigrid.outcome, solve::Outcome::converged) << multigrid.message;
  EXPECT_GT(multigrid.linear.solutions, 1);
  EXPECT_LT((multigrid.state.u - direct.state.u).norm(), 1e-8 * direct.state.u.norm());
}

// A block that nothing holds ends as it does with factors, which say what is free.
TEST(MultigridRuns, AFreeBodyIsSaidToBeFree) {
  const auto pulled = [](const std::string& linear) {
    std::string text = blocks({"Free", "elements: [6, 6, 6]"}, linear);
    const std::string held = "{on: low.bottom, ux: 0, uy: 0, uz: 0}";
    text.replace(text.find(held), held.size(), "{on: low.bottom, ux: 0, uz: 0}");
    const std::size_t contact = text.find("contact:");
    text.erase(contact, text.find("steps:") - contact);
    const std::string shear = "prescribe: [{on: up.top, ux: 0.004}]";
    text.replace(text.find(shear), shear.size(),
                 "prescribe: [{on: up.top, ux: 0.004}], traction: [{on: low.top, ty: 0.1}]");
    text.replace(text.find("solver: {"), 9, "solver: {cutbacks: 0, ");
    const Description d = parse_model(text, "model.yaml");
    Built3 built = build3(d, load_mesh(d));
    return model::run(built.model, built.options, {});
  };
  const auto up_to_rounding = [](const std::string& message) {
    return message.substr(0, message.find(" (resistance"));
  };
  const model::AnalysisResult3 direct = pulled("direct"), multigrid = pulled("multigrid");
  EXPECT_NE(direct.outcome, solve::Outcome::converged);
  EXPECT_EQ(multigrid.outcome, direct.outcome);
  EXPECT_EQ(up_to_rounding(multigrid.message), up_to_rounding(direct.message));
  EXPECT_NE(multigrid.message.find("'low'"), std::string::npos) << multigrid.message;
  EXPECT_GT(multigrid.linear.given_up, 0);
}

// The middle one of three blocks comes loose within the second step, and is stretched by nothing.
TEST(MultigridRuns, ABodyThatComesLooseIsResisted) {
  const auto analysed_by = [](const std::string& linear) {
    const Description d = parse_model(R"(osculate: 1
mesh:
  generate:
    low: {box: {x: [0, 1], y: [0, 1], z: [0, 1], elements: [6, 6, 6]}}
    mid: {box: {x: [0, 1], y: [0, 1], z: [1, 2], elements: [6, 6, 6]}}
    up: {box: {x: [0, 1], y: [0, 1], z: [2, 3], elements: [6, 6, 6]}}
materials: {s: {linear_elastic: {E: 200, nu: 0.3}}}
sections: [{on: low, material: s, element: solid}, {on: mid, material: s, element: solid}, {on: up, material: s, element: solid}]
contact:
  - {name: a, master: low.top, slave: mid.bottom}
  - {name: b, master: mid.top, slave: up.bottom}
steps:
  - name: press
    increments: 1
    prescribe:
      - {on: low.bottom, ux: 0, uy: 0, uz: 0}
      - {on: up.top, ux: 0, uy: 0, uz: -0.01}
      - {on: mid.left, ux: 0}
      - {on: mid.front, uy: 0}
  - {name: part, increments: 1, prescribe: [{on: low.bottom, uz: -0.01}, {on: up.top, uz: 0.01}]}
solver: {linear: )" + linear + "}\n",
                                      "model.yaml");
    Built3 built = build3(d, load_mesh(d));
    return model::run(built.model, built.options, {});
  };
  const model::AnalysisResult3 direct = analysed_by("direct"), multigrid = analysed_by("multigrid");
  ASSERT_EQ(multigrid.outcome, direct.outcome) << multigrid.message;
  ASSERT_EQ(direct.outcome, solve::Outcome::converged) << direct.message;
  EXPECT_GT(multigrid.linear.solutions, 0);
  ASSERT_TRUE(direct.steps[1].increments.back().resisted);
  EXPECT_TRUE(multigrid.steps[1].increments.back().resisted);
}

TEST(MultigridRuns, APlaneOne) {
  const auto text = [](const std::string& linear) {
    return R"(osculate: 1
mesh:
  generate:
    low: {box: {x: [0, 2], y: [0, 1], elements: [40, 20]}}
    up: {box: {x: [0.5, 1.5], y: [1, 1.8], elements: [23, 17]}}
materials: {s: {linear_elastic: {E: 200, nu: 0.3}}}
sections: [{on: low, material: s, element: plane_strain}, {on: up, material: s, element: plane_strain}]
contact: [{name: c, master: low.top, slave: up.bottom, friction: {coulomb: {mu: 0.2}}}]
steps:
  - {name: press, increments: 1, prescribe: [{on: low.bottom, ux: 0, uy: 0}, {on: up.top, ux: 0, uy: -0.01}]}
  - {name: shear, increments: 1, prescribe: [{on: up.top, ux: 0.004}]}
solver: {tolerance: {residual: 1.0e-11}, linear: )" +
           linear + "}\n";
  };
  const auto analyse = [&](const std::string& linear) {
    const Description d = parse_model(text(linear), "model.yaml");
    const Built built = build(d, load_mesh(d));
    return model::run(built.model, built.options, {});
  };
  const model::AnalysisResult direct = analyse("direct"), multigrid = analyse("multigrid");
  ASSERT_EQ(direct.outcome, solve::Outcome::converged) << direct.message;
  ASSERT_EQ(multigrid.outcome, solve::Outcome::converged) << multigrid.message;
  EXPECT_EQ(multigrid.linear.given_up, 0);
  EXPECT_GT(multigrid.linear.solutions, 1);
  EXPECT_LT((multigrid.state.u - direct.state.u).norm(), 1e-8 * direct.state.u.norm());
}

}  // namespace
}  // namespace osculate::deck
