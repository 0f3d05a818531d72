#pragma once
#include <array>
#include <string_view>

#include "osculate/cell/volume_shape.hpp"
#include "osculate/solid/element.hpp"

namespace osculate::solid {

/// full: plain displacement element. bbar: mean dilatation (hex8), against volumetric locking.
/// enhanced: twelve incompatible strain modes (hex8), against bending and volumetric locking.
/// solid_shell: assumed and enhanced strains of thin bodies.
enum class VolumeFormulation { full, bbar, enhanced, solid_shell };

/// What a body in space is made of; the counterpart of `Section`.
struct VolumeSection {
  Kinematics kinematics = Kinematics::small;
  VolumeFormulation formulation = VolumeFormulation::full;
  material::Law law;
};

/// Empty if the cell type can be used with the section, else the reason in plain words.
[[nodiscard]] std::string_view unsupported(const VolumeSection& section, cell::CellType type);

inline constexpr int max_volume_nodes = cell::max_volume_nodes;
inline constexpr int max_volume_points = 27;
using Coordinates3 = Eigen::Matrix<double, Eigen::Dynamic, 3, 0, max_volume_nodes, 3>;
using VolumeVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3 * max_volume_nodes, 1>;
using VolumeMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3 * max_volume_nodes,
                                   3 * max_volume_nodes>;

/// Internal force f = int B^T S dV (order x0, y0, z0, x1, ...) and its derivative, which is
/// symmetric.
///
/// Formula    total Lagrange for finite kinematics: E = (F^T F - I)/2, S = dW/dE
/// Input      memory: of the points of the cell, as in the plane
/// Returns    out.status: inverted if det F <= 0 at a quadrature point (finite kinematics),
///            material_failed if the law, or the modes of the enhanced strains, have no answer;
///            force and tangent are then not to be used
/// Requires   unsupported(section, type) is empty
/// Tested by  tests/unit/solid/test_derivatives.cpp, test_patch.cpp, test_volume_locking.cpp
struct VolumeResult {
  Status status = Status::ok;
  VolumeVector force;
  VolumeMatrix tangent;  ///< filled only when asked for
};
void evaluate(const VolumeSection& section, cell::CellType type, const Coordinates3& reference,
              const Coordinates3& displacement, bool with_tangent, VolumeResult& out,
              const material::Memory& memory = {});
[[nodiscard]] std::size_t point_count(const VolumeSection& section, cell::CellType type);

/// Cauchy stress and strain of one quadrature point (strain: Green-Lagrange or small; components
/// xx, yy, zz, xy, yz, zx, the last three with half the shear angle). Formulations other than full:
/// the strain that the material sees.
struct PointStress3 {
  Vec3 xi;        ///< reference coordinates
  Vec3 position;  ///< in the undeformed body
  double volume;  ///< undeformed
  Vec<6> stress, strain;
};
struct CellStress3 {
  Status status = Status::ok;
  int count = 0;
  std::array<PointStress3, max_volume_points> point;
};
/// Tested by  tests/unit/solid/test_stress.cpp
[[nodiscard]] CellStress3 stress_at_points(const VolumeSection& section, cell::CellType type,
                                           const Coordinates3& reference,
                                           const Coordinates3& displacement,
                                           const material::Memory& memory = {});

/// The same extrapolated to the nodes by least squares over the quadrature points.
///
/// Tested by  tests/unit/solid/test_stress.cpp
struct NodalStress3 {
  int count = 0;
  std::array<Vec<6>, max_volume_nodes> stress, strain;
};
[[nodiscard]] NodalStress3 nodal_stress(const VolumeSection& section, cell::CellType type,
                                        const Coordinates3& reference,
                                        const Coordinates3& displacement,
                                        const material::Memory& memory = {});
[[nodiscard]] Eigen::MatrixXd at_nodes(const VolumeSection& section, cell::CellType type,
                                       const Eigen::MatrixXd& of_points);

/// int N_k dV: what a unit body force per volume gives each node.
[[nodiscard]] VolumeVector volume_weights(cell::CellType type, const Coordinates3& reference);

/// Smallest Jacobian determinant over the quadrature points and nodes.
[[nodiscard]] double smallest_jacobian(cell::CellType type, const Coordinates3& reference);

/// Nodal values of a face, an area cell of at most nine nodes.
using FaceVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 27, 1>;
using FaceMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 27, 27>;

/// int N_k dA over a face: what a unit traction gives each node.
///
/// Requires   face is tri3, tri6, quad4, quad8 or quad9
[[nodiscard]] FaceVector face_weights(cell::CellType face, const Coordinates3& reference);

/// Nodal forces of a pressure p on a face whose normal r_1 x r_2 points out of the body,
/// f_k = -int p N_k (x_1 x x_2) dxi, and their derivative. Finite kinematics: on the current face;
/// small: on the reference face.
///
/// Requires   face is tri3, tri6, quad4, quad8 or quad9
/// Tested by  tests/unit/solid/test_loads.cpp
struct FacePressure {
  FaceVector force;
  FaceMatrix tangent;
};
[[nodiscard]] FacePressure face_pressure(const VolumeSection& section, cell::CellType face,
                                         const Coordinates3& reference,
                                         const Coordinates3& displacement, double pressure);

}  // namespace osculate::solid
