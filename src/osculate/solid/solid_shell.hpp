#pragma once
// Solid-shells: volume cells with displacements only, thin in the direction zeta.
#include "osculate/solid/element.hpp"

namespace osculate::solid {

/// Internal force of a solid-shell cell and its derivative, as `evaluate` of the other volume
/// formulations. hex8 is thin from nodes 0..3 to nodes 4..7, shell18 from 0..8 to 9..17; of the
/// eight turned numberings of a hex8 that keep this direction each gives the same.
///
/// Formula    E_ij = (g_i . g_j - G_i . G_j)/2 in convected components, sampled at tying points:
///            hex8: E13, E23 at two edge middles, E33 at the four corners of the middle surface;
///            shell18: E11, E13 at 2 x 3 points, E22, E23 at 3 x 2 (Gauss points), E33 at the nine
///            nodes, E12 fitted by a bilinear function. Enhanced modes (7 and 4) make E33 linear in
///            zeta and, for hex8, the membrane strains linear; their parameters are found in the
///            cell
/// Limits     constant membrane and bending states are exact in prismatic cells with straight sides
///            of any outline; where a side of a shell18 is curved in its plane they are not.
///            Constant transverse shear is exact in affine cells only
/// Source     Bathe & Dvorkin 1985; Betsch & Stein 1995; Simo & Rifai 1990; Bucalem & Bathe 1993;
///            Simo & Hughes 1986 for what the fit of E12 must leave out
/// Returns    out.status: inverted if det(G_1, G_2, G_3) <= 0 at a quadrature point (a mirrored or
///            flat cell; its current one likewise in finite kinematics), material_failed if the law
///            or the modes have no answer; force and tangent are then not to be used. The tangent
///            is symmetric
/// Requires   type is hex8 or shell18; small kinematics with linear_elastic, finite with the others
/// Tested by  tests/unit/solid/test_derivatives.cpp, test_solid_shell.cpp,
///            test_solid_shell_patch.cpp, test_solid_shell_benchmarks.cpp
void evaluate_solid_shell(const Section<3>& section, cell::CellType type,
                          const Coordinates<3>& reference, const Coordinates<3>& displacement,
                          bool with_tangent, ElementResult<3>& out,
                          const material::Memory& memory = {});

/// Cauchy stress and strain at the quadrature points (the strain is the one the material sees).
///
/// Formula    finite kinematics: sigma = R U S U R^T / det U with the assumed strain in
///            U^2 = I + 2 E and the rotation R of the displacement gradient
/// Tested by  tests/unit/solid/test_solid_shell_stress.cpp
[[nodiscard]] CellStress<3> solid_shell_stress_at_points(const Section<3>& section,
                                                         cell::CellType type,
                                                         const Coordinates<3>& reference,
                                                         const Coordinates<3>& displacement,
                                                         const material::Memory& memory = {});

/// Adds what stresses at the quadrature points do to the stiffness (stress_stiffness.hpp).
///
/// Requires   the cell is not inverted
/// Tested by  tests/unit/solid/test_stress_stiffness.cpp
void add_solid_shell_stress_stiffness(const Section<3>& section, cell::CellType type,
                                      const Coordinates<3>& reference, const CellStress<3>& stress,
                                      ElementMatrix<3>& to);

/// Values at the nodes (rows) from those at the points: least squares, linear through the
/// thickness, linear (hex8) or quadratic (shell18) along the shell.
///
/// Tested by  tests/unit/solid/test_solid_shell_stress.cpp
[[nodiscard]] const Eigen::MatrixXd& solid_shell_extrapolation(cell::CellType type);

}  // namespace osculate::solid
