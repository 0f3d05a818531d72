#include "osculate/api/run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "osculate/core/error.hpp"
#include "osculate/io/report_bundle.hpp"

namespace osculate::api {
namespace {
namespace fs = std::filesystem;

constexpr const char* model =
    "osculate: 1\n"
    "title: Block on a rail\n"
    "mesh: {generate: {block: {box: {x: [0, 2], y: [0, 1], elements: [4, 2]}}, rail: {line: "
    "{points: [[-1, 0], [3, 0]], elements: 4}}}}\n"
    "materials: {m: {linear_elastic: {E: 100, nu: 0.3}}}\n"
    "sections: [{on: block, material: m, element: plane_strain}]\n"
    "rigid: {base: {set: rail}}\n"
    "contact: [{name: floor, master: base, slave: block.bottom, normal: {penalty: 1e4}}]\n"
    "steps:\n"
    "  - {name: press, increments: 2, prescribe: [{on: block.top, ux: 0, uy: -0.01}]}\n"
    "  - {name: more, increments: 3, prescribe: [{on: block.top, uy: -0.02}]}\n"
    "output:\n"
    "  history: [{on: block.top, of: rfy}, {on: floor, of: normal_force}, {on: base, of: rfy, "
    "name: base force}]\n";

std::string edited(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::runtime_error("no '" + from + "'");
  return text.replace(at, from.size(), to);
}

struct Run : ::testing::Test {
  fs::path folder = fs::path(::testing::TempDir()) /
                    ("osculate_run_" +
                     std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
  fs::path results = folder / "out";

  void SetUp() override {
    fs::remove_all(folder);
    fs::create_directories(folder);
    write("model.yaml", model);
  }
  void TearDown() override { fs::remove_all(folder); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder / name) << text;
  }
  [[nodiscard]] static std::string read(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    EXPECT_TRUE(file) << path;
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }
  [[nodiscard]] nlohmann::json summary() const {
    return nlohmann::json::parse(read(results / "summary.json"));
  }
  [[nodiscard]] RunOptions options(const std::string& name = "model.yaml") const {
    RunOptions o;
    o.model = (folder / name).string();
    o.folder = results.string();
    return o;
  }
  [[nodiscard]] std::string refusal(const RunOptions& o) const {
    try {
      (void)run(o);
    } catch (const core::InputError& error) {
      return std::regex_replace(std::string(error.what()), std::regex(folder.string() + "/"), "");
    }
    return {};
  }
  [[nodiscard]] std::set<std::string> files() const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(results))
      names.insert(entry.path().filename().string());
    return names;
  }
};

