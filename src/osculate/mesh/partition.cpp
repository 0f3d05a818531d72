#include "osculate/mesh/partition.hpp"

#include <metis.h>

#include <algorithm>
#include <memory>
#include <new>
#include <stdexcept>

namespace osculate::mesh {
namespace {

struct MetisFree {
  void operator()(idx_t* of) const { METIS_Free(of); }
};
using MetisArray = std::unique_ptr<idx_t, MetisFree>;

void check(int done) {
  if (done == METIS_ERROR_MEMORY) throw std::bad_alloc();
  if (done != METIS_OK) throw std::logic_error("METIS does not take the nodes of the cells");
}

/// Cells of nodes that are numbered as they come.
struct Numbered {
  std::vector<idx_t> number;  ///< by node; -1: in no cell
  std::vector<idx_t> start{0}, nodes{};
  idx_t used = 0;

  void add(const std::vector<Index>& cell) {
    for (const Index node : cell) {
      idx_t& as = number[static_cast<std::size_t>(node)];
      if (as < 0) as = used++;
      nodes.push_back(as);
    }
    start.push_back(static_cast<idx_t>(nodes.size()));
  }
};

/// Which nodes are neighbours of which, and what it costs to part them: those of a joint 16 times
/// as much as others, with which parts see 1.04 to 1.2 times their even share of the joints between
/// two blocks, where they see 2 to 8 times as many by the same costs (docs/decisions/112).
struct Neighbours {
  MetisArray start, nodes;
  std::vector<idx_t> cost;
};

Neighbours neighbours_of(Numbered& graph, std::size_t cells) {
  constexpr idx_t of_joint = 16;
  auto count = static_cast<idx_t>(graph.start.size() - 1);
  idx_t *start = nullptr, *nodes = nullptr, from_zero = 0;
  check(METIS_MeshToNodal(&count, &graph.used, graph.start.data(), graph.nodes.data(), &from_zero,
                          &start, &nodes));
  Neighbours out{MetisArray(start), MetisArray(nodes), {}};
  out.cost.assign(static_cast<std::size_t>(start[graph.used]), 1);
  std::vector<std::vector<std::size_t>> joints_of(static_cast<std::size_t>(graph.used));
  for (std::size_t joint = cells; joint + 1 < graph.start.size(); ++joint)
    for (idx_t k = graph.start[joint]; k < graph.start[joint + 1]; ++k)
      joints_of[static_cast<std::size_t>(graph.nodes[static_cast<std::size_t>(k)])].push_back(
          joint);
  std::vector<idx_t> seen_by(joints_of.size(), -1);
  for (idx_t a = 0; a < graph.used; ++a) {
    const std::vector<std::size_t>& joints = joints_of[static_cast<std::size_t>(a)];
    for (const std::size_t joint : joints)
      for (idx_t k = graph.start[joint]; k < graph.start[joint + 1]; ++k)
        seen_by[static_cast<std::size_t>(graph.nodes[static_cast<std::size_t>(k)])] = a;
    for (idx_t e = start[a]; !joints.empty() && e < start[a + 1]; ++e)
      if (seen_by[static_cast<std::size_t>(nodes[e])] == a)
        out.cost[static_cast<std::size_t>(e)] = of_joint;
  }
  return out;
}

/// Parts of the numbered nodes; `weights`: one or two of each.
std::vector<idx_t> parts_by(Numbered& graph, Neighbours& by, std::vector<idx_t>& weights,
                            int parts) {
  std::vector<idx_t> part(static_cast<std::size_t>(graph.used), 0);
  idx_t kinds = static_cast<idx_t>(weights.size() / part.size()), into = parts, cut = 0;
  check(METIS_PartGraphRecursive(&graph.used, &kinds, by.start.get(), by.nodes.get(),
                                 weights.data(), nullptr, by.cost.data(), &into, nullptr, nullptr,
                                 nullptr, &cut, part.data()));
  return part;
}

/// Whether no part has half as many nodes again as it should, and none has none.
bool is_even(const std::vector<idx_t>& part, int parts) {
  std::vector<double> size(static_cast<std::size_t>(parts), 0);
  for (const idx_t p : part) ++size[static_cast<std::size_t>(p)];
  return std::ranges::min(size) > 0 &&
         std::ranges::max(size) * parts < 1.5 * static_cast<double>(part.size());
}

/// With a second weight for joints: at all of their nodes, so that both sides of them are shared. A
/// few nodes cannot be shared evenly, nor can a large facet that many points are on: METIS would
/// give up the first weight for them.
std::vector<idx_t> parts_of(Numbered& graph, std::size_t cells, int parts) {
  constexpr idx_t at_most = 8;
  Neighbours by = neighbours_of(graph, cells);
  const auto used = static_cast<std::size_t>(graph.used);
  std::vector<idx_t> both(2 * used, 0), alone(used, 1);
  int joined = 0;
  for (auto n = graph.nodes.begin() + graph.start[cells]; n != graph.nodes.end(); ++n) {
    idx_t& weight = both[2 * static_cast<std::size_t>(*n) + 1];
    joined += weight == 0 ? 1 : 0;
    weight = std::min(at_most, weight + 1);
  }
  for (std::size_t n = 0; n < used; ++n) both[2 * n] = 1;
  if (joined >= 20 * parts) {
    std::vector<idx_t> part = parts_by(graph, by, both, parts);
    if (is_even(part, parts)) return part;
  }
  return parts_by(graph, by, alone, parts);
}

}  // namespace

std::vector<int> node_parts(const std::vector<std::vector<Index>>& cells,
                            const std::vector<std::vector<Index>>& joints, Index nodes, int parts) {
  Numbered graph{std::vector<idx_t>(static_cast<std::size_t>(nodes), -1)};
  for (const std::vector<Index>& cell : cells) graph.add(cell);
  std::vector<Index> known;
  for (const std::vector<Index>& joint : joints) {
    known.clear();
    for (const Index node : joint)
      if (graph.number[static_cast<std::size_t>(node)] >= 0) known.push_back(node);
    graph.add(known);
  }
  std::vector<idx_t> part(static_cast<std::size_t>(graph.used), 0);
  if (parts > 1 && graph.used > parts) part = parts_of(graph, cells.size(), parts);
  std::vector<int> out(static_cast<std::size_t>(nodes));
  int next = 0;
  for (std::size_t node = 0; node < out.size(); ++node) {
    const idx_t as = graph.number[node];
    out[node] = as >= 0 ? static_cast<int>(part[static_cast<std::size_t>(as)]) : next++ % parts;
  }
  return out;
}

}  // namespace osculate::mesh
