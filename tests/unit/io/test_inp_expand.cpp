// Shells, beams and trusses of decks as solids.
#include "osculate/io/inp/expand.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "osculate/cell/quadrature.hpp"
#include "osculate/cell/volume_shape.hpp"
#include "osculate/core/error.hpp"
#include "osculate/io/inp/deck_mesh.hpp"
#include "osculate/io/inp/element_types.hpp"
#include "osculate/mesh/check.hpp"

namespace osculate::io::inp {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

DeckMesh read(const std::string& text) {
  const Deck deck = read_cards(text, "a.inp");
  return deck_mesh(deck);
}

/// Of a cell its volume (negative: inside out) times 1, x, y, z.
Vec<4> moments(const mesh::Mesh& mesh, const mesh::CellRef& ref) {
  const mesh::Block& block = mesh.blocks[static_cast<std::size_t>(ref.block)];
  const bool is_wedge = cell::info(block.type).corners == 6;
  const cell::Quadrature3D rule = is_wedge ? cell::gauss_wedge(5, 4) : cell::gauss_hex(4);
  Vec<4> sum = Vec<4>::Zero();
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    const cell::VolumeShape shape = cell::volume_shape(block.type, rule.points[q]);
    Vec3 place = Vec3::Zero();
    Mat<3, 3> jacobian = Mat<3, 3>::Zero();
    for (int k = 0; k < shape.count; ++k) {
      const Vec3& x = mesh.nodes[static_cast<std::size_t>(block.cell(ref.cell)[k])];
      place += shape.n[k] * x;
      jacobian += x * shape.d.row(k);
    }
    const double volume = rule.weights[q] * jacobian.determinant();
    sum += volume * Vec<4>(1, place.x(), place.y(), place.z());
  }
  return sum;
}

Vec<4> moments(const mesh::Mesh& mesh, const std::string& set) {
  Vec<4> sum = Vec<4>::Zero();
  for (const mesh::CellRef& ref : mesh.find_set(set)->cells) sum += moments(mesh, ref);
  return sum;
}
Vec3 middle(const mesh::Mesh& mesh, const std::string& set) {
  const Vec<4> sum = moments(mesh, set);
  return sum.tail<3>() / sum[0];
}

/// A rectangle 2 x 3 at z = 1, normal +z, of one element of each type.
std::string plate(const std::string& type, const std::string& section) {
  const bool triangle = type[1] == '3' || type[1] == '6';
  const std::string rest = type[1] == '8'   ? "1, 2, 3, 4, 5, 6, 7, 8"
                           : type[1] == '6' ? "1, 2, 3, 5, 6, 9\n2, 1, 3, 4, 9, 7, 8"
                           : triangle       ? "1, 2, 3\n2, 1, 3, 4"
                                            : "1, 2, 3, 4";
  return "*NODE, NSET=N\n1, 0, 0, 1\n2, 2, 0, 1\n3, 2, 3, 1\n4, 0, 3, 1\n5, 1, 0, 1\n6, 2, 1.5, 1\n"
         "7, 1, 3, 1\n8, 0, 1.5, 1\n9, 1, 1.5, 1\n*ELEMENT, TYPE=" +
         type + ", ELSET=E\n1, " + rest + "\n" + section;
}

TEST(InpExpand, PlatesHaveTheirThicknessAlongTheNormal) {
  struct Case {
    std::string type;
    cell::CellType cell;
  };
  for (const Case& one : {Case{"S3", cell::CellType::wedge6}, Case{"S4R", cell::CellType::hex8},
                          Case{"S6", cell::CellType::wedge15}, Case{"S8R", cell::CellType::hex20}})
    for (const double offset : {0.0, 0.5, -0.5, 2.0}) {
      SCOPED_TRACE(fmt::format("{} {}", one.type, offset));
      const DeckMesh deck = read(plate(
          one.type, fmt::format("*SHELL SECTION, ELSET=E, MATERIAL=M, OFFSET={}\n0.25\n", offset)));
      const mesh::Set* const set = deck.mesh.find_set("E");
      ASSERT_EQ(set->dimension, 3);
      for (const mesh::CellRef& ref : set->cells) {
        EXPECT_EQ(deck.mesh.blocks[static_cast<std::size_t>(ref.block)].type, one.cell);
        EXPECT_GT(moments(deck.mesh, ref)[0], 0);
      }
      EXPECT_NEAR(moments(deck.mesh, "E")[0], 2 * 3 * 0.25, 1e-12);
      // the reference is the top for 0.5
      EXPECT_NEAR((middle(deck.mesh, "E") - Vec3(1, 1.5, 1 - offset * 0.25)).norm(), 0, 1e-12);
      EXPECT_THAT(deck.knots, IsEmpty());
    }
}

