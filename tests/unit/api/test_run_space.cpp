// Model files in space from the text to the files of the result folder.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "osculate/api/run.hpp"
#include "osculate/api/tangent_check.hpp"
#include "packed_values.hpp"

namespace osculate::api {
namespace {
namespace fs = std::filesystem;

/// A block of 2 x 1 x 1 pressed on a plane without lateral restraint: uniform stress. The pressure
/// p moves the top by p (1/E + 1/penalty) = 0.011 p.
constexpr const char* model =
    "osculate: 1\n"
    "title: Block in space\n"
    "mesh: {generate: {b: {box: {x: [0, 2], y: [0, 1], z: [0, 1], elements: [4, 2, 2]}}}}\n"
    "materials: {m: {linear_elastic: {E: 100, nu: 0.25}}}\n"
    "sections: [{on: b, material: m, element: solid}]\n"
    "rigid: {floor: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}}}\n"
    "contact: [{name: c, master: floor, slave: b.bottom, normal: {penalty: 1000}}]\n"
    "steps: [{name: s, increments: 2, prescribe: [{on: b.top, uz: -0.011}, {on: b.left, ux: 0}, "
    "{on: b.front, uy: 0}]}]\n"
    "output: {compress: false, history: [{on: b.top, of: rfz}, {on: c, of: normal_force}]}\n";

std::string edited(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::runtime_error("no '" + from + "'");
  return text.replace(at, from.size(), to);
}

std::string read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file) << path;
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Text between two marks after `at`.
std::string between(const std::string& text, const std::string& from, const std::string& to,
                    std::size_t at = 0) {
  const std::size_t begin = text.find(from, at);
  if (begin == std::string::npos) return {};
  const std::size_t start = begin + from.size();
  return text.substr(start, text.find(to, start) - start);
}

/// One array of an uncompressed VTU file and the attributes of its element.
template <class T>
struct Array {
  std::string attributes;
  std::vector<T> values;
};
template <class T>
Array<T> array(const std::string& vtu, const std::string& name) {
  Array<T> out;
  const std::size_t at = vtu.find("Name=\"" + name + "\"");
  if (at == std::string::npos) {
    ADD_FAILURE() << "no array " << name;
    return out;
  }
  out.attributes = between(vtu, "", "/>", at);
  const std::size_t start = vtu.find("<AppendedData encoding=\"raw\">\n_") + 31 +
                            std::stoul(between(vtu, "offset=\"", "\"", at));
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, vtu.data() + start, sizeof bytes);
  out.values.resize(bytes / sizeof(T));
  std::memcpy(out.values.data(), vtu.data() + start + sizeof bytes, bytes);
  return out;
}

