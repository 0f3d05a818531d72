// What is told of contact points: with friction they stick or slide, without it they are closed.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "osculate/api/run.hpp"
#include "osculate/api/tangent_check.hpp"

namespace osculate::api {
namespace {
namespace fs = std::filesystem;

/// Three blocks on a floor, pressed and dragged by 0.03: `rough` sticks, `dry` slides, `wet` has no
/// friction; `high` stays above. Three nodes each; the elastic give is 0.02 * 100 / eps_T.
constexpr const char* blocks_on_floor = R"(osculate: 1
title: Blocks on a floor
mesh:
  generate:
    rough: {box: {x: [0, 1], y: [0, 1], elements: [2, 1]}}
    dry: {box: {x: [2, 3], y: [0, 1], elements: [2, 1]}}
    wet: {box: {x: [4, 5], y: [0, 1], elements: [2, 1]}}
    high: {box: {x: [6, 7], y: [1, 2], elements: [2, 1]}}
materials: {m: {linear_elastic: {E: 1.0e4, nu: 0, density: 1}}}
sections:
  - {on: rough, material: m, element: plane_strain}
  - {on: dry, material: m, element: plane_strain}
  - {on: wet, material: m, element: plane_strain}
  - {on: high, material: m, element: plane_strain}
rigid: {floor: {line: {point: [0, 0], normal: [0, 1]}}}
)";
constexpr const char* pairs_of_blocks = R"(contact:
  - {name: rough, master: floor, slave: rough.bottom, normal: {penalty: 100}, friction: {coulomb: {mu: 9, penalty: 100}}}
  - {name: dry, master: floor, slave: dry.bottom, normal: {penalty: 100}, friction: {coulomb: {mu: 0.1, penalty: 100}}}
  - {name: wet, master: floor, slave: wet.bottom, normal: {penalty: 100}}
  - {name: high, master: floor, slave: high.bottom, normal: {penalty: 100}}
)";
constexpr const char* all_of_blocks =
    "contact: {all: {normal: {penalty: 100}, friction: {coulomb: {mu: 0.1, penalty: 100}}}}\n";

