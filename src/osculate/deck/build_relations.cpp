// Relations of the mesh as equations of the model.
#include "osculate/deck/build_displacements.hpp"

namespace osculate::deck {

template <int Dim>
std::vector<MarkedEquation> relations(const BuildContext<Dim>& c, PrescribedCourses& courses) {
  std::vector<MarkedEquation> all;
  for (const mesh::Relation& relation : c.model().mesh.relations) {
    MarkedEquation one{{}, c.description.mesh.mark, true};
    bool idle = relation.terms.size() > 1;  // of cells without section
    bool in_space = true;
    for (const mesh::Relation::Term& term : relation.terms) {
      in_space = in_space && term.direction < Dim;
      idle = idle && !c.takes_part(term.node);
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
