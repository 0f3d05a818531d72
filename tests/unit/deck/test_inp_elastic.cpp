// *ELASTIC and *ORIENTATION of decks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "osculate/core/error.hpp"
#include "osculate/deck/inp_translate.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/material/catalogue.hpp"

namespace osculate::deck {
namespace {

using ::testing::HasSubstr;

struct Deck {
  std::string material, section{}, before{}, step{"*STEP\n*STATIC\n"};
};
Description described(const Deck& deck) {
  const std::string text =
      "*NODE, NSET=N\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, 0, 0, 1\n6, 1, 0, 1\n"
      "7, 1, 1, 1\n8, 0, 1, 1\n*ELEMENT, TYPE=C3D8, ELSET=E\n1, 1, 2, 3, 4, 5, 6, 7, 8\n" +
      deck.before + "*MATERIAL, NAME=M\n" + deck.material + "*SOLID SECTION, ELSET=E, MATERIAL=M" +
      deck.section + "\n" + deck.step + "*BOUNDARY\n1, 1, 3\n*END STEP\n";
  return parse_model(translate_deck(text, "a.inp").root, "a.inp");
}
template <class T>
T law(const Deck& deck) {
  return std::get<T>(described(deck).materials.at(0).law.value);
}
std::string message(const Deck& deck) {
  try {
    (void)described(deck);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

const std::string wood =
    "*ELASTIC, TYPE=ENGINEERING CONSTANTS\n12., 2., 1., .3, .4, .2, .8, .7\n.6, 20.\n";

TEST(InpElastic, ConstantsGoOnInTheNextLine) {
  const auto ortho = law<material::Anisotropic>(
      {"*ELASTIC, TYPE=ORTHO\n500., 157., 400., 158., 159., 300., 126., 127.,\n128., 294.\n"});
  EXPECT_EQ(ortho.d1111, 500);
  EXPECT_EQ(ortho.d1122, 157);
  EXPECT_EQ(ortho.d2222, 400);
  EXPECT_EQ(ortho.d1133, 158);
  EXPECT_EQ(ortho.d2233, 159);
  EXPECT_EQ(ortho.d3333, 300);
  EXPECT_EQ(ortho.d1212, 126);
  EXPECT_EQ(ortho.d1313, 127);
  EXPECT_EQ(ortho.d2323, 128);
  EXPECT_EQ(ortho.d1112, 0);
  const auto all = law<material::Anisotropic>(
      {"*ELASTIC, TYPE=ANISOTROPIC\n300., 11., 320., 13., 14., 350., 16., 17.,\n18., 39., 20., "
       "21., 22., 23., 44., 25.,\n26., 27., 28., 29., 50.\n*DENSITY\n3.\n"});
  EXPECT_EQ(all.d1112, 16);
  EXPECT_EQ(all.d2212, 17);
  EXPECT_EQ(all.d3312, 18);
  EXPECT_EQ(all.d1212, 39);
  EXPECT_EQ(all.d1113, 20);
  EXPECT_EQ(all.d1213, 23);
  EXPECT_EQ(all.d1313, 44);
  EXPECT_EQ(all.d1123, 25);
  EXPECT_EQ(all.d1323, 29);
  EXPECT_EQ(all.d2323, 50);
  EXPECT_EQ(all.density, 3);
  const auto named = law<material::Orthotropic>({wood});
  EXPECT_EQ(named.e1, 12);
  EXPECT_EQ(named.nu12, 0.3);
  EXPECT_EQ(named.nu13, 0.4);
  EXPECT_EQ(named.nu23, 0.2);
  EXPECT_EQ(named.g12, 0.8);
  EXPECT_EQ(named.g13, 0.7);
  EXPECT_EQ(named.g23, 0.6);
}

TEST(InpElastic, WithNlgeomTheStrainIsFinite) {
  const Description d = described({.material = wood, .step = "*STEP, NLGEOM\n*STATIC\n"});
  EXPECT_EQ(d.sections.at(0).kinematics.value, Kinematics::finite);
  EXPECT_TRUE(std::holds_alternative<material::Orthotropic>(d.materials.at(0).law.value));
}

TEST(InpElastic, OrientationsAreThoseOfTheirSections) {
  using Kind = material::Orientation::Kind;
  const auto axes = [](const std::string& card, const std::string& material) {
    return described({material, ", ORIENTATION=O", card}).sections.at(0).orientation.value;
  };
  const material::Orientation flat = axes("*ORIENTATION, NAME=O\n0., 0., 1., 1., 0., 0.\n", wood);
  EXPECT_EQ(flat.kind, Kind::rectangular);
  EXPECT_EQ(flat.a, Vec3(0, 0, 1));
  EXPECT_EQ(flat.b, Vec3(1, 0, 0));
  EXPECT_EQ(flat.angle, 0);
  const material::Orientation round =
      axes("*ORIENTATION, NAME=o, SYSTEM=CYLINDRICAL\n0., 0., 1., 1., 0., 0.\n1, 90.\n", wood);
  EXPECT_EQ(round.kind, Kind::cylindrical);
  EXPECT_EQ(round.about, 0);
  EXPECT_DOUBLE_EQ(round.angle, std::numbers::pi / 2);
  // which materials that are the same in all directions do not need
  EXPECT_EQ(axes("*ORIENTATION, NAME=O\n0., 0., 1., 1., 0., 0.\n", "*ELASTIC\n1., .3\n").kind,
            Kind::global);
}

TEST(InpElastic, TellsOfResultsInLocalAxes) {
  const auto notes = [](const std::string& print) {
    return translate_deck(
               "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, 0, 0, 1\n6, 1, 0, 1\n"
               "7, 1, 1, 1\n8, 0, 1, 1\n*ELEMENT, TYPE=C3D8, ELSET=E\n1, 1, 2, 3, 4, 5, 6, 7, 8\n"
               "*ORIENTATION, NAME=O\n0., 0., 1., 1., 0., 0.\n*MATERIAL, NAME=M\n" +
                   wood +
                   "*SOLID SECTION, ELSET=E, MATERIAL=M, ORIENTATION=O\n*STEP\n*STATIC\n*BOUNDARY\n"
                   "1, 1, 3\n*EL PRINT, ELSET=E" +
                   print + "\nS\n*END STEP\n",
               "a.inp")
        .notes;
  };
  EXPECT_THAT(notes(""),
              ::testing::Contains("stresses and strains are in global axes, as with GLOBAL=YES"));
  EXPECT_TRUE(notes(", GLOBAL=YES").empty());
}

TEST(InpElastic, SaysWhatIsNotSupported) {
  EXPECT_THAT(message({"*ELASTIC, TYPE=LAMINA\n1., 2.\n"}),
              HasSubstr("TYPE=LAMINA is not supported: ISO, ORTHO, ENGINEERING CONSTANTS, ANISO"));
  EXPECT_THAT(message({"*ELASTIC, TYPE=ORTHO\n1., 2.\n"}),
              HasSubstr("expected 9 constants in 2 lines of 8, found 1 lines"));
  EXPECT_THAT(message({wood + "12., 2., 1., .3, .4, .2, .8, .7\n"}),
              HasSubstr("expected 9 constants in 2 lines of 8, found 3 lines"));
  EXPECT_THAT(message({wood + "11., 2., 1., .3, .4, .2, .8, .7\n.6, 40.\n"}),
              HasSubstr("depends on the temperature, which is given nowhere"));
  EXPECT_THAT(message({wood + "*PLASTIC\n1., 0.\n"}), HasSubstr("that is not isotropic"));
  EXPECT_THAT(message({wood, ", ORIENTATION=P", "*ORIENTATION, NAME=O\n0., 0., 1., 1., 0., 0.\n"}),
              HasSubstr("unknown ORIENTATION 'P'"));
  EXPECT_THAT(message({wood, ", ORIENTATION=O",
                       "*ORIENTATION, NAME=O, SYSTEM=SPHERICAL\n0., 0., 1., 1., 0., 0.\n"}),
              HasSubstr("SYSTEM=SPHERICAL is not supported: RECTANGULAR or CYLINDRICAL"));
  EXPECT_THAT(message({"*ELASTIC, TYPE=ORTHO\n1., 2., 1., 2., 2., 1., 1., 1.\n1.\n"}),
              HasSubstr("D2222 is too small beside the other constants"));
}

TEST(InpElastic, AllConstantsOverTheTemperature) {
  const std::string initial = "*INITIAL CONDITIONS, TYPE=TEMPERATURE\nN, 20.\n";
  // the same in all lines: no table
  EXPECT_TRUE(law<material::Orthotropic>({wood + "12., 2., 1., .3, .4, .2, .8, .7\n.6, 40.\n"})
                  .e1_over.empty());
  const auto named = law<material::Orthotropic>(
      {wood + "11., 2., 1., .3, .4, .2, .8, .7\n.5, 40.\n", "", initial});
  EXPECT_EQ(named.e1_over, (core::Table{{20, 12}, {40, 11}}));
  EXPECT_EQ(named.g23_over, (core::Table{{20, 0.6}, {40, 0.5}}));
  EXPECT_TRUE(named.e2_over.empty());
  EXPECT_EQ(named.e2, 2);
  const auto all = law<material::Anisotropic>(
      {"*ELASTIC, TYPE=ANISO\n300., 11., 320., 13., 14., 350., 16., 0.,\n18., 39., 20., "
       "21., 22., 23., 44., 25.,\n26., 27., 28., 29., 50., 0.\n"
       "300., 11., 320., 13., 14., 350., 16., 7.,\n18., 39., 20., "
       "21., 22., 23., 44., 25.,\n26., 27., 28., 29., 60., 90.\n",
       "", initial});
  EXPECT_EQ(all.d2212_over, (core::Table{{0, 0}, {90, 7}}));
  EXPECT_EQ(all.d2323_over, (core::Table{{0, 50}, {90, 60}}));
  EXPECT_TRUE(all.d1111_over.empty());
  EXPECT_EQ(described({wood + "11., 2., 1., .3, .4, .2, .8, .7\n.5, 40.\n", "", initial})
                .initial_temperature.size(),
            1U);
}

TEST(InpElastic, CreepOverTheTemperature) {
  const std::string initial = "*INITIAL CONDITIONS, TYPE=TEMPERATURE\nN, 20.\n",
                    visco = "*STEP\n*VISCO, CETOL=1.\n1., 1.\n";
  const auto pipe = law<material::Norton>(
      {"*ELASTIC\n200., .3, 0.\n100., .3, 500.\n*CREEP\n1.e-5, 3., 0., 0.\n2.e-5, 3., 0., 500.\n",
       "", initial, visco});
  EXPECT_EQ(pipe.young_over, (core::Table{{0, 200}, {500, 100}}));
  EXPECT_EQ(pipe.rate_over, (core::Table{{0, 1e-5}, {500, 2e-5}}));
  EXPECT_EQ(pipe.exponent, 3);
  EXPECT_TRUE(pipe.exponent_over.empty());
}

TEST(InpElastic, TablesOverTheTemperature) {
  const std::string table = "*ELASTIC\n210., .3, 0.\n30., .3, 500.\n";
  const std::string initial = "*INITIAL CONDITIONS, TYPE=TEMPERATURE\nN, 20.\n";
  const auto steel = law<material::LinearElastic>({table, "", initial});
  EXPECT_EQ(steel.young_over, (core::Table{{0, 210}, {500, 30}}));
  EXPECT_TRUE(steel.poisson_over.empty());
  EXPECT_EQ(steel.poisson, 0.3);
  EXPECT_EQ(described({table, "", initial}).initial_temperature.size(), 1U);
  EXPECT_TRUE(
      law<material::LinearElastic>({"*ELASTIC\n2., .3, 0.\n2., .3, 500.\n"}).young_over.empty());
  EXPECT_THAT(message({table}), HasSubstr("which is given nowhere"));
}

}  // namespace
}  // namespace osculate::deck
