#pragma once
// Mean dilatation (formulation bbar): the change of volume of a cell is a polynomial of few terms.
#include "osculate/solid/points.hpp"

namespace osculate::solid {

/// Force and tangent of a cell.
///
/// Formula    small strain: the volumetric part of the strain, and of B, is replaced by its
///            projection (of least squares over the undeformed cell) onto the polynomials.
///            Finite strain: each point sees the deformation gradient F_m = (theta/J)^(1/3) F,
///            theta the projection of J, so that det F_m = theta. E_m = m E + (m - 1)/2 I with m =
///            (theta/J)^(2/3); the energy is int W(E_m) dV, of which force and tangent are the
///            exact derivatives (so the tangent is symmetric). The first derivative of E_m is B_m =
///            m B + (E_m + I/2) d(ln m)/du
/// Source     Simo, Taylor & Pister 1985; Simo & Taylor 1991
/// Returns    out.status: inverted also where theta is not positive at a point
/// Tested by  tests/unit/solid/test_derivatives.cpp, test_locking.cpp, test_volume_locking.cpp,
///            test_mean_dilatation.cpp, test_pressure.cpp, verification/nearly_incompressible
template <int Dim>
void evaluate_bbar(const Section<Dim>& section, cell::CellType type,
                   const Coordinates<Dim>& reference, const Coordinates<Dim>& displacement,
                   const material::Memory& memory, bool with_tangent, ElementResult<Dim>& out);

/// E_m and F_m of the points.
template <int Dim>
void see_bbar(const Section<Dim>& section, cell::CellType type, const Coordinates<Dim>& reference,
              const Coordinates<Dim>& displacement, Seen<Dim>& out);

/// Adds the lower triangle of what the stresses of a cell do to its stiffness beside what they do
/// in plain cells: int S : d2(E_m)/du2 dV but for S : d2E, at no displacement.
template <int Dim>
void add_bbar_stress_stiffness(const Section<Dim>& section, cell::CellType type,
                               const Coordinates<Dim>& reference, const CellStress<Dim>& stress,
                               ElementMatrix<Dim>& lower);

}  // namespace osculate::solid
