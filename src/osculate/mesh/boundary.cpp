#include "osculate/mesh/boundary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <unordered_map>

#include "osculate/mesh/support.hpp"

namespace osculate::mesh {
namespace {

std::uint64_t edge_key(Index a, Index b) {
  const auto lo = static_cast<std::uint32_t>(std::min(a, b));
  const auto hi = static_cast<std::uint32_t>(std::max(a, b));
  return (std::uint64_t{lo} << 32U) | hi;
}

void add_edges(const Mesh& mesh, CellRef ref, std::vector<Edge>& edges) {
  const Block& block = block_of(mesh, ref);
  const cell::CellInfo& info = cell::info(block.type);
  if (info.dimension != 2) return;
  const Index* nodes = block.cell(ref.cell);
  for (int e = 0; e < info.edge_count; ++e) {
    const auto& local = info.edges[static_cast<std::size_t>(e)];
    edges.push_back({edge_key(nodes[local[0]], nodes[local[1]]), ref, static_cast<std::int8_t>(e)});
  }
}

EdgeTable sorted(std::vector<Edge> edges) {
  const auto order = [](const Edge& a, const Edge& b) {
    if (a.key != b.key) return a.key < b.key;
    if (a.cell.block != b.cell.block) return a.cell.block < b.cell.block;
    if (a.cell.cell != b.cell.cell) return a.cell.cell < b.cell.cell;
    return a.local < b.local;
  };
  std::sort(edges.begin(), edges.end(), order);
  return {std::move(edges)};
}

/// Nodes of an edge in the order of a line cell, with the cell on the left if it is numbered
/// counterclockwise.
BoundaryFacet facet_of_edge(const Mesh& mesh, const Edge& edge) {
  const Block& block = block_of(mesh, edge.cell);
  const cell::CellInfo& info = cell::info(block.type);
  const auto& local = info.edges[static_cast<std::size_t>(edge.local)];
  BoundaryFacet facet;
  facet.type = info.edge_type;
  facet.parent = edge.cell;
  for (std::size_t k = 0; k < facet.nodes().size(); ++k)
    facet.node[k] = block.cell(edge.cell.cell)[local[k]];
  return facet;
}

void flip(BoundaryFacet& facet) {
  std::swap(facet.node[0], facet.node[1]);
  if (facet.type == cell::CellType::line4) std::swap(facet.node[2], facet.node[3]);
}

/// +1 for a cell numbered counterclockwise, -1 clockwise, 0 without area. The polygon goes through
/// all nodes of the edges.
int turning(const Mesh& mesh, CellRef ref) {
  const Block& block = block_of(mesh, ref);
  const cell::CellInfo& info = cell::info(block.type);
  const Index* nodes = block.cell(ref.cell);
  const Vec3& origin = point(mesh, nodes[0]);
  double twice_area = 0;
  double size = 0;
  const auto side = [&](Index from, Index to) {
    const Vec3 a = point(mesh, from) - origin;
    const Vec3 b = point(mesh, to) - origin;
    twice_area += a.x() * b.y() - a.y() * b.x();
    size += (b - a).squaredNorm();
  };
  for (int e = 0; e < info.edge_count; ++e) {
    const auto& local = info.edges[static_cast<std::size_t>(e)];
    if (info.edge_type == cell::CellType::line3) {
      side(nodes[local[0]], nodes[local[2]]);
      side(nodes[local[2]], nodes[local[1]]);
    } else {
      side(nodes[local[0]], nodes[local[1]]);
    }
  }
  if (!(std::abs(twice_area) > 1e-14 * size)) return 0;
  return twice_area > 0 ? 1 : -1;
}

std::string describe_facet(const Mesh& mesh, const BoundaryFacet& facet) {
  return fmt::format("line from {} to {}", describe_node(mesh, facet.node[0]),
                     describe_node(mesh, facet.node[1]));
}

/// The free edge, directed with the body on the right; false if its cell has no area.
bool directed_edge(const Mesh& mesh, const Edge& edge, BoundaryFacet& facet) {
  facet = facet_of_edge(mesh, edge);
  const int sense = turning(mesh, edge.cell);
  if (sense > 0) flip(facet);
  facet.flipped = sense > 0;
  return sense != 0;
}

bool same_interior(BoundaryFacet a, BoundaryFacet b) {
  std::sort(a.node.begin() + 2, a.node.end());
  std::sort(b.node.begin() + 2, b.node.end());
  return a.type == b.type && std::equal(a.node.begin() + 2, a.node.end(), b.node.begin() + 2);
}

/// Directs one line cell; an empty text means success.
std::string orient(const Mesh& mesh, const EdgeTable& table, BoundaryFacet& facet) {
  const std::span<const Edge> parents = table.find(facet.node[0], facet.node[1]);
  if (parents.empty()) return {};
  if (parents.size() > 1)
    return fmt::format("{} lies inside a body: it is an edge of {} cells",
                       describe_facet(mesh, facet), parents.size());
  BoundaryFacet edge;
  if (!directed_edge(mesh, parents[0], edge))
    return fmt::format("{}: the cell behind it has no area", describe_facet(mesh, facet));
  if (!same_interior(facet, edge))
    return fmt::format("{} has other interior nodes than the edge of the cell behind it",
                       describe_facet(mesh, facet));
  facet.parent = parents[0].cell;
  if (facet.node[0] != edge.node[0]) {
    flip(facet);
    facet.flipped = true;
  }
  return {};
}

/// One direction of travel for lines without parent that hang together: that of most of them.
void align_lines(Boundary& boundary) {
  std::vector<BoundaryFacet>& facets = boundary.facets;
  std::unordered_map<Index, std::vector<std::size_t>> at_node;
  for (std::size_t f = 0; f < facets.size(); ++f)
    for (const int end : {0, 1})
      at_node[facets[f].node[static_cast<std::size_t>(end)]].push_back(f);
  std::vector<int> sense(facets.size(), 0);
  std::size_t turned = 0;
  for (std::size_t first = 0; first < facets.size(); ++first) {
    if (facets[first].has_parent() || sense[first] != 0) continue;
    std::vector<std::size_t> line{first};
    sense[first] = 1;
    std::size_t against = 0;
    for (std::size_t i = 0; i < line.size(); ++i)
      for (const std::size_t end : {0, 1}) {
        const std::vector<std::size_t>& both = at_node[facets[line[i]].node[end]];
        const std::size_t next = both.front() == line[i] ? both.back() : both.front();
        if (both.size() != 2 || facets[next].has_parent() || sense[next] != 0) continue;
        const bool agrees = facets[next].node[1 - end] == facets[line[i]].node[end];
        sense[next] = agrees ? sense[line[i]] : -sense[line[i]];
        against += sense[next] < 0 ? 1 : 0;
        line.push_back(next);
      }
    const int minority = 2 * against > line.size() ? 1 : -1;
    for (const std::size_t member : line)
      if (sense[member] == minority) {
        flip(facets[member]);
        facets[member].flipped = true;
        ++turned;
      }
  }
  if (turned > 0)
    add_message(
        boundary.warnings,
        fmt::format("{} of {} lines were turned round so that neighbours face the same side",
                    turned, facets.size()));
}

BoundaryFacet line_facet(const Mesh& mesh, CellRef ref) {
  const Block& block = block_of(mesh, ref);
  BoundaryFacet facet;
  facet.type = block.type;
  facet.line = ref;
  std::copy_n(block.cell(ref.cell), cell::info(block.type).nodes, facet.node.begin());
  return facet;
}

/// Free edges accepted by `wanted`, in the order of the cells.
template <class Wanted>
Boundary free_edges(const Mesh& mesh, const EdgeTable& table, const Wanted& wanted) {
  std::vector<Edge> chosen;
  const std::vector<Edge>& edges = table.edges;
  for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
    for (end = i + 1; end < edges.size() && edges[end].key == edges[i].key;) ++end;
    if (end == i + 1 && wanted(edges[i])) chosen.push_back(edges[i]);
  }
  std::sort(chosen.begin(), chosen.end(), [](const Edge& a, const Edge& b) {
    if (a.cell.block != b.cell.block) return a.cell.block < b.cell.block;
    if (a.cell.cell != b.cell.cell) return a.cell.cell < b.cell.cell;
    return a.local < b.local;
  });
  Boundary boundary;
  for (const Edge& edge : chosen) {
    BoundaryFacet facet;
    if (directed_edge(mesh, edge, facet))
      boundary.facets.push_back(facet);
    else
      add_message(boundary.errors,
                  fmt::format("{}: the cell behind it has no area", describe_facet(mesh, facet)));
  }
  connect(mesh, boundary);
  return boundary;
}

}  // namespace

