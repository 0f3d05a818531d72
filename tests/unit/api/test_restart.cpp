// Restart inside one process, and analyses side by side.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "osculate/api/run.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/io/csv.hpp"
#include "osculate/result/checkpoint.hpp"
#include "restart_models.hpp"

namespace osculate::api {
namespace {
namespace fs = std::filesystem;

using namespace restarted;  // NOLINT: the models, nothing else

class Restart : public ::testing::Test {
 protected:
  fs::path folder_ = fs::path(::testing::TempDir()) /
                     (std::string("osculate_restart_") +
                      ::testing::UnitTest::GetInstance()->current_test_info()->name());
  void SetUp() override {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    write("plane", plane);
    write("space", space);
    write("thrown", thrown);
    write("linear", linear);
    write("plastic", plastic);
    write("creeping", creeping);
    write("ringing", ringing);
    write("swinging", swinging);
    write("conditioned", conditioned);
  }
  void TearDown() override { fs::remove_all(folder_); }
  /// With a checkpoint after each increment.
  void write(const std::string& name, const std::string& text) const {
    const bool said = text.find("output:") != std::string::npos;
    std::ofstream(folder_ / (name + ".yaml")) << text << (said ? "" : "output: {}\n");
    if (text.find("checkpoint") == std::string::npos)
      replace(name + ".yaml", "output: {", "output: {checkpoint: 1, ");
  }
  [[nodiscard]] RunOptions options(const std::string& model, const std::string& out,
                                   int threads = 1) const {
    RunOptions o;
    o.model = (folder_ / (model + ".yaml")).string();
    o.folder = (folder_ / out).string();
    o.threads = threads;
    return o;
  }
  void replace(const std::string& name, const std::string& old, const std::string& text) const {
    std::ostringstream content;
    content << std::ifstream(folder_ / name).rdbuf();
    std::string changed = content.str();
    changed.replace(changed.find(old), old.size(), text);
    std::ofstream(folder_ / name) << changed;
  }
  /// A run that is stopped after so many increments, and goes on to its end from where it says.
  static void expect_to_go_on(RunOptions o, int increments, const std::string& from) {
    int asked = 0;
    o.interrupted = [&] { return ++asked == increments; };
    std::vector<std::string> restarts;
    o.say = [&](std::string_view text) {
      if (text.starts_with("restart after")) restarts.emplace_back(text);
    };
    ASSERT_EQ(run(o).status, RunStatus::stopped);
    o.restart = true;
    ASSERT_EQ(run(o).status, RunStatus::done);
    ASSERT_EQ(restarts.size(), 1U);
    EXPECT_TRUE(restarts[0].starts_with(from)) << restarts[0];
  }
  /// Histories and fields, byte by byte, and the steps of the summary.
  [[nodiscard]] std::map<std::string, std::string> results(const std::string& out) const {
    std::map<std::string, std::string> found;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_ / out)) {
      const std::string name = entry.path().filename().string();
      std::ostringstream text;
      text << std::ifstream(entry.path(), std::ios::binary).rdbuf();
      if (name == "history.csv" || name.ends_with(".vtu") || name.ends_with(".pvd"))
        found[name] = text.str();
      if (name == "summary.json") found[name] = nlohmann::json::parse(text.str())["steps"].dump();
    }
    return found;
  }
};

/// Of a run that is stopped after every increment: the last part says what the whole run says at
/// its end, and what happens on the way is told of once.
TEST_F(Restart, TheWarningsAreThoseOfTheWholeRun) {
  const std::map<std::string, std::pair<const char*, std::vector<std::string>>> models{
      {"bent", {bent, {"they lock", "small strains"}}},
      {"leaving", {leaving, {"only move apart, from 0.01 to 0.03"}}},
      {"beside", {beside, {"beside its slave the body has gone"}}},
      {"bouncing", {bouncing, {"of the energy out of nothing"}}},
      {"falling", {falling, {"went through the master"}}}};
  for (const auto& [name, model] : models) {
    SCOPED_TRACE(name);
    write(name, model.first);
    std::vector<std::string> all, of_part, on_the_way;
    RunOptions o = options(name, name + "_whole");
    o.say = [&](std::string_view line) {
      if (line.starts_with("warning")) all.emplace_back(line);
    };
    ASSERT_EQ(run(o).status, RunStatus::done);
    for (const std::string& text : model.second)
      EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](const std::string& line) {
        return line.find(text) != std::string::npos;
      })) << text;
    o = options(name, name + "_pieces");
    o.interrupted = [] { return true; };
    o.say = [&](std::string_view line) {
      if (!line.starts_with("warning")) return;
      const bool through = line.find("went through the master") != std::string_view::npos;
      (through ? on_the_way : of_part).emplace_back(line);
    };
    RunStatus status = RunStatus::stopped;
    for (int runs = 0; status != RunStatus::done && runs < 50; ++runs) {
      of_part.clear();
      status = run(o).status;
      o.restart = true;
    }
    ASSERT_EQ(status, RunStatus::done);
    for (int again = 0; again < 2; ++again) {  // then nothing is left to do
      std::vector<std::string> said = on_the_way;
      said.insert(said.end(), of_part.begin(), of_part.end());
      EXPECT_EQ(said, all);
      of_part.clear();
      ASSERT_EQ(run(o).status, RunStatus::done);
    }
  }
}

