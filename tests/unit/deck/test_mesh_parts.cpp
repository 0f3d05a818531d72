#include <gmock/gmock.h>

#include "deck_test.hpp"
#include "osculate/deck/build.hpp"
#include "osculate/mesh/check.hpp"

namespace osculate::deck {
namespace {

using cell::CellType;
using ::testing::IsEmpty;

Description good() { return parse_model(test_file("parts.yaml"), "model.yaml"); }

template <class T>
const T& part(const Description& d, std::size_t i) {
  return std::get<T>(d.mesh.generated.at(i).shape);
}

TEST(MeshParts, Boxes) {
  const Description d = good();
  const Box& beam = part<Box>(d, 0);
  EXPECT_TRUE(beam.solid());
  EXPECT_EQ(beam.breakpoints[2].value, (std::vector<double>{0, 0.5}));
  EXPECT_EQ(beam.elements[0], std::vector<int>{6});
  EXPECT_EQ(beam.elements[2], std::vector<int>{1});
  EXPECT_EQ(beam.bias[0], std::vector<double>{2});
  EXPECT_EQ(beam.type.value, CellType::shell18);
  EXPECT_EQ(beam.angle.value, 90);
  EXPECT_EQ(beam.about, Vec3(0, 1, 2));
  EXPECT_EQ(beam.axis, Vec3(0, 0, 2));
  const Box& block = part<Box>(d, 1);
  EXPECT_EQ(block.type.value, CellType::hex8);
  EXPECT_EQ(block.bias[2], std::vector<double>{1});
  EXPECT_EQ(block.axis, Vec3(0, 0, 1));
}

TEST(MeshParts, Rings) {
  const Description d = parse_model(test_file("ring.yaml"), "model.yaml");
  const Built3 built = build3(d, load_mesh(d));
  const mesh::Mesh& mesh = built.model.mesh;
  EXPECT_EQ(mesh.find_set("ring")->cells.size(), 24u);
  EXPECT_EQ(mesh.find_set("ring.from"), nullptr);
  for (const Index n : mesh.find_set("ring.outer")->nodes)
    EXPECT_NEAR((mesh.nodes[static_cast<std::size_t>(n)] - Vec3(1, -1, 0)).norm(), 3, 1e-14);
  EXPECT_EQ(mesh.find_set("pipe")->cells.size(), 24u);
  // The pressure on a quarter: radius times length in both directions.
  EXPECT_NEAR(built.loads[0].at(0).whole.force.y(), 8, 1e-12);
  EXPECT_NEAR(built.loads[0].at(0).whole.force.z(), 8, 1e-12);
  EXPECT_NEAR(built.loads[0].at(0).whole.force.x(), 0, 1e-12);
}

TEST(MeshParts, BrokenRings) {
  const auto refused = [](const std::string& from, const std::string& to) {
    return refusal(edited(test_file("ring.yaml"), from, to));
  };
  EXPECT_EQ(refused("center: [1, -1]", "center: [1, -1, 0]"),
            "model.yaml:5: mesh.generate.ring.ring.center: expected 2 values without z, "
            "got 3");
  EXPECT_EQ(refused("center: [1, -1]", "along: x"),
            "model.yaml:5: mesh.generate.ring.ring.along: needs z");
}

TEST(MeshParts, DiscsAndCylinders) {
  const Description d = parse_model(test_file("round.yaml"), "model.yaml");
  const auto& wheel = part<mesh::DiscSpec>(d, 0);
  EXPECT_EQ(wheel.quarters, 2);
  EXPECT_EQ(wheel.from, 180);
  EXPECT_EQ(wheel.core, 2);
  EXPECT_EQ(wheel.layer_bias, 0.5);
  EXPECT_EQ(wheel.center, Vec3(0, 5, 0));
  EXPECT_TRUE(wheel.heights.empty());
  const auto& bar = part<mesh::DiscSpec>(d, 1);
  EXPECT_EQ(bar.quarters, 2);
  EXPECT_EQ(bar.type, CellType::hex20);
  EXPECT_EQ(bar.elements, (std::vector<int>{1, 4}));
  EXPECT_EQ(bar.bias, (std::vector<double>{2, 1}));
  EXPECT_EQ(bar.along, 1);
  EXPECT_EQ(part<mesh::BallSpec>(d, 2).sides, (std::array{0, 0, 0}));
  const Built3 built = build3(d, load_mesh(d));
  // The pressure on the half cylinder of the bar: diameter times length.
  EXPECT_NEAR((built.loads[0].at(0).whole.force - Vec3(-2 * 3, 0, 0)).norm(), 0, 1e-12);
}

TEST(MeshParts, RefusedDiscs) {
  const auto refused = [](const std::string& from, const std::string& to) {
    return refusal(edited(test_file("round.yaml"), from, to));
  };
  EXPECT_EQ(refused("angle: [180, 360]", "angle: [180, 300]"),
            "model.yaml:5: mesh.generate.wheel.disc.angle: a disc is made of quarters: the angles "
            "must differ by 90, 180, 270 or 360, not 120");
  EXPECT_EQ(refused("elements: [2, 3]", "elements: [[2, 1], 3]"),
            "model.yaml:5: mesh.generate.wheel.disc.elements[0]: expected one value for each of "
            "the 1 intervals, got 2");
  EXPECT_EQ(refused("elements: [2, 3]", "elements: [2, 3, 1]"),
            "model.yaml:5: mesh.generate.wheel.disc.elements: expected 2 values without z, got 3");
  EXPECT_EQ(refused("type: hex20", "type: quad8"),
            "model.yaml:9: mesh.generate.bar.disc.type: with z it is made of tet4, tet10, wedge6, "
            "wedge15, hex8, hex20, hex27, shell18; got quad8");
}

TEST(MeshParts, Surfaces) {
  const Description d = good();
  const auto& roll = part<mesh::TubeSpec>(d, 2);
  EXPECT_EQ(roll.name, "roll");
  EXPECT_EQ(roll.start, Vec3(12, -1, -2));
  EXPECT_EQ(roll.end, Vec3(12, 2, -2));
  EXPECT_EQ(roll.radius, 2);
  EXPECT_EQ(roll.elements, (std::array{49, 3}));
  EXPECT_EQ(roll.zero.value(), Vec3(0, 0, 1));
  EXPECT_EQ(roll.type, CellType::quad9);
  const auto& pipe = part<mesh::TubeSpec>(d, 3);
  EXPECT_FALSE(pipe.zero.has_value());
  EXPECT_EQ(pipe.to, 360);
  EXPECT_EQ(pipe.type, CellType::quad4);
  const auto& floor = part<mesh::GridSpec>(d, 4);
  EXPECT_EQ(floor.origin, Vec3(0, 0, -1));
  EXPECT_EQ(floor.v, Vec3(0, 2, 0));
  EXPECT_EQ(floor.type, CellType::quad8);
  const auto& globe = part<mesh::SphereSpec>(d, 5);
  EXPECT_EQ(globe.elements, 4);
  EXPECT_TRUE(globe.inside);
  EXPECT_EQ(globe.type, CellType::tri3);
  const auto& drop = part<mesh::BallSpec>(d, 6);
  EXPECT_EQ(drop.core, 2);
  EXPECT_EQ(drop.layers, 3);
  EXPECT_EQ(drop.layer_bias, 0.5);
  EXPECT_EQ(drop.sides, (std::array{1, 1, -1}));
  EXPECT_EQ(drop.type, CellType::hex27);
  // `sides` by its former name.
  const Description before =
      parse_model(edited(test_file("parts.yaml"), "sides:", "octant:"), "model.yaml");
  EXPECT_EQ(part<mesh::BallSpec>(before, 6).sides, (std::array{1, 1, -1}));
}

TEST(MeshParts, AreGenerated) {
  const mesh::Mesh mesh = load_mesh(good());
  EXPECT_THAT(mesh::check_mesh(mesh), IsEmpty());
  EXPECT_EQ(mesh.find_set("beam")->cells.size(), 12U);
  EXPECT_EQ(mesh.find_set("block")->cells.size(), 1U);
  EXPECT_EQ(mesh.find_set("roll")->cells.size(), 147U);
  EXPECT_EQ(mesh.find_set("pipe.end")->cells.size(), 4U);
  EXPECT_EQ(mesh.find_set("floor")->cells.size(), 32U);
  EXPECT_EQ(mesh.find_set("globe")->cells.size(), 192U);
  EXPECT_EQ(mesh.find_set("drop")->cells.size(), 8U + 3 * 12U);
  // a quarter turn about (0, 1): x runs along y
  const Index corner = mesh.find_set("beam.top_front_right")->nodes.at(0);
  EXPECT_EQ(mesh.nodes[static_cast<std::size_t>(corner)], Vec3(1, 13, 0.5));
}

struct Refusal {
  const char *from, *to, *message;
};

void expect_refusals(const std::vector<Refusal>& refusals) {
  for (const Refusal& r : refusals)
    EXPECT_EQ(refusal(edited(test_file("parts.yaml"), r.from, r.to)), r.message);
}

TEST(MeshParts, RefusedBoxes) {
  expect_refusals({
      {"z: [0, 0.5]", "z: [0, 0]",
       "model.yaml:9: mesh.generate.beam.box.z[1]: breakpoints must increase, got 0 after 0"},
      {"elements: [6, [2], 1]", "elements: [6, [2]]",
       "model.yaml:10: mesh.generate.beam.box.elements: expected 3 values with z, got 2"},
      {"bias: [2, 1, [1]]", "bias: [2, 1]",
       "model.yaml:11: mesh.generate.beam.box.bias: expected 3 values with z, got 2"},
      {"z: [0, 1], elements: [1, 1, 1]", "elements: [1, 1, 1]",
       "model.yaml:16: mesh.generate.block.box.elements: expected 2 values without z, "
       "got 3"},
      {"elements: [1, 1, 1]}", "elements: [300, 300, 300]}",
       "model.yaml:16: mesh.generate.block.box.elements: 27000000 elements are too many; at most "
       "10000000"},
      {"type: shell18", "type: quad9",
       "model.yaml:12: mesh.generate.beam.box.type: with z it is made of tet4, tet10, wedge6, "
       "wedge15, hex8, hex20, hex27, shell18; got quad9"},
      {"z: [0, 1], elements: [1, 1, 1]", "elements: [1, 1], type: hex8",
       "model.yaml:16: mesh.generate.block.box.type: without z it is made of tri3, tri6, quad4, "
       "quad8, quad9; got hex8"},
      {"elements: [1, 1, 1]}", "elements: [1, 1, 1], crown: {side: top, radius: 9}}",
       "model.yaml:16: mesh.generate.block.box.crown: is for boxes without z"},
      {"z: [0, 1], elements: [1, 1, 1]", "elements: [1, 1], axis: [0, 0, 1]",
       "model.yaml:16: mesh.generate.block.box.axis: is for boxes with z; others turn about z"},
      {"about: [0, 1, 2]", "about: [0, 1]",
       "model.yaml:14: mesh.generate.beam.box.about: expected 3 values for a box with z, got 2"},
      {"axis: [0, 0, 2]", "axis: [0, 0, 0]",
       "model.yaml:15: mesh.generate.beam.box.axis: expected a direction, got a vector of no "
       "length"},
  });
}

TEST(MeshParts, RefusedSurfacesAndBalls) {
  expect_refusals({
      {"ends: [[12, -1, -2], [12, 2, -2]]", "ends: [[12, -1, -2], [12, -1, -2]]",
       "model.yaml:19: mesh.generate.roll.tube.ends: both ends are the same point"},
      {"ends: [[12, -1, -2], [12, 2, -2]]", "ends: [[12, -1, -2], [12, 2]]",
       "model.yaml:19: mesh.generate.roll.tube.ends[1]: expected 3 values, got 2"},
      {"elements: [49, 3]", "elements: [49, 0]",
       "model.yaml:21: mesh.generate.roll.tube.elements[1]: must be >= 1 and <= 100000, got 0"},
      {"zero: [0, 0, 1]", "zero: [0, 0, 0]",
       "model.yaml:22: mesh.generate.roll.tube.zero: expected a direction, got a vector of no "
       "length"},
      {"to: 360", "to: 361",
       "model.yaml:24: mesh.generate.roll.tube.to: must be above 'from' = 0 by at most 360, got "
       "361"},
      {"radius: 1, elements: [4, 1]", "radius: 0, elements: [4, 1]",
       "model.yaml:27: mesh.generate.pipe.tube.radius: must be > 0, got 0"},
      {"u: [4, 0, 0]", "u: [0, 0, 0]",
       "model.yaml:28: mesh.generate.floor.grid.u: expected a direction, got a vector of no "
       "length"},
      {"elements: 4, type: tri3", "elements: 4, type: hex8",
       "model.yaml:29: mesh.generate.globe.sphere.type: unknown value 'hex8'; known: "
       "tri3, tri6, quad4, quad8, quad9"},
      {"sides: [1, 1, -1]", "sides: [1, 2, -1]",
       "model.yaml:30: mesh.generate.drop.ball.sides[1]: must be >= -1 and <= 1, got 2"},
      {"type: hex27", "type: tet4",
       "model.yaml:30: mesh.generate.drop.ball.type: unknown value 'tet4'; known: hex8, "
       "hex20, hex27"},
      {"globe: {sphere:", "globe: {spheer:",
       "model.yaml:29: mesh.generate.globe: unknown key 'spheer'; did you mean 'sphere'?"},
  });
}

// What only the generator can find out is said with the place of the part.
TEST(MeshParts, GeneratorsNameThePlace) {
  const auto message = [](const char* from, const char* to) -> std::string {
    const Description d = parse_model(edited(test_file("parts.yaml"), from, to), "model.yaml");
    try {
      (void)load_mesh(d);
    } catch (const core::InputError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_EQ(
      message("v: [0, 2, 0]", "v: [2, 0, 0]"),
      "model.yaml:28: mesh.generate.floor: grid 'floor': the sides u and v must be finite and "
      "not parallel");
  EXPECT_EQ(message("zero: [0, 0, 1]", "zero: [0, 3, 0]"),
            "model.yaml:17: mesh.generate.roll: tube 'roll': the direction of the angle zero must "
            "not be along the axis");
  EXPECT_EQ(message("radius: 1, elements: [4, 1]", "radius: 1, elements: [2, 1]"),
            "model.yaml:27: mesh.generate.pipe: tube 'pipe': 2 elements around; at least 3 are "
            "needed all round");
}

}  // namespace
}  // namespace osculate::deck
