#pragma once
#include <array>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "osculate/cell/volume_shape.hpp"
#include "osculate/material/expansion.hpp"
#include "osculate/material/law.hpp"
#include "osculate/material/orientation.hpp"

namespace osculate::solid {

enum class Assumption { plane_strain, plane_stress, axisymmetric };
enum class Kinematics { small, finite };
/// full: plain displacement element. bbar: mean dilatation against volumetric locking, linear in
/// quad8, quad9, hex20 and hex27, constant in quad4, hex8, tri6, tet10 and wedge15
/// (mean_dilatation.hpp; not plane stress); a tet10 or wedge15 alone keeps three modes without
/// energy, a tri6 of a ring one. enhanced:
/// incompatible strain modes (four of quad4, five of it where axisymmetric, twelve of hex8),
/// against bending and volumetric locking. solid_shell: assumed and enhanced strains of thin bodies
/// in space (hex8, shell18). reduced: one point for quad4 and hex8, whose other modes are
/// stabilised (reduced.hpp); two along each axis for quad8 and hex20, of which one cell alone keeps
/// one mode (quad8) without energy, as do neighbours that are few, or six (hex20), which have a
/// very small one (reduced.hpp); two along the height for wedge6 (likewise one mode). beam: hex20
/// whose first axis lies along a beam, two points along it, five by five across.
enum class Formulation { full, bbar, enhanced, solid_shell, reduced, beam };

/// What a body in the plane or in space is made of.
template <int Dim>
struct Section;
template <>
struct Section<2> {
  Assumption assumption = Assumption::plane_strain;
  Kinematics kinematics = Kinematics::small;
  Formulation formulation = Formulation::full;
  double thickness = 1;
  material::Law law;
  material::Expansion expansion{};
  material::Orientation orientation{};  ///< of the axes of a directional law
};
template <>
struct Section<3> {
  Kinematics kinematics = Kinematics::small;
  Formulation formulation = Formulation::full;
  material::Law law;
  material::Expansion expansion{};
  material::Orientation orientation{};  ///< of the axes of a directional law
};

/// Empty if the cell type can be used with the section, else the reason in plain words.
template <int Dim>
[[nodiscard]] std::string_view unsupported(const Section<Dim>& section, cell::CellType type);

template <int Dim>
inline constexpr int max_nodes = Dim == 2 ? 9 : cell::max_volume_nodes;
template <int Dim>
inline constexpr int max_points = Dim == 2 ? 9 : 50;
/// Of strains and stresses: xx, yy, zz, xy and, in space, yz, zx.
template <int Dim>
inline constexpr int components = Dim == 2 ? 4 : 6;

/// Values of the nodes of a cell, one row a node. Dim is not deduced from them.
template <int Dim>
using Coordinates =
    std::type_identity_t<Eigen::Matrix<double, Eigen::Dynamic, Dim, 0, max_nodes<Dim>, Dim>>;
template <int Dim, int Nodes = max_nodes<Dim>>
using ElementVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, Dim * Nodes, 1>;
template <int Dim, int Nodes = max_nodes<Dim>>
using ElementMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, Dim * Nodes, Dim * Nodes>;

/// Terms of the volume ratio of formulation bbar in a cell: 1, a constant, or 1 + Dim, linear in
/// the coordinates of the undeformed body; 0 for cells that have no such formulation.
///
/// Source     constant of quad4, hex8: Simo, Taylor & Pister 1985; of tri6, tet10 (P2-P0) and
/// linear
///            of quad9, hex27 (Q2-P1): Boffi, Brezzi & Fortin 2013, chapter 8; in the coordinates
///            of the body, not in those of the cell: Boffi & Gastaldi 2002; quad8, hex20, wedge15:
///            measured, decision 064
/// Tested by  tests/unit/solid/test_stress.cpp, test_mean_dilatation.cpp
template <int Dim>
[[nodiscard]] int volume_terms(cell::CellType type);

enum class Status { ok, inverted, material_failed };

/// Internal force f = int B^T S dV (order x0, y0, [z0,] x1, ...) and its derivative, which is
/// symmetric.
///
/// Formula    total Lagrange for finite kinematics: E = (F^T F - I)/2, S = dW/dE
/// Units      force (plane: thickness; axisymmetric about the y axis: full circumference 2 pi R)
/// Input      memory: of the points of the cell, for laws that remember and for temperatures.
///            Without it nothing has happened to them yet
/// Returns    out.status: inverted if det F <= 0 at a quadrature point (finite kinematics),
///            material_failed if the law, or the modes of the enhanced strains, have no answer;
///            force and tangent are then not to be used
/// Requires   unsupported(section, type) is empty
/// Tested by  tests/unit/solid/test_derivatives.cpp, test_invariance.cpp, test_patch.cpp,
///            test_locking.cpp, test_volume_locking.cpp
template <int Dim>
struct ElementResult {
  Status status = Status::ok;
  ElementVector<Dim> force;
  ElementMatrix<Dim> tangent;  ///< filled only when asked for
};
template <int Dim>
void evaluate(const Section<Dim>& section, cell::CellType type, const Coordinates<Dim>& reference,
              const Coordinates<Dim>& displacement, bool with_tangent, ElementResult<Dim>& out,
              const material::Memory& memory = {});
/// Number of quadrature points.
template <int Dim>
[[nodiscard]] std::size_t point_count(const Section<Dim>& section, cell::CellType type);

/// Cauchy stress and strain of one quadrature point (strain: Green-Lagrange or small; shear
/// components are half the shear angle). Formulations other than full: the strain that the material
/// sees.
template <int Dim>
struct PointStress {
  Vec<Dim> xi;        ///< reference coordinates
  Vec<Dim> position;  ///< in the undeformed body
  double volume;      ///< undeformed; plane: times thickness, axisymmetric: full circumference
  Vec<components<Dim>> stress, strain;
};
template <int Dim>
struct CellStress {
  Status status = Status::ok;
  int count = 0;
  std::array<PointStress<Dim>, max_points<Dim>> point;
};
/// The points of a cell as CalculiX counts them: along the first direction of the cell first, then
/// along the second and the third.
template <int Dim>
[[nodiscard]] std::vector<std::size_t> in_order(const CellStress<Dim>& stress);
/// Tested by  tests/unit/solid/test_stress.cpp
template <int Dim>
[[nodiscard]] CellStress<Dim> stress_at_points(const Section<Dim>& section, cell::CellType type,
                                               const Coordinates<Dim>& reference,
                                               const Coordinates<Dim>& displacement,
                                               const material::Memory& memory = {});

/// The same extrapolated to the nodes by least squares over the quadrature points.
///
/// Tested by  tests/unit/solid/test_stress.cpp
template <int Dim>
struct NodalStress {
  int count = 0;
  std::array<Vec<components<Dim>>, max_nodes<Dim>> stress, strain;
};
template <int Dim>
[[nodiscard]] NodalStress<Dim> nodal_stress(const Section<Dim>& section, cell::CellType type,
                                            const Coordinates<Dim>& reference,
                                            const Coordinates<Dim>& displacement,
                                            const material::Memory& memory = {});
/// Values of the points at the nodes in the same way: one row a point, one a node.
///
/// Tested by  tests/unit/solid/test_memory.cpp
template <int Dim>
[[nodiscard]] Eigen::MatrixXd at_nodes(const Section<Dim>& section, cell::CellType type,
                                       const Eigen::MatrixXd& of_points);

/// Values of the nodes at the points of a cell, by the shape functions.
template <int Dim>
[[nodiscard]] std::array<double, static_cast<std::size_t>(max_points<Dim>)> values_at_points(
    const Section<Dim>& section, cell::CellType type, std::span<const double> nodal);
/// Strains that the temperatures give the points of a cell, for Memory::expansion: one number a
/// point, or six in the global axes (material::strains_of).
///
/// Input      temperature, before: of the nodes, now and at first
/// Tested by  tests/unit/solid/test_expansion.cpp
template <int Dim>
[[nodiscard]] std::array<double, 6 * static_cast<std::size_t>(max_points<Dim>)> expansion_at_points(
    const Section<Dim>& section, cell::CellType type, const Coordinates<Dim>& reference,
    std::span<const double> temperature, std::span<const double> before);

/// int N_k dV: what a unit body force per volume gives each node.
template <int Dim>
[[nodiscard]] ElementVector<Dim> volume_weights(const Section<Dim>& section, cell::CellType type,
                                                const Coordinates<Dim>& reference);

/// Smallest Jacobian determinant over the quadrature points of full integration, of cells of first
/// order over their nodes, too, but of those that have some at one place (`collapsed`).
template <int Dim>
[[nodiscard]] double smallest_jacobian(cell::CellType type, const Coordinates<Dim>& reference,
                                       bool collapsed = false);

/// Sides of cells, edges in the plane (line cells, the body on the right of travel) and faces in
/// space (tri3, tri6, quad4, quad8 or quad9; the normal r_1 x r_2 points out of the body).
inline constexpr int max_side_nodes = 9;

/// int N_k dA over a side: what a unit traction gives each node.
///
/// Tested by  tests/unit/solid/test_loads.cpp
template <int Dim>
[[nodiscard]] ElementVector<Dim, max_side_nodes> side_weights(const Section<Dim>& section,
                                                              cell::CellType side,
                                                              const Coordinates<Dim>& reference);

/// Nodal forces of a pressure p on a side, f_k = -int p N_k n dA, and their derivative. Finite
/// kinematics: on the current side; small: on the reference side.
///
/// Tested by  tests/unit/solid/test_loads.cpp
template <int Dim>
struct PressureResult {
  ElementVector<Dim, max_side_nodes> force;
  ElementMatrix<Dim, max_side_nodes> tangent;
};
template <int Dim>
[[nodiscard]] PressureResult<Dim> side_pressure(const Section<Dim>& section, cell::CellType side,
                                                const Coordinates<Dim>& reference,
                                                const Coordinates<Dim>& displacement,
                                                double pressure);

}  // namespace osculate::solid
