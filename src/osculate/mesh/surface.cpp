#include "osculate/mesh/surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <set>

#include "osculate/mesh/support.hpp"

namespace osculate::mesh {
namespace {

std::string describe_facet(const Mesh& mesh, const SurfaceFacet& facet) {
  std::string nodes;
  for (const Index node : facet.nodes())
    nodes += fmt::format("{}{}", nodes.empty() ? "" : " ", node_number(mesh, node));
  return fmt::format("{} on nodes {} at {}", cell::info(facet.type).name, nodes,
                     describe_node(mesh, facet.node[0]));
}

/// A face of a cell, outward; false if the cell has no volume.
bool outward_face(const Mesh& mesh, const Face& face, SurfaceFacet& facet) {
  const cell::CellFace& local =
      info_of(mesh, face.cell).faces[static_cast<std::size_t>(face.local)];
  facet.type = local.type;
  facet.parent = face.cell;
  const auto n = static_cast<std::size_t>(cell::info(local.type).nodes);
  for (std::size_t k = 0; k < n; ++k) facet.node[k] = nodes_of(mesh, face.cell)[local.nodes[k]];
  const int sense = handedness(mesh, face.cell);
  if (sense < 0) reverse_area(facet.type, {facet.node.data(), n});
  return sense != 0;
}

/// Whether two facets of one type name the same nodes in the same sense, from whatever corner.
bool same_facet(const SurfaceFacet& a, const SurfaceFacet& b) {
  const auto n = static_cast<std::size_t>(cell::info(a.type).corners);
  const auto nodes = static_cast<std::size_t>(cell::info(a.type).nodes);
  for (std::size_t shift = 0; shift < n; ++shift) {
    bool same = true;
    for (std::size_t k = 0; k < nodes && same; ++k) {
      const std::size_t ring = k < 2 * n ? k / n * n : 0;
      const std::size_t other = k < 2 * n ? ring + (k - ring + shift) % n : k;
      same = a.node[k] == b.node[other];
    }
    if (same) return true;
  }
  return false;
}

void turn_round(SurfaceFacet& facet) {
  reverse_area(facet.type, {facet.node.data(), facet.nodes().size()});
  facet.flipped = !facet.flipped;
}

/// Orients an area by the volume behind it, if there is one; an empty text means success.
std::string orient(const Mesh& mesh, const FaceTable& table, SurfaceFacet& facet) {
  const std::span<const Face> parents = table.find(facet.corners());
  if (parents.empty()) return {};
  if (parents.size() > 1)
    return fmt::format("{} lies inside a body: it is a face of {} cells",
                       describe_facet(mesh, facet), parents.size());
  SurfaceFacet face;
  if (!outward_face(mesh, parents[0], face))
    return fmt::format("{}: the cell behind it has no volume", describe_facet(mesh, facet));
  if (face.type != facet.type)
    return fmt::format("{}: the face of the cell behind it is a {}", describe_facet(mesh, facet),
                       cell::info(face.type).name);
  facet.parent = parents[0].cell;
  if (same_facet(facet, face)) return {};
  turn_round(facet);
  if (same_facet(facet, face)) return {};
  turn_round(facet);
  return fmt::format("{} has its nodes in another order than the face of the cell behind it",
                     describe_facet(mesh, facet));
}

SurfaceFacet area_facet(const Mesh& mesh, CellRef ref) {
  SurfaceFacet facet;
  facet.type = block_of(mesh, ref).type;
  facet.area = ref;
  std::copy_n(nodes_of(mesh, ref), cell::info(facet.type).nodes, facet.node.begin());
  return facet;
}

// ---- edges of a surface -----------------------------------------------------------------------

/// An edge of a facet: `forward` if it runs from the smaller node to the larger.
struct FacetEdge {
  std::array<Index, 2> ends;  // sorted
  std::size_t facet, local;
  bool forward;
};

/// All edges of the facets that `wanted` accepts, equal ones side by side.
template <class Wanted>
std::vector<FacetEdge> sorted_edges(const std::vector<SurfaceFacet>& facets, const Wanted& wanted) {
  std::vector<FacetEdge> edges;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    if (!wanted(facets[f])) continue;
    const std::span<const Index> c = facets[f].corners();
    for (std::size_t k = 0; k < c.size(); ++k) {
      const Index a = c[k];
      const Index b = c[(k + 1) % c.size()];
      edges.push_back({{std::min(a, b), std::max(a, b)}, f, k, a < b});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const FacetEdge& a, const FacetEdge& b) {
    if (a.ends != b.ends) return a.ends < b.ends;
    return a.facet != b.facet ? a.facet < b.facet : a.local < b.local;
  });
  return edges;
}

/// Calls `visit` with each group of edges that join the same two nodes.
template <class Visit>
void for_each_edge(const std::vector<FacetEdge>& edges, const Visit& visit) {
  for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
    for (end = i + 1; end < edges.size() && edges[end].ends == edges[i].ends;) ++end;
    visit(std::span<const FacetEdge>(edges).subspan(i, end - i));
  }
}

