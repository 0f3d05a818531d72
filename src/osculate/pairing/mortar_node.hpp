#pragma once
// Slave nodes of a mortar pair: tractions from D and M, forces, derivatives; for sources of this
// layer.
#include "osculate/pairing/pair.hpp"
#include "osculate/pairing/response.hpp"

namespace osculate::pairing {

/// Where the node lies over the master.
template <int Dim>
[[nodiscard]] NodeContact<Dim> project_node(const MortarNode<Dim>& node,
                                            const NodalNormal<Dim>& normal);

/// Report, forces and constraint of node `i`, which has been placed: false where it is open.
template <int Dim>
bool evaluate_node(const PairDefinition<Dim>& pair, Points<Dim> x,
                   const contact::PointHistory<Dim>& history, const MortarPlace& last,
                   const MortarNode<Dim>& node, const PointContext<Dim>& context, std::size_t i,
                   NodeContact<Dim>& c, PairEvaluation<Dim>& out);

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

}  // namespace osculate::pairing
