#pragma once
// Shared by build_*.cpp, not for users.
#include <set>
#include <vector>

#include "osculate/deck/build_displacements.hpp"

namespace osculate::deck {

/// Moves the slave nodes of ties that `adjust` onto their masters, in the reference coordinates.
template <int Dim>
void adjust_ties(BuildContext<Dim>& context);

/// What keeps ties from moving a displacement, or from being moved by it.
struct TiesBeside {
  const PrescribedCourses& ever;      ///< what any step prescribes
  const PrescribedCourses& at_first;  ///< what the first one does
  const std::set<model::Dof>& led;    ///< what equations give by what is prescribed
};

/// Equations of the surfaces that are tied; says how many nodes are.
///
/// Formula    u = sum N_k u_k : a node of the slave, and the shape functions of the master's facet
///            at the nearest place of it, in reference coordinates, no farther than the tolerance
/// Input      given: what other equations give. Displacements of slave nodes that the first step
/// prescribes, or
///            that are given, are not tied; those of later steps move the master, where that is
///            free. Of several ties of a node the first counts
/// Errors     core::InputError where nothing is near, or the master is rigid
/// Tested by  tests/unit/deck/test_ties.cpp
template <int Dim>
void add_ties(BuildContext<Dim>& context, const TiesBeside& beside, std::set<model::Dof> given,
              std::vector<MarkedEquation>& all);

/// The nodes of the slave that a tie ties, in reference coordinates.
template <int Dim>
[[nodiscard]] std::vector<Index> nodes_of_tie(const BuildContext<Dim>& context, const Tie& tie);

}  // namespace osculate::deck