struct RunSpace : ::testing::Test {
  fs::path folder = fs::path(::testing::TempDir()) /
                    ("osculate_space_" +
                     std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
  fs::path results = folder / "out";

  void SetUp() override {
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  void TearDown() override { fs::remove_all(folder); }

  [[nodiscard]] std::string write(const std::string& text) const {
    std::ofstream(folder / "model.yaml") << text;
    return (folder / "model.yaml").string();
  }
  RunOutcome run_model(const std::string& text = model) const {
    RunOptions o;
    o.model = write(text);
    o.folder = results.string();
    return run(o);
  }
};

TEST_F(RunSpace, WritesItsFiles) {
  const RunOutcome outcome = run_model();
  EXPECT_EQ(outcome.status, RunStatus::done) << outcome.message;
  std::set<std::string> expected{
      "summary.json", "history.csv", "results.pvd", "written.txt",    "report.json",
      "report.html",  "log.txt",     "journal.bin", "checkpoint.bin", "checkpoint.previous.bin"};
  expected.insert("iterations.csv");
  const std::string pvd = read(results / "results.pvd");
  for (int i = 0; i < 3; ++i)
    for (const char* part : {"bodies", "rigid", "contact0"}) {
      expected.insert(part + ("_0000" + std::to_string(i)) + ".vtu");
      EXPECT_NE(pvd.find(part + ("_0000" + std::to_string(i)) + ".vtu"), std::string::npos);
    }
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(results))
    names.insert(entry.path().filename().string());
  EXPECT_EQ(names, expected);
  const std::string history = read(results / "history.csv");
  const std::string last = history.substr(history.rfind('\n', history.size() - 2) + 1);
  EXPECT_NEAR(std::stod(last.substr(last.rfind(',') + 1)), 2.0, 1e-9) << last;
}

TEST_F(RunSpace, BodiesCarryTensorsOfSixComponents) {
  (void)run_model();
  const std::string vtu = read(results / "bodies_00002.vtu");
  const std::size_t nodes = 5 * 3 * 3;
  const Array<double> u = array<double>(vtu, "U"), s = array<double>(vtu, "S"),
                      e = array<double>(vtu, "E"), x = array<double>(vtu, "Points");
  ASSERT_EQ(x.values.size(), 3 * nodes);
  ASSERT_EQ(u.values.size(), 3 * nodes);
  ASSERT_EQ(s.values.size(), 6 * nodes);
  ASSERT_EQ(e.values.size(), 6 * nodes);
  int k = 0;
  for (const char* name : {"XX", "YY", "ZZ", "XY", "YZ", "XZ"})
    EXPECT_NE(s.attributes.find("ComponentName" + std::to_string(k++) + "=\"" + name + "\""),
              std::string::npos)
        << s.attributes;
  for (std::size_t n = 0; n < nodes; ++n) {
    EXPECT_NEAR(u.values[3 * n + 2], -0.001 - 0.01 * x.values[3 * n + 2], 1e-9);
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_NEAR(s.values[6 * n + i], i == 2 ? -1 : 0, 1e-6) << i;
      EXPECT_NEAR(e.values[6 * n + i], i == 2 ? -0.01 : i < 2 ? 0.0025 : 0, 1e-8) << i;
    }
  }
  for (const std::uint8_t type : array<std::uint8_t>(vtu, "types").values) EXPECT_EQ(type, 12);
}

/// One cell between two plates: the shear is uniform, half the shear angle in each component.
TEST_F(RunSpace, ShearComponentsAreInTheirPlaces) {
  std::string sheared = edited(model,
                               "contact: [{name: c, master: floor, slave: b.bottom, normal: "
                               "{penalty: 1000}}]\n",
                               "");
  sheared = edited(sheared, "{on: b.top, uz: -0.011}, {on: b.left, ux: 0}, {on: b.front, uy: 0}",
                   "{on: b.top, ux: 0.02, uy: 0.04, uz: 0}, {on: b.bottom, ux: 0, uy: 0, uz: 0}");
  sheared = edited(sheared, "[4, 2, 2]", "[1, 1, 1]");
  (void)run_model(edited(sheared, ", {on: c, of: normal_force}", ""));
  const std::string vtu = read(results / "bodies_00002.vtu");
  const Array<double> e = array<double>(vtu, "E"), s = array<double>(vtu, "S");
  ASSERT_EQ(e.values.size(), 6u * 8);
  ASSERT_EQ(s.values.size(), 6u * 8);
  for (std::size_t k = 0; k < e.values.size(); ++k) {
    const double strain = k % 6 == 4 ? 0.02 : k % 6 == 5 ? 0.01 : 0;
    EXPECT_NEAR(e.values[k], strain, 1e-12) << k;
    EXPECT_NEAR(s.values[k], 2 * 40 * strain, 1e-10) << k;  // G = 100 / 2.5
  }
}

