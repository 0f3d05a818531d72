#pragma once
// Slave nodes of a mortar pair: tractions from D and M, forces, derivatives; for sources of this
// layer.
#include "osculate/pairing/friction_branch.hpp"
#include "osculate/pairing/pair.hpp"

namespace osculate::pairing {

/// Where the node lies over the master.
template <int Dim>
[[nodiscard]] NodeContact<Dim> place_node(const MortarNode<Dim>& node,
                                          const NodalNormal<Dim>& normal);

/// Slip since the last place and the shear traction.
template <int Dim>
void set_friction(const PairDefinition<Dim>& pair, const contact::PointHistory<Dim>& history,
                  const MortarPlace& last, Points<Dim> x, const BranchHint<Dim>& hint,
                  NodeContact<Dim>& c);

template <int Dim>
void report(const PairDefinition<Dim>& pair, const contact::PointHistory<Dim>& old,
            const MortarNode<Dim>& node, const NodeContact<Dim>& c, PointResult<Dim>& result);

template <int Dim>
void set_forces(const MortarNode<Dim>& node, const NodeContact<Dim>& c, ContactBlock<Dim>& block);

/// Adds the derivatives of d_j, sum_k D_jk x_k and sum_l M_jl x_l of a facet's nodes, those of D
/// and M alone.
template <int Dim>
void add_rates(const MortarFacet<Dim>& matrices, std::span<const Index> slaves,
               std::span<const std::size_t> local, Points<Dim> x,
               std::vector<MortarNode<Dim>>& nodes);

/// The derivatives of D and M times the tractions.
template <int Dim>
void set_facet_tangent(const MortarFacet<Dim>& matrices, std::span<const Index> slaves,
                       std::span<const std::size_t> local,
                       std::type_identity_t<std::span<const Vec<Dim>>> tractions,
                       ContactBlock<Dim>& block);

/// Completes the rates of a node by those at fixed D and M, of the last place and of the frame, and
/// sets the derivative of its traction as path of the block, and the rows of its constraint.
template <int Dim>
void set_path(const PairDefinition<Dim>& pair, double constraint_area, const NodeContact<Dim>& c,
              const MortarPlace& last, const NodalNormal<Dim>& normal, MortarNode<Dim>& node,
              ContactBlock<Dim>& block);

/// Values and columns of a node whose tractions are unknowns.
template <int Dim>
void set_constraint(const PointPenalty& penalty, const NodeContact<Dim>& c,
                    const MortarNode<Dim>& node, double area,
                    const contact::Multiplier<Dim>& multiplier, ContactBlock<Dim>& block);

}  // namespace osculate::pairing