std::string describe_node(const Mesh& mesh, Index node) {
  const Vec3& x = point(mesh, node);
  const std::int64_t number = node_number(mesh, node);
  return has_volumes(mesh) || x.z() != 0
             ? fmt::format("node {} ({:.6g}, {:.6g}, {:.6g})", number, x.x(), x.y(), x.z())
             : fmt::format("node {} ({:.6g}, {:.6g})", number, x.x(), x.y());
}

std::span<const Edge> EdgeTable::find(Index a, Index b) const {
  const auto less = [](const Edge& edge, std::uint64_t key) { return edge.key < key; };
  const std::uint64_t key = edge_key(a, b);
  const auto first = std::lower_bound(edges.begin(), edges.end(), key, less);
  auto last = first;
  while (last != edges.end() && last->key == key) ++last;
  return {first, last};
}

EdgeTable edge_table(const Mesh& mesh) {
  std::vector<Edge> edges;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b)
    for (Index c = 0; c < mesh.blocks[b].size(); ++c)
      add_edges(mesh, {static_cast<Index>(b), c}, edges);
  return sorted(std::move(edges));
}

EdgeTable edge_table(const Mesh& mesh, std::span<const CellRef> cells) {
  std::vector<Edge> edges;
  for (const CellRef ref : cells) add_edges(mesh, ref, edges);
  return sorted(std::move(edges));
}

