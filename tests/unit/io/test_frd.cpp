#include "osculate/io/frd.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <sstream>

#include "osculate/core/error.hpp"
#include "osculate/io/atomic_file.hpp"
#include "osculate/io/inp.hpp"
#include "osculate/io/read_frd.hpp"

namespace osculate::io {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// A deck with one element whose node k has the number k.
mesh::Mesh one_element(const std::string& type, int nodes) {
  std::string text = "*NODE\n", element;
  for (int n = 1; n <= nodes; ++n) {
    text += fmt::format("{}, {}, {}, 0.25\n", n, 10 * n, n * n);
    element += fmt::format(", {}", n);
  }
  const std::size_t half = element.size() > 60 ? element.find(',', 40) + 1 : element.size();
  text += fmt::format("*ELEMENT, TYPE={}, ELSET=E\n7{}\n{}\n", type, element.substr(0, half),
                      element.substr(half));
  return read_inp(text, "one.inp");
}

FrdMesh all_cells(const mesh::Mesh& mesh) {
  std::vector<FrdMesh::Cell> cells;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b)
    for (Index c = 0; c < mesh.blocks[b].size(); ++c)
      cells.push_back({{static_cast<Index>(b), c}, 1});
  return frd_mesh(mesh, std::move(cells));
}

/// Type and nodes of the only cell of a file.
std::pair<int, std::vector<int>> written(const mesh::Mesh& mesh) {
  std::istringstream text(frd_cells(all_cells(mesh), mesh));
  std::string word;
  int count = 0, format = 0, number = 0, type = 0, group = 0, material = 0;
  text >> word >> count >> format >> word >> number >> type >> group >> material;
  EXPECT_EQ(count, 1);
  EXPECT_EQ(number, 7);
  std::vector<int> nodes;
  while (text >> word && word != "-3") {
    std::string line;
    std::getline(text, line);
    std::istringstream values(line);
    for (int node = 0; values >> node;) nodes.push_back(node);
  }
  return {type, nodes};
}

std::vector<int> up_to(int last) {
  std::vector<int> list;
  for (int n = 1; n <= last; ++n) list.push_back(n);
  return list;
}

TEST(Frd, CellsThatHaveTheOrderOfTheDeck) {
  for (const auto& [name, nodes, type] :
       std::vector<std::tuple<std::string, int, int>>{{"C3D8", 8, 1},
                                                      {"C3D6", 6, 2},
                                                      {"C3D4", 4, 3},
                                                      {"C3D10", 10, 6},
                                                      {"CPE3", 3, 7},
                                                      {"CPS6", 6, 8},
                                                      {"CAX4", 4, 9},
                                                      {"CPE8R", 8, 10}})
    EXPECT_EQ(written(one_element(name, nodes)), std::pair(type, up_to(nodes))) << name;
}

TEST(Frd, EdgesBetweenTheFacesComeBeforeThoseOfTheSecondFace) {
  EXPECT_EQ(written(one_element("C3D20R", 20)),
            std::pair(4, std::vector{1,  2,  3,  4,  5,  6,  7,  8,  9,  10,
                                     11, 12, 17, 18, 19, 20, 13, 14, 15, 16}));
  EXPECT_EQ(written(one_element("C3D15", 15)),
            std::pair(5, std::vector{1, 2, 3, 4, 5, 6, 7, 8, 9, 13, 14, 15, 10, 11, 12}));
}

TEST(Frd, CellsThatTheFormatDoesNotHaveAreShownByOthers) {
  using enum cell::CellType;
  EXPECT_EQ(frd_cell(hex27).nodes, frd_cell(hex20).nodes);
  EXPECT_EQ(frd_cell(quad9).nodes, frd_cell(quad8).nodes);
  EXPECT_THAT(frd_cell(shell18).nodes, ElementsAre(0, 1, 2, 3, 9, 10, 11, 12));
  EXPECT_EQ(frd_cell(point1).type, 0);
}

TEST(Frd, BeamsHaveTheMiddleLast) {
  using enum cell::CellType;
  EXPECT_EQ(frd_cell(line2).type, 11);
  EXPECT_EQ(frd_cell(line3).type, 12);
  EXPECT_THAT(frd_cell(line3).nodes, ElementsAre(0, 1, 2));
}

