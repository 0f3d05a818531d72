// The numbering of Abaqus and CalculiX elements against ours: nodes, Jacobians, sides.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <map>
#include <set>

#include "osculate/cell/facet_shape.hpp"
#include "osculate/cell/line_shape.hpp"
#include "osculate/cell/quadrature.hpp"
#include "osculate/cell/shape.hpp"
#include "osculate/cell/volume_shape.hpp"
#include "osculate/core/error.hpp"
#include "osculate/io/inp.hpp"
#include "osculate/io/inp/element_types.hpp"
#include "osculate/mesh/check.hpp"
#include "osculate/mesh/surface.hpp"

namespace osculate::io {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A shape as the manuals of Abaqus and CalculiX draw it; nodes are numbered from 1.
struct Drawing {
  std::vector<Vec3> corners;
  std::vector<std::pair<int, int>> middles;  ///< ends of the edges, in the order of their nodes
  std::vector<std::vector<int>> sides;       ///< corners of S1, S2, ...
};

const Drawing tetrahedron{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                          {{1, 2}, {2, 3}, {3, 1}, {1, 4}, {2, 4}, {3, 4}},
                          {{1, 2, 3}, {1, 4, 2}, {2, 4, 3}, {3, 4, 1}}};
const Drawing wedge{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}},
                    {{1, 2}, {2, 3}, {3, 1}, {4, 5}, {5, 6}, {6, 4}, {1, 4}, {2, 5}, {3, 6}},
                    {{1, 2, 3}, {4, 6, 5}, {1, 4, 5, 2}, {2, 5, 6, 3}, {3, 6, 4, 1}}};
const Drawing brick{
    {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
    {{1, 2},
     {2, 3},
     {3, 4},
     {4, 1},
     {5, 6},
     {6, 7},
     {7, 8},
     {8, 5},
     {1, 5},
     {2, 6},
     {3, 7},
     {4, 8}},
    {{1, 2, 3, 4}, {5, 8, 7, 6}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 8, 4}, {4, 8, 5, 1}}};
const Drawing triangle{
    {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{1, 2}, {2, 3}, {3, 1}}, {{1, 2}, {2, 3}, {3, 1}}};
const Drawing quadrangle{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                         {{1, 2}, {2, 3}, {3, 4}, {4, 1}},
                         {{1, 2}, {2, 3}, {3, 4}, {4, 1}}};

struct Case {
  std::string type;
  const Drawing& drawing;
  bool middles;
  cell::CellType cell, corners;  ///< the cell of the corners alone
};

using enum cell::CellType;
const std::vector<Case> solids{
    {"C3D4", tetrahedron, false, tet4, tet4},    {"c3d10", tetrahedron, true, tet10, tet4},
    {"C3D10MH", tetrahedron, true, tet10, tet4}, {"C3D6", wedge, false, wedge6, wedge6},
    {"C3D15", wedge, true, wedge15, wedge6},     {"C3D8", brick, false, hex8, hex8},
    {"C3D8R", brick, false, hex8, hex8},         {"C3D8I", brick, false, hex8, hex8},
    {"C3D8H", brick, false, hex8, hex8},         {"C3D20", brick, true, hex20, hex8},
    {"C3D20R", brick, true, hex20, hex8},        {"C3D20RH", brick, true, hex20, hex8}};

std::vector<Case> plane_cases() {
  std::vector<Case> all;
  for (const std::string family : {"CPE", "CPS", "CAX"}) {
    all.push_back({family + "3", triangle, false, tri3, tri3});
    all.push_back({family + "4", quadrangle, false, quad4, quad4});
    all.push_back({family + "4R", quadrangle, false, quad4, quad4});
    all.push_back({family + "4I", quadrangle, false, quad4, quad4});
    all.push_back({family + "6", triangle, true, tri6, tri3});
    all.push_back({family + "6M", triangle, true, tri6, tri3});
    all.push_back({family + "8", quadrangle, true, quad8, quad4});
    all.push_back({family + "8RH", quadrangle, true, quad8, quad4});
  }
  return all;
}

/// A shape of no symmetry, not mirrored; in the plane it stays there.
Vec3 placed(const Vec3& x, bool in_space) {
  Mat<3, 3> map;
  map << 2, 0.3, 0.2, -0.4, 1.5, 0.1, 0.25, -0.35, 1.2;
  if (!in_space) map.row(2).setZero(), map.col(2).setZero();
  return map * x + Vec3(3, 4, in_space ? 5 : 0);
}

