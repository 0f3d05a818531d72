#pragma once
#include "osculate/solid/element.hpp"

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
/// The same of each point of `stress_at_points`, per reference volume, without what hourglass
/// control stores.
///
/// Tested by  tests/unit/api/test_answers.cpp
template <int Dim>
[[nodiscard]] std::array<CellEnergy, max_points<Dim>> point_energies(
    const Section<Dim>& section, cell::CellType type, const Coordinates<Dim>& reference,
    const CellStress<Dim>& cell, const material::Memory& memory);
template <int Dim>
[[nodiscard]] CellEnergy cell_energy(const Section<Dim>& section, cell::CellType type,
                                     const Coordinates<Dim>& reference,
                                     const Coordinates<Dim>& displacement,
                                     const material::Memory& memory);
/// Of a cell to which nothing has happened before.
template <int Dim>
[[nodiscard]] double strain_energy(const Section<Dim>& section, cell::CellType type,
                                   const Coordinates<Dim>& reference,
                                   const Coordinates<Dim>& displacement) {
  return cell_energy(section, type, reference, displacement, {}).stored;
}

}  // namespace osculate::solid
