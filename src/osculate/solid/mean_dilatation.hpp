#pragma once
// Mean dilatation of quad4 and hex8 (formulation bbar).
#include "osculate/solid/points.hpp"

namespace osculate::solid {

/// Small strain: replaces the volumetric part of B, and of the strain, by its mean over the cell.
///
/// Tested by  tests/unit/solid/test_derivatives.cpp, test_locking.cpp, test_volume_locking.cpp
template <int Dim>
void average_volume_small(CornerPoints<Dim>& points, const Coordinates<Dim>& displacement);

/// Finite strain: each point sees the deformation gradient F_m = (theta/J)^(1/3) F with
/// theta = int J dV / int dV, so that det F_m = theta is the same at all points.
///
/// Formula    E_m = m E + (m - 1)/2 I,  m = (theta/J)^(2/3); the energy is int W(E_m) dV, of which
///            force and tangent are the exact derivatives (so the tangent is symmetric). The first
///            derivative of E_m is B_m = m B + (E_m + I/2) d(ln m)/du
/// Tested by  tests/unit/solid/test_derivatives.cpp, test_locking.cpp, test_volume_locking.cpp
template <int Dim>
struct MeanDilatation {
  using Vector = typename CornerSizes<Dim>::Vector;
  using Numbers = std::array<double, corners<Dim>>;
  CornerPoints<Dim> point;                 ///< E_m, B_m and F_m
  Numbers scale;                           ///< m
  std::array<Vector, corners<Dim>> log_m;  ///< d(ln m)/du
  std::array<Vector, corners<Dim>> log_j;  ///< d(ln J)/du
  Numbers volume_share;                    ///< J dV / int J dV
  Vector log_theta;                        ///< d(ln theta)/du
};
template <int Dim>
[[nodiscard]] MeanDilatation<Dim> mean_dilatation(const CornerPoints<Dim>& points);

/// Adds the lower triangle of the part of the tangent that comes from the change of B_m,
/// int S : d2(E_m)/du2 dV, but for m S : d2E, which the sum over the points has.
///
/// Input      points: those of the displacements themselves; stress: the response to E_m
template <int Dim>
void add_mean_dilatation_curvature(const CornerPoints<Dim>& points,
                                   const std::array<Vec<components<Dim>>, corners<Dim>>& stress,
                                   const MeanDilatation<Dim>& mean,
                                   typename CornerSizes<Dim>::Matrix& tangent);

}  // namespace osculate::solid
