#include "osculate/model/failure_contact.hpp"

#include <algorithm>
#include <cmath>

#include "osculate/model/body_resultants.hpp"
#include "osculate/model/penetration.hpp"

namespace osculate::model {
template <int Dim>
bool pulled_away(const BasicSystem<Dim>& system, const BasicModel<Dim>& model,
                 const std::vector<Index>& body) {
  const auto [load, push] = resultants(system, model, body, system.forces().external);
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
    if (!pairing::by_multipliers(pair)) continue;
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

template <int Dim>
InitialOverlap initial_overlap(const BasicModel<Dim>& model, const BasicState<Dim>& state) {
  InitialOverlap deepest;
  if (!state.u.isZero(0)) return deepest;
  for (std::size_t p = 0; p < model.pairs.size() && p < state.pairs.size(); ++p) {
    const pairing::PairDefinition<Dim>& pair = model.pairs[p].definition;
    if (pair.overlap != pairing::InitialOverlap::acts) continue;
    for (std::size_t i = 0; i < pair.slave.points.size() && i < state.pairs[p].points.size(); ++i) {
      const contact::PointHistory<Dim>& point = state.pairs[p].points[i];
      const double height = height_behind(model.pairs[p], i), depth = pair.offset - point.gap;
      if (!point.active || point.held || !(depth > deepest.share * height) || !(height > 0))
        continue;
      deepest = {model.pairs[p].name, pair.slave.points[i].nearest_node(), depth, depth / height};
    }
  }
  return deepest;
}

template InitialOverlap initial_overlap(const Model&, const State&);
template InitialOverlap initial_overlap(const Model3&, const State3&);
template bool pulled_away(const System&, const Model&, const std::vector<Index>&);
template bool pulled_away(const System3&, const Model3&, const std::vector<Index>&);
template std::vector<HeldPoints> held_points(const System&, const Model&, const State&);
template std::vector<HeldPoints> held_points(const System3&, const Model3&, const State3&);

}  // namespace osculate::model
