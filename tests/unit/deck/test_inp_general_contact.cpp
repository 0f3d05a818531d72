// *CONTACT of decks beside *CONTACT PAIR.
#include <gmock/gmock.h>

#include "cube_nodes.hpp"
#include "inp_run_test.hpp"
#include "osculate/deck/inp_translate.hpp"
#include "osculate/deck/parse.hpp"

namespace osculate::deck {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Three cubes on top of each other, pressed by 0.06 at the top: two contacts of 1e4 in a row with
/// three cubes of 1000.
const std::string cubes = R"(*NODE, NSET=ALL
)" + cube_nodes(1, {0, 0, 0}) +
                          cube_nodes(11, {0, 0, 1}) + cube_nodes(21, {0, 0, 2}) +
                          R"(*ELEMENT, TYPE=C3D8, ELSET=LOW
1, 1, 2, 3, 4, 5, 6, 7, 8
*ELEMENT, TYPE=C3D8, ELSET=MIDDLE
2, 11, 12, 13, 14, 15, 16, 17, 18
*ELEMENT, TYPE=C3D8, ELSET=HIGH
3, 21, 22, 23, 24, 25, 26, 27, 28
*NSET, NSET=BASE
1, 2, 3, 4
*NSET, NSET=TOP
25, 26, 27, 28
*SURFACE, NAME=A2
1, S2
*SURFACE, NAME=B1
2, S1
*SURFACE, NAME=B2
2, S2
*SURFACE, NAME=C1
3, S1
*SURFACE, NAME=OF_LOW
LOW,
*SURFACE, NAME=OF_HIGH
HIGH,
*MATERIAL, NAME=M
*ELASTIC
1000., 0.
*SOLID SECTION, ELSET=LOW, MATERIAL=M
*SOLID SECTION, ELSET=MIDDLE, MATERIAL=M
*SOLID SECTION, ELSET=HIGH, MATERIAL=M
*SURFACE INTERACTION, NAME=SI
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR
1.E4
*SURFACE INTERACTION, NAME=ROUGH
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR
2.E4
*FRICTION
0.3, 1.E4
)";
const std::string press = R"(*BOUNDARY
BASE, 1, 3
ALL, 1, 2
*STEP
*STATIC, DIRECT
1., 1.
*BOUNDARY
TOP, 3, 3, -0.06
*END STEP
)";

