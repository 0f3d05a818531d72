#include "osculate/io/gmsh/raw.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace osculate::io::gmsh {
namespace {

constexpr std::array<std::pair<int, const char*>, 22> foreign_types{{
    {7, "5-node pyramid"},       {13, "18-node prism"},       {14, "14-node pyramid"},
    {19, "13-node pyramid"},     {20, "9-node triangle"},     {21, "10-node triangle"},
    {22, "12-node triangle"},    {23, "15-node triangle"},    {24, "15-node triangle"},
    {25, "21-node triangle"},    {27, "5-node line"},         {28, "6-node line"},
    {29, "20-node tetrahedron"}, {30, "35-node tetrahedron"}, {31, "56-node tetrahedron"},
    {36, "16-node quadrangle"},  {37, "25-node quadrangle"},  {39, "12-node quadrangle"},
    {90, "40-node prism"},       {92, "64-node hexahedron"},  {93, "125-node hexahedron"},
    {91, "75-node prism"},
}};

}  // namespace

void finish_nodes(const Cursor& cursor, RawMesh& raw) {
  const std::size_t n = raw.tags.size();
  if (n == 0) cursor.fail("the mesh has no nodes");
  if (!std::is_sorted(raw.tags.begin(), raw.tags.end())) {
    std::vector<Index> order(n);
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
      return raw.tags[static_cast<std::size_t>(a)] < raw.tags[static_cast<std::size_t>(b)];
    });
    std::vector<std::int64_t> tags(n);
    std::vector<std::size_t> places(n);
    std::vector<Vec3> nodes(n);
    for (std::size_t i = 0; i < n; ++i) {
      const auto from = static_cast<std::size_t>(order[i]);
      tags[i] = raw.tags[from];
      places[i] = raw.places[from];
      nodes[i] = raw.nodes[from];
    }
    raw.tags = std::move(tags);
    raw.places = std::move(places);
    raw.nodes = std::move(nodes);
  }
  const auto twice = std::adjacent_find(raw.tags.begin(), raw.tags.end());
  if (twice != raw.tags.end())
    cursor.fail_at(raw.places[static_cast<std::size_t>(twice - raw.tags.begin()) + 1],
                   fmt::format("node {} is there twice", *twice));
  raw.places = {};
  raw.node_map = NumberMap(std::move(raw.tags));
  raw.tags = {};
  raw.has_nodes = true;
}

const cell::CellInfo& cell_of_type(const Cursor& cursor, std::int64_t gmsh_type) {
  const bool in_range = gmsh_type > 0 && gmsh_type < 1000;
  const cell::CellInfo* info =
      in_range ? cell::find_gmsh_cell(static_cast<int>(gmsh_type)) : nullptr;
  if (info != nullptr) return *info;
  std::string text = fmt::format("element type {}", gmsh_type);
  for (const auto& [type, name] : foreign_types)
    if (type == gmsh_type) text += fmt::format(" ({})", name);
  text += " is not supported";
  if (gmsh_type == 13) text += " (Mesh.SecondOrderIncomplete = 1 makes 15-node prisms)";
  text += "; supported are";
  for (const cell::CellInfo& known : cell::all_cells())
    if (known.gmsh_type > 0) text += fmt::format(" {} ({})", known.gmsh_type, known.name);
  cursor.fail(text);
}

void read_cell_nodes(Cursor& cursor, RawMesh& raw, const cell::CellInfo& info, bool wide,
                     Index group, std::int64_t number) {
  RawCells& cells = raw.cells[static_cast<std::size_t>(info.type)];
  for (int k = 0; k < info.nodes; ++k) {
    const std::int64_t tag =
        wide ? cursor.count("the tag of a node") : cursor.integer("the tag of a node");
    const Index node = raw.node_map.find(tag);
    if (node < 0) cursor.fail(fmt::format("an element names node {}, which does not exist", tag));
    cells.connectivity.push_back(node);
  }
  if (cells.connectivity.size() > static_cast<std::size_t>(std::numeric_limits<Index>::max()))
    cursor.fail("too many elements of one type");
  cells.group.push_back(group);
  cells.numbers.push_back(number);
}

}  // namespace osculate::io::gmsh