/// One element with all of its sides as surfaces SIDE1, ...; nodes have ten times their number.
std::string deck(const Case& c, bool in_space, const std::string& label = "S") {
  std::vector<Vec3> nodes = c.drawing.corners;
  if (c.middles)
    for (const auto& [a, b] : c.drawing.middles)
      nodes.push_back(0.5 * (nodes[std::size_t(a - 1)] + nodes[std::size_t(b - 1)]));
  std::string text = "*NODE\n", element = "7";
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const Vec3 x = placed(nodes[k], in_space);
    text += fmt::format("{}, {}, {}, {}\n", 10 * (k + 1), x[0], x[1], x[2]);
    element += fmt::format(",{}{}", k == 8 ? "\n " : " ", 10 * (k + 1));
  }
  text += "*ELEMENT, TYPE=" + c.type + ", ELSET=ALL\n" + element + "\n";
  for (std::size_t s = 1; s <= c.drawing.sides.size(); ++s)
    text += fmt::format("*SURFACE, NAME=SIDE{}\nALL, {}{}\n", s, label, s);
  return text;
}

/// Where a cell of the mesh maps a point of its reference shape, and the Jacobian.
std::pair<Vec3, double> map_of(const mesh::Mesh& mesh, const mesh::CellRef& ref,
                               cell::CellType type, const Vec3& xi) {
  const Index* const nodes = mesh.blocks[std::size_t(ref.block)].cell(ref.cell);
  Vec3 x = Vec3::Zero();
  Mat<3, 3> jacobian = Mat<3, 3>::Zero();
  const bool solid = cell::info(type).dimension == 3;
  const cell::VolumeShape volume = cell::volume_shape(type, xi);
  const cell::AreaShape area = solid ? cell::AreaShape{} : cell::area_shape(type, xi.head<2>());
  for (int k = 0; k < cell::info(type).nodes; ++k) {
    const Vec3& node = mesh.nodes[std::size_t(nodes[k])];
    x += (solid ? volume.n[k] : area.n[k]) * node;
    if (solid)
      jacobian += node * volume.d.row(k);
    else
      jacobian.leftCols<2>() += node * area.d.row(k);
  }
  if (!solid) jacobian(2, 2) = 1;
  return {x, jacobian.determinant()};
}

void expect_straight(const Case& c, const mesh::Mesh& mesh) {
  ASSERT_EQ(mesh.find_set("ALL")->cells.size(), 1u);
  const mesh::CellRef ref = mesh.find_set("ALL")->cells[0];
  EXPECT_EQ(mesh.blocks[std::size_t(ref.block)].type, c.cell);
  for (const Vec3& xi : {Vec3(0.2, 0.3, 0.1), Vec3(0.5, 0.1, 0.3), Vec3(0.1, 0.1, 0.7)}) {
    const auto [x, jacobian] = map_of(mesh, ref, c.cell, xi);
    const auto [straight, reference] = map_of(mesh, ref, c.corners, xi);
    EXPECT_NEAR((x - straight).norm(), 0, 1e-13) << c.type;
    EXPECT_GT(jacobian, 0) << c.type;
    EXPECT_NEAR(jacobian, reference, 1e-12) << c.type;
  }
}

/// The resultant of a unit pressure from outside: minus the integral of r_1 x r_2.
Vec3 thrust(const mesh::Mesh& mesh, const mesh::CellRef& ref) {
  const mesh::Block& block = mesh.blocks[std::size_t(ref.block)];
  const cell::Quadrature2D rule =
      cell::is_triangle(block.type) ? cell::gauss_triangle(4) : cell::gauss_quad(3);
  Vec3 sum = Vec3::Zero();
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    const cell::FacetShape shape = cell::facet_shape(block.type, rule.points[q], 1);
    Vec3 r1 = Vec3::Zero(), r2 = Vec3::Zero();
    for (std::size_t k = 0; k < std::size_t(shape.count); ++k) {
      const Vec3& x = mesh.nodes[std::size_t(block.cell(ref.cell)[k])];
      r1 += shape.n[1][k] * x;
      r2 += shape.n[2][k] * x;
    }
    sum -= rule.weights[q] * r1.cross(r2);
  }
  return sum;
}

/// The same of a line, per unit of thickness: minus k x the way along it.
Vec3 line_thrust(const mesh::Mesh& mesh, const mesh::CellRef& ref) {
  const Index* const nodes = mesh.blocks[std::size_t(ref.block)].cell(ref.cell);
  const Vec3 way = mesh.nodes[std::size_t(nodes[1])] - mesh.nodes[std::size_t(nodes[0])];
  return -Vec3::UnitZ().cross(way);
}

