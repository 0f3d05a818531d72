#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <unordered_map>

#include "osculate/io/gmsh/raw.hpp"
#include "osculate/mesh/surface.hpp"

namespace osculate::io::gmsh {
namespace {

using Nodes = std::array<Index, 27>;

struct CellKey {
  Nodes nodes;
  EntityKey entity;
  bool operator==(const CellKey&) const = default;
};

struct CellHash {
  std::size_t operator()(const CellKey& key) const {
    std::uint64_t hash = 14695981039346656037U ^ static_cast<std::uint64_t>(key.entity.second);
    for (const Index node : key.nodes)
      hash = (hash ^ static_cast<std::uint32_t>(node)) * 1099511628211U;
    return static_cast<std::size_t>(hash ^ (hash >> 29U));
  }
};

/// The cell walked the other way round, first node kept for areas. Volumes have no other way: a
/// group of them with a negative tag holds them as they are.
Nodes reversed(cell::CellType type, const Nodes& n) {
  const cell::CellInfo& info = cell::info(type);
  Nodes out = n;
  if (info.dimension == 1) {
    std::swap(out[0], out[1]);
    std::reverse(out.begin() + 2, out.begin() + info.nodes);
  } else if (info.dimension == 2) {
    mesh::reverse_area(type, {out.data(), static_cast<std::size_t>(info.nodes)});
  }
  return out;
}

/// Entities whose cells are in several physical groups. MSH 2 repeats their cells, one for each
/// group.
std::set<EntityKey> shared_entities(const std::vector<Group>& groups) {
  std::set<EntityKey> seen;
  std::set<EntityKey> shared;
  for (const Group& group : groups)
    if (!group.physical.empty() && (!seen.insert(group.entity).second || group.physical.size() > 1))
      shared.insert(group.entity);
  return shared;
}

std::string default_name(const EntityKey& key) {
  constexpr std::array<const char*, 4> kinds{"point", "line", "surface", "volume"};
  return fmt::format("{}_{}", kinds[static_cast<std::size_t>(key.first)], key.second);
}

/// Puts cells into blocks and sets.
class Builder {
 public:
  explicit Builder(const RawMesh& raw) : raw_(raw), shared_(shared_entities(raw.groups)) {
    for (const auto& [key, name] : raw.names) sets_[key].dimension = key.first;
    for (const Group& group : raw.groups) is_shared_.push_back(shared_.contains(group.entity));
  }

  void add_block(const cell::CellInfo& info) {
    const RawCells& cells = raw_.cells[static_cast<std::size_t>(info.type)];
    if (cells.group.empty()) return;
    mesh_.blocks.push_back({info.type, {}});
    mesh_.blocks.back().connectivity.reserve(cells.connectivity.size());
    mesh_.blocks.back().numbers.reserve(cells.numbers.size());
    known_.clear();
    const auto width = static_cast<std::size_t>(info.nodes);
    for (std::size_t c = 0; c < cells.group.size(); ++c) {
      Nodes nodes{};
      std::copy_n(cells.connectivity.begin() + static_cast<std::ptrdiff_t>(c * width), width,
                  nodes.begin());
      add_cell(info, nodes, cells.group[c], cells.numbers[c]);
    }
  }

  mesh::Mesh finish(const Cursor& cursor, std::vector<Vec3> nodes) {
    mesh_.nodes = std::move(nodes);
    mesh_.numbers = raw_.node_map.numbers();
    std::set<std::string> used;
    for (auto& [key, set] : sets_) {
      const auto named = raw_.names.find(key);
      set.name = named != raw_.names.end() ? named->second : default_name(key);
      if (!used.insert(set.name).second)
        cursor.fail_at(Cursor::nowhere,
                       fmt::format("two physical groups have the name '{}'", set.name));
      std::sort(set.nodes.begin(), set.nodes.end());
      set.nodes.erase(std::unique(set.nodes.begin(), set.nodes.end()), set.nodes.end());
      mesh_.sets.push_back(std::move(set));
    }
    return std::move(mesh_);
  }

 private:
  void add_cell(const cell::CellInfo& info, const Nodes& nodes, Index g, std::int64_t number) {
    const Group& group = raw_.groups[static_cast<std::size_t>(g)];
    const bool shared = is_shared_[static_cast<std::size_t>(g)];
    if (group.physical.empty()) (void)store(info, nodes, number);
    for (const std::int64_t physical : group.physical) {
      const Nodes directed = physical < 0 ? reversed(info.type, nodes) : nodes;
      mesh::CellRef ref{};
      if (shared) {
        const auto [place, is_new] = known_.try_emplace({directed, group.entity});
        if (is_new) place->second = store(info, directed, number);
        ref = place->second;
      } else {
        ref = store(info, directed, number);
      }
      mesh::Set& set = sets_[{info.dimension, std::abs(physical)}];
      set.dimension = info.dimension;
      set.cells.push_back(ref);
      set.nodes.insert(set.nodes.end(), directed.begin(), directed.begin() + info.nodes);
    }
  }

  mesh::CellRef store(const cell::CellInfo& info, const Nodes& nodes, std::int64_t number) {
    mesh::Block& block = mesh_.blocks.back();
    const mesh::CellRef ref{static_cast<Index>(mesh_.blocks.size()) - 1, block.size()};
    block.connectivity.insert(block.connectivity.end(), nodes.begin(), nodes.begin() + info.nodes);
    block.numbers.push_back(number);
    return ref;
  }

  const RawMesh& raw_;
  std::set<EntityKey> shared_;
  std::vector<bool> is_shared_;  ///< per group
  std::unordered_map<CellKey, mesh::CellRef, CellHash> known_;
  std::map<EntityKey, mesh::Set> sets_;
  mesh::Mesh mesh_;
};

}  // namespace

mesh::Mesh build_mesh(const Cursor& cursor, RawMesh raw) {
  std::vector<Vec3> nodes = std::move(raw.nodes);
  Builder builder(raw);
  for (const cell::CellInfo& info : cell::all_cells()) builder.add_block(info);
  return builder.finish(cursor, std::move(nodes));
}

}  // namespace osculate::io::gmsh