std::string describe_edge(const Mesh& mesh, const std::array<Index, 2>& ends) {
  return fmt::format("the edge from {} to {}", describe_node(mesh, ends[0]),
                     describe_node(mesh, ends[1]));
}

/// A neighbour of an area without volume, and whether both have the same orientation now.
struct Neighbour {
  std::size_t facet;
  bool agrees;
  std::array<Index, 2> ends;
};

/// The areas that hang together with `first`, and which of them must be turned round to agree with
/// it.
struct Sheet {
  std::vector<std::size_t> facets;
  std::size_t turned = 0;
  std::string problem;
};

Sheet walk_sheet(const Mesh& mesh, const std::vector<std::vector<Neighbour>>& neighbours,
                 std::size_t first, std::vector<std::int8_t>& sense) {
  Sheet sheet{{first}, 0, {}};
  sense[first] = 1;
  for (std::size_t i = 0; i < sheet.facets.size(); ++i) {
    const std::size_t f = sheet.facets[i];
    for (const Neighbour& next : neighbours[f]) {
      const auto wanted = static_cast<std::int8_t>(next.agrees ? sense[f] : -sense[f]);
      if (sense[next.facet] == 0) {
        sense[next.facet] = wanted;
        sheet.facets.push_back(next.facet);
        sheet.turned += wanted < 0 ? 1 : 0;
      } else if (sense[next.facet] != wanted && sheet.problem.empty()) {
        sheet.problem = "the surface has no two sides (like a Moebius strip): seen across " +
                        describe_edge(mesh, next.ends);
      }
    }
  }
  return sheet;
}

/// One orientation for areas without volume that hang together.
void align_sheets(const Mesh& mesh, const std::string& set, Surface& surface) {
  std::vector<SurfaceFacet>& facets = surface.facets;
  std::vector<std::vector<Neighbour>> neighbours(facets.size());
  const auto is_free = [](const SurfaceFacet& facet) { return !facet.has_parent(); };
  for_each_edge(sorted_edges(facets, is_free), [&](std::span<const FacetEdge> group) {
    if (group.size() != 2 || group[0].facet == group[1].facet) return;
    const bool agrees = group[0].forward != group[1].forward;
    neighbours[group[0].facet].push_back({group[1].facet, agrees, group[0].ends});
    neighbours[group[1].facet].push_back({group[0].facet, agrees, group[0].ends});
  });
  std::vector<std::int8_t> sense(facets.size(), 0);
  std::size_t turned = 0;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    if (sense[f] != 0 || !is_free(facets[f])) continue;
    const Sheet sheet = walk_sheet(mesh, neighbours, f, sense);
    if (!sheet.problem.empty())
      add_message(surface.errors, fmt::format("set '{}': {}", set, sheet.problem));
    const std::int8_t minority = 2 * sheet.turned > sheet.facets.size() ? 1 : -1;
    for (const std::size_t member : sheet.facets) {
      if (sense[member] != minority) continue;
      turn_round(facets[member]);
      ++turned;
    }
  }
  if (turned > 0 && surface.errors.empty())
    add_message(
        surface.warnings,
        fmt::format("{} of {} areas were turned round so that neighbours face the same side",
                    turned, facets.size()));
}

/// Free faces accepted by `wanted`, in the order of the cells.
template <class Wanted>
Surface free_faces(const Mesh& mesh, const FaceTable& table, const Wanted& wanted) {
  std::vector<Face> chosen;
  const std::vector<Face>& faces = table.faces;
  for (std::size_t i = 0, end = 0; i < faces.size(); i = end) {
    for (end = i + 1; end < faces.size() && faces[end].key == faces[i].key;) ++end;
    if (end == i + 1 && wanted(faces[i])) chosen.push_back(faces[i]);
  }
  std::sort(chosen.begin(), chosen.end(), [](const Face& a, const Face& b) {
    if (a.cell.block != b.cell.block) return a.cell.block < b.cell.block;
    if (a.cell.cell != b.cell.cell) return a.cell.cell < b.cell.cell;
    return a.local < b.local;
  });
  Surface surface;
  for (const Face& face : chosen) {
    SurfaceFacet facet;
    if (outward_face(mesh, face, facet))
      surface.facets.push_back(facet);
    else
      add_message(surface.errors,
                  fmt::format("{}: the cell behind it has no volume", describe_facet(mesh, facet)));
  }
  connect(mesh, surface);
  return surface;
}

}  // namespace

