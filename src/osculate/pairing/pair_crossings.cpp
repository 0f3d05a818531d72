// Crossings of edges as contact points.
#include <algorithm>

#include "osculate/pairing/friction_branch.hpp"

namespace osculate::pairing {

using contact::PointHistory;
using contact::Status;

namespace {

/// That of a slave edge is the mean of its ends'.
RelativeStiffness stiffness_of_edge(const PairDefinition<3>& pair, std::size_t edge) {
  const auto at_end = [&](std::size_t k) {
    return relative_stiffness(pair, static_cast<std::size_t>(pair.edges.slave_nodes[edge][k]));
  };
  const RelativeStiffness a = at_end(0), b = at_end(1);
  return {0.5 * (a.normal + b.normal), 0.5 * (a.shear + b.shear)};
}

/// The pair seen from its crossings: the master is the surface of the edges' differences, with one
/// facet per crossing and then one per history, the slave point is the origin.
PairDefinition<3> pair_of_crossings(const PairDefinition<3>& pair,
                                    const std::vector<Crossing>& found,
                                    std::span<const PointHistory<3>> histories) {
  PairDefinition<3> out;
  out.normal = pair.normal;
  out.friction = pair.friction;
  out.damping = pair.damping;
  out.separation = pair.separation;
  out.tolerance = pair.tolerance;
  out.offset = pair.offset;
  out.residual = pair.residual;
  out.tangent = pair.tangent;
  out.depth = pair.depth;
  out.weight = pair.weight == Weight::node ? Weight::node : Weight::reference_area;
  const std::size_t nodes = pair.slave.points.size();
  out.slave.nodes.assign(nodes + found.size(), -1);
  sample_nodes(out.slave);
  out.reference_areas.assign(nodes + found.size(), 0.0);
  if (!pair.relative_stiffness.empty()) out.relative_stiffness.resize(nodes + found.size());
  const auto add = [&](Index master, Index slave, bool flipped) {
    out.master.facets.push_back(crossing_facet(pair.edges.master[static_cast<std::size_t>(master)],
                                               pair.edges.slave[static_cast<std::size_t>(slave)],
                                               flipped));
  };
  for (std::size_t c = 0; c < found.size(); ++c) {
    add(found[c].master, found[c].slave, found[c].flipped);
    const auto edge = static_cast<std::size_t>(found[c].slave);
    out.reference_areas[nodes + c] = pair.edges.areas[edge];
    if (!pair.relative_stiffness.empty())
      out.relative_stiffness[nodes + c] = stiffness_of_edge(pair, edge);
  }
  for (const PointHistory<3>& h : histories) add(h.facet, h.edge, h.flipped);
  return out;
}

/// The origin is no node: its rows and columns go.
void drop_origin(ContactBlock<3>& block) {
  if (!block.active()) return;
  const int size = 3 * --block.count;
  block.slave_count = 0;
  std::copy_n(block.nodes.begin() + 1, block.count, block.nodes.begin());
  block.force.head(size) = block.force.segment(3, size).eval();
  block.branch_force.head(size) = block.branch_force.segment(3, size).eval();
  block.tangent.topLeftCorner(size, size) = block.tangent.block(3, 3, size, size).eval();
  block.path_rows.topRows(size) = block.path_rows.middleRows(3, size).eval();
}

/// Histories of the crossings of a committed state.
std::span<const PointHistory<3>> crossing_histories(const PairDefinition<3>& pair,
                                                    const PairState<3>& state) {
  const std::size_t nodes = pair.slave.points.size();
  return std::span(state.points).subspan(std::min(nodes, state.points.size()));
}

/// Slave edges with a node in contact.
std::vector<bool> held_edges(const PairDefinition<3>& pair, const PairEvaluation<3>& out) {
  std::vector<bool> held;
  for (const std::array<int, 3>& nodes : pair.edges.slave_nodes)
    held.push_back(std::any_of(nodes.begin(), nodes.end(), [&](int i) {
      return i >= 0 && out.points[static_cast<std::size_t>(i)].status != Status::open;
    }));
  return held;
}

void remember_edges(const PairDefinition<3>& pair, Points<3> x, const Crossing& c,
                    PointResult<3>& result) {
  result.foot = crossing_place(pair.edges.master[static_cast<std::size_t>(c.master)], c.xi[0], x);
  result.history.facet = c.master;
  result.history.edge = c.slave;
  result.history.flipped = c.flipped;
  result.branch.edges = {c.slave, c.master};
}

BranchHint<3> hint_of(const Crossing& c, const Assumed<3>& assumed, const RelativeStiffness& own) {
  BranchHint<3> hint;
  hint.duration = assumed.duration;
  hint.own = own;
  for (const AssumedBranch<3>& branch : assumed.branch) {
    if (branch.edges != std::array<Index, 2>{c.slave, c.master}) continue;
    hint.assumed = branch;
    hint.predict = assumed.predict;
    break;
  }
  return hint;
}

}  // namespace

void evaluate_crossings(const PairDefinition<3>& pair, Points<3> x, const PairState<3>& committed,
                        bool with_tangent, PairEvaluation<3>& out, const Assumed<3>& assumed) {
  find_crossings(pair.edges, pair.master, pair.slave.boundary, x, held_edges(pair, out), out.edges);
  const std::vector<Crossing>& found = out.edges.found;
  const std::size_t nodes = pair.slave.points.size();
  out.points.resize(nodes + found.size());
  out.blocks.resize(nodes + found.size());
  const std::span<const PointHistory<3>> histories = crossing_histories(pair, committed);
  const PairDefinition<3> differences = pair_of_crossings(pair, found, histories);
  for (std::size_t c = 0; c < found.size(); ++c) {
    const auto facet = static_cast<Index>(c);
    const Placed<3> placed = place_crossing(differences.master.facets[c], facet, found[c].xi, x);
    PointHistory<3> history;
    const int known = history_of_crossing(pair.edges, histories, found, found[c]);
    if (known >= 0) {
      history = histories[static_cast<std::size_t>(known)];
      history.facet = static_cast<Index>(found.size()) + known;
    }
    const RelativeStiffness own = relative_stiffness(differences, nodes + c);
    BranchHint<3> hint = hint_of(found[c], assumed, own);
    hint.way = way_of_gap(pair, assumed, history, history.facet, placed.kinematics.gap);
    evaluate_point<3>(differences, x, history, placed, hint, with_tangent, nodes + c, out);
    drop_origin(out.blocks[nodes + c]);
    remember_edges(pair, x, found[c], out.points[nodes + c]);
  }
}

Mat<3, 2> crossing_frame(const PairDefinition<3>& pair, const PointHistory<3>& h, Points<3> x) {
  FacetSurface one;
  one.facets.push_back(crossing_facet(pair.edges.master[static_cast<std::size_t>(h.facet)],
                                      pair.edges.slave[static_cast<std::size_t>(h.edge)],
                                      h.flipped));
  return stored_frame(one, 0, h.xi, x);
}

}  // namespace osculate::pairing
