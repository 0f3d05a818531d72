// Relations of the mesh as equations of the model.
#include <algorithm>
#include <limits>
#include <unordered_map>

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

/// By displacement: the first step that prescribes or holds it.
template <int Dim>
std::unordered_map<model::Dof, std::size_t> first_supports(const BuildContext<Dim>& c) {
  std::unordered_map<model::Dof, std::size_t> first;
  const std::vector<Step>& steps = c.description.steps;
  for (std::size_t s = 0; s < steps.size(); ++s) {
    const auto add = [&](const OneDisplacement& d) { first.try_emplace(d.dof, s); };
    for (const Release& held : steps[s].hold)
      for_each_displacement(c, held, [&](const OneDisplacement& d, std::size_t) { add(d); });
    for (const Prescription& p : steps[s].prescribe)
      for (std::size_t i = 0; i < component_count; ++i)
        if (p.values[i])
          std::ranges::for_each(displacements(c, p.on, static_cast<Component>(i), Idle::left_out),
                                add);
  }
  return first;
}

}  // namespace

template <int Dim>
void find_relation_steps(BuildContext<Dim>& c) {
  const std::vector<mesh::Relation>& all = c.model().mesh.relations;
  const auto waits = [](const mesh::Relation& relation) { return relation.from.node >= 0; };
  c.relations_from.assign(all.size(), 0);
  if (std::ranges::none_of(all, waits)) return;
  const std::unordered_map<model::Dof, std::size_t> first = first_supports(c);
  const std::vector<Step>& steps = c.description.steps;
  const bool fixed = !c.description.cyclic_symmetry.empty();
  constexpr std::size_t never = std::numeric_limits<std::size_t>::max();
  for (std::size_t r = 0; r < all.size(); ++r) {
    if (!waits(all[r])) continue;
    std::size_t& from = c.relations_from[r] = never;
    const auto [node, direction] = all[r].from;
    for (int k = 0; k < Dim; ++k)
      if (const auto found = first.find(Dim * node + k);
          found != first.end() && (direction < 0 || direction == k))
        from = std::min(from, found->second);
    while (from < steps.size() && (steps[from].modal || steps[from].harmonic)) ++from;
    if (fixed && from < steps.size()) from = 0;
    if (from > 0 && from < steps.size()) c.relation_changes.insert(from);
  }
}

template <int Dim>
std::vector<MarkedEquation> relations(const BuildContext<Dim>& c, std::size_t step,
                                      PrescribedCourses& courses) {
  std::vector<MarkedEquation> all;
  const std::vector<bool> live = related_nodes(c);
  const std::vector<mesh::Relation>& given = c.model().mesh.relations;
  for (std::size_t r = 0; r < given.size(); ++r) {
    if (c.relations_from[r] > step) continue;
    const mesh::Relation& relation = given[r];
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

template void find_relation_steps(BuildContext<2>&);
template void find_relation_steps(BuildContext<3>&);
template std::vector<MarkedEquation> relations(const BuildContext<2>&, std::size_t,
                                               PrescribedCourses&);
template std::vector<MarkedEquation> relations(const BuildContext<3>&, std::size_t,
                                               PrescribedCourses&);

}  // namespace osculate::deck