TEST(Frd, AShellIsWrittenByItsOwnNodes) {
  const mesh::Mesh mesh = read_inp(
      "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n*ELEMENT, TYPE=S3, ELSET=E\n7, 1, 2, 3\n"
      "*SHELL SECTION, ELSET=E, MATERIAL=M\n0.1\n",
      "shell.inp");
  EXPECT_EQ(written(mesh), std::pair(2, std::vector{4, 6, 8, 5, 7, 9}));
  const mesh::ThinElements thin = mesh::thin_elements(mesh);
  ASSERT_EQ(thin.elements.size(), 1U);
  const mesh::CellRef ref = thin.elements[0].cell;
  const FrdMesh part = frd_mesh(mesh, {{ref, 1, 0, thin.elements.data()}});
  EXPECT_THAT(part.numbers, ElementsAre(1, 2, 3));
  EXPECT_THAT(frd_cells(part, mesh), HasSubstr(" -1         7    7    0    1\n"
                                               " -2         1         2         3\n"));
}

mesh::Mesh two_triangles() {
  mesh::Mesh mesh;
  for (const double x : {0, 1, 2, 3, 4}) mesh.nodes.emplace_back(x, -x / 8, 0);
  mesh.numbers = {50, 40, 30, 20, 10};
  mesh.blocks.push_back({cell::CellType::tri3, {0, 1, 2, 2, 1, 4}, {8, 3}});
  return mesh;
}

TEST(Frd, NodesAndCellsAreSortedByTheirNumbersAndIdleNodesAreLeftOut) {
  const mesh::Mesh mesh = two_triangles();
  const FrdMesh part = all_cells(mesh);
  EXPECT_THAT(part.numbers, ElementsAre(10, 30, 40, 50));
  EXPECT_THAT(part.nodes, ElementsAre(4, 2, 1, 0));
  EXPECT_EQ(frd_nodes(part, mesh),
            "    2C                             4                                     1\n"
            " -1        10 4.00000E+00-5.00000E-01 0.00000E+00\n"
            " -1        30 2.00000E+00-2.50000E-01 0.00000E+00\n"
            " -1        40 1.00000E+00-1.25000E-01 0.00000E+00\n"
            " -1        50 0.00000E+00 0.00000E+00 0.00000E+00\n"
            " -3\n");
  EXPECT_EQ(frd_cells(part, mesh),
            "    3C                             2                                     1\n"
            " -1         3    7    0    1\n"
            " -2        30        40        10\n"
            " -1         8    7    0    1\n"
            " -2        50        40        30\n"
            " -3\n");
}

TEST(Frd, NumbersThatAreNotUniqueGiveWay) {
  mesh::Mesh mesh = two_triangles();
  mesh.numbers = {5, 4, 3, 2, 4};
  mesh.blocks[0].numbers = {3, 3};
  const FrdMesh part = all_cells(mesh);
  EXPECT_THAT(part.numbers, ElementsAre(1, 2, 3, 4));
  EXPECT_EQ(part.cells[0].number, 1);
  EXPECT_EQ(part.cells[1].number, 2);
}

TEST(Frd, FieldsStandInTheColumnsOfTheFormat) {
  const FrdMesh part = all_cells(two_triangles());
  const double none = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> values{1, -2.5, 0, 1e-120, -1e130, none, 3, 4, 5, 6, 7, 8};
  const std::vector<std::string_view> names{"DISP", "D1", "D2", "D3"};
  EXPECT_EQ(frd_field(part, {12, 3, 2, 5, 0.5}, true, names, values),
            "    1PSTEP                        12           3           2          \n"
            "  100CL  105 5.00000E-01           4                     0    5           1\n"
            " -4  DISP        4    1\n"
            " -5  D1          1    2    1    0\n"
            " -5  D2          1    2    2    0\n"
            " -5  D3          1    2    3    0\n"
            " -5  ALL         1    2    0    0    1ALL\n"
            " -1        10 1.00000E+00-2.50000E+00 0.00000E+00\n"
            " -1        30 0.00000E+00-9.99999E+99 0.00000E+00\n"
            " -1        40 3.00000E+00 4.00000E+00 5.00000E+00\n"
            " -1        50 6.00000E+00 7.00000E+00 8.00000E+00\n"
            " -3\n");
  const std::vector<std::string_view> scalar{"PE", "PE"};
  const std::string text =
      frd_field(part, {1, 1, 1, 1, 1234.5}, false, scalar, std::vector<double>{1, 2, 3, 4});
  EXPECT_THAT(text, HasSubstr("  100CL  101 1234.500000           4"));
  EXPECT_THAT(text, HasSubstr(" -4  PE          1    1\n -5  PE          1    1    0    0\n"));
  FrdTime mode{5, 1, 1, 2, 0, FrdTime::Mode{2, 1.473508e10, 19319.52008}};
  EXPECT_THAT(frd_field(part, mode, true, names, values),
              StartsWith("    1PSTEP                         5           1           1          \n"
                         "    1PGM                1.000000E+00                                  \n"
                         "    1PGK                1.473508E+10                                  \n"
                         "    1PHID                         -1                                  \n"
                         "    1PSUBC                         0                                  \n"
                         "    1PMODE                         2                                  \n"
                         "  100CL  102 19319.52008           4                     2    2MODAL  "
                         "    1\n -4  DISP        4    1\n"));
  const std::vector<std::string_view> tensor{"STRESS", "SXX", "SYY", "SZZ", "SXY", "SYZ", "SZX"};
  const std::vector<double> six(24, 1.0);
  EXPECT_THAT(frd_field(part, {1, 1, 1, 1, 1}, false, tensor, six),
              HasSubstr(" -4  STRESS      6    1\n"
                        " -5  SXX         1    4    1    1\n"
                        " -5  SYY         1    4    2    2\n"
                        " -5  SZZ         1    4    3    3\n"
                        " -5  SXY         1    4    1    2\n"
                        " -5  SYZ         1    4    2    3\n"
                        " -5  SZX         1    4    3    1\n"));
  EXPECT_THROW((void)frd_field(part, {}, false, scalar, six), std::invalid_argument);
}

