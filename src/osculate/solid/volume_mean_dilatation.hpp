#pragma once
// Mean dilatation of hex8 (formulation bbar); shared by volume.cpp and volume_stress.cpp.
#include "osculate/solid/volume_point.hpp"

namespace osculate::solid {

/// Small strain: replaces the volumetric part of B, and of the strain, by its mean over the cell.
///
/// Tested by  tests/unit/solid/test_derivatives.cpp, test_volume_locking.cpp
void average_volume_small(HexPoints& points, const Coordinates3& displacement);

/// Finite strain: each point sees F_m = (theta/J)^(1/3) F with theta = int J dV / int dV.
///
/// Formula    E_m = m E + (m - 1)/2 I,  m = (theta/J)^(2/3), as `mean_dilatation` in the plane
/// Tested by  tests/unit/solid/test_derivatives.cpp, test_volume_locking.cpp
struct MeanDilatation3 {
  std::array<double, 8> scale;            ///< m
  HexPoints point;                        ///< E_m, B_m and F_m
  std::array<HexSizes::Vector, 8> log_m;  ///< d(ln m)/du
  std::array<HexSizes::Vector, 8> log_j;  ///< d(ln J)/du
  std::array<double, 8> volume_share;     ///< J dV / int J dV
  HexSizes::Vector log_theta;             ///< d(ln theta)/du
};
[[nodiscard]] MeanDilatation3 mean_dilatation(const HexPoints& points);

/// Adds the part of the tangent that comes from the change of B_m: int S : d2(E_m)/du2 dV, of
/// which `geometric` takes the node matrix. Of both only the lower triangles are complete.
/// `points` are those of the displacements themselves, `stress` the response to E_m.
void add_mean_dilatation_geometric(const HexPoints& points,
                                   const std::array<material::Stress3, 8>& stress,
                                   const MeanDilatation3& mean, HexSizes::Matrix& tangent,
                                   HexSizes::NodeMatrix& geometric);

}  // namespace osculate::solid
