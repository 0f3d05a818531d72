#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "osculate/deck/build_displacements.hpp"
#include "osculate/deck/parse_parts.hpp"
#include "osculate/model/bulk.hpp"

namespace osculate::deck {
namespace {

using model::NodeConstraint;

/// The node of a set farthest by a measure, and that measure.
template <class Measure>
Index farthest(const std::vector<Index>& nodes, const Measure& measure) {
  return *std::max_element(nodes.begin(), nodes.end(),
                           [&](Index a, Index b) { return measure(a) < measure(b); });
}

template <int Dim>
core::InputError on_one_place(const NodeCondition& condition) {
  return {condition.on.mark,
          fmt::format("the nodes of '{}' lie at one place or on one line", condition.on.value)};
}

/// The nodes that define a plane or line, far from each other, and one after the other with them.
template <int Dim>
void add_all(BuildContext<Dim>& c, const NodeCondition& condition, NodeConstraint::Kind kind) {
  const std::vector<Index> nodes = moving_nodes(c, condition.on, Idle::refused);
  const auto at = [&](Index n) { return c.model().mesh.nodes[static_cast<std::size_t>(n)]; };
  const bool plane = kind == NodeConstraint::Kind::plane;
  std::vector<Index> frame{nodes.front()};
  const auto apart = [&](Index n) { return (at(n) - at(frame[0])).norm(); };
  frame.push_back(farthest(nodes, apart));
  const auto across = [&](Index n) {
    return (at(n) - at(frame[0])).cross(at(frame[1]) - at(frame[0])).norm();
  };
  if (plane) frame.push_back(farthest(nodes, across));
  constexpr double flat = 1e-9;
  const double length = apart(frame[1]);
  if (!(length > 0) || (plane && !(across(frame[2]) > flat * length * length)))
    throw on_one_place<Dim>(condition);
  for (const Index n : nodes) {
    if (std::find(frame.begin(), frame.end(), n) != frame.end()) continue;
    NodeConstraint one;
    one.kind = kind;
    one.name = condition.on.value;
    one.nodes = frame;
    one.nodes.push_back(n);
    c.model().node_constraints.push_back(std::move(one));
  }
}

template <int Dim>
void add_distance(BuildContext<Dim>& c, const NodeCondition& condition) {
  const std::vector<Index> nodes = moving_nodes(c, condition.on, Idle::refused);
  if (nodes.size() != 2)
    throw core::InputError(condition.on.mark, fmt::format("'{}' has {} nodes; expected two",
                                                          condition.on.value, nodes.size()));
  const auto& m = c.model();
  if (!((m.reference[static_cast<std::size_t>(nodes[0])] -
         m.reference[static_cast<std::size_t>(nodes[1])])
            .norm() > 0))
    throw on_one_place<Dim>(condition);
  c.model().node_constraints.push_back(
      {NodeConstraint::Kind::distance, condition.on.value, nodes, {}, -1, 1});
}

/// Shares of the nodes of a set by the area of its facets, or equal ones.
template <int Dim>
std::vector<double> shares(const BuildContext<Dim>& c, const Name& on,
                           const std::vector<Index>& nodes) {
  std::vector<double> weights(nodes.size(), 1.0);
  const mesh::Set& set = c.set(on);
  if (set.dimension == Dim - 1 && !set.cells.empty()) {
    std::fill(weights.begin(), weights.end(), 0.0);
    for (const Side<Dim>& side : oriented_facets(c, on)) {
      if (!side.has_parent()) continue;
      const Index section = c.section_of_cell.at({side.parent.block, side.parent.cell});
      const std::vector<double> parts = model::side_weights(
          c.model(), c.model().sections[static_cast<std::size_t>(section)].section, side.type,
          std::span<const Index>(side.nodes()));
      for (std::size_t k = 0; k < parts.size(); ++k) {
        const auto found = std::lower_bound(nodes.begin(), nodes.end(), side.nodes()[k]);
        if (found != nodes.end() && *found == side.nodes()[k])
          weights[static_cast<std::size_t>(found - nodes.begin())] += parts[k];
      }
    }
  }
  double sum = 0;
  for (const double w : weights) sum += w;
  for (double& w : weights) w /= sum;
  return weights;
}

template <int Dim>
void add_coupling(BuildContext<Dim>& c, const Coupling& coupling) {
  NodeConstraint one;
  one.kind = NodeConstraint::Kind::mean_motion;
  one.name = coupling.on.value;
  one.nodes = moving_nodes(c, coupling.on, Idle::refused);
  one.weights = shares(c, coupling.on, one.nodes);
  one.body = c.rigid_index.at(coupling.rigid.value);
  Vec3 low = Vec3::Constant(1e300), high = -low;
  for (const Index n : one.nodes) {
    low = low.cwiseMin(c.model().mesh.nodes[static_cast<std::size_t>(n)]);
    high = high.cwiseMax(c.model().mesh.nodes[static_cast<std::size_t>(n)]);
  }
  if (!((high - low).norm() > 0))
    throw core::InputError(coupling.on.mark,
                           fmt::format("the nodes of '{}' lie at one place", coupling.on.value));
  c.model().node_constraints.push_back(std::move(one));
}

/// Young's modulus times the size of a cell: what multipliers are measured by.
template <int Dim>
double node_stiffness(const BuildContext<Dim>& c) {
  const model::BasicModel<Dim>& m = c.model();
  double largest = 0;
  for (const model::BasicBulkSection<Dim>& section : m.sections) {
    if (section.cells.empty()) continue;
    const mesh::CellRef& ref = section.cells.front();
    const std::vector<double> weights = model::cell_weights(m, section, ref);
    double volume = 0;
    for (const double w : weights) volume += w;
    const double size = std::cbrt(std::abs(volume));
    largest = std::max(largest, material::unloaded(section.section.law).young * size);
  }
  return largest > 0 ? largest : 1.0;
}

}  // namespace

template <int Dim>
void build_node_constraints(BuildContext<Dim>& c) {
  const Description& d = c.description;
  for (const NodeCondition& one : d.coplanar) {
    if (Dim == 2) throw only_in_space(one.mark, "coplanar");
    add_all(c, one, NodeConstraint::Kind::plane);
  }
  for (const NodeCondition& one : d.collinear) add_all(c, one, NodeConstraint::Kind::line);
  for (const NodeCondition& one : d.fixed_distance) add_distance(c, one);
  for (const Coupling& one : d.coupling)
    if (one.is_mean()) add_coupling(c, one);
  if (c.model().node_constraints.empty()) return;
  const double stiffness = node_stiffness(c);
  for (NodeConstraint& one : c.model().node_constraints) one.stiffness = stiffness;
}

template void build_node_constraints(BuildContext<2>&);
template void build_node_constraints(BuildContext<3>&);

}  // namespace osculate::deck
