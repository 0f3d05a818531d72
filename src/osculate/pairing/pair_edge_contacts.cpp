// edge-edge contacts as contact points.
#include <algorithm>

#include "osculate/pairing/point_sample.hpp"
#include "osculate/pairing/response.hpp"

namespace osculate::pairing {

using contact::PointHistory;
using contact::Status;

namespace {

/// That of a slave edge is the mean of its ends'.
RelativeStiffness stiffness_of_edge(const PairDefinition<3>& pair, std::size_t edge) {
  const auto at_end = [&](std::size_t k) {
    const int node = edges_of(pair)->slave_nodes[edge][k];
    return relative_stiffness(pair, static_cast<std::size_t>(node));
  };
  const RelativeStiffness a = at_end(0), b = at_end(1);
  return {0.5 * (a.normal + b.normal), 0.5 * (a.shear + b.shear)};
}

/// The surface of the edges' differences, on which the origin is the slave point: one facet per
/// edge-edge contact and then one per history.
FacetSurface differences_of(const EdgeContact& edges, const std::vector<EdgeEdgePoint>& found,
                            std::span<const PointHistory<3>> histories) {
  FacetSurface out;
  const auto add = [&](Index master, Index slave, bool flipped) {
    out.facets.push_back(edge_contact_facet(edges.master[static_cast<std::size_t>(master)],
                                            edges.slave[static_cast<std::size_t>(slave)], flipped));
  };
  for (const EdgeEdgePoint& c : found) add(c.master, c.slave, c.flipped);
  for (const PointHistory<3>& h : histories) add(h.facet, h.edge, h.flipped);
  return out;
}

/// Histories of the edge-edge contacts of a committed state.
std::span<const PointHistory<3>> edge_contact_histories(const PairDefinition<3>& pair,
                                                        const PairState<3>& state) {
  const std::size_t nodes = pair.slave.points.size();
  return std::span(state.points).subspan(std::min(nodes, state.points.size()));
}

/// Slave edges with a node in contact.
std::vector<bool> held_edges(const PairDefinition<3>& pair, const PairEvaluation<3>& out) {
  std::vector<bool> held;
  for (const std::array<int, 3>& nodes : edges_of(pair)->slave_nodes)
    held.push_back(std::any_of(nodes.begin(), nodes.end(), [&](int i) {
      return i >= 0 && out.points[static_cast<std::size_t>(i)].status != Status::open;
    }));
  return held;
}

void remember_edges(const EdgeContact& edges, Points<3> x, const EdgeEdgePoint& c,
                    PointResult<3>& result) {
  result.foot = edge_position(edges.master[static_cast<std::size_t>(c.master)], c.xi[0], x);
  result.history.facet = c.master;
  result.history.edge = c.slave;
  result.history.flipped = c.flipped;
  result.branch.edges = {c.slave, c.master};
}

PointContext<3> context_of(const EdgeEdgePoint& c, const ActiveSet<3>& active_set,
                           const RelativeStiffness& own) {
  PointContext<3> context;
  context.duration = active_set.duration;
  context.own = own;
  for (const ActiveBranch<3>& branch : active_set.branch) {
    if (branch.edges != std::array<Index, 2>{c.slave, c.master}) continue;
    context.active = branch;
    context.predict = active_set.predict;
    break;
  }
  return context;
}

}  // namespace

void evaluate_edge_contacts(const PairDefinition<3>& pair, Points<3> x,
                            const PairState<3>& committed, bool with_tangent,
                            PairEvaluation<3>& out, const ActiveSet<3>& active_set) {
  const EdgeContact& edges = *edges_of(pair);
  find_crossings(edges, pair.master, pair.slave.boundary, x, held_edges(pair, out), out.edges);
  const std::vector<EdgeEdgePoint>& found = out.edges.found;
  const std::size_t nodes = pair.slave.points.size();
  out.points.resize(nodes + found.size());
  out.blocks.resize(nodes + found.size());
  const std::span<const PointHistory<3>> histories = edge_contact_histories(pair, committed);
  const FacetSurface differences = differences_of(edges, found, histories);
  for (std::size_t c = 0; c < found.size(); ++c) {
    const auto facet = static_cast<Index>(c);
    const auto edge = static_cast<std::size_t>(found[c].slave);
    const ProjectedPoint<3> projected =
        project_edge_edge(differences.facets[c], facet, found[c].xi, x);
    PointHistory<3> history;
    const int known = history_of_crossing(edges, histories, found, found[c]);
    if (known >= 0) {
      history = histories[static_cast<std::size_t>(known)];
      history.facet = static_cast<Index>(found.size()) + known;
    }
    PointContext<3> context = context_of(found[c], active_set, stiffness_of_edge(pair, edge));
    context.way = way_of_gap(pair, active_set, history, history.facet, projected.kinematics.gap);
    const double weight = pair.weight == Weight::node ? 1.0 : edges.areas[edge];
    evaluate_point<3>(pair, x, history, {differences, projected, nullptr, weight}, context,
                      with_tangent, nodes + c, out);
    remember_edges(edges, x, found[c], out.points[nodes + c]);
  }
}

Mat<3, 2> edge_contact_frame(const PairDefinition<3>& pair, const PointHistory<3>& h, Points<3> x) {
  const EdgeContact& edges = *edges_of(pair);
  FacetSurface one;
  one.facets.push_back(edge_contact_facet(edges.master[static_cast<std::size_t>(h.facet)],
                                          edges.slave[static_cast<std::size_t>(h.edge)],
                                          h.flipped));
  return stored_frame(one, 0, h.xi, x);
}

}  // namespace osculate::pairing
