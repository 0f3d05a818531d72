#pragma once
#include <span>

#include "osculate/mesh/surface.hpp"

namespace osculate::mesh {

/// Turns the numbering of hex8 cells of a shell so that their third direction goes through its
/// thickness; handedness and positions stay. The thickness joins two opposite faces that are both
/// free among `cells`; where more than one direction has such faces (a strip, a single cell), the
/// third stays unless another is less than half as long. Cells of a shell of several layers have
/// no such direction: their third one must go through the thickness already. Cells of other types
/// are left alone.
///
/// Returns    how many cells were turned
/// Tested by  tests/unit/mesh/test_shell_direction.cpp
Index align_shells(Mesh& mesh, std::span<const CellRef> cells);

}  // namespace osculate::mesh