TEST(InpExpand, NodesOfTheDeckStayAndMoveInTheMean) {
  const DeckMesh deck = read(plate("S8", "*SHELL SECTION, ELSET=E, MATERIAL=M\n0.25\n"));
  EXPECT_EQ(mesh::node_number(deck.mesh, 0), 1);
  EXPECT_EQ(deck.mesh.nodes[2], Vec3(2, 3, 1));
  ASSERT_THAT(deck.mesh.nodes, SizeIs(9 + 20));
  EXPECT_EQ(mesh::node_number(deck.mesh, 9), 10);
  ASSERT_THAT(deck.mesh.relations, SizeIs(8 * 3));
  for (const mesh::Relation& relation : deck.mesh.relations) {
    EXPECT_EQ(relation.from, mesh::Relation::Support{});  // of all steps
    // corners: u = 2 u_middle - (u_bottom + u_top) / 2; middles of edges: the mean of both
    ASSERT_THAT(relation.terms, SizeIs(relation.terms[0].node < 4 ? 4 : 3));
    Vec3 sum = Vec3::Zero();
    for (const mesh::Relation::Term& term : relation.terms) {
      EXPECT_EQ(term.direction, relation.terms[0].direction);
      sum += term.factor * deck.mesh.nodes[static_cast<std::size_t>(term.node)];
    }
    EXPECT_NEAR(sum.norm(), 0, 1e-12);
  }
  EXPECT_THAT(deck.mesh.find_set("N")->nodes, SizeIs(9));
}

/// What a node was expanded to, with its place along the axes of the section.
TEST(InpExpand, ExpandedNodesKnowTheirNode) {
  for (const char* const section : {"*SHELL SECTION, ELSET=E, MATERIAL=M, OFFSET=0.5\n0.25\n",
                                    "*SHELL SECTION, ELSET=E, COMPOSITE\n0.1, , M\n0.15, , M\n"}) {
    const DeckMesh deck = read(plate("S8", section));
    const std::vector<mesh::Expanded>& all = deck.mesh.expanded;
    EXPECT_EQ(all.size(), deck.mesh.nodes.size() - 9);
    for (const mesh::Expanded& one : all) {
      EXPECT_GE(one.node, 9);
      const Vec3 arm = deck.mesh.nodes[static_cast<std::size_t>(one.node)] -
                       deck.mesh.nodes[static_cast<std::size_t>(one.of)];
      EXPECT_NEAR((arm - one.height[0] * Vec3::UnitZ()).norm(), 0, 1e-12);
      EXPECT_EQ(one.height[1], 0);
    }
  }
  for (const char* const section :
       {"RECT\n0.1, 0.2\n", "BOX\n0.4, 0.2, 0.02, 0.02, 0.02, 0.02\n"}) {
    const DeckMesh beam = read(
        "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 2, 0, 0\n*ELEMENT, TYPE=B32, ELSET=E\n1, 1, 2, 3\n"
        "*BEAM SECTION, ELSET=E, MATERIAL=M, SECTION=" +
        std::string(section) + "0, 1, 0\n");
    EXPECT_EQ(beam.mesh.expanded.size(), beam.mesh.nodes.size() - 3);
    for (const mesh::Expanded& one : beam.mesh.expanded) {
      const Vec3 arm = beam.mesh.nodes[static_cast<std::size_t>(one.node)] -
                       beam.mesh.nodes[static_cast<std::size_t>(one.of)];
      EXPECT_NEAR((arm - Vec3(0, one.height[1], one.height[0])).norm(), 0, 1e-12);
    }
  }
}