/// From the drawing: the polygon of the corners, turned inwards.
Vec3 drawn_thrust(const Case& c, const std::vector<int>& side, bool in_space) {
  std::vector<Vec3> x;
  Vec3 middle = Vec3::Zero(), centre = Vec3::Zero(), sum = Vec3::Zero();
  for (const Vec3& corner : c.drawing.corners)
    centre += placed(corner, in_space) / double(c.drawing.corners.size());
  for (const int corner : side) {
    x.push_back(placed(c.drawing.corners[std::size_t(corner - 1)], in_space));
    middle += x.back() / double(side.size());
  }
  if (!in_space) sum = Vec3::UnitZ().cross(x[1] - x[0]);
  for (std::size_t k = 1; in_space && k + 1 < x.size(); ++k)
    sum += 0.5 * (x[k] - x[0]).cross(x[k + 1] - x[0]);
  return sum.dot(centre - middle) > 0 ? sum : Vec3(-sum);
}

std::set<std::int64_t> corner_numbers(const mesh::Mesh& mesh, const mesh::CellRef& ref) {
  const mesh::Block& block = mesh.blocks[std::size_t(ref.block)];
  std::set<std::int64_t> numbers;
  for (int k = 0; k < cell::info(block.type).corners; ++k)
    numbers.insert(mesh::node_number(mesh, block.cell(ref.cell)[k]));
  return numbers;
}

void expect_sides(const Case& c, const mesh::Mesh& mesh, bool in_space) {
  Vec3 all = Vec3::Zero();
  for (std::size_t s = 0; s < c.drawing.sides.size(); ++s) {
    const mesh::Set* const set = mesh.find_set(fmt::format("SIDE{}", s + 1));
    ASSERT_TRUE(set) << c.type;
    ASSERT_EQ(set->cells.size(), 1u);
    EXPECT_EQ(set->dimension, in_space ? 2 : 1);
    std::set<std::int64_t> drawn;
    for (const int corner : c.drawing.sides[s]) drawn.insert(10 * corner);
    EXPECT_EQ(corner_numbers(mesh, set->cells[0]), drawn) << c.type << " S" << s + 1;
    const Vec3 force = in_space ? thrust(mesh, set->cells[0]) : line_thrust(mesh, set->cells[0]);
    EXPECT_NEAR((force - drawn_thrust(c, c.drawing.sides[s], in_space)).norm(), 0, 1e-13)
        << c.type << " S" << s + 1;
    all += force;
    const bool clean = in_space
                           ? mesh::surface_of(mesh, mesh::face_table(mesh), *set).errors.empty()
                           : mesh::surface_of(mesh, mesh::edge_table(mesh), *set).errors.empty();
    EXPECT_TRUE(clean) << "the middles of the side are not those of its cell: " << c.type;
  }
  EXPECT_NEAR(all.norm(), 0, 1e-13) << c.type;
}

TEST(InpElements, SolidsHaveTheirNodesAndSidesWhereTheManualsDrawThem) {
  for (const Case& c : solids) {
    const mesh::Mesh mesh = read_inp(deck(c, true), "a.inp");
    expect_straight(c, mesh);
    expect_sides(c, mesh, true);
    for (const mesh::Finding& finding : mesh::check_mesh(mesh)) EXPECT_EQ(finding.message, "");
    EXPECT_EQ(mesh::cell_number(mesh, mesh.find_set("ALL")->cells[0]), 7);
  }
}

TEST(InpElements, PlaneElementsHaveTheirNodesAndEdgesWhereTheManualsDrawThem) {
  for (const Case& c : plane_cases())
    for (const std::string label : {"S", "E"}) {
      const mesh::Mesh mesh = read_inp(deck(c, false, label), "a.inp");
      expect_straight(c, mesh);
      expect_sides(c, mesh, false);
      for (const mesh::Finding& finding : mesh::check_mesh(mesh)) EXPECT_EQ(finding.message, "");
    }
}

TEST(InpElements, FreeSidesOfOneElementAreAllOfThem) {
  for (const Case& c : solids) {
    const mesh::Mesh mesh = read_inp(deck(c, true) + "*SURFACE, NAME=SKIN\nALL\n", "a.inp");
    const mesh::Set& skin = *mesh.find_set("SKIN");
    EXPECT_EQ(skin.cells.size(), c.drawing.sides.size());
    Vec3 all = Vec3::Zero();
    for (const mesh::CellRef& ref : skin.cells) all += thrust(mesh, ref);
    EXPECT_NEAR(all.norm(), 0, 1e-13);
    // They are the cells that the sides have already.
    for (const mesh::CellRef& ref : mesh.find_set("SIDE2")->cells)
      EXPECT_THAT(skin.cells, ::testing::Contains(ref));
  }
}

