#pragma once
#include "osculate/la/places.hpp"
#include "osculate/model/model.hpp"

namespace osculate::model {

/// Nodes, directions and places of the unknowns, and which of them are of contact, springs and
/// conditions of nodes.
///
/// Input      multipliers: number of those that are unknowns, which follow those of `dofs`
/// Tested by  tests/unit/deck/test_multigrid_models.cpp
template <int Dim>
[[nodiscard]] la::Places unknown_places(const BasicModel<Dim>& model,
                                        const BasicDofSpace<Dim>& dofs, Index multipliers);

}  // namespace osculate::model
