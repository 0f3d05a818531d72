// What `osculate check` says.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "osculate/api/run.hpp"

namespace osculate::api {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

CheckReport check_text(const std::string& text) {
  const std::filesystem::path file =
      std::filesystem::path(::testing::TempDir()) /
      (std::string("check_") + ::testing::UnitTest::GetInstance()->current_test_info()->name() +
       ".yaml");
  std::ofstream(file) << text;
  CheckReport report = check(file.string());
  std::filesystem::remove(file);
  return report;
}

std::string block(const std::string& initial) {
  return "osculate: 1\n"
         "mesh: {generate: {b: {box: {x: [0, 4], y: [-0.01, 2], elements: [8, 4]}}}}\n"
         "materials: {m: {linear_elastic: {E: 100, nu: 0.3}}}\n"
         "sections: [{on: b, material: m, element: plane_strain}]\n"
         "rigid: {floor: {line: {point: [0, 0], normal: [0, 1]}}}\n"
         "contact: [{name: c, master: floor, slave: b.bottom, normal: {penalty: 10}" +
         initial +
         "}]\n"
         "steps:\n"
         "  - {name: press, increments: 2, prescribe: [{on: b.top, ux: 0}], pressure: [{on: b.top, "
         "value: 3}]}\n"
         "  - {name: let, increments: 1, release: [{on: b.top, of: [ux]}]}\n";
}

TEST(Check, AnOverlapIsShownOnceWhateverBecomesOfIt) {
  for (const std::string initial : {"", ", initial: ramp", ", initial: keep"}) {
    const CheckReport report = check_text(block(initial));
    EXPECT_THAT(report.text, HasSubstr("9 overlap, gap -0.01 to -0.01\n")) << initial;
    EXPECT_NEAR(nlohmann::json::parse(report.json)["contact"][0]["smallest_gap"], -0.01, 1e-14);
  }
}

TEST(Check, AClearanceIsSaidBesideTheGapsOfTheMesh) {
  const std::string text = check_text(block(", initial: {clearance: 0.002}")).text;
  EXPECT_THAT(text, HasSubstr("Clearance     c                0.002 in place of these gaps\n"));
  EXPECT_THAT(text, ::testing::Not(HasSubstr("Overlaps")));
}

TEST(Check, EquationsThatBeginAndEnd) {
  const std::string text =
      check_text(block("") +
                 "  - {name: join, increments: 1, equations: [{terms: [{on: b.top, of: ux, factor: "
                 "2}, {on: b.top_left, of: uy, factor: -0.5}], value: 0.1, for_each_node: true}, "
                 "{terms: [{on: b.top_right, of: uy, factor: 1}]}]}\n"
                 "  - {name: some, increments: 1, free_equations: [{on: b.top, of: [ux]}]}\n"
                 "  - {name: none, increments: 1, free_equations: all}\n")
          .text;
  for (const char* const line :
       {"  equation    b.top            2 ux -0.5 uy of b.top_left = 0.1, of each node\n"
        "  equation    b.top_right      1 uy = 0\n",
        "  free        b.top            equations of ux\n",
        "  free        all              equations\n"})
    EXPECT_THAT(text, HasSubstr(line));
}

TEST(Check, SizeSetsCellsLoadsAndSupports) {
  const CheckReport report = check_text(block(""));
  for (const char* const line :
       {"Size          mesh             x 0 to 4, y -0.01 to 2; 45 nodes\n",
        "Sets          areas            b 32\n",
        "Sets          lines            b.left 4, b.right 4, b.bottom 8, b.top 8\n",
        "Cell shapes   b                worst 1 of 1 at node 1 (0, -0.01), none below 0.2; edges "
        "of a cell up to 1 : 1.01\n",
        "Steps         press            2 increments\n"
        "  prescribe   b.top            ux = 0 (9 nodes)\n"
        "  pressure    b.top            value 3: force (0, -12), moment -24 about the origin\n"
        "Steps         let              1 increments\n"
        "  release     b.top            ux (9 nodes)\n"
        "  pressure    b.top            as before, value 3: force (0, -12), moment -24 about the "
        "origin\n",
        "Supports      b                9 displacements prescribed; free to move along y and "
        "turn about (2, 2), but for c (without friction)\n",
        "Supports      floor            3 of 3 motions prescribed; no free motion\n",
        "  then        b                in let: nothing prescribed; free to move and turn, but "
        "for c (without friction)\n"})
    EXPECT_THAT(report.text, HasSubstr(line));
  const nlohmann::json json = nlohmann::json::parse(report.json);
  EXPECT_EQ(json["size"]["high"], (std::vector<double>{4, 2}));
  EXPECT_EQ(json["sets"].size(), 9u);
  EXPECT_NEAR(json["steps"][0]["total"]["force"][1], -12, 1e-12);
  EXPECT_EQ(json["quality"][0]["poor_cells"], 0);
  EXPECT_EQ(json["supports"][0]["free"][0], "move along y");
}

TEST(Check, ContactThatLooksAwayHoldsNoSlidingAndIsFarTooStiff) {
  const CheckReport report = check_text(R"(osculate: 1
mesh:
  generate:
    low: {box: {x: [-2, 2], y: [-1, 0], elements: [8, 2]}}
    up: {box: {x: [-1, 1], y: [0, 1], elements: [5, 2]}}
materials: {m: {linear_elastic: {E: 100, nu: 0.3}}}
sections: [{on: low, material: m, element: plane_strain}, {on: up, material: m, element: plane_strain}]
contact: [{name: c, master: low.bottom, slave: up.bottom, normal: {penalty: 1e16}}]
steps: [{name: press, increments: 1, prescribe: [{on: low.bottom, ux: 0, uy: 0}]}]
)");
  for (const char* const text :
       {"Supports      up               nothing prescribed; free to move and turn, but for c "
        "(without "
        "friction)\n",
        "slave points faces the master: it is elsewhere, or one of both looks away\n",
        "warning: contact 'c': its penalty of 1e+16 is 1e+13 times the automatic one"})
    EXPECT_THAT(report.text, HasSubstr(text));
}

TEST(Check, AsksForUnitsThatDoNotGoTogether) {
  const auto text = [](const char* young, const char* to) {
    return check_text(fmt::format(R"(osculate: 1
mesh: {{generate: {{b: {{box: {{x: [0, {}], y: [0, {}], elements: [2, 2]}}}}}}}}
materials: {{m: {{linear_elastic: {{E: {}, nu: 0.3}}}}}}
sections: [{{on: b, material: m, element: plane_strain}}]
steps: [{{name: press, increments: 1, prescribe: [{{on: b.bottom, ux: 0, uy: 0}}]}}]
)",
                                  to, to, young))
        .text;
  };
  EXPECT_THAT(text("2.1e11", "200"), HasSubstr("Units         ?                E of 2.1e+11, if in "
                                               "Pa, goes with m: 200 m long?"));
  EXPECT_THAT(text("2.1e5", "0.02"), HasSubstr("if in MPa, goes with mm: 0.02 mm long?"));
  for (const auto& [young, to] : {std::pair{"2.1e5", "20"},
                                  {"2.1e11", "0.02"},
                                  {"10", "0.02"},
                                  {"3e6", "0.05"},
                                  {"2.1e11", "12"}})
    EXPECT_THAT(text(young, to), Not(HasSubstr("Units")));
}

}  // namespace
}  // namespace osculate::api