std::vector<std::vector<std::string>> table(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

TEST_F(Run, WritesItsFiles) {
  const RunOutcome outcome = run(options());
  EXPECT_EQ(outcome.status, RunStatus::done);
  EXPECT_EQ(outcome.message, "");
  EXPECT_EQ(outcome.folder, results.string());
  std::set<std::string> expected{
      "summary.json", "history.csv", "results.pvd", "written.txt",    "report.json",
      "report.html",  "log.txt",     "journal.bin", "checkpoint.bin", "checkpoint.previous.bin"};
  expected.insert("iterations.csv");
  for (int i = 0; i < 6; ++i) {
    expected.insert("bodies_0000" + std::to_string(i) + ".vtu");
    expected.insert("rigid_0000" + std::to_string(i) + ".vtu");
    expected.insert("contact0_0000" + std::to_string(i) + ".vtu");
  }
  EXPECT_EQ(files(), expected);
  const std::string pvd = read(results / "results.pvd");
  for (const std::string& name : expected)
    EXPECT_EQ(pvd.find("\"" + name + "\"") != std::string::npos, name.ends_with(".vtu")) << name;
}

/// One row a point: number, place, and the fields of the VTU beside it.
TEST_F(Run, ContactPointsAreTablesOnRequest) {
  write("model.yaml", edited(model, "output:\n", "output:\n  contact_points: true\n"));
  EXPECT_EQ(run(options()).status, RunStatus::done);
  EXPECT_TRUE(files().contains("contact0_00005.csv"));
  const auto rows = table(read(results / "contact0_00005.csv"));
  ASSERT_EQ(rows.size(), 6u);
  const std::vector<std::string> head(rows[0].begin(), rows[0].begin() + 7);
  EXPECT_EQ(head, (std::vector<std::string>{"NodeNumber", "place_X", "place_Y", "place_Z", "U_X",
                                            "U_Y", "U_Z"}));
  EXPECT_EQ(rows[0].size(), 7u + 12);
  double force = 0;
  const auto column = std::find(rows[0].begin(), rows[0].end(), "CNFORCE") - rows[0].begin();
  for (std::size_t i = 1; i < rows.size(); ++i)
    force += std::stod(rows[i].at(static_cast<std::size_t>(column)));
  const auto history = table(read(results / "history.csv"));
  EXPECT_NEAR(force, std::stod(history.back().at(4)), 1e-9 * force);
  EXPECT_EQ(run(options()).status, RunStatus::done);
  EXPECT_TRUE(files().contains("contact0_00005.csv"));
  write("model.yaml", model);
  EXPECT_EQ(run(options()).status, RunStatus::done);
  EXPECT_FALSE(files().contains("contact0_00005.csv"));
}

TEST_F(Run, SummaryTellsWhatHappened) {
  const RunOutcome outcome = run(options());
  const nlohmann::json s = summary();
  EXPECT_EQ(nlohmann::json::parse(outcome.summary_json), s);
  EXPECT_EQ(s["status"], "done");
  EXPECT_EQ(s["model"], "model.yaml");
  EXPECT_EQ(s["message"], "");
  EXPECT_EQ(s["unknowns"], 2 * 15 + 3);
  EXPECT_EQ(s["total"]["increments"], 5);
  EXPECT_EQ(s["total"]["cutbacks"], 0);
  EXPECT_GT(s["peak_memory_mb"], 1);
  for (const char* phase :
       {"input", "analysis", "contact", "bulk", "assembly", "solver", "output", "total"})
    EXPECT_GE(s["seconds"][phase], 0);
  ASSERT_EQ(s["steps"].size(), 2u);
  EXPECT_EQ(s["steps"][0]["name"], "press");
  ASSERT_EQ(s["steps"][1]["increments"].size(), 3u);
  int iterations = 0;
  for (const auto& step : s["steps"])
    for (const auto& increment : step["increments"]) {
      iterations += increment["iterations"].get<int>();
      EXPECT_LE(increment["residual"], 1e-9);
      EXPECT_LE(increment["energy"], 1e-12);
      EXPECT_EQ(increment["open"].get<int>() + increment["closed"].get<int>(), 5);
      EXPECT_EQ(increment["stick"].get<int>() + increment["slipping"].get<int>(), 0);
      EXPECT_EQ(increment["residuals"].size(), increment["iterations"]);
      // on segments of length 1: the largest penetration of points between their ends (KSVD:60)
      const double pressure = 100 / (1 - 0.3 * 0.3) * 0.02 * increment["time"].get<double>() / 2;
      EXPECT_NEAR(increment["curvature_share"], pressure / 1e4, 0.3 * pressure / 1e4);
    }
  EXPECT_EQ(s["total"]["iterations"], iterations);
  EXPECT_DOUBLE_EQ(s["steps"][1]["increments"][1]["time"], 1 + 2.0 / 3);
}

// The block is pressed and dragged: mu N times the way, less what is elastic (and the little that
// the way to the verge of sliding differs from point to point).
TEST_F(Run, SummaryHasTheWorkOfFriction) {
  std::string text = edited(model, "normal: {penalty: 1e4}",
                            "normal: {penalty: 1e4}, friction: {coulomb: {mu: 0.2, penalty: 1e4}}");
  text = edited(text, "[{on: block.top, uy: -0.02}]", "[{on: block.top, ux: 0.05}]");
  text = edited(text, "{on: floor, of: normal_force}", "{on: floor, of: friction_work}");
  write("model.yaml", text);
  ASSERT_EQ(run(options()).status, RunStatus::done);
  const nlohmann::json s = summary();
  double last = s["steps"][0]["increments"][1]["friction_work"];
  EXPECT_GE(last, 0.0);
  for (const nlohmann::json& increment : s["steps"][1]["increments"]) {
    EXPECT_GT(increment["friction_work"], last);
    last = increment["friction_work"];
  }
  const auto rows = table(read(results / "history.csv"));
  const auto column = std::find(rows[0].begin(), rows[0].end(), "floor.friction_work");
  ASSERT_NE(column, rows[0].end());
  const double at_end = std::stod(rows.back()[static_cast<std::size_t>(column - rows[0].begin())]);
  EXPECT_NEAR(at_end, last, 1e-15);
}

TEST_F(Run, HistoryHasOneColumnPerRequest) {
  (void)run(options());
  const auto rows = table(read(results / "history.csv"));
  ASSERT_EQ(rows.size(), 1 + 1 + 5u);  // header, initial state, increments
  EXPECT_EQ(rows[0], (std::vector<std::string>{"step", "increment", "time", "block.top.rfy",
                                               "floor.normal_force", "base force"}));
  EXPECT_EQ(rows[4][0], "2");
  EXPECT_EQ(rows[4][1], "1");
  for (std::size_t i = 2; i < rows.size(); ++i) {
    ASSERT_EQ(rows[i].size(), 6u);
    const double top = std::stod(rows[i][3]), floor = std::stod(rows[i][4]);
    EXPECT_LT(top, 0);
    EXPECT_NEAR(top / floor, -1, 1e-9);
    EXPECT_NEAR(std::stod(rows[i][5]) / floor, 1, 1e-9);
  }
}

TEST_F(Run, ReportIsOffline) {
  (void)run(options());
  const nlohmann::json data = nlohmann::json::parse(read(results / "report.json"));
  EXPECT_EQ(data["title"], "Block on a rail");
  EXPECT_EQ(data["history"]["rows"].size(), 6u);
  EXPECT_EQ(data["frames"].size(), 6u);
  EXPECT_EQ(data["iterations"].size(), 5u);
  std::string html = read(results / "report.html");
  // The bundled libraries name addresses in comments and name spaces; nothing of ours does.
  const std::string_view bundle = io::report_bundle();
  const std::size_t at = html.find(bundle.substr(0, 200));
  ASSERT_NE(at, std::string::npos);
  html.erase(at, bundle.size());
  EXPECT_EQ(html.find("http://"), std::string::npos);
  EXPECT_EQ(html.find("https://"), std::string::npos);
  EXPECT_FALSE(std::regex_search(html, std::regex("(src|href)=\"(?!data:)|@import|url\\(")));
  const std::string before = read(results / "report.html");
  fs::remove(results / "report.html");
  rewrite_report(results.string());
  EXPECT_EQ(read(results / "report.html"), before);
}

/// Of more frames than the page holds every second is dropped, but never the first and the last.
TEST_F(Run, ReportKeepsTheFirstAndTheLastFrame) {
  write("model.yaml", edited(model, "increments: 2", "increments: 62"));
  (void)run(options());
  const nlohmann::json data = nlohmann::json::parse(read(results / "report.json"));
  EXPECT_EQ(data["frames"].size(), 34u);  // 0, 2, ..., 64 of 65, and the last
  EXPECT_EQ(data["frames"][0]["time"], 0);
  EXPECT_EQ(data["frames"][33]["time"], 2);
  EXPECT_EQ(data["frames"][32]["increment"], 2);
  EXPECT_EQ(data["rigid"][0]["polyline"].size(), 34u);
}

TEST_F(Run, AnOccupiedFolderIsRefused) {
  fs::create_directories(results);
  std::ofstream(results / "precious.txt") << "mine";
  EXPECT_EQ(refusal(options()),
            "folder 'out' is not empty and holds no results of 'model.yaml'; name another one "
            "with -o");
  EXPECT_EQ(files(), std::set<std::string>{"precious.txt"});
  fs::remove(results / "precious.txt");
  EXPECT_EQ(refusal(options()), "");  // empty: used
  EXPECT_EQ(refusal(options()), "");  // of the same model: replaced
  write("other.yaml", model);
  EXPECT_EQ(refusal(options("other.yaml")),
            "folder 'out' is not empty and holds no results of 'other.yaml'; name another one "
            "with -o");
  fs::remove_all(results);
  std::ofstream(results) << "a file";
  EXPECT_EQ(refusal(options()), "'out' exists and is not a folder");
}

/// Results are replaced only when the input has been found good, and then completely.
TEST_F(Run, BadInputLeavesEarlierResultsAlone) {
  (void)run(options());
  std::ofstream(results / "notes.md") << "mine";
  const auto kept = [&] { return read(results / "history.csv") + read(results / "report.json"); };
  const std::pair before{files(), kept()};
  write("model.yaml", edited(model, "on: block.top, ux", "on: block.topp, ux"));
  EXPECT_EQ(refusal(options()),
            "model.yaml:9: steps[0].prescribe[0].on: unknown set 'block.topp'; did you mean "
            "'block.top'?");
  RunOptions until = options();
  write("model.yaml", model);
  until.until = "mor";
  EXPECT_EQ(refusal(until), "--until: unknown step 'mor'; did you mean 'more'?");
  EXPECT_EQ(std::pair(files(), kept()), before);
  write("model.yaml", edited(model, "output:\n", "output:\n  fields: none\n  report: false\n"));
  (void)run(options());
  EXPECT_EQ(files(), (std::set<std::string>{"notes.md", "summary.json", "history.csv",
                                            "iterations.csv", "log.txt", "journal.bin",
                                            "checkpoint.bin", "checkpoint.previous.bin"}));
}

TEST_F(Run, UntilAStep) {
  RunOptions o = options();
  o.until = "press";
  EXPECT_EQ(run(o).status, RunStatus::done);
  EXPECT_EQ(summary()["steps"].size(), 1u);
  EXPECT_EQ(table(read(results / "history.csv")).size(), 1 + 1 + 2u);
}

TEST_F(Run, WhatConvergedIsKept) {
  // Pulling the block off leaves nothing to hold it: the second step cannot converge.
  write("model.yaml",
        edited(edited(model,
                      "  - {name: more, increments: 3, prescribe: [{on: block.top, uy: "
                      "-0.02}]}\n",
                      "  - name: loose\n    increments: 2\n    release: [{on: block.top, of: [ux, "
                      "uy]}]\n    forces: [{on: block.top, fy: 1}]\n"),
               "output:\n", "solver: {cutbacks: 2}\noutput:\n"));
  std::vector<std::string> said;
  RunOptions o = options();
  o.say = [&](std::string_view line) { said.emplace_back(line); };
  const RunOutcome outcome = run(o);
  EXPECT_EQ(outcome.status, RunStatus::stopped);
  EXPECT_TRUE(outcome.message.starts_with("step 'loose' stopped at 0 of its length: "))
      << outcome.message;
  EXPECT_NE(outcome.message.find("body 'block' is free to"), std::string::npos) << outcome.message;
  const nlohmann::json s = summary();
  EXPECT_EQ(s["status"], "stopped");
  EXPECT_EQ(s["message"], outcome.message);
  EXPECT_EQ(s["steps"][0]["increments"].size(), 2u);
  EXPECT_EQ(table(read(results / "history.csv")).size(), 1 + 1 + 2u);
  EXPECT_TRUE(files().contains("last_iterate.vtu"));
  EXPECT_TRUE(files().contains("report.html"));
  EXPECT_EQ(said.back(), outcome.message);
  EXPECT_NE(read(results / "log.txt").find(outcome.message), std::string::npos);
}

TEST_F(Run, AnInterruptKeepsWhatConverged) {
  RunOptions o = options();
  int calls = 0;
  o.interrupted = [&] { return ++calls == 3; };  // initial state, first, second increment
  const RunOutcome outcome = run(o);
  EXPECT_EQ(outcome.status, RunStatus::stopped);
  EXPECT_EQ(outcome.message, "stopped by the user");
  EXPECT_EQ(table(read(results / "history.csv")).size(), 1 + 1 + 2u);
  EXPECT_EQ(summary()["status"], "stopped");
  EXPECT_FALSE(files().contains("last_iterate.vtu"));
}

TEST_F(Run, AnIncrementThatIsAbandonedLeavesTheOnesBefore) {
  RunOptions o = options();
  int calls = 0;
  o.abandoned = [&] { return ++calls > 3; };
  const RunOutcome outcome = run(o);
  EXPECT_EQ(outcome.status, RunStatus::stopped);
  EXPECT_EQ(outcome.message, "stopped by the user");
  const std::size_t rows = table(read(results / "history.csv")).size();
  EXPECT_GT(rows, 2u);  // heading and initial state
  EXPECT_LT(rows, 2 + 5u);
  EXPECT_EQ(calls, 4);
  EXPECT_FALSE(files().contains("last_iterate.vtu"));
}

TEST_F(Run, ABudgetOfIterationsEndsTheRunAndKeepsWhatConverged) {
  RunOptions o = options();
  o.max_iterations = 3;
  const RunOutcome outcome = run(o);
  EXPECT_EQ(outcome.status, RunStatus::stopped);
  EXPECT_EQ(outcome.message,
            "the 3 iterations that --max-iterations allows are used up; everything that converged "
            "is kept");
  const nlohmann::json s = summary();
  EXPECT_EQ(s["message"], outcome.message);
  EXPECT_LE(s["total"]["iterations"], 3);
  EXPECT_GE(s["total"]["increments"], 1);
  o.max_iterations = 0;
  o.restart = true;
  EXPECT_EQ(run(o).status, RunStatus::done);
  EXPECT_EQ(summary()["total"]["increments"], 5);
}

TEST_F(Run, ABudgetOfTimeEndsTheRunAndKeepsWhatConverged) {
  RunOptions o = options();
  o.max_minutes = 1e-9;
  const RunOutcome outcome = run(o);
  EXPECT_EQ(outcome.status, RunStatus::stopped);
  EXPECT_EQ(outcome.message,
            "the 1e-09 minutes that --max-minutes allows are over; everything that converged is "
            "kept");
  EXPECT_EQ(table(read(results / "history.csv")).size(), 1 + 1u);
}

TEST_F(Run, ProgressTellsTheShareThatIsDone) {
  RunOptions o = options();
  std::vector<std::string> lines;
  o.progress = [&](std::string_view line) { lines.emplace_back(line); };
  (void)run(o);
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_TRUE(lines[1].starts_with("press ")) << lines[1];
  lines.clear();
  o.outlook_after = 0;
  (void)run(o);
  ASSERT_EQ(lines.size(), 10u);
  EXPECT_TRUE(lines[2].starts_with("press ")) << lines[2];
  EXPECT_TRUE(lines[3].starts_with(" 40 % ")) << lines[3];
  EXPECT_TRUE(lines[9].starts_with("100 % 0 s left")) << lines[9];
  lines.clear();
  o.with_outlook = true;
  (void)run(o);
  EXPECT_TRUE(lines[1].starts_with(" 40 % ")) << lines[1];
  EXPECT_TRUE(lines[4].starts_with("100 % 0 s left ")) << lines[4];
  EXPECT_EQ(read(results / "log.txt").find('%'), std::string::npos);
}

TEST_F(Run, ParametersAreInTheSummary) {
  write("model.yaml", edited(edited(model, "title:", "parameters: {down: -0.02}\ntitle:"),
                             "uy: -0.02", "uy: =down"));
  RunOptions o = options();
  (void)run(o);
  EXPECT_EQ(summary()["parameters"]["down"], "-0.02");
  o.settings = {{"down", "-0.03"}};
  (void)run(o);
  EXPECT_EQ(summary()["parameters"]["down"], "-0.03");
}

TEST_F(Run, WhoWatchesSeesFieldsAndMayStop) {
  RunOptions o = options();
  std::vector<double> times;
  o.converged = [&](const LiveIncrement& live) {
    times.push_back(live.progress.time);
    EXPECT_EQ(live.row.size(), live.columns.size());
    const std::vector<result::DataSet> sets = live.fields();
    EXPECT_EQ(sets.front().part, "bodies");
    EXPECT_EQ(sets.back().part, "floor");
    EXPECT_EQ(sets.front().point_fields.front().name, "U");
    return times.size() < 2;
  };
  EXPECT_EQ(run(o).status, RunStatus::stopped);
  EXPECT_EQ(times, (std::vector<double>{0.5, 1}));
  EXPECT_EQ(table(read(results / "history.csv")).size(), 1 + 1 + 2u);
}

TEST_F(Run, ADocumentStandsInPlaceOfTheFile) {
  ASSERT_EQ(run(options()).status, RunStatus::done);
  const std::string expected = read(results / "history.csv");
  const deck::SourceNode document = deck::read_yaml(model, "model");
  RunOptions o = options("none");
  o.folder = (folder / "other").string();
  o.document = &document;
  EXPECT_EQ(run(o).status, RunStatus::done);
  EXPECT_EQ(read(folder / "other" / "history.csv"), expected);
}

TEST_F(Run, AnInterruptBeforeTheFirstIncrementStops) {
  RunOptions o = options();
  o.interrupted = [] { return true; };
  EXPECT_EQ(run(o).status, RunStatus::stopped);
  EXPECT_EQ(table(read(results / "history.csv")).size(), 1 + 1u);
}

TEST_F(Run, CheckDescribesWithoutSolving) {
  const CheckReport report = check((folder / "model.yaml").string());
  EXPECT_NE(report.text.find("the model file is valid"), std::string::npos);
  const nlohmann::json json = nlohmann::json::parse(report.json);
  EXPECT_EQ(json["unknowns"], 33);
  ASSERT_EQ(json["contact"].size(), 1u);
  EXPECT_EQ(json["contact"][0]["points"], 5);
  EXPECT_EQ(json["contact"][0]["facing"], 5);
  EXPECT_EQ(json["contact"][0]["touching"], 5);
  EXPECT_EQ(json["contact"][0]["overlapping"], 0);
  EXPECT_FALSE(fs::exists(results));
}

// The disc's centre is a corner of the block: every direction out of the disc is as near.
TEST_F(Run, NamesPointsBeyondTheCentreOfCurvatureOfTheMaster) {
  write("deep.yaml",
        "osculate: 1\n"
        "mesh: {generate: {block: {box: {x: [0, 2], y: [0, 1], elements: [4, 2]}}}}\n"
        "materials: {m: {linear_elastic: {E: 100, nu: 0.3}}}\n"
        "sections: [{on: block, material: m, element: plane_strain}]\n"
        "rigid: {disc: {circle: {center: [0, 0], radius: 0.4}}}\n"
        "contact: [{name: lost, master: disc, slave: block.bottom, normal: {penalty: 1e-3}}]\n"
        "steps: [{name: s, increments: 2, prescribe: [{on: block.top, ux: 0, uy: 0}, {on: "
        "block.bottom, ux: 0, uy: 0}]}]\n");
  RunOptions o = options("deep.yaml");
  std::vector<std::string> said;
  o.say = [&](std::string_view text) { said.emplace_back(text); };
  EXPECT_EQ(run(o).status, RunStatus::done);
  const nlohmann::json s = summary();
  for (const auto& increment : s["steps"][0]["increments"]) {
    const nlohmann::json& list = increment["outside_domain"];
    ASSERT_EQ(list.size(), 1u);
    EXPECT_EQ(list[0]["pair"], "lost");
    EXPECT_EQ(list[0]["points"], 1);
    EXPECT_NE(list[0]["nodes"][0].get<std::string>().find("(0, 0"), std::string::npos);
  }
  const auto warned = std::count_if(said.begin(), said.end(), [](const std::string& text) {
    return text.find("warning: contact 'lost': ") == 0 &&
           text.find("centre of curvature") != std::string::npos;
  });
  EXPECT_EQ(warned, 1);  // once on the screen, in the log for every increment
  const std::string log = read(results / "log.txt");
  EXPECT_NE(log.find("centre of curvature"), log.rfind("centre of curvature"));
}

}  // namespace
}  // namespace osculate::api
