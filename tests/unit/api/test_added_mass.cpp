// What runs and `check` say of mass that is added for longer time steps.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "osculate/api/run.hpp"

namespace osculate::api {
namespace {
namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

/// Two rows of cells of 1 x 2 with c = 10, of which that named `thin` has cells of 0.5: stable
/// steps of 0.1 and 0.05; a mass of 16 each. They rest, and fall on nothing.
std::string rows(const std::string& scheme, const std::string& first_step = "") {
  return fmt::format(R"(osculate: 1
mesh:
  generate:
    thin: {{box: {{x: [0, 8], y: [0, 2], elements: [16, 1]}}}}
    even: {{box: {{x: [0, 8], y: [4, 6], elements: [8, 1]}}}}
materials: {{m: {{linear_elastic: {{E: 100, nu: 0, density: 1}}}}}}
sections:
  - {{on: thin, material: m, element: plane_strain, kinematics: small}}
  - {{on: even, material: m, element: plane_strain, kinematics: small}}
initial_velocity: [{{on: thin, vx: 1}}]
steps: [{}{{name: fly, increments: 2, duration: 1.8, dynamics: {{scheme: {}}}}}]
output: {{fields: none, report: false}}
)",
                     first_step, scheme);
}
std::string scaled(double stable_step) {
  return fmt::format("{{central_differences: {{mass_scaling: {{stable_step: {}}}}}}}", stable_step);
}

struct Ran {
  std::string log;
  nlohmann::json summary;
};

class AddedMass : public ::testing::Test {
 protected:
  const fs::path folder_ =
      fs::path(::testing::TempDir()) / ("osculate_added_mass_" + std::to_string(getpid()));
  void SetUp() override {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] std::string file(const std::string& text) const {
    std::ofstream(folder_ / "model.yaml") << text;
    return (folder_ / "model.yaml").string();
  }
  Ran ran(const std::string& text, bool restart = false) {
    RunOptions options;
    options.model = file(text);
    options.folder = (folder_ / "out").string();
    options.restart = restart;
    Ran out;
    options.say = [&](std::string_view line) { out.log += std::string(line) + "\n"; };
    const RunOutcome outcome = run(options);
    EXPECT_EQ(outcome.status, RunStatus::done) << outcome.message;
    out.summary = nlohmann::json::parse(outcome.summary_json);
    return out;
  }
  CheckReport checked(const std::string& text) { return check(file(text)); }
};

TEST_F(AddedMass, IsToldOfByTheBodyAbsoluteAndAsAShare) {
  const Ran out = ran(rows(scaled(0.051)));
  // 0.051 / 0.05 squared: 4.04 % more
  EXPECT_THAT(out.log, HasSubstr("Added mass    thin             0.6464 (4.04 % of 16) on 16 of 16 "
                                 "cells, up to 1.04 times a cell's mass; step 'fly', stable step "
                                 "of 0.051"));
  EXPECT_THAT(out.log, HasSubstr("Added mass    even             none is needed"));
  EXPECT_THAT(out.log, Not(HasSubstr("warning")));
  const nlohmann::json& masses = out.summary["steps"][0]["mass_scaling"];
  EXPECT_EQ(masses["stable_step"], 0.051);
  EXPECT_EQ(masses["factor"], 1.0);
  EXPECT_EQ(masses["cells"], 16);
  EXPECT_EQ(masses["nodes"], 0);
  EXPECT_NEAR(masses["added"], 0.6464, 1e-10);
  EXPECT_NEAR(masses["share"], 0.0404 / 2, 1e-10);
  ASSERT_EQ(masses["bodies"].size(), 2u);
  EXPECT_EQ(masses["bodies"][0]["name"], "thin");
  EXPECT_NEAR(masses["bodies"][0]["mass"], 16, 1e-10);
  EXPECT_NEAR(masses["bodies"][0]["share"], 0.0404, 1e-10);
  EXPECT_EQ(masses["bodies"][1]["added"], 0.0);
}

TEST_F(AddedMass, OfMuchOfOneBodyIsWarnedOf) {
  const Ran out = ran(rows(scaled(0.052)));
  EXPECT_THAT(out.log, HasSubstr("warning: step 'fly': the stable step of 0.052 adds 8.16 % to the "
                                 "mass of 'thin', more than 5 %"));
  EXPECT_THAT(out.log, Not(HasSubstr("mass of 'even'")));
  // who says the factor himself knows it
  EXPECT_THAT(ran(rows("{central_differences: {mass_scaling: {factor: 100}}}")).log,
              Not(HasSubstr("warning")));
}

TEST_F(AddedMass, IsNoWordOfStepsWithout) {
  const Ran out = ran(rows("central_differences"));
  EXPECT_THAT(out.log, Not(HasSubstr("Added mass")));
  EXPECT_FALSE(out.summary["steps"][0].contains("mass_scaling"));
}

TEST_F(AddedMass, OfALaterStepIsToldOfWhenItBegins) {
  const Ran out =
      ran(rows(scaled(0.052), "{name: wait, increments: 1, duration: 0.1, dynamics: {}}, "));
  EXPECT_LT(out.log.find("wait"), out.log.find("Added mass"));
  EXPECT_FALSE(out.summary["steps"][0].contains("mass_scaling"));
  EXPECT_TRUE(out.summary["steps"][1].contains("mass_scaling"));
}

TEST_F(AddedMass, IsWhatCheckSays) {
  const CheckReport report = checked(rows(scaled(0.052)));
  EXPECT_THAT(report.text, HasSubstr("Time step     fly              0.0468 by quad4 cell"));
  EXPECT_THAT(report.text, HasSubstr("Added mass    thin             1.306 (8.16 % of 16)"));
  EXPECT_THAT(report.text, HasSubstr("warning: step 'fly': the stable step of 0.052 adds 8.16 %"));
  const nlohmann::json json = nlohmann::json::parse(report.json);
  EXPECT_NEAR(json["steps"][0]["mass_scaling"]["bodies"][0]["share"], 0.0816, 1e-10);
}

TEST_F(AddedMass, CheckSaysWhatLongerTimeStepsWouldCost) {
  const CheckReport report = checked(rows("central_differences"));
  EXPECT_THAT(report.text, HasSubstr("0.045 by quad4 cell"));
  EXPECT_THAT(report.text, HasSubstr("`mass_scaling`, 1.5 times as long: 6"));  // 62.5
  EXPECT_THAT(report.text, HasSubstr(" % more mass, 2 times as long: 150 % more mass"));
  const nlohmann::json json = nlohmann::json::parse(report.json);
  const nlohmann::json& longer = json["steps"][0]["time_step"]["longer"];
  ASSERT_EQ(longer.size(), 3u);
  EXPECT_NEAR(longer[0]["share"], 1.25 / 2, 1e-9);
  EXPECT_EQ(longer[0]["cells"], 16);
  EXPECT_NEAR(longer[2]["share"], (8 + 1.25) / 2, 1e-9);
  EXPECT_EQ(longer[2]["cells"], 24);
  EXPECT_TRUE(longer[2]["reached"]);
  EXPECT_THAT(checked(rows("newmark")).text, Not(HasSubstr("Time step")));
}

}  // namespace
}  // namespace osculate::api
