#include "osculate/model/failure_contact.hpp"

#include <algorithm>
#include <cmath>

namespace osculate::model {
namespace {

/// Where the contacts of the last evaluation would push: by node the sum of the master's normals at
/// the slave's points that are closed or touch, and minus that on the master's nodes.
template <int Dim>
std::vector<Vec<Dim>> contact_pushes(const BasicSystem<Dim>& system, const BasicModel<Dim>& model) {
  std::vector<Vec<Dim>> pushes(model.reference.size(), Vec<Dim>::Zero());
  const auto add = [&](Index node, const Vec<Dim>& push) {
    pushes[static_cast<std::size_t>(node)] += push;
  };
  for (std::size_t p = 0; p < model.pairs.size(); ++p) {
    const pairing::PairDefinition<Dim>& pair = model.pairs[p].definition;
    const pairing::PairEvaluation<Dim>& contact = system.contact()[p];
    const double near = 1e-9 * model.pairs[p].height;
    const std::size_t count = std::min(contact.points.size(), pair.slave.points.size());
    for (std::size_t i = 0; i < count; ++i) {
      const pairing::PointResult<Dim>& point = contact.points[i];
      if (point.status == contact::Status::open && !(point.gap <= near)) continue;
      const pairing::SlavePoint<Dim>& slave = pair.slave.points[i];
      for (std::size_t k = 0; k < static_cast<std::size_t>(slave.count); ++k)
        add(slave.nodes[k], slave.shape[k] * point.normal);
      if (point.history.facet < 0) continue;
      const auto& facet = pair.master.facets[static_cast<std::size_t>(point.history.facet)];
      for (std::size_t k = 0; k < static_cast<std::size_t>(facet.count); ++k)
        add(facet.nodes[k], -point.normal / facet.count);
    }
  }
  return pushes;
}

}  // namespace

template <int Dim>
bool pulled_away(const BasicSystem<Dim>& system, const BasicModel<Dim>& model,
                 const std::vector<Index>& body) {
  const std::vector<Vec<Dim>> pushes = contact_pushes(system, model);
  Vec<Dim> load = Vec<Dim>::Zero(), push = load;
  for (const Index node : body) {
    push += pushes[static_cast<std::size_t>(node)];
    for (int i = 0; i < Dim; ++i)
      if (const Index u = system.dofs().unknown_of(system.dofs().node_dof(node, i)); u >= 0)
        load[i] += system.forces().external[u];
  }
  constexpr double along = 0.1;  // what is across is carried by friction, or slides
  return load.dot(push) > along * load.norm() * push.norm();
}

template <int Dim>
std::vector<HeldPoints> held_points(const BasicSystem<Dim>& system, const BasicModel<Dim>& model,
                                    const BasicState<Dim>& state) {
  std::vector<HeldPoints> found;
  const std::vector<Vec<Dim>> x = system.positions(state);
  std::vector<Expansion> unknowns;
  const auto is_free = [&](const Expansion& e) {
    return std::abs(e.factor) > 1e-9 && !system.prescribed(e.unknown);
  };
  for (std::size_t p = 0; p < model.pairs.size(); ++p) {
    const pairing::PairDefinition<Dim>& pair = model.pairs[p].definition;
    if (pair.enforcement != contact::Enforcement::lagrange_multiplier) continue;
    HeldPoints held{model.pairs[p].name, 0, -1};
    const auto& blocks = system.contact()[p].blocks;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      if (!blocks[i].constraint.on || blocks[i].constraint.normal_row.empty()) continue;
      unknowns.clear();
      for (const auto& g : blocks[i].constraint.normal_row)
        for (int d = 0; d < Dim; ++d)
          system.dofs().expand(system.dofs().node_dof(g.node, d), g.value[d], x, state.rigid,
                               unknowns);
      if (std::ranges::any_of(unknowns, is_free)) continue;
      if (held.count++ == 0 && i < pair.slave.points.size())
        held.node = pair.slave.points[i].nearest_node();
    }
    if (held.count > 0) found.push_back(held);
  }
  return found;
}

template bool pulled_away(const System&, const Model&, const std::vector<Index>&);
template bool pulled_away(const System3&, const Model3&, const std::vector<Index>&);
template std::vector<HeldPoints> held_points(const System&, const Model&, const State&);
template std::vector<HeldPoints> held_points(const System3&, const Model3&, const State3&);

}  // namespace osculate::model
