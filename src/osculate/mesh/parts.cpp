#include <algorithm>
#include <numeric>
#include <unordered_map>

#include "osculate/mesh/boundary.hpp"
#include "osculate/mesh/support.hpp"
#include "osculate/mesh/surface.hpp"

namespace osculate::mesh {
namespace {

/// What cells can share: a node, the ends of an edge or the corners of a face, sorted.
void append_keys(const Mesh& mesh, CellRef ref, Link link, std::vector<FaceKey>& keys) {
  const cell::CellInfo& info = info_of(mesh, ref);
  const Index* const nodes = nodes_of(mesh, ref);
  if (link == Link::node) {
    for (int k = 0; k < info.nodes; ++k) keys.push_back({-1, -1, -1, nodes[k]});
    return;
  }
  if (info.dimension == 2)
    for (int e = 0; e < info.edge_count; ++e) {
      const auto& local = info.edges[static_cast<std::size_t>(e)];
      keys.push_back({-1, -1, nodes[local[0]], nodes[local[1]]});
    }
  for (int f = 0; f < info.face_count; ++f) {
    const cell::CellFace& face = info.faces[static_cast<std::size_t>(f)];
    FaceKey key{-1, -1, -1, -1};
    for (int k = 0; k < cell::info(face.type).corners; ++k)
      key[static_cast<std::size_t>(k)] = nodes[face.nodes[static_cast<std::size_t>(k)]];
    keys.push_back(key);
  }
  for (FaceKey& key : keys) std::sort(key.begin(), key.end());
}

struct KeyHash {
  std::size_t operator()(const FaceKey& key) const {
    std::uint64_t hash = 14695981039346656037U;
    for (const Index node : key) hash = (hash ^ static_cast<std::uint32_t>(node)) * 1099511628211U;
    return static_cast<std::size_t>(hash ^ (hash >> 29U));
  }
};

}  // namespace

std::vector<std::vector<CellRef>> connected_parts(const Mesh& mesh, std::span<const CellRef> cells,
                                                  Link link) {
  std::vector<std::size_t> root(cells.size());
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto find = [&root](std::size_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  std::unordered_map<FaceKey, std::size_t, KeyHash> owner;
  std::vector<FaceKey> keys;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    keys.clear();
    append_keys(mesh, cells[i], link, keys);
    for (const FaceKey& key : keys) {
      const auto [place, is_new] = owner.try_emplace(key, i);
      if (is_new) continue;
      const std::size_t a = find(place->second);
      const std::size_t b = find(i);
      root[std::max(a, b)] = std::min(a, b);
    }
  }
  std::vector<std::vector<CellRef>> parts;
  std::vector<std::size_t> part_of(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::size_t r = find(i);
    if (r == i) {
      part_of[i] = parts.size();
      parts.emplace_back();
    }
    parts[part_of[r]].push_back(cells[i]);
  }
  return parts;
}

}  // namespace osculate::mesh
