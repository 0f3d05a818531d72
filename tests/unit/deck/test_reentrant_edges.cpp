// One meshed master with a concave edge in space, and unknown tractions: nodes stay in the edge,
// slide along it and leave it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>

#include "deck_test.hpp"
#include "osculate/deck/build.hpp"

namespace osculate::deck {
namespace {

using Look = std::function<void(const model::System3&, const model::State3&)>;

void run(const std::string& text, const Look& look) {
  const Description description = parse_model(text, "model.yaml");
  const Built3 built = build3(description, load_mesh(description));
  model::AnalysisObserver3 observer;
  observer.converged = [&](model::System3& system, const model::State3& state,
                           const model::Progress&, const solve::IncrementRecord* record) {
    if (record) look(system, state);
    return true;
  };
  const model::AnalysisResult3 result = model::run(built.model, built.options, observer);
  EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
}

/// A groove along x with sides that rise by 0.5, as one surface or as two that go on beyond the
/// edge, and an elastic block on its edge in it: what stands in `drag` follows on pressing it in.
std::string groove(double mu, bool one_master, const std::string& drag,
                   const std::string& lateral = ", uy: 0") {
  const std::string file = ::testing::TempDir() + "groove.msh";
  std::string nodes, quads;
  for (int i = 0; i < 4; ++i)
    for (int j = -1; j <= 1; ++j)
      nodes += fmt::format("{} {} {} {}\n", 3 * i + j + 2, 2 * i, 2 * j, j == 0 ? 0 : 1);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 2; ++j) {
      const int n = 3 * i + j + 1;
      quads += fmt::format("{} 3 2 1 1 {} {} {} {}\n", 2 * i + j + 1, n, n + 3, n + 4, n + 1);
    }
  std::ofstream(file) << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 1 "
                         "\"sides\"\n$EndPhysicalNames\n$Nodes\n12\n"
                      << nodes << "$EndNodes\n$Elements\n6\n"
                      << quads << "$EndElements\n";
  const std::string friction =
      mu > 0 ? fmt::format("{{coulomb: {{mu: {}, penalty: 100}}}}", mu) : std::string("none");
  const auto pair = [&](const char* master) {
    return fmt::format(
        "{{name: c_{0}, master: {0}, slave: lower, normal: {{penalty: 100}}, "
        "friction: {1}, enforcement: lagrange_multiplier}}",
        master, friction);
  };
  const std::string fixed = "ux: 0, uy: 0, uz: 0, rx: 0, ry: 0, rz: 0}";
  return fmt::format(
      R"(osculate: 1
mesh:
  files: {{groove: {{file: {}}}}}
  generate:
    first: {{grid: {{origin: [-1, -2, 1], u: [8, 0, 0], v: [0, 4, -2], elements: [3, 1]}}}}
    second: {{grid: {{origin: [-1, -2, -1], u: [8, 0, 0], v: [0, 4, 2], elements: [3, 1]}}}}
    block: {{box: {{x: [0.5, 2.5], y: [0, 1], z: [0, 1], elements: [4, 2, 2], angle: 45, axis: [1, 0, 0]}}}}
sets: {{lower: {{union: [block.front, block.bottom]}}, upper: {{union: [block.back, block.top]}}}}
materials: {{soft: {{linear_elastic: {{E: 100, nu: 0.3}}}}}}
sections: [{{on: block, material: soft, element: solid}}]
rigid: {{one: {{set: groove.sides}}, left: {{set: first}}, right: {{set: second}}}}
contact: [{}]
steps:
  - {{name: press, increments: 1, prescribe: [{{on: upper, ux: 0, uz: -0.02{}}},
      {{on: one, {}, {{on: left, {}, {{on: right, {}]}}
{})",
      file, one_master ? pair("one") : pair("left") + ", " + pair("right"), lateral, fixed, fixed,
      fixed, drag);
}

constexpr std::size_t first_node = 8 + 8, last_node = first_node + 5 * 3 * 3;  // of the block

Vec3 force_on_block(const model::System3& system) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t n = first_node; n < last_node; ++n)
    sum += system.forces().contact.segment<3>(3 * static_cast<Eigen::Index>(n));
  return sum;
}
std::vector<Vec3> places_of_block(const model::System3& system, const model::State3& state) {
  const std::vector<Vec3> x = system.positions(state);
  return {x.begin() + first_node, x.begin() + last_node};
}

/// Dragged along, the edge of the block meets mu F / sin(beta), beta the half angle of the groove;
/// without friction nothing. Two masters say the same, and the nodes are at the same place.
TEST(ReentrantEdges, ABlockIsDraggedAlongAGroove) {
  const std::string drag = "  - {name: drag, increments: 4, prescribe: [{on: upper, ux: 1.7}]}\n";
  for (const double mu : {0.0, 0.3}) {
    std::array<Vec3, 2> force;
    std::array<std::vector<Vec3>, 2> places;
    for (const bool one : {true, false})
      run(groove(mu, one, drag), [&](const model::System3& system, const model::State3& state) {
        force[one] = force_on_block(system);
        places[one] = places_of_block(system, state);
        if (!one) return;
        for (const Vec3& p : places[one]) EXPECT_GE(p.z(), 0.5 * std::abs(p.y()) - 1e-12);
      });
    ASSERT_GT(std::abs(force[1].z()), 0.1);
    const double sine = std::cos(std::atan(0.5));
    EXPECT_NEAR(std::abs(force[1].x() / force[1].z()), mu / sine, 1e-9);
    EXPECT_NEAR((force[1] - force[0]).norm(), 0, 1e-7 * force[1].norm());
    for (std::size_t n = 0; n < places[0].size(); ++n)
      EXPECT_NEAR((places[0][n] - places[1][n]).norm(), 0, 1e-8);
  }
}

/// Pushed across until it leaves the edge, and lifted off.
TEST(ReentrantEdges, ABlockLeavesAGroove) {
  const std::string out =
      "  - {name: push, increments: 8, prescribe: [{on: upper, uy: 0.3}]}\n"
      "  - {name: lift, increments: 1, prescribe: [{on: upper, uz: 0.4}]}\n";
  for (const double mu : {0.0, 0.3}) {
    double last = 0, farthest = 0;
    run(groove(mu, true, out), [&](const model::System3& system, const model::State3& state) {
      const std::vector<Vec3> x = places_of_block(system, state);
      for (const Vec3& p : x) EXPECT_GE(p.z(), 0.5 * std::abs(p.y()) - 1e-12);
      last = force_on_block(system).norm();
      farthest = std::max(farthest, x[0].y());
    });
    EXPECT_EQ(last, 0);
    EXPECT_GT(farthest, 0.05);
  }
}

/// The concave edge of an elastic angle: the nodes pressed into it go where it goes.
TEST(ReentrantEdges, OfAnElasticBodyMoveWithIt) {
  const std::string file = ::testing::TempDir() + "angle_in_space.msh";
  const std::array<std::array<int, 2>, 8> plane{
      {{0, 0}, {1, 0}, {2, 0}, {0, 1}, {1, 1}, {2, 1}, {0, 2}, {1, 2}}};
  std::string text =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n2 2 \"inner\"\n2 3 \"foot\"\n3 1 "
      "\"angle\"\n$EndPhysicalNames\n$Nodes\n16\n";
  for (int z = 0; z < 2; ++z)
    for (int k = 0; k < 8; ++k) {
      const auto& p = plane[static_cast<std::size_t>(k)];
      text += fmt::format("{} {} {} {}\n", 8 * z + k + 1, p[0], p[1], z);
    }
  text += R"($EndNodes
$Elements
7
1 5 2 1 1 1 2 5 4 9 10 13 12
2 5 2 1 1 2 3 6 5 10 11 14 13
3 5 2 1 1 4 5 8 7 12 13 16 15
4 3 2 2 2 5 13 16 8
5 3 2 2 2 6 14 13 5
6 3 2 3 3 1 2 10 9
7 3 2 3 3 2 3 11 10
$EndElements
)";
  std::ofstream(file) << text;
  for (const double mu : {0.0, 0.3}) {
    double moved = 0, apart = 0;
    Vec3 sum = Vec3::Zero();
    run(fmt::format(R"(osculate: 1
mesh:
  files: {{angle: {{file: {0}}}}}
  generate: {{block: {{box: {{x: [1, 1.6], y: [1, 1.5], z: [0.2, 0.8], elements: [2, 2, 2]}}}}}}
materials: {{m: {{linear_elastic: {{E: 100, nu: 0.3}}}}}}
sections: [{{on: block, element: solid, material: m}}, {{on: angle.angle, element: solid, material: m}}]
contact:
  - {{name: c, master: angle.inner, slave: [block.front, block.left], sampling: nodes,
     normal: {{penalty: 1000}}, friction: {1}, enforcement: lagrange_multiplier}}
steps:
  - {{name: push, increments: 2, prescribe: [{{on: block.back, ux: -0.02, uy: -0.02, uz: 0}},
                                            {{on: angle.foot, ux: 0, uy: 0, uz: 0}}]}}
)",
                    file, mu > 0 ? "{coulomb: {mu: 0.3, penalty: 1000}}" : "none"),
        [&](const model::System3& system, const model::State3& state) {
          const std::vector<Vec3> x = system.positions(state);
          const Vec3 a = x[27 + 4], along = (x[27 + 12] - a).normalized();  // the block has 27
          moved = (Vec3(a - Vec3(1, 1, 0))).norm();
          apart = 0;
          for (const std::size_t n : {0u, 9u, 18u}) {  // the block's edge x = y = 1
            const Vec3 arm = x[n] - a;
            apart = std::max(apart, (arm - arm.dot(along) * along).norm());
          }
          sum.setZero();
          for (Eigen::Index n = 0; n < system.forces().contact.size() / 3; ++n)
            sum += system.forces().contact.segment<3>(3 * n);
        });
    EXPECT_GT(moved, 1e-3);
    EXPECT_LT(apart, 1e-10) << mu;
    EXPECT_LT(sum.norm(), 1e-10);
  }
}

}  // namespace
}  // namespace osculate::deck