TEST_F(Restart, AfterEveryIncrementGivesTheSameBits) {
  for (const auto& [model, least] :
       {std::pair("plane", 10), std::pair("linear", 6), std::pair("plastic", 7),
        std::pair("creeping", 7), std::pair("ringing", 6), std::pair("swinging", 5),
        std::pair("conditioned", 7)}) {
    const std::string whole = std::string(model) + "_whole",
                      pieces = std::string(model) + "_pieces";
    ASSERT_EQ(run(options(model, whole)).status, RunStatus::done);
    RunOptions o = options(model, pieces);
    o.interrupted = [] { return true; };  // after one increment more
    int runs = 0;
    while (run(o).status != RunStatus::done) {
      o.restart = true;
      ASSERT_LT(++runs, 50);
    }
    EXPECT_GE(runs, least);
    EXPECT_EQ(results(pieces), results(whole));
  }
}

TEST_F(Restart, WithTimeStepsByTheirErrors) {
  ASSERT_EQ(run(options("thrown", "whole")).status, RunStatus::done);
  RunOptions o = options("thrown", "pieces");
  o.interrupted = [] { return true; };
  int runs = 0;
  while (run(o).status != RunStatus::done) {
    o.restart = true;
    ASSERT_LT(++runs, 500);
  }
  EXPECT_GE(runs, 10);
  EXPECT_EQ(results("pieces"), results("whole"));
  const nlohmann::json steps = nlohmann::json::parse(results("whole")["summary.json"]);
  EXPECT_TRUE(steps[0]["chosen_time_steps"].is_null());
  EXPECT_GT(steps[1]["chosen_time_steps"]["refused"], 0);
  EXPECT_LT(steps[1]["chosen_time_steps"]["smallest"], 0.5 * 0.1 / 3);
  EXPECT_EQ(steps[1]["chosen_time_steps"]["count"], steps[1]["increments"].size());
  // Fields are written at the ends of the nominal increments: initial state, 2 and 3 of them.
  int fields = 0;
  for (const auto& entry : results("whole")) fields += entry.first.ends_with(".vtu") ? 1 : 0;
  EXPECT_EQ(fields % 6, 0);
}

TEST_F(Restart, TheTimeOfStepsWithInertiaIsThatOfTheClock) {
  ASSERT_EQ(run(options("thrown", "whole")).status, RunStatus::done);
  const io::CsvTable table = io::read_csv((folder_ / "whole/history.csv").string());
  const auto column = [&](const char* name) { return table.numbers(table.find(name)); };
  const std::vector<double> time = column("time"), elapsed = column("elapsed"),
                            fraction = column("fraction"), step = column("step");
  for (std::size_t i = 0; i < time.size(); ++i) {
    EXPECT_NEAR(time[i], elapsed[i], 1e-15);
    EXPECT_NEAR(time[i], step[i] == 1 ? 0.01 * fraction[i] : 0.01 + 0.1 * fraction[i], 1e-15);
  }
  EXPECT_NEAR(time.back(), 0.11, 1e-15);
  const nlohmann::json steps = nlohmann::json::parse(results("whole")["summary.json"]);
  EXPECT_NEAR(steps[0]["increments"][0]["time"], 0.005, 1e-15);
  EXPECT_NEAR(steps[1]["increments"].back()["time"], 0.11, 1e-15);
  EXPECT_NE(results("whole")["results.pvd"].find("timestep=\"0.11"), std::string::npos);
}

