// *VISCOELASTIC of decks.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "osculate/core/error.hpp"
#include "osculate/deck/inp_translate.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/material/catalogue.hpp"

namespace osculate::deck {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string series = "*VISCOELASTIC, TIME=PRONY\n0.25, 0., 2.\n0.25, 0.2, 30.\n0., 0.3, 7.\n";
const std::string visco = "*STEP\n*VISCO, CETOL=1.\n1., 100.\n*BOUNDARY\n1, 1, 3\n*END STEP\n";

TranslatedDeck polymer_deck(const std::string& material, const std::string& steps = visco) {
  return translate_deck(
      "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, 0, 0, 1\n6, 1, 0, 1\n7, 1, 1, 1\n"
      "8, 0, 1, 1\n*ELEMENT, TYPE=C3D8, ELSET=E\n1, 1, 2, 3, 4, 5, 6, 7, 8\n*MATERIAL, NAME=M\n" +
          material + "*SOLID SECTION, ELSET=E, MATERIAL=M\n" + steps,
      "a.inp");
}
material::Viscoelastic polymer(const std::string& material) {
  return std::get<material::Viscoelastic>(
      parse_model(polymer_deck(material).root, "a.inp").materials.at(0).law.value);
}
std::string refused_polymer(const std::string& material, const std::string& steps = visco) {
  try {
    (void)parse_model(polymer_deck(material, steps).root, "a.inp");
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(InpViscoelastic, TermsAreThoseOfTwoSeries) {
  const material::Viscoelastic law =
      polymer("*ELASTIC, MODULI=INSTANTANEOUS\n100., 0.25\n*DENSITY\n3.\n" + series);
  EXPECT_EQ(law.young, 100);
  EXPECT_EQ(law.poisson, 0.25);
  EXPECT_EQ(law.density, 3);
  EXPECT_EQ(law.shear, (core::Table{{0.25, 2}, {0.25, 30}}));
  EXPECT_EQ(law.bulk, (core::Table{{0.2, 30}, {0.3, 7}}));
}

template <class T>
material::Relaxing<T> rubber_polymer(const std::string& material) {
  return std::get<material::Relaxing<T>>(
      parse_model(polymer_deck(material).root, "a.inp").materials.at(0).law.value);
}

// Constants are those of the end but with MODULI=INSTANTANEOUS; half of the shear and of the bulk
// modulus remain.
TEST(InpViscoelastic, RubberRelaxes) {
  const auto at_once = rubber_polymer<material::Rubber>(
      "*HYPERELASTIC, MOONEY-RIVLIN, MODULI=INSTANTANEOUS\n1., 0.5, 0.1\n*DENSITY\n3.\n" + series);
  EXPECT_EQ(at_once.law.c10, 1);
  EXPECT_EQ(at_once.law.c01, 0.5);
  EXPECT_EQ(at_once.law.d1, 0.1);
  EXPECT_EQ(at_once.law.density, 3);
  EXPECT_EQ(at_once.series.shear, (core::Table{{0.25, 2}, {0.25, 30}}));
  EXPECT_EQ(at_once.series.bulk, (core::Table{{0.2, 30}, {0.3, 7}}));
  for (const char* const moduli : {"", ", MODULI=LONG TERM"}) {
    const auto rubber = rubber_polymer<material::Rubber>(
        fmt::format("*HYPERELASTIC, MOONEY-RIVLIN{}\n1., 0.5, 0.1\n", moduli) + series);
    EXPECT_EQ(rubber.law.c10, 2);
    EXPECT_EQ(rubber.law.c01, 1);
    EXPECT_EQ(rubber.law.d1, 0.05);
  }
  const auto usual =
      rubber_polymer<material::Rubber>("*HYPERELASTIC, NEO HOOKE\n1., 0.\n" + series);
  EXPECT_EQ(usual.law.d1, 0.1 / 2 / 2);
  const auto ogden =
      rubber_polymer<material::Ogden>("*HYPERELASTIC, OGDEN, N=1\n1., 2., 0.1\n" + series);
  EXPECT_EQ(ogden.law.mu1, 2);
  EXPECT_EQ(ogden.law.alpha1, 2);
  EXPECT_EQ(ogden.law.d1, 0.05);
  const auto chains =
      rubber_polymer<material::ArrudaBoyce>("*HYPERELASTIC, ARRUDA-BOYCE\n1., 3., 0.1\n" + series);
  EXPECT_EQ(chains.law.mu, 2);
  EXPECT_EQ(chains.law.lambda_m, 3);
  EXPECT_EQ(chains.law.d, 0.05);
  const auto foam = rubber_polymer<material::Hyperfoam>(
      "*HYPERFOAM\n1., 2., 0.1\n*VISCOELASTIC, TIME=PRONY\n0.5, 0.5, 3.\n");
  EXPECT_EQ(foam.law.mu1, 2);
  EXPECT_EQ(foam.law.nu1, 0.1);
  EXPECT_EQ(foam.series.shear, foam.series.bulk);
  EXPECT_THAT(polymer_deck("*HYPERELASTIC, NEO HOOKE\n1., 0.1\n" + series).notes,
              Contains(HasSubstr("*VISCOELASTIC of rubber is Simo's form")));
}

// As in Abaqus, MODULI=LONG TERM is what is meant if nothing is said.
TEST(InpViscoelastic, ModuliAreThoseOfTheEnd) {
  for (const char* const elastic : {"*ELASTIC\n", "*ELASTIC, MODULI=LONG TERM\n"}) {
    const material::Viscoelastic law = polymer(std::string(elastic) + "100., 0.25\n" + series);
    EXPECT_NEAR(law.young / (2 * (1 + law.poisson)) * 0.5, 40, 1e-12);  // G of 100 and 0.25
    EXPECT_NEAR(law.young / (3 * (1 - 2 * law.poisson)) * 0.5, 100 / 1.5, 1e-12);
  }
}

TEST(InpViscoelastic, StaticStepsAreTheResponseAtOnce) {
  const std::string both = "*STEP\n*STATIC\n1., 5.\n*BOUNDARY\n1, 1, 3\n*END STEP\n" + visco;
  const TranslatedDeck deck = polymer_deck("*ELASTIC\n100., 0.25\n" + series, both);
  const Description d = parse_model(deck.root, "a.inp");
  EXPECT_TRUE(d.steps.at(0).at_once);
  EXPECT_EQ(d.steps.at(0).duration->value, 5);
  EXPECT_FALSE(d.steps.at(1).at_once);
  EXPECT_EQ(d.steps.at(1).duration->value, 100);
  const TranslatedDeck creeping =
      polymer_deck("*ELASTIC\n100., 0.25\n*CREEP\n1e-7, 5., 0.\n", both);
  const Description c = parse_model(creeping.root, "a.inp");
  EXPECT_TRUE(c.steps.at(0).at_once);
  EXPECT_EQ(c.steps.at(0).duration->value, 5);
  EXPECT_FALSE(c.steps.at(1).at_once);
  EXPECT_THAT(refused_polymer("*ELASTIC\n100., 0.25\n" + series,
                              "*STEP\n*STATIC, LONG TERM\n1., 5.\n*END STEP\n"),
              HasSubstr("LONGTERM"));
}

TEST(InpViscoelastic, WhatIsNotSupported) {
  const std::string elastic = "*ELASTIC\n100., 0.25\n";
  EXPECT_THAT(refused_polymer(elastic + "*VISCOELASTIC, TIME=RELAXATION TEST DATA\n1., 2.\n"),
              HasSubstr("expected TIME=PRONY"));
  EXPECT_THAT(refused_polymer(elastic + "*VISCOELASTIC, FREQUENCY=PRONY\n1., 2.\n"),
              HasSubstr("FREQUENCY"));
  EXPECT_THAT(refused_polymer(elastic + "*VISCOELASTIC\n0.1, 0., 2.\n"),
              HasSubstr("TIME=PRONY is expected"));
  EXPECT_THAT(refused_polymer(elastic + "*VISCOELASTIC, TIME=PRONY\n0.5, 0., 2.\n0.5, 0., 3.\n"),
              HasSubstr("the sum of the shares is less than 1"));
  EXPECT_THAT(refused_polymer(elastic + "*VISCOELASTIC, TIME=PRONY\n-0.5, 0., 2.\n"),
              HasSubstr("expected shares that are not negative"));
  EXPECT_THAT(refused_polymer(elastic + "*VISCOELASTIC, TIME=PRONY\n0.5, 0., 0.\n"),
              HasSubstr("expected a relaxation time greater than 0"));
  EXPECT_THAT(refused_polymer(elastic + series + "*PLASTIC\n1., 0.\n"),
              HasSubstr("*PLASTIC: of a material with *VISCOELASTIC this is not supported"));
  EXPECT_THAT(refused_polymer("*HYPERFOAM\n1., 2., 0.1\n" + series),
              HasSubstr("of *HYPERFOAM shape and volume relax alike: each line has g = k"));
  EXPECT_THAT(refused_polymer("*HYPERELASTIC, NEO HOOKE, MODULI=SHORT\n1., 0.1\n" + series),
              HasSubstr("MODULI=SHORT is not supported: INSTANTANEOUS or LONG TERM"));
  EXPECT_THAT(refused_polymer("*ELASTIC\n100., 0.25, 0.\n90., 0.25, 10.\n" + series),
              HasSubstr("numbers that depend on the temperature are not supported"));
  EXPECT_THAT(refused_polymer("*ELASTIC, MODULI=SHORT\n100., 0.25\n" + series),
              HasSubstr("MODULI=SHORT is not supported: INSTANTANEOUS or LONG TERM"));
}

}  // namespace
}  // namespace osculate::deck