TEST(InpExpand, ThicknessOfNodesWhereTheSectionSaysSo) {
  const std::string nodes =
      "*NODAL THICKNESS\n1, 0.1\n4, 0.1\n8, 0.1\n2, 0.5\n3, 0.5\n6, 0.5\n5, 0.3\n7, 0.3\n";
  const std::string section = "*SHELL SECTION, ELSET=E, MATERIAL=M";
  const DeckMesh with = read(plate("S8", section + ", NODAL THICKNESS\n" + nodes));
  EXPECT_NEAR(moments(with.mesh, "E")[0], 2 * 3 * 0.3, 1e-12);
  const DeckMesh without = read(plate("S8", section + "\n0.25\n" + nodes));
  EXPECT_NEAR(moments(without.mesh, "E")[0], 2 * 3 * 0.25, 1e-12);
}

/// A quarter of a cylinder of radius 1 around y, 2 wide, of n elements S8, normals outwards.
std::string arc(int n, const std::string& more) {
  std::string text = "*NODE\n", elements;
  for (int i = 0; i <= 2 * n; ++i)
    for (int j = 0; j < 3; ++j) {
      const double angle = std::numbers::pi / 4 * i / n;
      text += fmt::format("{}, {}, {}, {}\n", 10 * i + j + 1, std::cos(angle), j, std::sin(angle));
    }
  for (int e = 0; e < n; ++e) {
    const int a = 20 * e + 1;
    elements += fmt::format("{}, {}, {}, {}, {}, {}, {}, {}, {}\n", e + 1, a, a + 2, a + 22, a + 20,
                            a + 1, a + 12, a + 21, a + 10);
  }
  return text + "*ELEMENT, TYPE=S8, ELSET=E\n" + elements +
         "*SHELL SECTION, ELSET=E, MATERIAL=M\n0.2\n" + more;
}

TEST(InpExpand, CurvedShellsAreOneBodyAndConvergeToTheirVolume) {
  const double exact = std::numbers::pi / 4 * (1.1 * 1.1 - 0.9 * 0.9) * 2;
  double before = 0;
  for (const int n : {2, 4, 8}) {
    const DeckMesh deck = read(arc(n, ""));
    EXPECT_THAT(deck.knots, IsEmpty());
    const double error = std::abs(moments(deck.mesh, "E")[0] - exact);
    if (n > 2) {
      EXPECT_LT(error, before / 12);  // of fourth order
    }
    before = error;
    for (const mesh::Finding& finding : mesh::check_mesh(deck.mesh))
      EXPECT_EQ(finding.flaw, mesh::Flaw::unused_node) << finding.message;  // none in the middle
  }
}

TEST(InpExpand, AKnotWhereNormalsDiffer) {
  // two plates at 30 degrees, 19 degrees and one turned over
  const auto roof = [](double degrees, bool turned) {
    const double angle = degrees * std::numbers::pi / 180;
    return fmt::format(
        "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, {0}, 0, {1}\n6, {0}, 1, {1}\n"
        "*ELEMENT, TYPE=S4, ELSET=E\n1, 1, 2, 3, 4\n2, {2}\n"
        "*SHELL SECTION, ELSET=E, MATERIAL=M\n0.1\n*STEP, NLGEOM\n",
        1 + std::cos(angle), std::sin(angle), turned ? "2, 3, 6, 5" : "2, 5, 6, 3");
  };
  EXPECT_THAT(read(roof(19, false)).knots, IsEmpty());
  for (const DeckMesh& deck : {read(roof(21, false)), read(roof(0, true))}) {
    ASSERT_THAT(deck.knots, SizeIs(2));
    EXPECT_EQ(deck.knots[0].set, "knot 2");
    EXPECT_EQ(mesh::node_number(deck.mesh, deck.knots[1].node), 3);
    EXPECT_THAT(deck.mesh.find_set("knot 2")->nodes, SizeIs(5));
    EXPECT_THAT(deck.mesh.relations, SizeIs(4 * 3));
  }
}

