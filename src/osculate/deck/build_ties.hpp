#pragma once
// Shared by build_*.cpp, not for users.
#include <set>
#include <vector>

#include "osculate/deck/build_displacements.hpp"

namespace osculate::deck {

/// Moves the slave nodes of ties that `adjust` onto their masters, in the reference coordinates.
template <int Dim>
void adjust_ties(BuildContext<Dim>& context);

/// Equations of the surfaces that are tied; says how many nodes are.
///
/// Formula    u = sum N_k u_k : a node of the slave, and the shape functions of the master's facet
///            at the nearest place of it, in reference coordinates, no farther than the tolerance
/// Input      ever, at_first: what any step prescribes, and what the first one does; `given`: what
///            other equations give. Displacements of slave nodes that the first step prescribes, or
///            that are given, are not tied; those of later steps move the master, where that is
///            free. Of several ties of a node the first counts
/// Errors     core::InputError where nothing is near, or the master is rigid
/// Tested by  tests/unit/deck/test_ties.cpp
template <int Dim>
void add_ties(BuildContext<Dim>& context, const PrescribedCourses& ever,
              const PrescribedCourses& at_first, std::set<model::Dof> given,
              std::vector<MarkedEquation>& all);

/// The nodes of the slave that a tie ties, in reference coordinates.
template <int Dim>
[[nodiscard]] std::vector<Index> nodes_of_tie(const BuildContext<Dim>& context, const Tie& tie);

}  // namespace osculate::deck
