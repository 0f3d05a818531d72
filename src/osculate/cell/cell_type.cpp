#include "osculate/cell/cell_type.hpp"

namespace osculate::cell {
namespace {

using enum CellType;
constexpr std::array<std::array<std::int8_t, 3>, 4> no_edges{};
using Face = std::array<std::int8_t, 4>;  // corners; the last is -1 for a triangle
using Pair = std::array<std::int8_t, 2>;

constexpr std::array<Face, 4> tet_faces{
    {{0, 2, 1, -1}, {0, 1, 3, -1}, {0, 3, 2, -1}, {1, 2, 3, -1}}};
constexpr std::array<Pair, 6> tet_edges{{{0, 1}, {1, 2}, {2, 0}, {3, 0}, {2, 3}, {1, 3}}};
constexpr std::array<Face, 5> wedge_faces{
    {{0, 2, 1, -1}, {3, 4, 5, -1}, {0, 1, 4, 3}, {0, 3, 5, 2}, {1, 2, 5, 4}}};
constexpr std::array<Pair, 9> wedge_edges{
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 4}, {2, 5}, {3, 4}, {3, 5}, {4, 5}}};
/// In the order of the middle nodes of hex27.
constexpr std::array<Face, 6> hex_faces{
    {{0, 3, 2, 1}, {0, 1, 5, 4}, {0, 4, 7, 3}, {1, 2, 6, 5}, {2, 3, 7, 6}, {4, 5, 6, 7}}};
constexpr std::array<Pair, 12> hex_edges{{{0, 1},
                                          {0, 3},
                                          {0, 4},
                                          {1, 2},
                                          {1, 5},
                                          {2, 3},
                                          {2, 6},
                                          {3, 7},
                                          {4, 5},
                                          {4, 7},
                                          {5, 6},
                                          {6, 7}}};

/// The node in the middle of an edge: they follow the corners in the order of the edges.
template <std::size_t E>
constexpr std::int8_t middle(const std::array<Pair, E>& edges, int corners, int a, int b) {
  for (std::size_t e = 0; e < E; ++e)
    if ((edges[e][0] == a && edges[e][1] == b) || (edges[e][0] == b && edges[e][1] == a))
      return static_cast<std::int8_t>(corners + static_cast<int>(e));
  return -1;
}

/// Adds the faces to a volume cell; hex27 has middle nodes of faces after those of the edges.
template <std::size_t F, std::size_t E>
constexpr CellInfo volume(CellInfo cell, const std::array<Face, F>& faces,
                          const std::array<Pair, E>& edges) {
  cell.face_count = static_cast<int>(F);
  const bool centered = cell.type == hex27;
  for (std::size_t f = 0; f < F; ++f) {
    CellFace& face = cell.faces[f];
    const std::size_t corners = faces[f][3] < 0 ? 3 : 4;
    if (corners == 3)
      face.type = cell.order == 1 ? tri3 : tri6;
    else
      face.type = cell.order == 1 ? quad4 : centered ? quad9 : quad8;
    for (std::size_t k = 0; k < corners; ++k) {
      face.nodes[k] = faces[f][k];
      if (cell.order == 2)
        face.nodes[corners + k] =
            middle(edges, cell.corners, faces[f][k], faces[f][(k + 1) % corners]);
    }
    if (centered) face.nodes[8] = static_cast<std::int8_t>(20 + static_cast<int>(f));
  }
  return cell;
}

constexpr CellInfo two_faced_shell() {
  CellInfo cell{shell18, "shell18", 3, 18, 8, 2, 0, 12, point1, 0, no_edges};
  cell.face_count = 6;
  cell.faces = {{{quad9, {0, 3, 2, 1, 7, 6, 5, 4, 8}},
                 {quad9, {9, 10, 11, 12, 13, 14, 15, 16, 17}},
                 {quad4, {0, 1, 10, 9}},
                 {quad4, {1, 2, 11, 10}},
                 {quad4, {2, 3, 12, 11}},
                 {quad4, {3, 0, 9, 12}}}};
  return cell;
}

