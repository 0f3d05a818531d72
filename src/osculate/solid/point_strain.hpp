#pragma once
// One quadrature point of a bulk element; shared by element.cpp and stress.cpp.
#include <array>
#include <vector>

#include "osculate/cell/quadrature.hpp"
#include "osculate/cell/shape.hpp"
#include "osculate/solid/element.hpp"

namespace osculate::solid {

using StrainMatrix = Eigen::Matrix<double, 4, Eigen::Dynamic, 0, 4, 2 * max_nodes>;

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

/// All quadrature points of a cell.
struct Points {
  std::size_t count = 0;
  std::array<PointGeometry, max_points> geometry;
  std::array<PointStrain, max_points> strain;
};

/// Quadrature of a cell type with the shape functions at its points. No formulation leaves a mode
/// without energy.
struct AreaRule {
  std::vector<Vec2> points;
  std::vector<double> weights;
  std::vector<cell::AreaShape> shape;
};
[[nodiscard]] const AreaRule& area_rule(Assumption assumption, cell::CellType type);
[[nodiscard]] PointGeometry point_geometry(const Section& section, const cell::AreaShape& shape,
                                           const Coordinates& reference, double weight);
[[nodiscard]] PointStrain point_strain(const Section& section, const PointGeometry& geometry,
                                       const Coordinates& displacement);
/// Adds int G^T S G dV, the part of the tangent from the change of B (finite kinematics).
void add_geometric(const Section& section, const PointGeometry& geometry,
                   const material::Stress& stress, ElementMatrix& tangent);
/// Fills `points`; false if det F is not positive somewhere (finite kinematics).
[[nodiscard]] bool fill_points(const Section& section, cell::CellType type,
                               const Coordinates& reference, const Coordinates& displacement,
                               Points& points);
[[nodiscard]] material::Response point_response(const Section& section,
                                                const material::Strain& strain,
                                                const material::Memory& memory,
                                                double* strain_33 = nullptr);

}  // namespace osculate::solid
