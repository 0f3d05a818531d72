#pragma once
#include <string>
#include <string_view>

#include "osculate/mesh/mesh.hpp"

namespace osculate::io {

/// Reads the mesh of an Abaqus or CalculiX input file: `*NODE`, `*ELEMENT`, `*NSET`, `*ELSET`,
/// `*SURFACE`, `*PART`, `*INSTANCE`, `*ASSEMBLY` and `*INCLUDE`. Other keywords are skipped.
///
/// Nodes and cells are ordered by their numbers, which they keep unless instances share some; there
/// is one block per cell type. Sets of elements are sets of cells, sets of nodes are sets of nodes,
/// surfaces of elements are sets of the facets (areas, in the plane lines), of nodes sets of nodes.
/// Sets of an instance are called `INSTANCE.SET`. Names are found in capital and small letters. A
/// deck may give one name to elements, to a surface and to nodes: then the elements have it, and
/// what has other nodes is called `NAME.surface`, `NAME.nodes`,
/// `NAME.surface_nodes`. A set of elements of several
/// dimensions is that of the highest one, beside `NAME.areas`, `NAME.lines`.
///
/// Errors     core::InputError with file and line: see inp::read_cards, inp::collect,
///            inp::add_cells, inp::Members, inp::Sides
/// Tested by  tests/unit/io/test_inp*.cpp, tests/fuzz/fuzz_inp.cpp
[[nodiscard]] mesh::Mesh read_inp(std::string_view content, const std::string& name);

/// Whether content begins with a keyword or comment of such a file.
[[nodiscard]] bool looks_like_inp(std::string_view content);

}  // namespace osculate::io
