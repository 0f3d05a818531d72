#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "osculate/mesh/boundary.hpp"
#include "osculate/mesh/mesh.hpp"

namespace osculate::mesh {

/// Corners of a face, sorted; triangles have -1 in front. The same for all cells that share it.
using FaceKey = std::array<Index, 4>;

/// One face of one volume cell.
struct Face {
  FaceKey key{-1, -1, -1, -1};
  CellRef cell = no_cell;
  std::int8_t local = -1;  ///< number of the face in the cell
};

/// All faces of some volume cells, sorted by (key, block, cell, local).
struct FaceTable {
  std::vector<Face> faces;
  /// The faces with these corners (three or four, in any order): none, one (free) or more
  /// (interior).
  [[nodiscard]] std::span<const Face> find(std::span<const Index> corners) const;
};

/// The faces of all volume cells of the mesh.
[[nodiscard]] FaceTable face_table(const Mesh& mesh);
/// The faces of the given volume cells only (of the bodies that take part in the analysis, say).
[[nodiscard]] FaceTable face_table(const Mesh& mesh, std::span<const CellRef> cells);

/// +1 for a volume cell numbered as its type demands, -1 for one that is inside out (mirrored), 0
/// without volume: the sign of the volume enclosed by its faces.
[[nodiscard]] int handedness(const Mesh& mesh, CellRef ref);

inline constexpr std::size_t most_facet_nodes = 9;

/// A piece of a surface in space. Nodes in the order of an area cell; seen from the side that the
/// normal r_1 x r_2 points to, the corners run counterclockwise.
struct SurfaceFacet {
  cell::CellType type = cell::CellType::quad4;
  std::array<Index, most_facet_nodes> node{-1, -1, -1, -1, -1, -1, -1, -1, -1};
  CellRef area = no_cell;    ///< the area cell it stems from; no_cell for a free face
  CellRef parent = no_cell;  ///< the volume cell behind it; no_cell for a rigid meshed surface
  bool flipped = false;      ///< the file has it the other way round
  std::array<Index, 4> next{-1, -1, -1, -1};  ///< facet across the edge from corner k to k + 1

  [[nodiscard]] std::span<const Index> nodes() const {
    return {node.data(), static_cast<std::size_t>(cell::info(type).nodes)};
  }
  [[nodiscard]] std::span<const Index> corners() const {
    return {node.data(), static_cast<std::size_t>(cell::info(type).corners)};
  }
  [[nodiscard]] bool has_parent() const { return parent != no_cell; }
};

/// An oriented surface. If `errors` is not empty the facets they name are missing and the surface
/// must not be used. Messages name nodes by their number and coordinates.
struct Surface {
  std::vector<SurfaceFacet> facets;
  std::vector<std::string> errors;
  std::vector<std::string> warnings;
  /// Edges (both ends) along which the neighbours are not unique or face opposite sides; the facets
  /// there are unlinked.
  std::vector<std::array<Index, 2>> branching;
};

/// Orients the area cells of a set.
///
/// Sign       areas on volume cells: the normal points out of the volume (also of cells that are
///            inside out). Others (rigid meshed surfaces): areas that hang together get one
///            orientation, that of most of them (of the first one in case of a tie)
/// Errors     an area with two volumes (inside a body), used twice, on a volume cell of no volume,
///            of another type or with other interior nodes than the face of the cell behind it;
///            areas without volume that cannot be oriented (a Moebius strip)
/// Returns    in the order of the set, next already set; a warning where areas without volume had
/// to
///            be turned round
/// Requires   set.dimension == 2
/// Tested by  tests/unit/mesh/test_surface.cpp, test_outer_facets.cpp
[[nodiscard]] Surface orient_surface(const Mesh& mesh, const FaceTable& table, const Set& set);
[[nodiscard]] Surface orient_surface(const Mesh& mesh, const Set& set);

/// The free faces (those of one volume cell only) of the cells of a volume set, outward and in the
/// order of the cells. Free is judged by the table: where two bodies share nodes there is no free
/// face if both are in it.
[[nodiscard]] Surface surface_facets(const Mesh& mesh, const FaceTable& table, const Set& set);
[[nodiscard]] Surface surface_facets(const Mesh& mesh, const Set& set);

/// The free faces all of whose nodes are in the node list; nodes that belong to none are a warning.
[[nodiscard]] Surface faces_of_nodes(const Mesh& mesh, const FaceTable& table,
                                     std::span<const Index> nodes);

/// What a user means by naming a set as surface: areas, the free faces of volumes, or of nodes. A
/// line set is an error.
[[nodiscard]] Surface surface_of(const Mesh& mesh, const FaceTable& table, const Set& set);

/// Sets next through shared edges, fills `branching` and adds the warnings.
void connect(const Mesh& mesh, Surface& surface);

/// Turns an area cell round: the first node stays, the normal changes its sign.
void reverse_area(cell::CellType type, std::span<Index> nodes);

}  // namespace osculate::mesh
