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

namespace osculate::api {
namespace {
namespace fs = std::filesystem;

constexpr const char* plane =
    "osculate: 1\n"
    "mesh: {generate: {block: {box: {x: [0, 2], y: [0, 1], elements: [12, 6]}}, rail: {line: "
    "{points: [[-1, 0], [3, 0]], elements: 7}}}}\n"
    "materials: {m: {st_venant_kirchhoff: {E: 100, nu: 0.3}}}\n"
    "sections: [{on: block, material: m, element: plane_strain}]\n"
    "rigid: {base: {set: rail}}\n"
    "contact: [{name: floor, master: base, slave: block.bottom, normal: {penalty: 1e4}, friction: "
    "{coulomb: {mu: 0.3, penalty: 1e4}}}]\n"
    "steps:\n"
    "  - {name: press, increments: 2, prescribe: [{on: block.top, ux: 0, uy: -0.02}]}\n"
    "  - {name: drag, increments: 8, prescribe: [{on: block.top, ux: 0.1}]}\n"
    "output: {history: [{on: floor, of: normal_force}, {on: floor, of: shear_force}]}\n";

constexpr const char* space =
    "osculate: 1\n"
    "mesh: {generate: {b: {box: {x: [0, 2], y: [0, 1], z: [0, 1], elements: [6, 3, 3]}}}}\n"
    "materials: {m: {linear_elastic: {E: 100, nu: 0.25}}}\n"
    "sections: [{on: b, material: m, element: solid}]\n"
    "rigid: {floor: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}}}\n"
    "contact: [{name: c, master: floor, slave: b.bottom, normal: {penalty: 1000}, friction: "
    "{coulomb: {mu: 0.3, penalty: 500}}}]\n"
    "steps:\n"
    "  - {name: press, increments: 2, prescribe: [{on: b.top, ux: 0, uy: 0, uz: -0.02}]}\n"
    "  - {name: drag, increments: 4, prescribe: [{on: b.top, ux: 0.03, uy: 0.04}]}\n"
    "output: {history: [{on: c, of: normal_force}, {on: c, of: force_x}]}\n";

/// A disc that is thrown on a block whose base is shaken; time steps by their errors, after another
/// step with inertia.
constexpr const char* thrown =
    "osculate: 1\n"
    "mesh: {generate: {block: {box: {x: [-2, 2], y: [-1, 0], elements: [4, 2]}}}}\n"
    "materials: {m: {neo_hooke: {E: 1000, nu: 0.3, density: 0.5}}}\n"
    "sections: [{on: block, material: m, element: plane_strain}]\n"
    "rigid: {disc: {circle: {center: [0.3, 1.03], radius: 1}, mass: 2}}\n"
    "contact: [{name: c, master: disc, slave: block.top, normal: {penalty: 900}, friction: "
    "{coulomb: {mu: 0.4, penalty: 700}}}]\n"
    "initial_velocity: [{on: disc, vx: 0.3, vy: -1, wz: 2}]\n"
    "amplitudes: {shake: [[0, 0], [0.23, 1], [0.4, 0], [1, 0]]}\n"
    "steps:\n"
    "  - {name: fly, increments: 2, duration: 0.01, dynamics: {}, prescribe: [{on: block.bottom, "
    "ux: "
    "0, uy: 0}]}\n"
    "  - {name: hit, increments: 3, duration: 0.1, gravity: [0, -9.81], dynamics: {damping: {mass: "
    "0.3}, time_steps: {error: 0.02}}, prescribe: [{on: block.bottom, ux: 0.01, uy: 0, amplitude: "
    "shake}]}\n"
    "output: {history: [{on: c, of: normal_force}, {on: disc, of: vy}], checkpoint: 1}\n";

/// A linear block of many unknowns, of which few are iterated on.
constexpr const char* linear =
    "osculate: 1\n"
    "mesh: {generate: {block: {box: {x: [0, 2], y: [0, 1], elements: [60, 30]}}, rail: {line: "
    "{points: [[-1, 0], [3, 0]], elements: 7}}}}\n"
    "materials: {m: {linear_elastic: {E: 100, nu: 0.3}}}\n"
    "sections: [{on: block, material: m, element: plane_strain}]\n"
    "rigid: {base: {set: rail}}\n"
    "contact: [{name: floor, master: base, slave: block.bottom, normal: {penalty: 1e4}, friction: "
    "{coulomb: {mu: 0.3, penalty: 1e4}}}]\n"
    "steps:\n"
    "  - {name: press, increments: 2, prescribe: [{on: block.top, ux: 0, uy: -0.02}]}\n"
    "  - {name: drag, increments: 4, prescribe: [{on: block.top, ux: 0.01}]}\n"
    "output: {history: [{on: floor, of: normal_force}, {on: floor, of: shear_force}]}\n";

/// A plastic block that is bent over a rail and back, small and finite strains side by side.
constexpr const char* plastic =
    "osculate: 1\n"
    "mesh: {generate: {b: {box: {x: [0, 4], y: [0, 1], elements: [8, 2]}}, c: {box: {x: [0, 4], y: "
    "[2, 3], elements: [8, 2]}}}}\n"
    "materials: {m: {elastoplastic: {E: 200, nu: 0.3, hardening: [[1, 0], [1.2, 0.02]], kinematic: "
    "5}}}\n"
    "sections: [{on: b, material: m, element: plane_strain, kinematics: finite}, {on: c, material: "
    "m, element: plane_stress}]\n"
    "rigid: {rail: {circle: {center: [2, -1], radius: 1}}}\n"
    "contact: [{name: on, master: rail, slave: b.bottom, friction: {coulomb: {mu: 0.2}}}]\n"
    "steps:\n"
    "  - {name: bend, increments: 4, prescribe: [{on: rail, ux: 0, uy: 0.2, rz: 0}, {on: [b.left, "
    "b.right, c.left], ux: 0, uy: 0}, {on: c.right, ux: 0.05, uy: 0.2}]}\n"
    "  - {name: back, increments: 3, prescribe: [{on: rail, uy: 0.05}, {on: c.right, uy: 0}]}\n"
    "output: {history: [{on: on, of: normal_force}, {on: c.right, of: rfy}]}\n";

/// A creeping block that is dragged over a floor whose friction ages.
constexpr const char* creeping =
    "osculate: 1\n"
    "mesh: {generate: {b: {box: {x: [0, 4], y: [0, 1], elements: [4, 2]}}}}\n"
    "materials: {m: {norton: {E: 200, nu: 0.3, A: 0.1, n: 3}}}\n"
    "sections: [{on: b, material: m, element: plane_strain}]\n"
    "rigid: {floor: {line: {point: [0, 0], normal: [0, 1]}}}\n"
    "contact: [{name: on, master: floor, slave: b.bottom, normal: {penalty: 1000}, friction: "
    "{rate_and_state: {mu: 0.5, a: 0.01, b: 0.015, speed: 0.1, distance: 0.02, penalty: 1000}}}]\n"
    "steps:\n"
    "  - {name: press, increments: 2, duration: 1, prescribe: [{on: b.top, ux: 0, uy: -0.01}]}\n"
    "  - {name: drag, increments: 5, duration: 1, prescribe: [{on: b.top, ux: 0.1}]}\n"
    "output: {history: [{on: on, of: normal_force}, {on: on, of: shear_force}]}\n";

/// A bar that is stretched, and then moves along its vibrations in two steps.
constexpr const char* ringing =
    "osculate: 1\n"
    "mesh: {generate: {b: {box: {x: [0, 4], y: [0, 1], elements: [8, 2]}}}}\n"
    "materials: {m: {st_venant_kirchhoff: {E: 100, nu: 0.3, density: 1}}}\n"
    "sections: [{on: b, material: m, element: plane_strain}]\n"
    "amplitudes: {bent: [[0, 1], [0.3, 0], [1, 2]]}\n"
    "steps:\n"
    "  - {name: stretch, increments: 2, prescribe: [{on: b.left, ux: 0, uy: 0}], total_force: "
    "[{on: "
    "b.right, fx: 1}]}\n"
    "  - {name: free, modes: 3}\n"
    "  - {name: ring, increments: 3, duration: 2, modal: {damping: {ratio: 0.02}}, total_force: "
    "[{on: "
    "b.right, fy: 0.1, amplitude: bent}]}\n"
    "  - {name: on, increments: 2, duration: 1, modal: {}}\n"
    "output: {history: [{on: b.right, of: uy}, {on: b.right, of: vy}, {on: b.left, of: rfy}]}\n";

/// A bar that swings with loads and with its support, at some frequencies.
constexpr const char* swinging =
    "osculate: 1\n"
    "mesh: {generate: {b: {box: {x: [0, 4], y: [0, 1], elements: [8, 2]}}}}\n"
    "materials: {m: {linear_elastic: {E: 100, nu: 0.3, density: 1}}}\n"
    "sections: [{on: b, material: m, element: plane_strain}]\n"
    "steps:\n"
    "  - {name: hold, increments: 1, prescribe: [{on: b.left, ux: 0, uy: 0}]}\n"
    "  - {name: free, modes: 3}\n"
    "  - {name: swing, harmonic: {from: 0.1, to: 0.7, points: 3, damping: {ratio: 0.02}}, "
    "total_force: [{on: b.right, fy: 0.1, phase: 30}], prescribe: [{on: b.left, ux: 0.1}]}\n"
    "  - {name: on, harmonic: {from: 0.2, to: 0.2}, total_force: [{on: b.right, fx: 1}]}\n"
    "output: {history: [{on: b.right, of: uy}, {on: b.right, of: vy}, {on: b.left, of: rfy}]}\n";

/// Runs that end with warnings of what was on the way: a beam that is bent and straightened again,
/// a block that moves away from a floor that was nearest at first, a body that goes past its slave,
/// blocks that go through a floor and that gain energy in explicit time integration.
constexpr const char* bent =
    "osculate: 1\n"
    "mesh: {generate: {b: {box: {x: [0, 10], y: [0, 1], elements: [10, 1]}}}}\n"
    "materials: {m: {linear_elastic: {E: 100, nu: 0.3}}}\n"
    "sections: [{on: b, material: m, element: plane_stress, formulation: full}]\n"
    "steps:\n"
    "  - {name: bend, increments: 2, prescribe: [{on: b.left, ux: 0, uy: 0}, {on: b.right, uy: "
    "-4}]}\n"
    "  - {name: back, increments: 2, prescribe: [{on: b.right, uy: 0}]}\n";
constexpr const char* leaving =
    "osculate: 1\n"
    "mesh: {generate: {b: {box: {x: [0, 2], y: [0, 1], elements: [2, 2]}}}}\n"
    "materials: {m: {linear_elastic: {E: 100, nu: 0}}}\n"
    "sections: [{on: b, material: m, element: plane_strain}]\n"
    "rigid: {floor: {line: {point: [0, -0.01], normal: [0, 1]}}}\n"
    "contact: [{name: c, master: floor, slave: b.bottom}]\n"
    "steps: [{name: s, increments: 2, prescribe: [{on: b.top, ux: 0, uy: 0.02}]}]\n";
constexpr const char* beside =
    "osculate: 1\n"
    "mesh: {generate: {b: {box: {x: [0, 10], y: [0, 10], elements: [8, 8]}}}}\n"
    "materials: {m: {neo_hooke: {E: 3, nu: 0.45}}}\n"
    "sections: [{on: b, material: m, element: plane_strain, formulation: bbar}]\n"
    "rigid: {low: {line: {point: [0, 0], normal: [0, 1]}}, up: {line: {point: [0, 10], normal: "
    "[0, -1]}}}\n"
    "contact: [{name: l, master: low, slave: b.bottom, friction: {coulomb: {mu: 0.5}}}, {name: u, "
    "master: up, slave: b.top, friction: {coulomb: {mu: 0.5}}}]\n"
    "steps: [{name: s, increments: 12, prescribe: [{on: low, ux: 0, uy: 0, rz: 0}, {on: up, ux: 0, "
    "uy: -4.2, rz: 0}]}]\n";
constexpr const char* bouncing =
    "osculate: 1\n"
    "mesh: {generate: {cells: {box: {x: [0, 2], y: [0.04, 1], elements: [1, 1]}}}}\n"
    "rigid: {block: {set: cells, mass: 2, inertia: 1.5}, floor: {line: {point: [0, 0], normal: [0, "
    "1]}}}\n"
    "contact: [{name: c, master: floor, slave: cells.bottom, weight: node, normal: {table: [[0, 0],"
    " [0.001, 0.1], [0.002, 10]]}}]\n"
    "initial_velocity: [{on: block, vy: -1}]\n"
    "steps: [{name: fall, increments: 3, duration: 0.3, dynamics: {scheme: "
    "central_differences}}]\n";
constexpr const char* falling =
    "osculate: 1\n"
    "mesh: {generate: {b: {box: {x: [-1, 1], y: [0.01, 1], elements: [8, 4]}}}}\n"
    "materials: {m: {neo_hooke: {E: 2.0e3, nu: 0.4, density: 1}}}\n"
    "sections: [{on: b, material: m, element: plane_strain}]\n"
    "rigid: {floor: {line: {point: [0, 0], normal: [0, 1]}}}\n"
    "contact: [{name: c, master: floor, slave: b.bottom, search: {depth: 1.0e-4}}]\n"
    "initial_velocity: [{on: b, vy: -6}]\n"
    "steps: [{name: fall, increments: 6, duration: 0.006, dynamics: {scheme: "
    "central_differences}}]\n";

class Restart : public ::testing::Test {
 protected:
  fs::path folder_ = fs::path(::testing::TempDir()) /
                     (std::string("osculate_restart_") +
                      ::testing::UnitTest::GetInstance()->current_test_info()->name());
  void SetUp() override {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    std::ofstream(folder_ / "plane.yaml") << plane;
    std::ofstream(folder_ / "space.yaml") << space;
    std::ofstream(folder_ / "thrown.yaml") << thrown;
    std::ofstream(folder_ / "linear.yaml") << linear;
    std::ofstream(folder_ / "plastic.yaml") << plastic;
    std::ofstream(folder_ / "creeping.yaml") << creeping;
    std::ofstream(folder_ / "ringing.yaml") << ringing;
    std::ofstream(folder_ / "swinging.yaml") << swinging;
  }
  void TearDown() override { fs::remove_all(folder_); }
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
    std::ofstream(folder_ / (name + ".yaml")) << model.first;
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
        std::pair("creeping", 7), std::pair("ringing", 6), std::pair("swinging", 5)}) {
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
  const std::string model = OSCULATE_SOURCE_DIR "/verification/snap_through/roller.yaml";
  RunOptions whole = options("plane", "whole"), o = options("plane", "pieces");
  whole.model = o.model = model;
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

TEST_F(Restart, NothingIsCutBeforeTheAnalysisStandsWhereItGoesOn) {
  replace("plane.yaml", "output: {", "output: {checkpoint: 5, ");
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
