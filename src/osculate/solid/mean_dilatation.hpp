#pragma once
// Mean dilatation of quad4 and hex8 (formulation bbar).
#include "osculate/solid/cell_points.hpp"

namespace osculate::solid {

/// Small strain: replaces the volumetric part of B, and of the strain, by its mean over the cell.
///
/// Tested by  tests/unit/solid/test_derivatives.cpp, test_locking.cpp, test_volume_locking.cpp
template <class AnyPoints, class AnyCoordinates>
void average_volume_small(AnyPoints& points, const AnyCoordinates& displacement);

/// Finite strain: each point sees the deformation gradient F_m = (theta/J)^(1/3) F with
/// theta = int J dV / int dV, so that det F_m = theta is the same at all points.
///
/// Formula    E_m = m E + (m - 1)/2 I,  m = (theta/J)^(2/3); the energy is int W(E_m) dV, of which
///            force and tangent are the exact derivatives (so the tangent is symmetric). The first
///            derivative of E_m is B_m = m B + (E_m + I/2) d(ln m)/du
/// Tested by  tests/unit/solid/test_derivatives.cpp, test_locking.cpp, test_volume_locking.cpp
template <class AnyPoints>
struct MeanDilatation {
  static constexpr std::size_t most = PointsTraits<AnyPoints>::most;
  using Vector = typename PointsTraits<AnyPoints>::Vector;
  AnyPoints point;                        ///< E_m, B_m and F_m
  std::array<double, most> scale;         ///< m
  std::array<Vector, most> log_m;         ///< d(ln m)/du
  std::array<Vector, most> log_j;         ///< d(ln J)/du
  std::array<double, most> volume_share;  ///< J dV / int J dV
  Vector log_theta;                       ///< d(ln theta)/du
};
template <class AnyPoints>
[[nodiscard]] MeanDilatation<AnyPoints> mean_dilatation(const AnyPoints& points);

/// Adds the part of the tangent that comes from the change of B_m, int S : d2(E_m)/du2 dV, but for
/// m S : d2E, which add_geometric adds. Whole in the plane, in space the lower triangle.
///
/// Input      points: those of the displacements themselves; stress: the response to E_m; ring:
///            axisymmetric
template <class AnyPoints, class Stress>
void add_mean_dilatation_curvature(const AnyPoints& points,
                                   const std::array<Stress, PointsTraits<AnyPoints>::most>& stress,
                                   const MeanDilatation<AnyPoints>& mean, bool ring,
                                   typename PointsTraits<AnyPoints>::Matrix& tangent);

}  // namespace osculate::solid
