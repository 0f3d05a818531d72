#pragma once
#include <string_view>

#include "osculate/cell/cell_type.hpp"
#include "osculate/material/law.hpp"

namespace osculate::solid {

enum class Assumption { plane_strain, plane_stress, axisymmetric };
enum class Kinematics { small, finite };
/// full: plain displacement element. bbar: mean volumetric strain (quad4, small strain), against
/// volumetric locking. enhanced: four incompatible strain modes (quad4), against bending and
/// volumetric locking.
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
using Coordinates = Eigen::Matrix<double, Eigen::Dynamic, 2, 0, max_nodes, 2>;
using ElementVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 2 * max_nodes, 1>;
using ElementMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 2 * max_nodes, 2 * max_nodes>;

enum class Status { ok, inverted, material_failed };

/// Internal force f = int B^T S dV (order x0, y0, x1, y1, ...) and its derivative.
///
/// Formula    total Lagrange for finite kinematics: E = (F^T F - I)/2, S = dW/dE
/// Units      force (plane: thickness; axisymmetric about the y axis: full circumference 2 pi R)
/// Tested by  tests/unit/solid/test_elements.cpp (order, patch tests, rigid motions)
struct ElementResult {
  Status status = Status::ok;
  ElementVector force;
  ElementMatrix tangent;  ///< filled only when asked for
};
void evaluate(const Section& section, cell::CellType type, const Coordinates& reference,
              const Coordinates& displacement, bool with_tangent, ElementResult& out);

/// Cauchy stress and strain (Green-Lagrange or small; xx, yy, zz, xy with half the shear angle)
/// extrapolated to the nodes by least squares over the quadrature points.
struct NodalStress {
  int count = 0;
  std::array<Vec<4>, max_nodes> stress, strain;
};
[[nodiscard]] NodalStress nodal_stress(const Section& section, cell::CellType type,
                                       const Coordinates& reference,
                                       const Coordinates& displacement);

/// int N_k dV: what a unit body force per volume gives each node.
[[nodiscard]] ElementVector volume_weights(const Section& section, cell::CellType type,
                                           const Coordinates& reference);

/// Smallest Jacobian determinant over the quadrature points and corners.
[[nodiscard]] double smallest_jacobian(cell::CellType type, const Coordinates& reference);

/// int N_k dA over an edge (line cell order): what a unit traction gives each node.
[[nodiscard]] ElementVector edge_weights(const Section& section, const Coordinates& reference);

/// Nodal forces of a pressure p on an edge whose body is on the right of travel, f = -int p n N dA,
/// and their derivative. Finite kinematics: on the current edge; small: on the reference edge.
struct PressureResult {
  ElementVector force;
  ElementMatrix tangent;
};
[[nodiscard]] PressureResult edge_pressure(const Section& section, const Coordinates& reference,
                                           const Coordinates& displacement, double pressure);

}  // namespace osculate::solid
