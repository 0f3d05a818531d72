// Axes of materials in model files.
#include <gmock/gmock.h>

#include <algorithm>

#include "deck_test.hpp"
#include "osculate/deck/build.hpp"

namespace osculate::deck {
namespace {

using ::testing::HasSubstr;

std::string model(const std::string& material, const std::string& section, bool space) {
  return std::string("osculate: 1\nmesh: {generate: {b: {box: {x: [0, 1], y: [0, 1]") +
         (space ? ", z: [0, 1], elements: [1, 1, 1]" : ", elements: [1, 1]") +
         "}}}}\nmaterials: {m: " + material +
         "}\nsections: [{on: b, material: m, element: " + (space ? "solid" : "plane_strain") +
         section + "}]\nsteps: [{name: s, increments: 1, prescribe: [{on: b, ux: 0, uy: 0}]}]\n";
}
const std::string wood =
    "{orthotropic: {E1: 12, E2: 1, E3: 0.6, nu12: 0.3, nu13: 0.4, nu23: 0.5, G12: 0.8, G13: 0.7, "
    "G23: 0.2}}";

Built built(const std::string& text) {
  const Description d = parse_model(text, "model.yaml");
  return build(d, load_mesh(d));
}
std::string problem(const std::string& text) {
  try {
    const Description d = parse_model(text, "model.yaml");
    if (is_space(d.sections.at(0).element.value))
      (void)build3(d, load_mesh(d));
    else
      (void)build(d, load_mesh(d));
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(MaterialAxes, AreReadWithTheirTurn) {
  const Description d = parse_model(
      model(wood,
            ", orientation: {rectangular: {x: [1, 1], xy: [0, 1]}, turn: {about: 3, angle: 180}}",
            false),
      "model.yaml");
  const material::Orientation& axes = d.sections.at(0).orientation.value;
  EXPECT_EQ(axes.kind, material::Orientation::Kind::rectangular);
  EXPECT_EQ(axes.a, Vec3(1, 1, 0));
  EXPECT_EQ(axes.about, 2);
  EXPECT_NEAR(axes.angle, 3.14159265358979, 1e-14);
  EXPECT_EQ(d.sections.at(0).kinematics.value, Kinematics::small);
}

TEST(MaterialAxes, ThatAreNoneAreRefused) {
  EXPECT_EQ(problem(model(wood, ", orientation: {rectangular: {x: [1, 1], xy: [2, 2]}}", false)),
            "model.yaml:4: sections[0].orientation: the two points do not give axes: they "
            "coincide, or lie in one direction");
  EXPECT_EQ(problem(model(wood, ", orientation: {turn: {about: 3, angle: 1}}", false)),
            "model.yaml:4: sections[0].orientation: needs one of rectangular, cylindrical");
}

TEST(MaterialAxes, InThePlaneOneIsAcrossIt) {
  EXPECT_EQ(problem(model(wood, ", orientation: {rectangular: {x: [1, 2], xy: [0, 1]}}", false)),
            "");
  EXPECT_EQ(problem(model(wood, ", orientation: {rectangular: {x: [0, 0, 1], xy: [0, 1]}}", false)),
            "");
  EXPECT_EQ(problem(model(wood, ", orientation: {cylindrical: {from: [3, 3]}}", false)), "");
  EXPECT_THAT(
      problem(model(wood, ", orientation: {rectangular: {x: [1, 0, 1], xy: [0, 1]}}", false)),
      HasSubstr("model.yaml:4: sections[0].orientation: material 'm' answers strains of the plane "
                "with shear across it"));
  const std::string crystal =
      "{anisotropic: {D1111: 9, D2222: 9, D3333: 9, D1212: 4, D1313: 4, D2323: 4, D1123: 1}}";
  EXPECT_THAT(problem(model(crystal, "", false)),
              HasSubstr("model.yaml:4: sections[0].material: material 'm' answers strains"));
  EXPECT_EQ(problem(model(crystal, "", true)), "");
}

TEST(MaterialAxes, LieOnLayersOfBricksAndWedges) {
  const std::string on_shell = ", orientation: {cylindrical: {from: [3, 3, 0]}, shell: true}";
  EXPECT_EQ(problem(model(wood, on_shell, true)), "");
  EXPECT_EQ(problem(model(wood, on_shell, false)),
            "model.yaml:4: sections[0].orientation: shell: true is for layers of bricks or wedges, "
            "and set 'b' has quad4 cells");
}

TEST(MaterialAxes, AlongLayersAreWarnedOf) {
  const auto warnings = [](const char* heights) {
    std::string text = model(
        wood, ", orientation: {rectangular: {x: [1, 0, 0], xy: [0, 1, 0]}, shell: true}", true);
    text.replace(text.find("z: [0, 1]"), 9, heights);
    const Description d = parse_model(text, "model.yaml");
    return build3(d, load_mesh(d)).warnings;
  };
  const auto warned = ::testing::Contains(
      HasSubstr("the third axis of the shell 'b' is along the third local direction of its cells"));
  EXPECT_THAT(warnings("z: [0, 2.1]"), warned);
  EXPECT_THAT(warnings("z: [0, 1.9]"), ::testing::Not(warned));
}

TEST(MaterialAxes, WithoutEffectAreToldOf) {
  const Built b = built(model("{linear_elastic: {E: 1, nu: 0.3}}",
                              ", orientation: {cylindrical: {from: [3, 3]}}", false));
  EXPECT_EQ(std::count(b.warnings.begin(), b.warnings.end(),
                       "sections: the orientation on 'b' has no effect: material 'm' is the same "
                       "in all directions"),
            1);
}

TEST(MaterialAxes, AStiffnessThatGivesEnergyIsRefusedByItsKey) {
  std::string steep = wood;
  steep.replace(steep.find("nu12: 0.3"), 9, "nu12: 3.5");
  EXPECT_EQ(problem(model(steep, "", true)),
            "model.yaml:3: materials.m.orthotropic.nu12: nu12^2 < E1 / E2 is needed: else the "
            "stiffness is not positive definite");
  EXPECT_EQ(problem(model("{anisotropic: {D1111: 9, D2222: 1, D3333: 9, D1212: 4, D1313: 4, D2323: "
                          "4, D1122: 3}}",
                          "", true)),
            "model.yaml:3: materials.m.anisotropic.D2222: D2222 is too small beside the other "
            "constants: the stiffness is not positive definite");
}

}  // namespace
}  // namespace osculate::deck
