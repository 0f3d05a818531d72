#pragma once
#include <array>
#include <span>
#include <string_view>

#include "osculate/core/types.hpp"

namespace osculate::cell {

/// Reference shapes. Node order is Gmsh's: corners, then edge midpoints, then the interior.
/// Lines -1..1, quads -1..1 squared, triangles 0..1.
enum class CellType : std::uint8_t { point1, line2, line3, line4, tri3, tri6, quad4, quad8, quad9 };

/// Facts about one cell type. `edges` lists the local nodes of each edge in the order of a line
/// cell (ends first, then interior), walked so that the cell lies on the left.
struct CellInfo {
  CellType type;
  std::string_view name;
  int dimension;
  int nodes;
  int corners;
  int order;
  int gmsh_type;  ///< Gmsh element type number
  int vtk_type;   ///< VTK cell type number
  CellType edge_type;
  int edge_count;
  std::array<std::array<std::int8_t, 3>, 4> edges;
};

[[nodiscard]] const CellInfo& info(CellType type);
[[nodiscard]] std::span<const CellInfo> all_cells();
/// nullptr when there is no cell of that name / Gmsh number.
[[nodiscard]] const CellInfo* find_cell(std::string_view name);
[[nodiscard]] const CellInfo* find_gmsh_cell(int gmsh_type);

}  // namespace osculate::cell
