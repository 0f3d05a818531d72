#include "osculate/cell/cell_type.hpp"

namespace osculate::cell {
namespace {

using enum CellType;
constexpr std::array<std::array<std::int8_t, 3>, 4> no_edges{};
constexpr std::array<CellInfo, 9> table{{
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
}};

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
    if (cell.gmsh_type == gmsh_type) return &cell;
  return nullptr;
}

}  // namespace osculate::cell
