#pragma once
// Mean dilatation of quad4 (formulation bbar); shared by element.cpp and stress.cpp.
#include <span>

#include "osculate/solid/point_strain.hpp"

namespace osculate::solid {

/// Small strain: replaces the volumetric part of B, and of the strain, by its mean over the cell.
///
/// Tested by  tests/unit/solid/test_derivatives.cpp, test_locking.cpp
void average_volume_small(std::span<const PointGeometry> geometry, std::span<PointStrain> strain,
                          const Coordinates& displacement);

/// Finite strain: each point sees the deformation gradient F_m = (theta/J)^(1/3) F with
/// theta = int J dV / int dV, so that det F_m = theta is the same at all points.
///
/// Formula    E_m = m E + (m - 1)/2 I,  m = (theta/J)^(2/3); the energy is int W(E_m) dV, of which
///            force and tangent are the exact derivatives (so the tangent is symmetric). The first
///            derivative of E_m is B_m = m B + (E_m + I/2) d(ln m)/du
/// Tested by  tests/unit/solid/test_derivatives.cpp, test_locking.cpp
struct MeanDilatation {
  std::array<double, max_points> scale;         ///< m
  std::array<PointStrain, max_points> strain;   ///< E_m and B_m; f and f33 of F_m
  std::array<ElementVector, max_points> log_m;  ///< d(ln m)/du
  std::array<ElementVector, max_points> log_j;  ///< d(ln J)/du
  std::array<double, max_points> volume_share;  ///< J dV / int J dV
  ElementVector log_theta;                      ///< d(ln theta)/du
};
[[nodiscard]] MeanDilatation mean_dilatation(std::span<const PointGeometry> geometry,
                                             std::span<const PointStrain> strain);

/// Adds the part of the tangent that comes from the change of B_m: int S : d2(E_m)/du2 dV.
/// `strain` are the points of the displacements themselves, `stress` the response to E_m.
void add_mean_dilatation_geometric(const Section& section, std::span<const PointGeometry> geometry,
                                   std::span<const PointStrain> strain,
                                   std::span<const material::Response> response,
                                   const MeanDilatation& mean, ElementMatrix& tangent);

}  // namespace osculate::solid