TEST(Frd, TheHeadNamesTheMaterials) {
  const std::string text =
      frd_head({"A title", "Osculate", "0.1", "1.may.2026", "10:11:12", {"STEEL", "RUBBER"}});
  EXPECT_THAT(text, StartsWith("    1C\n    1UA title"));
  EXPECT_THAT(text, HasSubstr("    1UDATE              1.may.2026"));
  EXPECT_THAT(text, HasSubstr("    1UPGM               Osculate"));
  EXPECT_THAT(text, HasSubstr("    1UMAT    1STEEL"));
  EXPECT_THAT(text, HasSubstr("    1UMAT    2RUBBER"));
}

FrdContent read_back(const std::string& text) {
  const std::string path = (std::filesystem::temp_directory_path() / "osculate_read.frd").string();
  write_file(path, text);
  return read_frd(path);
}

/// Two triangles with displacements at time 0.5 and a vibration.
std::string whole_file() {
  const mesh::Mesh mesh = two_triangles();
  const FrdMesh part = all_cells(mesh);
  const std::vector<double> values{1, -2.5, 0, 0.25, -1e99, 7, 3, 4, 5, 6, 7, 8};
  const std::vector<std::string_view> names{"DISP", "D1", "D2", "D3"};
  return frd_head({"A title", "Osculate", "0.1", "1.may.2026", "10:11:12", {"STEEL"}}) +
         frd_nodes(part, mesh) + frd_cells(part, mesh) +
         frd_field(part, {1, 1, 1, 1, 0.5}, true, names, values) +
         frd_field(part, {2, 1, 1, 2, 0, FrdTime::Mode{2, 1.5e10, 19319.5}}, true, names, values) +
         std::string(frd_end);
}

TEST(Frd, WhatIsWrittenIsRead) {
  const FrdContent content = read_back(whole_file());
  EXPECT_THAT(content.nodes, ElementsAre(10, 30, 40, 50));
  EXPECT_EQ(content.places[1], Vec3(2, -0.25, 0));
  ASSERT_EQ(content.results.size(), 2u);
  EXPECT_EQ(content.results[0].name, "DISP");
  EXPECT_EQ(content.results[0].time, 0.5);
  EXPECT_FALSE(content.results[0].mode);
  EXPECT_EQ(content.results[0].nodes, content.nodes);
  EXPECT_THAT(content.results[0].values, ElementsAre(1, -2.5, 0, 0.25, -1e99, 7, 3, 4, 5, 6, 7, 8));
  EXPECT_TRUE(content.results[1].mode);
  EXPECT_EQ(content.results[1].time, 19319.5);
}

TEST(Frd, WhatIsNotReadIsRefusedWithItsLine) {
  const std::string good = whole_file();
  const auto refused = [](const std::string& text) -> std::string {
    try {
      (void)read_back(text);
    } catch (const core::InputError& error) {
      return error.what();
    }
    return "it was read";
  };
  const auto without = [&](const std::string& what, const std::string& instead) {
    std::string text = good;
    return text.replace(text.find(what), what.size(), instead);
  };
  EXPECT_THAT(refused(good.substr(0, good.rfind(" -3"))), HasSubstr("ends within a block"));
  EXPECT_THAT(refused(without("-2.50000E+00", "-2.5oooo0E+0")), HasSubstr("expected a number"));
  EXPECT_THAT(refused(without("    1           1\n -4", "    1           2\n -4")),
              HasSubstr("only .frd files in ASCII"));
  EXPECT_THAT(refused(without(" 7.00000E+00\n", "\n")), HasSubstr("not all nodes"));
  EXPECT_THAT(refused("1, 2, 3\n"), HasSubstr("it has no nodes"));
}

}  // namespace
}  // namespace osculate::io
