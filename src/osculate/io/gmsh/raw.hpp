#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "osculate/cell/cell_type.hpp"
#include "osculate/io/gmsh/cursor.hpp"
#include "osculate/io/number_map.hpp"
#include "osculate/mesh/mesh.hpp"

namespace osculate::io::gmsh {

/// (dimension, tag) of a geometric entity or a physical group.
using EntityKey = std::pair<int, std::int64_t>;

/// Cells of one entity with the same physical groups; a negative tag: its cells are reversed.
struct Group {
  EntityKey entity;
  std::vector<std::int64_t> physical;
};

struct RawCells {
  std::vector<Index> connectivity;
  std::vector<Index> group;  ///< per cell, position in RawMesh::groups
  std::vector<std::int64_t> numbers;
};

/// What a file says, before sets are made of it.
struct RawMesh {
  std::map<EntityKey, std::string> names;
  std::map<EntityKey, std::vector<std::int64_t>> entities;  ///< MSH 4.1: physical tags
  std::vector<std::int64_t> tags;   ///< of the nodes, in file order; emptied by finish_nodes
  std::vector<std::size_t> places;  ///< of the nodes in the file; emptied by finish_nodes
  std::vector<Vec3> nodes;          ///< ordered by tag after finish_nodes
  NumberMap node_map;
  bool has_nodes = false, has_cells = false;
  std::array<RawCells, cell::cell_type_count> cells;  ///< by cell type
  std::vector<Group> groups;
};

/// Orders the nodes by tag; throws if a tag is there twice.
void finish_nodes(const Cursor& cursor, RawMesh& raw);
/// The cell type of a Gmsh element type; throws for one we do not have.
[[nodiscard]] const cell::CellInfo& cell_of_type(const Cursor& cursor, std::int64_t gmsh_type);
/// Reads the node tags of the cell `number`.
void read_cell_nodes(Cursor& cursor, RawMesh& raw, const cell::CellInfo& info, bool wide,
                     Index group, std::int64_t number);

void read_nodes_2(Cursor& cursor, RawMesh& raw);
void read_elements_2(Cursor& cursor, RawMesh& raw);
void read_entities_4(Cursor& cursor, RawMesh& raw);
void read_partitioned_entities_4(Cursor& cursor, RawMesh& raw);
void read_nodes_4(Cursor& cursor, RawMesh& raw);
void read_elements_4(Cursor& cursor, RawMesh& raw);

/// Blocks and sets.
[[nodiscard]] mesh::Mesh build_mesh(const Cursor& cursor, RawMesh raw);

}  // namespace osculate::io::gmsh
