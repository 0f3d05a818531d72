// Types of elements of decks, and their temperatures.
#include <gtest/gtest.h>

#include "osculate/deck/build.hpp"
#include "osculate/deck/inp_translate.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/deck/to_inp.hpp"

namespace osculate::deck {
namespace {

/// Two squares side by side, of the types.
std::string squares(const std::string& left, const std::string& right) {
  return R"(*NODE, NSET=ALL
1, 0, 0
2, 1, 0
3, 2, 0
4, 0, 1
5, 1, 1
6, 2, 1
*ELEMENT, ELSET=PLATE, TYPE=)" +
         left + "\n1, 1, 2, 5, 4\n*ELEMENT, ELSET=PLATE, TYPE=" + right + R"(
2, 2, 3, 6, 5
*MATERIAL, NAME=M
*ELASTIC
1000., .3, 0.
1000., .3, 500.
*EXPANSION, ZERO=20.
1.E-5, 0.
2.E-5, 100.
*SOLID SECTION, ELSET=PLATE, MATERIAL=M
0.5
)";
}

std::string yaml_of(const std::string& left, const std::string& right,
                    const std::string& rest = "*STEP\n*STATIC\n*END STEP\n") {
  const TranslatedDeck deck = translate_deck(squares(left, right) + rest, "plate.inp");
  (void)parse_model(deck.root, "plate.inp");
  return to_yaml(deck.root);
}

std::string section(const char* on, const char* element, const char* formulation) {
  return std::string("  - {on: ") + on + ", material: M, element: " + element +
         ", kinematics: small, formulation: " + formulation;
}

TEST(InpElements, HaveTheFormulationOfTheirType) {
  const struct {
    const char *type, *element, *formulation;
  } cases[]{{"CPE4", "plane_strain", "full"},      {"CPE4R", "plane_strain", "reduced"},
            {"CPE4RH", "plane_strain", "reduced"}, {"CPE4I", "plane_strain", "enhanced"},
            {"CPE4H", "plane_strain", "bbar"},     {"CPS4R", "plane_stress", "reduced"},
            {"CAX4R", "axisymmetric", "reduced"},  {"CAX4", "axisymmetric", "full"}};
  for (const auto& one : cases) {
    const std::string yaml = yaml_of(one.type, one.type);
    EXPECT_NE(yaml.find(section("PLATE", one.element, one.formulation)), std::string::npos) << yaml;
  }
}

/// One plane element of second order, of the type.
std::string second_order(const std::string& type) {
  const bool triangle = type.find('6') != std::string::npos;
  return R"(*NODE, NSET=ALL
1, 1, 0
2, 2, 0
3, 2, 1
4, 1, 1
5, 1.5, 0
6, 2, 0.5
7, 1.5, 1
8, 1, 0.5
9, 1.5, 0.5
*ELEMENT, ELSET=PLATE, TYPE=)" +
         type + (triangle ? "\n1, 1, 2, 3, 5, 6, 9\n" : "\n1, 1, 2, 3, 4, 5, 6, 7, 8\n") + R"(
*MATERIAL, NAME=M
*ELASTIC
1000., .3
*SOLID SECTION, ELSET=PLATE, MATERIAL=M
0.5
*STEP
*STATIC
*END STEP
)";
}

TEST(InpElements, OfSecondOrderHaveTheFormulationOfTheirType) {
  const struct {
    const char *type, *element, *formulation;
  } cases[]{{"CPE8", "plane_strain", "full"},  {"CPE8R", "plane_strain", "reduced"},
            {"CPE8H", "plane_strain", "bbar"}, {"CPE8RH", "plane_strain", "bbar"},
            {"CPE6H", "plane_strain", "bbar"}, {"CPE6MH", "plane_strain", "bbar"},
            {"CAX8H", "axisymmetric", "bbar"}, {"CAX8RH", "axisymmetric", "bbar"},
            {"CAX6H", "axisymmetric", "bbar"}, {"CPS8R", "plane_stress", "reduced"},
            {"CPS6", "plane_stress", "full"}};
  for (const auto& one : cases) {
    const TranslatedDeck deck = translate_deck(second_order(one.type), "plate.inp");
    (void)parse_model(deck.root, "plate.inp");
    const std::string yaml = to_yaml(deck.root);
    EXPECT_NE(yaml.find(section("PLATE", one.element, one.formulation)), std::string::npos) << yaml;
  }
}

