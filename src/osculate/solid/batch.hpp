#pragma once
// Forces of many cells of one kind, four at a time, for explicit time integration: each kind of
// cell keeps the few numbers that its forces need, the cells of four lanes beside each other.
#include <optional>

#include "osculate/core/pack.hpp"
#include "osculate/solid/batch_wide.hpp"
#include "osculate/solid/element.hpp"

namespace osculate::solid {

/// How the forces of cells come about.
///
/// linear     quad4, hex8 in small strain of a linear law, all formulations but solid_shell:
///            f = B^T V D B u + sum_ab gamma_a K_ab gamma_b u with the mean B of the strain matrix
///            and the modes gamma_a that do not see linear motions (reduced.hpp). Constant strains
///            and these modes do not work on each other, since the latter have no mean strain; so
///            that is the cell's stiffness itself, in a sixth of its numbers
/// one_point  quad4, hex8 with formulation reduced, as reduced.hpp has them
/// points     quad4, hex8 in finite strain, with and without the mean dilatation, as
///            finite_forces.hpp has them
/// simplex    tri3, tet4
enum class BatchKind { linear, one_point, points, simplex };

/// What the cells of one kind have in common. The section has to outlive it.
template <int Dim>
struct Batch {
  BatchKind kind;
  cell::CellType type;
  Section<Dim> section;
  Mat<components<Dim>, components<Dim>> stiffness;  ///< of the law, linear cells
  std::size_t kept = 0;                             ///< numbers of a cell
};

/// Nothing if such cells have to be evaluated one by one. In the plane: strained in it, but
/// linear cells; laws that remember nothing and are the same in all directions, but linear cells.
///
/// Input      section: that of the cell type (no formulation that the type does not have);
///            reference: of the first cell
/// Tested by  tests/unit/solid/test_batch.cpp
template <int Dim>
[[nodiscard]] std::optional<Batch<Dim>> batch_of(const Section<Dim>& section, cell::CellType type,
                                                 const Coordinates<Dim>& reference);

/// Sets the numbers of a cell in one lane of `numbers` (batch.kept of them). False: it is not of
/// this kind (axes of the material that turn within it) and has to be evaluated by itself.
template <int Dim>
[[nodiscard]] bool keep_in(const Batch<Dim>& batch, const Coordinates<Dim>& reference, int lane,
                           core::Pack* numbers);

/// The forces of four cells, up to round-off those of `evaluate`.
///
/// Input      u: displacements of the nodes, x0, y0, (z0,) x1, ..., best less those of one node
/// Returns    false: one of the cells has no answer, or is turned inside out
template <int Dim>
[[nodiscard]] bool batch_forces(const Batch<Dim>& batch, const core::Pack* numbers,
                                const core::Pack* u, core::Pack* force);

/// What `forces_of_eight` needs of such cells; nothing where it does not take them, or the
/// processor has no registers for it.
template <int Dim>
[[nodiscard]] std::optional<EightCells> eight_cells(const Batch<Dim>& batch);

/// The stored energy of four cells, up to round-off that of `cell_energy`.
template <int Dim>
[[nodiscard]] bool batch_energy(const Batch<Dim>& batch, const core::Pack* numbers,
                                const core::Pack* u, core::Pack& energy);

/// The stiffness of four cells, column by column from their forces: exact where these are linear,
/// else to about seven digits, less where cells are thin and have turned far; enough for how fast
/// they are.
///
/// Formula    K_j = (f(u + d e_j) - f(u)) / d , d = 1e-7 of the least width as the cell was; of
///            linear forces f(e_j) - f(0) . The columns of the first node are less the sum of all
///            others: what all nodes have in common makes no forces
/// Shapes     stiffness: dofs x dofs
/// Returns    false: as batch_forces, and where the law is no `at_once` (pointwise.hpp), whose
///            tangents take less time
template <int Dim>
[[nodiscard]] bool batch_stiffness(const Batch<Dim>& batch, const core::Pack* numbers,
                                   const core::Pack* u, core::Pack* stiffness);

}  // namespace osculate::solid
