#include "osculate/model/dof_space.hpp"

#include <algorithm>

namespace osculate::model {

template <int Dim>
BasicDofSpace<Dim>::BasicDofSpace(Index nodes, std::vector<Index> body_of_node, Index bodies,
                                  std::vector<Equation> equations,
                                  const std::vector<bool>& used_node,
                                  std::span<const Dof> also_used)
    : nodes_(nodes),
      bodies_(bodies),
      body_of_node_(std::move(body_of_node)),
      equations_(std::move(equations)) {
  const auto total = static_cast<std::size_t>(dofs());
  unknown_of_.assign(total, -1);
  equation_of_.assign(total, -1);
  alone_.assign(total, false);
  std::vector<bool> named(total, false);  // an equation gives a dof without cells its stiffness
  for (const Dof dof : also_used) named[static_cast<std::size_t>(dof)] = true;
  for (std::size_t e = 0; e < equations_.size(); ++e) {
    equation_of_[static_cast<std::size_t>(equations_[e].terms.front().dof)] = static_cast<Index>(e);
    for (const Equation::Term& term : equations_[e].terms)
      named[static_cast<std::size_t>(term.dof)] = true;
  }
  for (Dof dof = 0; dof < dofs(); ++dof) {
    const auto d = static_cast<std::size_t>(dof);
    const auto node = d / Dim;
    const bool of_node = dof < Dim * nodes_;
    alone_[d] = of_node && body_of_node_[node] < 0 && !used_node[node] && named[d];
    if (equation_of_[d] >= 0) continue;
    if (of_node && (body_of_node_[node] >= 0 || !(used_node[node] || named[d]))) continue;
    unknown_of_[d] = unknowns_++;
    dof_of_unknown_.push_back(dof);
  }
}

template <int Dim>
void BasicDofSpace<Dim>::expand(Dof dof, double factor, std::span<const Vec<Dim>> x,
                                const std::vector<body::BasicRigidMotion<Dim>>& rigid,
                                std::vector<Expansion>& out) const {
  const auto d = static_cast<std::size_t>(dof);
  if (unknown_of_[d] >= 0) {
    out.push_back({unknown_of_[d], factor});
    return;
  }
  if (equation_of_[d] >= 0) {
    const Equation& equation = equations_[static_cast<std::size_t>(equation_of_[d])];
    const double lead = equation.terms.front().factor;
    for (std::size_t t = 1; t < equation.terms.size(); ++t)
      expand(equation.terms[t].dof, -factor * equation.terms[t].factor / lead, x, rigid, out);
    return;
  }
  if (dof >= Dim * nodes_) return;
  const Index node = dof / Dim;
  const Index b = body_of_node_[static_cast<std::size_t>(node)];
  if (b < 0) return;  // a node nobody uses
  const Mat<Dim, body::motions<Dim>> gradient =
      body::motion_gradient(rigid[static_cast<std::size_t>(b)], x[static_cast<std::size_t>(node)]);
  for (int component = 0; component < body::motions<Dim>; ++component) {
    const double value = gradient(dof % Dim, component);
    if (value != 0.0) expand(body_dof(b, component), factor * value, x, rigid, out);
  }
}

template <int Dim>
bool BasicDofSpace<Dim>::turns(Dof dof) const {
  const auto d = static_cast<std::size_t>(dof);
  if (unknown_of_[d] >= 0) return false;
  if (equation_of_[d] >= 0)
    return std::ranges::any_of(
        std::span(equations_[static_cast<std::size_t>(equation_of_[d])].terms).subspan(1),
        [&](const Equation::Term& term) { return turns(term.dof); });
  return dof < Dim * nodes_ && body_of_node_[static_cast<std::size_t>(dof / Dim)] >= 0;
}

template class BasicDofSpace<2>;
template class BasicDofSpace<3>;

}  // namespace osculate::model