/// A box of the type, written as a deck.
WrittenDeck written_box(const std::string& type, bool plane, const std::string& formulation) {
  const std::string text = "osculate: 1\nmesh: {generate: {b: {box: {x: [0, 1], y: [0, 1]" +
                           std::string(plane ? "" : ", z: [0, 1]") +
                           ", elements: " + (plane ? "[1, 1]" : "[1, 1, 1]") + ", type: " + type +
                           "}}}}\nmaterials: {m: {elastoplastic: {E: 100, nu: 0.3, yield: 1}}}\n"
                           "sections: [{on: b, material: m, element: " +
                           (plane ? "plane_strain" : "solid") + ", formulation: " + formulation +
                           "}]\nsteps: [{name: s, increments: 1, prescribe: [{on: b, ux: 0}]}]\n";
  const Description description = parse_model(text, "model.yaml");
  return write_deck(description, build_any(description, load_mesh(description)));
}

TEST(InpElements, OfConstantAndLinearVolumeRatiosGoThereAndBack) {
  const struct {
    const char *type, *name;
    bool plane, by_default;
  } cases[]{{"tri6", "CPE6", true, false},    {"quad8", "CPE8", true, true},
            {"tet10", "C3D10", false, false}, {"wedge15", "C3D15", false, false},
            {"hex20", "C3D20", false, true},  {"hex8", "C3D8", false, true}};
  for (const auto& one : cases) {
    SCOPED_TRACE(one.type);
    const std::string name = std::string("TYPE=") + one.name;
    const auto notes = [](const WrittenDeck& deck) {
      return ::testing::PrintToString(deck.notes).find("no elements with mean dilatation") !=
             std::string::npos;
    };
    const WrittenDeck asked = written_box(one.type, one.plane, "bbar"),
                      given = written_box(one.type, one.plane, "auto");
    EXPECT_NE(asked.text.find(name + "H"), std::string::npos) << asked.text;
    EXPECT_TRUE(notes(asked));
    EXPECT_EQ(given.text.find(name + "H") != std::string::npos, one.by_default) << given.text;
    EXPECT_EQ(notes(given), one.by_default);
    const Description after =
        parse_model(translate_deck(asked.text, "model.inp").root, "model.inp");
    EXPECT_EQ(after.sections.at(0).formulation.value, Formulation::bbar);
  }
}

TEST(InpElements, OfSeveralFormulationsInOneSetAreSeveralSections) {
  const std::string yaml = yaml_of("CPS4R", "CPS4");
  EXPECT_NE(yaml.find(section("PLATE of CPS4R", "plane_stress", "reduced")), std::string::npos)
      << yaml;
  EXPECT_NE(yaml.find(section("PLATE of CPS4", "plane_stress", "full")), std::string::npos) << yaml;
  EXPECT_NE(yaml_of("CPE4R", "CPE4RT").find(section("PLATE", "plane_strain", "reduced")),
            std::string::npos);
}

TEST(InpTemperatures, GoIntoMaterialsAndSteps) {
  const std::string yaml = yaml_of("CPS4R", "CPS4R", R"(*INITIAL CONDITIONS, TYPE=TEMPERATURE
ALL, 20.
*AMPLITUDE, NAME=A
0., 0., 1., 2.
*STEP
*STATIC
*TEMPERATURE
ALL, 70.
3, 90.
*END STEP
*STEP
*STATIC
*TEMPERATURE, AMPLITUDE=A
6, 50.
*END STEP
)");
  EXPECT_NE(yaml.find(R"(    expansion:
      alpha:
        - [0, 1e-05]
        - [100, 2e-05]
      reference: 20
)"),
            std::string::npos)
      << yaml;
  EXPECT_NE(yaml.find("initial_temperature:\n  - {on: ALL, value: 20}\n"), std::string::npos)
      << yaml;
  EXPECT_NE(yaml.find("    temperature:\n      - {on: ALL, value: 70}\n      - {on: node 3, value: "
                      "90}\n"),
            std::string::npos)
      << yaml;
  EXPECT_NE(yaml.find("    temperature:\n      - {on: node 6, value: 50, amplitude: A_2}\n"),
            std::string::npos)
      << yaml;
}

TEST(InpTemperatures, WithoutAStepThatHasSomeAreLeftOut) {
  EXPECT_EQ(yaml_of("CPS4R", "CPS4R").find("expansion"), std::string::npos);
}

}  // namespace
}  // namespace osculate::deck
