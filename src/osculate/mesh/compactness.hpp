#pragma once
#include <span>

#include "osculate/mesh/mesh.hpp"

namespace osculate::mesh {

/// How compact the least compact of some bodies is. Volume cells that share faces are one body.
///
/// Formula    V / A^1.5, volume over surface: 0.068 of a cube, 0.094 of a ball, 0.027 of a plate
///            1 : 10 and of a rod 1 : 20, 0.0153 of a plate 1 : 20. Faces are those between the
///            corners
/// Returns    1 where there is no volume cell
/// Tested by  tests/unit/mesh/test_compactness.cpp
[[nodiscard]] double least_compactness(const Mesh& mesh, std::span<const CellRef> cells);

}  // namespace osculate::mesh
