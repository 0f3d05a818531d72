// *USER MATERIAL of decks, and `user` of model files, as far as no library is needed; with
// libraries: tests/system/test_user_material.py.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "deck_test.hpp"
#include "osculate/core/error.hpp"
#include "osculate/deck/inp_translate.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/material/catalogue.hpp"

namespace osculate::deck {
namespace {

using ::testing::HasSubstr;

std::string brick(const std::string& material, const std::string& parameters = "") {
  return "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, 0, 0, 1\n6, 1, 0, 1\n7, 1, 1, "
         "1\n"
         "8, 0, 1, 1\n*ELEMENT, TYPE=C3D8, ELSET=E\n1, 1, 2, 3, 4, 5, 6, 7, 8\n*MATERIAL, NAME=" +
         material + "*SOLID SECTION, ELSET=E, MATERIAL=" + material.substr(0, material.find('\n')) +
         "\n*STEP" + parameters + "\n*STATIC\n*BOUNDARY\n1, 1, 3\n*END STEP\n";
}
std::string message(const std::string& material) {
  try {
    (void)parse_model(translate_deck(brick(material), "a.inp").root, "a.inp");
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

class InpUser : public ::testing::Test {
 protected:
  void SetUp() override { setenv("OSCULATE_USER_MATERIAL", "/nowhere/umat.so", 1); }
  void TearDown() override { unsetenv("OSCULATE_USER_MATERIAL"); }
};

TEST_F(InpUser, IsTheKeyUser) {
  const TranslatedDeck deck = translate_deck(
      brick("Steel\n*USER MATERIAL, CONSTANTS=9\n1., 2., 3., 4., 5., 6., 7., 8.\n9.\n*DEPVAR\n7\n"
            "*DENSITY\n3.\n"),
      "a.inp");
  const auto value = [](const SourceNode& node, const std::string& key) -> const SourceNode& {
    for (const SourceEntry& entry : node.entries)
      if (entry.key == key) return entry.value;
    throw std::runtime_error("no key " + key);
  };
  const SourceNode& user = value(value(value(deck.root, "materials"), "Steel"), "user");
  EXPECT_EQ(value(user, "library").text, "/nowhere/umat.so");
  EXPECT_EQ(value(user, "name").text, "Steel");
  EXPECT_EQ(value(user, "state").text, "7");
  EXPECT_EQ(value(user, "density").text, "3");
  ASSERT_EQ(value(user, "constants").items.size(), 9u);
  EXPECT_EQ(value(user, "constants").items[8].text, "9");
}

TEST_F(InpUser, LinearElasticityOfCalculixIsHookesLaw) {
  for (const bool finite : {false, true}) {
    const std::string deck =
        brick("LIN_ISO_EL\n*USER MATERIAL, CONSTANTS=2\n200., 0.3\n", finite ? ", NLGEOM" : "");
    const Description d = parse_model(translate_deck(deck, "a.inp").root, "a.inp");
    const material::Law& law = d.materials.at(0).law.value;
    EXPECT_EQ(std::holds_alternative<material::StVenantKirchhoff>(law), finite);
    EXPECT_EQ(unloaded(law).young, 200);
    EXPECT_EQ(unloaded(law).poisson, 0.3);
  }
}

TEST_F(InpUser, WhatIsNotSupported) {
  EXPECT_THAT(message("M\n*USER MATERIAL, CONSTANTS=2\n200., 0.3\n"),
              HasSubstr("library: there is no file '/nowhere/umat.so'"));
  EXPECT_THAT(message("M\n*USER MATERIAL, CONSTANTS=3\n200., 0.3\n"),
              HasSubstr("*USERMATERIAL: expected 3 constants, found 2"));
  EXPECT_THAT(message("M\n*USER MATERIAL, CONSTANTS=1\n200., 0.3\n210., 100.\n"),
              HasSubstr("expected 1 constants, found 4: constants that depend on the temperature"));
  EXPECT_THAT(message("M\n*USER MATERIAL, CONSTANTS=1\n200.\n*DEPVAR\n"),
              HasSubstr("*DEPVAR: expected the number of state variables"));
  EXPECT_THAT(message("M\n*ELASTIC\n200., 0.3\n*DEPVAR\n3\n"),
              HasSubstr("*DEPVAR: belongs to a *USER MATERIAL"));
  EXPECT_THAT(message("M\n*ELASTIC\n200., 0.3\n*USER MATERIAL, CONSTANTS=1\n1.\n"),
              HasSubstr("of a material with *USER MATERIAL this is not supported"));
  for (const char* const name : {"ANISO_CREEP", "SINGLE_CRYSTAL_2", "TENSION_ONLY"})
    EXPECT_THAT(message(std::string(name) + "\n*USER MATERIAL, CONSTANTS=1\n1.\n"),
                HasSubstr("is a material that CalculiX has compiled in"));
  EXPECT_THAT(message("LIN_ISO_EL\n*USER MATERIAL, CONSTANTS=1\n1.\n"),
              HasSubstr("LIN_ISO_EL has two constants"));
  unsetenv("OSCULATE_USER_MATERIAL");
  EXPECT_THAT(message("M\n*USER MATERIAL, CONSTANTS=1\n200.\n"),
              HasSubstr("name that in the environment variable OSCULATE_USER_MATERIAL"));
}

TEST(UserMaterial, IsRefusedInAModelFile) {
  const std::string model = test_file("user.yaml");
  EXPECT_THAT(refusal(model), HasSubstr("model.yaml:5: materials.steel.user.library: there is no "
                                        "file './metal.so'"));
  EXPECT_THAT(refusal(edited(model, "state: 7", "state: 7.5")),
              HasSubstr("materials.steel.user.state: must be a whole number"));
  EXPECT_THAT(refusal(edited(model, "state: 7", "state: 1000")), HasSubstr("<= 999"));
  EXPECT_THAT(refusal(edited(model, "library: metal.so, ", "")),
              HasSubstr("required key 'library' is missing"));
  EXPECT_THAT(refusal(edited(model, "[200, 0.3, 1, 20]", "[200, x]")),
              HasSubstr("constants[1]: expected a number"));
}

}  // namespace
}  // namespace osculate::deck