TEST_F(Restart, OnAPathThatTurnsBack) {
  std::ostringstream roller;
  roller << std::ifstream(OSCULATE_SOURCE_DIR "/verification/snap_through/roller.yaml").rdbuf();
  write("roller", roller.str());
  const RunOptions whole = options("roller", "whole");
  RunOptions o = options("roller", "pieces");
  ASSERT_EQ(run(whole).status, RunStatus::done);
  int increments = 0, runs = 0;
  o.interrupted = [&] { return ++increments % 8 == 0; };
  while (run(o).status != RunStatus::done) {
    o.restart = true;
    ASSERT_LT(++runs, 50);
  }
  EXPECT_GE(runs, 8);
  EXPECT_EQ(results("pieces"), results("whole"));
  EXPECT_NE(results("whole")["summary.json"].find("\"on_path\":true"), std::string::npos);
}

/// Factors pass from one increment to the next between checkpoints, and not past one.
TEST_F(Restart, OfASmallModelGoesOnAfterEachTenthIncrement) {
  replace("plane.yaml", "checkpoint: 1, ", "");
  replace("plane.yaml", "increments: 8", "increments: 24");
  expect_to_go_on(options("plane", "pieces"), 16, "restart after increment 8 of step 'drag'");
  ASSERT_EQ(run(options("plane", "whole")).status, RunStatus::done);
  EXPECT_EQ(results("pieces"), results("whole"));
}

/// The same with the coarser models of multigrid, with bodies that are linear and with one that is
/// not.
TEST_F(Restart, CoarserModelsPassBetweenCheckpointsAlone) {
  for (const std::string& law : {std::string("linear_elastic"), std::string("neo_hooke")}) {
    SCOPED_TRACE(law);
    write(law, by_multigrid);
    replace(law + ".yaml", "checkpoint: 1, ", "");
    replace(law + ".yaml", "{LAW", "{" + law);
    expect_to_go_on(options(law, law + "_pieces"), 13, "restart after increment 8 of step 'drag'");
    for (const int threads : {1, 2}) {
      const std::string whole = law + "_whole" + std::to_string(threads);
      ASSERT_EQ(run(options(law, whole, threads)).status, RunStatus::done);
      EXPECT_EQ(results(law + "_pieces"), results(whole));
    }
  }
}

/// Each part of a run that is stopped again and again gets on, whether it is stopped after an
/// increment or within one.
TEST_F(Restart, OfASmallModelGoesOnWhereItWasStoppedBeforeTheTenthIncrement) {
  replace("plane.yaml", "checkpoint: 1, ", "");
  for (const bool within : {false, true}) {
    SCOPED_TRACE(within);
    RunOptions o = options("plane", within ? "within" : "after");
    if (within)
      o.max_iterations = 11;
    else
      o.interrupted = [] { return true; };
    int runs = 1;
    for (; run(o).status != RunStatus::done && runs < 50; ++runs) o.restart = true;
    EXPECT_GE(runs, within ? 3 : 10);
    EXPECT_LT(runs, 50);
  }
}

TEST_F(Restart, NothingIsCutBeforeTheAnalysisStandsWhereItGoesOn) {
  replace("plane.yaml", "checkpoint: 1", "checkpoint: 5");
  RunOptions o = options("plane", "out");
  int lines = 0;
  o.progress = [&](std::string_view) {
    if (++lines == 9) throw std::runtime_error("killed");
  };
  EXPECT_THROW((void)run(o), std::runtime_error);
  const auto before = results("out");
  EXPECT_EQ(std::count(before.at("history.csv").begin(), before.at("history.csv").end(), '\n'), 10);
  o.restart = true;
  o.progress = nullptr;
  o.say = [](std::string_view text) {
    if (text.starts_with("restart after")) throw std::runtime_error("killed");
  };
  EXPECT_THROW((void)run(o), std::runtime_error);
  EXPECT_EQ(results("out"), before);
  o.say = nullptr;
  EXPECT_EQ(run(o).status, RunStatus::done);
  ASSERT_EQ(run(options("plane", "whole")).status, RunStatus::done);
  EXPECT_EQ(results("out"), results("whole"));
}

