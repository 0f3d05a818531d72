#pragma once
#include <span>
#include <string>

#include "osculate/mesh/mesh.hpp"

namespace osculate::mesh {

/// Makes shell18 of the hex27 cells among `cells`, which no mesh generator writes: the nodes
/// halfway through the thickness are left out (of all sets too), and the quad9 facets and line3
/// edges that had them become quad4 and line2. The thickness is found as `align_shells` finds it.
/// Cells and their sets are numbered anew; nodes keep their numbers.
///
/// Returns    empty, or why it cannot be: cells that stay have nodes that would be left out
/// Tested by  tests/unit/deck/test_shell_meshes.cpp
[[nodiscard]] std::string make_shell18(Mesh& mesh, std::span<const CellRef> cells);

}  // namespace osculate::mesh
