#include "osculate/model/changing_unknowns.hpp"

#include <algorithm>

#include "osculate/model/bulk.hpp"

namespace osculate::model {
namespace {

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

template <int Dim>
void mark_cells(const BasicModel<Dim>& model, Marks<Dim>& marks) {
  for (const BasicBulkSection<Dim>& section : model.sections) {
    const bool linear = section.section.kinematics == solid::Kinematics::small &&
                        material::linear(section.section.law);
    for (const mesh::CellRef& cell : section.cells) {
      const std::span<const Index> nodes = cell_nodes(model.mesh, cell).nodes;
      const bool turns =
          std::ranges::any_of(nodes, [&](Index n) { return marks.dofs.body_of(n) >= 0; });
      if (!linear || turns) marks.nodes(nodes);
      marks.of_cells = marks.of_cells || !linear;
    }
  }
}

}  // namespace

template <int Dim>
std::vector<Index> changing_unknowns(const BasicModel<Dim>& model, const BasicDofSpace<Dim>& dofs,
                                     Index multipliers) {
  constexpr std::size_t fewest = 4;
  Marks<Dim> marks{model, dofs};
  mark_contact(model, marks);
  mark_cells(model, marks);
  const bool changes = !model.pair_changes.empty() || !model.springs.empty() ||
                       !model.node_constraints.empty() || marks.of_contact || marks.of_cells;
  if (!changes) return {};  // one iteration is all it takes
  for (const Spring& spring : model.springs) {
    for (const Index n : spring.ends) marks.node(n);
    for (const Equation::Term& term : spring.terms) marks.dof(term.dof);
  }
  for (const NodeConstraint& c : model.node_constraints) marks.nodes(c.nodes);
  for (const Step& step : model.steps)
    for (const PressureLoad& load : step.pressure)
      for (const PressureLoad::Facet& facet : load.facets) marks.nodes(facet.nodes);
  for (Index b = 0; b < dofs.bodies(); ++b)
    for (int k = 0; k < body::motions<Dim>; ++k) marks.dof(dofs.body_dof(b, k));
  std::vector<Index> out;
  for (std::size_t u = 0; u < marks.of_unknown.size(); ++u)
    if (marks.of_unknown[u]) out.push_back(static_cast<Index>(u));
  for (Index m = 0; m < multipliers; ++m) out.push_back(dofs.unknowns() + m);
  if (fewest * out.size() > marks.of_unknown.size()) out.clear();
  return out;
}

template std::vector<Index> changing_unknowns(const Model&, const DofSpace&, Index);
template std::vector<Index> changing_unknowns(const Model3&, const DofSpace3&, Index);

}  // namespace osculate::model
