#pragma once
// Enhanced strains of quad4 and hex8.
#include "osculate/solid/points.hpp"

namespace osculate::solid {

/// How many modes there are: four in the plane, five in a ring, twelve in space.
inline constexpr int plane_modes = 4, ring_modes = 5, space_modes = 12;

/// State of the incompatible strain modes at given displacements.
template <int Count>
struct EnhancedModes {
  static constexpr int dim = Count == space_modes ? 3 : 2, rows = components<dim>;
  bool ok = true;
  std::array<Mat<rows, Count>, corners<dim>> matrix;  ///< strain per mode at the quadrature points
  std::array<material::ResponseOf<rows>, corners<dim>> response;  ///< at strain + matrix * alpha
  Vec<Count> alpha = Vec<Count>::Zero();
  Mat<Count, Count> stiffness;
};

/// Finds the mode parameters by a local Newton iteration from zero to round-off (one step where
/// linear): int M^T S dV = 0. The element keeps no state. Modes linear along the axes of the cell
/// let it bend; in space three volumetric ones (xi eta, eta zeta, zeta xi) let it keep its volume.
///
/// Source     Simo & Rifai 1990 (small strain; the axisymmetric modes too), Simo, Armero & Taylor
///            1993 (the modes in space); for finite strain the Green-Lagrange strain is enhanced in
///            the same way
/// Limits     one cell in uniform compression (in space by more than about a third, neo-Hooke) has
///            hourglass modes of negative stiffness, as enhanced strains are known to (decision 037
///            says from where); bbar has none there
/// Requires   Count is ring_modes where the section is axisymmetric, space_modes in space, else
///            plane_modes
/// Returns    ok is false where the law has no answer or the iteration finds none
/// Tested by  tests/unit/solid/test_patch.cpp, test_derivatives.cpp, test_locking.cpp,
///            test_volume_locking.cpp
template <int Count, int Dim>
[[nodiscard]] EnhancedModes<Count> enhanced_modes(const Section<Dim>& section,
                                                  const Coordinates<Dim>& reference,
                                                  const CornerPoints<Dim>& points,
                                                  const material::Memory& memory);

}  // namespace osculate::solid