/// Two cells that touch edge on edge: the crossing is a point of its own, after the slave's nodes.
TEST_F(RunSpace, CrossingsOfEdgesArePointsOfTheContactData) {
  const std::string text =
      "osculate: 1\n"
      "mesh: {generate: {low: {box: {x: [-1, 1], y: [-1, 1], z: [-1, 1], elements: [1, 1, 1], "
      "angle: 45, axis: [1, 0, 0], about: [0, 0, 0]}}, up: {box: {x: [-1, 1], y: [-1, 1], z: "
      "[1.8, 3.8], elements: [1, 1, 1], angle: 45, axis: [0, 1, 0], about: [0, 0, 2.8]}}}}\n"
      "materials: {m: {linear_elastic: {E: 100, nu: 0}}}\n"
      "sections: [{on: low, material: m, element: solid}, {on: up, material: m, element: solid}]\n"
      "contact: [{name: c, master: low, slave: up, normal: {penalty: 10}, weight: node, edges: "
      "true, search: {depth: 0.5}}]\n"
      "steps: [{name: s, increments: 1, prescribe: [{on: low, ux: 0, uy: 0, uz: 0}, {on: up.top, "
      "ux: 0, uy: 0, uz: -0.1}]}]\n"
      "output: {compress: false, history: [{on: c, of: force_z}, {on: c, of: closed}]}\n";
  const RunOutcome outcome = run_model(text);
  ASSERT_EQ(outcome.status, RunStatus::done) << outcome.message;
  const std::string vtu = read(results / "contact0_00001.vtu");
  const std::vector<double> feature = array<double>(vtu, "CFEATURE").values,
                            status = array<double>(vtu, "CSTATUS").values,
                            force = array<double>(vtu, "CNFORCE").values,
                            u = array<double>(vtu, "U").values,
                            place = array<double>(vtu, "Points").values;
  ASSERT_EQ(feature.size(), 8u + 1);  // the slave's nodes and the crossing
  EXPECT_EQ(feature.back(), 2);
  EXPECT_EQ(status.back(), 3);  // closed: there is no friction
  for (std::size_t n = 0; n < 8; ++n) EXPECT_EQ(status[n], 0);
  ASSERT_EQ(place.size(), 27u);
  EXPECT_NEAR(place[24], 0, 1e-12);
  EXPECT_NEAR(place[25], 0, 1e-12);
  EXPECT_NEAR(place[26], 2.8 - std::sqrt(2.0), 1e-12);  // on the slave's edge
  EXPECT_LT(u[26], 0);
  EXPECT_NEAR(force.back(), 10 * (std::sqrt(2.0) - place[26] - u[26]), 1e-9);
  EXPECT_EQ(array<std::uint8_t>(vtu, "types").values.back(), 1);  // a vertex
  const std::string checked = check((folder / "model.yaml").string()).text;
  EXPECT_NE(checked.find("12 of the master, 12 of the slave, 1 crossings"), std::string::npos)
      << checked;
}

TEST_F(RunSpace, ContactSurfaceIsADataSetOfItsOwn) {
  (void)run_model();
  const std::string vtu = read(results / "contact0_00002.vtu");
  const std::size_t nodes = 5 * 3;
  const std::map<std::string, double> expected{{"COPEN", -0.001}, {"CPRESS", 1},   {"CSHEAR1", 0},
                                               {"CSHEAR2", 0},    {"CSLIP1", 0},   {"CSLIP2", 0},
                                               {"CSTATUS", 3},    {"CFEATURE", 1}, {"CSFORCE", 0}};
  for (const auto& [name, value] : expected) {
    const Array<double> field = array<double>(vtu, name);
    ASSERT_EQ(field.values.size(), nodes) << name;
    if (name.starts_with("CSLIP")) continue;  // the bottom widens freely
    for (const double v : field.values) EXPECT_NEAR(v, value, 1e-6) << name;
  }
  double area = 0, force = 0;
  for (const double v : array<double>(vtu, "CAREA").values) area += v;
  for (const double v : array<double>(vtu, "CNFORCE").values) force += v;
  EXPECT_NEAR(area, 2, 1e-12);
  EXPECT_NEAR(force, 2, 1e-6);
  const std::vector<double> normal = array<double>(vtu, "normal").values;
  ASSERT_EQ(normal.size(), 3 * nodes);
  for (std::size_t n = 0; n < nodes; ++n) EXPECT_NEAR(normal[3 * n + 2], 1, 1e-12);
  const std::vector<std::uint8_t> types = array<std::uint8_t>(vtu, "types").values;
  EXPECT_EQ(types, std::vector<std::uint8_t>(8, 9));
}

