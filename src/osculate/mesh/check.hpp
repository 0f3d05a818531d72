#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "osculate/mesh/mesh.hpp"

namespace osculate::mesh {

enum class Flaw : std::uint8_t {
  bad_index,         ///< a cell or set names a node or cell that does not exist
  not_finite,        ///< a coordinate is NaN, infinite or beyond 1e100
  repeated_node,     ///< a cell names a node twice
  duplicate_volume,  ///< two volume cells on the same nodes
  duplicate_area,    ///< two area cells on the same nodes
  duplicate_line,    ///< two line cells on the same nodes
  inside_out,        ///< a volume cell whose Jacobian is not positive at its nodes or middle
  folded,            ///< one of second order, but not at its points
  unused_node,       ///< a node of no cell (points and node sets do not count as use)
  double_node,       ///< two nodes of one body's set at the same place: parts that are not joined
  hanging_node,      ///< plane: a node on an edge of another cell of its set, between its ends
  overlap,           ///< plane: two cells on the same side of an edge, or three at one
  empty_set          ///< a set without nodes
};

/// All flaws of one kind; `is_error` where no analysis makes sense.
struct Finding {
  Flaw flaw;
  bool is_error;
  std::size_t count;
  std::string message;  ///< the number and the first few examples
};

/// By node: whether it belongs to the master, to the slave.
using ContactSides = std::array<std::vector<bool>, 2>;

/// Checks what a mesh file or a generator can get wrong. At most one finding per kind; with
/// bad_index the rest is not examined. Where nodes of both sides of one of the `contacts` are at
/// the same place, or one is on an edge of the other side, that is meant: parts of one section, or
/// the lips of a crack, touch there; likewise nodes of two bodies of a set that a contact keeps
/// apart elsewhere. Nodes of no cell are meant where they are `also_used` (by
/// node; empty: none). Tested by  tests/unit/mesh/test_check.cpp
[[nodiscard]] std::vector<Finding> check_mesh(const Mesh& mesh,
                                              std::span<const ContactSides> contacts = {},
                                              const std::vector<bool>& also_used = {});

/// Smallest Jacobian determinant of a volume cell over its nodes and their middle.
[[nodiscard]] double smallest_jacobian(const Mesh& mesh, CellRef ref);
/// Whether corners of a cell are at one place, as those of sectors are on their axis
/// (Mesh::expanded); of other meshes such cells are none.
[[nodiscard]] bool is_collapsed(const Mesh& mesh, CellRef ref);

}  // namespace osculate::mesh
