#pragma once
// Included by the sources that tell solvers of the unknowns.
#include <span>
#include <vector>

#include "osculate/model/model.hpp"

namespace osculate::model {

/// Which unknowns have been marked, node by node and dof by dof.
template <int Dim>
struct Marks {
  const BasicModel<Dim>& model;
  const BasicDofSpace<Dim>& dofs;
  std::vector<char> of_unknown = std::vector<char>(static_cast<std::size_t>(dofs.unknowns()), 0);
  std::vector<body::BasicRigidMotion<Dim>> rigid{model.rigid.size()};
  std::vector<Expansion> scratch{};
  bool of_contact = false, of_cells = false;  ///< anything that may change was met

  void dof(Dof d) {
    scratch.clear();
    dofs.expand(d, 1.0, model.reference, rigid, scratch);
    for (const Expansion& e : scratch) of_unknown[static_cast<std::size_t>(e.unknown)] = 1;
  }
  void node(Index n) {
    if (n < 0) return;
    for (int k = 0; k < Dim; ++k) dof(Dim * n + k);
  }
  template <class Range>
  void nodes(const Range& all) {
    for (const Index n : all) node(n);
  }
  void boundary(const pairing::Boundary<Dim>& of) {
    for (const auto& facet : of.facets)
      nodes(std::span(facet.nodes).first(static_cast<std::size_t>(facet.count)));
  }
};

template <int Dim>
void mark_contact(const BasicModel<Dim>& model, Marks<Dim>& marks) {
  for (const BasicContactPair<Dim>& pair : model.pairs) {
    const pairing::PairDefinition<Dim>& d = pair.definition;
    marks.nodes(d.slave.nodes);
    for (const pairing::SlavePoint<Dim>& p : d.slave.points)
      marks.nodes(std::span(p.nodes).first(static_cast<std::size_t>(p.count)));
    marks.boundary(d.slave.boundary);
    marks.boundary(d.master);
    marks.of_contact = marks.of_contact || !pairing::is_tied(d);
  }
}

/// Springs and conditions of nodes.
template <int Dim>
void mark_connectors(const BasicModel<Dim>& model, Marks<Dim>& marks) {
  for (const Spring& spring : model.springs) {
    for (const Index n : spring.ends) marks.node(n);
    for (const Equation::Term& term : spring.terms) marks.dof(term.dof);
  }
  for (const NodeConstraint& c : model.node_constraints) marks.nodes(c.nodes);
}

}  // namespace osculate::model