/// A quadratic cell of VTK starts with the same corners, then its edges: bottom, top, upright.
TEST_F(RunSpace, QuadraticCellsAreInTheOrderOfVtk) {
  (void)run_model(edited(model, "[4, 2, 2]", "[1, 1, 1], type: hex20"));
  const std::string vtu = read(results / "bodies_00000.vtu");
  EXPECT_EQ(array<std::uint8_t>(vtu, "types").values, std::vector<std::uint8_t>{25});
  const std::vector<std::int64_t> cell = array<std::int64_t>(vtu, "connectivity").values;
  const std::vector<double> x = array<double>(vtu, "Points").values;
  ASSERT_EQ(cell.size(), 20u);
  const auto at = [&](std::size_t k, std::size_t i) {
    return x[3 * static_cast<std::size_t>(cell[k]) + i];
  };
  constexpr std::array<std::array<std::size_t, 2>, 12> edges{{{0, 1},
                                                              {1, 2},
                                                              {2, 3},
                                                              {3, 0},
                                                              {4, 5},
                                                              {5, 6},
                                                              {6, 7},
                                                              {7, 4},
                                                              {0, 4},
                                                              {1, 5},
                                                              {2, 6},
                                                              {3, 7}}};
  for (std::size_t k = 0; k < edges.size(); ++k)
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(at(8 + k, i), 0.5 * (at(edges[k][0], i) + at(edges[k][1], i)), 1e-12) << k;
}

TEST_F(RunSpace, SummarySaysWhereTheTimeWent) {
  (void)run_model();
  const nlohmann::json s = nlohmann::json::parse(read(results / "summary.json"));
  const nlohmann::json& t = s["seconds"];
  double parts = 0;
  for (const char* phase : {"contact", "bulk", "assembly", "solver", "output"}) {
    EXPECT_GT(t[phase].get<double>(), 0) << phase;
    parts += t[phase].get<double>();
  }
  EXPECT_LE(parts, t["analysis"].get<double>());
  EXPECT_GT(parts, 0.5 * t["analysis"].get<double>());
  double contact = 0;
  for (const char* phase : {"search", "projection", "evaluation"}) {
    EXPECT_GT(s["contact_seconds"][phase].get<double>(), 0) << phase;
    contact += s["contact_seconds"][phase].get<double>();
  }
  EXPECT_LE(contact, t["contact"].get<double>());
  EXPECT_GT(contact, 0.5 * t["contact"].get<double>());
  EXPECT_DOUBLE_EQ(t["total"].get<double>(),
                   t["input"].get<double>() + t["analysis"].get<double>());
  EXPECT_EQ(s["unknowns"], 3 * 45 + 6);
  EXPECT_GT(s["peak_memory_mb"], 1);
}

// [eq:KSVD:60] by hand, on a plane whose frame has unit length: the row of the frame's origin in
// the rotational part is 4 eps |gap| where that of the slave node in the main part is 2 eps.
TEST_F(RunSpace, SummaryTellsWhatTheTangentPartsWeigh) {
  (void)run_model();
  const nlohmann::json s = nlohmann::json::parse(read(results / "summary.json"));
  const nlohmann::json& increments = s["steps"][0]["increments"];
  ASSERT_EQ(increments.size(), 2u);
  const double first = increments[0]["curvature_share"], last = increments[1]["curvature_share"];
  EXPECT_GT(first, 0);
  EXPECT_NEAR(last, 2 * 0.001, 1e-8);  // the gap is -0.001
  EXPECT_NEAR(last, 2 * first, 0.1 * last);
}

