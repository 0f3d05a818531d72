// *PLASTIC and *CYCLIC HARDENING of decks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "osculate/core/error.hpp"
#include "osculate/deck/inp_translate.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/material/catalogue.hpp"

namespace osculate::deck {
namespace {

using ::testing::HasSubstr;

TranslatedDeck translated_metal(const std::string& plastic) {
  const std::string text =
      "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, 0, 0, 1\n6, 1, 0, 1\n7, 1, 1, 1\n"
      "8, 0, 1, 1\n*ELEMENT, TYPE=C3D8, ELSET=E\n1, 1, 2, 3, 4, 5, 6, 7, 8\n*MATERIAL, NAME=M\n"
      "*ELASTIC\n200000., 0.3\n" +
      plastic +
      "*SOLID SECTION, ELSET=E, MATERIAL=M\n*STEP\n*STATIC\n*BOUNDARY\n1, 1, 3\n*END STEP\n";
  return translate_deck(text, "a.inp");
}
Description metal_deck(const std::string& plastic) {
  return parse_model(translated_metal(plastic).root, "a.inp");
}
material::J2Plasticity metal(const std::string& plastic) {
  return std::get<material::J2Plasticity>(metal_deck(plastic).materials.at(0).law.value);
}
std::string refused_metal(const std::string& plastic) {
  try {
    (void)metal_deck(plastic);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

/// Two points at one temperature.
const core::Table two_points{{0, 0}, {800, 0.1}};

TEST(InpPlastic, CombinedHardeningIsATableBesideACurve) {
  const material::J2Plasticity both = metal(
      "*PLASTIC, HARDENING=COMBINED\n800., 0.\n1600., 0.1\n"
      "*CYCLIC HARDENING\n500., 0.\n600., 0.02\n650., 0.1\n");
  EXPECT_EQ(both.kinematic_over.at(0).points, two_points);
  EXPECT_EQ(both.hardening, (core::Table{{500, 0}, {600, 0.02}, {650, 0.1}}));
  EXPECT_EQ(both.yield, 0);
  const material::J2Plasticity steady =
      metal("*PLASTIC, HARDENING=COMBINED\n800., 0.\n1600., 0.1\n*CYCLIC HARDENING\n500., 0.\n");
  EXPECT_EQ(steady.yield, 500);
  EXPECT_EQ(steady.kinematic_over.at(0).points, two_points);
  for (const char* const kind : {"COMBINED", "KINEMATIC"}) {
    const material::J2Plasticity moved =
        metal(std::string("*PLASTIC, HARDENING=") + kind + "\n800., 0.\n1600., 0.1\n");
    EXPECT_EQ(moved.yield, 800);
    EXPECT_EQ(moved.kinematic, 0);
    EXPECT_EQ(moved.kinematic_over.at(0).points, two_points);
    EXPECT_TRUE(moved.hardening.empty());
  }
}

// Two points end at the second one, at one temperature as at several, as in CalculiX; Abaqus' slope
// goes on, which is said by a second point where nothing comes.
TEST(InpPlastic, TwoPointsOfKinematicHardeningAreACurveAtAnyTemperature) {
  const auto points = [](const std::string& plastic, std::size_t curve) {
    return metal("*PLASTIC, HARDENING=KINEMATIC\n" + plastic +
                 "*INITIAL CONDITIONS, TYPE=TEMPERATURE\n1, 20.\n")
        .kinematic_over.at(curve)
        .points;
  };
  EXPECT_EQ(points("800., 0.\n1600., 0.1\n", 0), two_points);
  const std::string warm = "800., 0., 0.\n1600., 0.1, 0.\n700., 0., 90.\n1400., 0.1, 90.\n";
  EXPECT_EQ(points(warm, 0), two_points);
  EXPECT_EQ(points(warm, 1), (core::Table{{0, 0}, {700, 0.1}}));
  const material::J2Plasticity far =
      metal("*PLASTIC, HARDENING=KINEMATIC\n800., 0.\n1.6E6, 200.\n");
  EXPECT_EQ(far.kinematic, 7996);
  EXPECT_TRUE(far.kinematic_over.empty());
  const auto notes = [](const std::string& plastic) {
    std::size_t found = 0;
    const TranslatedDeck deck = translated_metal("*PLASTIC, HARDENING=KINEMATIC\n" + plastic);
    for (const std::string& note : deck.notes)
      found += note.find("two points are a slope") != std::string::npos;
    return found;
  };
  EXPECT_EQ(notes("800., 0.\n1600., 0.1\n"), 1U);
  EXPECT_EQ(notes("800., 0.\n1600., 0.1\n1700., 0.2\n"), 0U);
  EXPECT_EQ(notes("800., 0.\n1.6E6, 200.\n"), 0U);
}

TEST(InpPlastic, AScaleIsOneOfTheStresses) {
  EXPECT_EQ(metal("*PLASTIC, SCALE=1.5\n800., 0.\n1000., 0.1\n").hardening,
            (core::Table{{1200, 0}, {1500, 0.1}}));
}

// As CalculiX: with a yield stress of 0 the answers are those of creep alone.
TEST(InpPlastic, AYieldStressOfZeroBesideCreepIsCreep) {
  const Description d = metal_deck("*PLASTIC\n0., 0.\n0., 10.\n*CREEP\n1.E-10, 5., 0.\n");
  const auto norton = std::get<material::Norton>(d.materials.at(0).law.value);
  EXPECT_EQ(norton.rate, 1e-10);
  EXPECT_EQ(norton.exponent, 5);
  EXPECT_THAT(
      refused_metal("*PLASTIC\n8., 0.\n*CREEP\n1.E-10, 5., 0.\n"),
      HasSubstr("a material that both flows and creeps is not supported, but with a yield"));
}

TEST(InpPlastic, OnePointDoesNotHarden) { EXPECT_EQ(metal("*PLASTIC\n800., 0.\n").yield, 800); }

TEST(InpPlastic, DeformationPlasticityIsALawOfItsOwn) {
  const std::string text =
      "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, 0, 0, 1\n6, 1, 0, 1\n7, 1, 1, 1\n"
      "8, 0, 1, 1\n*ELEMENT, TYPE=C3D8, ELSET=E\n1, 1, 2, 3, 4, 5, 6, 7, 8\n*MATERIAL, NAME=M\n"
      "*DEFORMATION PLASTICITY\n190000., 0.34, 900., 12., 0.45\n*DENSITY\n3.\n"
      "*SOLID SECTION, ELSET=E, MATERIAL=M\n*STEP\n*STATIC\n*BOUNDARY\n1, 1, 3\n*END STEP\n";
  const Description d = parse_model(translate_deck(text, "a.inp").root, "a.inp");
  const auto law = std::get<material::DeformationPlasticity>(d.materials.at(0).law.value);
  EXPECT_EQ(law.young, 190000);
  EXPECT_EQ(law.poisson, 0.34);
  EXPECT_EQ(law.yield, 900);
  EXPECT_EQ(law.exponent, 12);
  EXPECT_EQ(law.offset, 0.45);
  EXPECT_EQ(law.density, 3);
  EXPECT_EQ(d.sections.at(0).kinematics.value, Kinematics::finite);  // as CalculiX, without NLGEOM
}

TEST(InpPlastic, WhatIsNotSupported) {
  EXPECT_THAT(refused_metal("*DEFORMATION PLASTICITY\n190000., 0.34, 900., 12., 0.45\n"),
              HasSubstr("of a material with *DEFORMATION PLASTICITY this is not supported"));
  EXPECT_THAT(refused_metal("*PLASTIC, HARDENING=USER\n800., 0.\n"),
              HasSubstr("HARDENING=USER is not supported: ISOTROPIC, KINEMATIC or COMBINED"));
  EXPECT_THAT(refused_metal("*PLASTIC, HARDENING=COMBINED, DATA TYPE=PARAMETERS\n200., 1., 2.\n"),
              HasSubstr("DATA TYPE=PARAMETERS is not supported"));
  EXPECT_THAT(refused_metal("*PLASTIC\n800., 0.\n*CYCLIC HARDENING\n500., 0.\n"),
              HasSubstr("*CYCLICHARDENING: belongs to *PLASTIC, HARDENING=COMBINED"));
  EXPECT_THAT(refused_metal("*CYCLIC HARDENING\n500., 0.\n"),
              HasSubstr("*CYCLICHARDENING: belongs to *PLASTIC, HARDENING=COMBINED"));
  EXPECT_THAT(refused_metal("*PLASTIC\n8., 0., 100.\n9., 0., 20.\n"),
              HasSubstr("expected a temperature that is not below that of the line before"));
  EXPECT_THAT(refused_metal("*PLASTIC\n8., 0., 20.\n9., 0., 20.\n"),
              HasSubstr("expected a larger plastic strain than in the line before"));
  EXPECT_THAT(refused_metal("*PLASTIC, HARDENING=COMBINED\n800., 0.\n*CYCLIC HARDENING\n5., 0., "
                            "20.\n4., 0., 100.\n"),
              HasSubstr("depends on the temperature, which is given nowhere"));
}

TEST(InpPlastic, CurvesOverTheTemperature) {
  const std::string heat = "*INITIAL CONDITIONS, TYPE=TEMPERATURE\n1, 20.\n";
  const material::J2Plasticity steel =
      metal("*PLASTIC\n8., 0., 20.\n9., 0.1, 20.\n5., 0., 300.\n" + heat);
  EXPECT_EQ(steel.yield, 0);
  EXPECT_TRUE(steel.hardening.empty());
  ASSERT_EQ(steel.hardening_over.size(), 2U);
  EXPECT_EQ(steel.hardening_over[0].temperature, 20);
  EXPECT_EQ(steel.hardening_over[0].points, (core::Table{{8, 0}, {9, 0.1}}));
  EXPECT_EQ(steel.hardening_over[1].temperature, 300);
  EXPECT_EQ(steel.hardening_over[1].points, (core::Table{{5, 0}}));
  EXPECT_EQ(metal_deck("*PLASTIC\n8., 0., 20.\n7., 0., 90.\n" + heat).initial_temperature.size(),
            1U);
  // the same at all temperatures, or one of them alone
  EXPECT_EQ(metal("*PLASTIC\n8., 0., 20.\n8., 0., 300.\n").yield, 8);
  EXPECT_EQ(metal("*PLASTIC\n8., 0., 20.\n9., 1., 20.\n").hardening, (core::Table{{8, 0}, {9, 1}}));
}

TEST(InpPlastic, CurvesOfKinematicHardening) {
  const material::J2Plasticity bent =
      metal("*PLASTIC, HARDENING=KINEMATIC\n8., 0.\n9., 0.1\n9.5, 0.2\n");
  EXPECT_EQ(bent.yield, 8);
  EXPECT_EQ(bent.kinematic, 0);
  ASSERT_EQ(bent.kinematic_over.size(), 1U);
  EXPECT_EQ(bent.kinematic_over[0].points, (core::Table{{0, 0}, {1, 0.1}, {1.5, 0.2}}));
  const material::J2Plasticity warm = metal(
      "*PLASTIC, HARDENING=KINEMATIC\n8., 0., 0.\n9., 0.1, 0.\n4., 0., 90.\n4.5, 0.1, 90.\n"
      "*INITIAL CONDITIONS, TYPE=TEMPERATURE\n1, 20.\n");
  ASSERT_EQ(warm.hardening_over.size(), 2U);
  EXPECT_EQ(warm.hardening_over[1].points, (core::Table{{4, 0}}));
  ASSERT_EQ(warm.kinematic_over.size(), 2U);
  EXPECT_EQ(warm.kinematic_over[1].points, (core::Table{{0, 0}, {0.5, 0.1}}));
  const material::J2Plasticity both = metal(
      "*PLASTIC, HARDENING=COMBINED\n8., 0., 0.\n9., 0.1, 0.\n4., 0., 90.\n4.5, 0.1, 90.\n"
      "*CYCLIC HARDENING\n8., 0., 0.\n8.5, 0.1, 0.\n4., 0., 60.\n"
      "*INITIAL CONDITIONS, TYPE=TEMPERATURE\n1, 20.\n");
  EXPECT_EQ(both.hardening_over[1].temperature, 60);
  EXPECT_EQ(both.kinematic_over[1].temperature, 90);
}

TEST(InpPlastic, ElasticConstantsOverTheTemperature) {
  const std::string text =
      "*NODE, NSET=N\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, 0, 0, 1\n6, 1, 0, 1\n7, "
      "1, 1, 1\n"
      "8, 0, 1, 1\n*ELEMENT, TYPE=C3D8, ELSET=E\n1, 1, 2, 3, 4, 5, 6, 7, 8\n*MATERIAL, NAME=M\n"
      "*ELASTIC\n200., 0.3, 0.\n100., 0.3, 90.\n*PLASTIC\n8., 0.\n*SOLID SECTION, ELSET=E, "
      "MATERIAL=M\n*INITIAL CONDITIONS, TYPE=TEMPERATURE\nN, 20.\n*STEP\n*STATIC\n*BOUNDARY\n1, 1, "
      "3\n*END STEP\n";
  const Description d = parse_model(translate_deck(text, "a.inp").root, "a.inp");
  EXPECT_EQ(std::get<material::J2Plasticity>(d.materials.at(0).law.value).young_over,
            (core::Table{{0, 200}, {90, 100}}));
}

}  // namespace
}  // namespace osculate::deck
