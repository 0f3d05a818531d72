#pragma once
// Displacements that loads, prescriptions and equations name; shared by build_*.cpp, not for users.
#include <optional>
#include <utility>
#include <vector>

#include "osculate/deck/build_context.hpp"

namespace osculate::deck {

/// What happens to nodes of a set that take no part in the analysis.
enum class Idle { refused, left_out };
/// What happens to nodes of a set that rigid bodies move.
enum class InBodies { refused, kept };

/// A displacement component: a dof of the model, or (where local axes run against the global ones)
/// minus one.
struct OneDisplacement {
  model::Dof dof;
  double sign = 1;
};

template <int Dim>
[[nodiscard]] model::Dof body_dof(const model::BasicModel<Dim>& m, Index body,
                                  Component component) {
  return Dim * static_cast<model::Dof>(m.reference.size()) + body::motions<Dim> * body +
         motion_of<Dim>(component);
}

/// Axes of nodes that `axes` names, and the nodes that carry their local displacements where some
/// are prescribed; nodes without cells that equations or springs name, or that have a mass, become
/// unknowns. Before all that names displacements.
template <int Dim>
void build_axes(BuildContext<Dim>& context);

/// Nodes of a set that move with the solution and with no rigid body (unless these are kept), or in
/// one direction by a relation of the mesh. Throws for others.
template <int Dim>
[[nodiscard]] std::vector<Index> moving_nodes(const BuildContext<Dim>& context, const Name& on,
                                              Idle idle, std::optional<int> direction = {},
                                              InBodies in_bodies = InBodies::refused);

/// What `on` names for one component, of a rigid body or of each node, as prescriptions see it.
///
/// Tested by  tests/unit/deck/test_axes.cpp
template <int Dim>
[[nodiscard]] std::vector<OneDisplacement> displacements(const BuildContext<Dim>& context,
                                                         const Name& on, Component component,
                                                         Idle idle);

/// Calls `visit(displacement, component)` for all that a `release` or `hold` names.
template <int Dim, class Visit>
void for_each_displacement(const BuildContext<Dim>& context, const Release& of,
                           const Visit& visit) {
  for (std::size_t i = 0; i < component_count; ++i)
    if (of.of[i])
      for (const OneDisplacement& d :
           displacements(context, of.on, static_cast<Component>(i), Idle::left_out))
        visit(d, i);
}

/// Direction in the global axes of a component of a node.
template <int Dim>
[[nodiscard]] Vec<Dim> direction_of(const BuildContext<Dim>& context, Index node,
                                    Component component);

/// Adds factor times the displacement of a node along a direction to an equation: in local
/// displacements where the node has some.
template <int Dim>
void add_displacement(const BuildContext<Dim>& context, Index node, const Vec<Dim>& direction,
                      double factor, model::Equation& equation);
/// Adds factor times a component of a rigid body, or of every node of a set.
template <int Dim>
void add_component(const BuildContext<Dim>& context, const Name& on, Component component,
                   double factor, model::Equation& equation);
/// The same of a dof that is known already; what is named twice gets the sum of its factors.
void add_term(model::Equation& equation, model::Dof dof, double factor);

/// When relations of the mesh begin: with the first step that prescribes or holds what they wait
/// for; with cyclic symmetry, where equations do not change, all of them with the first one, in
/// steps along vibrations none, but with the next step.
template <int Dim>
void find_relation_steps(BuildContext<Dim>& context);
/// Equations of the mesh that hold in a step, of what takes part and is not prescribed by itself.
/// What rigid bodies move joins what is prescribed.
template <int Dim>
[[nodiscard]] std::vector<MarkedEquation> relations(const BuildContext<Dim>& context,
                                                    std::size_t step, PrescribedCourses& courses);

/// Equations of cyclic symmetry.
///
/// Formula    u = Q sum N_k u_k : a node of the dependent face and the facet of the independent one
///            at its place, turned by Q about the axis
/// Tested by  tests/unit/deck/test_cyclic_symmetry.cpp
template <int Dim>
void add_cyclic_symmetry(const BuildContext<Dim>& context, std::vector<MarkedEquation>& all);

}  // namespace osculate::deck