TEST_F(RunSpace, ReportShowsTheOuterFaces) {
  (void)run_model();
  const nlohmann::json data = nlohmann::json::parse(read(results / "report.json"));
  const nlohmann::json& mesh = data["mesh"];
  EXPECT_EQ(mesh["dimension"], 3);
  const std::size_t nodes = 45, points = nodes + 4;  // inner ones too; the plane
  EXPECT_EQ(mesh["points"]["shape"], (std::vector<std::size_t>{points, 3}));
  ASSERT_EQ(mesh["cells"].size(), 2u);
  EXPECT_EQ(mesh["cells"][0]["type"], "quad4");
  EXPECT_EQ(mesh["cells"][0]["connectivity"].size(), 4u * 2 * (8 + 8 + 4));
  EXPECT_FALSE(mesh["cells"][0].contains("rigid"));
  EXPECT_EQ(mesh["cells"][1]["rigid"], true);
  ASSERT_EQ(data["frames"].size(), 3u);
  const nlohmann::json& frame = data["frames"][2];
  EXPECT_EQ(frame["increment"], 2);
  const std::vector<float> u = support::decoded(frame["u"]), x = support::decoded(mesh["points"]);
  const std::vector<float> p = support::decoded(frame["fields"]["contact pressure"]);
  const std::vector<float> stress = support::decoded(frame["stress"]);
  ASSERT_EQ(stress.size(), 6 * nodes);
  ASSERT_EQ(u.size(), 3 * points);
  ASSERT_EQ(p.size(), nodes);
  for (std::size_t i = 0; i < nodes; ++i) {
    EXPECT_NEAR(u[3 * i + 2], -0.001 - 0.01 * x[3 * i + 2], 1e-6);
    for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(stress[6 * i + k], k == 2 ? -1 : 0, 1e-5);
    if (x[3 * i + 2] == 0)
      EXPECT_NEAR(p[i], 1, 1e-5);
    else
      EXPECT_TRUE(std::isnan(p[i]));
  }
  for (std::size_t i = nodes; i < points; ++i) {
    EXPECT_EQ(x[3 * i + 2], 0);
    EXPECT_EQ(u[3 * i + 2], 0);
  }
  EXPECT_NE(read(results / "report.html").find("\"dimension\":3"), std::string::npos);
}

TEST_F(RunSpace, CheckPrintsGaps) {
  const CheckReport report =
      check(write(edited(model, "[0, 0, 0], normal", "[0, 0, -0.25], normal")));
  EXPECT_NE(report.text.find("15 of 15 slave points face the master, 0 touch, 0 overlap, gap 0.25 "
                             "to 0.25"),
            std::string::npos)
      << report.text;
  EXPECT_NE(report.text.find("plane, reference point (0, 0, -0.25)"), std::string::npos)
      << report.text;
  EXPECT_NE(report.text.find("16 hex8, enhanced strains, small strain"), std::string::npos)
      << report.text;
  const nlohmann::json json = nlohmann::json::parse(report.json);
  EXPECT_EQ(json["contact"][0]["largest_gap"], 0.25);
  EXPECT_EQ(json["unknowns"], 3 * 45 + 6);
  EXPECT_FALSE(fs::exists(results));
}

/// Two blocks with friction: the tangent in open, sticking and slipping points.
TEST_F(RunSpace, TangentIsOfSecondOrder) {
  const std::string blocks = edited(
      edited(
          edited(edited(edited(model, "[4, 2, 2]}}",
                               "[4, 2, 2]}}, t: {box: {x: [0.4, 1.7], y: "
                               "[0.2, 1.4], z: [1, 2], elements: [2, 3, "
                               "2], angle: 10}}"),
                        "{linear_elastic: {E: 100, nu: 0.25}}", "{neo_hooke: {E: 100, nu: 0.3}}"),
                 "element: solid}", "element: solid}, {on: t, material: m, element: solid}"),
          "normal: {penalty: 1000}}",
          "normal: {penalty: 1000}}, {name: d, master: b.top, slave: t.bottom, normal: "
          "{penalty: 1000}, friction: {coulomb: {mu: 0.3, penalty: 500}}}"),
      "{on: b.top, uz: -0.011}", "{on: t.top, uz: -0.011}");
  const TangentReport report = check_tangent(write(blocks), 1);
  EXPECT_GT(report.counts.open, 0);
  EXPECT_GT(report.counts.stick, 0);
  EXPECT_GT(report.counts.slipping, 0);
  ASSERT_EQ(report.rows.size(), 3u);
  for (const TangentRow& row : report.rows) {
    EXPECT_FALSE(row.skipped) << row.part << " " << row.note;
    EXPECT_NEAR(row.order, 2, 0.1) << row.part << " " << row.error;
  }
}

}  // namespace
}  // namespace osculate::api
