// Springs, dampers and masses at nodes.
#include <fmt/format.h>

#include <cmath>

#include "osculate/deck/build_displacements.hpp"

namespace osculate::deck {
namespace {

/// Node of a set of one.
template <int Dim>
Index node_of(const BuildContext<Dim>& c, const Name& on) {
  const std::vector<Index>& nodes = c.set(on).nodes;
  if (nodes.size() == 1) return nodes[0];
  throw core::InputError(on.mark, fmt::format("a spring joins two nodes, and '{}' has {} of them",
                                              on.value, nodes.size()));
}

template <int Dim>
void join(const BuildContext<Dim>& c, const Spring& spring, model::Spring& out) {
  const model::BasicModel<Dim>& m = c.model();
  for (std::size_t i = 0; i < 2; ++i) out.ends[i] = node_of(c, spring.between[i]);
  const auto at = [&](std::size_t i) { return m.reference[static_cast<std::size_t>(out.ends[i])]; };
  if (!((at(1) - at(0)).norm() > 0))
    throw core::InputError(spring.between[1].mark,
                           fmt::format("'{}' and '{}' lie at one place: the spring has no "
                                       "direction; give it `terms`",
                                       spring.between[0].value, spring.between[1].value));
}

/// As in equations, but of the nodes' own displacements where these have local ones: the forces are
/// those of the nodes.
template <int Dim>
void add_to_elongation(const BuildContext<Dim>& c, const EquationTerm& term,
                       model::Equation& elongation) {
  if (c.rigid_index.contains(term.on.value) || is_rotation(term.of))
    return add_component(c, term.on, term.of, term.factor.value, elongation);
  constexpr double rounding = 1e-14;
  for (const Index node : moving_nodes(c, term.on, Idle::refused, motion_of<Dim>(term.of))) {
    const Vec<Dim> direction = direction_of(c, node, term.of);
    for (int i = 0; i < Dim; ++i)
      if (std::abs(direction[i]) > rounding)
        add_term(elongation, Dim * node + i, term.factor.value * direction[i]);
  }
}

}  // namespace

template <int Dim>
void build_springs(BuildContext<Dim>& c) {
  for (const Spring& spring : c.description.springs) {
    model::Spring out;
    out.turns = spring.kinematics == Kinematics::finite;
    out.damping = spring.damping;
    if (spring.stiffness) out.stiffness = spring.stiffness->value;
    for (const Vec2& point : spring.table.value) out.table.push_back({point[0], point[1]});
    if (spring.gap)
      out.gap = model::SpringGap{spring.gap->clearance, spring.gap->stiffness, spring.gap->tension};
    if (!spring.between.empty()) join(c, spring, out);
    model::Equation elongation;
    for (const EquationTerm& term : spring.terms) add_to_elongation(c, term, elongation);
    out.terms = std::move(elongation.terms);
    c.model().springs.push_back(std::move(out));
  }
  for (const PointMass& one : c.description.masses)
    for (const Index node : c.set(one.on).nodes) c.model().masses.push_back({node, one.mass.value});
}

template void build_springs(BuildContext<2>&);
template void build_springs(BuildContext<3>&);

}  // namespace osculate::deck