struct PointStatesOf : ::testing::Test {
  fs::path folder = fs::path(::testing::TempDir()) /
                    ("osculate_states_" +
                     std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
  void SetUp() override {
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  void TearDown() override { fs::remove_all(folder); }

  [[nodiscard]] std::string model() const { return (folder / "model.yaml").string(); }
  [[nodiscard]] std::string text_of(const std::string& name) const {
    std::ifstream file(folder / "out" / name);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }
  /// The last increment of summary.json.
  nlohmann::json run_model(const std::string& contact, const std::string& on,
                           const std::string& extra = {}) {
    std::ofstream(model()) << blocks_on_floor << contact
                           << "steps:\n  - {name: drag, increments: 2, " << extra << "prescribe: [";
    for (const std::string block : {"rough", "dry", "wet", "high"})
      std::ofstream(model(), std::ios::app)
          << "{on: " << block << ", ux: 0.03, uy: -0.02}" << (block == "high" ? "]}\n" : ", ");
    std::ofstream file(model(), std::ios::app);
    file << "output: {history: [";
    std::istringstream names(on);
    for (std::string name; names >> name;)
      for (const std::string of : {"open", "stick", "slipping", "closed", "slip"})
        file << "{on: " << name << ", of: " << of << "},";
    file << "]}\n";
    file.close();
    RunOptions options;
    options.model = model();
    options.folder = (folder / "out").string();
    const RunOutcome outcome = run(options);
    EXPECT_EQ(outcome.status, RunStatus::done) << outcome.message;
    return nlohmann::json::parse(text_of("summary.json"))["steps"][0]["increments"].back();
  }
  /// The last row of history.csv by column.
  [[nodiscard]] std::map<std::string, double> last_row() const {
    std::istringstream table(text_of("history.csv"));
    std::string names, line, last;
    std::getline(table, names);
    while (std::getline(table, line)) last = line;
    std::map<std::string, double> row;
    std::istringstream a(names), b(last);
    for (std::string name, value; std::getline(a, name, ',') && std::getline(b, value, ',');)
      row[name] = name == "step" ? 0 : std::stod(value);
    return row;
  }
};

void expect_counts(const nlohmann::json& found, int open, int stick, int slipping, int closed) {
  EXPECT_EQ(found["open"], open);
  EXPECT_EQ(found["stick"], stick);
  EXPECT_EQ(found["slipping"], slipping);
  EXPECT_EQ(found["closed"], closed);
  EXPECT_FALSE(found.contains("slip"));
}

TEST_F(PointStatesOf, ARunCountsThemByWhatHoldsThem) {
  expect_counts(run_model(pairs_of_blocks, "rough dry wet high"), 3, 3, 3, 3);
  const std::string log = text_of("log.txt");
  EXPECT_NE(log.find("  open 3 stick 3 slipping 3 closed 3"), std::string::npos) << log;
  std::map<std::string, double> row = last_row();
  const auto expect = [&](const std::string& pair, int open, int stick, int slipping, double slip) {
    EXPECT_EQ(row.at(pair + ".open"), open) << pair;
    EXPECT_EQ(row.at(pair + ".stick"), stick) << pair;
    EXPECT_EQ(row.at(pair + ".slipping"), slipping) << pair;
    EXPECT_EQ(row.at(pair + ".closed"), 3 - open) << pair;
    EXPECT_NEAR(row.at(pair + ".slip"), slip, 1e-12) << pair;
  };
  expect("rough", 0, 3, 0, 0.03);
  expect("dry", 0, 0, 3, 0.03);
  expect("wet", 0, 0, 0, 0);
  expect("high", 3, 0, 0, 0);
}

TEST_F(PointStatesOf, TheLogNamesThoseThatThereCanBe) {
  std::string contact = pairs_of_blocks;
  const std::size_t wet = contact.find("  - {name: wet");
  (void)run_model(contact.substr(0, wet), "rough");
  EXPECT_NE(text_of("log.txt").find("  open 0 stick 3 slipping 3\n"), std::string::npos);
  (void)run_model("contact:\n" + contact.substr(wet), "wet");
  EXPECT_NE(text_of("log.txt").find("  open 3 closed 3\n"), std::string::npos);
  const TangentReport report = check_tangent(model(), 1);
  EXPECT_TRUE(to_text(report).starts_with("contact points: open 3 closed 3\n")) << to_text(report);
  const nlohmann::json json = nlohmann::json::parse(to_json(report));
  expect_counts(json, 3, 0, 0, 3);
  (void)run_model("", "");
  EXPECT_EQ(text_of("log.txt").find("open"), std::string::npos) << text_of("log.txt");
}

TEST_F(PointStatesOf, ExplicitTimeIntegrationCountsThemAlike) {
  expect_counts(run_model(pairs_of_blocks, "wet",
                          "duration: 0.01, dynamics: {scheme: central_differences}, "),
                3, 3, 3, 3);
  EXPECT_NE(text_of("log.txt").find("  open 3 stick 3 slipping 3 closed 3\n"), std::string::npos);
}

TEST_F(PointStatesOf, OfSeveralPairsTheLargestSlipAndTheSumOfThePoints) {
  (void)run_model(all_of_blocks, "all all.1-floor");
  std::map<std::string, double> row = last_row();
  EXPECT_NEAR(row.at("all.slip"), 0.03, 1e-12);
  EXPECT_NEAR(row.at("all.1-floor.slip"), 0.03, 1e-12);
  EXPECT_EQ(row.at("all.1-floor.slipping"), 3);
  EXPECT_EQ(row.at("all.slipping"), 9);
  EXPECT_EQ(row.at("all.closed"), 9);
}

}  // namespace
}  // namespace osculate::api
