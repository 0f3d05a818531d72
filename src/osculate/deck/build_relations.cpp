// Relations of the mesh as equations of the model.
#include "osculate/deck/build_displacements.hpp"

namespace osculate::deck {

namespace {

/// Nodes that move with the solution, by cells, bodies, or relations with those that do.
template <int Dim>
std::vector<bool> related_nodes(const BuildContext<Dim>& c) {
  const mesh::Mesh& mesh = c.model().mesh;
  std::vector<bool> live(mesh.nodes.size());
  for (std::size_t n = 0; n < live.size(); ++n) live[n] = c.takes_part(static_cast<Index>(n));
  for (bool more = true; more;) {
    more = false;
    for (const mesh::Relation& relation : mesh.relations) {
      std::size_t count = 0;
      for (const auto& term : relation.terms) count += live[static_cast<std::size_t>(term.node)];
      if (count == 0 || count == relation.terms.size()) continue;
      more = true;
      for (const auto& term : relation.terms) live[static_cast<std::size_t>(term.node)] = true;
    }
  }
  return live;
}

}  // namespace

template <int Dim>
std::vector<MarkedEquation> relations(const BuildContext<Dim>& c, PrescribedCourses& courses) {
  std::vector<MarkedEquation> all;
  const std::vector<bool> live = related_nodes(c);
  for (const mesh::Relation& relation : c.model().mesh.relations) {
    MarkedEquation one{{}, c.description.mesh.mark, true};
    bool idle = relation.terms.size() > 1;  // of cells without section
    bool in_space = true;
    for (const mesh::Relation::Term& term : relation.terms) {
      in_space = in_space && term.direction < Dim;
      idle = idle && !live[static_cast<std::size_t>(term.node)];
    }
    if (idle || !in_space) continue;
    for (const mesh::Relation::Term& term : relation.terms) {
      add_displacement(c, term.node, Vec<Dim>(Vec<Dim>::Unit(term.direction)), term.factor,
                       one.equation);
      if (c.model().body_of_node[static_cast<std::size_t>(term.node)] >= 0)
        courses[Dim * term.node + term.direction] = {};
    }
    const std::vector<model::Equation::Term>& terms = one.equation.terms;
    if (terms.size() > 1 || !courses.contains(terms.front().dof)) all.push_back(std::move(one));
  }
  return all;
}

template std::vector<MarkedEquation> relations(const BuildContext<2>&, PrescribedCourses&);
template std::vector<MarkedEquation> relations(const BuildContext<3>&, PrescribedCourses&);

}  // namespace osculate::deck
