#include "osculate/model/explicit_obstacle.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "osculate/mesh/boundary.hpp"
#include "osculate/model/bulk.hpp"
#include "osculate/pairing/combinations.hpp"

namespace osculate::model {
namespace {

/// How many of the motions of a body, from one on, the step leaves free.
template <int Dim>
int free_motions_of(const BasicModel<Dim>& model, const Step& step, std::size_t body, int from) {
  const Dof first =
      Dim * static_cast<Dof>(model.reference.size()) + body::motions<Dim> * static_cast<Dof>(body);
  int count = body::motions<Dim> - from;
  for (const PrescribedDof& p : step.prescribed)
    if (p.dof >= first + from && p.dof < first + body::motions<Dim>) --count;
  return count;
}

template <int Dim>
std::string obstacle_of_bodies(const BasicModel<Dim>& model, const Step& step) {
  for (std::size_t b = 0; b < model.rigid.size(); ++b) {
    const BasicRigidBody<Dim>& body = model.rigid[b];
    const int free = free_motions_of(model, step, b, 0);
    if (free > 0 && !(body.mass > 0))
      return fmt::format("the rigid body '{}' is free to move and has no mass", body.name);
    const int turns = free_motions_of(model, step, b, Dim);
    if (Dim == 3 && turns > 0 && turns < Dim)
      return fmt::format(
          "of the rotations of the rigid body '{}' some are prescribed and some are free: all or "
          "none of them can be, with central differences",
          body.name);
    if (free == 0) continue;
    for (const BasicBulkSection<Dim>& section : model.sections)
      for (const mesh::CellRef& ref : section.cells)
        for (const Index node : cell_nodes(model.mesh, ref).nodes)
          if (model.body_of_node[static_cast<std::size_t>(node)] == static_cast<Index>(b))
            return fmt::format(
                "cells are attached to the rigid body '{}', which is free to move: their mass at "
                "its nodes is not one of the body's own",
                body.name);
  }
  return {};
}

template <int Dim>
std::string obstacle_of_equations(const BasicModel<Dim>& model) {
  if (!model.springs.empty()) return "springs are not in the explicit time integration";
  if (!model.node_constraints.empty())
    return "constraints of nodes have multipliers, for which no mass is there";
  const auto nodes = static_cast<Dof>(model.reference.size());
  for (const Equation& equation : model.equations) {
    if (equation.terms.size() > 2)
      return "an equation of more than two displacements couples masses, which are at the nodes "
             "with central differences";
    if (equation.value != 0.0)
      return "an equation with a constant that is not zero moves a node without telling its "
             "velocity";
    for (const Equation::Term& term : equation.terms) {
      const Dof of_body = term.dof - Dim * nodes;
      if (of_body < 0 && model.body_of_node[static_cast<std::size_t>(term.dof / Dim)] >= 0)
        return "an equation ties a displacement to a node of a rigid body";
      if (Dim == 3 && of_body >= 0 && of_body % body::motions<Dim> >= Dim)
        return "an equation has a rotation of a rigid body, which in space is no sum of others";
    }
  }
  return {};
}

/// Free nodes without a mass.
template <int Dim>
std::string obstacle_of_masses(const BasicModel<Dim>& model) {
  for (const BasicBulkSection<Dim>& section : model.sections) {
    const double density = material::density(section.section.law);
    if (density > 0) continue;
    for (const mesh::CellRef& ref : section.cells)
      for (const Index node : cell_nodes(model.mesh, ref).nodes)
        if (model.body_of_node[static_cast<std::size_t>(node)] < 0)
          return fmt::format("{} has no mass: the material of '{}' has no density",
                             mesh::describe_node(model.mesh, node), section.name);
  }
  return {};
}

}  // namespace

template <int Dim>
std::string explicit_obstacle(const BasicModel<Dim>& model, const Step& step) {
  for (const BasicContactPair<Dim>& pair : model.pairs) {
    pairing::Traits traits = pairing::traits_of(pair.definition);
    traits.add(pairing::Trait::explicit_time);
    if (const pairing::Refusal* const no = pairing::refusal(traits))
      return fmt::format("the contact '{}' has {}", pair.name, no->why);
  }
  std::string obstacle = obstacle_of_bodies(model, step);
  if (obstacle.empty()) obstacle = obstacle_of_equations(model);
  if (obstacle.empty()) obstacle = obstacle_of_masses(model);
  return obstacle;
}

template std::string explicit_obstacle(const Model&, const Step&);
template std::string explicit_obstacle(const Model3&, const Step&);

}  // namespace osculate::model