void reverse_area(cell::CellType type, std::span<Index> nodes) {
  const cell::CellInfo& info = cell::info(type);
  assert(info.dimension == 2);
  const auto first = nodes.begin();
  std::reverse(first + 1, first + info.corners);
  if (info.order == 2) std::reverse(first + info.corners, first + 2 * info.corners);
}

Surface orient_surface(const Mesh& mesh, const FaceTable& table, const Set& set) {
  assert(set.dimension == 2);
  Surface surface;
  std::set<FaceKey> used;
  for (const CellRef ref : set.cells) {
    SurfaceFacet facet = area_facet(mesh, ref);
    std::string problem = orient(mesh, table, facet);
    FaceKey key{-1, -1, -1, -1};
    std::copy(facet.corners().begin(), facet.corners().end(), key.begin());
    std::sort(key.begin(), key.end());
    if (!used.insert(key).second)
      problem = fmt::format("{} is there twice", describe_facet(mesh, facet));
    if (problem.empty())
      surface.facets.push_back(facet);
    else
      add_message(surface.errors, fmt::format("set '{}': {}", set.name, problem));
  }
  align_sheets(mesh, set.name, surface);
  connect(mesh, surface);
  return surface;
}

Surface orient_surface(const Mesh& mesh, const Set& set) {
  return orient_surface(mesh, face_table(mesh), set);
}

Surface surface_facets(const Mesh& mesh, const FaceTable& table, const Set& set) {
  std::vector<std::vector<bool>> inside(mesh.blocks.size());
  for (std::size_t b = 0; b < inside.size(); ++b)
    inside[b].resize(static_cast<std::size_t>(mesh.blocks[b].size()));
  for (const CellRef ref : set.cells)
    inside[static_cast<std::size_t>(ref.block)][static_cast<std::size_t>(ref.cell)] = true;
  return free_faces(mesh, table, [&](const Face& face) {
    return inside[static_cast<std::size_t>(face.cell.block)]
                 [static_cast<std::size_t>(face.cell.cell)];
  });
}

Surface surface_facets(const Mesh& mesh, const Set& set) {
  return surface_facets(mesh, face_table(mesh), set);
}

Surface faces_of_nodes(const Mesh& mesh, const FaceTable& table, std::span<const Index> nodes) {
  std::vector<bool> marked(mesh.nodes.size());
  for (const Index node : nodes) marked[static_cast<std::size_t>(node)] = true;
  Surface surface = free_faces(mesh, table, [&](const Face& face) {
    const cell::CellFace& local =
        info_of(mesh, face.cell).faces[static_cast<std::size_t>(face.local)];
    const Index* const cell = nodes_of(mesh, face.cell);
    const auto begin = local.nodes.begin();
    return std::all_of(begin, begin + cell::info(local.type).nodes,
                       [&](auto k) { return marked[static_cast<std::size_t>(cell[k])]; });
  });
  for (const SurfaceFacet& facet : surface.facets)
    for (const Index node : facet.nodes()) marked[static_cast<std::size_t>(node)] = false;
  for (const Index node : nodes) {
    if (!marked[static_cast<std::size_t>(node)]) continue;
    marked[static_cast<std::size_t>(node)] = false;
    add_message(surface.warnings,
                describe_node(mesh, node) + " is on no free face with all its nodes in the set");
  }
  return surface;
}

Surface surface_of(const Mesh& mesh, const FaceTable& table, const Set& set) {
  if (set.dimension == 2) return orient_surface(mesh, table, set);
  if (set.dimension == 3) return surface_facets(mesh, table, set);
  if (set.dimension == 0) return faces_of_nodes(mesh, table, set.nodes);
  Surface surface;
  surface.errors.push_back(fmt::format(
      "set '{}' is made of lines; a surface in space is made of areas, volumes or nodes",
      set.name));
  return surface;
}

void connect(const Mesh& mesh, Surface& surface) {
  for (SurfaceFacet& facet : surface.facets) facet.next.fill(-1);
  surface.branching.clear();
  const auto all = [](const SurfaceFacet&) { return true; };
  for_each_edge(sorted_edges(surface.facets, all), [&](std::span<const FacetEdge> group) {
    if (group.size() < 2) return;
    const FacetEdge& a = group[0];
    const FacetEdge& b = group[1];
    if (group.size() == 2 && a.forward != b.forward && a.facet != b.facet) {
      surface.facets[a.facet].next[a.local] = static_cast<Index>(b.facet);
      surface.facets[b.facet].next[b.local] = static_cast<Index>(a.facet);
      return;
    }
    surface.branching.push_back(a.ends);
    const std::string edge = describe_edge(mesh, a.ends);
    add_message(surface.warnings, group.size() == 2
                                      ? "the surface changes sides across " + edge
                                      : fmt::format("{} facets meet along {}", group.size(), edge));
  });
}

}  // namespace osculate::mesh