TEST_F(Restart, OnAnotherProcessorItSaysThatLastBitsMayDiffer) {
  const std::string path = (folder_ / "plane.yaml").string(), out = folder_.string();
  const deck::Description description = deck::read_model(path);
  const deck::AnyBuilt any = deck::build_any(description, deck::load_mesh(description));
  const auto& built = std::get<deck::Built>(any);
  model::System system(built.model, 1);
  const model::State state = system.initial_state();
  const result::RunIdentity here = result::identity(description, built.model.mesh, built.history);
  const auto note_of = [&](const std::string& processor) {
    result::RunIdentity there = here;
    there.processor = processor;
    result::CheckpointWriter<2> writer(out, there);
    writer.add({}, {});
    writer.save(state, {}, {}, {}, {});
    return result::read_checkpoint<2>(out, here, built.model, path).note;
  };
  EXPECT_EQ(note_of(here.processor), "");
  EXPECT_NE(note_of("Abacus 3").find("(Abacus 3; this is " + here.processor + "): last bits may"),
            std::string::npos);
}

TEST_F(Restart, LastFieldsAreThoseOfTheEndOfEveryStep) {
  replace("plane.yaml", "output: {", "output: {fields: last, ");
  ASSERT_EQ(run(options("plane", "whole")).status, RunStatus::done);
  const auto times = [&](const std::string& out) {
    std::vector<std::string> found;
    const std::string text = results(out)["results.pvd"];
    for (std::size_t at = 0; (at = text.find("timestep=\"", at)) != std::string::npos; ++at)
      if (text.find("\"bodies\"", at) < text.find('\n', at))
        found.push_back(text.substr(at + 10, text.find('"', at + 10) - at - 10));
    return found;
  };
  EXPECT_EQ(times("whole"), (std::vector<std::string>{"1", "2"}));
  RunOptions o = options("plane", "pieces");
  o.until = "press";
  ASSERT_EQ(run(o).status, RunStatus::done);
  EXPECT_EQ(times("pieces"), (std::vector<std::string>{"1"}));
  o.until = "";
  o.restart = true;
  ASSERT_EQ(run(o).status, RunStatus::done);
  EXPECT_EQ(results("pieces"), results("whole"));
}

TEST_F(Restart, ALogThatCannotBeWrittenEndsTheRun) {
  RunOptions o = options("plane", "out");
  o.until = "press";
  ASSERT_EQ(run(o).status, RunStatus::done);
  fs::remove(folder_ / "out/log.txt");
  fs::create_symlink("/dev/full", folder_ / "out/log.txt");
  o.until = "";
  o.restart = true;
  const RunOutcome outcome = run(o);
  EXPECT_EQ(outcome.status, RunStatus::stopped);
  EXPECT_NE(outcome.message.find("log.txt: cannot write: No space left"), std::string::npos);
}

TEST_F(Restart, AModelFileThatIsEditedMeanwhileIsNotTheOneThatHasRun) {
  const auto content = [&] {
    std::ifstream file(folder_ / "out/summary.json");
    return nlohmann::json::parse(file)["model_content"].get<std::string>();
  };
  RunOptions o = options("plane", "out");
  ASSERT_EQ(run(o).status, RunStatus::done);
  const std::string before = content();
  o.say = [&](std::string_view) {
    std::ofstream(folder_ / "plane.yaml", std::ios::app) << "# edited\n";
  };
  ASSERT_EQ(run(o).status, RunStatus::done);
  EXPECT_EQ(content(), before);
}

TEST_F(Restart, TwoAnalysesAtTheSameTimeHaveTheBitsOfEachAlone) {
  ASSERT_EQ(run(options("plane", "plane1")).status, RunStatus::done);
  ASSERT_EQ(run(options("space", "space1")).status, RunStatus::done);
  for (int k = 0; k < 3; ++k) {
    std::thread other([&] { EXPECT_EQ(run(options("space", "space2")).status, RunStatus::done); });
    EXPECT_EQ(run(options("plane", "plane2")).status, RunStatus::done);
    other.join();
    EXPECT_EQ(results("plane2"), results("plane1"));
    EXPECT_EQ(results("space2"), results("space1"));
  }
}

TEST_F(Restart, OneAndTwoThreadsHaveTheSameBits) {
  for (const std::string model : {"plane", "space", "plastic", "creeping"}) {
    ASSERT_EQ(run(options(model, model + "1")).status, RunStatus::done);
    ASSERT_EQ(run(options(model, model + "2", 2)).status, RunStatus::done);
    EXPECT_EQ(results(model + "2"), results(model + "1"));
  }
}

}  // namespace
}  // namespace osculate::api
