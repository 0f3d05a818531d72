// Decks: loads of later steps replace those of the nodes and facets they act on, as in CalculiX.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cube_nodes.hpp"
#include "inp_run_test.hpp"
#include "osculate/deck/inp_translate.hpp"
#include "osculate/deck/parse.hpp"

namespace osculate::deck {
namespace {

using ::testing::HasSubstr;

/// Two cubes in a row that share the face x = 1; A is the top of the first, B that of the second.
std::string two_cubes(const std::string& cards) {
  return "*NODE, NSET=NALL\n" + cube_nodes(1, {0, 0, 0}) +
         "9, 2, 0, 0\n10, 2, 1, 0\n11, 2, 0, 1\n12, 2, 1, 1\n"
         "*ELEMENT, TYPE=C3D8, ELSET=EA\n1, 1, 2, 3, 4, 5, 6, 7, 8\n"
         "*ELEMENT, TYPE=C3D8, ELSET=EB\n2, 2, 9, 10, 3, 6, 11, 12, 7\n*ELSET, ELSET=EALL\nEA, EB\n"
         "*NSET, NSET=BASE\n1, 2, 3, 4, 9, 10\n*NSET, NSET=A\n5, 6, 7, 8\n"
         "*NSET, NSET=B\n6, 7, 11, 12\n*MATERIAL, NAME=M\n*ELASTIC\n1000., 0.3\n*DENSITY\n1.\n"
         "*SOLID SECTION, ELSET=EALL, MATERIAL=M\n*BOUNDARY\nBASE, 1, 3\n" +
         cards;
}
std::string a_step(const std::string& cards) { return "*STEP\n*STATIC\n" + cards + "*END STEP\n"; }
std::string forces_on(std::initializer_list<int> nodes, double size) {
  std::string lines;
  for (const int node : nodes) lines += fmt::format("{}, 3, {}\n", node, size);
  return lines;
}
/// Both have the same displacements after each step.
void expect_same(const std::string& one, const std::string& other) {
  const DeckRun a = run_deck(two_cubes(one)), b = run_deck(two_cubes(other));
  ASSERT_EQ(a.u.size(), b.u.size());
  for (std::size_t s = 0; s < a.u.size(); ++s) {
    EXPECT_GT(b.u[s].norm(), 0);
    EXPECT_LT((a.u[s] - b.u[s]).norm(), 1e-12 * b.u[s].norm()) << s;
  }
}
std::string text_of(const std::string& cards) {
  return to_yaml(translate_deck(two_cubes(cards), "a.inp").root);
}
std::string refusal_of(const std::string& cards) {
  try {
    (void)text_of(cards);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "no error";
}

// CalculiX' reactions of such steps: 4, 42, 420, 4040.
TEST(InpLoadParts, ForcesOfLaterStepsReplaceThoseOfTheirNodes) {
  expect_same(a_step("*CLOAD\nA, 3, 1.\n") + a_step("*CLOAD\nB, 3, 10.\n") +
                  a_step("*CLOAD\nA, 3, 100.\n") +
                  a_step("*CLOAD, OP=NEW\nB, 3, 10.\nA, 3, 1000.\n"),
              a_step("*CLOAD\n" + forces_on({5, 6, 7, 8}, 1)) +
                  a_step("*CLOAD\n" + forces_on({6, 7, 11, 12}, 10)) +
                  a_step("*CLOAD\n" + forces_on({5, 6, 7, 8}, 100)) +
                  a_step("*CLOAD\n" + forces_on({6, 7}, 1010) + forces_on({5, 8}, 1000) +
                         forces_on({11, 12}, 10)));
}

TEST(InpLoadParts, ForcesOfOneNodeAmongThoseOfItsSet) {
  expect_same(a_step("*CLOAD\nA, 3, 1.\n7, 2, 3.\n") + a_step("*CLOAD\n7, 3, 5.\n") +
                  a_step("*CLOAD\nB, 3, 2.\n"),
              a_step("*CLOAD\n7, 2, 3.\n" + forces_on({5, 6, 7, 8}, 1)) +
                  a_step("*CLOAD\n" + forces_on({7}, 5)) +
                  a_step("*CLOAD\n" + forces_on({6, 7, 11, 12}, 2)));
}

TEST(InpLoadParts, AmplitudesEndWhereTheirForcesAreReplaced) {
  const std::string table = "*AMPLITUDE, NAME=T\n0., 0., 0.5, 2., 1., 1.\n";
  expect_same(table + a_step("*CLOAD, AMPLITUDE=T\nA, 3, 1.\n") + a_step("*CLOAD\nB, 3, 10.\n"),
              table + a_step("*CLOAD, AMPLITUDE=T\n" + forces_on({5, 6, 7, 8}, 1)) +
                  a_step("*CLOAD\n" + forces_on({6, 7, 11, 12}, 10)));
  // CalculiX has an error, too
  EXPECT_THAT(refusal_of(table + a_step("*CLOAD\nA, 3, 1.\n") + a_step("*CLOAD\nB, 3, 10.\n") +
                         a_step("*CLOAD\nA, 3, 1.\n*CLOAD, AMPLITUDE=T\nB, 3, 10.\n")),
              HasSubstr("has this load with another amplitude in the same step"));
}

// CalculiX: a cell pulled by 5 with the amplitude 0.5 to 1 moves by 0.0182 at the end of its step
// and of the next one.
TEST(InpLoadParts, WhatAnAmplitudeOfAStepHasComeToStays) {
  const std::string table = "*AMPLITUDE, NAME=T\n0., 0., 1., 3.\n";
  struct Case {
    std::string keyword, at_one, at_three;
  };
  for (const Case& c : {Case{"*CLOAD", "A, 3, 1.\n", "A, 3, 3.\n"},
                        Case{"*DLOAD", "EALL, P2, 1.\n", "EALL, P2, 3.\n"},
                        Case{"*BOUNDARY", "B, 3, 3, 1e-3\n", "B, 3, 3, 3e-3\n"}}) {
    SCOPED_TRACE(c.keyword);
    const std::string first = table + a_step(c.keyword + ", AMPLITUDE=T\n" + c.at_one);
    expect_same(first + a_step(""), first + a_step(c.keyword + "\n" + c.at_three));
  }
  const std::string total = "*AMPLITUDE, NAME=T, TIME=TOTAL TIME\n0., 0., 2., 4.\n";
  expect_same(total + a_step("*CLOAD, AMPLITUDE=T\nA, 3, 1.\n") + a_step(""),
              a_step("*CLOAD\nA, 3, 2.\n") + a_step("*CLOAD\nA, 3, 4.\n"));
}

/// They act where the cubes are with NLGEOM, and soften vibrations about a state, as there.
TEST(InpLoadParts, CentrifugalForcesActWhereBodiesAre) {
  const std::string load =
      "\n*STATIC\n*DLOAD\nEALL, CENTRIF, 1., 0., 0., 0., 0., 0., 1.\n*END STEP\n";
  const auto first_cell_moves = [&](const std::string& step) {
    const DeckRun run = run_deck(two_cubes(step + load));
    return run.built.model.steps[0].centrifugal.at(0).cells->at(0).moves;
  };
  EXPECT_TRUE(first_cell_moves("*STEP, NLGEOM"));
  EXPECT_FALSE(first_cell_moves("*STEP"));
}

TEST(InpLoadParts, PressuresOfLaterStepsReplaceThoseOfTheirFacets) {
  expect_same(a_step("*DLOAD\nEALL, P2, 1.\n") + a_step("*DLOAD\n2, P2, 10.\n") +
                  a_step("*DLOAD\nEA, P2, 100.\n2, P2, 7.\n2, P2, 3.\n"),
              a_step("*DLOAD\n1, P2, 1.\n2, P2, 1.\n") + a_step("*DLOAD\n2, P2, 10.\n") +
                  a_step("*DLOAD\n1, P2, 100.\n2, P2, 10.\n"));
}

TEST(InpLoadParts, SetsOfWhichNoneReplacesTheOtherStayWhole) {
  const auto has_parts = [](const std::string& cards) {
    return text_of(cards).find("\nsets:") != std::string::npos;
  };
  const std::string a = "*CLOAD\nA, 3, 1.\n", b = "*CLOAD\nB, 3, 2.\n";
  EXPECT_TRUE(has_parts(a_step(a) + a_step(b)));
  EXPECT_FALSE(has_parts(a_step(a + b) + a_step(a + b)));
  EXPECT_FALSE(has_parts(a_step(a) + a_step("*CLOAD\nB, 2, 2.\n")));
  EXPECT_FALSE(has_parts(a_step(a) + a_step("*CLOAD, OP=NEW\nB, 3, 2.\n")));
  EXPECT_FALSE(has_parts(a_step("*DLOAD\nEALL, P2, 1.\n") + a_step("*DLOAD\n2, P3, 10.\n")));
}

std::string held(std::initializer_list<int> nodes, int direction, double by = 0) {
  std::string lines;
  for (const int node : nodes) lines += fmt::format("{0}, {1}, {1}, {2}\n", node, direction, by);
  return lines;
}

// CalculiX' displacements of the deck supports_replaced: the last line of a node counts.
TEST(InpLoadParts, SupportsOfLaterLinesReplaceThoseOfTheirNodes) {
  const std::string a = "*BOUNDARY\nA, 3, 3, 1e-3\n";
  expect_same(a_step(a + "7, 3, 3, 5e-3\n") + a_step("*BOUNDARY\nB, 3, 3, 2e-3\n"),
              a_step("*BOUNDARY\n" + held({5, 6, 8}, 3, 1e-3) + held({7}, 3, 5e-3)) +
                  a_step("*BOUNDARY\n" + held({6, 7, 11, 12}, 3, 2e-3)));
  expect_same(a + a_step("*BOUNDARY\n7, 3, 3, 5e-3\n"),
              a_step("*BOUNDARY\n" + held({5, 6, 8}, 3, 1e-3) + held({7}, 3, 5e-3)));
  // both end, and share nodes 6 and 7
  expect_same(a_step("*BOUNDARY\nA, 3, 3, 1e-3\nB, 3, 3, 2e-3\n") +
                  a_step("*BOUNDARY, OP=NEW\nBASE, 1, 3\n*CLOAD\nA, 3, 1.\n"),
              a_step("*BOUNDARY\n" + held({5, 8}, 3, 1e-3) + held({6, 7, 11, 12}, 3, 2e-3)) +
                  a_step("*BOUNDARY, OP=NEW\nBASE, 1, 3\n*CLOAD\nA, 3, 1.\n"));
}

// CalculiX' displacement there: 0.0038 under 1 at each node of a cube with E = 1000.
TEST(InpLoadParts, NewSupportsOfTheFirstStepEndThoseBeforeIt) {
  const std::string before = "*BOUNDARY\nA, 1, 3\nB, 2, 2, 1e-2\n";
  const std::string held_again = "*BOUNDARY, OP=NEW\nBASE, 1, 3\n";
  const std::string pulled = "*CLOAD\nA, 3, 1.\n";
  expect_same(before + a_step(held_again + pulled), a_step(pulled));
  expect_same(a_step(pulled) + before + a_step(held_again + pulled), a_step(pulled) + a_step(""));
  // a support of the step before and one said behind it both end
  expect_same(
      a_step("*BOUNDARY\nA, 3, 3, 1e-3\n") + "*BOUNDARY\nA, 3, 3, 2e-3\n" +
          a_step(held_again + "B, 3, 3, 1e-3\n"),
      a_step("*BOUNDARY\nA, 3, 3, 1e-3\n") + a_step(held_again + held({6, 7, 11, 12}, 3, 1e-3)));
}

TEST(InpLoadParts, SupportsThatAgreeStayWhole) {
  const auto has_parts = [](const std::string& cards) {
    return text_of(cards).find("\nsets:") != std::string::npos;
  };
  EXPECT_FALSE(has_parts(a_step("*BOUNDARY\nA, 1, 3\nB, 3, 3\n") + a_step("")));
  EXPECT_FALSE(has_parts(a_step("*BOUNDARY\nA, 3, 3, 1e-3\nB, 2, 2\n")));
  EXPECT_TRUE(has_parts(a_step("*BOUNDARY\nA, 3, 3, 1e-3\nB, 3, 3\n")));
}

/// CalculiX replaces GRAV of the same set and direction, and adds others.
TEST(InpLoadParts, GravityOfOtherSetsAndDirectionsAdds) {
  const auto down = [](const std::string& on, double size) {
    return fmt::format("{}, GRAV, {}, 0, 0, -1\n", on, size);
  };
  const DeckRun run = run_deck(
      two_cubes(a_step("*DLOAD\n" + down("EALL", 1)) +
                a_step("*DLOAD\n" + down("EB", 10) + "EALL, GRAV, 3, 1, 0, 0\n") +
                a_step("*DLOAD\n" + down("EALL", 7)) + a_step("*DLOAD\nEALL, GRAV, 5, 1, 0, 0\n") +
                a_step("*DLOAD, OP=NEW\nEB, GRAV, 2, 1, 0, 0\n")));
  const std::array<Vec3, 5> weights{
      {{0, 0, 2}, {-6, 0, 12}, {-6, 0, 24}, {-10, 0, 24}, {-2, 0, 0}}};
  for (std::size_t s = 0; s < weights.size(); ++s)  // half of a cube rests on the nodes of its base
    EXPECT_LT((run.reaction_of("NALL", s) - weights[s]).norm(), 1e-9) << s;
}

/// The sum, as in Abaqus, which a note says; CalculiX takes one of them.
TEST(InpLoadParts, SeveralRotationsOfAnElementAddUp) {
  const std::string axis = ", 0, 0, 0, 0, 0, 1\n", other = ", 1, 0, 0, 0, 0.6, 0.8\n";
  const std::string first = "*DLOAD\nEALL, CENTRIF, 1." + axis, second = "EB, CENTRIF, 2." + other;
  const auto moved = [](const std::string& cards) { return run_deck(two_cubes(cards)).u.back(); };
  const Eigen::VectorXd one = moved(a_step(first)), two = moved(a_step("*DLOAD\n" + second));
  ASSERT_GT(one.norm(), 0);
  ASSERT_GT(two.norm(), 0);
  EXPECT_LT((moved(a_step(first + second)) - one - two).norm(), 1e-12 * one.norm());
  EXPECT_LT((moved(a_step(first) + a_step("*DLOAD\n" + second)) - one - two).norm(),
            1e-12 * one.norm());
  EXPECT_LT((moved(a_step(first) + a_step("*DLOAD, OP=NEW\n" + second)) - two).norm(),
            1e-12 * one.norm());
  const std::string all = "EALL, CENTRIF, 2." + other;  // of one set
  const Eigen::VectorXd last = moved(a_step("*DLOAD\n" + all));
  EXPECT_LT((moved(a_step(first + all)) - one - last).norm(), 1e-12 * one.norm());
  EXPECT_LT((moved(a_step(first) + a_step("*DLOAD\n" + all)) - last).norm(), 1e-12 * one.norm());
  const auto told = [](const std::string& cards) {
    const TranslatedDeck deck = translate_deck(two_cubes(cards), "a.inp");
    return std::ranges::any_of(deck.notes, [](const std::string& note) {
      return note.find("CalculiX takes one of them") != std::string::npos;
    });
  };
  EXPECT_TRUE(told(a_step(first + second)));
  EXPECT_TRUE(told(a_step(first + "EALL, CENTRIF, 2." + other)));
  EXPECT_FALSE(told(a_step(first) + a_step("*DLOAD\nEALL, CENTRIF, 2." + axis)));
  EXPECT_FALSE(told(a_step(first) + a_step("*DLOAD, OP=NEW\nEB, CENTRIF, 2." + axis)));
  EXPECT_FALSE(told(a_step("*DLOAD\nEA, CENTRIF, 1." + axis + "EB, CENTRIF, 2." + other)));
}

const std::string mass = "*ELEMENT, TYPE=MASS, ELSET=EM\n100, 7\n*MASS, ELSET=EM\n4.\n";

TEST(InpLoadParts, WeightsOfMassesBesideForcesOfTheirNode) {
  const DeckRun run = run_deck(two_cubes(
      mass + a_step("*DLOAD\nEM, GRAV, 10., 0, 0, -2.\n*CLOAD\n7, 3, 3.\n7, 1, 2.\n") +
      a_step("*CLOAD, OP=NEW\n") + a_step("*DLOAD\nEM, GRAV, 5., 0, 0, -1.\n") +
      a_step("*DLOAD\nEM, GRAV, 2., 1, 0, 0\n") + a_step("*CLOAD\n7, 3, 1.\n*DLOAD, OP=NEW\n")));
  const std::array<Vec3, 5> sums{{{-2, 0, 37}, {0, 0, 40}, {0, 0, 20}, {-8, 0, 20}, {0, 0, -1}}};
  for (std::size_t s = 0; s < sums.size(); ++s)
    EXPECT_LT((run.reaction_of("BASE", s) - sums[s]).norm(), 1e-9) << s;
}

/// A rigid body takes their sum: one that has come to its end has no common amplitude with a new
/// one.
TEST(InpLoadParts, WeightsOfMassesOfRigidBodiesBesideForces) {
  const std::string body =
      mass + "*RIGID BODY, ELSET=EB, REF NODE=7\n*AMPLITUDE, NAME=R\n0, 0, 1, 1\n";
  const std::string weight = "*DLOAD, AMPLITUDE=R\nEM, GRAV, 10., 0, 0, -2.\n";
  const std::string force = "*CLOAD, AMPLITUDE=R\n7, 3, 3.\n";
  const std::string sum =
      to_yaml(translate_deck(two_cubes(body + a_step(weight + force)), "a.inp").root);
  EXPECT_THAT(sum, HasSubstr("{on: body_of_node_7, fz: -37, amplitude: R_1}"));
  try {
    (void)translate_deck(two_cubes(body + a_step(weight) + a_step(force)), "a.inp");
    FAIL() << "taken";
  } catch (const core::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("with another amplitude"));
  }
}

/// Forces of the node are along its axes, its weight is not.
TEST(InpLoadParts, WeightsOfMassesWithAxesOfTheirOwn) {
  for (const char* const axes : {"TYPE=C\n0, 0, 0, 0, 0, 1\n", "TYPE=R\n1, 1, 0, 0, 1, 0\n"}) {
    const DeckRun run = run_deck(
        two_cubes(std::string("*TRANSFORM, NSET=A, ") + axes + mass +
                  a_step("*DLOAD\nEM, GRAV, 10., 1., 0., -1.\n*CLOAD\n7, 1, 3.\n7, 3, 3.\n")));
    const double along = 40 / std::sqrt(2.0), radial = 3 / std::sqrt(2.0);
    EXPECT_LT((run.reaction_of("BASE") - Vec3(-along - radial, -radial, along - 3)).norm(), 1e-9);
  }
}

TEST(InpLoadParts, TemperaturesOfLaterStepsReplaceThoseOfTheirNodes) {
  const auto cubes = [&](const std::string& cards) {
    std::string text = two_cubes(cards);
    const std::size_t at = text.find("*SOLID SECTION");
    return text.insert(at, "*EXPANSION\n1.E-3\n");
  };
  const auto on = [](std::initializer_list<int> nodes, double size) {
    std::string lines = "*TEMPERATURE\n";
    for (const int node : nodes) lines += fmt::format("{}, {}\n", node, size);
    return lines;
  };
  const DeckRun sets =
      run_deck(cubes(a_step("*TEMPERATURE\nA, 1.\n") + a_step("*TEMPERATURE\nB, 10.\n") +
                     a_step("*TEMPERATURE\nA, 100.\n")));
  const DeckRun nodes =
      run_deck(cubes(a_step(on({5, 6, 7, 8}, 1)) + a_step(on({6, 7, 11, 12}, 10)) +
                     a_step(on({5, 6, 7, 8}, 100))));
  for (std::size_t s = 0; s < 3; ++s)
    EXPECT_LT((sets.u[s] - nodes.u[s]).norm(), 1e-12 * nodes.u[s].norm()) << s;
}

}  // namespace
}  // namespace osculate::deck