TEST(InpExpand, ATJointAndAStepOfThicknessAreKnots) {
  const DeckMesh joint = read(
      "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, 2, 0, 0\n6, 2, 1, 0\n7, 1, 0, 1\n"
      "8, 1, 1, 1\n*ELEMENT, TYPE=S4, ELSET=E\n1, 1, 2, 3, 4\n2, 2, 5, 6, 3\n3, 2, 7, 8, 3\n"
      "*SHELL SECTION, ELSET=E, MATERIAL=M\n0.1\n*STEP, NLGEOM\n");
  ASSERT_THAT(joint.knots, SizeIs(2));
  EXPECT_THAT(joint.mesh.find_set("KNOT 3")->nodes, SizeIs(5));
  const DeckMesh step = read(
      "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 2, 0, 0\n*ELEMENT, TYPE=B31, ELSET=A\n1, 1, 2\n"
      "*ELEMENT, TYPE=B31, ELSET=B\n2, 2, 3\n*BEAM SECTION, ELSET=A, MATERIAL=M, SECTION=RECT\n"
      "1, 2\n0, 1, 0\n*BEAM SECTION, ELSET=B, MATERIAL=M, SECTION=RECT\n1, 1\n0, 1, 0\n"
      "*STEP, NLGEOM\n");
  ASSERT_THAT(step.knots, SizeIs(1));
  EXPECT_THAT(step.mesh.find_set("knot 2")->nodes, SizeIs(9));
}

/// Largest error of the relations where nodes have `u` of their place, but those of the rotations
/// of nodes of the set N `turn`, and those of the stretches, which follow them, `stretch`.
double misfit(const DeckMesh& deck, const std::function<Vec3(const Vec3&)>& u, const Vec3& turn,
              const Vec3& stretch) {
  const std::vector<Index>& turns = deck.mesh.find_set("rotations of N")->nodes;
  double worst = 0;
  for (const mesh::Relation& relation : deck.mesh.relations) {
    double sum = 0;
    for (const mesh::Relation::Term& term : relation.terms) {
      const auto is = [&](Index node) { return std::ranges::count(turns, node) > 0; };
      const Vec3 value = is(term.node) ? turn
                         : is(term.node - 1)
                             ? stretch
                             : u(deck.mesh.nodes[static_cast<std::size_t>(term.node)]);
      sum += term.factor * value[term.direction];
    }
    worst = std::max(worst, std::abs(sum));
  }
  return worst;
}

TEST(InpExpand, KnotsOfSmallRotationsTurnAndStretch) {
  const Vec3 turn(0.3, -0.2, 0.7), move(1, 2, 3);
  // two plates at a right angle, their knots on a line: alike all around
  const DeckMesh shells = read(
      "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, 1, 0, 1\n6, 1, 1, 1\n"
      "*NSET, NSET=N\n2, 3\n*ELEMENT, TYPE=S4, ELSET=E\n1, 1, 2, 3, 4\n2, 2, 5, 6, 3\n"
      "*SHELL SECTION, ELSET=E, MATERIAL=M\n0.1\n");
  EXPECT_THAT(shells.knots, IsEmpty());
  EXPECT_THAT(shells.mesh.relations, SizeIs(4 * 3 + 2 * 4 * 3));
  const auto swollen = [&](const Vec3& x) {  // about the line of the knots, and along it
    const Vec3 arm = x - Vec3(1, 0, 0);
    return Vec3(move + turn.cross(x) + 0.4 * Vec3(arm.x(), 0, arm.z()));
  };
  EXPECT_NEAR(misfit(shells, swollen, turn, Vec3(0.4, 0, 0)), 0, 1e-12);
  EXPECT_GT(misfit(shells, swollen, turn, Vec3(0.3, 0, 0)), 1e-3);
  // a step of the thickness of a beam along x: in its plane, not along it
  const DeckMesh beams = read(
      "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 2, 0, 0\n*NSET, NSET=N\n2\n*ELEMENT, TYPE=B31, ELSET=A\n"
      "1, 1, 2\n*ELEMENT, TYPE=B31, ELSET=B\n2, 2, 3\n"
      "*BEAM SECTION, ELSET=A, MATERIAL=M, SECTION=RECT\n1, 2\n0, 1, 0\n"
      "*BEAM SECTION, ELSET=B, MATERIAL=M, SECTION=RECT\n1, 1\n0, 1, 0\n");
  const auto stretched = [&](const Vec3& x) {  // z is along the second axis, y along the first
    const Vec3 size(0, 0.5 * x.y() + 0.1 * x.z(), 0.3 * x.z() + 0.1 * x.y());
    return Vec3(move + turn.cross(x) + size);
  };
  EXPECT_NEAR(misfit(beams, stretched, turn, Vec3(0.3, 0.5, 0.1)), 0, 1e-12);
}