constexpr std::array<CellInfo, cell_type_count> table{{
    {point1, "point1", 0, 1, 1, 0, 15, 1, point1, 0, no_edges},
    {line2, "line2", 1, 2, 2, 1, 1, 3, point1, 0, no_edges},
    {line3, "line3", 1, 3, 2, 2, 8, 21, point1, 0, no_edges},
    {line4, "line4", 1, 4, 2, 3, 26, 35, point1, 0, no_edges},
    {tri3, "tri3", 2, 3, 3, 1, 2, 5, line2, 3, {{{0, 1, -1}, {1, 2, -1}, {2, 0, -1}, {}}}},
    {tri6, "tri6", 2, 6, 3, 2, 9, 22, line3, 3, {{{0, 1, 3}, {1, 2, 4}, {2, 0, 5}, {}}}},
    {quad4,
     "quad4",
     2,
     4,
     4,
     1,
     3,
     9,
     line2,
     4,
     {{{0, 1, -1}, {1, 2, -1}, {2, 3, -1}, {3, 0, -1}}}},
    {quad8, "quad8", 2, 8, 4, 2, 16, 23, line3, 4, {{{0, 1, 4}, {1, 2, 5}, {2, 3, 6}, {3, 0, 7}}}},
    {quad9, "quad9", 2, 9, 4, 2, 10, 28, line3, 4, {{{0, 1, 4}, {1, 2, 5}, {2, 3, 6}, {3, 0, 7}}}},
    volume({tet4, "tet4", 3, 4, 4, 1, 4, 10, point1, 0, no_edges}, tet_faces, tet_edges),
    volume({tet10, "tet10", 3, 10, 4, 2, 11, 24, point1, 0, no_edges}, tet_faces, tet_edges),
    volume({wedge6, "wedge6", 3, 6, 6, 1, 6, 13, point1, 0, no_edges}, wedge_faces, wedge_edges),
    volume({wedge15, "wedge15", 3, 15, 6, 2, 18, 26, point1, 0, no_edges}, wedge_faces,
           wedge_edges),
    volume({hex8, "hex8", 3, 8, 8, 1, 5, 12, point1, 0, no_edges}, hex_faces, hex_edges),
    volume({hex20, "hex20", 3, 20, 8, 2, 17, 25, point1, 0, no_edges}, hex_faces, hex_edges),
    volume({hex27, "hex27", 3, 27, 8, 2, 12, 29, point1, 0, no_edges}, hex_faces, hex_edges),
    two_faced_shell(),
}};

constexpr std::array<std::int8_t, 10> same_order{0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
constexpr std::array<std::int8_t, 10> vtk_tet10{0, 1, 2, 3, 4, 5, 6, 7, 9, 8};
constexpr std::array<std::int8_t, 15> vtk_wedge15{0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11};
/// Its first twenty are hex20.
constexpr std::array<std::int8_t, 27> vtk_hex27{0,  1,  2,  3,  4,  5,  6,  7,  8,
                                                11, 13, 9,  16, 18, 19, 17, 10, 12,
                                                14, 15, 22, 23, 21, 24, 20, 25, 26};
constexpr std::array<std::int8_t, 8> vtk_shell18{0, 1, 2, 3, 9, 10, 11, 12};

}  // namespace

const CellInfo& info(CellType type) { return table[static_cast<std::size_t>(type)]; }

std::span<const CellInfo> all_cells() { return table; }

const CellInfo* find_cell(std::string_view name) {
  for (const CellInfo& cell : table)
    if (cell.name == name) return &cell;
  return nullptr;
}

const CellInfo* find_gmsh_cell(int gmsh_type) {
  for (const CellInfo& cell : table)
    if (cell.gmsh_type == gmsh_type && gmsh_type != 0) return &cell;
  return nullptr;
}

std::span<const std::int8_t> vtk_nodes(CellType type) {
  switch (type) {
    case tet10:
      return vtk_tet10;
    case wedge15:
      return vtk_wedge15;
    case hex20:
      return std::span(vtk_hex27).first(20);
    case hex27:
      return vtk_hex27;
    case shell18:
      return vtk_shell18;
    default:
      return std::span(same_order).first(static_cast<std::size_t>(info(type).nodes));
  }
}

}  // namespace osculate::cell
