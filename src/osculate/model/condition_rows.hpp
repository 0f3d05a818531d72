#pragma once
#include <span>
#include <vector>

#include "osculate/model/model.hpp"
#include "osculate/model/state.hpp"

namespace osculate::model {

/// Dofs of the nodes of a condition, then those of its body.
template <int Dim>
[[nodiscard]] std::vector<Dof> dofs_of(const NodeConstraint& c, const BasicDofSpace<Dim>& dofs);
/// Derivatives of one of its functions with respect to these.
template <int Dim>
[[nodiscard]] Eigen::VectorXd derivatives(const NodeConstraintValue<Dim>& g, Eigen::Index row);

/// Rows of conditions of nodes that follow from others, as those of a plane face and of a straight
/// edge of it do. What multipliers of both do against each other is nobody's force where conditions
/// are fulfilled, and not off that: a multiplier that follows is held where it is.
///
/// Formula    row i depends where |a_i - sum c_j a_j| <= 1e-6 |a_i| , a_i its derivatives with
///            respect to the unknowns, at `state`; D_i = 1e6 |a_i|^2 / s of these and 0 of others,
///            to be taken off the diagonal of the multiplier, s the stiffness that it is measured
///            by
/// Shapes     prescribed: by unknown, theirs are left out; returned: one for each row of
///            model.node_constraints
/// Limits     more than 2000 rows that share all their unknowns with others are not looked at
/// Decision   docs/decisions/116-conditions-that-follow-from-others.md
/// Tested by  tests/unit/deck/test_redundant_multipliers.cpp
template <int Dim>
[[nodiscard]] std::vector<double> held_conditions(const BasicModel<Dim>& model,
                                                  const BasicDofSpace<Dim>& dofs,
                                                  const std::vector<bool>& prescribed,
                                                  const BasicState<Dim>& state);

}  // namespace osculate::model
