// *HYPERELASTIC of decks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "osculate/core/error.hpp"
#include "osculate/deck/inp_translate.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/material/catalogue.hpp"

namespace osculate::deck {
namespace {

using ::testing::HasSubstr;

Description described(const std::string& material) {
  const std::string text =
      "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, 0, 0, 1\n6, 1, 0, 1\n7, 1, 1, 1\n"
      "8, 0, 1, 1\n*ELEMENT, TYPE=C3D8, ELSET=E\n1, 1, 2, 3, 4, 5, 6, 7, 8\n*MATERIAL, NAME=M\n" +
      material +
      "*SOLID SECTION, ELSET=E, MATERIAL=M\n*STEP\n*STATIC\n*BOUNDARY\n1, 1, 3\n*END STEP\n";
  return parse_model(translate_deck(text, "a.inp").root, "a.inp");
}
material::Rubber rubber(const std::string& material) {
  return std::get<material::Rubber>(described(material).materials.at(0).law.value);
}
std::string message(const std::string& material) {
  try {
    (void)described(material);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(InpHyperelastic, FormsOfTheLaw) {
  const material::Rubber neo = rubber("*HYPERELASTIC, NEO HOOKE\n1.5, 0.02\n*DENSITY\n3.\n");
  EXPECT_EQ(neo.c10, 1.5);
  EXPECT_EQ(neo.d1, 0.02);
  EXPECT_EQ(neo.density, 3);
  const material::Rubber mooney = rubber("*HYPERELASTIC, MOONEY-RIVLIN\n1.5, 0.5, 0.02\n");
  EXPECT_EQ(mooney.c01, 0.5);
  EXPECT_EQ(mooney.d1, 0.02);
  const material::Rubber yeoh = rubber("*HYPERELASTIC, YEOH\n1.5, -0.1, 0.2, 0.02, 0.03, 0.04\n");
  EXPECT_EQ(yeoh.c20, -0.1);
  EXPECT_EQ(yeoh.c30, 0.2);
  EXPECT_EQ(yeoh.d2, 0.03);
  EXPECT_EQ(yeoh.d3, 0.04);
  const material::Rubber two = rubber("*HYPERELASTIC, REDUCED POLYNOMIAL, N=2\n1.5, 0.1, 0.02\n");
  EXPECT_EQ(two.c20, 0.1);
  EXPECT_EQ(two.d1, 0.02);
  EXPECT_EQ(two.d2, 0);
  const material::Rubber whole =
      rubber("*HYPERELASTIC, POLYNOMIAL, N=3\n1., 2., 3., 4., 5., 6., 7., 8.\n9., 10., 11., 12.\n");
  EXPECT_EQ(whole.c11, 4);
  EXPECT_EQ(whole.c12, 8);
  EXPECT_EQ(whole.c03, 9);
  EXPECT_EQ(whole.d1, 10);
  EXPECT_EQ(whole.d3, 12);
}

TEST(InpHyperelastic, ItMovesFarWithoutNlgeom) {
  EXPECT_EQ(described("*HYPERELASTIC, NEO HOOKE\n1.5, 0.02\n").sections.at(0).kinematics.value,
            Kinematics::finite);
}

TEST(InpHyperelastic, OgdenAndFoam) {
  const auto law = [](const std::string& material) {
    return described(material).materials.at(0).law.value;
  };
  const auto ogden = std::get<material::Ogden>(
      law("*HYPERELASTIC, OGDEN, N=3\n0.4, 1.3, 0.003, 5., -0.01, -2., 0.02, 0.\n0.03\n"));
  EXPECT_EQ(ogden.mu2, 0.003);
  EXPECT_EQ(ogden.alpha3, -2);
  EXPECT_EQ(ogden.d1, 0.02);
  EXPECT_EQ(ogden.d2, 0);
  EXPECT_EQ(ogden.d3, 0.03);
  EXPECT_NEAR(unloaded(law("*HYPERELASTIC, OGDEN, N=1\n3.488, 2.163, 0.\n")).poisson, 29.0 / 61,
              1e-14);
  const auto foam = std::get<material::Hyperfoam>(
      law("*HYPERFOAM, N=2\n0.16, 8.9, 2.3e-5, -4.8, 0.1, 0.2\n*DENSITY\n3.\n"));
  EXPECT_EQ(foam.alpha2, -4.8);
  EXPECT_EQ(foam.nu1, 0.1);
  EXPECT_EQ(foam.nu2, 0.2);
  EXPECT_EQ(foam.density, 3);
}

TEST(InpHyperelastic, Chains) {
  const auto law = [](const std::string& material) {
    return described(material).materials.at(0).law.value;
  };
  const auto given = std::get<material::ArrudaBoyce>(
      law("*HYPERELASTIC, ARRUDA-BOYCE\n0.3, 5., 0.02\n*DENSITY\n3.\n"));
  EXPECT_EQ(given.mu, 0.3);
  EXPECT_EQ(given.lambda_m, 5);
  EXPECT_EQ(given.d, 0.02);
  EXPECT_EQ(given.density, 3);
  const auto without =
      std::get<material::ArrudaBoyce>(law("*HYPERELASTIC, ARRUDA-BOYCE\n0.3, 5.\n"));
  EXPECT_NEAR(without.d, 0.1 / 0.3, 1e-15);
}

/// Poisson's ratio is that of K = 20 mu, 29/61, where no constant gives the bulk modulus.
TEST(InpHyperelastic, WithoutABulkModulus) {
  const material::Isotropic is = unloaded(rubber("*HYPERELASTIC, MOONEY-RIVLIN\n1.5, 0.5\n"));
  EXPECT_NEAR(is.poisson, 29.0 / 61, 1e-14);
  EXPECT_NEAR(is.young, 4 * 2 * 90.0 / 61, 1e-13);
}

TEST(InpHyperelastic, WhatIsNotSupported) {
  EXPECT_THAT(message("*HYPERELASTIC, MARLOW\n1., 2., 0.1\n"),
              HasSubstr("a.inp:13: *HYPERELASTIC: MARLOW is not supported: NEO HOOKE"));
  EXPECT_THAT(message("*HYPERELASTIC, ARRUDA-BOYCE\n1.\n"),
              HasSubstr("expected mu, lambda_m and D, found 1"));
  EXPECT_THAT(message("*HYPERELASTIC, ARRUDA-BOYCE\n1., 3., 0.1, 20.\n2., 3., 0.1, 100.\n"),
              HasSubstr("*HYPERELASTIC: constants that depend on the temperature"));
  EXPECT_THAT(message("*HYPERELASTIC, ARRUDA-BOYCE\n1., 0., 0.1\n"),
              HasSubstr("lambda_m: must be > 0"));
  EXPECT_THAT(message("*HYPERELASTIC, OGDEN, N=4\n1.\n"), HasSubstr("expected N=1, 2 or 3"));
  EXPECT_THAT(message("*HYPERELASTIC, OGDEN, N=2\n1., 2., 0.1\n"),
              HasSubstr("expected 4 constants, found 3"));
  EXPECT_THAT(message("*HYPERFOAM, N=1\n1., 2., 0.1, 20.\n2., 2., 0.1, 100.\n"),
              HasSubstr("*HYPERFOAM: constants that depend on the temperature"));
  EXPECT_THAT(message("*HYPERFOAM, TEST DATA INPUT\n1., 2.\n"), HasSubstr("from test data"));
  EXPECT_THAT(message("*HYPERFOAM, N=1\n1., 2., 0.5\n"), HasSubstr("nu1: must be > -1 and < 0.5"));
  EXPECT_THAT(message("*HYPERELASTIC, OGDEN\n-1., 2., 0.1\n"),
              HasSubstr("mu1: mu1 + mu2 + mu3 > 0"));
  EXPECT_THAT(message("*HYPERELASTIC, POLYNOMIAL, N=4\n1.\n"), HasSubstr("expected N=1, 2 or 3"));
  EXPECT_THAT(message("*HYPERELASTIC, MOONEY-RIVLIN\n1.\n"),
              HasSubstr("expected 2 constants, found 1"));
  EXPECT_THAT(message("*HYPERELASTIC, NEO HOOKE\n1., 0.1, 20.\n2., 0.1, 100.\n"),
              HasSubstr("temperature"));
  EXPECT_THAT(message("*ELASTIC\n1., 0.3\n*HYPERELASTIC, NEO HOOKE\n1., 0.1\n"),
              HasSubstr("of a material with *HYPERELASTIC or *HYPERFOAM this is not supported"));
}

}  // namespace
}  // namespace osculate::deck