Description read(const std::string& contact) {
  return parse_model(translate_deck(cubes + contact + press, "cubes.inp").root, "cubes.inp");
}
std::string refusal(const std::string& contact) {
  try {
    (void)read(contact);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(InpGeneralContact, AllExteriorAndItsPairsAreAsContactPairs) {
  const std::string law = "*CONTACT PROPERTY ASSIGNMENT\n, , SI\n";
  const std::array<std::string, 3> contacts{
      "*CONTACT PAIR, INTERACTION=SI, TYPE=SURFACE TO SURFACE\nB1, A2\nC1, B2\n",
      "*CONTACT\n*CONTACT INCLUSIONS, ALL EXTERIOR\n" + law,
      "*CONTACT\n*CONTACT INCLUSIONS\nB1, A2\nB2, C1\n" + law};
  const double pressure = 0.06 / (3 / 1000.0 + 2 / 1e4);
  for (const std::string& contact : contacts) {
    const DeckRun run = run_deck(cubes + contact + press);
    EXPECT_NEAR(run.reaction_of("BASE").z(), pressure, 1e-6 * pressure) << contact;
    EXPECT_NEAR(run.displacement(6).z(), -pressure / 1000, 1e-6 * 0.06) << contact;
    EXPECT_NEAR(run.displacement(15).z(), -pressure * (2 / 1000.0 + 1 / 1e4), 1e-6 * 0.06);
  }
}

// Cubes of 1000, contacts of 1e4 and 2e4 in a row; what is tied gives nothing.
TEST(InpGeneralContact, WhatIsPairedOrTiedDoesNotTouchByAllAsWell) {
  const std::string all =
      "*CONTACT\n*CONTACT INCLUSIONS, ALL EXTERIOR\n*CONTACT PROPERTY ASSIGNMENT\n, , SI\n";
  const auto expect = [&](const std::string& contact, double compliance) {
    const double pressure = 0.06 / compliance;
    EXPECT_NEAR(run_deck(cubes + contact + press).reaction_of("BASE").z(), pressure,
                1e-6 * pressure)
        << contact;
  };
  const double two = 3 / 1000.0 + 1 / 1e4 + 1 / 2e4, tied = 3 / 1000.0 + 1 / 1e4;
  expect(all + "*CONTACT PAIR, INTERACTION=ROUGH, TYPE=SURFACE TO SURFACE\nB1, A2\n", two);
  expect(all + "*CONTACT PAIR, INTERACTION=ROUGH, TYPE=NODE TO SURFACE\nB1, A2\n", two);
  expect(all + "A2, B1, ROUGH\n", two);
  expect(all + "*TIE, NAME=T\nB1, A2\n", tied);
  // Exclusions of surfaces, one of them by its nodes.
  const std::string nodes = "*SURFACE, NAME=NODES, TYPE=NODE\nBASE\n5,\n6,\n7,\n8,\n";
  const std::string pair = "*CONTACT PAIR, INTERACTION=ROUGH, TYPE=SURFACE TO SURFACE\nB1, A2\n";
  expect(nodes + all + "*CONTACT EXCLUSIONS\nB1, NODES\n" + pair, two);
  // The last law of two surfaces counts, and excluded ones need none.
  expect(all + "A2, B1, SI\nB1, A2, ROUGH\n", two);
  const Description model = read(all + "A2, C1, ROUGH\n*CONTACT EXCLUSIONS\nC1, A2\n");
  ASSERT_EQ(model.contact.size(), 1U);
  EXPECT_EQ(model.contact[0].exclude_surfaces.at(0)[1].value, "A2");
}

// The reference node of a coupling is a rigid body of one node, which is nothing to warn of.
TEST(InpGeneralContact, ReferenceNodesTouchNothing) {
  const std::string all =
      "*CONTACT\n*CONTACT INCLUSIONS, ALL EXTERIOR\n*CONTACT PROPERTY ASSIGNMENT\n, , SI\n";
  const std::string reference =
      "*NODE\n99, 0.5, 0.5, 4.\n*SURFACE, NAME=C2\n3, S2\n"
      "*COUPLING, CONSTRAINT NAME=C, REF NODE=99, SURFACE=C2\n*DISTRIBUTING\n1, 6\n";
  EXPECT_THAT(run_deck(cubes + reference + all + press).built.warnings, ::testing::IsEmpty());
}

// Without its exclusion the low cube holds the middle one, with it nothing does.
TEST(InpGeneralContact, SurfacesThatAreExcludedPassThroughEachOther) {
  const std::string all =
      "*CONTACT\n*CONTACT INCLUSIONS, ALL EXTERIOR\n*CONTACT PROPERTY ASSIGNMENT\n, , SI\n";
  const std::string held = "*BOUNDARY\nALL, 1, 2\n11, 3, 3\n12, 3, 3\n13, 3, 3\n14, 3, 3\n";
  EXPECT_NEAR(run_deck(cubes + all + "*CONTACT EXCLUSIONS\nA2, B1\n" + held + press)
                  .reaction_of("BASE")
                  .z(),
              0, 1e-9);
}

TEST(InpGeneralContact, ExclusionsNameTheSectionsOfWholeBodies) {
  const Description model = read(
      "*CONTACT\n*CONTACT INCLUSIONS, ALL EXTERIOR\n*CONTACT EXCLUSIONS\nOF_LOW, OF_HIGH\n"
      "of_high,\n*CONTACT PROPERTY ASSIGNMENT\n, , rough\n");
  ASSERT_EQ(model.contact.size(), 1U);
  const Contact& all = model.contact[0];
  EXPECT_TRUE(all.all);
  ASSERT_EQ(all.exclude.size(), 2U);
  EXPECT_EQ(all.exclude[0][0].value, "LOW");
  EXPECT_EQ(all.exclude[0][1].value, "HIGH");
  EXPECT_EQ(all.exclude[1][0].value, "HIGH");
  EXPECT_EQ(all.exclude[1][1].value, "HIGH");
  EXPECT_TRUE(all.friction.has_value());
}

TEST(InpGeneralContact, PairsHaveTheLawAssignedToThemElseThatOfAll) {
  const Description model = read(
      "*CONTACT\n*CONTACT INCLUSIONS\nB1, A2\nB2, C1\nOF_LOW, OF_HIGH\nOF_LOW\n"
      "*CONTACT EXCLUSIONS\nOF_HIGH, OF_LOW\n"
      "*CONTACT PROPERTY ASSIGNMENT\nA2, B1, ROUGH\n, , SI\n");
  ASSERT_EQ(model.contact.size(), 3U);
  EXPECT_TRUE(model.contact[0].friction.has_value());
  EXPECT_FALSE(model.contact[1].friction.has_value());
  EXPECT_TRUE(model.contact[0].two_pass.has_value());
  EXPECT_EQ(model.contact[2].slave.value, model.contact[2].master.value);
  EXPECT_FALSE(model.contact[2].two_pass.has_value());
}

TEST(InpGeneralContact, WhatItCannotSayIsRefused) {
  const std::string all = "*CONTACT\n*CONTACT INCLUSIONS, ALL EXTERIOR\n";
  EXPECT_THAT(refusal(all + "*CONTACT EXCLUSIONS\nA2, OF_HIH\n"), HasSubstr("OF_HIH"));
  EXPECT_THAT(refusal(all + "*CONTACT EXCLUSIONS\n, A2\n"),
              HasSubstr("cubes.inp:65: *CONTACT EXCLUSIONS: with a surface that is not the whole"));
  EXPECT_THAT(refusal(all + "*CONTACT PROPERTY ASSIGNMENT\n, B1, SI\n"),
              HasSubstr("expected two surfaces and their interaction"));
  EXPECT_THAT(refusal(all + "*CONTACT PROPERTY ASSIGNMENT\n, , S1\n"),
              HasSubstr("unknown surface interaction 'S1'; did you mean 'SI'"));
  EXPECT_THAT(refusal("*CONTACT\n"), HasSubstr("expected *CONTACT INCLUSIONS after it"));
  EXPECT_THAT(refusal("*CONTACT INCLUSIONS, ALL EXTERIOR\n"), HasSubstr("before *CONTACT"));
  EXPECT_THAT(refusal("*CONTACT\n*CONTACT INCLUSIONS\nB1, A2\n*CONTACT EXCLUSIONS\nB2, C1\n"),
              HasSubstr("*CONTACT INCLUSIONS has no such pair"));
  EXPECT_THAT(refusal("*STEP\n*STATIC\n*END STEP\n*STEP\n*STATIC\n*CONTACT\n*END STEP\n"),
              HasSubstr("is not supported after the first step"));
}

}  // namespace
}  // namespace osculate::deck
