#pragma once
#include <vector>

#include "osculate/model/model.hpp"

namespace osculate::model {

/// Whether forces of a section's cells are linear in the displacements, where no rigid body turns
/// their nodes.
template <int Dim>
[[nodiscard]] bool is_linear(const BasicBulkSection<Dim>& section);

/// Whether a cell has the same stiffness in all states of a model: its forces are linear in the
/// displacements, and no rigid body turns its nodes, nor what they follow by equations.
template <int Dim>
[[nodiscard]] bool is_constant(const BasicModel<Dim>& model, const BasicDofSpace<Dim>& dofs,
                               const BasicBulkSection<Dim>& section, const mesh::CellRef& cell);

/// Unknowns between which the tangent is likely to change from one iteration to the next: of nodes
/// in contact pairs, of cells whose forces are not linear in the displacements or that hang on
/// rigid bodies, of springs, constraints and loads that turn, and of rigid bodies. All other
/// entries are those of bodies that are linear. Empty where these are too many to be of use.
///
/// Input      multipliers: number of those that are unknowns, which follow those of `dofs`
/// Tested by  tests/unit/deck/test_changing_unknowns.cpp
template <int Dim>
[[nodiscard]] std::vector<Index> changing_unknowns(const BasicModel<Dim>& model,
                                                   const BasicDofSpace<Dim>& dofs,
                                                   Index multipliers);

}  // namespace osculate::model
