#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "osculate/mesh/mesh.hpp"

namespace osculate::mesh {

/// No cell.
inline constexpr CellRef no_cell{-1, -1};

/// One edge of one area cell. `key` is the same for both cells that share the edge.
struct Edge {
  std::uint64_t key = 0;
  CellRef cell = no_cell;
  std::int8_t local = -1;  ///< number of the edge in the cell
};

/// All edges of some area cells, sorted by (key, block, cell, local).
struct EdgeTable {
  std::vector<Edge> edges;
  /// The edges that join these two corner nodes: none, one (free) or more (interior).
  [[nodiscard]] std::span<const Edge> find(Index a, Index b) const;
};

/// The edges of all area cells of the mesh.
[[nodiscard]] EdgeTable edge_table(const Mesh& mesh);
/// The edges of the given area cells only (of the bodies that take part in the analysis, say).
[[nodiscard]] EdgeTable edge_table(const Mesh& mesh, std::span<const CellRef> cells);

/// A piece of a boundary, directed. Nodes in the order of a line cell: both ends, then the
/// interior.
struct BoundaryFacet {
  cell::CellType type = cell::CellType::line2;
  std::array<Index, 4> node{-1, -1, -1, -1};
  CellRef line = no_cell;      ///< the line cell it stems from; no_cell for a free edge
  CellRef parent = no_cell;    ///< the area cell behind it; no_cell for a meshed rigid line
  bool flipped = false;        ///< the file has it the other way round
  Index prev = -1, next = -1;  ///< neighbours in the direction of travel, -1 = the boundary ends
  [[nodiscard]] std::span<const Index> nodes() const {
    return {node.data(), static_cast<std::size_t>(cell::info(type).nodes)};
  }
  [[nodiscard]] bool has_parent() const { return parent != no_cell; }
};

/// A directed boundary. If `errors` is not empty the facets they name are missing and the boundary
/// must not be used. Messages name nodes by their number and coordinates.
struct Boundary {
  std::vector<BoundaryFacet> facets;
  std::vector<std::string> errors;
  std::vector<std::string> warnings;
  std::vector<Index> branching;  ///< nodes where the neighbours are not unique (facets unlinked)
};

/// Directs the line cells of a set so that the body is on the right of the direction of travel.
///
/// Sign       the normal k x rho_xi points out of the body (also of cells numbered clockwise)
/// Errors     a line with two parents (inside the body), used twice, with a parent of no area, or
///            with other interior nodes than the edge of its parent
/// Returns    prev/next already set; lines without parent that hang together travel in one
///            direction, that of most of them in the file
/// Requires   set.dimension == 1
/// Tested by  tests/unit/mesh/test_boundary.cpp, test_outer_facets.cpp
[[nodiscard]] Boundary orient_boundary(const Mesh& mesh, const EdgeTable& table, const Set& set);
[[nodiscard]] Boundary orient_boundary(const Mesh& mesh, const Set& set);

/// The free edges (those of one area cell only) of the cells of an area set, directed as above and
/// in the order of the cells. Free is judged by the table: where two bodies share nodes there is no
/// free edge if both are in it.
[[nodiscard]] Boundary boundary_facets(const Mesh& mesh, const EdgeTable& table, const Set& set);
[[nodiscard]] Boundary boundary_facets(const Mesh& mesh, const Set& set);

/// The free edges all of whose nodes are in the node list; nodes that belong to none are a warning.
[[nodiscard]] Boundary facets_of_nodes(const Mesh& mesh, const EdgeTable& table,
                                       std::span<const Index> nodes);

/// What a user means by naming a set as surface: lines, the free edges of areas, or of nodes.
[[nodiscard]] Boundary surface_of(const Mesh& mesh, const EdgeTable& table, const Set& set);

/// Sets prev/next through shared end nodes, fills `branching` and adds the warnings.
void connect(const Mesh& mesh, Boundary& boundary);

/// What makes two cells neighbours. `side` (an edge of areas, a face of volumes) also separates
/// parts that hang together in less than that.
enum class Link : std::uint8_t { node, side };

/// The connected parts of some area or volume cells, each in the order of the input, parts in the
/// order of their first cell.
[[nodiscard]] std::vector<std::vector<CellRef>> connected_parts(const Mesh& mesh,
                                                                std::span<const CellRef> cells,
                                                                Link link = Link::node);

/// `node 12 (1, 0.5)`: its number in the mesh file (else 1-based) and its coordinates (three of
/// them where there are volumes).
[[nodiscard]] std::string describe_node(const Mesh& mesh, Index node);

}  // namespace osculate::mesh