TEST(InpExpand, AStepOfThicknessOfAPlateHasNoTurnAboutItsNormal) {
  const DeckMesh deck = read(
      "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, 2, 0, 0\n6, 2, 1, 0\n"
      "*ELEMENT, TYPE=S4, ELSET=A\n1, 1, 2, 3, 4\n*ELEMENT, TYPE=S4, ELSET=B\n2, 2, 5, 6, 3\n"
      "*SHELL SECTION, ELSET=A, MATERIAL=M\n0.1\n*SHELL SECTION, ELSET=B, MATERIAL=M\n0.2\n");
  const auto about_normal = [](const mesh::Relation& relation) {
    return relation.terms.size() == 1 && relation.terms[0].direction == 2;
  };
  EXPECT_EQ(std::count_if(deck.mesh.relations.begin(), deck.mesh.relations.end(), about_normal), 2);
}

/// A line from 0 to (3, 0, 0).
std::string line(const std::string& type, const std::string& section) {
  const bool middle = type[2] == '2';
  return "*NODE, NSET=N\n1, 0, 0, 0\n2, 1.5, 0, 0\n3, 3, 0, 0\n*ELEMENT, TYPE=" + type +
         ", ELSET=E\n1, " + (middle ? "1, 2, 3" : "1, 3") + "\n" + section;
}

TEST(InpExpand, BeamsHaveTheirSectionAlongTheAxes) {
  for (const std::string type : {"B31", "B32R"}) {
    const DeckMesh deck = read(line(type,
                                    "*BEAM SECTION, ELSET=E, MATERIAL=M, SECTION=RECT, "
                                    "OFFSET1=0.5, OFFSET2=-1\n0.5, 0.2\n0, 1, 0\n"));
    EXPECT_NEAR(moments(deck.mesh, "E")[0], 3 * 0.5 * 0.2, 1e-12);
    // first axis y, second z
    EXPECT_NEAR((middle(deck.mesh, "E") - Vec3(1.5, -0.25, 0.2)).norm(), 0, 1e-12);
    double low = 1, high = -1;
    for (const Index node : deck.mesh.find_set("E")->nodes) {
      low = std::min(low, deck.mesh.nodes[static_cast<std::size_t>(node)].y());
      high = std::max(high, deck.mesh.nodes[static_cast<std::size_t>(node)].y());
    }
    EXPECT_NEAR(low, -0.5, 1e-12);
    EXPECT_NEAR(high, 0, 1e-12);
  }
}

TEST(InpExpand, RoundBeamsAreSecondOrderArcs) {
  const DeckMesh deck =
      read(line("B32", "*BEAM SECTION, ELSET=E, MATERIAL=M, SECTION=CIRC\n0.4, 0.2\n0, 1, 0\n"));
  const double ellipse = std::numbers::pi / 4 * 0.4 * 0.2;
  EXPECT_NEAR(moments(deck.mesh, "E")[0] / 3, ellipse, 0.015 * ellipse);
  for (const Index node : deck.mesh.find_set("E")->nodes) {
    const Vec3& x = deck.mesh.nodes[static_cast<std::size_t>(node)];
    EXPECT_NEAR(std::hypot(x.y() / 0.2, x.z() / 0.1), 1, 1e-12);
  }
}

