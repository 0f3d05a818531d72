#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "osculate/deck/build_displacements.hpp"
#include "osculate/deck/pretension.hpp"

namespace osculate::deck {
namespace {

/// Entries of rounding are none.
Mat<3, 3> cleaned(Mat<3, 3> axes) {
  constexpr double rounding = 1e-14;
  for (double& entry : axes.reshaped())
    if (std::abs(entry) < rounding) entry = 0;
  return axes;
}

/// Whether every axis is one of the global ones, in any order and direction.
template <int Dim>
bool is_aligned(const Mat<Dim, Dim>& axes) {
  return (axes.array() != 0).count() == Dim;
}

template <int Dim>
void read_axes(BuildContext<Dim>& c) {
  for (const LocalAxes& axes : c.description.axes) {
    require_axes(axes.along, axes.mark);
    for (const Index node : c.set(axes.on).nodes) {
      const auto n = static_cast<std::size_t>(node);
      if (c.model().body_of_node[n] >= 0) continue;
      const Mat<3, 3> in_space = cleaned(material::axes_at(axes.along, c.model().mesh.nodes[n]));
      c.axes[node] = {in_space.template topLeftCorner<Dim, Dim>(), -1};
    }
  }
}

/// Nodes of no cell that an equation or a spring names by itself, or that have a mass.
template <int Dim>
void find_control_nodes(BuildContext<Dim>& c) {
  for (const Pretension& pretension : c.description.pretension)
    c.control_nodes.insert(cut_of(pretension, c.model().mesh).node);
  const auto by_itself = [&](const Name& on) {
    if (c.rigid_index.contains(on.value)) return;
    const std::vector<Index>& nodes = c.set(on).nodes;
    if (nodes.size() == 1 && !c.takes_part(nodes[0])) c.control_nodes.insert(nodes[0]);
  };
  for (const Equation* const equation : c.description.all_equations())
    for (const EquationTerm& term : equation->terms) by_itself(term.on);
  for (const Spring& spring : c.description.springs) {
    for (const Name& on : spring.between) by_itself(on);
    for (const EquationTerm& term : spring.terms) by_itself(term.on);
  }
  for (const PointMass& one : c.description.masses)
    for (const Index node : c.set(one.on).nodes)
      if (!c.takes_part(node)) c.control_nodes.insert(node);
}

/// A node for the local displacements of every node of a set that needs one.
template <int Dim>
void add_local_nodes(BuildContext<Dim>& c, const Name& on) {
  if (c.rigid_index.contains(on.value)) return;
  for (const Index node : c.set(on).nodes) {
    const auto found = c.axes.find(node);
    if (found == c.axes.end() || found->second.local >= 0 || is_aligned<Dim>(found->second.axes))
      continue;
    model::BasicModel<Dim>& m = c.model();
    found->second.local = static_cast<Index>(m.reference.size());
    const Vec<Dim> place = m.reference[static_cast<std::size_t>(node)];
    m.reference.push_back(place);
    m.body_of_node.push_back(-1);
  }
}

}  // namespace

void require_axes(const material::Orientation& axes, const core::SourceMark& mark) {
  if (!material::gives_axes(axes))
    throw core::InputError(
        mark, "the two points do not give axes: they coincide, or lie in one direction");
}

template <int Dim>
void build_axes(BuildContext<Dim>& c) {
  find_control_nodes(c);
  if (c.description.axes.empty()) return;
  read_axes(c);
  for (const Step& step : c.description.steps)
    for (const Prescription& p : step.prescribe) add_local_nodes(c, p.on);
}

template <int Dim>
std::vector<Index> moving_nodes(const BuildContext<Dim>& c, const Name& on, Idle idle,
                                std::optional<int> direction, InBodies in_bodies) {
  std::vector<Index> nodes;
  for (const Index node : c.set(on).nodes) {
    const Index body = c.model().body_of_node[static_cast<std::size_t>(node)];
    if (body >= 0 && in_bodies == InBodies::kept) {
      nodes.push_back(node);
      continue;
    }
    if (body >= 0)
      throw core::InputError(
          on.mark, fmt::format("set '{}' has nodes of the rigid body '{}'; name "
                               "the rigid body instead",
                               on.value, c.model().rigid[static_cast<std::size_t>(body)].name));
    if (direction ? c.takes_part(node, *direction) : c.takes_part(node))
      nodes.push_back(node);
    else if (idle == Idle::refused)
      throw c.idle_node(on, node);
  }
  if (!nodes.empty()) return nodes;
  if (!c.set(on).nodes.empty()) throw c.idle_node(on, c.set(on).nodes.front());
  throw core::InputError(on.mark, fmt::format("set '{}' has no nodes", on.value));
}

template <int Dim>
std::vector<OneDisplacement> displacements(const BuildContext<Dim>& c, const Name& on,
                                           Component component, Idle idle) {
  const auto rigid = c.rigid_index.find(on.value);
  if (rigid != c.rigid_index.end()) return {{body_dof(c.model(), rigid->second, component)}};
  if (is_rotation(component))
    throw core::InputError(
        on.mark, fmt::format("{} needs a rigid body, and '{}' is a set",
                             component_names[static_cast<std::size_t>(component)], on.value));
  const int i = motion_of<Dim>(component);
  std::vector<OneDisplacement> out;
  for (const Index node : moving_nodes(c, on, idle, i)) {
    const auto found = c.axes.find(node);
    if (found == c.axes.end()) {
      out.push_back({Dim * node + i});
    } else if (found->second.local >= 0) {
      out.push_back({Dim * found->second.local + i});
    } else {
      Eigen::Index at = 0;
      found->second.axes.col(i).cwiseAbs().maxCoeff(&at);
      out.push_back(
          {Dim * node + static_cast<int>(at), found->second.axes(at, i) > 0 ? 1.0 : -1.0});
    }
  }
  return out;
}

template <int Dim>
Vec<Dim> direction_of(const BuildContext<Dim>& c, Index node, Component component) {
  const int i = motion_of<Dim>(component);
  const auto found = c.axes.find(node);
  return found == c.axes.end() ? Vec<Dim>(Vec<Dim>::Unit(i)) : Vec<Dim>(found->second.axes.col(i));
}

void add_term(model::Equation& equation, model::Dof dof, double factor) {
  for (model::Equation::Term& term : equation.terms)
    if (term.dof == dof) {
      term.factor += factor;
      return;
    }
  equation.terms.push_back({dof, factor});
}

template <int Dim>
void add_displacement(const BuildContext<Dim>& c, Index node, const Vec<Dim>& direction,
                      double factor, model::Equation& equation) {
  const auto found = c.axes.find(node);
  const bool local = found != c.axes.end() && found->second.local >= 0;
  Vec<Dim> parts = direction;
  if (local) parts = found->second.axes.transpose() * direction;
  constexpr double rounding = 1e-14;
  for (int i = 0; i < Dim; ++i)
    if (std::abs(parts[i]) > rounding)
      add_term(equation, Dim * (local ? found->second.local : node) + i, factor * parts[i]);
}

template <int Dim>
void add_component(const BuildContext<Dim>& c, const Name& on, Component component, double factor,
                   model::Equation& equation) {
  if (c.rigid_index.contains(on.value) || is_rotation(component)) {
    for (const OneDisplacement& d : displacements(c, on, component, Idle::refused))
      add_term(equation, d.dof, factor);
    return;
  }
  for (const Index node : moving_nodes(c, on, Idle::refused, motion_of<Dim>(component)))
    add_displacement(c, node, direction_of(c, node, component), factor, equation);
}

template void build_axes(BuildContext<2>&);
template void build_axes(BuildContext<3>&);
template std::vector<Index> moving_nodes(const BuildContext<2>&, const Name&, Idle,
                                         std::optional<int>, InBodies);
template std::vector<Index> moving_nodes(const BuildContext<3>&, const Name&, Idle,
                                         std::optional<int>, InBodies);
template std::vector<OneDisplacement> displacements(const BuildContext<2>&, const Name&, Component,
                                                    Idle);
template std::vector<OneDisplacement> displacements(const BuildContext<3>&, const Name&, Component,
                                                    Idle);
template Vec<2> direction_of(const BuildContext<2>&, Index, Component);
template Vec<3> direction_of(const BuildContext<3>&, Index, Component);
template void add_displacement(const BuildContext<2>&, Index, const Vec<2>&, double,
                               model::Equation&);
template void add_displacement(const BuildContext<3>&, Index, const Vec<3>&, double,
                               model::Equation&);

template void add_component(const BuildContext<2>&, const Name&, Component, double,
                            model::Equation&);
template void add_component(const BuildContext<3>&, const Name&, Component, double,
                            model::Equation&);

}  // namespace osculate::deck
