#include "osculate/mesh/partition.hpp"

#include <metis.h>

#include <memory>
#include <new>

namespace osculate::mesh {
namespace {

struct MetisFree {
  void operator()(idx_t* of) const { METIS_Free(of); }
};
using MetisArray = std::unique_ptr<idx_t, MetisFree>;

void check(int done) {
  if (done == METIS_ERROR_MEMORY) throw std::bad_alloc();
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

/// Parts of the numbered nodes. With a second weight for the joints that begin at them, if there
/// are any.
std::vector<idx_t> parts_of(Numbered& graph, const std::vector<std::vector<Index>>& joints,
                            int parts) {
  std::vector<idx_t> part(static_cast<std::size_t>(graph.used), 0);
  idx_t kinds = joints.empty() ? 1 : 2, into = parts, cut = 0, from_zero = 0;
  std::vector<idx_t> weights(part.size() * static_cast<std::size_t>(kinds), 0);
  for (std::size_t n = 0; n < part.size(); ++n) weights[n * static_cast<std::size_t>(kinds)] = 1;
  for (const std::vector<Index>& joint : joints)
    if (const idx_t n = graph.number[static_cast<std::size_t>(joint.front())]; n >= 0)
      ++weights[2 * static_cast<std::size_t>(n) + 1];
  auto count = static_cast<idx_t>(graph.start.size() - 1);
  idx_t *first = nullptr, *next = nullptr;
  check(METIS_MeshToNodal(&count, &graph.used, graph.start.data(), graph.nodes.data(), &from_zero,
                          &first, &next));
  const MetisArray starts(first), neighbours(next);
  const int done =
      METIS_PartGraphKway(&graph.used, &kinds, first, next, weights.data(), nullptr, nullptr, &into,
                          nullptr, nullptr, nullptr, &cut, part.data());
  check(done);
  if (done != METIS_OK) part.assign(part.size(), 0);
  return part;
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
  if (parts > 1 && graph.used > parts) part = parts_of(graph, joints, parts);
  std::vector<int> out(static_cast<std::size_t>(nodes));
  int next = 0;
  for (std::size_t node = 0; node < out.size(); ++node) {
    const idx_t as = graph.number[node];
    out[node] = as >= 0 ? static_cast<int>(part[static_cast<std::size_t>(as)]) : next++ % parts;
  }
  return out;
}

}  // namespace osculate::mesh
