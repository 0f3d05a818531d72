// Axes, multi-point constraints, rigid bodies and their loads in decks.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <tuple>

#include "cube_nodes.hpp"
#include "inp_run_test.hpp"
#include "osculate/deck/inp_translate.hpp"

namespace osculate::deck {
namespace {

using ::testing::HasSubstr;

/// A bar of `count` cubes along an axis of a frame turned about z, E = 100, nu = 0.
/// Nodes 10 k + 1 to 10 k + 4 lie in the plane k.
std::string bar(int count, double degrees = 0, double nu = 0) {
  const double c = std::cos(degrees * std::numbers::pi / 180),
               s = std::sin(degrees * std::numbers::pi / 180);
  std::string text = "*NODE, NSET=NALL\n";
  for (int k = 0; k <= count; ++k)
    for (int i = 0; i < 4; ++i) {
      const double x = k, y = i == 1 || i == 2 ? 1 : 0, z = i >= 2 ? 1 : 0;
      text += fmt::format("{}, {:.17g}, {:.17g}, {}\n", 10 * k + i + 1, c * x - s * y,
                          s * x + c * y, z);
    }
  text += fmt::format("*NODE\n901, {}, 0.5, 0.5\n902, 0, 0, 0\n*ELEMENT, TYPE=C3D8, ELSET=BAR\n",
                      count);
  for (int k = 0; k < count; ++k)
    text += fmt::format("{}, {}, {}, {}, {}, {}, {}, {}, {}\n", k + 1, 10 * k + 1, 10 * k + 2,
                        10 * k + 3, 10 * k + 4, 10 * k + 11, 10 * k + 12, 10 * k + 13, 10 * k + 14);
  text += "*NSET, NSET=START\n1, 2, 3, 4\n*NSET, NSET=FINISH\n";
  for (int i = 1; i <= 4; ++i) text += fmt::format("{},\n", 10 * count + i);
  text += "*SURFACE, NAME=TIP\n" + fmt::format("{}, S2\n", count);
  text += fmt::format("*MATERIAL, NAME=M\n*ELASTIC\n100., {}\n*DENSITY\n3.\n", nu);
  return text + "*SOLID SECTION, ELSET=BAR, MATERIAL=M\n";
}
const std::string fixed = "*BOUNDARY\nSTART, 1, 3\n";
std::string step(const std::string& what, const std::string& parameters = "") {
  return "*STEP" + parameters + "\n*STATIC\n1., 1.\n" + what + "*END STEP\n";
}

TEST(InpConstraints, AxesTurnWhatIsPrescribedReleasedAndLoaded) {
  const double c = std::cos(std::numbers::pi / 6), s = 0.5;
  const DeckRun run =
      run_deck(bar(2, 30, 0.25) + "*TRANSFORM, NSET=NALL, TYPE=R\n" +
               fmt::format("{:.17g}, {}, 0, {}, {:.17g}, 0\n", c, s, -s, c) +
               "*BOUNDARY\nSTART, 1\n1, 2, 3\n2, 3\n11, 2, 3\n21, 2, 3\n12, 3\n22, 3\n" +
               step("*BOUNDARY\nFINISH, 1, 1, 0.1\n") +
               step("*BOUNDARY, OP=NEW\nSTART, 1\n1, 2, 3\n2, 3\n*CLOAD\nFINISH, 1, -0.5\n"));
  // stretched by 0.05 along the bar: 5 on an area of 1
  const Vec3 force = run.reaction_of("FINISH");
  EXPECT_NEAR(force.x(), 5 * c, 1e-9);
  EXPECT_NEAR(force.y(), 5 * s, 1e-9);
  EXPECT_NEAR(run.reaction_of("START").x(), -5 * c, 1e-9);
  const Vec3 far_corner = run.displacement(23);  // across the bar -nu 0.05 in both directions
  EXPECT_NEAR(far_corner.x(), 0.1 * c + 0.0125 * s, 1e-12);
  EXPECT_NEAR(far_corner.y(), 0.1 * s - 0.0125 * c, 1e-12);
  EXPECT_NEAR(far_corner.z(), -0.0125, 1e-12);
  // released and pushed by 2 in total
  const Vec3 pushed = run.displacement(21, 1);
  EXPECT_NEAR(pushed.x(), -0.04 * c, 1e-12);
  EXPECT_NEAR(pushed.y(), -0.04 * s, 1e-12);
  EXPECT_NEAR(run.reaction_of("FINISH", 1).norm(), 0, 1e-9);
  EXPECT_NEAR(run.reaction_of("START", 1).x(), 2 * c, 1e-9);
}

/// Radial displacement of a ring of hexahedra by its own coordinates: the same everywhere.
TEST(InpConstraints, CylindricalAxesFollowTheNodes) {
  const DeckRun run =
      run_deck(bar(1) + "*TRANSFORM, NSET=NALL, TYPE=C\n-1, -1, 0, -1, -1, 1\n" +
               step("*BOUNDARY\nNALL, 1, 1, 0.01\nNALL, 2, 2, 0.02\nNALL, 3, 3, 0\n"));
  for (const int number : {1, 2, 3, 4, 11, 12, 13, 14}) {
    const Vec3 x = run.built.model.mesh.nodes[static_cast<std::size_t>(run.node(number))];
    const Vec3 radial = Vec3(x.x() + 1, x.y() + 1, 0).normalized(),
               around = Vec3(-radial.y(), radial.x(), 0);
    EXPECT_LT((run.displacement(number) - 0.01 * radial - 0.02 * around).norm(), 1e-13);
  }
}

TEST(InpConstraints, EquationsMeanLocalDirections) {
  const double c = std::cos(std::numbers::pi / 6), s = 0.5;
  const DeckRun run = run_deck(bar(1, 30) + "*TRANSFORM, NSET=FINISH, TYPE=R\n" +
                               fmt::format("{:.17g}, {}, 0, {}, {:.17g}, 0\n", c, s, -s, c) +
                               "*EQUATION\n2\n11, 1, 1., 901, 1, -1.\n2\n12, 1, 1., 901, 1, -1.\n"
                               "2\n13, 1, 1., 901, 1, -1.\n2\n14, 1, 1., 901, 1, -1.\n" +
                               fixed + step("*BOUNDARY\nFINISH, 2, 3\n*CLOAD\n901, 1, 5.\n"));
  for (const int number : {11, 12, 13, 14})
    EXPECT_LT((run.displacement(number) - 0.05 * Vec3(c, s, 0)).norm(), 1e-12);
  EXPECT_NEAR(run.displacement(901).x(), 0.05, 1e-12);
}

TEST(InpConstraints, RigidBodyIsMovedAndTurnedByItsNodes) {
  const std::string body = "*RIGID BODY, NSET=FINISH, REF NODE=901, ROT NODE=902\n";
  const DeckRun pulled = run_deck(bar(2) + body + fixed + step("*CLOAD\n901, 1, 5.\n"));
  EXPECT_NEAR(pulled.displacement(901).x(), 0.1, 1e-9);
  EXPECT_NEAR(pulled.displacement(22).x(), 0.1, 1e-9);
  EXPECT_NEAR(pulled.reaction_of("START").x(), -5, 1e-9);
  // half a turn about z and back, of any size
  const DeckRun turned =
      run_deck(bar(1) + "*RIGID BODY, ELSET=BAR, REF NODE=901, ROT NODE=902\n" +
               step("*BOUNDARY\n901, 1, 3\n902, 1, 2\n902, 3, 3, 3.141592653589793\n", ", NLGEOM"));
  EXPECT_LT((turned.displacement(12) - Vec3(0, -1, 0)).norm(), 1e-12);
  EXPECT_LT((turned.displacement(1) - Vec3(2, 1, 0)).norm(), 1e-12);
}

/// Without NLGEOM a rigid body moves by theta x r, which strains no cell of small strain.
TEST(InpConstraints, RigidBodiesTurnLinearlyWithoutNlgeom) {
  const Vec3 theta(0.1, -0.05, 0.08), far(0.2, 0.1, -0.3);
  const auto places = [](const DeckRun& run) { return run.built.model.reference; };
  for (const std::string body :
       {"*RIGID BODY, NSET=FINISH, REF NODE=901, ROT NODE=902\n",
        "*COUPLING, REF NODE=901, SURFACE=TIP, CONSTRAINT NAME=C\n*KINEMATIC\n1, 6\n",
        "*COUPLING, REF NODE=901, SURFACE=TIP, CONSTRAINT NAME=C\n*DISTRIBUTING\n1, 6\n"}) {
    const bool by_nodes = body.starts_with("*RIGID");
    const int turning = by_nodes ? 902 : 901, first = by_nodes ? 1 : 4;
    std::string moves = "*BOUNDARY\n";
    for (int i = 0; i < 3; ++i)
      moves += fmt::format("901, {0}, {0}, {1}\n{2}, {3}, {3}, {4}\n", i + 1, far[i], turning,
                           first + i, theta[i]);
    const DeckRun run = run_deck(bar(2) + body + step(moves));
    const Vec3 centre = places(run)[static_cast<std::size_t>(run.node(901))];
    for (const int number : {1, 2, 3, 4, 11, 12, 13, 14, 21, 22, 23, 24}) {
      const Vec3 arm = places(run)[static_cast<std::size_t>(run.node(number))] - centre;
      EXPECT_LT((run.displacement(number) - far - theta.cross(arm)).norm(), 1e-12) << body;
    }
    EXPECT_LT(run.reaction.at(0).norm(), 1e-10) << body;
  }
}

TEST(InpConstraints, KinematicCouplingIsARigidBody) {
  const std::string text = bar(2) +
                           "*COUPLING, REF NODE=901, SURFACE=TIP, CONSTRAINT NAME=C\n*KINEMATIC\n"
                           "1, 3\n" +
                           fixed + step("*CLOAD\n901, 1, 5.\n");
  const DeckRun run = run_deck(text);
  for (const int number : {21, 22, 23, 24, 901})
    EXPECT_NEAR(run.displacement(number).x(), 0.1, 1e-9);
}

std::string message_of(const std::string& text) {
  try {
    (void)translate_deck(text, "a.inp");
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "no error";
}

/// A cube, whose top is coupled with a node above it.
std::string coupled_cube(const std::string& directions, const std::string& rest,
                         const std::string& parameters = "", const std::string& orientation = "") {
  return "*NODE, NSET=NALL\n" + cube_nodes(1, {0, 0, 0}) +
         "20, 0.5, 0.7, 1.5\n*ELEMENT, TYPE=C3D8, ELSET=E\n1, 1, 2, 3, 4, 5, 6, 7, 8\n"
         "*SURFACE, NAME=TOP\nE, S2\n*MATERIAL, NAME=M\n*ELASTIC\n1000., 0.3\n"
         "*SOLID SECTION, ELSET=E, MATERIAL=M\n*NSET, NSET=BASE\n1, 2, 3, 4\n*BOUNDARY\n"
         "BASE, 1, 3\n*ORIENTATION, NAME=O, SYSTEM=RECTANGULAR\n1., 1., 0., -1., 1., 0.\n"
         "*COUPLING, CONSTRAINT NAME=C, REF NODE=20, SURFACE=TOP" +
         orientation + "\n*KINEMATIC\n" + directions + "*BOUNDARY\n20, 2, 2\n20, 4, 4\n" +
         step(rest, parameters);
}

/// Numbers of CalculiX 2.20.
TEST(InpConstraints, KinematicCouplingOfSomeDirections) {
  const DeckRun run = run_deck(coupled_cube("1, 1\n3\n", "*CLOAD\n20, 1, 1.\n"));
  const std::array<Vec3, 4> there{{{4.630476e-3, 2.278095e-3, 3.763810e-3},
                                   {4.630476e-3, -2.278095e-3, -3.763810e-3},
                                   {8.097143e-3, -4.952381E-04, -3.763810e-3},
                                   {8.097143e-3, 4.952381E-04, 3.763810e-3}}};
  for (int k = 0; k < 4; ++k)
    EXPECT_LT((run.displacement(5 + k) - there[static_cast<std::size_t>(k)]).norm(), 1e-8) << k;
  EXPECT_NEAR(run.displacement(20).x(), 1.082095e-2, 1e-8);
  EXPECT_NEAR(run.reaction_of("BASE").x(), -1, 1e-9);
  EXPECT_THAT(message_of(coupled_cube("1, 1\n", "", ", NLGEOM")),
              HasSubstr("some directions alone are not supported with NLGEOM"));
  EXPECT_THAT(message_of(coupled_cube("4, 6\n", "")), HasSubstr("couples no displacement"));
}

/// Numbers of CalculiX 2.20. Where all displacements follow axes do not matter.
TEST(InpConstraints, KinematicCouplingAlongAxes) {
  const DeckRun run =
      run_deck(coupled_cube("1, 1\n3\n", "*CLOAD\n20, 1, 1.\n", "", ", ORIENTATION=O"));
  const std::array<Vec3, 4> there{{{4.395068e-3, 4.414064e-3, 3.609132e-3},
                                   {4.903196e-3, 4.392694e-4, -3.609132e-3},
                                   {7.168402e-3, 1.640731e-3, -3.609132e-3},
                                   {8.369863e-3, 3.905936e-3, 3.609132e-3}}};
  for (int k = 0; k < 4; ++k)
    EXPECT_LT((run.displacement(5 + k) - there[static_cast<std::size_t>(k)]).norm(), 1e-8) << k;
  EXPECT_NEAR(run.displacement(20).x(), 1.311160e-2, 1e-8);
  const DeckRun with =
      run_deck(coupled_cube("1, 3\n", "*CLOAD\n20, 1, 1.\n", "", ", ORIENTATION=O"));
  const DeckRun without = run_deck(coupled_cube("1, 3\n", "*CLOAD\n20, 1, 1.\n"));
  EXPECT_EQ(with.displacement(7), without.displacement(7));
  EXPECT_THAT(message_of(coupled_cube("1, 1\n", "", "", ", ORIENTATION=P")),
              HasSubstr("unknown ORIENTATION 'P'"));
}

/// Abaqus: nodes that move as another one, and nodes of rigid bodies by more than one set.
TEST(InpConstraints, PinnedAndTiedNodes) {
  for (const char* const kind : {"PIN", "TIE"}) {
    const DeckRun run = run_deck(bar(2) + "*MPC\n" + kind + ", FINISH, 901\n" + kind +
                                 ", 11, 12\n" + fixed + step("*CLOAD\n901, 1, 8.\n11, 2, 1.\n"));
    for (const int number : {21, 22, 23, 24})
      EXPECT_LT((run.displacement(number) - run.displacement(901)).norm(), 1e-14);
    EXPECT_LT((run.displacement(11) - run.displacement(12)).norm(), 1e-14);
    EXPECT_GT(run.displacement(12).y(), 0.001);
    EXPECT_NEAR(run.reaction_of("START").x(), -8, 1e-9);
  }
  EXPECT_THAT(message_of(bar(2) + "*MPC\nPIN, 901, FINISH\n" + fixed + step("")),
              HasSubstr("expected one node, 'FINISH' has several"));
  EXPECT_THAT(message_of(bar(2) + "*MPC\nLINK, 901, 1\n" + fixed + step("")),
              HasSubstr("MEANROT, PIN or TIE"));
  const DeckRun body =
      run_deck(bar(2) +
               "*NSET, NSET=P\n21, 22\n*NSET, NSET=T\n23, 24\n*RIGID BODY, REF NODE=901, "
               "PIN NSET=P, TIE NSET=T\n" +
               fixed + step("*CLOAD\n901, 1, 8.\n"));
  for (const int number : {21, 22, 23, 24})
    EXPECT_NEAR(body.displacement(number).x(), body.displacement(901).x(), 1e-9);
  EXPECT_THAT(message_of(bar(2) + "*RIGID BODY, REF NODE=901\n" + fixed + step("")),
              HasSubstr("expected NSET= or ELSET="));
}

/// Force and moment at the middle of the face arrive at the clamped end.
TEST(InpConstraints, DistributingCouplingSharesForcesOut) {
  const DeckRun run =
      run_deck(bar(2) +
               "*COUPLING, REF NODE=901, SURFACE=TIP, CONSTRAINT NAME=C\n"
               "*DISTRIBUTING\n" +
               fixed + step("*CLOAD\n901, 1, 5.E-3\n901, 2, 1.E-5\n901, 6, 3.E-5\n"));
  const Vec3 sum = run.reaction_of("START");
  EXPECT_NEAR(sum.x(), -5e-3, 1e-10);
  EXPECT_NEAR(sum.y(), -1e-5, 1e-10);
  double moment = 0;  // about the reference node
  for (const int number : {1, 2, 3, 4}) {
    const Index n = run.node(number);
    const Vec3 arm = run.built.model.mesh.nodes[static_cast<std::size_t>(n)] - Vec3(2, 0.5, 0.5) -
                     run.displacement(901);
    moment += arm.cross(Vec3(run.reaction[0].segment<3>(3 * n))).z();
  }
  EXPECT_NEAR(moment, -3e-5, 1e-7);  // small strains: arms of the undeformed bar inside of it
  Vec3 mean = Vec3::Zero();
  for (const int number : {21, 22, 23, 24}) mean += 0.25 * run.displacement(number);
  EXPECT_LT((run.displacement(901) - mean).norm(), 1e-12);
  EXPECT_NEAR(mean.x(), 1e-4, 1e-9);
}

TEST(InpConstraints, DistributingCouplingElementIsTheMeanOfItsNodes) {
  const DeckRun run = run_deck(bar(2) +
                               "*ELEMENT, TYPE=DCOUP3D, ELSET=D\n77, 901\n"
                               "*DISTRIBUTING COUPLING, ELSET=D\nFINISH, 1.\n"
                               "*SOLID SECTION, ELSET=D, MATERIAL=M\n" +
                               fixed + step("*CLOAD\n901, 1, 8.\n901, 2, 0.1\n"));
  Vec3 mean = Vec3::Zero();
  for (const int number : {21, 22, 23, 24}) mean += 0.25 * run.displacement(number);
  EXPECT_LT((run.displacement(901) - mean).norm(), 1e-12);
  EXPECT_NEAR(mean.x(), 0.16, 1e-9);
  EXPECT_NEAR(run.reaction_of("START").x(), -8, 1e-9);
  EXPECT_NEAR(run.reaction_of("START").y(), -0.1, 1e-9);
}

/// The places of nodes after a load that would take them apart.
TEST(InpConstraints, NodesStayInAPlaneOnALineAndAtTheirDistance) {
  const std::string load = step("*CLOAD\n22, 1, 4.\n23, 2, 3.\n", ", NLGEOM");
  const auto place = [](const DeckRun& run, int number) {
    return Vec3(run.built.model.mesh.nodes[static_cast<std::size_t>(run.node(number))] +
                run.displacement(number));
  };
  const auto volume = [&](const DeckRun& run) {
    return (place(run, 22) - place(run, 21))
        .cross(Vec3(place(run, 23) - place(run, 21)))
        .dot(place(run, 24) - place(run, 21));
  };
  const auto bend = [&](const DeckRun& run) {
    return (place(run, 12) - place(run, 2)).cross(Vec3(place(run, 22) - place(run, 2))).norm();
  };
  const auto stretch = [&](const DeckRun& run) {
    return (place(run, 21) - place(run, 23)).norm() - std::sqrt(2.0);
  };
  const DeckRun free = run_deck(bar(2) + fixed + load);
  EXPECT_GT(std::abs(volume(free)), 1e-3);
  EXPECT_GT(bend(free), 1e-2);
  EXPECT_GT(std::abs(stretch(free)), 1e-3);
  const DeckRun plane = run_deck(bar(2) + fixed + "*MPC\nPLANE, FINISH\n" + load);
  EXPECT_NEAR(volume(plane), 0, 1e-9);
  EXPECT_NEAR(plane.reaction_of("START").x(), -4, 1e-7);
  const DeckRun line = run_deck(bar(2) + fixed + "*MPC\nSTRAIGHT, 2, 12, 22\n" + load);
  EXPECT_NEAR(bend(line), 0, 1e-9);
  const DeckRun rod = run_deck(bar(2) + fixed + "*MPC\nBEAM, 21, 23\n" + load);
  EXPECT_NEAR(stretch(rod), 0, 1e-9);
  EXPECT_NEAR(rod.reaction_of("START").y(), -3, 1e-7);
}

// As CalculiX does: l = 1.1 by F = E A l (l^2 - 1) / 2, with small strains by F = E A (l - 1).
TEST(InpConstraints, ConditionsOfNodesBringFiniteStrains) {
  const std::string pull = "*CLOAD\nFINISH, 1, 2.8875\n", beam = "*MPC\nBEAM, 21, 22\n";
  constexpr double far = 2 * 0.1, small = 2 * 0.1155;
  const auto run = [&](const std::string& mpc, const std::string& steps) {
    return run_deck(bar(2) + fixed + mpc + steps);
  };
  for (const std::string& mpc :
       {beam, std::string("*MPC\nSTRAIGHT, 1, 11, 21\n"), std::string("*MPC\nPLANE, FINISH\n")}) {
    EXPECT_NEAR(run(mpc, step(pull)).displacement(21).x(), far, 1e-9) << mpc;
    EXPECT_NEAR(run(mpc, step(pull, ", NLGEOM=NO")).displacement(21).x(), small, 1e-9) << mpc;
  }
  EXPECT_NEAR(run("", step(pull)).displacement(21).x(), small, 1e-9);
  EXPECT_NEAR(run("*MPC\nPIN, 21, 22\n", step(pull)).displacement(21).x(), small, 1e-9);
  const DeckRun two = run(beam, step("*CLOAD\n21, 1, 0.\n", ", NLGEOM=NO") + step(pull));
  EXPECT_NEAR(two.displacement(21, 1).x(), small, 1e-9);
  const auto notes = [&](const std::string& parameters) {
    return translate_deck(bar(2) + fixed + beam + step(pull, parameters), "a.inp").notes;
  };
  EXPECT_THAT(notes(""), ::testing::Contains(HasSubstr("makes displacements and strains those of "
                                                       "NLGEOM")));
  EXPECT_TRUE(notes(", NLGEOM").empty());
  const std::string rubber = "*MATERIAL, NAME=R\n*HYPERELASTIC, NEO HOOKE\n10., 0.01\n";
  EXPECT_TRUE(translate_deck(bar(2) + rubber + fixed + beam + step(pull), "a.inp").notes.empty());
}

/// Two bars, one behind the other, that share no node, with equations between them and without.
TEST(InpConstraints, BodiesJoinedByEquationsHangTogether) {
  const auto warnings = [](const std::string& equations) {
    const std::string second =
        "*NODE\n21, 1, 0, 0\n22, 1, 1, 0\n23, 1, 1, 1\n24, 1, 0, 1\n31, 2, 0, 0\n32, 2, 1, 0\n"
        "33, 2, 1, 1\n34, 2, 0, 1\n*ELEMENT, TYPE=C3D8, ELSET=BAR\n"
        "9, 21, 22, 23, 24, 31, 32, 33, 34\n*NSET, NSET=FAR\n31, 32, 33, 34\n";
    const std::string move = "*BOUNDARY\nFAR, 1, 1, 0.1\nFAR, 2, 3, 0.\n";
    return run_deck(bar(1) + second + equations + fixed + step(move)).built.warnings;
  };
  std::string equations = "*EQUATION\n";
  for (int k = 1; k <= 4; ++k)
    for (int i = 1; i <= 3; ++i)
      equations += fmt::format("2\n{}, {}, 1., {}, {}, -1.\n", 20 + k, i, 10 + k, i);
  const auto told = ::testing::Contains(HasSubstr("nodes of one body at the same place"));
  EXPECT_THAT(warnings(equations), ::testing::Not(told));
  EXPECT_THAT(warnings(""), told);
}

/// Pulled together by a force, then kept as it is while the bar is pulled: F = E A delta / L.
TEST(InpConstraints, PretensionIsAForceAndThenLocked) {
  const std::string section =
      "*SURFACE, NAME=CUT\n2, S2\n*PRE-TENSION SECTION, SURFACE=CUT, "
      "NODE=901\n1., 0., 0.\n";
  const DeckRun run =
      run_deck(bar(4) + section + fixed + step("*BOUNDARY\nFINISH, 1, 3\n*CLOAD\n901, 1, 5.\n") +
               step("*BOUNDARY, FIXED\n901, 1, 3\n*BOUNDARY\nFINISH, 1, 1, 0.04\n"));
  EXPECT_NEAR(run.reaction_of("FINISH").x(), 5, 1e-9);
  EXPECT_NEAR(run.reaction_of("START").x(), -5, 1e-9);
  // 4 long: shortened by F L / (E A)
  const model::Equation& equation = run.built.model.equations.front();
  EXPECT_EQ(equation.terms.size(), 3u);
  const Index shortening = run.built.model.mesh.find_set("pretension_of_node_901")->nodes[0];
  EXPECT_EQ(shortening, run.node(901));
  EXPECT_NEAR(run.u[0][3 * shortening], 0.2, 1e-9);
  EXPECT_NEAR(run.u[1][3 * shortening], 0.2, 1e-9);
  EXPECT_NEAR(run.reaction_of("FINISH", 1).x(), 5 + 100 * 0.04 / 4, 1e-9);
}

/// As CalculiX has it: a normal into the elements of the surface turns the sign round.
TEST(InpConstraints, PretensionHasTheSignOfTheNormal) {
  const std::string ends = fixed + step("*BOUNDARY\nFINISH, 1, 3\n*CLOAD\n901, 1, 5.\n");
  for (const auto& [surface, normal, pull] :
       {std::tuple("2, S2", "1., 0., 0.", 5.0), std::tuple("2, S2", "-1., 0., 0.", -5.0),
        std::tuple("3, S1", "1., 0., 0.", -5.0), std::tuple("3, S1", "0., 0., 0.", 5.0)}) {
    const DeckRun run =
        run_deck(bar(4) +
                 fmt::format("*SURFACE, NAME=CUT\n{}\n*PRE-TENSION SECTION, SURFACE=CUT, "
                             "NODE=901\n{}\n",
                             surface, normal) +
                 ends);
    EXPECT_NEAR(run.reaction_of("FINISH").x(), pull, 1e-9) << surface << " " << normal;
  }
}

/// Turning bar, fixed at the axis: u(L) = rho w^2 L^3 / (3 E), N(0) = rho w^2 L^2 / 2.
TEST(InpConstraints, CentrifugalForceOfABar) {
  const DeckRun run =
      run_deck(bar(4) + "*BOUNDARY\nNALL, 2, 3\nSTART, 1\n" +
               step("*DLOAD\nBAR, CENTRIF, 0.2, 0, 0, 0, 0, 0, 1\nBAR, CENTRIF, 0.3, 0, 0, 0, 0, "
                    "0, 1\n"));
  EXPECT_NEAR(run.reaction_of("START").x(), -3 * 0.5 * 16 / 2, 1e-9);
  EXPECT_NEAR(run.displacement(41).x(), 3 * 0.5 * 64 / 300, 1e-9);
}

/// A force on a node of a rigid body is that force on its reference point and a moment about it;
/// it turns with the node, as far as it goes.
TEST(InpConstraints, ForcesActOnNodesOfRigidBodies) {
  const std::string body =
      bar(1) + fixed + "*RIGID BODY, NSET=FINISH, REF NODE=901, ROT NODE=902\n";
  constexpr double size = 1e-6;
  // at node 11, by (0, -1/2, -1/2) from the reference point: M = r x F
  const DeckRun at_node = run_deck(body + step(fmt::format("*CLOAD\n11, 1, {}\n", size)));
  const DeckRun at_reference =
      run_deck(body + step(fmt::format("*CLOAD\n901, 1, {}\n902, 2, {}\n902, 3, {}\n", size,
                                       -size / 2, size / 2)));
  const double scale = at_node.displacement(11).norm();
  EXPECT_GT(scale, size / 100);
  for (const int node : {11, 12, 13, 14})
    EXPECT_LT((at_node.displacement(node) - at_reference.displacement(node)).norm(), 1e-6 * scale);
}

}  // namespace
}  // namespace osculate::deck