Boundary orient_boundary(const Mesh& mesh, const EdgeTable& table, const Set& set) {
  assert(set.dimension == 1);
  Boundary boundary;
  std::unordered_map<std::uint64_t, bool> used;
  for (const CellRef ref : set.cells) {
    BoundaryFacet facet = line_facet(mesh, ref);
    std::string problem = orient(mesh, table, facet);
    if (!used.emplace(edge_key(facet.node[0], facet.node[1]), true).second)
      problem = fmt::format("{} is there twice", describe_facet(mesh, facet));
    if (problem.empty())
      boundary.facets.push_back(facet);
    else
      add_message(boundary.errors, fmt::format("set '{}': {}", set.name, problem));
  }
  align_lines(boundary);
  connect(mesh, boundary);
  return boundary;
}

Boundary orient_boundary(const Mesh& mesh, const Set& set) {
  return orient_boundary(mesh, edge_table(mesh), set);
}

Boundary boundary_facets(const Mesh& mesh, const EdgeTable& table, const Set& set) {
  std::vector<std::vector<bool>> inside(mesh.blocks.size());
  for (std::size_t b = 0; b < inside.size(); ++b)
    inside[b].resize(static_cast<std::size_t>(mesh.blocks[b].size()));
  for (const CellRef ref : set.cells)
    inside[static_cast<std::size_t>(ref.block)][static_cast<std::size_t>(ref.cell)] = true;
  return free_edges(mesh, table, [&](const Edge& edge) {
    return inside[static_cast<std::size_t>(edge.cell.block)]
                 [static_cast<std::size_t>(edge.cell.cell)];
  });
}

Boundary boundary_facets(const Mesh& mesh, const Set& set) {
  return boundary_facets(mesh, edge_table(mesh), set);
}

Boundary facets_of_nodes(const Mesh& mesh, const EdgeTable& table, std::span<const Index> nodes) {
  std::vector<bool> wanted(mesh.nodes.size());
  for (const Index node : nodes) wanted[static_cast<std::size_t>(node)] = true;
  Boundary boundary = free_edges(mesh, table, [&](const Edge& edge) {
    const BoundaryFacet facet = facet_of_edge(mesh, edge);
    return std::ranges::all_of(facet.nodes(),
                               [&](Index node) { return wanted[static_cast<std::size_t>(node)]; });
  });
  for (const BoundaryFacet& facet : boundary.facets)
    for (const Index node : facet.nodes()) wanted[static_cast<std::size_t>(node)] = false;
  for (const Index node : nodes)
    if (wanted[static_cast<std::size_t>(node)]) {
      wanted[static_cast<std::size_t>(node)] = false;
      add_message(boundary.warnings, describe_node(mesh, node) +
                                         " belongs to no free edge whose nodes are all in the set");
    }
  return boundary;
}

Boundary surface_of(const Mesh& mesh, const EdgeTable& table, const Set& set) {
  if (set.dimension == 1) return orient_boundary(mesh, table, set);
  if (set.dimension == 2) return boundary_facets(mesh, table, set);
  return facets_of_nodes(mesh, table, set.nodes);
}

void connect(const Mesh& mesh, Boundary& boundary) {
  struct Star {
    Index starting = -1, ending = -1;  // facets
    Index starts = 0, ends = 0;        // their numbers
  };
  std::unordered_map<Index, Star> stars;
  std::vector<Index> order;
  const auto star_at = [&](Index node) -> Star& {
    const auto [place, is_new] = stars.try_emplace(node);
    if (is_new) order.push_back(node);
    return place->second;
  };
  for (std::size_t f = 0; f < boundary.facets.size(); ++f) {
    BoundaryFacet& facet = boundary.facets[f];
    facet.prev = facet.next = -1;
    Star& start = star_at(facet.node[0]);
    start.starting = static_cast<Index>(f);
    ++start.starts;
    Star& end = star_at(facet.node[1]);
    end.ending = static_cast<Index>(f);
    ++end.ends;
  }
  boundary.branching.clear();
  for (const Index node : order) {
    const Star& star = stars.at(node);
    if (star.starts == 1 && star.ends == 1) {
      boundary.facets[static_cast<std::size_t>(star.ending)].next = star.starting;
      boundary.facets[static_cast<std::size_t>(star.starting)].prev = star.ending;
    } else if (star.starts + star.ends > 1) {
      boundary.branching.push_back(node);
      add_message(boundary.warnings,
                  star.starts + star.ends == 2
                      ? "the direction of travel changes at " + describe_node(mesh, node)
                      : fmt::format("{} lines meet at {}", star.starts + star.ends,
                                    describe_node(mesh, node)));
    }
  }
}

}  // namespace osculate::mesh