// Of reduced integration along the beam only, where their bricks would have modes without energy.
TEST(InpExpand, BeamsOfReducedIntegrationAreBricksOfTheirOwn) {
  const auto type_of = [](const char* type, const std::string& size) {
    const DeckMesh deck =
        read(line(type, "*BEAM SECTION, ELSET=E, MATERIAL=M, SECTION=" + size + "\n0, 1, 0\n"));
    for (const DeckSet& set : deck.sets)
      if (set.name == "E" && set.kind == SetKind::elements) return set.type;
    return std::string();
  };
  EXPECT_EQ(type_of("B32R", "RECT\n0.4, 0.2"), beam_brick);
  EXPECT_EQ(type_of("B32R", "CIRC\n0.4, 0.2"), beam_brick);
  EXPECT_EQ(type_of("B32R", "PIPE\n0.2, 0.1"), "C3D20R");
  EXPECT_EQ(type_of("B32", "RECT\n0.4, 0.2"), "C3D20");
}

// The first direction of the bricks lies along the beam.
TEST(InpExpand, BricksOfBeamsBeginAlongThem) {
  const DeckMesh deck =
      read(line("B32R", "*BEAM SECTION, ELSET=E, MATERIAL=M, SECTION=RECT\n0.4, 0.2\n0, 1, 0\n"));
  for (const mesh::CellRef& ref : deck.mesh.find_set("E")->cells) {
    const Index* const nodes = deck.mesh.blocks[static_cast<std::size_t>(ref.block)].cell(ref.cell);
    const cell::VolumeShape middle = cell::volume_shape(cell::CellType::hex20, Vec3::Zero());
    Vec3 way = Vec3::Zero();
    for (int k = 0; k < 20; ++k)
      way += middle.d(k, 0) * deck.mesh.nodes[static_cast<std::size_t>(nodes[k])];
    EXPECT_LT(way.normalized().tail<2>().norm(), 1e-12);
  }
}

TEST(InpExpand, TrussesAreHinged) {
  const DeckMesh deck = read(
      "*NODE\n1, 0, 0, 0\n2, 5, 0, 5\n3, 0, 0, 10\n*ELEMENT, TYPE=T3D2, ELSET=E\n1, 1, 2\n2, 2, 3\n"
      "*SOLID SECTION, ELSET=E, MATERIAL=M\n0.0625\n");
  EXPECT_THAT(deck.knots, IsEmpty());
  EXPECT_NEAR(moments(deck.mesh, "E")[0], 2 * std::sqrt(50.0) * 0.0625, 1e-12);
  EXPECT_THAT(deck.mesh.relations, SizeIs(4 * 3 + 2));  // an end each, and no turn about the axis
  EXPECT_THAT(deck.mesh.nodes, SizeIs(3 + 16));
}

TEST(InpExpand, RotationsAreThoseOfARigidTurn) {
  for (const std::string& text :
       {line("B32",
             "*BEAM SECTION, ELSET=E, MATERIAL=M, SECTION=RECT\n0.4, 0.2\n0, 1, 0\n"
             "*BOUNDARY\n1, 4, 6\n"),
        plate("S4", "*SHELL SECTION, ELSET=E, MATERIAL=M\n0.25\n*BOUNDARY\n1, 4, 6\n")}) {
    const DeckMesh deck = read(text);
    const std::vector<Index> turns = deck.mesh.find_set("rotations of node 1")->nodes;
    ASSERT_THAT(turns, SizeIs(1));
    const Vec3 turn(0.3, -0.2, 0.7);
    int found = 0;
    for (const mesh::Relation& relation : deck.mesh.relations) {
      if (relation.terms[0].node != turns[0]) continue;
      double sum = 0;
      for (std::size_t k = 1; k < relation.terms.size(); ++k) {
        const mesh::Relation::Term& term = relation.terms[k];
        const Vec3 u = turn.cross(deck.mesh.nodes[static_cast<std::size_t>(term.node)]);
        sum += term.factor * u[term.direction];
      }
      ++found;
      const bool of_normal = relation.terms.size() == 1;  // of the shell, whose normal is z
      EXPECT_EQ(of_normal,
                text.find("S4") != std::string::npos && relation.terms[0].direction == 2);
      if (!of_normal) {
        EXPECT_NEAR(sum, turn[relation.terms[0].direction], 1e-12);
      }
    }
    EXPECT_EQ(found, 3);
  }
}

