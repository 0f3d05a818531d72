// Decks with plane, axisymmetric and solid elements.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "inp_run_test.hpp"
#include "osculate/core/error.hpp"
#include "osculate/deck/inp_translate.hpp"
#include "osculate/deck/parse.hpp"

namespace osculate::deck {
namespace {

using ::testing::AnyOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

constexpr double degree = std::numbers::pi / 180;

std::string message(const std::string& text) {
  try {
    (void)parse_model(translate_deck(text, "a.inp").root, "a.inp");
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

const std::string material = "*MATERIAL, NAME=M\n*ELASTIC\n1000., 0.3\n*DENSITY\n2.\n";

/// A cube of a C3D8 whose nodes 111 to 118 have it at x = 5 to 6.
const std::string cube =
    "*NODE, NSET=CUBE\n111, 5, 0, 0\n112, 6, 0, 0\n113, 6, 1, 0\n114, 5, 1, 0\n115, 5, 0, 1\n"
    "116, 6, 0, 1\n117, 6, 1, 1\n118, 5, 1, 1\n*ELEMENT, TYPE=C3D8, ELSET=B\n"
    "20, 111, 112, 113, 114, 115, 116, 117, 118\n*SOLID SECTION, ELSET=B, MATERIAL=M\n"
    "*BOUNDARY\nCUBE, 3\n111, 1, 2\n112, 2\n114, 1\n115, 1, 2\n116, 2\n118, 1\n";

bool is_triangle(const std::string& type) { return type[3] == '3' || type[3] == '6'; }
bool is_ring(const std::string& type) { return type.starts_with("CAX"); }

/// One element between x = 1 and 3 and y = 0 and 4, or the half of it below the diagonal.
std::string element(const std::string& type, const std::string& thickness) {
  const bool second = type[3] == '6' || type[3] == '8';
  const std::string nodes = is_triangle(type) ? (second ? "1, 2, 3, 5, 6, 9" : "1, 2, 3")
                                              : (second ? "1, 2, 3, 4, 5, 6, 7, 8" : "1, 2, 3, 4");
  return material +
         "*NODE\n1, 1, 0\n2, 3, 0\n3, 3, 4\n4, 1, 4\n5, 2, 0\n6, 3, 2\n7, 2, 4\n8, 1, 2\n"
         "9, 2, 2\n*NSET, NSET=P\n" +
         nodes + "\n*ELEMENT, TYPE=" + type + ", ELSET=P\n1, " + nodes +
         "\n*SOLID SECTION, ELSET=P, MATERIAL=M\n" + (thickness.empty() ? "" : thickness + "\n");
}

/// A pressure of 1 on each edge of each kind of element is held by its nodes: of a ring the force
/// on a sector of 2 degrees, as far as it stretches the ring along x.
TEST(InpPlane, UnitPressureHasItsResultant) {
  const std::array<Vec3, 4> sides{Vec3(0, -2, 0), Vec3(4, 0, 0), Vec3(0, 2, 0), Vec3(-4, 0, 0)};
  for (const std::string type :
       {"CPE3", "CPE4", "CPE4R", "CPE4I", "CPE6", "CPE8", "CPE8R", "CPS3", "CPS4", "CPS4R", "CPS6",
        "CPS8", "CPS8R", "CAX3", "CAX4", "CAX4R", "CAX6", "CAX8", "CAX8R"}) {
    const int edges = is_triangle(type) ? 3 : 4;
    for (int k = 1; k <= edges; ++k) {
      SCOPED_TRACE(fmt::format("{} {}", type, k));
      const DeckRun run = run_deck(element(type, "0.25") + cube +
                                   "*BOUNDARY\nP, 1, 3\n*STEP\n*STATIC\n*DLOAD\n1, P" +
                                   std::to_string(k) + ", 1.\n20, P4, 1.\n*END STEP\n");
      Vec3 expected = sides[static_cast<std::size_t>(k - 1)];
      if (edges == 3 && k == 3) expected = Vec3(-4, 2, 0);
      const double radius = edges == 4 && k == 4 ? 1 : k == 2 ? 3 : 2;
      // across the radius the chord, along it what is between arcs (of second order) or chords
      const double arc = type[3] > '4' ? 2 * degree : std::sin(2 * degree);
      if (is_ring(type))
        expected =
            radius * Vec3(2 * std::sin(degree) * expected.x(), arc * expected.y(), expected.z());
      else
        expected *= 0.25;
      const double close = is_ring(type) && type[3] > '4' ? 1e-6 : 1e-9;
      EXPECT_NEAR((run.reaction_of("P") - expected).norm(), 0, close * expected.norm());
      EXPECT_NEAR(run.displacement(112).x(), -0.91e-3, 1e-12);  // the cube: (1 - nu^2) / E
    }
  }
}

/// Lame's ring in plane strain, beside a cube that knows nothing of it.
TEST(InpPlane, RingOfLameBesideACube) {
  std::string nodes = "*NODE\n", elements, flat = "*NSET, NSET=FLAT\n";
  constexpr int cells = 8;
  for (int i = 0; i <= 2 * cells; ++i)
    for (int j = 0; j <= 2; ++j) {
      if (i % 2 == 1 && j == 1) continue;
      nodes += fmt::format("{}, {}, {}\n", 1 + i + 20 * j, 1 + 2.0 * i / (2 * cells), 0.25 * j);
      flat += fmt::format("{},\n", 1 + i + 20 * j);
    }
  for (int c = 0; c < cells; ++c) {
    const int a = 1 + 2 * c;
    elements += fmt::format("{}, {}, {}, {}, {}, {}, {}, {}, {}\n", c + 1, a, a + 2, a + 42, a + 40,
                            a + 1, a + 22, a + 41, a + 20);
  }
  const DeckRun run = run_deck(
      material + nodes + "*ELEMENT, TYPE=CAX8R, ELSET=P\n" + elements +
      "*SOLID SECTION, ELSET=P, MATERIAL=M\n" + flat + cube +
      "*BOUNDARY\nFLAT, 2, 2\n*STEP\n*STATIC\n*DLOAD\n1, P4, 10.\n20, P4, 1.\n*END STEP\n");
  for (const double r : {1.0, 1.5, 2.0, 3.0}) {
    // u = (1 + nu) / E p a^2 / (b^2 - a^2) ((1 - 2 nu) r + b^2 / r)
    const double u = 1.3 / 1000 * 10 / 8 * (0.4 * r + 9 / r);
    const int number = 1 + static_cast<int>(std::lround((r - 1) * cells));
    EXPECT_NEAR(run.displacement(number).x(), u, 2e-5 * u);
    EXPECT_NEAR(run.displacement(number).z(), 0, 1e-14);
  }
  EXPECT_NEAR(run.displacement(112).x(), -0.91e-3, 1e-12);
}

/// A solid that is tied to a block in plane strain: both have one uniform stress.
TEST(InpPlane, SolidTiedToPlaneStrain) {
  const std::string deck =
      material +
      "*NODE\n1, 3, 0\n2, 5, 0\n3, 5, 1\n4, 3, 1\n*ELEMENT, TYPE=CPE4, ELSET=P\n1, 1, 2, 3, 4\n"
      "*SOLID SECTION, ELSET=P, MATERIAL=M\n2.\n"
      "*NODE, NSET=CUBE\n111, 5, 0, -1\n112, 6, 0, -1\n113, 6, 1, -1\n114, 5, 1, -1\n115, 5, 0, 1\n"
      "116, 6, 0, 1\n117, 6, 1, 1\n118, 5, 1, 1\n*ELEMENT, TYPE=C3D8, ELSET=B\n"
      "20, 111, 112, 113, 114, 115, 116, 117, 118\n*SOLID SECTION, ELSET=B, MATERIAL=M\n"
      "*SURFACE, NAME=PLATE\n1, S2\n*SURFACE, NAME=FACE\n20, S6\n";
  const std::string held =
      "*BOUNDARY\n1, 1, 2\n2, 2\n4, 1\nCUBE, 3\n*STEP\n*STATIC\n*DLOAD\n20, P4, -50.\n*END STEP\n";
  const DeckRun run = run_deck(deck + "*TIE, NAME=T, POSITION TOLERANCE=0.1\nFACE, PLATE\n" + held);
  const double strain = 50 * (1 - 0.09) / 1000, across = -50 * 0.3 * 1.3 / 1000;
  EXPECT_NEAR(run.displacement(2).x(), 2 * strain, 1e-12);
  EXPECT_NEAR(run.displacement(116).x(), 3 * strain, 1e-12);
  EXPECT_NEAR(run.displacement(117).y(), across, 1e-12);
  EXPECT_NEAR(run.displacement(3).y(), across, 1e-12);
  // what holds the slave holds the master as well, through the node that leads it
  EXPECT_THAT(run.built.warnings, Not(Contains(HasSubstr("the surfaces part there"))));
  EXPECT_THAT(
      message(deck + "*TIE, NAME=T\nPLATE, FACE\n" + held),
      HasSubstr("'PLATE' is on plane elements, which become solids beside others: they follow "
                "the nodes of the deck and cannot be the slave of a *TIE"));
}

/// In plane stress the thickness changes as it must; finite strain, too.
TEST(InpPlane, PlaneStressChangesItsThickness) {
  for (const char* const type : {"CPS4", "CPS8", "CPS8R"})
    for (const bool finite : {false, true}) {
      SCOPED_TRACE(fmt::format("{} {}", type, finite));
      const DeckRun run =
          run_deck(element(type, "0.25") + cube +
                   "*BOUNDARY\n1, 1, 2\n2, 2\n2, 1, 1, 0.2\n3, 1, 1, 0.2\n4, 1\n" +
                   (type[3] == '8' ? "5, 2\n6, 1, 1, 0.2\n8, 1\n" : "") +
                   fmt::format("*STEP{}\n*STATIC\n*END STEP\n", finite ? ", NLGEOM" : ""));
      const double stretch = finite ? 0.1 + 0.005 : 0.1;  // Green and Lagrange's
      const double across = -0.3 * stretch;
      const double width = finite ? std::sqrt(1 + 2 * across) - 1 : across;
      EXPECT_NEAR(run.displacement(3).y(), 4 * width, 1e-9);
      for (const mesh::Expanded& one : run.built.model.mesh.expanded)
        EXPECT_NEAR(run.u[0][3 * one.node + 2],
                    run.built.model.mesh.nodes[static_cast<std::size_t>(one.node)].z() * width,
                    1e-9);
    }
}

/// Forces are those of whole rings, as are the thicknesses that they act on.
TEST(InpPlane, ForcesBesideRingsAreThoseOfTheWhole) {
  const std::string plate =
      "*NODE\n21, 10, 0\n22, 11, 0\n23, 11, 1\n24, 10, 1\n*ELEMENT, TYPE=CPE4, ELSET=Q\n"
      "5, 21, 22, 23, 24\n*SOLID SECTION, ELSET=Q, MATERIAL=M\n0.5\n*BOUNDARY\n21, 1, 2\n22, "
      "2\n24, 1\n";
  const std::string loads = "*STEP\n*STATIC\n*CLOAD\n23, 2, 3.\n24, 2, 3.\n113, 1, 9.\n*END STEP\n";
  const DeckRun without = run_deck(material + plate + cube + loads);
  const DeckRun beside = run_deck(element("CAX4", "") + plate + cube + "*BOUNDARY\n1, 2\n" + loads);
  EXPECT_NEAR(without.displacement(23).y(), 3 / 0.25 * 0.91e-3, 1e-12);
  EXPECT_NEAR(beside.displacement(23).y(), 3 / 0.25 * 0.91e-3, 1e-12);
  EXPECT_NEAR(beside.displacement(113).x(), without.displacement(113).x() / 180, 1e-12);
  EXPECT_THAT(
      translate_deck(element("CAX4", "") + cube + "*STEP\n*STATIC\n*END STEP\n", "a.inp").notes,
      Contains(HasSubstr("sectors of 2 degrees")));
  EXPECT_THAT(
      translate_deck(element("CPE4", "") + cube + "*STEP\n*STATIC\n*END STEP\n", "a.inp").notes,
      Not(Contains(HasSubstr("sectors of 2 degrees"))));
}

/// What acts across the plane acts on nothing; a node that solids share stays in it.
TEST(InpPlane, NothingMovesAcrossThePlane) {
  const std::string shared =
      material +
      "*NODE\n1, 3, 0\n2, 5, 0\n3, 5, 1\n4, 3, 1\n*ELEMENT, TYPE=CPE4, ELSET=P\n1, 1, 2, 3, 4\n"
      "*SOLID SECTION, ELSET=P, MATERIAL=M\n2.\n*NODE\n"
      "112, 6, 0, 0\n113, 6, 1, 0\n115, 5, 0, 1\n116, 6, 0, 1\n117, 6, 1, 1\n118, 5, 1, 1\n"
      "*ELEMENT, TYPE=C3D8, ELSET=B\n20, 2, 112, 113, 3, 115, 116, 117, 118\n"
      "*SOLID SECTION, ELSET=B, MATERIAL=M\n*BOUNDARY\n1, 1, 2\n4, 1\n112, 3\n113, 3\n";
  const std::string loads = "*STEP\n*STATIC\n*CLOAD\n116, 3, 2.\n117, 3, 2.\n4, 3, 7.\n*END STEP\n";
  const DeckRun run = run_deck(shared + loads);
  EXPECT_NEAR(run.displacement(2).z(), 0, 1e-15);
  EXPECT_GT(run.displacement(116).z(), 1e-3);
  const DeckRun held = run_deck(shared + "*BOUNDARY\n1, 3\n2, 3\n3, 3, 6\n" + loads);
  EXPECT_NEAR((held.displacement(116) - run.displacement(116)).norm(), 0, 1e-14);
}

/// Axes that turn the plane.
TEST(InpPlane, NodesHaveAxes) {
  const DeckRun run = run_deck(
      element("CPE4", "0.25") + cube +
      "*NSET, NSET=T\n4,\n*TRANSFORM, NSET=T\n0, 1, 0, -1, 0, 0\n" +
      "*BOUNDARY\n1, 1, 2\n2, 2\n4, 2, 3\n*STEP\n*STATIC\n*DLOAD\n1, P2, -10.\n*END STEP\n");
  EXPECT_NEAR(run.displacement(4).x(), 0, 1e-14);  // its second axis is -x
  EXPECT_NEAR(run.displacement(2).x(), 2 * 10 * 0.91e-3, 1e-12);
}

/// A body that flies: its solids move as the nodes of the deck are told.
TEST(InpPlane, VelocitiesAtFirst) {
  for (const std::string type : {"CPE4", "CPS8R", "CAX4", "CPE6"}) {
    SCOPED_TRACE(type);
    const DeckRun run = run_deck(
        element(type, "0.25") + cube + "*INITIAL CONDITIONS, TYPE=VELOCITY\nP, 2, 3.\nP, 3, 1.\n" +
        (is_ring(type) ? "" : "P, 1, 2.\n") +
        "*STEP\n*DYNAMIC, DIRECT\n0.01, 0.02\n*DLOAD\n20, P4, 0.\n*END STEP\n");
    for (const int number : {1, 2, 3}) {
      const Vec3 expected(is_ring(type) ? 0 : 0.04, 0.06, 0);
      EXPECT_NEAR((run.displacement(number) - expected).norm(), 0, 1e-12);
    }
    for (const mesh::Expanded& one : run.built.model.mesh.expanded)
      EXPECT_NEAR(run.u[0][3 * one.node + 1], 0.06, 1e-12);
  }
}

TEST(InpPlane, PlaneElementsAreShownAsTheyAre) {
  const auto shown = [](const std::string& text, const std::string& request) {
    const Description d = parse_model(
        translate_deck(text + "*STEP\n*STATIC\n" + request + "U\n*END STEP\n", "a.inp").root,
        "a.inp");
    return d.output.as_given;
  };
  const std::string mixed = element("CPE4", "") + cube;
  EXPECT_TRUE(shown(mixed, "*NODE FILE\n"));
  EXPECT_FALSE(shown(mixed, "*NODE FILE, OUTPUT=3D\n"));
  EXPECT_FALSE(shown(element("CPE4", ""), "*NODE FILE\n"));
  const std::string shell =
      "*NODE\n51, 20, 0\n52, 21, 0\n53, 21, 1\n54, 20, 1\n*ELEMENT, TYPE=S4, ELSET=S\n50, 51, 52, "
      "53, "
      "54\n*SHELL SECTION, ELSET=S, MATERIAL=M\n0.1\n";
  EXPECT_FALSE(shown(mixed + shell, "*NODE FILE\n"));
  EXPECT_TRUE(shown(mixed + shell, "*NODE FILE, OUTPUT=2D\n"));
}

TEST(InpPlane, WhatLayersCannotDoIsRefused) {
  const std::string mixed = element("CPE4", "") + cube, end = "*STEP\n*STATIC\n*END STEP\n";
  const std::string surfaces = "*SURFACE, NAME=PLATE\n1, S2\n*SURFACE, NAME=FACE\n20, S6\n";
  EXPECT_THAT(message(mixed + surfaces +
                      "*NODE\n300, 9, 9\n*PRE-TENSION SECTION, SURFACE=PLATE, "
                      "NODE=300\n1, 0, 0\n" +
                      end),
              HasSubstr("*PRE-TENSION SECTION through them is not supported"));
  EXPECT_THAT(
      message(mixed + "*NODE\n300, 9, 9\n*RIGID BODY, NSET=P, REF NODE=300\n" + end),
      HasSubstr("'P.nodes' is on plane elements, which become solids beside others: no part of a "
                "rigid body"));
  EXPECT_THAT(
      message(mixed + surfaces +
              "*NODE\n300, 9, 9\n*COUPLING, CONSTRAINT NAME=C, REF NODE=300, SURFACE=PLATE\n"
              "*KINEMATIC\n1, 3\n" +
              end),
      HasSubstr("*KINEMATIC is not supported there"));
  EXPECT_THAT(message(mixed +
                      "*SURFACE INTERACTION, NAME=I\n*CONTACT\n*CONTACT INCLUSIONS, ALL "
                      "EXTERIOR\n*CONTACT PROPERTY ASSIGNMENT\n, , I\n" +
                      end),
              HasSubstr("ALL EXTERIOR would have their sides, too: name the pairs of surfaces"));
  EXPECT_THAT(message(mixed + surfaces +
                      "*TIE, NAME=T, CYCLIC SYMMETRY\nFACE, PLATE\n*CYCLIC SYMMETRY MODEL, N=4, "
                      "TIE=T\n0, 0, 0, 0, 1, 0\n" +
                      end),
              HasSubstr("plane elements become solids beside others: not supported here"));
  EXPECT_THAT(
      message(
          mixed + surfaces +
          "*SURFACE, NAME=POINTS, TYPE=NODE\nP\n*SURFACE INTERACTION, NAME=I\n*SURFACE BEHAVIOR, "
          "PRESSURE-OVERCLOSURE=LINEAR\n1e5\n*CONTACT PAIR, INTERACTION=I, TYPE=NODE TO "
          "SURFACE\nPOINTS, FACE\n" +
          end),
      HasSubstr("a surface of their nodes is not supported, name their edges"));
  EXPECT_THAT(message(mixed + "*STEP\n*STATIC\n*BOUNDARY\n1, 3, 3, 0.01\n*END STEP\n"),
              HasSubstr("are not displaced along z"));
  EXPECT_THAT(message(mixed + end), IsEmpty());
}

}  // namespace
}  // namespace osculate::deck
