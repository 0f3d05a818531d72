// Rigid surfaces of facets with nothing behind them face the side where the slave starts.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "space_test.hpp"
#include "system_test.hpp"

namespace osculate::deck {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A block on a wall of lines.
std::string block_on(const std::string& points, const std::string& flip = "") {
  return fmt::format(R"(osculate: 1
mesh: {{generate: {{b: {{box: {{x: [0, 2], y: [0, 1], elements: [4, 2]}}}}, wall: {{line: {{points: {}, elements: 4}}}}}}}}
materials: {{m: {{linear_elastic: {{E: 100, nu: 0}}}}}}
sections: [{{on: b, material: m, element: plane_strain}}]
rigid: {{floor: {{set: wall{}}}}}
contact: [{{name: c, master: floor, slave: b.bottom, normal: {{penalty: 1e5}}}}]
steps: [{{name: press, increments: 1, prescribe: [{{on: b.top, ux: 0, uy: -0.01}}]}}]
)",
                     points, flip);
}

/// Normal force at the end, of a plane model or one in space.
template <int Dim>
double pressed(const BasicBuilt<Dim>& built) {
  double force = 0;
  model::BasicAnalysisObserver<Dim> observer;
  observer.converged = [&](model::BasicSystem<Dim>& system, const model::BasicState<Dim>&,
                           const model::Progress&, const solve::IncrementRecord*) {
    force = 0;
    for (const pairing::PointResult<Dim>& point : system.contact()[0].points)
      force -= point.normal_traction * point.weight;
    return true;
  };
  const auto result = model::run(built.model, built.options, observer);
  EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
  return force;
}

TEST(RigidSide, AWallOfLinesHoldsWhicheverWayTheyAreNumbered) {
  const double exact = 2 * 100 * 0.01;  // area, modulus, strain; the penalty adds 0.1 %
  EXPECT_NEAR(pressed(build_text(block_on("[[3, 0], [-1, 0]]"))), exact, 2e-3 * exact);
  const Built other = build_text(block_on("[[-1, 0], [3, 0]]"));
  EXPECT_NEAR(pressed(other), exact, 2e-3 * exact);
  const Built first = build_text(block_on("[[3, 0], [-1, 0]]"));
  EXPECT_EQ(first.notes.size() + other.notes.size(), 1u);
  EXPECT_THAT(first.notes.empty() ? other.notes : first.notes,
              Contains(HasSubstr("4 of its 4 facets were turned round to face the side where")));
}

TEST(RigidSide, FlipSaysOtherwise) {
  const bool forward = build_text(block_on("[[-1, 0], [3, 0]]")).notes.empty();
  for (const bool flip : {false, true}) {
    const Built built =
        build_text(block_on("[[-1, 0], [3, 0]]", flip ? ", flip: true" : ", flip: false"));
    EXPECT_THAT(built.notes, IsEmpty());
    EXPECT_EQ(pressed(built) > 1, flip != forward);
  }
}

/// Two walls on both sides of a strip, in one rigid body; both lines run to the right.
Built strip_in_channel(const std::string& side) {
  const Description description = parse_model(fmt::format(R"(osculate: 1
mesh:
  generate:
    b: {{box: {{x: [0, 2], y: [0, 1], elements: [4, 2]}}}}
    low: {{line: {{points: [[-1, -0.1], [3, -0.1]], elements: 2}}}}
    high: {{line: {{points: [[-1, 1.1], [3, 1.1]], elements: 2}}}}
materials: {{m: {{linear_elastic: {{E: 100, nu: 0}}}}}}
sections: [{{on: b, material: m, element: plane_strain}}]
rigid: {{channel: {{set: low}}}}
contact: [{{name: c, master: channel, slave: b.{0}, normal: {{penalty: 10}}}}]
steps: [{{name: press, increments: 1, prescribe: [{{on: b.{0}, ux: 0}}]}}]
)",
                                                          side),
                                              "model.yaml");
  mesh::Mesh mesh = load_mesh(description);
  const mesh::Set high = *mesh.find_set("high");
  for (mesh::Set& set : mesh.sets)
    if (set.name == "low") {
      set.cells.insert(set.cells.end(), high.cells.begin(), high.cells.end());
      set.nodes.insert(set.nodes.end(), high.nodes.begin(), high.nodes.end());
    }
  return build(description, mesh);
}

TEST(RigidSide, EachPartOfAChannelFacesTheStrip) {
  for (const std::string side : {"bottom", "top", "left"}) {
    const Built built = strip_in_channel(side);
    EXPECT_THAT(built.warnings, IsEmpty()) << side;
    const pairing::Chain& master = built.model.pairs[0].definition.master;
    ASSERT_EQ(master.facets.size(), 4u);
    for (const pairing::Facet& facet : master.facets) {
      const Vec2& a = built.model.reference[static_cast<std::size_t>(facet.nodes[0])];
      const Vec2& b = built.model.reference[static_cast<std::size_t>(facet.nodes[1])];
      const double middle = 0.5;
      EXPECT_GT(turn(Vec2(b - a)).y() * (middle - a.y()), 0) << side;
    }
  }
}

TEST(RigidSide, SlavesOnBothSidesAreToldOf) {
  std::string text = block_on("[[-1, 0.5], [3, 0.5]]");
  text = edited(text, "slave: b.bottom", "slave: b.right");
  EXPECT_THAT(build_text(text).warnings, Contains(HasSubstr("starts on both sides of it")));
}

TEST(RigidSide, APlateOfAreasHoldsABlockAboveAndOneBelow) {
  for (const bool above : {false, true}) {
    const std::string text = fmt::format(R"(osculate: 1
mesh:
  generate:
    b: {{box: {{x: [0, 2], y: [0, 2], z: {}, elements: [2, 2, 2]}}}}
    wall: {{grid: {{origin: [-1, -1, 0], u: [4, 0, 0], v: [0, 4, 0], elements: [2, 2]}}}}
materials: {{m: {{linear_elastic: {{E: 100, nu: 0}}}}}}
sections: [{{on: b, material: m, element: solid}}]
rigid: {{floor: {{set: wall}}}}
contact: [{{name: c, master: floor, slave: {}, normal: {{penalty: 1e5}}}}]
steps: [{{name: press, increments: 1, prescribe: [{{on: {}, ux: 0, uy: 0, uz: {}}}]}}]
)",
                                         above ? "[0, 1]" : "[-1, 0]", above ? "b.bottom" : "b.top",
                                         above ? "b.top" : "b.bottom", above ? -0.01 : 0.01);
    const double exact = 4 * 100 * 0.01;
    EXPECT_NEAR(pressed(built_from(text)), exact, 2e-3 * exact) << above;
  }
}

}  // namespace
}  // namespace osculate::deck