TEST(InpExpand, NormalsOfTheDeck) {
  const DeckMesh deck =
      read(plate("S4", "*SHELL SECTION, ELSET=E, MATERIAL=M\n0.25\n*NORMAL\n1, 1, 1, 0, 1\n"));
  const double way = 0.125 / std::numbers::sqrt2;
  EXPECT_NEAR((deck.mesh.nodes[9] - Vec3(-way, 0, 1 - way)).norm(), 0, 1e-12);
  EXPECT_NEAR((deck.mesh.nodes[11] - Vec3(2, 0, 1 - 0.125)).norm(), 0, 1e-12);
}

TEST(InpExpand, SidesAndPressuresOfShellsAndBeams) {
  const auto mean = [](const mesh::Mesh& mesh, const std::string& set) {
    Vec3 sum = Vec3::Zero();
    for (const Index node : mesh.find_set(set)->nodes)
      sum += mesh.nodes[static_cast<std::size_t>(node)];
    return Vec3(sum / static_cast<double>(mesh.find_set(set)->nodes.size()));
  };
  const mesh::Mesh shell =
      read(plate("S8",
                 "*SHELL SECTION, ELSET=E, MATERIAL=M\n0.25\n*SURFACE, NAME=UP\nE, SPOS\n"
                 "*SURFACE, NAME=EDGE\nE, E2\n*DLOAD\nE, P, 1\n"))
          .mesh;
  EXPECT_NEAR(mean(shell, "UP").z(), 1.125, 1e-12);
  EXPECT_NEAR(mean(shell, "P of E").z(), 0.875, 1e-12);
  EXPECT_NEAR(mean(shell, "EDGE").x(), 2, 1e-12);
  const mesh::Mesh beam =
      read(line("B32",
                "*BEAM SECTION, ELSET=E, MATERIAL=M, SECTION=RECT\n0.4, 0.2\n0, 1, 0\n"
                "*DLOAD\nE, P1, 1\nE, P2, 1\n*SURFACE, NAME=UP\nE, S2\n"))
          .mesh;
  EXPECT_NEAR(mean(beam, "P1 of E").y(), -0.2, 1e-12);
  EXPECT_NEAR(mean(beam, "P2 of E").z(), -0.1, 1e-12);
  EXPECT_NEAR(mean(beam, "UP").y(), 0.2, 1e-12);
}

TEST(InpExpand, WhatIsWrongIsTold) {
  const auto message = [](const std::string& text) -> std::string {
    try {
      (void)read(text);
    } catch (const core::InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(message(plate("S4", "*SHELL SECTION, ELSET=E, MATERIAL=M\n0.\n")),
              HasSubstr("expected a thickness above 0, found 0"));
  for (const char* const type : {"B31", "B31R"})
    EXPECT_THAT(message("*NODE\n1, 0, 0, 0\n2, 0, 0, 5\n*ELEMENT, TYPE=" + std::string(type) +
                        ", ELSET=E\n1, 1, 2\n*BEAM SECTION, ELSET=E, MATERIAL=M, SECTION=CIRC\n"
                        "0.4, 0.4\n0, 1, 0\n"),
                HasSubstr("its elements are of type B31; round beams are B32 or B32R"));
  EXPECT_THAT(message("*NODE\n1, 0, 0, 0\n*ELEMENT, TYPE=C3D20RB, ELSET=E\n1, 1\n"),
              HasSubstr("elements of type 'C3D20RB' are not supported"));
  EXPECT_THAT(message(plate("S4", "*SHELL SECTION, ELSET=E, MATERIAL=M, NODAL THICKNESS\n")),
              HasSubstr("element 1 has no thickness at node 1"));
  EXPECT_THAT(message(plate("S4", "*BEAM SECTION, ELSET=E, MATERIAL=M, SECTION=RECT\n1, 1\n")),
              HasSubstr("its elements are of type S4, which is no beam in space"));
  EXPECT_THAT(
      message(line("B31", "*BEAM SECTION, ELSET=E, MATERIAL=M, SECTION=RECT\n1, 1\n1, 0, 0\n")),
      HasSubstr("element 1 is along the first axis of its section"));
}

}  // namespace
}  // namespace osculate::io::inp
