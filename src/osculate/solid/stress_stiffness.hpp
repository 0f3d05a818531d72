#pragma once
// What the stresses that a cell of small strain has do to its stiffness.
#include "osculate/solid/element.hpp"

namespace osculate::solid {

/// Second derivative of the work of stresses that do not change, at no displacement: what is added
/// to the stiffness of small strains where a body that has them buckles or vibrates.
///
/// Formula    K_ab = int grad N_a . sigma . grad N_b dV I ; rings also int sigma_33 N_a N_b / R^2
/// dV
///            in the radial direction. Formulations:
///            full, enhanced: the gradients of the displacements (the modes enhance the strain
///            alone); reduced: the same at its points, of quad4 and hex8 with the mean gradients,
///            so that what holds their other modes has no part in it; bbar: as its finite strain,
///            int sigma : d2(E_m)/du2 dV (mean_dilatation.hpp); solid_shell: sum over the tying
///            points of their stress times d2(E_ij)/du2 (solid_shell.hpp)
/// Source     Bathe 1996, section 6.3; the tangents of finite strain at F = I
/// Shapes     as ElementMatrix
/// Sign       tension stiffens; symmetric; linear in the stresses
/// Input      stress: of stress_at_points, of small kinematics, or any at these points
/// Requires   unsupported(section, type) is empty
/// Tested by  tests/unit/solid/test_stress_stiffness.cpp, verification/buckling
template <int Dim>
[[nodiscard]] ElementMatrix<Dim> stress_stiffness(const Section<Dim>& section, cell::CellType type,
                                                  const Coordinates<Dim>& reference,
                                                  const CellStress<Dim>& stress);

}  // namespace osculate::solid
