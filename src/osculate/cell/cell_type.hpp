#pragma once
#include <array>
#include <span>
#include <string_view>

#include "osculate/core/types.hpp"

namespace osculate::cell {

/// Reference shapes. Node order is Gmsh's: corners, then edge midpoints, then faces, then the
/// interior. Lines -1..1, quads -1..1 squared, triangles 0..1, hexahedra -1..1 cubed, tetrahedra
/// 0..1, wedges triangle times -1..1. shell18 has no counterpart in Gmsh: two quad9, nodes 0..8 at
/// the bottom (zeta = -1) and 9..17 above them.
enum class CellType : std::uint8_t {
  point1,
  line2,
  line3,
  line4,
  tri3,
  tri6,
  quad4,
  quad8,
  quad9,
  tet4,
  tet10,
  wedge6,
  wedge15,
  hex8,
  hex20,
  hex27,
  shell18
};
inline constexpr std::size_t cell_type_count = 17;

/// A face of a volume cell: local nodes in the order of an area cell of the type (the first
/// `nodes` of it are used), walked so that r_1 x r_2 points out of the cell.
struct CellFace {
  CellType type = CellType::point1;
  std::array<std::int8_t, 9> nodes{};
};

/// Facts about one cell type. `edges` lists the local nodes of each edge in the order of a line
/// cell (ends first, then interior), walked so that the cell lies on the left; volumes list their
/// faces instead. The four sides of shell18, quadratic one way and linear the other, are listed as
/// the quad4 of their corners: they tell neighbours apart, and carry loads of the right resultant.
///
/// Tested by  tests/unit/cell/test_volume_shape.cpp (faces, order of VTK)
struct CellInfo {
  CellType type;
  std::string_view name;
  int dimension;
  int nodes;
  int corners;
  int order;
  int gmsh_type;  ///< Gmsh element type number; 0: none
  int vtk_type;   ///< VTK cell type number
  CellType edge_type;
  int edge_count;
  std::array<std::array<std::int8_t, 3>, 4> edges;
  int face_count = 0;
  std::array<CellFace, 6> faces{};
};

[[nodiscard]] const CellInfo& info(CellType type);
[[nodiscard]] std::span<const CellInfo> all_cells();
/// nullptr when there is no cell of that name / Gmsh number.
[[nodiscard]] const CellInfo* find_cell(std::string_view name);
[[nodiscard]] const CellInfo* find_gmsh_cell(int gmsh_type);

/// Local nodes in the order in which VTK wants them for the cell's `vtk_type`. shell18 is shown as
/// the linear hexahedron of its corners: eight of its nodes.
[[nodiscard]] std::span<const std::int8_t> vtk_nodes(CellType type);

}  // namespace osculate::cell
