// Plane and axisymmetric elements of decks beside solids: one layer of solids.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "osculate/cell/quadrature.hpp"
#include "osculate/cell/shape.hpp"
#include "osculate/cell/volume_shape.hpp"
#include "osculate/core/error.hpp"
#include "osculate/io/inp/deck_mesh.hpp"
#include "osculate/mesh/check.hpp"

namespace osculate::io::inp {
namespace {

using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr double degree = std::numbers::pi / 180;
const std::vector<std::string> kinds{"CPE3",  "CPE4",  "CPE4R", "CPE4I", "CPE6",  "CPE8",
                                     "CPE8R", "CPS3",  "CPS4",  "CPS6",  "CPS8R", "CAX3",
                                     "CAX4",  "CAX4R", "CAX6",  "CAX8",  "CAX8R"};

DeckMesh read(const std::string& text) {
  const Deck deck = read_cards(text, "a.inp");
  return deck_mesh(deck);
}
std::string message(const std::string& text) {
  try {
    (void)read(text);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

/// One element between x = 1 and 3 and y = 0 and 4, or the half of it below the diagonal.
std::string element(const std::string& type) {
  const bool triangle = type[3] == '3' || type[3] == '6';
  const bool second = type[3] == '6' || type[3] == '8';
  const std::string nodes = triangle ? (second ? "1, 2, 3, 5, 6, 9" : "1, 2, 3")
                                     : (second ? "1, 2, 3, 4, 5, 6, 7, 8" : "1, 2, 3, 4");
  return "*NODE, NSET=PLANE\n1, 1, 0\n2, 3, 0\n3, 3, 4\n4, 1, 4\n5, 2, 0\n6, 3, 2\n7, 2, 4\n8, 1, "
         "2\n"
         "9, 2, 2\n*ELEMENT, TYPE=" +
         type + ", ELSET=P\n1, " + nodes + "\n";
}
const std::string cube =
    "*NODE, NSET=CUBE\n11, 5, 0, 0\n12, 6, 0, 0\n13, 6, 1, 0\n14, 5, 1, 0\n15, 5, 0, 1\n16, 6, 0, "
    "1\n"
    "17, 6, 1, 1\n18, 5, 1, 1\n*ELEMENT, TYPE=C3D8, ELSET=B\n2, 11, 12, 13, 14, 15, 16, 17, 18\n"
    "*SOLID SECTION, ELSET=B, MATERIAL=M\n";
std::string section(const std::string& thickness) {
  return "*SOLID SECTION, ELSET=P, MATERIAL=M\n" + (thickness.empty() ? "" : thickness + "\n");
}

double volume(const mesh::Mesh& mesh, const std::string& set) {
  double sum = 0;
  for (const mesh::CellRef& ref : mesh.find_set(set)->cells) {
    const mesh::Block& block = mesh.blocks[static_cast<std::size_t>(ref.block)];
    const cell::Quadrature3D rule =
        cell::info(block.type).corners == 6 ? cell::gauss_wedge(5, 4) : cell::gauss_hex(4);
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const cell::VolumeShape shape = cell::volume_shape(block.type, rule.points[q]);
      Mat<3, 3> jacobian = Mat<3, 3>::Zero();
      for (int k = 0; k < shape.count; ++k)
        jacobian += mesh.nodes[static_cast<std::size_t>(block.cell(ref.cell)[k])] * shape.d.row(k);
      sum += rule.weights[q] * jacobian.determinant();
    }
  }
  return sum;
}

/// Area times normal of the facets of a set.
Vec3 area(const mesh::Mesh& mesh, const std::string& set) {
  Vec3 sum = Vec3::Zero();
  for (const mesh::CellRef& ref : mesh.find_set(set)->cells) {
    const mesh::Block& block = mesh.blocks[static_cast<std::size_t>(ref.block)];
    EXPECT_EQ(cell::info(block.type).corners, 4);
    const cell::Quadrature2D rule = cell::gauss_quad(4);
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const cell::AreaShape shape = cell::area_shape(block.type, rule.points[q]);
      Mat<3, 2> along = Mat<3, 2>::Zero();
      for (int k = 0; k < shape.count; ++k)
        along += mesh.nodes[static_cast<std::size_t>(block.cell(ref.cell)[k])] * shape.d.row(k);
      sum += rule.weights[q] * along.col(0).cross(along.col(1));
    }
  }
  return sum;
}

bool is_triangle(const std::string& type) { return type[3] == '3' || type[3] == '6'; }
bool is_ring(const std::string& type) { return type.starts_with("CAX"); }

TEST(InpPlane, ElementsBesideSolidsAreOneLayer) {
  for (const std::string& type : kinds) {
    SCOPED_TRACE(type);
    const DeckMesh deck = read(element(type) + section("0.25") + cube);
    const mesh::Set* const set = deck.mesh.find_set("P");
    ASSERT_EQ(set->dimension, 3);
    ASSERT_THAT(set->cells, SizeIs(1));
    const std::string letters = type.substr(4);
    const int nodes = type[3] == '3' ? 6 : type[3] == '4' ? 8 : type[3] == '6' ? 15 : 20;
    std::string known;
    for (const DeckSet& one : deck.sets)
      if (one.kind == SetKind::elements && one.name == "P") known = one.type;
    EXPECT_EQ(known, fmt::format("C3D{}{}", nodes, letters));
    // of first order straight between the sides, of second order a parabola
    const double middle = is_triangle(type) ? 7.0 / 3 : 2, flat = is_triangle(type) ? 4 : 8;
    if (!is_ring(type))
      EXPECT_NEAR(volume(deck.mesh, "P"), flat * 0.25, 1e-12);
    else if (nodes < 15)
      EXPECT_NEAR(volume(deck.mesh, "P"), flat * middle * std::sin(2 * degree), 1e-12);
    else
      EXPECT_NEAR(volume(deck.mesh, "P"), flat * middle * 2 * degree, 1e-6);
    EXPECT_EQ(deck.sectors, is_ring(type));
    for (const mesh::Expanded& one : deck.mesh.expanded) EXPECT_TRUE(one.follows);
  }
}

/// What the two sides may do, and nothing else, meets the relations.
TEST(InpPlane, SidesMoveAlike) {
  for (const std::string& type : kinds) {
    SCOPED_TRACE(type);
    const DeckMesh deck = read(element(type) + section("0.25") + cube);
    const auto worst = [&](double swell, double slide) {
      std::map<Index, Vec3> u;
      for (const mesh::Expanded& one : deck.mesh.expanded) {
        const Vec3 &x = deck.mesh.nodes[static_cast<std::size_t>(one.of)],
                   &y = deck.mesh.nodes[static_cast<std::size_t>(one.node)];
        u[one.of] = Vec3(1 + x.x() * x.y(), x.x() - 3, 0);
        u[one.node] = Vec3(u[one.of].x(), u[one.of].y(), swell * x.y() * y.z() + slide);
        if (!is_ring(type)) continue;
        const double angle = std::atan2(y.z(), y.x());
        u[one.node] = Vec3(std::cos(angle) * u[one.of].x(), u[one.of].y(),
                           std::sin(angle) * u[one.of].x() + swell * y.z() + slide);
      }
      double most = 0;
      for (const mesh::Relation& relation : deck.mesh.relations) {
        double sum = 0;
        for (const auto& term : relation.terms) sum += term.factor * u[term.node][term.direction];
        most = std::max(most, std::abs(sum));
      }
      return most;
    };
    EXPECT_LT(worst(0, 0), 1e-14);
    EXPECT_GT(worst(0, 0.1), 0.01);
    if (type.starts_with("CPS"))
      EXPECT_LT(worst(0.1, 0), 1e-14);
    else
      EXPECT_GT(worst(0.1, 0), 1e-4);
  }
}

/// S1 is the edge from the first node to the second one, as in the plane, also as a load.
TEST(InpPlane, EdgesAreFacesAcross) {
  const std::array<Vec3, 4> sides{Vec3(0, -2, 0), Vec3(4, 0, 0), Vec3(0, 2, 0), Vec3(-4, 0, 0)};
  for (const std::string& type : kinds) {
    SCOPED_TRACE(type);
    const int edges = is_triangle(type) ? 3 : 4;
    std::string surfaces, loads = "*STEP\n*STATIC\n*DLOAD\n";
    for (int k = 1; k <= edges; ++k) {
      surfaces += fmt::format("*SURFACE, NAME=E{}\nP, S{}\n", k, k);
      loads += fmt::format("P, P{}, 1.\n", k);
    }
    const DeckMesh deck = read(element(type) + section("0.25") + cube + surfaces + loads);
    for (int k = 1; k <= edges; ++k) {
      Vec3 expected = sides[static_cast<std::size_t>(k - 1)];
      if (edges == 3 && k == 3) expected = Vec3(-4, 2, 0);
      // at the radii 1 and 3 of the edges up and down, 2 in the middle of the others
      const double radius = edges == 4 && k == 4 ? 1 : k == 2 ? 3 : 2;
      expected *= is_ring(type) ? 2 * radius * std::sin(degree) : 0.25;
      for (const std::string& name : {fmt::format("E{}", k), fmt::format("P{} of P", k)}) {
        SCOPED_TRACE(name);
        const Vec3 found = area(deck.mesh, name);
        if (!is_ring(type))
          EXPECT_NEAR((found - expected).norm(), 0, 1e-12);
        else  // normal to x: between chords; along y: the trapezium, or up to the parabola
          EXPECT_NEAR((found - expected).norm(), 0, std::abs(expected.y()) > 0 ? 4e-4 : 1e-12);
        EXPECT_NEAR(found.z(), 0, 1e-14);
      }
    }
    EXPECT_THAT(message(element(type) + section("0.25") + cube +
                        fmt::format("*SURFACE, NAME=E\nP, S{}\n", edges + 1)),
                HasSubstr(fmt::format("has no side 'S{}'; expected S1 to S{}", edges + 1, edges)));
  }
}

/// The sides between which they were expanded are not free.
TEST(InpPlane, FreeFacesAreThoseOfTheEdges) {
  const DeckMesh deck = read(element("CPE4") + section("0.25") + cube + "*SURFACE, NAME=S\nP,\n");
  EXPECT_THAT(deck.mesh.find_set("S")->cells, SizeIs(4));
  EXPECT_NEAR(area(deck.mesh, "S").norm(), 0, 1e-14);
  const DeckMesh solid = read(element("CPE4") + section("0.25") + cube + "*SURFACE, NAME=S\nB,\n");
  EXPECT_THAT(solid.mesh.find_set("S")->cells, SizeIs(6));
}

TEST(InpPlane, AloneTheyStayPlane) {
  const DeckMesh alone = read(element("CPE4") + section("0.25"));
  EXPECT_EQ(alone.mesh.find_set("P")->dimension, 2);
  EXPECT_THAT(alone.mesh.relations, IsEmpty());
  const DeckMesh rings =
      read(element("CAX4") + section("") + "*ELEMENT, TYPE=CPE3, ELSET=Q\n5, 1, 3, 4\n" +
           "*SOLID SECTION, ELSET=Q, MATERIAL=M\n");
  EXPECT_EQ(rings.mesh.find_set("Q")->dimension, 2);
  EXPECT_FALSE(rings.sectors);
  // without a section they are surfaces, as meshing programs write these
  const DeckMesh areas = read(element("CPS4") + cube);
  EXPECT_EQ(areas.mesh.find_set("P")->dimension, 2);
  EXPECT_THAT(areas.mesh.relations, IsEmpty());
}

TEST(InpPlane, ThicknessIsOneOrGivenAndLessBesideRings) {
  EXPECT_NEAR(volume(read(element("CPE4") + section("") + cube).mesh, "P"), 8, 1e-12);
  EXPECT_NEAR(volume(read(element("CPS4") + section("0.5") + cube).mesh, "P"), 4, 1e-12);
  const DeckMesh deck =
      read(element("CAX4") + section("") +
           "*NODE\n21, 10, 0\n22, 11, 0\n23, 11, 1\n24, 10, 1\n*ELEMENT, TYPE=CPE4, ELSET=Q\n"
           "5, 21, 22, 23, 24\n*SOLID SECTION, ELSET=Q, MATERIAL=M\n0.5\n" +
           cube);
  EXPECT_NEAR(volume(deck.mesh, "Q"), 0.5 / 180, 1e-14);
  EXPECT_NEAR(volume(deck.mesh, "B"), 1, 1e-14);
}

/// Elements of one kind and thickness share the nodes that their nodes become; others do not.
TEST(InpPlane, NeighboursOfOneKindAreJoined) {
  const auto nodes = [](const std::string& other) {
    const std::string text =
        "*NODE\n1, 0, 0\n2, 1, 0\n3, 2, 0\n4, 0, 1\n5, 1, 1\n6, 2, 1\n*ELEMENT, TYPE=CPE4, "
        "ELSET=P\n"
        "1, 1, 2, 5, 4\n" +
        section("0.25") + other + cube;
    return read(text).mesh.expanded.size();
  };
  const auto second = [](const char* type, const char* thickness) {
    return fmt::format(
        "*ELEMENT, TYPE={}, ELSET=Q\n3, 2, 3, 6, 5\n*SOLID SECTION, ELSET=Q, MATERIAL=M\n{}\n",
        type, thickness);
  };
  EXPECT_EQ(nodes(second("CPE4R", "0.25")), 12U);
  EXPECT_EQ(nodes(second("CPE4", "0.5")), 16U);
  EXPECT_EQ(nodes(second("CPS4", "0.25")), 16U);
}

/// A node that solids have, too, stays in the plane as well.
TEST(InpPlane, SharedNodesStayInThePlane) {
  const DeckMesh deck = read(element("CPS4") + section("0.5") + cube +
                             "*NODE\n31, 5, 0\n32, 5, 4\n33, 3, 0, 1\n34, 5, 0, 1\n35, 5, 4, 1\n"
                             "36, 3, 4, 1\n*ELEMENT, TYPE=C3D8, ELSET=B\n7, 2, 31, 32, 3, 33, 34, "
                             "35, 36\n");
  std::size_t alone = 0, with_sides = 0;
  for (const mesh::Relation& relation : deck.mesh.relations) {
    if (relation.terms[0].node > 8 || relation.terms[0].direction != 2) continue;
    (relation.terms.size() == 1 ? alone : with_sides) += 1;
  }
  EXPECT_EQ(alone, 2U);
  EXPECT_EQ(with_sides, 2U);
}

/// Corners of the two sides are at one place on the axis.
TEST(InpPlane, CellsOnTheAxisAreNoError) {
  for (const char* const type : {"CAX3", "CAX4", "CAX6", "CAX8"}) {
    SCOPED_TRACE(type);
    std::string text = element(type);
    for (const char* const node : {"1, 1, 0", "4, 1, 4", "8, 1, 2"})
      text.replace(text.find(node) + 3, 1, "0");
    for (const char* const node : {"5, 2, 0", "7, 2, 4", "9, 2, 2"})
      text.replace(text.find(node) + 3, 1, "1.5");
    const DeckMesh deck = read(text + section("") + cube);
    EXPECT_GT(volume(deck.mesh, "P"), 0);
    EXPECT_THAT(mesh::check_mesh(deck.mesh),
                Each(::testing::Field(&mesh::Finding::is_error, false)));
    EXPECT_TRUE(mesh::is_collapsed(deck.mesh, deck.mesh.find_set("P")->cells[0]));
    EXPECT_FALSE(mesh::is_collapsed(deck.mesh, deck.mesh.find_set("B")->cells[0]));
  }
}

TEST(InpPlane, WhatIsNotInThePlaneIsRefused) {
  std::string high = element("CPE4");
  high.replace(high.find("3, 3, 4"), 7, "3, 3, 4, 0.1");
  EXPECT_THAT(
      message(high + section("") + cube),
      HasSubstr("a.inp:13: *SOLID SECTION: node 3 (3, 4, 0.1) of plane elements is not at z = 0"));
  std::string behind = element("CAX4");
  behind.replace(behind.find("1, 1, 0"), 7, "1, -1, 0");
  EXPECT_THAT(message(behind + section("") + cube), HasSubstr("has a negative radius (x)"));
  EXPECT_THAT(
      message(element("CPE4") + section("") + cube +
              "*ELEMENT, TYPE=B31, ELSET=L\n9, 2, 11\n"
              "*BEAM SECTION, ELSET=L, MATERIAL=M, SECTION=RECT\n0.1, 0.1\n0, 0, 1\n"),
      HasSubstr("node 2 (3, 0, 0) is one of plane elements and of shells, beams or trusses: "
                "not supported"));
}

}  // namespace
}  // namespace osculate::io::inp
