#pragma once
// One quadrature point of a bulk element; shared by element.cpp and stress.cpp.
#include <span>

#include "osculate/cell/quadrature.hpp"
#include "osculate/cell/shape.hpp"
#include "osculate/solid/element.hpp"

namespace osculate::solid {

using StrainMatrix = Eigen::Matrix<double, 4, Eigen::Dynamic, 0, 4, 2 * max_nodes>;

inline constexpr int max_points = 9;

/// Geometry of one quadrature point in the reference configuration.
struct PointGeometry {
  double volume = 0;  ///< weight times area times thickness or circumference
  double determinant = 0;
  double radius = 0;     ///< reference radius (axisymmetric)
  Coordinates gradient;  ///< dN_k/dX
  cell::AreaShape shape;
};

/// Strain of one point and its derivative with respect to the displacements.
struct PointStrain {
  material::Strain strain = material::Strain::Zero();
  StrainMatrix b;
  Mat<2, 2> f = Mat<2, 2>::Identity();
  double f33 = 1;
};

[[nodiscard]] const cell::Quadrature2D& quadrature_of(cell::CellType type);
[[nodiscard]] PointGeometry point_geometry(const Section& section, cell::CellType type,
                                           const Coordinates& reference, const Vec2& xi,
                                           double weight);
[[nodiscard]] PointStrain point_strain(const Section& section, const PointGeometry& geometry,
                                       const Coordinates& displacement);
[[nodiscard]] material::Response point_response(const Section& section,
                                                const material::Strain& strain,
                                                double* strain_33 = nullptr);

}  // namespace osculate::solid
