#pragma once
// Penalties from the stiffness of the bodies behind a contact (docs/decisions/020).
#include "osculate/model/layers_behind.hpp"

namespace osculate::model {

/// Both sides of a contact: as a whole, and facet by facet (or node by node).
struct BothSides {
  std::vector<LayerSum> slaves, masters;
  Layer slave, master;
};
template <int Dim>
[[nodiscard]] BothSides sides_of(const BasicModel<Dim>& model, const CellsOfNodes<Dim>& cells,
                                 const pairing::PairDefinition<Dim>& pair);

/// Height of the thinner cells; 0: both sides are rigid.
[[nodiscard]] double height_of(const BothSides& sides);

/// Penalties per area.
///
/// Formula    automatic_factor times the two layers' stiffness behind each other: E/h, G/h
struct AutomaticStiffness {
  double normal = 0, shear = 0;
};
[[nodiscard]] AutomaticStiffness automatic_stiffness(const BothSides& sides);

/// Factors of the single points (of the penalties that are asked for), and the heights of the cells
/// there, if any of them differs.
///
/// Formula    pairing::own_factor of the ratio of the point's own stiffness to the mean
/// Tested by  tests/unit/deck/test_point_penalties.cpp
template <int Dim>
void set_point_factors(const BasicModel<Dim>& model, const CellsOfNodes<Dim>& cells,
                       const BothSides& sides, bool normal, bool shear, BasicContactPair<Dim>& out);

}  // namespace osculate::model