TEST(InpElements, ShellsAndMembranesAreSurfacesWithTwoSides) {
  const std::string nodes =
      "*NODE\n1, 0, 0, 0\n2, 2, 0, 0\n3, 2, 1, 0\n4, 0, 1, 0\n5, 1, 0, 0\n6, 2, .5\n7, 1, 1\n8, 0, "
      ".5\n9, 1, .5\n";
  const std::map<std::string, std::string> quads{{"S4R", "1, 2, 3, 4"},
                                                 {"S4", "1, 2, 3, 4"},
                                                 {"M3D4", "1, 2, 3, 4"},
                                                 {"SFM3D4R", "1, 2, 3, 4"},
                                                 {"R3D4", "1, 2, 3, 4"},
                                                 {"S8R", "1, 2, 3, 4, 5, 6, 7, 8"},
                                                 {"M3D8", "1, 2, 3, 4, 5, 6, 7, 8"},
                                                 {"M3D9", "1, 2, 3, 4, 5, 6, 7, 8, 9"}};
  for (const auto& [type, element] : quads) {
    const mesh::Mesh mesh = read_inp(
        nodes + "*ELEMENT, TYPE=" + type + ", ELSET=A\n1, " + element +
            "\n*SURFACE, NAME=UP\nA, SPOS\n*SURFACE, NAME=DOWN\nA, SNEG\n*SURFACE, NAME=RIM\nA, "
            "E2\n*SURFACE, NAME=CCX\nA, S4\n*SURFACE, NAME=ASIS\nA\n",
        "a.inp");
    EXPECT_NEAR((thrust(mesh, mesh.find_set("UP")->cells[0]) - Vec3(0, 0, -2)).norm(), 0, 1e-14);
    EXPECT_NEAR((thrust(mesh, mesh.find_set("DOWN")->cells[0]) - Vec3(0, 0, 2)).norm(), 0, 1e-14);
    EXPECT_EQ(mesh.find_set("UP")->cells, mesh.find_set("A")->cells);
    EXPECT_EQ(mesh.find_set("ASIS")->cells, mesh.find_set("A")->cells);
    EXPECT_EQ(mesh.find_set("RIM")->dimension, 1);
    EXPECT_EQ(corner_numbers(mesh, mesh.find_set("RIM")->cells[0]), (std::set<std::int64_t>{2, 3}));
    EXPECT_EQ(mesh.find_set("CCX")->cells, mesh.find_set("RIM")->cells);
  }
}

TEST(InpElements, BeamsAndTrussesHaveTheirMiddleBetweenTheEnds) {
  for (const std::string type : {"B32R", "B22", "T3D3", "T2D3"}) {
    const mesh::Mesh mesh =
        read_inp("*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 4, 0, 0\n*ELEMENT, TYPE=" + type +
                     ", ELSET=A\n1, 1, 2, 3\n",
                 "a.inp");
    EXPECT_EQ(mesh.blocks[0].type, line3);
    EXPECT_THAT(mesh.blocks[0].connectivity, ::testing::ElementsAre(0, 2, 1)) << type;
  }
}

TEST(InpElements, VariantsOfAllNamesThatAreKnown) {
  for (const char* const name :
       {"C3D8RH", "C3D8IH", "C3D8T", "C3D10HS", "C3D20RHT", "CPS4R", "CAX8RH", "S4R5", "S8R5",
        "S3R", "S4RSW", "STRI65", "R2D2", "RAX2", "B31", "B31H", "B32R", "T2D2H"})
    EXPECT_TRUE(inp::find_element_type(name)) << name;
  for (const char* const name :
       {"C3D8Z", "C3D8RR", "C3D", "C3D27", "c3d8", "", "DC3D8", "F3D8", "S", "SPRINGA", "MASS",
        "B33", "C3D20 R", "C3D20B", "C3D20BR", "C3D20RBT", "U1", "CONN3D2", "S4R55"})
    EXPECT_FALSE(inp::find_element_type(name)) << name;
}

TEST(InpElements, SidesThatThereAreNot) {
  const auto refusal = [](const Case& c, const std::string& side) {
    try {
      (void)read_inp(deck(c, true) + "*SURFACE, NAME=X\nALL, " + side + "\n", "a.inp");
    } catch (const core::InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(refusal(solids[0], "S5"),
              HasSubstr("element 7 of type C3D4 has no side 'S5'; expected S1 to S4"));
  EXPECT_THAT(refusal(solids[3], "S6"), HasSubstr("expected S1 to S5"));
  for (const std::string side : {"S0", "S7", "S10", "E1", "SPOS", "S", "P1", "S-1"})
    EXPECT_THAT(refusal(solids[5], side), HasSubstr("expected S1 to S6")) << side;
  EXPECT_THAT(refusal(solids[5], "s6"), IsEmpty());
}

}  // namespace
}  // namespace osculate::io
