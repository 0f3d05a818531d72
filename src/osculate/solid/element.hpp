#pragma once
#include <array>
#include <string_view>

#include "osculate/cell/cell_type.hpp"
#include "osculate/material/law.hpp"

namespace osculate::solid {

enum class Assumption { plane_strain, plane_stress, axisymmetric };
enum class Kinematics { small, finite };
/// full: plain displacement element. bbar: mean dilatation (quad4; not plane stress), against
/// volumetric locking. enhanced: four incompatible strain modes (quad4; five where axisymmetric),
/// against bending and volumetric locking.
enum class Formulation { full, bbar, enhanced };

struct Section {
  Assumption assumption = Assumption::plane_strain;
  Kinematics kinematics = Kinematics::small;
  Formulation formulation = Formulation::full;
  double thickness = 1;
  material::Law law;
};

/// Empty if the cell type can be used with the section, else the reason in plain words.
[[nodiscard]] std::string_view unsupported(const Section& section, cell::CellType type);

inline constexpr int max_nodes = 9;
inline constexpr int max_points = 9;
using Coordinates = Eigen::Matrix<double, Eigen::Dynamic, 2, 0, max_nodes, 2>;
using ElementVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 2 * max_nodes, 1>;
using ElementMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 2 * max_nodes, 2 * max_nodes>;

enum class Status { ok, inverted, material_failed };

/// Internal force f = int B^T S dV (order x0, y0, x1, y1, ...) and its derivative.
///
/// Formula    total Lagrange for finite kinematics: E = (F^T F - I)/2, S = dW/dE
/// Units      force (plane: thickness; axisymmetric about the y axis: full circumference 2 pi R)
/// Input      memory: of the points of the cell, for laws that remember. Without it nothing has
///            happened to them yet
/// Returns    out.status: inverted if det F <= 0 at a quadrature point (finite kinematics),
///            material_failed if the law, or the modes of the enhanced strains, have no answer;
///            force and tangent are then not to be used. The tangent is symmetric for all sections
/// Requires   unsupported(section, type) is empty
/// Tested by  tests/unit/solid/test_derivatives.cpp, test_invariance.cpp, test_patch.cpp,
///            test_locking.cpp
struct ElementResult {
  Status status = Status::ok;
  ElementVector force;
  ElementMatrix tangent;  ///< filled only when asked for
};
void evaluate(const Section& section, cell::CellType type, const Coordinates& reference,
              const Coordinates& displacement, bool with_tangent, ElementResult& out,
              const material::Memory& memory = {});
/// Number of quadrature points.
[[nodiscard]] std::size_t point_count(const Section& section, cell::CellType type);

/// Cauchy stress and strain of one quadrature point (strain: Green-Lagrange or small; components
/// xx, yy, zz, xy, the last with half the shear angle). Formulations bbar and enhanced: the strain
/// that the material sees.
struct PointStress {
  Vec2 xi;        ///< reference coordinates
  Vec2 position;  ///< in the undeformed body
  double volume;  ///< undeformed; plane: times thickness, axisymmetric: full circumference
  Vec<4> stress, strain;
};
struct CellStress {
  Status status = Status::ok;
  int count = 0;
  std::array<PointStress, max_points> point;
};
/// Tested by  tests/unit/solid/test_stress.cpp
[[nodiscard]] CellStress stress_at_points(const Section& section, cell::CellType type,
                                          const Coordinates& reference,
                                          const Coordinates& displacement,
                                          const material::Memory& memory = {});

/// The same extrapolated to the nodes by least squares over the quadrature points.
///
/// Tested by  tests/unit/solid/test_stress.cpp
struct NodalStress {
  int count = 0;
  std::array<Vec<4>, max_nodes> stress, strain;
};
[[nodiscard]] NodalStress nodal_stress(const Section& section, cell::CellType type,
                                       const Coordinates& reference,
                                       const Coordinates& displacement,
                                       const material::Memory& memory = {});
/// Values of the points at the nodes in the same way: one row a point, one a node.
///
/// Tested by  tests/unit/solid/test_memory.cpp
[[nodiscard]] Eigen::MatrixXd at_nodes(const Section& section, cell::CellType type,
                                       const Eigen::MatrixXd& of_points);

/// int N_k dV: what a unit body force per volume gives each node.
[[nodiscard]] ElementVector volume_weights(const Section& section, cell::CellType type,
                                           const Coordinates& reference);

/// Smallest Jacobian determinant over the quadrature points and nodes.
[[nodiscard]] double smallest_jacobian(cell::CellType type, const Coordinates& reference);

/// int N_k dA over an edge (line cell order): what a unit traction gives each node.
[[nodiscard]] ElementVector edge_weights(const Section& section, const Coordinates& reference);

/// Nodal forces of a pressure p on an edge whose body is on the right of travel, f = -int p n N dA,
/// and their derivative. Finite kinematics: on the current edge; small: on the reference edge.
///
/// Tested by  tests/unit/solid/test_loads.cpp
struct PressureResult {
  ElementVector force;
  ElementMatrix tangent;
};
[[nodiscard]] PressureResult edge_pressure(const Section& section, const Coordinates& reference,
                                           const Coordinates& displacement, double pressure);

}  // namespace osculate::solid
