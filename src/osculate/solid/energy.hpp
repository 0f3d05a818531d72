#pragma once
#include "osculate/solid/element.hpp"
#include "osculate/solid/volume.hpp"

namespace osculate::solid {

/// Strain energy of a cell that remembers `memory.committed`: where nothing flows, its derivative
/// with respect to the displacements is the internal force, whatever the formulation.
///
/// Formula    U = sum over the quadrature points of W(E) dV, E the strain that the material sees
/// Returns    infinity where the cell has no answer (inverted)
/// Tested by  tests/unit/solid/test_derivatives.cpp, test_memory.cpp
struct CellEnergy {
  double stored = 0;
  double dissipated = 0;  ///< so far, in the material
};
[[nodiscard]] CellEnergy cell_energy(const Section& section, cell::CellType type,
                                     const Coordinates& reference, const Coordinates& displacement,
                                     const material::Memory& memory);
[[nodiscard]] CellEnergy cell_energy(const VolumeSection& section, cell::CellType type,
                                     const Coordinates3& reference,
                                     const Coordinates3& displacement,
                                     const material::Memory& memory);
/// Of a cell to which nothing has happened before.
[[nodiscard]] double strain_energy(const Section& section, cell::CellType type,
                                   const Coordinates& reference, const Coordinates& displacement);
[[nodiscard]] double strain_energy(const VolumeSection& section, cell::CellType type,
                                   const Coordinates3& reference, const Coordinates3& displacement);

}  // namespace osculate::solid
