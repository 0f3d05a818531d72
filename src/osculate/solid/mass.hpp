#pragma once
#include "osculate/solid/element.hpp"

namespace osculate::solid {

/// Consistent mass of a cell per unit density, one number per pair of nodes (the same in every
/// direction), by a rule that is exact for straight-sided cells.
///
/// Formula    M_ij = int N_i N_j dV
/// Units      volume (plane: times thickness; axisymmetric: full circumference 2 pi R)
/// Shapes     as many rows and columns as the cell has nodes
/// Tested by  tests/unit/solid/test_mass.cpp
using NodeMass =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, max_nodes<3>, max_nodes<3>>;
template <int Dim>
[[nodiscard]] NodeMass consistent_mass(const Section<Dim>& section, cell::CellType type,
                                       const Coordinates<Dim>& reference);

/// The diagonal of the consistent mass, scaled to the mass of the cell: no node of a quadratic cell
/// has a mass that is zero or negative, as with sums of rows.
///
/// Source     Hinton1976
/// Tested by  tests/unit/solid/test_mass.cpp
[[nodiscard]] NodeMass lumped_mass(const NodeMass& consistent);

}  // namespace osculate::solid
