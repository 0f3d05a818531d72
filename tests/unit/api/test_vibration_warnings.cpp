// Bodies that are free to move have rigid motions, of which nothing is warned; what is unstable is
// told of.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "warnings_of.hpp"

namespace osculate::api {
namespace {
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A bar of steel in space, in millimetres, and its steps.
std::string bar(const std::string& steps, double at = 0) {
  return fmt::format(R"(osculate: 1
mesh: {{generate: {{bar: {{box: {{x: [{}, {}], y: [0, 1], z: [0, 1], elements: [10, 2, 2], type: hex8}}}}}}}}
sets: {{edge: {{of: bar.left, within: bar.bottom}}, corner: {{of: edge, within: bar.front}}}}
materials: {{m: {{linear_elastic: {{E: 2.1e5, nu: 0.3, density: 7.8e-9}}}}}}
sections: [{{on: bar, material: m, element: solid}}]
steps: {}
output: {{fields: none, report: false}}
)",
                     at, at + 10, steps);
}

/// A long bar in the plane, its left end held while it is heated or pressed.
std::string strip(const std::string& kinematics, const std::string& step) {
  return fmt::format(R"(osculate: 1
mesh: {{generate: {{b: {{box: {{x: [0, 100], y: [0, 1], elements: [50, 2], type: quad8}}}}}}}}
sets: {{foot: {{of: b.left, within: b.bottom}}, tip: {{of: b.right, within: b.bottom}}}}
materials: {{m: {{{}, expansion: {{alpha: 1.0e-5}}}}}}
sections: [{{on: b, material: m, element: plane_stress, kinematics: {}}}]
steps:
{}
output: {{fields: none, report: false}}
)",
                     kinematics == "finite"
                         ? "st_venant_kirchhoff: {E: 2.1e5, nu: 0.3, density: 7.8e-9}"
                         : "linear_elastic: {E: 2.1e5, nu: 0.3, density: 7.8e-9}",
                     kinematics, step);
}

/// Lines of a run that tell of motions without stiffness.
std::string said_of(const std::string& text) {
  namespace fs = std::filesystem;
  const fs::path folder =
      fs::path(::testing::TempDir()) / ("osculate_v" + std::to_string(getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "model.yaml") << text;
  std::string found;
  RunOptions options;
  options.model = (folder / "model.yaml").string();
  options.folder = (folder / "out").string();
  options.say = [&](std::string_view line) {
    if (line.starts_with("warning") || line.find("no stiffness") != std::string_view::npos)
      found += std::string(line) + "\n";
  };
  EXPECT_EQ(run(options).status, RunStatus::done);
  fs::remove_all(folder);
  return found;
}

TEST(VibrationWarnings, RigidMotionsAreCountedAndNotWarnedOf) {
  const auto count = [](int n) {
    return ::testing::AllOf(HasSubstr(fmt::format("{} of them are rigid motions", n)),
                            ::testing::Not(HasSubstr("warning")));
  };
  EXPECT_THAT(said_of(bar("[{name: free, modes: 8}]")), count(6));
  EXPECT_THAT(said_of(bar("[{name: free, modes: 6}]")), count(6));
  EXPECT_THAT(said_of(bar("[{name: free, modes: 8}]", 5000)), count(6));
  EXPECT_THAT(said_of(bar("[{name: v, modes: 7, prescribe: [{on: corner, ux: 0}]}]")), count(5));
  EXPECT_THAT(said_of(bar("[{name: v, modes: 5, prescribe: [{on: corner, ux: 0, uy: 0, uz: 0}]}]")),
              count(3));
  EXPECT_THAT(said_of(bar("[{name: v, modes: 2, prescribe: [{on: edge, ux: 0, uy: 0, uz: 0}]}]")),
              HasSubstr("1 of them is a rigid motion or mechanism: no stiffness"));
}

TEST(VibrationWarnings, TwoBodiesHaveTwelveRigidMotions) {
  const std::string two = R"(osculate: 1
mesh:
  generate:
    a: {box: {x: [0, 10], y: [0, 1], z: [0, 1], elements: [8, 1, 1], type: hex20}}
    b: {box: {x: [20, 30], y: [0, 1], z: [0, 1], elements: [8, 2, 2], type: hex8}}
materials: {m: {linear_elastic: {E: 2.1e5, nu: 0.3, density: 7.8e-9}}}
sections: [{on: a, material: m, element: solid}, {on: b, material: m, element: solid}]
steps: [{name: free, modes: 14}]
output: {fields: none, report: false}
)";
  EXPECT_EQ(said_of(two),
            "free         12 of them are rigid motions or mechanisms: no stiffness\n");
}

// What heat or supports leave in a body that is let go are stresses in balance, within rounding.
TEST(VibrationWarnings, ABodyThatWasHeldAndHeatedIsFreeAgain) {
  for (const char* const kinematics : {"small", "finite"})
    EXPECT_EQ(said_of(strip(kinematics,
                            "  - {name: heat, increments: 2, prescribe: [{on: foot, ux: 0, uy: 0}, "
                            "{on: tip, uy: 0}], temperature: [{on: b.bottom, value: 50}]}\n"
                            "  - {name: free, modes: 5, release: [{on: foot, of: [ux, uy]}, "
                            "{on: tip, of: [uy]}]}")),
              "free         3 of them are rigid motions or mechanisms: no stiffness\n")
        << kinematics;
}

// Euler's load of the strip, held at one end, is pi^2 E I / (4 l^2) = 4.32.
TEST(VibrationWarnings, AStrutUnderMoreThanItsCriticalLoadIsUnstable) {
  const auto under = [](const char* force) {
    return warnings_of(strip("small", fmt::format("  - {{name: press, increments: 1, prescribe: "
                                                  "[{{on: b.left, ux: 0, uy: 0}}], total_force: "
                                                  "[{{on: b.right, fx: -{}}}]}}\n"
                                                  "  - {{name: v, modes: 2}}",
                                                  force)));
  };
  EXPECT_THAT(under("4.25"), IsEmpty());
  EXPECT_THAT(under("4.40"), ElementsAre(HasSubstr("'v': the state is unstable: omega^2 < 0")));
  EXPECT_THAT(under("6"), ElementsAre(HasSubstr("'v': the state is unstable: omega^2 < 0")));
}

// The same strut, straight, at the end of a step that knows its way: of large rotations.
TEST(VibrationWarnings, AStepThatEndsAboveTheCriticalLoadSaysSo) {
  const auto under = [](const char* force) {
    return warnings_of(strip("finite", fmt::format("  - {{name: press, increments: 2, prescribe: "
                                                   "[{{on: b.left, ux: 0, uy: 0}}], total_force: "
                                                   "[{{on: b.right, fx: -{}}}]}}\n",
                                                   force)));
  };
  EXPECT_THAT(under("4.25"), IsEmpty());
  EXPECT_THAT(under("4.40"),
              ElementsAre(HasSubstr("step 'press' ends in an unstable equilibrium: the least "
                                    "disturbance makes the bodies leave it in one way")));
  // the second load of Euler's is nine times the first
  EXPECT_THAT(under("42"), ElementsAre(HasSubstr("leave it in 2 ways")));
}

// A long soft strip is no mechanism: its slowest vibration has 1e-14 of the fastest one's omega^2.
TEST(VibrationWarnings, ASoftBodyIsNoRigidOne) {
  const std::string text =
      said_of(strip("small", "  - {name: v, modes: 2, prescribe: [{on: b.left, ux: 0, uy: 0}]}"));
  EXPECT_EQ(text, "");
}

}  // namespace
}  // namespace osculate::api
