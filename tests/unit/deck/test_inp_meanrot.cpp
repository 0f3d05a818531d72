// Mean rotations of nodes in decks: a bar that is twisted by them.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "inp_run_test.hpp"
#include "osculate/core/error.hpp"

namespace osculate::deck {
namespace {

/// A bar along z of two cubes with nu = 0.25, its lower end held; node 900 has the axis.
std::string bar_along_z(const std::string& axis = "0., 0., 1.") {
  std::string text = "*NODE, NSET=NALL\n";
  for (int k = 0; k <= 2; ++k)
    for (int i = 0; i < 4; ++i)
      text += fmt::format("{}, {}, {}, {}\n", 10 * k + i + 1, i == 1 || i == 2 ? 1 : 0,
                          i >= 2 ? 1 : 0, k);
  text += "*NODE\n900, " + axis + "\n*ELEMENT, TYPE=C3D8, ELSET=BAR\n";
  for (int k = 0; k < 2; ++k)
    text += fmt::format("{}, {}, {}, {}, {}, {}, {}, {}, {}\n", k + 1, 10 * k + 1, 10 * k + 2,
                        10 * k + 3, 10 * k + 4, 10 * k + 11, 10 * k + 12, 10 * k + 13, 10 * k + 14);
  return text +
         "*NSET, NSET=START\n1, 2, 3, 4\n*MATERIAL, NAME=M\n*ELASTIC\n100., 0.25\n"
         "*SOLID SECTION, ELSET=BAR, MATERIAL=M\n*BOUNDARY\nSTART, 1, 3\n";
}
const std::string twist = "*MPC\nMEANROT, 21, 21, 21, 22, 22, 22, 23, 23, 23\n24, 24, 24, 900\n";

std::string message(const std::string& text) {
  try {
    (void)run_deck(text);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "no error";
}

/// Small rotations: each corner moves by phi times its arm across it.
TEST(InpMeanRotation, InALinearStepItIsSmall) {
  const DeckRun run = run_deck(bar_along_z() + twist +
                               "*STEP\n*STATIC\n*BOUNDARY\n900, 1, 1, 0.5\n" + "*END STEP\n");
  const Vec3 corner = run.displacement(21);  // at (-1/2, -1/2) from the axis
  EXPECT_NEAR(corner.x(), 0.25, 1e-9);
  EXPECT_NEAR(corner.y(), -0.25, 1e-9);
  EXPECT_NEAR(run.displacement(23).x(), -0.25, 1e-9);
}

/// With NLGEOM the same corners go round a circle about the axis.
TEST(InpMeanRotation, WithNlgeomItIsOfAnySize) {
  for (const auto& [axis, sign] : {std::pair("0., 0., 1.", 1.0), {"0., 0., -2.", -1.0}}) {
    const DeckRun run =
        run_deck(bar_along_z(axis) + twist +
                 "*STEP, NLGEOM\n*STATIC\n0.25, 1.\n*BOUNDARY\n900, 1, 1, 0.5\n*END STEP\n");
    const Vec3 corner = run.displacement(21);
    const double turned = std::atan2(-0.5 + corner.y(), -0.5 + corner.x()) - std::atan2(-0.5, -0.5);
    EXPECT_NEAR(turned, sign * 0.5, 1e-8);
  }
}

TEST(InpMeanRotation, WhatIsWrongIsSaid) {
  using ::testing::HasSubstr;
  const std::string small = "*STEP\n*STATIC\n*END STEP\n";
  const std::string finite = "*STEP, NLGEOM\n*STATIC\n*END STEP\n";
  EXPECT_THAT(message(bar_along_z() + "*MPC\nMEANROT, 21, 21, 22, 22, 22, 23, 900\n" + small),
              HasSubstr("expected 'node 21' three times"));
  EXPECT_THAT(message(bar_along_z() + "*MPC\nMEANROT, 21, 21, 900\n" + small),
              HasSubstr("MEANROT needs two nodes and its own"));
  EXPECT_THAT(message(bar_along_z("0., 0., 0.") + twist + small), HasSubstr("has no axis"));
  EXPECT_THAT(message(bar_along_z("0., 1., 1.") + twist + finite), HasSubstr("along x, y or z"));
  EXPECT_THAT(message(bar_along_z() + "*MPC\nMEANROT, 1, 1, 1, 11, 11, 11, 900\n" + small),
              HasSubstr("lie on its axis"));
}

}  // namespace
}  // namespace osculate::deck
