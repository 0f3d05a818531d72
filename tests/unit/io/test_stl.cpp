// STL files, text and binary: corners that meet are one node, solids are sets.
#include "osculate/io/stl.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <limits>

#include "osculate/core/error.hpp"
#include "osculate/io/mesh_format.hpp"
#include "osculate/mesh/surface.hpp"

namespace osculate::io {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Corner = std::array<double, 3>;

std::string facet(const std::array<Corner, 3>& corners) {
  std::string text = "facet normal nan 0 0\n outer loop\n";
  for (const auto& [x, y, z] : corners) text += fmt::format("  vertex {} {} {:e}\n", x, y, z);
  return text + " endloop\nendfacet\n";
}

/// The four sides of a tetrahedron, from outside.
const std::array<std::array<Corner, 3>, 4> sides{{{{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}}},
                                                  {{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}},
                                                  {{{0, 0, 0}, {0, 0, 1}, {0, 1, 0}}},
                                                  {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}}};

std::string text() {
  std::string all = "solid tetrahedron of one\n";
  for (const auto& side : sides) all += facet(side);
  return all + "endsolid tetrahedron of one\n";
}

std::string binary() {
  std::string all(80, 's');
  const auto put = [&](const auto& value) {
    all.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  put(static_cast<std::uint32_t>(sides.size()));
  for (const auto& side : sides) {
    for (int k = 0; k < 3; ++k) put(0.0F);
    for (const Corner& corner : side)
      for (const double x : corner) put(static_cast<float>(x));
    put(std::uint16_t{0});
  }
  return all;
}

std::string refusal(const std::string& content) {
  try {
    (void)read_stl(content, "a.stl");
  } catch (const core::InputError& error) {
    return error.what();
  }
  return {};
}

TEST(Stl, TextAndBinaryAreTheSameClosedSurface) {
  for (const std::string& content : {text(), binary()}) {
    EXPECT_TRUE(looks_like_stl(content));
    const mesh::Mesh mesh = read_mesh(content, "without extension");
    EXPECT_EQ(mesh.nodes.size(), 4u);
    ASSERT_EQ(mesh.blocks.size(), 1u);
    EXPECT_EQ(mesh.blocks[0].type, cell::CellType::tri3);
    EXPECT_EQ(mesh.blocks[0].size(), 4);
    ASSERT_EQ(mesh.sets.size(), 1u);
    EXPECT_THAT(mesh.sets[0].nodes, ElementsAre(0, 1, 2, 3));
    const auto surface = mesh::surface_of(mesh, mesh::face_table(mesh), mesh.sets[0]);
    EXPECT_TRUE(surface.errors.empty());
    double volume = 0;
    for (const auto& side : surface.facets) {
      const auto x = [&](std::size_t k) { return mesh.nodes[std::size_t(side.node[k])]; };
      volume += x(0).dot(x(1).cross(x(2))) / 6;
      for (const Index neighbour : {side.next[0], side.next[1], side.next[2]})
        EXPECT_GE(neighbour, 0);
    }
    EXPECT_DOUBLE_EQ(volume, 1.0 / 6);
  }
  EXPECT_EQ(read_stl(text(), "").sets[0].name, "tetrahedron of one");
  EXPECT_EQ(read_stl(binary(), "").sets[0].name, "surface");
}

TEST(Stl, SolidsAreSetsAndTrianglesWithoutAreaAreLeftOut) {
  const mesh::Mesh mesh =
      read_stl("solid a\n" + facet(sides[0]) + facet({{{1, 1, 1}, {1, 1, 1}, {2, 0, 0}}}) +
                   "endsolid\nsolid b\n" + facet(sides[1]) + "endsolid b\nsolid a\n" +
                   facet(sides[2]) + "endsolid",
               "a.stl");
  EXPECT_EQ(mesh.blocks[0].size(), 3);
  ASSERT_EQ(mesh.sets.size(), 2u);
  EXPECT_EQ(mesh.find_set("a")->cells.size(), 2u);
  EXPECT_EQ(mesh.find_set("b")->cells.size(), 1u);
}

TEST(Stl, WhatIsWrongIsSaidWithItsLine) {
  EXPECT_THAT(refusal("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 x\n"),
              HasSubstr("a.stl:4: expected a coordinate, found 'x'"));
  EXPECT_THAT(refusal("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 1e999\n"),
              HasSubstr("expected a coordinate, found '1e999'"));
  EXPECT_THAT(refusal("solid a\n"), HasSubstr("a.stl:2: the file ends before 'endsolid'"));
  EXPECT_THAT(refusal("solid a\nfacet normal 0 0 1\nouter lop"),
              HasSubstr("a.stl:3: expected 'loop', found 'lop'"));
  EXPECT_THAT(refusal("solid a\nendsolid a\n"), HasSubstr("a.stl: the file has no triangles"));
  EXPECT_THAT(refusal("hello"), HasSubstr("a.stl:1: expected 'solid'"));
  EXPECT_THAT(refusal(""), HasSubstr("the file has no triangles"));
  std::string broken = binary();
  const float infinite = std::numeric_limits<float>::infinity();
  std::memcpy(broken.data() + 84 + 50 + 12, &infinite, sizeof infinite);
  EXPECT_THAT(refusal(broken), HasSubstr("a coordinate of triangle 2 is no number"));
}

TEST(MeshFormats, GoByExtensionThenByContent) {
  EXPECT_EQ(mesh_format_of("A.STL", "")->name, "STL");
  EXPECT_EQ(mesh_format_of("a.msh", text())->name, "Gmsh");
  EXPECT_EQ(mesh_format_of("a", "$MeshFormat")->name, "Gmsh");
  EXPECT_EQ(mesh_format_of("a.yaml", "curve: {}"), nullptr);
  EXPECT_THROW((void)read_mesh("solid state physics", "a"), core::InputError);
}

}  // namespace
}  // namespace osculate::io
