#include "osculate/result/initial_gaps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "osculate/mesh/boundary.hpp"

namespace osculate::result {

template <int Dim>
GapFacts gap_facts(const pairing::PairState<Dim>& state, double rounding) {
  GapFacts facts;
  for (std::size_t i = 0; i < state.points.size(); ++i) {
    const contact::PointHistory<Dim>& point = state.points[i];
    if (point.edge >= 0) {
      ++facts.edge_contacts;
      continue;
    }
    if (point.facet < 0) continue;
    const double gap = std::abs(point.gap) > rounding ? point.gap : 0.0;
    if (!facts.found || gap < facts.smallest) facts.deepest = i;
    facts.smallest = facts.found ? std::min(facts.smallest, gap) : gap;
    facts.largest = facts.found ? std::max(facts.largest, gap) : gap;
    ++facts.found;
    if (point.feature == projection::Feature::face) ++facts.over_faces;
    if (gap == 0) ++facts.touching;
    if (gap < 0) ++facts.overlapping;
  }
  return facts;
}

template <int Dim>
std::string deep_overlap(const model::BasicModel<Dim>& model,
                         const model::BasicContactPair<Dim>& pair,
                         const pairing::PairState<Dim>& state) {
  constexpr double deep = 0.5;  // of a cell
  const pairing::PairDefinition<Dim>& definition = pair.definition;
  if (definition.overlap != pairing::InitialOverlap::acts || pairing::held_from_start(definition) ||
      !(pair.height > 0))
    return {};
  const GapFacts facts = gap_facts<Dim>(state);
  const double share = -(facts.smallest - definition.offset) / pair.height;
  if (facts.overlapping == 0 || !(share > deep)) return {};
  const Index node = definition.slave.points[facts.deepest].nearest_node();
  const bool all = facts.overlapping == facts.found;
  return fmt::format(
      "contact '{}': the slave begins {:.4g} deep in the master, {:.2g} times the height of the "
      "cells, at {}, and is pushed out in the first increment: {}if the overlap is meant, let it "
      "in over the first step (initial: ramp) or measure gaps from it (keep); else move the nodes "
      "onto the master (adjust), or the body",
      pair.name, share * pair.height, share, mesh::describe_node(model.mesh, node),
      all ? "all of its points are behind the master; if that should face them, turn it round "
            "(`flip`, `inside`, the order of points); "
          : "");
}

template GapFacts gap_facts<2>(const pairing::PairState<2>&, double);
template GapFacts gap_facts<3>(const pairing::PairState<3>&, double);
template std::string deep_overlap(const model::Model&, const model::ContactPair&,
                                  const pairing::PairState<2>&);
template std::string deep_overlap(const model::Model3&, const model::ContactPair3&,
                                  const pairing::PairState<3>&);

}  // namespace osculate::result
