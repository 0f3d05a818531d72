// Shells and beams of decks: sections, knots, rotations.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "deck_test.hpp"
#include "inp_run_test.hpp"
#include "osculate/core/error.hpp"
#include "osculate/deck/inp_translate.hpp"
#include "osculate/deck/parse.hpp"

namespace osculate::deck {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

/// A beam with a corner at node 2, and its end 3.
const std::string elbow =
    "*NODE, NSET=N\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n*ELEMENT, TYPE=B31, ELSET=E\n1, 1, 2\n"
    "2, 2, 3\n*MATERIAL, NAME=M\n*ELASTIC\n1000., 0.3\n*DENSITY\n2.\n"
    "*BEAM SECTION, ELSET=E, MATERIAL=M, SECTION=RECT\n0.1, 0.2\n0, 0, 1\n";

Description described(const std::string& text) {
  return parse_model(translate_deck(text, "a.inp").root, "a.inp");
}
std::string message(const std::string& text) {
  try {
    (void)described(text);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

/// In a later step the same GRAV is replaced; another one adds to it, on a set of its own.
TEST(InpThin, GravityOfLaterSteps) {
  const auto deck = [](const std::string& second) {
    return elbow + "*STEP\n*STATIC\n*DLOAD\nE, GRAV, 3, 0, 0, -1\n*END STEP\n*STEP\n*STATIC\n" +
           second + "*END STEP\n";
  };
  const Description d = described(deck("*DLOAD\nE, GRAV, 5, 0, 0, -1\n"));
  EXPECT_EQ(d.steps[1].body_force[0].values[2]->value, -10);
  const Description other = described(deck("*DLOAD\nE, GRAV, 5, 1, 0, 0\n"));
  ASSERT_THAT(other.steps[1].body_force, SizeIs(1));
  EXPECT_EQ(other.steps[1].body_force[0].on.value, "E_gravity_2");
  EXPECT_EQ(other.steps[1].body_force[0].values[0]->value, 10);
  const Description anew = described(deck("*DLOAD, OP=NEW\nE, GRAV, 5, 1, 0, 0\n"));
  EXPECT_EQ(anew.steps[1].body_force.size(), 2u);  // that along z becomes 0
}

/// Forces per length push into the shell: a plate under them is in plane stress.
TEST(InpThin, ForcesAlongEdgesAreForcesOfTheirFaces) {
  const auto plate = [](const std::string& load, const std::string& section) {
    return "*NODE, NSET=N\n1, 0, 0, 0\n2, 1, 0, 0\n3, 2, 0, 0\n4, 2, 1, 0\n5, 2, 2, 0\n6, 1, 2, 0\n"
           "7, 0, 2, 0\n8, 0, 1, 0\n*ELEMENT, TYPE=S8, ELSET=E\n1, 1, 3, 5, 7, 2, 4, 6, 8\n"
           "*MATERIAL, NAME=M\n*ELASTIC\n1000., 0.3\n*SHELL SECTION, ELSET=E, MATERIAL=M" +
           section +
           "*NSET, NSET=BC\n1, 8, 7\n*BOUNDARY\nBC, 1, 1\n8, 2, 2\nN, 3, "
           "3\n*STEP\n*STATIC\n*DLOAD\n" +
           load + "*END STEP\n";
  };
  for (const char* const elements : {"E", "1"}) {
    const Description d = described(plate(std::string(elements) + ", EDNOR2, 3.\n", "\n0.1\n"));
    ASSERT_THAT(d.steps[0].pressure, SizeIs(1));
    EXPECT_EQ(d.steps[0].pressure[0].on.value,
              std::string("EDNOR2 of ") + (*elements == 'E' ? "E" : "element 1"));
    EXPECT_DOUBLE_EQ(d.steps[0].pressure[0].values[0]->value, 30);
  }
  const DeckRun run = run_deck(plate("E, EDNOR2, 3.\n", "\n0.1\n"));
  EXPECT_NEAR(run.displacement(4).x(), -0.06, 1e-12);  // sigma = -30
  EXPECT_NEAR(run.displacement(5).y(), 0.009, 1e-12);
  EXPECT_THAT(message(plate("E, EDNOR2, 3.\n", ", NODAL THICKNESS\n*NODAL THICKNESS\nN, 0.1\n")),
              HasSubstr("EDNOR needs shells of one thickness"));
}

/// A plate of `along` by `across` S8R, 10 x 1 x 0.2, clamped and loaded by 0.3 at its end.
std::string plate_of_s8r(int along, int across) {
  const int row = 2 * across + 1;
  const auto node = [&](int i, int j) { return i * row + j + 1; };
  std::string text = "*NODE, NSET=N\n", end;
  for (int i = 0; i <= 2 * along; ++i)
    for (int j = 0; j < row; ++j)
      if (i % 2 == 0 || j % 2 == 0)
        text +=
            fmt::format("{}, {:.17g}, {:.17g}, 0\n", node(i, j), 5.0 * i / along, 0.5 * j / across);
  text += "*ELEMENT, TYPE=S8R, ELSET=E\n";
  for (int e = 0; e < along * across; ++e) {
    const int i = 2 * (e / across), j = 2 * (e % across);
    text += fmt::format("{}, {}, {}, {}, {}, {}, {}, {}, {}\n", e + 1, node(i, j), node(i + 2, j),
                        node(i + 2, j + 2), node(i, j + 2), node(i + 1, j), node(i + 2, j + 1),
                        node(i + 1, j + 2), node(i, j + 1));
  }
  std::string held = "*NSET, NSET=START\n";
  for (int j = 0; j < row; ++j) {
    held += fmt::format("{},\n", node(0, j));
    end += fmt::format("{}, 3, {:.17g}\n", node(2 * along, j), 0.3 / row);
  }
  return text + held +
         "*MATERIAL, NAME=M\n*ELASTIC\n210000., 0.3\n*SHELL SECTION, ELSET=E, MATERIAL=M\n0.2\n"
         "*BOUNDARY\nSTART, 1, 6\n*STEP, NLGEOM\n*STATIC\n0.1, 1.\n*CLOAD\n" +
         end + "*END STEP\n";
}

/// Rows of one cell have modes that its points do not see, which buckle as it bends far.
TEST(InpThin, RowsOfS8RBendFarWithNlgeom) {
  const auto bent = [](int along, int across, std::size_t& iterations) {
    const DeckRun run = run_deck(plate_of_s8r(along, across));
    iterations = 0;
    for (const solve::IncrementRecord& record : run.result.steps.at(0).increments)
      iterations += record.iterations.size();
    return run.displacement(2 * along * (2 * across + 1) + across + 1).z();
  };
  std::size_t row = 0, others = 0;
  const double fine = bent(10, 2, others);
  EXPECT_NEAR(bent(4, 1, row), fine, 0.03 * fine);
  EXPECT_LT(row, 300U);  // 5388 with a millionth
  EXPECT_LT(others, 60U);
}

/// Of plates and a beam whose supports come and go, held along axes of their own and by equations:
/// what ccx 2.20 prints of nodes at the end of each step, seven digits.
TEST(InpThin, MiddlesAreTiedFromTheStepOnThatHoldsThem) {
  struct Printed {
    std::size_t step;
    int node;
    Vec3 u;
  };
  const std::vector<Printed> all{{0, 12, {-1.199774e-3, 3.306897e-3, 2.764490e-2}},
                                 {0, 48, {4.675991e-4, 1.739761e-3, 1.892713e-3}},
                                 {0, 65, {0, 2.544013e-1, 4.330359e-2}},
                                 {1, 12, {-1.444005e-4, 3.424017e-4, 2.371203e-3}},
                                 {1, 24, {6.527393e-4, 5.965546e-4, 2.044338e-3}},
                                 {1, 48, {4.537171e-4, 2.213450e-3, 5.703425e-4}},
                                 {1, 65, {0, 5.319438e-2, 5.019191e-3}},
                                 {2, 12, {-1.444005e-4, 3.424017e-4, 2.371203e-3}},
                                 {2, 65, {0, 5.182312e-2, 4.437820e-3}},
                                 {3, 12, {-1.199644e-3, 3.305520e-3, 4.222399e-4}},
                                 {3, 24, {1.901958e-3, 3.333301e-3, 4.480564e-4}},
                                 {3, 44, {1.331068e-3, 1.306144e-3, 2.721205e-4}},
                                 {3, 64, {0, -1.825902e-2, 0}}};
  const DeckRun run = run_deck(test_file("../../decks/own/supports_later.inp"));
  ASSERT_EQ(run.u.size(), 4U);
  for (const Printed& p : all)
    EXPECT_LT((run.displacement(p.node, p.step) - p.u).norm(), 1e-6 * p.u.norm())
        << "node " << p.node << ", step " << p.step + 1;
}

/// Each once, with the first step that holds the node, whatever becomes of the support.
TEST(InpThin, MiddlesAreTiedOnce) {
  const std::string plate =
      "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, .5, 0, 0\n6, 1, .5, 0\n"
      "7, .5, 1, 0\n8, 0, .5, 0\n*ELEMENT, TYPE=S8, ELSET=E\n1, 1, 2, 3, 4, 5, 6, 7, 8\n"
      "*MATERIAL, NAME=M\n*ELASTIC\n1000., 0.3\n*SHELL SECTION, ELSET=E, MATERIAL=M\n0.1\n";
  const auto step = [](const std::string& what) {
    return "*STEP\n*STATIC\n" + what + "*END STEP\n";
  };
  using Pair = std::pair<std::size_t, std::size_t>;
  const auto changes = [&](const std::string& second, const std::string& third) {
    const Built3 built =
        built_deck(plate + step("*BOUNDARY\n1, 1, 3\n") + step(second) + step(third));
    std::vector<Pair> all{{0, built.model.equations.size()}};
    for (const auto& change : built.model.body_changes)
      all.emplace_back(change.step, change.equations ? change.equations->size() : 0);
    return all;
  };
  const std::string held = "*BOUNDARY\n3, 2, 3\n";
  const std::size_t count = changes("", "").at(0).second;
  EXPECT_THAT(changes("", ""), ElementsAre(Pair(0, count)));
  EXPECT_THAT(changes("", "*BOUNDARY\n1, 1, 1, 0.5\n6, 1, 3\n"), ElementsAre(Pair(0, count)));
  EXPECT_THAT(changes(held, ""), ElementsAre(Pair(0, count), Pair(1, count + 2)));
  EXPECT_THAT(changes("", held), ElementsAre(Pair(0, count), Pair(2, count + 2)));
  EXPECT_THAT(changes(held, "*BOUNDARY, OP=NEW\n1, 1, 3\n3, 1\n"),
              ElementsAre(Pair(0, count), Pair(1, count + 2), Pair(2, count + 3)));
}

TEST(InpThin, SectionsAreSolids) {
  const Description d =
      described(elbow + "*STEP, NLGEOM\n*STATIC\n*DLOAD\nE, GRAV, 3, 0, 0, -1\n*END STEP\n");
  ASSERT_THAT(d.sections, SizeIs(1));
  EXPECT_EQ(d.sections[0].on.value, "E");
  EXPECT_EQ(d.sections[0].formulation.value, Formulation::enhanced);
  ASSERT_THAT(d.steps[0].body_force, SizeIs(1));
  EXPECT_EQ(d.steps[0].body_force[0].on.value, "E");
  EXPECT_EQ(d.steps[0].body_force[0].values[2]->value, -6);
}

TEST(InpThin, AKnotIsARigidBodyThatIsReleased) {
  const Description d =
      described(elbow + "*BOUNDARY\n2, 3\n2, 5, 6\n*STEP, NLGEOM\n*STATIC\n*END STEP\n");
  ASSERT_THAT(d.rigid, SizeIs(1));
  EXPECT_EQ(d.rigid[0].name.value, "knot_2");
  EXPECT_EQ(std::get<SetShape>(d.rigid[0].shape).set.value, "knot 2");
  EXPECT_THAT(d.rigid[0].reference->value, ElementsAre(1, 0, 0));
  ASSERT_THAT(d.steps[0].release, SizeIs(1));
  const Release& release = d.steps[0].release[0];
  EXPECT_EQ(release.on.value, "knot_2");
  EXPECT_THAT(release.of, ElementsAre(true, true, false, true, false, false));
  ASSERT_THAT(d.steps[0].prescribe, SizeIs(3));
  for (const Prescription& p : d.steps[0].prescribe) EXPECT_EQ(p.on.value, "knot_2");
}

TEST(InpThin, ASetWithAKnotIsSupportedInParts) {
  const Description d =
      described(elbow + "*BOUNDARY\nN, 3\nN, 5\n*STEP, NLGEOM\n*STATIC\n*END STEP\n");
  std::vector<std::string> on;
  for (const Prescription& p : d.steps[0].prescribe)
    for (std::size_t k = 0; k < p.values.size(); ++k)
      if (p.values[k]) on.push_back(p.on.value + std::to_string(k));
  EXPECT_THAT(on, ::testing::UnorderedElementsAre("N without knots2", "knot_22", "rotations of N1",
                                                  "knot_24"));
}

TEST(InpThin, MomentsTurnNodesAndKnots) {
  const Description d = described(
      elbow + "*STEP, NLGEOM\n*STATIC\n*CLOAD\n2, 4, 7.\n3, 6, 8.\n3, 1, 9.\n*END STEP\n");
  std::map<std::string, double> sizes;
  for (const Load& load : d.steps[0].forces)
    for (std::size_t k = 0; k < load.values.size(); ++k)
      if (load.values[k]) sizes[load.on.value + std::to_string(k)] = load.values[k]->value;
  EXPECT_THAT(sizes, ::testing::UnorderedElementsAre(::testing::Pair("knot_23", 7),
                                                     ::testing::Pair("node 30", 9),
                                                     ::testing::Pair("rotations of node 32", 8)));
}

TEST(InpThin, TemperaturesHaveGradients) {
  const Description d = described(
      elbow +
      "*EXPANSION\n1.e-5\n*INITIAL CONDITIONS, TYPE=TEMPERATURE\nN, 20., 3.\n*STEP\n*STATIC\n"
      "*TEMPERATURE\nN, 30.\n1, 40., 5., -6.\n*END STEP\n");
  ASSERT_THAT(d.initial_temperature, SizeIs(1));
  EXPECT_EQ(d.initial_temperature[0].values[1]->value, 3);
  EXPECT_EQ(d.initial_temperature[0].values[2]->value, 0);
  ASSERT_THAT(d.steps[0].temperature, SizeIs(2));
  EXPECT_EQ(d.steps[0].temperature[0].values[1]->value, 0);
  EXPECT_EQ(d.steps[0].temperature[1].values[1]->value, 5);
  EXPECT_EQ(d.steps[0].temperature[1].values[2]->value, -6);
}

TEST(InpThin, WhatIsNotExpandedStops) {
  const std::string step = "*STEP, NLGEOM\n*STATIC\n*END STEP\n";
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = elbow + step;
    return message(text.replace(text.find(from), from.size(), to));
  };
  EXPECT_EQ(message(elbow + step), "");
  EXPECT_THAT(with("SECTION=RECT", "SECTION=I"), HasSubstr("SECTION=I is not supported"));
  EXPECT_THAT(
      message("*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n*ELEMENT, TYPE=S3, ELSET=E\n1, 1, "
              "2, 3\n*MATERIAL, NAME=M\n*ELASTIC\n1, 0\n*SHELL SECTION, ELSET=E, "
              "COMPOSITE\n1., , M\n" +
              step),
      HasSubstr("its elements are of type S3; shells of layers are S6, S8 or S8R"));
  EXPECT_THAT(message(elbow + "*STEP, NLGEOM\n*STATIC\n*BOUNDARY\n1, 7\n*END STEP\n"),
              HasSubstr("expected directions 1 to 6, found 7 to 7"));
}

}  // namespace
}  // namespace osculate::deck
