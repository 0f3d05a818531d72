#pragma once
// Patch tests of plates: constant membrane strains and constant curvatures.
#include <array>
#include <vector>

#include "osculate/cell/cell_type.hpp"
#include "osculate/core/types.hpp"

namespace osculate::verification::shell {

/// Quadrilaterals that fill a rectangle in the plane z = 0. Their sides are straight, or bent
/// inside the rectangle: all points moved along (1, -1) by `bend` times the width in its middle,
/// and by half a sine wave in both directions elsewhere.
struct PatchMesh {
  std::vector<Vec2> at;
  std::vector<std::array<std::size_t, 4>> quads;
  double length, width, height;
  double bend = 0;
};

/// MacNeal & Harder's five quadrilaterals in a rectangle 0.24 x 0.12, 0.01 thick.
[[nodiscard]] PatchMesh five_cells();
/// Each quadrilateral cut into n by n (before it is bent).
[[nodiscard]] PatchMesh refined(const PatchMesh& mesh, int n);
[[nodiscard]] PatchMesh bent(PatchMesh mesh, double bend);
/// Two by two cells in the same rectangle, the middle node moved by `shift` times the size of a
/// cell in both directions.
[[nodiscard]] PatchMesh four_cells(double shift);

enum class PlateState { membrane, bending };

/// Largest error of a displacement inside, relative to the largest displacement of all, when the
/// border moves as the exact solution (plane stress; Kirchhoff's plate) does.
[[nodiscard]] double patch_error(const PatchMesh& mesh, cell::CellType type, PlateState state,
                                 double poisson, const Workers& workers);

}  // namespace osculate::verification::shell
