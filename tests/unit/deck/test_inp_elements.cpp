// Types of elements of decks, and their temperatures.
#include <gtest/gtest.h>

#include "osculate/deck/inp_translate.hpp"
#include "osculate/deck/parse.hpp"

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
